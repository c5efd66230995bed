//! One shape after the other: codes held until the block is sure, moves, stops, alarms, the program's end.

use base::{Alarm, AxisSet, Condition, Place, Seconds};
use dialect::{MMeaning, Occasion};
use machine::{EventKind, Machine, Refusal, ResetCause, StopCause};
use meaning::{Close, CodeLine, CodeOut, EndKind, State, StopKind};
use motion::{Pace, Timed};
use path::{Shape, Shaped};

use super::{AfterAlarm, Session};
use crate::library::Library;

impl<L: Library> Session<L> {
    pub(super) fn execute(&mut self) {
        self.begun = Some(self.motion.upstream.current().block);
        if self.between_blocks {
            self.begin_block();
        }
        let shaped = self.motion.upstream.current();
        let (place, closes) = (shaped.place, shaped.closes);
        match shaped.shape {
            Shape::Alarm(alarm) => return self.raise(alarm),
            Shape::Close(close) => {
                self.send_codes();
                return self.close(close, place);
            }
            Shape::Code(code) if self.in_force.aux_lock && !self.is_obeyed(code) => return,
            Shape::Code(code) if !code.after_motion => return self.codes.push(*shaped),
            _ => {}
        }
        if self.after_alarm == AfterAlarm::GoOn {
            self.pass_unknown();
        }
        if !self.start_codes() {
            if closes && self.alarm.is_none() {
                self.close(Close::Next, place);
            }
        } else if !self.prepare_shape() {
            self.perform_shape();
        }
    }

    /// What has been prepared is executed to its end.
    pub(super) fn perform_shape(&mut self) {
        let shaped = self.motion.upstream.current();
        let (place, stop_point, closes) = (shaped.place, shaped.stop_point, shaped.closes);
        let stop = if let Shape::Await(stop) = shaped.shape { stop } else { None };
        let (moves, since) = (shaped.shape.is_move(), self.machine.time());
        match self.execute_shape() {
            Ok(()) if stop_point && self.stops_at_blocks() => self.stop(place, StopKind::SingleBlock),
            Ok(()) => {}
            Err(refusal) => self.raise(self.at_the_word(refusal.alarm)),
        }
        if !moves {
            self.pass_since(since);
        }
        if let Some(kind) = stop {
            self.stop(place, kind);
        }
        if closes && self.alarm.is_none() {
            self.close(Close::Next, place);
        }
    }

    /// The switches that act from block to block are looked at.
    pub(super) fn begin_block(&mut self) {
        self.between_blocks = false;
        self.take_from_tape();
        self.unfound = self.newly_returned();
        self.tell_block();
        // #3004 bit 1: the program fixes the feed override at 100 %.
        let fixes = self.interpreter().executing_state().feed_control & 2 != 0;
        if self.switched || self.fixes_override != fixes {
            self.switched = false;
            self.in_force = self.switches;
            self.fixes_override = fixes;
            self.pass_locks();
            self.pass_overrides();
        }
    }

    /// The codes that begin the block go out, if its first move may begin; false if it is refused.
    pub(super) fn start_codes(&mut self) -> bool {
        if self.codes.is_empty() {
            return true;
        }
        let checked = match self.real_shape() {
            None => self.machine.check(&self.motion.current()),
            Some(shaped) => self.machine.check(&Timed { shaped: &shaped, ..self.motion.current() }),
        };
        if let Err(refusal) = checked {
            self.raise(self.at_the_word(refusal.alarm));
            return false;
        }
        self.send_codes();
        true
    }

    /// A move is planned, and begins; true if it takes its time.
    fn prepare_shape(&mut self) -> bool {
        let shape = &self.motion.upstream.current().shape;
        let (moves, measures) = (shape.is_move(), self.motion.upstream.current().until_signal);
        let dwells = matches!(shape, Shape::Dwell(_));
        match shape {
            _ if moves => {
                self.plan();
                if measures {
                    self.rest();
                }
            }
            Shape::Code(_) | Shape::Dwell(_) | Shape::Await(_) => self.rest(),
            _ => {}
        }
        let dwells = dwells && self.deadline.is_some();
        moves && self.begin_search() || self.live && (moves && self.begin_move() || dwells && self.begin_dwell())
    }

