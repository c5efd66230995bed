//! The reading side of the control: one block after the other, through calls and returns, as commands.

mod doubt;
mod rows;

use std::collections::VecDeque;

use base::{AXES, Alarm, AxisSet, Condition, Place, Point, ProgramId, SourceId, Span};
use dialect::{Grouping, Meaning};
use syntax::{Block, Cursor, Outcome, Value, read_block};

use crate::block::{Flow, cut_by_block_delete, read_meaning};
use crate::command::{Body, Command, Finish, MOST_CODES};
use crate::jump::{Calls, Found, LoopsAround, Progress, Search};
use crate::operation::{CodeLine, CodeOut, EndKind, SetValue, Side};
use crate::program::{CalledBy, Frame, Names};
use crate::pull::Quantity;
use crate::record::{Records, WordsRead};
use crate::repetition::Repetition;
use crate::setting::Setting;
use crate::state::State;
use crate::supply::Supply;
use crate::user_macro::call::{Arguments, ModalCall};
use crate::user_macro::flow::MOST_AHEAD;
use crate::user_macro::store::{Store, UNFOUND};
use crate::user_macro::trouble::Trouble;
use crate::user_macro::{BLANK, LOCALS};
use crate::word::Refusal;
use crate::wording::Wording;
use rows::Unsound;

/// What came of reading.
pub(crate) enum Read {
    /// A command was read.
    Command,
    /// Bytes of a source are needed first.
    NeedBytes { source: SourceId, offset: u64 },
    /// A program from outside is needed first.
    NeedProgram { number: u32 },
    /// The machine must be asked first.
    NeedValue(Quantity),
    /// So many statements have been carried out ahead that the blocks before them come first.
    Pause,
    /// There is nothing more to read.
    Ended,
}

/// A value that a statement wrote, to be told before the block that was read after it.
pub(crate) struct Note {
    pub before: u64,
    pub place: Place,
    pub value: SetValue,
}

/// The reader.
pub(crate) struct Reader {
    pub setting: Setting,
    pub supply: Supply,
    pub names: Names,
    pub calls: Calls,
    /// The state after the block read last.
    pub state: State,
    /// The state after the block being read, in the making.
    next: State,
    /// Go on after an alarm, to find later ones.
    pub goes_on: bool,
    /// Jumps allowed without motion, dwell or stop.
    pub loop_limit: u64,
    /// Writes to variables are told.
    pub tells_variables: bool,
    /// Writes not told yet, in their order.
    pub notes: VecDeque<Note>,
    /// Statements carried out since the last block.
    pub ahead: u32,
    pub(crate) store: Store,
    /// The values of the words at hand that were variables.
    pub(crate) word_values: Vec<f64>,
    /// What the machine has answered for the statement at hand.
    pub answers: Vec<(Quantity, f64)>,
    pub(crate) block: Block,
    pub(crate) search: Option<Search>,
    pub(crate) blocks: u64,
    ended: bool,
    jumps: u64,
    /// Statements since the last move, dwell or stop.
    pub(crate) statements: u64,
    /// A tape is read on behind the next end of block: what stands before it counts as its label.
    pub passes_over: bool,
    /// Something has moved, dwelt or stopped since the last jump back.
    pub(crate) moved: bool,
    pub(crate) repetition: Repetition,
    /// The loop at this place asks whether it shall go on for ever.
    pub(crate) asks_again: Option<Cursor>,
    /// A statement was refused: what variables hold is doubtful.
    pub(crate) variables_doubtful: bool,
    arguments: Arguments,
    /// The arguments with which each level was called, for its repeats.
    called_with: Vec<Arguments>,
    modal: Option<ModalCall>,
    pub(crate) records: Records,
}

impl Reader {
    pub fn new(setting: Setting, state: State) -> Reader {
        let levels = setting.control.subprogram_levels;
        let macro_levels = setting.control.macro_levels;
        Reader {
            setting,
            supply: Supply::new(),
            names: Names::default(),
            calls: Calls::new(levels),
            state,
            next: state,
            goes_on: false,
            loop_limit: 1_000_000,
            tells_variables: false,
            notes: VecDeque::with_capacity(64),
            ahead: 0,
            store: Store::default(),
            word_values: Vec::with_capacity(32),
            answers: Vec::with_capacity(16),
            block: Block::default(),
            search: None,
            blocks: 0,
            ended: true,
            jumps: 0,
            statements: 0,
            passes_over: false,
            moved: false,
            repetition: Repetition::default(),
            asks_again: None,
            variables_doubtful: false,
            arguments: [BLANK; LOCALS],
            called_with: vec![[BLANK; LOCALS]; macro_levels + 1],
            modal: None,
            records: Records::default(),
        }
    }

