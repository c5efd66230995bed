//! S-curves from rest to rest: within their limits, as fast as Ruckig's, and safe to hold and release at any time.

use motion::{SCurve, Stroke};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use rsruckig::prelude::*;

/// What a move may take in excess of Ruckig's, which is time-optimal.
const OPTIMAL: f64 = 1.001;
/// Relative error of a few operations on doubles.
const ROUNDING: f64 = 1e-9;

/// The duration of the same move by Ruckig.
fn ruckig(distance: f64, speed: f64, acceleration: f64, jerk: f64) -> f64 {
    let mut input = InputParameter::<1>::new(None);
    input.target_position = daov_stack![distance];
    input.max_velocity = daov_stack![speed];
    input.max_acceleration = daov_stack![acceleration];
    input.max_jerk = daov_stack![jerk];
    let mut trajectory = Trajectory::new(None);
    let mut ruckig = Ruckig::<1, ThrowErrorHandler>::new(None, 0.001);
    ruckig.calculate(&input, &mut trajectory).expect("a plain move");
    trajectory.get_duration()
}

/// Goes to the end, looking every `period`; shows (s, v, a).
fn run(stroke: &mut Stroke, period: f64, mut look: impl FnMut(&mut Stroke, f64)) -> f64 {
    let mut seconds = 0.0;
    loop {
        let left = stroke.advance(period);
        seconds += period - left;
        if stroke.has_arrived() {
            return seconds;
        }
        look(stroke, seconds);
        assert!(seconds < 1e5, "arrives");
        if left > 0.0 {
            seconds += left;
        }
    }
}

const RANDOM_MOVES: u32 = 4000;

#[test]
fn as_fast_as_ruckig() {
    let worst = std::cell::Cell::new(0.0f64);
    let moves = (-3.0f64..3.0, -1.0f64..3.0, 1.0f64..4.0, 2.0f64..6.0);
    let mut runner = TestRunner::new(ProptestConfig::with_cases(RANDOM_MOVES));
    let compared = runner.run(&moves, |(distance, speed, acceleration, jerk)| {
        let [distance, speed, acceleration, jerk] = [distance, speed, acceleration, jerk].map(|e| libm::pow(10.0, e));
        let curve = SCurve::new(distance, speed, acceleration, jerk);
        let best = ruckig(distance, speed, acceleration, jerk);
        worst.set(worst.get().max(curve.seconds() / best));
        prop_assert!(curve.seconds() <= best * OPTIMAL, "{} s, Ruckig {best} s", curve.seconds());
        prop_assert!(
            curve.seconds() >= best / OPTIMAL,
            "faster than the optimum: {} s, Ruckig {best} s",
            curve.seconds()
        );
        // The legs are the same move.
        let mut stroke = Stroke::new(distance, speed, acceleration, jerk);
        let seconds = curve.seconds() - stroke.advance(curve.seconds() * 2.0) + curve.seconds();
        prop_assert!((seconds - curve.seconds()).abs() <= curve.seconds() * ROUNDING);
        prop_assert!(stroke.has_arrived() && (stroke.here().s - distance).abs() <= 1e-9, "{:?}", stroke.here());
        Ok(())
    });
    println!("{RANDOM_MOVES} moves from point to point, model jerk: at most {:.6} of Ruckig's time", worst.get());
    if let Err(error) = compared {
        panic!("{error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn within_the_limits_whatever_the_operator_does(
        distance in 0.0f64..2.5, speed in 0.5f64..2.5, acceleration in 2.0f64..3.5, jerk in 3.0f64..5.5,
        deeds in prop::collection::vec((0.0f64..0.3, 0u8..4, 0.0f64..1.0), 0..12),
    ) {
        let [distance, speed, acceleration, jerk] = [distance, speed, acceleration, jerk].map(|e| libm::pow(10.0, e));
        let mut stroke = Stroke::new(distance, speed, acceleration, jerk);
        let mut before = stroke.here();
        let (mut at, mut held, mut next) = (0.0, false, 0);
        let mut when: Vec<_> = deeds.iter().map(|deed| { at += deed.0; (at, deed.1, deed.2) }).collect();
        when.push((at + 0.05, 3, 1.0));
        let period = 0.001;
        run(&mut stroke, period, |stroke, seconds| {
            let here = stroke.here();
            let wide = 1.0 + 1e-6;
            assert!(here.s >= before.s - 1e-9 && here.s <= distance + 1e-9, "never back, never beyond");
            assert!(here.speed >= -1e-9 && here.speed <= speed * wide, "{here:?}");
            assert!(here.acceleration.abs() <= acceleration * wide, "{here:?}");
            assert!((here.acceleration - before.acceleration).abs() <= jerk * period * wide, "{before:?} {here:?}");
            assert!((here.speed - before.speed).abs() <= acceleration * period * wide, "{before:?} {here:?}");
            before = here;
            if next < when.len() && seconds >= when[next].0 {
                match when[next].1 {
                    0 | 1 => { held = !held; stroke.hold(held); }
                    2 => stroke.set_speed(speed * when[next].2),
                    _ => { held = false; stroke.hold(false); stroke.set_speed(speed); }
                }
                let now = stroke.here();
                assert!((now.s - here.s).abs() < 1e-9 && (now.speed - here.speed).abs() < 1e-6, "{here:?} {now:?}");
                next += 1;
            }
        });
    }
}

#[test]
fn a_hold_is_as_short_as_can_be_and_the_rest_is_a_new_move() {
    let mut stroke = Stroke::new(200.0, 100.0, 500.0, 5000.0);
    stroke.advance(1.0);
    stroke.hold(true);
    // v/a + a/j; 85 mm driven before, 15 mm in it.
    assert!((stroke.advance(10.0) - 9.7).abs() < ROUNDING && (stroke.here().s - 100.0).abs() < ROUNDING);
    stroke.hold(false);
    let left = stroke.advance(10.0);
    assert!(stroke.has_arrived() && (left - (10.0 - 1.3)).abs() < ROUNDING);
}