    fn execute_shape(&mut self) -> Result<(), Refusal> {
        if let Some(duration) = self.searched {
            let timed = Timed { duration, ..self.motion.current() };
            return self.machine.execute(&timed, &mut self.events);
        }
        let Some(shaped) = self.real_shape() else {
            return self.machine.execute(&self.motion.current(), &mut self.events);
        };
        // The way back to the reference point is that of the axes, any other takes the time of the counted one.
        let timed = if self.returned().is_empty() { self.motion.current() } else { self.motion.time(&shaped) };
        let length = match &shaped.shape {
            Shape::Rapid { from, to, .. } | Shape::Line { from, to, .. } if from == to => 0.0,
            _ => timed.length,
        };
        let timed = Timed { shaped: &shaped, length, ..timed };
        let before = self.counted_position();
        let executed = self.machine.execute(&timed, &mut self.events);
        if executed.is_ok() {
            self.count_move();
        }
        self.pass_displays(&before);
        executed
    }

    /// True while moves stand still because an override, or the jog speed of DRY RUN, is at zero; the codes of their block
    /// are out then.
    pub(super) fn stands_still(&mut self) -> bool {
        let runs = self.feed_percent() > 0 && self.percents.rapid > 0 && !self.switches.dry_run;
        if runs || self.after_alarm == AfterAlarm::GoOn {
            return false;
        }
        if self.between_blocks {
            self.begin_block();
        }
        self.is_still(self.motion.upstream.current()) && self.start_codes()
    }

    /// True for a move that the override switches do not let run.
    pub(super) fn is_still(&self, shaped: &Shaped) -> bool {
        let overrides = self.motion.overrides();
        match &shaped.shape {
            Shape::Line { feed, .. } | Shape::Arc { feed, .. } if overrides.at_rapid(feed) => overrides.rapid_stands(),
            Shape::Line { feed, .. } | Shape::Arc { feed, .. } => overrides.actual(feed) <= 0.0,
            // Axes that a lock has led astray may have a way where none is counted.
            Shape::Rapid { from, to, .. } => overrides.rapid_stands() && (from != to || self.lock.acts()),
            _ => false,
        }
    }

    /// Codes that go out in spite of the auxiliary lock: the M codes that the control itself knows.
    pub(super) fn is_obeyed(&self, code: CodeOut) -> bool {
        code.line == CodeLine::M && self.configuration.control.m_code(code.code).is_some()
    }

    /// Sends the codes that begin the block.
    fn send_codes(&mut self) {
        if !self.codes.is_empty() {
            self.rest();
            self.codes_out = true;
        }
        for shaped in self.codes.drain(..) {
            let timed =
                Timed { shaped: &shaped, duration: Seconds(0.0), length: 0.0, feed: 0.0, pace: Pace::default() };
            // A code is no move, so the machine has nothing to refuse.
            let _ = self.machine.execute(&timed, &mut self.events);
        }
    }

    /// Checking on: the machine learns which axes' places are unknown in the block it executes.
    fn pass_unknown(&mut self) {
        if let Some(command) = self.interpreter().executing() {
            let unknown = self.unknown.without(command.absolute);
            let axes = unknown.or(command.after.unknown.axes);
            self.unknown = unknown;
            self.machine.set_unknown(axes);
        }
    }

    /// An alarm about an axis points at the axis' word.
    fn at_the_word(&self, mut alarm: Alarm) -> Alarm {
        if let (Some(axis), Some(command)) = (alarm.axis, self.interpreter().executing()) {
            alarm.span = command.axis_span(usize::from(axis));
        }
        alarm
    }

    /// An alarm that no block of a program raises.
    pub fn raise_at_panel(&mut self, condition: Condition, values: [f64; 3]) {
        let place = Place::default();
        self.raise(Alarm::new(condition, place, place.block).with(values));
    }

