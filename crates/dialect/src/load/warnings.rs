//! `warnings.toml`, that of all controls and that of one.

use data::Table;

use super::origin;
use crate::warning::{OwnWarning, WarningRow};

/// The rows of all controls.
pub(super) fn rows(root: &mut Table) -> Vec<WarningRow> {
    root.tables("warning", |row| WarningRow {
        name: row.required_string("name"),
        shade: row.string("shade").unwrap_or_default(),
        own: row.boolean("own").unwrap_or(false),
        what: row.required_string("what"),
        why: row.required_string("why"),
        help: row.required_string("help"),
    })
}

/// The rows of one control.
pub(super) fn own(root: &mut Table) -> Vec<OwnWarning> {
    root.tables("warning", |row| OwnWarning {
        name: row.required_string("name"),
        shade: row.string("shade").unwrap_or_default(),
        text: row.required_string("text"),
        help: row.string("help"),
        origin: origin(row),
    })
}
