//! G81 drilling: feed to the bottom, rapid out.

use super::{Cursor, Holes, Step};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.advance() {
        0 => Step::Feed(holes.bottom),
        1 => Step::Rapid(holes.end),
        _ => Step::Done,
    }
}
