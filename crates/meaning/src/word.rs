//! A block's words by their letters, and their values as the control means them.

use std::cell::RefCell;

use base::{Alarm, Condition, Decimal, Place, Span, UnitSystem};
use dialect::{Address, Control};
use syntax::{Block, Value, Word};

use crate::record::{ReadAs, WordsRead};

/// Most G codes looked at in one block.
pub(crate) const MOST_G: usize = 64;
const NO_WORD: u8 = u8::MAX;
/// Most words that are taken in by their letters.
pub(crate) const MOST_WORDS: usize = NO_WORD as usize;

/// Why a block is not carried out now.
pub(crate) enum Refusal {
    /// The control refuses it.
    Alarm(Alarm),
    /// A jump's target must be found first; then the block is read again.
    Locate(crate::jump::Target),
}

impl From<Alarm> for Refusal {
    fn from(alarm: Alarm) -> Refusal {
        Refusal::Alarm(alarm)
    }
}

/// The words of one block by letter. Of several words of one letter the last one counts.
pub(crate) struct Words<'b> {
    pub block: &'b Block,
    pub place: Place,
    /// How many least increments a plain length counts in units of one.
    pub coarse: i64,
    /// A number without a point is the value itself, as if it were written with one.
    pub whole_units: bool,
    record: Option<&'b RefCell<WordsRead>>,
    by_letter: [u8; 26],
    present: u32,
    repeated: u32,
}

