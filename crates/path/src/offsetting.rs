//! Blocks that run beside their programmed path: the control's buffer is looked into, compensation plans, and the plan
//! comes out piece by piece.

use base::{Alarm, Condition, Point};
use meaning::{Act, Barrier, Command, Element, Interpreter, Offset};

use crate::compensation::{Beside, Compensation, Corner, Fault, Join, Next, NextKind, Plan, Rules, Which};
use crate::pieces::{Carried, Pieces};
use crate::plane::{NONE, Vector};
use crate::shape::{Part, RunBeside, Shaped};

/// Blocks without a way in the plane that the look ahead passes over; more of them make the tool stop.
const BRIDGED: u8 = 1;

/// What becomes of an operation.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Taken {
    /// Its first piece has been written.
    Piece,
    /// It has no length.
    Nothing,
    /// It runs as it is, beside its programmed place by the tool's vector.
    AsItIs,
    /// It leads from beside the path to its programmed end.
    LeadsBack,
    /// Its block is refused.
    Refused,
}

/// The part of the stage that runs beside the path.
#[derive(Clone, Default)]
pub(crate) struct Offsetting {
    compensation: Compensation,
    /// The block whose ways are counted, and how many of them have been taken.
    block: u64,
    part: u8,
    /// The way being run, the next one and the one behind that, in turn; `now` is the place of the first. They stay in
    /// their places: to move them would cost more than the geometry.
    ways: [Way; 3],
    now: usize,
    /// The plan being carried out.
    plan: Plan,
    pieces: Pieces,
    /// The refusal.
    alarm: Option<Alarm>,
    /// How the way back to the path follows from that, or the way that the tool does not fit beside.
    beside: Option<RunBeside>,
}

/// A way in the buffer.
#[derive(Clone, Default)]
struct Way {
    /// Its shape, or why there is none.
    next: Next,
    element: Element,
    at: At,
    /// Its end, if that has been made with the way behind it.
    end: Join,
    is_ended: bool,
}

/// Where a way stands: its block's place in the buffer, counted from the one being executed, and its number in the block.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
struct At {
    index: usize,
    part: u8,
    /// Ways of its block.
    parts: u8,
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

    /// A program begins: its blocks are counted anew, and none of them has been run.
    pub fn begin_program(&mut self) {
        (self.block, self.part) = (u64::MAX, 0);
        self.ways.iter_mut().for_each(|way| way.is_ended = false);
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
        let Some(command) = upstream.executing().filter(|_| is_move) else { return Ok(Taken::AsItIs) };
        if self.block != block {
            (self.block, self.part) = (block, 0);
        }
        let part = self.part;
        let offset = command.offset();
        let axes = offset.map_or(self.compensation.axes(), |offset| offset.axes);
        if command.drops_offset(axes) {
            self.compensation.drop_on(axes.map(|axis| command.drops_on(axis)));
            return Ok(Taken::AsItIs);
        }
        let (now, ..) = self.three();
        let is_known = now.is_ended && (now.at.block, now.at.part) == (block, part) && offset.is_some();
        let mut element = Element::default();
        if !is_known && !command.element(axes, part, &mut element) {
            return Ok(Taken::AsItIs);
        }
        let Some(offset) = offset else {
            let stood_beside = self.compensation.vector() != NONE;
            self.compensation.cancel();
            if element.turn.is_none() {
                if !stood_beside {
                    return Ok(Taken::AsItIs);
                }
                let (.., last) = self.three();
                let Offset { radius, plane, .. } = last.next.beside.offset;
                let (part, corner) = (Part::Cancel, Corner::None);
                self.beside = Some(RunBeside { part, radius, corner, way: Some(element), plane, axes });
                return Ok(Taken::LeadsBack);
            }
            self.alarm = Some(alarm_of(Fault::EndsByArc, command, axes, 0.0));
            return Ok(Taken::Refused);
        };
        let (now, next, after) = self.three();
        if is_known {
            // Its block has come to the front meanwhile.
            next.at.index = next.at.index.saturating_sub(now.at.index);
            now.at.index = 0;
        } else {
            now.is_ended = false;
            now.at = At { index: 0, part, parts: command.parts(), block };
            if !now.next.beside.edge.take(&element) {
                return Ok(Taken::AsItIs);
            }
            (now.element, now.next.beside.offset) = (element, offset);
            look(upstream, &now.at, axes, next)?;
        }
        after.next.kind = NextKind::Unseen;
        if next.next.kind == NextKind::Element {
            look(upstream, &next.at, axes, after)?;
        }
        self.part += 1;
        match self.run(upstream, position, shaped) {
            Ok(true) => Ok(Taken::Piece),
            Ok(false) => Ok(Taken::Nothing),
            Err((at, fault)) => {
                let (now, ..) = self.three();
                now.is_ended = false;
                let refused = now.next.beside;
                let Offset { radius, plane, .. } = refused.offset;
                self.compensation.pass(&refused);
                if let Some(command) = upstream.look_ahead(at.index)? {
                    let way = command.element(axes, at.part, &mut element).then_some(element);
                    self.alarm = Some(alarm_of(fault, command, axes, radius.abs()));
                    let (part, corner) = (Part::Along, Corner::None);
                    self.beside = Some(RunBeside { part, radius, corner, way, plane, axes });
                }
                Ok(Taken::Refused)
            }
        }
    }

