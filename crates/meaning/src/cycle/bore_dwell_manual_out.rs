//! G88 boring: feed in, dwell, stop the spindle and wait for the operator's hand; CYCLE START goes out at rapid.

use super::{Cursor, Holes, Spindle, Step};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.advance() {
        0 => Step::Feed(holes.bottom),
        1 => Step::Dwell(holes.dwell),
        2 => Step::Spindle(Spindle::Stop),
        3 => Step::ByHand,
        4 => Step::Rapid(holes.end),
        5 => Step::Restart,
        _ => Step::Done,
    }
}
