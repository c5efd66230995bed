//! The stage: one shape in, the same shape out with its duration.

use base::{AXES, Point, Seconds};
use meaning::{Answer, Feed, Pull, StaleBarrier};
use path::{Arc, Path, Shape, Shaped};

use crate::limits::Limits;
use crate::profile::Trapezoid;

/// A shape with its time.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Timed<'s> {
    /// What happens and where it comes from.
    pub shaped: &'s Shaped,
    /// How long it takes; zero for what takes no time.
    pub duration: Seconds,
    /// Length of its path, mm (degrees count as mm); zero for what is no move.
    pub length: f64,
    /// Feed of the tool centre along the path, mm/min, as commanded; zero for what is no cut.
    pub feed: f64,
}

/// The stage that gives paths their time.
pub struct Motion {
    /// The stage before.
    pub upstream: Path,
    limits: Limits,
}

impl Motion {
    /// The stage behind a path, under these limits.
    pub fn new(upstream: Path, limits: Limits) -> Motion {
        Motion { upstream, limits }
    }

    /// Answers the interpreter's open barrier.
    ///
    /// # Errors
    /// `id` is not that of the open barrier.
    pub fn resume(&mut self, id: u64, answer: Answer) -> Result<(), StaleBarrier> {
        self.upstream.resume(id, answer)
    }

    /// Advances to the next shape; [`Motion::current`] gives it.
    #[expect(clippy::should_implement_trait, reason = "a pull has barriers, which an iterator does not")]
    pub fn next(&mut self) -> Pull<()> {
        match self.upstream.next() {
            Pull::Item(_) => Pull::Item(()),
            Pull::Barrier(barrier) => Pull::Barrier(barrier),
            Pull::End => Pull::End,
        }
    }

    /// The shape that [`Motion::next`] has come to, with its time.
    pub fn current(&self) -> Timed<'_> {
        let shaped = self.upstream.current();
        let (seconds, length, feed) = match &shaped.shape {
            Shape::Rapid { from, to, .. } => self.rapid(from, to),
            Shape::Line { from, to, feed } => self.line(from, to, feed),
            Shape::Arc { arc, feed } => self.arc(arc, feed),
            Shape::Dwell(dwell) => (dwell.seconds(), 0.0, 0.0),
            _ => (0.0, 0.0, 0.0),
        };
        Timed { shaped, duration: Seconds(seconds), length, feed }
    }

    fn rapid(&self, from: &Point, to: &Point) -> (f64, f64, f64) {
        let length = distance(from, to, self.limits.count);
        if self.limits.straight_rapid {
            let (speed, acceleration) = self.along(from, to, length, |axis| axis.rapid);
            return (Trapezoid::new(length, speed, acceleration).seconds(), length, 0.0);
        }
        let mut longest = 0.0f64;
        for axis in 0..self.limits.count {
            let way = (to[axis] - from[axis]).abs();
            if way > 0.0 {
                let limits = &self.limits.axes[axis];
                longest = longest.max(Trapezoid::new(way, limits.rapid, limits.acceleration).seconds());
            }
        }
        (longest, length, 0.0)
    }

    fn line(&self, from: &Point, to: &Point, feed: &Feed) -> (f64, f64, f64) {
        let length = distance(from, to, self.limits.count);
        let at_rapid = feed.mm_per_min == f64::INFINITY;
        let (speed, acceleration) =
            self.along(from, to, length, |axis| if at_rapid { axis.rapid } else { axis.max_feed });
        let commanded = if at_rapid { speed * 60.0 } else { feed.mm_per_min };
        let speed = speed.min(commanded / 60.0);
        (Trapezoid::new(length, speed, acceleration).seconds(), length, commanded)
    }

    /// The highest speed and acceleration along a straight way that no axis is asked too much by.
    fn along(&self, from: &Point, to: &Point, length: f64, rate: impl Fn(&crate::AxisLimits) -> f64) -> (f64, f64) {
        let (mut speed, mut acceleration) = (f64::INFINITY, f64::INFINITY);
        for axis in 0..self.limits.count {
            let way = (to[axis] - from[axis]).abs();
            if way > 0.0 {
                let limits = &self.limits.axes[axis];
                speed = speed.min(rate(limits) * length / way);
                acceleration = acceleration.min(limits.acceleration * length / way);
            }
        }
        (speed, acceleration)
    }

    /// An arc. Its own acceleration towards the centre and that along the path share what the plane's axes can give:
    /// the speed is held to where the first takes at most 1/√2 of it, the second gets the rest.
    fn arc(&self, arc: &Arc, feed: &Feed) -> (f64, f64, f64) {
        let (plane_length, length) = (arc.plane_length(), arc.length());
        if plane_length <= 0.0 {
            return (0.0, 0.0, 0.0);
        }
        let steepness = length / plane_length;
        let [u, v] = arc.axes.map(|axis| &self.limits.axes[usize::from(axis) % AXES]);
        let given = u.acceleration.min(v.acceleration);
        let radius = arc.radius[0].min(arc.radius[1]).max(1e-6);
        let centripetal = (given * radius * std::f64::consts::FRAC_1_SQRT_2).sqrt();
        let at_rapid = feed.mm_per_min == f64::INFINITY;
        let rate = |limits: &crate::AxisLimits| if at_rapid { limits.rapid } else { limits.max_feed };
        let most = rate(u).min(rate(v));
        let commanded = if at_rapid { most * 60.0 } else { feed.mm_per_min };
        // Speeds in the plane; the axes beside it keep step.
        let mut speed = (commanded / 60.0).min(most).min(centripetal);
        let towards_centre = speed * speed / radius;
        let mut acceleration = (given * given - towards_centre * towards_centre).max(0.0).sqrt();
        for axis in (0..self.limits.count).filter(|&axis| !arc.axes.contains(&(axis as u8))) {
            let way = (arc.to[axis] - arc.from[axis]).abs();
            if way > 0.0 {
                speed = speed.min(rate(&self.limits.axes[axis]) * plane_length / way);
                acceleration = acceleration.min(self.limits.axes[axis].acceleration * plane_length / way);
            }
        }
        let seconds = Trapezoid::new(plane_length, speed, acceleration).seconds();
        (seconds, length, commanded * steepness)
    }
}

fn distance(from: &Point, to: &Point, axes: usize) -> f64 {
    let mut sum = 0.0;
    for axis in 0..axes.min(AXES) {
        let way = to[axis] - from[axis];
        sum += way * way;
    }
    sum.sqrt()
}
