//! Model `jerk`: velocity, acceleration and jerk of every axis stay within their limits, the path within the tolerance.
//!
//! The environment can ask for more random programs: PROGRAMS=10000; or for single ones: ONLY=18,34.

mod course;
use base::{AXES, Point};
use course::seeds::over_seeds;
use course::{arc, line};
use motion::{AxisLimits, JerkHorizon, Leg, Limits, Move, Overrides, SCurve, Way};

/// What a limit may be exceeded by: 1.001 is asked of the planner.
const WIDE: f64 = 1.0 + 1e-6;
/// The same of what a drive would see of the jerk.
const SEEN: f64 = 1.001;
/// As the planner's own rounding, mm, mm/s and mm/s².
const ROUNDING: [f64; 3] = [1e-8, 1e-8, 1e-5];

/// A small source of numbers between 0 and 1.
struct Dice(u64);

impl Dice {
    fn new(seed: u64) -> Dice {
        let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
        dice.throw();
        dice
    }

    fn throw(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as f64) / f64::from(1u32 << 31)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.throw()
    }

    /// Evenly in its digits.
    fn around(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.between(libm::log(low), libm::log(high)))
    }
}

fn machine(dice: &mut Dice) -> Limits {
    let mut axes = [AxisLimits::default(); AXES];
    for axis in &mut axes[..3] {
        let (max_feed, acceleration) = (dice.around(20.0, 400.0), dice.around(200.0, 5000.0));
        // Now and then an axis without a limit of jerk.
        let jerk = if dice.throw() < 0.05 { f64::INFINITY } else { acceleration * dice.around(3.0, 300.0) };
        *axis = AxisLimits { rapid: max_feed, max_feed, acceleration, jerk };
    }
    let corner_tolerance = if dice.throw() < 0.1 { 0.0 } else { dice.around(0.001, 0.2) };
    Limits { axes, count: 3, corner_tolerance, ..Limits::default() }
}

/// Moves of every kind: lines long and short, chords of curves, arcs that touch and arcs that do not, helices.
fn course(dice: &mut Dice, count: usize) -> Vec<Move> {
    let mut moves: Vec<Move> = Vec::new();
    let (mut at, mut heading, mut f) = ([0.0; 3], 0.0f64, 3000.0);
    while moves.len() < count {
        if dice.throw() < 0.2 {
            f = dice.around(200.0, 20_000.0);
        }
        if dice.throw() < 0.4 {
            heading += dice.between(-3.2, 3.2);
        }
        match (dice.throw() * 4.0) as u32 {
            0 => {
                let length = dice.around(0.01, 60.0);
                let rise = if dice.throw() < 0.5 { 0.0 } else { dice.between(-5.0, 5.0) };
                let to = [at[0] + length * libm::cos(heading), at[1] + length * libm::sin(heading), at[2] + rise];
                moves.push(line(at, to, f));
                at = to;
            }
            1 => {
                // Chords, now and then of uneven length.
                let (chord, bend) = (dice.around(0.02, 1.0), dice.between(-0.3, 0.3));
                let uneven = dice.throw() < 0.3;
                for _ in 0..(dice.throw() * 40.0) as usize {
                    let length = if uneven { chord * dice.around(0.1, 1.0) } else { chord };
                    let to = [at[0] + length * libm::cos(heading), at[1] + length * libm::sin(heading), at[2]];
                    moves.push(line(at, to, f));
                    at = to;
                    heading += bend;
                }
            }
            _ => {
                let (radius, clockwise) = (dice.around(0.2, 50.0), dice.throw() < 0.5);
                let sweep = dice.between(0.05, 6.2) * if clockwise { -1.0 } else { 1.0 };
                let side = if clockwise { -1.0 } else { 1.0 };
                let center = [at[0] - side * radius * libm::sin(heading), at[1] + side * radius * libm::cos(heading)];
                heading += sweep;
                let rise = if dice.throw() < 0.7 { 0.0 } else { dice.between(-3.0, 3.0) };
                let to = [
                    center[0] + side * radius * libm::sin(heading),
                    center[1] - side * radius * libm::cos(heading),
                    at[2] + rise,
                ];
                moves.push(arc(at, to, center, clockwise, f));
                at = to;
            }
        }
        if let Some(last) = moves.last_mut() {
            last.stops = dice.throw() < 0.05;
        }
    }
    moves.truncate(count);
    moves
}

/// Adds moves as the control does: while they are wanted.
fn feed_in<'m>(horizon: &mut JerkHorizon, next: &mut impl Iterator<Item = &'m Move>) {
    while horizon.wants_more() {
        match next.next() {
            Some(next) => horizon.add(next),
            None if horizon.is_empty() => return,
            None => horizon.stop(),
        }
    }
}

