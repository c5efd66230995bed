//! The exact arc: a circle, a helix, or a spiral whose radius changes steadily with the angle.

use base::{AXES, AxisSet, Point};
use meaning::{ArcMove, Plane};

use std::f64::consts::TAU;

/// An arc in one plane; every other axis moves in step with the angle. Lengths in mm (degrees on rotary axes).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Arc {
    /// Where all axes are at its start.
    pub from: Point,
    /// Where all axes are at its end.
    pub to: Point,
    /// Its plane.
    pub plane: Plane,
    /// The two axes of the plane.
    pub axes: [u8; 2],
    /// The centre along those axes.
    pub center: [f64; 2],
    /// Radius at the start and at the end; they differ where the programmed end is off the circle.
    pub radius: [f64; 2],
    /// Angle of the start, radians from the first axis towards the second.
    pub start_angle: f64,
    /// Angle swept, radians, + counter-clockwise seen from the + end of the third axis; a full circle is ±2π.
    pub sweep: f64,
}

/// An end less than this beside the ray from the centre through the start, mm, lies on it: far below any increment.
const ON_THE_RAY: f64 = 1e-7;
/// Steps in which the extreme of an ordinary spiral is found.
const SEARCH_STEPS: usize = 6;
/// Radians; a coordinate changes by the square of it at an extreme.
const SEARCH_EXACTNESS: f64 = 1e-9;
/// Halvings of a whole turn down to the last digit, for spirals that grow faster than they turn.
const HALVINGS: usize = 56;

/// The angle swept from one spoke to another, radians, + counter-clockwise.
pub(crate) fn sweep_between(start: [f64; 2], end: [f64; 2], clockwise: bool, full_circle: bool) -> f64 {
    if full_circle {
        return if clockwise { -TAU } else { TAU };
    }
    let cross = start[0] * end[1] - start[1] * end[0];
    let dot = start[0] * end[0] + start[1] * end[1];
    let beside = cross / libm::hypot(start[0], start[1]);
    // On the ray itself rounding must not choose between a full turn and none: it is a turn.
    let turn = if dot > 0.0 && beside.abs() < ON_THE_RAY { 0.0 } else { libm::atan2(cross, dot) };
    match clockwise {
        true if turn >= 0.0 => turn - TAU,
        false if turn <= 0.0 => turn + TAU,
        _ => turn,
    }
}

impl Arc {
    /// The arc from `from` as the block gives it.
    pub fn new(from: &Point, arc: &ArcMove) -> Arc {
        let [u, v] = arc.axes.map(usize::from);
        let start = [from[u] - arc.center[0], from[v] - arc.center[1]];
        let end = [arc.to[u] - arc.center[0], arc.to[v] - arc.center[1]];
        let sweep = sweep_between(start, end, arc.clockwise, arc.full_circle);
        Arc {
            from: *from,
            to: arc.to,
            plane: arc.plane,
            axes: arc.axes,
            center: arc.center,
            radius: [libm::hypot(start[0], start[1]), libm::hypot(end[0], end[1])],
            start_angle: libm::atan2(start[1], start[0]),
            sweep,
        }
    }

    /// The angle swept up to a point on it, between nothing and the whole sweep, and how far that is from the centre.
    pub(crate) fn turned_to(&self, at: &Point) -> (f64, f64) {
        let [u, v] = self.axes.map(|axis| usize::from(axis) % AXES);
        let spoke = [at[u] - self.center[0], at[v] - self.center[1]];
        let turn = TAU.copysign(self.sweep);
        let mut sweep = (libm::atan2(spoke[1], spoke[0]) - self.start_angle) % turn;
        if sweep * turn < 0.0 {
            sweep += turn;
        }
        let beyond = (sweep - self.sweep) * self.sweep.signum();
        if beyond > 0.0 {
            // By rounding it lies a little behind the end, or before the start.
            sweep = if beyond < (turn - sweep).abs() { self.sweep } else { 0.0 };
        }
        (sweep, libm::hypot(spoke[0], spoke[1]))
    }

