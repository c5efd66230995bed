//! The drives of a virtual machine: they count what they are sent.

use base::{AXES, Point, Seconds};
use motion::Setpoint;

/// What the drives have been sent: increments, one a servo period and axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Drives {
    increment: f64,
    last: [i64; AXES],
    sum: [i64; AXES],
    largest: [i64; AXES],
    periods: u64,
    time: Seconds,
}

impl Drives {
    /// Drives that stand here and move in steps of `increment`, mm or degrees.
    pub fn at(position: &Point, increment: f64) -> Drives {
        let last = position.map(|at| (at / increment).round() as i64);
        let nothing = [0; AXES];
        Drives { increment, last, sum: last, largest: nothing, periods: 0, time: Seconds(0.0) }
    }

    pub(crate) fn follow(&mut self, time: Seconds, setpoint: &Setpoint) {
        self.periods += 1;
        self.time = time;
        for axis in 0..AXES {
            let at = (setpoint.position[axis] / self.increment).round() as i64;
            let sent = at - self.last[axis];
            self.sum[axis] += sent;
            self.largest[axis] = self.largest[axis].max(sent.abs());
            self.last[axis] = at;
        }
    }

    /// Where the drives are: the place they stood at and every increment since, in increments.
    pub fn counts(&self) -> &[i64; AXES] {
        &self.sum
    }

    /// The largest increment that each one was sent.
    pub fn largest(&self) -> &[i64; AXES] {
        &self.largest
    }

    /// How many setpoints there were.
    pub fn periods(&self) -> u64 {
        self.periods
    }

    /// When the last one held.
    pub fn time(&self) -> Seconds {
        self.time
    }
}
