//! The stage: one shape in, the same shape out with its duration.

use base::{AXES, Point, Seconds};
use meaning::{Answer, Feed, Pull, StaleBarrier};
use path::{Arc, Path, Shape, Shaped};

use crate::engine::{Kept, Sample};
use crate::horizon::{Move, Setpoint};
use crate::limits::{Limits, Model};
use crate::overrides::Overrides;
use crate::planner::{Ahead, Pace, Planner, Stretch};
use crate::positioning::Positioning;
use crate::profile::Trapezoid;
use crate::scurve::SCurve;
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
    /// The present shape, if it is being positioned under the eyes of the operator.
    positioning: Option<Positioning>,
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
        Motion { upstream, limits, overrides: Overrides::default(), planner: None, planned: None, positioning: None }
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
        Motion {
            upstream: upstream.clone(),
            limits: *limits,
            overrides: *overrides,
            planner: None,
            planned: None,
            positioning: None,
        }
    }

    /// True if moves are planned together.
    pub fn plans(&self) -> bool {
        self.planner.is_some()
    }

    /// Keeps how the move planned last is driven.
    pub fn keep_stretches(&mut self) {
        if let Some(planner) = &mut self.planner {
            planner.keep_details();
        }
    }

    /// How the move planned last is driven, stretch by stretch.
    pub fn stretches(&self) -> &[Stretch] {
        self.kept().map_or(&[], |kept| &kept.stretches)
    }

    /// Where the axes were on the move planned last, in order of time, if they run beside it (model `classic`).
    pub fn samples(&self) -> &[Sample] {
        self.kept().map_or(&[], |kept| &kept.samples)
    }

    fn kept(&self) -> Option<&Kept> {
        self.planner.as_ref().filter(|_| self.planned.is_some()).and_then(|planner| planner.kept())
    }

    /// The axes have stood for this time, s; how much longer they must for want of a block.
    pub fn pass(&mut self, seconds: f64) -> f64 {
        self.planner.as_mut().map_or(0.0, |planner| planner.pass(seconds))
    }

    /// True if the present shape is a move that is driven together with others, and not what was shown.
    pub fn is_surprised(&self) -> bool {
        let shape = &self.upstream.current().shape;
        self.is_joined() && self.planner.as_ref().is_some_and(|planner| !planner.expects(shape))
    }

    /// True if the present shape is driven together with others.
    pub fn is_joined(&self) -> bool {
        let shape = &self.upstream.current().shape;
        self.planner.as_ref().is_some_and(|planner| planner.joins(shape))
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
        let asked = self.asks();
        self.planned = self.planner.as_mut().filter(|planner| planner.knows()).map(|planner| planner.drive(asked));
    }

    /// The speeds as the operator has set them, from the next move on.
    pub fn set_overrides(&mut self, overrides: Overrides) {
        self.overrides = overrides;
        if let Some(planner) = &mut self.planner {
            planner.set_overrides(overrides);
        }
        if let (Some(positioning), Shape::Rapid { from, to, .. }) =
            (&mut self.positioning, &self.upstream.current().shape)
        {
            let length = distance(from, to, self.limits.count);
            let along = along(&self.limits, from, to, length, |axis| overrides.rapid(axis.rapid)).0;
            let straight = self.limits.straight_rapid;
            let rate = |axis: usize| if straight { along } else { overrides.rapid(self.limits.axes[axis].rapid) };
            positioning.set_rates(rate);
        }
    }

    /// The speeds as the operator has set them.
    pub fn overrides(&self) -> &Overrides {
        &self.overrides
    }

    /// The speed that the present move asks for, mm/s.
    fn asks(&self) -> f64 {
        match &self.upstream.current().shape {
            Shape::Rapid { from, to, .. } => self.rapid_rate(from, to, distance(from, to, self.limits.count)),
            Shape::Line { feed, .. } | Shape::Arc { feed, .. } => self.overrides.actual(feed) / 60.0,
            _ => 0.0,
        }
    }

    /// Begins to drive the present move step by step; it has been shown if it is driven together with others.
    pub fn begin(&mut self) {
        self.planned = None;
        let Shape::Rapid { from, to, .. } = &self.upstream.current().shape else { return };
        if self.is_joined() {
            return;
        }
        self.positioning = Some(self.positioning(from, to));
    }

    /// Positioning from here to there that has not begun.
    pub(crate) fn positioning(&self, from: &Point, to: &Point) -> Positioning {
        let (limits, overrides) = (&self.limits, &self.overrides);
        if limits.straight_rapid {
            let length = distance(from, to, limits.count);
            let (rate, acceleration) = along(limits, from, to, length, |axis| overrides.rapid(axis.rapid));
            let jerk = jerk_along(limits, from, to, length);
            return Positioning::straight(from, to, length, [rate, acceleration, jerk]);
        }
        let of = |axis: usize| {
            let own = &limits.axes[axis];
            [overrides.rapid(own.rapid), own.acceleration, limits.jerk(axis)]
        };
        Positioning::by_axes(from, to, of, limits.count)
    }

    /// Drives the present move for a time, s: what is left of it, and whether the move has ended.
    pub fn drive_for(&mut self, seconds: f64) -> (f64, bool) {
        match (&mut self.positioning, &mut self.planner) {
            (Some(positioning), _) => positioning.drive_for(seconds),
            (None, Some(planner)) => planner.drive_for(seconds),
            _ => (seconds, true),
        }
    }

    /// The present move has been driven to its end in this time, s.
    pub fn end(&mut self, seconds: f64) {
        let timed = self.time(self.upstream.current());
        let speed = self.overrides.commanded(&feed_of(timed.shaped)) / 60.0;
        let pace = if self.positioning.is_some() { timed.pace } else { Pace { asked: speed, ..Pace::default() } };
        self.positioning = None;
        self.planned = Some((seconds, pace));
    }

    /// What is left of the present move is dropped, and what was to follow; the axes stand.
    pub fn drop_rest(&mut self) {
        self.positioning = None;
        self.forget_ahead();
    }

    /// The axes shall stand as soon as they can, or go on.
    pub fn hold(&mut self, held: bool) {
        match (&mut self.positioning, &mut self.planner) {
            (Some(positioning), _) => positioning.hold(held),
            (None, Some(planner)) => planner.hold(held),
            _ => {}
        }
    }

    /// What follows is touched: the axes stand at the end of the first move at whose end they can.
    pub fn stand_soon(&mut self) {
        if let Some(planner) = &mut self.planner {
            planner.stand_soon();
        }
    }

    /// True if nothing moves.
    pub fn is_standing(&self) -> bool {
        match (&self.positioning, &self.planner) {
            (Some(positioning), _) => positioning.is_standing(),
            (None, Some(planner)) => planner.is_standing(),
            _ => true,
        }
    }

    /// Where the axes are on the present move, and how fast, while it is driven step by step.
    pub fn setpoint(&self) -> Option<Setpoint> {
        match (&self.positioning, &self.planner) {
            (Some(positioning), _) => Some(positioning.setpoint()),
            (None, planner) => planner.as_ref().and_then(|planner| planner.setpoint()),
        }
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
                    let asked = self.rapid_rate(from, to, rapid.1);
                    pace = Pace { asked, allowed: asked as f32, ..pace };
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
            let (speed, acceleration) = along(&self.limits, from, to, length, |axis| self.overrides.rapid(axis.rapid));
            let jerk = jerk_along(&self.limits, from, to, length);
            return (from_rest_to_rest(length, speed, acceleration, jerk), length, 0.0);
        }
        let mut longest = 0.0f64;
        for axis in 0..self.limits.count {
            let way = (to[axis] - from[axis]).abs();
            if way > 0.0 {
                let limits = &self.limits.axes[axis];
                let (rate, jerk) = (self.overrides.rapid(limits.rapid), self.limits.jerk(axis));
                longest = longest.max(from_rest_to_rest(way, rate, limits.acceleration, jerk));
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
        let (most, acceleration) = along(&self.limits, from, to, length, rate);
        let (commanded, speed) = if at_rapid {
            (along(&self.limits, from, to, length, |axis| axis.rapid).0 * 60.0, most)
        } else {
            // The feed of the tool's tip, whose way is another than that of the axes.
            let share = if feed.way_mm > 0.0 { length / feed.way_mm } else { 1.0 };
            (self.overrides.commanded(feed), most.min(self.overrides.actual(feed) / 60.0 * share))
        };
        let jerk = jerk_along(&self.limits, from, to, length);
        (from_rest_to_rest(length, speed, acceleration, jerk), length, commanded)
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
        let jerk = arc.axes.map(|axis| self.limits.jerk(usize::from(axis) % AXES));
        let seconds = from_rest_to_rest(plane_length, speed, acceleration, jerk[0].min(jerk[1]));
        (seconds, length, commanded * steepness)
    }
}

