//! Diagnostics as data: one struct, several faces (terminal, JSON, SARIF, editor, panel).

use crate::{Place, Span};

/// How bad it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, PartialOrd, Ord)]
pub enum Severity {
    /// Legal, and dangerous.
    Warning,
    /// The control refuses the block.
    Error,
}

impl Severity {
    /// The word shown to people and machines.
    pub const fn name(self) -> &'static str {
        match self {
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// What the control itself calls it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct AlarmName {
    /// The reference name of the alarm, such as `G_COMBINATION`.
    pub name: String,
    /// The number the control shows, where it is known.
    pub number: Option<u32>,
    /// The control's short text.
    pub text: String,
}

/// One finding about a program, in three sentences: what is wrong, why the machine cares, what to do.
#[derive(Clone, PartialEq, Debug)]
pub struct Diagnostic {
    /// Stable kebab-case name of the condition.
    pub code: &'static str,
    /// Error or warning.
    pub severity: Severity,
    /// What is wrong, with numbers and units.
    pub message: String,
    /// Why the machine cares.
    pub why: String,
    /// What to do.
    pub help: String,
    /// The control's alarm, for errors.
    pub alarm: Option<AlarmName>,
    /// The block.
    pub place: Place,
    /// The offending word, or the whole block.
    pub span: Span,
    /// What stands under it, for warnings; an alarm's own name does for errors.
    pub label: String,
    /// Other places that belong to it.
    pub labels: Vec<Label>,
    /// How the block can be written instead.
    pub fix: Option<Correction>,
}

/// A block as it can be written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Correction {
    /// The characters that it replaces.
    pub span: Span,
    /// What takes their place: blocks, one a line.
    pub text: String,
    /// The programmer evidently meant this; otherwise it is a guess.
    pub safe: bool,
}

/// Another place that belongs to a finding.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Label {
    /// The block.
    pub place: Place,
    /// The word, or the whole block.
    pub span: Span,
    /// What about it.
    pub text: String,
}
