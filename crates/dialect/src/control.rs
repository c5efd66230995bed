//! A control as one value: everything its tables say, with the look-ups that the stages need.

use syntax::Grammar;

use crate::address::Address;
use crate::alarm::{AlarmRow, Sentences};
use crate::combination::Combination;
use crate::fitting::FROM_AXES;
use crate::function::Functions;
use crate::meaning::{MMeaning, Meaning};
use crate::member::AxisLetter;
use crate::policy::ASKED;
use crate::row::{Division, GCode, MCode, OptionRow, Origin, ParameterRow, PolicyRow};
use crate::station::StationTable;
use crate::transform::{RotationRule, ScalingRule};
use crate::user_macro::UserMacro;
use crate::warning::{OwnWarning, WarningRow};

/// The most modal groups a control can have.
pub const MOST_GROUPS: usize = 24;
/// No row: a group that has no code in force.
pub const NO_CODE: u8 = u8::MAX;

/// The code in force in every group, as indices of the control's G rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct GroupCodes(pub [u8; MOST_GROUPS]);

/// How a group comes to its state at power-on or reset.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct GroupRule {
    /// The row when no parameter decides; `None` keeps the state (at power-on: no code).
    pub row: Option<u8>,
    /// The parameter that decides: its index, its bits (least significant first), a row or "keep" for each value.
    pub parameter: Option<(usize, Vec<u8>, Vec<Option<u8>>)>,
}

/// A modal group.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Group {
    /// As the control numbers it.
    pub number: u8,
    /// What it decides.
    pub name: String,
    /// Its state at power-on.
    pub power_on: GroupRule,
    /// Its state after the RESET key.
    pub reset: GroupRule,
    /// Its state after an emergency stop.
    pub emergency_stop: GroupRule,
    /// Its state after a program's end at which the control resets.
    pub program_end: GroupRule,
    /// The parameter that decides at power-on follows the code last programmed.
    pub stored: bool,
    /// What the row rests on.
    pub origin: Origin,
}

/// The endings of files that are programs.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FileNames {
    /// Of every program; a call does not write it.
    pub ending: String,
    /// Of large programs, which a call writes and which call no others.
    pub large: Option<String>,
}

/// Which group decides what: indices of the groups, found by what their codes mean.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Roles {
    /// Positioning, lines and arcs.
    pub motion: usize,
    /// The plane of arcs and compensation.
    pub plane: usize,
    /// Absolute or incremental.
    pub distance: usize,
    /// Feed per minute or per revolution.
    pub feed_mode: usize,
    /// Inch or metric.
    pub units: usize,
    /// Tool radius compensation.
    pub compensation: usize,
    /// Tool length compensation.
    pub length: usize,
    /// Canned cycles.
    pub cycle: usize,
    /// The level to which cycles return.
    pub return_level: usize,
    /// The work coordinate system.
    pub work: usize,
    /// Exact stop or cutting mode.
    pub stop_mode: usize,
    /// Modal macro calls.
    pub modal_macro: usize,
    /// Scaling, on a control that has it.
    pub scaling: Option<usize>,
    /// The second stored stroke area, on a control that has it.
    pub stroke: Option<usize>,
    /// Coordinate rotation, on a control that has it.
    pub rotation: Option<usize>,
    /// Polar coordinates, on a control that has them.
    pub polar: Option<usize>,
    /// Constant surface speed, on a control that has it.
    pub surface_speed: Option<usize>,
}

/// Tolerances and clearances that are parameters on this control: indices of the parameter rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Tolerances {
    /// Clearance of pecking cycles.
    pub cycle_clearance: usize,
    /// Direction in which boring cycles shift the tool by Q: bit 0 towards minus, bit 1 along Y; `None` is +X.
    pub cycle_shift: Option<usize>,
    /// By how much a radius may be too short to span its arc.
    pub arc_radius: usize,
    /// By how much an arc's end may be off its circle; 0 = no limit.
    pub arc_end: usize,
}