/// The feed of a cutting move.
fn feed_of(shaped: &Shaped) -> Feed {
    match &shaped.shape {
        Shape::Line { feed, .. } | Shape::Arc { feed, .. } => *feed,
        _ => Feed { mm_per_min: 0.0, exact_stop: false, tapping: false, per_revolution: false, way_mm: 0.0 },
    }
}

/// The highest speed and acceleration along a straight way that no axis is asked too much by.
fn along(
    limits: &Limits,
    from: &Point,
    to: &Point,
    length: f64,
    rate: impl Fn(&crate::AxisLimits) -> f64,
) -> (f64, f64) {
    // What holds it most: a limit, and the axis' own way. Only theirs is worth a division.
    let (mut speed, mut acceleration) = ((f64::INFINITY, 1.0), (f64::INFINITY, 1.0));
    for axis in 0..limits.count {
        let way = (to[axis] - from[axis]).abs();
        if way > 0.0 {
            let limits = &limits.axes[axis];
            speed = tighter(speed, (rate(limits), way));
            acceleration = tighter(acceleration, (limits.acceleration, way));
        }
    }
    // Where nothing moves there is no bound.
    let along = |(limit, way): (f64, f64)| if limit.is_finite() { limit * length / way } else { limit };
    (along(speed), along(acceleration))
}

/// The highest jerk along a straight way; infinite under all models but one.
fn jerk_along(limits: &Limits, from: &Point, to: &Point, length: f64) -> f64 {
    if limits.model != Model::Jerk {
        return f64::INFINITY;
    }
    let each = |axis: usize| limits.axes[axis].jerk * length / (to[axis] - from[axis]).abs();
    (0..limits.count).filter(|&axis| to[axis] != from[axis]).map(each).fold(f64::INFINITY, f64::min)
}

/// How long a move takes that is not planned together with others, s.
fn from_rest_to_rest(length: f64, speed: f64, acceleration: f64, jerk: f64) -> f64 {
    if jerk < f64::INFINITY {
        SCurve::new(length, speed, acceleration, jerk).seconds()
    } else {
        Trapezoid::new(length, speed, acceleration).seconds()
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
