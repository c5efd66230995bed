//! One case judged: what the program prints against what the folder expects.

use std::fs;
use std::io;
use std::path::Path;

use tempfile::TempDir;

use crate::case::Case;
use crate::difference::difference;
use crate::motion;
use crate::program::{Call, Outcome, Program};

/// The alarm of a row that the program knows and does not execute yet.
const NOT_YET_BUILT: &str = "does not execute it yet";
/// What the operator is told of such an action.
const NOT_BUILT_YET: &str = "not built yet";

/// What is done with what the program prints.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Mode {
    /// It is compared with the folder.
    Compare,
    /// It is written into the folder, as the new expectation.
    Rewrite,
}

/// Judges the case in a folder.
///
/// # Errors
/// Everything in which the program and the folder differ, in words.
pub fn judge(folder: &Path, mode: Mode, program: Program) -> Result<(), String> {
    let case = Case::read(folder)?;
    let verdict =
        if case.same_motion { judge_pair(&case, folder, program) } else { judge_one(&case, folder, mode, program) };
    verdict.map_err(|message| format!("{}\n{message}", case.why))
}

fn judge_one(case: &Case, folder: &Path, mode: Mode, program: Program) -> Result<(), String> {
    let room = Room::new(case, folder).map_err(|error| format!("no room to run the case: {error}"))?;
    let outcome = run(case, room.folder(folder), case.file.as_deref(), program)?;
    let mut faults = Vec::new();
    if let Some(waits) = case.waits
        && ![&outcome.out, &outcome.err].iter().any(|text| text.contains(NOT_YET_BUILT) || text.contains(NOT_BUILT_YET))
    {
        let name = waits.name();
        faults.push(format!(
            "it no longer answers that it is not built yet: take out `waits = \"{name}\"` and write what is right"
        ));
    }
    let expected = Expected { folder, mode };
    let has_err = folder.join("err.txt").exists();
    let needs_out = !has_err && case.waits.is_none();
    if needs_out || !outcome.out.is_empty() && case.waits.is_none() || folder.join("out.trace").exists() {
        expected.compare("out.trace", &outcome.out, needs_out || mode == Mode::Rewrite, &mut faults);
    }
    if has_err {
        expected.compare("err.txt", &outcome.err, true, &mut faults);
    } else if case.exit == 0 && !outcome.err.is_empty() {
        faults.push(format!("standard error is not empty:\n{}", outcome.err));
    }
    let after = case.rewrites.iter().map(|file| (file, format!("{file}.after")));
    for (file, name) in case.writes.iter().map(|file| (file, file.clone())).chain(after) {
        match fs::read_to_string(room.folder(folder).join(file)) {
            Ok(text) => expected.compare(&name, &text, true, &mut faults),
            Err(error) => faults.push(format!("{file} was not written: {error}")),
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n\n")) }
}

fn judge_pair(case: &Case, folder: &Path, program: Program) -> Result<(), String> {
    let mut paths = Vec::new();
    for file in ["a.nc", "b.nc"] {
        if !folder.join(file).exists() {
            return Err(format!("{file} is missing: a pair has a.nc and b.nc"));
        }
        let outcome = run(case, folder, Some(file), program)?;
        paths.push(motion::motion_of(&outcome.out).map_err(|error| format!("{file}: {error}"))?);
    }
    if let [a, b] = &mut paths[..]
        && case.within_increment
    {
        *b = motion::settled(a, b);
    }
    let [a, b] = &paths[..] else { return Ok(()) };
    if a.is_empty() {
        return Err("a.nc moves nothing: two empty paths prove nothing".to_owned());
    }
    match difference(a, b) {
        None => Ok(()),
        Some(lines) => Err(format!("the motion of a.nc (-) and of b.nc (+) differs:\n{lines}")),
    }
}

/// Runs the case's command on a file; an exit code that is not the case's is an error.
fn run(case: &Case, folder: &Path, file: Option<&str>, program: Program) -> Result<Outcome, String> {
    let mut arguments = case.run.clone();
    if let Some(control) = &case.control {
        arguments.extend(["--control".to_owned(), control.clone()]);
    }
    arguments.extend(file.map(str::to_owned));
    arguments.extend(case.arguments.iter().cloned());
    let input = if file == Some("-") {
        fs::read(folder.join("in.nc")).map_err(|error| format!("cannot read in.nc: {error}"))?
    } else {
        Vec::new()
    };
    let line = arguments.join(" ");
    let call = Call { folder: folder.to_owned(), arguments, input };
    let outcome = program(&call).map_err(|error| format!("`{line}` cannot be run: {error}"))?;
    if outcome.exit == Some(case.exit) {
        return Ok(outcome);
    }
    let exit = outcome.exit.map_or("no exit code".to_owned(), |exit| format!("exit code {exit}"));
    Err(format!("`{line}` ends with {exit} instead of {}\n{}{}", case.exit, outcome.out, outcome.err))
}

/// The files of a folder that say what is expected.
struct Expected<'f> {
    folder: &'f Path,
    mode: Mode,
}

impl Expected<'_> {
    /// Compares a text with the file of this name, or writes it there. A missing file stands for no text unless it is
    /// `needed`.
    fn compare(&self, name: &str, text: &str, needed: bool, faults: &mut Vec<String>) {
        let path = self.folder.join(name);
        if self.mode == Mode::Rewrite {
            if let Err(error) = fs::write(&path, text) {
                faults.push(format!("{name} cannot be written: {error}"));
            }
            return;
        }
        let expected = match fs::read_to_string(&path) {
            Ok(expected) => expected,
            Err(error) if error.kind() == io::ErrorKind::NotFound && !needed => String::new(),
            Err(error) => {
                faults.push(format!("{name} cannot be read: {error}; the program prints\n{text}"));
                return;
            }
        };
        if let Some(lines) = difference(&expected, text) {
            faults.push(format!("{name} (-) and what the program prints (+) differ:\n{lines}"));
        }
    }
}

/// Where a command runs: in the case folder, or in a copy of it if the command writes files.
struct Room(Option<TempDir>);

impl Room {
    fn new(case: &Case, folder: &Path) -> io::Result<Room> {
        if case.writes.is_empty() && case.rewrites.is_empty() {
            return Ok(Room(None));
        }
        let copy = TempDir::new()?;
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            if path.is_file() && !case.writes.contains(&name) {
                fs::copy(&path, copy.path().join(name))?;
            }
        }
        Ok(Room(Some(copy)))
    }

    fn folder<'r>(&'r self, folder: &'r Path) -> &'r Path {
        self.0.as_ref().map_or(folder, TempDir::path)
    }
}
