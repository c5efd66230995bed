//! The lag behind the interpolator: what exponential acceleration makes of the command of every axis.
//!
//! With `p` the command, `q` the axis and `τ` the time constant, `q' = (p - q) / τ`; so what it is behind, `e = p - q`,
//! obeys `e' = p' - e / τ`. Its solution has two parts: one that belongs to the way ([`steady`]) and one that is left
//! over from before and dies away as `exp(-t/τ)`. Both are exact for every way at constant speed.

use base::{AXES, Point};

use crate::way::Way;

/// What the axes are behind on a way that they have followed at this speed (mm/s) for long.
///
/// On a line `τ v`. On a circle, written as a complex number in the turning frame with `ω` the turn a second,
/// `iωτ r / (1 + iωτ)`: the axes run on the radius `r / √(1 + ω²τ²)`, smaller by about `v²τ² / 2r`. A spiral's radius
/// grows by `k` a second, which adds the terms with `k`.
pub fn steady(way: &Way, s: f64, speed: f64, tau: f64) -> Point {
    let following = tau * speed;
    match way {
        Way::Line { along, .. } => along.map(|along| following * along),
        Way::Arc { arc, length } => {
            let fraction = s / length;
            let mut behind: Point = std::array::from_fn(|axis| following * (arc.to[axis] - arc.from[axis]) / length);
            let growth = arc.radius[1] - arc.radius[0];
            let turned = following * arc.sweep / length;
            // B / τ = iω k τ / (1 + iωτ), everything multiplied by τ as often as it is divided by time.
            let k = following * growth / length;
            let square = 1.0 + turned * turned;
            let b = [turned * turned * k / square, turned * k / square];
            // A = (k + iω r - B) τ / (1 + iωτ)
            let radius = arc.radius[0] + growth * fraction;
            let [real, imaginary] = [k - b[0], turned * radius - b[1]];
            let a = [(real + imaginary * turned) / square, (imaginary - real * turned) / square];
            let (sin, cos) = libm::sincos(arc.start_angle + arc.sweep * fraction);
            let [u, v] = arc.axes.map(|axis| usize::from(axis) % AXES);
            behind[u] = a[0] * cos - a[1] * sin;
            behind[v] = a[0] * sin + a[1] * cos;
            behind
        }
        Way::Blend { terms: [.., cubic], .. } => {
            let (slope, bend) = (way.slope(s), way.bend(s));
            std::array::from_fn(|axis| {
                following * (slope[axis] - following * (bend[axis] - following * 6.0 * cubic[axis]))
            })
        }
    }
}

/// What is left after a time of what the axes were behind: its share.
pub fn left_after(seconds: f64, tau: f64) -> f64 {
    if seconds > 0.0 { libm::exp(-seconds / tau) } else { 1.0 }
}

/// How long the axes need until the farthest of them is no more than `width` behind, the command standing, s.
pub fn settling(behind: &Point, width: f64, tau: f64) -> f64 {
    let farthest = behind.iter().fold(0.0f64, |most, behind| most.max(behind.abs()));
    if farthest > width { tau * libm::log(farthest / width) } else { 0.0 }
}

