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
}

impl Zones {
    /// Adds the zone of a piece beyond its end.
    fn add(&mut self, piece: &Piece, end: f64) {
        let end = end + piece.own * piece.window / 2.0 * WIDER + NOTHING;
        self.fastest.add(piece.own, end);
        self.push.add(piece.own_push, end);
    }

    pub(super) fn clear(&mut self) {
        self.fastest.0.clear();
        self.push.0.clear();
        self.place = 0.0;
    }
}

impl JerkHorizon {
    /// Adds a piece, restrained by what lies before it.
    pub(super) fn push_piece(&mut self, piece: Piece) {
        let end = self.zones.place + piece.length;
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
        self.zones.add(&piece, end);
    }

    /// Lowers the bounds of a piece to those of the zones of what lies behind it, `way` from the end of all that is
    /// known; where zones end on it, it is cut, and goes on before the part that is left at its place.
    fn restrain(&mut self, index: usize, way: f64) -> bool {
        let (fastest, until) = self.behind.fastest.at(way);
        let (push, push_until) = self.behind.push.at(way);
        let piece = &mut self.pieces[index];
        let mut reach = f64::INFINITY;
        if fastest < piece.fastest {
            reach = reach.min(until - way);
        }
        if push < piece.push {
            reach = reach.min(push_until - way);
        }
        if reach == f64::INFINITY {
            return false;
        }
        let free = piece.length - reach;
        let cut = free > piece.length * WORTH_A_CUT;
        let before = Piece { length: free, ends: false, stops: false, ..*piece };
        (piece.fastest, piece.push) = (fastest.min(piece.fastest), push.min(piece.push));
        if cut {
            (piece.from, piece.length) = (piece.from + free, reach);
            self.pieces.insert(index, before);
        }
        cut
    }

    /// True while more of what follows would let the next move be driven faster, or might; with nothing more to come,
    /// [`JerkHorizon::stop`] says so.
    pub fn wants_more(&mut self) -> bool {
        self.ready = self.ready || self.next_is_settled();
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
                let unsure = self.pieces.len().saturating_sub(self.settled);
                self.goal = (self.pieces.len() + unsure.max(BATCH)).min(MOST_PIECES);
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
        let Some(ends) = self.pieces.iter().take(self.settled).find(|piece| piece.ends) else { return false };
        let Some(last) = self.settled.checked_sub(1).and_then(|last| self.pieces.get(last)) else { return false };
        if last.stops {
            return true;
        }
        // What is planned in a piece depends on the speed with which the next may begin.
        let before = self.settled.checked_sub(2).and_then(|last| self.pieces.get(last));
        before.is_some_and(|before| before.clock - ends.clock >= ends.window * WIDER)
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
        let (mut final_behind, mut firm_behind) = (None, None);
        let floor =
            self.limits.axes[..self.limits.count].iter().map(|axis| self.floor(axis)).fold(f64::INFINITY, f64::min);
        // Whether more is to come, how far off and, at least, how long.
        let (mut open, mut way, mut behind) = (!self.closed, 0.0, 0.0);
        self.behind.clear();
        let mut index = self.pieces.len();
        while index > self.settled {
            index -= 1;
            let stops = self.pieces[index].stops;
            open &= !stops;
            if stops {
                self.behind.clear();
            }
            if index >= self.firm && self.restrain(index, way) {
                // The part before it is looked at next.
                index += 1;
            }
            let end = self.end_of(index);
            let piece = &mut self.pieces[index];
            let (allowed, window) = (piece.allowed(), piece.window * WIDER * WIDER);
            let gain = if open && behind < window {
                let push = piece.push.min(floor);
                least_gain(push, piece.window, way + piece.length) - least_gain(push, piece.window, way)
            } else {
                2.0 * piece.push * piece.length
            };
            piece.most = allowed.min(end + gain);
            if final_behind.is_none() && (piece.stops || (behind >= window && piece.most >= allowed)) {
                // Counted from the end, for pieces before it may still be cut.
                final_behind = Some(self.pieces.len() - index - 1);
            }
            if firm_behind.is_none() && (!open || behind >= window) {
                firm_behind = Some(self.pieces.len() - index - 1);
            }
            let piece = &self.pieces[index];
            way += piece.length;
            behind += piece.length / piece.fastest;
            self.behind.add(&self.pieces[index], way);
        }
        let seen = self.pieces.len();
        let final_from = if self.closed { seen } else { final_behind.map_or(self.settled, |behind| seen - behind) };
        self.firm = self.firm.max(firm_behind.map_or(0, |behind| seen - behind));
        self.time_from(self.settled, final_from);
        self.settled = final_from;
    }

    /// Gives pieces their clock.
    fn time_from(&mut self, from: usize, to: usize) {
        let mut clock = from.checked_sub(1).map_or(0.0, |before| self.pieces[before].clock);
        for piece in self.pieces.range_mut(from..to) {
            clock += piece.length / piece.fastest;
            piece.clock = clock;
            if piece.stops {
                // A plan that stands waits for its mean.
                clock += 2.0 * piece.window;
            }
        }
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
