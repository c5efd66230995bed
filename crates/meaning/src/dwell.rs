//! G04: a pause.

use base::Alarm;

use crate::block::Reading;
use crate::command::Body;
use crate::operation::Dwell;

impl Reading<'_> {
    /// G04: P in milliseconds without a point, seconds with one; X likewise where that is fitted.
    pub fn dwell(&mut self) -> Result<(), Alarm> {
        let control = self.control();
        let letter = if self.words.has(b'P') || !self.setting.fitting.options.dwell_x { b'P' } else { b'X' };
        let seconds = match letter {
            b'P' => self.words.seconds(control, b'P')?,
            _ => match (self.words.number(b'X')?, control.address(b'P')) {
                (Some(number), Some(address)) => Some(
                    control
                        .dwell_seconds(address, number)
                        .map_err(|(condition, values)| self.words.alarm(condition, b'X').with(values))?,
                ),
                _ => None,
            },
        };
        self.command.body = Body::Dwell(Dwell::Seconds(seconds.unwrap_or(0.0)));
        Ok(())
    }
}
