//! A plan of compensation as moves, one at a time: round the corner at the start, beside the element, round the corner
//! at its end.

use base::{AXES, Point};
use meaning::{Act, Element, Feed, Offset, Operation, RapidKind};

use crate::arc::Arc;
use crate::compensation::{Corner, Edge, Join, Plan, sweep_round};
use crate::plane::{Vector, in_plane, less};
use crate::shape::{COUNTS, Part, RunBeside, Shape, Shaped};

/// A piece shorter than this, mm, has no length: rounding made it.
const NO_LENGTH: f64 = 1e-9;

/// A plan being carried out.
#[derive(Clone, Copy, Default)]
pub(crate) struct Pieces {
    /// Pieces of the plan, and the one that comes next.
    count: u8,
    next: u8,
    certain: bool,
    element: Element,
    edge: Edge,
    offset: Offset,
    plan: Plan,
    end: Join,
    /// Where the axes stood before it.
    from: Point,
}

/// What the pieces of a plan are made from.
pub(crate) struct Carried<'c> {
    /// The element.
    pub element: &'c Element,
    /// Its shape.
    pub edge: &'c Edge,
    /// The offset of its block.
    pub offset: &'c Offset,
    /// The plan.
    pub plan: &'c Plan,
    /// Its end.
    pub end: &'c Join,
    /// Where the axes stood before it.
    pub from: &'c Point,
    /// Where it begins is certain.
    pub certain: bool,
}

impl Pieces {
    /// True until the last piece is out.
    #[inline]
    pub fn is_open(&self) -> bool {
        self.next < self.count
    }

    /// Writes the first piece of a plan that has a length and keeps the others; false if none has.
    pub fn begin(&mut self, work: &Carried, operation: &Operation, position: &mut Point, shaped: &mut Shaped) -> bool {
        let count = work.count();
        if let (1, Act::Line { to, feed }, false) = (count, &operation.act, work.edge.is_arc()) {
            return work.whole(operation, (to, feed), position, shaped);
        }
        for index in 0..count {
            if !work.piece(operation, index, position, shaped) {
                continue;
            }
            if index + 1 < count {
                let Carried { element, edge, offset, plan, end, from, certain } = *work;
                *self = Pieces {
                    count: count as u8,
                    next: index as u8 + 1,
                    certain,
                    element: *element,
                    edge: *edge,
                    offset: *offset,
                    plan: *plan,
                    end: *end,
                    from: *from,
                };
            }
            return true;
        }
        false
    }

    /// Writes the next piece that has a length; false if there is none. The operation is the one that was planned.
    pub fn next(&mut self, operation: &Operation, position: &mut Point, shaped: &mut Shaped) -> bool {
        while self.is_open() {
            let index = usize::from(self.next);
            self.next += 1;
            let Pieces { element, edge, offset, plan, end, from, certain, .. } = self;
            let work = Carried { element, edge, offset, plan, end, from, certain: *certain };
            if work.piece(operation, index, position, shaped) {
                return true;
            }
        }
        false
    }
}

