//! The interpreter: the reader, the queue and the expansion as one thing that is pulled.

mod states;

use std::sync::Arc;

use base::{AXES, AxisSet, Place, Point, ProgramId, SourceId};
use dialect::{Control, Fitting, GroupCodes, M01OffOutput};

use crate::command::{Body, Command, Finish};
use crate::expand::{Expansion, Surroundings};
use crate::facts::{MachineFacts, Memory, Switches};
use crate::operation::{Act, Close, EndKind, Operation};
use crate::pull::{Answer, Barrier, BarrierKind, Pull, Quantity, StaleBarrier};
use crate::queue::Queue;
use crate::reader::{Read, Reader, empty_command};
use crate::record::{StatementRuns, WordsRead};
use crate::setting::Setting;
use crate::state::State;
use crate::supply::WINDOW;
use crate::unknown::letter_bit;
use syntax::Cursor;

/// The interpreter of one control.
///
/// [`Interpreter::select`] a program, then pull with [`Interpreter::next`]; barriers are answered with
/// [`Interpreter::resume`]. Reading runs ahead of execution by as many blocks as the control's buffer holds.
pub struct Interpreter {
    pub(crate) reader: Reader,
    queue: Queue,
    expansion: Option<Expansion>,
    /// The operation handed out last.
    operation: Operation,
    barrier: Option<Barrier>,
    barriers: u64,
    /// Bytes of an answer that came in parts.
    gathered: Vec<u8>,
    started: bool,
    /// The close that waits for the answer whether the main program runs again.
    runs_again: Option<bool>,
    waits_for_start: bool,
    /// The operation handed out ends where the skip signal comes.
    measures: bool,
    /// The state in which the selected program begins.
    start_state: State,
    /// Origin of the base work system at power-on (counts).
    base_origin: Point,
    /// The codes when settings that follow them were written last.
    stored: GroupCodes,
}

impl Interpreter {
    /// A control at power-on, its axes standing at `machine` (mm, degrees; machine coordinates), the base work
    /// system's origin at `base_origin` (counts).
    pub fn new(
        control: Arc<Control>,
        fitting: Fitting,
        facts: MachineFacts,
        memory: Memory,
        machine: &Point,
        base_origin: Point,
    ) -> Interpreter {
        let groups = fitting.power_on(&control);
        let state = State::power_on(groups, to_counts(machine), base_origin);
        let axis_letters = facts.axes.iter().fold(0, |set, axis| set | letter_bit(axis.letter));
        let code_letters = b"STM".iter().fold(0, |set, &letter| set | letter_bit(letter))
            | if facts.axis(b'B').is_none() { letter_bit(b'B') } else { 0 };
        let length_axis = facts.axis(crate::coordinate::LENGTH_AXIS);
        let setting = Setting {
            control,
            fitting,
            facts,
            memory,
            switches: Switches::default(),
            length_axis,
            axis_letters,
            code_letters,
            record: None,
        };
        Interpreter {
            reader: Reader::new(setting, state),
            queue: Queue::new(&empty_command(&state)),
            expansion: None,
            operation: Operation::default(),
            barrier: None,
            barriers: 0,
            gathered: Vec::new(),
            started: false,
            runs_again: None,
            waits_for_start: false,
            measures: false,
            start_state: state,
            base_origin,
            stored: groups,
        }
    }

    /// Chooses the program to run, from its head. `name` is its name unless an O word gives it one.
    pub fn select(&mut self, source: SourceId, name: &str) {
        self.select_at(source, name, Cursor::HEAD);
    }

    /// Chooses a program that begins at `head` in its text.
    pub fn select_at(&mut self, source: SourceId, name: &str, head: Cursor) {
        self.drop_queue();
        self.reader.select(source, name, head);
        self.started = false;
    }

    /// The main program from its head, everything else as it stands.
    pub fn rewind(&mut self) {
        self.drop_queue();
        self.reader.rewind();
        self.started = false;
    }

    /// Go on after an alarm to find later ones, with what the refused block names as unknown.
    pub fn go_on_after_alarms(&mut self) {
        self.reader.goes_on = true;
    }

    /// Jumps allowed without motion, dwell or stop before the alarm for an endless loop.
    pub fn set_loop_limit(&mut self, limit: u64) {
        self.reader.loop_limit = limit;
    }

    /// The switches; block delete acts on blocks that are read from now on.
    pub fn switches_mut(&mut self) -> &mut Switches {
        &mut self.reader.setting.switches
    }

    /// The control's memory; offsets act from the next block that calls for them.
    pub fn memory_mut(&mut self) -> &mut Memory {
        &mut self.reader.setting.memory
    }

