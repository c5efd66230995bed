//! How far the driven path is from the ordered one, and that distance drawn larger.
//!
//! Every driven place has its foot: the nearest place of the way that was ordered, not before the last one. Drawn larger,
//! the place is so many times as far from its foot. Inside a corner the foot jumps from one way to the next, and what is
//! drawn beside the one way would run past what is drawn beside the other: both end where they cross.

use std::collections::VecDeque;

use crate::arc::Curve;
use crate::piece::{Piece, distance};

/// At most so many places, and so many ways, are looked at together where the axes never come to stand.
const MOST_PLACES: usize = 16_384;
const MOST_WAYS: usize = 4_096;

/// The axes are at most so many ways behind what was ordered.
const MOST_BEHIND: usize = 64;

/// Of two ways that are as near, the next one is meant: what a mm further on counts as distance.
const FURTHER_ON: f64 = 1e-3;

/// Beside so many places at most before and behind a corner is it looked for where they cross.
const MOST_CROSSING: usize = 512;

/// A foot has jumped if it went so many times as far as the axes, and so far at least, mm.
const JUMP: [f64; 2] = [3.0, 1e-6];

/// A deviation below this, in mm, is none: it comes of chords.
const NOTHING: f64 = 5e-7;

/// Between places that are so far off at least, mm, a farther one is looked for, by halving at most so often, until none
/// can be so many times as far.
const OFF: f64 = 1e-5;
const MOST_HALVED: u32 = 12;
const NO_FARTHER: f64 = 1.0005;

/// The largest deviation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Farthest {
    /// mm.
    pub by: f64,
    /// Where the axes were.
    pub at: [f64; 3],
}

/// A way that was ordered.
#[derive(Clone, Copy, Debug)]
struct Way {
    piece: Piece,
    curve: Option<Curve>,
    /// Where it begins on all that was ordered, and how long it is, mm.
    begins: f64,
    length: f64,
}

impl Way {
    /// The part of the way nearest to a point; of a way of several turns the one near another part.
    fn nearest(&self, point: [f64; 3], near: f64) -> f64 {
        if let Some(curve) = &self.curve {
            return curve.nearest(point, near);
        }
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        let (along, to) = (minus(self.piece.to, self.piece.from), minus(point, self.piece.from));
        (dot(along, to) / dot(along, along)).clamp(0.0, 1.0)
    }

    fn at(&self, part: f64) -> [f64; 3] {
        let Piece { from, to, .. } = self.piece;
        self.curve.map_or_else(
            || std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * part),
            |curve| curve.at(part),
        )
    }
}

/// A place that was driven to.
#[derive(Clone, Copy, Debug)]
struct Place {
    at: [f64; 3],
    /// Its foot on all that was ordered, mm, and where that is.
    foot: f64,
    foot_at: [f64; 3],
    off: f64,
}

/// The driven path beside the ordered one.
#[derive(Clone, Debug)]
pub(crate) struct Deviation {
    /// How many times it is drawn.
    pub times: f64,
    pub farthest: Option<Farthest>,
    ways: VecDeque<Way>,
    /// The way of the last foot.
    on: usize,
    places: Vec<Place>,
}

impl Deviation {
    /// Nothing is ordered yet.
    pub fn new(times: f64) -> Deviation {
        Deviation { times, farthest: None, ways: VecDeque::new(), on: 0, places: Vec::new() }
    }

    /// A way that is to be driven behind the others.
    pub fn order(&mut self, piece: &Piece) {
        let begins = self.ways.back().map_or(0.0, |way| way.begins + way.length);
        let length = piece.length_mm();
        if length > 0.0 {
            self.ways.push_back(Way { piece: *piece, curve: piece.curve(), begins, length });
        }
    }

    /// The axes drive through these places; `line` is given what is to be drawn.
    pub fn drive(&mut self, points: &[[f64; 3]], mut line: impl FnMut([f64; 3], [f64; 3])) {
        if self.ways.is_empty() {
            return points.windows(2).for_each(|pair| line(pair[0], pair[1]));
        }
        for point in points {
            if self.places.last().is_some_and(|last| last.at == *point) {
                continue;
            }
            self.drive_to(*point, MOST_HALVED);
        }
        let stands_on_it = self.places.last().is_some_and(|last| last.off < NOTHING);
        if stands_on_it || self.places.len() > MOST_PLACES || self.ways.len() > MOST_WAYS {
            self.draw(&mut line);
        }
    }

