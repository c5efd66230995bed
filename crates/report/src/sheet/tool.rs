//! What one tool does.

use std::collections::BTreeSet;

use super::Spot;

/// Lowest and highest value.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Range {
    /// Lowest.
    pub low: f64,
    /// Highest.
    pub high: f64,
}

impl Range {
    /// Widens the range of a value that may not have one yet.
    pub fn take(range: &mut Option<Range>, value: f64) {
        match range {
            None => *range = Some(Range { low: value, high: value }),
            Some(range) => {
                range.low = range.low.min(value);
                range.high = range.high.max(value);
            }
        }
    }
}

/// The lowest point to which a tool comes along the length axis, mm.
#[derive(Clone, PartialEq, Debug)]
pub struct Lowest {
    /// Of the spindle, machine coordinates.
    pub machine: f64,
    /// Of the tool's tip, machine coordinates.
    pub tip: f64,
    /// In the program's coordinates.
    pub program: f64,
    /// The work system in which these count.
    pub system: String,
    /// Where.
    pub spot: Spot,
}

/// A piece of work: blocks in a row that do the same.
#[derive(Clone, PartialEq, Debug)]
pub struct Operation {
    /// The cycle's code, empty for lines and arcs.
    pub code: String,
    /// What it is.
    pub text: String,
    /// Holes made, in a cycle.
    pub holes: u64,
    /// Path cut, mm.
    pub length: f64,
    /// Lowest point along the length axis, program coordinates.
    pub depth: Option<f64>,
    /// Where it begins.
    pub first: Spot,
    /// The bottom of its holes, which tells two pieces of work apart.
    pub(super) bottom: Option<f64>,
    /// The place of the last hole, so that the next one is known from it.
    pub(super) last_hole: Option<[f64; 2]>,
}

/// One tool.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct ToolSheet {
    /// Its T; `None` is the tool in the spindle at the start.
    pub tool: Option<u32>,
    /// Where it is called first.
    pub first: Spot,
    /// The remarks where it is called.
    pub remarks: Vec<String>,
    /// Numbers of its length offsets.
    pub h: BTreeSet<u32>,
    /// Numbers of its radius or position offsets.
    pub d: BTreeSet<u32>,
    /// How deep it goes.
    pub lowest: Option<Lowest>,
    /// Where it cuts, program coordinates: work system, letter, range.
    pub extents: Vec<(String, char, Range)>,
    /// Spindle speeds while it cuts.
    pub speeds: Option<Range>,
    /// Feeds while it cuts, mm/min.
    pub feeds: Option<Range>,
    /// Seconds of cutting.
    pub cutting: f64,
    /// Seconds in all.
    pub total: f64,
    /// What it does, in order.
    pub operations: Vec<Operation>,
}

impl ToolSheet {
    /// True if it cuts.
    pub fn cuts(&self) -> bool {
        !self.operations.is_empty()
    }

    /// Widens the part that it cuts along an axis.
    pub fn reach(&mut self, system: &str, letter: char, low: f64, high: f64) {
        let found = self.extents.iter_mut().find(|(own, axis, _)| own == system && *axis == letter);
        match found {
            Some((_, _, range)) => {
                range.low = range.low.min(low);
                range.high = range.high.max(high);
            }
            None => self.extents.push((system.to_owned(), letter, Range { low, high })),
        }
    }
}
