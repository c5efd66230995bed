//! Canned cycles: one file each, all as the same thing, a list of steps in one hole.
//!
//! Comes in: a block's words and the data that earlier blocks stored. Goes out: [`Holes`], which the expander works
//! off step by step, so that a deep hole of a hundred thousand pecks needs no memory.

mod drill;
mod peck;
mod reading;
mod spot;
mod tap;

pub(crate) mod pattern;

use base::{Condition, Point, UnitSystem};
use dialect::Meaning;

use crate::operation::{Feed, RapidKind};
use crate::word::Words;
use pattern::Places;

/// What a cycle keeps from block to block: R and bottom are program coordinates of Z, in counts.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct CycleData {
    /// Z when the cycle mode was entered: machine coordinate without the length offset.
    pub initial: f64,
    /// The R level.
    pub r: Option<f64>,
    /// The bottom.
    pub bottom: Option<f64>,
    /// Depth of cut Q.
    pub peck: f64,
    /// Dwell P, seconds.
    pub dwell: f64,
}

/// The work of one cycle block. Positions are counts in machine coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Holes {
    /// What is done at each place; `None` goes to the places only.
    pub cycle: Option<Meaning>,
    pub places: Places,
    /// Signed distances of positioning from one side, zero where there is none.
    pub approach: Point,
    /// Index of the drilling axis.
    pub axis: u8,
    pub r: f64,
    pub bottom: f64,
    /// Initial or R level.
    pub end: f64,
    pub peck: f64,
    pub clearance: f64,
    pub dwell: f64,
    pub feed: Feed,
    pub rapid: RapidKind,
}

/// How far the work in one hole is.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Cursor {
    pub phase: u32,
    pub depth: f64,
}

impl Cursor {
    /// This phase, stepping on to the next.
    pub fn advance(&mut self) -> u32 {
        let phase = self.phase;
        self.phase += 1;
        phase
    }
}

/// A spindle command of a cycle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Spindle {
    Forward,
    Reverse,
}

/// One step in a hole.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Step {
    /// Rapid along the drilling axis to this level.
    Rapid(f64),
    /// Feed to this level.
    Feed(f64),
    /// Feed to this level with the tap in the hole.
    Tap(f64),
    /// Wait so many seconds (none if zero).
    Dwell(f64),
    /// Send a spindle code and wait for it.
    Spindle(Spindle),
    /// The hole is done.
    Done,
}

type StepFn = fn(&Holes, &mut Cursor) -> Step;

/// The cycles that are built: a new one is a file and a line here.
const CYCLES: &[(Meaning, StepFn)] = &[
    (Meaning::Drill, drill::step),
    (Meaning::Spot, spot::step),
    (Meaning::Peck, peck::step),
    (Meaning::Tap, tap::step),
];

/// The steps of a cycle, if it is built.
pub(crate) fn steps_of(cycle: Meaning) -> Option<StepFn> {
    CYCLES.iter().find(|(meaning, _)| *meaning == cycle).map(|&(_, step)| step)
}

/// True if the cycle cuts in pecks of Q.
pub(crate) fn needs_peck(cycle: Meaning) -> bool {
    matches!(cycle, Meaning::Peck | Meaning::HighSpeedPeck)
}

/// Takes the block's R, Z, Q and P (if `takes_dwell`) into the cycle's data.
///
/// `initial` is the initial level in program coordinates. In incremental mode R counts from the initial level and Z from the R level; both are kept as absolute levels.
pub(crate) fn store(
    words: &Words,
    control: &dialect::Control,
    units: UnitSystem,
    absolute: bool,
    takes_dwell: bool,
    initial: f64,
    data: &mut CycleData,
) -> Result<(), base::Alarm> {
    if let Some(r) = words.length(control, b'R', units)? {
        data.r = Some(if absolute { r } else { initial + r });
    }
    if let Some(z) = words.length(control, b'Z', units)? {
        data.bottom = match (absolute, data.r) {
            (true, _) => Some(z),
            (false, Some(r)) => Some(r + z),
            (false, None) => return Err(words.alarm(Condition::CycleLevelMissing, b'Z')),
        };
    }
    if let Some(q) = words.length(control, b'Q', units)? {
        data.peck = q.abs();
    }
    if takes_dwell
        && words.has(b'P')
        && let Some(seconds) = words.seconds(control, b'P')?
    {
        data.dwell = seconds;
    }
    Ok(())
}