    /// The axes drive straight to a place. Where the foot goes over to another way, the farthest place may lie between:
    /// nothing there is farther off than the mean of both ends and the way between them allow.
    fn drive_to(&mut self, point: [f64; 3], halved: u32) {
        let (on, last) = (self.on, self.places.last().copied());
        let place = self.place(point);
        let known = self.farthest.map_or(NOTHING, |farthest| farthest.by);
        if let Some(last) = last.filter(|last| self.on != on && last.off.min(place.off) > OFF) {
            let most = (last.off + place.off + distance(last.at, point)) / 2.0;
            if halved > 0 && most > known * NO_FARTHER {
                self.on = on;
                self.drive_to(std::array::from_fn(|axis| (last.at[axis] + point[axis]) / 2.0), halved - 1);
                return self.drive_to(point, halved - 1);
            }
        }
        if place.off > known {
            self.farthest = Some(Farthest { by: place.off, at: point });
        }
        self.places.push(place);
    }

    /// The axes leave what was ordered.
    pub fn leave(&mut self, mut line: impl FnMut([f64; 3], [f64; 3])) {
        self.draw(&mut line);
        self.ways.clear();
        self.places.clear();
        self.on = 0;
    }

    /// A place with its foot.
    fn place(&mut self, at: [f64; 3]) -> Place {
        let last = self.places.last().map_or(0.0, |place| place.foot);
        let mut best: Option<(f64, usize, Place)> = None;
        for (index, way) in self.ways.iter().enumerate().skip(self.on).take(MOST_BEHIND) {
            let least = ((last - way.begins) / way.length).clamp(0.0, 1.0);
            let part = way.nearest(at, least).max(least);
            let (foot, foot_at) = (way.begins + part * way.length, way.at(part));
            let off = distance(foot_at, at);
            let cost = off + FURTHER_ON * (foot - last).min(off);
            if best.is_none_or(|(lowest, ..)| cost < lowest) {
                best = Some((cost, index, Place { at, foot, foot_at, off }));
            }
        }
        let Some((_, index, place)) = best else { return Place { at, foot: last, foot_at: at, off: 0.0 } };
        self.on = index;
        place
    }

    /// Draws the places and forgets all but the last, and the ways behind it.
    fn draw(&mut self, line: &mut impl FnMut([f64; 3], [f64; 3])) {
        let drawn: Vec<[f64; 3]> = self.places.iter().map(|place| self.enlarged(place)).collect();
        // Between two jumps of the foot lies what is drawn beside one way, or several that go over into each other.
        let jumps = |pair: &[Place]| {
            let jump = distance(pair[0].foot_at, pair[1].foot_at);
            self.times > 1.0 && jump > (JUMP[0] * distance(pair[0].at, pair[1].at)).max(JUMP[1])
        };
        let mut parts: Vec<Vec<[f64; 3]>> = vec![drawn.first().copied().into_iter().collect()];
        for (pair, at) in self.places.windows(2).zip(drawn.iter().skip(1)) {
            if jumps(pair) {
                parts.push(Vec::new());
            }
            parts.last_mut().into_iter().for_each(|part| part.push(*at));
        }
        for next in 1..parts.len() {
            let (before, behind) = parts.split_at_mut(next);
            if let (Some(before), Some(behind)) = (before.last_mut(), behind.first_mut()) {
                end_at_crossing(before, behind);
            }
        }
        let mut before: Option<[f64; 3]> = None;
        for at in parts.into_iter().flatten() {
            if let Some(before) = before.filter(|before| *before != at) {
                line(before, at);
            }
            before = Some(at);
        }
        let last = self.places.len().saturating_sub(1);
        self.places.drain(..last);
        self.ways.drain(..self.on.min(self.ways.len()));
        self.on = 0;
    }

    fn enlarged(&self, place: &Place) -> [f64; 3] {
        let Place { at, foot_at, .. } = place;
        if self.times == 1.0 {
            return *at;
        }
        std::array::from_fn(|axis| foot_at[axis] + (at[axis] - foot_at[axis]) * self.times)
    }
}

/// Ends one line, and begins the next, where they cross; they stay as they are if they do not.
fn end_at_crossing(before: &mut Vec<[f64; 3]>, behind: &mut Vec<[f64; 3]>) {
    let first = before.len().saturating_sub(MOST_CROSSING);
    for start in (first..before.len().saturating_sub(1)).rev() {
        for end in 0..behind.len().min(MOST_CROSSING).saturating_sub(1) {
            if let Some(crossing) = crossing([before[start], before[start + 1]], [behind[end], behind[end + 1]]) {
                before.truncate(start + 1);
                before.push(crossing);
                behind.drain(..=end);
                return;
            }
        }
    }
}