/// The most that an axis moves anywhere on a way for each mm of it; of a spiral never less than that.
pub fn steepest(way: &Way) -> Point {
    let (first, last) = (way.slope(0.0), way.slope(way.length()));
    let mut most: Point = std::array::from_fn(|axis| first[axis].abs().max(last[axis].abs()));
    match way {
        Way::Line { .. } => {}
        Way::Arc { arc, length } => {
            let growth = (arc.radius[1] - arc.radius[0]).abs();
            let [small, large] = [arc.radius[0].min(arc.radius[1]), arc.radius[0].max(arc.radius[1])];
            let peak = libm::hypot(large * arc.sweep, growth) / length;
            // A circle's axis is fastest a quarter turn from its extreme, a spiral's beside that by less than this.
            let margin = growth / (arc.sweep.abs() * small);
            let (from, to) = (arc.start_angle, arc.start_angle + arc.sweep);
            let [low, high] = [from.min(to) - margin, from.max(to) + margin];
            let half = std::f64::consts::PI;
            for (axis, fastest) in arc.axes.into_iter().zip([half / 2.0, 0.0]) {
                let passed = ((high - fastest) / half).floor() >= ((low - fastest) / half).ceil();
                if passed || margin.is_nan() {
                    most[usize::from(axis) % AXES] = peak;
                }
            }
        }
        Way::Blend { terms: [_, b, c, d], length } => {
            for axis in 0..AXES {
                most[axis] = b[axis].abs() + length * (2.0 * c[axis].abs() + 3.0 * length * d[axis].abs());
            }
        }
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;
    use meaning::{ArcMove, Plane};
    use path::Arc;

    fn point(xyz: [f64; 3]) -> Point {
        let mut point = [0.0; AXES];
        point[..3].copy_from_slice(&xyz);
        point
    }

    /// An arc of the XY plane from (10, 0, 1) about the origin.
    fn arc(to: [f64; 3], clockwise: bool) -> Way {
        let full_circle = to[..2] == [10.0, 0.0];
        let to = point(to);
        let arc = ArcMove { to, plane: Plane::Xy, axes: [0, 1], center: [0.0; 2], clockwise, full_circle };
        Way::arc(&Arc::new(&point([10.0, 0.0, 1.0]), &arc))
    }

    fn ways() -> Vec<Way> {
        let (before, after) = (point([1.0, 0.0, 0.0]), point([0.0, 0.6, 0.8]));
        vec![
            Way::line(&point([1.0, 2.0, 3.0]), &point([4.0, -2.0, 5.0]), 3),
            arc([0.0, 10.0, 1.0], false),
            arc([0.0, 10.0, 4.0], true),
            arc([-4.0, 3.0, 1.0], false),
            arc([0.0, -25.0, 2.0], true),
            arc([10.0, 0.0, 1.0], true),
            Way::blend(&point([0.0; 3]), &before, &point([0.5, 0.7, 0.4]), &after, 1.0),
        ]
    }

    #[test]
    fn on_a_circle_the_axes_run_on_a_smaller_one() {
        // By hand: 50 mm/s on r = 10 is 5 rad/s; with τ = 0.05 s, ωτ = 0.25: r / √1.0625 = 9.701425, 14.036° behind.
        let way = arc([10.0, 0.0, 1.0], false);
        let behind = steady(&way, 0.0, 50.0, 0.05);
        let axis = [10.0 - behind[0], -behind[1]];
        assert!((libm::hypot(axis[0], axis[1]) - 9.701_425_001_453_32).abs() < 1e-12, "{axis:?}");
        assert!((libm::atan2(axis[1], axis[0]).to_degrees() + 14.036_243_467_926_479).abs() < 1e-10);
        // v²τ² / 2r = 0.3125 mm is the first term of what is lost, 0.2986 mm.
        let slow = steady(&way, 0.0, 5.0, 0.05);
        let lost = 10.0 - libm::hypot(10.0 - slow[0], slow[1]);
        assert!((lost / (0.25 * 0.25 / 20.0) - 1.0).abs() < 1e-3, "{lost}");
    }

    /// The differential equation itself, in a thousand steps of the fourth order.
    #[test]
    fn the_steady_part_obeys_the_lag() {
        let (speed, tau) = (7.0, 0.05);
        for way in ways() {
            let seconds = way.length() / speed;
            let step = seconds / 1000.0;
            let mut behind = steady(&way, 0.0, speed, tau);
            let rate = |t: f64, e: &Point| -> Point {
                let slope = way.slope(t * speed);
                std::array::from_fn(|axis| slope[axis] * speed - e[axis] / tau)
            };
            for number in 0..1000 {
                let t = f64::from(number) * step;
                let add = |e: &Point, k: &Point, h: f64| -> Point { std::array::from_fn(|i| e[i] + k[i] * h) };
                let k1 = rate(t, &behind);
                let k2 = rate(t + step / 2.0, &add(&behind, &k1, step / 2.0));
                let k3 = rate(t + step / 2.0, &add(&behind, &k2, step / 2.0));
                let k4 = rate(t + step, &add(&behind, &k3, step));
                for axis in 0..3 {
                    behind[axis] += step / 6.0 * (k1[axis] + 2.0 * k2[axis] + 2.0 * k3[axis] + k4[axis]);
                }
                if number % 100 == 99 {
                    let ours = steady(&way, (t + step) * speed, speed, tau);
                    for axis in 0..3 {
                        assert!((ours[axis] - behind[axis]).abs() < 1e-8, "{way:?} {t} {axis}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_steepest_place_is_found() {
        for way in ways() {
            let most = steepest(&way);
            for axis in 0..3 {
                let seen = (0..=4000).map(|part| way.slope(way.length() * f64::from(part) / 4000.0)[axis].abs());
                let seen = seen.fold(0.0, f64::max);
                assert!(most[axis] >= seen * (1.0 - 1e-12), "{way:?} {axis}: {} {seen}", most[axis]);
                let exact = matches!(&way, Way::Line { .. })
                    || matches!(&way, Way::Arc { arc, .. } if arc.radius[0] == arc.radius[1]);
                assert!(!exact || most[axis] <= seen * (1.0 + 1e-6), "{way:?} {axis}: {} {seen}", most[axis]);
            }
        }
    }

    #[test]
    fn a_short_arc_is_not_held_to_what_a_longer_one_needs() {
        // From 10° to 20°: X moves by sin 20° at most.
        let at = |degrees: f64| [10.0 * libm::cos(degrees.to_radians()), 10.0 * libm::sin(degrees.to_radians()), 0.0];
        let (from, to) = (point(at(10.0)), point(at(20.0)));
        let arc =
            ArcMove { to, plane: Plane::Xy, axes: [0, 1], center: [0.0; 2], clockwise: false, full_circle: false };
        let most = steepest(&Way::arc(&Arc::new(&from, &arc)));
        assert!((most[0] - libm::sin(20f64.to_radians())).abs() < 1e-9 && most[1] < 0.985, "{most:?}");
    }

    #[test]
    fn settling_is_a_logarithm() {
        // 5 mm behind, 0.01 mm wide, 0.05 s: 0.05 ln 500.
        assert!((settling(&point([5.0, -2.0, 0.0]), 0.01, 0.05) - 0.310_730_404_921_094_8).abs() < 1e-12);
        assert_eq!(settling(&point([0.01, 0.0, 0.0]), 0.01, 0.05), 0.0);
    }
}