    pub(super) fn raise(&mut self, alarm: Alarm) {
        self.codes.clear();
        self.tell(alarm.place, EventKind::Alarm(alarm));
        match self.after_alarm {
            AfterAlarm::Stand => {
                self.alarm = Some(alarm);
                // What was held or stopped does not go on by CYCLE START any more.
                (self.stopped, self.feed_held) = (false, false);
            }
            AfterAlarm::GoOn => {
                self.between_blocks = true;
                if let Some(axis) = alarm.axis {
                    let axes = AxisSet::only(usize::from(axis));
                    self.unknown = self.unknown.or(axes);
                    self.interpreter_mut().forget_axes(axes);
                }
            }
        }
    }

    fn stop(&mut self, place: Place, kind: StopKind) {
        self.rest();
        self.tell_nothing_read();
        self.stopped = true;
        self.tell(place, EventKind::Stop(StopCause::Program(kind)));
    }

    fn close(&mut self, close: Close, place: Place) {
        self.between_blocks = true;
        self.unfound = AxisSet::NONE;
        if std::mem::take(&mut self.codes_out) && self.waits_for_codes() {
            self.rest();
        }
        self.closing = Some((close, place));
        self.go_on_closing();
    }

    /// The block is done when its codes are.
    pub(super) fn finish(&mut self, close: Close, place: Place) {
        let waits = self.waits_for_codes();
        self.machine.finish_block(&place, waits, &mut self.events);
        match close {
            Close::Stop(kind) => self.stop(place, kind),
            Close::End(kind) => self.end(kind, place),
            // The start of the program and the end of its text are no blocks.
            Close::Next if place.line > 0 && self.stops_at_blocks() => self.stop(place, StopKind::SingleBlock),
            Close::Next => {}
        }
    }

    /// #3003 bit 1: the program does not wait for FIN.
    pub(super) fn waits_for_codes(&self) -> bool {
        self.executing_state(|state| state.block_control & 2 == 0)
    }

    /// SINGLE BLOCK is on, the program does not keep it from acting (#3003 bit 0), and the axes stand: switched on in a
    /// move, they may not be able to at its end.
    fn stops_at_blocks(&self) -> bool {
        self.switches.single_block && !self.is_moving() && self.executing_state(|state| state.block_control & 1 == 0)
    }

    /// What holds in the block being executed.
    fn executing_state(&self, holds: impl FnOnce(&State) -> bool) -> bool {
        holds(self.interpreter().executing_state())
    }

    fn end(&mut self, kind: EndKind, place: Place) {
        // Blocks typed at the panel that have run out are no program's end; M02 or M30 among them is one.
        let runs_out = kind == EndKind::Text && !self.is_typed_selected();
        let ends = matches!(kind, EndKind::M02 | EndKind::M30) || runs_out;
        let reset = ends && self.configuration.control.station.end_resets
            || self.input(kind, self.inputs.eop, &self.configuration.machine.wiring.eop);
        let rewind = kind == EndKind::M99
            || self.rewinds_at(kind)
            || self.input(kind, self.inputs.rwd, &self.configuration.machine.wiring.rwd);
        let groups = self.interpreter().executing_state().groups;
        let to = *self.machine.position();
        self.tell(place, EventKind::End { kind, rewind, reset, groups, to });
        self.ended = true;
        self.rewound = rewind;
        if reset {
            self.change_states(Occasion::ProgramEnd, ResetCause::ProgramEnd);
        }
        self.settle_displacement();
    }

    /// Whether the control itself goes back to the program's head at this end.
    fn rewinds_at(&self, kind: EndKind) -> bool {
        let station = &self.configuration.control.station;
        match (kind, station.m02_rewinds) {
            (EndKind::M30, _) => station.end_rewinds,
            (EndKind::M02, Some(parameter)) => self.interpreter().fitting().parameter(parameter) > 0.0,
            _ => false,
        }
    }

    /// Whether an input is on at the end of a program: held by hand, or driven by the end code's decoded line.
    fn input(&self, kind: EndKind, by_hand: Option<bool>, wired: &[String]) -> bool {
        let meaning = match kind {
            EndKind::M02 => MMeaning::ProgramEnd,
            EndKind::M30 => MMeaning::TapeEnd,
            EndKind::M99 | EndKind::Text | EndKind::Loop => return false,
        };
        let line = self.configuration.control.m_of(meaning).and_then(|row| row.decoded.as_ref());
        by_hand.unwrap_or_else(|| line.is_some_and(|line| wired.contains(line)))
    }
}
