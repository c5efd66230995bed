//! `rapid-down-and-across`: rapid downwards and across in one block.
//!
//! What: one positioning move goes down and across at once.
//! Why: every axis runs at its own rapid rate, so the way is no straight line: it has a dog-leg whose shape depends on
//! the rates, and the tool may be down before it is over its place. Clamps and the part's rim stand in that way.
//! Do: position in X and Y first, then go down in a block of its own; going up, the other way round.
//!
//! Silent for less than 0.1 mm of either (an offset's correction is no approach), and on machines whose positioning
//! runs in a straight line (`straight_rapid` of the machine's file). Inside canned cycles the two never go together.

use base::{AXES, Point};

use crate::finding::{At, Finding};
use crate::look::number;
use crate::rules::Rule;
use meaning::Command;

/// Below this, in mm, it is a correction and no approach.
const LEAST_MM: f64 = 0.1;

/// How far down and how far across a positioning move goes, if it does both. `across` are the axes beside the length axis.
pub(crate) fn legs(from: &Point, to: &Point, length_axis: usize, across: &[bool; AXES]) -> Option<(f64, f64)> {
    let down = from.get(length_axis)? - to.get(length_axis)?;
    if down < LEAST_MM {
        return None;
    }
    let way = |axis: usize| to[axis] - from[axis];
    let square = (0..AXES).filter(|&axis| across[axis]).map(|axis| way(axis) * way(axis)).sum::<f64>();
    let across = square.sqrt();
    (across >= LEAST_MM).then_some((down, across))
}

pub(crate) fn finding(command: &Command, length_letter: u8, down: f64, across: f64) -> Finding {
    Finding::new(Rule::RapidDownAndAcross, "", command, At::Letter(length_letter))
        .with("down", number(down))
        .with("across", number(across))
        .labelled(format!("{} mm down and {} mm across", number(down), number(across)))
}