    /// The control's memory.
    pub fn memory(&self) -> &Memory {
        &self.reader.setting.memory
    }

    /// Options, policies, parameters.
    pub fn fitting_mut(&mut self) -> &mut Fitting {
        &mut self.reader.setting.fitting
    }

    /// Options, policies, parameters.
    pub fn fitting(&self) -> &Fitting {
        &self.reader.setting.fitting
    }

    /// The control's tables.
    pub fn control(&self) -> &Arc<Control> {
        &self.reader.setting.control
    }

    /// The machine as programs see it.
    pub fn facts(&self) -> &MachineFacts {
        &self.reader.setting.facts
    }

    /// A program's name.
    pub fn program_name(&self, program: ProgramId) -> &str {
        self.reader.names.name(program)
    }

    /// The main program and its source, if one is selected.
    pub fn main_program(&self) -> Option<(ProgramId, SourceId)> {
        self.reader.main_program()
    }

    /// The value of a macro variable of the level in execution; `None` is a blank or no such variable.
    pub fn variable(&self, number: u32) -> Option<f64> {
        self.reader.variable(number)
    }

    /// Writes a macro variable by hand; `None` blanks it. False if there is none that may be written so.
    pub fn set_variable(&mut self, number: u32, value: Option<f64>) -> bool {
        self.reader.set_variable(number, value.unwrap_or(crate::user_macro::BLANK))
    }

    /// Writes to variables are told as operations, as a trace wants them.
    pub fn tell_variables(&mut self, tells: bool) {
        self.reader.tells_variables = tells;
    }

    /// What the control has read: the state after the last block read.
    pub fn read_state(&self) -> &State {
        &self.reader.state
    }

    /// What the control is executing: the block at the front of the queue.
    pub fn executing(&self) -> Option<&Command> {
        self.queue.front()
    }

    /// The block whose last operation was handed out last and the one executed before it, also where a reset at the
    /// program's end has dropped the queue.
    pub fn done(&self) -> [&Command; 2] {
        self.queue.done()
    }

    /// The state of the block being executed; what was read last if none is.
    pub fn executing_state(&self) -> &State {
        self.queue.front().map_or(&self.reader.state, |command| &command.after)
    }

    /// The state before the block being executed.
    pub fn state_before(&self) -> &State {
        self.queue.previous().map_or(&self.start_state, |command| &command.after)
    }

    /// From now on it is kept how words are read, for whoever explains the program, and what every macro statement does
    /// at this execution of it, counted from 1.
    pub fn record_words(&mut self, pass: u64) {
        self.reader.setting.record = Some(std::cell::RefCell::default());
        self.reader.records.pass = pass;
        self.reader.tells_variables = true;
    }

    /// The macro statements carried out so far, if that is recorded.
    pub fn statements_read(&self) -> impl Iterator<Item = &StatementRuns> {
        self.reader.records.statements()
    }

    /// How the words of the block being executed were read, if that is recorded.
    pub fn words_read(&self) -> Option<&WordsRead> {
        self.queue.front().and_then(|command| self.reader.words_read(command.block))
    }

    /// A later stage refused the block: checking on, these axes are unknown.
    pub fn forget_axes(&mut self, axes: AxisSet) {
        self.reader.forget_axes(axes);
    }

    /// The next operation. It stays as it is until the next call.
    #[expect(clippy::should_implement_trait, reason = "a pull has barriers, which an iterator does not")]
    pub fn next(&mut self) -> Pull<&Operation> {
        if let Some(barrier) = self.barrier {
            return Pull::Barrier(barrier);
        }
        loop {
            if self.measures {
                self.measures = false;
                return Pull::Barrier(self.ask(BarrierKind::SkipPosition));
            }
            if self.waits_for_start {
                self.waits_for_start = false;
                return Pull::Barrier(self.ask(BarrierKind::CycleStart));
            }
            match self.next_of_front() {
                Some(Front::Operation) => return Pull::Item(&self.operation),
                Some(Front::Question) => return Pull::Barrier(self.ask(BarrierKind::RunAgain)),
                None => {}
            }
            if let Some(barrier) = self.read_ahead() {
                return Pull::Barrier(barrier);
            }
            if self.tell_note() {
                return Pull::Item(&self.operation);
            }
            match self.queue.front() {
                Some(command) => self.expansion = Some(Expansion::new(command)),
                None => return Pull::End,
            }
        }
    }

