//! Blocks that run beside their programmed path: the control's buffer is looked into, compensation plans, and the plan
//! comes out piece by piece.

use base::{Alarm, Condition, Point};
use meaning::{Act, Barrier, Command, Element, Interpreter};

use crate::compensation::{Beside, Compensation, Edge, Fault, Join, Next, Rules, Vector, Which};
use crate::pieces::{Carried, Pieces};
use crate::shape::Shaped;

/// Blocks without a way in the plane that the look ahead passes over; more of them make the tool stop.
const BRIDGED: u8 = 1;

/// What becomes of an operation.
pub(crate) enum Taken {
    /// Its first piece has been written.
    Piece,
    /// It has no length.
    Nothing,
    /// It runs as it is, the plane's axes beside their programmed place by a vector.
    AsItIs([u8; 2], Vector),
    /// Its block is refused.
    Refused(Alarm),
}

/// The part of the stage that runs beside the path.
#[derive(Default)]
pub(crate) struct Offsetting {
    compensation: Compensation,
    /// The block whose ways are counted, and how many of them have been taken.
    block: u64,
    part: u8,
    /// What is known of a way: the one behind that taken last, if `is_known`.
    ahead: Ahead,
    is_known: bool,
    /// The plan being carried out.
    pieces: Pieces,
}

/// A way with what follows it.
#[derive(Default)]
struct Ahead {
    block: u64,
    part: u8,
    way: Beside,
    /// Its end, if it is known.
    end: Join,
    next: Next,
    /// Where what follows stands, counted from the way's own block.
    at: At,
}

/// A way in the buffer: its block's place, counted from the one being executed, and its number in the block.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
struct At {
    index: usize,
    part: u8,
    block: u64,
}

impl Offsetting {
    /// True if the tool stands, or may stand, beside its programmed place.
    #[inline]
    pub fn is_on(&self) -> bool {
        self.compensation.is_on()
    }

    /// True if where the tool stands is uncertain: a block was refused, and checking goes on.
    pub fn is_doubtful(&self) -> bool {
        self.compensation.is_doubtful()
    }

    /// Writes the next piece of the plan under way; false if there is none.
    #[inline]
    pub fn next_piece(&mut self, upstream: &Interpreter, position: &mut Point, shaped: &mut Shaped) -> bool {
        self.pieces.is_open() && self.pieces.next(upstream.current(), position, shaped)
    }

    /// Takes the interpreter's operation.
    ///
    /// # Errors
    /// The buffer cannot be looked into before a barrier is answered; the same operation is to be taken again then.
    pub fn take(
        &mut self,
        upstream: &mut Interpreter,
        position: &mut Point,
        shaped: &mut Shaped,
    ) -> Result<Taken, Barrier> {
        let operation = upstream.current();
        let is_move = matches!(operation.act, Act::Rapid { .. } | Act::Line { .. } | Act::Arc { .. });
        let block = operation.block;
        let Some(command) = upstream.executing().filter(|_| is_move) else {
            return Ok(Taken::AsItIs([0; 2], [0.0; 2]));
        };
        if self.block != block {
            (self.block, self.part) = (block, 0);
        }
        let part = self.part;
        let offset = command.offset();
        let axes = offset.map_or(self.compensation.axes(), |offset| offset.axes);
        if command.drops_offset(axes) {
            self.compensation.drop_on(axes.map(|axis| command.drops_on(axis)));
            return Ok(self.as_it_is(axes));
        }
        let Some(element) = command.element(axes, part) else { return Ok(self.as_it_is(axes)) };
        let Some(offset) = offset else {
            self.compensation.cancel();
            return Ok(match element.turn {
                Some(_) => Taken::Refused(alarm_of(Fault::EndsByArc, command, axes, 0.0)),
                None => Taken::AsItIs(axes, [0.0; 2]),
            });
        };
        if !self.is_known || (self.ahead.block, self.ahead.part) != (block, part) {
            self.is_known = false;
            let Some(edge) = Edge::new(&element) else { return Ok(self.as_it_is(axes)) };
            (self.ahead.next, self.ahead.at) = look(upstream, At { index: 0, part, block }, axes)?;
            self.ahead.way = Beside { edge, offset };
        }
        let (after, behind) = match self.ahead.next {
            Next::Element(_) => look(upstream, self.ahead.at, axes)?,
            _ => (Next::Unseen, self.ahead.at),
        };
        self.part += 1;
        match self.run(upstream, &element, (&after, behind), position, shaped) {
            Ok(true) => Ok(Taken::Piece),
            Ok(false) => Ok(Taken::Nothing),
            Err((index, fault)) => {
                let radius = self.ahead.way.offset.radius.abs();
                self.compensation.pass(&self.ahead.way);
                self.is_known = false;
                let command = upstream.look_ahead(index)?;
                Ok(command.map_or(Taken::Nothing, |command| Taken::Refused(alarm_of(fault, command, axes, radius))))
            }
        }
    }

