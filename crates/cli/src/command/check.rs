//! `check`: every alarm the control would raise, of many programs, without motion.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use machine::EventKind;
use report::{Format, begin, end, render, separator};
use station::AfterAlarm;

use super::{open, run_through};
use crate::arguments::{CheckArguments, FormatArgument};
use crate::failure::Failure;
use crate::output::{Output, colour_out};
use crate::show_alarm::show_alarm;
use crate::texts::looks_like_program;

/// Findings that are remembered so as not to be said twice.
const MOST_REMEMBERED: usize = 100_000;

pub fn check(arguments: &CheckArguments) -> Result<bool, Failure> {
    let mut found = 0;
    match check_all(arguments, &mut found) {
        // Whoever reads no further has still been told that there are alarms.
        Err(Failure::PipeClosed) => Ok(found == 0),
        outcome => outcome,
    }
}

fn check_all(arguments: &CheckArguments, found: &mut u64) -> Result<bool, Failure> {
    let format = match arguments.format {
        FormatArgument::Text => Format::Text { colour: colour_out() },
        FormatArgument::Json => Format::Json,
        FormatArgument::Sarif => Format::Sarif,
        FormatArgument::Github => Format::Github,
    };
    let files = files(&arguments.files)?;
    let mut output = Output::new();
    let mut said = BTreeSet::new();
    output.buffer.extend_from_slice(begin(format).as_bytes());
    for file in &files {
        let mut session = open(file, &arguments.setting)?;
        let configuration = session.configuration().clone();
        let (control, machine) = (&configuration.control, &configuration.machine);
        session.set_after_alarm(AfterAlarm::GoOn);
        run_through(&mut session, arguments.setting.repeat, |session, event| {
            let EventKind::Alarm(alarm) = &event.kind else { return Ok(()) };
            // A block that is executed again is not refused anew.
            let key = (file.as_str(), alarm.place.source, alarm.span.start, alarm.condition.id());
            if said.contains(&key) {
                return Ok(());
            }
            if said.len() < MOST_REMEMBERED {
                said.insert(key);
            }
            let (diagnostic, excerpt) = show_alarm(alarm, control, machine, session.library_mut());
            if *found > 0 {
                output.buffer.extend_from_slice(separator(format).as_bytes());
            }
            *found += 1;
            output.buffer.extend_from_slice(render(&diagnostic, &excerpt, format).as_bytes());
            output.pass()
        })?;
    }
    output.buffer.extend_from_slice(end(format).as_bytes());
    if matches!(format, Format::Text { .. }) {
        let gap = if *found > 0 { "\n" } else { "" };
        let line = format!("{gap}{}: {}\n", count(files.len() as u64, "program"), alarms(*found));
        output.buffer.extend_from_slice(line.as_bytes());
    }
    output.flush()?;
    Ok(*found == 0)
}

fn count(number: u64, what: &str) -> String {
    if number == 1 { format!("1 {what}") } else { format!("{number} {what}s") }
}

fn alarms(number: u64) -> String {
    if number == 0 { "no alarms".to_owned() } else { count(number, "alarm") }
}

/// The programs that files, folders and patterns name, each once, in order.
fn files(names: &[String]) -> Result<Vec<String>, Failure> {
    let mut files = Vec::new();
    for name in names {
        let path = Path::new(name);
        if name == "-" || (path.exists() && !path.is_dir()) {
            files.push(name.clone());
        } else if path.is_dir() {
            let before = files.len();
            programs_in(path, &mut files)?;
            if files.len() == before {
                return Err(Failure::call(format!(
                    "{name}: the folder holds no programs (.nc .cnc .tap .eia .txt, O1234)"
                )));
            }
        } else {
            let matches = glob::glob(name).map_err(|e| Failure::call(format!("{name}: {e}")))?;
            let mut found: Vec<PathBuf> = matches.flatten().filter(|path| path.is_file()).collect();
            found.sort();
            if found.is_empty() {
                return Err(Failure::call(format!("cannot read {name}: there is no such file")));
            }
            files.extend(found.into_iter().map(|path| path.to_string_lossy().into_owned()));
        }
    }
    let mut seen = BTreeSet::new();
    files.retain(|file| seen.insert(file.clone()));
    Ok(files)
}

fn programs_in(folder: &Path, files: &mut Vec<String>) -> Result<(), Failure> {
    let cannot = |error| Failure::call(format!("cannot read {}: {error}", folder.display()));
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).map_err(cannot)?.flatten().map(|entry| entry.path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() && !path.is_symlink() {
            programs_in(&path, files)?;
        } else if path.is_file() && looks_like_program(&path) {
            files.push(path.to_string_lossy().into_owned());
        }
    }
    Ok(())
}
