//! Two texts run side by side: what one does the other does, event for event.

use base::Place;
use machine::EventKind;
use station::{Library, LibraryError, Session};

use super::next_event;

/// Where two runs part.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Difference {
    /// The block of the first text.
    pub first: Place,
    /// The block of the second text.
    pub second: Place,
}

/// Runs both sessions' programs to their ends, CYCLE START pressed after every stop. Lines and sequence numbers aside,
/// every event must be the same, up to so many: a program may run for ever.
///
/// # Errors
/// A text cannot be read.
pub fn same_run<L: Library>(
    first: &mut Session<L>,
    second: &mut Session<L>,
    most_events: u64,
) -> Result<Option<Difference>, LibraryError> {
    first.start();
    second.start();
    for _ in 0..most_events {
        let here = |session: &Session<L>| session.place();
        let difference = Difference { first: here(first), second: here(second) };
        match (next_event(first)?, next_event(second)?) {
            (Some(a), Some(b)) => {
                let (one, other) = (first.interpreter(), second.interpreter());
                let same_program = one.program_name(a.place.program) == other.program_name(b.place.program);
                if a.time != b.time || !same_program || !same_kind(&a.kind, &b.kind) {
                    return Ok(Some(Difference { first: a.place, second: b.place }));
                }
            }
            (None, None) => return Ok(None),
            _ => return Ok(Some(difference)),
        }
    }
    Ok(None)
}

fn same_kind(a: &EventKind, b: &EventKind) -> bool {
    match (a, b) {
        (EventKind::Alarm(a), EventKind::Alarm(b)) => {
            // Their numbers can be lines and blocks, which are others in another text.
            a.condition == b.condition && a.axis == b.axis && a.letter == b.letter
        }
        _ => a == b,
    }
}
