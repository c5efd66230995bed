//! Model `classic`: how the controls of 1980 to 1995 moved.
//!
//! The interpolator runs along the cuts at the commanded feed, from block to block without a stop; the exponential
//! acceleration behind it lets every axis follow late ([`lag`]): corners are rounded, arcs become smaller. Rapids
//! accelerate linearly, every axis for itself ([`ramp`]). Before a rapid, a code, a dwell and behind an exact stop
//! all axes must be in position. Blocks that are not ready yet are waited for ([`buffer`]). All times and places
//! are exact: nothing depends on how often they are looked at.

mod buffer;
mod drive;
mod lag;
mod ramp;

use std::collections::VecDeque;

use base::{AXES, Point};

use buffer::Buffer;
pub use drive::{Spell, SpellKind};
use ramp::{Rapid, Rate};

use crate::horizon::{Move, Setpoint};
use crate::limits::{Classic, Limits};
use crate::overrides::Overrides;
use crate::way::{Way, norm};

/// A time constant of zero, a width of zero: so small that nobody sees it, s and mm.
const NEXT_TO_NOTHING: f64 = 1e-9;
/// The move under way and the one that decides how it ends.
const AHEAD: usize = 2;

/// What the time of a move, or of a dwell, was made of, s.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Spent {
    /// All of it.
    pub seconds: f64,
    /// Of it the interpolator waited for its block.
    pub starving: f64,
    /// Of it the axes were waited for until they were in position.
    pub settling: f64,
}

/// A move that is to come.
#[derive(Clone, Copy, Debug)]
struct Ahead {
    what: What,
    /// Blocks that must have been made ready.
    blocks: u32,
    /// What comes next waits until all axes are in position.
    stops: bool,
}

#[derive(Clone, Copy, Debug)]
enum What {
    Cut(Move),
    Rapid { from: Point, to: Point },
}

/// What is being done.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Phase {
    /// Nothing yet.
    Between,
    /// The next block is waited for.
    Starving,
    /// The interpolator runs.
    Cutting {
        /// Where on its way it began, mm, and how fast it is, mm/s.
        s: f64,
        speed: f64,
        /// What the axes were behind in excess of what belongs to this way and speed.
        excess: Point,
    },
    /// The interpolator stands at the end of a cut and waits for the axes.
    Settling,
    /// Rapid.
    Rapid,
}

/// The interpolator of an old control and the axes behind it.
#[derive(Clone, Debug)]
pub struct Interpolator {
    limits: Limits,
    model: Classic,
    overrides: Overrides,
    held: bool,
    ahead: VecDeque<Ahead>,
    /// Blocks that have begun since the last move.
    blocks: u32,
    buffer: Buffer,
    /// Seconds since the beginning, up to the present phase.
    clock: f64,
    phase: Phase,
    /// How long the phase lasts, and how much of that is over, s.
    seconds: f64,
    spent: f64,
    /// Where the interpolator stands between moves.
    at: Option<Point>,
    /// What the axes were behind at the beginning of the phase.
    behind: Point,
    rapid: Rapid,
    /// A rapid without in-position check that is still slowing down, and how much of its time is over.
    tail: Option<(Rapid, f64)>,
    this: Spent,
    last: Spent,
}

impl Interpolator {
    /// Nothing ahead, the axes standing.
    pub fn new(limits: Limits, model: Classic) -> Interpolator {
        let model = Classic {
            rapid_s: model.rapid_s.max(NEXT_TO_NOTHING),
            feed_s: model.feed_s.max(NEXT_TO_NOTHING),
            in_position_mm: model.in_position_mm.max(NEXT_TO_NOTHING),
            ..model
        };
        Interpolator {
            limits,
            model,
            overrides: Overrides::default(),
            held: false,
            ahead: VecDeque::with_capacity(AHEAD),
            blocks: 0,
            buffer: Buffer::new(model.block_s, model.buffer as usize),
            clock: 0.0,
            phase: Phase::Between,
            seconds: 0.0,
            spent: 0.0,
            at: None,
            behind: [0.0; AXES],
            rapid: Rapid::default(),
            tail: None,
            this: Spent::default(),
            last: Spent::default(),
        }
    }

    /// Forgets everything ahead and all blocks that are ready; the axes stand where they are looked for next.
    pub fn clear(&mut self) {
        self.ahead.clear();
        self.buffer.empty(0.0);
        (self.blocks, self.clock) = (0, 0.0);
        (self.phase, self.seconds, self.spent) = (Phase::Between, 0.0, 0.0);
        (self.at, self.tail, self.behind) = (None, None, [0.0; AXES]);
        (self.this, self.last) = (Spent::default(), Spent::default());
    }

    /// True if nothing is ahead.
    pub fn is_empty(&self) -> bool {
        self.ahead.is_empty()
    }

    /// True if the axes stand behind the last move: what follows is added when that has been driven.
    pub fn is_closed(&self) -> bool {
        self.ahead.back().is_some_and(|last| last.stops)
    }

    /// True while it is not known how the next move ends; with nothing more to come, [`Interpolator::stop`] says so.
    pub fn wants_more(&self) -> bool {
        self.ahead.len() < AHEAD && !self.is_closed()
    }