    /// Runs the way at hand, if it and the next one can be run; false if it has no length.
    ///
    /// # Errors
    /// The place in the buffer of the block that is at fault.
    fn run(
        &mut self,
        upstream: &Interpreter,
        element: &Element,
        (after, behind): (&Next, At),
        position: &mut Point,
        shaped: &mut Shaped,
    ) -> Result<bool, (usize, Fault)> {
        let Offsetting { compensation, ahead, is_known, pieces, .. } = self;
        let policies = &upstream.fitting().policies;
        let rules = Rules {
            start: policies.compensation_start,
            restart: policies.compensation_restart,
            cut: policies.compensation_cut,
            table: upstream.control().functions.compensation,
        };
        let Ahead { way, end, next, at, .. } = ahead;
        let place = |(which, fault)| match which {
            Which::This => (0, fault),
            Which::Next => (at.index, fault),
            Which::After => (behind.index, fault),
        };
        let plan = compensation.plan(way, next, is_known.then_some(&*end), &rules).map_err(place)?;
        compensation.look_about(way, &plan, (next, after), &rules).map_err(place)?;
        let end_of_next = match next {
            Next::Element(next) => {
                Compensation::look_past(way, &plan, next, after, &rules).map_err(|fault| (at.index, fault))?
            }
            _ => None,
        };
        let certain = !compensation.is_doubtful();
        compensation.take(way, &plan, next);
        let from = *position;
        let carried = Carried { element, edge: &way.edge, offset: &way.offset, plan: &plan, from: &from, certain };
        let has_length = pieces.begin(&carried, upstream.current(), position, shaped);
        // The way behind it is the next one's turn.
        *is_known = false;
        if let (Next::Element(beside), Some(end_of_next), true) = (*next, end_of_next, *after != Next::Unseen) {
            (ahead.block, ahead.part) = (at.block, at.part);
            *at = At { index: behind.index - at.index, ..behind };
            (*way, *end, *next) = (beside, end_of_next, *after);
            *is_known = true;
        }
        Ok(has_length)
    }

    fn as_it_is(&self, axes: [u8; 2]) -> Taken {
        Taken::AsItIs(axes, self.compensation.vector())
    }
}

/// What follows a way in the buffer, and where that stands.
fn look(upstream: &mut Interpreter, way: At, axes: [u8; 2]) -> Result<(Next, At), Barrier> {
    let mut at = way;
    let mut still = 0;
    let mut parts = upstream.look_ahead(at.index)?.map_or(1, Command::parts);
    loop {
        (at.index, at.part) = if at.part + 1 < parts { (at.index, at.part + 1) } else { (at.index + 1, 0) };
        let Some(command) = upstream.look_ahead(at.index)?.filter(|command| !command.is_refused()) else {
            return Ok((Next::Unseen, at));
        };
        at.block = command.block;
        parts = command.parts();
        if command.drops_offset(axes) {
            return Ok((Next::Ends, at));
        }
        let edge = command.element(axes, at.part).and_then(|element| Edge::new(&element));
        match (edge, command.offset()) {
            (Some(edge), Some(offset)) => return Ok((Next::Element(Beside { edge, offset }), at)),
            (Some(_), None) => return Ok((Next::Ends, at)),
            (None, _) if at.part > 0 => {}
            (None, _) => {
                still += 1;
                if still > BRIDGED {
                    return Ok((Next::Unseen, at));
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
        Fault::Cut(depth) => (Condition::ElementCut, [depth, tool, 0.0]),
    };
    let spans = axes.map(|axis| command.axis_span(usize::from(axis)));
    let span = spans.into_iter().find(|span| *span != command.place.block).unwrap_or(command.place.block);
    Alarm::new(condition, command.place, span).with(values)
}
