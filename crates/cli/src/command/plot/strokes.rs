//! Moves as strokes of the picture, and what they run beside.

use base::{Alarm, Condition, Point};
use machine::{EventKind, MachineFile};
use meaning::{Command, Element, Offset};
use path::{Corner, Part, Programmed, RunBeside};
use plot::{Arc, Drawing, Kind, Layer, Plane, Stroke};
use station::Session;

use crate::arguments::LayerArgument;
use crate::texts::Texts;

/// The layer that an argument names.
pub fn layer(argument: LayerArgument) -> Layer {
    match argument {
        LayerArgument::Programmed => Layer::Programmed,
        LayerArgument::Compensated => Layer::Compensated,
        LayerArgument::Tool => Layer::Tool,
        LayerArgument::Speed => Layer::Speed,
        LayerArgument::Actual => Layer::Actual,
    }
}

/// What makes strokes of a machine's moves.
pub struct Strokes<'m> {
    machine: &'m MachineFile,
    /// The indices of X, Y and Z.
    axes: [Option<usize>; 3],
}

impl<'m> Strokes<'m> {
    pub fn new(machine: &'m MachineFile) -> Strokes<'m> {
        let axes = [b'X', b'Y', b'Z'].map(|letter| machine.axes.iter().position(|axis| axis.letter == letter));
        Strokes { machine, axes }
    }

    /// X, Y and Z of a point.
    pub fn at(&self, point: &Point) -> [f64; 3] {
        self.axes.map(|axis| axis.map_or(0.0, |axis| point[axis]))
    }

    /// The stroke of an event, if it moves the tool.
    pub fn of_event(&self, event: &EventKind, tool: u32) -> Option<Stroke> {
        Some(match event {
            EventKind::Rapid { from, to, .. } => {
                Stroke { kind: Kind::Rapid, from: self.at(from), to: self.at(to), arc: None, feed: 0.0, tool }
            }
            EventKind::Feed { from, to, feed, .. } => {
                Stroke { kind: Kind::Feed, from: self.at(from), to: self.at(to), arc: None, feed: *feed, tool }
            }
            EventKind::Arc { arc, feed, .. } => Stroke { feed: *feed, tool, ..self.of_arc(arc) },
            _ => return None,
        })
    }

    fn of_arc(&self, arc: &path::Arc) -> Stroke {
        let shape = Arc { plane: plane_of(arc.plane), center: arc.center, sweep_deg: arc.sweep.to_degrees() };
        // A fourth axis has no place in the picture: where it turns with one of the three, those go straight.
        let letters = arc.axes.map(|axis| self.machine.axes.get(usize::from(axis)).map(|axis| axis.letter));
        let shape = (letters == arc.plane.letters().map(Some)).then_some(shape);
        Stroke { kind: Kind::Feed, from: self.at(&arc.from), to: self.at(&arc.to), arc: shape, feed: 0.0, tool: 0 }
    }

    fn of_way(&self, way: &Programmed, kind: Kind) -> Stroke {
        match way {
            Programmed::Line(from, to) => {
                Stroke { kind, from: self.at(from), to: self.at(to), arc: None, feed: 0.0, tool: 0 }
            }
            Programmed::Arc(arc) => Stroke { kind, ..self.of_arc(arc) },
        }
    }

    /// Draws what a move runs beside; true if that is the programmed way of its block.
    pub fn beside(
        &self,
        drawing: &mut Drawing,
        beside: Option<&RunBeside>,
        event: &EventKind,
        stroke: &Stroke,
    ) -> bool {
        let Some(beside) = beside else { return false };
        drawing.swept(stroke, plane_of(beside.plane), beside.radius.abs());
        let (from, to) = match event {
            EventKind::Rapid { from, to, .. } | EventKind::Feed { from, to, .. } => (from, to),
            EventKind::Arc { arc, .. } => (&arc.from, &arc.to),
            _ => return false,
        };
        let way = beside.programmed(from, to);
        way.inspect(|way| drawing.programmed(&self.of_way(way, stroke.kind))).is_some()
    }

    /// The programmed ways of a block under compensation; the tool stands here.
    pub fn ways_of(&self, command: &Command, stands: &Point) -> impl Iterator<Item = Stroke> {
        let parts = command.offset().map_or(0, |_| command.parts());
        (0..parts).filter_map(move |part| {
            let Offset { radius, plane, axes, .. } = command.offset()?;
            let mut way = Element::default();
            let way = command.element(axes, part, &mut way).then_some(way);
            let beside = RunBeside { part: Part::Along, radius, corner: Corner::None, way, plane, axes };
            beside.programmed(stands, stands).map(|way| self.of_way(&way, Kind::Feed))
        })
    }

    /// Draws what the tool does not fit beside, and the contour that the control has read about it.
    pub fn refused(&self, drawing: &mut Drawing, session: &mut Session<Texts>, alarm: &Alarm) {
        let Some(beside) = session.beside().copied() else { return };
        let (beside, stands) = (&beside, &session.position());
        let mut index = 0;
        while let Ok(Some(command)) = session.interpreter_mut().look_ahead(index) {
            self.ways_of(command, stands).for_each(|way| drawing.refused_among(&way));
            index += 1;
        }
        let Some(way) = beside.programmed(stands, stands) else { return };
        let touches = match alarm.condition {
            Condition::InnerArcTooSmall | Condition::CompensatedPathReversed => way.touched(beside, 0.5),
            Condition::CompensatedPathsApart | Condition::CompensatedCircleOpen => way.touched(beside, 0.0),
            _ => *stands,
        };
        let stroke = self.of_way(&way, Kind::Feed);
        drawing.refused(&stroke, plane_of(beside.plane), self.at(&touches), beside.radius.abs());
    }
}

fn plane_of(plane: meaning::Plane) -> Plane {
    match plane {
        meaning::Plane::Xy => Plane::Xy,
        meaning::Plane::Zx => Plane::Zx,
        meaning::Plane::Yz => Plane::Yz,
    }
}
