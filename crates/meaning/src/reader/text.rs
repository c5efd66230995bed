//! From a text to a block at hand: read, compiled and kept, or taken from what was kept.

use std::rc::Rc;

use super::rows::Unsound;
use super::{Read, Reader};
use crate::block::cut_by_block_delete;
use crate::command::{Command, Finish};
use crate::operation::{EndKind, Side};
use crate::program::Frame;
use crate::setting::Setting;
use crate::user_macro::store::{UNFOUND, sequence_of};
use crate::user_macro::trouble::Trouble;
use base::{Condition, Place, Span};
use syntax::{Cursor, Outcome, read_block};

/// Why no block came of a text.
pub(super) enum Text {
    More,
    End,
    /// A statement or variable in it cannot be compiled.
    Refused((Condition, syntax::Extent, [f64; 3])),
}

impl Reader {
    /// Reads the next block from its text, and compiles and keeps it if statements or variables stand in it, or if it
    /// stands in a loop or macro. Of a tape it also says what is wrong with the block's rows.
    pub(super) fn read_text(&mut self, frame: &Frame, unsound: &mut Option<Unsound>) -> Result<Option<u32>, Text> {
        let (source, cursor) = (frame.source, &frame.cursor);
        let mut view = self.supply.view(source, cursor.offset);
        match read_block(view.characters, view.last, *cursor, &self.setting.control.grammar, &mut self.block) {
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
        self.called = None;
        if let Some(name) = self.block.call_name {
            let from = (self.block.start.offset - cursor.offset) as usize + usize::from(name.at);
            let text = view.characters.get(from..from + usize::from(name.len)).unwrap_or_default();
            let numbers = self.setting.fitting.options.number_form_call;
            self.called = self.setting.control.files.as_ref().map(|files| self.names.called(text, files, numbers));
        }
        let called = self.called;
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
        let kept = self.store.keep(control, &memory.variables, (source, at), block, text);
        if let (Ok(index), Some(_)) = (&kept, called) {
            self.store.set_called(*index, called);
        }
        kept.map(Some).map_err(|trouble| match trouble {
            Trouble::Refused(condition, extent, values) => Text::Refused((condition, extent, values)),
            // Compiling asks nothing of the machine.
            Trouble::Needs(_) => Text::End,
        })
    }

    /// Carries out a kept block: its statement, or its words with their variables' values.
    pub(super) fn take_line(&mut self, index: u32, frame: &Frame, command: &mut Command) -> Option<Read> {
        let line = Rc::clone(self.store.line(index)?);
        if line.statement.is_some() {
            if let Some(word) = self.block.words.iter().find(|word| !matches!(word.letter, b'N' | b'O')) {
                return self.refuse_statement((Condition::MacroInBlock, word.extent, [0.0; 3]), frame, command);
            }
            return self.take_statement(index, command);
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
        let taken = self.take_block(frame, command);
        if taken {
            self.answers.clear();
            if line.has_runs && self.variables_doubtful && self.goes_on {
                self.forget_what_it_names();
            }
        }
        taken.then_some(Read::Command)
    }

    /// The loop that begins at `head` has come round to what it was: the program asks whether it shall go on.
    pub(super) fn ask_again(&mut self, head: Cursor, frame: &Frame, command: &mut Command) -> Read {
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
        command.after = *self.state;
        command.side = Side::Off;
        command.offset = None;
        self.blocks += 1;
        Read::Command
    }

    /// Where the block at hand stands.
    pub(crate) fn place_of_block(&self, frame: &Frame) -> Place {
        let start = self.block.start;
        Place {
            program: self.calls.top().map_or(frame.program, |frame| frame.program),
            source: frame.source,
            line: start.line,
            line_start: start.line_start,
            block: self.block.span(),
            sequence: sequence_of(&self.block),
        }
    }
}
