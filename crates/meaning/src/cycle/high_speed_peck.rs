//! G73 high-speed peck drilling: cut Q, back off by the clearance to break the chip, cut on from there.

use super::{Cursor, Holes, Step};

const CUT: u32 = 0;
const BACK_OFF: u32 = 1;
const DWELL: u32 = 2;
const OUT: u32 = 3;
const DONE: u32 = 4;
const NEXT_CUT: u32 = 5;

pub(super) fn step(holes: &Holes, at: &mut Cursor) -> Step {
    match at.phase {
        CUT | NEXT_CUT => {
            let from = if at.phase == CUT { holes.r } else { at.depth };
            at.phase = if at.cut(holes, from) { DWELL } else { BACK_OFF };
            Step::Feed(at.depth)
        }
        BACK_OFF => {
            at.phase = NEXT_CUT;
            Step::Rapid(at.depth - holes.down() * holes.clearance)
        }
        DWELL => {
            at.phase = OUT;
            Step::Dwell(holes.dwell)
        }
        OUT => {
            at.phase = DONE;
            Step::Rapid(holes.end)
        }
        _ => Step::Done,
    }
}
