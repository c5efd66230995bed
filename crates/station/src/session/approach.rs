//! Restart in mid-program: what it takes, the way of the axes to the place, and the program taken up there.

use base::{AxisSet, Place, Point};
use dialect::{GroupCodes, RestartApproach};
use machine::{EventKind, Machine, SpindleSays, StopCause};
use meaning::{CodeLine, CodeOut, LENGTH_AXIS, RapidKind};
use path::Shape;

use super::Session;
use super::by_hand::HandMove;
use super::trial::{Arrived, ProgramHead, Way};
use crate::block_target::BlockTarget;
use crate::library::Library;

/// Restart in mid-program as it would be done now.
#[derive(Clone, PartialEq, Debug)]
pub struct RestartPlan {
    /// The block.
    pub place: Place,
    /// The program in which it stands.
    pub program: String,
    /// Which execution of the block it is, and how many there are.
    pub pass: [u32; 2],
    /// The codes in force there.
    pub groups: GroupCodes,
    /// F, mm/min or mm/rev.
    pub feed: f64,
    /// S, T, B, H and D in force.
    pub words: [u32; 5],
    /// Where the axes stand, machine coordinates.
    pub from: Point,
    /// Where the block before ends, machine coordinates.
    pub to: Point,
    /// The same in the work system in force there.
    pub work: Point,
    /// The way there: axes one after the other, and where each one stands then.
    pub legs: Vec<(usize, f64)>,
    /// The codes that the machine still wants, in their order.
    pub give: Vec<(CodeLine, u32)>,
    /// M codes of which the control does not know what they have left.
    pub unknown: Vec<u32>,
    /// Axes that were moved without being counted: the restart counts them anew.
    pub uncounted: AxisSet,
    /// Axes that the program does not place before this block.
    pub unplaced: AxisSet,
    /// What else the program has done on the way.
    pub way: Way,
}

impl RestartPlan {
    /// True if both lead to the same block by the same way, in the same state and with the same codes.
    fn is_same(&self, other: &RestartPlan) -> bool {
        let block = |plan: &RestartPlan| (plan.place, plan.pass, plan.groups, plan.words, plan.feed);
        block(self) == block(other)
            && self.from == other.from
            && self.to == other.to
            && self.legs == other.legs
            && self.give == other.give
    }
}

/// The M codes of the spindle, as the machine's file has them in rows.
const FORWARD: usize = 0;
const REVERSE: usize = 1;
const STOP: usize = 2;
const ORIENTATION: usize = 3;
/// Nearer than this the axis stands there, mm or degrees.
const THERE: f64 = 1e-9;

impl<L: Library> Session<L> {
    /// What a restart at this block of a program takes; without one, of the selected program.
    ///
    /// # Errors
    /// Why the program cannot be entered there, in words.
    pub fn plan_restart(&mut self, target: &BlockTarget, text: Option<&ProgramHead>) -> Result<RestartPlan, String> {
        self.refuse_locks()?;
        let arrived = self.try_to(target, text)?;
        let plan = self.plan_of(&arrived);
        self.check_legs(&plan, &arrived)?;
        Ok(plan)
    }

    /// Takes up the program at this block: the axes go there first, and it runs on. `of_tape`: the reader reads it, from
    /// the tape's head up to the block without a stop.
    ///
    /// # Errors
    /// It is no longer as it was `confirmed`.
    pub fn restart(
        &mut self,
        target: &BlockTarget,
        text: Option<&ProgramHead>,
        confirmed: &RestartPlan,
        of_tape: bool,
    ) -> Result<(), String> {
        self.refuse_locks()?;
        let arrived = self.try_to(target, text)?;
        if !self.plan_of(&arrived).is_same(confirmed) {
            return Err("it is no longer as it was confirmed; ask for the restart again".to_owned());
        }
        self.come_back();
        let (place, groups) = (arrived.place, arrived.groups);
        let mut trial = arrived.trial;
        let tells = self.interpreter().tells_variables();
        trial.interpreter_mut().tell_variables(tells);
        self.forget_rehearsal();
        self.motion.drop_rest();
        self.motion.upstream = trial.motion.upstream;
        (self.pulled, self.between_blocks) = (true, trial.between_blocks);
        // The block has not begun: it is told when the axes have come to the place.
        (self.told, self.begun) = (None, trial.begun);
        (self.ended, self.rewound, self.label_skip) = (false, false, false);
        (self.stopped, self.feed_held) = (false, false);
        (self.fixes_override, self.switched) = (trial.fixes_override, true);
        self.machine.take_area(&trial.machine);
        self.lock.settle(self.configuration.machine.travel().axes);
        self.approach = Some((confirmed.to, confirmed.way.highest));
        self.reader = None;
        if of_tape {
            self.load_reader();
            self.wind_back();
        }
        let start = Place { program: place.program, source: place.source, ..Place::default() };
        self.tell(start, EventKind::Start(groups));
        self.release();
        Ok(())
    }

