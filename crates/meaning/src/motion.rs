//! Positioning, lines and arcs: from the words of a block to one move in machine coordinates.

use base::{AXES, Alarm, AxisSet, Condition, Point};
use dialect::{ArcWithoutCentre, Meaning, PositionOffsetAbsolute, PositionOffsetArcRadius, PositionOffsetLetter};

use crate::arc::{ArcWords, solve};
use crate::block::Reading;
use crate::command::Body;
use crate::coordinate::LENGTH_AXIS;
use crate::operation::{Plane, RapidKind, Side};
use crate::position_offset::PositionOffset;

impl Reading<'_> {
    /// Where an axis' word leads, machine coordinates.
    pub fn target(&mut self, axis: usize) -> Result<f64, Alarm> {
        self.length_axis_placed(axis);
        let (value, minus) = self.axis_word(axis)?;
        let now = self.next.machine[axis];
        let mut target = if self.absolute {
            let kept = match self.setting.fitting.policies.position_offset_absolute {
                PositionOffsetAbsolute::Dropped => 0.0,
                PositionOffsetAbsolute::Kept => self.next.displacement[axis],
            };
            self.placed(axis, value) + kept
        } else {
            now + self.next.transform.distance(axis, value) + self.length_change_on(axis)
        };
        if let Some(offset) = self.position_offset {
            let minus = minus != self.next.transform.mirrored.has(axis);
            let change = offset.change(target - now, minus && value == 0.0);
            self.next.displacement[axis] += change;
            target += change;
        } else if self.absolute
            && self.setting.fitting.policies.position_offset_absolute == PositionOffsetAbsolute::Dropped
        {
            self.next.displacement[axis] = 0.0;
        }
        Ok(target)
    }

    /// What an incremental word of the length axis has to make up for.
    fn length_change_on(&self, axis: usize) -> f64 {
        if Some(axis) == self.setting.length_axis { self.length_change } else { 0.0 }
    }

    /// Every named axis at its target, and the length axis moved by a changed offset if it has no word of its own.
    pub fn targets(&mut self) -> Result<(Point, AxisSet), Alarm> {
        let mut to = self.next.machine;
        let mut moved = AxisSet::NONE;
        let named = self.axes_named()?;
        for axis in named.iter() {
            to[axis] = self.target(axis)?;
            moved.add(axis);
        }
        let changes = self.words.has(b'H') || self.groups_written & (1 << self.control().roles.length) != 0;
        if self.length_change != 0.0
            && (changes || !named.is_empty())
            && let Some(axis) = self.setting.length_axis
            && !named.has(axis)
        {
            to[axis] += self.length_change;
            moved.add(axis);
            self.next.length_due = 0.0;
        }
        Ok((to, moved))
    }

    /// The block's movement under the motion code in force.
    pub fn motion(&mut self, motion: Meaning) -> Result<(), Alarm> {
        match motion {
            Meaning::ArcClockwise | Meaning::ArcCounterClockwise => self.arc(motion == Meaning::ArcClockwise),
            _ => {
                let (to, moved) = self.targets()?;
                if moved.is_empty() {
                    return Ok(());
                }
                self.now_known = self.now_known.or(moved);
                match motion {
                    Meaning::Linear => {
                        let feed = self.feed_to(&to)?;
                        self.command.body = Body::Line { to, feed };
                    }
                    Meaning::OneSidedPositioning => self.one_sided(to, moved),
                    _ => self.command.body = Body::Rapid { to, kind: self.rapid_kind },
                }
                self.next.machine = to;
                Ok(())
            }
        }
    }

    /// G60: every moving axis first goes to its approach point, stops, then arrives from one side.
    fn one_sided(&mut self, to: Point, moved: AxisSet) {
        let mut via = to;
        for axis in moved.iter() {
            if to[axis] != self.next.machine[axis] {
                via[axis] -= self.setting.facts.axes.get(axis).map_or(0.0, |facts| facts.approach);
            }
        }
        self.command.body = Body::Via { via, to, stops: false };
        self.rapid_kind = RapidKind::Checked;
    }

    /// G53: one block in machine coordinates, offsets suspended; in incremental mode its words are without effect.
    pub fn machine_coordinates(&mut self) -> Result<(), Alarm> {
        let axes = self.axes_named()?;
        if !self.absolute || axes.is_empty() {
            return Ok(());
        }
        let mut to = self.next.machine;
        for axis in axes.iter() {
            to[axis] = self.axis_word(axis)?.0;
            self.length_axis_placed(axis);
            self.next.displacement[axis] = 0.0;
        }
        let roles = self.setting.control.roles;
        self.command.body = match self.setting.control.in_force(&self.next.groups, roles.motion) {
            Some(Meaning::Linear) => Body::Line { to, feed: self.feed_to(&to)? },
            _ => Body::Rapid { to, kind: RapidKind::Checked },
        };
        self.now_known = self.now_known.or(axes);
        self.next.machine = to;
        Ok(())
    }

    /// The offset of G45 to G48, from D (or H, by policy).
    pub fn read_position_offset(&mut self, code: Meaning) -> Result<(), Alarm> {
        let Some(factor) = code.position_offset() else { return Ok(()) };
        let roles = self.setting.control.roles;
        if self.setting.control.in_force(&self.next.groups, roles.cycle).is_some_and(Meaning::is_cycle) {
            return Err(self.one_shot_alarm(Condition::PositionOffsetInCycle));
        }
        if self.command.side != Side::Off {
            return Err(self.one_shot_alarm(Condition::PositionOffsetInCompensation));
        }
        let by_h = self.setting.fitting.policies.position_offset_letter == PositionOffsetLetter::DOrH
            && !self.words.has(b'D')
            && self.words.has(b'H');
        let (letter, value) = if by_h {
            (b'H', self.offset(self.setting.memory.length(self.next.h)))
        } else {
            (b'D', self.offset(self.setting.memory.radius(self.next.d)))
        };
        let Some(offset) = value else {
            return Err(self.words.alarm(Condition::OffsetNumber, letter));
        };
        self.position_offset = Some(PositionOffset { factor, offset });
        Ok(())
    }

    /// The plane in force.
    pub fn plane(&self) -> Plane {
        match self.setting.control.in_force(&self.next.groups, self.setting.control.roles.plane) {
            Some(Meaning::PlaneZx) => Plane::Zx,
            Some(Meaning::PlaneYz) => Plane::Yz,
            _ => Plane::Xy,
        }
    }

    fn arc(&mut self, clockwise: bool) -> Result<(), Alarm> {
        let plane = self.plane();
        let letters = plane.centre_letters();
        let has_center = self.words.has(letters[0]) || self.words.has(letters[1]);
        let has_radius = self.words.has(b'R');
        if !has_center && !has_radius && self.axes_named()?.is_empty() && !self.words.has(b'H') {
            return Ok(());
        }
        if self.length_change != 0.0 && (has_center || has_radius || !self.axes_named()?.is_empty()) {
            return Err(self.words.alarm(Condition::LengthOffsetWithArc, b'H'));
        }
        let axes = plane.letters().map(|letter| self.arc_axis(letter));
        let [Some(u), Some(v)] = axes else { return Err(self.motion_alarm(Condition::AddressUnavailable)) };
        let (to, moved) = self.targets()?;
        let units = self.units;
        let control = self.control();
        let transform = self.next.transform;
        let clockwise = clockwise != transform.turns_over([u, v]);
        let radius = self.words.length(control, b'R', units)?.map(|radius| transform.size([u, v], radius));
        let straight = self.setting.fitting.policies.arc_without_centre == ArcWithoutCentre::StraightLine;
        if !has_center && radius.is_none() && straight {
            self.command.body = Body::Line { to, feed: self.feed()? };
            self.now_known = self.now_known.or(moved);
            self.next.machine = to;
            return Ok(());
        }
        if radius.is_some()
            && self.position_offset.is_some()
            && self.setting.fitting.policies.position_offset_arc_radius == PositionOffsetArcRadius::Refuse
        {
            return Err(self.words.alarm(Condition::PositionOffsetArcRadius, b'R'));
        }
        self.check_helix(moved, u, v)?;
        let from = self.next.machine;
        let tolerances = control.tolerances;
        let words = ArcWords {
            start: [from[u], from[v]],
            end: [to[u], to[v]],
            center: if has_center {
                Some([self.centre_word(letters[0], u)?, self.centre_word(letters[1], v)?])
            } else {
                None
            },
            radius,
            clockwise,
            radius_tolerance: self.setting.fitting.parameter(tolerances.arc_radius) * 1e6,
            end_limit: self.setting.fitting.parameter(tolerances.arc_end) * 1e6,
        };
        let solved = solve(words)
            .map_err(|(condition, values)| self.arc_alarm(condition, plane, [u, v], has_radius).with(values));
        let Some(solved) = solved? else { return Ok(()) };
        let feed = self.feed()?;
        self.command.body = Body::Arc {
            to,
            center: solved.center,
            axes: [u as u8, v as u8],
            plane,
            clockwise,
            full_circle: solved.full_circle,
            feed,
        };
        self.now_known = self.now_known.or(moved);
        self.next.machine = to;
        Ok(())
    }

    /// The alarm for an arc that cannot be, at the word that says so.
    fn arc_alarm(&self, condition: Condition, plane: Plane, ends: [usize; 2], by_radius: bool) -> Alarm {
        let first_of = |[one, other]: [u8; 2]| if self.words.has(one) { one } else { other };
        match condition {
            Condition::ArcWithoutCentre => self.motion_alarm(condition),
            Condition::ArcEndOff => {
                let letters = ends.map(|axis| self.setting.facts.axes.get(axis).map_or(b'X', |facts| facts.letter));
                self.words.alarm(condition, first_of(letters))
            }
            _ if by_radius => self.words.alarm(condition, b'R'),
            _ => self.words.alarm(condition, first_of(plane.centre_letters())),
        }
    }

    /// The axis of one of the plane's letters: the linear fourth axis along it (U, V, W along X, Y, Z) takes its place
    /// where it stands in the block alone.
    fn arc_axis(&self, letter: u8) -> Option<usize> {
        let facts = &self.setting.facts;
        let along = facts.axis(letter - (b'X' - b'U'));
        let is_linear = |axis: &usize| facts.axes.get(*axis).is_some_and(|facts| !facts.rotary);
        let alone = self.words.has(letter - (b'X' - b'U')) && !self.words.has(letter);
        along.filter(is_linear).filter(|_| alone).or_else(|| facts.axis(letter))
    }

    /// Another axis beside the plane's two makes a helix, which is an option.
    fn check_helix(&self, moved: AxisSet, u: usize, v: usize) -> Result<(), Alarm> {
        let others = moved.without(AxisSet::only(u)).without(AxisSet::only(v));
        match others.iter().next() {
            Some(axis) if !self.setting.fitting.options.helical => {
                let letter = self.setting.facts.axes.get(axis).map_or(0, |facts| facts.letter);
                Err(self.words.alarm(Condition::HelixNotFitted, letter))
            }
            _ => Ok(()),
        }
    }

    /// A centre word along an axis in counts, lengthened by G45 to G48 as the axis of its name would be.
    fn centre_word(&self, letter: u8, axis: usize) -> Result<f64, Alarm> {
        let Some(value) = self.words.length(self.control(), letter, self.units)? else { return Ok(0.0) };
        let value = self.next.transform.distance(axis, value);
        let minus = self.words.number(letter)?.is_some_and(|number| number.negative);
        let minus = minus != self.next.transform.mirrored.has(axis);
        Ok(value + self.position_offset.map_or(0.0, |offset| offset.change(value, minus)))
    }

    /// The distances of positioning from one side, where the motion code in force asks for them; none along the axis of
    /// the spindle.
    pub fn cycle_approach(&self) -> Point {
        let mut approach = [0.0; AXES];
        let motion = self.setting.control.in_force(&self.next.groups, self.setting.control.roles.motion);
        if motion == Some(Meaning::OneSidedPositioning) {
            for (axis, facts) in self.setting.facts.axes.iter().enumerate().take(AXES) {
                if facts.letter != LENGTH_AXIS {
                    approach[axis] = facts.approach;
                }
            }
        }
        approach
    }
}
