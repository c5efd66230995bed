//! A main program that jumps about for ever, found out: it comes to the same block in the same state once more.

use syntax::Cursor;

use crate::coordinate::clear;
use crate::state::State;
use crate::user_macro::Variables;

/// One earlier jump, kept for 1, 2, 4, 8 … jumps (Brent's cycle search), so that one state is enough.
#[derive(Clone, Debug)]
pub(crate) struct Repetition {
    seen: Option<(Cursor, State, Variables)>,
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
    pub fn comes_again(&mut self, cursor: Cursor, state: &State, variables: &Variables) -> bool {
        if let Some((place, earlier, before)) = &self.seen
            && *place == cursor
            && *earlier == settled(state)
            && before == variables
        {
            return true;
        }
        self.jumps += 1;
        if self.jumps >= self.kept_for {
            match &mut self.seen {
                Some((place, earlier, before)) => {
                    *place = cursor;
                    *earlier = settled(state);
                    before.copy_from(variables);
                }
                None => self.seen = Some((cursor, settled(state), variables.clone())),
            }
            self.jumps = 0;
            self.kept_for *= 2;
        }
        false
    }
}

/// A state without what is not known in it.
fn settled(state: &State) -> State {
    let mut state = *state;
    state.machine = clear(state.machine, state.unknown.axes);
    state.displacement = clear(state.displacement, state.unknown.axes);
    state
}