/// How a control reads punched tape.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TapeRules {
    /// Index of the parameter, and its bit, that turns the check of block parity on.
    pub block_parity: (usize, u8),
    /// The macro characters, each with the index of the parameter that holds its EIA row.
    pub eia_codes: Vec<(u8, usize)>,
}

/// Parameters that decide feeds and dwells, where the control has them: indices of the parameter rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct FeedSettings {
    /// The feeds that F1 to F9 call, mm/min.
    pub stored: [Option<usize>; 9],
    /// The fastest cutting feed, mm/min; 0 = no limit.
    pub limit: Option<usize>,
    /// Bits: 0 a dwell under feed per revolution counts turns, 1 in whole turns where it has no point.
    pub dwell: Option<usize>,
    /// The fastest turning of the spindle under constant surface speed, rev/min.
    pub spindle_limit: Option<usize>,
}

/// A control, validated.
#[derive(Clone, PartialEq, Debug)]
pub struct Control {
    /// The name by which users choose it.
    pub name: String,
    /// The folder of its tables, which other members of its family share.
    pub family: String,
    /// Its full name.
    pub title: String,
    /// Who made it.
    pub maker: String,
    /// What it is, in one sentence.
    pub summary: String,
    /// The machine taken when none is named.
    pub stock_machine: String,
    /// The letters of its axes in their order; empty where the machine alone decides.
    pub axes: Vec<AxisLetter>,
    /// What may stand together in a block, where classes of codes decide it.
    pub combination: Option<Combination>,
    /// How its texts are read.
    pub grammar: Grammar,
    /// The endings of files that are programs, where a program is a file.
    pub files: Option<FileNames>,
    /// True if the last of several words of one address counts; false if that is refused.
    pub last_word_wins: bool,
    /// Least input increments: nanometres (metric), nanometres (inch), microdegrees.
    pub increments: [i64; 3],
    /// Index of the parameter with which a number without a point is the value itself.
    pub whole_units: Option<usize>,
    /// Blocks read ahead of the executing one: ordinarily, in compensation, in buffering mode.
    pub read_ahead: [usize; 3],
    /// Levels of subprograms.
    pub subprogram_levels: usize,
    /// Levels of macro calls.
    pub macro_levels: usize,
    /// Highest offset number.
    pub highest_offset: u32,
    /// Largest offset value in mm.
    pub offset_limit_mm: f64,
    /// True if H and D share one memory.
    pub common_offsets: bool,
    /// M codes that cycles send: spindle forward, reverse, stop, orient.
    pub cycle_codes: [u32; 4],
    /// The form that its functions have.
    pub functions: Functions,
    /// Index of the parameter, and its bit, with which G92 presets the UNIVERSAL display; `None` if none does.
    pub universal_preset: Option<(usize, u8)>,
    /// Index of the parameter, and its bit, by which the second stored stroke area forbids its outside.
    pub stroke_outside: Option<(usize, u8)>,
    /// Index of the parameter whose bits 0 to 3 choose the axes of the mirror image: X, Y, Z, the fourth.
    pub mirror_setting: Option<usize>,
    /// How the words of scaling are read, on a control that has it.
    pub scaling: Option<ScalingRule>,
    /// How the words of rotation are read, on a control that has it.
    pub rotation: Option<RotationRule>,
    /// Index of the parameter that says how far the tool's tip may leave its way, on a control that can be fitted with
    /// programming of the tip.
    pub tool_tip: Option<usize>,
    /// How punched tape is read; `None` on a control without tapes.
    pub tape: Option<TapeRules>,
    /// Row of the base work system, if the control has one.
    pub base_system: Option<u8>,
    /// M codes the machine builder decides, those of the control, those above two digits.
    pub m_ranges: [[u32; 2]; 3],
    /// Most M codes of a block where the option for several is fitted.
    pub most_m_codes: usize,
    /// The modal groups.
    pub groups: Vec<Group>,
    /// Which group decides what.
    pub roles: Roles,
    /// Which parameters hold which tolerance.
    pub tolerances: Tolerances,
    /// Which parameters decide feeds and dwells.
    pub feeds: FeedSettings,
    /// The G codes.
    pub g_codes: Vec<GCode>,
    /// The M codes that the control knows.
    pub m_codes: Vec<MCode>,
    /// The address letters, A to Z.
    pub addresses: [Option<Address>; 26],
    /// The options.
    pub options: Vec<OptionRow>,
    /// The policies.
    pub policies: Vec<PolicyRow>,
    /// The parameters.
    pub parameters: Vec<ParameterRow>,
    /// The operator's station.
    pub station: StationTable,
    /// The user macro.
    pub user_macro: UserMacro,
    /// The alarms.
    pub alarms: Vec<AlarmRow>,
    /// The warnings of `check`, those of all controls.
    pub warnings: Vec<WarningRow>,
    /// The warnings that are for this control in particular.
    pub own_warnings: Vec<OwnWarning>,
    /// The sentences for each condition, in the order of `Condition::ALL`.
    pub(crate) sentences: Vec<Sentences>,
    /// Which alarm each condition raises, in the order of `Condition::ALL`.
    pub(crate) alarm_of_condition: Vec<usize>,
    /// What each G row means: asked for many times a block.
    pub(crate) meanings: [Option<Meaning>; 1 + u8::MAX as usize],
    /// Row of each G code by its number.
    pub(crate) g_index: Vec<u8>,
    /// Row of each M code by its number.
    pub(crate) m_index: Vec<u8>,
}

