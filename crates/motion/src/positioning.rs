//! Positioning as it happens: every axis, or the straight line, on its own way from rest to rest, held and released
//! anywhere.

use base::{AXES, Point};

use crate::horizon::Setpoint;
use crate::stroke::Stroke;

/// A positioning move under way.
#[derive(Clone, Debug)]
pub(crate) struct Positioning {
    from: Point,
    to: Point,
    /// Along the line if it is straight, else one an axis.
    strokes: [Stroke; AXES],
    straight: Option<f64>,
    count: usize,
}

impl Positioning {
    /// Every axis at its own rate, acceleration and jerk: mm/s, mm/s², mm/s³.
    pub fn by_axes(from: &Point, to: &Point, limits: impl Fn(usize) -> [f64; 3], count: usize) -> Positioning {
        let strokes = std::array::from_fn(|axis| {
            let [rate, acceleration, jerk] = if axis < count { limits(axis) } else { [1.0; 3] };
            let way = if axis < count { (to[axis] - from[axis]).abs() } else { 0.0 };
            Stroke::new(way, rate, acceleration, jerk)
        });
        Positioning { from: *from, to: *to, strokes, straight: None, count }
    }

    /// Along a straight line of this length, at this rate, acceleration and jerk along it.
    pub fn straight(from: &Point, to: &Point, length: f64, [rate, acceleration, jerk]: [f64; 3]) -> Positioning {
        let strokes = [Stroke::new(length, rate, acceleration, jerk); AXES];
        Positioning { from: *from, to: *to, strokes, straight: Some(length), count: 1 }
    }

    /// Other rates from now on.
    pub fn set_rates(&mut self, rates: impl Fn(usize) -> f64) {
        for (index, stroke) in self.strokes[..self.count].iter_mut().enumerate() {
            stroke.set_speed(rates(index));
        }
    }

    /// The axes shall stand as soon as they can, or go on.
    pub fn hold(&mut self, held: bool) {
        for stroke in &mut self.strokes[..self.count] {
            stroke.hold(held);
        }
    }

    /// Drives for a time: what is left of it when the end is reached, and whether it is.
    pub fn drive_for(&mut self, seconds: f64) -> (f64, bool) {
        let mut left = seconds;
        for stroke in &mut self.strokes[..self.count] {
            left = left.min(stroke.advance(seconds));
        }
        let ended = self.strokes[..self.count].iter().all(Stroke::has_arrived);
        (if ended { left } else { 0.0 }, ended)
    }

    /// True if nothing moves.
    pub fn is_standing(&self) -> bool {
        self.strokes[..self.count].iter().all(|stroke| stroke.leg().is_none())
    }

    /// Where the axes are, and how fast.
    pub fn setpoint(&self) -> Setpoint {
        let mut setpoint = Setpoint { position: self.to, velocity: [0.0; AXES] };
        for axis in 0..AXES {
            let way = self.to[axis] - self.from[axis];
            let (stroke, share) = match self.straight {
                Some(length) => (&self.strokes[0], way / length),
                None => (&self.strokes[axis], 1.0_f64.copysign(way)),
            };
            if !stroke.has_arrived() {
                let here = stroke.here();
                setpoint.position[axis] = self.from[axis] + share * here.s;
                setpoint.velocity[axis] = share * here.speed;
            }
        }
        setpoint
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::way::expect::point;

    fn run() -> Positioning {
        Positioning::by_axes(
            &point(0.0, 5.0),
            &point(100.0, -15.0),
            |axis| [[200.0, 100.0][axis], 500.0, f64::INFINITY],
            2,
        )
    }

    #[test]
    fn every_axis_takes_its_own_time() {
        let mut run = run();
        // Y: 20 mm, never at its rate: 2 sqrt(20 / 500) = 0.4 s. X: 100 mm, at 200 mm/s: 100 / 200 + 200 / 500 = 0.9 s.
        assert_eq!(run.drive_for(0.4), (0.0, false));
        let setpoint = run.setpoint();
        assert!((setpoint.position[1] + 15.0).abs() < 1e-9 && setpoint.velocity[1].abs() < 1e-9);
        let (left, ended) = run.drive_for(1.0);
        assert!(ended && (left - 0.5).abs() < 1e-9 && run.setpoint().position == point(100.0, -15.0));
    }

    #[test]
    fn held_it_stands_short_of_its_end_and_goes_on_to_it() {
        let mut run = run();
        run.drive_for(0.2);
        run.hold(true);
        assert!(!run.is_standing());
        assert_eq!(run.drive_for(5.0), (0.0, false));
        // X has 0.2 s at 500 mm/s²: 10 mm at 100 mm/s, and as much again to stand.
        assert!(run.is_standing() && (run.setpoint().position[0] - 20.0).abs() < 1e-9);
        run.hold(false);
        let (left, ended) = run.drive_for(5.0);
        // 80 mm from rest: 80 / 200 + 200 / 500 = 0.8 s.
        assert!(ended && (left - 4.2).abs() < 1e-9, "{left}");
    }

    #[test]
    fn limits_are_kept_whatever_is_done() {
        let mut run = run();
        let mut last = run.setpoint();
        for step in 0..20_000 {
            match step % 97 {
                20 => run.hold(true),
                60 => run.hold(false),
                80 => run.set_rates(|axis| [200.0, 100.0][axis] * f64::from(step % 5) / 4.0 + 1.0),
                _ => {}
            }
            run.drive_for(0.001);
            let now = run.setpoint();
            for axis in 0..2 {
                assert!((now.velocity[axis] - last.velocity[axis]).abs() <= 0.5 * 1.000_001, "{step}");
                assert!(now.velocity[axis].abs() <= [202.0, 102.0][axis]);
            }
            last = now;
        }
        assert_eq!(last.position, point(100.0, -15.0));
    }
}
