//! Axes that were moved by hand while the program was stopped: they stand beside the place where it counts them.
//!
//! Until it is led back, an axis makes its programmed way beside its place. A straight move leads it back if its block
//! names the axis' place (absolutely, or as a level of a cycle, or as the reference point); an arc never does.

use base::{AXES, AxisSet, Point};
use meaning::{Command, Leads};

use crate::shape::{Shape, Shaped};

/// What of the current shape is still to be made.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Pending {
    /// Nothing: the next one follows.
    Nothing,
    /// All of it.
    Whole,
    /// The rest of a move, beside its way.
    RestBeside,
    /// The rest of a move, to its end.
    RestToTheEnd,
}

/// By how much the axes stand beside the places where the program counts them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Displacement {
    /// mm, degrees.
    by: Point,
    acts: bool,
    /// The block in which they were moved.
    block: u64,
}

impl Default for Displacement {
    fn default() -> Self {
        Displacement { by: [0.0; AXES], acts: false, block: 0 }
    }
}

impl Displacement {
    /// True if some axis stands beside its place.
    #[inline]
    pub fn acts(&self) -> bool {
        self.acts
    }

    /// Where axes really are that the program counts to be here.
    pub fn real(&self, mut counted: Point) -> Point {
        for (at, by) in counted.iter_mut().zip(&self.by) {
            *at += by;
        }
        counted
    }

    /// True if the block leads an axis back, even where the program counts it to be there already.
    pub fn is_led_back(&self, command: &Command) -> bool {
        (0..AXES).any(|axis| self.by[axis] != 0.0 && command.leads(axis) == Leads::ToThePlace)
    }

    /// The axes that a straight move of the block leads to their places.
    fn led_back(&self, shaped: &Shaped, command: &Command, [from, to]: [&Point; 2]) -> AxisSet {
        let mut back = AxisSet::NONE;
        for axis in 0..AXES {
            let moves = from[axis] != to[axis];
            let is_led = match command.leads(axis) {
                _ if command.returned.has(axis) => !shaped.stop_point,
                Leads::ToThePlace => true,
                Leads::ToTheLevel => moves,
                // What is left of a cycle leads to places that it has worked out before.
                Leads::Along => moves && self.block == shaped.block && command.levels().is_some(),
            };
            if is_led {
                back.add(axis);
            }
        }
        back
    }

    fn settle(&mut self, axes: AxisSet) {
        for axis in axes.iter() {
            self.by[axis] = 0.0;
        }
        self.acts = self.by.iter().any(|&by| by != 0.0);
    }

    /// A shape as the program counts it becomes what the axes make of it.
    #[cold]
    pub fn apply(&mut self, shaped: &mut Shaped, command: Option<&Command>) {
        let before = *self;
        if let (Some([from, to]), Some(command)) = (straight(&shaped.shape), command) {
            self.settle(before.led_back(shaped, command, [&from, &to]));
        }
        match &mut shaped.shape {
            Shape::Rapid { from, to, .. } | Shape::Line { from, to, .. } => {
                (*from, *to) = (before.real(*from), self.real(*to));
            }
            shape => beside(shape, &self.by),
        }
    }

    /// An axis is moved by hand; what is left of the current shape goes on from there.
    pub fn add(&mut self, axis: usize, way: f64, pending: Pending, shaped: &mut Shaped, command: Option<&Command>) {
        let ends = straight(&shaped.shape);
        let keeps_end = match (pending, ends, command) {
            (Pending::Whole, Some([from, to]), Some(command)) => self.led_back(shaped, command, [&from, &to]).has(axis),
            (Pending::RestToTheEnd, Some(_), _) => true,
            (Pending::RestBeside, Some(_), Some(command)) => command.returned.has(axis) && !shaped.stop_point,
            _ => false,
        };
        let mut by = [0.0; AXES];
        if let Some(by) = by.get_mut(axis) {
            *by = way;
        }
        match &mut shaped.shape {
            _ if pending == Pending::Nothing => {}
            Shape::Rapid { from, to, .. } | Shape::Line { from, to, .. } => {
                from[axis] += way;
                to[axis] += if keeps_end { 0.0 } else { way };
            }
            shape => beside(shape, &by),
        }
        if !keeps_end {
            self.by[axis] += way;
            self.acts = self.by.iter().any(|&by| by != 0.0);
            self.block = shaped.block;
        }
    }
}

/// The ends of a straight move.
fn straight(shape: &Shape) -> Option<[Point; 2]> {
    match shape {
        Shape::Rapid { from, to, .. } | Shape::Line { from, to, .. } => Some([*from, *to]),
        _ => None,
    }
}

/// An arc is made beside its place.
fn beside(shape: &mut Shape, by: &Point) {
    let Shape::Arc { arc, .. } = shape else { return };
    for axis in 0..AXES {
        arc.from[axis] += by[axis];
        arc.to[axis] += by[axis];
    }
    for (center, axis) in arc.center.iter_mut().zip(arc.axes) {
        *center += by.get(usize::from(axis)).copied().unwrap_or(0.0);
    }
}
