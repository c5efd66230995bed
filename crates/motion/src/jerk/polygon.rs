//! Lines one behind the other, rounded so that the bend of the way is steady.
//!
//! A polygon is a curve whose bend is an impulse at each corner, as large as the change `Δ` of the direction. Each impulse
//! is made a hat of the same area, `w` wide on either side: `q'' = Δ (w - |s|) / w²`, so that the way leaves the polygon by
//! `Δ k(|s|)` with `k = (w - |s|)³ / 6w²`, and only within `w`. Hats overlap freely: on chords of a curve each is several
//! chords wide, and their sum is nearly the bend of the curve itself.
//!
//! How wide: let `g` be the width at which, if all hats had it, the deviations `|Δ| k` would add up to the tolerance at a
//! corner. A hat that is no wider than `g` of every corner that it covers keeps all of them within it; and between two
//! corners the sum is convex, so that it is largest at one of them.

use std::collections::VecDeque;

use base::{AXES, Point};

use super::rounding::USED;
use crate::way::{Way, norm};

/// Corners that a hat covers on either side, at most.
const MOST_COVERED: usize = 16;
/// The widest hat, mm, so that long lines need not be seen far ahead.
const WIDEST: f64 = 10.0;
/// Newton's steps towards `g`.
const STEPS: usize = 4;
/// What is taken off `g` until the deviations are within the tolerance.
const LESS: f64 = 0.97;
/// Ends of hats nearer than this to each other, as a part of the line, are one.
const NEAR: f64 = 1e-9;

/// A corner, at the beginning of its line.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Corner {
    /// Its place on the stretch, mm.
    at: f64,
    change: Point,
    /// The length of the change.
    turn: f64,
    /// `g` and `w`, as soon as they are known.
    most: f64,
    width: f64,
}

/// A line, and the move that asks for it.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Line {
    way: Way,
    mover: u64,
}

/// Lines between two ends.
#[derive(Clone, Debug, Default)]
pub struct Polygon {
    tolerance: f64,
    axes: usize,
    /// The corners, of which the first `before` belong to lines that have been cut; and the other lines.
    corners: VecDeque<Corner>,
    before: usize,
    lines: VecDeque<Line>,
    /// How many corners have their `g` and their `w`.
    measured: usize,
    settled: usize,
    /// Where it begins and, so far, ends, and what is sure to be free of arms.
    begin: f64,
    end: f64,
    free: f64,
    ended: bool,
    /// Whether it has had one line only.
    single: bool,
    /// The pieces of the line cut last.
    pieces: Vec<Way>,
    knots: Vec<f64>,
}

impl Polygon {
    /// Begins anew, an arm's length behind the start of the first line.
    pub fn begin(&mut self, tolerance: f64, axes: usize, arm: f64) {
        self.corners.clear();
        self.lines.clear();
        (self.tolerance, self.axes) = (tolerance * USED, axes);
        (self.before, self.measured, self.settled) = (0, 0, 0);
        (self.begin, self.end, self.free) = (arm, 0.0, 0.0);
        (self.ended, self.single) = (false, true);
    }

    /// Adds a line, where the direction changes by this much.
    pub fn add(&mut self, way: &Way, mover: u64, change: Point) {
        self.single = self.corners.is_empty();
        let turn = norm(&change, self.axes);
        self.corners.push_back(Corner { at: self.end, change, turn, most: 0.0, width: 0.0 });
        self.lines.push_back(Line { way: *way, mover });
        self.free = self.end + way.length() / 2.0;
        self.end += way.length();
    }

    /// It ends an arm's length before the end of the last line.
    pub fn end(&mut self, arm: f64) {
        self.ended = true;
        self.free = self.end - arm;
    }

    /// True if it has been one line only.
    pub fn is_single(&self) -> bool {
        self.single
    }

    /// The move of the first line that has not been cut.
    pub fn first_mover(&self) -> Option<u64> {
        self.lines.front().map(|line| line.mover)
    }

    /// True if no line is left after the one cut last.
    pub fn is_cut(&self) -> bool {
        self.lines.is_empty()
    }

