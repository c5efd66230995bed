//! The corpus of a control as a whole: nothing left out, nothing raised unseen.

use std::fs;
use std::path::Path;

use crate::case::Case;
use crate::motion::{read_event, text};
use crate::rules::Rules;
use crate::{file_name, folders};

/// Every rule of `rules.toml` has a folder that begins with its number, as `r29-`, and that folder says so in `covers`.
///
/// # Errors
/// The rules without a folder, and the folders that do not cover their rule.
pub fn rules_have_folders(control: &Path) -> Result<(), String> {
    let rules = Rules::read(control)?;
    if rules.rules.is_empty() {
        return Err("rules.toml lists no rules".to_owned());
    }
    let folders = folders(control)?;
    let mut faults = Vec::new();
    for rule in &rules.rules {
        let number: u32 = rule.trim_start_matches('R').parse().map_err(|_| format!("`{rule}` is no rule's name"))?;
        let start = format!("r{number:02}-");
        let own: Vec<_> = folders.iter().filter(|folder| file_name(folder).starts_with(&start)).collect();
        if own.is_empty() {
            faults.push(format!("{rule} has no folder {start}…"));
        }
        for folder in own {
            if !Case::read(folder)?.covers.contains(rule) {
                faults.push(format!("{}: `covers` does not name {rule}", file_name(folder)));
            }
        }
    }
    report(faults)
}

/// Every alarm that a case's `out.trace` raises stands in the case's `covers`.
///
/// # Errors
/// The alarms that do not.
pub fn alarms_are_covered(control: &Path) -> Result<(), String> {
    let mut faults = Vec::new();
    for folder in folders(control)? {
        let Ok(trace) = fs::read_to_string(folder.join("out.trace")) else { continue };
        let covers = Case::read(&folder)?.covers;
        for line in trace.lines().filter(|line| line.contains("\"event\":\"alarm\"")) {
            let event = read_event(line)?;
            let alarm = text(&event, "name");
            if !covers.iter().any(|covered| covered == alarm) {
                faults.push(format!("{}: `covers` does not name the alarm {alarm}", file_name(&folder)));
            }
        }
    }
    report(faults)
}

/// Every rule, table and program that a case covers is described in `rules.toml`.
///
/// # Errors
/// Those that are not.
pub fn covers_are_known(control: &Path) -> Result<(), String> {
    let rules = Rules::read(control)?;
    let mut faults = Vec::new();
    for folder in folders(control)? {
        for covered in Case::read(&folder)?.covers {
            if !rules.knows(&covered) {
                faults.push(format!(
                    "{}: `covers` names {covered}, which rules.toml does not describe",
                    file_name(&folder)
                ));
            }
        }
    }
    report(faults)
}

/// Every warning of `controls/warnings.toml` beside the corpus has a case that shows it and one that must not.
///
/// The folders of a warning begin with `warning-` and its name. Warnings of single controls count where a control's own
/// tables list them.
///
/// # Errors
/// The warnings that lack one of the two.
pub fn warnings_have_cases(control: &Path) -> Result<(), String> {
    let Some(controls) = control.ancestors().nth(2).map(|root| root.join("controls")) else { return Ok(()) };
    let Ok(all) = fs::read_to_string(controls.join("warnings.toml")) else { return Ok(()) };
    let own = fs::read_to_string(controls.join(file_name(control)).join("warnings.toml")).unwrap_or_default();
    let mut faults = Vec::new();
    for row in all.split("[[warning]]").skip(1) {
        let name = row.split('"').nth(1).unwrap_or_default();
        let listed = own.contains(&format!("name = \"{name}\""));
        if row.contains("own = true") && !listed {
            continue;
        }
        let (mut shown, mut silent) = (false, false);
        for folder in
            folders(control)?.iter().filter(|folder| file_name(folder).starts_with(&format!("warning-{name}")))
        {
            let out = fs::read_to_string(folder.join("out.trace")).unwrap_or_default();
            let says = out.contains(&format!("[{name}]"));
            // What waits for a function cannot be shown yet.
            let waits = Case::read(folder)?.waits.is_some();
            shown |= says || waits;
            silent |= !says && !waits;
        }
        for (has, what) in [(shown, "shows it"), (silent, "must not")] {
            if !has {
                faults.push(format!("the warning {name} has no case warning-{name}… that {what}"));
            }
        }
    }
    faults.dedup();
    report(faults)
}

fn report(faults: Vec<String>) -> Result<(), String> {
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
}
