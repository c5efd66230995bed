//! Geometry to time: how long each move takes under the limits of every axis.
//!
//! Comes in: shapes. Goes out: the same shapes, each move with its duration and path length. Must never know: what
//! the machine does with them, and what time it is; time is counted from zero by whoever adds the durations up.
//!
//! As built: every move starts and ends at rest and accelerates along a trapezoid. Looking ahead over block borders
//! comes later and changes durations only.

mod limits;
mod overrides;
mod profile;
mod stage;

pub use limits::{AxisLimits, Limits};
pub use overrides::Overrides;
pub use profile::Trapezoid;
pub use stage::{Motion, Timed};
