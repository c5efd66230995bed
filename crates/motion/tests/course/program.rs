//! Random programs: lines, arcs, helices, spirals and chords of curves, over axes of unlike limits.

use std::f64::consts::{PI, TAU};

use base::{AXES, Point};
use meaning::{ArcMove, Feed, Plane};
use motion::{AxisLimits, Limits, Move, Way};
use path::Arc;

use super::feed;
use testkit::Random;

/// A program and the machine it runs on.
#[derive(Clone, Debug)]
pub struct Program {
    pub limits: Limits,
    pub moves: Vec<Move>,
}

/// Seconds that a single move of a random program takes at most at its feed, so that the tests end.
const LONGEST_S: f64 = 0.15;

struct Pen<'r> {
    random: &'r mut Random,
    limits: Limits,
    moves: Vec<Move>,
    at: Point,
    /// Heading in the XY plane, radians.
    heading: f64,
    feed: Feed,
    /// Places are rounded to this, mm; 0: not at all.
    increment: f64,
}

/// The program of this number.
pub fn program(seed: u64) -> Program {
    let mut random = Random::new(seed);
    let count = random.pick(&[1, 2, 3, 3, 3, 4, 5, 8]);
    let alike = random.chance(0.3);
    let mut axis = AxisLimits::default();
    let axes = std::array::from_fn(|index| {
        if index == 0 || !alike {
            let max_feed = random.scaled(5.0, 1000.0);
            let rapid = max_feed * random.between(1.0, 3.0);
            axis = AxisLimits { rapid, max_feed, acceleration: random.scaled(50.0, 20_000.0), jerk: f64::INFINITY };
        }
        axis
    });
    let corner_tolerance = random.pick(&[0.0, 0.001, 0.01, 0.05, 0.1]);
    let servo_period = random.pick(&[0.0005, 0.001, 0.002, 0.004, 0.008]);
    let limits = Limits { axes, count, corner_tolerance, servo_period, ..Limits::default() };
    let at = std::array::from_fn(|axis| if axis < count { random.between(-100.0, 100.0) } else { 0.0 });
    let increment = random.pick(&[0.0, 0.0, 1e-6, 0.001]);
    let heading = random.between(0.0, TAU);
    let speed = feed(random.scaled(1.0, 60_000.0));
    let mut pen = Pen { random: &mut random, limits, moves: Vec::new(), at, heading, feed: speed, increment };
    let kind = pen.random.below(6);
    let wanted = pen.random.pick(&[1, 2, 5, 12, 30]);
    while pen.moves.len() < wanted {
        pen.next(kind);
    }
    Program { limits, moves: pen.moves }
}

