//! Blocks that run beside their programmed path: the control's buffer is looked into, compensation plans, and the plan
//! comes out piece by piece.

use base::{Alarm, Condition, Point};
use meaning::{Act, Barrier, Command, Element, Interpreter, Operation};

use crate::compensation::{Beside, Compensation, Edge, Fault, Next, Rules, Which};
use crate::pieces::Pieces;
use crate::shape::Shaped;

/// Blocks without a way in the plane that the look ahead passes over; more of them make the tool stop.
const BRIDGED: u8 = 1;

/// The part of the stage that runs beside the path.
#[derive(Default)]
pub(crate) struct Offsetting {
    compensation: Compensation,
    /// The block whose ways are counted, and how many of them have been taken.
    block: u64,
    part: u8,
    /// The plan being carried out.
    pieces: Pieces,
}

impl Offsetting {
    /// True if the tool stands, or may stand, beside its programmed place.
    #[inline]
    pub fn is_on(&self) -> bool {
        self.compensation.is_on()
    }

    /// Writes the next piece of the plan under way; false if there is none.
    #[inline]
    pub fn next_piece(&mut self, position: &mut Point, shaped: &mut Shaped) -> bool {
        self.pieces.is_open() && self.pieces.next(position, shaped)
    }

    /// Takes the interpreter's operation: into pieces, or as an operation that runs as it is.
    ///
    /// # Errors
    /// The buffer cannot be looked into before a barrier is answered; the same operation is to be taken again then.
    pub fn take(&mut self, upstream: &mut Interpreter, position: &Point) -> Result<Option<Operation>, Barrier> {
        let operation = *upstream.current();
        let is_move = matches!(operation.act, Act::Rapid { .. } | Act::Line { .. } | Act::Arc { .. });
        let Some(command) = upstream.executing().filter(|_| is_move) else { return Ok(Some(operation)) };
        if self.block != operation.block {
            (self.block, self.part) = (operation.block, 0);
        }
        let offset = command.offset();
        let axes = offset.map_or(self.compensation.axes(), |offset| offset.axes);
        if command.drops_offset(axes) {
            self.compensation.drop_on(axes.map(|axis| command.drops_on(axis)));
            return Ok(Some(self.shifted(operation, axes)));
        }
        let Some(element) = command.element(axes, self.part) else {
            return Ok(Some(self.shifted(operation, axes)));
        };
        let Some(offset) = offset else {
            let by_arc = element.turn.is_some().then(|| alarm_of(Fault::EndsByArc, command, axes, 0.0));
            self.compensation.cancel();
            let act = by_arc.map_or(operation.act, Act::Alarm);
            return Ok(Some(Operation { act, ..operation }));
        };
        match Edge::new(&element) {
            Some(edge) => self.plan(upstream, position, operation, element, Beside { edge, offset }),
            None => Ok(Some(self.shifted(operation, axes))),
        }
    }

    fn plan(
        &mut self,
        upstream: &mut Interpreter,
        position: &Point,
        operation: Operation,
        element: Element,
        now: Beside,
    ) -> Result<Option<Operation>, Barrier> {
        let axes = now.offset.axes;
        let (next, at) = look(upstream, (0, self.part), axes)?;
        let after = match next {
            Next::Element(_) => look(upstream, at, axes)?.0,
            _ => Next::Unseen,
        };
        let policies = &upstream.fitting().policies;
        let rules = Rules {
            start: policies.compensation_start,
            restart: policies.compensation_restart,
            table: upstream.control().functions.compensation,
        };
        let certain = !self.compensation.is_doubtful();
        let planned = self.compensation.plan(&now, &next, &after, &rules);
        self.part += 1;
        let (which, fault) = match planned {
            Ok(plan) => {
                self.pieces = Pieces::new(operation, element, now, plan, certain, position);
                return Ok(None);
            }
            Err(refused) => refused,
        };
        let index = if which == Which::This { 0 } else { at.0 };
        let seen = upstream.look_ahead(index)?;
        let Some(command) = seen else { return Ok(Some(operation)) };
        let alarm = alarm_of(fault, command, axes, now.offset.radius.abs());
        self.compensation.pass(&now);
        Ok(Some(Operation { act: Act::Alarm(alarm), ..operation }))
    }

    /// The operation with the tool beside its programmed place as it is.
    fn shifted(&self, mut operation: Operation, axes: [u8; 2]) -> Operation {
        if let Act::Rapid { to, .. } | Act::Line { to, .. } = &mut operation.act {
            for (axis, way) in axes.iter().zip(self.compensation.vector()) {
                if let Some(place) = to.get_mut(usize::from(*axis)) {
                    *place += way;
                }
            }
        }
        operation
    }

    /// Marks a shape that runs as it is.
    pub fn note(&self, shaped: &mut Shaped) {
        shaped.certain = !self.compensation.is_doubtful();
    }
}

/// What follows a way (by its block's place in the buffer and its number in the block), and where that stands.
fn look(upstream: &mut Interpreter, way: (usize, u8), axes: [u8; 2]) -> Result<(Next, (usize, u8)), Barrier> {
    let (mut index, mut part) = way;
    let mut still = 0;
    loop {
        let parts = upstream.look_ahead(index)?.map_or(1, Command::parts);
        (index, part) = if part + 1 < parts { (index, part + 1) } else { (index + 1, 0) };
        let Some(command) = upstream.look_ahead(index)?.filter(|command| !command.is_refused()) else {
            return Ok((Next::Unseen, (index, part)));
        };
        if command.drops_offset(axes) {
            return Ok((Next::Ends, (index, part)));
        }
        let edge = command.element(axes, part).and_then(|element| Edge::new(&element));
        match (edge, command.offset()) {
            (Some(edge), Some(offset)) => return Ok((Next::Element(Beside { edge, offset }), (index, part))),
            (Some(_), None) => return Ok((Next::Ends, (index, part))),
            (None, _) if part > 0 => {}
            (None, _) => {
                still += 1;
                if still > BRIDGED {
                    return Ok((Next::Unseen, (index, part)));
                }
            }
        }
    }
}

/// The alarm about a block's element; the tool's radius in mm.
#[cold]
fn alarm_of(fault: Fault, command: &Command, axes: [u8; 2], tool: f64) -> Alarm {
    let (condition, values) = match fault {
        Fault::StartsByArc => (Condition::ArcStartsCompensation, [0.0; 3]),
        Fault::EndsByArc => (Condition::ArcEndsCompensation, [0.0; 3]),
        Fault::InnerArc(radius) => (Condition::InnerArcTooSmall, [radius, tool, 0.0]),
        Fault::Reversed(way) => (Condition::CompensatedPathReversed, [way, tool, 0.0]),
        Fault::Open(gap) => (Condition::CompensatedCircleOpen, [gap, tool, 0.0]),
        Fault::Apart => (Condition::CompensatedPathsApart, [tool, 0.0, 0.0]),
        Fault::LaterCut(depth) => (Condition::LaterPathCut, [depth, tool, 0.0]),
    };
    let spans = axes.map(|axis| command.axis_span(usize::from(axis)));
    let span = spans.into_iter().find(|span| *span != command.place.block).unwrap_or(command.place.block);
    Alarm::new(condition, command.place, span).with(values)
}
