//! G86 boring: feed in, stop the spindle, rapid out, start it again.

use super::{Cursor, Holes, Spindle, Step};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.advance() {
        0 => Step::Feed(holes.bottom),
        1 => Step::Spindle(Spindle::Stop),
        2 => Step::Rapid(holes.end),
        3 => Step::Restart,
        _ => Step::Done,
    }
}
