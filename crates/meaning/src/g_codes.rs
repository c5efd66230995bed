//! The G codes of a block: modal ones come into force, one-shot ones are noted, their company is checked.

use base::{Alarm, Condition};
use dialect::{Meaning, Written, check_combination};

use crate::block::Reading;
use crate::unknown::letter_bit;
use crate::word::MOST_G;

impl Reading<'_> {
    /// Modal codes come into force, one-shot codes are noted, their company is checked.
    pub fn take_g_codes(&mut self) -> Result<(), Alarm> {
        let control = self.setting.control.as_ref();
        let roles = control.roles;
        if !self.words.has(b'G') {
            return Ok(());
        }
        let mut rows = [0u8; MOST_G];
        let mut places = [0usize; MOST_G];
        let mut count = 0;
        let mut restricted = false;
        for (index, word) in self.words.block.words.iter().take(self.word_count).enumerate() {
            if word.letter != b'G' {
                continue;
            }
            let row = self.g_row(word)?;
            self.words.note_g(word, row);
            if count == MOST_G {
                return Err(self.words.alarm_at(Condition::BlockTooLong, word).with([MOST_G as f64, 0.0, 0.0]));
            }
            rows[count] = row;
            places[count] = index;
            count += 1;
            let Some(code) = control.g_codes.get(usize::from(row)) else { continue };
            restricted |= !code.not_under.is_empty();
            match code.group {
                Some(group) => {
                    if usize::from(group) == roles.feed_mode && self.before.groups.0[roles.feed_mode] != row {
                        self.leave_feed();
                    }
                    self.next.groups.0[usize::from(group)] = row;
                    self.groups_written |= 1 << group;
                    // Any movement code ends a canned cycle.
                    if code.meaning.is_motion()
                        && let Some(off) = control.row_of(Meaning::CycleOff)
                    {
                        self.next.groups.0[roles.cycle] = off;
                    }
                }
                None => self.one_shot = Some((code.meaning, index)),
            }
        }
        let motion = control.in_force(&self.next.groups, roles.motion);
        let written = Written { rows: &rows[..count], motion };
        check_combination(control, &self.setting.fitting, written).map_err(|(condition, index)| {
            match self.words.block.words.get(places[index]) {
                Some(word) => self.words.alarm_at(condition, word),
                None => self.words.alarm(condition, b'G'),
            }
        })?;
        if restricted { self.check_states(&rows[..count], &places) } else { Ok(()) }
    }

    /// Refuses a code that its row forbids under another in force.
    #[cold]
    #[inline(never)]
    fn check_states(&self, rows: &[u8], places: &[usize]) -> Result<(), Alarm> {
        let control = self.control();
        let row = |row: u8| control.g_codes.get(usize::from(row));
        for (&written, &place) in rows.iter().zip(places) {
            for &other in row(written).map_or(&[][..], |code| &code.not_under) {
                let Some(code) = row(other) else { continue };
                let in_force = code.group.is_some_and(|group| self.next.groups.0[usize::from(group)] == other)
                    && !(code.meaning.length_offset().is_some() && self.is_length_ended());
                if let (true, Some(word)) = (in_force, self.words.block.words.get(place)) {
                    let values = [f64::from(code.code), 0.0, 0.0];
                    return Err(self.words.alarm_at(Condition::StateForbids, word).with(values));
                }
            }
        }
        Ok(())
    }

    /// True if H00 has ended the length offset, and nothing of it has yet to be moved away.
    fn is_length_ended(&self) -> bool {
        self.before.h == 0 && self.before.length == 0.0 && self.before.length_due == 0.0
    }

    fn g_row(&self, word: &syntax::Word) -> Result<u8, Alarm> {
        let control = self.setting.control.as_ref();
        let number = self.words.value(word)?;
        let Some(address) = control.address(b'G') else {
            return Err(self.words.alarm_at(Condition::AddressUnavailable, word));
        };
        let code = control
            .integer(address, number)
            .map_err(|(condition, values)| self.words.alarm_at(condition, word).with(values))?;
        let values = [code as f64, 0.0, 0.0];
        let Some(row) = control.g_row(code) else {
            return Err(self.words.alarm_at(Condition::GUnknown, word).with(values));
        };
        let division = control.g_codes[usize::from(row)].division;
        if !self.setting.fitting.has(division) {
            let condition = match division {
                dialect::Division::Sibling => Condition::GUnknown,
                _ => Condition::GNotFitted,
            };
            return Err(self.words.alarm_at(condition, word).with(values));
        }
        Ok(row)
    }

    /// An alarm at the word of a G code.
    fn g_alarm(&self, condition: Condition, code: i64) -> Alarm {
        let is_it = |word: &&syntax::Word| {
            word.letter == b'G' && matches!(word.value, syntax::Value::Number(number) if number.integer() == Some(code))
        };
        match self.words.block.words.iter().find(is_it) {
            Some(word) => self.words.alarm_at(condition, word).with([code as f64, 0.0, 0.0]),
            None => self.words.alarm(condition, b'G').with([code as f64, 0.0, 0.0]),
        }
    }

    /// An alarm at the block's code of a modal group.
    pub fn group_alarm(&self, condition: Condition, group: Option<usize>) -> Alarm {
        let row = group.map_or(dialect::NO_CODE, |group| self.next.groups.0[group]);
        let code = self.control().g_codes.get(usize::from(row)).map_or(0, |row| i64::from(row.code));
        self.g_alarm(condition, code)
    }

    /// An alarm at the block's one-shot code.
    pub fn one_shot_alarm(&self, condition: Condition) -> Alarm {
        match self.one_shot.and_then(|(_, index)| self.words.block.words.get(index)) {
            Some(word) => self.words.alarm_at(condition, word),
            None => self.words.alarm(condition, b'G'),
        }
    }

    /// An alarm at the block's movement code, or at its first axis word.
    pub fn motion_alarm(&self, condition: Condition) -> Alarm {
        let words = &self.words.block.words;
        let is_motion = |word: &&syntax::Word| {
            word.letter == b'G'
                && matches!(word.value, syntax::Value::Number(number) if number.integer().is_some_and(|code| {
                    let row = self.setting.control.g_row(code);
                    row.is_some_and(|row| {
                        let meaning = self.setting.control.g_codes[usize::from(row)].meaning;
                        meaning.is_motion() || meaning.is_cycle()
                    })
                }))
        };
        let is_axis = |word: &&syntax::Word| self.setting.axis_letters & letter_bit(word.letter) != 0;
        let taken = &words[..self.word_count.min(words.len())];
        match taken.iter().find(is_motion).or_else(|| taken.iter().find(is_axis)) {
            Some(word) => self.words.alarm_at(condition, word),
            None => Alarm::new(condition, self.words.place, self.words.place.block),
        }
    }
}