    /// Makes an operation of the next write to a variable, if the blocks read before it are done.
    fn tell_note(&mut self) -> bool {
        let due = match (self.reader.notes.front(), self.queue.front()) {
            (Some(note), Some(command)) => note.before <= command.block && !matches!(command.body, Body::Start(_)),
            (Some(_), None) => self.started,
            (None, _) => false,
        };
        let Some(note) = self.reader.notes.pop_front_if(|_| due) else { return false };
        self.operation =
            Operation { block: note.before, place: note.place, act: Act::Set(note.value), ..Operation::default() };
        true
    }

    /// Makes the next operation of the block being executed; the block leaves the queue when it is done.
    fn next_of_front(&mut self) -> Option<Front> {
        let around = self.surroundings();
        let expansion = self.expansion.as_mut()?;
        let command = self.queue.front()?;
        if !expansion.next(command, &around, &mut self.operation) {
            self.expansion = None;
            self.queue.pop();
            self.reader.ahead = 0;
            return None;
        }
        self.measures = self.operation.until_signal;
        if let Act::Close(close) = self.operation.act {
            if matches!(command.finish, Finish::End(EndKind::M99 | EndKind::Loop)) {
                match self.runs_again.take() {
                    None => {
                        // The close comes again when the question is answered.
                        expansion.close_again();
                        return Some(Front::Question);
                    }
                    Some(true) => self.operation.act = Act::Close(Close::Next),
                    Some(false) => {}
                }
            }
            self.waits_for_start = matches!(close, Close::Stop(_));
            if matches!(self.operation.act, Act::Close(Close::End(_))) {
                self.reader.end();
            }
        }
        // The manual part of a cycle.
        self.waits_for_start |= matches!(self.operation.act, Act::Await(Some(_)));
        Some(Front::Operation)
    }

    fn surroundings(&self) -> Surroundings {
        let setting = &self.reader.setting;
        Surroundings {
            axes: setting.facts.axes.len(),
            optional_stop: setting.switches.optional_stop,
            sends_m01: setting.fitting.policies.m01_off_output == M01OffOutput::Code,
            spindle_codes: setting.control.cycle_codes,
            m_digits: setting.facts.codes.digits[0],
        }
    }

    /// Fills the queue to the control's depth: the block to execute and those read ahead of it.
    fn read_ahead(&mut self) -> Option<Barrier> {
        // Checking on, a block must be judged by the later stages before the next one is read.
        let [blocks, _, buffering] = self.reader.setting.control.read_ahead;
        let depth = |state: &State| if state.buffering { buffering } else { blocks } + 1;
        let goes_on = self.reader.goes_on;
        while self.queue.len() < (if goes_on { 1 } else { depth(&self.reader.state) })
            && !self.queue.back().is_some_and(|command| command.stops_reading)
        {
            match self.reader.read(self.queue.slot()) {
                Read::Command => {
                    if !self.started {
                        self.start();
                    }
                    self.queue.take_in();
                }
                Read::NeedBytes { source, offset } => {
                    return Some(self.ask(BarrierKind::NeedBytes { source, offset, len: WINDOW }));
                }
                Read::NeedProgram { number } => return Some(self.ask(BarrierKind::NeedProgram { number })),
                // Motion must have ended: the blocks in the queue come first.
                Read::NeedValue(quantity) if quantity.waits_for_motion() && self.queue.len() > 0 => break,
                Read::NeedValue(quantity) => return Some(self.ask(BarrierKind::NeedValue(quantity))),
                Read::Pause if self.queue.len() > 0 => break,
                Read::Pause => self.reader.ahead = 0,
                Read::Ended => break,
            }
        }
        None
    }

    /// The first block has been read, so the program's name is known: the program begins before it.
    fn start(&mut self) {
        self.started = true;
        let first = *self.queue.slot();
        let start = self.queue.slot();
        *start = empty_command(&self.start_state);
        start.place = Place { program: first.place.program, source: first.place.source, ..Place::default() };
        start.body = Body::Start(self.start_state.groups);
        self.queue.take_in();
        *self.queue.slot() = first;
    }

    fn ask(&mut self, kind: BarrierKind) -> Barrier {
        self.barriers += 1;
        let barrier = Barrier { id: self.barriers, kind };
        self.barrier = Some(barrier);
        barrier
    }

