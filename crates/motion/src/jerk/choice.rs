//! Whether it is sooner to stand in a sharp corner than to pass it.
//!
//! Moves from rest to rest are driven at the optimum, runs nearly so: around a corner that is passed at the speed `c` a run
//! keeps to `c` for a window, and changes speed with the acceleration that suits its window. After a stop, between
//! lines, both are estimated for the line before the corner and for half of the one behind it.

use super::bounds::Line;
use crate::scurve::SCurve;

/// A line that is longer than so many times the way on which a run slows down for the corner stands for itself.
const LONG: f64 = 4.0;

/// A line beside the corner: what can be driven on it, and its length.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Beside {
    /// Its speed, acceleration and jerk.
    pub line: Line,
    /// Its length, mm.
    pub length: f64,
}

/// True if the axes had better stand between two lines, the first of which begins at rest; `passed` is the speed at
/// which the corner can be passed, `width` that of its hat.
pub fn stands(before: &Beside, behind: &Beside, passed: f64, width: f64, window: f64) -> bool {
    // Between short lines there are many corners, and one beginning.
    let slow = passed * window / 2.0 + width;
    if slow * LONG > before.length.min(behind.length) {
        return false;
    }
    let stopping = before.rest_to_rest() + behind.rest_to_rest() / 2.0;
    let [first, second] = [before, behind].map(|beside| beside.half_from_corner(passed, width, window));
    stopping < before.half_from_rest(window) + first + second
}

impl Beside {
    fn rest_to_rest(&self) -> f64 {
        let Line { speed, acceleration, jerk } = self.line;
        SCurve::new(self.length, speed, acceleration, jerk).seconds()
    }

    /// The acceleration in a run.
    fn push(&self, window: f64) -> f64 {
        self.line.acceleration.min(self.line.jerk * window / 2.0)
    }

    fn half_from_rest(&self, window: f64) -> f64 {
        window / 2.0 + self.rising(0.0, self.length / 2.0, window)
    }

    fn half_from_corner(&self, passed: f64, width: f64, window: f64) -> f64 {
        let slow = passed.min(self.line.speed);
        let near = (slow * window / 2.0 + width).min(self.length / 2.0);
        near / slow + self.rising(slow, self.length / 2.0 - near, window)
    }

    /// The time for a way on which the speed rises from one to the line's, if it can.
    fn rising(&self, from: f64, way: f64, window: f64) -> f64 {
        let push = self.push(window);
        let top = (from * from + 2.0 * push * way).sqrt().min(self.line.speed);
        (top - from) / push + (way - (top * top - from * from) / (2.0 * push)).max(0.0) / top.max(f64::MIN_POSITIVE)
    }
}
