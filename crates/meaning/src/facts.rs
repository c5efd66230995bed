//! What the interpreter must know of the machine, its memory and its switches.

use base::{AXES, AxisSet, Point};

use crate::kinematics::Kinematics;
use crate::user_macro::Variables;

/// One axis as programs see it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AxisFacts {
    /// Its address letter.
    pub letter: u8,
    /// True if it turns (degrees), false if it slides (mm).
    pub rotary: bool,
    /// Reference points 1 to 4, machine coordinates in nanometres or microdegrees.
    pub reference_points: [f64; 4],
    /// Signed distance of positioning from one side, in nanometres or microdegrees.
    pub approach: f64,
}

/// How codes go to the machine.
#[derive(Clone, PartialEq, Debug)]
pub struct CodeRules {
    /// Digits on the M, S, T and B lines.
    pub digits: [u8; 4],
    /// M codes that are sent after the block's motion.
    pub m_after_motion: Vec<u32>,
    /// True if B is sent after the block's motion.
    pub b_after_motion: bool,
}

/// The machine as programs see it.
#[derive(Clone, PartialEq, Debug)]
pub struct MachineFacts {
    /// The axes in the machine file's order, at most eight.
    pub axes: Vec<AxisFacts>,
    /// How codes go out.
    pub codes: CodeRules,
    /// How axes that turn move the tip of the tool, where the builder says so.
    pub kinematics: Option<Kinematics>,
}

impl MachineFacts {
    /// The index of the axis with this letter.
    pub fn axis(&self, letter: u8) -> Option<usize> {
        self.axes.iter().take(AXES).position(|axis| axis.letter == letter)
    }

    /// All axes.
    pub fn all(&self) -> AxisSet {
        AxisSet(((1u16 << self.axes.len().min(AXES)) - 1) as u8)
    }
}

/// Tool offsets by number, in nanometres.
#[derive(Clone, PartialEq, Debug)]
pub struct OffsetTable {
    values: Vec<f64>,
}

impl OffsetTable {
    /// A table with numbers 0 to `highest`, all zero.
    pub fn new(highest: u32) -> OffsetTable {
        OffsetTable { values: vec![0.0; highest as usize + 1] }
    }

    /// The value of a number; number 0 is always zero.
    pub fn value(&self, number: u32) -> Option<f64> {
        self.values.get(number as usize).copied()
    }

    /// Writes a value; false if there is no such number to write.
    pub fn set(&mut self, number: u32, nanometres: f64) -> bool {
        match self.values.get_mut(number as usize) {
            Some(value) if number > 0 => {
                *value = nanometres;
                true
            }
            _ => false,
        }
    }
}

/// What the control keeps from program to program.
#[derive(Clone, PartialEq, Debug)]
pub struct Memory {
    /// Values selected by H (and by D where both share one memory).
    pub lengths: OffsetTable,
    /// Values selected by D where D has a column of its own.
    pub radii: Option<OffsetTable>,
    /// Macro variables.
    pub variables: Variables,
    /// Origins of the work systems 1 to 6: machine coordinates in nanometres or microdegrees.
    pub work: [Point; 6],
    /// An origin that counts in every work system, on a control that has one.
    pub external: Point,
}

impl Memory {
    /// The value that H selects.
    pub fn length(&self, number: u32) -> Option<f64> {
        self.lengths.value(number)
    }

    /// The value that D selects.
    pub fn radius(&self, number: u32) -> Option<f64> {
        self.radii.as_ref().unwrap_or(&self.lengths).value(number)
    }
}

/// Switches of the operator's panel that decide what a program does.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Switches {
    /// M01 stops.
    pub optional_stop: bool,
    /// Block delete 1 to 9, bit 0 for the first.
    pub block_delete: u16,
    /// Axes whose mirror image is on by its switch.
    pub mirror_image: AxisSet,
}
