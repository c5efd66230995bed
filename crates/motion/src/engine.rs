//! The three models behind one face: what is added, what is driven, what is seen of it.

use base::Point;

use crate::classic::Interpolator;
use crate::horizon::{Horizon, Leg, Move, Setpoint};
use crate::jerk::JerkHorizon;
use crate::limits::{Limits, Model};
use crate::overrides::Overrides;
use crate::planner::Pace;
use crate::sampling::sample_evenly;
use crate::way::Way;

/// A planner of one of the models.
#[derive(Clone, Debug)]
pub(crate) enum Engine {
    /// Model `trapezoid`, and `jerk` where no axis' jerk is limited.
    Horizon(Box<Horizon>),
    /// Model `jerk`.
    Jerk(Box<JerkHorizon>),
    /// Model `classic`.
    Classic(Box<Interpolator>),
}

/// A setpoint, and when it holds.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sample {
    /// Since the beginning of its move, s.
    pub seconds: f64,
    /// Where the axes are, and how fast.
    pub setpoint: Setpoint,
}

/// What is kept of a move that is driven.
#[derive(Clone, Debug, Default)]
pub(crate) struct Kept {
    /// Its stretches.
    pub stretches: Vec<crate::Stretch>,
    /// Setpoints of a move that runs beside its way.
    pub samples: Vec<Sample>,
}

impl Engine {
    pub fn new(limits: Limits) -> Engine {
        match limits.model {
            Model::Classic(classic) => Engine::Classic(Box::new(Interpolator::new(limits, classic))),
            Model::Jerk if limits.axes[..limits.count].iter().any(|axis| axis.jerk.is_finite()) => {
                Engine::Jerk(Box::new(JerkHorizon::new(limits)))
            }
            Model::Trapezoid | Model::Jerk => Engine::Horizon(Box::new(Horizon::new(limits))),
        }
    }

    /// True if it drives rapids, too, and asks for every block.
    pub fn drives_all(&self) -> bool {
        matches!(self, Engine::Classic(_))
    }

    pub fn clear(&mut self) {
        match self {
            Engine::Horizon(horizon) => horizon.clear(),
            Engine::Jerk(horizon) => horizon.clear(),
            Engine::Classic(classic) => classic.clear(),
        }
    }

    pub fn is_closed(&self) -> bool {
        match self {
            Engine::Horizon(horizon) => horizon.is_closed(),
            Engine::Jerk(horizon) => horizon.is_closed(),
            Engine::Classic(classic) => classic.is_closed(),
        }
    }

    pub fn wants_more(&mut self) -> bool {
        match self {
            Engine::Horizon(horizon) => horizon.wants_more(),
            Engine::Jerk(horizon) => horizon.wants_more(),
            Engine::Classic(classic) => classic.wants_more(),
        }
    }

    pub fn add(&mut self, next: &Move) {
        match self {
            Engine::Horizon(horizon) => horizon.add(next),
            Engine::Jerk(horizon) => horizon.add(next),
            Engine::Classic(classic) => classic.add(next),
        }
    }

    /// Adds positioning, with the in-position check or without.
    pub fn add_rapid(&mut self, from: &Point, to: &Point, checked: bool) {
        match self {
            Engine::Horizon(horizon) => horizon.stop(),
            Engine::Jerk(horizon) => horizon.stop(),
            Engine::Classic(classic) => classic.add_rapid(from, to, checked),
        }
    }

    pub fn stop(&mut self) {
        match self {
            Engine::Horizon(horizon) => horizon.stop(),
            Engine::Jerk(horizon) => horizon.stop(),
            Engine::Classic(classic) => classic.stop(),
        }
    }

    /// A block begins.
    pub fn begin_block(&mut self) {
        if let Engine::Classic(classic) = self {
            classic.begin_block();
        }
    }

    /// Nothing has been read ahead.
    pub fn empty_buffer(&mut self) {
        if let Engine::Classic(classic) = self {
            classic.empty_buffer();
        }
    }

    /// The axes have stood for this time, s; how much longer they must for want of a block.
    pub fn pass(&mut self, seconds: f64) -> f64 {
        match self {
            Engine::Horizon(_) | Engine::Jerk(_) => 0.0,
            Engine::Classic(classic) => classic.pass(seconds),
        }
    }

