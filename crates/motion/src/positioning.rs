//! Positioning as it happens: every axis, or the straight line, on its own S-curve (without a limit of jerk that is a
//! trapezoid), held and released anywhere.

use base::{AXES, Point};

use crate::horizon::Setpoint;
use crate::stroke::Stroke;

/// One coordinate on its way to rest at its end.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Runner {
    from: f64,
    end: f64,
    stroke: Stroke,
}

impl Runner {
    fn new(from: f64, end: f64, [rate, acceleration, jerk]: [f64; 3]) -> Runner {
        Runner { from, end, stroke: Stroke::new((end - from).abs(), rate, acceleration, jerk) }
    }

    /// Where it is, and how fast.
    fn here(&self) -> (f64, f64) {
        if self.stroke.has_arrived() {
            return (self.end, 0.0);
        }
        let here = self.stroke.here();
        let direction = if self.end < self.from { -1.0 } else { 1.0 };
        (self.from + direction * here.s, direction * here.speed)
    }
}

/// A positioning move under way.
#[derive(Clone, Debug)]
pub(crate) struct Positioning {
    from: Point,
    to: Point,
    /// Along the line if it is straight, else one an axis.
    runners: [Runner; AXES],
    straight: Option<f64>,
    count: usize,
    held: bool,
}

impl Positioning {
    /// Every axis at its own rate, acceleration and jerk: mm/s, mm/s², mm/s³.
    pub fn by_axes(from: &Point, to: &Point, limits: impl Fn(usize) -> [f64; 3], count: usize) -> Positioning {
        let mut runners = [Runner::new(0.0, 0.0, [0.0; 3]); AXES];
        for (axis, runner) in runners.iter_mut().enumerate().take(count) {
            *runner = Runner::new(from[axis], to[axis], limits(axis));
        }
        Positioning { from: *from, to: *to, runners, straight: None, count, held: false }
    }

    /// Along a straight line of this length, at this rate, acceleration and jerk along it.
    pub fn straight(from: &Point, to: &Point, length: f64, limits: [f64; 3]) -> Positioning {
        let runners = [Runner::new(0.0, length, limits); AXES];
        Positioning { from: *from, to: *to, runners, straight: Some(length), count: 1, held: false }
    }

    /// Other rates from now on.
    pub fn set_rates(&mut self, rates: impl Fn(usize) -> f64) {
        for (index, runner) in self.runners[..self.count].iter_mut().enumerate() {
            runner.stroke.set_speed(rates(index));
        }
    }

    /// The axes shall stand as soon as they can, or go on.
    pub fn hold(&mut self, held: bool) {
        self.held = held;
        for runner in &mut self.runners[..self.count] {
            runner.stroke.hold(held);
        }
    }

    /// Drives for a time: what is left of it when the end is reached, and whether it is.
    pub fn drive_for(&mut self, seconds: f64) -> (f64, bool) {
        let (mut left, mut arrived) = (seconds, true);
        for runner in &mut self.runners[..self.count] {
            left = left.min(runner.stroke.advance(seconds));
            arrived &= runner.stroke.has_arrived();
        }
        let ended = !self.held && arrived;
        (if ended { left } else { 0.0 }, ended)
    }

    /// True if nothing moves.
    pub fn is_standing(&self) -> bool {
        self.runners[..self.count].iter().all(|runner| runner.stroke.leg().is_none())
    }

    /// Where the axes are, and how fast.
    pub fn setpoint(&self) -> Setpoint {
        let mut setpoint = Setpoint { position: self.from, velocity: [0.0; AXES] };
        let Some(length) = self.straight else {
            for (axis, runner) in self.runners[..self.count].iter().enumerate() {
                (setpoint.position[axis], setpoint.velocity[axis]) = runner.here();
            }
            return setpoint;
        };
        let (s, speed) = self.runners[0].here();
        if s >= length {
            return Setpoint { position: self.to, velocity: [0.0; AXES] };
        }
        for axis in 0..AXES {
            let share = (self.to[axis] - self.from[axis]) / length;
            setpoint.position[axis] += share * s;
            setpoint.velocity[axis] = share * speed;
        }
        setpoint
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64) -> Point {
        let mut point = [0.0; AXES];
        (point[0], point[1]) = (x, y);
        point
    }

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
