//! From which move on the directions of a contour lie within half a turn.
//!
//! As long as the directions of neighbouring elements, from one to another, lie within half a turn, the centre beside the
//! one is nowhere nearer to the other than the radius, and nothing need be compared. (Take the element among them that
//! points farthest right: all elements before it lie right of its line, all centres behind it left of its centre's line;
//! and of the one that points farthest left the other way round.)

use path::Part;
use path::plane::{Vector, least, less, most};

use crate::way::{Turns, Way};

/// Half a turn in the measure of [`direction`], and a bit for rounding.
const HALF_TURN: f64 = 2.0 + 1e-9;
/// A turn back by less than this beside half a turn can go either way round.
const EITHER_WAY: f64 = 2.0 - 1e-6;

/// The latest moves' directions, in a ring by the moves' numbers, as many as a power of two.
#[derive(Default)]
pub(super) struct Chain {
    /// The directions in each move, lowest and highest; in those that are summed up, from each to the last such one.
    angles: Vec<[f64; 2]>,
    /// From here on all directions lie within half a turn; before `summed` they are summed up, behind it they lie between
    /// these.
    begin: u64,
    summed: u64,
    reach: [f64; 2],
    /// The direction in which the last move ends: turns counted, and not.
    last: Option<[f64; 2]>,
}

impl Chain {
    /// With room for so many moves, a power of two.
    pub fn of(room: usize) -> Chain {
        Chain { angles: vec![NO_REACH; room], begin: 0, summed: 0, reach: NO_REACH, last: None }
    }

    /// The first move of it.
    pub fn begin(&self) -> u64 {
        self.begin
    }

    /// Follows the directions: from which move on they lie within half a turn.
    #[inline]
    pub fn follow(&mut self, number: u64, way: &Way, turns: &Turns) {
        let (track, turn) = match way.part {
            Some(Part::Along) if way.beside => (&way.element, &turns[1]),
            Some(Part::Round) => (&way.centre, &turns[0]),
            _ => return self.break_off(number + 1),
        };
        let (begins, ends, sweep) = if track.is_arc {
            let [begins, ends] = track.curve(turn).directions().map(direction);
            (begins, ends, turn.sweep)
        } else {
            let begins = direction(less(track.ends[1], track.ends[0]));
            (begins, begins, 0.0)
        };
        if !begins.is_finite() || !ends.is_finite() {
            return self.break_off(number + 1);
        }
        let turn = self.last.map_or(0.0, |[_, last]| shortest(begins - last));
        let first = self.last.map_or(0.0, |[angle, _]| angle) + turn;
        let mut swept = ends - begins;
        if sweep != 0.0 {
            let quarters = sweep / std::f64::consts::FRAC_PI_2;
            swept += 4.0 * ((quarters - swept) / 4.0).round();
        }
        let own = [least(first, first + swept), most(first, first + swept)];
        if self.last.is_none() || turn.abs() > EITHER_WAY {
            self.break_off(number);
        }
        self.last = Some([first + swept, ends]);
        self.shorten(number, own);
    }

    /// Takes the directions of a move and leaves out of the chain what they do not lie within half a turn of.
    fn shorten(&mut self, number: u64, own: [f64; 2]) {
        let mask = self.angles.len() as u64 - 1;
        let index = |number: u64| (number & mask) as usize;
        let mut chain = self.begin.max(number.saturating_sub(mask));
        self.angles[index(number)] = own;
        let mut reach = wider(self.reach, own);
        let fits = |all: [f64; 2]| all[1] - all[0] <= HALF_TURN;
        while chain < number {
            if chain < self.summed {
                if fits(wider(self.angles[index(chain)], reach)) {
                    break;
                }
                chain += 1;
            } else if fits(reach) {
                break;
            } else {
                // Each move is summed up once.
                let mut all = NO_REACH;
                for earlier in (chain..=number).rev() {
                    let angle = &mut self.angles[index(earlier)];
                    all = wider(all, *angle);
                    *angle = all;
                }
                self.summed = number + 1;
                reach = NO_REACH;
            }
        }
        self.begin = chain;
        self.reach = reach;
    }

    /// Begins anew with this move.
    pub fn break_off(&mut self, from: u64) {
        self.begin = from;
        self.summed = from;
        self.reach = NO_REACH;
        self.last = None;
    }
}

const NO_REACH: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

fn wider(one: [f64; 2], other: [f64; 2]) -> [f64; 2] {
    [least(one[0], other[0]), most(one[1], other[1])]
}

/// A direction as a number from 0 to 4 that grows with its angle; opposite ones differ by 2.
fn direction(way: Vector) -> f64 {
    let part = way[0] / (way[0].abs() + way[1].abs());
    if way[1] >= 0.0 { 1.0 - part } else { 3.0 + part }
}

/// The shorter way round.
fn shortest(turn: f64) -> f64 {
    if turn > 2.0 {
        turn - 4.0
    } else if turn < -2.0 {
        turn + 4.0
    } else {
        turn
    }
}
