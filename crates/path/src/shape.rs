//! What the stage hands on: shapes, each with where it comes from.

use base::{Alarm, Place, Point};
use meaning::{ArcMove, Close, CodeOut, Dwell, Element, Feed, Plane, RapidKind, SetValue, StopKind, Turn};

use crate::arc::Arc;
use crate::compensation::Corner;

/// Counts a mm.
pub(crate) const COUNTS: f64 = 1e6;

/// What happens, with its geometry.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Shape {
    /// The program begins.
    Start(dialect::GroupCodes),
    /// A code goes out.
    Code(CodeOut),
    /// Positioning.
    Rapid {
        /// From here.
        from: Point,
        /// To there.
        to: Point,
        /// How it ends.
        kind: RapidKind,
    },
    /// A straight cut.
    Line {
        /// From here.
        from: Point,
        /// To there.
        to: Point,
        /// The feed along it.
        feed: Feed,
    },
    /// An arc.
    Arc {
        /// Its geometry.
        arc: Arc,
        /// The feed along the arc in its plane.
        feed: Feed,
    },
    /// Time passes.
    Dwell(Dwell),
    /// A value was written.
    Set(SetValue),
    /// The machine answers every code that is out; then a stop, if there is one.
    Await(Option<StopKind>),
    /// The block is done.
    Close(Close),
    /// The block is refused.
    Alarm(Alarm),
}

impl Shape {
    /// True for a move of the axes.
    pub fn is_move(&self) -> bool {
        matches!(self, Shape::Rapid { .. } | Shape::Line { .. } | Shape::Arc { .. })
    }

    /// The part of a move that leads here, to a point on it.
    pub fn up_to(&self, at: &Point) -> Shape {
        match self {
            Shape::Rapid { from, kind, .. } => Shape::Rapid { from: *from, to: *at, kind: *kind },
            Shape::Line { from, feed, .. } => Shape::Line { from: *from, to: *at, feed: *feed },
            Shape::Arc { arc, feed } => {
                let (sweep, radius) = arc.turned_to(at);
                Shape::Arc { arc: Arc { to: *at, sweep, radius: [arc.radius[0], radius], ..*arc }, feed: *feed }
            }
            other => *other,
        }
    }

    /// The part of a move that is left from here, a point on it.
    pub fn from_there(&self, at: &Point) -> Shape {
        match self {
            Shape::Rapid { to, kind, .. } => Shape::Rapid { from: *at, to: *to, kind: *kind },
            Shape::Line { to, feed, .. } => Shape::Line { from: *at, to: *to, feed: *feed },
            Shape::Arc { arc, feed } => {
                let (sweep, radius) = arc.turned_to(at);
                let rest = Arc {
                    from: *at,
                    sweep: arc.sweep - sweep,
                    radius: [radius, arc.radius[1]],
                    start_angle: arc.start_angle + sweep,
                    ..*arc
                };
                Shape::Arc { arc: rest, feed: *feed }
            }
            other => *other,
        }
    }
}

/// A shape with where it comes from.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shaped {
    /// Which block it belongs to.
    pub block: u64,
    /// Where that block stands.
    pub place: Place,
    /// What happens.
    pub shape: Shape,
    /// A stop point of the single-block switch inside the block.
    pub stop_point: bool,
    /// The block is done with it, and the next one follows.
    pub closes: bool,
    /// The move ends where the skip signal comes.
    pub until_signal: bool,
    /// The second stored stroke area is checked.
    pub stroke_check: bool,
    /// False if an earlier refusal makes its place doubtful (only while checking on).
    pub certain: bool,
    /// How it follows from the programmed path, if it runs beside that; with an alarm, the way that the tool does not fit
    /// beside.
    pub beside: Option<RunBeside>,
}

/// How a move beside the programmed path follows from it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RunBeside {
    /// Which part of the block it is.
    pub part: Part,
    /// The tool's radius, mm: positive left of the path, negative right of it.
    pub radius: f64,
    /// The corner at the block's end, with the move that leads to it; `None` with every other.
    pub corner: Corner,
    /// The programmed way of the block in the plane, with the move that runs beside it.
    pub way: Option<Element>,
    /// The plane.
    pub plane: Plane,
    /// Its two axes.
    pub axes: [u8; 2],
}

