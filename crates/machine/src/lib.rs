//! The machine: what the builder's file says of it, and a deterministic virtual one that executes timed shapes.
//!
//! Comes in: shapes with their durations. Goes out: [`Event`]s in the order of execution, with virtual time. Must
//! never know: a clock, a file, what any control's codes mean. A machine with real axes is another [`Machine`].

mod area;
mod drives;
mod event;
mod file;
mod interface;
mod kinematics;
mod logic;
mod path_table;
mod reference_return;
mod signals;
mod travel;
mod virtual_machine;

pub use drives::Drives;
pub use event::{Event, EventKind, ResetCause, StopCause};
pub use file::{CodeTimes, MachineAxis, MachineFile, Wiring, builtin_machine, builtin_machines, read_machine};
pub use interface::{DecodedLine, HandshakeTimes};
pub use logic::{LogicFate, LogicTable, LogicTrouble, LogicWait, SpindleSays, Watched};
pub use path_table::PathTable;
pub use reference_return::ReferenceReturn;
pub use signals::{Fin, LimitSwitch, Magazine, MagazineFacts, Signal, Spindle, SpindleFacts, Trouble, Waiting};
pub use travel::Travel;
pub use virtual_machine::{LogicAlarm, Machine, Refusal, VirtualMachine, Wait};
