//! The operator's station: wires the stages together and lets an operator, or a command in his place, act on them.
//!
//! Comes in: a [`Configuration`], the texts of programs through a [`Library`], the operator's actions. Goes out:
//! events, one at a time, through [`Session::next`]. Must never know: files, clocks, how events are shown.

mod action;
mod block_target;
mod catalogue;
mod configuration;
mod display;
mod edit;
mod fault;
mod kept;
mod library;
mod lock;
mod memory;
mod operator;
mod program_text;
mod script;
mod session;
mod setup;
mod switches;

pub use action::{Action, OverrideSwitch, Show, Until};
pub use block_target::{At, BlockTarget};
pub use catalogue::{blocks_of, programs_in};
pub use configuration::{Configuration, ConfigurationError, Inputs};
pub use display::Value;
pub use edit::Edit;
pub use fault::Fault;
pub use kept::{Cell, CellKind};
pub use library::{Library, LibraryError, Shelf, Wanted};
pub use operator::{Interrupted, Operator, Panel, Said};
pub use program_text::number_of;
pub use script::{ScriptError, ScriptLine, read_action, read_script, split_offset, split_parameter, without_comment};
pub use session::{AfterAlarm, Asked, HandMove, PastAlarm, Percents, RestartPlan, Session, Step, TYPED, Way};
pub use setup::{OffsetColumn, Setup, read_setup};
pub use switches::{SessionSwitches, Which, split_switch};
