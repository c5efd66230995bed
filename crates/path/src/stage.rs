//! The stage: one operation in, one shape out, moves of no length left out.

use base::{AXES, Alarm, AxisSet, Place, Point};
use meaning::{
    Act, Answer, Close, CodeOut, Dwell, Feed, Interpreter, Operation, Pull, RapidKind, SetValue, StaleBarrier,
};

use crate::arc::Arc;
use crate::compensation::{Compensation, Verdict};

/// What happens, with its geometry.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Shape {
    /// The program begins.
    Start(dialect::GroupCodes),
    /// A code goes out.
    Code(CodeOut),
    /// Positioning.
    Rapid {
        /// From here.
        from: Point,
        /// To there.
        to: Point,
        /// How it ends.
        kind: RapidKind,
    },
    /// A straight cut.
    Line {
        /// From here.
        from: Point,
        /// To there.
        to: Point,
        /// The feed along it.
        feed: Feed,
    },
    /// An arc.
    Arc {
        /// Its geometry.
        arc: Arc,
        /// The feed along the arc in its plane.
        feed: Feed,
    },
    /// Time passes.
    Dwell(Dwell),
    /// A value was written.
    Set(SetValue),
    /// The block is done.
    Close(Close),
    /// The block is refused.
    Alarm(Alarm),
}

/// A shape with where it comes from.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shaped {
    /// Which block it belongs to.
    pub block: u64,
    /// Where that block stands.
    pub place: Place,
    /// What happens.
    pub shape: Shape,
    /// A stop point of the single-block switch inside the block.
    pub stop_point: bool,
    /// False if an earlier refusal makes its place doubtful (only while checking on).
    pub certain: bool,
}

/// The stage that makes paths of operations.
pub struct Path {
    /// The stage before.
    pub upstream: Interpreter,
    position: Point,
    compensation: Compensation,
}

impl Path {
    /// The stage behind an interpreter, its axes standing at `position` (mm, degrees).
    pub fn new(upstream: Interpreter, position: Point) -> Path {
        Path { upstream, position, compensation: Compensation::default() }
    }

    /// The axes stand here, whatever was under way (mm, degrees).
    pub fn stand_at(&mut self, position: &Point) {
        self.position = *position;
        self.compensation = Compensation::default();
    }

    /// Answers the interpreter's open barrier.
    ///
    /// # Errors
    /// `id` is not that of the open barrier.
    pub fn resume(&mut self, id: u64, answer: Answer) -> Result<(), StaleBarrier> {
        self.upstream.resume(id, answer)
    }

    /// The next shape.
    #[expect(clippy::should_implement_trait, reason = "a pull has barriers, which an iterator does not")]
    pub fn next(&mut self) -> Pull<Shaped> {
        loop {
            let operation = match self.upstream.next() {
                Pull::Item(operation) => operation,
                Pull::Barrier(barrier) => return Pull::Barrier(barrier),
                Pull::End => return Pull::End,
            };
            if let Some(shaped) = self.shape(&operation) {
                return Pull::Item(shaped);
            }
        }
    }

    /// The operation's shape; `None` for a move of no length.
    fn shape(&mut self, operation: &Operation) -> Option<Shaped> {
        let from = self.position;
        let (shape, to) = match operation.act {
            Act::Start(groups) => (Shape::Start(groups), None),
            Act::Code(code) => (Shape::Code(code), None),
            Act::Dwell(dwell) => (Shape::Dwell(dwell), None),
            Act::Set(value) => (Shape::Set(value), None),
            Act::Close(close) => (Shape::Close(close), None),
            Act::Alarm(alarm) => (Shape::Alarm(alarm), None),
            Act::Rapid { to, kind } => (Shape::Rapid { from, to, kind }, Some(to)),
            Act::Line { to, feed } => (Shape::Line { from, to, feed }, Some(to)),
            Act::Arc { arc, feed } => (Shape::Arc { arc: Arc::new(&from, &arc), feed }, Some(arc.to)),
        };
        let Operation { block, place, stop_point, .. } = *operation;
        let mut shaped = Shaped { block, place, shape, stop_point, certain: true };
        let Some(to) = to else { return Some(shaped) };
        let moving = match &shaped.shape {
            Shape::Arc { arc, .. } => AxisSet::only(usize::from(arc.axes[0])).or(AxisSet::only(usize::from(arc.axes[1]))),
            _ => differing(&from, &to),
        };
        if moving.is_empty() {
            return None;
        }
        match self.compensation.judge(operation.side, moving, operation.plane, &place) {
            Verdict::Pass => {}
            Verdict::Uncertain => shaped.certain = false,
            Verdict::Refuse(alarm) => {
                shaped.shape = Shape::Alarm(alarm);
                return Some(shaped);
            }
        }
        self.position = to;
        Some(shaped)
    }
}

/// The axes on which two points differ.
fn differing(a: &Point, b: &Point) -> AxisSet {
    let mut axes = AxisSet::NONE;
    for axis in 0..AXES {
        if a[axis] != b[axis] {
            axes.add(axis);
        }
    }
    axes
}
