//! The stage: one shape in, the same shape out with its duration.

use base::{AXES, Point, Seconds};
use meaning::{Answer, Feed, Pull, StaleBarrier};
use path::{Arc, Path, Shape, Shaped};

use crate::horizon::Move;
use crate::limits::Limits;
use crate::overrides::Overrides;
use crate::planner::{Ahead, Pace, Planner, Stretch};
use crate::profile::Trapezoid;
use crate::way::Way;

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
    /// How it runs, where moves are planned together.
    pub pace: Pace,
}

/// The stage that gives paths their time.
pub struct Motion {
    /// The stage before.
    pub upstream: Path,
    limits: Limits,
    overrides: Overrides,
    planner: Option<Box<Planner>>,
    /// The time of the present shape, s, and how it runs, once it has been planned.
    planned: Option<(f64, Pace)>,
}

/// How a shape stands to the moves before and behind it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Joins {
    /// It is driven with them.
    Move(Move),
    /// It is nothing to them.
    Nothing,
    /// The axes stand before it, and behind it.
    Rest,
}

/// A shape as the planner sees it.
pub(crate) fn as_move(shape: &Shape, limits: &Limits) -> Joins {
    let joined = |way: Way, feed: &Feed, share: f64| {
        if way.length() > SHORTEST {
            Joins::Move(Move { way, feed: *feed, share, stops: feed.exact_stop })
        } else {
            Joins::Nothing
        }
    };
    match shape {
        Shape::Line { from, to, feed } => {
            let way = Way::line(from, to, limits.count);
            // The feed of the tool's tip, whose way is another than that of the axes.
            let share = if feed.way_mm > 0.0 { way.length() / feed.way_mm } else { 1.0 };
            joined(way, feed, share)
        }
        Shape::Arc { arc, feed } => {
            let (plane_length, way) = (arc.plane_length(), Way::arc(arc));
            if plane_length > SHORTEST { joined(way, feed, way.length() / plane_length) } else { Joins::Nothing }
        }
        _ => Joins::Rest,
    }
}

/// A way not longer than this, mm, is none: far below any increment.
const SHORTEST: f64 = 1e-7;

impl Motion {
    /// The stage behind a path, under these limits.
    pub fn new(upstream: Path, limits: Limits) -> Motion {
        Motion { upstream, limits, overrides: Overrides::default(), planner: None, planned: None }
    }

    /// Moves are planned together with those behind them, which [`Motion::show`] is shown; without it each one begins
    /// and ends at rest.
    pub fn plan_ahead(&mut self) {
        let mut planner = Planner::new(self.limits);
        planner.set_overrides(self.overrides);
        self.planner = Some(Box::new(planner));
    }

    /// The same stage that does not plan.
    #[must_use]
    pub fn unplanned(&self) -> Motion {
        let Motion { upstream, limits, overrides, .. } = self;
        Motion { upstream: upstream.clone(), limits: *limits, overrides: *overrides, planner: None, planned: None }
    }

    /// True if moves are planned together.
    pub fn plans(&self) -> bool {
        self.planner.is_some()
    }

    /// Keeps how the move planned last is driven.
    pub fn keep_stretches(&mut self) {
        if let Some(planner) = &mut self.planner {
            planner.keep_stretches();
        }
    }

    /// How the move planned last is driven, stretch by stretch.
    pub fn stretches(&self) -> &[Stretch] {
        match (&self.planner, &self.planned) {
            (Some(planner), Some(_)) => planner.stretches(),
            _ => &[],
        }
    }

    /// True if the present shape is a move that is driven together with others, and not what was shown.
    pub fn is_surprised(&self) -> bool {
        let shape = &self.upstream.current().shape;
        self.is_joined() && self.planner.as_ref().is_some_and(|planner| !planner.expects(shape))
    }

    /// True if the present shape is driven together with others.
    pub fn is_joined(&self) -> bool {
        matches!(as_move(&self.upstream.current().shape, &self.limits), Joins::Move(_))
    }

    /// True if the next move that is driven together with others has been shown.
    pub fn knows_next(&self) -> bool {
        self.planner.as_ref().is_some_and(|planner| planner.knows())
    }

    /// True while more of what follows the present move is to be shown.
    pub fn wants_more(&mut self) -> bool {
        self.planner.as_mut().is_some_and(|planner| planner.wants_more())
    }

    /// Shows what follows.
    pub fn show(&mut self, ahead: &Ahead) {
        if let Some(planner) = &mut self.planner {
            planner.show(ahead);
        }
    }

    /// What was shown does not come; the axes stand.
    pub fn forget_ahead(&mut self) {
        if let Some(planner) = &mut self.planner {
            planner.forget();
        }
    }

    /// Plans the present move, which has been shown.
    pub fn plan(&mut self) {
        self.planned = self.planner.as_mut().filter(|planner| planner.knows()).map(|planner| planner.drive());
    }

    /// The speeds as the operator has set them, from the next move on.
    pub fn set_overrides(&mut self, overrides: Overrides) {
        self.overrides = overrides;
        if let Some(planner) = &mut self.planner {
            planner.set_overrides(overrides);
        }
    }

    /// The speeds as the operator has set them.
    pub fn overrides(&self) -> &Overrides {
        &self.overrides
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
        self.planned = None;
        match self.upstream.next() {
            Pull::Item(_) => Pull::Item(()),
            Pull::Barrier(barrier) => Pull::Barrier(barrier),
            Pull::End => Pull::End,
        }
    }

