//! `controls NAME --coverage`: the corpus of cases held against the control's tables.

use std::fs;
use std::io::Write;
use std::path::Path;

use data::{Document, Table};
use report::{CoveredRow, CoveringCase, coverage as listing, rows_of};

use crate::failure::Failure;
use crate::setting;

pub fn coverage(name: &str, controls: Option<&Path>, cases: &Path) -> Result<bool, Failure> {
    let control = setting::load(name, controls)?;
    let folder = cases.join(&control.family);
    let mut rows = rows_of(&control);
    rows.extend(rules(&folder)?);
    let (text, whole) = listing(&control.title, &rows, &cases_in(&folder)?);
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(whole)
}

fn read<T>(path: &Path, build: impl FnOnce(&mut Table) -> T) -> Result<T, Failure> {
    let name = path.to_string_lossy();
    let text = fs::read_to_string(path).map_err(|error| {
        Failure::call(format!("cannot read {name}: {error}; --cases names the folder of the corpus"))
    })?;
    Document::read(&name, &text, build)
        .map_err(|errors| Failure::call(errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n")))
}

/// The rules, rows of tables and programs that cases refer to.
fn rules(folder: &Path) -> Result<Vec<CoveredRow>, Failure> {
    read(&folder.join("rules.toml"), |root| {
        root.integer("format");
        let mut rows = Vec::new();
        for (key, table) in [("rule", "rules"), ("table", "rows of the manual's tables"), ("program", "programs")] {
            rows.extend(root.tables(key, |row| CoveredRow {
                table: table.to_owned(),
                name: row.required_string("name"),
                text: row.required_string("text"),
            }));
        }
        rows
    })
}

fn cases_in(folder: &Path) -> Result<Vec<CoveringCase>, Failure> {
    let entries = fs::read_dir(folder)
        .map_err(|error| Failure::call(format!("cannot read {}: {error}", folder.to_string_lossy())))?;
    let mut folders: Vec<_> = entries.flatten().map(|entry| entry.path()).filter(|path| path.is_dir()).collect();
    folders.sort();
    let case = |folder: &std::path::PathBuf| {
        read(&folder.join("case.toml"), |root| {
            let covers = root.strings("covers").unwrap_or_default();
            let waits = root.string("waits");
            // What else a case says is the runner's.
            root.rest();
            let name = folder.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
            CoveringCase { name, covers, waits }
        })
    };
    folders.iter().map(case).collect()
}