/// Drives it all, move by move; every leg is shown with the move's number.
fn drive(limits: &Limits, moves: &[Move], mut show: impl FnMut(usize, &Way, &Leg)) -> Vec<f64> {
    let mut horizon = JerkHorizon::new(*limits);
    let (mut next, mut times) = (moves.iter(), Vec::new());
    let mut legs = 0u32;
    while times.len() < moves.len() {
        feed_in(&mut horizon, &mut next);
        let number = times.len();
        times.push(horizon.drive_move(|way, _, leg| {
            legs += 1;
            assert!(legs < 5_000_000, "never arrives: {leg:?}");
            show(number, way, leg);
        }));
    }
    assert!(horizon.is_empty());
    times
}

/// The distance from the programmed path near a move.
fn off_the_path(moves: &[Move], number: usize, at: &Point) -> f64 {
    let near = &moves[number.saturating_sub(1)..(number + 2).min(moves.len())];
    near.iter().map(|near| distance(&near.way, at)).fold(f64::INFINITY, f64::min)
}

fn distance(way: &Way, at: &Point) -> f64 {
    let apart = |s: f64| {
        let there = way.at(s);
        (0..3).map(|axis| (there[axis] - at[axis]) * (there[axis] - at[axis])).sum::<f64>()
    };
    let length = way.length();
    if let Way::Line { from, along, .. } = way {
        let s: f64 = (0..3).map(|axis| (at[axis] - from[axis]) * along[axis]).sum();
        return apart(s.clamp(0.0, length)).sqrt();
    }
    let steps = 40;
    let place = |step: i32| length * f64::from(step.clamp(0, steps)) / f64::from(steps);
    let nearest = (0..=steps).min_by(|one, other| apart(place(*one)).total_cmp(&apart(place(*other)))).unwrap_or(0);
    let (mut low, mut high) = (place(nearest - 1), place(nearest + 1));
    while high - low > 1e-10 {
        let third = (high - low) / 3.0;
        if apart(low + third) < apart(high - third) { high -= third } else { low += third }
    }
    let best = (low + high) / 2.0;
    apart(best).sqrt()
}

fn check(what: &str, limits: &Limits, value: &Point, limit: fn(&AxisLimits) -> f64, rounding: f64) {
    for axis in 0..limits.count {
        let most = limit(&limits.axes[axis]);
        assert!(value[axis].abs() <= most * WIDE + rounding, "{what} of axis {axis}: {} of {most}", value[axis]);
    }
}

/// Everything that a leg does, at some of its places.
fn look_at(limits: &Limits, moves: &[Move], number: usize, way: &Way, leg: &Leg) {
    for part in 0..=3 {
        let seconds = leg.seconds * f64::from(part) / 3.0;
        let (s, speed) = leg.at(seconds);
        let acceleration = leg.acceleration + leg.jerk * seconds;
        assert!(speed >= -ROUNDING[1], "{leg:?}");
        let then = Leg { s, speed, acceleration, ..*leg };
        let (accelerations, jerks) = then.on(way);
        check("velocity", limits, &way.slope(s).map(|slope| slope * speed), |axis| axis.max_feed, ROUNDING[1]);
        check("acceleration", limits, &accelerations, |axis| axis.acceleration, ROUNDING[2]);
        check("jerk", limits, &jerks, |axis| axis.jerk, 1e-2);
        let off = off_the_path(moves, number, &way.at(s));
        assert!(off <= limits.corner_tolerance * WIDE + ROUNDING[0], "{off} mm off the path");
    }
}

#[test]
fn legs_keep_to_every_limit_and_to_the_path() {
    over_seeds(100, |seed| {
        let mut dice = Dice::new(seed);
        let limits = machine(&mut dice);
        let moves = course(&mut dice, 40);
        let mut before: Option<(Point, Point, Point)> = None;
        let times = drive(&limits, &moves, |number, way, leg| {
            look_at(&limits, &moves, number, way, leg);
            // One leg goes over into the next: place, velocity and acceleration.
            let (s, speed) = leg.at(leg.seconds);
            let end = Leg { s, speed, acceleration: leg.acceleration + leg.jerk * leg.seconds, ..*leg };
            let state = |leg: &Leg| (way.at(leg.s), way.slope(leg.s).map(|slope| slope * leg.speed), leg.on(way).0);
            let start = state(leg);
            if let Some(before) = before {
                for axis in 0..3 {
                    let limit = &limits.axes[axis];
                    assert!((before.0[axis] - start.0[axis]).abs() < ROUNDING[0], "{before:?} {start:?}");
                    assert!(
                        (before.1[axis] - start.1[axis]).abs() < ROUNDING[1] + limit.jerk * 1e-9,
                        "{before:?} {start:?}"
                    );
                    assert!(
                        (before.2[axis] - start.2[axis]).abs() < ROUNDING[2] + limit.jerk * 1e-6,
                        "{before:?} {start:?}"
                    );
                }
            }
            before = Some(state(&end));
        });
        assert!(times.iter().all(|seconds| seconds.is_finite() && *seconds >= 0.0), "{times:?}");
        let (end, last) = (before.expect("something was driven").0, moves.last().expect("there are moves").way);
        for axis in 0..3 {
            assert!((end[axis] - last.at(last.length())[axis]).abs() < 1e-9, "{end:?}");
        }
        Ok(())
    });
}

