//! Codes and the lines they go out on, as time passes.

use base::{Place, Point, Seconds};
use meaning::{CodeLine, CodeOut};

use super::VirtualMachine;
use crate::event::{Event, EventKind};
use crate::interface::DecodedLine;
use crate::signals::{Fin, LimitSwitch, Magazine, Moment, Signal, Spindle, Trouble, Waiting, bits};

/// How a wait stands.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Wait {
    /// It is over.
    Over,
    /// The time given was too short.
    Still,
    /// The control gives up: why, and what it waited for.
    GivenUp(Trouble, Waiting),
}

/// What happens next.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Next {
    /// The spindle has arrived.
    Spindle,
    /// The builder's logic goes on.
    Logic,
    /// Something on the lines of codes.
    Codes(Moment),
}

/// So many things can happen on the lines without time passing before a wait is given up as endless.
const MOST_AT_ONCE: usize = 1000;

impl VirtualMachine {
    /// Every edge of a line is an event too.
    pub fn tell_signals(&mut self, tells: bool) {
        self.tells_signals = tells;
    }

    /// M codes with a line of their own, and the inputs that the builder drives by it.
    pub fn wire(&mut self, decoded: Vec<DecodedLine>) {
        self.decoded = decoded;
    }

    /// What the machine does with FIN.
    pub fn set_fin_fault(&mut self, fault: Fin) {
        self.handshake.set_fault(fault);
    }

    /// The spindle.
    pub fn spindle(&self) -> &Spindle {
        &self.spindle
    }

    /// The tool magazine.
    pub fn magazine(&self) -> &Magazine {
        &self.magazine
    }

    /// The spindle does not get to its speed, or does again.
    pub fn set_spindle_weak(&mut self, weak: bool, now: Seconds, told: &mut Vec<Event>) {
        let falls = weak && self.spindle.is_turning() && self.spindle.has_arrived();
        self.spindle.set_weak(weak, now.0);
        if falls {
            self.edge(Signal::SpeedReached, false, now.0, &Place::default(), told);
        }
    }

    /// The spindle's drive is off.
    pub fn stop_spindle(&mut self, now: Seconds, told: &mut Vec<Event>) {
        if !self.spindle.is_turning() {
            return;
        }
        if self.spindle.has_arrived() {
            self.edge(Signal::SpeedReached, false, now.0, &Place::default(), told);
        }
        self.spindle.stop(now.0);
    }

    /// Another overtravel switch.
    pub fn add_switch(&mut self, switch: LimitSwitch) {
        self.switches.push(switch);
    }

    /// The overtravel switches.
    pub fn switches(&self) -> &[LimitSwitch] {
        &self.switches
    }

    /// The axes are here and move so: the edges of overtravel switches are told; the one onto which an axis runs.
    pub fn look_at_switches(
        &mut self,
        position: &Point,
        velocity: &Point,
        now: Seconds,
        told: &mut Vec<Event>,
    ) -> Option<LimitSwitch> {
        let mut onto = None;
        for index in 0..self.switches.len() {
            let Some(switch) = self.switches.get_mut(index) else { break };
            let (on, speed) = (switch.is_on(position), velocity[switch.axis]);
            let edge = std::mem::replace(&mut switch.on, on) != on;
            let switch = *switch;
            // Two switches may share a line.
            let on_line = self.switches.iter().filter(|other| other.on && other.signal() == switch.signal()).count();
            if edge && on_line == usize::from(on) {
                self.edge(switch.signal(), on, now.0, &Place::default(), told);
            }
            if on && if switch.positive { speed > 0.0 } else { speed < 0.0 } {
                onto = onto.or(Some(switch));
            }
        }
        onto
    }

    /// Overtravel switches behind the first so many are gone.
    pub fn keep_switches(&mut self, count: usize, now: Seconds, told: &mut Vec<Event>) {
        while self.switches.len() > count {
            let Some(gone) = self.switches.pop() else { break };
            if gone.on && !self.switches.iter().any(|other| other.on && other.signal() == gone.signal()) {
                self.edge(gone.signal(), false, now.0, &Place::default(), told);
            }
        }
    }

