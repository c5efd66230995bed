//! The checks of a tape's rows: what a control finds wrong with a block before it reads a word of it.

use base::{Alarm, Condition, Place, SourceId, Span};
use tape::{Fault, UNREADABLE, faults, is_odd};

use super::{Read, Reader};
use crate::command::Command;
use crate::program::Frame;

/// Why a block on tape is refused, and where.
#[derive(Clone, Copy)]
pub(super) struct Unsound {
    condition: Condition,
    values: [f64; 3],
    /// What it is about; the whole block if it is none of its characters.
    span: Option<Span>,
    /// The block is the `%` that ends the tape.
    closes: bool,
}

impl Unsound {
    /// The alarm; rows around the block's words belong to the block where one of them is wrong.
    fn alarm(self, mut place: Place) -> Alarm {
        let span = self.span.unwrap_or(place.block);
        place.block = place.block.to(span);
        Alarm::new(self.condition, place, span).with(self.values)
    }
}

impl Reader {
    /// Takes bytes of a source in.
    pub fn take(&mut self, source: SourceId, offset: u64, bytes: &[u8], last: bool) {
        let codes = self.setting.fitting.tape_codes(&self.setting.control);
        self.supply.fill(source, offset, bytes, last, codes);
    }

    /// The bytes that the reader lacks.
    pub(super) fn need(&self, source: SourceId, offset: u64) -> Read {
        Read::NeedBytes { source, offset: self.supply.wanted(source, offset) }
    }

    /// True if the block at hand is the `%` behind the program: nothing behind it is read.
    pub(super) fn closes(&self, frame: &Frame) -> bool {
        self.block.rewind && (frame.begun || frame.opened)
    }

    /// Passes over the block at hand if it counts as the label of a tape; a text has none.
    pub(super) fn passes_label(&mut self, frame: &Frame) -> bool {
        if !self.passes_over || self.calls.frames.len() > 1 {
            return false;
        }
        self.passes_over = false;
        let is_tape = matches!(self.supply.format(frame.source), Some(tape::Format::Tape(_)));
        if !is_tape || self.block.rewind {
            return false;
        }
        if let Some(frame) = self.calls.frames.last_mut() {
            frame.cursor = self.block.next;
        }
        true
    }

    /// What is wrong with the rows of the block at hand, of a source that is a tape.
    ///
    /// The control checks every row it takes in, those of comments and of skipped words too, and counts the rows of a
    /// block from one end-of-block to the next.
    pub(super) fn unsound(&mut self, frame: &Frame) -> Option<Unsound> {
        let closes = self.closes(frame);
        let (control, block) = (&self.setting.control, &self.block);
        let tape::Format::Tape(tape) = self.supply.format(frame.source)? else { return None };
        let table = self.setting.fitting.tape_codes(control)?.table(tape.system);
        let begin = frame.cursor.offset.max(tape.label);
        let end = if closes { block.start.offset + 1 } else { block.next.offset };
        let rows = self.supply.view(frame.source, begin).rows;
        let rows = rows.get(..usize::try_from(end.saturating_sub(begin)).ok()?)?;
        let at = |index: usize| Some(Span { start: begin + index as u64, len: 1 });
        for (index, fault) in faults(rows, &table) {
            let row = rows.get(index).copied().map_or(0.0, f64::from);
            let (condition, values) = match fault {
                Fault::Parity(guesses) => (Condition::CharacterParity, [row, guesses.number(), 0.0]),
                Fault::Blank => (Condition::TapeBlank, [0.0; 3]),
                // Words that are skipped are not read, so it may be no fault.
                Fault::Unknown => continue,
            };
            return Some(Unsound { condition, values, span: at(index), closes });
        }
        // Only a block that ends with its own end-of-block can be counted.
        let count = block.next.offset.saturating_sub(block.start.line_start);
        let ends = rows.last() == Some(&tape.system.end_of_block()) && block.start.line_start >= tape.label;
        if closes || !ends {
            return None;
        }
        if self.setting.fitting.checks_block_parity(control) && is_odd(count) {
            return Some(Unsound {
                condition: Condition::BlockParity,
                values: [count as f64, 0.0, 0.0],
                span: None,
                closes,
            });
        }
        let limit = control.grammar.block_length;
        let punched = rows.iter().filter(|&&row| row != 0);
        let too_long = punched.clone().count() > limit as usize;
        too_long.then(|| {
            let values = [f64::from(limit), 0.0, 0.0];
            let index = rows.iter().enumerate().filter(|(_, row)| **row != 0).nth(limit as usize).map_or(0, |(i, _)| i);
            let span = at(index.min(rows.len().saturating_sub(2)));
            Unsound { condition: Condition::BlockTooLong, values, span, closes }
        })
    }

    /// The block is refused for its rows: what was read of it counts for nothing, only where the tape goes on.
    pub(super) fn refuse_rows(
        &mut self,
        unsound: Option<Unsound>,
        frame: &Frame,
        command: &mut Command,
    ) -> Option<Read> {
        let unsound = unsound?;
        let place = self.place_of_block(frame);
        // The `%` that ends the tape is read once more, and ends it.
        self.begin(if unsound.closes { self.block.start } else { self.block.next }, command);
        if let Some(now) = self.calls.frames.last_mut()
            && self.block.words.is_empty()
        {
            now.begun = frame.begun;
            now.opened |= self.block.rewind;
        }
        self.refuse(unsound.alarm(place), command)
    }

    /// An unknown character on a tape is named by its holes.
    pub(super) fn name_row(&mut self, mut alarm: Alarm) -> Alarm {
        let source = alarm.place.source;
        if alarm.condition == Condition::CharacterUnknown
            && let Some(tape::Format::Tape(tape)) = self.supply.format(source)
            && let Some(codes) = self.setting.fitting.tape_codes(&self.setting.control)
            && let Some(&row) = self.supply.view(source, alarm.span.start).rows.first()
            && codes.table(tape.system).character(row) == UNREADABLE
        {
            alarm.condition = Condition::TapeCodeUnknown;
            alarm.values[0] = f64::from(row);
        }
        alarm
    }
}
