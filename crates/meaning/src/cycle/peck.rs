//! G83 deep-hole drilling: cut Q, out to R, back to the clearance above the last depth, and again.

use super::{Cursor, Holes, Step};

const OUT: u32 = 1;
const BACK: u32 = 2;
const LAST: u32 = 3;
const DONE: u32 = 4;
const CUT: u32 = 5;

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    let down = if holes.bottom < holes.r { -1.0 } else { 1.0 };
    let deeper = |depth: f64| {
        let next = depth + down * holes.peck;
        if (next - holes.bottom) * down >= 0.0 { holes.bottom } else { next }
    };
    match at.phase {
        0 => {
            at.depth = deeper(holes.r);
            at.phase = if at.depth == holes.bottom { LAST } else { OUT };
            Step::Feed(at.depth)
        }
        OUT => {
            at.phase = BACK;
            Step::Rapid(holes.r)
        }
        BACK => {
            // A peck shallower than the clearance would lead back above R.
            let above = at.depth - down * holes.clearance;
            at.phase = CUT;
            Step::Rapid(if (above - holes.r) * down < 0.0 { holes.r } else { above })
        }
        CUT => {
            at.depth = deeper(at.depth);
            at.phase = if at.depth == holes.bottom { LAST } else { OUT };
            Step::Feed(at.depth)
        }
        LAST => {
            at.phase = DONE;
            Step::Rapid(holes.end)
        }
        _ => Step::Done,
    }
}
