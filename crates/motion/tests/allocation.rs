//! Live execution takes no memory once it has been warmed up: what is ahead, an override turned, a hold and going on.

use std::f64::consts::TAU;

use base::AXES;
use motion::{AxisLimits, Horizon, Limits, Move, Overrides, Way};
use testkit::{Counting, allocations_so_far};

mod course;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const PERIOD_S: f64 = 0.001;
/// The operator's acts come again after so many periods.
const ROUND: usize = 1000;

/// Lines, arcs and chords of a curve, on and on.
fn program() -> Vec<Move> {
    let mut moves = vec![
        course::line([0.0, 0.0, 0.0], [30.0, 0.0, 0.0], 6000.0),
        course::arc([30.0, 0.0, 0.0], [40.0, 10.0, 0.0], [30.0, 10.0], false, 6000.0),
        course::line([40.0, 10.0, 0.0], [40.0, 30.0, 5.0], 3000.0),
    ];
    let at = |part: f64| [40.0 - 40.0 * part, 30.0 + 5.0 * (TAU * part).sin(), 5.0];
    moves.extend((0..200).map(|n| course::line(at(f64::from(n) / 200.0), at(f64::from(n + 1) / 200.0), 6000.0)));
    moves.push(course::line([0.0, 30.0, 5.0], [0.0, 0.0, 0.0], 6000.0));
    moves
}

/// Drives so many periods, with what the operator does.
fn drive(horizon: &mut Horizon, moves: &[Move], next: &mut usize, periods: usize) {
    let feed = |feed: f64| Overrides { feed, ..Overrides::default() };
    for period in 0..periods {
        match period % ROUND {
            200 => horizon.set_overrides(feed(0.5)),
            350 => horizon.set_overrides(feed(1.3)),
            500 => horizon.hold(true),
            600 => horizon.hold(false),
            700 => horizon.set_overrides(feed(0.0)),
            720 => horizon.set_overrides(feed(1.0)),
            _ => {}
        }
        let mut left = PERIOD_S;
        while left > 0.0 {
            while horizon.wants_more() {
                horizon.add(&moves[*next % moves.len()]);
                *next += 1;
            }
            let (rest, ended) = horizon.drive_for(left);
            left = if ended { rest } else { 0.0 };
        }
        assert!(horizon.setpoint().is_some());
    }
}

#[test]
fn periods_take_no_memory() {
    let axis = AxisLimits { rapid: 200.0, max_feed: 200.0, acceleration: 500.0, jerk: f64::INFINITY };
    let limits = Limits { axes: [axis; AXES], count: 3, corner_tolerance: 0.01, ..Limits::default() };
    let (moves, mut horizon, mut next) = (program(), Horizon::new(limits), 0);
    drive(&mut horizon, &moves, &mut next, 20 * ROUND);
    let (warm, seen) = (allocations_so_far(), next);
    drive(&mut horizon, &moves, &mut next, 40 * ROUND);
    assert!(next > seen + moves.len(), "{next} moves");
    assert_eq!(allocations_so_far() - warm, 0, "memory taken in {} periods", 40 * ROUND);
    // The allocator does count.
    let more = vec![Way::line(&[0.0; AXES], &[1.0; AXES], 3)];
    assert!(more.capacity() > 0 && allocations_so_far() > warm);
}
