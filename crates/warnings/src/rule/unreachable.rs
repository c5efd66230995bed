//! `unreachable`: blocks that no run can come to.
//!
//! What: a block stands behind an M02, M30, M99 or GOTO that nothing can pass, and no jump leads to it or past it.
//! Why: who wrote it believes that it runs: a tool is not retracted, a hole not drilled.
//! Do: take it out, or mend the jump that was to lead there.
//!
//! An end behind a block-delete sign can be passed, and an IF makes both ways possible. A block whose N any jump of the
//! text names can be reached; where a jump's number is computed every N can. Each stretch is named once, at its head.

use base::Place;

use crate::finding::{At, Finding};
use crate::hygiene::{Facts, Targets};
use crate::rules::Rule;

/// Whether anything leads to the next block.
#[derive(Default)]
pub(crate) struct Unreachable {
    is_dead: bool,
    is_said: bool,
}

impl Unreachable {
    /// A program begins: calls lead to its head.
    pub fn begin(&mut self) {
        *self = Unreachable::default();
    }

    /// True if no run can come to the next block.
    pub fn is_dead(&self) -> bool {
        self.is_dead
    }

    pub fn look(&mut self, facts: &Facts, place: Place, targets: &Targets) -> Option<Finding> {
        if facts.sequence.is_some_and(|number| targets.any_block || targets.blocks.contains(&number)) {
            self.begin();
        }
        let found = self.is_dead && !self.is_said;
        self.is_said |= found;
        self.is_dead |= facts.leaves && !facts.can_be_passed;
        found.then(|| Finding::at(Rule::Unreachable, "", u64::MAX, place, At::Block).labelled("nothing leads here"))
    }
}