    /// A block of the program begins: what is added from here on is part of it. It is counted whether it moves or not.
    pub fn begin_block(&mut self) {
        self.blocks = self.blocks.saturating_add(1);
    }

    /// Adds a cut.
    pub fn add(&mut self, next: &Move) {
        self.push(What::Cut(*next), next.stops);
    }

    /// Adds a rapid move. With `checked` it ends in position; without (G06) a rapid that follows begins as soon as this
    /// one slows down.
    pub fn add_rapid(&mut self, from: &Point, to: &Point, checked: bool) {
        if let Some(Ahead { what: What::Cut(_), stops, .. }) = self.ahead.back_mut() {
            *stops = true;
        }
        self.push(What::Rapid { from: *from, to: *to }, checked);
    }

    fn push(&mut self, what: What, stops: bool) {
        debug_assert!(self.ahead.len() < AHEAD, "it is asked first whether more is wanted");
        self.at.get_or_insert(what.start());
        let blocks = std::mem::take(&mut self.blocks);
        self.ahead.push_back(Ahead { what, blocks, stops });
    }

    /// All axes are in position behind the last move.
    pub fn stop(&mut self) {
        if let Some(last) = self.ahead.back_mut() {
            last.stops = true;
        }
    }

    /// Time passes without a move, between moves: a dwell, a code's answer. How long the blocks that have begun were
    /// waited for before it.
    pub fn pass(&mut self, seconds: f64) -> f64 {
        debug_assert!(self.phase == Phase::Between, "moves are driven to their end first");
        let blocks = std::mem::take(&mut self.blocks);
        let starving = self.take_blocks(blocks);
        self.elapse(starving + seconds);
        self.last = Spent { seconds: starving + seconds, starving, settling: 0.0 };
        starving
    }

    /// What has not begun yet is read only from here on: M00, M01, M02, M30, and what else stops reading ahead.
    pub fn empty_buffer(&mut self) {
        self.buffer.empty(self.clock + self.spent);
    }

    /// What the time of the move or dwell that ended last was made of.
    pub fn last_spent(&self) -> Spent {
        self.last
    }

    fn take_blocks(&mut self, blocks: u32) -> f64 {
        let start = (0..blocks).fold(0.0, |waited, _| waited + self.buffer.take(self.clock + waited));
        if start > 0.0 { start } else { 0.0 }
    }

    /// The speeds as the operator has set them, at once.
    pub fn set_overrides(&mut self, overrides: Overrides) {
        if self.overrides != overrides {
            self.overrides = overrides;
            self.go_on_anew();
        }
    }

    /// The speeds as the operator has set them.
    pub fn overrides(&self) -> &Overrides {
        &self.overrides
    }

    /// The interpolator stops at once and rapids as fast as they can, or they go on.
    pub fn hold(&mut self, held: bool) {
        if self.held != held {
            self.held = held;
            self.go_on_anew();
        }
    }

    /// The speed of the interpolator on a cut, mm/s.
    fn speed(&self, cut: &Move) -> f64 {
        if self.held || cut.way.length() <= 0.0 {
            return 0.0;
        }
        let at_rapid = self.overrides.at_rapid(&cut.feed);
        let steepest = lag::steepest(&cut.way);
        let mut speed = self.overrides.actual(&cut.feed) / 60.0 * cut.share;
        for (axis, steepest) in self.limits.axes[..self.limits.count].iter().zip(steepest) {
            let rate = if at_rapid { self.overrides.rapid(axis.rapid) } else { axis.max_feed };
            if steepest * speed > rate {
                speed = rate / steepest;
            }
        }
        speed.max(0.0)
    }

    /// What every axis may do in a rapid: its own rate, or together so much that they run in a straight line.
    fn rates(&self, from: &Point, to: &Point) -> [Rate; AXES] {
        let mut rates = [(0.0, 1.0); AXES];
        let factor = if self.held { 0.0 } else { 1.0 };
        let own = |axis: usize| {
            let rapid = self.limits.axes[axis].rapid;
            (self.overrides.rapid(rapid) * factor, rapid / self.model.rapid_s)
        };
        for axis in 0..self.limits.count {
            rates[axis] = own(axis);
        }
        if self.limits.straight_rapid {
            let way: Point = std::array::from_fn(|axis| (to[axis] - from[axis]).abs());
            let length = norm(&way, self.limits.count);
            let (mut speed, mut acceleration) = (f64::INFINITY, f64::INFINITY);
            for axis in (0..self.limits.count).filter(|&axis| way[axis] > 0.0) {
                let (rate, most) = rates[axis];
                speed = speed.min(rate * length / way[axis]);
                acceleration = acceleration.min(most * length / way[axis]);
            }
            for axis in (0..self.limits.count).filter(|&axis| way[axis] > 0.0) {
                let share = way[axis] / length;
                rates[axis] = (speed * share, acceleration * share);
            }
        }
        rates
    }
}

impl What {
    fn start(&self) -> Point {
        match self {
            What::Cut(cut) => cut.way.at(0.0),
            What::Rapid { from, .. } => *from,
        }
    }

    fn way(&self) -> Option<&Way> {
        match self {
            What::Cut(cut) => Some(&cut.way),
            What::Rapid { .. } => None,
        }
    }
}