impl RunBeside {
    /// The programmed way that a move between these points runs beside; mm.
    pub fn programmed(&self, from: &Point, to: &Point) -> Option<Programmed> {
        let way = self.way?;
        let at = |point: &Point, counts: [f64; 2]| {
            let mut point = *point;
            for (axis, counts) in self.axes.iter().zip(counts) {
                if let Some(place) = point.get_mut(usize::from(*axis)) {
                    *place = counts / COUNTS;
                }
            }
            point
        };
        let (start, end) = (at(from, way.from), at(to, way.to));
        let Some(turn) = way.turn else { return Some(Programmed::Line(start, end)) };
        let Turn { center, clockwise, full_circle } = turn;
        let center = center.map(|counts| counts / COUNTS);
        let arc = ArcMove { to: end, plane: self.plane, axes: self.axes, center, clockwise, full_circle };
        Some(Programmed::Arc(Arc::new(&start, &arc)))
    }
}

/// Which part of a compensated block a move is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Part {
    /// It leads from the programmed path to the one beside it.
    Start,
    /// It runs beside the programmed element.
    Along,
    /// It goes round a corner.
    Round,
    /// It leads back to the programmed path.
    Cancel,
}

/// A programmed way.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Programmed {
    /// Straight, from here to there.
    Line(Point, Point),
    /// An arc.
    Arc(Arc),
}

impl Programmed {
    /// Where a tool of this radius (mm, positive left) touches it: its middle, at a fraction of the way.
    pub fn touched(&self, beside: &RunBeside, fraction: f64) -> Point {
        let [first, second] = beside.axes.map(usize::from);
        let (mut point, at) = match self {
            Programmed::Line(from, to) => {
                let point: Point = std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * fraction);
                let along = |axis: usize| to.get(axis).zip(from.get(axis)).map_or(0.0, |(to, from)| to - from);
                let length = libm::hypot(along(first), along(second)).max(f64::MIN_POSITIVE);
                let normal = [-along(second) / length, along(first) / length];
                let on = |axis: usize| point.get(axis).copied().unwrap_or(0.0);
                (point, [0, 1].map(|index| on([first, second][index]) + beside.radius * normal[index]))
            }
            Programmed::Arc(arc) => {
                let point: Point =
                    std::array::from_fn(|axis| arc.from[axis] + (arc.to[axis] - arc.from[axis]) * fraction);
                let radius = arc.radius[0] + (arc.radius[1] - arc.radius[0]) * fraction;
                let away = radius - beside.radius * arc.sweep.signum();
                let (sin, cos) = libm::sincos(arc.start_angle + arc.sweep * fraction);
                (point, [arc.center[0] + away * cos, arc.center[1] + away * sin])
            }
        };
        for (axis, at) in [first, second].into_iter().zip(at) {
            if let Some(place) = point.get_mut(axis) {
                *place = at;
            }
        }
        point
    }
}

impl Default for Shaped {
    /// The end of no block.
    fn default() -> Self {
        let shape = Shape::Close(Close::Next);
        Shaped {
            block: 0,
            place: Place::default(),
            shape,
            stop_point: false,
            closes: false,
            until_signal: false,
            stroke_check: false,
            certain: true,
            beside: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use base::AXES;

    use super::*;

    fn point(x: f64, y: f64) -> Point {
        let mut point = [0.0; AXES];
        (point[0], point[1]) = (x, y);
        point
    }

    fn beside(radius: f64, way: Element) -> RunBeside {
        RunBeside { part: Part::Along, radius, corner: Corner::None, way: Some(way), plane: Plane::Xy, axes: [0, 1] }
    }

    #[test]
    fn the_tool_touches_a_line_on_its_side() {
        let way = Element { from: [0.0, 0.0], to: [30e6, 40e6], turn: None };
        for (radius, at) in [(5.0, [11.0, 23.0]), (-5.0, [19.0, 17.0])] {
            let beside = beside(radius, way);
            let programmed = beside.programmed(&point(0.0, 0.0), &point(0.0, 0.0)).expect("a way");
            let touched = programmed.touched(&beside, 0.5);
            assert!((touched[0] - at[0]).abs() < 1e-12 && (touched[1] - at[1]).abs() < 1e-12, "{touched:?}");
        }
    }

    #[test]
    fn the_tool_touches_an_arc_inside_and_outside() {
        // From (10, 0) by (0, 10), or the other way, to (-10, 0).
        for (clockwise, radius, away) in [(false, 3.0, 7.0), (false, -3.0, 13.0), (true, 3.0, 13.0), (true, -3.0, 7.0)]
        {
            let turn = Some(Turn { center: [0.0; 2], clockwise, full_circle: false });
            let beside = beside(radius, Element { from: [10e6, 0.0], to: [-10e6, 0.0], turn });
            let programmed = beside.programmed(&point(0.0, 0.0), &point(0.0, 0.0)).expect("a way");
            let touched = programmed.touched(&beside, 0.5);
            let side = if clockwise { -away } else { away };
            assert!(touched[0].abs() < 1e-9 && (touched[1] - side).abs() < 1e-9, "{clockwise} {radius}: {touched:?}");
        }
    }
}
