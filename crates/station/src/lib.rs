//! The operator's station: wires the stages together and lets an operator, or a command in his place, act on them.
//!
//! Comes in: a [`Configuration`], the texts of programs through a [`Library`], the operator's actions. Goes out:
//! events, one at a time, through [`Session::next`]. Must never know: files, clocks, how events are shown.

mod catalogue;
mod configuration;
mod library;
mod operator;
mod script;
mod session;
mod setup;
mod switches;

pub use catalogue::programs_in;
pub use configuration::{Configuration, ConfigurationError, Inputs};
pub use library::{Library, LibraryError};
pub use operator::{Loaded, Operator, Said, Shown};
pub use script::{Action, ScriptError, Show, Until, read_script, split_switch};
pub use session::{AfterAlarm, Session, Step};
pub use setup::{OffsetColumn, Setup, read_setup};
pub use switches::SessionSwitches;
