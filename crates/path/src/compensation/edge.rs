//! An element as compensation looks at it: its directions, how it bends, how long it is.

use meaning::Element;

use crate::arc::sweep_between;
use crate::plane::{Vector, add, angle, cross, dot, left, length, less, times};
use crate::shape::COUNTS;

/// An element's shape, free of where it lies; mm.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Edge {
    /// Unit tangents at its start and end.
    pub tangent: [Vector; 2],
    /// Curvature at its start and end, 1/mm: positive if it turns left.
    pub curvature: [f64; 2],
    /// Length of a line.
    pub length: f64,
    /// Angle of an arc, radians, + counter-clockwise; 0 for a line.
    pub sweep: f64,
    /// An arc all the way round.
    pub full_circle: bool,
}

impl Edge {
    /// The shape of an element; `None` for one without length.
    pub fn new(element: &Element) -> Option<Edge> {
        let mut edge = Edge::default();
        edge.take(element).then_some(edge)
    }

    /// Becomes the shape of an element; false for one without length.
    pub fn take(&mut self, element: &Element) -> bool {
        let Some(turn) = &element.turn else {
            let way = times(less(element.to, element.from), 1.0 / COUNTS);
            self.length = length(way);
            self.tangent = [times(way, 1.0 / self.length); 2];
            (self.curvature, self.sweep, self.full_circle) = ([0.0; 2], 0.0, false);
            return self.length > 0.0;
        };
        let spoke = [element.from, element.to].map(|end| times(less(end, turn.center), 1.0 / COUNTS));
        let radius = spoke.map(length);
        let sense = if turn.clockwise { -1.0 } else { 1.0 };
        self.length = 0.0;
        self.tangent = [0, 1].map(|end| times(left(spoke[end]), sense / radius[end]));
        self.curvature = radius.map(|radius| sense / radius);
        self.sweep = sweep_between(spoke[0], spoke[1], turn.clockwise, turn.full_circle);
        self.full_circle = turn.full_circle;
        radius[0] > 0.0 && radius[1] > 0.0
    }

    /// True for an arc.
    pub fn is_arc(&self) -> bool {
        self.sweep != 0.0
    }

    /// Its left normals at start and end, so long.
    pub fn normal(&self, end: usize, long: f64) -> Vector {
        times(left(self.tangent[end]), long)
    }

    /// From the centre of an arc to its start or end.
    pub fn spoke(&self, end: usize) -> Vector {
        times(left(self.tangent[end]), -1.0 / self.curvature[end])
    }

    /// The angle of an arc's path that begins and ends beside it by these vectors, radians.
    pub fn sweep_beside(&self, vectors: [Vector; 2]) -> f64 {
        let shift = |end: usize| {
            let spoke = self.spoke(end);
            let moved = add(spoke, vectors[end]);
            // On its own ray nothing is to be turned; the centre itself has no direction.
            if cross(spoke, moved) == 0.0 || dot(moved, moved) == 0.0 { 0.0 } else { angle(spoke, moved) }
        };
        self.sweep + shift(1) - shift(0)
    }
}
