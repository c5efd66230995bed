//! What the control sees of the path before it, under model `jerk`.
//!
//! A *run* is what lies between two stops. In it the path is rounded so that its bend is steady ([`polygon`], [`rounding`]) and
//! planned as if speed could change at a constant acceleration at once; what is driven is the mean of that plan over
//! the last `T` seconds: `s(t) = 1/T ∫ p(τ) dτ` from `t - T` to `t`. Its speed and acceleration are then means of the
//! plan's, and the acceleration changes by at most `2 u / T` (Biagiotti and Melchiorri, *FIR filters for online
//! trajectory planning*, Control Engineering Practice 2012). As the mean is taken along the path, the path is not left.
//!
//! What may be driven at `s` must hold for all that the mean at `s` is made of. If a stretch allows the speed `c`, and
//! the plan keeps to it from `c T / 2` before the stretch to `c T / 2` behind it, then whenever the mean lies within
//! the stretch, the whole window lies within that zone: a window that begins a time `d` before the zone has its mean
//! before the stretch by at least `c T / 2 (1 - (1 - d / T)²)`. So each stretch's bounds are those of all zones it is in.
//!
//! A run that is one straight way is a [`Stroke`](crate::Stroke), the optimum. Holds and overrides act on the plan, which is never
//! above what it was before where it brakes; the mean makes them smooth.

mod bounds;
mod choice;
mod drive;
mod plan;
mod polygon;
mod rounding;
mod settle;
mod stand;

use std::collections::VecDeque;

use base::{AXES, Point};
use meaning::Feed;

use bounds::{Allowance, Bounds, Line};
use choice::Beside;
use drive::Drive;
use polygon::Polygon;
use rounding::Joint;
use settle::Zones;

use crate::horizon::Move;
use crate::limits::{AxisLimits, Limits};
use crate::overrides::Overrides;
use crate::way::Way;

/// The longest look-ahead, pieces. Where more would be needed, the axes stand.
pub const MOST_PIECES: usize = 16_384;
/// The highest feed override: a piece may be driven so much faster than commanded without being looked at anew.
const HIGHEST_OVERRIDE: f64 = 2.0;
/// A move that would want so much longer a window than its run has begins a run of its own.
const TOO_SHORT: f64 = 2.0;

/// How fast a move shall be.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Asked {
    feed: Feed,
    share: f64,
    /// Where it ends.
    to: Point,
}

/// A move whose end is not known yet.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Open {
    way: Way,
    mover: u64,
    /// How it begins.
    start: Joint,
}

/// A stretch of way over which the bounds are the same.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Piece {
    /// The way that it is part of, by number.
    way: u64,
    /// Where it begins on that way, and how long it is, mm.
    from: f64,
    length: f64,
    /// What the axes allow, all zones counted in: mm/s and mm/s².
    fastest: f64,
    push: f64,
    /// What they allow on the piece itself.
    own: f64,
    own_push: f64,
    /// What the commanded feed allows, overrides counted in, mm/s.
    feed: f64,
    /// The highest squared speed of the plan at its start from which all the rest can be kept to.
    most: f64,
    /// The window of its run, s.
    window: f64,
    /// When its end is reached at the earliest, if it is settled, s: only differences mean anything.
    clock: f64,
    /// The moves whose feeds it keeps to.
    moves: [u64; 2],
    /// A move ends at its end; the axes stand there; it is a run of its own along a straight way.
    ends: bool,
    stops: bool,
    stroke: bool,
}

/// The moves ahead, for axes whose jerk is limited.
#[derive(Clone, Debug)]
pub struct JerkHorizon {
    limits: Limits,
    overrides: Overrides,
    pieces: VecDeque<Piece>,
    /// The ways of the pieces, and the first one's number.
    ways: VecDeque<Way>,
    first_way: u64,
    /// What the moves of the pieces ask for, and the first one's number.
    asked: VecDeque<Asked>,
    first_move: u64,
    /// The lines that have not been cut, and the last move.
    polygon: Polygon,
    last: Option<Open>,
    /// The axes stand behind the last piece.
    closed: bool,
    /// The zones of pieces beyond their ends, and those before their beginnings.
    zones: Zones,
    behind: Zones,
    /// The window of the run to which moves are added, s.
    window: f64,
    /// Pieces whose bounds are final, and those whose highest speed is.
    firm: usize,
    settled: usize,
    /// So many pieces are to be seen before looking again.
    goal: usize,
    /// The next move has been found to be settled.
    ready: bool,
    drive: Drive,
}

impl JerkHorizon {
    /// Nothing ahead, the axes standing.
    pub fn new(limits: Limits) -> JerkHorizon {
        JerkHorizon {
            limits,
            overrides: Overrides::default(),
            pieces: VecDeque::new(),
            ways: VecDeque::new(),
            first_way: 0,
            asked: VecDeque::new(),
            first_move: 0,
            polygon: Polygon::default(),
            last: None,
            closed: false,
            zones: Zones::default(),
            behind: Zones::default(),
            window: 0.0,
            firm: 0,
            settled: 0,
            goal: 0,
            ready: false,
            drive: Drive::default(),
        }
    }

