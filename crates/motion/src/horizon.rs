//! What the control sees of the path before it: moves in, their time out.
//!
//! Moves are cut into cells; backwards from the farthest, where it must be able to stand, each cell learns the
//! highest speed from which all the rest can be kept to. Where that is the cell's own limit, what lies farther off
//! does not matter: everything up to there is settled, however much path is still to come. A move is driven once it
//! is settled, so no look-ahead of any length would drive it faster; only where [`MOST_CELLS`] are not enough
//! it may be slower.

mod drive;
mod legs;
mod settle;
mod stand;

use std::collections::VecDeque;

use base::{AXES, Point};
use meaning::Feed;

use drive::Drive;
pub use drive::{Leg, Setpoint};

use crate::cell::{Cell, Ends, Reserve};
use crate::corner::{Corner, corner, round};
use crate::limits::{AxisLimits, Limits, Scale};
use crate::overrides::Overrides;
use crate::way::{Edges, Way, norm};

/// The longest look-ahead, cells. A program of points 1 µm apart is then seen 16 mm ahead.
pub const MOST_CELLS: usize = 16_384;
/// Room for so many is there from the beginning, so that driving hardly ever waits for more.
const USUAL_CELLS: usize = 1024;
/// Between the ends of a cell an acceleration may be more than at both by this part of what the axes can give. Where a
/// cell of an arc turns by φ that is up to 5/8 φ²: φ²/8 as the direction turns, φ²/2 as the speed changes meanwhile.
const UNEVEN: f64 = 0.00225;
/// Speed may change by so much more between the places of a blend that are looked at.
const MORE: f64 = 1.2;
/// Radians that a cell of an arc turns at most; and where it is driven from rest to rest at changing speeds, which are
/// lost on by 0.15 of that.
const WIDEST: f64 = 0.27;
const FINEST: f64 = 0.004;
/// Most cells of a single way.
const MOST_OF_A_WAY: usize = 1600;

/// A cutting move.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Move {
    /// Where it leads.
    pub way: Way,
    /// How fast it shall be.
    pub feed: Feed,
    /// Speed along the way for each of the commanded one.
    pub share: f64,
    /// What comes next waits until the axes stand.
    pub stops: bool,
}

/// How fast a move shall be.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Asked {
    feed: Feed,
    share: f64,
}

/// A move whose cells have not been cut yet: how its way ends is not known.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Open {
    way: Way,
    /// The number of the way, and that of the move.
    number: u64,
    mover: u64,
    /// Where its cells begin.
    from: f64,
    /// The axes stand at its beginning.
    from_rest: bool,
    /// The highest squared speed there.
    enters: f64,
}

/// The moves ahead.
#[derive(Clone, Debug)]
pub struct Horizon {
    limits: Limits,
    /// The same for cutting feeds and for the rapid rate.
    at_feed: Scale,
    at_rapid: Scale,
    overrides: Overrides,
    cells: VecDeque<Cell>,
    /// The ways of the cells, and the first one's number.
    ways: VecDeque<Way>,
    first_way: u64,
    /// What the moves of the cells ask for, and the first one's number.
    asked: VecDeque<Asked>,
    first_move: u64,
    open: Option<Open>,
    /// The axes stand behind the last cell.
    closed: bool,
    /// Cells whose highest speed is final.
    settled: usize,
    /// Cells whose speeds follow from those behind them as these are.
    looked: usize,
    /// So many cells are to be seen before looking again.
    goal: usize,
    /// Setpoints are driven one by one, and so many more moves may be asked for at this one.
    is_live: bool,
    spare: usize,
    drive: Drive,
}

impl Horizon {
    /// Nothing ahead, the axes standing.
    pub fn new(limits: Limits) -> Horizon {
        Horizon {
            limits,
            at_feed: Scale::new(&limits, |axis| axis.max_feed),
            at_rapid: Scale::new(&limits, |axis| axis.rapid),
            overrides: Overrides::default(),
            cells: VecDeque::with_capacity(USUAL_CELLS),
            ways: VecDeque::with_capacity(USUAL_CELLS),
            first_way: 0,
            asked: VecDeque::with_capacity(USUAL_CELLS),
            first_move: 0,
            open: None,
            closed: false,
            settled: 0,
            looked: 0,
            goal: 0,
            is_live: false,
            spare: 0,
            drive: Drive::default(),
        }
    }