    /// How the words of a block read not long ago were read, if that is recorded.
    pub fn words_read(&self, block: u64) -> Option<&WordsRead> {
        self.records.of(block)
    }

    /// Puts the reader at the head of a program, which begins at `head` in its text; `name` is used if no O word names it.
    pub fn select(&mut self, source: SourceId, name: &str, head: Cursor) {
        let program = self.names.intern(name);
        self.calls.frames.clear();
        self.calls.frames.push(Frame { program, source, head, entry: head, cursor: head, ..Frame::default() });
        self.rewind();
    }

    /// Goes back to the head of the main program.
    pub fn rewind(&mut self) {
        self.calls.frames.truncate(1);
        if let Some(main) = self.calls.frames.first_mut() {
            main.cursor = main.head;
            main.begun = false;
            main.opened = false;
        }
        self.passes_over = false;
        self.search = None;
        self.blocks = 0;
        self.ended = false;
        self.jumps = 0;
        self.calls.loops.clear();
        self.notes.clear();
        self.answers.clear();
        self.statements = 0;
        self.variables_doubtful = false;
        self.asks_again = None;
        self.repetition = Repetition::default();
    }

    /// What is being looked for or asked for is of no use any more.
    pub fn drop_what_is_sought(&mut self) {
        self.search = None;
        self.ended = false;
        self.jumps = 0;
        self.answers.clear();
        self.asks_again = None;
        self.repetition = Repetition::default();
    }

    /// Goes on in the main program at the block after a command, or (`again`) with that block once more.
    ///
    /// A command of a subprogram has no way back to its caller any more: the main program's head is next.
    pub fn go_to(&mut self, command: &Command, again: bool) {
        self.rewind();
        if !command.called
            && let Some(main) = self.calls.frames.first_mut()
        {
            main.cursor = if again { command.here } else { command.frame.cursor };
            main.begun = main.cursor.offset > main.head.offset && !(again && command.first);
        }
    }

    /// Reads on in another main program, where it was left.
    pub fn go_back_to(&mut self, frame: Frame) {
        self.calls.frames.clear();
        self.calls.frames.push(frame);
        let cursor = frame.cursor;
        let (begun, opened) = (frame.begun, frame.opened);
        self.rewind();
        if let Some(main) = self.calls.frames.first_mut() {
            (main.cursor, main.begun, main.opened) = (cursor, begun, opened);
        }
    }

    /// Reads on after a program's end.
    pub fn go_on(&mut self) {
        self.ended = false;
    }

    /// Stops reading until [`Reader::rewind`].
    pub fn end(&mut self) {
        self.ended = true;
        self.search = None;
    }

    /// The program that was asked for, or that there is none.
    pub fn brought(&mut self, source: Option<SourceId>) {
        if let Some(search) = &mut self.search
            && !search.brought(source)
        {
            let target = search.target();
            self.calls.remember(target, None);
            self.search = None;
        }
    }

    /// The main program.
    pub fn main_program(&self) -> Option<(ProgramId, SourceId)> {
        self.calls.frames.first().map(|frame| (frame.program, frame.source))
    }