    /// Forgets everything ahead; the axes stand.
    pub fn clear(&mut self) {
        self.pieces.clear();
        self.ways.clear();
        self.asked.clear();
        self.polygon.begin(0.0, 0, 0.0);
        self.last = None;
        self.closed = false;
        self.zones.clear();
        (self.firm, self.settled, self.goal, self.ready) = (0, 0, 0, false);
        self.drive.clear();
    }

    /// True if nothing is ahead.
    pub fn is_empty(&self) -> bool {
        self.asked.is_empty()
    }

    /// True if the axes stand behind the last move: what follows is added when that has been driven.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Adds the next move. It is not added to a closed horizon, and it has a length.
    pub fn add(&mut self, next: &Move) {
        debug_assert!(!self.closed && next.way.length() > 0.0, "nothing is seen behind a stop");
        let mover = self.first_move + self.asked.len() as u64;
        let to = next.way.at(next.way.length());
        self.asked.push_back(Asked { feed: next.feed, share: next.share, to });
        self.ready = false;
        let mut open = Open { way: next.way, mover, start: Joint::Rest };
        if let Some(last) = self.last.take() {
            open.start = self.join(&last, &open);
        }
        if open.start == Joint::Rest {
            self.window = self.wanted_window(&open);
        }
        self.last = Some(open);
        if open.way.is_straight() {
            self.add_line(&open);
        }
        if next.stops {
            self.stop();
        }
    }

    /// The axes stand behind the last move.
    pub fn stop(&mut self) {
        self.end_run();
        self.closed = !self.pieces.is_empty();
        self.ready = false;
    }

    /// The run ends with the last move.
    fn end_run(&mut self) {
        if let Some(last) = self.last.take() {
            self.end_way(&last, &Joint::Rest);
        }
    }

    /// Ends one way, with the joint to the next: what that is.
    fn join(&mut self, last: &Open, next: &Open) -> Joint {
        let speed = self.hardest(last.mover).min(self.hardest(next.mover));
        let joint = if self.wanted_window(next) > TOO_SHORT * self.window {
            Joint::Rest
        } else {
            rounding::joint(&self.limits, &last.way, &next.way, speed)
        };
        let straight = last.way.is_straight() && next.way.is_straight();
        let corner = matches!(joint, Joint::Corner(_));
        let joint = if corner && self.stands_between(last, next) { Joint::Rest } else { joint };
        if joint == Joint::Rest || !straight {
            self.end_way(last, &joint);
        }
        if let Joint::Arms(arm) = joint {
            self.push_arms(last, next, arm);
        }
        joint
    }

    /// A line goes on with those before it, or begins.
    fn add_line(&mut self, open: &Open) {
        let (mut change, mut goes_on) = ([0.0; AXES], false);
        match open.start {
            Joint::Corner(by) => (change, goes_on) = (by, true),
            Joint::Passed => goes_on = !self.polygon.is_cut(),
            _ => {}
        }
        if !goes_on {
            let arm = if let Joint::Arms(arm) = open.start { arm } else { 0.0 };
            self.polygon.begin(self.limits.corner_tolerance, self.limits.count, arm);
        }
        self.polygon.add(&open.way, open.mover, change);
        self.cut_lines();
    }

    /// Cuts the lines of which enough is known.
    fn cut_lines(&mut self) {
        let mut polygon = std::mem::take(&mut self.polygon);
        while let Some(mover) = polygon.cut() {
            for way in polygon.pieces() {
                self.push(way, 0.0, way.length(), [mover; 2]);
            }
            if let Some(piece) = self.pieces.back_mut() {
                piece.ends = true;
            }
        }
        self.polygon = polygon;
    }

    fn end_way(&mut self, last: &Open, end: &Joint) {
        let arm = |joint: &Joint| if let Joint::Arms(arm) = joint { *arm } else { 0.0 };
        if last.way.is_straight() {
            self.polygon.end(arm(end));
            self.cut_lines();
        } else {
            let from = arm(&last.start);
            self.push(&last.way, from, last.way.length() - arm(end) - from, [last.mover; 2]);
        }
        let stops = *end == Joint::Rest;
        let stroke = stops && last.start == Joint::Rest && last.way.is_straight() && self.polygon.is_single();
        if let Some(piece) = self.pieces.back_mut() {
            // Half of the arms belongs to the move.
            (piece.ends, piece.stops, piece.stroke) = (!matches!(end, Joint::Arms(_)), stops, stroke);
        }
        if stops {
            self.zones.clear();
        }
    }

    fn push_arms(&mut self, last: &Open, next: &Open, arm: f64) {
        let movers = [last.mover, next.mover];
        let [first, second, third] = rounding::cubics(&last.way, &next.way, arm);
        self.push(&first, 0.0, first.length(), movers);
        let half = second.length() / 2.0;
        self.push(&second, 0.0, half, movers);
        if let Some(piece) = self.pieces.back_mut() {
            piece.ends = true;
        }
        self.push_on(&second, half, half, movers);
        self.push(&third, 0.0, third.length(), movers);
    }

