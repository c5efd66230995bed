//! G77 back boring: through the hole beside its wall to R, which lies below, and up to Z with the spindle turning.
//!
//! The end is the initial level, whatever the return level in force.

use super::{Cursor, Holes, Spindle, Step};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.advance() {
        0 | 7 => Step::Spindle(Spindle::Orient),
        1 | 8 => Step::Aside,
        2 => Step::Rapid(holes.r),
        3 | 10 => Step::Back,
        4 | 11 => Step::Restart,
        5 => Step::Feed(holes.bottom),
        6 => Step::Dwell(holes.dwell),
        9 => Step::Rapid(holes.end),
        _ => Step::Done,
    }
}
