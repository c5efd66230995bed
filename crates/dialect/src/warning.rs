//! What `check` warns of, as far as it is data: the sentences, and which control a warning is for.

use crate::control::Control;
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

/// A warning that a control's own tables list, because it is about something that this control does differently, or is
/// helped in another way there.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct OwnWarning {
    /// Its name.
    pub name: String,
    /// Of which shade, empty for all.
    pub shade: String,
    /// What this control does and others do not.
    pub text: String,
    /// What to do on this control, where that is not what is done on others.
    pub help: Option<String>,
    /// What the row rests on.
    pub origin: Origin,
}

impl Control {
    /// The sentences of a warning in one of its shades: what, why, what to do on this control.
    pub fn warning(&self, name: &str, shade: &str) -> Option<[&str; 3]> {
        let row = self.warnings.iter().find(|row| row.name == name && row.shade == shade)?;
        let mut own = self.own_warnings.iter().filter(|own| own.name == name);
        let own = own.find(|own| own.help.is_some() && (own.shade.is_empty() || own.shade == shade));
        Some([&row.what, &row.why, own.and_then(|own| own.help.as_deref()).unwrap_or(&row.help)])
    }
}
