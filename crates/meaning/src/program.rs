//! Programs by name, and the levels of calls.

use std::collections::BTreeMap;

use base::{ProgramId, SourceId};
use syntax::Cursor;

/// The names of programs, each kept once.
#[derive(Default)]
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
    /// The sign that begins a tape has been read: the next one ends it.
    pub opened: bool,
    /// How many more times it runs after this one.
    pub repeats: u32,
}
