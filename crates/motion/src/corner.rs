//! The corner between two moves: stopped at, passed as it is, or rounded within the tolerance.
//!
//! Rounded, it is a [`Way::Blend`] from an arm's length before the corner to the same length behind it. Between lines
//! that is a parabola, on which the acceleration is constant: with `Δ` the change of direction and `l` the arm it
//! leaves the corner by `l |Δ| / 4` and asks `v² |Δᵢ| / 2l` of axis `i`. The arm is the shortest one that lets the
//! commanded feed pass, at most half of either way, and no longer than the tolerance allows.

use crate::limits::Limits;
use crate::way::{Way, dot, norm};

/// What becomes of a corner.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Corner {
    /// The axes stand in it.
    Stop,
    /// The ways go over into each other.
    Passed,
    /// It is rounded, with an arm of this length, mm.
    Rounded(f64),
}

/// A turn as sharp as this (its cosine) is a reversal and stopped at, whatever the tolerance: 150°.
const REVERSAL: f64 = -0.866;
/// The part of an axis' acceleration which a change of direction within one servo period may take and still counts as
/// none.
const UNNOTICED: f64 = 2e-4;
/// By how much longer than needed for the feed an arm is, so that speed can change in it: between lines, and beside arcs.
const ROOM: f64 = 2.0;
const ROOM_BESIDE_ARCS: f64 = 3.0;
/// How much of the tolerance is used where one of the ways is itself bent.
const SHARE_BESIDE_ARCS: f64 = 0.5;
/// The shortest arm, mm; a corner without room for it is a stop.
const SHORTEST: f64 = 1e-7;

/// The corner from one way into the next, both driven at no more than `speed` (mm/s).
pub fn corner(limits: &Limits, before: &Way, after: &Way, speed: f64) -> Corner {
    let count = limits.count;
    let (mut first, mut second) = (before.slope(before.length()), after.slope(0.0));
    for slope in [&mut first, &mut second] {
        let length = norm(slope, count);
        for part in slope {
            *part /= length;
        }
    }
    let (mut change, mut needed, mut noticed) = (0.0, 0.0f64, false);
    for axis in 0..count {
        let turned = (second[axis] - first[axis]).abs();
        let acceleration = limits.axes[axis].acceleration;
        change += turned * turned;
        needed = needed.max(turned / acceleration);
        noticed |= turned * speed > UNNOTICED * acceleration * limits.servo_period;
    }
    if !noticed {
        return Corner::Passed;
    }
    let change: f64 = f64::sqrt(change);
    if limits.corner_tolerance <= 0.0 || dot(&first, &second, count) < REVERSAL {
        return Corner::Stop;
    }
    let straight = before.is_straight() && after.is_straight();
    let (room, share) = if straight { (ROOM, 1.0) } else { (ROOM_BESIDE_ARCS, SHARE_BESIDE_ARCS) };
    let half = before.length().min(after.length()) / 2.0;
    let tolerated = 4.0 * share * limits.corner_tolerance / change;
    let arm = half.min(tolerated).min(room * needed * speed * speed / 2.0);
    if arm > SHORTEST { Corner::Rounded(arm) } else { Corner::Stop }
}
