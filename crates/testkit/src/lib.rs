//! The corpus runner: every folder of `cases/CONTROL/` is a test of its own.
//!
//! Comes in: the program to test and the folder of the corpus. Goes out: one test a folder, and the tests of the corpus
//! as a whole. Must never know: what a control does. What is expected stands in the folders, and only there.

#![allow(clippy::disallowed_methods, clippy::disallowed_types)] // the edge of the house: files and processes

mod allocation;
mod case;
mod coverage;
mod difference;
mod judge;
mod motion;
mod program;
mod random;
mod rules;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use libtest_mimic::{Arguments, Failed, Trial};

pub use allocation::{Counting, allocations_so_far};
pub use case::{Case, Waits};
pub use coverage::{alarms_are_covered, covers_are_known, rules_have_folders, warnings_have_cases};
pub use difference::difference;
pub use judge::{Mode, judge};
pub use program::{Call, Outcome, Program};
pub use random::{Dice, Random};

/// Set to anything, it makes the runner write what the program prints into the case folders.
const REWRITE: &str = "UPDATE_CASES";

/// Runs the corpus in `folder` against the program at `program`, as `cargo test` asks on the command line.
pub fn run_corpus(program: &str, folder: &str) -> ExitCode {
    let arguments = Arguments::from_args();
    let mode = if std::env::var_os(REWRITE).is_some() { Mode::Rewrite } else { Mode::Compare };
    match trials(Path::new(program), Path::new(folder), mode) {
        Ok(trials) => libtest_mimic::run(&arguments, trials).exit_code(),
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// The tests of a corpus: one a case, four a control.
///
/// # Errors
/// The corpus is not there or empty.
pub fn trials(program: &Path, corpus: &Path, mode: Mode) -> Result<Vec<Trial>, String> {
    let program = Arc::new(program.to_owned());
    let mut trials = Vec::new();
    for control in folders(corpus)? {
        let name = file_name(&control);
        for folder in folders(&control)? {
            trials.push(case_trial(&name, folder, program.clone(), mode));
        }
        trials.extend(corpus_trials(&name, &control));
    }
    if trials.is_empty() {
        return Err(format!("{}: the corpus is empty", corpus.display()));
    }
    Ok(trials)
}

fn case_trial(control: &str, folder: PathBuf, program: Arc<PathBuf>, mode: Mode) -> Trial {
    let name = format!("{control}/{}", file_name(&folder));
    let kind = match Case::read(&folder) {
        Ok(Case { waits: Some(waits), .. }) => format!("waits for {}", waits.name()),
        _ => String::new(),
    };
    let run = move || judge(&folder, mode, &|call: &Call| program::start(&program, call)).map_err(Failed::from);
    Trial::test(name, run).with_kind(kind)
}

fn corpus_trials(control: &str, folder: &Path) -> Vec<Trial> {
    type Check = fn(&Path) -> Result<(), String>;
    let checks: [(&str, Check); 4] = [
        ("every-rule-has-a-folder", rules_have_folders),
        ("every-raised-alarm-is-covered", alarms_are_covered),
        ("every-covered-rule-is-known", covers_are_known),
        ("every-warning-has-its-cases", warnings_have_cases),
    ];
    let trial = |(name, check): (&str, Check)| {
        let folder = folder.to_owned();
        Trial::test(format!("corpus/{control}/{name}"), move || check(&folder).map_err(Failed::from))
    };
    checks.into_iter().map(trial).collect()
}

/// The folders in a folder, in the order of their names.
pub(crate) fn folders(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let cannot = |error: std::io::Error| format!("cannot read {}: {error}", folder.display());
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(cannot)? {
        let path = entry.map_err(cannot)?.path();
        if path.is_dir() {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

pub(crate) fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}
