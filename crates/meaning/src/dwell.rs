//! G04: a pause.

use base::{Alarm, Condition};

use crate::block::Reading;
use crate::command::Body;
use crate::operation::Dwell;
use crate::record::ReadAs;

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
        let (number, address) = match (self.words.number(letter)?, control.address(b'P')) {
            (Some(number), Some(address)) => (number, address),
            _ => {
                self.command.body = Body::Dwell(Dwell::Seconds(0.0));
                return Ok(());
            }
        };
        let unit = self.setting.fitting.parameter_if_any(control.feeds.dwell) as u8;
        let dwell = if unit & IN_TURNS != 0 && self.is_per_revolution() {
            control
                .dwell_turns(address, number, unit & WHOLE_TURNS != 0)
                .map(|turns| Dwell::Revolutions { turns, rpm: 0.0 })
        } else {
            control.dwell_seconds(address, number).map(Dwell::Seconds)
        };
        let mut dwell = dwell.map_err(|(condition, values)| self.words.alarm(condition, letter).with(values))?;
        match dwell {
            Dwell::Seconds(seconds) => self.words.note(letter, ReadAs::Seconds, seconds),
            Dwell::Revolutions { turns, .. } => self.words.note(letter, ReadAs::Turns, turns),
        }
        if let Dwell::Revolutions { rpm, .. } = &mut dwell {
            *rpm = self.spindle_rpm().map_err(|condition| self.words.alarm(condition, letter))?;
        }
        self.command.body = Body::Dwell(dwell);
        Ok(())
    }
}
