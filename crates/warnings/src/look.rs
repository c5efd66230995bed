//! What a rule sees of a block that has been executed.

use base::{AXES, Point};
use dialect::{Control, Fitting, Meaning};
use meaning::{Command, Interpreter, LENGTH_AXIS, MachineFacts, Memory, State};

/// A block that has been executed, with what it was executed by.
#[derive(Clone, Copy)]
pub(crate) struct Look<'l> {
    pub interpreter: &'l Interpreter,
    pub control: &'l Control,
    pub fitting: &'l Fitting,
    pub facts: &'l MachineFacts,
    pub memory: &'l Memory,
    pub before: &'l State,
    pub command: &'l Command,
}

impl<'l> Look<'l> {
    /// The state after the block.
    pub fn after(&self) -> &'l State {
        &self.command.after
    }

    /// What the code in force in a group after the block means.
    pub fn in_force(&self, group: usize) -> Option<Meaning> {
        self.control.in_force(&self.after().groups, group)
    }

    /// The name of the code in force in a group after the block.
    pub fn code_name(&self, group: usize) -> String {
        self.control.groups.get(group).map_or_else(String::new, |_| self.control.g_name(self.after().groups.0[group]))
    }

    /// The letter of an axis.
    pub fn letter(&self, axis: usize) -> u8 {
        self.facts.axes.get(axis).map_or(b'?', |facts| facts.letter)
    }

    /// The axes that have a word in the block.
    pub fn named(&self) -> impl Iterator<Item = usize> + 'l {
        let wording = self.command.wording;
        let axes = &self.facts.axes;
        (0..axes.len().min(AXES)).filter(move |&axis| wording.has(axes[axis].letter))
    }

    /// The axis on which length offsets act.
    pub fn length_axis(&self) -> Option<usize> {
        self.facts.axis(LENGTH_AXIS)
    }

    /// The number of the block's one-shot code, and its name.
    pub fn one_shot(&self) -> Option<(u16, String)> {
        let row = self.control.row_of(self.command.wording.one_shot?)?;
        let code = self.control.g_codes.get(usize::from(row))?;
        Some((code.code, self.control.g_name(row)))
    }

    /// The number of the code that stands in force in a group, for pointing at its word.
    pub fn code_in(&self, group: usize) -> u16 {
        let row = self.after().groups.0[group];
        self.control.g_codes.get(usize::from(row)).map_or(0, |code| code.code)
    }
}

/// Counts (nanometres, microdegrees) as a number for people: at most three decimals, no trailing zeros.
pub(crate) fn plain(counts: f64) -> String {
    number(counts / 1e6)
}

/// A number for people: at most three decimals, no trailing zeros.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// The places of some axes, as `X10 Y-20`, in counts.
pub(crate) fn places(facts: &MachineFacts, axes: impl Iterator<Item = usize>, point: &Point) -> String {
    let name = |axis: usize| {
        let letter = facts.axes.get(axis).map_or('?', |facts| char::from(facts.letter));
        format!("{letter}{}", plain(point[axis]))
    };
    axes.filter(|&axis| axis < AXES).map(name).collect::<Vec<_>>().join(" ")
}

/// The travel of an axis' letter among the machine's axes, mm or degrees; what is not limited is infinite.
pub(crate) fn widest(travel: &[[f64; 2]]) -> f64 {
    travel.iter().map(|[low, high]| high - low).fold(0.0, f64::max)
}
