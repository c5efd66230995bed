//! A cell: a stretch of way over which the bounds of speed and acceleration are looked at together.
//!
//! With `x = v²` and `u = dv/dt`, axis `i` accelerates by `q'ᵢ u + q''ᵢ x`, which its limit holds between `-aᵢ` and
//! `aᵢ`. Within a cell `u` is constant, so `x` at its start and `y` at its end are `2 u` times its length apart, and
//! each axis asks for two strips of the plane of `x` and `y`, one for either end: a convex figure round the origin.
//! [`Cell::most_before`] is its highest `x` from which the next cell can be entered as slowly as it asks,
//! [`Cell::reach`] the range of `y` for an `x`. This is the reachability analysis of Pham and Pham (TOPP-RA, IEEE
//! T-RO 2018), one linear program of two variables a cell.

use base::{AXES, Point};

use crate::limits::Scale;
use crate::way::Edge;

/// One strip: `-half ≤ x + lean y ≤ half`.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
struct Strip {
    half: f64,
    lean: f64,
}

/// Two strips, of the cell's start and of its end, for every axis; on a circle three for two of them, at most one for
/// others.
const STRIPS: usize = 2 * AXES;
/// A speed that is the limit itself shall not count as beyond it by a rounding.
const AT_THE_LIMIT: f64 = 1.0 + 1e-9;
/// Steps after which the search for the highest speed is over; each one leaves a side of the figure behind.
const SEARCH_STEPS: usize = 2 * STRIPS;
/// A strip that does not bound `x` at all is taken to lean as much as this, relative to its bound of `y`.
const LEVEL: f64 = 1e-12;

/// A highest speed at a cell's start: the squared speed there, the one at its end that it leads to, and whether nothing
/// at its end lets it begin faster.
struct Peak {
    x: f64,
    y: f64,
    is_top: bool,
}

/// A stretch of way. Speeds are squared, (mm/s)², and count along the way's own length.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Cell {
    /// The way that it is part of, by number.
    pub way: u64,
    /// Where it begins and ends on that way, mm.
    pub part: [f64; 2],
    /// What the axes allow where speed does not change.
    pub axes_allow: f64,
    /// What the axes' highest feeds allow.
    rates_allow: f64,
    /// What the commanded feed allows, overrides counted in.
    pub feed_allows: f64,
    /// The highest squared speed at its start, for the corner there.
    pub enters: f64,
    /// How far the axes move for each mm of the way, squared; its most.
    pub pace: f64,
    /// The cell's own squared speed at its end for each one of the next cell's, where their ways count differently.
    pub gain: f64,
    /// The highest squared speed at its start from which everything behind it can be kept to.
    pub most: f64,
    /// The same if any speed were allowed at its very start, and the squared speed at its end that it leads to.
    pub peak: f64,
    pub leads_to: f64,
    /// The axes stand at its end.
    pub stops: bool,
    /// Where the move ends that it belongs to.
    pub ends: Ends,
    /// The moves whose feeds hold here: their numbers.
    pub moves: [u64; 2],
    /// The acceleration along it, mm/s², if it is straight.
    straight: Option<f64>,
    /// By how much more the axes may be asked for in its middle than at its ends, relative.
    pub uneven: f64,
    /// The part of the axes' rates that it uses.
    pub rates: f64,
    /// Its highest point of all, once it has been looked for: `x`, and the `y` that it leads to.
    top: Option<[f64; 2]>,
    strips: [Strip; STRIPS],
    count: usize,
    /// Those of its end, a bit for each.
    at_end: u32,
}

/// What is done about it that between a cell's ends the axes may be asked for more than there.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Reserve {
    /// How much more that is, relative, at most.
    pub uneven: f64,
    /// The parts of the axes' acceleration and rates that are used.
    share: f64,
    rates: f64,
    /// Of a circle, whose middle is looked at too: how far it turns for each mm, squared.
    round: Option<f64>,
}

/// So much more is let pass.
const LET_PASS: f64 = 0.0008;

impl Reserve {
    /// Of a cell in which the axes may be asked for so much more.
    pub fn of(uneven: f64) -> Reserve {
        let share = (1.0 + LET_PASS - uneven).clamp(0.5, 1.0);
        Reserve { uneven, share, rates: share, round: None }
    }

