//! G04: a pause.

use base::{Alarm, Condition, Decimal};
use dialect::{DwellVariable, PointRule};

use crate::block::Reading;
use crate::command::Body;
use crate::operation::Dwell;
use crate::record::ReadAs;
use crate::user_macro::number::with_point;

/// Bits of the parameter for dwells under feed per revolution: they count turns; a plain number counts whole turns.
const IN_TURNS: u8 = 1;
const WHOLE_TURNS: u8 = 2;

impl Reading<'_> {
    /// G04: P in milliseconds without a point, seconds with one; X likewise where that is fitted. Under feed per
    /// revolution a parameter makes them turns of the spindle.
    pub fn dwell(&mut self) -> Result<(), Alarm> {
        let control = self.setting.control.as_ref();
        if self.words.has(b'X') && !self.setting.fitting.options.dwell_x {
            return Err(self.words.alarm(Condition::AddressUnavailable, b'X'));
        }
        let letter = if self.words.has(b'P') { b'P' } else { b'X' };
        let (number, address) = match (self.dwell_number(letter)?, control.address(b'P')) {
            (Some(number), Some(address)) => (number, address),
            _ => {
                self.command.body = Body::Dwell(Dwell::Seconds(0.0));
                return Ok(());
            }
        };
        let unit = self.setting.fitting.parameter_if_any(control.feeds.dwell) as u8;
        let mut dwell = if unit & IN_TURNS != 0 && self.is_per_revolution() {
            let turns = control.dwell_turns(address, number, unit & WHOLE_TURNS != 0);
            let turns = turns.map_err(|(condition, values)| self.words.alarm(condition, letter).with(values))?;
            self.words.note(letter, ReadAs::Turns, turns);
            Dwell::Revolutions { turns, rpm: 0.0 }
        } else {
            Dwell::Seconds(self.words.seconds(control, letter, number)?)
        };
        if let Dwell::Revolutions { rpm, .. } = &mut dwell {
            *rpm = self.spindle_rpm().map_err(|condition| self.words.alarm(condition, letter))?;
        }
        self.command.body = Body::Dwell(dwell);
        Ok(())
    }

    /// The number of a dwell's word; from a variable as if written with a point (policy `dwell-variable`).
    pub fn dwell_number(&self, letter: u8) -> Result<Option<Decimal>, Alarm> {
        let number = self.words.number(letter)?;
        let value = self.word_values.get(self.words.index(letter)).filter(|value| !value.is_nan());
        let in_seconds = self.setting.fitting.policies.dwell_variable == DwellVariable::Seconds
            && self.control().address(letter).is_some_and(|address| address.point != PointRule::Whole);
        Ok(match value {
            Some(&value) if in_seconds => Some(with_point(value)),
            _ => number,
        })
    }
}
