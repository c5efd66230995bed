//! A finding as a small value; its words are made when it is shown.

use std::collections::BTreeSet;

use base::{Place, SourceId};
use meaning::Command;

use crate::rules::Rule;

/// Findings that are remembered so as not to be said twice; the rest is not said at all.
const MOST_SAID: usize = 100_000;

/// Which word of the block is meant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum At {
    /// The block as a whole.
    Block,
    /// The last word of this letter.
    Letter(u8),
    /// The G word with this code.
    G(u16),
    /// The M word with this code.
    M(u32),
}

/// Another place that belongs to a finding.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Beside {
    /// The block.
    pub place: Place,
    /// What about it.
    pub text: &'static str,
}

/// Something legal and suspect.
#[derive(Clone, PartialEq, Debug)]
pub struct Finding {
    /// What.
    pub rule: Rule,
    /// Which shade of it, empty where there is only one.
    pub shade: &'static str,
    /// When in the run it came up: blocks counted from the program's start.
    pub order: u64,
    /// The block.
    pub place: Place,
    /// The word.
    pub at: At,
    /// Values for the sentences, by their names.
    pub values: Vec<(&'static str, String)>,
    /// What stands under the word.
    pub label: String,
    /// Another place that belongs to it.
    pub beside: Option<Beside>,
    /// The two readings of a number without a point are to be said, and only if both can be meant.
    pub readings: Option<Readings>,
    /// How many least increments a number without a point counts each: 10 with the option for it.
    pub coarse: i64,
    /// It is the value itself, by a parameter.
    pub whole_units: bool,
}

/// In what the number of a word counts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Readings {
    /// mm.
    Millimetres,
    /// Inches.
    Inches,
    /// Degrees.
    Degrees,
}

impl Finding {
    /// A finding at a block.
    pub(crate) fn new(rule: Rule, shade: &'static str, command: &Command, at: At) -> Finding {
        Finding::at(rule, shade, command.block, command.place, at)
    }

    /// A finding at a place.
    pub(crate) fn at(rule: Rule, shade: &'static str, order: u64, place: Place, at: At) -> Finding {
        Finding {
            rule,
            shade,
            order,
            place,
            at,
            values: Vec::new(),
            label: String::new(),
            beside: None,
            readings: None,
            coarse: 1,
            whole_units: false,
        }
    }

    /// The same with a value.
    #[must_use]
    pub(crate) fn with(mut self, name: &'static str, value: impl Into<String>) -> Finding {
        self.values.push((name, value.into()));
        self
    }

    /// The same with what stands under the word.
    #[must_use]
    pub(crate) fn labelled(mut self, label: impl Into<String>) -> Finding {
        self.label = label.into();
        self
    }

    /// The same with another place.
    #[must_use]
    pub(crate) fn beside(mut self, place: Place, text: &'static str) -> Finding {
        self.beside = Some(Beside { place, text });
        self
    }
}

/// Findings on their way out, each block's of a rule once.
#[derive(Default)]
pub(crate) struct Found {
    pub list: Vec<Finding>,
    said: BTreeSet<(Rule, SourceId, u64)>,
}

impl Found {
    /// True if this rule has not spoken of this block before; a loop comes to a block many times.
    pub fn is_new(&mut self, rule: Rule, place: &Place) -> bool {
        let key = (rule, place.source, place.block.start);
        if self.said.contains(&key) || self.said.len() >= MOST_SAID {
            return false;
        }
        self.said.insert(key)
    }

    /// Takes a finding in, unless its rule has spoken of the block before.
    pub fn say(&mut self, rule: Rule, place: &Place, make: impl FnOnce() -> Finding) {
        if self.is_new(rule, place) {
            self.list.push(make());
        }
    }
}
