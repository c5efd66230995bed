//! What `check` warns of, as far as it is data: the sentences, and which control a warning is for.

use crate::row::Origin;

/// One warning in one of its shades: what is suspect, why the machine cares, what to do.
///
/// The sentences have places for values, as `{axis}`; the rule that finds it says which.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct WarningRow {
    /// Its name.
    pub name: String,
    /// Which shade of it, empty where there is only one.
    pub shade: String,
    /// True if it is only for controls whose own tables list it.
    pub own: bool,
    /// What is suspect.
    pub what: String,
    /// Why the machine cares.
    pub why: String,
    /// What to do.
    pub help: String,
}

/// A warning that a control's own tables list, because it is about something that this control does differently.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct OwnWarning {
    /// Its name.
    pub name: String,
    /// What this control does and others do not.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}
