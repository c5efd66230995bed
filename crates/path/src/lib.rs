//! Operations to geometry: where the tool goes between the points that the program names.
//!
//! Comes in: the interpreter's operations. Goes out: [`Shape`]s with exact lines and arcs, none of zero length, all
//! other operations as they came. Must never know: how fast anything moves.

mod arc;
mod chain;
mod compensation;
mod curve;
mod displacement;
mod offsetting;
mod pieces;
pub mod plane;
mod shape;
mod stage;

pub use arc::Arc;
pub use chain::{ChainRules, Link, run_chain};
pub use compensation::{BACKWARDS_MM, Corner, TANGENT_MM};
pub use curve::{Curve, Extent, Turn};
pub use shape::{Part, Programmed, RunBeside, Shape, Shaped};
pub use stage::Path;
