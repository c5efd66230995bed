//! G36, G37, G38: the middle of a hole or slot, found by the skip signal. The words are an assumption, so the option is
//! off unless it is fitted.
//!
//! From where the tool stands: at feed F by the distance I along X (J along Y) until the signal, back by the same
//! distance to the other side until the signal, then in rapid to the mean of both. G36 does so along X and then Y, G37
//! along X, G38 along Y. No signal within the distance is an alarm.

use base::{Alarm, Condition};
use dialect::Meaning;

use crate::block::Reading;
use crate::command::Body;
use crate::operation::Feed;

/// The work of one centring block.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Centring {
    /// Axis and distance to each side, counts, one after the other.
    pub along: [Option<(u8, f64)>; 2],
    pub feed: Feed,
    /// What is raised where the signal does not come.
    pub missed: Alarm,
}

impl Reading<'_> {
    /// G36, G37, G38.
    pub fn centring(&mut self, code: Meaning) -> Result<(), Alarm> {
        self.refuse_skip_in_compensation()?;
        let x = matches!(code, Meaning::CentringXy | Meaning::CentringX);
        let y = matches!(code, Meaning::CentringXy | Meaning::CentringY);
        let along = [
            if x { Some(self.centring_along(b'X', b'I')?) } else { None },
            if y { Some(self.centring_along(b'Y', b'J')?) } else { None },
        ];
        for (axis, _) in along.iter().flatten() {
            self.now_known.add(usize::from(*axis));
        }
        let missed = self.one_shot_alarm(Condition::CentringSignalMissing);
        self.command.body = Body::Centring(Centring { along, feed: self.feed()?, missed });
        self.command.stops_reading = true;
        Ok(())
    }

    fn centring_along(&self, letter: u8, limit: u8) -> Result<(u8, f64), Alarm> {
        let Some(axis) = self.setting.facts.axis(letter) else {
            return Err(self.one_shot_alarm(Condition::AddressUnavailable));
        };
        match self.words.length(self.control(), limit, self.units)? {
            Some(distance) if distance != 0.0 => Ok((axis as u8, self.next.transform.distance(axis, distance))),
            Some(_) => Err(self.words.alarm(Condition::CentringLimitMissing, limit)),
            None => Err(self.one_shot_alarm(Condition::CentringLimitMissing)),
        }
    }
}
