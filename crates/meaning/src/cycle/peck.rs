//! G83 deep-hole drilling: cut Q, out to R, back to the clearance above the last depth, and again.

use super::{Cursor, Holes, Step};

const CUT: u32 = 0;
const OUT: u32 = 1;
const BACK: u32 = 2;
const LAST: u32 = 3;
const DONE: u32 = 4;
const NEXT_CUT: u32 = 5;

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.phase {
        CUT | NEXT_CUT => {
            let from = if at.phase == CUT { holes.r } else { at.depth };
            at.phase = if at.cut(holes, from) { LAST } else { OUT };
            Step::Feed(at.depth)
        }
        OUT => {
            at.phase = BACK;
            Step::Rapid(holes.r)
        }
        BACK => {
            // A peck shallower than the clearance would lead back above R.
            let down = holes.down();
            let above = at.depth - down * holes.clearance;
            at.phase = NEXT_CUT;
            Step::Rapid(if (above - holes.r) * down < 0.0 { holes.r } else { above })
        }
        LAST => {
            at.phase = DONE;
            Step::Rapid(holes.end)
        }
        _ => Step::Done,
    }
}
