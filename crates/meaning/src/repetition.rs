//! A program that jumps about for ever, found out: it comes to the same block in the same state once more.
//!
//! The state is all of it: a loop of a program that is called again and again begins anew each time, and ends.

use base::AXES;
use syntax::Cursor;

use crate::coordinate::clear;
use crate::jump::OpenLoop;
use crate::program::Frame;
use crate::state::State;
use crate::user_macro::Variables;
use crate::user_macro::call::{Arguments, ModalCall};

/// What decides where a program goes on after a jump.
#[derive(Clone, Copy)]
pub(crate) struct Moment<'m> {
    /// Where the jump leads.
    pub cursor: Cursor,
    pub state: &'m State,
    pub variables: &'m Variables,
    /// The levels of calls, with how often each is still to run.
    pub frames: &'m [Frame],
    pub loops: &'m [OpenLoop],
    pub modal: Option<&'m ModalCall>,
    /// The arguments with which each level begins again.
    pub called_with: &'m [Arguments],
}

#[derive(Clone, Debug)]
struct Seen {
    cursor: Cursor,
    state: State,
    variables: Variables,
    frames: Vec<Frame>,
    loops: Vec<OpenLoop>,
    modal: Option<ModalCall>,
    called_with: Vec<Arguments>,
}

impl Seen {
    fn of(moment: &Moment) -> Seen {
        Seen {
            cursor: moment.cursor,
            state: settled(moment.state),
            variables: moment.variables.clone(),
            frames: moment.frames.to_vec(),
            loops: moment.loops.to_vec(),
            modal: moment.modal.copied(),
            called_with: moment.called_with.to_vec(),
        }
    }

    fn take(&mut self, moment: &Moment) {
        self.cursor = moment.cursor;
        self.state = settled(moment.state);
        self.variables.copy_from(moment.variables);
        moment.frames.clone_into(&mut self.frames);
        moment.loops.clone_into(&mut self.loops);
        self.modal = moment.modal.copied();
        moment.called_with.clone_into(&mut self.called_with);
    }

    fn is(&self, moment: &Moment) -> bool {
        self.cursor == moment.cursor
            // An axis that stands elsewhere decides it without a look at all the rest.
            && (self.state.machine == moment.state.machine || !moment.state.unknown.axes.is_empty())
            && self.frames == moment.frames
            && self.loops == moment.loops
            && self.state == settled(moment.state)
            && self.variables == *moment.variables
            && same_modal(self.modal.as_ref(), moment.modal)
            && self.called_with.len() == moment.called_with.len()
            && self.called_with.iter().zip(moment.called_with).all(|(one, other)| same_arguments(one, other))
    }
}

fn same_modal(one: Option<&ModalCall>, other: Option<&ModalCall>) -> bool {
    match (one, other) {
        (None, None) => true,
        (Some(one), Some(other)) => {
            one.found == other.found && one.repeats == other.repeats && same_arguments(&one.arguments, &other.arguments)
        }
        _ => false,
    }
}

/// A blank is no number that equals itself.
fn same_arguments(one: &Arguments, other: &Arguments) -> bool {
    one.iter().zip(other).all(|(one, other)| one.to_bits() == other.to_bits())
}

/// One earlier jump, kept for 1, 2, 4, 8 … jumps (Brent's cycle search), so that one moment is enough.
#[derive(Clone, Debug)]
pub(crate) struct Repetition {
    seen: Option<Seen>,
    jumps: u64,
    kept_for: u64,
    /// The clock was read since: it goes on by itself, and may end the loop.
    timed: bool,
}

impl Default for Repetition {
    fn default() -> Self {
        Repetition { seen: None, jumps: 0, kept_for: 1, timed: false }
    }
}

impl Repetition {
    pub fn clock_was_read(&mut self) {
        self.timed = true;
    }

    /// True if the program has made this jump at such a moment before: it would go on for ever.
    ///
    /// Where an axis is unknown (only while checking on) its place makes no difference.
    pub fn comes_again(&mut self, moment: &Moment) -> bool {
        if !self.timed && self.seen.as_ref().is_some_and(|seen| seen.is(moment)) {
            return true;
        }
        self.jumps += 1;
        if self.jumps >= self.kept_for {
            match &mut self.seen {
                Some(seen) => seen.take(moment),
                None => self.seen = Some(Seen::of(moment)),
            }
            self.jumps = 0;
            self.kept_for *= 2;
            self.timed = false;
        }
        false
    }
}

/// A state without what is not known in it, and without what only a display shows: that decides nothing.
fn settled(state: &State) -> State {
    let mut state = *state;
    state.machine = clear(state.machine, state.unknown.axes);
    state.displacement = clear(state.displacement, state.unknown.axes);
    state.universal_zero = [0.0; AXES];
    state
}
