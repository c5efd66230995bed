//! The state of a program: every modal value and where its last block ends.
//!
//! Small and `Copy`: each block in the queue owns the state after it, so that RESET can go back to it.

use base::{AXES, AxisSet, Point};
use dialect::GroupCodes;

use crate::cycle::{CycleData, Spindle};
use crate::interrupt::Interrupt;
use crate::polar::Polar;
use crate::reference_point::ReferenceData;
use crate::stroke::StrokeBox;
use crate::transform::Transform;
use crate::unknown::Unknown;

/// The feed as last programmed.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct FeedWord {
    /// Nanometres per minute or per revolution; 0 if none was programmed.
    pub nanometres: f64,
    /// True if it was programmed per revolution.
    pub per_revolution: bool,
    /// True if it was programmed in inches: of a rotary axis alone the number counts degrees all the same.
    pub inch: bool,
}

/// How tool radius compensation goes round outside corners.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Corner {
    /// As the control does by itself.
    #[default]
    NotProgrammed,
    /// M96: on an arc.
    Arc,
    /// M97: through the intersection of the shifted paths.
    Intersection,
}

/// Everything that a block leaves to the next one. Lengths are counts: nanometres or microdegrees in an `f64`, exact
/// up to 9 000 km, with a fraction only where the control derives a point itself.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct State {
    /// The code in force in every group.
    pub groups: GroupCodes,
    /// F.
    pub feed: FeedWord,
    /// S.
    pub spindle: u32,
    /// T.
    pub tool: u32,
    /// B.
    pub index: u32,
    /// H.
    pub h: u32,
    /// D.
    pub d: u32,
    /// The radius that D called for when it or the side of compensation was programmed last, counts.
    pub radius: f64,
    /// Where the block ends: machine coordinates, every offset applied.
    pub machine: Point,
    /// Origin of the base work system.
    pub base_origin: Point,
    /// Shift of all work systems together, that of the local origin included.
    pub common_shift: Point,
    /// The local origin in every work system (G52).
    pub local: Point,
    /// Machine coordinate at which the UNIVERSAL display shows zero.
    pub universal_zero: Point,
    /// Length offset applied to the length axis.
    pub length: f64,
    /// What the length axis has yet to move because of a changed offset: no block since has moved it.
    pub length_due: f64,
    /// Displacement left by tool position offsets.
    pub displacement: Point,
    /// Data of the canned cycle.
    pub cycle: CycleData,
    /// M last commanded.
    pub miscellaneous: u32,
    /// N of the last block that has one.
    pub sequence: u32,
    /// Where the last skip move ended, program coordinates.
    pub skip: Point,
    /// #3003: bit 0 the single-block switch has no effect, bit 1 codes are not waited for.
    pub block_control: u8,
    /// #3004: bit 0 no feed hold, bit 1 feed override 100 %, bit 2 no exact-stop check.
    pub feed_control: u8,
    /// Reference points.
    pub reference: ReferenceData,
    /// M91: where the program goes on when the interrupt input turns on.
    pub interrupt: Option<Interrupt>,
    /// M93: more blocks are read ahead.
    pub buffering: bool,
    /// M96 and M97.
    pub corner: Corner,
    /// The box of the second stored stroke area.
    pub stroke: StrokeBox,
    /// Scale, mirror and rotation.
    pub transform: Transform,
    /// Polar coordinates.
    pub polar: Polar,
    /// Which way the spindle was last told to turn, by the program or by a cycle; a stop does not change it.
    pub spindle_direction: Option<Spindle>,
    /// It was told to stop since.
    pub spindle_stopped: bool,
    /// Surface speed kept under G96, nanometres a minute; 0 if none was programmed.
    pub surface_speed: f64,
    /// Changes with every value that the program writes into memory, and comes back when the value does.
    pub memory_mark: u64,
    /// What cannot be known after a refused block.
    pub unknown: Unknown,
}

impl State {
    /// The state at power-on with the machine standing at `machine`.
    pub fn power_on(groups: GroupCodes, machine: Point, base_origin: Point) -> State {
        State {
            groups,
            feed: FeedWord::default(),
            spindle: 0,
            tool: 0,
            index: 0,
            h: 0,
            d: 0,
            radius: 0.0,
            machine,
            base_origin,
            common_shift: [0.0; AXES],
            local: [0.0; AXES],
            universal_zero: [0.0; AXES],
            length: 0.0,
            length_due: 0.0,
            displacement: [0.0; AXES],
            cycle: CycleData::default(),
            miscellaneous: 0,
            sequence: 0,
            block_control: 0,
            feed_control: 0,
            reference: ReferenceData { established: AxisSet(u8::MAX), remembered: AxisSet::NONE, via: [0.0; AXES] },
            skip: [0.0; AXES],
            interrupt: None,
            buffering: false,
            corner: Corner::NotProgrammed,
            stroke: StrokeBox::NONE,
            transform: Transform::default(),
            polar: Polar::default(),
            spindle_direction: None,
            spindle_stopped: false,
            surface_speed: 0.0,
            memory_mark: 0,
            unknown: Unknown::default(),
        }
    }
}
