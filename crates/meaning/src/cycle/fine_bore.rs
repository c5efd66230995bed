//! G76 fine boring: feed in, dwell, orient the spindle, leave beside the wall, come back over the hole.

use super::{Cursor, Holes, Spindle, Step};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.advance() {
        0 => Step::Feed(holes.bottom),
        1 => Step::Dwell(holes.dwell),
        2 => Step::Spindle(Spindle::Orient),
        3 => Step::Aside,
        4 => Step::Rapid(holes.end),
        5 => Step::Back,
        6 => Step::Restart,
        _ => Step::Done,
    }
}