impl Carried<'_> {
    /// Pieces before the one that runs beside the element: the first place of that way is where the tool stands.
    fn ahead(&self) -> usize {
        self.plan.before.as_ref().map_or(0, |join| join.places().len().saturating_sub(1))
    }

    fn count(&self) -> usize {
        self.ahead() + self.end.places().len()
    }

    /// Writes the one piece of a cut beside a line, as most are; false if it has no length.
    fn whole(
        &self,
        operation: &Operation,
        (end, feed): (&Point, &Feed),
        position: &mut Point,
        shaped: &mut Shaped,
    ) -> bool {
        let axes = self.offset.axes;
        let to = placed(end, axes, self.element.to, self.end.first());
        let way = less(in_plane(&to, axes), in_plane(position, axes));
        if way[0].abs() < NO_LENGTH
            && way[1].abs() < NO_LENGTH
            && beside_plane(position, axes) == beside_plane(&to, axes)
        {
            return false;
        }
        straight(&mut shaped.shape, position, &to, feed, true);
        *position = to;
        self.finish(operation, true, if self.plan.starts { Part::Start } else { Part::Along }, shaped);
        true
    }

    /// Writes what a piece has beside its shape.
    fn finish(&self, operation: &Operation, last: bool, part: Part, shaped: &mut Shaped) {
        shaped.block = operation.block;
        shaped.place = operation.place;
        shaped.stop_point = operation.stop_point && last;
        shaped.closes = operation.closes && last;
        shaped.until_signal = false;
        shaped.stroke_check = operation.stroke_check;
        shaped.certain = self.certain;
        self.mark(part, &mut shaped.beside);
    }

    /// Writes a piece; false if it has no length.
    fn piece(&self, operation: &Operation, index: usize, position: &mut Point, shaped: &mut Shaped) -> bool {
        let ahead = self.ahead();
        let last = index + 1 == self.count();
        let (join, step, programmed) = match (index.checked_sub(ahead), &self.plan.before) {
            (None, Some(before)) => (before, index + 1, self.element.from),
            (behind, _) => (self.end, behind.unwrap_or(0), self.element.to),
        };
        let (Some(&vector), Some(end)) = (join.places().get(step), end_of(operation)) else { return false };
        let axes = self.offset.axes;
        let from = *position;
        let to = placed(if index < ahead { self.from } else { end }, axes, programmed, vector);
        let along = index == ahead;
        let arc = match along {
            true if self.edge.is_arc() => Some(self.arc_beside(&from, &to)),
            false if join.round && step == 1 => Some(self.arc_round(&from, &to, join, programmed)),
            _ => None,
        };
        let has_length = match &arc {
            None => less(in_plane(&to, axes), in_plane(&from, axes)).iter().any(|way| way.abs() >= NO_LENGTH),
            Some(arc) => arc.plane_length() >= NO_LENGTH,
        };
        if !has_length && beside_plane(&from, axes) == beside_plane(&to, axes) {
            return false;
        }
        *position = to;
        match (&operation.act, arc) {
            (Act::Line { feed, .. }, None) => straight(&mut shaped.shape, &from, &to, feed, last),
            // An arc shrunk to its centre is a turn on the spot.
            (_, arc) => shaped.shape = shape(operation, arc.filter(|_| has_length), from, to, last),
        }
        let part = match (along, self.plan.starts) {
            (true, true) => Part::Start,
            (true, false) => Part::Along,
            (false, _) => Part::Round,
        };
        self.finish(operation, last, part, shaped);
        true
    }

    /// Writes how a piece follows from the programmed path; on its own as [`straight`] is.
    #[inline(never)]
    fn mark(&self, part: Part, beside: &mut Option<RunBeside>) {
        let along = part != Part::Round;
        *beside = Some(RunBeside {
            part,
            radius: self.offset.radius,
            corner: if along { self.end.corner } else { Corner::None },
            way: along.then_some(*self.element),
            plane: self.offset.plane,
            axes: self.offset.axes,
        });
    }

    /// The arc beside the programmed one: about the same centre.
    fn arc_beside(&self, from: &Point, to: &Point) -> Arc {
        let center = self.element.turn.map_or([0.0; 2], |turn| turn.center.map(|counts| counts / COUNTS));
        self.arc_about(center, from, to, self.plan.sweep)
    }

    /// The arc about a corner, from one foot to the other, away from the tool's side.
    fn arc_round(&self, from: &Point, to: &Point, join: &Join, corner: Vector) -> Arc {
        let [first, second] = [0, 1].map(|place| join.places().get(place).copied().unwrap_or_default());
        let sweep = sweep_round(first, second, self.offset.radius);
        self.arc_about(corner.map(|counts| counts / COUNTS), from, to, sweep)
    }

    fn arc_about(&self, center: Vector, from: &Point, to: &Point, sweep: f64) -> Arc {
        let offset = self.offset;
        let spokes = [from, to].map(|end| less(in_plane(end, offset.axes), center));
        let radius = spokes.map(|spoke| libm::hypot(spoke[0], spoke[1]));
        // What differs by rounding alone is a circle, not a spiral.
        let is_circle = (radius[0] - radius[1]).abs() < NO_LENGTH;
        Arc {
            from: *from,
            to: *to,
            plane: offset.plane,
            axes: offset.axes,
            center,
            radius: if is_circle { [radius[0]; 2] } else { radius },
            start_angle: libm::atan2(spokes[0][1], spokes[0][0]),
            sweep,
        }
    }
}

/// Where an operation ends as programmed.
fn end_of(operation: &Operation) -> Option<&Point> {
    match &operation.act {
        Act::Rapid { to, .. } | Act::Line { to, .. } => Some(to),
        Act::Arc { arc, .. } => Some(&arc.to),
        _ => None,
    }
}

/// Writes a cut from here to there. On its own: made in the midst of others it would be built aside and copied.
#[inline(never)]
fn straight(shape: &mut Shape, from: &Point, to: &Point, feed: &Feed, last: bool) {
    *shape = Shape::Line { from: *from, to: *to, feed: Feed { exact_stop: feed.exact_stop && last, ..*feed } };
}

/// The shape from here to there; of a block in pieces only the last one ends exactly.
fn shape(operation: &Operation, arc: Option<Arc>, from: Point, to: Point, last: bool) -> Shape {
    let feed = match operation.act {
        Act::Line { feed, .. } | Act::Arc { feed, .. } => feed,
        // A corner in a positioning block is rounded at the rapid rate.
        _ => Feed { mm_per_min: f64::INFINITY, exact_stop: true, tapping: false, per_revolution: false, way_mm: 0.0 },
    };
    let feed = Feed { exact_stop: feed.exact_stop && last, ..feed };
    match (arc, operation.act) {
        (Some(arc), _) => Shape::Arc { arc, feed },
        (None, Act::Rapid { kind, .. }) => {
            Shape::Rapid { from, to, kind: if last { kind } else { RapidKind::Unchecked } }
        }
        (None, _) => Shape::Line { from, to, feed },
    }
}

/// A point with its axes of the plane at a programmed place (counts) and a vector beside it (mm).
fn placed(point: &Point, axes: [u8; 2], programmed: Vector, vector: Vector) -> Point {
    let mut placed = *point;
    for (index, axis) in axes.iter().enumerate() {
        placed[usize::from(*axis) % AXES] = programmed[index] / COUNTS + vector[index];
    }
    placed
}

/// A point with its axes of the plane left out.
fn beside_plane(point: &Point, axes: [u8; 2]) -> Point {
    placed(point, axes, [0.0; 2], [0.0; 2])
}
