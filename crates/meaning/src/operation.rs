//! What the control does next: small values, each with its place in the program.

use base::{Alarm, AxisSet, Place, Point};
use dialect::GroupCodes;

/// A plane of arcs and compensation, by its axes' letters in their order.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Plane {
    /// X, Y; third axis Z.
    #[default]
    Xy,
    /// Z, X; third axis Y.
    Zx,
    /// Y, Z; third axis X.
    Yz,
}

impl Plane {
    /// The letters of the two axes.
    pub const fn letters(self) -> [u8; 2] {
        match self {
            Plane::Xy => [b'X', b'Y'],
            Plane::Zx => [b'Z', b'X'],
            Plane::Yz => [b'Y', b'Z'],
        }
    }

    /// The letters of the words that give an arc's centre along those axes.
    pub const fn centre_letters(self) -> [u8; 2] {
        match self {
            Plane::Xy => [b'I', b'J'],
            Plane::Zx => [b'K', b'I'],
            Plane::Yz => [b'J', b'K'],
        }
    }
}

/// On which side of the path the tool runs.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Side {
    /// On the path itself.
    #[default]
    Off,
    /// Left of it.
    Left,
    /// Right of it.
    Right,
}

/// How a positioning move ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum RapidKind {
    /// With the in-position check.
    Checked,
    /// Without it: the next block may begin while the axes still follow.
    Unchecked,
}

/// The feed of a cutting move.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Feed {
    /// Along the path (of an arc: along the arc in its plane), mm/min, as commanded; infinite is the rapid rate.
    pub mm_per_min: f64,
    /// True if the block ends with a stop and an in-position check (G09, G61).
    pub exact_stop: bool,
    /// True in tapping: override 100 %, feed hold deferred.
    pub tapping: bool,
    /// True if it follows the spindle: the speed that was commanded is counted in, the spindle override is not.
    pub per_revolution: bool,
    /// The length of the way along which it counts, mm, where that is not the way of the axes; 0 otherwise.
    pub way_mm: f64,
}

/// An arc, in its plane; every other axis moves in step with the angle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ArcMove {
    /// Where all axes are at its end, mm or degrees, machine coordinates.
    pub to: Point,
    /// Its plane.
    pub plane: Plane,
    /// The two axes of the plane.
    pub axes: [u8; 2],
    /// The centre along those axes, mm, machine coordinates.
    pub center: [f64; 2],
    /// True if it turns clockwise seen from the + end of the third axis.
    pub clockwise: bool,
    /// True if it is a full circle (start and end are one point).
    pub full_circle: bool,
}

/// How long a dwell lasts.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Dwell {
    /// So many seconds.
    Seconds(f64),
    /// So many turns of the spindle, which is to turn at this speed.
    Revolutions {
        /// How many.
        turns: f64,
        /// rev/min, above zero.
        rpm: f64,
    },
}

impl Dwell {
    /// How long it lasts, s.
    pub fn seconds(self) -> f64 {
        match self {
            Dwell::Seconds(seconds) => seconds,
            Dwell::Revolutions { turns, rpm } => turns * 60.0 / rpm,
        }
    }
}

/// The lines that carry a code to the machine.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum CodeLine {
    /// Miscellaneous.
    M,
    /// Spindle.
    S,
    /// Tool.
    T,
    /// Index table.
    B,
}

impl CodeLine {
    /// The letter of its words.
    pub const fn letter(self) -> char {
        match self {
            CodeLine::M => 'M',
            CodeLine::S => 'S',
            CodeLine::T => 'T',
            CodeLine::B => 'B',
        }
    }

    /// Its place where something is kept for each line: M, S, T, B.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// A code as it is written: `M08`, `T01`, `S1000`, `B90`.
    pub fn word(self, code: u32) -> String {
        match self {
            CodeLine::M | CodeLine::T => format!("{}{code:02}", self.letter()),
            CodeLine::S | CodeLine::B => format!("{}{code}", self.letter()),
        }
    }
}

/// A code that goes out to the machine.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct CodeOut {
    /// On which lines.
    pub line: CodeLine,
    /// Its number.
    pub code: u32,
    /// Digits on the lines.
    pub digits: u8,
    /// True if the block's motion has ended when it goes out.
    pub after_motion: bool,
}