#[test]
fn setpoints_keep_to_every_limit_whatever_the_operator_does() {
    over_seeds(20, |seed| {
        let mut dice = Dice::new(seed);
        let limits = machine(&mut dice);
        let moves = course(&mut dice, 25);
        let meddle = dice.throw() < 0.8;
        let (driven, seconds) = walk(&limits, &moves, &mut dice, meddle);
        if !meddle {
            let planned: f64 = drive(&limits, &moves, |_, _, _| {}).iter().sum();
            assert!((planned - seconds).abs() <= 1e-6 * planned + 1e-9, "{planned} {seconds}");
        }
        assert_eq!(driven, moves.len());
        Ok(())
    });
}

/// Drives a servo period at a time, at random held, released and overridden: how many moves ended, and the time.
fn walk(limits: &Limits, moves: &[Move], dice: &mut Dice, meddle: bool) -> (usize, f64) {
    let period = limits.servo_period;
    let mut horizon = JerkHorizon::new(*limits);
    let mut next = moves.iter();
    let (mut ended, mut seconds, mut periods) = (0, 0.0, 0u32);
    let mut held = false;
    // The last four setpoints.
    let mut places: Vec<Point> = vec![moves[0].way.at(0.0); 4];
    while ended < moves.len() {
        let mut rest = period;
        while rest > 0.0 && ended < moves.len() {
            feed_in(&mut horizon, &mut next);
            let (left, end) = horizon.drive_for(rest);
            (seconds, rest) = (seconds + rest - left, left);
            ended += usize::from(end);
        }
        let setpoint = horizon.setpoint();
        let last = &moves[moves.len() - 1].way;
        let place = setpoint.map_or(last.at(last.length()), |setpoint| setpoint.position);
        let (accelerations, jerks) = horizon.acceleration_and_jerk();
        if let Some(setpoint) = setpoint {
            check("velocity", limits, &setpoint.velocity, |axis| axis.max_feed, ROUNDING[1]);
        }
        check("acceleration", limits, &accelerations, |axis| axis.acceleration, ROUNDING[2]);
        check("jerk", limits, &jerks, |axis| axis.jerk, 1e-2);
        let off = off_the_path(moves, ended.min(moves.len() - 1), &place);
        assert!(off <= limits.corner_tolerance * WIDE + ROUNDING[0], "{off} mm off the path");
        places.rotate_left(1);
        places[3] = place;
        // What a drive would see.
        let [a, b, c, d] = [places[0], places[1], places[2], places[3]];
        let difference = |terms: [f64; 4], over: f64| -> Point {
            std::array::from_fn(|axis| {
                (terms[0] * d[axis] + terms[1] * c[axis] + terms[2] * b[axis] + terms[3] * a[axis]) / over
            })
        };
        check("velocity seen", limits, &difference([1.0, -1.0, 0.0, 0.0], period), |axis| axis.max_feed, 1e-8);
        check(
            "acceleration seen",
            limits,
            &difference([1.0, -2.0, 1.0, 0.0], period * period),
            |axis| axis.acceleration,
            1e-5,
        );
        // Lines that go over into each other unnoticed change an acceleration by 2e-4 of that.
        let jerks = difference([1.0, -3.0, 3.0, -1.0], period * period * period);
        check("jerk seen", limits, &jerks.map(|jerk| jerk / SEEN), |axis| axis.jerk, 1e-1);
        periods += 1;
        assert!(periods < 1_000_000, "never arrives");
        if !meddle {
            continue;
        }
        if periods > 60_000 {
            // It is long enough.
            held = false;
            horizon.hold(false);
            horizon.set_overrides(Overrides::default());
        } else if dice.throw() < 0.01 {
            match (dice.throw() * 6.0) as u32 {
                4 => {
                    // What follows is shown anew behind the move at whose end the axes stand.
                    let left = horizon.stand_soon();
                    assert!(horizon.is_closed() || left == 0);
                    next = moves[ended + left..].iter();
                }
                5 => {
                    // Faster than any feed override.
                    let dry_run = Some(dice.around(50.0, 60_000.0));
                    horizon.set_overrides(Overrides { dry_run, ..Overrides::default() });
                }
                0 => {
                    held = !held;
                    horizon.hold(held);
                }
                1 => horizon.set_overrides(Overrides { feed: dice.between(0.0, 2.0), ..Overrides::default() }),
                2 => horizon.set_overrides(Overrides { feed: 0.0, ..Overrides::default() }),
                _ => {
                    held = false;
                    horizon.hold(false);
                    horizon.set_overrides(Overrides::default());
                }
            }
        }
    }
    (ended, seconds)
}

