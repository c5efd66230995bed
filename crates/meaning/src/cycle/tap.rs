//! G84 tapping: feed in, reverse the spindle, feed out to R, forward again.
//!
//! Override is fixed at 100 % and feed hold deferred while the tap is in the hole.

use super::{Cursor, Holes, Spindle, Step};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.advance() {
        0 => Step::Tap(holes.bottom),
        1 | 4 => Step::Dwell(holes.dwell),
        2 => Step::Spindle(Spindle::Reverse),
        3 => Step::Tap(holes.r),
        5 => Step::Spindle(Spindle::Forward),
        6 => Step::Rapid(holes.end),
        _ => Step::Done,
    }
}
