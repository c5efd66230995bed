//! A program in execution: the stages chained, their questions answered, their events handed out one by one.

use std::collections::VecDeque;

use base::{Alarm, AxisSet, Place, Point, Seconds};
use dialect::MMeaning;
use machine::{Event, EventKind, Machine, ResetCause, StopCause, VirtualMachine};
use meaning::{Answer, BarrierKind, Close, EndKind, Interpreter, Pull, Quantity, StopKind};
use motion::{Motion, Timed};
use path::{Path, Shape, Shaped};

use crate::configuration::{Configuration, Inputs};
use crate::library::{Library, LibraryError};
use crate::switches::SessionSwitches;

/// What follows an alarm.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum AfterAlarm {
    /// The control stands until RESET.
    #[default]
    Stand,
    /// It goes on, to find later ones: only for checking.
    GoOn,
}

/// What a session has next.
#[derive(Clone, PartialEq, Debug)]
pub enum Step {
    /// Something happened.
    Event(Event),
    /// The control waits for CYCLE START.
    Stopped,
    /// Nothing more happens: the program has ended, or an alarm stands.
    Idle,
    /// A text could not be read.
    Failed(LibraryError),
}

/// A session: one control with its machine and memory.
pub struct Session<L> {
    motion: Motion,
    machine: VirtualMachine,
    library: L,
    configuration: Configuration,
    /// The switches, as the operator has set them.
    switches: SessionSwitches,
    inputs: Inputs,
    after_alarm: AfterAlarm,
    repeats_main: bool,
    events: VecDeque<Event>,
    /// Codes that begin a block, held until it is sure that the block is not refused.
    codes: Vec<Shaped>,
    bytes: Vec<u8>,
    /// The next shape has been pulled and not yet executed.
    held: bool,
    /// The block at whose beginning the operator asked to be told.
    told: Option<u64>,
    /// The block of which something has been executed last.
    begun: Option<u64>,
    stopped: bool,
    alarm: Option<Alarm>,
    ended: bool,
    rewound: bool,
    failed: Option<LibraryError>,
    unknown: AxisSet,
}

impl<L: Library> Session<L> {
    /// A control at power-on.
    pub fn new(configuration: Configuration, library: L) -> Session<L> {
        let Configuration {
            control,
            fitting,
            machine,
            memory,
            base_origin,
            start,
            not_returned,
            contact,
            switches,
            inputs,
        } = configuration.clone();
        let mut interpreter = Interpreter::new(control, fitting.clone(), machine.facts(), memory, &start, base_origin);
        interpreter.lose_reference_points(not_returned);
        let mut virtual_machine = VirtualMachine::new(&machine, start, fitting.policies.stroke_check);
        virtual_machine.set_contact(contact);
        virtual_machine.set_skip(inputs.skip);
        let motion = Motion::new(Path::new(interpreter, start), machine.limits());
        let mut session = Session {
            motion,
            machine: virtual_machine,
            library,
            configuration,
            switches,
            inputs,
            after_alarm: AfterAlarm::Stand,
            repeats_main: false,
            events: VecDeque::with_capacity(32),
            codes: Vec::with_capacity(16),
            bytes: Vec::new(),
            held: false,
            told: None,
            begun: None,
            stopped: false,
            alarm: None,
            ended: true,
            rewound: true,
            failed: None,
            unknown: AxisSet::NONE,
        };
        session.pass_switches();
        session
    }

    /// What follows an alarm.
    pub fn set_after_alarm(&mut self, after: AfterAlarm) {
        self.after_alarm = after;
        if after == AfterAlarm::GoOn {
            self.interpreter_mut().go_on_after_alarms();
        }
    }

    /// M99 in the main program runs it again (as the control does) or ends it.
    pub fn set_repeats_main(&mut self, repeats: bool) {
        self.repeats_main = repeats;
    }

    /// The interpreter, to look at.
    pub fn interpreter(&self) -> &Interpreter {
        &self.motion.upstream.upstream
    }