    /// Forgets everything ahead; the axes stand.
    pub fn clear(&mut self) {
        self.cells.clear();
        self.ways.clear();
        self.asked.clear();
        self.open = None;
        self.closed = false;
        (self.settled, self.looked, self.goal) = (0, 0, 0);
        self.drive = Drive::default();
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
        self.asked.push_back(Asked { feed: next.feed, share: next.share });
        let mut open = Open { way: next.way, number: 0, mover, from: 0.0, from_rest: true, enters: f64::INFINITY };
        if let Some(last) = self.open.take() {
            self.join(&last, &mut open);
        }
        open.number = self.keep(next.way);
        self.open = Some(open);
        if next.stops {
            self.stop();
        }
    }

    /// The axes stand behind the last move.
    pub fn stop(&mut self) {
        if let Some(last) = self.open.take() {
            self.end_at_rest(&last);
        }
        self.closed = !self.cells.is_empty();
    }

    /// Cuts the end of one way and the corner into the next.
    fn join(&mut self, last: &Open, next: &mut Open) {
        let speed = self.wanted(last.mover).min(self.wanted(next.mover));
        match corner(&self.limits, &last.way, &next.way, speed) {
            Corner::Stop => self.end_at_rest(last),
            Corner::Passed(most) => {
                (next.from_rest, next.enters) = (false, most * most);
                self.cut(last, last.way.length(), false);
                self.end_move(Ends::AtEnd, false);
                self.link(pace(&next.way, 0.0));
            }
            Corner::Rounded(arm) => {
                (next.from, next.from_rest) = (arm, false);
                let end = last.way.length() - arm;
                self.cut(last, end, false);
                self.link(1.0);
                self.cut_blend(&round(&last.way, &next.way, arm), [last.mover, next.mover]);
                self.link(pace(&next.way, arm));
            }
        }
    }

    fn end_at_rest(&mut self, last: &Open) {
        self.cut(last, last.way.length(), true);
        self.end_move(Ends::AtEnd, true);
    }

    /// The cell before goes over into a way that runs at this pace.
    fn link(&mut self, next: f64) {
        let number = self.cells.back().map(|cell| (cell.way, cell.part[1]));
        let own = number.and_then(|(number, end)| self.way(number).map(|way| pace(way, end)));
        if let (Some(own), Some(cell)) = (own, self.cells.back_mut()) {
            let ratio = next / own;
            cell.gain = ratio * ratio;
        }
    }

    fn cut(&mut self, open: &Open, end: f64, to_rest: bool) {
        let length = end - open.from;
        if length <= 0.0 {
            return;
        }
        let (mut pieces, mut reserve) = (1, Reserve::of(0.0));
        if let Way::Arc { arc, length: whole } = &open.way {
            // On a spiral the direction turns up to twice as fast as the spoke.
            let is_even = arc.radius[0] == arc.radius[1];
            let part = if is_even { length / whole } else { 2.0 * length / whole };
            let turned = arc.sweep.abs() * part;
            let mut widest = WIDEST;
            if to_rest && open.from_rest {
                widest = FINEST.max(widest.min(FINEST / self.share_changing(open, length)));
            }
            pieces = ((turned / widest).ceil() as usize).clamp(1, MOST_OF_A_WAY);
            let each = turned / pieces as f64;
            reserve =
                if is_even { Reserve::round(each, length / pieces as f64) } else { Reserve::of(0.625 * each * each) };
        }
        let first = self.cells.len();
        self.push((open.number, &open.way), [open.from, end], (pieces, reserve), [open.mover; 2]);
        if let Some(cell) = self.cells.get_mut(first) {
            cell.enters = open.enters;
        }
    }

