//! What is seen at the machine: small values; text is made where they are shown.

use base::{Alarm, Place, Point, Seconds};
use dialect::GroupCodes;
use meaning::{CodeLine, CodeOut, Dwell, EndKind, SetValue, StopKind};
use motion::Pace;
use path::Arc;

use crate::signals::Signal;

/// What makes automatic operation stop so that it can go on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum StopCause {
    /// The program or a switch.
    Program(StopKind),
    /// FEED HOLD.
    FeedHold,
}

/// What resets the control.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ResetCause {
    /// The RESET key.
    Key,
    /// The function key of this number, where it resets.
    FunctionKey(u8),
    /// The end of the program, by the EOP input.
    ProgramEnd,
    /// Emergency stop.
    EmergencyStop,
}

/// One thing that happened.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Event {
    /// Virtual time since the start at which it ended.
    pub time: Seconds,
    /// The block it belongs to.
    pub place: Place,
    /// What happened.
    pub kind: EventKind,
}

/// What happened. Positions are mm and degrees in machine coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum EventKind {
    /// The program begins.
    Start(GroupCodes),
    /// A positioning move.
    Rapid {
        /// Where it began.
        from: Point,
        /// Where it ended.
        to: Point,
        /// How long it took.
        duration: Seconds,
        /// Its straight length.
        length: f64,
        /// How it ran.
        pace: Pace,
    },
    /// A straight cut.
    Feed {
        /// Where it began.
        from: Point,
        /// Where it ended.
        to: Point,
        /// Along the path, mm/min.
        feed: f64,
        /// How long it took.
        duration: Seconds,
        /// Its length.
        length: f64,
        /// How it ran.
        pace: Pace,
    },
    /// An arc or helix.
    Arc {
        /// Its geometry.
        arc: Arc,
        /// Along the path, mm/min.
        feed: f64,
        /// How long it took.
        duration: Seconds,
        /// Its length.
        length: f64,
        /// How it ran.
        pace: Pace,
    },
    /// A dwell.
    Dwell(Dwell),
    /// A code went out.
    Code(CodeOut),
    /// The machine has finished a code.
    Finished(CodeLine),
    /// A line between control and machine turned on or off.
    Signal(Signal, bool),
    /// Time passed in which nothing moved, waiting for the machine.
    Waited(Seconds),
    /// The program wrote a value.
    Set(SetValue),
    /// Automatic operation stopped and can go on.
    Stop(StopCause),
    /// The control refused a block and stopped.
    Alarm(Alarm),
    /// The control was reset.
    Reset {
        /// By what.
        cause: ResetCause,
        /// The codes in force after it.
        groups: GroupCodes,
    },
    /// The program ended.
    End {
        /// How.
        kind: EndKind,
        /// The program stands at its head again.
        rewind: bool,
        /// The control resets.
        reset: bool,
        /// The codes in force as the program left them.
        groups: GroupCodes,
        /// Where the axes are.
        to: Point,
    },
    /// A block was done.
    BlockDone,
}