    /// The shape that [`Motion::next`] has come to, with its time.
    pub fn current(&self) -> Timed<'_> {
        let timed = self.time(self.upstream.current());
        match self.planned {
            None => timed,
            Some((seconds, pace)) => Timed { duration: Seconds(seconds), pace, ..timed },
        }
    }

    /// A shape with its time.
    pub fn time<'s>(&self, shaped: &'s Shaped) -> Timed<'s> {
        let mut pace = Pace::default();
        let (seconds, length, feed) = match &shaped.shape {
            Shape::Rapid { from, to, .. } => {
                let rapid = self.rapid(from, to);
                if self.planner.is_some() {
                    let asked = self.rapid_rate(from, to, rapid.1) as f32;
                    pace = Pace { asked, allowed: asked, ..pace };
                }
                rapid
            }
            Shape::Line { from, to, feed } => self.line(from, to, feed),
            Shape::Arc { arc, feed } => self.arc(arc, feed),
            Shape::Dwell(dwell) => (self.overrides.dwell(*dwell), 0.0, 0.0),
            _ => (0.0, 0.0, 0.0),
        };
        Timed { shaped, duration: Seconds(seconds), length, feed, pace }
    }

    fn rapid(&self, from: &Point, to: &Point) -> (f64, f64, f64) {
        let length = distance(from, to, self.limits.count);
        if self.limits.straight_rapid {
            let (speed, acceleration) = self.along(from, to, length, |axis| self.overrides.rapid(axis.rapid));
            return (Trapezoid::new(length, speed, acceleration).seconds(), length, 0.0);
        }
        let mut longest = 0.0f64;
        for axis in 0..self.limits.count {
            let way = (to[axis] - from[axis]).abs();
            if way > 0.0 {
                let limits = &self.limits.axes[axis];
                longest =
                    longest.max(Trapezoid::new(way, self.overrides.rapid(limits.rapid), limits.acceleration).seconds());
            }
        }
        (longest, length, 0.0)
    }

    /// The straight speed of positioning in which every axis runs at its rate, or waits for the slowest.
    fn rapid_rate(&self, from: &Point, to: &Point, length: f64) -> f64 {
        let needed = |axis: usize| (to[axis] - from[axis]).abs() / self.overrides.rapid(self.limits.axes[axis].rapid);
        let longest = (0..self.limits.count).map(needed).fold(0.0, f64::max);
        if longest > 0.0 { length / longest } else { 0.0 }
    }

    fn line(&self, from: &Point, to: &Point, feed: &Feed) -> (f64, f64, f64) {
        let length = distance(from, to, self.limits.count);
        let at_rapid = self.overrides.at_rapid(feed);
        let rate = |axis: &crate::AxisLimits| if at_rapid { self.overrides.rapid(axis.rapid) } else { axis.max_feed };
        let (most, acceleration) = self.along(from, to, length, rate);
        let (commanded, speed) = if at_rapid {
            (self.along(from, to, length, |axis| axis.rapid).0 * 60.0, most)
        } else {
            // The feed of the tool's tip, whose way is another than that of the axes.
            let share = if feed.way_mm > 0.0 { length / feed.way_mm } else { 1.0 };
            (self.overrides.commanded(feed), most.min(self.overrides.actual(feed) / 60.0 * share))
        };
        (Trapezoid::new(length, speed, acceleration).seconds(), length, commanded)
    }

    /// The highest speed and acceleration along a straight way that no axis is asked too much by.
    fn along(&self, from: &Point, to: &Point, length: f64, rate: impl Fn(&crate::AxisLimits) -> f64) -> (f64, f64) {
        // What holds it most: a limit, and the axis' own way. Only theirs is worth a division.
        let (mut speed, mut acceleration) = ((f64::INFINITY, 1.0), (f64::INFINITY, 1.0));
        for axis in 0..self.limits.count {
            let way = (to[axis] - from[axis]).abs();
            if way > 0.0 {
                let limits = &self.limits.axes[axis];
                speed = tighter(speed, (rate(limits), way));
                acceleration = tighter(acceleration, (limits.acceleration, way));
            }
        }
        // Where nothing moves there is no bound.
        let along = |(limit, way): (f64, f64)| if limit.is_finite() { limit * length / way } else { limit };
        (along(speed), along(acceleration))
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
        let at_rapid = self.overrides.at_rapid(feed);
        let rate = |axis: &crate::AxisLimits| if at_rapid { self.overrides.rapid(axis.rapid) } else { axis.max_feed };
        let most = rate(u).min(rate(v));
        let (commanded, actual) = if at_rapid {
            (u.rapid.min(v.rapid) * 60.0, most)
        } else {
            (self.overrides.commanded(feed), self.overrides.actual(feed) / 60.0)
        };
        // Speeds in the plane; the axes beside it keep step.
        let mut speed = actual.min(most).min(centripetal);
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

/// The smaller one of two limits, each divided by its axis' way.
fn tighter(one: (f64, f64), other: (f64, f64)) -> (f64, f64) {
    if other.0 * one.1 < one.0 * other.1 { other } else { one }
}

fn distance(from: &Point, to: &Point, axes: usize) -> f64 {
    let mut sum = 0.0;
    for axis in 0..axes.min(AXES) {
        let way = to[axis] - from[axis];
        sum += way * way;
    }
    sum.sqrt()
}
