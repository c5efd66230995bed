//! How a block is written, as far as a look at the program (a check, an explanation) wants to know: a few bit sets,
//! taken on the way, so that reading costs no more. Where the words stand is in the text.

use dialect::Meaning;
use syntax::{Value, Word};

use crate::unknown::letter_bit;

/// How a block is written. Letters and groups are bit sets: bit 0 is the letter A, bit 0 the first group.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Wording {
    /// The letters that stand in it.
    pub letters: u32,
    /// Letters with a number, not a variable, that has a decimal point.
    pub pointed: u32,
    /// Letters with a number, not a variable, that has none and is not zero.
    pub plain: u32,
    /// The modal groups whose codes stand in it.
    pub groups: u32,
    /// The one-shot code.
    pub one_shot: Option<Meaning>,
}

impl Wording {
    /// True if a word of this letter stands in the block.
    pub const fn has(&self, letter: u8) -> bool {
        self.letters & letter_bit(letter) != 0
    }

    /// True if the code of this group stands in the block.
    pub const fn writes(&self, group: usize) -> bool {
        self.groups & (1 << group) != 0
    }

    /// Takes in the words that count; `values` are those of variables in their places, blank where none stands, or
    /// nothing at all if none stands anywhere.
    pub(crate) fn take(&mut self, words: &[Word], values: &[f64]) {
        for (index, word) in words.iter().enumerate() {
            let bit = letter_bit(word.letter);
            self.letters |= bit;
            let is_written = values.get(index).is_none_or(|value| value.is_nan());
            if let (Value::Number(number), true) = (word.value, is_written) {
                if number.point {
                    self.pointed |= bit;
                } else if !number.is_zero() {
                    self.plain |= bit;
                }
            }
        }
    }
}