    /// The part of its time for which the speed of an arc changes that is driven from rest to rest, roughly.
    fn share_changing(&self, open: &Open, length: f64) -> f64 {
        let speed = self.wanted(open.mover);
        let (at, square) = (length / 2.0, speed * speed);
        let acceleration = self.hardest_along(&[1.0; AXES]);
        let bend = open.way.bend(at);
        if 2.0 * square * norm(&bend, AXES) > acceleration || square > acceleration * length {
            return 1.0;
        }
        let changing = 2.0 * speed / acceleration;
        changing / (changing / 2.0 + length / speed)
    }

    fn cut_blend(&mut self, blend: &Way, movers: [u64; 2]) {
        let number = self.keep(*blend);
        let length = blend.length();
        let Way::Blend { terms: [_, _, square, cube], .. } = blend else { return };
        // The bend changes steadily, so nowhere is it more than at one of its ends.
        let ends: [Point; 2] =
            [0.0, 6.0 * length].map(|s| std::array::from_fn(|axis| 2.0 * square[axis] + s * cube[axis]));
        let turned = length * ends.map(|bend| norm(&bend, AXES)).into_iter().fold(0.0, f64::max);
        // Between the ends of a cell an acceleration is off the straight line between theirs as 5/8 of the third
        // derivative, by the change of speed and the square of the length.
        let looked_at = [0.0, length / 2.0, length];
        let u = looked_at.map(|s| MORE * self.hardest_along(&blend.slope(s))).into_iter().fold(0.0, f64::max);
        let mut uneven = 0.0f64;
        for (limit, cube) in self.limits.axes.iter().zip(cube).take(self.limits.count) {
            uneven = uneven.max(0.625 * 6.0 * cube.abs() * u * length * length / limit.acceleration);
        }
        let uneven = uneven.max(0.625 * turned * turned);
        let pieces = ((uneven / UNEVEN).sqrt().ceil().max(1.0) as usize).min(MOST_OF_A_WAY);
        if pieces <= 1 {
            self.push((number, blend), [0.0, length], (1, Reserve::of(uneven)), movers);
            return self.end_move(Ends::At(length / 2.0), false);
        }
        let half = pieces.div_ceil(2);
        let reserve = Reserve::of(uneven / (4 * half * half) as f64);
        self.push((number, blend), [0.0, length / 2.0], (half, reserve), movers);
        self.end_move(Ends::AtEnd, false);
        self.push((number, blend), [length / 2.0, length], (half, reserve), movers);
    }

    /// The highest acceleration along a direction that no axis is asked too much by.
    fn hardest_along(&self, slope: &Point) -> f64 {
        let axes = self.limits.axes.iter().zip(slope).take(self.limits.count);
        axes.map(|(limit, slope)| limit.acceleration / slope.abs()).fold(f64::INFINITY, f64::min)
    }

    /// Cuts a part of a way into so many cells, each of which uses so much of what the axes can give.
    fn push(
        &mut self,
        (number, way): (u64, &Way),
        [from, to]: [f64; 2],
        (pieces, reserve): (usize, Reserve),
        moves: [u64; 2],
    ) {
        let (scale, asked) = (*self.scale(moves), self.slowest(moves));
        if let Way::Line { along, .. } = way {
            self.cells.push_back(Cell::straight(&scale, number, [from, to], along));
            return self.end_cut(moves, asked);
        }
        let step = (to - from) / pieces as f64;
        let mut edges = Edges::new(way, from, step);
        let (mut start, mut edge) = (from, edges.next());
        for piece in 1..=pieces {
            let end = if piece == pieces { to } else { from + step * piece as f64 };
            let next = edges.next();
            self.cells.push_back(Cell::new(number, [start, end]));
            if let Some(cell) = self.cells.back_mut() {
                cell.bend(&scale, [&edge, &next], &reserve);
            }
            self.end_cut(moves, asked);
            (start, edge) = (end, next);
        }
    }

    /// The last cell is of these moves, which ask for this speed.
    fn end_cut(&mut self, moves: [u64; 2], asked: f64) {
        if let Some(cell) = self.cells.back_mut() {
            cell.moves = moves;
            cell.feed_allows = asked * asked / cell.pace;
        }
        if self.overrides.rapid_tells()
            && let Some(cell) = self.cells.back()
        {
            let allows = self.feed_allows(cell, asked);
            if let Some(cell) = self.cells.back_mut() {
                cell.set_feed(allows);
            }
        }
    }

