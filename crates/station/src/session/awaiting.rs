//! Waiting for the machine: a block that closes, and what may not begin before codes are answered.
//!
//! While the operator works the wait takes its time, and he can step in; otherwise it passes as a whole.

use base::{Alarm, Condition, Place};
use machine::{DecodedLine, Machine, Signal, Trouble, Wait, Waiting};
use meaning::{Close, CodeOut};
use path::{Shape, Shaped};

use super::Session;
use crate::configuration::{Configuration, Inputs};
use crate::library::Library;

/// A block that has closed but for its codes.
pub(super) type Closing = Option<(Close, Place)>;

/// The M codes with a line of their own, and what the builder drives by them.
pub(super) fn decoded_lines(configuration: &Configuration, inputs: &Inputs) -> Vec<DecodedLine> {
    let wiring = &configuration.machine.wiring;
    let rows = configuration.control.m_codes.iter();
    let wired = |line: &String, wired: &[String], by_hand: Option<bool>| by_hand.is_none() && wired.contains(line);
    rows.filter_map(|row| {
        let line = row.decoded.as_ref()?;
        let (eop, rwd) = (wired(line, &wiring.eop, inputs.eop), wired(line, &wiring.rwd, inputs.rwd));
        Some(DecodedLine { code: u32::from(row.code), eop, rwd })
    })
    .collect()
}

/// What an alarm says of a code that is waited for: its letter, its number, for how long, s.
pub(super) fn values_of(code: CodeOut, seconds: f64) -> [f64; 3] {
    [f64::from(u32::from(code.line.letter())), f64::from(code.code), seconds]
}

impl<L: Library> Session<L> {
    /// Every edge of a line between control and machine is an event too.
    pub fn tell_signals(&mut self, tells: bool) {
        self.machine.tell_signals(tells);
    }

    /// The spindle's speed now, rev/min; backward is negative.
    pub fn spindle_rpm(&self) -> f64 {
        self.machine.spindle().rpm(self.time().0)
    }

    /// The tool in the spindle and the pocket at the place of change, as the machine has them; no tool is 0.
    pub fn tools(&self) -> [u32; 2] {
        let magazine = self.machine.magazine();
        [magazine.tool(), magazine.pocket()]
    }

    /// What the control waits for at the machine, if it does.
    pub fn waiting(&self) -> Option<Waiting> {
        let waits = self.closing.is_some() && self.waits_for_codes() || self.awaited;
        if waits && self.alarm.is_none() { self.machine.waiting() } else { None }
    }

    /// What the steps of the code wait for that the control waits for, in words, if the builder's logic has it.
    pub fn logic_waiting(&self, waiting: &Waiting) -> Option<String> {
        let wait = self.machine.logic_waiting(waiting.code)?;
        Some(self.configuration.machine.logic.wait_in_words(&wait))
    }

    /// The builder's lines and how they stand.
    pub fn logic_lines(&self) -> impl Iterator<Item = (&str, bool)> {
        self.machine.logic_lines()
    }

    /// Holds an input by hand.
    ///
    /// # Errors
    /// Why not, in words.
    pub fn set_input(&mut self, name: &str, on: bool) -> Result<(), String> {
        let now = self.time();
        if name == "FIN" {
            self.machine.set_fin(on, now, &mut self.events);
            return Ok(());
        }
        if let Some(line) = self.configuration.machine.logic.input(name) {
            self.machine.hold_line(line, on, now, &mut self.events);
            return Ok(());
        }
        let before = self.inputs;
        self.inputs.set(name, on).map_err(|error| error.0)?;
        self.pass_inputs(&before);
        if self.inputs.interrupt && !before.interrupt {
            self.interrupt();
        }
        self.machine.set_skip(self.inputs.skip);
        if self.inputs.skip && !before.skip {
            self.skip_move_under_way();
        }
        Ok(())
    }

    /// Edges of the inputs that the script gives.
    fn pass_inputs(&mut self, before: &Inputs) {
        let (now, inputs) = (self.time(), self.inputs);
        self.machine.pass_signals(now, &mut self.events);
        let edges = [
            (Signal::Eop, before.eop == Some(true), inputs.eop == Some(true)),
            (Signal::Rwd, before.rwd == Some(true), inputs.rwd == Some(true)),
            (Signal::Skip, before.skip, inputs.skip),
            (Signal::Interrupt, before.interrupt, inputs.interrupt),
        ];
        for (signal, was, on) in edges {
            if was != on {
                self.machine.tell_input(signal, on, now, &mut self.events);
            }
        }
        // An input held by hand is no longer driven by its wire.
        self.machine.wire(decoded_lines(&self.configuration, &inputs));
    }

