//! A main program that jumps about for ever, found out: it comes to the same block in the same state once more.

use syntax::Cursor;

use crate::coordinate::clear;
use crate::state::State;

/// One earlier jump, kept for 1, 2, 4, 8 … jumps (Brent's cycle search), so that one state is enough.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Repetition {
    seen: Option<(Cursor, State)>,
    jumps: u64,
    kept_for: u64,
}

impl Default for Repetition {
    fn default() -> Self {
        Repetition { seen: None, jumps: 0, kept_for: 1 }
    }
}

impl Repetition {
    /// True if the program has jumped to this block in this state before: it would go on for ever.
    ///
    /// Where an axis is unknown (only while checking on) its place makes no difference.
    pub fn comes_again(&mut self, cursor: Cursor, state: &State) -> bool {
        let mut state = *state;
        state.machine = clear(state.machine, state.unknown.axes);
        state.displacement = clear(state.displacement, state.unknown.axes);
        if self.seen.as_ref().is_some_and(|(place, earlier)| *place == cursor && *earlier == state) {
            return true;
        }
        self.jumps += 1;
        if self.jumps >= self.kept_for {
            self.seen = Some((cursor, state));
            self.jumps = 0;
            self.kept_for *= 2;
        }
        false
    }
}
