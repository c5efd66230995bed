//! `boring-code-differs`: a boring cycle that means another thing on other controls.
//!
//! What: G77 and G87. One is back boring here, the other elsewhere.
//! Why: back boring enters the bore off centre and cuts upwards; the other cycle bores down. Run on the wrong control
//! the bar meets the wall of the hole.
//! Do: make sure that the program was written for this control, then say `(allow: boring-code-differs)` in the block.
//!
//! Said once a program for each of the two, and only for controls whose own tables list the rule.

use dialect::Meaning;

use crate::finding::{At, Finding, Found};
use crate::look::Look;
use crate::rules::Rule;

/// What has been said.
#[derive(Default)]
pub(crate) struct BoringCodeDiffers {
    said: [bool; 2],
}

impl BoringCodeDiffers {
    pub fn look(&mut self, look: &Look, found: &mut Found) {
        let cycle = look.control.roles.cycle;
        let (index, shade) = match look.in_force(cycle) {
            Some(Meaning::BackBore) => (0, "back"),
            Some(Meaning::BoreManualOut) => (1, "down"),
            _ => return,
        };
        if self.said[index] || !look.command.wording.writes(cycle) {
            return;
        }
        self.said[index] = true;
        found.say(Rule::BoringCodeDiffers, &look.command.place, || {
            Finding::new(Rule::BoringCodeDiffers, shade, look.command, At::G(look.code_in(cycle)))
                .with("code", look.code_name(cycle))
        });
    }
}