    /// Cuts the next line if all that it depends on is known: its move; [`Polygon::pieces`] gives its pieces.
    pub fn cut(&mut self) -> Option<u64> {
        self.measure();
        self.settle();
        let line = *self.lines.front()?;
        let next = self.before + 1;
        let reach = match self.corners.get(next) {
            Some(corner) if next < self.settled => corner.at + corner.most.min(WIDEST),
            None if self.ended => self.end,
            _ => return None,
        };
        // Corners behind the end of the line reach into it only from within its `g`, and not over too many others.
        let mut near = self.corners.iter().take(next + 1 + MOST_COVERED);
        let unknown = !self.ended && self.end < reach && self.corners.len() <= next + MOST_COVERED;
        if unknown || near.by_ref().skip(self.settled).any(|corner| corner.at < reach) {
            return None;
        }
        self.cut_line(&line.way);
        self.lines.pop_front();
        self.before += 1;
        while self.before > MOST_COVERED {
            self.corners.pop_front();
            self.before -= 1;
            self.measured = self.measured.saturating_sub(1);
            self.settled = self.settled.saturating_sub(1);
        }
        Some(line.mover)
    }

    /// The pieces of the line cut last.
    pub fn pieces(&self) -> &[Way] {
        &self.pieces
    }

    /// Gives corners their `g` as far as enough is known.
    fn measure(&mut self) {
        while let Some(&corner) = self.corners.get(self.measured) {
            let index = self.measured;
            if corner.turn == 0.0 {
                self.corners[index].most = f64::INFINITY;
                self.measured += 1;
                continue;
            }
            let mut most = (6.0 * self.tolerance / corner.turn).min(WIDEST);
            if let Some(before) = index.checked_sub(MOST_COVERED) {
                most = most.min(corner.at - self.corners[before].at);
            }
            if let Some(behind) = self.corners.get(index + MOST_COVERED) {
                most = most.min(behind.at - corner.at);
            }
            if !self.ended && corner.at + most > self.end {
                return;
            }
            self.corners[index].most = self.tolerated(index, most);
            self.measured += 1;
        }
    }

    /// The largest `g` of a corner, at most `most`.
    fn tolerated(&self, index: usize, most: f64) -> f64 {
        let mut g = most;
        for _ in 0..STEPS {
            let (sum, rise) = self.deviations(index, g);
            if sum <= self.tolerance {
                return g;
            }
            let next = g - (sum - self.tolerance) / rise;
            // Newton's step has overshot where the sum bends.
            g = if next > g * 0.1 { next } else { g * 0.5 };
        }
        while self.deviations(index, g).0 > self.tolerance {
            g *= LESS;
        }
        g
    }

    /// What the deviations at a corner add up to if all hats are `g` wide, and how that grows with `g`.
    fn deviations(&self, index: usize, g: f64) -> (f64, f64) {
        let at = self.corners[index].at;
        let (mut sum, mut rise) = (0.0, 0.0);
        let mut add = |corner: &Corner| {
            let apart = (corner.at - at).abs();
            let inside = apart < g;
            if inside {
                let square = corner.turn * (g - apart) * (g - apart);
                sum += square * (g - apart);
                rise += square * (g + 2.0 * apart);
            }
            inside
        };
        for other in index..self.corners.len() {
            if !add(&self.corners[other]) {
                break;
            }
        }
        for other in (0..index).rev() {
            if !add(&self.corners[other]) {
                break;
            }
        }
        let square = 6.0 * g * g;
        (sum / square, rise / (square * g))
    }

    /// Gives hats their width as far as enough is known.
    fn settle(&mut self) {
        while self.settled < self.measured {
            let index = self.settled;
            let corner = self.corners[index];
            if corner.turn == 0.0 {
                self.settled += 1;
                continue;
            }
            let mut width = corner.most.min(corner.at - self.begin);
            let narrow = |width: f64, other: &Corner| width.min(other.most.max((other.at - corner.at).abs()));
            for other in (0..index).rev() {
                let other = &self.corners[other];
                if corner.at - other.at >= width {
                    break;
                }
                width = narrow(width, other);
            }
            if self.ended {
                width = width.min(self.free - corner.at);
            }
            for other in index + 1..self.corners.len() {
                if self.corners[other].at - corner.at >= width {
                    break;
                }
                if other >= self.measured {
                    return;
                }
                width = narrow(width, &self.corners[other]);
            }
            if corner.at + width > self.free && !self.ended {
                return;
            }
            self.corners[index].width = width.max(0.0);
            self.settled += 1;
        }
    }