    /// Reads the next block that says anything into `command`.
    pub fn read(&mut self, command: &mut Command) -> Read {
        loop {
            if self.ended {
                return Read::Ended;
            }
            if let Some(needs) = self.search_on() {
                return needs;
            }
            let Some(&(mut frame)) = self.calls.top() else { return Read::Ended };
            frame.cursor = self.supply.begin(frame.source, frame.cursor);
            if let Some(head) = self.asks_again.take() {
                return self.ask_again(head, &frame, command);
            }
            if self.ahead >= MOST_AHEAD {
                return Read::Pause;
            }
            let kept = if self.store.is_empty() { None } else { self.store.find(frame.source, frame.cursor.offset) };
            let mut unsound = None;
            let line = match kept {
                Some(index) => {
                    let Some(line) = self.store.line(index) else { return Read::Ended };
                    if line.plain {
                        match self.take_statement(index, &frame, command) {
                            Some(read) => return read,
                            None => continue,
                        }
                    }
                    self.store.load(line, &mut self.block);
                    Some(index)
                }
                None => match self.read_text(&frame, &mut unsound) {
                    Ok(line) => line,
                    Err(Text::More) => return self.need(frame.source, frame.cursor.offset),
                    Err(Text::End) => return self.end_of_text(&frame, command),
                    Err(Text::Refused(refused)) => match self.refuse_statement(refused, &frame, command) {
                        Some(read) => return read,
                        None => continue,
                    },
                },
            };
            if self.passes_label(&frame) {
                continue;
            }
            if unsound.is_none() && self.closes(&frame) {
                return self.end_of_text(&frame, command);
            }
            if unsound.is_none() && (self.block.rewind || self.block.is_empty()) {
                if let Some(frame) = self.calls.frames.last_mut() {
                    frame.cursor = self.block.next;
                    frame.opened |= self.block.rewind;
                }
                continue;
            }
            if self.begins_program() {
                // A jump may lead back to the block of the program's own O word.
                let own = [frame.first, frame.head.offset].contains(&self.block.start.offset);
                if frame.begun && !own {
                    return self.end_of_text(&frame, command);
                }
                self.name_program();
            }
            if let Some(record) = &self.setting.record {
                record.borrow_mut().clear();
            }
            let read = match line {
                None if unsound.is_some() => self.refuse_rows(unsound, &frame, command),
                Some(line) => self.take_line(line, &frame, command),
                None => {
                    self.word_values.clear();
                    self.take_block(&frame, command)
                }
            };
            if let Some(read) = read {
                if let Some(record) = &self.setting.record {
                    self.records.keep(command.block, record.borrow().clone());
                }
                return read;
            }
        }
    }

    /// Reads the next block from its text, and compiles and keeps it if statements or variables stand in it, or if it
    /// stands in a loop or macro. Of a tape it also says what is wrong with the block's rows.
    fn read_text(&mut self, frame: &Frame, unsound: &mut Option<Unsound>) -> Result<Option<u32>, Text> {
        let Frame { source, cursor, .. } = *frame;
        let mut view = self.supply.view(source, cursor.offset);
        match read_block(view.characters, view.last, cursor, &self.setting.control.grammar, &mut self.block) {
            Outcome::More => return Err(Text::More),
            Outcome::End => return Err(Text::End),
            Outcome::Block => {}
        }
        if !view.rows.is_empty() {
            *unsound = self.unsound(frame);
            if unsound.is_some() {
                return Ok(None);
            }
            view = self.supply.view(source, cursor.offset);
        }
        let block = &mut self.block;
        let runs = block.statement.is_some() || block.variables;
        let turned = !self.calls.loops.is_empty() || frame.level > 0;
        if !(runs || turned) || !block.faults.is_empty() || block.rewind {
            return Ok(None);
        }
        let mut at = cursor.offset;
        if !block.skips.is_empty() {
            at = UNFOUND;
            if !runs {
                return Ok(None);
            }
            let (words, cut) = cut_by_block_delete(block, self.setting.switches.block_delete);
            block.words.truncate(words);
            block.statement = block.statement.filter(|statement| statement.extent.at < cut);
        }
        let from = (block.start.offset - cursor.offset) as usize;
        let text = view.characters.get(from..from + block.len as usize).unwrap_or_default();
        let Setting { control, memory, .. } = &self.setting;
        self.store.keep(control, &memory.variables, (source, at), block, text).map(Some).map_err(
            |trouble| match trouble {
                Trouble::Refused(condition, extent, values) => Text::Refused((condition, extent, values)),
                // Compiling asks nothing of the machine.
                Trouble::Needs(_) => Text::End,
            },
        )
    }

    /// Carries out a kept block: its statement, or its words with their variables' values.
    fn take_line(&mut self, index: u32, frame: &Frame, command: &mut Command) -> Option<Read> {
        let line = *self.store.line(index)?;
        if line.statement.is_some() {
            if let Some(word) = self.block.words.iter().find(|word| !matches!(word.letter, b'N' | b'O')) {
                return self.refuse_statement((Condition::MacroInBlock, word.extent, [0.0; 3]), frame, command);
            }
            return self.take_statement(index, frame, command);
        }
        if line.has_runs && !self.setting.fitting.options.user_macro {
            let extent = syntax::Extent { at: 0, len: self.block.len.min(u32::from(u16::MAX)) as u16 };
            return self.refuse_statement((Condition::MacroNotFitted, extent, [0.0; 3]), frame, command);
        }
        match self.resolve_words(index) {
            Ok(()) => {}
            Err(Trouble::Needs(quantity)) => return Some(Read::NeedValue(quantity)),
            Err(Trouble::Refused(condition, extent, values)) => {
                return self.refuse_statement((condition, extent, values), frame, command);
            }
        }
        let read = self.take_block(frame, command);
        if read.is_some() {
            self.answers.clear();
            if line.has_runs && self.variables_doubtful && self.goes_on {
                self.forget_what_it_names();
            }
        }
        read
    }

