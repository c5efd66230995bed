//! G50 and G51: everything larger or smaller about a point.
//!
//! G51 X Y Z P (I J K in place of X Y Z): P counts thousandths, 0.001 to 99.999. The centre is named in program
//! coordinates whatever G90 or G91 says; along an axis that is not named it is the present point.

use base::{Alarm, AxisSet, Condition};
use dialect::{Meaning, ScalingCompany};

use crate::block::Reading;
use crate::unknown::letter_bit;

/// The older letters of the centre, with the axis each belongs to.
const OLD_LETTERS: [(u8, u8); 3] = [(b'X', b'I'), (b'Y', b'J'), (b'Z', b'K')];

impl Reading<'_> {
    /// The block's G50 or G51, if it has one.
    pub fn scaling_code(&self) -> Option<Meaning> {
        let group = self.control().roles.scaling?;
        if self.groups_written & (1 << group) == 0 {
            return None;
        }
        self.control().in_force(&self.next.groups, group)
    }

    /// Turns scaling on or off; true if the block's words were the centre and nothing moves.
    pub fn scaling(&mut self, code: Meaning) -> Result<bool, Alarm> {
        if self.setting.fitting.policies.scaling_company == ScalingCompany::Alone {
            self.refuse_company()?;
        }
        if code != Meaning::ScalingOn {
            self.next.transform.scaled = AxisSet::NONE;
            return Ok(false);
        }
        let Some(thousandths) = self.words.count(self.control(), b'P')? else {
            return Err(self.group_alarm(Condition::ScalingFactorMissing, self.control().roles.scaling));
        };
        if thousandths == 0 {
            return Err(self.words.below(self.control(), b'P', 0, 1));
        }
        self.next.transform.scaled = AxisSet::NONE;
        let mut scaled = AxisSet::NONE;
        for (axis, facts) in self.setting.facts.axes.iter().enumerate().take(base::AXES) {
            // Degrees are no size.
            if facts.rotary {
                continue;
            }
            scaled.add(axis);
            let old = OLD_LETTERS.iter().find(|(letter, _)| *letter == facts.letter).map(|&(_, old)| old);
            let here = self.setting.programmed(self.next, axis, self.here(axis));
            let named = self.words.has(facts.letter);
            let center = match old {
                _ if named => Some(self.axis_word(axis)?.0),
                Some(old) => self.words.length(self.control(), old, self.units)?,
                None => None,
            };
            self.next.transform.center[axis] = center.unwrap_or(here);
        }
        self.next.transform.factor = f64::from(thousandths) / 1000.0;
        self.next.transform.scaled = scaled;
        Ok(true)
    }

    /// G50 and G51 stand alone: no other G code beside them, and no way to go beside G50.
    fn refuse_company(&self) -> Result<(), Alarm> {
        let group = self.control().roles.scaling;
        let taken = || self.words.block.words.iter().take(self.word_count);
        let in_group = |word: &syntax::Word| {
            let syntax::Value::Number(number) = word.value else { return false };
            let row = number.integer().and_then(|code| self.control().g_row(code));
            let row = row.and_then(|row| self.control().g_codes.get(usize::from(row)));
            row.is_some_and(|row| row.group.map(usize::from) == group)
        };
        if let Some(other) = taken().find(|word| word.letter == b'G' && !in_group(word)) {
            return Err(self.words.alarm_at(Condition::ScalingNotAlone, other));
        }
        let off = self.scaling_code() != Some(Meaning::ScalingOn);
        let is_axis = |word: &&syntax::Word| self.setting.axis_letters & letter_bit(word.letter) != 0;
        match taken().find(is_axis) {
            Some(word) if off => Err(self.words.alarm_at(Condition::ScalingNotAlone, word)),
            _ => Ok(()),
        }
    }
}
