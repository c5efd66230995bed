//! What must not be run: an element that the tool does not fit beside.

use std::f64::consts::TAU;

use dialect::CompensationRules;

use super::edge::Edge;
use crate::plane::{Vector, dot, length, less};

/// A path that runs backwards by less than this, mm, has no length: rounding made it.
pub const BACKWARDS_MM: f64 = 1e-6;

/// What is wrong, with its measures in mm.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Fault {
    /// Compensation would begin on an arc.
    StartsByArc,
    /// Compensation would end on an arc.
    EndsByArc,
    /// The tool does not fit into an arc of this radius.
    InnerArc(f64),
    /// The centre would run backwards by this much.
    Reversed(f64),
    /// The centre would go all the way round and on by this much.
    Overlaps(f64),
    /// A full circle that does not close by this much.
    Open(f64),
    /// The paths beside this element and the one before do not meet.
    Apart,
    /// Beside an element near it the tool would cut into this one by this much.
    Cut(f64),
}

/// Judges whether there is room beside an arc on the tool's side, for a tool beside it by `s` at its start and end.
#[inline]
pub(crate) fn judge_room(edge: &Edge, s: [f64; 2], rules: &CompensationRules) -> Result<(), Fault> {
    if !edge.is_arc() {
        return Ok(());
    }
    for (curvature, s) in edge.curvature.into_iter().zip(s) {
        // What is left of the radius on the tool's side.
        let left = (1.0 - s * curvature) / curvature.abs();
        if left < -BACKWARDS_MM || rules.refuses_equal_arc && left < BACKWARDS_MM {
            return Err(Fault::InnerArc(1.0 / curvature.abs()));
        }
    }
    Ok(())
}

/// Judges the path beside an element from one vector to another, for a tool beside it by `s` at its end.
#[inline]
pub(crate) fn judge(edge: &Edge, vectors: [Vector; 2], s: f64, rules: &CompensationRules) -> Result<(), Fault> {
    if !edge.is_arc() {
        let way = edge.length + dot(less(vectors[1], vectors[0]), edge.tangent[0]);
        return if way < -BACKWARDS_MM { Err(Fault::Reversed(-way)) } else { Ok(()) };
    }
    let sweep = edge.sweep_beside(vectors) * edge.sweep.signum();
    // That of the centre's path.
    let radius = ((1.0 - s * edge.curvature[1]) / edge.curvature[1].abs()).max(0.0);
    if sweep * radius < -BACKWARDS_MM {
        return Err(Fault::Reversed(-sweep * radius));
    }
    if (sweep - TAU) * radius > BACKWARDS_MM {
        return Err(Fault::Overlaps((sweep - TAU) * radius));
    }
    let gap = length(less(vectors[1], vectors[0]));
    if edge.full_circle && rules.circles_close && gap > BACKWARDS_MM {
        return Err(Fault::Open(gap));
    }
    Ok(())
}