    /// A block that closes goes on doing so; false if it still waits.
    pub(super) fn go_on_closing(&mut self) -> bool {
        let Some((close, place)) = self.closing else { return true };
        if !self.settle_returned(&place) {
            return false;
        }
        let since = self.machine.time();
        if self.waits_for_codes() && !self.await_machine(&place) {
            return false;
        }
        self.closing = None;
        self.pass_since(since);
        if self.alarm.is_none() {
            self.finish(close, place);
        }
        true
    }

    /// True if what comes next may not begin because codes are out.
    pub(super) fn waits_for_machine(&mut self) -> bool {
        self.awaited = false;
        if !self.machine.awaits() && self.codes.is_empty() {
            return false;
        }
        if self.machine.awaits() && self.lines_are_taken() {
            let place = self.motion.upstream.current().place;
            if !self.await_machine(&place) {
                self.awaited = true;
                return true;
            }
            if self.alarm.is_some() {
                return true;
            }
        }
        let shape = &self.motion.upstream.current().shape;
        let (asks, place) = (self.asks_for_answers(shape), self.motion.upstream.current().place);
        if !asks {
            return false;
        }
        if self.between_blocks {
            self.begin_block();
        }
        if !self.start_codes() || self.await_machine(&place) {
            return self.alarm.is_some();
        }
        self.awaited = true;
        true
    }

    /// Codes are to go out now whose lines are still taken: the program has not waited for those before.
    fn lines_are_taken(&self) -> bool {
        let gathers = matches!(self.motion.upstream.current().shape, Shape::Code(code) if !code.after_motion);
        let taken = |shaped: &Shaped| match shaped.shape {
            Shape::Code(code) => self.machine.is_taken(code, &shaped.place),
            _ => false,
        };
        !gathers && self.codes.iter().any(taken)
    }

    fn asks_for_answers(&self, shape: &Shape) -> bool {
        match shape {
            Shape::Code(code) => code.after_motion && (!self.in_force.aux_lock || self.is_obeyed(*code)),
            Shape::Await(_) => true,
            Shape::Rapid { .. } | Shape::Line { .. } | Shape::Arc { .. } | Shape::Dwell(_) => {
                self.machine.holds_motion()
            }
            _ => false,
        }
    }

    /// Waits for the machine; false if that lasts longer than the time there is. Where the control gives up, an alarm
    /// stands.
    fn await_machine(&mut self, place: &Place) -> bool {
        if !self.machine.awaits() {
            return true;
        }
        self.rest();
        let deadline = self.deadline.map_or(f64::INFINITY, |deadline| deadline.0);
        loop {
            let limit = deadline.min(self.next_trip()).max(self.machine.time().0);
            let wait = self.machine.wait_for_codes(limit, place, &mut self.events);
            let (now, trip) = (self.machine.time().0, self.next_trip());
            match wait {
                Wait::Over => return true,
                Wait::GivenUp(trouble, waiting) => {
                    self.raise(self.given_up(trouble, &waiting));
                    return true;
                }
                Wait::Still if trip <= now => return false,
                // The builder's logic has got on meanwhile, and gives up later.
                Wait::Still if limit < deadline => {}
                // Where nobody works the control, nobody gives what is waited for.
                Wait::Still if !self.attended && limit == f64::INFINITY => {
                    if let Some(waiting) = self.machine.waiting() {
                        self.raise(self.never_comes(&waiting));
                    }
                    return true;
                }
                Wait::Still => return false,
            }
        }
    }

    fn never_comes(&self, waiting: &Waiting) -> Alarm {
        match self.machine.logic_late(waiting.code) {
            Some(wait) => {
                let values = values_of(waiting.code, wait);
                Alarm::new(Condition::LogicTimeOut, waiting.place, waiting.place.block).with(values)
            }
            None if waiting.on => self.given_up(Trouble::Missing, waiting),
            None => self.given_up(Trouble::Stuck, waiting),
        }
    }

    fn given_up(&self, trouble: Trouble, waiting: &Waiting) -> Alarm {
        let condition = match trouble {
            Trouble::Missing => Condition::FinMissing,
            Trouble::Early => Condition::FinEarly,
            Trouble::Stuck => Condition::FinStuck,
        };
        let time_out = self.configuration.machine.handshake.time_out.0;
        let values = values_of(waiting.code, time_out);
        Alarm::new(condition, waiting.place, waiting.place.block).with(values)
    }
}