    /// Answers the open barrier.
    ///
    /// # Errors
    /// `id` is not that of the open barrier; nothing changes then.
    pub fn resume(&mut self, id: u64, answer: Answer) -> Result<(), StaleBarrier> {
        let barrier = self.barrier.filter(|barrier| barrier.id == id).ok_or(StaleBarrier)?;
        self.barrier = None;
        match (barrier.kind, answer) {
            (BarrierKind::NeedBytes { source, offset, len }, Answer::Bytes(bytes, last)) => {
                self.take_bytes(source, offset, len, bytes, last);
            }
            (BarrierKind::NeedBytes { source, offset, len }, _) => self.take_bytes(source, offset, len, &[], true),
            (BarrierKind::NeedProgram { .. }, Answer::Program(source)) => self.reader.brought(Some(source)),
            (BarrierKind::NeedProgram { .. }, _) => self.reader.brought(None),
            (BarrierKind::NeedValue(quantity), answer) => {
                let value = if let Answer::Value(value) = answer { value } else { 0.0 };
                if quantity == Quantity::Clock {
                    self.reader.repetition.clock_was_read();
                }
                self.reader.answers.push((quantity, value));
            }
            (BarrierKind::SkipPosition, answer) => self.measured(answer),
            (BarrierKind::RunAgain, answer) => self.runs_again = Some(answer == Answer::Continue),
            (BarrierKind::CycleStart, Answer::Stop) => self.reader.end(),
            (BarrierKind::CycleStart, _) => {}
        }
        Ok(())
    }

    /// A move that waits for the skip signal has ended. Nothing has been read beyond its block.
    fn measured(&mut self, answer: Answer) {
        let Answer::Stands(at, signalled) = answer else { return };
        if let (Some(expansion), Some(command)) = (self.expansion.as_mut(), self.queue.front_mut()) {
            crate::skip::measured(&self.reader.setting, expansion, command, &at, signalled);
            (self.reader.state.machine, self.reader.state.skip) = (command.after.machine, command.after.skip);
        }
    }

    /// Takes bytes in. Fewer than asked for are gathered and the rest asked for, so that any answer leads on; nothing
    /// at all and not the end would be asked for again for ever, and is taken for the end.
    fn take_bytes(&mut self, source: SourceId, offset: u64, len: usize, bytes: &[u8], last: bool) {
        let last = last || bytes.is_empty();
        if self.gathered.is_empty() && (last || bytes.len() >= len) {
            self.reader.take(source, offset, bytes, last);
            return;
        }
        self.gathered.extend_from_slice(bytes);
        if !last && bytes.len() < len {
            let (offset, len) = (offset + bytes.len() as u64, len - bytes.len());
            self.ask(BarrierKind::NeedBytes { source, offset, len });
            return;
        }
        let start = offset + bytes.len() as u64 - self.gathered.len() as u64;
        self.reader.take(source, start, &self.gathered, last);
        self.gathered.clear();
    }

    /// Where the axes are in the coordinates of the work system in force: mm and degrees for a machine position.
    pub fn work_position(&self, machine: &Point) -> Point {
        let setting = &self.reader.setting;
        let mut work = [0.0; AXES];
        for axis in 0..setting.facts.axes.len().min(AXES) {
            work[axis] = ((machine[axis] * 1e6).round() - setting.zero(self.executing_state(), axis)) / 1e6;
        }
        work
    }

    /// The word of an axis that leads to a machine coordinate in a state (counts).
    pub fn programmed(&self, state: &State, axis: usize, machine: f64) -> f64 {
        self.reader.setting.programmed(state, axis, machine)
    }

    /// Where program zero lies in a state, offsets included: mm and degrees, machine coordinates.
    pub fn program_zero(&self, state: &State) -> Point {
        let setting = &self.reader.setting;
        let mut zero = [0.0; AXES];
        for axis in 0..setting.facts.axes.len().min(AXES) {
            zero[axis] = setting.zero(state, axis) / 1e6;
        }
        zero
    }

    /// What the UNIVERSAL display shows for a machine position.
    pub fn universal_position(&self, machine: &Point) -> Point {
        let state = self.executing_state();
        let mut shown = [0.0; AXES];
        for axis in 0..self.reader.setting.facts.axes.len().min(AXES) {
            shown[axis] = ((machine[axis] * 1e6).round() - state.universal_zero[axis]) / 1e6;
        }
        shown
    }

    fn drop_queue(&mut self) {
        self.queue.clear();
        self.expansion = None;
        self.barrier = None;
        self.gathered.clear();
        self.runs_again = None;
        self.waits_for_start = false;
        self.measures = false;
        self.start_state = self.reader.state;
    }

    /// Texts have changed: everything remembered of them is forgotten.
    pub fn forget_texts(&mut self) {
        self.reader.supply.clear();
        self.reader.store.clear();
        self.reader.calls.forget();
    }
}

/// What the block being executed has next.
enum Front {
    /// An operation.
    Operation,
    /// The question whether the main program runs again.
    Question,
}

/// Millimetres and degrees to counts, to the nearest whole one.
fn to_counts(mm: &Point) -> Point {
    let mut counts = [0.0; AXES];
    for axis in 0..AXES {
        counts[axis] = (mm[axis] * 1e6).round();
    }
    counts
}
