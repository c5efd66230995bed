//! Corners and jumps of curvature under a limit of jerk: how they are rounded so that the bend of the way is steady.
//!
//! Lines are rounded together ([`polygon`](super::polygon)). Beside arcs three cubics of equal length, from an arm's length
//! before the joint to the same length behind it, meet place, slope and bend of both ways. Where the direction does not
//! jump, a jump `k` of the bend is left by only about `0.003 k arm²`.

use base::{AXES, Point};

use crate::limits::Limits;
use crate::way::{Way, dot, norm};

/// What becomes of the joint between two ways.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Joint {
    /// The axes stand.
    Rest,
    /// The ways go over into each other.
    Passed,
    /// A corner between lines: how the direction changes.
    Corner(Point),
    /// Three cubics on arms of this length, mm.
    Arms(f64),
}

/// A turn as sharp as this (its cosine) is a reversal and stopped at, whatever the tolerance: 150°.
const REVERSAL: f64 = -0.866;
/// The part of an axis' jerk which a jump within one servo period may take and still counts as none.
const UNNOTICED: f64 = 2e-4;
/// The shortest line that is rounded and the shortest arm, mm; a corner without room for it is a stop.
const SHORTEST: f64 = 1e-6;
/// The part of the tolerance that is used: deviations of arms are looked at in samples.
pub const USED: f64 = 0.95;
/// By how much of arm times change of direction, and of the arm's square times change of bend, three cubics leave the way.
const BY_TURN: f64 = 0.19;
const BY_BEND: f64 = 0.0035;
/// The most that an arc turns along an arm, radians.
const WIDEST: f64 = 0.5;
/// Samples on each arm, and how often an arm is shortened.
const SAMPLES: usize = 8;
const TRIES: usize = 12;

/// The joint of two ways driven at no more than `speed`.
pub fn joint(limits: &Limits, before: &Way, after: &Way, speed: f64) -> Joint {
    let count = limits.count;
    let end = before.length();
    let (first, second) = (before.slope(end), after.slope(0.0));
    let (bent, bends) = (before.bend(end), after.bend(0.0));
    let (mut change, mut jump) = ([0.0; AXES], [0.0; AXES]);
    let mut noticed = false;
    for axis in 0..count {
        change[axis] = second[axis] - first[axis];
        jump[axis] = bends[axis] - bent[axis];
        let (limit, period) = (&limits.axes[axis], limits.servo_period);
        let most = UNNOTICED * limit.acceleration.min(limit.jerk * period);
        noticed |= change[axis].abs() * speed > most * period || jump[axis].abs() * speed * speed > most;
    }
    if !noticed {
        return Joint::Passed;
    }
    let lengths = norm(&first, count) * norm(&second, count);
    if limits.corner_tolerance <= 0.0 || dot(&first, &second, count) < REVERSAL * lengths {
        return Joint::Rest;
    }
    let (turn, jump) = (norm(&change, count), norm(&jump, count));
    if before.is_straight() && after.is_straight() {
        let short = before.length().min(after.length()) < SHORTEST;
        return if short { Joint::Rest } else { Joint::Corner(change) };
    }
    arms(limits, before, after, turn, jump)
}

/// The widest hat of a corner between two directions that is not near another one.
pub fn widest(limits: &Limits, before: &Point, behind: &Point) -> f64 {
    let change: Point = std::array::from_fn(|axis| behind[axis] - before[axis]);
    6.0 * USED * limits.corner_tolerance / norm(&change, limits.count)
}

fn arms(limits: &Limits, before: &Way, after: &Way, turn: f64, jump: f64) -> Joint {
    let tolerance = USED * limits.corner_tolerance;
    // The larger root of BY_BEND jump l² + BY_TURN turn l = tolerance, without cancelling.
    let linear = BY_TURN * turn;
    let estimate = 2.0 * tolerance / (linear + (linear * linear + 4.0 * BY_BEND * jump * tolerance).sqrt());
    let mut arm = estimate.min(longest(before)).min(longest(after));
    for _ in 0..TRIES {
        if arm <= SHORTEST {
            break;
        }
        let left = deviation(before, after, arm, limits.count);
        if left <= tolerance {
            return Joint::Arms(arm);
        }
        arm *= (USED * tolerance / left).clamp(0.1, 0.9);
    }
    Joint::Rest
}

/// The longest arm on a way.
fn longest(way: &Way) -> f64 {
    let half = way.length() / 2.0;
    match way {
        Way::Arc { arc, length } => half.min(length * WIDEST / arc.sweep.abs()),
        _ => half,
    }
}

