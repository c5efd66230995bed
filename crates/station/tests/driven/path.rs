//! How far setpoints are from the programmed path: from the moves told just before and just behind them.

use std::collections::VecDeque;

use base::Point;
use machine::EventKind;
use motion::{Limits, Way};

/// What is rounding, mm.
const ROUNDING_MM: f64 = 1e-8;
/// Places of an arc or helix that are looked at, and steps in which the nearest one is narrowed down.
const PLACES: usize = 200;
const STEPS: usize = 60;

/// A move.
#[derive(Clone, Copy, Debug)]
enum Track {
    /// Along a way.
    Way(Way),
    /// Every axis by itself.
    Box(Point, Point),
}

/// Moves, and setpoints that wait for the move behind theirs to be told.
pub struct Paths {
    limits: Limits,
    /// The move told last but one, and the last one.
    told: VecDeque<Track>,
    /// Setpoints seen since a move was told, and those seen since the one before.
    waiting: [Vec<Point>; 2],
    worst: (f64, Point),
}

impl Paths {
    pub fn new(limits: &Limits) -> Paths {
        let worst = (0.0, Point::default());
        Paths { limits: *limits, told: VecDeque::new(), waiting: [Vec::new(), Vec::new()], worst }
    }

    /// A move has been told, which is when it is over; false if it is none.
    pub fn moved(&mut self, event: &EventKind) -> bool {
        let count = self.limits.count;
        let track = match event {
            EventKind::Rapid { from, to, .. } if self.limits.straight_rapid => Track::Way(Way::line(from, to, count)),
            EventKind::Rapid { from, to, .. } => Track::Box(*from, *to),
            EventKind::Feed { from, to, .. } => Track::Way(Way::line(from, to, count)),
            EventKind::Arc { arc, .. } => Track::Way(Way::arc(arc)),
            _ => return false,
        };
        self.told.push_back(track);
        let ready = std::mem::take(&mut self.waiting[0]);
        // Those before lie on the move before this one, on this, or between them.
        self.check(&ready);
        self.waiting.swap(0, 1);
        while self.told.len() > 3 {
            self.told.pop_front();
        }
        true
    }

    /// The axes are here.
    pub fn at(&mut self, position: &Point) {
        self.waiting[1].push(*position);
    }

    /// The axes have been elsewhere: what waits for a move is not looked at, as that may be the one given up.
    pub fn leave(&mut self) {
        self.waiting.iter_mut().for_each(Vec::clear);
        self.told.clear();
    }

    /// All moves have been told.
    pub fn end(&mut self) {
        let ready = std::mem::take(&mut self.waiting[0]);
        self.check(&ready);
    }

    fn check(&mut self, places: &[Point]) {
        let tolerance = self.limits.corner_tolerance + ROUNDING_MM;
        for place in places {
            let off = |track: &Track| match track {
                Track::Way(way) => distance(way, place, tolerance),
                Track::Box(from, to) => outside(from, to, place),
            };
            let off = self.told.iter().rev().map(off).fold(f64::INFINITY, f64::min) / tolerance;
            if off > self.worst.0 && off.is_finite() {
                self.worst = (off, *place);
            }
        }
    }

    pub fn worst(&self) -> (f64, Point) {
        self.worst
    }

    /// The part by which the direction of the shortest move at hand is not exact.
    pub fn noise(&self) -> f64 {
        let length = |track: &Track| if let Track::Way(way) = track { way.length() } else { 1.0 };
        1e-12 / self.told.iter().map(length).fold(1.0, f64::min)
    }
}

fn outside(from: &Point, to: &Point, place: &Point) -> f64 {
    let axes = from.iter().zip(to).zip(place);
    axes.map(|((from, to), at)| (at - from.max(*to)).max(from.min(*to) - at)).fold(0.0, f64::max)
}

fn distance(way: &Way, place: &Point, enough: f64) -> f64 {
    let apart =
        |s: f64| way.at(s).iter().zip(place).map(|(one, other)| (one - other) * (one - other)).sum::<f64>().sqrt();
    let length = way.length();
    if let Way::Line { from, along, .. } = way {
        let s: f64 = place.iter().zip(from).zip(along).map(|((at, from), along)| (at - from) * along).sum();
        return apart(s.clamp(0.0, length));
    }
    let at = |step: usize| length * step as f64 / PLACES as f64;
    // A full circle begins where it ends: both halves of a way are searched.
    let halves = [0..=PLACES / 2, PLACES / 2..=PLACES];
    let off = halves.map(|steps| {
        let nearest = steps.min_by(|one, other| apart(at(*one)).total_cmp(&apart(at(*other)))).unwrap_or(0);
        narrowed(apart, [at(nearest.saturating_sub(1)), at((nearest + 1).min(PLACES))], enough)
    });
    off[0].min(off[1])
}

/// The least of what falls and then rises between two places; it is not asked for more exactly than `enough` wants.
fn narrowed(apart: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2], enough: f64) -> f64 {
    for _ in 0..STEPS {
        let third = (high - low) / 3.0;
        if apart(low + third) < apart(high - third) {
            high -= third
        } else {
            low += third
        }
        if apart(low) <= enough * 0.5 {
            break;
        }
    }
    apart(low).min(apart((low + high) / 2.0))
}
