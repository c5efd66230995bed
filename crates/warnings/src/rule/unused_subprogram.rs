//! `unused-subprogram`: a subprogram that nothing calls.
//!
//! What: a program of this text ends with M99, and no block of the text calls its number.
//! Why: the call that was meant calls another number, and its cuts are missing.
//! Do: mend the call, or take the subprogram out.
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