/// A value that the program wrote.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum SetValue {
    /// A macro variable.
    Variable {
        /// Its number.
        number: u32,
        /// Its value; a blank is [`crate::BLANK`].
        value: f64,
    },
    /// A tool radius, where radii have a column of their own.
    Radius {
        /// Its number.
        number: u32,
        /// Its value, mm.
        value: f64,
    },
    /// A shift of every work system: of this G row, or (`None`) the external one; mm or degrees on the named axes.
    Shift {
        /// Row of the G code that shifts.
        code: Option<u8>,
        /// The axes written.
        axes: AxisSet,
        /// By how much it shifts now.
        shift: Point,
    },
    /// A tool offset; a length where radii have a column of their own.
    Offset {
        /// Its number.
        number: u32,
        /// Its value, mm.
        value: f64,
    },
    /// The origin of a work system, by its G row; mm or degrees on the named axes.
    WorkOrigin {
        /// Row of the system's G code.
        system: u8,
        /// The axes written.
        axes: AxisSet,
        /// Machine coordinates of the origin.
        origin: Point,
    },
    /// The UNIVERSAL position display.
    Universal {
        /// The axes written.
        axes: AxisSet,
        /// What it now shows.
        shown: Point,
    },
    /// The second stored stroke area.
    StrokeArea(StrokeArea),
}

/// A box of machine coordinates, mm.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct StrokeArea {
    /// The axes along which it extends.
    pub axes: AxisSet,
    /// Lower faces.
    pub low: Point,
    /// Upper faces.
    pub high: Point,
    /// True if the axes must stay within it, false if they must stay out.
    pub outside: bool,
}

/// Why automatic operation stops and can go on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum StopKind {
    /// M00.
    Program,
    /// M01 with its switch on.
    Optional,
    /// The single-block switch.
    SingleBlock,
    /// The manual part of a canned cycle.
    Cycle,
}

/// How a program ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EndKind {
    /// M02.
    M02,
    /// M30.
    M30,
    /// M99 in the main program.
    M99,
    /// A loop that comes round for ever to the same state.
    Loop,
    /// The text has no more blocks.
    Text,
}

/// What happens.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Act {
    /// The program begins, with these codes in force.
    Start(GroupCodes),
    /// A code goes out.
    Code(CodeOut),
    /// Every axis moves at its own rapid rate (mm, degrees, machine coordinates).
    Rapid {
        /// Where the axes are at its end.
        to: Point,
        /// How it ends.
        kind: RapidKind,
    },
    /// A straight cut.
    Line {
        /// Where the axes are at its end.
        to: Point,
        /// The feed along the path.
        feed: Feed,
    },
    /// An arc or helix.
    Arc {
        /// Its geometry.
        arc: ArcMove,
        /// The feed along the arc in its plane.
        feed: Feed,
    },
    /// Time passes.
    Dwell(Dwell),
    /// A value was written.
    Set(SetValue),
    /// The machine answers every code that is out before anything else is done; then a stop, if there is one.
    Await(Option<StopKind>),
    /// The block is done; what follows it.
    Close(Close),
    /// The block is refused.
    Alarm(Alarm),
}

/// What follows a block.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Close {
    /// The next block.
    Next,
    /// A stop.
    Stop(StopKind),
    /// The program's end.
    End(EndKind),
}

/// One thing that the control does.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Operation {
    /// Which block it belongs to, counted from the program's start.
    pub block: u64,
    /// Where that block stands.
    pub place: Place,
    /// What happens.
    pub act: Act,
    /// Tool radius compensation is in force: the path stage looks at the block itself.
    pub compensated: bool,
    /// The move ends where the skip signal comes; the machine is asked for the place before anything else.
    pub until_signal: bool,
    /// The second stored stroke area is checked (G22).
    pub stroke_check: bool,
    /// Checking on: some axis' place before it is unknown, so it may be a move even where it seems to be none.
    pub from_unknown: bool,
    /// With the single-block switch on the control stops after it, though the block goes on.
    pub stop_point: bool,
    /// The block is done with it, and the next one follows: as if [`Close::Next`] came behind it.
    pub closes: bool,
}

impl Default for Operation {
    /// The end of no block.
    fn default() -> Self {
        Operation {
            block: 0,
            place: Place::default(),
            act: Act::Close(Close::Next),
            compensated: false,
            until_signal: false,
            stroke_check: false,
            from_unknown: false,
            stop_point: false,
            closes: false,
        }
    }
}