    /// An edge of an input that the operator's script gives.
    pub fn tell_input(&mut self, signal: Signal, on: bool, now: Seconds, told: &mut Vec<Event>) {
        self.edge(signal, on, now.0, &Place::default(), told);
    }

    /// The script gives FIN.
    pub fn set_fin(&mut self, on: bool, now: Seconds, told: &mut Vec<Event>) {
        self.pass_signals(now, told);
        if !self.handshake.set_fin(on, now) {
            return;
        }
        self.edge(Signal::Fin, on, now.0, &Place::default(), told);
        while let Some(index) = self.handshake.answered_by_hand() {
            self.happen(now.0, Moment::Done(index), told);
        }
        if self.handshake.is_cleared_by_hand() {
            self.happen(now.0, Moment::Clear, told);
        }
        self.pass_signals(now, told);
    }

    fn edge(&self, signal: Signal, on: bool, at: f64, place: &Place, told: &mut Vec<Event>) {
        if self.tells_signals {
            told.push(Event { time: Seconds(at), place: *place, kind: EventKind::Signal(signal, on) });
        }
    }

    /// The lines of a code turn on or off.
    fn code_lines(&self, (code, nth): (CodeOut, u8), on: bool, at: f64, place: &Place, told: &mut Vec<Event>) {
        if self.tells_signals {
            for (decade, weight) in bits(code.code, code.digits) {
                self.edge(Signal::Bit(code.line, nth, decade, weight), on, at, place, told);
            }
        }
    }

    /// The line of its own of a code, and the inputs that it drives.
    fn decoded_lines(&self, code: CodeOut, on: bool, at: f64, place: &Place, told: &mut Vec<Event>) {
        let row = self.decoded.iter().find(|row| code.line == CodeLine::M && row.code == code.code);
        let Some(row) = row.filter(|_| self.tells_signals) else { return };
        self.edge(Signal::Decoded(row.code), on, at, place, told);
        for (signal, drives) in [(Signal::Eop, row.eop), (Signal::Rwd, row.rwd)] {
            if drives {
                self.edge(signal, on, at, place, told);
            }
        }
    }

    /// A code goes out.
    pub(super) fn send(&mut self, code: CodeOut, place: &Place, told: &mut Vec<Event>) {
        if code.after_motion || self.handshake.is_taken(code.line, place) {
            self.await_codes(place, told);
        }
        self.tell(told, place, EventKind::Code(code));
        let takes = (!self.is_led(code)).then(|| self.times.of(code.line, code.code));
        let nth = self.handshake.send(code, place, self.time, takes);
        self.code_lines((code, nth), true, self.time.0, place, told);
        self.holds_motion |= code.after_motion;
        self.pass_signals(self.time, told);
    }

    /// Codes are out, and the block's motion is done.
    fn distribution_ends(&mut self, place: &Place, told: &mut Vec<Event>) {
        if self.handshake.is_busy() && !self.den && !self.handshake.is_ending() {
            self.den = true;
            self.edge(Signal::Den, true, self.time.0, place, told);
        }
    }

    /// What happens on the lines until then is told.
    #[inline]
    pub fn pass_signals(&mut self, until: Seconds, told: &mut Vec<Event>) {
        while let Some((at, moment)) = self.next_moment().filter(|(at, _)| *at <= until.0) {
            self.pass_moment(at, moment, told);
        }
        self.signals_until = self.signals_until.max(until.0);
    }

    /// Time passes, and what happens on the lines is told.
    pub(super) fn pass_until(&mut self, until: Seconds, told: &mut Vec<Event>) {
        self.pass_signals(until, told);
        self.time = until;
    }

    /// Time passes in which nothing moves.
    pub fn stand_until(&mut self, time: Seconds, told: &mut Vec<Event>) {
        self.pass_until(Seconds(self.time.0.max(time.0)), told);
    }

