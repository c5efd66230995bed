//! The way in which every stage hands on what it made, and asks for what it lacks.

use base::{Point, SourceId};

use crate::program::ProgramKey;

/// What a stage has next.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Pull<T> {
    /// A piece of work.
    Item(T),
    /// Nothing until this is answered.
    Barrier(Barrier),
    /// Nothing more.
    End,
}

/// A question that must be answered before anything more can come.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Barrier {
    /// Goes back with the answer; answers to earlier questions are refused.
    pub id: u64,
    /// What is asked.
    pub kind: BarrierKind,
}

/// What an interpreter can ask for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BarrierKind {
    /// The bytes of a source from an offset on, at most so many.
    NeedBytes {
        /// Which text.
        source: SourceId,
        /// From which byte.
        offset: u64,
        /// At most so many bytes.
        len: usize,
    },
    /// A program from outside the texts that are open.
    NeedProgram {
        /// Which one.
        program: ProgramKey,
    },
    /// Something that a macro reads of the machine.
    NeedValue(Quantity),
    /// Where a move that waits for the skip signal has ended.
    SkipPosition,
    /// CYCLE START after a program stop.
    CycleStart,
    /// Whether the main program, which asks to be run again, shall be.
    RunAgain,
}

/// What a macro can read of the machine.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Quantity {
    /// The interface inputs UI0 to UI31 as bits of a number.
    Inputs,
    /// Seconds since power-on.
    Clock,
    /// Where an axis stands, mm or degrees in machine coordinates.
    Position(u8),
    /// How far an axis is behind its command, mm or degrees.
    Deviation(u8),
}

impl Quantity {
    /// True if motion must have ended before it can be read.
    pub(crate) const fn waits_for_motion(self) -> bool {
        matches!(self, Quantity::Position(_) | Quantity::Deviation(_))
    }
}

/// The answer to a barrier.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Answer<'a> {
    /// Bytes of a source; `last` says that it ends with them.
    Bytes(&'a [u8], bool),
    /// The source in which the program stands.
    Program(SourceId),
    /// The source that is the program, and its name.
    File(SourceId, &'a str),
    /// There is no such program or text.
    NotFound,
    /// What a macro reads.
    Value(f64),
    /// Where the axes stand, mm and degrees in machine coordinates, and whether the skip signal brought them there.
    Stands(Point, bool),
    /// Go on.
    Continue,
    /// Do not go on.
    Stop,
}

/// An answer to a question that is no longer open.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct StaleBarrier;

impl std::fmt::Display for StaleBarrier {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("the question this answers is no longer open")
    }
}

impl std::error::Error for StaleBarrier {}
