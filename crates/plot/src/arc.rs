//! The geometry of an arc: points on it, its length, its extent, how far it bends.
//!
//! Radius and third axis change linearly with the angle: circle, helix, spiral and conical helix are one curve.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::extent::Extent;
use crate::stroke::{Arc, Plane};

/// An arc with its angles worked out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curve {
    pub plane: Plane,
    center: [f64; 2],
    start_rad: f64,
    pub sweep_rad: f64,
    start_radius: f64,
    end_radius: f64,
    start_height: f64,
    end_height: f64,
}

/// No arc is cut into more chords than this.
const MOST_STEPS: f64 = 20_000.0;

impl Curve {
    /// The curve from one point to another, all in mm.
    pub fn new(from: [f64; 3], to: [f64; 3], arc: &Arc) -> Curve {
        let [first, second, third] = arc.plane.axes();
        let start = [from[first] - arc.center[0], from[second] - arc.center[1]];
        let end = [to[first] - arc.center[0], to[second] - arc.center[1]];
        let (start_radius, end_radius) = (libm::hypot(start[0], start[1]), libm::hypot(end[0], end[1]));
        let sweep_rad = arc.sweep_deg.to_radians();
        // A spiral that begins at its centre has its direction from its end.
        let start_rad = if start_radius > end_radius * 1e-9 {
            libm::atan2(start[1], start[0])
        } else {
            libm::atan2(end[1], end[0]) - sweep_rad
        };
        Curve {
            plane: arc.plane,
            center: arc.center,
            start_rad,
            sweep_rad,
            start_radius,
            end_radius,
            start_height: from[third],
            end_height: to[third],
        }
    }

    /// The point at a fraction of the sweep (0 start, 1 end), in mm.
    pub fn at(&self, fraction: f64) -> [f64; 3] {
        let angle = self.start_rad + self.sweep_rad * fraction;
        let radius = self.start_radius + (self.end_radius - self.start_radius) * fraction;
        let [first, second, third] = self.plane.axes();
        let mut point = [0.0; 3];
        point[first] = self.center[0] + radius * libm::cos(angle);
        point[second] = self.center[1] + radius * libm::sin(angle);
        point[third] = self.start_height + (self.end_height - self.start_height) * fraction;
        point
    }

    /// Calls `point` with the inner ends of so many equal chords, in order: one less than there are chords.
    pub fn for_each_inner(&self, chords: usize, mut point: impl FnMut([f64; 3])) {
        let part = 1.0 / chords as f64;
        let (sin, cos) = libm::sincos(self.sweep_rad * part);
        let (mut y, mut x) = libm::sincos(self.start_rad);
        let [first, second, third] = self.plane.axes();
        for chord in 1..chords {
            // Turning the direction on is much faster than a sine and a cosine each time, and as exact as is needed.
            (x, y) = (x * cos - y * sin, x * sin + y * cos);
            let fraction = chord as f64 * part;
            let radius = self.start_radius + (self.end_radius - self.start_radius) * fraction;
            let mut inner = [0.0; 3];
            inner[first] = self.center[0] + radius * x;
            inner[second] = self.center[1] + radius * y;
            inner[third] = self.start_height + (self.end_height - self.start_height) * fraction;
            point(inner);
        }
    }

    /// The fraction of the sweep at which the curve's angle is that of a point, of several turns the one nearest to another.
    pub fn nearest(&self, point: [f64; 3], near: f64) -> f64 {
        let [first, second, _] = self.plane.axes();
        let angle = libm::atan2(point[second] - self.center[1], point[first] - self.center[0]) - self.start_rad;
        let turns = ((near * self.sweep_rad - angle) / TAU).round();
        ((angle + turns * TAU) / self.sweep_rad).clamp(0.0, 1.0)
    }

    /// The greater of the two radii in mm.
    pub fn radius(&self) -> f64 {
        self.start_radius.max(self.end_radius)
    }

    /// True if the curve is a circle's arc in the XY plane to within a tolerance in mm, whatever Z does.
    pub fn is_round_in_plan(&self, tolerance_mm: f64) -> bool {
        self.plane == Plane::Xy && (self.end_radius - self.start_radius).abs() <= tolerance_mm
    }

    /// True if the third axis stands still.
    pub fn is_flat(&self) -> bool {
        self.start_height == self.end_height
    }

    /// A bound in mm of the distance between the curve and its chord, at the same fraction of both.
    pub fn bend_mm(&self) -> f64 {
        let sweep = self.sweep_rad.abs();
        (2.0 * (self.end_radius - self.start_radius).abs() * sweep + self.radius() * sweep * sweep) / 8.0
    }

    /// How many equal chords stay within a tolerance in mm of the curve.
    pub fn steps(&self, tolerance_mm: f64) -> usize {
        let least = (self.sweep_rad.abs() / FRAC_PI_2).ceil();
        (self.bend_mm() / tolerance_mm).sqrt().ceil().max(least).clamp(1.0, MOST_STEPS) as usize
    }

