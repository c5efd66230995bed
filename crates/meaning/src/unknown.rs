//! What cannot be known after a refused block, so that checking on raises only alarms it can stand behind.
//!
//! A refused block has no effect. What it named (axes, groups, F, …) is unknown from then on until it is written
//! again: an axis by an absolute word, a group by one of its codes. An alarm that depends on an unknown is not raised.

use base::{AxisSet, Condition};
use dialect::Roles;

/// Sets of what is unknown.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Unknown {
    /// Axes whose position is unknown.
    pub axes: AxisSet,
    /// Axes on which the base work system's origin is unknown.
    pub origins: AxisSet,
    /// Modal groups whose code is unknown, one bit each.
    pub groups: u32,
    /// Words whose value is unknown, one bit a letter.
    pub words: u32,
    /// Some offset or origin in memory is unknown.
    pub memory: bool,
}

impl Unknown {
    /// True if everything is known.
    pub const fn is_nothing(self) -> bool {
        self.axes.is_empty() && self.origins.is_empty() && self.groups == 0 && self.words == 0 && !self.memory
    }

    /// True if the code of this group is unknown.
    pub const fn group(self, group: usize) -> bool {
        self.groups & (1 << group) != 0
    }

    /// True if the value of this letter is unknown.
    pub const fn word(self, letter: u8) -> bool {
        self.words & letter_bit(letter) != 0
    }

    /// True if an alarm with this condition may rest on something unknown.
    pub fn clouds(self, condition: Condition, roles: &Roles, axis: Option<u8>) -> bool {
        if self.is_nothing() {
            return false;
        }
        let any = |groups: &[usize]| groups.iter().any(|&group| self.group(group));
        match condition {
            Condition::FeedMissing | Condition::SpindleSpeedMissing | Condition::SpindleSpeedCoded => {
                any(&[roles.motion, roles.feed_mode, roles.cycle]) || self.word(b'F') || self.word(b'S')
            }
            Condition::ArcWithoutCentre => any(&[roles.motion, roles.cycle]),
            Condition::ArcRadiusZero | Condition::ArcRadiusTooSmall | Condition::ArcEndOff => {
                !self.axes.is_empty() || any(&[roles.motion, roles.plane, roles.distance, roles.units, roles.work])
            }
            Condition::ReferenceNotReached => {
                !self.axes.is_empty() || any(&[roles.motion, roles.distance, roles.units, roles.work])
            }
            // The refused block may have been the one that returns the axis.
            Condition::ReferenceNotDone | Condition::IntermediatePointMissing => {
                axis.is_some_and(|axis| self.axes.has(usize::from(axis)))
            }
            Condition::LengthOffsetWithArc | Condition::OneShotWithMotion => self.group(roles.motion),
            Condition::PositionOffsetInCycle
            | Condition::CycleLevelMissing
            | Condition::CyclePeckMissing
            | Condition::CycleShiftMissing => {
                let data = b"RZQIJ".iter().any(|&letter| self.word(letter));
                data || self.group(roles.cycle)
            }
            Condition::PositionOffsetInCompensation
            | Condition::CycleInCompensation
            | Condition::CircleInCompensation => self.group(roles.compensation),
            Condition::CircleOffsetMissing => self.word(b'D'),
            Condition::CircleTooSmall => self.word(b'D') || self.group(roles.units) || self.memory,
            Condition::OffsetRange => any(&[roles.units, roles.distance]) || self.memory,
            Condition::StoredFeedMissing => self.group(roles.feed_mode),
            // Whichever code in force the refusal rests on.
            Condition::StateForbids => self.groups != 0,
            Condition::ValueOutOfRange => self.group(roles.units),
            Condition::TravelExceeded => {
                axis.is_some_and(|axis| self.axes.has(usize::from(axis)))
                    || any(&[roles.cycle, roles.work, roles.distance])
            }
            _ => false,
        }
    }
}

/// The bit of a letter in a set of letters.
pub const fn letter_bit(letter: u8) -> u32 {
    1 << (letter.wrapping_sub(b'A') & 31)
}