    /// The interpreter.
    pub fn interpreter_mut(&mut self) -> &mut Interpreter {
        &mut self.motion.upstream.upstream
    }

    /// The texts.
    pub fn library_mut(&mut self) -> &mut L {
        &mut self.library
    }

    /// The texts.
    pub fn library(&self) -> &L {
        &self.library
    }

    /// What the session started from.
    pub fn configuration(&self) -> &Configuration {
        &self.configuration
    }

    /// Where the axes are, mm and degrees in machine coordinates.
    pub fn position(&self) -> &Point {
        self.machine.position()
    }

    /// Virtual time since power-on.
    pub fn time(&self) -> Seconds {
        self.machine.time()
    }

    /// The alarm that stands.
    pub fn alarm(&self) -> Option<&Alarm> {
        self.alarm.as_ref()
    }

    /// True if a program is being executed, stopped or not.
    pub fn is_running(&self) -> bool {
        !self.ended && self.alarm.is_none()
    }

    /// True if it waits for CYCLE START.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// Chooses the program to run, which begins at `head` in its text.
    pub fn select(&mut self, source: base::SourceId, name: &str, head: syntax::Cursor) {
        let (position, refused) = (*self.machine.position(), self.alarm.is_some());
        // What was read ahead of an alarm or of a program broken off was never executed.
        self.interpreter_mut().restore(&position, refused);
        self.interpreter_mut().select_at(source, name, head);
        self.held = false;
        self.told = None;
        self.rewound = true;
        self.ended = true;
    }

    /// CYCLE START: begins the selected program, or goes on after a stop.
    pub fn start(&mut self) {
        if self.ended {
            let rewound = self.rewound;
            let interpreter = self.interpreter_mut();
            if rewound {
                interpreter.rewind();
            } else {
                interpreter.go_on_after_end();
            }
        }
        self.ended = false;
        self.rewound = false;
        self.stopped = false;
    }

    /// The program from its head once more, everything else as it stands.
    pub fn start_over(&mut self) {
        self.rewound = true;
        self.ended = true;
        self.start();
    }

    /// Turns a switch.
    ///
    /// # Errors
    /// Why not, in words.
    pub fn set_switch(&mut self, name: &str, number: Option<u8>, on: bool) -> Result<(), String> {
        self.switches.set(name, number, on)?;
        self.pass_switches();
        Ok(())
    }

    /// Holds an input by hand.
    ///
    /// # Errors
    /// Why not, in words.
    pub fn set_input(&mut self, name: &str, on: bool) -> Result<(), String> {
        let interrupt = self.inputs.interrupt;
        self.inputs.set(name, on).map_err(|error| error.0)?;
        if self.inputs.interrupt && !interrupt {
            self.interrupt();
        }
        self.machine.set_skip(self.inputs.skip);
        Ok(())
    }

    fn pass_switches(&mut self) {
        let SessionSwitches { optional_stop, block_delete, .. } = self.switches;
        let switches = self.interpreter_mut().switches_mut();
        switches.optional_stop = optional_stop;
        switches.block_delete = block_delete;
    }

    /// The interrupt input has turned on: if the program allows it, the rest of the block that runs is dropped and the
    /// program goes on elsewhere.
    fn interrupt(&mut self) {
        if !self.is_running() || self.stopped {
            return;
        }
        let (position, place) = (*self.machine.position(), self.place());
        let begun = !self.held || self.begun == Some(self.motion.upstream.current().block);
        if !self.interpreter_mut().interrupt(&position, begun) {
            return;
        }
        self.codes.clear();
        self.motion.upstream.stand_at(&position);
        self.held = false;
        self.told = None;
        if begun {
            let events = &mut self.events;
            self.machine.finish_block(&place, &mut |event| events.push_back(event));
        }
    }

