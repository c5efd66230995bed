//! The corner between two moves: stopped at, passed as it is, or rounded within the tolerance.
//!
//! Rounded, it is a [`Way::Blend`] from an arm's length before the corner to the same length behind it. Between lines
//! that is a parabola, on which the acceleration is constant: with `Δ` the change of direction and `l` the arm it
//! leaves the corner by `l |Δ| / 4` and asks `v² |Δᵢ| / 2l` of axis `i`. The arm is the shortest one that lets the
//! commanded feed pass, at most half of either way, and no longer than the tolerance allows.

use base::Point;

use crate::limits::Limits;
use crate::way::{Way, dot, norm};

/// What becomes of a corner.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Corner {
    /// The axes stand in it.
    Stop,
    /// The ways go over into each other, at this speed at most (mm/s).
    Passed(f64),
    /// It is rounded, with an arm of this length, mm.
    Rounded(f64),
}

/// A turn as sharp as this (its cosine) is a reversal and stopped at, whatever the tolerance: 150°.
const REVERSAL: f64 = -0.866;
/// The part of an axis' acceleration which a change of direction within one servo period may take and still counts as
/// none.
const UNNOTICED: f64 = 2e-4;
/// By how much the speed asked for may be passed there, by overrides and DRY RUN.
const FASTER: f64 = 2.0;
/// The ends of a way are exact to this, mm.
const ROUNDING: f64 = 2e-12;
/// By how much longer than needed for the feed an arm is, so that speed can change in it: between lines, and beside arcs.
const ROOM: f64 = 2.0;
const ROOM_BESIDE_ARCS: f64 = 3.0;
/// How far a bent way may turn within an arm, radians.
const MOST_TURN: f64 = 0.3;
/// Where one of the ways is bent the arm is shortened by this until the tolerance is kept to: so many times, and to that
/// part of it, as only some points are looked at.
const SHORTER: f64 = 0.7;
const MOST_TIMES: usize = 12;
const KEPT: f64 = 0.97;
/// The shortest arm, mm; a corner without room for it is a stop.
const SHORTEST: f64 = 1e-7;

/// The corner from one way into the next, both driven at no more than `speed` (mm/s), infinite where only the axes hold
/// it.
pub fn corner(limits: &Limits, before: &Way, after: &Way, speed: f64) -> Corner {
    let count = limits.count;
    let (first, second) = (heading(before, before.length()), heading(after, 0.0));
    let speed = [first, second].iter().fold(speed, |speed, along| speed.min(fastest(limits, along)));
    // Short ways have several corners in one servo period.
    let shortest = before.length().min(after.length());
    let (mut change, mut needed, mut passes) = (0.0, 0.0f64, f64::INFINITY);
    for axis in 0..count {
        let turned = (second[axis] - first[axis]).abs();
        let acceleration = limits.axes[axis].acceleration;
        change += turned * turned;
        needed = needed.max(turned / acceleration);
        if turned * shortest > ROUNDING {
            let unnoticed = UNNOTICED * acceleration / turned;
            passes = passes.min(unnoticed * limits.servo_period).min((unnoticed * shortest).sqrt());
        }
    }
    if speed <= passes {
        return Corner::Passed(FASTER * passes);
    }
    let change: f64 = f64::sqrt(change);
    if limits.corner_tolerance <= 0.0 || dot(&first, &second, count) < REVERSAL {
        return Corner::Stop;
    }
    let straight = before.is_straight() && after.is_straight();
    let half = before.length().min(after.length()) / 2.0;
    let tolerated = 4.0 * limits.corner_tolerance / change;
    let wanted = needed * speed * speed / 2.0;
    if straight {
        let arm = half.min(tolerated).min(ROOM * wanted);
        return if arm > SHORTEST { Corner::Rounded(arm) } else { Corner::Stop };
    }
    let bend = norm(&before.bend(before.length()), count).max(norm(&after.bend(0.0), count));
    let mut arm = half.min(tolerated).min(ROOM_BESIDE_ARCS * wanted).min(MOST_TURN / bend);
    for _ in 0..MOST_TIMES {
        if arm <= SHORTEST {
            break;
        }
        if deviation(before, after, arm, count) <= KEPT * limits.corner_tolerance {
            return Corner::Rounded(arm);
        }
        arm *= SHORTER;
    }
    Corner::Stop
}

/// The highest speed in a direction.
fn fastest(limits: &Limits, along: &Point) -> f64 {
    let axes = limits.axes.iter().zip(along).take(limits.count);
    axes.map(|(limit, along)| limit.rapid.max(limit.max_feed) / along.abs()).fold(f64::INFINITY, f64::min)
}

/// The way round the corner with this arm.
pub fn round(before: &Way, after: &Way, arm: f64) -> Way {
    let end = before.length() - arm;
    Way::blend(&before.at(end), &heading(before, end), &after.at(arm), &heading(after, arm), 2.0 * arm)
}

/// How far the way round the corner is from the corner, or from the ways half-way to it.
fn deviation(before: &Way, after: &Way, arm: f64, count: usize) -> f64 {
    let blend = round(before, after, arm);
    let off = |s: f64, place: Point| {
        let at = blend.at(s);
        let apart: Point = std::array::from_fn(|axis| at[axis] - place[axis]);
        norm(&apart, count)
    };
    let sides = [0.35, 0.7].map(|part| {
        let before = off(part * arm, before.at(before.length() - (1.0 - part) * arm));
        before.max(off((2.0 - part) * arm, after.at((1.0 - part) * arm)))
    });
    off(arm, after.at(0.0)).max(sides[0]).max(sides[1])
}

/// The direction of a way, one mm long.
fn heading(way: &Way, s: f64) -> Point {
    let mut slope = way.slope(s);
    let length = norm(&slope, slope.len());
    for part in &mut slope {
        *part /= length;
    }
    slope
}
