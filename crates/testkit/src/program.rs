//! One call of the program.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// How the program is called.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Call {
    /// The working directory.
    pub folder: PathBuf,
    /// The command line.
    pub arguments: Vec<String>,
    /// What it reads on standard input.
    pub input: Vec<u8>,
}

/// What came of a call.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Outcome {
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
    /// The exit code; `None` if the program was killed.
    pub exit: Option<i32>,
}

/// Whatever can be called: the real program, or a stand-in in the tests of the runner.
pub type Program<'p> = &'p dyn Fn(&Call) -> io::Result<Outcome>;

/// Calls the program at this path, without colour, and waits for it.
pub(crate) fn start(program: &Path, call: &Call) -> io::Result<Outcome> {
    let mut child = Command::new(program)
        .args(&call.arguments)
        .current_dir(&call.folder)
        .env("NO_COLOR", "1")
        .env_remove("COLUMNS")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    if let Some(mut input) = child.stdin.take() {
        // A program that does not read its input is free to end before all of it is written.
        match input.write_all(&call.input) {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => return Err(error),
            _ => {}
        }
    }
    let output = child.wait_with_output()?;
    Ok(Outcome {
        out: String::from_utf8_lossy(&output.stdout).into_owned(),
        err: String::from_utf8_lossy(&output.stderr).into_owned(),
        exit: output.status.code(),
    })
}
