//! G87 boring: feed in, stop the spindle, out at rapid or by hand (policy `g87-return`), start the spindle again.

use super::{Cursor, Holes, Spindle, Step};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.advance() {
        0 => Step::Feed(holes.bottom),
        1 => Step::Spindle(Spindle::Stop),
        2 => Step::ByHand,
        3 => Step::Rapid(holes.end),
        4 => Step::Restart,
        _ => Step::Done,
    }
}
