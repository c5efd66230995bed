//! A cell: a stretch of way over which the bounds of speed and acceleration are looked at together.
//!
//! With `x = v²` and `u = dv/dt`, axis `i` accelerates by `q'ᵢ u + q''ᵢ x`, which its limit holds between `-aᵢ` and
//! `aᵢ`: a strip of the plane of `x` and `u`. Within a cell `u` is constant, so `x` grows by `2 u s`; the strips of the
//! cell's start and of its end make a convex figure round the origin. [`Cell::most_before`] is its highest `x` from
//! which the next cell can be entered as slowly as it asks, [`Cell::hardest`] its largest `u`. This is the
//! reachability analysis of Pham and Pham (TOPP-RA, IEEE T-RO 2018), one linear program of two variables a cell.

use base::AXES;

use crate::limits::Limits;
use crate::way::Way;

/// One strip: `-1 ≤ slope u + bend x ≤ 1`, divided by the slope, which is made positive.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
struct Strip {
    /// 1 / slope.
    half: f64,
    /// bend / slope.
    lean: f64,
}

/// Two strips, of the cell's start and of its end, for every axis.
const STRIPS: usize = 2 * AXES;
/// A strip as level as this bounds the speed and not its change: an axis that turns round gives next to nothing to it.
const LEVEL: f64 = 1e-7;
/// Steps after which the search for the highest speed is over; each one leaves a side of the figure behind.
const SEARCH_STEPS: usize = 2 * STRIPS;

/// A stretch of way. Speeds are squared, (mm/s)², and count along the way's own length.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Cell {
    /// The way that it is part of, by number.
    pub way: u64,
    /// Where it begins and ends on that way, mm.
    pub part: [f64; 2],
    /// What the axes' highest feeds allow.
    pub axes_allow: f64,
    /// What the commanded feed allows, overrides counted in.
    pub feed_allows: f64,
    /// The cell's own squared speed at its end for each one of the next cell's, where their ways count differently.
    pub gain: f64,
    /// The highest squared speed at its start from which everything behind it can be kept to.
    pub most: f64,
    /// The axes stand at its end.
    pub stops: bool,
    /// Where the move ends that it belongs to.
    pub ends: Ends,
    /// The moves whose feeds hold here: their numbers.
    pub moves: [u64; 2],
    /// The acceleration along it, mm/s², if it is straight.
    straight: Option<f64>,
    strips: [Strip; STRIPS],
    count: usize,
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
    /// The part of a way between two of its lengths.
    pub fn new(
        limits: &Limits,
        (number, way): (u64, &Way),
        part: [f64; 2],
        rate: fn(&crate::AxisLimits) -> f64,
    ) -> Cell {
        let mut cell = Cell {
            way: number,
            part,
            axes_allow: f64::INFINITY,
            feed_allows: f64::INFINITY,
            gain: 1.0,
            most: 0.0,
            stops: false,
            ends: Ends::Not,
            moves: [0; 2],
            straight: None,
            strips: [Strip::default(); STRIPS],
            count: 0,
        };
        match way {
            Way::Line { along, .. } => {
                let (mut speed, mut acceleration) = (f64::INFINITY, f64::INFINITY);
                for (limit, along) in limits.axes[..limits.count].iter().zip(along) {
                    let along = along.abs();
                    if along > 0.0 {
                        speed = speed.min(rate(limit) / along);
                        acceleration = acceleration.min(limit.acceleration / along);
                    }
                }
                cell.axes_allow = speed * speed;
                cell.straight = Some(acceleration);
            }
            _ => cell.take_strips(limits, way, rate),
        }
        cell
    }

    fn take_strips(&mut self, limits: &Limits, way: &Way, rate: fn(&crate::AxisLimits) -> f64) {
        let length = self.length();
        for s in self.part {
            let (slope, bend) = (way.slope(s), way.bend(s));
            // At the end of the cell `x` has grown by 2 u length.
            let grown = if s == self.part[1] { 2.0 * length } else { 0.0 };
            for axis in 0..limits.count {
                let (slope, bend, limit) = (slope[axis], bend[axis], &limits.axes[axis]);
                if slope == 0.0 && bend == 0.0 {
                    continue;
                }
                let fastest = rate(limit) / slope.abs();
                self.axes_allow = self.axes_allow.min(fastest * fastest);
                // Also where there is no acceleration along the way.
                self.axes_allow = self.axes_allow.min(limit.acceleration / bend.abs());
                let steep = slope + grown * bend;
                if steep.abs() > LEVEL && self.count < STRIPS {
                    let (half, lean) = (limit.acceleration / steep.abs(), bend / steep);
                    self.strips[self.count] = Strip { half, lean };
                    self.count += 1;
                }
            }
        }
    }

    /// Its length, mm.
    pub fn length(&self) -> f64 {
        self.part[1] - self.part[0]
    }

    /// What may be driven in it.
    pub fn allowed(&self) -> f64 {
        self.axes_allow.min(self.feed_allows)
    }

    /// The acceleration along it, if it is straight.
    pub fn straight(&self) -> Option<f64> {
        self.straight
    }

    /// The highest squared speed at its start from which its end is reached with at most `end`.
    pub fn most_before(&self, end: f64) -> f64 {
        let (allowed, length) = (self.allowed(), self.length());
        let end = end.min(allowed);
        if let Some(acceleration) = self.straight {
            return allowed.min(end + 2.0 * acceleration * length);
        }
        let mut x = allowed;
        for _ in 0..SEARCH_STEPS {
            let (above, below) = self.range(x, end, length);
            if above.at(x) >= below.at(x) {
                return x;
            }
            // Where the two lines meet; they leave each other behind as the speed falls.
            let met = (above.half - below.half) / (above.lean - below.lean);
            if met >= x {
                return x;
            }
            // Never below zero, where every strip holds; `max` also takes it where the lines are parallel.
            x = met.max(0.0);
        }
        x
    }

    /// The largest `u` at the squared speed `x` from which its end is reached with at most `end`; never one that an
    /// axis cannot give.
    pub fn hardest(&self, x: f64, end: f64) -> f64 {
        let (above, below) = self.range(x, end.min(self.allowed()), self.length());
        above.at(x).max(self.softest(x)).max(below.at(x))
    }

    /// The smallest `u` that the axes can give at the squared speed `x`.
    pub fn softest(&self, x: f64) -> f64 {
        if let Some(acceleration) = self.straight {
            return -acceleration;
        }
        let below = |strip: &Strip| -strip.half - strip.lean * x;
        self.strips[..self.count].iter().map(below).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The lines that bound `u` from above and below at `x`.
    fn range(&self, x: f64, end: f64, length: f64) -> (Strip, Strip) {
        let per_u = 1.0 / (2.0 * length);
        let mut above = Strip { half: end * per_u, lean: per_u };
        let mut below = Strip { half: 0.0, lean: per_u };
        let (mut highest, mut lowest) = (above.at(x), below.at(x));
        for strip in &self.strips[..self.count] {
            let leaning = strip.lean * x;
            if strip.half - leaning < highest {
                highest = strip.half - leaning;
                above = *strip;
            }
            if -strip.half - leaning > lowest {
                lowest = -strip.half - leaning;
                below = Strip { half: -strip.half, lean: strip.lean };
            }
        }
        (above, below)
    }
}

impl Strip {
    /// The line's `u` at `x`.
    fn at(&self, x: f64) -> f64 {
        self.half - self.lean * x
    }
}
