//! Words with variables: their values become numbers before the block is given its meaning.

use std::rc::Rc;

use base::{Condition, Decimal};
use dialect::PointRule;
use syntax::Value;

use super::evaluation::evaluate;
use super::number::{whole, with_point};
use super::trouble::Trouble;
use super::variables::BLANK;
use crate::reader::Reader;

impl Reader {
    /// Puts numbers in the place of the variables of the block at hand; a word with a blank is not there at all.
    pub(crate) fn resolve_words(&mut self, line: u32) -> Result<(), Trouble> {
        self.word_values.clear();
        let Some(line) = self.store.line(line).map(Rc::clone) else { return Ok(()) };
        if !line.has_runs {
            return Ok(());
        }
        let (mut kept, words) = (0, self.block.words.len());
        for index in 0..words {
            let mut word = self.block.words[index];
            let mut value = BLANK;
            if let Some(run) = self.store.run_of(&line, index) {
                if matches!(word.letter, b'N' | b'O') {
                    return Err(Trouble::at(Condition::MacroVariableNotHere, word.extent));
                }
                value = evaluate(&self.store.code, run, &self.source())?;
                if value.is_nan() {
                    // Block-delete signs behind it stand before one word less.
                    let behind = self.block.skips.iter_mut().filter(|skip| usize::from(skip.first_word) > kept);
                    behind.for_each(|skip| skip.first_word -= 1);
                    continue;
                }
                word.value = Value::Number(self.number_for(word.letter, value));
            }
            self.block.words[kept] = word;
            self.word_values.push(value);
            kept += 1;
        }
        self.block.words.truncate(kept);
        Ok(())
    }

    /// A value as the number of a word: rounded to what its address counts, as if written with a point where one may be.
    fn number_for(&self, letter: u8, value: f64) -> Decimal {
        match self.setting.control.address(letter).map(|address| address.point) {
            // Where P is a dwell, what reads it goes back to the value.
            Some(PointRule::No | PointRule::Dwell | PointRule::Whole) => whole(value),
            _ => with_point(value),
        }
    }
}
