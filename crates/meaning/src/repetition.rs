//! A main program that jumps about for ever, found out: it comes to the same block in the same state once more.

use syntax::Cursor;

use crate::coordinate::clear;
use crate::program::Frame;
use crate::state::State;
use crate::user_macro::Variables;

/// One earlier jump, kept for 1, 2, 4, 8 … jumps (Brent's cycle search), so that one state is enough.
#[derive(Clone, Debug)]
pub(crate) struct Repetition {
    seen: Option<(Cursor, State, Variables)>,
    /// The levels of calls at that jump.
    calls: Vec<Frame>,
    jumps: u64,
    kept_for: u64,
}

impl Default for Repetition {
    fn default() -> Self {
        Repetition { seen: None, calls: Vec::new(), jumps: 0, kept_for: 1 }
    }
}

impl Repetition {
    /// The program has read what changes by itself, as a clock does: what was seen before need not come again.
    pub fn forget(&mut self) {
        self.calls.clear();
        (self.jumps, self.kept_for) = (0, 1);
    }

    /// True if the program has jumped to this block in this state before: it would go on for ever. `calls` are the
    /// programs on the levels of calls: a subprogram that runs once more from elsewhere, or again by its L, is another.
    ///
    /// Where an axis is unknown (only while checking on) its place makes no difference.
    pub fn comes_again(&mut self, cursor: Cursor, calls: &[Frame], state: &State, variables: &Variables) -> bool {
        if let Some((place, earlier, before)) = &self.seen
            && *place == cursor
            && same_calls(&self.calls, calls)
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
            self.calls.clear();
            self.calls.extend_from_slice(calls);
            self.jumps = 0;
            self.kept_for *= 2;
        }
        false
    }
}

/// Whether both lead back the same way. Where the innermost program stands is told by the block it jumps to.
fn same_calls(earlier: &[Frame], now: &[Frame]) -> bool {
    let same = |(earlier, now): (&Frame, &Frame)| earlier.source == now.source && earlier.repeats == now.repeats;
    let callers = now.len().saturating_sub(1);
    earlier.len() == now.len()
        && earlier.iter().zip(now).all(same)
        && earlier.iter().zip(now).take(callers).all(|(earlier, now)| earlier.cursor == now.cursor)
}

/// A state without what is not known in it.
fn settled(state: &State) -> State {
    let mut state = *state;
    state.machine = clear(state.machine, state.unknown.axes);
    state.displacement = clear(state.displacement, state.unknown.axes);
    state
}
