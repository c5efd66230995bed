//! The builder's logic on the virtual machine: its edges are told, its answers reach the handshake.

use base::{Place, Seconds};
use meaning::{CodeLine, CodeOut};

use super::VirtualMachine;
use crate::event::{Event, EventKind};
use crate::logic::{Logic, LogicFate, LogicTrouble, LogicWait, pack, spindle_says};
use crate::signals::Signal;

/// A code that the builder's logic cannot bring to its end.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LogicAlarm {
    /// When it gives up.
    pub at: f64,
    /// The code and its block, if that is still out.
    pub code: CodeOut,
    /// Where that stands.
    pub place: Option<Place>,
    /// What it waited for, as an alarm carries it; `None` if the code names no position of what is to turn.
    pub wait: Option<f64>,
}

impl VirtualMachine {
    /// The builder's lines and how they stand.
    pub fn logic_lines(&self) -> impl Iterator<Item = (&str, bool)> {
        self.logic.iter().flat_map(|logic| logic.lines())
    }

    /// Something is done with the logic; edges are told, and codes that are done by it are.
    fn at_logic(&mut self, now: f64, told: &mut Vec<Event>, act: impl FnOnce(&mut Logic, &mut dyn FnMut(u8, bool))) {
        let place = self.place_out();
        let says = self.spindle_says();
        let Some(logic) = &mut self.logic else { return };
        let tells = self.tells_signals;
        let mut tell = |line, on| {
            if tells {
                let kind = EventKind::Signal(Signal::Line(line), on);
                told.push(Event { time: Seconds(now), place, kind });
            }
        };
        act(logic, &mut tell);
        logic.advance(now, says, &mut tell);
        while let Some(index) = logic.take_finished() {
            // What a code about tools has brought about is known when it is done.
            if let Some((code, _, _)) = self.handshake.out(index) {
                self.magazine.take(code);
            }
            self.handshake.end(index, now);
        }
    }

    pub(super) fn spindle_says(&self) -> [bool; 3] {
        let spindle = &self.spindle;
        spindle_says(spindle.is_turning(), spindle.orients(), spindle.has_arrived())
    }

    /// The logic goes on to now.
    pub(super) fn advance_logic(&mut self, now: f64, told: &mut Vec<Event>) {
        self.at_logic(now, told, |_, _| {});
    }

    /// The strobe of a code has come: true if the logic does what it asks for.
    pub(super) fn begin_logic(&mut self, index: usize, code: CodeOut, now: f64, told: &mut Vec<Event>) -> bool {
        let Some(sequence) = self.logic.as_ref().and_then(|logic| logic.table().sequence_of(code)) else {
            // What the spindle does may be waited for by another code's steps.
            if matches!(code.line, CodeLine::M | CodeLine::S) {
                self.advance_logic(now, told);
            }
            return false;
        };
        self.at_logic(now, told, |logic, _| logic.begin(sequence, code, index));
        true
    }

    /// Whether the logic does what a code asks for.
    pub(super) fn is_led(&self, code: CodeOut) -> bool {
        self.logic.as_ref().is_some_and(|logic| logic.table().sequence_of(code).is_some())
    }

    /// No code is out any more.
    pub(super) fn detach_logic(&mut self) {
        if let Some(logic) = &mut self.logic {
            logic.detach();
        }
    }

    /// A script holds an input of the builder's.
    pub fn hold_line(&mut self, line: u8, on: bool, now: Seconds, told: &mut Vec<Event>) {
        self.pass_signals(now, told);
        self.at_logic(now.0, told, |logic, tell| logic.hold(line, on, now.0, tell));
        self.pass_signals(now, told);
    }

    /// An input of the builder's stays as it is, until RESET.
    pub fn stick_line(&mut self, line: u8) {
        if let Some(logic) = &mut self.logic {
            logic.stick(line);
        }
    }

    /// RESET: stuck inputs follow the machine again.
    pub fn mend_logic(&mut self, now: Seconds, told: &mut Vec<Event>) {
        self.at_logic(now.0, told, |logic, tell| logic.mend(now.0, tell));
    }

    /// Steps and outputs at RESET, emergency stop and when the power goes or comes.
    pub fn end_logic(&mut self, fate: LogicFate, now: Seconds, told: &mut Vec<Event>) {
        self.pass_signals(now, told);
        self.at_logic(now.0, told, |logic, tell| logic.end(fate, now.0, tell));
    }

    /// The sequence that has given up is dropped.
    pub fn drop_late_logic(&mut self, now: Seconds, told: &mut Vec<Event>) {
        self.at_logic(now.0, told, |logic, tell| logic.drop_late(now.0, tell));
    }

    /// When the logic gives up, and on what.
    pub fn logic_gives_up(&self) -> Option<LogicAlarm> {
        let logic = self.logic.as_ref()?;
        let (at, code, trouble) = logic.gives_up()?;
        let place = logic.answers(code).and_then(|index| self.handshake.out(index)).map(|(_, _, place)| place);
        let wait = match trouble {
            LogicTrouble::TimeOut(wait) => Some(pack(&wait)),
            LogicTrouble::NoPosition => None,
        };
        Some(LogicAlarm { at, code, place, wait })
    }

    /// As [`LogicAlarm::wait`], of a code whose steps wait now.
    pub fn logic_late(&self, code: CodeOut) -> Option<f64> {
        self.logic_waiting(code).map(|wait| pack(&wait))
    }

    /// What the steps of a code wait for.
    pub fn logic_waiting(&self, code: CodeOut) -> Option<LogicWait> {
        self.logic.as_ref()?.waiting(code)
    }
}
