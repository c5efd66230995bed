//! The bounds of every piece, zones counted in, and backwards over them: the highest speed from which the rest can be
//! kept to.
//!
//! A zone never reaches farther back than what can be driven in one window at the speeds allowed there, for the mean
//! looks no farther. So bounds are final as soon as the way behind them takes a window. Of those that are not it is known
//! how low they can become: what is yet to come reaches a place `d` before its beginning only if it allows `c ≥ 2 d / T`,
//! and then it also allows an acceleration of `2 c / T`, or of a floor (`bounds.rs`). The plan is made for the least, and
//! for rest where nothing more is known; so whatever comes, it can be kept to. Speeds are final as in
//! [`Horizon`](crate::Horizon): from a piece on whose own bounds hold them.

use std::collections::VecDeque;

use super::bounds::PUSH;
use super::{JerkHorizon, MOST_PIECES, Piece};
use crate::limits::AxisLimits;

/// Pieces that are looked at together at least.
const BATCH: usize = 64;
/// The most cuts of one piece by the ends of zones.
const MOST_CUTS: usize = 4;
/// What rounding may leave of a zone, mm.
const NOTHING: f64 = 1e-9;
/// By how much zones are wider than they must be, for rounding.
const WIDER: f64 = 1.0 + 1e-6;
/// The part of the acceleration that is left where a rounded way is steeper than those that it joins.
const STEEPER: f64 = 0.8;
/// A piece is cut by a zone that leaves at least this part of it free.
const WORTH_A_CUT: f64 = 0.2;

/// The least value of zones that overlap: those that matter, lower ones ending before higher ones.
#[derive(Clone, Debug, Default)]
struct Least(VecDeque<(f64, f64)>);

impl Least {
    fn add(&mut self, value: f64, end: f64) {
        let zones = &mut self.0;
        let behind = zones.iter().rev().take_while(|zone| zone.1 > end).count();
        let mut at = zones.len() - behind;
        if zones.get(at).is_some_and(|lower| lower.0 <= value) {
            return;
        }
        // What is neither lower nor ends later does not matter.
        while at > 0 && zones[at - 1].0 >= value {
            at -= 1;
            zones.remove(at);
        }
        zones.insert(at, (value, end));
    }

    /// The least value at a place, and up to where it holds.
    fn at(&mut self, place: f64) -> (f64, f64) {
        while let Some(&(value, end)) = self.0.front() {
            if end > place + NOTHING {
                return (value, end);
            }
            self.0.pop_front();
        }
        (f64::INFINITY, f64::INFINITY)
    }
}

/// The zones of what has been added, as far as they reach beyond it.
#[derive(Clone, Debug, Default)]
pub(super) struct Zones {
    fastest: Least,
    push: Least,
    /// Where on the run the next piece begins, mm.
    place: f64,
    /// The highest bounds on the run.
    highest: (f64, f64),
}

impl Zones {
    pub(super) fn clear(&mut self) {
        self.fastest.0.clear();
        self.push.0.clear();
        (self.place, self.highest) = (0.0, (0.0, 0.0));
    }
}

impl JerkHorizon {
    /// Adds a piece: what lies before it restrains it, and it what lies before.
    pub(super) fn push_piece(&mut self, piece: Piece) {
        let reach = piece.fastest * piece.window / 2.0 * WIDER + NOTHING;
        let (first, end) = (self.pieces.len(), self.zones.place + piece.length);
        let mut rest = piece;
        for cuts in 0..=MOST_CUTS {
            let place = end - rest.length;
            let (fastest, until) = self.zones.fastest.at(place);
            let (push, push_until) = self.zones.push.at(place);
            let mut cut = f64::INFINITY;
            if fastest < piece.fastest {
                cut = cut.min(until - place);
            }
            if push < piece.push {
                cut = cut.min(push_until - place);
            }
            let mut part = Piece { fastest: fastest.min(piece.fastest), push: push.min(piece.push), ..rest };
            if cuts == MOST_CUTS || cut >= rest.length * (1.0 - WORTH_A_CUT) {
                self.pieces.push_back(part);
                break;
            }
            part.length = cut;
            self.pieces.push_back(part);
            (rest.from, rest.length) = (rest.from + cut, rest.length - cut);
        }
        self.zones.place = end;
        self.zones.fastest.add(piece.fastest, end + reach);
        self.zones.push.add(piece.push, end + reach);
        self.restrain(first, &piece, reach);
        let highest = &mut self.zones.highest;
        *highest = (highest.0.max(piece.fastest), highest.1.max(piece.push));
    }