    /// The loop that begins at `head` has come round to what it was: the program asks whether it shall go on.
    fn ask_again(&mut self, head: Cursor, frame: &Frame, command: &mut Command) -> Read {
        let place = Place {
            program: frame.program,
            source: frame.source,
            line: head.line,
            line_start: head.line_start,
            block: Span { start: head.offset, len: 0 },
            sequence: 0,
        };
        self.prepare(command, place);
        self.begin(head, command);
        command.finish = Finish::End(EndKind::Loop);
        command.stops_reading = true;
        command.after = self.state;
        command.side = Side::Off;
        self.blocks += 1;
        Read::Command
    }

    /// Where the block at hand stands.
    pub(crate) fn place_of_block(&self, frame: &Frame) -> Place {
        let sequence = match self.block.words.iter().find(|word| word.letter == b'N').map(|word| word.value) {
            Some(Value::Number(number)) => number.integer().and_then(|n| u32::try_from(n).ok()).unwrap_or(0),
            _ => 0,
        };
        let start = self.block.start;
        Place {
            program: self.calls.top().map_or(frame.program, |frame| frame.program),
            source: frame.source,
            line: start.line,
            line_start: start.line_start,
            block: self.block.span(),
            sequence,
        }
    }

    fn search_on(&mut self) -> Option<Read> {
        let search = self.search.as_mut()?;
        let grammar = self.setting.control.grammar;
        match search.advance(&mut self.supply, &grammar, &mut self.names, &mut self.block, &mut self.calls.index) {
            Progress::NeedBytes { source, offset } => Some(self.need(source, offset)),
            Progress::NeedProgram { number } => Some(Read::NeedProgram { number }),
            Progress::Done(found) => {
                let target = search.target();
                self.calls.remember(target, found);
                self.search = None;
                None
            }
        }
    }

    fn advance(&mut self, to: Cursor) {
        if let Some(frame) = self.calls.frames.last_mut() {
            frame.cursor = to;
        }
    }

    fn begins_program(&self) -> bool {
        self.setting.control.grouping == Grouping::OWords
            && self.block.words.first().is_some_and(|word| word.letter == b'O')
    }

    fn name_program(&mut self) {
        if let Some(Value::Number(number)) = self.block.words.first().map(|word| word.value)
            && let Some(number) = number.integer().and_then(|number| u32::try_from(number).ok())
        {
            let program = self.names.numbered(number);
            if let Some(frame) = self.calls.frames.last_mut() {
                frame.program = program;
            }
        }
    }

    /// Gives the block its meaning; `None` reads on (a jump's target is looked for first, or the block is passed over).
    fn take_block(&mut self, frame: &Frame, command: &mut Command) -> Option<Read> {
        let place = self.place_of_block(frame);
        self.prepare(command, place);
        self.next = self.state;
        if place.sequence > 0 {
            self.next.sequence = place.sequence;
        }
        let Reader { setting, calls, state, next, block, word_values, arguments, .. } = self;
        match read_meaning(setting, calls, state, next, (block, word_values), arguments, command) {
            Ok(flow) => {
                self.begin(self.block.next, command);
                match self.follow(flow, command) {
                    Ok(()) => {
                        let memory = &mut self.setting.memory;
                        self.next.memory_mark ^= command.write.map_or(0, |write| memory.write(write));
                        self.state = self.next;
                        command.after = self.next;
                        self.count(command);
                        if flow == Flow::Next {
                            self.call_after_move(command);
                        }
                        Some(Read::Command)
                    }
                    Err(alarm) => self.refuse(alarm, command),
                }
            }
            Err(Refusal::Locate(target)) => {
                let main = self.calls.frames.first().map_or(frame.source, |main| main.source);
                self.search = Some(Search::new(target, main, &self.calls.index, LoopsAround::default()));
                None
            }
            Err(Refusal::Alarm(alarm)) => {
                self.begin(self.block.next, command);
                let alarm = self.name_row(alarm);
                self.refuse(alarm, command)
            }
        }
    }

