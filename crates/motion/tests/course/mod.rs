//! Courses for the tests: moves of a plane or of space, driven from rest to rest, looked at as closely as one likes.

#![allow(dead_code)] // every test takes what it needs

pub mod oracle;
pub mod program;
pub mod seeds;
pub mod watch;

use base::{AXES, Point};
use meaning::{ArcMove, Feed, Plane};
use motion::{AxisLimits, Horizon, Leg, Limits, Move, Way};
use path::Arc;

/// A point of three axes.
pub fn point(xyz: [f64; 3]) -> Point {
    let mut point = [0.0; AXES];
    point[..3].copy_from_slice(&xyz);
    point
}

/// Three equal axes.
pub fn limits(max_feed: f64, acceleration: f64, corner_tolerance: f64) -> Limits {
    let axis = AxisLimits { rapid: max_feed, max_feed, acceleration, jerk: f64::INFINITY };
    Limits { axes: [axis; AXES], count: 3, corner_tolerance, ..Limits::default() }
}

/// A feed, mm/min.
pub fn feed(mm_per_min: f64) -> Feed {
    Feed { mm_per_min, exact_stop: false, tapping: false, per_revolution: false, way_mm: 0.0 }
}

/// A straight move.
pub fn line(from: [f64; 3], to: [f64; 3], f: f64) -> Move {
    Move { way: Way::line(&point(from), &point(to), 3), feed: feed(f), share: 1.0, stops: false }
}

/// A move along an arc of the XY plane.
pub fn arc(from: [f64; 3], to: [f64; 3], center: [f64; 2], clockwise: bool, f: f64) -> Move {
    let (from, to) = (point(from), point(to));
    let full_circle = from[..2] == to[..2];
    let arc = ArcMove { to, plane: Plane::Xy, axes: [0, 1], center, clockwise, full_circle };
    Move { way: Way::arc(&Arc::new(&from, &arc)), feed: feed(f), share: 1.0, stops: false }
}

/// Drives moves through a horizon as the control does; every leg is shown. How long each move takes, s.
pub fn drive(limits: &Limits, moves: &[Move], mut show: impl FnMut(&Way, &Leg)) -> Vec<f64> {
    let mut horizon = Horizon::new(*limits);
    let (mut next, mut times) = (moves.iter(), Vec::new());
    while times.len() < moves.len() {
        while horizon.wants_more() {
            match next.next() {
                Some(next) => horizon.add(next),
                None => horizon.stop(),
            }
        }
        times.push(horizon.drive_move(|way, _, leg| show(way, leg)));
    }
    times
}