impl Control {
    /// The row of a G code.
    pub fn g_row(&self, code: i64) -> Option<u8> {
        let row = *self.g_index.get(usize::try_from(code).ok()?)?;
        (row != NO_CODE).then_some(row)
    }

    /// The M code of this number, if the control itself knows it.
    pub fn m_code(&self, code: u32) -> Option<&MCode> {
        let row = *self.m_index.get(code as usize)?;
        self.m_codes.get(usize::from(row))
    }

    /// What the code in force in a group means.
    #[inline]
    pub fn in_force(&self, codes: &GroupCodes, group: usize) -> Option<Meaning> {
        self.meanings[usize::from(codes.0[group])]
    }

    /// The row of the first code with this meaning.
    pub fn row_of(&self, meaning: Meaning) -> Option<u8> {
        self.g_codes.iter().position(|row| row.meaning == meaning).map(|row| row as u8)
    }

    /// The M code with this meaning.
    pub fn m_of(&self, meaning: MMeaning) -> Option<&MCode> {
        self.m_codes.iter().find(|row| row.meaning == meaning)
    }

    /// The address letter, if the control has it.
    pub fn address(&self, letter: u8) -> Option<&Address> {
        self.addresses.get(usize::from(letter.wrapping_sub(b'A')))?.as_ref()
    }

    /// True if an option changes what the program does: it gives codes, or code asks for it.
    pub fn asks_for(&self, option: &str) -> bool {
        let index = self.options.iter().position(|row| row.name == option);
        let gives = |code: &GCode| index.is_some_and(|index| code.division == Division::Option(index as u8));
        let keeps = self.station.states.iter().any(|row| row.kept_by.as_deref() == Some(option));
        let limits = index.is_some() && self.station.more_programs == index;
        limits || keeps || ASKED.contains(&option) || FROM_AXES.contains(&option) || self.g_codes.iter().any(gives)
    }

    /// A G row's name as programs write it: `G01`.
    pub fn g_name(&self, row: u8) -> String {
        self.g_codes.get(usize::from(row)).map_or_else(|| "-".to_owned(), |code| format!("G{:02}", code.code))
    }

    /// The groups that this control's own codes use, each with its index.
    pub fn shown_groups(&self) -> impl Iterator<Item = (usize, &Group)> {
        self.groups.iter().enumerate()
    }
}