fn equal(speed: f64, acceleration: f64, jerk: f64, tolerance: f64) -> Limits {
    let axis = AxisLimits { rapid: speed, max_feed: speed, acceleration, jerk };
    Limits { axes: [axis; AXES], count: 3, corner_tolerance: tolerance, ..Limits::default() }
}

fn sine(chords: usize) -> Vec<Move> {
    let at = |index: usize| {
        let x = index as f64 * 0.1;
        [x, 3.0 * libm::sin(x / 2.0), 0.0]
    };
    (0..chords).map(|index| line(at(index), at(index + 1), 6000.0)).collect()
}

fn square() -> Vec<Move> {
    let corners = [[0.0, 0.0, 0.0], [20.0, 0.0, 0.0], [20.0, 20.0, 0.0], [0.0, 20.0, 0.0]];
    (0..40).map(|side| line(corners[side % 4], corners[(side + 1) % 4], 3000.0)).collect()
}

/// Lines of 20 mm and quarters of a circle of 10 mm.
fn slot() -> Vec<Move> {
    let part = |part: usize| {
        let turn = |[x, y]: [f64; 2]| match part / 2 % 4 {
            0 => [x, y, 0.0],
            1 => [-y, x, 0.0],
            2 => [-x, -y, 0.0],
            _ => [y, -x, 0.0],
        };
        if part.is_multiple_of(2) {
            line(turn([-10.0, -20.0]), turn([10.0, -20.0]), 4000.0)
        } else {
            let [u, v, _] = turn([10.0, -10.0]);
            arc(turn([10.0, -20.0]), turn([20.0, -10.0]), [u, v], false, 4000.0)
        }
    };
    (0..40).map(part).collect()
}

fn seconds(moves: &[Move], limits: &Limits) -> f64 {
    drive(limits, moves, |_, _, _| {}).iter().sum()
}

#[test]
fn passing_is_no_slower_than_stopping_and_chords_do_not_stop() {
    for (acceleration, jerk) in [(500.0, 5000.0), (500.0, 50_000.0), (5000.0, 50_000.0), (5000.0, 500_000.0)] {
        let limits = equal(200.0, acceleration, jerk, 0.01);
        let exact = Limits { corner_tolerance: 0.0, ..limits };
        let [square, slot, sine] = [square(), slot(), sine(2001)].map(|moves| (seconds(&moves, &limits), moves));
        assert!(square.0 <= seconds(&square.1, &exact) * WIDE, "{} s", square.0);
        assert!(slot.0 <= seconds(&slot.1, &exact) * 0.92, "{} s", slot.0);
        assert!(sine.0 <= seconds(&sine.1, &exact) * 0.2, "{} s", sine.0);
    }
    // Without a limit of jerk the curve takes 7.06 s.
    assert!(seconds(&sine(2001), &equal(200.0, 500.0, 50_000.0, 0.01)) <= 9.0);
}

/// A straight move from rest to rest takes no longer than the optimum, whatever lies before and behind it.
#[test]
fn exact_stops_are_driven_at_the_optimum() {
    let limits = equal(200.0, 500.0, 5000.0, 0.0);
    let best = SCurve::new(20.0, 50.0, 500.0, 5000.0).seconds();
    let times = drive(&limits, &square(), |_, _, _| {});
    assert!(times.iter().all(|seconds| (seconds - best).abs() < 1e-8 * best), "{times:?}");
}

/// The mean comes to where the plan has come, also after a hundred thousand legs without a stop.
#[test]
fn nothing_drifts() {
    let mut end = Default::default();
    let moves = sine(20_000);
    drive(&equal(200.0, 500.0, 50_000.0, 0.01), &moves, |_, way, leg| end = way.at(leg.at(leg.seconds).0));
    let last = moves[moves.len() - 1].way;
    for axis in 0..3 {
        assert!((end[axis] - last.at(last.length())[axis]).abs() < ROUNDING[0], "{end:?}");
    }
}