    /// Where all axes are after the fraction `s` (0 to 1) of the sweep.
    pub fn at(&self, s: f64) -> Point {
        if s <= 0.0 {
            return self.from;
        }
        if s >= 1.0 {
            return self.to;
        }
        let mut point = [0.0; AXES];
        for axis in 0..AXES {
            point[axis] = self.from[axis] + (self.to[axis] - self.from[axis]) * s;
        }
        let radius = self.radius[0] + (self.radius[1] - self.radius[0]) * s;
        let (sin, cos) = libm::sincos(self.start_angle + self.sweep * s);
        let [u, v] = self.axes.map(usize::from);
        point[u] = self.center[0] + radius * cos;
        point[v] = self.center[1] + radius * sin;
        point
    }

    /// Length along the arc in its plane, mm.
    pub fn plane_length(&self) -> f64 {
        let angle = self.sweep.abs();
        let growth = (self.radius[1] - self.radius[0]) / angle;
        let mean = (self.radius[0] + self.radius[1]) / 2.0;
        // Below this the spiral's own term changes less than the last digit.
        if growth.abs() <= mean * 1e-8 {
            return mean * angle;
        }
        // ∫ √(r² + growth²) dr / growth
        let part = |r: f64| (r * libm::hypot(r, growth) + growth * growth * libm::asinh(r / growth.abs())) / 2.0;
        ((part(self.radius[1]) - part(self.radius[0])) / growth).abs()
    }

    /// Length along the path with the axes beside the plane, mm (degrees count as mm).
    pub fn length(&self) -> f64 {
        let others: f64 = (0..AXES)
            .filter(|&axis| !self.axes.contains(&(axis as u8)))
            .map(|axis| (self.to[axis] - self.from[axis]) * (self.to[axis] - self.from[axis]))
            .sum();
        let plane = self.plane_length();
        (plane * plane + others).sqrt()
    }

    /// The fractions of the sweep at which the plane's axes turn round, in order; at most seven.
    pub fn turning_points(&self) -> impl Iterator<Item = f64> {
        let quarter = TAU / 4.0;
        let direction = self.sweep.signum();
        let first =
            if direction > 0.0 { (self.start_angle / quarter).ceil() } else { (self.start_angle / quarter).floor() };
        // A spiral turns beside its quadrants, so the one before the start and the one after the end count too.
        (-1..6).filter_map(move |step| {
            let s = (self.turn_near((first + direction * f64::from(step)) * quarter) - self.start_angle) / self.sweep;
            (s > 0.0 && s < 1.0).then_some(s)
        })
    }