/// How far the cubics leave the way at most; an upper bound, for places of the same length are compared.
fn deviation(before: &Way, after: &Way, arm: f64, count: usize) -> f64 {
    let cubics = cubics(before, after, arm);
    let third = arm * 2.0 / 3.0;
    let mut most = 0.0f64;
    for sample in 1..2 * SAMPLES {
        let s = arm * sample as f64 / SAMPLES as f64;
        let index = ((s / third) as usize).min(2);
        let at = cubics[index].at(s - third * index as f64);
        let meant = if s < arm { before.at(before.length() - arm + s) } else { after.at(s - arm) };
        let apart: Point = std::array::from_fn(|axis| at[axis] - meant[axis]);
        most = most.max(norm(&apart, count));
    }
    most
}

/// The three cubics on arms of this length.
pub fn cubics(before: &Way, after: &Way, arm: f64) -> [Way; 3] {
    let (start, length) = (before.length() - arm, 2.0 * arm);
    let h = length / 3.0;
    let [mut place, mut slope, mut bend] = [before.at(start), before.slope(start), before.bend(start)];
    let [to, slope_to, bend_to] = [after.at(arm), after.slope(arm), after.bend(arm)];
    let mut twists = [[0.0; AXES]; 3];
    for axis in 0..AXES {
        let bent = bend_to[axis] - bend[axis];
        let turned = slope_to[axis] - slope[axis] - bend[axis] * length;
        let moved = to[axis] - place[axis] - (slope[axis] + bend[axis] * length / 2.0) * length;
        // j + k + l = a; 5j + 3k + l = 2b; 19j + 7k + l = c.
        let (a, b, c) = (bent / h, turned / (h * h), 6.0 * moved / (h * h * h));
        let j = (c + 2.0 * a - 6.0 * b) / 6.0;
        let k = b - a / 2.0 - 2.0 * j;
        (twists[0][axis], twists[1][axis], twists[2][axis]) = (j, k, a - j - k);
    }
    twists.map(|twist| {
        let terms = [place, slope, bend.map(|bend| bend / 2.0), twist.map(|twist| twist / 6.0)];
        let way = Way::Blend { terms, length: h };
        (place, slope, bend) = (way.at(h), way.slope(h), way.bend(h));
        way
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::AxisLimits;
    use crate::way::expect::{point, steady};
    use meaning::{ArcMove, Plane};
    use path::Arc;

    fn limits() -> Limits {
        let axis = AxisLimits { rapid: 200.0, max_feed: 200.0, acceleration: 500.0, jerk: 5000.0 };
        Limits { axes: [axis; AXES], count: 2, corner_tolerance: 0.01, ..Limits::default() }
    }

    fn quarter() -> Way {
        let arc = ArcMove {
            to: point(10.0, 10.0),
            plane: Plane::Xy,
            axes: [0, 1],
            center: [0.0, 10.0],
            clockwise: false,
            full_circle: false,
        };
        Way::arc(&Arc::new(&point(0.0, 0.0), &arc))
    }

    #[test]
    fn a_line_goes_over_into_an_arc_with_a_steady_bend_and_within_the_tolerance() {
        let (line, arc) = (Way::line(&point(-20.0, 0.0), &point(0.0, 0.0), 2), quarter());
        let Joint::Arms(arm) = joint(&limits(), &line, &arc, 100.0) else { panic!("a jump of curvature") };
        assert!(arm > 3.0, "long, for it leaves the way by little: {arm}");
        let [first, second, third] = cubics(&line, &arc, arm);
        steady(&[first, second, third]);
        for (one, s, other, t) in [(&line, 20.0 - arm, &first, 0.0), (&third, third.length(), &arc, arm)] {
            for axis in 0..2 {
                assert!((one.at(s)[axis] - other.at(t)[axis]).abs() < 1e-12);
                assert!((one.slope(s)[axis] - other.slope(t)[axis]).abs() < 1e-12);
                assert!((one.bend(s)[axis] - other.bend(t)[axis]).abs() < 1e-11);
            }
        }
        assert!(deviation(&line, &arc, arm, 2) <= 0.01 && deviation(&line, &arc, arm * 2.5, 2) > 0.01);
        // At 1 mm/s nobody notices it.
        assert_eq!(joint(&limits(), &line, &arc, 0.001), Joint::Passed);
    }

    #[test]
    fn reversals_and_a_tolerance_of_none_are_stops() {
        let (there, back) =
            (Way::line(&point(0.0, 0.0), &point(5.0, 0.0), 2), Way::line(&point(5.0, 0.0), &point(0.0, 0.1), 2));
        assert_eq!(joint(&limits(), &there, &back, 10.0), Joint::Rest);
        let aside = Way::line(&point(5.0, 0.0), &point(5.0, 5.0), 2);
        assert!(matches!(joint(&limits(), &there, &aside, 10.0), Joint::Corner(_)));
        assert_eq!(joint(&Limits { corner_tolerance: 0.0, ..limits() }, &there, &aside, 10.0), Joint::Rest);
    }
}
