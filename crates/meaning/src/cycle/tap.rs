//! G84 tapping: feed in, reverse the spindle, feed out to R, forward again.
//!
//! Override is fixed at 100 % and feed hold deferred while the tap is in the hole.

use super::{Cursor, Holes, Spindle, Step};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    tapping(holes, at, [Spindle::Forward, Spindle::Reverse])
}

/// Tapping with the spindle's directions into the hole and out of it.
pub(super) fn tapping(holes: &Holes, at: &mut Cursor, [into, out]: [Spindle; 2]) -> Step {
    match at.advance() {
        0 => Step::Tap(holes.bottom),
        1 | 4 => Step::Dwell(holes.dwell),
        2 => Step::Spindle(out),
        3 => Step::Tap(holes.r),
        5 => Step::Spindle(into),
        6 => Step::Rapid(holes.end),
        _ => Step::Done,
    }
}
