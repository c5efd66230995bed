//! Travel: no axis leaves its limits. Arcs and helices are judged by their true extent.

use base::{AXES, AxisSet, Point};
use path::Shape;

/// The limits of travel, mm and degrees in machine coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Travel {
    /// Lowest coordinates.
    pub low: Point,
    /// Highest coordinates.
    pub high: Point,
    /// The axes that there are.
    pub axes: AxisSet,
}

/// Positions are exact to less than this; a hair's breadth beyond a limit is on it.
const EXACTNESS: f64 = 1e-9;

/// A move that leaves the travel.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Exit {
    /// The axis that leaves.
    pub axis: usize,
    /// The furthest coordinate it would reach.
    pub reaches: f64,
}

impl Travel {
    /// The first axis that the move would take beyond its limits.
    pub fn exit(&self, shape: &Shape) -> Option<Exit> {
        match shape {
            Shape::Rapid { to, .. } | Shape::Line { to, .. } => self.outside(to, to),
            Shape::Arc { arc, .. } => {
                let (low, high) = arc.extent();
                self.outside(&low, &high)
            }
            _ => None,
        }
    }

    fn outside(&self, low: &Point, high: &Point) -> Option<Exit> {
        for axis in self.axes.iter() {
            if low[axis] < self.low[axis] - EXACTNESS {
                return Some(Exit { axis, reaches: low[axis] });
            }
            if high[axis] > self.high[axis] + EXACTNESS {
                return Some(Exit { axis, reaches: high[axis] });
            }
        }
        None
    }

    /// The part of a move that stays inside: the shape up to the border, and which part of the whole it is. `rates` are the axes' own rapid rates where
    /// every axis runs at its own; `None` for a straight way.
    pub fn until_border(&self, shape: &Shape, rates: Option<&Point>) -> (Shape, f64) {
        match *shape {
            Shape::Rapid { from, to, kind } => {
                let end = match rates {
                    Some(rates) => self.clip_by_rates(&from, &to, rates),
                    None => self.clip(&from, &to),
                };
                (Shape::Rapid { from, to: end, kind }, part(&from, &end, &to))
            }
            Shape::Line { from, to, feed } => {
                let end = self.clip(&from, &to);
                (Shape::Line { from, to: end, feed }, part(&from, &end, &to))
            }
            Shape::Arc { mut arc, feed } => {
                let mut part = 1.0;
                if let Some((s, _)) = arc.first_exit(self.axes, &self.low, &self.high) {
                    let (to, radius) = (arc.at(s), arc.radius[0] + (arc.radius[1] - arc.radius[0]) * s);
                    arc.to = to;
                    arc.radius[1] = radius;
                    arc.sweep *= s;
                    part = s;
                }
                (Shape::Arc { arc, feed }, part)
            }
            other => (other, 1.0),
        }
    }

    /// The limit that an axis meets on its way, if it meets one.
    fn border(&self, axis: usize, to: f64) -> Option<f64> {
        if to < self.low[axis] {
            Some(self.low[axis])
        } else if to > self.high[axis] {
            Some(self.high[axis])
        } else {
            None
        }
    }

    fn clip(&self, from: &Point, to: &Point) -> Point {
        let mut part = 1.0f64;
        for axis in self.axes.iter() {
            if let Some(border) = self.border(axis, to[axis]) {
                part = part.min((border - from[axis]) / (to[axis] - from[axis]));
            }
        }
        let part = part.max(0.0);
        let mut end = *from;
        for axis in 0..AXES {
            end[axis] = from[axis] + (to[axis] - from[axis]) * part;
        }
        self.snap(end, to)
    }

    fn clip_by_rates(&self, from: &Point, to: &Point, rates: &Point) -> Point {
        let mut time = f64::INFINITY;
        for axis in self.axes.iter() {
            if let Some(border) = self.border(axis, to[axis]) {
                // An axis that stands beyond its border already does not move further out.
                let way = (border - from[axis]) * (to[axis] - from[axis]).signum();
                time = time.min(way.max(0.0) / rates[axis]);
            }
        }
        let mut end = *to;
        for axis in self.axes.iter() {
            let way = to[axis] - from[axis];
            end[axis] = from[axis] + way.signum() * way.abs().min(rates[axis] * time);
        }
        self.snap(end, to)
    }

    /// Rounding must not leave the border's axis beside it.
    fn snap(&self, mut end: Point, to: &Point) -> Point {
        for axis in self.axes.iter() {
            if let Some(border) = self.border(axis, to[axis])
                && (end[axis] - border).abs() < EXACTNESS
            {
                end[axis] = border;
            }
        }
        end
    }
}

/// Which part of the way from `from` to `to` leads to `end`, along the axis that goes furthest.
fn part(from: &Point, end: &Point, to: &Point) -> f64 {
    let mut furthest = 0;
    for axis in 1..AXES {
        if (to[axis] - from[axis]).abs() > (to[furthest] - from[furthest]).abs() {
            furthest = axis;
        }
    }
    let whole = to[furthest] - from[furthest];
    if whole == 0.0 { 1.0 } else { (end[furthest] - from[furthest]) / whole }
}