    /// The angle at which an axis turns round, near the quadrant at which a circle's does.
    ///
    /// With `g` the growth of the radius an angle, it lies where `angle = quadrant + atan2(g, r(angle))`; the right side
    /// falls as the angle grows, so there is one such angle.
    fn turn_near(&self, quadrant: f64) -> f64 {
        let growth = (self.radius[1] - self.radius[0]) / self.sweep;
        if growth == 0.0 {
            return quadrant;
        }
        let beside = |angle: f64| quadrant + libm::atan2(growth, self.radius[0] + growth * (angle - self.start_angle));
        // A spiral as programs have it, a hair off its circle, is found in two or three steps.
        let mut angle = quadrant;
        for _ in 0..SEARCH_STEPS {
            let next = beside(angle);
            if (next - angle).abs() < SEARCH_EXACTNESS {
                return next;
            }
            angle = next;
        }
        let (mut low, mut high) = (quadrant - TAU / 2.0, quadrant + TAU / 2.0);
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            if beside(middle) > middle { low = middle } else { high = middle }
        }
        (low + high) / 2.0
    }

    /// Lowest and highest coordinate of every axis along the whole arc.
    pub fn extent(&self) -> (Point, Point) {
        let (mut low, mut high) = (self.from, self.from);
        let mut take = |point: &Point| {
            for axis in 0..AXES {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        };
        take(&self.to);
        for s in self.turning_points() {
            take(&self.at(s));
        }
        (low, high)
    }

    /// The fraction of the sweep at which one of these axes first leaves its limits, and that axis.
    pub fn first_exit(&self, axes: AxisSet, low: &Point, high: &Point) -> Option<(f64, usize)> {
        let outside = |s: f64| {
            let point = self.at(s);
            axes.iter().find(|&axis| point[axis] < low[axis] || point[axis] > high[axis])
        };
        let mut inside = 0.0;
        // Between two turning points every axis runs one way, so a limit is crossed at most once.
        for end in self.turning_points().chain([1.0]) {
            if outside(end).is_some() {
                let mut beyond = end;
                for _ in 0..60 {
                    let middle = (inside + beyond) / 2.0;
                    if outside(middle).is_some() { beyond = middle } else { inside = middle }
                }
                return outside(beyond).map(|axis| (inside, axis));
            }
            inside = end;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(from: [f64; 3], to: [f64; 3], center: [f64; 2], clockwise: bool) -> Arc {
        let point = |p: [f64; 3]| [p[0], p[1], p[2], 0.0, 0.0, 0.0, 0.0, 0.0];
        let (from, to) = (point(from), point(to));
        let full_circle = from[..2] == to[..2];
        Arc::new(&from, &ArcMove { to, plane: Plane::Xy, axes: [0, 1], center, clockwise, full_circle })
    }

    #[test]
    fn quarters_halves_and_circles_sweep_exactly() {
        let quarter = arc([10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0], false);
        assert_eq!(quarter.sweep.to_degrees(), 90.0);
        let rest = arc([10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0], true);
        assert_eq!(rest.sweep.to_degrees(), -270.0);
        let circle = arc([10.0, 0.0, 0.0], [10.0, 0.0, -3.0], [0.0, 0.0], true);
        assert_eq!(circle.sweep.to_degrees(), -360.0);
        assert!((circle.length() - (20.0 * std::f64::consts::PI).hypot(3.0)).abs() < 1e-9);
    }

    #[test]
    fn the_extent_of_an_arc_is_that_of_its_bulge() {
        let bulge = arc([8.0, -6.0, 0.0], [8.0, 6.0, 5.0], [0.0, 0.0], false);
        let (low, high) = bulge.extent();
        assert!((high[0] - 10.0).abs() < 1e-12 && (low[0] - 8.0).abs() < 1e-12);
        assert_eq!((low[1], high[1], low[2], high[2]), (-6.0, 6.0, 0.0, 5.0));
    }

    #[test]
    fn the_extent_and_length_of_a_spiral_agree_with_small_steps() {
        let spiral = arc([10.0, 0.0, 0.0], [-4.0, 3.0, 0.0], [0.0, 0.0], false);
        let (low, high) = spiral.extent();
        let steps = 200_000;
        let (mut length, mut most, mut last) = (0.0, f64::MIN, spiral.at(0.0));
        for step in 1..=steps {
            let point = spiral.at(f64::from(step) / f64::from(steps));
            length += libm::hypot(point[0] - last[0], point[1] - last[1]);
            most = most.max(point[1]);
            last = point;
        }
        assert!((spiral.plane_length() - length).abs() < 1e-6, "{} {length}", spiral.plane_length());
        assert!((high[1] - most).abs() < 1e-7, "{} {most}", high[1]);
        assert_eq!((low[0], high[0]), (-4.0, 10.0));
    }

    #[test]
    fn a_spiral_that_ends_on_its_start_ray_turns_once_wherever_it_lies() {
        for shift in 0..500 {
            let at = f64::from(shift) / 10.0;
            let spiral = arc([300.0 + at, 400.0, 0.0], [600.0 + at, 800.0, 0.0], [at, 0.0], false);
            assert_eq!(spiral.sweep, TAU, "{at}");
        }
    }

    #[test]
    fn the_border_is_met_where_it_is() {
        let half = arc([10.0, 0.0, 0.0], [-10.0, 0.0, 0.0], [0.0, 0.0], false);
        let (low, mut high) = ([-100.0; AXES], [100.0; AXES]);
        assert_eq!(half.first_exit(AxisSet(0b11), &low, &high), None);
        high[1] = 5.0;
        let (s, axis) = half.first_exit(AxisSet(0b11), &low, &high).expect("it leaves");
        assert_eq!(axis, 1);
        assert!((half.at(s)[1] - 5.0).abs() < 1e-9 && s < 0.2);
    }
}
