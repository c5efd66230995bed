//! How the words of blocks were read, kept for whoever explains programs: what a word was taken for, and its value.
//!
//! Nothing is kept unless it is asked for ([`crate::Interpreter::record_words`]); running a program costs nothing more.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};

use base::{Place, SourceId};

use crate::operation::SetValue;
use crate::state::State;

/// Blocks whose records are kept: more than the control's buffer ever holds.
const KEPT: usize = 32;
/// Statements of a text that are counted.
const MOST_STATEMENTS: usize = 100_000;

/// What a word was read as.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ReadAs {
    /// A number whose unit the function knows.
    Number,
    /// A whole number: an offset's, a program's, a count.
    Whole,
    /// A length; the value is in mm.
    Length,
    /// An angle; the value is in degrees.
    Angle,
    /// A ratio of scaling.
    Ratio,
    /// A time; the value is in seconds.
    Seconds,
    /// Turns of the spindle.
    Turns,
    /// A feed; the value is in mm/min.
    FeedPerMinute,
    /// A feed; the value is in mm a revolution.
    FeedPerRevolution,
}

/// How the words of one block were read.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct WordsRead {
    words: [Option<(ReadAs, f64)>; 26],
    /// The block's G codes, as written: where the word stands in the block, its row in the control's table.
    pub g_rows: Vec<(u16, u8)>,
    /// The block's M codes, as written.
    pub m_codes: Vec<u32>,
    /// Arguments of a macro call: where the word stands in the block, the local variable that it fills, its value.
    pub arguments: Vec<(u16, usize, f64)>,
}

impl WordsRead {
    /// What the last word of a letter was read as, and its value; `None` if nothing in the block has asked for it.
    pub fn word(&self, letter: u8) -> Option<(ReadAs, f64)> {
        self.words.get(usize::from(letter.wrapping_sub(b'A'))).copied().flatten()
    }

    pub(crate) fn clear(&mut self) {
        self.words = [None; 26];
        self.g_rows.clear();
        self.m_codes.clear();
        self.arguments.clear();
    }

    /// Notes a reading. That of a mere number never takes the place of one with a unit.
    pub(crate) fn note(&mut self, letter: u8, read: ReadAs, value: f64) {
        if let Some(slot) = self.words.get_mut(usize::from(letter.wrapping_sub(b'A')))
            && (read != ReadAs::Number || slot.is_none())
        {
            *slot = Some((read, value));
        }
    }
}

/// A macro statement as it was carried out.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct StatementRead {
    /// Where it stands.
    pub place: Place,
    /// The state in which it was carried out.
    pub state: State,
    /// What it wrote, if it is one that writes.
    pub wrote: Option<SetValue>,
    /// The line at which the program went on.
    pub goes_to: u64,
}

/// How often a statement was carried out, and one time of them.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct StatementRuns {
    /// How often.
    pub count: u64,
    /// The time that was asked for.
    pub asked: Option<StatementRead>,
}

/// The records of the blocks read last.
#[derive(Clone, Default)]
pub(crate) struct Records {
    kept: VecDeque<(u64, WordsRead)>,
    statements: BTreeMap<(SourceId, u64), StatementRuns>,
    /// Which time of each statement is kept, from 1.
    pub pass: u64,
}

impl Records {
    pub fn keep_if_recorded(&mut self, block: u64, words: Option<&RefCell<WordsRead>>) {
        if let Some(words) = words {
            self.keep(block, words.borrow().clone());
        }
    }

    fn keep(&mut self, block: u64, words: WordsRead) {
        if self.kept.len() >= KEPT {
            self.kept.pop_front();
        }
        self.kept.push_back((block, words));
    }

    /// The record of a block; counted anew from each start of a program, so the latest of a number is meant.
    pub fn of(&self, block: u64) -> Option<&WordsRead> {
        self.kept.iter().rev().find(|(number, _)| *number == block).map(|(_, words)| words)
    }

    pub fn statement(&mut self, read: StatementRead) {
        let key = (read.place.source, read.place.block.start);
        if self.statements.len() < MOST_STATEMENTS || self.statements.contains_key(&key) {
            let runs = self.statements.entry(key).or_default();
            runs.count += 1;
            if runs.count == self.pass {
                runs.asked = Some(read);
            }
        }
    }

    /// Every statement carried out so far.
    pub fn statements(&self) -> impl Iterator<Item = &StatementRuns> {
        self.statements.values()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reading_with_a_unit_outlives_the_mere_number() {
        let mut words = WordsRead::default();
        words.note(b'P', ReadAs::Number, 1000.0);
        words.note(b'P', ReadAs::Seconds, 1.0);
        words.note(b'P', ReadAs::Number, 1000.0);
        assert_eq!(words.word(b'P'), Some((ReadAs::Seconds, 1.0)));
        assert_eq!((words.word(b'Q'), words.word(b'#')), (None, None));
    }

    #[test]
    fn old_blocks_are_forgotten_and_a_block_read_again_counts_anew() {
        let mut records = Records::default();
        for block in 0..100 {
            records.keep(block, WordsRead::default());
        }
        let mut again = WordsRead::default();
        again.m_codes.push(7);
        records.keep(99, again.clone());
        assert!(records.of(0).is_none());
        assert_eq!(records.of(99), Some(&again));
    }
}