    /// The next thing on the lines, of the spindle or in the builder's logic; of several at once in the order in which
    /// one brings about another.
    #[inline]
    fn next_moment(&self) -> Option<(f64, Next)> {
        let spindle = self.spindle.next().map(|at| (at, Next::Spindle));
        let logic = self.logic.as_ref().and_then(|logic| Some((logic.next()?, Next::Logic)));
        let codes = if self.handshake.is_busy() { self.handshake.next() } else { None };
        let codes = codes.map(|(at, moment)| (at, Next::Codes(moment)));
        let sooner = |first: Option<(f64, Next)>, then: Option<(f64, Next)>| match (first, then) {
            (Some(first), Some(then)) if then.0 < first.0 => Some(then),
            (first, then) => first.or(then),
        };
        sooner(sooner(spindle, logic), codes)
    }

    fn pass_moment(&mut self, at: f64, moment: Next, told: &mut Vec<Event>) {
        // What has become possible since, and was due before, happens now.
        let at = at.max(self.signals_until).max(self.time.0);
        self.signals_until = at;
        match moment {
            Next::Codes(moment) => self.happen(at, moment, told),
            Next::Logic => self.advance_logic(at, told),
            Next::Spindle => {
                self.spindle.pass();
                let signal = match (self.spindle.is_turning(), self.spindle.orients()) {
                    (true, _) => Signal::SpeedReached,
                    (_, true) => Signal::Oriented,
                    _ => Signal::SpindleStands,
                };
                self.edge(signal, true, at, &Place::default(), told);
                self.advance_logic(at, told);
            }
        }
    }

    /// Something happens on the lines of codes.
    fn happen(&mut self, at: f64, moment: Moment, told: &mut Vec<Event>) {
        match moment {
            Moment::Strobe(index) => {
                if let Some((code, nth, place)) = self.handshake.out(index) {
                    self.edge(Signal::Strobe(code.line, nth), true, at, &place, told);
                    self.decoded_lines(code, true, at, &place, told);
                    self.take_spindle(code, index, at, told);
                    if self.begin_logic(index, code, at, told) {
                        self.handshake.pass(at, moment);
                        return;
                    }
                    let longer = self.magazine.take(code);
                    if longer.0 > 0.0 {
                        let takes = self.times.of(code.line, code.code) + longer;
                        self.handshake.lengthen(index, takes.0);
                    }
                }
            }
            Moment::Done(index) => {
                if let Some((code, _, place)) = self.handshake.out(index) {
                    told.push(Event { time: Seconds(at), place, kind: EventKind::Finished(code.line) });
                }
            }
            Moment::FinOn => self.edge(Signal::Fin, true, at, &self.place_out(), told),
            Moment::StrobesOff => self.strobes_off(at, told),
            Moment::Clear => self.lines_off(at, told),
        }
        if self.handshake.pass(at, moment) {
            self.holds_motion = false;
            self.detach_logic();
        }
    }

    /// The spindle obeys a code; the code is done when the spindle has, if the builder wants that.
    fn take_spindle(&mut self, code: CodeOut, index: usize, at: f64, told: &mut Vec<Event>) {
        let (turned, arrived) = (self.spindle.is_turning(), self.spindle.has_arrived());
        let oriented = self.spindle.orients();
        if self.spindle.take(code, at) {
            let was = match (turned, oriented) {
                (true, _) => Signal::SpeedReached,
                (_, true) => Signal::Oriented,
                _ => Signal::SpindleStands,
            };
            if arrived {
                self.edge(was, false, at, &self.place_out(), told);
            }
            self.handshake.lengthen(index, self.spindle.takes(at));
        }
    }

    fn strobes_off(&mut self, at: f64, told: &mut Vec<Event>) {
        let place = self.place_out();
        for (code, nth, strobe) in self.handshake.all_out() {
            if strobe {
                self.edge(Signal::Strobe(code.line, nth), false, at, &place, told);
            }
        }
        if std::mem::take(&mut self.den) {
            self.edge(Signal::Den, false, at, &place, told);
        }
    }

