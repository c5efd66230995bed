//! The stage: one operation in, its shapes out, moves of no length left out.

use base::Point;
use meaning::{Act, Answer, Close, Dwell, Interpreter, Operation, Pull, StaleBarrier};

use crate::arc::Arc;
use crate::displacement::{Displacement, Pending};
use crate::offsetting::{Offsetting, Taken};
use crate::shape::{Shape, Shaped};

/// The stage that makes paths of operations.
#[derive(Clone)]
pub struct Path {
    /// The stage before.
    pub upstream: Interpreter,
    position: Point,
    offsetting: Offsetting,
    displacement: Displacement,
    /// Of the shape handed out last the beginning has been made already.
    is_rest: bool,
    /// The operation pulled last is not worked off: a question had to be answered first.
    held: bool,
    /// The operation pulled last closes its block, and no shape has done so yet.
    open: bool,
    /// The shape handed out last.
    shaped: Shaped,
}

impl Path {
    /// The stage behind an interpreter, its axes standing at `position` (mm, degrees).
    pub fn new(upstream: Interpreter, position: Point) -> Path {
        Path {
            upstream,
            position,
            offsetting: Offsetting::default(),
            displacement: Displacement::default(),
            is_rest: false,
            held: false,
            open: false,
            shaped: Shaped::default(),
        }
    }

    /// The axes stand here, whatever was under way (mm, degrees).
    pub fn stand_at(&mut self, position: &Point) {
        self.position = *position;
        self.displacement = Displacement::default();
        self.offsetting = Offsetting::default();
        self.held = false;
        self.open = false;
    }

    /// The programmed place of a tool that stands at `position` (mm, degrees), behind a block that is done.
    pub fn programmed(&self, position: &Point) -> Point {
        if !self.offsetting.is_on() {
            return *position;
        }
        let (axes, vector) = self.offsetting.vector();
        moved(*position, (axes, vector.map(|way| -way)))
    }

    /// Answers the interpreter's open barrier.
    ///
    /// # Errors
    /// `id` is not that of the open barrier.
    pub fn resume(&mut self, id: u64, answer: Answer) -> Result<(), StaleBarrier> {
        self.upstream.resume(id, answer)?;
        if let Answer::Stands(at, _) = answer {
            self.position = at;
            self.displacement = Displacement::default();
        }
        Ok(())
    }

    /// An axis is moved by hand, by `way` mm or degrees, while the program is stopped: before the shape handed out last
    /// if that is `pulled` and not executed. The rest of a move leads to the move's end, or beside it by as much.
    pub fn displace(&mut self, axis: usize, way: f64, pulled: bool, to_the_end: bool) {
        let pending = match (pulled, self.is_rest) {
            (false, _) => Pending::Nothing,
            (true, false) => Pending::Whole,
            (true, true) if to_the_end => Pending::RestToTheEnd,
            (true, true) => Pending::RestBeside,
        };
        self.displacement.add(axis, way, pending, &mut self.shaped, self.upstream.executing());
    }

    /// True if axes stand beside the places where the program counts them.
    pub fn is_displaced(&self) -> bool {
        self.displacement.acts()
    }

    /// Of the current move nothing is left but the rest, from a point on it.
    pub fn keep_rest(&mut self, at: &Point) {
        self.shaped.shape = self.shaped.shape.from_there(at);
        self.is_rest = true;
    }

    /// True if of the current move nothing is left but the rest.
    pub fn is_rest(&self) -> bool {
        self.is_rest
    }

    /// Of the current dwell nothing is left but this share.
    pub fn keep_share(&mut self, share: f64) {
        match &mut self.shaped.shape {
            Shape::Dwell(Dwell::Seconds(seconds)) => *seconds *= share,
            Shape::Dwell(Dwell::Revolutions { turns, .. }) => *turns *= share,
            _ => {}
        }
    }

    /// The next shape. It stays as it is until the next call.
    #[expect(clippy::should_implement_trait, reason = "a pull has barriers, which an iterator does not")]
    #[inline]
    pub fn next(&mut self) -> Pull<&Shaped> {
        self.is_rest = false;
        match self.pull() {
            Pull::Item(()) => {
                if self.displacement.acts() {
                    self.displacement.apply(&mut self.shaped, self.upstream.executing());
                }
                Pull::Item(&self.shaped)
            }
            Pull::Barrier(barrier) => Pull::Barrier(barrier),
            Pull::End => Pull::End,
        }
    }

