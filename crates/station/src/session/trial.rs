//! A trial: the program run from its head to a block by a second session, so that its state there is known.
//!
//! It is the same control on the same machine and texts, so it has no meaning of its own. Nothing of it is told, and
//! nothing of it touches this session.

use base::{AxisSet, Place, SourceId};
use dialect::GroupCodes;
use machine::{Event, EventKind, Fin, Machine};
use meaning::{BarrierKind, CodeLine, CodeOut, Quantity, SetValue, Side};
use syntax::Cursor;

use super::rehearsal::Lent;
use super::{Session, Step};
use crate::block_target::{At, BlockTarget};
use crate::library::Library;

/// A program: its text, its name, where it begins.
pub type ProgramHead = (SourceId, String, Cursor);

/// Blocks after which a trial is given up.
const MOST_BLOCKS: u64 = 5_000_000;

/// What the program has asked of the machine on the way: a later answer may be another.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Asked {
    /// The clock.
    pub clock: bool,
    /// Interface inputs.
    pub inputs: bool,
    /// Where an axis stands, or how far it is behind.
    pub position: bool,
    /// Where the skip signal came.
    pub skip: bool,
}

impl Asked {
    /// Takes note of a question.
    pub fn note(&mut self, kind: &BarrierKind) {
        match kind {
            BarrierKind::NeedValue(Quantity::Clock) => self.clock = true,
            BarrierKind::NeedValue(Quantity::Inputs) => self.inputs = true,
            BarrierKind::NeedValue(Quantity::Position(_) | Quantity::Deviation(_)) => self.position = true,
            BarrierKind::SkipPosition => self.skip = true,
            _ => {}
        }
    }
}

/// What a trial has met on its way.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Way {
    /// The last S, and the last B.
    pub speed: Option<CodeOut>,
    /// The last B.
    pub index: Option<CodeOut>,
    /// The M codes, each once, in the order in which they went out last.
    pub m_codes: Vec<u32>,
    /// The values that the program wrote, in their order.
    pub written: Vec<SetValue>,
    /// Axes that it has placed absolutely or returned to their reference point.
    pub placed: AxisSet,
    /// Axes whose coordinates it has set where they stood, before it had placed them.
    pub counted_from: AxisSet,
    /// What it asked of the machine.
    pub asked: Asked,
    /// The highest place of the tool's axis, machine coordinates.
    pub highest: f64,
}

impl Way {
    fn take(&mut self, event: &Event) {
        match event.kind {
            EventKind::Code(code) => match code.line {
                CodeLine::S => self.speed = Some(code),
                CodeLine::B => self.index = Some(code),
                CodeLine::T => {}
                CodeLine::M => {
                    self.m_codes.retain(|known| *known != code.code);
                    self.m_codes.push(code.code);
                }
            },
            EventKind::Set(value) => {
                if let SetValue::WorkOrigin { axes, .. } | SetValue::Shift { axes, .. } = value {
                    self.counted_from = self.counted_from.or(axes.without(self.placed));
                }
                // Of a variable the last value counts.
                if let SetValue::Variable { number, .. } = value {
                    let same = |set: &SetValue| matches!(set, SetValue::Variable { number: own, .. } if *own == number);
                    self.written.retain(|set| !same(set));
                }
                if self.written.len() < MOST_WRITTEN {
                    self.written.push(value);
                }
            }
            _ => {}
        }
    }
}

/// Values written that are kept.
const MOST_WRITTEN: usize = 1000;

/// A trial that has come to the beginning of the block that was looked for.
pub(super) struct Arrived {
    pub trial: Session<Lent>,
    pub way: Way,
    pub place: Place,
    /// Which execution of the block it is, and how many there are.
    pub pass: [u32; 2],
    /// The codes in force there.
    pub groups: GroupCodes,
}

impl<L: Library> Session<L> {
    /// The selected program, or the one that is named, from its head to a block.
    ///
    /// # Errors
    /// Why it cannot be entered there, in words.
    pub(super) fn try_to(&mut self, target: &BlockTarget, text: Option<&ProgramHead>) -> Result<Arrived, String> {
        let wanted = target.pass;
        let (mut scout, mut way) = (self.begin_trial(text), Way::default());
        let (passes, ending) = self.follow(&mut scout, target, None, &mut way);
        if let (0, Some(why)) = (passes, ending) {
            return Err(why);
        }
        let pass = match (passes, wanted) {
            (0, _) => return Err(format!("the program does not come to {}", target.at)),
            (1, None) => 1,
            (passes, None) => {
                return Err(format!("{} is executed {passes} times: say which, pass 1 to pass {passes}", target.at));
            }
            (passes, Some(pass)) if pass > passes => {
                let times = if passes == 1 { "once".to_owned() } else { format!("{passes} times") };
                return Err(format!("{} is executed {times}, not {pass} times", target.at));
            }
            (_, Some(pass)) => pass,
        };
        let (mut trial, mut way) = (self.begin_trial(text), Way::default());
        self.follow(&mut trial, target, Some(pass), &mut way);
        way.asked = trial.asked.take().unwrap_or_default();
        let interpreter = trial.interpreter();
        let place = interpreter.executing().map(|command| command.place).unwrap_or_default();
        let groups = interpreter.state_before().groups;
        Ok(Arrived { trial, way, place, pass: [pass, passes], groups })
    }