    pub fn set_overrides(&mut self, overrides: Overrides) {
        match self {
            Engine::Horizon(horizon) => horizon.set_overrides(overrides),
            Engine::Jerk(horizon) => horizon.set_overrides(overrides),
            Engine::Classic(classic) => classic.set_overrides(overrides),
        }
    }

    pub fn hold(&mut self, held: bool) {
        match self {
            // Whoever holds has waited for the end of tapping, or does not wait.
            Engine::Horizon(horizon) if held => horizon.emergency_stop(),
            Engine::Horizon(horizon) => horizon.hold(false),
            Engine::Jerk(horizon) => horizon.hold(held),
            Engine::Classic(classic) => classic.hold(held),
        }
    }

    /// What follows is touched; how many moves are left.
    pub fn stand_soon(&mut self, shown: usize) -> usize {
        match self {
            Engine::Horizon(horizon) => horizon.stand_soon(),
            Engine::Jerk(horizon) => horizon.stand_soon(),
            Engine::Classic(classic) => {
                classic.stop();
                shown
            }
        }
    }

    pub fn drive_for(&mut self, seconds: f64) -> (f64, bool) {
        match self {
            Engine::Horizon(horizon) => horizon.drive_for(seconds),
            Engine::Jerk(horizon) => horizon.drive_for(seconds),
            Engine::Classic(classic) => classic.drive_for(seconds),
        }
    }

    pub fn setpoint(&self) -> Option<Setpoint> {
        match self {
            Engine::Horizon(horizon) => horizon.setpoint(),
            Engine::Jerk(horizon) => horizon.setpoint(),
            Engine::Classic(classic) => classic.setpoint(),
        }
    }

    pub fn is_standing(&self) -> bool {
        match self {
            Engine::Horizon(horizon) => horizon.is_standing(),
            Engine::Jerk(horizon) => horizon.is_standing(),
            Engine::Classic(classic) => classic.is_standing(),
        }
    }

    /// Drives the next move to its end: its time, s, and how it runs. What it asks for is `asked`, mm/s.
    pub fn drive(&mut self, asked: f64, kept: Option<&mut Kept>) -> (f64, Pace) {
        match self {
            Engine::Horizon(horizon) => {
                let asks = horizon.next_asks();
                drive_on_the_way(asks, kept, |leg| horizon.drive_move(leg))
            }
            Engine::Jerk(horizon) => {
                let asks = horizon.next_asks();
                drive_on_the_way(asks, kept, |leg| horizon.drive_move(leg))
            }
            Engine::Classic(classic) => drive_beside_it(classic, asked, kept),
        }
    }
}

fn drive_on_the_way(
    asked: f64,
    mut kept: Option<&mut Kept>,
    drive_move: impl FnOnce(&mut dyn FnMut(&Way, f64, &Leg)) -> f64,
) -> (f64, Pace) {
    let mut allowed = f32::INFINITY;
    let mut pace: Option<Pace> = None;
    let seconds = drive_move(&mut |way: &Way, axes_allow: f64, leg: &Leg| {
        let (speed, end) = (leg.speed as f32, leg.at(leg.seconds).1 as f32);
        let pace = pace.get_or_insert(Pace { asked, start: speed, ..Pace::default() });
        pace.top = pace.top.max(speed).max(end);
        pace.end = end;
        if !matches!(way, Way::Blend { .. }) {
            allowed = allowed.min(axes_allow.sqrt() as f32);
        }
        if let Some(kept) = &mut kept {
            kept.stretches.push(crate::Stretch { way: *way, leg: *leg, allowed: axes_allow.sqrt() });
        }
    });
    (seconds, Pace { allowed: allowed.min(asked as f32), ..pace.unwrap_or_default() })
}

fn drive_beside_it(classic: &mut Interpolator, asked: f64, mut kept: Option<&mut Kept>) -> (f64, Pace) {
    let mut pace = Pace { asked, allowed: asked as f32, ..Pace::default() };
    let mut before = 0.0;
    let seconds = classic.drive_move(|spell| {
        pace.top = pace.top.max(spell.speed as f32);
        if let Some(kept) = &mut kept {
            let keep = |at, setpoint| kept.samples.push(Sample { seconds: before + at, setpoint });
            sample_evenly(spell.seconds, |at| spell.at(at), keep);
        }
        before += spell.seconds;
    });
    (seconds, pace)
}
