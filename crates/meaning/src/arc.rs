//! Centre and sense of an arc from its words: I J K, or R.
//!
//! YASNAC MX1 reference: centre words count from the start point whatever G90 or G91 says, a missing one is zero;
//! R > 0 is an arc up to 180°, R < 0 the greater one; R wins over I J K; an end off the circle is reached on a spiral.

use base::Condition;

use crate::command::Body;
use crate::operation::{Act, ArcMove, Feed};
use crate::setting::to_mm;

/// What the words of an arc say, in counts, along the two axes of its plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ArcWords {
    pub start: [f64; 2],
    pub end: [f64; 2],
    /// The centre from the start point, if any of its words stands in the block.
    pub center: Option<[f64; 2]>,
    pub radius: Option<f64>,
    pub clockwise: bool,
    /// By how much a radius may be too short, in counts.
    pub radius_tolerance: f64,
    /// By how much the end may be off the circle, in counts; 0 = no limit.
    pub end_limit: f64,
}

/// A solved arc.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Solved {
    pub center: [f64; 2],
    pub full_circle: bool,
}

/// A refused arc: the condition and its numbers in mm.
type Refused = (Condition, [f64; 3]);

/// Solves an arc. `None` is an arc of no motion (a radius, and the end is the start).
pub(crate) fn solve(words: ArcWords) -> Result<Option<Solved>, Refused> {
    match (words.radius, words.center) {
        (Some(radius), _) => by_radius(words, radius),
        (None, Some(center)) => by_center(words, center).map(Some),
        (None, None) => Err((Condition::ArcWithoutCentre, [0.0; 3])),
    }
}

fn by_radius(words: ArcWords, radius: f64) -> Result<Option<Solved>, Refused> {
    let chord = [words.end[0] - words.start[0], words.end[1] - words.start[1]];
    let length = libm::hypot(chord[0], chord[1]);
    if length == 0.0 {
        return Ok(None);
    }
    let (half, size) = (length / 2.0, radius.abs());
    if half > size + words.radius_tolerance || size == 0.0 {
        return Err((Condition::ArcRadiusTooSmall, [radius / 1e6, length / 1e6, words.radius_tolerance / 1e6]));
    }
    let height = ((size - half) * (size + half)).max(0.0).sqrt();
    // The centre lies left of start → end for the smaller arc counter-clockwise and the greater one clockwise.
    let side = if words.clockwise == (radius < 0.0) { height } else { -height };
    let center = [
        words.start[0] + chord[0] / 2.0 - chord[1] / length * side,
        words.start[1] + chord[1] / 2.0 + chord[0] / length * side,
    ];
    Ok(Some(Solved { center, full_circle: false }))
}

fn by_center(words: ArcWords, from_start: [f64; 2]) -> Result<Solved, Refused> {
    let center = [words.start[0] + from_start[0], words.start[1] + from_start[1]];
    let start_radius = libm::hypot(from_start[0], from_start[1]);
    if start_radius == 0.0 {
        return Err((Condition::ArcRadiusZero, [0.0; 3]));
    }
    let end_radius = libm::hypot(words.end[0] - center[0], words.end[1] - center[1]);
    let off = (end_radius - start_radius).abs();
    if words.end_limit > 0.0 && off > words.end_limit {
        return Err((Condition::ArcEndOff, [off / 1e6, words.end_limit / 1e6, 0.0]));
    }
    Ok(Solved { center, full_circle: words.start == words.end })
}

/// An arc and the straight piece from its end to where the block ends.
#[cold]
#[inline(never)]
pub(crate) fn closed_arc(body: &Body, phase: u8) -> Option<Act> {
    let Body::Arc { to, center, axes, plane, clockwise, foot: Some(foot), feed, .. } = body else { return None };
    match phase {
        0 => {
            let mut end = *to;
            for (axis, at) in axes.iter().zip(foot) {
                end[usize::from(*axis)] = *at;
            }
            let arc = ArcMove {
                to: to_mm(&end),
                plane: *plane,
                axes: *axes,
                center: center.map(|counts| counts / 1e6),
                clockwise: *clockwise,
                full_circle: false,
            };
            Some(Act::Arc { arc, feed: Feed { exact_stop: false, ..*feed } })
        }
        1 => Some(Act::Line { to: to_mm(to), feed: *feed }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words() -> ArcWords {
        ArcWords {
            start: [0.0, 0.0],
            end: [20e6, 0.0],
            center: None,
            radius: None,
            clockwise: true,
            radius_tolerance: 5000.0,
            end_limit: 0.0,
        }
    }

    #[test]
    fn the_sign_of_the_radius_and_the_sense_choose_the_side() {
        let height = (12.5f64 * 12.5 - 100.0).sqrt() * 1e6;
        for (clockwise, radius, y) in
            [(true, 12.5e6, -height), (true, -12.5e6, height), (false, 12.5e6, height), (false, -12.5e6, -height)]
        {
            let solved =
                solve(ArcWords { clockwise, radius: Some(radius), ..words() }).expect("it spans").expect("it moves");
            assert!(
                (solved.center[0] - 10e6).abs() < 1e-3 && (solved.center[1] - y).abs() < 1e-3,
                "{clockwise} {radius}"
            );
        }
    }

    #[test]
    fn a_radius_just_too_short_is_a_half_circle_and_shorter_is_refused() {
        let solved = solve(ArcWords { radius: Some(9.996e6), ..words() }).expect("within tolerance").expect("it moves");
        assert_eq!(solved.center, [10e6, 0.0]);
        let refused = solve(ArcWords { radius: Some(9.99e6), ..words() });
        assert_eq!(refused, Err((Condition::ArcRadiusTooSmall, [9.99, 20.0, 0.005])));
    }

    #[test]
    fn start_equal_to_end_is_a_circle_with_a_centre_and_nothing_with_a_radius() {
        let still = ArcWords { end: [0.0, 0.0], ..words() };
        assert_eq!(solve(ArcWords { radius: Some(5e6), ..still }), Ok(None));
        let circle = solve(ArcWords { center: Some([5e6, 0.0]), ..still });
        assert_eq!(circle, Ok(Some(Solved { center: [5e6, 0.0], full_circle: true })));
        assert_eq!(solve(ArcWords { center: Some([0.0, 0.0]), ..words() }), Err((Condition::ArcRadiusZero, [0.0; 3])));
        assert_eq!(solve(words()), Err((Condition::ArcWithoutCentre, [0.0; 3])));
    }
}
