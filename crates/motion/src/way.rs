//! A smooth way of all axes together: where they are, and how that changes along it.
//!
//! Every way has a length parameter `s`. On lines, circles and helices it is the length of the path itself (degrees
//! count as mm), on spirals and blends nearly so; [`Way::slope`] says by how much not. Velocity and acceleration
//! follow from the speed `v = ds/dt` and `u = dv/dt`: `q' v` and `q' u + q'' v²`.

use base::{AXES, Point};
use path::Arc;

/// A smooth way.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Way {
    /// Straight.
    Line {
        /// From here.
        from: Point,
        /// In this direction, a mm each mm.
        along: Point,
        /// So far, mm.
        length: f64,
    },
    /// Round.
    Arc {
        /// Its geometry.
        arc: Arc,
        /// Its length, mm.
        length: f64,
    },
    /// Round a corner: a polynomial of the third degree in `s`.
    Blend {
        /// Its four coefficients.
        terms: [Point; 4],
        /// Its length, mm.
        length: f64,
    },
}

/// A place on a way: how the axes move there for each mm of it, and how that changes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Edge {
    /// `q'`.
    pub slope: Point,
    /// `q''`.
    pub bend: Point,
}

impl Edge {
    /// The place at this length of a way.
    pub fn new(way: &Way, s: f64) -> Edge {
        Edges::new(way, s, 0.0).next()
    }
}

/// Places on a way, one by one, evenly apart.
pub struct Edges<'w> {
    way: &'w Way,
    s: f64,
    step: f64,
    /// Of an arc: the direction of its spoke, and by how much that turns at each step, as cosine and sine.
    spoke: [f64; 2],
    turn: [f64; 2],
    /// How far each axis moves for each mm of it that moves evenly.
    even: Point,
}

impl<'w> Edges<'w> {
    /// Places so far apart, the first one at this length of a way.
    pub fn new(way: &'w Way, s: f64, step: f64) -> Edges<'w> {
        let mut edges = Edges { way, s, step, spoke: [1.0, 0.0], turn: [1.0, 0.0], even: [0.0; AXES] };
        if let Way::Arc { arc, length } = way {
            let per_length = 1.0 / length;
            let angles = [arc.start_angle + arc.sweep * s * per_length, arc.sweep * step * per_length];
            [edges.spoke, edges.turn] = angles.map(|angle| {
                let (sin, cos) = libm::sincos(angle);
                [cos, sin]
            });
            edges.even = std::array::from_fn(|axis| (arc.to[axis] - arc.from[axis]) * per_length);
        }
        edges
    }

    /// The next one.
    pub fn next(&mut self) -> Edge {
        let (way, s) = (self.way, self.s);
        self.s += self.step;
        let Way::Arc { arc, length } = way else { return Edge { slope: way.slope(s), bend: way.bend(s) } };
        let ([cos, sin], [turn_cos, turn_sin]) = (self.spoke, self.turn);
        self.spoke = [cos * turn_cos - sin * turn_sin, sin * turn_cos + cos * turn_sin];
        let per_length = 1.0 / length;
        let growth = (arc.radius[1] - arc.radius[0]) * per_length;
        let turned = arc.sweep * per_length;
        let radius = arc.radius[0] + growth * s;
        let [u, v] = plane(arc);
        let mut edge = Edge { slope: self.even, bend: [0.0; AXES] };
        edge.slope[u] = growth * cos - radius * turned * sin;
        edge.slope[v] = growth * sin + radius * turned * cos;
        let (aside, towards) = (2.0 * growth * turned, radius * turned * turned);
        edge.bend[u] = -aside * sin - towards * cos;
        edge.bend[v] = aside * cos - towards * sin;
        edge
    }
}

impl Way {
    /// The straight way between two points.
    pub fn line(from: &Point, to: &Point, count: usize) -> Way {
        let (mut along, mut square) = ([0.0; AXES], 0.0);
        for axis in 0..count.min(AXES) {
            along[axis] = to[axis] - from[axis];
            square += along[axis] * along[axis];
        }
        let length = f64::sqrt(square);
        if length > 0.0 {
            for part in &mut along {
                *part /= length;
            }
        }
        Way::Line { from: *from, along, length }
    }

    /// The way along an arc.
    pub fn arc(arc: &Arc) -> Way {
        Way::Arc { arc: *arc, length: arc.length() }
    }

    /// The way from a point and direction to another, as long as the way round their corner: a parabola where the two
    /// are equally far from it.
    pub fn blend(from: &Point, before: &Point, to: &Point, after: &Point, length: f64) -> Way {
        let mut terms = [*from, *before, [0.0; AXES], [0.0; AXES]];
        for axis in 0..AXES {
            let mean = (to[axis] - from[axis]) / length;
            terms[2][axis] = (3.0 * mean - 2.0 * before[axis] - after[axis]) / length;
            terms[3][axis] = (before[axis] + after[axis] - 2.0 * mean) / (length * length);
        }
        Way::Blend { terms, length }
    }

    /// Its length, mm.
    pub fn length(&self) -> f64 {
        match self {
            Way::Line { length, .. } | Way::Arc { length, .. } | Way::Blend { length, .. } => *length,
        }
    }

    /// True if its direction never changes.
    pub fn is_straight(&self) -> bool {
        matches!(self, Way::Line { .. })
    }

    /// Where the axes are.
    pub fn at(&self, s: f64) -> Point {
        match self {
            Way::Line { from, along, .. } => std::array::from_fn(|axis| from[axis] + along[axis] * s),
            Way::Arc { arc, length } => arc.at(s / length),
            Way::Blend { terms: [a, b, c, d], .. } => {
                std::array::from_fn(|axis| a[axis] + s * (b[axis] + s * (c[axis] + s * d[axis])))
            }
        }
    }

