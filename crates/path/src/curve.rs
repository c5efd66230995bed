//! Lines and arcs in the plane of compensation, and how near to each other they come: exactly, by their geometry; mm.

use std::f64::consts::TAU;

use crate::arc::Arc;
use crate::plane::{Vector, add, cross, distance, dot, in_plane, least, length, less, most};
use crate::shape::Programmed;

/// Angles nearer to each other than this, radians, are one.
const SAME_ANGLE: f64 = 1e-9;
/// Directions with less sine than this are parallel.
const PARALLEL: f64 = 1e-12;

/// A line or an arc in the plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Curve {
    /// Where it begins.
    pub from: Vector,
    /// Where it ends.
    pub to: Vector,
    /// How it turns, if it is an arc.
    pub turn: Option<Turn>,
}

/// How an arc turns. A spiral is taken for the circle of its mean radius.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Turn {
    /// About this place.
    pub center: Vector,
    /// So far from it.
    pub radius: f64,
    /// Half of what the radii at its ends differ by.
    pub slack: f64,
    /// Where it begins, seen from the centre; radians.
    start_angle: f64,
    /// Angle swept, radians, + counter-clockwise.
    pub sweep: f64,
}

/// A box along the axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Extent {
    /// Its corner with the lowest coordinates.
    pub low: Vector,
    /// Its corner with the highest.
    pub high: Vector,
}

impl Extent {
    /// Of nothing.
    pub const NOTHING: Extent = Extent { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    /// Of everything.
    pub const EVERYTHING: Extent = Extent { low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] };

    /// Of a straight way.
    #[inline]
    pub fn of_line([from, to]: [Vector; 2]) -> Extent {
        Extent {
            low: [least(from[0], to[0]), least(from[1], to[1])],
            high: [most(from[0], to[0]), most(from[1], to[1])],
        }
    }

    /// The least that holds both.
    #[inline]
    pub fn with(&self, other: &Extent) -> Extent {
        Extent {
            low: [least(self.low[0], other.low[0]), least(self.low[1], other.low[1])],
            high: [most(self.high[0], other.high[0]), most(self.high[1], other.high[1])],
        }
    }

    /// True if the other comes nearer than this along both axes.
    #[inline]
    pub fn is_near(&self, other: &Extent, distance: f64) -> bool {
        self.gap(other) <= distance
    }

    /// How far the other stays away along one axis at least.
    #[inline]
    pub fn gap(&self, other: &Extent) -> f64 {
        let gap = |axis: usize| most(self.low[axis] - other.high[axis], other.low[axis] - self.high[axis]);
        most(gap(0), gap(1))
    }

    /// True if the other lies within it.
    #[inline]
    pub fn holds(&self, other: &Extent) -> bool {
        let holds = |axis: usize| self.low[axis] <= other.low[axis] && other.high[axis] <= self.high[axis];
        holds(0) & holds(1)
    }

    /// What of it lies no farther than this from the other, along each axis.
    pub fn around(&self, other: &Extent, distance: f64) -> Extent {
        let around = |axis: usize| {
            [most(self.low[axis], other.low[axis] - distance), least(self.high[axis], other.high[axis] + distance)]
        };
        let ([left, right], [below, above]) = (around(0), around(1));
        Extent { low: [left, below], high: [right, above] }
    }
}

impl Curve {
    /// A straight way.
    pub fn line(from: Vector, to: Vector) -> Curve {
        Curve { from, to, turn: None }
    }

    /// An arc as it lies in its plane.
    pub fn arc(arc: &Arc) -> Curve {
        let [first, last] = arc.radius;
        let turn = Turn {
            center: arc.center,
            radius: f64::midpoint(first, last),
            slack: (last - first).abs() / 2.0,
            start_angle: arc.start_angle,
            sweep: arc.sweep,
        };
        Curve { from: in_plane(&arc.from, arc.axes), to: in_plane(&arc.to, arc.axes), turn: Some(turn) }
    }

    /// The arc about a centre that begins at the end of a spoke.
    pub fn about(center: Vector, spoke: Vector, sweep: f64) -> Curve {
        let (sin, cos) = libm::sincos(sweep);
        let end = [spoke[0] * cos - spoke[1] * sin, spoke[0] * sin + spoke[1] * cos];
        let turn =
            Turn { center, radius: length(spoke), slack: 0.0, start_angle: libm::atan2(spoke[1], spoke[0]), sweep };
        Curve { from: add(center, spoke), to: add(center, end), turn: Some(turn) }
    }

    /// A programmed way in the plane of these axes.
    pub fn programmed(way: &Programmed, axes: [u8; 2]) -> Curve {
        match way {
            Programmed::Line(from, to) => Curve::line(in_plane(from, axes), in_plane(to, axes)),
            Programmed::Arc(arc) => Curve::arc(arc),
        }
    }

    /// By how much places on it may lie beside it.
    pub fn slack(&self) -> f64 {
        self.turn.map_or(0.0, |turn| turn.slack)
    }

