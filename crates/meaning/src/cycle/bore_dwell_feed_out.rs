//! G89 boring: feed in, dwell, feed out to R.

use super::{Cursor, Holes, Step};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.advance() {
        0 => Step::Feed(holes.bottom),
        1 => Step::Dwell(holes.dwell),
        2 => Step::Feed(holes.r),
        3 => Step::Rapid(holes.end),
        _ => Step::Done,
    }
}