    /// Lowers the bounds of what lies before a piece to its own.
    fn restrain(&mut self, first: usize, piece: &Piece, reach: f64) {
        if piece.fastest >= self.zones.highest.0 && piece.push >= self.zones.highest.1 {
            return;
        }
        let (mut way, mut seconds) = (0.0, 0.0);
        let mut index = first;
        while index > self.settled && way < reach && seconds < piece.window * WIDER {
            index -= 1;
            let other = &mut self.pieces[index];
            if other.stops {
                break;
            }
            let length = other.length;
            if other.fastest > piece.fastest || other.push > piece.push {
                let (fastest, push) = (other.fastest.min(piece.fastest), other.push.min(piece.push));
                let free = length - (reach - way);
                if free > length * WORTH_A_CUT {
                    let back = Piece { from: other.from + free, length: length - free, fastest, push, ..*other };
                    (other.length, other.ends) = (free, false);
                    self.pieces.insert(index + 1, back);
                    return;
                }
                (other.fastest, other.push) = (fastest, push);
            }
            way += length;
            seconds += length / other.fastest;
        }
    }

    /// True while more of what follows would let the next move be driven faster, or might; with nothing more to come,
    /// [`JerkHorizon::stop`] says so.
    pub fn wants_more(&mut self) -> bool {
        if self.ready {
            return false;
        }
        let seen = self.pieces.len();
        if !self.closed && seen < MOST_PIECES {
            if seen < self.goal || seen == 0 {
                return true;
            }
            self.settle();
            if !self.next_is_settled() {
                self.goal = (seen + (seen - self.settled).max(BATCH)).min(MOST_PIECES);
                return true;
            }
        } else {
            if !self.closed {
                // Nothing is known of what follows, so that the axes stand before it.
                self.end_run();
            }
            self.settle();
        }
        self.ready = true;
        false
    }

    /// True if the next move can be driven as fast as if all the rest were known: the plan is a window ahead.
    fn next_is_settled(&self) -> bool {
        let mut beyond: Option<f64> = None;
        for piece in self.pieces.iter().take(self.settled.saturating_sub(1)) {
            if let Some(seconds) = &mut beyond {
                *seconds += piece.length / piece.fastest;
            } else if piece.ends {
                beyond = Some(0.0);
            }
            if beyond.is_some_and(|seconds| piece.stops || seconds >= piece.window * WIDER) {
                return true;
            }
        }
        let last = self.settled.checked_sub(1).and_then(|last| self.pieces.get(last));
        last.is_some_and(|last| last.stops && (beyond.is_some() || last.ends))
    }

    /// The highest squared speed of the plan at the end of a piece.
    pub(super) fn end_of(&self, index: usize) -> f64 {
        match (self.pieces.get(index), self.pieces.get(index + 1)) {
            (Some(piece), Some(next)) if !piece.stops => next.most,
            _ => 0.0,
        }
    }

    /// Gives every piece that is not final yet its highest speed, and finds which of them are final.
    pub(super) fn settle(&mut self) {
        let seen = self.pieces.len();
        let mut final_from = if self.closed { seen } else { self.settled };
        let floor =
            self.limits.axes[..self.limits.count].iter().map(|axis| self.floor(axis)).fold(f64::INFINITY, f64::min);
        // Whether more is to come, how far off and, at least, how long.
        let (mut open, mut way, mut behind) = (!self.closed, 0.0, 0.0);
        for index in (self.settled..seen).rev() {
            let end = self.end_of(index);
            let piece = &mut self.pieces[index];
            open &= !piece.stops;
            let (allowed, window) = (piece.allowed(), piece.window * WIDER * WIDER);
            let gain = if open && behind < window {
                let push = piece.push.min(floor);
                least_gain(push, piece.window, way + piece.length) - least_gain(push, piece.window, way)
            } else {
                2.0 * piece.push * piece.length
            };
            piece.most = allowed.min(end + gain);
            if final_from <= index && (piece.stops || (behind >= window && piece.most >= allowed)) {
                final_from = index + 1;
            }
            way += piece.length;
            behind += piece.length / piece.fastest;
        }
        self.settled = final_from.max(self.settled);
    }

    /// What no piece allows less of along the way, unless it says so by its speed.
    pub(super) fn floor(&self, axis: &AxisLimits) -> f64 {
        STEEPER * PUSH * axis.acceleration.min(axis.jerk * self.window / 2.0)
    }
}

/// The squared speed from which the plan comes to rest in a distance, whatever is yet to come: its acceleration is
/// `4 d / T²` at a distance of `d`, but no more than `push`.
fn least_gain(push: f64, window: f64, way: f64) -> f64 {
    let each = 4.0 / (window * window);
    let near = way.min(push / each);
    each * near * near + 2.0 * push * (way - near)
}

impl Piece {
    /// The squared speed that may be planned in it.
    pub(super) fn allowed(&self) -> f64 {
        let speed = self.fastest.min(self.feed);
        speed * speed
    }

    /// Where it ends on its way.
    pub(super) fn end(&self) -> f64 {
        self.from + self.length
    }
}
