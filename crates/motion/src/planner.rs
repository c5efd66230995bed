//! What follows the moves at hand, as far as it is known, and the times that come of it.
//!
//! The stage is shown what follows ([`Ahead`]) while it [`Planner::wants_more`]; a move that is then executed must be
//! the one that was shown. What was shown and does not come is forgotten, and the axes have come to rest before.

use std::collections::VecDeque;

use meaning::RapidKind;
use path::Shape;

use crate::engine::{Engine, Kept};
use crate::horizon::{Leg, Setpoint};
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
    /// A block begins.
    Block,
    /// The control has read nothing ahead.
    NothingRead,
}

/// How a move runs, mm/s along its way; nothing but zeros where moves are not planned together.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Pace {
    /// The speed that it asks for, overrides counted in; of positioning the one at which every axis runs at its rate.
    pub asked: f64,
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
    /// The speed that the axes allow there, mm/s; infinite where it is not known.
    pub allowed: f64,
}

/// The moves shown and not yet executed.
#[derive(Clone, Debug)]
pub(crate) struct Planner {
    engine: Engine,
    limits: Limits,
    shown: VecDeque<Shape>,
    /// How the move driven last is driven, if that is wanted.
    kept: Option<Kept>,
}

impl Planner {
    pub fn new(limits: Limits) -> Planner {
        Planner { engine: Engine::new(limits), limits, shown: VecDeque::new(), kept: None }
    }

    pub fn set_overrides(&mut self, overrides: Overrides) {
        self.engine.set_overrides(overrides);
    }

    pub fn keep_details(&mut self) {
        self.kept = Some(Kept::default());
    }

    pub fn kept(&self) -> Option<&Kept> {
        self.kept.as_ref()
    }

    /// True while the next move might be driven faster if more were known.
    pub fn wants_more(&mut self) -> bool {
        self.engine.wants_more()
    }

    pub fn show(&mut self, ahead: &Ahead) {
        match ahead {
            Ahead::Rest => self.engine.stop(),
            Ahead::Block => self.engine.begin_block(),
            Ahead::NothingRead => self.engine.empty_buffer(),
            Ahead::Move(shape) => self.show_move(shape),
        }
    }

    fn show_move(&mut self, shape: &Shape) {
        let joins = as_move(shape, &self.limits);
        if joins == Joins::Nothing {
            return;
        }
        match (&joins, shape) {
            (Joins::Move(next), _) if !self.engine.is_closed() => self.engine.add(next),
            (Joins::Move(_), _) => {}
            (_, Shape::Rapid { from, to, kind }) if self.engine.drives_all() => {
                self.engine.add_rapid(from, to, *kind == RapidKind::Checked);
            }
            _ => return self.engine.stop(),
        }
        self.shown.push_back(*shape);
    }

    /// True if the shape is driven together with others.
    pub fn joins(&self, shape: &Shape) -> bool {
        match shape {
            Shape::Rapid { .. } => self.engine.drives_all(),
            _ => matches!(as_move(shape, &self.limits), Joins::Move(_)),
        }
    }

    /// The axes have stood for this time, s; how much longer they must for want of a block.
    pub fn pass(&mut self, seconds: f64) -> f64 {
        self.engine.pass(seconds)
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
        self.engine.clear();
        self.shown.clear();
    }

    /// The next move shown is driven for a time: what is left of it, and whether the move has ended.
    pub fn drive_for(&mut self, seconds: f64) -> (f64, bool) {
        let driven = self.engine.drive_for(seconds);
        if driven.1 {
            self.shown.pop_front();
        }
        driven
    }

    /// The axes shall stand as soon as they can, or go on.
    pub fn hold(&mut self, held: bool) {
        self.engine.hold(held);
    }

    /// What follows is touched: the axes stand at the end of the first move at whose end they can.
    pub fn stand_soon(&mut self) {
        if !self.shown.is_empty() {
            let left = self.engine.stand_soon(self.shown.len());
            self.shown.truncate(left);
        }
    }

    /// Where the axes are on what is being driven, and how fast.
    pub fn setpoint(&self) -> Option<Setpoint> {
        self.engine.setpoint()
    }

    /// True if nothing moves.
    pub fn is_standing(&self) -> bool {
        self.engine.is_standing()
    }

    /// Drives the next move shown: its time, s, and how it runs. It asks for `asked`, mm/s.
    pub fn drive(&mut self, asked: f64) -> (f64, Pace) {
        if let Some(kept) = &mut self.kept {
            kept.stretches.clear();
            kept.samples.clear();
        }
        let driven = self.engine.drive(asked, self.kept.as_mut());
        self.shown.pop_front();
        driven
    }
}
