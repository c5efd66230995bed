//! What holds while programs run: the control as fitted, the machine, memory and switches.

use std::cell::RefCell;
use std::sync::Arc;

use base::{AXES, AxisSet, Point};
use dialect::{Control, Fitting};

use crate::facts::{MachineFacts, Memory, Switches};
use crate::record::WordsRead;
use crate::unknown::letter_bit;

/// What holds while programs run.
#[derive(Clone)]
pub(crate) struct Setting {
    pub control: Arc<Control>,
    pub fitting: Fitting,
    pub facts: MachineFacts,
    pub memory: Memory,
    pub switches: Switches,
    /// The axis on which the length offset acts.
    pub length_axis: Option<usize>,
    /// The letters of all axes, one bit each.
    pub axis_letters: u32,
    /// The axis of each letter that is one's.
    pub axis_of_letter: [Option<u8>; 26],
    /// The letters that may stand in any block of this control and machine.
    pub usual_letters: u32,
    /// The letters of codes that go out.
    pub code_letters: u32,
    /// The groups whose codes change how words become places, one bit each; the plane among them where it matters to one.
    pub transform_groups: u32,
    /// How the words of the block at hand are read, where that is recorded.
    pub record: Option<RefCell<WordsRead>>,
}

/// The groups of scale, rotation and polar coordinates, and of the plane where the latter two are.
pub(crate) fn transform_groups(control: &Control) -> u32 {
    let roles = &control.roles;
    let plane = (roles.rotation.is_some() || roles.polar.is_some()).then_some(roles.plane);
    [roles.scaling, roles.rotation, roles.polar, plane].iter().flatten().fold(0, |set, &group| set | 1 << group)
}

/// The axis of each letter that is one's.
pub(crate) fn axis_of_letter(facts: &MachineFacts) -> [Option<u8>; 26] {
    let mut axes = [None; 26];
    for (axis, facts) in facts.axes.iter().enumerate().take(AXES) {
        if let Some(slot) = axes.get_mut(usize::from(facts.letter.wrapping_sub(b'A'))) {
            *slot = Some(axis as u8);
        }
    }
    axes
}

/// The letters that may stand in any block: G, the axes', and the addresses that are neither axes nor there for macros
/// alone, but for O, whose place matters.
pub(crate) fn usual_letters(control: &Control, axis_letters: u32) -> u32 {
    let says = |letter: &u8| control.address(*letter).is_some_and(|address| !address.is_axis_or_macro());
    (b'A'..=b'Z')
        .filter(|letter| *letter != b'O' && says(letter))
        .fold(axis_letters | letter_bit(b'G'), |set, letter| set | letter_bit(letter))
}

impl Setting {
    /// The axis of a letter.
    #[inline]
    pub fn axis_of(&self, letter: u8) -> Option<usize> {
        self.axis_of_letter.get(usize::from(letter.wrapping_sub(b'A'))).copied().flatten().map(usize::from)
    }

    /// The axes of these letters.
    #[inline]
    pub fn axes_of(&self, letters: u32) -> AxisSet {
        let mut axes = AxisSet::NONE;
        let mut rest = letters & self.axis_letters;
        while rest != 0 {
            if let Some(axis) = self.axis_of(b'A' + rest.trailing_zeros() as u8) {
                axes.add(axis);
            }
            rest &= rest - 1;
        }
        axes
    }

    /// Counts to mm and degrees.
    pub fn to_mm(&self, counts: &Point) -> Point {
        to_mm(counts)
    }

    /// True if a number without a point is the value itself, by the parameter that the control has for it.
    pub fn whole_units(&self) -> bool {
        self.control.whole_units.is_some_and(|parameter| self.fitting.parameter(parameter) != 0.0)
    }

    /// Whether G92 presets the UNIVERSAL display, by the parameter bit that the control has for it.
    pub fn presets_universal(&self) -> bool {
        self.control
            .universal_preset
            .is_some_and(|(parameter, bit)| self.fitting.parameter(parameter) as u8 & (1 << bit) != 0)
    }
}

/// Counts to mm and degrees.
pub(crate) fn to_mm(counts: &Point) -> Point {
    counts.map(|counts| counts / 1e6)
}
