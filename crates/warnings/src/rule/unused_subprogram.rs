//! `unused-subprogram`: a subprogram that nothing calls.
//!
//! What: a program of this text ends with M99, and no block of the text calls its number.
//! Why: the call that was meant calls another number, and its cuts are missing.
//! Do: mend the call, or take the subprogram out.
//!
//! On a control whose subprograms stand in the main program's own text, from a block number to an M99: that nothing calls
//! such a stretch behind the end is said in place of `unreachable`.
//!
//! Silent for a program that ends with M02 or M30: it is a main program that waits for its turn. Silent for the text's
//! first program, and where a call's number is computed.

use base::Place;

use crate::finding::{At, Finding};
use crate::hygiene::{Facts, Targets};
use crate::rules::Rule;

/// A program of the text, while it is read.
#[derive(Default)]
pub(crate) struct UnusedSubprogram {
    number: Option<i64>,
    head: Place,
    returns: bool,
    ends: bool,
}

impl UnusedSubprogram {
    /// A program begins; `number` is its own unless it is the text's first.
    pub fn begin(&mut self, number: Option<i64>, head: Place) {
        *self = UnusedSubprogram { number, head, ..UnusedSubprogram::default() };
    }

    /// A block that can be reached.
    pub fn look(&mut self, facts: &Facts) {
        self.returns |= facts.returns;
        self.ends |= facts.ends;
    }

    /// The program is over.
    pub fn end(&self, targets: &Targets) -> Option<Finding> {
        let number = self.number.filter(|_| self.returns && !self.ends)?;
        if targets.any_program || targets.programs.contains(&number) {
            return None;
        }
        let finding = Finding::at(Rule::UnusedSubprogram, "", u64::MAX, self.head, At::Letter(b'O'));
        Some(finding.with("number", format!("O{number}")).labelled("never called"))
    }
}

/// A stretch of the text that nothing leads to, and that may be a subprogram of the main program.
#[derive(Default)]
pub(crate) struct UnusedSection {
    /// Subprograms can stand in the main program's text.
    has_calls: bool,
    /// What is said of the stretch if it is none, and the number at its head.
    open: Option<(Finding, i64)>,
}

impl UnusedSection {
    pub fn new(has_calls: bool) -> UnusedSection {
        UnusedSection { has_calls, open: None }
    }

    /// A stretch begins that nothing leads to; gives back what is said of it if it cannot be a subprogram.
    pub fn begin(&mut self, facts: &Facts, finding: Finding) -> Option<Finding> {
        match facts.sequence.filter(|_| self.has_calls) {
            None => Some(finding),
            Some(number) => {
                self.open = Some((finding, number));
                None
            }
        }
    }

    /// A block of the text: the stretch ends with M99, with something else, or where a jump leads into it.
    pub fn look(&mut self, facts: &Facts, is_dead: bool) -> Option<Finding> {
        let (finding, number) = self.open.take_if(|_| facts.leaves || !is_dead)?;
        if !facts.returns || !is_dead {
            return Some(finding);
        }
        let finding = Finding::at(Rule::UnusedSubprogram, "", u64::MAX, finding.place, At::Letter(b'N'));
        Some(finding.with("number", format!("N{number}")).labelled("never called"))
    }

    /// The text is over.
    pub fn end(&mut self) -> Option<Finding> {
        self.open.take().map(|(finding, _)| finding)
    }
}
