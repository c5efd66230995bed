//! The stage: one operation in, one shape out, moves of no length left out.

use base::{AXES, Alarm, AxisSet, Place, Point};
use meaning::{
    Act, Answer, Close, CodeOut, Dwell, Feed, Interpreter, Operation, Pull, RapidKind, SetValue, StaleBarrier, StopKind,
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
    /// The machine answers every code that is out; then a stop, if there is one.
    Await(Option<StopKind>),
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
    /// The move ends where the skip signal comes.
    pub until_signal: bool,
    /// The second stored stroke area is checked.
    pub stroke_check: bool,
    /// False if an earlier refusal makes its place doubtful (only while checking on).
    pub certain: bool,
}

impl Default for Shaped {
    /// The end of no block.
    fn default() -> Self {
        let shape = Shape::Close(Close::Next);
        Shaped {
            block: 0,
            place: Place::default(),
            shape,
            stop_point: false,
            until_signal: false,
            stroke_check: false,
            certain: true,
        }
    }
}

/// The stage that makes paths of operations.
pub struct Path {
    /// The stage before.
    pub upstream: Interpreter,
    position: Point,
    compensation: Compensation,
    /// Where the axes are is doubtful: a move was refused, and checking goes on.
    doubtful: bool,
    /// The shape handed out last.
    shaped: Shaped,
}

impl Path {
    /// The stage behind an interpreter, its axes standing at `position` (mm, degrees).
    pub fn new(upstream: Interpreter, position: Point) -> Path {
        Path { upstream, position, compensation: Compensation::default(), doubtful: false, shaped: Shaped::default() }
    }

    /// The axes stand here, whatever was under way (mm, degrees).
    pub fn stand_at(&mut self, position: &Point) {
        self.position = *position;
        self.compensation = Compensation::default();
        self.doubtful = false;
    }

    /// Answers the interpreter's open barrier.
    ///
    /// # Errors
    /// `id` is not that of the open barrier.
    pub fn resume(&mut self, id: u64, answer: Answer) -> Result<(), StaleBarrier> {
        self.upstream.resume(id, answer)?;
        if let Answer::Stands(at, _) = answer {
            self.position = at;
        }
        Ok(())
    }

    /// The next shape. It stays as it is until the next call.
    #[expect(clippy::should_implement_trait, reason = "a pull has barriers, which an iterator does not")]
    pub fn next(&mut self) -> Pull<&Shaped> {
        let Path { upstream, position, compensation, doubtful, shaped } = self;
        loop {
            let operation = match upstream.next() {
                Pull::Item(operation) => operation,
                Pull::Barrier(barrier) => return Pull::Barrier(barrier),
                Pull::End => return Pull::End,
            };
            if shape(operation, position, compensation, doubtful, shaped) {
                return Pull::Item(shaped);
            }
        }
    }

    /// The shape handed out last.
    pub fn current(&self) -> &Shaped {
        &self.shaped
    }
}

/// Writes the operation's shape; false for a move of no length.
fn shape(
    operation: &Operation,
    position: &mut Point,
    compensation: &mut Compensation,
    doubtful: &mut bool,
    shaped: &mut Shaped,
) -> bool {
    let from = *position;
    let to = match operation.act {
        Act::Rapid { to, kind } => {
            shaped.shape = Shape::Rapid { from, to, kind };
            to
        }
        Act::Line { to, feed } => {
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
    shaped.block = operation.block;
    shaped.place = operation.place;
    shaped.stop_point = operation.stop_point;
    shaped.until_signal = operation.until_signal;
    shaped.stroke_check = operation.stroke_check;
    shaped.certain = true;
    let moving = match &shaped.shape {
        Shape::Arc { arc, .. } => AxisSet::only(usize::from(arc.axes[0])).or(AxisSet::only(usize::from(arc.axes[1]))),
        Shape::Rapid { .. } | Shape::Line { .. } => differing(&from, &to),
        _ => return true,
    };
    if moving.is_empty() && !operation.from_unknown && !*doubtful {
        return false;
    }
    match compensation.judge(operation.side, moving, operation.plane, &operation.place) {
        Verdict::Pass => *doubtful = false,
        Verdict::Uncertain => {
            shaped.certain = false;
            *doubtful = true;
        }
        Verdict::Refuse(alarm) => {
            *doubtful = true;
            // Checking on, later moves begin where the program believes to be.
            *position = to;
            shaped.shape = Shape::Alarm(alarm);
            return true;
        }
    }
    *position = to;
    true
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