    /// The directions at its start and end, of any length.
    pub fn directions(&self) -> [Vector; 2] {
        match &self.turn {
            None => [less(self.to, self.from); 2],
            Some(turn) => [self.from, self.to].map(|end| {
                let spoke = less(end, turn.center);
                if turn.sweep < 0.0 { [spoke[1], -spoke[0]] } else { [-spoke[1], spoke[0]] }
            }),
        }
    }

    /// The box around it.
    #[inline]
    pub fn extent(&self) -> Extent {
        let extent = Extent::of_line([self.from, self.to]);
        match &self.turn {
            None => extent,
            Some(turn) => turn.bulge(extent),
        }
    }

    /// Its place nearest to a point.
    pub fn nearest(&self, point: Vector) -> Vector {
        match &self.turn {
            None => {
                let way = less(self.to, self.from);
                let square = dot(way, way);
                let part = if square > 0.0 { dot(less(point, self.from), way) / square } else { 0.0 };
                match part.clamp(0.0, 1.0) {
                    0.0 => self.from,
                    1.0 => self.to,
                    part => [self.from[0] + way[0] * part, self.from[1] + way[1] * part],
                }
            }
            Some(turn) => {
                let spoke = less(point, turn.center);
                let long = length(spoke);
                if long > 0.0 && turn.passes(libm::atan2(spoke[1], spoke[0])) {
                    return turn.at(spoke, turn.radius / long);
                }
                if distance(point, self.from) <= distance(point, self.to) { self.from } else { self.to }
            }
        }
    }

    /// How near the other comes, and the place on the other.
    pub fn approach(&self, other: &Curve) -> (f64, Vector) {
        if let Some(place) = self.crossing(other) {
            return (0.0, place);
        }
        let mut best = (f64::INFINITY, other.from);
        let mut try_pair = |on_self: Vector, on_other: Vector| {
            let apart = distance(on_self, on_other);
            if apart < best.0 {
                best = (apart, on_other);
            }
        };
        for end in [self.from, self.to] {
            try_pair(end, other.nearest(end));
        }
        for end in [other.from, other.to] {
            try_pair(self.nearest(end), end);
        }
        // Beside the ends only where the other's nearest place to a centre lies, or away from it.
        for place in self.turn.iter().flat_map(|turn| turn.facing(other)) {
            let own = self.nearest(place);
            try_pair(own, other.nearest(own));
        }
        for place in other.turn.iter().flat_map(|turn| turn.facing(self)) {
            let far = other.nearest(place);
            try_pair(self.nearest(far), far);
        }
        best
    }

    /// A place where both cross.
    pub fn crossing(&self, other: &Curve) -> Option<Vector> {
        match (&self.turn, &other.turn) {
            (None, None) => {
                let (a, b) = (less(self.to, self.from), less(other.to, other.from));
                let sine = cross(a, b);
                if sine.abs() <= PARALLEL * length(a) * length(b) {
                    return None;
                }
                let between = less(other.from, self.from);
                let (s, t) = (cross(between, b) / sine, cross(between, a) / sine);
                let inside = 0.0..=1.0;
                (inside.contains(&s) && inside.contains(&t)).then(|| [self.from[0] + a[0] * s, self.from[1] + a[1] * s])
            }
            (Some(turn), None) => turn.crosses_line(other),
            (None, Some(turn)) => turn.crosses_line(self),
            (Some(turn), Some(other)) => turn.crosses(other),
        }
    }

    /// What of it lies behind a place on it.
    pub fn behind(&self, place: Vector) -> Curve {
        let turn = self.turn.map(|turn| {
            let part = turn.part(place);
            let start_angle = turn.start_angle + turn.sweep * part;
            Turn { start_angle, sweep: turn.sweep * (1.0 - part), ..turn }
        });
        Curve { from: place, to: self.to, turn }
    }

    /// What of it lies before a place on it.
    pub fn before(&self, place: Vector) -> Curve {
        let turn = self.turn.map(|turn| {
            let part = turn.part(place);
            // The place where a circle began is also the one where it ends.
            Turn { sweep: if part == 0.0 { turn.sweep } else { turn.sweep * part }, ..turn }
        });
        Curve { from: self.from, to: place, turn }
    }
}

impl Turn {
    /// The box around its ends, with what lies beyond them.
    fn bulge(&self, mut extent: Extent) -> Extent {
        for (axis, quarter) in [(0, 0.0), (1, 1.0), (0, 2.0), (1, 3.0)] {
            if self.passes(quarter * TAU / 4.0) {
                let side = if quarter < 2.0 { self.radius } else { -self.radius };
                extent.low[axis] = extent.low[axis].min(self.center[axis] + side);
                extent.high[axis] = extent.high[axis].max(self.center[axis] + side);
            }
        }
        extent
    }

    /// True if it comes by in this direction from its centre.
    fn passes(&self, angle: f64) -> bool {
        let way = self.way_to(angle);
        way <= self.sweep.abs() + SAME_ANGLE || way >= TAU - SAME_ANGLE
    }