/// Where two pieces of line cross, in the plane of two axes in which they cross most squarely.
fn crossing(one: [[f64; 3]; 2], other: [[f64; 3]; 2]) -> Option<[f64; 3]> {
    let minus = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|axis| a[axis] - b[axis]) };
    let (along, across, apart) = (minus(one[1], one[0]), minus(other[1], other[0]), minus(other[0], one[0]));
    let squarely = |[u, v]: [usize; 2]| along[u] * across[v] - along[v] * across[u];
    let planes = [[0, 1], [1, 2], [2, 0]];
    let plane = planes.into_iter().max_by(|a, b| squarely(*a).abs().total_cmp(&squarely(*b).abs()))?;
    let ([u, v], area) = (plane, squarely(plane));
    let part = (apart[u] * across[v] - apart[v] * across[u]) / area;
    let other_part = (apart[u] * along[v] - apart[v] * along[u]) / area;
    let within = (0.0..=1.0).contains(&part) && (0.0..=1.0).contains(&other_part);
    within.then(|| std::array::from_fn(|axis| one[0][axis] + along[axis] * part))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stroke::{Arc, Kind, Plane};

    fn way(from: [f64; 3], to: [f64; 3], arc: Option<Arc>) -> Piece {
        Piece { kind: Kind::Feed, from, to, arc, feed: 0.0 }
    }

    fn drawn(deviation: &mut Deviation, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut drawn = Vec::new();
        deviation.drive(points, |_, to| drawn.push(to));
        deviation.leave(|_, to| drawn.push(to));
        drawn
    }

    #[test]
    fn a_smaller_circle_is_drawn_smaller_still() {
        let mut deviation = Deviation::new(10.0);
        let arc = Arc { plane: Plane::Xy, center: [0.0; 2], sweep_deg: 360.0 };
        deviation.order(&way([20.0, 0.0, 0.0], [20.0, 0.0, 0.0], Some(arc)));
        let at = |degrees: u32| {
            let (sin, cos) = libm::sincos(f64::from(degrees).to_radians());
            [19.9 * cos, 19.9 * sin, 0.0]
        };
        let points: Vec<_> = (0..=720).map(|half| at(half).map(|part| part)).take(361).collect();
        for [x, y, _] in drawn(&mut deviation, &points) {
            assert!((libm::hypot(x, y) - 19.0).abs() < 2e-3, "{x} {y}");
        }
        let farthest = deviation.farthest.expect("it is off");
        assert!((farthest.by - 0.1).abs() < 1e-9);
    }

    #[test]
    fn a_rounded_corner_is_enlarged_towards_its_inside_without_a_jump() {
        let mut deviation = Deviation::new(4.0);
        deviation.order(&way([0.0; 3], [10.0, 0.0, 0.0], None));
        deviation.order(&way([10.0, 0.0, 0.0], [10.0, 10.0, 0.0], None));
        // A parabola with arms of 2 mm: each way is left by half a mm.
        let blend = (0..=400).map(|part| {
            let s = f64::from(part) / 100.0;
            [8.0 + s - s * s / 8.0, s * s / 8.0, 0.0]
        });
        let points: Vec<_> = [[0.0; 3]].into_iter().chain(blend).chain([[10.0, 10.0, 0.0]]).collect();
        let drawn = drawn(&mut deviation, &points);
        assert!((deviation.farthest.expect("it is off").by - 0.5).abs() < 1e-9);
        let steps = drawn[1..drawn.len() - 1].windows(2).map(|pair| distance(pair[0], pair[1]));
        assert!(steps.fold(0.0, f64::max) < 0.03, "{drawn:?}");
        // By hand: 4 times the distance from the one way, s²/2, is that from the other, 2 - s + s²/8, where s = 4/3.
        let height = 8.0 / 9.0;
        let nearest = drawn.iter().map(|at| distance(*at, [10.0 - height, height, 0.0]));
        assert!(nearest.fold(f64::INFINITY, f64::min) < 0.01, "{height} {drawn:?}");
    }

    #[test]
    fn what_is_on_its_way_has_no_deviation() {
        let mut deviation = Deviation::new(100.0);
        deviation.order(&way([0.0; 3], [10.0, 0.0, 0.0], None));
        assert_eq!(drawn(&mut deviation, &[[0.0; 3], [4.0, 0.0, 0.0], [10.0, 0.0, 0.0]])[1], [10.0, 0.0, 0.0]);
        assert_eq!(deviation.farthest, None);
    }
}