    /// RESET: whatever runs is dropped, an alarm is cleared, the reset table is applied.
    pub fn reset(&mut self, cause: ResetCause) {
        let position = *self.machine.position();
        let place = self.place();
        self.machine.drop_codes();
        self.codes.clear();
        self.motion.upstream.stand_at(&position);
        let refused = self.alarm.is_some();
        self.interpreter_mut().reset(&position, refused);
        self.held = false;
        self.told = None;
        self.alarm = None;
        self.stopped = false;
        self.ended = true;
        let groups = self.interpreter().read_state().groups;
        self.tell(place, EventKind::Reset { cause, groups });
    }

    /// The block being executed.
    pub fn place(&self) -> Place {
        self.interpreter().executing().map_or_else(Place::default, |command| command.place)
    }

    fn tell(&mut self, place: Place, kind: EventKind) {
        let time = self.machine.time();
        self.events.push_back(Event { time, place, kind });
    }

    /// The next thing that happens.
    #[expect(clippy::should_implement_trait, reason = "it never ends for good: an operator can start again")]
    pub fn next(&mut self) -> Step {
        loop {
            if let Some(event) = self.events.pop_front() {
                return Step::Event(event);
            }
            if let Some(error) = self.failed.take() {
                self.ended = true;
                return Step::Failed(error);
            }
            if self.stopped {
                return Step::Stopped;
            }
            if self.ended || self.alarm.is_some() {
                return Step::Idle;
            }
            if self.pull() {
                self.held = false;
                self.execute();
            }
        }
    }

    /// The place of a block of which nothing has been executed yet, told once for each; `None` if something else
    /// comes first.
    pub fn block_begins(&mut self) -> Option<Place> {
        if !self.events.is_empty() || self.stopped || self.ended || self.alarm.is_some() || !self.pull() {
            return None;
        }
        self.held = true;
        let shaped = self.motion.upstream.current();
        if self.told == Some(shaped.block) {
            return None;
        }
        self.told = Some(shaped.block);
        Some(shaped.place)
    }

    /// Pulls the next shape; false if a question had to be answered, a stop was met or there is no more.
    fn pull(&mut self) -> bool {
        if self.held {
            return true;
        }
        loop {
            let barrier = match self.motion.next() {
                Pull::Item(()) => return true,
                Pull::End => {
                    self.ended = true;
                    return false;
                }
                Pull::Barrier(barrier) => barrier,
            };
            let answered = match barrier.kind {
                BarrierKind::NeedBytes { source, offset, len } => {
                    match self.library.read(source, offset, len, &mut self.bytes) {
                        Ok(last) => self.motion.resume(barrier.id, Answer::Bytes(&self.bytes, last)),
                        Err(error) => {
                            self.failed = Some(error);
                            return false;
                        }
                    }
                }
                BarrierKind::NeedProgram { number } => match self.library.find_program(number) {
                    Ok(Some(source)) => self.motion.resume(barrier.id, Answer::Program(source)),
                    Ok(None) => self.motion.resume(barrier.id, Answer::NotFound),
                    Err(error) => {
                        self.failed = Some(error);
                        return false;
                    }
                },
                BarrierKind::NeedValue(quantity) => {
                    let value = self.value_of(quantity);
                    self.motion.resume(barrier.id, Answer::Value(value))
                }
                // The stop was told when its block closed; here CYCLE START has been pressed.
                BarrierKind::CycleStart => self.motion.resume(barrier.id, Answer::Continue),
                BarrierKind::SkipPosition => {
                    let answer = Answer::Stands(*self.machine.position(), self.machine.was_skipped());
                    self.motion.resume(barrier.id, answer)
                }
                BarrierKind::RunAgain => {
                    let answer = if self.repeats_main { Answer::Continue } else { Answer::Stop };
                    self.motion.resume(barrier.id, answer)
                }
            };
            debug_assert!(answered.is_ok(), "a barrier is answered in the moment it is met");
        }
    }