    /// The way being run, the next one and the one behind that.
    #[inline]
    fn three(&mut self) -> (&mut Way, &mut Way, &mut Way) {
        let [a, b, c] = &mut self.ways;
        in_turn(self.now, (a, b, c))
    }

    /// Runs the way at hand, if it and the next one can be run; false if it has no length.
    ///
    /// # Errors
    /// The place in the buffer of the way that is at fault.
    fn run(&mut self, upstream: &Interpreter, position: &mut Point, shaped: &mut Shaped) -> Result<bool, (At, Fault)> {
        let Offsetting { compensation, ways: [a, b, c], now: turn, plan, pieces, .. } = self;
        let (now, next, after) = in_turn(*turn, (a, b, c));
        let policies = &upstream.fitting().policies;
        let rules = Rules {
            start: policies.compensation_start,
            restart: policies.compensation_restart,
            cut: policies.compensation_cut,
            table: upstream.control().functions.compensation,
        };
        let (this, place_of_next, behind) = (now.at, next.at, after.at);
        let place = |(which, fault)| match which {
            Which::This => (this, fault),
            Which::Next => (place_of_next, fault),
            Which::After => (behind, fault),
        };
        let way = &now.next.beside;
        compensation.plan(way, &next.next, (now.is_ended, &mut now.end), &rules, plan).map_err(place)?;
        compensation.look_about(way, plan, &now.end, (&next.next, &after.next), &rules).map_err(place)?;
        next.is_ended = false;
        if let Some(beside) = next.next.element() {
            let fits = Compensation::look_past(way, &now.end, beside, &after.next, &rules, &mut next.end);
            next.is_ended = fits.map_err(|fault| place((Which::Next, fault)))? && after.next.kind != NextKind::Unseen;
        }
        let certain = !compensation.is_doubtful();
        compensation.take(way, plan, &now.end, &next.next);
        let from = *position;
        let Beside { edge, offset } = way;
        let element = &now.element;
        let carried = Carried { element, edge, offset, plan, end: &now.end, from: &from, certain };
        let has_length = pieces.begin(&carried, upstream.current(), position, shaped);
        // The next one's turn.
        now.is_ended = false;
        *turn = (*turn + 1) % 3;
        Ok(has_length)
    }

    /// By which the tool stands beside its programmed place, along two axes.
    pub fn vector(&self) -> ([u8; 2], Vector) {
        (self.compensation.axes(), self.compensation.vector())
    }

    /// The refusal of the operation taken last.
    pub fn take_alarm(&mut self) -> Option<Alarm> {
        self.alarm.take()
    }

    /// How the way back to the path, or the way that is refused, follows from the programmed one.
    pub fn take_beside(&mut self) -> Option<RunBeside> {
        self.beside.take()
    }
}

/// Three things, the one at `turn` first.
#[inline]
fn in_turn<T>(turn: usize, (a, b, c): (T, T, T)) -> (T, T, T) {
    match turn {
        0 => (a, b, c),
        1 => (b, c, a),
        _ => (c, a, b),
    }
}

/// Finds what follows a way in the buffer.
fn look(upstream: &mut Interpreter, way: &At, axes: [u8; 2], found: &mut Way) -> Result<(), Barrier> {
    let Way { next, element, at, .. } = found;
    let mut still = 0;
    *at = *way;
    next.kind = NextKind::Unseen;
    loop {
        (at.index, at.part) = if at.part + 1 < at.parts { (at.index, at.part + 1) } else { (at.index + 1, 0) };
        let Some(command) = upstream.look_ahead(at.index)?.filter(|command| !command.is_refused()) else {
            return Ok(());
        };
        at.block = command.block;
        at.parts = command.parts();
        if command.drops_offset(axes) {
            next.kind = NextKind::Ends;
            return Ok(());
        }
        if command.element(axes, at.part, element) && next.beside.edge.take(element) {
            next.kind = NextKind::Ends;
            if let Some(offset) = command.offset() {
                (next.kind, next.beside.offset) = (NextKind::Element, offset);
            }
            return Ok(());
        }
        if at.part == 0 {
            still += 1;
            if still > BRIDGED {
                return Ok(());
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
        Fault::Overlaps(way) => (Condition::CompensatedCircleOverlaps, [way, tool, 0.0]),
        Fault::Open(gap) => (Condition::CompensatedCircleOpen, [gap, tool, 0.0]),
        Fault::Apart => (Condition::CompensatedPathsApart, [tool, 0.0, 0.0]),
        Fault::Cut(depth) => (Condition::ElementCut, [depth, tool, 0.0]),
    };
    let spans = axes.map(|axis| command.axis_span(usize::from(axis)));
    let span = spans.into_iter().find(|span| *span != command.place.block).unwrap_or(command.place.block);
    Alarm::new(condition, command.place, span).with(values)
}
