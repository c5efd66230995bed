//! The interpreter: the reader, the queue and the expansion as one thing that is pulled.

mod answers;
mod positions;
mod pulling;
mod states;

use std::sync::Arc;

use base::{AXES, AxisSet, Place, Point, ProgramId, SourceId};
use dialect::{Control, Fitting, GroupCodes};
use syntax::Cursor;

use crate::command::Command;
use crate::expand::Expansion;
use crate::facts::{MachineFacts, Memory, Switches};
use crate::operation::Operation;
use crate::pull::Barrier;
use crate::queue::Queue;
use crate::reader::Reader;
use crate::record::{StatementRuns, WordsRead};
use crate::setting::Setting;
use crate::state::State;
use crate::unknown::letter_bit;

/// The interpreter of one control.
///
/// [`Interpreter::select`] a program, then pull with [`Interpreter::next`]; barriers are answered with
/// [`Interpreter::resume`]. Reading runs ahead of execution by as many blocks as the control's buffer holds.
#[derive(Clone)]
pub struct Interpreter {
    pub(crate) reader: Reader,
    queue: Queue,
    expansion: Expansion,
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
        let transform_groups = crate::setting::transform_groups(&control);
        let axis_of_letter = crate::setting::axis_of_letter(&facts);
        let usual_letters = crate::setting::usual_letters(&control, axis_letters);
        let setting = Setting {
            control,
            fitting,
            facts,
            memory,
            switches: Switches::default(),
            length_axis,
            axis_letters,
            axis_of_letter,
            usual_letters,
            code_letters,
            transform_groups,
            record: None,
        };
        Interpreter {
            reader: Reader::new(setting, state),
            queue: Queue::new(&Command::empty(&state)),
            expansion: Expansion::idle(),
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

    /// How a text is read, text or tape, once that is known.
    pub fn format_of(&self, source: SourceId) -> Option<tape::Format> {
        self.reader.supply.format(source)
    }

    /// Where the text of a called program that was read last ended before its M99.
    pub fn unreturned(&self) -> Option<Place> {
        self.reader.unreturned
    }

    /// The main program and its source, if one is selected.
    pub fn main_program(&self) -> Option<(ProgramId, SourceId)> {
        self.reader.main_program()
    }

    /// The program of this name.
    pub fn program_named(&mut self, name: &str) -> base::ProgramId {
        self.reader.names.intern(name)
    }

    /// The value of a macro variable of the level in execution; `None` is a blank or no such variable.
    pub fn variable(&self, number: u32) -> Option<f64> {
        self.reader.variable(number)
    }

    /// The level of macro calls whose local variables are read and written, 0 for the main program.
    pub fn macro_level(&self) -> usize {
        self.reader.macro_level()
    }

    /// Writes a macro variable by hand; `None` blanks it. False if there is none that may be written so.
    pub fn set_variable(&mut self, number: u32, value: Option<f64>) -> bool {
        self.reader.set_variable(number, value.unwrap_or(crate::user_macro::BLANK))
    }

    /// Writes to variables are told as operations, as a trace wants them.
    pub fn tell_variables(&mut self, tells: bool) {
        self.reader.tells_variables = tells;
    }

    /// True if writes to variables are told.
    pub fn tells_variables(&self) -> bool {
        self.reader.tells_variables
    }

    /// What the control has read: the state after the last block read.
    pub fn read_state(&self) -> &State {
        &self.reader.state
    }

    /// What the control is executing: the block at the front of the queue.
    pub fn executing(&self) -> Option<&Command> {
        self.queue.front()
    }

    /// The block being executed and those that the control has read behind it, in their order.
    pub fn held(&self) -> impl Iterator<Item = &Command> {
        (0..self.queue.len()).map_while(|index| self.queue.behind(index))
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

    fn drop_queue(&mut self) {
        self.queue.clear();
        self.expansion.end();
        self.barrier = None;
        self.gathered.clear();
        self.runs_again = None;
        self.waits_for_start = false;
        self.measures = false;
        self.start_state = *self.reader.state;
    }

    /// Texts have changed: everything remembered of them is forgotten.
    pub fn forget_texts(&mut self) {
        self.reader.supply.clear();
        self.reader.store.clear();
        self.reader.calls.forget();
    }
}

/// Millimetres and degrees to counts, to the nearest whole one.
fn to_counts(mm: &Point) -> Point {
    let mut counts = [0.0; AXES];
    for axis in 0..AXES {
        counts[axis] = (mm[axis] * 1e6).round();
    }
    counts
}
