//! What the axes allow on a stretch of way: a speed, and an acceleration along it.
//!
//! With `v = ds/dt`, `u = dv/dt` and `w = du/dt` an axis moves with `q' v`, accelerates by `q' u + q'' v²` and jerks by
//! `q' w + 3 q'' v u + q''' v³`. Here the largest of `|q'|`, `|q''|`, `|q'''|` on the stretch stand for them. Where a way
//! is bent `u` first gets what changes the speed by itself in half a window, at most [`PUSH`] of what it would have on a
//! straight one; the speed gets the rest, and `u` again what that leaves.

use base::{AXES, Point};

use crate::limits::{AxisLimits, Limits};
use crate::way::Way;

/// The part of the acceleration that is kept for changes of speed where the way is bent, at most.
pub const PUSH: f64 = 0.3;
/// Steps of Newton's method for the speed at which the jerk is reached; they come from above, squaring the error.
const STEPS: usize = 8;
/// The part of a limit that rounding may take.
const ROUNDING: f64 = 1e-9;

/// The largest derivatives of each axis on a stretch of way.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounds {
    slope: Point,
    bend: Point,
    twist: Point,
    straight: bool,
}

/// What may be driven: mm/s and mm/s².
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Allowance {
    /// The highest speed.
    pub fastest: f64,
    /// The highest change of it.
    pub push: f64,
}

/// What can be driven on a line: mm/s, mm/s², mm/s³.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Line {
    /// Its speed.
    pub speed: f64,
    /// Its acceleration.
    pub acceleration: f64,
    /// Its jerk.
    pub jerk: f64,
}

impl Line {
    /// The window in which the speed is reached soonest: a ramp takes `v/u + T` with `u = j T / 2`, which is least for
    /// `T = √(2 v / j)`; no axis uses more than the time in which its acceleration turns round.
    pub fn window(&self) -> f64 {
        (2.0 * self.speed / self.jerk).sqrt().min(2.0 * self.acceleration / self.jerk)
    }
}

impl Bounds {
    /// Those of a whole way.
    pub fn of(way: &Way, count: usize) -> Bounds {
        let mut bounds = Bounds { slope: [0.0; AXES], bend: [0.0; AXES], twist: [0.0; AXES], straight: false };
        match way {
            Way::Line { along, .. } => {
                bounds.straight = true;
                bounds.slope = along.map(f64::abs);
            }
            Way::Arc { arc, length } => {
                for axis in 0..count {
                    bounds.slope[axis] = ((arc.to[axis] - arc.from[axis]) / length).abs();
                }
                let radius = arc.radius[0].max(arc.radius[1]);
                let growth = (arc.radius[1] - arc.radius[0]).abs() / length;
                let turn = arc.sweep.abs() / length;
                for axis in arc.axes.map(|axis| usize::from(axis) % AXES) {
                    bounds.slope[axis] = growth + radius * turn;
                    bounds.bend[axis] = (2.0 * growth + radius * turn) * turn;
                    bounds.twist[axis] = (3.0 * growth + radius * turn) * turn * turn;
                }
            }
            Way::Blend { terms: [_, b, c, d], length } => {
                for axis in 0..count {
                    let (first, twist) = (2.0 * c[axis], 6.0 * d[axis]);
                    let last = first + twist * length;
                    let steepest = b[axis].abs().max((b[axis] + (first + last) / 2.0 * length).abs());
                    // Where the bend changes its sign the slope is steepest, this much beside the ends at most.
                    let beside = if first * last < 0.0 { (twist * length * length / 8.0).abs() } else { 0.0 };
                    bounds.slope[axis] = steepest + beside;
                    bounds.bend[axis] = first.abs().max(last.abs());
                    bounds.twist[axis] = twist.abs();
                }
            }
        }
        bounds
    }

