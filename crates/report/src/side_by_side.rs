//! Two programs run side by side: whether one does what the other does, and where not.
//!
//! Comes in: two sessions, each with its program, control and machine. Goes out: the first place at which two texts part
//! ([`same_run`], for texts that must be one program), or everything that differs at the machine ([`compare`], for
//! programs and controls that may differ) and its two faces. Neither run is held in memory.

mod alignment;
mod comparison;
mod json;
mod likeness;
mod proof;
mod text;

use machine::Event;
use station::{Library, LibraryError, Session, Step};

pub use comparison::{Comparison, Deviation, Limits, compare};
pub use json::comparison_json;
pub use proof::{Difference, same_run};
pub use text::comparison_text;

/// The next event of a run, CYCLE START pressed after every stop; `None` at its end.
fn next_event<L: Library>(session: &mut Session<L>) -> Result<Option<Event>, LibraryError> {
    loop {
        match session.next() {
            Step::Event(event) => return Ok(Some(event)),
            Step::Stopped => session.start(),
            Step::Idle => return Ok(None),
            Step::Failed(error) => return Err(error),
        }
    }
}
