//! The plan within a piece: legs of constant acceleration, as if it could change at once.

use super::Piece;
use crate::horizon::Leg;

/// The part of a squared speed that rounding may leave.
const ROUNDING: f64 = 1e-12;

/// Legs of constant acceleration in one piece.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Legs {
    pub legs: [Leg; 3],
    pub count: usize,
    /// The speed behind them, and whether they lead to the end of the piece.
    pub speed: f64,
    pub reaches: bool,
}

impl Legs {
    pub fn get(&self, leg: usize) -> Option<&Leg> {
        self.legs[..self.count].get(leg)
    }

    fn push(&mut self, leg: Leg) {
        if leg.seconds > 0.0 && self.count < self.legs.len() {
            self.legs[self.count] = leg;
            self.count += 1;
        }
    }
}

/// The plan: where it is, and how it goes on in its piece.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Plan {
    /// Its piece, counted from the first one.
    pub index: usize,
    /// Where it is on that piece's way, and its speed.
    pub s: f64,
    pub speed: f64,
    /// What is planned for the rest of the piece.
    pub legs: Legs,
    pub leg: usize,
    pub spent: f64,
    /// It stands at the end of its run.
    pub ended: bool,
}

/// The legs from a place and speed to the end of a piece, there at no more than a squared speed.
pub fn speed_up(piece: &Piece, s: f64, speed: f64, end: f64) -> Legs {
    let (x, length, push, allowed) = (speed * speed, (piece.end() - s).max(0.0), piece.push, piece.allowed());
    let double = 2.0 * push;
    let end = end.min(allowed).min(x + double * length);
    // A root of what rounding leaves would be no small speed.
    let least = x - double * length;
    let end = if least - end > x * ROUNDING { least } else { end };
    // Too fast, it brakes to what is allowed; to more than that at the end, if there is no room.
    let level =
        if x > allowed { allowed.max(end) } else { allowed.min((x + end) / 2.0 + push * length).max(x).max(end) };
    let [top, last] = [level, end].map(f64::sqrt);
    let (first_way, last_way) = ((level - x).abs() / double, (level - end) / double);
    let cruise = length - first_way - last_way;
    let mut legs = Legs { speed: last, reaches: true, ..Legs::default() };
    let acceleration = if x > level { -push } else { push };
    legs.push(Leg { s, speed, acceleration, seconds: (top - speed).abs() / push, ..Leg::default() });
    if cruise > 0.0 {
        if top <= 0.0 {
            // It stands.
            return Legs { speed: 0.0, reaches: false, ..legs };
        }
        legs.push(Leg { s: s + first_way, speed: top, seconds: cruise / top, ..Leg::default() });
    }
    let seconds = (top - last) / push;
    legs.push(Leg { s: piece.end() - last_way, speed: top, acceleration: -push, seconds, ..Leg::default() });
    legs
}

/// The leg in which the plan comes to stand, or to the end of the piece.
pub fn slow_down(piece: &Piece, s: f64, speed: f64) -> Legs {
    let left = speed * speed - 2.0 * piece.push * (piece.end() - s).max(0.0);
    let reached = if left > speed * speed * ROUNDING { left.sqrt() } else { 0.0 };
    let seconds = ((speed - reached) / piece.push).max(0.0);
    let mut legs = Legs { speed: reached, reaches: reached > 0.0, ..Legs::default() };
    legs.push(Leg { s, speed, acceleration: -piece.push, seconds, ..Leg::default() });
    legs
}
