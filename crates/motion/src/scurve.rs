//! The S-curve: from rest to rest over a distance, as fast as a speed, an acceleration and a jerk allow.

/// A move from rest to rest in up to seven stretches of constant jerk. Distance in mm, then mm/s, mm/s², mm/s³.
///
/// A ramp from rest to the speed `v` takes `v/a + a/j` if the acceleration `a` is reached on it (`v ≥ a²/j`), else
/// `2·√(v/j)`, and covers half of `v` times that. Two ramps and what lies between are the time-optimal move (Ruckig:
/// Berscheid and Kröger, RSS 2021, is the general case). Where both ramps leave nothing between, its peak is
/// `√(a⁴/4j² + a·d) - a²/2j`, or `(d·√j/2)^⅔` if `a` is not reached.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SCurve {
    /// Length of the way, not negative.
    pub distance: f64,
    /// Speed reached.
    pub top: f64,
    /// Highest acceleration and deceleration.
    pub acceleration: f64,
    /// Highest change of them; infinite: the move is a trapezoid.
    pub jerk: f64,
}

impl SCurve {
    /// The fastest such move. A limit of zero or less never arrives: its time is infinite.
    pub fn new(distance: f64, speed: f64, acceleration: f64, jerk: f64) -> SCurve {
        let curve = |top| SCurve { distance, top, acceleration, jerk };
        if distance <= 0.0 || speed <= 0.0 || acceleration <= 0.0 || jerk <= 0.0 {
            return curve(0.0);
        }
        if distance >= curve(speed).ramp_seconds() * speed {
            return curve(speed);
        }
        let reached = acceleration * acceleration / jerk;
        let half = reached / 2.0;
        // The same as the root above less the half, without cancelling.
        let product = acceleration * distance;
        let long = product / ((half * half + product).sqrt() + half);
        if long >= reached {
            return curve(long.min(speed));
        }
        let root = libm::cbrt(distance * jerk.sqrt() / 2.0);
        curve((root * root).min(speed))
    }

    /// How long it takes, s.
    pub fn seconds(&self) -> f64 {
        if self.distance <= 0.0 {
            return 0.0;
        }
        if self.top <= 0.0 {
            return f64::INFINITY;
        }
        self.distance / self.top + self.ramp_seconds()
    }

    /// How long it takes from rest to the speed reached.
    fn ramp_seconds(&self) -> f64 {
        if self.top * self.jerk >= self.acceleration * self.acceleration {
            self.top / self.acceleration + self.acceleration / self.jerk
        } else {
            2.0 * (self.top / self.jerk).sqrt()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_of_the_three_shapes_takes_its_time() {
        // v = 100, a = 500, j = 5000: a ramp takes 0.3 s and 15 mm.
        assert_eq!(SCurve::new(130.0, 100.0, 500.0, 5000.0).seconds(), 1.6);
        // Two ramps to 75 mm/s: 0.25 s each.
        let peaked = SCurve::new(18.75, 100.0, 500.0, 5000.0);
        assert!((peaked.top - 75.0).abs() < 1e-12 && (peaked.seconds() - 0.5).abs() < 1e-12);
        // Four times 0.05 s of jerk: 2 j t³.
        let short = SCurve::new(1.25, 100.0, 500.0, 5000.0);
        assert!((short.top - 12.5).abs() < 1e-12 && (short.seconds() - 0.2).abs() < 1e-12);
    }

    #[test]
    fn without_a_limit_of_jerk_it_is_a_trapezoid() {
        for distance in [0.0, 0.5, 5.0, 200.0] {
            let (curve, straight) =
                (SCurve::new(distance, 100.0, 500.0, f64::INFINITY), crate::Trapezoid::new(distance, 100.0, 500.0));
            assert!((curve.seconds() - straight.seconds()).abs() < 1e-12, "{distance}");
        }
    }
}