    /// What a macro reads of the machine.
    fn value_of(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Inputs => f64::from(self.inputs.interface),
            Quantity::Clock => self.machine.time().0,
            Quantity::Position(axis) => self.machine.position().get(usize::from(axis)).copied().unwrap_or(0.0),
            // The virtual machine follows its command exactly.
            Quantity::Deviation(_) => 0.0,
        }
    }

    fn execute(&mut self) {
        self.begun = Some(self.motion.upstream.current().block);
        let shaped = self.motion.upstream.current();
        let (place, stop_point) = (shaped.place, shaped.stop_point);
        let stop = if let Shape::Await(stop) = shaped.shape { stop } else { None };
        match shaped.shape {
            Shape::Alarm(alarm) => return self.raise(alarm),
            Shape::Close(close) => {
                self.send_codes();
                return self.close(close, place);
            }
            Shape::Code(code) if !code.after_motion => return self.codes.push(*shaped),
            _ => {}
        }
        if self.after_alarm == AfterAlarm::GoOn {
            self.pass_unknown();
        }
        if !self.codes.is_empty() {
            if let Err(refusal) = self.machine.check(&self.motion.current()) {
                return self.raise(self.at_the_word(refusal.alarm));
            }
            self.send_codes();
        }
        let events = &mut self.events;
        match self.machine.execute(&self.motion.current(), &mut |event| events.push_back(event)) {
            Ok(()) if stop_point && self.switches.single_block && !self.ignores_single_block() => {
                self.stop(place, StopKind::SingleBlock)
            }
            Ok(()) => {}
            Err(refusal) => self.raise(self.at_the_word(refusal.alarm)),
        }
        if let Some(kind) = stop {
            self.stop(place, kind);
        }
    }

    /// Sends the codes that begin the block.
    fn send_codes(&mut self) {
        let events = &mut self.events;
        for shaped in self.codes.drain(..) {
            let timed = Timed { shaped: &shaped, duration: Seconds(0.0), length: 0.0, feed: 0.0 };
            // A code is no move, so the machine has nothing to refuse.
            let _ = self.machine.execute(&timed, &mut |event| events.push_back(event));
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

    fn raise(&mut self, alarm: Alarm) {
        self.codes.clear();
        self.tell(alarm.place, EventKind::Alarm(alarm));
        match self.after_alarm {
            AfterAlarm::Stand => self.alarm = Some(alarm),
            AfterAlarm::GoOn => {
                if let Some(axis) = alarm.axis {
                    let axes = AxisSet::only(usize::from(axis));
                    self.unknown = self.unknown.or(axes);
                    self.interpreter_mut().forget_axes(axes);
                }
            }
        }
    }

    fn stop(&mut self, place: Place, kind: StopKind) {
        self.stopped = true;
        self.tell(place, EventKind::Stop(StopCause::Program(kind)));
    }

    fn close(&mut self, close: Close, place: Place) {
        let events = &mut self.events;
        self.machine.finish_block(&place, &mut |event| events.push_back(event));
        match close {
            Close::Stop(kind) => self.stop(place, kind),
            Close::End(kind) => self.end(kind, place),
            // The start of the program and the end of its text are no blocks.
            Close::Next if self.switches.single_block && place.line > 0 && !self.ignores_single_block() => {
                self.stop(place, StopKind::SingleBlock)
            }
            Close::Next => {}
        }
    }

    /// #3003 bit 0: the program keeps the single-block switch from acting.
    fn ignores_single_block(&self) -> bool {
        self.interpreter().executing().is_some_and(|command| command.after.block_control & 1 != 0)
    }

    fn end(&mut self, kind: EndKind, place: Place) {
        let reset = self.input(kind, self.inputs.eop, &self.configuration.machine.wiring.eop);
        let rewind = kind == EndKind::M99 || self.input(kind, self.inputs.rwd, &self.configuration.machine.wiring.rwd);
        let groups = self.interpreter().executing_state().groups;
        let to = *self.machine.position();
        self.tell(place, EventKind::End { kind, rewind, reset, groups, to });
        self.ended = true;
        self.rewound = rewind;
        if reset {
            self.reset(ResetCause::ProgramEnd);
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
