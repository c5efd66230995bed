//! Geometry to time: how long each move takes under the limits of every axis.
//!
//! Comes in: shapes. Goes out: the same shapes, each move with its duration and path length. Must never know: what
//! the machine does with them, and what time it is; time is counted from zero by whoever adds the durations up.
//!
//! Moves run into each other where the control lets them ([`Horizon`] looks ahead as far as that asks); docs/motion.md
//! derives how. Who does not plan gets every move from rest to rest.

mod cell;
mod classic;
mod corner;
mod engine;
mod horizon;
mod jerk;
mod limits;
mod overrides;
mod planner;
mod positioning;
mod profile;
mod sampling;
mod scurve;
mod stage;
mod stroke;
mod way;

pub use classic::{Interpolator, Spell, SpellKind, Spent};
pub use engine::Sample;
pub use horizon::{Horizon, Leg, MOST_CELLS, Move, Setpoint};
pub use jerk::{JerkHorizon, MOST_PIECES};
pub use limits::{AxisLimits, Classic, Limits, Model};
pub use overrides::Overrides;
pub use planner::{Ahead, Pace, Stretch};
pub use profile::Trapezoid;
pub use scurve::SCurve;
pub use stage::{Motion, Timed};
pub use stroke::Stroke;
pub use way::Way;