    /// Of a cell of a circle that turns by so many radians on so many mm.
    pub fn round(turned: f64, length: f64) -> Reserve {
        let (square, per_mm) = (turned * turned, turned / length);
        let rates = Reserve::of(0.125 * square).share;
        Reserve { uneven: 0.625 * square, share: 1.0, rates, round: Some(per_mm * per_mm) }
    }

    /// Into how many parts a stretch as uneven as this is cut, so that nothing has to be left.
    pub fn parts(uneven: f64) -> usize {
        (uneven / LET_PASS).sqrt().ceil().max(1.0) as usize
    }
}

/// Where in a cell a move ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Ends {
    /// Not in it.
    Not,
    /// At its end.
    AtEnd,
    /// At this length of its way: the corner that it goes round is the border of two moves.
    At(f64),
}

impl Cell {
    /// A cell of which nothing is known but where it is.
    #[inline]
    pub fn new(way: u64, part: [f64; 2]) -> Cell {
        Cell {
            way,
            part,
            axes_allow: f64::INFINITY,
            rates_allow: f64::INFINITY,
            feed_allows: f64::INFINITY,
            enters: f64::INFINITY,
            pace: 1.0,
            gain: 1.0,
            most: 0.0,
            peak: 0.0,
            leads_to: 0.0,
            stops: false,
            ends: Ends::Not,
            moves: [0; 2],
            straight: None,
            uneven: 0.0,
            rates: 1.0,
            top: None,
            strips: [Strip::default(); STRIPS],
            count: 0,
            at_end: 0,
        }
    }

    /// A part of a straight way in this direction.
    pub fn straight(scale: &Scale, way: u64, part: [f64; 2], along: &Point) -> Cell {
        let mut cell = Cell::new(way, part);
        let (mut fastest, mut hardest) = (0.0f64, 0.0f64);
        for (axis, along) in along.iter().enumerate().take(scale.count) {
            fastest = fastest.max(along.abs() * scale.per_rate[axis]);
            hardest = hardest.max(along.abs() * scale.per_acceleration[axis]);
        }
        let allows = 1.0 / (fastest * fastest);
        (cell.axes_allow, cell.rates_allow) = (allows, allows);
        cell.straight = Some(1.0 / hardest);
        cell
    }

    /// A part of a bent way between two of its places.
    pub fn bent(scale: &Scale, way: u64, part: [f64; 2], edges: [&Edge; 2], reserve: &Reserve) -> Cell {
        let mut cell = Cell::new(way, part);
        cell.bend(scale, edges, reserve);
        cell
    }

    /// Bends a new cell.
    #[inline]
    pub fn bend(&mut self, scale: &Scale, [start, end]: [&Edge; 2], reserve: &Reserve) {
        let length = self.length();
        let per_u = 0.5 / length;
        let (mut fastest, mut hardest) = (0.0f64, 0.0f64);
        let (mut first, mut last) = (0.0, 0.0);
        (self.uneven, self.rates) = (reserve.uneven, reserve.rates);
        for axis in 0..scale.count.min(AXES) {
            let (slopes, bends) = ([start.slope[axis], end.slope[axis]], [start.bend[axis], end.bend[axis]]);
            if slopes == [0.0; 2] && bends == [0.0; 2] {
                continue;
            }
            first += slopes[0] * slopes[0];
            last += slopes[1] * slopes[1];
            let given = scale.acceleration[axis] * reserve.share;
            fastest = fastest.max(slopes[0].abs().max(slopes[1].abs()) * scale.per_rate[axis]);
            hardest = hardest.max(bends[0].abs().max(bends[1].abs()) * scale.per_acceleration[axis]);
            let across = slopes.map(|slope| slope * per_u);
            self.add_strip(bends[0] - across[0], across[0], given);
            if bends == [0.0; 2] && slopes[0] == slopes[1] {
                continue;
            }
            self.add_strip(-across[1], bends[1] + across[1], given);
            self.at_end |= 1 << (self.count - 1);
            if let Some(round) = reserve.round {
                // What an axis is asked for lies below the lines that touch it at both ends: their meeting.
                let twist = round * length / 4.0;
                let across = (across[0] + across[1]) / 2.0 + 0.375 * (bends[0] - bends[1]);
                let (x_part, y_part) = (bends[0] / 2.0 - twist * slopes[0], bends[1] / 2.0 + twist * slopes[1]);
                self.add_strip(x_part - across, y_part + across, given);
            }
        }
        self.rates_allow = (reserve.rates * reserve.rates) / (fastest * fastest);
        self.axes_allow = (reserve.share / hardest).min(self.rates_allow);
        self.pace = f64::max(first, last);
    }

