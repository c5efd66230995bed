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
pub(crate) const EXACTNESS: f64 = 1e-9;
/// What rounding can do to a point that is worked out, mm.
const ROUNDING: f64 = 1e-8;

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

    /// The exit of a move, and where on its way the first axis meets its limit.
    pub fn meets(&self, shape: &Shape, rates: Option<&Point>) -> Option<(Exit, Met)> {
        let exit = self.exit(shape)?;
        let met = match (shape, rates) {
            (Shape::Rapid { from, to, .. }, Some(rates)) => self.first(from, to, |axis, way| way / rates[axis]),
            (Shape::Rapid { from, to, .. } | Shape::Line { from, to, .. }, _) => {
                self.first(from, to, |axis, way| way / (to[axis] - from[axis]).abs())
            }
            (Shape::Arc { arc, .. }, _) => {
                let (at, axis) = arc.first_exit(self.axes, &self.low, &self.high).unwrap_or((1.0, exit.axis));
                let above = arc.at(at)[axis] > (self.low[axis] + self.high[axis]) / 2.0;
                Met { at, axis, border: if above { self.high[axis] } else { self.low[axis] } }
            }
            _ => return None,
        };
        Some((exit, met))
    }

    /// The first axis to meet its limit on a way from point to point; `when` counts its way up to there.
    fn first(&self, from: &Point, to: &Point, when: impl Fn(usize, f64) -> f64) -> Met {
        let mut first = Met { at: f64::INFINITY, axis: 0, border: f64::NAN };
        for axis in self.axes.iter() {
            let border = match to[axis] {
                to if to < self.low[axis] => self.low[axis],
                to if to > self.high[axis] => self.high[axis],
                _ => continue,
            };
            let way = to[axis] - from[axis];
            // An axis that stands beyond its border already does not move at all.
            let at = if way == 0.0 { 0.0 } else { when(axis, ((border - from[axis]) * way.signum()).max(0.0)) };
            if at < first.at {
                first = Met { at, axis, border };
            }
        }
        first
    }
}

/// Where something is met on the way of a move.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Met {
    /// The axis that meets it.
    pub axis: usize,
    /// A fraction of a line or of the sweep of an arc; minutes since the start where every axis runs at its own rate.
    pub at: f64,
    /// Where the axis is then.
    pub border: f64,
}

/// The part of a move before what it meets, and which part of the whole it is. `rates` are the axes' own rapid rates
/// where every axis runs at its own; `None` for a straight way.
pub fn until(shape: &Shape, met: &Met, rates: Option<&Point>) -> (Shape, f64) {
    let snap = |mut end: Point| {
        // Rounding must not leave the axis beside the border.
        if (end[met.axis] - met.border).abs() < ROUNDING {
            end[met.axis] = met.border;
        }
        end
    };
    match *shape {
        Shape::Rapid { from, to, kind } => {
            let end = snap(match rates {
                Some(rates) => at_own_rates(&from, &to, rates, met.at),
                None => along(&from, &to, met.at),
            });
            (Shape::Rapid { from, to: end, kind }, part(&from, &end, &to))
        }
        Shape::Line { from, to, feed } => {
            let end = snap(along(&from, &to, met.at));
            (Shape::Line { from, to: end, feed }, part(&from, &end, &to))
        }
        Shape::Arc { mut arc, feed } => {
            if met.at < 1.0 {
                let (to, radius) = (arc.at(met.at), arc.radius[0] + (arc.radius[1] - arc.radius[0]) * met.at);
                arc.to = snap(to);
                arc.radius[1] = radius;
                arc.sweep *= met.at;
            }
            (Shape::Arc { arc, feed }, met.at.min(1.0))
        }
        other => (other, 1.0),
    }
}

/// The point at this fraction of a straight way.
pub fn along(from: &Point, to: &Point, fraction: f64) -> Point {
    let fraction = fraction.clamp(0.0, 1.0);
    let mut point = *from;
    for axis in 0..AXES {
        point[axis] = from[axis] + (to[axis] - from[axis]) * fraction;
    }
    point
}

/// Where the axes are so many minutes after they all began to move, each at its own rate until it arrives.
pub fn at_own_rates(from: &Point, to: &Point, rates: &Point, minutes: f64) -> Point {
    let mut point = *to;
    for axis in 0..AXES {
        let way = to[axis] - from[axis];
        if way.abs() > rates[axis] * minutes {
            point[axis] = from[axis] + way.signum() * rates[axis] * minutes;
        }
    }
    point
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
