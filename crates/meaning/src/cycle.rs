//! Canned cycles: each a list of steps in one hole, which is a table of the control.
//!
//! Comes in: a block's words and the data that earlier blocks stored. Goes out: [`Holes`], which the expander works
//! off step by step, so that a deep hole of a hundred thousand pecks needs no memory.

mod reading;
mod steps;

pub(crate) mod pattern;

use base::{Condition, Point, UnitSystem};
use dialect::{CycleSteps, Meaning};

use crate::coordinate::LENGTH_AXIS;
use crate::operation::{Feed, RapidKind};
use crate::word::Words;
use pattern::Places;
pub(crate) use steps::next_step;

/// What a cycle keeps from block to block: R and bottom are program coordinates of Z, in counts.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct CycleData {
    /// Z when the cycle mode was entered: machine coordinate without the length offset.
    pub initial: f64,
    /// The R level.
    pub r: Option<f64>,
    /// The bottom.
    pub bottom: Option<f64>,
    /// Depth of cut or shift Q.
    pub peck: f64,
    /// Shift I, J of boring cycles, unless a later block has written Q alone.
    pub shift: Option<[f64; 2]>,
    /// Dwell P, seconds.
    pub dwell: f64,
}

/// The work of one cycle block. Positions are counts in machine coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Holes {
    /// What is done at each place; `None` goes to the places only.
    pub cycle: Option<Meaning>,
    pub steps: CycleSteps,
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
    /// By how much boring cycles shift the tool off the wall, along these axes.
    pub shift: [f64; 2],
    pub shift_axes: [u8; 2],
    /// Which way a cycle that wants the spindle turning starts it at the first hole; `None`: it turns so already.
    pub start: Option<Spindle>,
    /// Which way the spindle turns after it has been stopped or oriented; `None` leaves it as it is.
    pub restart: Option<Spindle>,
    /// Where the steps say so, the tool leaves the hole by the operator's hand; else the cycle brings it out.
    pub by_hand: bool,
    pub feed: Feed,
    pub rapid: RapidKind,
}

impl Holes {
    /// The way into the hole: 1 or -1 along the drilling axis.
    fn down(&self) -> f64 {
        if self.bottom < self.r { -1.0 } else { 1.0 }
    }
}

/// How far the work in one hole is.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Cursor {
    /// The step that is next.
    pub step: u8,
    /// How far a step of pecks is.
    pub peck: u8,
    pub depth: f64,
}

impl Cursor {
    /// Cuts by Q from a level, to the bottom at most; true if it is reached.
    fn cut(&mut self, holes: &Holes, from: f64) -> bool {
        let next = from + holes.down() * holes.peck;
        let reached = (next - holes.bottom) * holes.down() >= 0.0;
        self.depth = if reached { holes.bottom } else { next };
        reached
    }
}

/// A spindle command of a cycle, in the order in which the control's table has the codes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Spindle {
    /// It turns clockwise.
    Forward,
    /// It turns counter-clockwise.
    Reverse,
    /// It stops anywhere.
    Stop,
    /// It stops at its fixed angle.
    Orient,
}

impl Spindle {
    /// What an M code makes the spindle do, if it is one of these codes.
    pub(crate) fn sent_by(code: u32, codes: &[u32; 4]) -> Option<Spindle> {
        const ALL: [Spindle; 4] = [Spindle::Forward, Spindle::Reverse, Spindle::Stop, Spindle::Orient];
        ALL.into_iter().find(|&spindle| codes[spindle as usize] == code)
    }

    /// True if the spindle turns then.
    pub(crate) const fn turns(self) -> bool {
        matches!(self, Spindle::Forward | Spindle::Reverse)
    }
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
    /// Start the spindle, if it does not turn as the cycle wants it.
    Start,
    /// Start the spindle as it turned before.
    Restart,
    /// Rapid aside, off the wall of the hole.
    Aside,
    /// Rapid back over the hole.
    Back,
    /// Stop where the tool leaves by the operator's hand; CYCLE START goes on.
    ByHand,
    /// The hole is done.
    Done,
}

/// True if the tool goes to the R level before the cycle's own steps; back boring goes there by itself, off the hole.
pub(crate) fn begins_at_r(cycle: Meaning) -> bool {
    cycle != Meaning::BackBore
}

/// Takes the block's I and J into the cycle's data. The shift written last counts: I and J, or Q without them.
pub(crate) fn store_shift(
    words: &Words,
    control: &dialect::Control,
    units: UnitSystem,
    data: &mut CycleData,
) -> Result<(), base::Alarm> {
    let (i, j) = (words.length(control, b'I', units)?, words.length(control, b'J', units)?);
    if i.is_some() || j.is_some() {
        let [old_i, old_j] = data.shift.unwrap_or_default();
        data.shift = Some([i.unwrap_or(old_i), j.unwrap_or(old_j)]);
    } else if words.has(b'Q') {
        data.shift = None;
    }
    Ok(())
}

/// Takes the block's R, Z and Q into the cycle's data.
///
/// `initial` is the initial level in program coordinates. In incremental mode R counts from the initial level and Z
/// from the R level; both are kept as absolute levels.
pub(crate) fn store(
    words: &Words,
    control: &dialect::Control,
    units: UnitSystem,
    absolute: bool,
    initial: f64,
    data: &mut CycleData,
) -> Result<(), base::Alarm> {
    if let Some(r) = words.length(control, b'R', units)? {
        data.r = Some(if absolute { r } else { initial + r });
    }
    if let Some(z) = words.length(control, LENGTH_AXIS, units)? {
        data.bottom = match (absolute, data.r) {
            (true, _) => Some(z),
            (false, Some(r)) => Some(r + z),
            (false, None) => return Err(words.alarm(Condition::CycleLevelMissing, LENGTH_AXIS)),
        };
    }
    if let Some(q) = words.length(control, b'Q', units)? {
        data.peck = q;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cycle_of_every_control_has_its_steps_and_comes_to_an_end() {
        for control in dialect::builtin_controls() {
            let files = dialect::builtin_files(&control).expect("it is built in");
            let table = dialect::load_control(&files).expect("it loads");
            let cycles = table.g_codes.iter().filter(|code| code.meaning.is_cycle());
            for code in cycles.filter(|code| code.division != dialect::Division::Sibling) {
                let places = Places::Row { first: [0.0; base::AXES], step: [0.0; base::AXES], count: 1 };
                let holes = Holes {
                    cycle: Some(code.meaning),
                    steps: table.functions.cycle.steps_of(code.meaning),
                    places,
                    approach: [0.0; base::AXES],
                    axis: 2,
                    r: 2e6,
                    bottom: -5e6,
                    end: 10e6,
                    peck: 3e6,
                    clearance: 1e6,
                    dwell: 0.0,
                    shift: [1e6, 0.0],
                    shift_axes: [0, 1],
                    start: None,
                    restart: None,
                    by_hand: false,
                    feed: Feed {
                        mm_per_min: 100.0,
                        exact_stop: false,
                        tapping: false,
                        per_revolution: false,
                        way_mm: 0.0,
                    },
                    rapid: RapidKind::Checked,
                };
                let (mut at, mut steps, mut level) = (Cursor::default(), 0, holes.end);
                loop {
                    match next_step(&holes, &mut at) {
                        Step::Done => break,
                        Step::Rapid(to) | Step::Feed(to) | Step::Tap(to) => level = to,
                        _ => {}
                    }
                    steps += 1;
                }
                let name = format!("{control} G{:02}", code.code);
                assert!((2..=12).contains(&steps) && level == holes.end, "{name}: {steps} steps, left at {level}");
            }
        }
    }
}