    /// Lets a trial run to this execution of the block, or to its end: how many there were, and why no more came.
    fn follow(
        &mut self,
        trial: &mut Session<Lent>,
        target: &BlockTarget,
        pass: Option<u32>,
        way: &mut Way,
    ) -> (u32, Option<String>) {
        let mut passes = 0;
        let (tool_axis, axes) = (self.tool_axis(), self.configuration.machine.travel().axes);
        let mut was = (trial.interpreter().executing_state().transform, Side::default());
        way.highest = f64::NEG_INFINITY;
        for _ in 0..MOST_BLOCKS {
            let begins = match target.at {
                At::Line(line) => trial.line_begins().filter(|place| place.line == line),
                At::Sequence(number) => trial.block_begins().filter(|place| place.sequence == number),
            };
            if begins.is_some_and(|place| trial.is_in(&place, target.program.as_deref())) {
                passes += 1;
                if pass == Some(passes) {
                    return (passes, None);
                }
            }
            if let Some(z) = tool_axis {
                way.highest = way.highest.max(trial.machine.position()[z]);
            }
            if let Some(command) = trial.interpreter().executing() {
                // What is turned, mirrored or compensated from where the tool stands depends on that place.
                let shaping = (command.after.transform, command.side());
                if shaping != was {
                    way.counted_from = way.counted_from.or(axes.without(way.placed));
                    was = shaping;
                }
                // A cycle comes back to where the tool stood before it.
                let comes_back = tool_axis.filter(|_| command.levels().is_some()).map_or(AxisSet::NONE, AxisSet::only);
                way.placed = way.placed.or(command.absolute.without(comes_back)).or(command.returned);
            }
            match trial.next() {
                Step::Event(event) => way.take(&event),
                Step::Stopped => trial.start(),
                Step::Failed(_) if trial.library.answer(&mut self.library) => trial.ended = false,
                Step::Failed(error) => return (passes, Some(error.0)),
                Step::Idle => return (passes, trial.alarm().map(|alarm| self.alarm_on_the_way(alarm))),
            }
        }
        (passes, Some(format!("the program is too long to be tried out to {}", target.at)))
    }

    fn alarm_on_the_way(&self, alarm: &base::Alarm) -> String {
        let name = self.configuration.control.alarm_name(alarm).name;
        format!("the program raises {name} on the way, in line {}", alarm.place.line)
    }

    /// True if the block stands in the program of this name; without one, in the main program.
    fn is_in(&self, place: &Place, program: Option<&str>) -> bool {
        let interpreter = self.interpreter();
        match program {
            Some(name) => interpreter.program_name(place.program).eq_ignore_ascii_case(name),
            None => interpreter.main_program().is_some_and(|(main, _)| main == place.program),
        }
    }

    /// A session that stands where this one stands and begins the selected program at its head, or this one.
    fn begin_trial(&self, text: Option<&ProgramHead>) -> Session<Lent> {
        let mut trial = self.begin_rehearsal();
        (trial.met, trial.reader) = (None, None);
        trial.asked = Some(Asked::default());
        (trial.pulled, trial.between_blocks) = (false, true);
        trial.codes.clear();
        trial.closing = None;
        trial.codes_out = false;
        // Nobody presses CYCLE START, and the machine answers.
        trial.switches.single_block = false;
        trial.switched = true;
        (trial.repeats_main, trial.rounds) = (false, 0);
        trial.machine.set_fin_fault(Fin::Right);
        trial.machine.tell_signals(false);
        trial.interpreter_mut().tell_variables(true);
        let now = trial.time();
        trial.machine.set_spindle_weak(false, now, &mut trial.events);
        // What was moved without being counted is counted anew: the place is one on the machine.
        let axes = self.configuration.machine.travel().axes;
        trial.lock.settle(axes);
        trial.settle_counters();
        let position = trial.counted_position();
        trial.interpreter_mut().moved_by_hand(&position, AxisSet::NONE);
        trial.events.clear();
        trial.handed_out = 0;
        if let Some((source, name, head)) = text {
            trial.interpreter_mut().forget_texts();
            trial.select(*source, name, *head);
        }
        trial.start_over();
        trial
    }
}
