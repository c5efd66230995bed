//! The reading side of the control: one block after the other, through calls and returns, as commands.

mod doubt;
mod follow;
mod handing_on;
mod rows;
mod selection;
mod text;

pub(crate) use follow::After;

use std::collections::VecDeque;

use base::{Place, SourceId};
use syntax::{Block, Cursor};

use crate::block::{Flow, read_meaning};
use crate::command::Command;
use crate::jump::{Calls, LoopsAround};
use crate::operation::SetValue;
use crate::program::{CallName, Frame, Names, ProgramKey};
use crate::pull::Quantity;
use crate::record::{Records, WordsRead};
use crate::repetition::Repetition;
use crate::search::{Progress, Search};
use crate::setting::Setting;
use crate::state::State;
use crate::supply::Supply;
use crate::user_macro::call::{Arguments, ModalCall};
use crate::user_macro::flow::MOST_AHEAD;
use crate::user_macro::store::Store;
use crate::user_macro::{BLANK, LOCALS};
use crate::word::Refusal;
use text::Text;

/// What came of reading.
pub(crate) enum Read {
    /// A command was read.
    Command,
    /// Bytes of a source are needed first.
    NeedBytes { source: SourceId, offset: u64 },
    /// A program from outside is needed first.
    NeedProgram { program: ProgramKey },
    /// The machine must be asked first.
    NeedValue(Quantity),
    /// So many statements have been carried out ahead that the blocks before them come first.
    Pause,
    /// There is nothing more to read.
    Ended,
}

/// A value that a statement wrote, to be told before the block that was read after it.
#[derive(Clone)]
pub(crate) struct Note {
    pub before: u64,
    pub place: Place,
    pub value: SetValue,
}

/// The reader.
#[derive(Clone)]
pub(crate) struct Reader {
    pub setting: Setting,
    pub supply: Supply,
    pub names: Names,
    pub calls: Calls,
    /// The state after the block read last. It changes places with the one in the making, so that neither is copied.
    pub state: Box<State>,
    /// The state after the block being read, in the making.
    next: Box<State>,
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
    /// The program that the block at hand names.
    pub(crate) called: CallName,
    /// Where a called program's text ended before its M99.
    pub(crate) unreturned: Option<Place>,
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
            state: Box::new(state),
            next: Box::new(state),
            goes_on: false,
            loop_limit: 1_000_000,
            tells_variables: false,
            notes: VecDeque::with_capacity(64),
            ahead: 0,
            store: Store::default(),
            word_values: Vec::with_capacity(32),
            answers: Vec::with_capacity(16),
            block: Block::default(),
            called: None,
            unreturned: None,
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

    /// Reads the next block that says anything into `command`.
    pub fn read(&mut self, command: &mut Command) -> Read {
        loop {
            if self.ended {
                return Read::Ended;
            }
            if let Some(needs) = self.search_on() {
                return needs;
            }
            if let Some(index) = self.kept_statement() {
                match self.take_statement(index, command) {
                    Some(read) => return read,
                    None => continue,
                }
            }
            let Some(&(mut frame)) = self.calls.top() else { return Read::Ended };
            if frame.cursor.offset == 0 {
                frame.cursor = self.supply.begin(frame.source, frame.cursor);
            }
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
                    self.store.load(line, &mut self.block);
                    self.called = line.called.get();
                    Some(index)
                }
                None => match self.read_text(&frame, &mut unsound) {
                    Ok(line) => line,
                    Err(Text::More) => return self.need(frame.source, frame.cursor.offset),
                    Err(Text::End) if self.returns_at_end(&frame) => continue,
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
                    if !self.take_block(&frame, command) {
                        continue;
                    }
                    self.records.keep_if_recorded(command.block, self.setting.record.as_ref());
                    return Read::Command;
                }
            };
            if let Some(read) = read {
                self.records.keep_if_recorded(command.block, self.setting.record.as_ref());
                return read;
            }
        }
    }

    /// The statement that is next, if it is kept and stands alone in its block: no more of the frame is needed then.
    #[inline]
    fn kept_statement(&mut self) -> Option<u32> {
        if self.store.is_empty() || self.asks_again.is_some() || self.ahead >= MOST_AHEAD {
            return None;
        }
        let top = self.calls.frames.last().filter(|top| top.begun)?;
        let index = self.store.find(top.source, top.cursor.offset)?;
        self.store.line(index).is_some_and(|line| line.plain).then_some(index)
    }

    fn search_on(&mut self) -> Option<Read> {
        let search = self.search.as_mut()?;
        let grammar = self.setting.control.grammar;
        let block_delete = self.setting.switches.block_delete;
        let (supply, index) = (&mut self.supply, &mut self.calls.index);
        match search.advance(supply, &grammar, &mut self.names, &mut self.block, index, block_delete) {
            Progress::NeedBytes { source, offset } => Some(self.need(source, offset)),
            Progress::NeedProgram { program } => Some(Read::NeedProgram { program }),
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
        self.calls.leave_loops(self.calls.frames.len(), to.offset);
    }

    fn begins_program(&self) -> bool {
        self.block.begins_program(&self.setting.control.grammar)
    }

    fn name_program(&mut self) {
        if let Some(number) = self.block.whole_number(b'O').and_then(|number| u32::try_from(number).ok()) {
            let program = self.names.numbered(number);
            if let Some(frame) = self.calls.frames.last_mut() {
                frame.program = program;
            }
        }
    }

    /// Gives the block its meaning; false reads on (a jump's target is looked for first, or the block is passed over).
    fn take_block(&mut self, frame: &Frame, command: &mut Command) -> bool {
        let place = self.place_of_block(frame);
        self.prepare(command, place);
        *self.next = *self.state;
        if place.sequence > 0 {
            self.next.sequence = place.sequence;
        }
        let Reader { setting, calls, state, next, block, word_values, called, arguments, .. } = self;
        // Written where it stays: it is large, and nearly always says nothing.
        let mut flow = Flow::Next;
        let text = (&*block, word_values.as_slice(), *called);
        match read_meaning(setting, calls, state, next, text, arguments, (command, &mut flow)) {
            Ok(()) => {
                self.begin(self.block.next, command);
                match self.follow(&flow, command) {
                    Ok(()) => {
                        let memory = &mut self.setting.memory;
                        self.next.memory_mark ^= command.write.map_or(0, |write| memory.write(write));
                        std::mem::swap(&mut self.state, &mut self.next);
                        command.after = *self.state;
                        self.count(command);
                        if matches!(flow, Flow::Next) {
                            self.call_after_move(command);
                        }
                        true
                    }
                    Err(alarm) => self.refuse(alarm, command).is_some(),
                }
            }
            Err(Refusal::Locate(target)) => {
                let main = self.calls.frames.first().map_or(frame.source, |main| main.source);
                self.search = Some(Search::new(target, main, &self.calls.index, LoopsAround::default()));
                false
            }
            Err(Refusal::Alarm(alarm)) => {
                self.begin(self.block.next, command);
                let alarm = self.name_row(alarm);
                self.refuse(alarm, command).is_some()
            }
        }
    }
}