    fn pull(&mut self) -> Pull<()> {
        let Path { upstream, position, offsetting, displacement, held, open, shaped, .. } = self;
        loop {
            if offsetting.next_piece(upstream, position, shaped) {
                *open &= !shaped.closes;
                return Pull::Item(());
            }
            if std::mem::take(open) {
                close(upstream.current(), offsetting, shaped);
                return Pull::Item(());
            }
            if !std::mem::take(held) {
                match upstream.next() {
                    Pull::Item(_) => {}
                    Pull::Barrier(barrier) => return Pull::Barrier(barrier),
                    Pull::End => return Pull::End,
                }
            }
            let mut taken = Taken::AsItIs;
            if upstream.current().compensated || offsetting.is_on() {
                match offsetting.take(upstream, position, shaped) {
                    Ok(Taken::Piece) => {
                        *open = upstream.current().closes && !shaped.closes;
                        return Pull::Item(());
                    }
                    Ok(Taken::Nothing) => {
                        *open = upstream.current().closes;
                        continue;
                    }
                    Ok(other) => taken = other,
                    Err(barrier) => {
                        *held = true;
                        return Pull::Barrier(barrier);
                    }
                }
            }
            if matches!(upstream.current().act, Act::Start(_)) {
                offsetting.begin_program();
            }
            let is_shape = shape(upstream.current(), offsetting, position, shaped);
            *open = shaped.closes;
            if taken == Taken::Refused
                && let Some(alarm) = offsetting.take_alarm()
            {
                (shaped.shape, shaped.closes) = (Shape::Alarm(alarm), false);
                shaped.beside = offsetting.take_beside();
                return Pull::Item(());
            }
            if taken == Taken::LeadsBack {
                shaped.beside = offsetting.take_beside();
            }
            let is_led_back = |command| shaped.shape.is_move() && displacement.is_led_back(command);
            if is_shape || displacement.acts() && upstream.executing().is_some_and(is_led_back) {
                *open = false;
                return Pull::Item(());
            }
        }
    }

    /// The shape handed out last.
    pub fn current(&self) -> &Shaped {
        &self.shaped
    }
}

/// Writes the operation's shape; false for a move of no length.
fn shape(operation: &Operation, offsetting: &Offsetting, position: &mut Point, shaped: &mut Shaped) -> bool {
    let from = *position;
    let beside = |to: Point| if offsetting.is_on() { moved(to, offsetting.vector()) } else { to };
    let to = match operation.act {
        Act::Rapid { to, kind } => {
            let to = beside(to);
            shaped.shape = Shape::Rapid { from, to, kind };
            to
        }
        Act::Line { to, feed } => {
            let to = beside(to);
            shaped.shape = Shape::Line { from, to, feed };
            to
        }
        Act::Arc { arc, feed } => {
            shaped.shape = Shape::Arc { arc: Arc::new(&from, &arc), feed };
            arc.to
        }
        Act::Start(groups) => {
            shaped.shape = Shape::Start(groups);
            from
        }
        Act::Code(code) => {
            shaped.shape = Shape::Code(code);
            from
        }
        Act::Dwell(dwell) => {
            shaped.shape = Shape::Dwell(dwell);
            from
        }
        Act::Set(value) => {
            shaped.shape = Shape::Set(value);
            from
        }
        Act::Await(stop) => {
            shaped.shape = Shape::Await(stop);
            from
        }
        Act::Close(close) => {
            shaped.shape = Shape::Close(close);
            from
        }
        Act::Alarm(alarm) => {
            shaped.shape = Shape::Alarm(alarm);
            from
        }
    };
    finish(operation, offsetting, shaped);
    let moves = match &shaped.shape {
        Shape::Arc { .. } => true,
        Shape::Rapid { .. } | Shape::Line { .. } => from != to,
        _ => return true,
    };
    *position = to;
    moves || operation.from_unknown
}

/// Writes what a shape has beside itself.
fn finish(operation: &Operation, offsetting: &Offsetting, shaped: &mut Shaped) {
    shaped.block = operation.block;
    shaped.place = operation.place;
    shaped.stop_point = operation.stop_point;
    shaped.closes = operation.closes;
    shaped.until_signal = operation.until_signal;
    shaped.stroke_check = operation.stroke_check;
    shaped.certain = !offsetting.is_doubtful();
    shaped.beside = None;
}

/// Closes the block of an operation that does so but left nothing to run at its end.
#[cold]
fn close(operation: &Operation, offsetting: &Offsetting, shaped: &mut Shaped) {
    finish(operation, offsetting, shaped);
    (shaped.shape, shaped.closes) = (Shape::Close(Close::Next), false);
}

/// A point moved in the plane of two axes.
fn moved(mut point: Point, (axes, vector): ([u8; 2], [f64; 2])) -> Point {
    for (axis, way) in axes.iter().zip(vector) {
        if let Some(place) = point.get_mut(usize::from(*axis)) {
            *place += way;
        }
    }
    point
}
