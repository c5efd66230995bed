//! The stage: one shape in, the same shape out with its duration.

mod alone;
mod driving;

use base::Seconds;
use meaning::{Answer, Feed, Pull, StaleBarrier};
use path::{Path, Shape, Shaped};

use crate::engine::{Kept, Sample};
use crate::horizon::Move;
use crate::limits::Limits;
use crate::overrides::Overrides;
use crate::planner::{Ahead, Pace, Planner, Stretch};
use crate::positioning::Positioning;
use crate::way::Way;
use alone::{along, distance};

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
}