    /// The angle from its start to a direction, the way it turns; 0 to 2π.
    fn way_to(&self, angle: f64) -> f64 {
        ((angle - self.start_angle) * self.sweep.signum()).rem_euclid(TAU)
    }

    /// Which part of it lies before a place on it.
    fn part(&self, place: Vector) -> f64 {
        let spoke = less(place, self.center);
        let way = self.way_to(libm::atan2(spoke[1], spoke[0]));
        let all = self.sweep.abs();
        if way > all { if way > f64::midpoint(all, TAU) { 0.0 } else { 1.0 } } else { way / all }
    }

    fn at(&self, spoke: Vector, times: f64) -> Vector {
        [self.center[0] + spoke[0] * times, self.center[1] + spoke[1] * times]
    }

    /// Places in the directions in which another curve can be nearest.
    fn facing(&self, other: &Curve) -> [Vector; 2] {
        match &other.turn {
            None => [other.nearest(self.center); 2],
            Some(other) => {
                let way = less(other.center, self.center);
                [self.at(way, 1.0), self.at(way, -1.0)]
            }
        }
    }

    fn holds(&self, place: Vector) -> bool {
        let spoke = less(place, self.center);
        self.passes(libm::atan2(spoke[1], spoke[0]))
    }

    fn crosses_line(&self, line: &Curve) -> Option<Vector> {
        let way = less(line.to, line.from);
        let square = dot(way, way);
        let out = less(line.from, self.center);
        // |out + way·s| = radius
        let half = dot(out, way);
        let root = half * half - square * (dot(out, out) - self.radius * self.radius);
        if square <= 0.0 || root < 0.0 {
            return None;
        }
        let root = root.sqrt();
        let parts = [(-half - root) / square, (-half + root) / square];
        let places = parts.into_iter().filter(|part| (0.0..=1.0).contains(part));
        places.map(|part| [line.from[0] + way[0] * part, line.from[1] + way[1] * part]).find(|&place| self.holds(place))
    }

    fn crosses(&self, other: &Turn) -> Option<Vector> {
        let way = less(other.center, self.center);
        let square = dot(way, way);
        if square <= 0.0 {
            return None;
        }
        let along = (square + self.radius * self.radius - other.radius * other.radius) / (2.0 * square);
        let beside = self.radius * self.radius / square - along * along;
        if beside < 0.0 {
            return None;
        }
        let beside = beside.sqrt();
        let at = |beside: f64| {
            [self.center[0] + way[0] * along - way[1] * beside, self.center[1] + way[1] * along + way[0] * beside]
        };
        [at(beside), at(-beside)].into_iter().find(|&place| self.holds(place) && other.holds(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A place on a curve.
    fn at(curve: &Curve, part: f64) -> Vector {
        match &curve.turn {
            None => {
                let way = less(curve.to, curve.from);
                [curve.from[0] + way[0] * part, curve.from[1] + way[1] * part]
            }
            Some(turn) => {
                let (sin, cos) = libm::sincos(turn.start_angle + turn.sweep * part);
                turn.at([cos, sin], turn.radius)
            }
        }
    }

    #[test]
    fn lines_and_arcs_approach_as_a_search_finds_it() {
        let mut seed = 12_345_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut crossings = 0;
        for _ in 0..2000 {
            let mut curve = || match random() < 0.5 {
                true => Curve::line([random() * 10.0, random() * 10.0], [random() * 10.0, random() * 10.0]),
                false => {
                    let (sin, cos) = libm::sincos(random() * 6.0);
                    let radius = 0.5 + random() * 5.0;
                    Curve::about([random() * 10.0; 2], [radius * cos, radius * sin], random() * 12.0 - 6.0)
                }
            };
            let (a, b) = (curve(), curve());
            let (found, place) = a.approach(&b);
            assert!(distance(b.nearest(place), place) < 1e-9);
            let steps = 400;
            let places = (0..=steps).map(|step| at(&a, f64::from(step) / f64::from(steps)));
            let searched = places.map(|place| distance(place, b.nearest(place))).fold(f64::INFINITY, f64::min);
            assert!(found <= searched + 1e-9 && searched < found + 0.1, "{found} {searched} {a:?} {b:?}");
            crossings += u32::from(found == 0.0);
        }
        assert!(crossings > 100);
    }

    #[test]
    fn what_lies_before_and_behind_a_place_is_the_whole() {
        let half = Curve::about([0.0, 0.0], [5.0, 0.0], TAU / 2.0);
        let top = [0.0, 5.0];
        let (before, behind) = (half.before(top), half.behind(top));
        assert_eq!((before.from, before.to, behind.from, behind.to), (half.from, top, top, half.to));
        let sweep = |curve: &Curve| curve.turn.map_or(0.0, |turn| turn.sweep);
        assert!((sweep(&before) - TAU / 4.0).abs() < 1e-12 && (sweep(&behind) - TAU / 4.0).abs() < 1e-12);
        let extent = half.extent();
        assert_eq!((extent.low[0], extent.high), (-5.0, [5.0, 5.0]));
    }
}
