//! `rules.toml` of a control: the rules, tables and example programs that its cases refer to, each in a sentence.

use std::fs;
use std::path::Path;

use data::{DataError, Document, Table};

/// What the cases of a control may refer to.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Rules {
    /// `R29`, in the order of the file.
    pub rules: Vec<String>,
    /// `5.11`.
    pub tables: Vec<String>,
    /// `P1`.
    pub programs: Vec<String>,
}

impl Rules {
    /// Reads a control's rules.
    ///
    /// # Errors
    /// The file is missing, or every error in it.
    pub fn read(control: &Path) -> Result<Rules, String> {
        let path = control.join("rules.toml");
        let name = path.to_string_lossy();
        let text = fs::read_to_string(&path).map_err(|error| format!("cannot read {name}: {error}"))?;
        let read = Document::read(&name, &text, |table| {
            table.require("format");
            table.integer("format");
            Rules { rules: names(table, "rule"), tables: names(table, "table"), programs: names(table, "program") }
        });
        read.map_err(|errors| errors.iter().map(DataError::to_string).collect::<Vec<_>>().join("\n\n"))
    }

    /// True if this is the name of something that the file describes, or of something that it does not list at all: a
    /// code, an alarm, a policy.
    pub fn knows(&self, covered: &str) -> bool {
        let numbered = |letter| {
            covered
                .strip_prefix(letter)
                .is_some_and(|rest: &str| !rest.is_empty() && rest.bytes().all(|b| b.is_ascii_digit()))
        };
        let is_in = |names: &[String]| names.iter().any(|name| name == covered);
        if numbered('R') {
            is_in(&self.rules)
        } else if numbered('P') {
            is_in(&self.programs)
        } else if covered.starts_with(|c: char| c.is_ascii_digit()) {
            is_in(&self.tables)
        } else {
            !covered.trim().is_empty()
        }
    }
}

fn names(table: &mut Table, key: &'static str) -> Vec<String> {
    table.tables(key, |row| {
        let name = row.required_string("name");
        row.required_string("text");
        name
    })
}
