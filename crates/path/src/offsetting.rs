//! Blocks that run beside their programmed path: the control's buffer is looked into, compensation plans, and the plan
//! comes out piece by piece.

use base::{Alarm, Condition, Point};
use meaning::{Act, Barrier, Command, Element, Interpreter};

use crate::compensation::{Beside, Compensation, Edge, Fault, Join, Next, Rules, Vector, Which};
use crate::pieces::Pieces;
use crate::shape::Shaped;

/// Blocks without a way in the plane that the look ahead passes over; more of them make the tool stop.
const BRIDGED: u8 = 1;

/// What becomes of an operation.
pub(crate) enum Taken {
    /// It runs in pieces.
    Pieces,
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
    /// What was made of the way behind the one taken last.
    known: Option<Known>,
    /// The plan being carried out.
    pieces: Pieces,
}

/// A way that has been looked at, with its end and what follows it.
struct Known {
    block: u64,
    part: u8,
    way: Beside,
    end: Join,
    next: Next,
    /// Where what follows stands, counted from the way's own block.
    at: At,
}

/// A way in the buffer: its block's place, counted from the one being executed, and its number in the block.
#[derive(Clone, Copy, PartialEq, Debug)]
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
    pub fn take(&mut self, upstream: &mut Interpreter, position: &Point) -> Result<Taken, Barrier> {
        let operation = upstream.current();
        let is_move = matches!(operation.act, Act::Rapid { .. } | Act::Line { .. } | Act::Arc { .. });
        let block = operation.block;
        let Some(command) = upstream.executing().filter(|_| is_move) else {
            return Ok(Taken::AsItIs([0; 2], [0.0; 2]));
        };
        if self.block != block {
            (self.block, self.part) = (block, 0);
        }
        let offset = command.offset();
        let axes = offset.map_or(self.compensation.axes(), |offset| offset.axes);
        if command.drops_offset(axes) {
            self.compensation.drop_on(axes.map(|axis| command.drops_on(axis)));
            return Ok(self.as_it_is(axes));
        }
        let Some(element) = command.element(axes, self.part) else { return Ok(self.as_it_is(axes)) };
        let Some(offset) = offset else {
            self.compensation.cancel();
            return Ok(match element.turn {
                Some(_) => Taken::Refused(alarm_of(Fault::EndsByArc, command, axes, 0.0)),
                None => Taken::AsItIs(axes, [0.0; 2]),
            });
        };
        let part = self.part;
        let known = self.known.take().filter(|known| known.block == block && known.part == part);
        match known {
            Some(known) => self.run(upstream, position, element, &known.way, (known.next, known.at), Some(&known.end)),
            None => {
                let Some(edge) = Edge::new(&element) else { return Ok(self.as_it_is(axes)) };
                let next = look(upstream, At { index: 0, part, block }, axes)?;
                self.run(upstream, position, element, &Beside { edge, offset }, next, None)
            }
        }
    }

    /// Runs an element, if it and the next one can be.
    fn run(
        &mut self,
        upstream: &mut Interpreter,
        position: &Point,
        element: Element,
        now: &Beside,
        (next, at): (Next, At),
        end: Option<&Join>,
    ) -> Result<Taken, Barrier> {
        let policies = &upstream.fitting().policies;
        let (start, restart) = (policies.compensation_start, policies.compensation_restart);
        let rules = Rules { start, restart, table: upstream.control().functions.compensation };
        let axes = now.offset.axes;
        let (after, behind) = match next {
            Next::Element(_) => look(upstream, at, axes)?,
            _ => (Next::Unseen, at),
        };
        self.part += 1;
        let tool = now.offset.radius.abs();
        let plan = match self.compensation.plan(now, &next, end, &rules) {
            Ok(plan) => plan,
            Err((which, fault)) => {
                let index = if which == Which::This { 0 } else { at.index };
                self.compensation.pass(now);
                return refused(upstream, index, fault, axes, tool);
            }
        };
        if let Next::Element(way) = &next {
            match Compensation::look_past(now, &plan, way, &after, &rules) {
                Ok(end) => {
                    let at_next = At { index: behind.index - at.index, ..behind };
                    let seen = end.filter(|_| after != Next::Unseen);
                    self.known = seen.map(|end| Known {
                        block: at.block,
                        part: at.part,
                        way: *way,
                        end,
                        next: after,
                        at: at_next,
                    });
                }
                Err(fault) => {
                    self.compensation.pass(now);
                    return refused(upstream, at.index, fault, axes, tool);
                }
            }
        }
        let certain = !self.compensation.is_doubtful();
        self.compensation.take(now, &plan, &next);
        self.pieces.begin(element, now, &plan, certain, position);
        Ok(Taken::Pieces)
    }

    fn as_it_is(&self, axes: [u8; 2]) -> Taken {
        Taken::AsItIs(axes, self.compensation.vector())
    }
}

/// The refusal of what is found at fault in the block at a place of the buffer.
fn refused(upstream: &mut Interpreter, index: usize, fault: Fault, axes: [u8; 2], tool: f64) -> Result<Taken, Barrier> {
    let seen = upstream.look_ahead(index)?;
    Ok(seen.map_or(Taken::AsItIs(axes, [0.0; 2]), |command| Taken::Refused(alarm_of(fault, command, axes, tool))))
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
        Fault::LaterCut(depth) => (Condition::LaterPathCut, [depth, tool, 0.0]),
    };
    let spans = axes.map(|axis| command.axis_span(usize::from(axis)));
    let span = spans.into_iter().find(|span| *span != command.place.block).unwrap_or(command.place.block);
    Alarm::new(condition, command.place, span).with(values)
}
