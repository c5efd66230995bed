//! An alarm as a small value; its text is made where it is shown.

use crate::{Condition, Place, Span};

/// A refused block: what is wrong, where, and the numbers that say by how much.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Alarm {
    /// What is wrong.
    pub condition: Condition,
    /// The block that is refused.
    pub place: Place,
    /// The word it is about, or the whole block.
    pub span: Span,
    /// Numbers for the text; each condition's documentation says which (mm, deg, counts).
    pub values: [f64; 3],
    /// The axis it is about, as an index of the machine's axes.
    pub axis: Option<u8>,
    /// The address letter it is about, 0 for none: some addresses have an alarm of their own.
    pub letter: u8,
}

impl Alarm {
    /// An alarm about one span of a block, without numbers.
    pub const fn new(condition: Condition, place: Place, span: Span) -> Alarm {
        Alarm { condition, place, span, values: [0.0; 3], axis: None, letter: 0 }
    }

    /// The same with its numbers.
    #[must_use]
    pub const fn with(mut self, values: [f64; 3]) -> Alarm {
        self.values = values;
        self
    }

    /// The same about one address.
    #[must_use]
    pub const fn about(mut self, letter: u8) -> Alarm {
        self.letter = letter;
        self
    }

    /// The same about one axis.
    #[must_use]
    pub const fn on_axis(mut self, axis: usize) -> Alarm {
        self.axis = Some(axis as u8);
        self
    }
}
