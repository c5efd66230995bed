//! `r-above-approach`: the R level of a canned cycle lies above the tool.
//!
//! What: before the hole the tool stands lower than R, so that the cycle's approach goes up.
//! Why: the tool has come across the work at a height that the program takes for unsafe: R and the initial level are
//! the wrong way round, or a length offset or a Z word is missing.
//! Do: bring Z above R before the cycle begins; with G99 the tool stays at the R level from hole to hole.
//!
//! Silent for back boring, which goes down to R past the work. Of a row of holes the first is named, whose block sets R.

use dialect::Meaning;

use crate::finding::{At, Finding, Found};
use crate::look::{Look, plain};
use crate::rules::Rule;

pub(crate) fn look(look: &Look, found: &mut Found) {
    let Some(levels) = look.command.levels() else { return };
    let above = levels.r - levels.from;
    let wording = &look.command.wording;
    let sets = wording.has(b'R') || wording.writes(look.control.roles.cycle);
    if levels.cycle == Meaning::BackBore || above <= 0.0 || !sets {
        return;
    }
    found.say(Rule::RAboveApproach, &look.command.place, || {
        let at = if wording.has(b'R') { At::Letter(b'R') } else { At::Block };
        Finding::new(Rule::RAboveApproach, "", look.command, at)
            .with("distance", plain(above))
            .labelled(format!("{} mm above the tool", plain(above)))
    });
}
