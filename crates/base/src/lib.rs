//! What every stage speaks: places in a program, exact numbers, axes, conditions, diagnostics as data.
//!
//! Comes in: nothing. Goes out: plain values. Must never know: any control, any file, any clock.

pub mod alarm;
pub mod axis;
pub mod condition;
pub mod diagnostic;
pub mod number;
pub mod place;
pub mod units;

pub use alarm::Alarm;
pub use axis::{AXES, AxisSet, Point};
pub use condition::Condition;
pub use diagnostic::{AlarmName, Correction, Diagnostic, Label, Severity};
pub use number::Decimal;
pub use place::{Place, ProgramId, SourceId, Span};
pub use units::{MmPerMinute, Seconds, UnitSystem};