    pub(crate) fn begin(&mut self, next: Cursor, command: &mut Command) {
        if let Some(frame) = self.calls.frames.last_mut() {
            command.first = !frame.begun;
            if !frame.begun {
                frame.first = self.block.start.offset;
            }
            frame.cursor = next;
            frame.begun = true;
            command.frame = *frame;
        }
        command.here = self.block.start;
        command.called = self.calls.frames.len() > 1;
    }

    fn prepare(&self, command: &mut Command, place: Place) {
        command.block = self.blocks;
        command.place = place;
        command.from = self.state.machine;
        command.code_count = 0;
        command.optional_code = None;
        command.body = Body::Nothing;
        command.write = None;
        command.finish = Finish::Next;
        command.stops_reading = false;
        command.absolute = AxisSet::NONE;
        command.returned = AxisSet::NONE;
        command.wording = Wording::default();
        command.from_unknown = !self.state.unknown.axes.is_empty();
    }

    fn count(&mut self, command: &Command) {
        self.blocks += 1;
        if !matches!(command.body, Body::Nothing | Body::Set(..)) || command.finish != Finish::Next {
            self.jumps = 0;
            self.statements = 0;
            self.moved = true;
        }
    }

    /// Carries the program to where the block sends it.
    fn follow(&mut self, flow: Flow, command: &mut Command) -> Result<(), Alarm> {
        if flow == Flow::Next {
            return Ok(());
        }
        self.jumps += 1;
        if self.jumps > self.loop_limit {
            let place = command.place;
            let jump = self.block.words.iter().find(|word| word.letter == b'M');
            let span = jump.map_or(place.block, |word| word.extent.span(place.block.start));
            let alarm = Alarm::new(Condition::EndlessLoop, place, span);
            let first = match &flow {
                Flow::Jump(found) => found.cursor.line.min(place.line),
                Flow::Again => self.calls.top().map_or(place.line, |frame| frame.head.line),
                _ => place.line,
            };
            return Err(alarm.with([self.loop_limit as f64, first as f64, place.line as f64]));
        }
        match flow {
            Flow::Next => {}
            Flow::Call { found, entry, repeats } => self.enter(found, entry, repeats),
            Flow::MacroCall(found, repeats) => {
                let arguments = self.arguments;
                self.enter_macro(found, repeats, CalledBy::Macro, &arguments);
            }
            Flow::ModalCall(found, repeats) => {
                self.modal = Some(ModalCall { found, repeats, arguments: self.arguments });
            }
            Flow::Return(found) => self.leave(found),
            Flow::Again => self.run_again(command),
            // A round without a move, dwell or stop is not a program that runs again: the loop limit ends it.
            Flow::Jump(found) if self.jumps == 1 && self.comes_again(found.cursor) => self.run_again(command),
            Flow::Jump(found) => self.advance(found.cursor),
        }
        Ok(())
    }

    fn comes_again(&mut self, cursor: Cursor) -> bool {
        self.repetition.comes_again(cursor, &self.next, &self.setting.memory.variables)
    }

    fn enter(&mut self, found: Found, entry: Cursor, repeats: u32) {
        let Found { source, program, cursor: head, .. } = found;
        let level = self.calls.top().map_or(0, |frame| frame.level);
        let called_by = CalledBy::Subprogram;
        let repeats = repeats.saturating_sub(1);
        let frame =
            Frame { program, source, head, entry, cursor: entry, called_by, level, repeats, ..Frame::default() };
        self.calls.frames.push(frame);
    }

    /// Enters a macro with local variables of its own.
    fn enter_macro(&mut self, found: Found, repeats: u32, called_by: CalledBy, arguments: &Arguments) {
        self.enter(found, found.cursor, repeats);
        let Some(frame) = self.calls.frames.last_mut() else { return };
        frame.called_by = called_by;
        frame.level += 1;
        let level = usize::from(frame.level);
        if let Some(slot) = self.called_with.get_mut(level) {
            *slot = *arguments;
        }
        self.setting.memory.variables.set_locals(level, arguments);
    }