impl<'b> Words<'b> {
    /// No words of a block yet.
    pub fn new(block: &'b Block, place: Place, record: Option<&'b RefCell<WordsRead>>) -> Words<'b> {
        if let Some(record) = record {
            record.borrow_mut().clear();
        }
        Words { block, place, coarse: 1, whole_units: false, record, by_letter: [NO_WORD; 26], present: 0, repeated: 0 }
    }

    /// Takes the block's words in, so many of them (a block-delete sign may cut the rest off).
    #[inline]
    pub fn take(&mut self, words: usize) {
        let words = self.block.words.get(..words.min(MOST_WORDS)).unwrap_or_default();
        for (index, word) in words.iter().enumerate() {
            let letter = crate::unknown::letter_bit(word.letter);
            self.by_letter[usize::from(word.letter - b'A') % 26] = index as u8;
            self.repeated |= self.present & letter;
            self.present |= letter;
        }
    }

    /// Notes what a word was read as, where that is recorded; the value is in mm, degrees, seconds or a plain number.
    #[inline]
    pub fn note(&self, letter: u8, read: ReadAs, value: f64) {
        if let Some(record) = self.record {
            record.borrow_mut().note(letter, read, value);
        }
    }

    /// Notes a G code by its row.
    pub fn note_g(&self, word: &Word, row: u8) {
        if let Some(record) = self.record {
            record.borrow_mut().g_rows.push((word.extent.at, row));
        }
    }

    /// Notes the argument of a macro call.
    pub fn note_argument(&self, word: &Word, variable: usize, value: f64) {
        if let Some(record) = self.record {
            record.borrow_mut().arguments.push((word.extent.at, variable, value));
        }
    }

    /// Notes an M code.
    pub fn note_m(&self, code: u32) {
        if let Some(record) = self.record {
            record.borrow_mut().m_codes.push(code);
        }
    }

    /// True if a word of this letter stands in the block.
    pub fn has(&self, letter: u8) -> bool {
        self.present & crate::unknown::letter_bit(letter) != 0
    }

    /// True if a word of any of these letters stands in the block.
    pub fn has_any(&self, letters: u32) -> bool {
        self.present & letters != 0
    }

    /// The letters that stand in the block, one bit each.
    pub fn letters(&self) -> u32 {
        self.present
    }

    /// The letters of which several words stand in the block, one bit each.
    pub fn repeated(&self) -> u32 {
        self.repeated
    }

    /// Where in the block the word of this letter stands.
    pub fn index(&self, letter: u8) -> usize {
        usize::from(self.by_letter[usize::from(letter - b'A') % 26])
    }

    /// The word of this letter.
    pub fn word(&self, letter: u8) -> Option<&'b Word> {
        let index = self.by_letter[usize::from(letter - b'A') % 26];
        self.block.words.get(usize::from(index)).filter(|_| index != NO_WORD)
    }

    /// The number of a word; variables have become numbers before the block is given its meaning. Inlined, for what it
    /// returns is larger by far with an alarm than without.
    #[inline(always)]
    pub fn number(&self, letter: u8) -> Result<Option<Decimal>, Alarm> {
        match self.word(letter) {
            None => Ok(None),
            Some(word) => {
                let number = self.value(word)?;
                if self.record.is_some() {
                    self.note(letter, ReadAs::Number, number.to_f64());
                }
                Ok(Some(number))
            }
        }
    }

    /// A length or angle as the control takes it.
    pub fn pointed(&self, number: Decimal) -> Decimal {
        Decimal { point: number.point || self.whole_units, ..number }
    }

    /// The number of this word.
    #[inline(always)]
    pub fn value(&self, word: &Word) -> Result<Decimal, Alarm> {
        match word.value {
            Value::Number(number) => Ok(number),
            Value::Expression => Err(self.alarm_at(Condition::NotYetBuilt, word)),
            Value::Missing => Err(self.alarm_at(Condition::NumberMissing, word)),
        }
    }

    /// The place of a word.
    pub fn span(&self, word: &Word) -> Span {
        word.extent.span(self.block.start.offset)
    }

    /// An alarm about a word.
    #[cold]
    pub fn alarm_at(&self, condition: Condition, word: &Word) -> Alarm {
        Alarm::new(condition, self.place, self.span(word)).about(word.letter)
    }

    /// An alarm about the word of a letter, or about the whole block if there is none.
    pub fn alarm(&self, condition: Condition, letter: u8) -> Alarm {
        match self.word(letter) {
            Some(word) => self.alarm_at(condition, word),
            None => Alarm::new(condition, self.place, self.place.block),
        }
    }

    /// A value, noted in units of so many counts.
    fn noted(&self, letter: u8, read: ReadAs, value: f64, counts: f64) -> f64 {
        self.note(letter, read, value / counts);
        value
    }

    fn read<T>(
        &self,
        control: &Control,
        letter: u8,
        read: impl FnOnce(&Address, Decimal) -> Result<T, (Condition, [f64; 3])>,
    ) -> Result<Option<T>, Alarm> {
        let Some(number) = self.number(letter)? else { return Ok(None) };
        let Some(address) = control.address(letter) else {
            return Err(self.alarm(Condition::AddressUnavailable, letter));
        };
        read(address, number).map(Some).map_err(|(condition, values)| self.alarm(condition, letter).with(values))
    }

    /// A word as a length in nanometres.
    pub fn length(&self, control: &Control, letter: u8, units: UnitSystem) -> Result<Option<f64>, Alarm> {
        let length = self.read(control, letter, |address, number| {
            control.length(address, self.pointed(number), units, self.coarse)
        })?;
        Ok(length.map(|counts| self.noted(letter, ReadAs::Length, counts as f64, 1e6)))
    }

    /// A word as an angle in microdegrees.
    pub fn angle(&self, control: &Control, letter: u8) -> Result<Option<f64>, Alarm> {
        let angle = self.read(control, letter, |address, number| control.angle(address, self.pointed(number)))?;
        Ok(angle.map(|counts| self.noted(letter, ReadAs::Angle, counts as f64, 1e6)))
    }

    /// A word as a whole number.
    pub fn integer(&self, control: &Control, letter: u8) -> Result<Option<i64>, Alarm> {
        let whole = self.read(control, letter, |address, number| control.integer(address, number))?;
        Ok(whole.inspect(|&whole| self.note(letter, ReadAs::Whole, whole as f64)))
    }

    /// A word as a whole number that is not negative.
    pub fn count(&self, control: &Control, letter: u8) -> Result<Option<u32>, Alarm> {
        match self.integer(control, letter)? {
            None => Ok(None),
            Some(value) => match u32::try_from(value) {
                Ok(count) => Ok(Some(count)),
                Err(_) => Err(self.below(control, letter, value, 0)),
            },
        }
    }

    /// The alarm for a whole number that its address allows and that is too small for this use of it.
    pub fn below(&self, control: &Control, letter: u8, value: i64, least: i64) -> Alarm {
        let highest = control.address(letter).map_or(least, |address| address.range[1]);
        self.alarm(Condition::ValueOutOfRange, letter).with([value as f64, least as f64, highest as f64])
    }

    /// A number as the seconds of a dwell in the word of this letter.
    pub fn seconds(&self, control: &Control, letter: u8, number: Decimal) -> Result<f64, Alarm> {
        let Some(address) = control.address(b'P') else {
            return Err(self.alarm(Condition::AddressUnavailable, letter));
        };
        let seconds = match letter {
            b'X' => control.seconds(address, self.pointed(number)),
            _ => control.dwell_seconds(address, number),
        };
        match seconds {
            Ok(seconds) => Ok(self.noted(letter, ReadAs::Seconds, seconds, 1.0)),
            Err((condition, values)) => Err(self.alarm(condition, letter).with(values)),
        }
    }
}
