//! G31: a cut that ends where the skip signal comes. The next block starts from there: the machine is asked where it
//! stands before anything more is read.

use base::{AXES, Alarm, Condition, Point};
use dialect::SkipWithoutSignal;

use crate::block::Reading;
use crate::command::{Body, Command};
use crate::expand::Expansion;
use crate::operation::Side;
use crate::setting::Setting;

impl Reading<'_> {
    /// G31: as G01, until the signal.
    pub fn skip(&mut self) -> Result<(), Alarm> {
        self.refuse_skip_in_compensation()?;
        let mut to = [0.0; AXES];
        let moved = self.targets(&mut to)?;
        if moved.is_empty() {
            return Ok(());
        }
        self.now_known = self.now_known.or(moved);
        let missed = match self.setting.fitting.policies.skip_without_signal {
            SkipWithoutSignal::EndPoint => None,
            SkipWithoutSignal::Alarm => Some(self.one_shot_alarm(Condition::SkipSignalMissing)),
        };
        self.command.body = Body::Skip { to, feed: self.feed()?, missed };
        self.command.stops_reading = true;
        self.next.machine = to;
        Ok(())
    }

    /// The signal comes where the tool touches, which is beside the path that compensation follows.
    pub fn refuse_skip_in_compensation(&self) -> Result<(), Alarm> {
        match self.command.side {
            Side::Off => Ok(()),
            _ => Err(self.one_shot_alarm(Condition::SkipInCompensation)),
        }
    }
}

/// A move that waits for the skip signal has ended at `at` (mm and degrees): the rest of the block, and the state after
/// it, go on from there.
pub(crate) fn measured(
    setting: &Setting,
    expansion: &mut Expansion,
    command: &mut Command,
    at: &Point,
    signalled: bool,
) {
    let there = expansion.arrived(at, signalled);
    match &command.body {
        Body::Skip { .. } => {
            command.after.machine = there;
            let mut place = there;
            for axis in 0..AXES {
                place[axis] -= command.after.displacement[axis];
            }
            command.after.skip = setting.programmed(&command.after, &place);
        }
        Body::Centring(centring) => {
            command.after.machine = there;
            if let Some((axis, middle)) = expansion.middle(centring) {
                command.after.machine[axis] = middle;
            }
        }
        _ => {}
    }
}
