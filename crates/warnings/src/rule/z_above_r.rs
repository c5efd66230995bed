//! `z-above-r`: the bottom of a hole lies above its R level.
//!
//! What: the Z of a canned cycle is higher than its R, so that the feed goes up and nothing is drilled.
//! Why: the two levels are the wrong way round: R, to which the tool goes at rapid, is then inside the work.
//! Do: exchange Z and R; in G91 remember that R counts from the initial level and Z from R, so Z is negative.
//!
//! Silent for back boring, which cuts upwards, and where Z and R are equal: the hole is only touched. Of a
//! row of holes the first is named, whose block sets the levels.

use dialect::Meaning;

use crate::finding::{At, Finding, Found};
use crate::look::{Look, plain};
use crate::rules::Rule;

pub(crate) fn look(look: &Look, found: &mut Found) {
    let Some(levels) = look.command.levels() else { return };
    let above = levels.bottom - levels.r;
    let wording = &look.command.wording;
    let sets = wording.has(b'R') || wording.has(b'Z') || wording.writes(look.control.roles.cycle);
    if levels.cycle == Meaning::BackBore || above <= 0.0 || !sets {
        return;
    }
    found.say(Rule::ZAboveR, &look.command.place, || {
        let at = [b'Z', b'R'].into_iter().find(|&letter| wording.has(letter)).map_or(At::Block, At::Letter);
        Finding::new(Rule::ZAboveR, "", look.command, at)
            .with("distance", plain(above))
            .labelled(format!("{} mm above R", plain(above)))
    });
}
