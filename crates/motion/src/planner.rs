//! What follows the moves at hand, as far as it is known, and the times that come of it.
//!
//! The stage is shown what follows ([`Ahead`]) while it [`Planner::wants_more`]; a move that is then executed must be
//! the one that was shown. What was shown and does not come is forgotten, and the axes have come to rest before.

use std::collections::VecDeque;

use path::Shape;

use crate::horizon::{Horizon, Leg, Move};
use crate::limits::Limits;
use crate::overrides::Overrides;
use crate::stage::{Joins, as_move};
use crate::way::Way;

/// What follows.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Ahead {
    /// A move.
    Move(Shape),
    /// The axes stand before anything else moves.
    Rest,
}

/// How a move runs, mm/s along its way; nothing but zeros where moves are not planned together.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Pace {
    /// The speed that it asks for, overrides counted in; of positioning the one at which every axis runs at its rate.
    pub asked: f32,
    /// What the axes' limits leave of that on its straight or round part.
    pub allowed: f32,
    /// At its start.
    pub start: f32,
    /// At its fastest.
    pub top: f32,
    /// At its end.
    pub end: f32,
}

/// A stretch of a move as it is driven: where, and how.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stretch {
    /// The way it lies on: of the move, or round a corner.
    pub way: Way,
    /// What is driven of it.
    pub leg: Leg,
}

/// The moves shown and not yet executed.
#[derive(Clone, Debug)]
pub(crate) struct Planner {
    horizon: Horizon,
    limits: Limits,
    shown: VecDeque<Shape>,
    /// The stretches of the move driven last, if they are wanted.
    stretches: Vec<Stretch>,
    keeps_stretches: bool,
}

impl Planner {
    pub fn new(limits: Limits) -> Planner {
        Planner {
            horizon: Horizon::new(limits),
            limits,
            shown: VecDeque::new(),
            stretches: Vec::new(),
            keeps_stretches: false,
        }
    }

    pub fn set_overrides(&mut self, overrides: Overrides) {
        self.horizon.set_overrides(overrides);
    }

    pub fn keep_stretches(&mut self) {
        self.keeps_stretches = true;
    }

    pub fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }

    /// True while the next move might be driven faster if more were known.
    pub fn wants_more(&mut self) -> bool {
        self.horizon.wants_more()
    }

    pub fn show(&mut self, ahead: &Ahead) {
        match ahead {
            Ahead::Rest => self.horizon.stop(),
            Ahead::Move(shape) => match as_move(shape, &self.limits) {
                Joins::Move(next) => {
                    self.shown.push_back(*shape);
                    self.add(&next);
                }
                Joins::Nothing => {}
                Joins::Rest => self.horizon.stop(),
            },
        }
    }

    fn add(&mut self, next: &Move) {
        if !self.horizon.is_closed() {
            self.horizon.add(next);
        }
    }

    /// True if this is the move that comes next of those shown, or none has been shown.
    pub fn expects(&self, shape: &Shape) -> bool {
        self.shown.front().is_none_or(|next| next == shape)
    }

    /// True if moves have been shown.
    pub fn knows(&self) -> bool {
        !self.shown.is_empty()
    }

    /// Forgets what was shown.
    pub fn forget(&mut self) {
        self.horizon.clear();
        self.shown.clear();
    }

    /// Drives the next move shown: its time, s, and how it runs.
    pub fn drive(&mut self) -> (f64, Pace) {
        let Planner { horizon, shown, stretches, keeps_stretches, .. } = self;
        stretches.clear();
        let asked = horizon.next_asks() as f32;
        let mut allowed = f32::INFINITY;
        let mut pace: Option<Pace> = None;
        let seconds = horizon.drive_move(|way, axes_allow, leg| {
            let (speed, end) = (leg.speed as f32, leg.at(leg.seconds).1 as f32);
            let pace = pace.get_or_insert(Pace { asked, start: speed, ..Pace::default() });
            pace.top = pace.top.max(speed).max(end);
            pace.end = end;
            if !matches!(way, Way::Blend { .. }) {
                allowed = allowed.min(axes_allow.sqrt() as f32);
            }
            if *keeps_stretches {
                stretches.push(Stretch { way: *way, leg: *leg });
            }
        });
        shown.pop_front();
        (seconds, Pace { allowed: allowed.min(asked), ..pace.unwrap_or_default() })
    }
}
