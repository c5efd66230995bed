//! Standard output, buffered, and whether a terminal is there.

use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

use report::Paint;

use crate::failure::Failure;

/// Bytes gathered before they are written.
const ENOUGH: usize = 64 * 1024;

/// Standard output through one buffer.
pub struct Output {
    /// What waits to be written.
    pub buffer: Vec<u8>,
}

impl Output {
    /// Nothing written yet.
    pub fn new() -> Output {
        Output { buffer: Vec::with_capacity(2 * ENOUGH) }
    }

    /// True if enough has been gathered to be written.
    pub fn is_enough(&self) -> bool {
        self.buffer.len() >= ENOUGH
    }

    /// Writes what has been gathered, if it is enough.
    pub fn pass(&mut self) -> Result<(), Failure> {
        if self.is_enough() { self.flush() } else { Ok(()) }
    }

    /// Writes what has been gathered.
    pub fn flush(&mut self) -> Result<(), Failure> {
        let mut out = io::stdout().lock();
        out.write_all(&self.buffer)?;
        out.flush()?;
        self.buffer.clear();
        Ok(())
    }
}

/// Writes a file, `-` for standard output; never over a file that the command reads.
pub fn write_file(path: &Path, bytes: &[u8], read: &[&Path]) -> Result<(), Failure> {
    let shown = path.display();
    if path.as_os_str() == "-" {
        return Ok(io::stdout().lock().write_all(bytes)?);
    }
    if let Ok(own) = fs::canonicalize(path)
        && own.is_file()
        && read.iter().any(|other| fs::canonicalize(other).is_ok_and(|other| other == own))
    {
        return Err(Failure::call(format!("{shown} is read by this command; nothing is written over it")));
    }
    fs::write(path, bytes).map_err(|error| Failure::call(format!("cannot write {shown}: {error}")))
}

/// Writes to standard error; that nobody reads it is no reason to fail.
pub fn say(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// Lines for people are at least this long, on a pipe exactly this long.
const WIDTH: usize = 80;
/// Longer lines are hard to read.
const WIDEST: usize = 100;

/// How text for people is laid out on standard output.
pub fn paint_out() -> Paint {
    let terminal = io::stdout().is_terminal().then(terminal_size::terminal_size).flatten();
    let width = terminal.map_or(WIDTH, |(width, _)| usize::from(width.0).clamp(WIDTH, WIDEST));
    Paint { colour: colour_out(), width }
}

fn wants_colour() -> bool {
    std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Colour on standard output.
pub fn colour_out() -> bool {
    io::stdout().is_terminal() && wants_colour()
}

/// Colour on standard error.
pub fn colour_err() -> bool {
    io::stderr().is_terminal() && wants_colour()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_written_over_what_is_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let (read, other) = (folder.path().join("part.nc"), folder.path().join("part.txt"));
        fs::write(&read, "M30").expect("written");
        let same = folder.path().join(".").join("part.nc");
        assert!(write_file(&same, b"sheet", &[&other, &read]).is_err());
        assert_eq!(fs::read(&read).expect("still there"), b"M30");
        write_file(&other, b"sheet", &[&read]).expect("another file");
        assert_eq!(fs::read(&other).expect("written"), b"sheet");
    }
}
