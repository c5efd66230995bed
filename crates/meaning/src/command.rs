//! A block as the control has read it: everything decided, nothing done.

use base::{AXES, Alarm, AxisSet, Place, Point};
use dialect::{GroupCodes, Meaning};
use syntax::{Cursor, Extent};

use crate::centring::Centring;
use crate::circle_cutting::CircleCut;
use crate::cycle::Holes;
use crate::data_setting::DataWrite;
use crate::element::Offset;
use crate::kinematics::Kinematics;
use crate::operation::{CodeLine, CodeOut, Dwell, EndKind, Feed, Plane, RapidKind, SetValue, Side, StopKind};
use crate::program::Frame;
use crate::state::State;
use crate::wording::Wording;

/// Most codes that one block sends.
pub(crate) const MOST_CODES: usize = 8;

/// What the block does between its codes. Positions are counts in machine coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Body {
    Nothing,
    Rapid {
        to: Point,
        kind: RapidKind,
    },
    /// A rapid, and what is wrong with where it ends.
    Checked {
        to: Point,
        alarm: Option<Alarm>,
    },
    /// Two rapids; `stops` puts a stop point of SINGLE BLOCK between them.
    Via {
        via: Point,
        to: Point,
        stops: bool,
    },
    Line {
        to: Point,
        feed: Feed,
    },
    Arc {
        to: Point,
        center: [f64; 2],
        axes: [u8; 2],
        plane: Plane,
        clockwise: bool,
        full_circle: bool,
        /// Where the arc ends in its plane if a straight piece leads on to the end.
        foot: Option<[f64; 2]>,
        feed: Feed,
    },
    /// A line until the skip signal; what is raised if it does not come.
    Skip {
        to: Point,
        feed: Feed,
        missed: Option<Alarm>,
    },
    Centring(Centring),
    /// A straight way of the tool's tip, in parts.
    Tip(TipMove),
    Dwell(Dwell),
    Set(SetValue, Option<SetValue>),
    Holes(Holes),
    Circle(CircleCut),
    Alarm(Alarm),
    /// The program begins.
    Start(GroupCodes),
}

/// A straight way of the tool's tip while the axes turn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct TipMove {
    pub kinematics: Kinematics,
    /// Where it ends, as if nothing were turned; counts.
    pub upright: Point,
    /// Where the machine stands then, counts.
    pub machine: Point,
    /// The tool's length at the beginning and at the end, mm.
    pub lengths: [f64; 2],
    pub parts: u32,
    /// The feed of each part.
    pub feed: Feed,
}

impl Body {
    /// True if axes move by it.
    pub fn moves(&self) -> bool {
        matches!(
            self,
            Body::Rapid { .. }
                | Body::Checked { .. }
                | Body::Via { .. }
                | Body::Line { .. }
                | Body::Arc { .. }
                | Body::Skip { .. }
                | Body::Centring(_)
                | Body::Tip(_)
                | Body::Circle(_)
                | Body::Holes(_)
        )
    }
}

/// What follows the block.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Finish {
    /// The next block.
    Next,
    /// M00.
    ProgramStop,
    /// M01: the switch is looked at when the block is executed.
    OptionalStop,
    /// The program's end.
    End(EndKind),
}

impl Finish {
    /// The stop that this finish is, if it is one.
    pub(crate) const fn stop(self) -> Option<StopKind> {
        match self {
            Finish::ProgramStop => Some(StopKind::Program),
            Finish::OptionalStop => Some(StopKind::Optional),
            _ => None,
        }
    }
}

/// A block as read.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Command {
    /// Counted from the program's start.
    pub block: u64,
    /// Where it stands.
    pub place: Place,
    /// The state after it.
    pub after: State,
    /// Where the axes are before it (counts, machine coordinates).
    pub from: Point,
    /// The codes it sends, in their order.
    pub(crate) codes: [CodeOut; MOST_CODES],
    pub(crate) code_count: u8,
    /// Which of the codes is that of M01, if one is.
    pub(crate) optional_code: Option<u8>,
    pub(crate) body: Body,
    /// What it writes into memory; already written when it stands in the queue.
    pub(crate) write: Option<DataWrite>,
    /// What follows.
    pub finish: Finish,
    /// The next block must not be read before this one is done.
    pub(crate) stops_reading: bool,
    /// Tool radius compensation in force, as it is seen on the machine: a mirror image has exchanged left and right.
    pub(crate) side: Side,
    /// How the tool runs beside the path, while it does.
    pub(crate) offset: Option<Offset>,
    /// Axes along which the block goes to its own place, whatever the tool's offset was.
    pub(crate) drops: AxisSet,
    /// The axes that have a word in the block, and where it stands.
    pub(crate) written: AxisSet,
    pub(crate) axis_words: [Extent; AXES],
    /// Axes written absolutely.
    pub absolute: AxisSet,
    /// Axes that it returns to their reference point.
    pub returned: AxisSet,
    /// The second stored stroke area is checked.
    pub(crate) stroke_check: bool,
    /// How it is written; nothing of a refused block.
    pub wording: Wording,
    /// Checking on: some axis' place before the block is unknown.
    pub(crate) from_unknown: bool,
    /// The program it belongs to, with the cursor on the block after it.
    pub(crate) frame: Frame,
    /// The cursor on the block itself.
    pub(crate) here: Cursor,
    /// It stands in a subprogram.
    pub(crate) called: bool,
    /// It is the first block of its program.
    pub(crate) first: bool,
}

