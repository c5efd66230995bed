//! A move in the plane of tool radius compensation, as the rules about it look at it.

use base::{AXES, Place, Point};
use meaning::{Element, Interpreter};
use path::plane::{Vector, cross, distance, dot, in_plane, length, less};
use path::{Arc, Corner, Curve, Extent, Part, RunBeside, Turn};

/// A count in mm.
const MM: f64 = 1e-6;
/// A path that runs beside its element by the tool's radius is taken for one up to this part of it.
const EXACTNESS: f64 = 1e-7;

/// A move of a block that runs beside its path, or that ends running so. It is written where it stays, piece by piece:
/// made elsewhere and copied it costs more than all that is done with it.
#[derive(Clone, Copy, Default)]
pub(crate) struct Way {
    pub place: Place,
    /// Blocks counted from the program's start.
    pub block: u64,
    /// Where the tool's centre goes.
    pub centre: Track,
    /// The programmed way beside which it goes, and whether there is one that is to be kept: not that of the block which
    /// leads to the contour, nor that of the block which leads away.
    pub element: Track,
    pub has_element: bool,
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
    /// How it cuts into its own element and the last one is said by another rule.
    pub claimed: bool,
    /// It begins where the tool stopped without having seen its element.
    pub blind: bool,
}

/// From here to there, and how it turns, if it is an arc. That stands elsewhere: most ways are lines, and what is touched
/// with every move is to be small.
#[derive(Clone, Copy, Default)]
pub(crate) struct Track {
    pub ends: [Vector; 2],
    pub is_arc: bool,
}

/// How the centre's track and the element turn, where they do.
pub(crate) type Turns = [Turn; 2];

impl Way {
    /// Where the tool's centre goes.
    #[inline]
    pub fn centre(&self, turns: &Turns) -> Curve {
        self.centre.curve(&turns[0])
    }

    /// The programmed way, if it is one that is to be kept.
    #[inline]
    pub fn element(&self, turns: &Turns) -> Option<Curve> {
        self.has_element.then(|| self.element.curve(&turns[1]))
    }

    /// True if the tool stands beside its element's beginning by its radius, but not square to it: square to the element
    /// before, as it does where no next one is seen. Within `least` mm.
    #[inline]
    pub fn begins_blind(&self, turns: &Turns, least: f64) -> bool {
        if self.beside {
            return false;
        }
        let Some(element) = self.element(turns) else { return false };
        let out = less(self.centre.ends[0], element.from);
        let [begins, _] = element.directions();
        (length(out) - self.radius).abs() <= least && dot(out, begins).abs() > least * length(begins)
    }
}

impl Track {
    /// Both together.
    #[inline]
    pub fn curve(&self, turn: &Turn) -> Curve {
        let [from, to] = self.ends;
        Curve { from, to, turn: self.is_arc.then_some(*turn) }
    }

    /// Takes a curve.
    pub fn take(&mut self, curve: &Curve, turn: &mut Turn) {
        self.ends = [curve.from, curve.to];
        self.is_arc = curve.turn.is_some();
        *turn = curve.turn.unwrap_or_default();
    }

    #[inline]
    pub fn extent(&self, turn: &Turn) -> Extent {
        if self.is_arc { self.curve(turn).extent() } else { Extent::of_line(self.ends) }
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

    /// Writes a move as the rules look at it; false without compensation.
    #[inline]
    pub fn write(
        &mut self,
        (way, turns): (&mut Way, &mut Turns),
        place: &Place,
        (from, to, arc): (&Point, &Point, Option<&Arc>),
        beside: Option<&RunBeside>,
        interpreter: &Interpreter,
    ) -> bool {
        if !self.is_on() || beside.is_some_and(|beside| beside.part == Part::Start) {
            self.axes = beside.map(|beside| beside.axes);
        }
        let Some(axes) = self.axes else { return false };
        let command = interpreter.executing().unwrap_or_else(|| interpreter.done()[0]);
        way.place = *place;
        way.block = command.block;
        way.axes = axes;
        let centre = [in_plane(from, axes), in_plane(to, axes)];
        (way.centre.ends, way.centre.is_arc) = (centre, false);
        if let Some(arc) = arc.filter(|arc| arc.axes == axes) {
            way.centre.take(&Curve::arc(arc), &mut turns[0]);
        }
        let mut moved = 0_u32;
        for axis in 0..AXES {
            moved |= u32::from(from[axis] != to[axis]) << axis;
        }
        way.level = moved & !axes.iter().fold(0, |set, &axis| set | 1_u32.wrapping_shl(u32::from(axis))) == 0;
        way.has_element = false;
        way.beside = false;
        way.leaves = false;
        let Some(beside) = beside.filter(|beside| beside.part != Part::Cancel) else {
            let runs_free = || command.offset().is_none() || command.drops_offset(axes);
            way.leaves = centre[0] != centre[1] && runs_free();
            (way.part, way.radius, way.left, way.corner) = (None, 0.0, false, Corner::None);
            return true;
        };
        let radius = beside.radius;
        (way.part, way.radius, way.left, way.corner) = (Some(beside.part), radius.abs(), radius > 0.0, beside.corner);
        if beside.part != Part::Along {
            return true;
        }
        match &beside.way {
            Some(Element { from, to, turn: None }) => {
                let element = [[from[0] * MM, from[1] * MM], [to[0] * MM, to[1] * MM]];
                (way.element.ends, way.element.is_arc, way.has_element) = (element, false, true);
                // Not read again from where it was just written: that takes longer than to compare it.
                way.beside = !way.centre.is_arc && is_line_beside(centre, element, radius);
            }
            Some(_) => {
                if let Some(programmed) = beside.programmed(from, to) {
                    way.element.take(&Curve::programmed(&programmed, axes), &mut turns[1]);
                    way.has_element = true;
                    way.beside = way.centre.is_arc && is_arc_beside(&turns[0], &turns[1], radius);
                }
            }
            None => {}
        }
        true
    }

    /// Compensation runs no more, or nobody knows how.
    pub fn end(&mut self) {
        self.axes = None;
    }
}

/// True if the centre's line is the element's at the tool's radius, the same way.
#[inline]
fn is_line_beside(centre: [Vector; 2], element: [Vector; 2], radius: f64) -> bool {
    let way = less(element[1], element[0]);
    let square = dot(way, way);
    let wanted = radius * radius * square;
    let is_beside = |end: Vector| {
        let out = cross(way, less(end, element[0]));
        out * radius > 0.0 && (out * out - wanted).abs() <= EXACTNESS * wanted
    };
    is_beside(centre[0]) && is_beside(centre[1]) && dot(way, less(centre[1], centre[0])) > 0.0
}

/// True if the centre's arc is the element's at the tool's radius, the same way.
fn is_arc_beside(centre: &Turn, element: &Turn, radius: f64) -> bool {
    let wanted = element.radius - radius.copysign(radius * element.sweep);
    let apart = distance(centre.center, element.center).max((centre.radius - wanted).abs());
    let exactness = EXACTNESS * radius.abs() + centre.slack + element.slack;
    apart <= exactness && centre.sweep * element.sweep > 0.0
}
