//! Checking on after a refused block: what it names is unknown from then on.

use base::AxisSet;
use dialect::Meaning;
use syntax::Value;

use super::Reader;
use crate::unknown::{Unknown, letter_bit};

impl Reader {
    /// The group of a G word, if it is a modal code of this control.
    fn group_of(&self, word: &syntax::Word) -> Option<u8> {
        let Value::Number(number) = word.value else { return None };
        let row = self.setting.control.g_row(number.integer()?).filter(|_| word.letter == b'G')?;
        self.setting.control.g_codes.get(usize::from(row))?.group
    }

    /// What is unknown in the block at hand: what it writes itself is not.
    pub(super) fn unknown_in_block(&self) -> Unknown {
        let mut unknown = self.state.unknown;
        if !unknown.is_nothing() {
            for word in &self.block.words {
                unknown.words &= !letter_bit(word.letter);
                if let Some(group) = self.group_of(word) {
                    unknown.groups &= !(1 << group);
                }
            }
        }
        unknown
    }

    /// True if the block at hand has a code with this meaning.
    fn has_code(&self, meaning: Meaning) -> bool {
        self.block.words.iter().any(|word| {
            let Value::Number(number) = word.value else { return false };
            let row = number.integer().and_then(|code| self.setting.control.g_row(code));
            let code = row.and_then(|row| self.setting.control.g_codes.get(usize::from(row)));
            word.letter == b'G' && code.is_some_and(|code| code.meaning == meaning)
        })
    }

    pub(super) fn forget_what_it_names(&mut self) {
        let mut unknown = self.state.unknown;
        for word in &self.block.words {
            if let Some(axis) = self.setting.facts.axis(word.letter) {
                unknown.axes.add(axis);
            }
            match self.group_of(word) {
                Some(group) => unknown.groups |= 1 << group,
                None => unknown.words |= letter_bit(word.letter),
            }
        }
        let shifts = self.setting.control.functions.work.shifts_all && self.has_code(Meaning::SetCoordinates);
        unknown.memory |= shifts || self.has_code(Meaning::WriteData) || self.has_code(Meaning::LocalCoordinates);
        if self.has_code(Meaning::SetCoordinates) {
            let named = self.block.words.iter().filter_map(|word| self.setting.facts.axis(word.letter));
            named.for_each(|axis| unknown.origins.add(axis));
            unknown.groups |= 1 << self.setting.control.roles.work;
        }
        self.state.unknown = unknown;
    }

    /// A later stage refused a block: these axes are unknown.
    pub fn forget_axes(&mut self, axes: AxisSet) {
        self.state.unknown.axes = self.state.unknown.axes.or(axes);
    }
}
