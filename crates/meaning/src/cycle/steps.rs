//! The steps of a hole, one after the other as the control's table lists them.

use dialect::CycleStep;

use super::{Cursor, Holes, Spindle, Step};

// Phases of a step that cuts in pecks.
const FIRST_CUT: u8 = 0;
const OUT: u8 = 1;
const BACK: u8 = 2;
const NEXT_CUT: u8 = 3;

/// The next step in a hole.
pub(crate) fn next_step(holes: &Holes, at: &mut Cursor) -> Step {
    let step = holes.steps.get(usize::from(at.step)).copied().unwrap_or_default();
    if matches!(step, CycleStep::DeepPecks | CycleStep::ChipPecks) {
        return peck(holes, at, step == CycleStep::DeepPecks);
    }
    at.step = at.step.saturating_add(1);
    match step {
        CycleStep::FeedBottom => Step::Feed(holes.bottom),
        CycleStep::FeedR => Step::Feed(holes.r),
        CycleStep::TapBottom => Step::Tap(holes.bottom),
        CycleStep::TapR => Step::Tap(holes.r),
        CycleStep::RapidR => Step::Rapid(holes.r),
        CycleStep::RapidEnd => Step::Rapid(holes.end),
        CycleStep::Dwell => Step::Dwell(holes.dwell),
        CycleStep::StartForward | CycleStep::StartReverse => Step::Start,
        CycleStep::Forward => Step::Spindle(Spindle::Forward),
        CycleStep::Reverse => Step::Spindle(Spindle::Reverse),
        CycleStep::Stop => Step::Spindle(Spindle::Stop),
        CycleStep::Orient => Step::Spindle(Spindle::Orient),
        CycleStep::Restart => Step::Restart,
        CycleStep::Aside => Step::Aside,
        CycleStep::Back => Step::Back,
        CycleStep::ByHand => Step::ByHand,
        CycleStep::Done | CycleStep::DeepPecks | CycleStep::ChipPecks => Step::Done,
    }
}

/// Cuts of Q. Between two of them the tool leaves the hole and comes back at rapid, or only breaks the chip.
fn peck(holes: &Holes, at: &mut Cursor, deep: bool) -> Step {
    match at.peck {
        OUT if deep => {
            at.peck = BACK;
            Step::Rapid(holes.r)
        }
        OUT => {
            at.peck = NEXT_CUT;
            Step::Rapid(at.depth - holes.down() * holes.clearance)
        }
        BACK => {
            // A peck shallower than the clearance would lead back above R.
            let above = at.depth - holes.down() * holes.clearance;
            at.peck = NEXT_CUT;
            Step::Rapid(if (above - holes.r) * holes.down() < 0.0 { holes.r } else { above })
        }
        phase => {
            let from = if phase == FIRST_CUT { holes.r } else { at.depth };
            if at.cut(holes, from) {
                (at.step, at.peck) = (at.step.saturating_add(1), FIRST_CUT);
            } else {
                at.peck = OUT;
            }
            Step::Feed(at.depth)
        }
    }
}
