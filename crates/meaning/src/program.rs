//! Programs by name, and the levels of calls.

use std::collections::BTreeMap;

use base::{Condition, ProgramId, SourceId};
use dialect::FileNames;
use syntax::Cursor;

/// A program that is called.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ProgramKey {
    /// By its number.
    Number(u32),
    /// By its file.
    File {
        /// The file's name with its ending, in capitals.
        name: ProgramId,
        /// The name was written with its ending, as that of a large program.
        large: bool,
    },
}

/// The longest name of a program's file.
const LONGEST_NAME: usize = 64;
/// Names that are kept. No program calls so many others; one that names more is refused as one that is not there.
const MOST_NAMES: usize = 65_536;

/// The program that a block calls by name, or what is wrong with the name.
pub(crate) type CallName = Option<Result<ProgramKey, Condition>>;

/// The names of programs, each kept once.
#[derive(Clone, Default)]
pub(crate) struct Names {
    names: Vec<String>,
    by_name: BTreeMap<String, u32>,
    by_number: BTreeMap<u32, ProgramId>,
}

impl Names {
    pub fn intern(&mut self, name: &str) -> ProgramId {
        if let Some(&index) = self.by_name.get(name) {
            return ProgramId(index);
        }
        let index = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.by_name.insert(name.to_owned(), index);
        ProgramId(index)
    }

    /// The name of a numbered program; a name already known is found without making its text anew.
    pub fn numbered(&mut self, number: u32) -> ProgramId {
        if let Some(&program) = self.by_number.get(&number) {
            return program;
        }
        let program = self.intern(&format!("O{number}"));
        self.by_number.insert(number, program);
        program
    }

    /// The program that a call names: its file, or (`numbers`) P and its number.
    ///
    /// # Errors
    /// It is no program's name.
    pub fn called(&mut self, text: &[u8], files: &FileNames, numbers: bool) -> Result<ProgramKey, Condition> {
        if let [b'P' | b'p', digits @ ..] = text
            && numbers
            && !digits.is_empty()
            && digits.iter().all(u8::is_ascii_digit)
        {
            let number = std::str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok());
            return match number {
                Some(number) if number > 0 => Ok(ProgramKey::Number(number)),
                Some(_) => Err(Condition::CallTargetMissing),
                None => Err(Condition::ProgramName),
            };
        }
        let (stem, ending) = match text.iter().position(|&byte| byte == b'.') {
            Some(point) => (&text[..point], Some(&text[point + 1..])),
            None => (text, None),
        };
        if stem.is_empty() || !stem.iter().all(|&byte| byte.is_ascii_alphanumeric() || byte == b'_') {
            return Err(Condition::ProgramName);
        }
        let large =
            files.large.as_ref().filter(|large| ending.is_some_and(|e| e.eq_ignore_ascii_case(large.as_bytes())));
        if ending.is_some() && large.is_none() {
            return Err(Condition::ProgramEnding);
        }
        let ending = large.unwrap_or(&files.ending).as_bytes();
        let mut name = [0u8; LONGEST_NAME];
        let len = stem.len() + 1 + ending.len();
        let Some(room) = name.get_mut(..len) else { return Err(Condition::ProgramName) };
        for (to, from) in room.iter_mut().zip(stem.iter().chain(b".").chain(ending)) {
            *to = from.to_ascii_uppercase();
        }
        let name = std::str::from_utf8(room).map_err(|_| Condition::ProgramName)?;
        if self.names.len() >= MOST_NAMES && !self.by_name.contains_key(name) {
            return Err(Condition::FileNotFound);
        }
        Ok(ProgramKey::File { name: self.intern(name), large: large.is_some() })
    }

    /// The number of a program that is named by one, 0 for others.
    pub fn number(&self, program: ProgramId) -> u32 {
        self.name(program).strip_prefix('O').and_then(|digits| digits.parse().ok()).unwrap_or(0)
    }

    pub fn name(&self, program: ProgramId) -> &str {
        self.names.get(program.0 as usize).map_or("", String::as_str)
    }
}

/// How a program came to be executed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) enum CalledBy {
    /// It is the main program.
    #[default]
    Selection,
    /// M98: with its caller's local variables.
    Subprogram,
    /// G65: with local variables of its own.
    Macro,
    /// G66: after a move.
    ModalMacro,
}

/// Where a main program goes on: to leave it for another and come back.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pointer(pub(crate) Frame);

impl Pointer {
    /// Where in its text the next block to read begins.
    pub const fn offset(&self) -> u64 {
        self.0.cursor.offset
    }
}

/// One program in execution: the main program or a subprogram on its level.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Frame {
    pub called_by: CalledBy,
    /// The level of its local variables.
    pub level: u8,
    /// The block with which it begins, each time it is repeated.
    pub entry: Cursor,
    pub program: ProgramId,
    pub source: SourceId,
    /// Where the program begins in its text.
    pub head: Cursor,
    /// The next block to read.
    pub cursor: Cursor,
    /// Its first block has been read: from here on an O word belongs to the next program.
    pub begun: bool,
    /// Where that block begins.
    pub first: u64,
    /// It was called as a large program.
    pub large: bool,
    /// The sign that begins a tape has been read: the next one ends it.
    pub opened: bool,
    /// How many more times it runs after this one.
    pub repeats: u32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_called_are_not_kept_without_end() {
        let files = FileNames { ending: "CNC".into(), large: None };
        let mut names = Names::default();
        for number in 0..MOST_NAMES + 10 {
            let called = names.called(format!("A{number}").as_bytes(), &files, false);
            assert_eq!(called.is_ok(), number < MOST_NAMES);
        }
        assert!(names.called(b"a7", &files, false).is_ok(), "a name already known");
        assert_eq!(names.names.len(), MOST_NAMES);
    }
}
