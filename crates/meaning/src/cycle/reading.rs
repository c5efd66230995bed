//! Cycle blocks and hole patterns: from words to [`Holes`].

use base::{AXES, Alarm, Condition, Point};
use dialect::{CycleInCompensation, CycleL0Moves, CycleSpindleUnknown, CycleStep, CycleSteps, G87Return, Meaning};

use super::pattern::{Places, sin_cos_deg};
use super::{CycleData, Holes, Spindle, store, store_shift};
use crate::block::Reading;
use crate::command::Body;
use crate::coordinate::LENGTH_AXIS;
use crate::operation::{Feed, RapidKind, Side};
use crate::unknown::letter_bit;

/// Bits of the parameter for the direction in which Q shifts the tool.
const SHIFTS_TO_MINUS: u8 = 1;
const SHIFTS_ALONG_Y: u8 = 2;

impl Reading<'_> {
    /// The initial level in program coordinates.
    fn initial_level(&self, cycle: Meaning) -> Result<f64, Alarm> {
        let axis = self.drilling_axis()?;
        Ok(self.level_programmed(cycle, axis, self.next.cycle.initial + self.next.length))
    }

    fn drilling_axis(&self) -> Result<usize, Alarm> {
        self.setting.length_axis.ok_or_else(|| self.motion_alarm(Condition::AddressUnavailable))
    }

    /// Takes the initial level when the cycle mode is entered, and forgets the data when it is left.
    pub fn enter_cycle(&mut self) -> Result<(), Alarm> {
        let control = self.control();
        let roles = control.roles;
        let is_on = |row: u8| control.g_codes.get(usize::from(row)).is_some_and(|code| code.meaning.is_cycle());
        let before = is_on(self.before.groups.0[roles.cycle]);
        let now = is_on(self.next.groups.0[roles.cycle]);
        let ended_here = self.groups_written & (1 << roles.cycle | 1 << roles.motion) != 0;
        if !now && (before || ended_here) {
            self.next.cycle = CycleData::default();
        }
        if now && !before {
            let axis = self.drilling_axis()?;
            // The offset may change in this very block; the level is that of the tool as it stands. It keeps its place
            // on the machine when the work system changes, and follows the length offset.
            self.next.cycle.initial = self.next.machine[axis] - (self.next.length - self.length_change);
        }
        Ok(())
    }

    /// A block while a cycle is in force: it stores data, and drills if it names a place.
    pub fn cycle_block(&mut self, cycle: Meaning) -> Result<(), Alarm> {
        let control = self.control();
        let (units, absolute) = (self.units, self.absolute);
        let initial = self.initial_level(cycle)?;
        store(&self.words, control, units, absolute, initial, &mut self.next.cycle)?;
        self.store_dwell()?;
        let table = &control.functions.cycle;
        if table.shifts_by_ij {
            store_shift(&self.words, control, units, &mut self.next.cycle)?;
        }
        let levels = letter_bit(b'R') | letter_bit(LENGTH_AXIS);
        if !self.words.has_any(self.setting.axis_letters | levels) {
            return Ok(());
        }
        let drilling = self.drilling_axis()?;
        let repeats = table.repeats.iter().copied().find(|&letter| self.words.has(letter));
        let count = match repeats.filter(|_| !self.calls_or_returns) {
            Some(letter) => self.words.count(control, letter)?.unwrap_or(1),
            None => 1,
        };
        if count == 0 && self.setting.fitting.policies.cycle_l0_moves == CycleL0Moves::No {
            return Ok(());
        }
        let named = self.axes_named().without(base::AxisSet::only(drilling));
        let places = self.row_of_holes(named, count.max(1))?;
        let approach = self.cycle_approach();
        self.holes((count > 0).then_some(cycle), places, approach)
    }

    /// Takes P into the cycle's data, unless it is that of a call or a jump.
    fn store_dwell(&mut self) -> Result<(), Alarm> {
        if self.calls_or_returns {
            return Ok(());
        }
        let Some(number) = self.dwell_number(b'P')? else { return Ok(()) };
        self.next.cycle.dwell = self.words.seconds(self.control(), b'P', number)?;
        Ok(())
    }

    /// G70, G71, G72: holes on a circle, an arc or a line, made with the cycle in force or only gone to.
    pub fn pattern(&mut self, code: Meaning, cycle: Option<Meaning>) -> Result<(), Alarm> {
        let control = self.control();
        let [Some(x), Some(y)] = [b'X', b'Y'].map(|letter| self.setting.facts.axis(letter)) else {
            return Err(self.one_shot_alarm(Condition::AddressUnavailable));
        };
        if let Some(cycle) = cycle {
            let (units, absolute) = (self.units, self.absolute);
            let initial = self.initial_level(cycle)?;
            // Here I and J belong to the pattern; R, Z, Q and P may still renew the cycle's data.
            store(&self.words, control, units, absolute, initial, &mut self.next.cycle)?;
            self.store_dwell()?;
        }
        let count = self.words.integer(control, b'L')?.unwrap_or(0);
        let size = self.words.length(control, b'I', self.units)?.unwrap_or(0.0);
        let angle = self.words.angle(control, b'J')?.unwrap_or(0.0) / 1e6;
        let mut named = self.axes_named();
        if let (Some(drilling), true) = (self.setting.length_axis, cycle.is_some()) {
            named = named.without(base::AxisSet::only(drilling));
        }
        let mut level = [0.0; base::AXES];
        let moved = self.targets_of(named, &mut level)?;
        self.now_known = self.now_known.or(moved);
        let transform = self.next.transform;
        let wrong = |condition, letter| match self.words.has(letter) {
            true => self.words.alarm(condition, letter),
            false => self.one_shot_alarm(condition),
        };
        if count == 0 {
            return Err(wrong(Condition::PatternCount, b'L'));
        }
        if count < 0 && code != Meaning::BoltCircle {
            return Err(wrong(Condition::PatternCount, b'L'));
        }
        let places = if code != Meaning::LinePattern {
            if size <= 0.0 {
                return Err(wrong(Condition::PatternRadius, b'I'));
            }
            let step = match code {
                Meaning::BoltCircle => 360.0 / count as f64,
                _ => self.words.angle(control, b'K')?.unwrap_or(0.0) / 1e6,
            };
            Places::Circle {
                level,
                axes: [x as u8, y as u8],
                center: [level[x], level[y]],
                arms: [transform.vector([x, y], [size, 0.0]), transform.vector([x, y], [0.0, size])],
                first_deg: angle,
                step_deg: step,
                count: count.unsigned_abs() as u32,
            }
        } else {
            let (sin, cos) = sin_cos_deg(angle);
            let mut step = [0.0; AXES];
            [step[x], step[y]] = transform.vector([x, y], [size * cos, size * sin]);
            Places::Row { first: level, step, count: count.unsigned_abs() as u32 }
        };
        // Positions of a pattern are gone to as by G00, under G60 too.
        self.holes(cycle, places, [0.0; AXES])
    }

    /// The block's holes, and where it leaves the axes.
    fn holes(&mut self, cycle: Option<Meaning>, places: Places, approach: Point) -> Result<(), Alarm> {
        if self.command.side != Side::Off {
            if self.setting.fitting.policies.cycle_in_compensation == CycleInCompensation::Refuse {
                return Err(match self.one_shot {
                    Some(_) => self.one_shot_alarm(Condition::CycleInCompensation),
                    None => self.motion_alarm(Condition::CycleInCompensation),
                });
            }
            self.command.drops = self.setting.facts.all();
        }
        let drilling = self.drilling_axis()?;
        let mut end_point = places.at(places.count().saturating_sub(1));
        if cycle.is_some() {
            end_point[drilling] = self.next.machine[drilling];
        }
        let mut holes = Holes {
            cycle,
            steps: cycle.map_or_else(Default::default, |cycle| self.control().functions.cycle.steps_of(cycle)),
            places,
            approach,
            axis: drilling as u8,
            r: 0.0,
            bottom: 0.0,
            end: self.next.machine[drilling],
            peck: 0.0,
            clearance: 0.0,
            dwell: 0.0,
            shift: [0.0; 2],
            shift_axes: [drilling as u8; 2],
            start: None,
            restart: None,
            by_hand: false,
            feed: Feed { mm_per_min: 0.0, exact_stop: false, tapping: false, per_revolution: false, way_mm: 0.0 },
            rapid: RapidKind::Checked,
        };
        if let Some(cycle) = cycle {
            self.levels(cycle, drilling, &mut holes)?;
            self.spindle(cycle, &mut holes);
            if self.control().functions.cycle.shifts(cycle) {
                self.shift(&mut holes)?;
            }
            end_point[drilling] = holes.end;
            self.next.length_due = 0.0;
            self.now_known.add(drilling);
        }
        self.next.machine = end_point;
        self.command.body = Body::Holes(holes);
        Ok(())
    }

    fn levels(&self, cycle: Meaning, drilling: usize, holes: &mut Holes) -> Result<(), Alarm> {
        let control = self.setting.control.as_ref();
        let data = self.next.cycle;
        let (Some(r), Some(bottom)) = (data.r, data.bottom) else {
            return Err(self.motion_alarm(Condition::CycleLevelMissing));
        };
        if control.functions.cycle.pecks(cycle) && data.peck <= 0.0 {
            return Err(self.q_alarm(Condition::CyclePeckMissing));
        }
        // After back boring the tool would stand at R under the part.
        let to_r = control.in_force(&self.next.groups, control.roles.return_level) == Some(Meaning::ReturnR)
            && cycle != Meaning::BackBore;
        holes.r = self.level_placed(cycle, drilling, r);
        holes.bottom = self.level_placed(cycle, drilling, bottom);
        holes.end = if to_r { holes.r } else { data.initial + self.next.length };
        holes.peck = data.peck;
        holes.clearance = self.setting.fitting.parameter(control.tolerances.cycle_clearance) * 1e6;
        holes.dwell = data.dwell;
        holes.feed = self.feed()?;
        Ok(())
    }

    /// How the spindle starts again, and how it turns after the block.
    fn spindle(&mut self, cycle: Meaning, holes: &mut Holes) {
        let policies = &self.setting.fitting.policies;
        holes.restart = match self.next.spindle_direction {
            None if policies.cycle_spindle_unknown == CycleSpindleUnknown::Forward => Some(Spindle::Forward),
            direction => direction,
        };
        holes.by_hand = cycle != Meaning::BoreManualOut || policies.g87_return == G87Return::Manual;
        holes.start = self.spindle_through(&holes.steps);
    }

    /// How the spindle turns once the steps are done; which way they start it, if they want it and it does not turn so.
    fn spindle_through(&mut self, steps: &CycleSteps) -> Option<Spindle> {
        let mut start = None;
        for &step in steps {
            let (now, wanted) = match step {
                CycleStep::StartForward => (Spindle::Forward, true),
                CycleStep::StartReverse => (Spindle::Reverse, true),
                CycleStep::Forward => (Spindle::Forward, false),
                CycleStep::Reverse => (Spindle::Reverse, false),
                CycleStep::Stop => (Spindle::Stop, false),
                CycleStep::Orient => (Spindle::Orient, false),
                CycleStep::Restart => {
                    self.next.spindle_stopped = false;
                    continue;
                }
                _ => continue,
            };
            if wanted && (self.next.spindle_direction != Some(now) || self.next.spindle_stopped) {
                start = Some(now);
            }
            self.next.spindle_stopped = !now.turns();
            if now.turns() {
                self.next.spindle_direction = Some(now);
            }
        }
        start
    }

    /// The shift off the wall: I and J if they are stored, else Q in the direction that a parameter sets.
    fn shift(&self, holes: &mut Holes) -> Result<(), Alarm> {
        let [Some(x), Some(y)] = [b'X', b'Y'].map(|letter| self.setting.facts.axis(letter)) else {
            return Err(self.motion_alarm(Condition::AddressUnavailable));
        };
        let data = self.next.cycle;
        let direction = self.setting.fitting.parameter_if_any(self.control().tolerances.cycle_shift) as u8;
        let by_q = if direction & SHIFTS_TO_MINUS != 0 { -data.peck } else { data.peck };
        holes.shift_axes = [x as u8, y as u8];
        holes.shift = match data.shift.filter(|&vector| vector != [0.0; 2]) {
            Some(vector) => vector,
            None if direction & SHIFTS_ALONG_Y != 0 => [0.0, by_q],
            None => [by_q, 0.0],
        };
        // Q has no sign: the parameter says which way.
        let wrong = holes.shift == [0.0; 2] || data.peck < 0.0 && data.shift.is_none();
        if wrong { Err(self.q_alarm(Condition::CycleShiftMissing)) } else { Ok(()) }
    }

    /// An alarm at Q, or at the cycle's code if there is none.
    fn q_alarm(&self, condition: Condition) -> Alarm {
        if self.words.has(b'Q') { self.words.alarm(condition, b'Q') } else { self.motion_alarm(condition) }
    }
}
