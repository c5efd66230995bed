//! G74 left-hand tapping: G84 with the spindle the other way round.

use super::{Cursor, Holes, Spindle, Step, tap};

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    tap::tapping(holes, at, [Spindle::Reverse, Spindle::Forward])
}
