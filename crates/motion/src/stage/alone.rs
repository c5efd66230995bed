//! A move by itself, from rest to rest: how long it takes under every axis' limits.

use base::{AXES, Point};
use meaning::Feed;
use path::Arc;

use super::Motion;
use crate::limits::{Limits, Model};
use crate::profile::Trapezoid;
use crate::scurve::SCurve;

impl Motion {
    /// Positioning: its time, s, its length and no feed.
    pub(super) fn rapid(&self, from: &Point, to: &Point) -> (f64, f64, f64) {
        let length = distance(from, to, self.limits.count);
        if self.limits.straight_rapid {
            let (speed, acceleration) = along(&self.limits, from, to, length, |axis| self.overrides.rapid(axis.rapid));
            let jerk = jerk_along(&self.limits, from, to, length);
            return (from_rest_to_rest(length, speed, acceleration, jerk), length, 0.0);
        }
        let mut longest = 0.0f64;
        for axis in 0..self.limits.count {
            let way = (to[axis] - from[axis]).abs();
            if way > 0.0 {
                let limits = &self.limits.axes[axis];
                let (rate, jerk) = (self.overrides.rapid(limits.rapid), self.limits.jerk(axis));
                longest = longest.max(from_rest_to_rest(way, rate, limits.acceleration, jerk));
            }
        }
        (longest, length, 0.0)
    }

    /// The straight speed of positioning in which every axis runs at its rate, or waits for the slowest.
    pub(super) fn rapid_rate(&self, from: &Point, to: &Point, length: f64) -> f64 {
        let needed = |axis: usize| (to[axis] - from[axis]).abs() / self.overrides.rapid(self.limits.axes[axis].rapid);
        let longest = (0..self.limits.count).map(needed).fold(0.0, f64::max);
        if longest > 0.0 { length / longest } else { 0.0 }
    }

    /// A straight cut: its time, s, its length, the commanded feed.
    pub(super) fn line(&self, from: &Point, to: &Point, feed: &Feed) -> (f64, f64, f64) {
        let length = distance(from, to, self.limits.count);
        let at_rapid = self.overrides.at_rapid(feed);
        let rate = |axis: &crate::AxisLimits| if at_rapid { self.overrides.rapid(axis.rapid) } else { axis.max_feed };
        let (most, acceleration) = along(&self.limits, from, to, length, rate);
        let (commanded, speed) = if at_rapid {
            (along(&self.limits, from, to, length, |axis| axis.rapid).0 * 60.0, most)
        } else {
            // The feed of the tool's tip, whose way is another than that of the axes.
            let share = if feed.way_mm > 0.0 { length / feed.way_mm } else { 1.0 };
            (self.overrides.commanded(feed), most.min(self.overrides.actual(feed) / 60.0 * share))
        };
        let jerk = jerk_along(&self.limits, from, to, length);
        (from_rest_to_rest(length, speed, acceleration, jerk), length, commanded)
    }

    /// An arc. Its own acceleration towards the centre and that along the path share what the plane's axes can give:
    /// the speed is held to where the first takes at most 1/√2 of it, the second gets the rest.
    pub(super) fn arc(&self, arc: &Arc, feed: &Feed) -> (f64, f64, f64) {
        let (plane_length, length) = (arc.plane_length(), arc.length());
        if plane_length <= 0.0 {
            return (0.0, 0.0, 0.0);
        }
        let steepness = length / plane_length;
        let [u, v] = arc.axes.map(|axis| &self.limits.axes[usize::from(axis) % AXES]);
        let given = u.acceleration.min(v.acceleration);
        let radius = arc.radius[0].min(arc.radius[1]).max(1e-6);
        let centripetal = (given * radius * std::f64::consts::FRAC_1_SQRT_2).sqrt();
        let at_rapid = self.overrides.at_rapid(feed);
        let rate = |axis: &crate::AxisLimits| if at_rapid { self.overrides.rapid(axis.rapid) } else { axis.max_feed };
        let most = rate(u).min(rate(v));
        let (commanded, actual) = if at_rapid {
            (u.rapid.min(v.rapid) * 60.0, most)
        } else {
            (self.overrides.commanded(feed), self.overrides.actual(feed) / 60.0)
        };
        // Speeds in the plane; the axes beside it keep step.
        let mut speed = actual.min(most).min(centripetal);
        let towards_centre = speed * speed / radius;
        let mut acceleration = (given * given - towards_centre * towards_centre).max(0.0).sqrt();
        for axis in (0..self.limits.count).filter(|&axis| !arc.axes.contains(&(axis as u8))) {
            let way = (arc.to[axis] - arc.from[axis]).abs();
            if way > 0.0 {
                speed = speed.min(rate(&self.limits.axes[axis]) * plane_length / way);
                acceleration = acceleration.min(self.limits.axes[axis].acceleration * plane_length / way);
            }
        }
        let jerk = arc.axes.map(|axis| self.limits.jerk(usize::from(axis) % AXES));
        let seconds = from_rest_to_rest(plane_length, speed, acceleration, jerk[0].min(jerk[1]));
        (seconds, length, commanded * steepness)
    }
}

/// The highest speed and acceleration along a straight way that no axis is asked too much by.
pub(super) fn along(
    limits: &Limits,
    from: &Point,
    to: &Point,
    length: f64,
    rate: impl Fn(&crate::AxisLimits) -> f64,
) -> (f64, f64) {
    // What holds it most: a limit, and the axis' own way. Only theirs is worth a division.
    let (mut speed, mut acceleration) = ((f64::INFINITY, 1.0), (f64::INFINITY, 1.0));
    for axis in 0..limits.count {
        let way = (to[axis] - from[axis]).abs();
        if way > 0.0 {
            let limits = &limits.axes[axis];
            speed = tighter(speed, (rate(limits), way));
            acceleration = tighter(acceleration, (limits.acceleration, way));
        }
    }
    // Where nothing moves there is no bound.
    let along = |(limit, way): (f64, f64)| if limit.is_finite() { limit * length / way } else { limit };
    (along(speed), along(acceleration))
}

/// The highest jerk along a straight way; infinite under all models but one.
pub(super) fn jerk_along(limits: &Limits, from: &Point, to: &Point, length: f64) -> f64 {
    if limits.model != Model::Jerk {
        return f64::INFINITY;
    }
    let each = |axis: usize| limits.axes[axis].jerk * length / (to[axis] - from[axis]).abs();
    (0..limits.count).filter(|&axis| to[axis] != from[axis]).map(each).fold(f64::INFINITY, f64::min)
}

/// How long a move takes that is not planned together with others, s.
fn from_rest_to_rest(length: f64, speed: f64, acceleration: f64, jerk: f64) -> f64 {
    if jerk < f64::INFINITY {
        SCurve::new(length, speed, acceleration, jerk).seconds()
    } else {
        Trapezoid::new(length, speed, acceleration).seconds()
    }
}

/// The smaller one of two limits, each divided by its axis' way.
fn tighter(one: (f64, f64), other: (f64, f64)) -> (f64, f64) {
    if other.0 * one.1 < one.0 * other.1 { other } else { one }
}

/// The length of a straight way.
pub(super) fn distance(from: &Point, to: &Point, axes: usize) -> f64 {
    let mut sum = 0.0;
    for axis in 0..axes.min(AXES) {
        let way = to[axis] - from[axis];
        sum += way * way;
    }
    sum.sqrt()
}
