//! Whether the tool, beside one element, cuts into another: the one before, the next one, or the one behind that.
//! Everything is counted from the end of the element being run.

use super::corner::{Join, sweep_round};
use super::edge::Edge;
use std::f64::consts::PI;

use crate::curve::Curve;
use crate::plane::{NONE, Vector, add, cross, less, times};

/// Nearer by less than this, mm, is near enough: rounding made it.
const CUT_MM: f64 = 1e-6;

/// Elements in their order, the one being run among them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbours<'n> {
    pub before: Option<&'n Edge>,
    pub now: &'n Edge,
    pub next: Option<&'n Edge>,
    pub after: Option<&'n Edge>,
}

/// By how much the path beside the element being run, from a vector to its end and round the corner there, cuts into the
/// next element, into the one behind that and into the one before it, mm; the first that it cuts.
pub(crate) fn cut(near: &Neighbours, start: Vector, corner: &Join, s: f64) -> Option<(Cut, f64)> {
    let Neighbours { before, now, next, after } = *near;
    let bends = |edge: &Edge| edge.is_arc();
    let depth = |edge: &Edge, other: Curve| {
        let nearest = pieces(now, start, corner, s).map(|piece| piece.approach(&other).0).fold(f64::INFINITY, f64::min);
        Some(s.abs() - nearest).filter(|depth| *depth > CUT_MM + unround(now, s) + unround(edge, s))
    };
    if let Some(next) = next {
        let any = bends(now) || bends(next);
        // Beside a line the corner has seen to the next line.
        if let Some(depth) = any.then(|| depth(next, beginning(next, NONE))).flatten() {
            return Some((Cut::Next, depth));
        }
        if let Some(after) = after {
            // Three lines come back to the first only by turning to the tool's side by more than half a turn.
            let side = |from: Vector, to: Vector| cross(from, to) * s;
            let wraps = side(now.tangent[1], next.tangent[0]) > 0.0
                && side(next.tangent[1], after.tangent[0]) > 0.0
                && side(now.tangent[1], after.tangent[0]) <= 0.0;
            let looks = any || bends(after) || wraps;
            if let Some(depth) = looks.then(|| depth(after, beginning(after, way(next)))).flatten() {
                return Some((Cut::After, depth));
            }
        }
    }
    // Going round a corner the tool can come back to a line as well.
    // Beside its own end an arc of more than half a turn has its beginning.
    if now.sweep.abs() > PI {
        let own = ending(now, NONE, [NONE; 2]);
        let nearest =
            pieces(now, start, corner, s).skip(1).map(|piece| piece.approach(&own).0).fold(f64::INFINITY, f64::min);
        let depth = s.abs() - nearest;
        if depth > CUT_MM + unround(now, s) {
            return Some((Cut::Now, depth));
        }
    }
    let before = before.filter(|before| bends(now) || bends(before) || corner.places().len() > 1)?;
    depth(before, ending(before, times(way(now), -1.0), [NONE; 2])).map(|depth| (Cut::Before, depth))
}

/// The path beside an element that ends at zero, and the way round the corner there.
fn pieces(edge: &Edge, start: Vector, corner: &Join, s: f64) -> impl Iterator<Item = Curve> {
    let round = move |pair: &[Vector]| match pair {
        [first, second] if corner.round => Curve::about(NONE, *first, sweep_round(*first, *second, s)),
        [first, second] => Curve::line(*first, *second),
        _ => Curve::line(NONE, NONE),
    };
    let own = ending(edge, NONE, [start, corner.first()]);
    std::iter::once(own).chain(corner.places().windows(2).map(round))
}

/// By how much places beside an arc lie beside its circle, whose radius differs from its start to its end: rounded words
/// make it so.
fn unround(edge: &Edge, s: f64) -> f64 {
    if !edge.is_arc() {
        return 0.0;
    }
    let [first, last] = edge.curvature.map(|curvature| 1.0 / curvature.abs());
    let growth = (first - last).abs();
    let slope = growth / (first * edge.sweep.abs());
    2.0 * growth + s.abs() * slope * slope
}

/// Which element is cut.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Cut {
    Before,
    Now,
    Next,
    After,
}

/// From an element's start to its end.
fn way(edge: &Edge) -> Vector {
    if edge.is_arc() { less(edge.spoke(1), edge.spoke(0)) } else { times(edge.tangent[0], edge.length) }
}

/// An element that ends at a point, or the path beside it by two vectors.
fn ending(edge: &Edge, end: Vector, [first, last]: [Vector; 2]) -> Curve {
    if !edge.is_arc() {
        return Curve::line(add(less(end, way(edge)), first), add(end, last));
    }
    let sweep = if first == NONE && last == NONE { edge.sweep } else { edge.sweep_beside([first, last]) };
    Curve::about(less(end, edge.spoke(1)), add(edge.spoke(0), first), sweep)
}

/// An element that begins at a point.
fn beginning(edge: &Edge, start: Vector) -> Curve {
    if !edge.is_arc() {
        return Curve::line(start, add(start, way(edge)));
    }
    Curve::about(less(start, edge.spoke(0)), edge.spoke(0), edge.sweep)
}
