//! G85 boring and reaming: feed in, feed out to R.

use super::{Cursor, Holes, Step};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.advance() {
        0 => Step::Feed(holes.bottom),
        1 => Step::Feed(holes.r),
        2 => Step::Rapid(holes.end),
        _ => Step::Done,
    }
}