    /// Calls the modal macro after a move, unless the move is that macro's own.
    fn call_after_move(&mut self, command: &Command) {
        let Some(modal) = self.modal else { return };
        let group = self.setting.control.roles.modal_macro;
        if self.setting.control.in_force(&self.state.groups, group) != Some(Meaning::ModalMacroCall) {
            self.modal = None;
            return;
        }
        let own = self.calls.frames.iter().any(|frame| frame.called_by == CalledBy::ModalMacro);
        let room = self.calls.macro_level() < self.setting.control.macro_levels;
        if command.body.moves() && !own && room {
            self.enter_macro(modal.found, modal.repeats, CalledBy::ModalMacro, &modal.arguments);
        }
    }

    fn leave(&mut self, found: Option<Found>) {
        let Some(frame) = self.calls.frames.last_mut() else { return };
        if frame.repeats > 0 && found.is_none() {
            frame.repeats -= 1;
            frame.cursor = frame.entry;
            frame.begun = false;
            frame.opened = false;
            let level = usize::from(frame.level);
            if matches!(frame.called_by, CalledBy::Macro | CalledBy::ModalMacro)
                && let Some(arguments) = self.called_with.get(level)
            {
                self.setting.memory.variables.set_locals(level, arguments);
            }
            self.close_loops();
            return;
        }
        self.calls.frames.pop();
        self.close_loops();
        if let Some(found) = found {
            self.advance(found.cursor);
        }
    }

    /// Loops that a return has left are closed.
    fn close_loops(&mut self) {
        let depth = self.calls.frames.len();
        let inside = self.calls.top().is_some_and(|frame| frame.begun);
        self.calls.loops.retain(|open| open.depth < depth || (open.depth == depth && inside));
    }

    /// M99 in the main program: it asks to be run again.
    fn run_again(&mut self, command: &mut Command) {
        command.finish = Finish::End(EndKind::M99);
        command.stops_reading = true;
        self.calls.loops.clear();
        if let Some(main) = self.calls.frames.first_mut() {
            main.cursor = main.head;
            main.begun = false;
            main.opened = false;
        }
    }

    /// The block is refused: it has no effect. Checking on, what it names becomes unknown.
    pub(crate) fn refuse(&mut self, alarm: Alarm, command: &mut Command) -> Option<Read> {
        let clouded = self.unknown_in_block().clouds(alarm.condition, &self.setting.control.roles, alarm.axis);
        if !self.goes_on || alarm.condition == Condition::EndlessLoop {
            self.ended = true;
        } else {
            self.forget_what_it_names();
        }
        if clouded {
            return None;
        }
        self.prepare(command, alarm.place);
        command.body = Body::Alarm(alarm);
        command.after = self.state;
        self.blocks += 1;
        Some(Read::Command)
    }

    fn end_of_text(&mut self, frame: &Frame, command: &mut Command) -> Read {
        let Cursor { offset, line, line_start, .. } = frame.cursor;
        self.prepare(
            command,
            Place {
                program: frame.program,
                source: frame.source,
                line,
                line_start,
                block: Span { start: offset, len: 0 },
                sequence: 0,
            },
        );
        command.finish = Finish::End(EndKind::Text);
        command.after = self.state;
        command.side = Side::Off;
        command.frame = *frame;
        command.here = frame.cursor;
        command.called = self.calls.frames.len() > 1;
        command.first = false;
        self.ended = true;
        Read::Command
    }

    /// Sets where the axes stand (counts).
    pub fn stand_at(&mut self, machine: Point) {
        self.state.machine = machine;
    }
}

/// Why no block came of a text.
enum Text {
    More,
    End,
    /// A statement or variable in it cannot be compiled.
    Refused((Condition, syntax::Extent, [f64; 3])),
}

/// A command that says nothing.
pub(crate) fn empty_command(state: &State) -> Command {
    Command {
        block: 0,
        place: Place::default(),
        after: *state,
        from: state.machine,
        codes: [CodeOut { line: CodeLine::M, code: 0, digits: 0, after_motion: false }; MOST_CODES],
        code_count: 0,
        optional_code: None,
        body: Body::Nothing,
        write: None,
        finish: Finish::Next,
        stops_reading: false,
        side: Side::Off,
        plane: AxisSet::NONE,
        axis_words: [syntax::Extent::default(); AXES],
        absolute: AxisSet::NONE,
        returned: AxisSet::NONE,
        stroke_check: false,
        wording: Wording::default(),
        from_unknown: false,
        frame: Frame::default(),
        here: Cursor::HEAD,
        called: false,
        first: false,
    }
}