    /// `|x_part x + y_part y| ≤ given`.
    fn add_strip(&mut self, x_part: f64, y_part: f64, given: f64) {
        if let Some(strip) = self.strips.get_mut(self.count) {
            *strip = Strip::new(x_part, y_part, given);
            self.count += 1;
        }
    }

    /// The rest of a straight one.
    pub fn from(&self, start: f64) -> Cell {
        Cell { part: [start, self.part[1]], enters: f64::INFINITY, ..*self }
    }

    /// Its length, mm.
    pub fn length(&self) -> f64 {
        self.part[1] - self.part[0]
    }

    /// What may be driven in it.
    pub fn allowed(&self) -> f64 {
        self.rates_allow.min(self.feed_allows)
    }

    /// What may be driven at its very start.
    pub fn highest(&self) -> f64 {
        self.allowed().min(self.enters)
    }

    /// The acceleration along it, if it is straight.
    pub fn acceleration(&self) -> Option<f64> {
        self.straight
    }

    /// Gives it a new feed.
    pub fn set_feed(&mut self, allows: f64) {
        (self.feed_allows, self.top) = (allows, None);
    }

    /// Finds the highest speeds from which its end is reached with at most `end`; true if its own limits hold them, so
    /// that no higher end would raise them.
    pub fn settle(&mut self, end: f64) -> bool {
        let allowed = self.allowed();
        let found = self.peak_before(end.min(allowed));
        (self.peak, self.leads_to) = (found.x, found.y);
        if found.is_top {
            self.top = Some([found.x, found.y]);
        }
        self.most = self.peak.min(self.highest());
        found.is_top || self.peak >= self.highest()
    }

    fn peak_before(&self, end: f64) -> Peak {
        if let Some(acceleration) = self.straight {
            return Peak { x: end + 2.0 * acceleration * self.length(), y: end, is_top: false };
        }
        if let Some([x, y]) = self.top
            && y <= end
        {
            return Peak { x, y, is_top: true };
        }
        // What is allowed can be driven all along the cell, so it does not bound its very start; or it cannot.
        let allowed = self.allowed();
        let most = if allowed <= self.axes_allow { f64::MAX } else { allowed };
        let (mut highest, mut lowest) = (most, 0.0f64);
        let mut above = Strip { half: most, lean: 0.0 };
        for strip in &self.strips[..self.count] {
            let leaning = strip.lean * end;
            let at = strip.half - leaning;
            let is_lower = at < highest;
            highest = if is_lower { at } else { highest };
            above.half = if is_lower { strip.half } else { above.half };
            above.lean = if is_lower { strip.lean } else { above.lean };
            lowest = lowest.max(-strip.half - leaning);
        }
        match highest >= lowest {
            true if above.lean <= 0.0 => Peak { x: highest, y: end, is_top: false },
            true => self.top_below(end, most, above),
            false => self.top_of_reach(end, most),
        }
    }

    /// The highest point where no speed at the start leads to such an end: it is lowered to one that can be reached.
    #[inline(never)]
    fn top_of_reach(&self, end: f64, most: f64) -> Peak {
        let mut y = end;
        let (mut below, mut above) = self.bounds(y, most);
        for _ in 0..SEARCH_STEPS {
            if above.at(y) >= below.at(y) {
                break;
            }
            let met = (above.half - below.half) / (above.lean - below.lean);
            if met >= y {
                break;
            }
            y = met.max(0.0);
            (below, above) = self.bounds(y, most);
        }
        self.top_below(y, most, above)
    }

