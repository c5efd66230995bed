//! The reader for images of punched tape: one byte a row, one row a character.

use crate::code::{Codes, Table};
use crate::recognise::Tape;
use crate::{IGNORED, Reader};

/// The reader for one tape.
///
/// The label, which a control skips, is passed over; so are the rows that have no character. What is no row of the
/// code becomes [`crate::UNREADABLE`]; [`crate::faults`] says why.
#[derive(Clone, Copy, Debug)]
pub struct Punched {
    tape: Tape,
    table: Table,
}

impl Punched {
    /// Reads a tape in the codes of a control.
    pub fn new(tape: Tape, codes: &Codes) -> Punched {
        Punched { tape, table: codes.table(tape.system) }
    }

    /// What the tape's rows are.
    pub const fn table(&self) -> &Table {
        &self.table
    }
}

impl Reader for Punched {
    fn translate(&self, bytes: &mut [u8], at: u64, _last: bool) -> usize {
        let label = usize::try_from(self.tape.head.saturating_sub(at)).unwrap_or(usize::MAX).min(bytes.len());
        let (label, program) = bytes.split_at_mut(label);
        label.fill(IGNORED);
        self.table.translate(program);
        bytes.len()
    }
}