    fn cut_line(&mut self, way: &Way) {
        self.pieces.clear();
        self.knots.clear();
        let Way::Line { from, along, length } = way else { return };
        let start = self.corners[self.before].at;
        let low = start.max(self.begin);
        let last = self.before + 1 >= self.corners.len();
        let high = if last && self.ended { self.free } else { start + length };
        let over = |corner: &&Corner| corner.at + corner.width > low && corner.at - corner.width < high;
        for corner in self.corners.iter().take(self.settled).filter(over) {
            for knot in [corner.at - corner.width, corner.at + corner.width] {
                if knot > low && knot < high {
                    self.knots.push(knot);
                }
            }
        }
        self.knots.sort_unstable_by(f64::total_cmp);
        self.knots.push(high);
        let mut at = low;
        for index in 0..self.knots.len() {
            let knot = self.knots[index];
            if knot - at <= length * NEAR || (high - knot <= length * NEAR && knot < high) {
                continue;
            }
            let middle = (at + knot) / 2.0;
            let base: Point = std::array::from_fn(|axis| from[axis] + along[axis] * (at - start));
            let mut terms = [base, *along, [0.0; AXES], [0.0; AXES]];
            let mut bends = false;
            for corner in self.corners.iter().take(self.settled).filter(over) {
                if (corner.at - middle).abs() < corner.width {
                    let sign = if corner.at < middle { -1.0 } else { 1.0 };
                    add_cube(&mut terms, corner, sign, at, self.axes);
                    bends = true;
                }
            }
            let length = knot - at;
            let line = Way::Line { from: base, along: *along, length };
            self.pieces.push(if bends { Way::Blend { terms, length } } else { line });
            at = knot;
        }
    }
}

/// Adds a hat's `Δ (w - |s|)³ / 6w²`, counted from the place `at` before (`sign` 1) or behind its corner (-1).
fn add_cube(terms: &mut [Point; 4], corner: &Corner, sign: f64, at: f64, axes: usize) {
    let each = 1.0 / (6.0 * corner.width * corner.width);
    let rest = corner.width - (corner.at - at) * sign;
    let parts = [rest * rest * rest, 3.0 * rest * rest * sign, 3.0 * rest, sign].map(|part| part * each);
    for axis in 0..axes {
        for (term, part) in terms.iter_mut().zip(parts) {
            term[axis] += corner.change[axis] * part;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::way::expect::{point, steady};

    /// All pieces of a polygon.
    fn rounded(tolerance: f64, places: &[Point]) -> Vec<Way> {
        let (mut stretch, mut ways) = (Polygon::default(), Vec::new());
        stretch.begin(tolerance, 2, 0.0);
        let mut before = None;
        for (mover, pair) in places.windows(2).enumerate() {
            let way = Way::line(&pair[0], &pair[1], 2);
            let slope = way.slope(0.0);
            let change =
                before.map_or([0.0; AXES], |before: Point| std::array::from_fn(|axis| slope[axis] - before[axis]));
            stretch.add(&way, mover as u64, change);
            before = Some(slope);
            while stretch.cut().is_some() {
                ways.extend_from_slice(stretch.pieces());
            }
        }
        stretch.end(0.0);
        while stretch.cut().is_some() {
            ways.extend_from_slice(stretch.pieces());
        }
        assert!(stretch.is_cut());
        ways
    }

    #[test]
    fn the_bend_of_a_polygon_is_steady() {
        let places = [point(0.0, 0.0), point(1.0, 0.0), point(1.9, 0.3), point(2.0, 1.5), point(2.0, 4.0)];
        let ways = rounded(0.05, &places);
        assert!(ways.len() > 8);
        steady(&ways);
        let whole: f64 = ways.iter().map(Way::length).sum();
        let polygon: f64 = places.windows(2).map(|pair| Way::line(&pair[0], &pair[1], 2).length()).sum();
        assert!((whole - polygon).abs() < 1e-9);
        for (axis, end) in [2.0, 4.0].into_iter().enumerate() {
            let last = ways[ways.len() - 1];
            assert!((last.at(last.length())[axis] - end).abs() < 1e-9);
        }
    }

    #[test]
    fn uneven_chords_of_a_circle_are_nearly_the_circle() {
        let (radius, mut angle, mut places) = (5.0, 0.0, Vec::new());
        let mut uneven = 0.0;
        while angle < 6.0 {
            places.push(point(radius * libm::cos(angle), radius * libm::sin(angle)));
            uneven = (uneven + 0.618) % 1.0;
            angle += 0.01 + 0.02 * uneven;
        }
        let ways = rounded(0.01, &places);
        steady(&ways);
        let count = ways.len();
        for way in &ways[count / 4..3 * count / 4] {
            let bend = norm(&way.bend(way.length() / 2.0), 2);
            assert!((bend * radius - 1.0).abs() < 0.15, "{bend}");
            let at = way.at(way.length() / 2.0);
            assert!((norm(&at, 2) - radius).abs() < 0.01);
        }
    }
}