    /// Axes that a switch holds do not come to the place.
    fn refuse_locks(&self) -> Result<(), String> {
        let switches = &self.switches;
        if switches.machine_lock || switches.z_cancel || switches.display_lock {
            return Err("a lock switch is on: the axes would not come to the place".to_owned());
        }
        Ok(())
    }

    fn plan_of(&self, arrived: &Arrived) -> RestartPlan {
        let Arrived { trial, way, place, pass, groups } = arrived;
        let interpreter = trial.interpreter();
        let state = interpreter.state_before();
        let to = *trial.machine.position();
        let known = |code: &u32| self.configuration.control.m_code(*code).is_some() || self.knows_m(*code);
        let axes = self.configuration.machine.travel().axes;
        RestartPlan {
            place: *place,
            program: interpreter.program_name(place.program).to_owned(),
            pass: *pass,
            groups: *groups,
            feed: state.feed.nanometres / 1e6,
            words: [state.spindle, state.tool, state.index, state.h, state.d],
            from: self.position(),
            to,
            work: interpreter.work_position_in(state, &to),
            legs: self.legs_to(&to, way.highest),
            give: self.codes_to_give(trial, way),
            unknown: way.m_codes.iter().copied().filter(|code| !known(code)).collect(),
            uncounted: self.lock.astray(axes),
            unplaced: axes.without(way.placed).or(way.counted_from),
            way: way.clone(),
        }
    }

    /// True for the M codes of the spindle and of the tool change.
    fn knows_m(&self, code: u32) -> bool {
        let machine = &self.configuration.machine;
        machine.spindle.codes.iter().any(|codes| codes.contains(&code)) || machine.magazine.change.contains(&code)
    }

    /// The codes that bring spindle, tool and index table to where the program has them.
    fn codes_to_give<T: Library>(&self, trial: &Session<T>, way: &Way) -> Vec<(CodeLine, u32)> {
        let mut codes = Vec::new();
        let spindle = |machine: &machine::Spindle| (machine.rpm(f64::INFINITY), machine.orients());
        let (wanted, mut is) = (spindle(trial.machine.spindle()), spindle(self.machine.spindle()));
        let turns = &self.configuration.machine.spindle.codes;
        let turning = |row: usize| turns.get(row).and_then(|codes| codes.first()).map(|code| (CodeLine::M, *code));
        let ([tool, pocket], [own_tool, mut own_pocket]) = (trial.tools(), self.tools());
        if tool != own_tool {
            if tool != own_pocket {
                codes.push((CodeLine::T, tool));
            }
            if let Some(&change) = self.configuration.machine.magazine.change.first() {
                // What the builder's change waits for comes before it.
                let logic = &self.configuration.machine.logic;
                let asks = |says| logic.asks_spindle(CodeLine::M, change, says);
                if asks(SpindleSays::Angle) && !is.1 {
                    codes.extend(turning(ORIENTATION));
                    is = (0.0, true);
                } else if asks(SpindleSays::Stands) && is.0 != 0.0 {
                    codes.extend(turning(STOP));
                    is = (0.0, false);
                }
                codes.push((CodeLine::M, change));
            }
            own_pocket = tool;
        }
        if pocket != own_pocket {
            codes.push((CodeLine::T, pocket));
        }
        if let Some(CodeOut { code, .. }) = way.index
            && self.interpreter().executing_state().index != code
        {
            codes.push((CodeLine::B, code));
        }
        if wanted != is {
            let speed = trial.interpreter().state_before().spindle;
            let turning = match wanted {
                (_, true) => turning(ORIENTATION),
                (rpm, _) if rpm > 0.0 => turning(FORWARD),
                (rpm, _) if rpm < 0.0 => turning(REVERSE),
                _ => turning(STOP),
            };
            if wanted.0 != 0.0 && wanted.0.abs() != is.0.abs() {
                codes.push((CodeLine::S, speed));
            }
            codes.extend(turning);
        }
        codes
    }