    /// `q'`: how far each axis moves for each mm of `s`.
    pub fn slope(&self, s: f64) -> Point {
        match self {
            Way::Line { along, .. } => *along,
            Way::Arc { .. } => Edge::new(self, s).slope,
            Way::Blend { terms: [_, b, c, d], .. } => {
                std::array::from_fn(|axis| b[axis] + s * (2.0 * c[axis] + 3.0 * s * d[axis]))
            }
        }
    }

    /// `q''`: how the slope changes for each mm of `s`.
    pub fn bend(&self, s: f64) -> Point {
        match self {
            Way::Line { .. } => [0.0; AXES],
            Way::Arc { .. } => Edge::new(self, s).bend,
            Way::Blend { terms: [_, _, c, d], .. } => std::array::from_fn(|axis| 2.0 * c[axis] + 6.0 * s * d[axis]),
        }
    }

    /// `q'''`: how the bend changes for each mm of `s`.
    pub fn twist(&self, s: f64) -> Point {
        match self {
            Way::Line { .. } => [0.0; AXES],
            Way::Arc { arc, length } => {
                let mut twist = [0.0; AXES];
                let (growth, radius, [cos, sin]) = spoke(arc, s / length);
                let [u, v] = plane(arc);
                let square = arc.sweep * arc.sweep;
                let (towards, along) = (3.0 * growth * square, radius * square * arc.sweep);
                let cube = length * length * length;
                twist[u] = (-towards * cos + along * sin) / cube;
                twist[v] = (-towards * sin - along * cos) / cube;
                twist
            }
            Way::Blend { terms: [_, _, _, d], .. } => d.map(|d| 6.0 * d),
        }
    }
}

fn plane(arc: &Arc) -> [usize; 2] {
    arc.axes.map(|axis| usize::from(axis) % AXES)
}

/// By how much the radius grows over the whole arc, the radius at a fraction of it, and the direction of its spoke.
fn spoke(arc: &Arc, fraction: f64) -> (f64, f64, [f64; 2]) {
    let growth = arc.radius[1] - arc.radius[0];
    let (sin, cos) = libm::sincos(arc.start_angle + arc.sweep * fraction);
    (growth, arc.radius[0] + growth * fraction, [cos, sin])
}

/// The length of a vector over the machine's axes.
pub fn norm(vector: &Point, count: usize) -> f64 {
    dot(vector, vector, count).sqrt()
}

/// The product of two vectors over the machine's axes.
pub fn dot(one: &Point, other: &Point, count: usize) -> f64 {
    one.iter().zip(other).take(count).map(|(one, other)| one * other).sum()
}

#[cfg(test)]
pub mod expect;

#[cfg(test)]
mod tests {
    use super::*;
    use meaning::{ArcMove, Plane};

    fn point(xyz: [f64; 3]) -> Point {
        let mut point = [0.0; AXES];
        point[..3].copy_from_slice(&xyz);
        point
    }

    fn ways() -> [Way; 4] {
        let arc = |to, center| {
            let to = point(to);
            let arc = ArcMove { to, plane: Plane::Xy, axes: [0, 1], center, clockwise: true, full_circle: false };
            Way::arc(&Arc::new(&point([10.0, 0.0, 1.0]), &arc))
        };
        let line = Way::line(&point([1.0, 2.0, 3.0]), &point([4.0, -2.0, 5.0]), 3);
        let (before, after) = (point([1.0, 0.0, 0.0]), point([0.0, 0.6, 0.8]));
        let blend = Way::blend(&point([0.0; 3]), &before, &point([0.5, 0.3, 0.4]), &after, 1.0);
        [line, arc([0.0, 10.0, 4.0], [0.0; 2]), arc([-4.0, 3.0, 1.0], [0.0; 2]), blend]
    }

    #[test]
    fn slope_bend_and_twist_are_the_derivatives_of_the_place() {
        for way in ways() {
            let step = way.length() * 1e-5;
            for part in 1..20 {
                let s = way.length() * f64::from(part) / 20.0;
                let (before, at, after) = (way.at(s - step), way.at(s), way.at(s + step));
                for axis in 0..3 {
                    let slope = (after[axis] - before[axis]) / (2.0 * step);
                    let bend = (after[axis] - 2.0 * at[axis] + before[axis]) / (step * step);
                    assert!((way.slope(s)[axis] - slope).abs() < 1e-7, "{way:?} {s} {axis}");
                    assert!((way.bend(s)[axis] - bend).abs() < 1e-3, "{way:?} {s} {axis}");
                    let twist = (way.bend(s + step)[axis] - way.bend(s - step)[axis]) / (2.0 * step);
                    assert!((way.twist(s)[axis] - twist).abs() < 1e-6, "{way:?} {s} {axis}");
                }
            }
        }
    }

    #[test]
    fn a_helix_and_a_line_run_a_mm_each_mm() {
        for way in &ways()[..2] {
            assert!((norm(&way.slope(way.length() / 3.0), 3) - 1.0).abs() < 1e-12, "{way:?}");
        }
    }

    #[test]
    fn a_blend_of_equal_arms_is_a_parabola_and_ends_where_it_should() {
        let [.., blend] = ways();
        let Way::Blend { terms, length } = blend else { panic!("a blend") };
        assert!(norm(&terms[3], 3) < 1e-15, "no third term");
        let end = blend.at(length);
        assert!((end[0] - 0.5).abs() < 1e-15 && (end[1] - 0.3).abs() < 1e-15 && (end[2] - 0.4).abs() < 1e-15);
    }
}