    /// What may be driven there, at most `asked`, if the acceleration along the way is the mean over a window of time
    /// of one that changes at will: it then changes by twice itself in that time.
    pub fn allow(&self, limits: &Limits, rate: fn(&AxisLimits) -> f64, asked: f64, window: f64) -> Allowance {
        let mut allowance = Allowance { fastest: asked, push: f64::INFINITY };
        for (axis, limit) in limits.axes[..limits.count].iter().enumerate() {
            let slope = self.slope[axis];
            if slope > 0.0 {
                let most = limit.acceleration.min(limit.jerk * window / 2.0);
                allowance.fastest = allowance.fastest.min(rate(limit) / slope);
                allowance.push = allowance.push.min(most / slope);
            }
        }
        if !self.straight {
            self.share(limits, window, &mut allowance);
        }
        let inside = 1.0 - ROUNDING;
        Allowance { fastest: allowance.fastest * inside, push: allowance.push * inside }
    }

    fn share(&self, limits: &Limits, window: f64, allowance: &mut Allowance) {
        let asked = allowance.fastest;
        self.slow_down(limits, window, 0.0, allowance);
        let push = (allowance.push * PUSH).min(2.0 * allowance.fastest / window);
        allowance.fastest = asked;
        self.slow_down(limits, window, push, allowance);
        let mut left = f64::INFINITY;
        let speed = allowance.fastest;
        for (axis, limit) in limits.axes[..limits.count].iter().enumerate() {
            let (slope, bend, twist) = (self.slope[axis], self.bend[axis], self.twist[axis]);
            if slope > 0.0 {
                left = left.min((limit.acceleration - bend * speed * speed) / slope);
            }
            let each = 2.0 * slope / window + 3.0 * bend * speed;
            if limit.jerk.is_finite() && each > 0.0 {
                left = left.min((limit.jerk - twist * speed * speed * speed) / each);
            }
        }
        // Never less than was kept for it.
        allowance.push = left.clamp(push, allowance.push);
    }
}

impl Bounds {
    /// To the speed at which `push` is left for what is along the way.
    fn slow_down(&self, limits: &Limits, window: f64, push: f64, allowance: &mut Allowance) {
        for (axis, limit) in limits.axes[..limits.count].iter().enumerate() {
            let (slope, bend, twist) = (self.slope[axis], self.bend[axis], self.twist[axis]);
            let given = limit.acceleration - slope * push;
            if bend * allowance.fastest * allowance.fastest > given {
                allowance.fastest = (given / bend).sqrt();
            }
            if limit.jerk.is_finite() {
                let given = limit.jerk - 2.0 * slope * push / window;
                allowance.fastest = slower(allowance.fastest, twist, 3.0 * bend * push, given);
            }
        }
    }
}

/// The speed, at most `speed`, at which `cubic v³ + linear v` is `given`.
fn slower(mut speed: f64, cubic: f64, linear: f64, given: f64) -> f64 {
    for _ in 0..STEPS {
        let excess = (cubic * speed * speed + linear) * speed - given;
        if excess <= given * ROUNDING {
            break;
        }
        speed -= excess / (3.0 * cubic * speed * speed + linear);
    }
    // The curve bends upwards, so that every step ends above the speed that is looked for.
    if (cubic * speed * speed + linear) * speed > given * (1.0 + ROUNDING) {
        speed = libm::cbrt(given / cubic).min(given / linear) / 2.0;
    }
    speed
}

impl Bounds {
    /// What can be driven straight on.
    pub fn line(&self, limits: &Limits, rate: fn(&AxisLimits) -> f64, asked: f64) -> Line {
        let mut line = Line { speed: asked, acceleration: f64::INFINITY, jerk: f64::INFINITY };
        for (axis, limit) in limits.axes[..limits.count].iter().enumerate() {
            let slope = self.slope[axis];
            if slope > 0.0 {
                line.speed = line.speed.min(rate(limit) / slope);
                line.acceleration = line.acceleration.min(limit.acceleration / slope);
                line.jerk = line.jerk.min(limit.jerk / slope);
            }
        }
        line
    }

    /// Those of a corner between two directions, rounded by a hat of its own.
    pub fn of_corner(before: &Point, behind: &Point, width: f64) -> Bounds {
        let slope = std::array::from_fn(|axis| before[axis].abs().max(behind[axis].abs()));
        let bend: Point = std::array::from_fn(|axis| (behind[axis] - before[axis]).abs() / width);
        Bounds { slope, bend, twist: bend.map(|bend| bend / width), straight: false }
    }
}