    /// Adds a stretch of a way that is the first one of it.
    fn push(&mut self, way: &Way, from: f64, length: f64, movers: [u64; 2]) {
        // What rounding leaves is nothing.
        if length > way.length() * 1e-9 {
            self.ways.push_back(*way);
            self.push_on(way, from, length, movers);
        }
    }

    /// Adds a stretch of the last way.
    fn push_on(&mut self, way: &Way, from: f64, length: f64, movers: [u64; 2]) {
        let asked = self.hardest(movers[0]).min(self.hardest(movers[1]));
        let bounds = Bounds::of(way, self.limits.count);
        let Allowance { mut fastest, push } = bounds.allow(&self.limits, self.rate(movers[0]), asked, self.window);
        // What the plan counts on before it knows: see `settle.rs`.
        if self.limits.axes[..self.limits.count].iter().all(|axis| push < self.floor(axis)) {
            fastest = fastest.min(push * self.window / 2.0);
        }
        let piece = Piece {
            way: self.first_way + self.ways.len() as u64 - 1,
            from,
            length,
            fastest,
            push,
            own: fastest,
            own_push: push,
            clock: 0.0,
            feed: 0.0,
            most: 0.0,
            window: self.window,
            moves: movers,
            ends: false,
            stops: false,
            stroke: false,
        };
        self.push_piece(Piece { feed: self.feed_allows(&piece), ..piece });
    }

    fn way(&self, number: u64) -> Option<&Way> {
        self.ways.get(number.checked_sub(self.first_way)? as usize)
    }

    fn asked(&self, mover: u64) -> Option<&Asked> {
        self.asked.get(mover.checked_sub(self.first_move)? as usize)
    }

    /// Which rate of an axis bounds a move.
    fn rate(&self, mover: u64) -> fn(&AxisLimits) -> f64 {
        match self.asked(mover) {
            Some(asked) if asked.feed.mm_per_min == f64::INFINITY => |axis| axis.rapid,
            _ => |axis| axis.max_feed,
        }
    }

    /// The highest speed that can ever be asked of a move along its way, mm/s.
    fn hardest(&self, mover: u64) -> f64 {
        self.asked(mover).map_or(0.0, |asked| {
            let feed = asked.feed.mm_per_min * HIGHEST_OVERRIDE;
            feed.max(self.overrides.actual(&asked.feed)) / 60.0 * asked.share
        })
    }

    /// The speed that the next move to end asks for, mm/s along its way, overrides counted in.
    pub fn next_asks(&self) -> f64 {
        let next = self.pieces.iter().find(|piece| piece.ends);
        next.map_or(0.0, |piece| self.feed_allows(&Piece { moves: [piece.moves[0]; 2], fastest: piece.own, ..*piece }))
    }

    /// What can be driven on a way, if it were straight.
    fn line(&self, open: &Open) -> Line {
        let asked = self
            .asked(open.mover)
            .map_or(0.0, |asked| self.overrides.actual(&asked.feed).max(asked.feed.mm_per_min) / 60.0 * asked.share);
        Bounds::of(&open.way, self.limits.count).line(&self.limits, self.rate(open.mover), asked)
    }

    /// The window that suits a move best.
    fn wanted_window(&self, open: &Open) -> f64 {
        self.line(open).window().max(self.limits.servo_period)
    }

    /// True if the axes had better stand in the corner between two lines.
    fn stands_between(&self, last: &Open, next: &Open) -> bool {
        if last.start != Joint::Rest {
            return false;
        }
        let beside = [last, next].map(|open| Beside { line: self.line(open), length: open.way.length() });
        let (first, second) = (last.way.slope(0.0), next.way.slope(0.0));
        let width = rounding::widest(&self.limits, &first, &second).min(beside[0].length).min(beside[1].length);
        let asked = beside[0].line.speed.min(beside[1].line.speed);
        let bounds = Bounds::of_corner(&first, &second, width);
        let passed = bounds.allow(&self.limits, self.rate(next.mover), asked, self.window).fastest;
        choice::stands(&beside[0], &beside[1], passed, width, self.window)
    }

    /// The speed that the feeds of a piece's moves allow, overrides counted in.
    fn feed_allows(&self, piece: &Piece) -> f64 {
        let speed = piece.moves.map(|mover| {
            let Some(asked) = self.asked(mover) else { return 0.0 };
            if self.overrides.at_rapid(&asked.feed) {
                self.overrides.rapid(piece.fastest)
            } else {
                self.overrides.actual(&asked.feed) / 60.0 * asked.share
            }
        });
        speed[0].min(speed[1])
    }

    /// The speeds as the operator has set them, from the next setpoint on.
    pub fn set_overrides(&mut self, overrides: Overrides) {
        if self.overrides == overrides {
            return;
        }
        self.cut_here();
        self.overrides = overrides;
        for index in 0..self.pieces.len() {
            let feed = self.feed_allows(&self.pieces[index]);
            self.pieces[index].feed = feed;
        }
        self.give_stroke_its_speed();
        (self.settled, self.goal, self.ready) = (0, 0, false);
        self.settle();
    }
}