/// The levels between which a canned cycle works, in counts of the machine's coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CycleLevels {
    /// The cycle.
    pub cycle: Meaning,
    /// Where the drilling axis stands before the block.
    pub from: f64,
    /// The R level.
    pub r: f64,
    /// The bottom, of back boring the top, of the hole.
    pub bottom: f64,
}

/// Where a block leads an axis that stands beside the place at which the program counts it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Leads {
    /// To the place that it names.
    ToThePlace,
    /// To a level of its cycle, with the first move of the axis.
    ToTheLevel,
    /// By its way, from where the axis stands.
    Along,
}

impl Command {
    /// One that says nothing, in this state.
    pub(crate) fn empty(state: &State) -> Command {
        Command {
            block: 0,
            place: Place::default(),
            after: *state,
            from: state.machine,
            codes: [CodeOut { line: CodeLine::M, code: 0, digits: 0, after_motion: false }; MOST_CODES],
            code_count: 0,
            optional_code: None,
            body: Body::Nothing,
            write: None,
            finish: Finish::Next,
            stops_reading: false,
            side: Side::Off,
            offset: None,
            drops: AxisSet::NONE,
            written: AxisSet::NONE,
            axis_words: [Extent::default(); AXES],
            absolute: AxisSet::NONE,
            returned: AxisSet::NONE,
            stroke_check: false,
            wording: Wording::default(),
            from_unknown: false,
            frame: Frame::default(),
            here: Cursor::HEAD,
            called: false,
            first: false,
        }
    }

    /// Where it leads an axis that stands beside the place at which the program counts it.
    pub fn leads(&self, axis: usize) -> Leads {
        let drills =
            matches!(&self.body, Body::Holes(holes) if holes.cycle.is_some() && usize::from(holes.axis) == axis);
        match (self.absolute.has(axis), self.written.has(axis)) {
            // A cycle keeps its levels as places, from block to block.
            (true, _) | (_, false) if drills => Leads::ToTheLevel,
            (true, _) => Leads::ToThePlace,
            _ => Leads::Along,
        }
    }

    /// True if the control refuses the block: nothing of it happens.
    pub fn is_refused(&self) -> bool {
        matches!(self.body, Body::Alarm(_))
    }

    /// True if it may move axes.
    pub fn moves(&self) -> bool {
        self.body.moves()
    }

    /// It is a straight cut. (On its own, so that no copy is made on the way where other blocks are other things.)
    #[inline(never)]
    pub(crate) fn cut_to(&mut self, to: &Point, feed: Feed) {
        self.body = Body::Line { to: *to, feed };
    }

    /// True if it cuts: a feed is in use.
    pub fn cuts(&self) -> bool {
        match &self.body {
            Body::Line { .. } | Body::Arc { .. } | Body::Skip { .. } => true,
            Body::Centring(_) | Body::Circle(_) | Body::Tip(_) => true,
            Body::Holes(holes) => holes.cycle.is_some(),
            _ => false,
        }
    }

    /// True if it is an arc.
    pub fn is_arc(&self) -> bool {
        matches!(self.body, Body::Arc { .. })
    }

    /// The point by way of which the axes move, if the block is two rapids.
    pub fn via(&self) -> Option<&Point> {
        match &self.body {
            Body::Via { via, .. } => Some(via),
            _ => None,
        }
    }

    /// The levels of a canned cycle.
    pub fn levels(&self) -> Option<CycleLevels> {
        let Body::Holes(holes) = &self.body else { return None };
        let from = *self.from.get(usize::from(holes.axis))?;
        Some(CycleLevels { cycle: holes.cycle?, from, r: holes.r, bottom: holes.bottom })
    }

    /// True if it stands in a subprogram or macro.
    pub fn is_called(&self) -> bool {
        self.called
    }

    /// On which side of the path the tool runs.
    pub fn side(&self) -> Side {
        self.side
    }

    /// The codes it sends, in their order.
    pub fn sent(&self) -> &[CodeOut] {
        self.codes.get(..usize::from(self.code_count)).unwrap_or_default()
    }

    /// The span of an axis' word, or of the whole block if it has none.
    pub fn axis_span(&self, axis: usize) -> base::Span {
        match self.axis_words.get(axis) {
            Some(extent) if self.written.has(axis) => extent.span(self.place.block.start),
            _ => self.place.block,
        }
    }
}