    /// The highest point at no more than a `y` that can be reached, where this line bounds it from above.
    #[inline(never)]
    fn top_below(&self, y: f64, most: f64, mut above: Strip) -> Peak {
        // Entering the next cell more slowly may let this one begin faster.
        if above.lean <= 0.0 || y <= 0.0 {
            return Peak { x: above.at(y).max(0.0), y, is_top: true };
        }
        let mut rising = self.above(0.0, most);
        if rising.lean >= 0.0 {
            return Peak { x: rising.at(0.0), y: 0.0, is_top: true };
        }
        for _ in 0..SEARCH_STEPS {
            let met = (above.half - rising.half) / (above.lean - rising.lean);
            let lowest = self.above(met, most);
            if lowest == above || lowest == rising {
                break;
            }
            if lowest.lean > 0.0 {
                above = lowest;
            } else {
                rising = lowest;
            }
        }
        let met = (above.half - rising.half) / (above.lean - rising.lean);
        Peak { x: above.at(met).max(0.0), y: met, is_top: true }
    }

    /// The line that bounds `x` from above at `y`, at `most` or less.
    #[inline]
    fn above(&self, y: f64, most: f64) -> Strip {
        let (mut highest, mut above) = (most, Strip { half: most, lean: 0.0 });
        for strip in &self.strips[..self.count] {
            let at = strip.at(y);
            let is_lower = at < highest;
            highest = if is_lower { at } else { highest };
            above.half = if is_lower { strip.half } else { above.half };
            above.lean = if is_lower { strip.lean } else { above.lean };
        }
        above
    }

    /// The lines that bound `x` from below and above at `y`, above at `most`.
    #[inline]
    fn bounds(&self, y: f64, mut most: f64) -> (Strip, Strip) {
        let (mut below, mut above) = (Strip::default(), Strip { half: most, lean: 0.0 });
        let mut least = 0.0;
        for strip in &self.strips[..self.count] {
            let leaning = strip.lean * y;
            if strip.half - leaning < most {
                most = strip.half - leaning;
                above = *strip;
            }
            if -strip.half - leaning > least {
                least = -strip.half - leaning;
                below = Strip { half: -strip.half, lean: strip.lean };
            }
        }
        (below, above)
    }

    /// The lowest and the highest squared speed at its end that the axes can come to from `x`; the lowest may be less
    /// than nothing.
    pub fn reach(&self, x: f64) -> [f64; 2] {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for strip in &self.strips[..self.count] {
            if strip.lean == 0.0 {
                continue;
            }
            let per_y = 1.0 / strip.lean;
            let (middle, apart) = (-x * per_y, strip.half * AT_THE_LIMIT * per_y.abs());
            low = low.max(middle - apart);
            high = high.min(middle + apart);
        }
        // Where rounding leaves nothing between them.
        if low > high { [(low + high) / 2.0; 2] } else { [low, high] }
    }

    /// The lowest squared speed at its end that the axes can come to from `x`, where they cannot stand in it.
    pub fn slowest_after(&self, x: f64) -> f64 {
        match self.straight {
            Some(acceleration) => x - 2.0 * acceleration * self.length(),
            None => self.reach(x)[0].max(0.0),
        }
    }

    /// The acceleration with which the axes come to stand in it from the squared speed `x` at its start, if they can.
    pub fn braking(&self, x: f64) -> Option<f64> {
        let mut hardest = self.straight.unwrap_or(f64::INFINITY);
        let double = 2.0 * self.length();
        for (index, strip) in self.strips[..self.count].iter().enumerate() {
            let (x_part, y_part) = (1.0 / strip.half, strip.lean / strip.half);
            if self.at_end >> index & 1 == 0 {
                // |slope u + bend x| ≤ 1 at the start, where the slope is y's part.
                let (slope, bend) = (y_part * double, x_part + y_part);
                hardest = hardest.min((1.0 + bend * x * slope.signum()) / slope.abs()).min(1.0 / slope.abs());
            } else {
                hardest = hardest.min(1.0 / (x_part * double).abs());
            }
        }
        let hardest = hardest.max(0.0);
        (hardest * double >= x).then_some(-hardest)
    }
}

impl Strip {
    /// `|x_part x + y_part y| ≤ given`.
    fn new(x_part: f64, y_part: f64, given: f64) -> Strip {
        if x_part == 0.0 && y_part == 0.0 {
            return Strip { half: f64::INFINITY, lean: 0.0 };
        }
        let x_part = if x_part.abs() > y_part.abs() * LEVEL { x_part } else { y_part.abs() * LEVEL };
        let per_x = 1.0 / x_part;
        Strip { half: given * per_x.abs(), lean: y_part * per_x }
    }

    /// The line's `x` at `y`.
    fn at(&self, y: f64) -> f64 {
        self.half - self.lean * y
    }
}