    /// The axis along which the tool leaves the work.
    pub fn tool_axis(&self) -> Option<usize> {
        self.configuration.machine.axes.iter().position(|axis| axis.letter == LENGTH_AXIS)
    }

    /// The way of the axes from where they stand: one after the other, the tool off the work first and down last.
    fn legs_to(&self, to: &Point, highest: f64) -> Vec<(usize, f64)> {
        let (from, axes) = (self.position(), &self.configuration.machine.axes);
        let astray = |axis: &usize| (from[*axis] - to[*axis]).abs() > THERE;
        let z = self.tool_axis();
        let mut legs: Vec<_> =
            (0..axes.len()).filter(|axis| Some(*axis) != z && astray(axis)).map(|axis| (axis, to[axis])).collect();
        let Some(z) = z else { return legs };
        let mut at = from[z];
        let retracts = self.interpreter().fitting().policies.restart_approach == RestartApproach::Retract;
        if let (true, false, Some(&high)) = (retracts, legs.is_empty(), axes[z].reference_points.first())
            && at < high.max(highest) - THERE
        {
            at = high.max(highest);
            legs.insert(0, (z, at));
        }
        if (at - to[z]).abs() > THERE {
            legs.push((z, to[z]));
        }
        legs
    }

    /// The way there must lie within the travel and out of the stroke area as the program has left it.
    fn check_legs(&self, plan: &RestartPlan, arrived: &Arrived) -> Result<(), String> {
        let mut machine = self.machine.clone();
        machine.take_area(&arrived.trial.machine);
        let mut from = self.position();
        for &(axis, mm) in &plan.legs {
            let mut to = from;
            to[axis] = mm;
            let shaped = self.hand_shape(Shape::Rapid { from, to, kind: RapidKind::Checked });
            if let (_, Some(refusal)) = machine.free_part(&self.motion.time(&shaped)) {
                let letter = self.configuration.machine.axes.get(axis).map_or('?', |axis| char::from(axis.letter));
                let name = self.configuration.control.alarm_name(&refusal.alarm).name;
                return Err(format!("the way there, {letter} to {mm}, meets {name}: bring the axes nearer by hand"));
            }
            from = to;
        }
        Ok(())
    }

    /// True while the axes are on their way to where the program is taken up.
    pub(super) fn is_approaching(&self) -> bool {
        self.approach.is_some_and(|(to, highest)| !self.legs_to(&to, highest).is_empty())
    }

    /// The axes go on to where the program is taken up; false if they are there.
    pub(super) fn goes_on_approaching(&mut self) -> bool {
        let Some((to, highest)) = self.approach else { return false };
        let Some(&(axis, mm)) = self.legs_to(&to, highest).first() else {
            self.approach = None;
            return false;
        };
        if self.begin_by_hand(axis, HandMove::To(mm)).is_err() {
            // A lock switch has been turned on.
            self.hold_approach();
        }
        true
    }

    /// What is left of the approach waits for CYCLE START.
    pub(super) fn hold_approach(&mut self) {
        if self.approach.is_some() && self.alarm.is_none() {
            (self.stopped, self.feed_held) = (true, true);
            self.tell(Place::default(), EventKind::Stop(StopCause::FeedHold));
        }
    }
}