    /// FIN falls, and the code lines with what they drive are cleared.
    fn lines_off(&mut self, at: f64, told: &mut Vec<Event>) {
        let place = self.place_out();
        if !self.handshake.is_cleared_by_hand() && self.handshake.has_fin() {
            self.edge(Signal::Fin, false, at, &place, told);
        }
        for (code, nth, strobe) in self.handshake.all_out() {
            self.code_lines((code, nth), false, at, &place, told);
            if strobe {
                self.decoded_lines(code, false, at, &place, told);
            }
        }
    }

    /// The block whose codes are out.
    pub(super) fn place_out(&self) -> Place {
        (0..).map_while(|index| self.handshake.out(index)).next().map_or_else(Place::default, |(_, _, place)| place)
    }

    /// RESET: what was asked of the machine is dropped.
    pub fn drop_codes(&mut self, told: &mut Vec<Event>) {
        let now = self.time.0;
        if self.handshake.is_busy() {
            if self.handshake.has_strobes() {
                self.strobes_off(now, told);
            } else if std::mem::take(&mut self.den) {
                self.edge(Signal::Den, false, now, &self.place_out(), told);
            }
            for (code, nth, strobe) in self.handshake.all_out() {
                self.code_lines((code, nth), false, now, &self.place_out(), told);
                if strobe {
                    self.decoded_lines(code, false, now, &self.place_out(), told);
                }
            }
        }
        if self.handshake.drop_codes() {
            self.edge(Signal::Fin, false, now, &Place::default(), told);
        }
        self.holds_motion = false;
        self.detach_logic();
    }

    /// True if the lines of a code are still taken by one of another block.
    pub fn is_taken(&self, code: CodeOut, place: &Place) -> bool {
        self.handshake.is_taken(code.line, place)
    }

    /// True while a code is out.
    #[inline]
    pub fn awaits(&self) -> bool {
        self.handshake.is_busy()
    }

    /// True while nothing may move because codes are out.
    #[inline]
    pub fn holds_motion(&self) -> bool {
        self.holds_motion && self.handshake.is_busy()
    }

    /// What the control waits for.
    pub fn waiting(&self) -> Option<Waiting> {
        self.handshake.waiting()
    }

    /// Waits until no code is out any more, but no longer than until then.
    pub fn wait_for_codes(&mut self, limit: f64, place: &Place, told: &mut Vec<Event>) -> Wait {
        self.distribution_ends(place, told);
        for _ in 0..MOST_AT_ONCE {
            if !self.handshake.is_busy() {
                return Wait::Over;
            }
            let next = self.next_moment();
            let given_up = self.handshake.gives_up().filter(|(at, _)| next.is_none_or(|(next, _)| *at < next));
            let at = given_up.map_or(next.map_or(f64::INFINITY, |(at, _)| at), |(at, _)| at);
            if at > limit || at == f64::INFINITY {
                if limit.is_finite() {
                    self.wait_until(Seconds(limit), place, told);
                }
                return Wait::Still;
            }
            self.wait_until(Seconds(at), place, told);
            match (given_up, self.handshake.waiting(), next) {
                (Some((_, trouble)), Some(waiting), _) => return Wait::GivenUp(trouble, waiting),
                (_, _, Some((at, moment))) => self.pass_moment(at, moment, told),
                _ => return Wait::Over,
            }
            if self.logic_gives_up().is_some_and(|late| late.at <= self.time.0) {
                return Wait::Still;
            }
        }
        Wait::Still
    }

    /// Waits until every code that is out has been answered.
    pub(super) fn await_codes(&mut self, place: &Place, told: &mut Vec<Event>) {
        if self.handshake.is_busy() && self.wait_for_codes(f64::INFINITY, place, told) != Wait::Over {
            // Who wants to know why has asked before.
            self.drop_codes(told);
        }
    }

    /// Waits for what a move must wait for.
    pub fn wait_to_move(&mut self, place: &Place, told: &mut Vec<Event>) {
        if self.holds_motion {
            self.await_codes(place, told);
            self.holds_motion = false;
        }
    }

    fn wait_until(&mut self, at: Seconds, place: &Place, told: &mut Vec<Event>) {
        if at > self.time {
            let waited = at - self.time;
            self.time = at;
            self.tell(told, place, EventKind::Waited(waited));
        }
    }
}
