//! The present move driven through time, step by step, so that an operator can step in.

use base::Point;
use meaning::Feed;
use path::{Shape, Shaped};

use super::Motion;
use super::alone::{along, distance, jerk_along};
use crate::horizon::Setpoint;
use crate::planner::Pace;
use crate::positioning::Positioning;

impl Motion {
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
}

/// The feed of a cutting move.
fn feed_of(shaped: &Shaped) -> Feed {
    match &shaped.shape {
        Shape::Line { feed, .. } | Shape::Arc { feed, .. } => *feed,
        _ => Feed { mm_per_min: 0.0, exact_stop: false, tapping: false, per_revolution: false, way_mm: 0.0 },
    }
}