    fn end_move(&mut self, ends: Ends, stops: bool) {
        if let Some(cell) = self.cells.back_mut() {
            (cell.ends, cell.stops) = (ends, stops);
        }
    }

    fn keep(&mut self, way: Way) -> u64 {
        self.ways.push_back(way);
        self.first_way + self.ways.len() as u64 - 1
    }

    fn way(&self, number: u64) -> Option<&Way> {
        self.ways.get(number.checked_sub(self.first_way)? as usize)
    }

    fn asked(&self, mover: u64) -> Option<&Asked> {
        self.asked.get(mover.checked_sub(self.first_move)? as usize)
    }

    /// The limits that bound what lies on two moves.
    fn scale(&self, moves: [u64; 2]) -> &Scale {
        if moves.into_iter().all(|mover| self.is_at_rapid(mover)) { &self.at_rapid } else { &self.at_feed }
    }

    /// The speed that a move asks for along its way without overrides, mm/s.
    fn wanted(&self, mover: u64) -> f64 {
        self.asked(mover).map_or(0.0, |asked| asked.feed.mm_per_min / 60.0 * asked.share)
    }

    /// The speed that the next move to end asks for, mm/s along its way, overrides counted in.
    pub fn next_asks(&self) -> f64 {
        let next = self.next_end().and_then(|end| self.cells.get(end));
        next.and_then(|cell| self.asked(cell.moves[0])).map_or(0.0, |asked| self.asks(asked))
    }

    /// The speed that a move asks for along its way, mm/s, overrides counted in.
    fn asks(&self, asked: &Asked) -> f64 {
        self.overrides.actual(&asked.feed) / 60.0 * asked.share
    }

    /// The slowest speed that one of these moves asks for along its way, mm/s, overrides counted in.
    fn slowest(&self, moves: [u64; 2]) -> f64 {
        let asks = moves.map(|mover| self.asked(mover).map_or(f64::INFINITY, |asked| self.asks(asked)));
        asks[0].min(asks[1])
    }

    /// The squared speed that the feeds of a cell's moves allow, overrides counted in, of which the slowest is `asked`.
    fn feed_allows(&self, cell: &Cell, asked: f64) -> f64 {
        let mut allows = asked * asked / cell.pace;
        let overrides = &self.overrides;
        if overrides.rapid_tells() && cell.moves.into_iter().any(|mover| self.is_at_rapid(mover)) {
            let rate = |axis: &AxisLimits| match overrides.dry_run {
                Some(_) => axis.max_feed,
                None => overrides.rapid(axis.rapid),
            };
            if let Some(way) = self.way(cell.way) {
                for edge in cell.part.map(|s| way.slope(s)) {
                    for (limit, slope) in self.limits.axes.iter().zip(edge).take(self.limits.count) {
                        let fastest = rate(limit) * cell.rates / slope;
                        allows = allows.min(fastest * fastest);
                    }
                }
            }
        }
        allows
    }

    /// A cut at the rapid rate.
    fn is_at_rapid(&self, mover: u64) -> bool {
        self.asked(mover).is_some_and(|asked| asked.feed.mm_per_min == f64::INFINITY)
    }

    /// The speeds as the operator has set them, from the next setpoint on.
    pub fn set_overrides(&mut self, overrides: Overrides) {
        if self.overrides == overrides {
            return;
        }
        self.overrides = overrides;
        self.cut_here();
        for index in 0..self.cells.len() {
            let cell = &self.cells[index];
            let allows = self.feed_allows(cell, self.slowest(cell.moves));
            self.cells[index].set_feed(allows);
        }
        self.settled = 0;
        self.look_again();
    }
}

/// How far the axes move for each mm of a way: one, but for spirals.
fn pace(way: &Way, s: f64) -> f64 {
    match way {
        Way::Arc { arc, .. } if arc.radius[0] != arc.radius[1] => {
            let slope = way.slope(s);
            norm(&slope, slope.len())
        }
        _ => 1.0,
    }
}
