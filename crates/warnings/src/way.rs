//! A move in the plane of tool radius compensation, as the rules about it look at it.

use base::{AXES, Place, Point};
use meaning::Interpreter;
use path::{Arc, Corner, Part, RunBeside};

use crate::curve::{Curve, Vector, cross, distance, dot, in_plane, length, less};

/// A count in mm.
const MM: f64 = 1e-6;
/// A path that runs beside its element by the tool's radius is taken for one up to this part of it.
const EXACTNESS: f64 = 1e-7;

/// A move of a block that runs beside its path, or that ends running so.
#[derive(Clone, Copy)]
pub(crate) struct Way<'w> {
    pub place: Place,
    /// Blocks counted from the program's start.
    pub block: u64,
    /// Where the tool's centre goes.
    pub centre: Curve,
    /// The programmed way beside which it goes, if it is one that is to be kept: not that of the block which leads to
    /// the contour, nor that of the block which leads away.
    pub element: Option<Curve>,
    /// `None`: it does not run beside a path any more.
    pub part: Option<Part>,
    /// The tool's radius, mm.
    pub radius: f64,
    /// The tool is left of the path.
    pub left: bool,
    /// The corner at the element's end.
    pub corner: Corner,
    /// The plane's axes.
    pub axes: [u8; 2],
    /// With it compensation ends, for a time or for good.
    pub leaves: bool,
    /// No axis beside the plane's moves.
    pub level: bool,
    /// Its centre runs beside its element from end to end.
    pub beside: bool,
    pub interpreter: &'w Interpreter,
}

impl Way<'_> {
    /// True if the tool stands beside its element's beginning by its radius, but not square to it: square to the element
    /// before, as it does where no next one is seen. Within `least` mm.
    pub fn begins_blind(&self, least: f64) -> bool {
        let Some(element) = self.element.as_ref().filter(|_| !self.beside) else { return false };
        let out = less(self.centre.from, element.from);
        let [begins, _] = element.directions();
        (length(out) - self.radius).abs() <= least && dot(out, begins).abs() > least * length(begins)
    }
}

/// What is kept of a stretch of compensation.
#[derive(Clone, Copy, Default)]
pub(crate) struct Stretch {
    /// The plane's axes, while compensation runs.
    axes: Option<[u8; 2]>,
}

impl Stretch {
    /// True while compensation runs.
    pub fn is_on(&self) -> bool {
        self.axes.is_some()
    }

    /// A move as the rules look at it; `None` without compensation.
    pub fn way<'w>(
        &mut self,
        place: &Place,
        (from, to, arc): (&Point, &Point, Option<&Arc>),
        beside: Option<&RunBeside>,
        interpreter: &'w Interpreter,
    ) -> Option<Way<'w>> {
        let command = interpreter.executing().unwrap_or(interpreter.done()[0]);
        if !self.is_on() || beside.is_some_and(|beside| beside.part == Part::Start) {
            self.axes = beside.map(|beside| beside.axes);
        }
        let axes = self.axes?;
        let centre = match arc {
            Some(arc) if arc.axes == axes => Curve::arc(arc),
            _ => Curve::line(in_plane(from, axes), in_plane(to, axes)),
        };
        let mut moved = 0_u32;
        for axis in 0..AXES {
            moved |= u32::from(from[axis] != to[axis]) << axis;
        }
        let level = moved & !axes.iter().fold(0, |set, &axis| set | 1_u32.wrapping_shl(u32::from(axis))) == 0;
        let beside = beside.filter(|beside| beside.part != Part::Cancel);
        let runs_free = || command.offset().is_none() || command.drops_offset(axes);
        let leaves = beside.is_none() && centre.from != centre.to && runs_free();
        let radius = beside.map_or(0.0, |beside| beside.radius);
        let part = beside.map(|beside| beside.part);
        let element = match beside.and_then(|beside| beside.way.map(|way| (beside, way))) {
            Some((_, way)) if part == Some(Part::Along) && way.turn.is_none() => {
                let [from, to] = [way.from, way.to].map(|end| end.map(|counts| counts * MM));
                Some(Curve::line(from, to))
            }
            Some((beside, _)) if part == Some(Part::Along) => {
                beside.programmed(from, to).map(|way| Curve::programmed(&way, axes))
            }
            _ => None,
        };
        Some(Way {
            place: *place,
            block: command.block,
            centre,
            element,
            part,
            radius: radius.abs(),
            left: radius > 0.0,
            corner: beside.map_or(Corner::None, |beside| beside.corner),
            axes,
            leaves,
            level,
            beside: element.is_some_and(|element| runs_beside(&centre, &element, radius)),
            interpreter,
        })
    }

    /// Compensation runs no more, or nobody knows how.
    pub fn end(&mut self) {
        self.axes = None;
    }
}

/// True if the centre's path is the element's at the tool's radius, the same way.
fn runs_beside(centre: &Curve, element: &Curve, radius: f64) -> bool {
    match (&centre.turn, &element.turn) {
        (None, None) => {
            let way = less(element.to, element.from);
            let square = dot(way, way);
            let wanted = radius * radius * square;
            let is_beside = |end: Vector| {
                let out = cross(way, less(end, element.from));
                out * radius > 0.0 && (out * out - wanted).abs() <= EXACTNESS * wanted
            };
            is_beside(centre.from) && is_beside(centre.to) && dot(way, less(centre.to, centre.from)) > 0.0
        }
        (Some(centre), Some(element)) => {
            let wanted = element.radius - radius.copysign(radius * element.sweep);
            let apart = distance(centre.center, element.center).max((centre.radius - wanted).abs());
            let exactness = EXACTNESS * radius.abs() + centre.slack + element.slack;
            apart <= exactness && centre.sweep * element.sweep > 0.0
        }
        _ => false,
    }
}