impl Pen<'_> {
    fn next(&mut self, kind: usize) {
        if self.random.chance(0.2) {
            self.feed = feed(if self.random.chance(0.1) { f64::INFINITY } else { self.random.scaled(1.0, 60_000.0) });
            self.feed.per_revolution = self.feed.mm_per_min < f64::INFINITY && self.random.chance(0.2);
            self.feed.tapping = self.feed.mm_per_min < f64::INFINITY && self.random.chance(0.1);
        }
        match kind {
            0 => self.line(false),
            1 if self.limits.count > 1 => self.tangent(),
            2 => self.chords(),
            3 if self.limits.count > 1 => self.round(false),
            _ => match self.random.below(6) {
                0 | 1 => self.line(false),
                2 => self.line(true),
                3 => self.chords(),
                4 if self.limits.count > 1 => self.round(true),
                5 if self.limits.count > 1 => self.round(false),
                _ => self.line(true),
            },
        }
    }

    /// A length of any size that is not driven for ever: 1 µm as well as 1 m.
    fn length(&mut self) -> f64 {
        let axes = &self.limits.axes[..self.limits.count];
        let speed = axes.iter().map(|axis| axis.max_feed).fold(self.feed.mm_per_min / 60.0, f64::min);
        self.random.scaled(0.001, 1000.0).min(speed * LONGEST_S).max(1e-6)
    }

    fn line(&mut self, tangent: bool) {
        let length = self.length();
        let mut to = self.at;
        if self.limits.count == 1 || self.random.chance(0.2) {
            let axis = self.random.below(self.limits.count);
            to[axis] += self.random.pick(&[length, -length]);
            return self.line_to(&to);
        }
        if !tangent {
            self.heading += match self.random.below(4) {
                0 => self.random.between(-PI, PI),
                1 => self.random.pick(&[PI / 2.0, -PI / 2.0, PI, 0.0]),
                2 => self.random.scaled(1e-7, 1.0),
                _ => -self.random.scaled(1e-7, 1.0),
            };
        }
        to[0] += length * self.heading.cos();
        to[1] += length * self.heading.sin();
        if self.random.chance(0.4) {
            for place in &mut to[2..self.limits.count.max(2)] {
                *place += self.random.between(-length, length);
            }
        }
        self.line_to(&to);
    }

    fn tangent(&mut self) {
        if self.random.chance(0.5) { self.line(true) } else { self.round(true) }
    }

    /// A curve by its chords.
    fn chords(&mut self) {
        let chord = self.random.scaled(1e-3, 2.0).min(self.length());
        let (from, heading) = (self.at, self.heading);
        let (height, wave) = (self.random.scaled(0.1, 20.0), self.random.scaled(1.0, 50.0));
        for index in 1..=self.random.between(5.0, 60.0) as usize {
            let along = chord * index as f64;
            let aside = height * (1.0 - (along / wave).cos());
            let mut to = from;
            to[0] += along * heading.cos() - aside * heading.sin();
            if self.limits.count > 1 {
                to[1] += along * heading.sin() + aside * heading.cos();
            }
            if self.limits.count > 2 {
                to[2] += height * 0.3 * (along / wave * 1.7).sin();
            }
            self.line_to(&to);
        }
    }

    /// An arc, at times a helix or a spiral.
    fn round(&mut self, tangent: bool) {
        let count = self.limits.count;
        let pair = if tangent || count < 3 { [0, 1] } else { self.random.pick(&[[0u8, 1], [2, 0], [1, 2]]) };
        let radius = self.random.scaled(0.01, 500.0);
        let clockwise = self.random.chance(0.5);
        let side = if clockwise { -1.0 } else { 1.0 };
        let heading = if tangent && pair == [0, 1] { self.heading } else { self.random.between(0.0, TAU) };
        let full_circle = !tangent && self.random.chance(0.2);
        let most = (self.length() * 3.0 / radius).clamp(1e-4, TAU - 1e-3);
        let sweep = if full_circle { TAU } else { self.random.between(0.3, 1.0) * most };
        let spoke = heading - side * PI / 2.0;
        let [u, v] = pair.map(usize::from);
        let center = [self.at[u] - radius * spoke.cos(), self.at[v] - radius * spoke.sin()];
        let end = spoke + side * sweep;
        // The end off the circle: by a rounding, or on purpose.
        let other = match self.random.below(6) {
            0 => radius * self.random.between(0.999, 1.001),
            1 => radius * self.random.scaled(0.05, 20.0),
            _ => radius,
        };
        let mut to = self.at;
        if !full_circle {
            to[u] = self.rounded(center[0] + other * end.cos());
            to[v] = self.rounded(center[1] + other * end.sin());
        }
        if self.random.chance(0.4) {
            for axis in (0..count).filter(|axis| ![u, v].contains(axis)) {
                to[axis] += radius * sweep * self.random.between(-1.0, 1.0);
            }
        }
        if to[u] == self.at[u] && to[v] == self.at[v] && !full_circle {
            return;
        }
        let arc = ArcMove { to, plane: Plane::Xy, axes: pair, center, clockwise, full_circle };
        let arc = Arc::new(&self.at, &arc);
        let way = Way::arc(&arc);
        if arc.plane_length() > 1e-7 {
            self.add(way, &to, way.length() / arc.plane_length());
        }
        self.heading = heading + side * sweep;
    }

    fn rounded(&self, place: f64) -> f64 {
        if self.increment > 0.0 { (place / self.increment).round() * self.increment } else { place }
    }

    fn line_to(&mut self, to: &Point) {
        let mut to = *to;
        for axis in 0..AXES {
            to[axis] = if axis < self.limits.count { self.rounded(to[axis]) } else { 0.0 };
        }
        let way = Way::line(&self.at, &to, self.limits.count);
        if way.length() > 1e-7 {
            self.add(way, &to, 1.0);
        }
    }

    fn add(&mut self, way: Way, to: &Point, share: f64) {
        let stops = self.random.chance(0.1);
        self.moves.push(Move { way, feed: self.feed, share, stops });
        self.at = *to;
    }
}
