//! The trapezoid: from rest to rest over a distance, as fast as a speed and an acceleration allow.

/// A move from rest to rest. Distance in mm, speed in mm/s, acceleration in mm/s².
///
/// With `d` the distance, `v` the top speed and `a` the acceleration: if `d ≥ v²/a` the speed is reached and the move
/// takes `d/v + v/a`; otherwise it peaks at `√(d·a)` and takes `2·√(d/a)`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Trapezoid {
    /// Length of the way, not negative.
    pub distance: f64,
    /// Speed reached.
    pub top: f64,
    /// Acceleration and deceleration.
    pub acceleration: f64,
}

impl Trapezoid {
    /// The fastest such move. A speed or acceleration of zero or less never arrives: its time is infinite.
    pub fn new(distance: f64, speed: f64, acceleration: f64) -> Trapezoid {
        let squared = distance * acceleration;
        // Of a speed that is reached no root is needed.
        let top = if speed * speed <= squared { speed } else { speed.min(squared.max(0.0).sqrt()) };
        Trapezoid { distance, top, acceleration }
    }

    /// How long it takes, s.
    pub fn seconds(&self) -> f64 {
        if self.distance <= 0.0 {
            return 0.0;
        }
        if self.top <= 0.0 || self.acceleration <= 0.0 {
            return f64::INFINITY;
        }
        self.distance / self.top + self.top / self.acceleration
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_moves_reach_their_speed_and_short_ones_do_not() {
        let long = Trapezoid::new(200.0, 100.0, 500.0);
        assert_eq!((long.top, long.seconds()), (100.0, 2.2));
        let short = Trapezoid::new(5.0, 100.0, 500.0);
        assert_eq!((short.top, short.seconds()), (50.0, 0.2));
        assert_eq!(Trapezoid::new(0.0, 100.0, 500.0).seconds(), 0.0);
        assert_eq!(Trapezoid::new(1.0, 0.0, 500.0).seconds(), f64::INFINITY);
    }

    #[test]
    fn no_profile_is_faster_than_its_limits() {
        for step in 1..2000 {
            let (distance, speed, acceleration) =
                (f64::from(step) * 0.05, f64::from(step % 37 + 1), f64::from(step % 11 + 1) * 90.0);
            let move_ = Trapezoid::new(distance, speed, acceleration);
            let ramp = move_.top * move_.top / acceleration;
            assert!(move_.top <= speed && ramp <= distance * (1.0 + 1e-12));
            let area = move_.top * (move_.seconds() - move_.top / acceleration);
            assert!((area - distance).abs() < 1e-9, "the speed's integral is the way");
        }
    }
}
