//! What planning costs: `planner chords N` and `planner contour N` plan N moves; `planner live N` (the contour) and
//! `planner live-chords N` drive N servo periods with an override turned and a hold now and then, and print how long one
//! period took.

#![allow(clippy::disallowed_types, clippy::expect_used)]

use std::time::{Duration, Instant};

use base::{AXES, Point};
use meaning::{ArcMove, Feed, Plane};
use motion::{AxisLimits, Horizon, Limits, Move, Overrides, Way};
use path::Arc;
use rustix::time::{ClockId, clock_gettime};

const PERIOD_S: f64 = 0.001;

fn point(x: f64, y: f64) -> Point {
    let mut point = [0.0; AXES];
    (point[0], point[1]) = (x, y);
    point
}

fn cut(way: Way) -> Move {
    let feed = Feed { mm_per_min: 6000.0, exact_stop: false, tapping: false, per_revolution: false, way_mm: 0.0 };
    Move { way, feed, share: 1.0, stops: false }
}

/// Chords of a sine, 0.1 mm apart in X.
fn chord(index: usize) -> Move {
    let at = |index: usize| {
        let x = index as f64 * 0.1;
        point(x, 3.0 * libm::sin(x / 2.0))
    };
    cut(Way::line(&at(index), &at(index + 1), 3))
}

/// Round and round a square with rounded corners, lines and arcs by turns.
fn contour(index: usize) -> Move {
    let turned = |[x, y]: [f64; 2]| match index / 2 % 4 {
        0 => point(x, y),
        1 => point(-y, x),
        2 => point(-x, -y),
        _ => point(y, -x),
    };
    if index.is_multiple_of(2) {
        return cut(Way::line(&turned([-5.0, -8.0]), &turned([5.0, -8.0]), 3));
    }
    let (from, to, middle) = (turned([5.0, -8.0]), turned([8.0, -5.0]), turned([5.0, -5.0]));
    let center = [middle[0], middle[1]];
    let arc = ArcMove { to, plane: Plane::Xy, axes: [0, 1], center, clockwise: false, full_circle: false };
    cut(Way::arc(&Arc::new(&from, &arc)))
}

fn horizon() -> Horizon {
    let axis = AxisLimits { rapid: 200.0, max_feed: 200.0, acceleration: 500.0, jerk: f64::INFINITY };
    Horizon::new(Limits { axes: [axis; AXES], count: 3, corner_tolerance: 0.01, ..Limits::default() })
}

fn plan(moves: usize, make: fn(usize) -> Move) {
    let (mut horizon, mut next, mut seconds) = (horizon(), 0, 0.0);
    for _ in 0..moves {
        while horizon.wants_more() {
            if next < moves {
                horizon.add(&make(next));
            } else {
                horizon.stop();
            }
            next += 1;
        }
        seconds += horizon.drive_move(|_, _, _| {});
    }
    println!("{moves} moves, {seconds:.3} s of machining");
}

fn cpu() -> Duration {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec.unsigned_abs(), time.tv_nsec as u32)
}

fn live(periods: usize, make: fn(usize) -> Move) {
    let (mut horizon, mut next) = (horizon(), 0);
    let (mut by_cpu, mut by_wall) = (Vec::with_capacity(periods), Vec::with_capacity(periods));
    let mut far = 0.0f64;
    for period in 0..periods {
        let (cpu_before, wall_before) = (cpu(), Instant::now());
        match period % 5000 {
            1000 => horizon.set_overrides(Overrides { feed: 0.5, ..Overrides::default() }),
            2000 => horizon.set_overrides(Overrides { feed: 1.3, ..Overrides::default() }),
            3000 => horizon.hold(true),
            3300 => horizon.hold(false),
            _ => {}
        }
        let mut left = PERIOD_S;
        while left > 0.0 {
            while horizon.wants_more() {
                horizon.add(&make(next));
                next += 1;
            }
            let (rest, ended) = horizon.drive_for(left);
            left = if ended { rest } else { 0.0 };
        }
        far = far.max(horizon.setpoint().map_or(0.0, |setpoint| setpoint.position[0].abs()));
        by_cpu.push(cpu() - cpu_before);
        by_wall.push(wall_before.elapsed());
    }
    for (name, mut times) in [("thread CPU time", by_cpu), ("wall clock", by_wall)] {
        times.sort_unstable();
        let at = |part: f64| times[((times.len() - 1) as f64 * part) as usize].as_secs_f64() * 1e6;
        println!(
            "{name}: median {:.2} µs, p99 {:.2} µs, p99.9 {:.2} µs, most {:.1} µs",
            at(0.5),
            at(0.99),
            at(0.999),
            at(1.0)
        );
    }
    println!("{periods} periods, {next} moves, farthest {far:.3} mm");
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let number = arguments.get(2).and_then(|number| number.parse().ok()).unwrap_or(1_000_000);
    match arguments.get(1).map(String::as_str) {
        Some("chords") => plan(number, chord),
        Some("contour") => plan(number, contour),
        Some("live-chords") => live(number, chord),
        _ => live(number, contour),
    }
}