    /// The length along the curve in mm.
    pub fn length_mm(&self) -> f64 {
        let (widening, rise) = (self.end_radius - self.start_radius, self.end_height - self.start_height);
        let speed = |fraction: f64| {
            let around = (self.start_radius + widening * fraction) * self.sweep_rad;
            (widening * widening + around * around + rise * rise).sqrt()
        };
        if widening == 0.0 {
            return speed(0.0);
        }
        // Simpson's rule: the integrand is smooth, sixteen intervals are far below a micrometre.
        const INTERVALS: usize = 16;
        let sum: f64 = (0..=INTERVALS)
            .map(|step| {
                let weight = match step {
                    0 | INTERVALS => 1.0,
                    odd if odd % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                weight * speed(step as f64 / INTERVALS as f64)
            })
            .sum();
        sum / (3.0 * INTERVALS as f64)
    }

    /// The box around the curve: its ends and where it crosses the directions of the plane's axes.
    pub fn extent(&self, from: [f64; 3], to: [f64; 3]) -> Extent {
        let mut extent = Extent::EMPTY;
        extent.include(from);
        extent.include(to);
        let (low, high) = if self.sweep_rad < 0.0 { (self.sweep_rad, 0.0) } else { (0.0, self.sweep_rad) };
        // More than a turn crosses every direction; on a spiral the outermost turns are the first or the last one.
        let first = ((self.start_rad + low) / FRAC_PI_2).ceil();
        let last = ((self.start_rad + high) / FRAC_PI_2).floor();
        let crossings = last - first + 1.0;
        for nth in 0..crossings.clamp(0.0, 8.0) as u32 {
            let from_front = f64::from(nth.min(3)) + first;
            let quarter = if nth < 4 { from_front } else { last - f64::from(nth - 4) };
            if quarter <= last && self.sweep_rad.abs() > TAU * 1e-12 {
                extent.include(self.at((quarter * FRAC_PI_2 - self.start_rad) / self.sweep_rad));
            }
        }
        extent
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::piece::distance;

    const NEAR_MM: f64 = 1e-9;

    fn arc(plane: Plane, center: [f64; 2], sweep_deg: f64) -> Arc {
        Arc { plane, center, sweep_deg }
    }

    #[test]
    fn a_quarter_circle_passes_its_middle_on_the_right_side() {
        let diagonal = 10.0 / 2f64.sqrt();
        let ccw = Curve::new([10.0, 0.0, 0.0], [0.0, 10.0, 0.0], &arc(Plane::Xy, [0.0; 2], 90.0));
        assert!(distance(ccw.at(0.5), [diagonal, diagonal, 0.0]) < NEAR_MM);
        let cw = Curve::new([10.0, 0.0, 0.0], [0.0, 10.0, 0.0], &arc(Plane::Xy, [0.0; 2], -270.0));
        assert!(distance(cw.at(0.5), [-diagonal, -diagonal, 0.0]) < NEAR_MM);
        // Z to X is counter-clockwise seen from +Y.
        let zx = Curve::new([0.0, 0.0, 10.0], [10.0, 0.0, 0.0], &arc(Plane::Zx, [0.0; 2], 90.0));
        assert!(distance(zx.at(0.5), [diagonal, 0.0, diagonal]) < NEAR_MM);
        let yz = Curve::new([0.0, 10.0, 0.0], [0.0, 0.0, 10.0], &arc(Plane::Yz, [0.0; 2], 90.0));
        assert!(distance(yz.at(0.5), [0.0, diagonal, diagonal]) < NEAR_MM);
    }

    #[test]
    fn the_length_of_a_helix_and_of_a_spiral() {
        let helix = Curve::new([5.0, 0.0, 0.0], [5.0, 0.0, -3.0], &arc(Plane::Xy, [0.0; 2], 720.0));
        assert!((helix.length_mm() - (20.0 * std::f64::consts::PI).hypot(3.0)).abs() < NEAR_MM);
        // Archimedes from the centre: r = a·θ, length = a/2 (θ√(1+θ²) + asinh θ).
        let spiral = Curve::new([0.0; 3], [TAU, 0.0, 0.0], &arc(Plane::Xy, [0.0; 2], 360.0));
        let exact = 0.5 * (TAU * (1.0 + TAU * TAU).sqrt() + TAU.asinh());
        assert!((spiral.length_mm() - exact).abs() < 1e-3);
    }

    #[test]
    fn the_extent_knows_the_outermost_points() {
        let half = Curve::new([10.0, 0.0, 0.0], [-10.0, 0.0, 2.0], &arc(Plane::Xy, [0.0; 2], 180.0));
        let extent = half.extent([10.0, 0.0, 0.0], [-10.0, 0.0, 2.0]);
        assert!((extent.max[1] - 10.0).abs() < NEAR_MM && extent.min[1].abs() < NEAR_MM);
        let turns = Curve::new([1.0, 0.0, 0.0], [9.0, 0.0, 0.0], &arc(Plane::Xy, [0.0; 2], 1800.0));
        assert!(turns.extent([1.0, 0.0, 0.0], [9.0, 0.0, 0.0]).min[0] < -8.0);
    }

    proptest::proptest! {
        #[test]
        fn chords_stay_within_the_tolerance(
            start in 0.5..20.0f64, end in 0.5..20.0f64, sweep in -900.0..900.0f64, rise in -9.0..9.0f64,
        ) {
            let angle = sweep.to_radians();
            let (from, to) = ([start, 0.0, 0.0], [end * angle.cos(), end * angle.sin(), rise]);
            let curve = Curve::new(from, to, &arc(Plane::Xy, [0.0; 2], sweep));
            let steps = curve.steps(0.01);
            let mut ends = vec![from];
            curve.for_each_inner(steps, |inner| ends.push(inner));
            ends.push(to);
            proptest::prop_assert_eq!(ends.len(), steps + 1);
            for (step, pair) in ends.windows(2).enumerate() {
                let [a, b] = [pair[0], pair[1]];
                proptest::prop_assert!(distance(a, curve.at(step as f64 / steps as f64)) < NEAR_MM);
                let middle = curve.at((step as f64 + 0.5) / steps as f64);
                let chord: [f64; 3] = std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]));
                proptest::prop_assert!(distance(middle, chord) <= 0.0101);
            }
        }
    }
}
