//! The trapezoid: never faster than its limits, and as fast as they allow.

use motion::Trapezoid;
use proptest::prelude::*;

/// Relative error of a few operations on doubles.
const ROUNDING: f64 = 1e-12;

proptest! {
    #[test]
    fn limits_are_kept_and_the_way_is_covered(distance in 1e-6f64..1e5, speed in 1e-3f64..1e3, acceleration in 1.0f64..1e5) {
        let profile = Trapezoid::new(distance, speed, acceleration);
        prop_assert!(profile.top <= speed);
        let ramps = profile.top * profile.top / acceleration;
        prop_assert!(ramps <= distance * (1.0 + ROUNDING), "both ramps fit into the way");
        let cruise = profile.seconds() - 2.0 * profile.top / acceleration;
        prop_assert!(cruise >= -ROUNDING * profile.seconds());
        let covered = ramps + cruise * profile.top;
        prop_assert!((covered - distance).abs() <= 1e-9 * distance, "{covered} of {distance}");
        // Nothing is faster than full speed throughout, nor than full acceleration throughout.
        let bound = (distance / speed).max(2.0 * (distance / acceleration).sqrt());
        prop_assert!(profile.seconds() >= bound * (1.0 - ROUNDING));
        prop_assert!(profile.seconds() <= distance / speed + speed / acceleration + bound * ROUNDING, "no slower than a full ramp");
    }

    #[test]
    fn more_way_takes_longer_and_higher_limits_take_less(
        distance in 1e-6f64..1e5, speed in 1e-3f64..1e3, acceleration in 1.0f64..1e5, more in 1.0f64..3.0,
    ) {
        let seconds = Trapezoid::new(distance, speed, acceleration).seconds();
        let slack = seconds * ROUNDING;
        prop_assert!(Trapezoid::new(distance * more, speed, acceleration).seconds() >= seconds - slack);
        prop_assert!(Trapezoid::new(distance, speed * more, acceleration).seconds() <= seconds + slack);
        prop_assert!(Trapezoid::new(distance, speed, acceleration * more).seconds() <= seconds + slack);
    }
}
