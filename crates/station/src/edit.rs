//! The keys of the edit display as actions: `edit find X10.`, `edit insert G04 P500`, `edit delete block`.

use std::fmt;

/// What the operator does at the edit display.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Edit {
    /// `edit top`: the cursor goes to the program's first word.
    Top,
    /// `edit next`
    Next,
    /// `edit back`
    Back,
    /// `edit line 12`: the cursor goes to the first word of a line.
    Line(u64),
    /// `edit find X10.`, `edit find X`: the cursor goes on to a word, or to the next word of an address.
    Find(String),
    /// `edit insert …`: typed words are put in behind the cursor; `;` ends a block.
    Insert(String),
    /// `edit alter …`: typed words take the place of the one at the cursor.
    Alter(String),
    /// `edit delete`: the word at the cursor.
    Delete,
    /// `edit delete block`: the block at the cursor, with its end.
    DeleteBlock,
    /// `edit delete program O1234`
    DeleteProgram(String),
    /// `edit new O1234`
    New(String),
}

impl fmt::Display for Edit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Edit::Top => f.write_str("top"),
            Edit::Next => f.write_str("next"),
            Edit::Back => f.write_str("back"),
            Edit::Line(line) => write!(f, "line {line}"),
            Edit::Find(word) => write!(f, "find {word}"),
            Edit::Insert(words) => write!(f, "insert {words}"),
            Edit::Alter(words) => write!(f, "alter {words}"),
            Edit::Delete => f.write_str("delete"),
            Edit::DeleteBlock => f.write_str("delete block"),
            Edit::DeleteProgram(name) => write!(f, "delete program {name}"),
            Edit::New(name) => write!(f, "new {name}"),
        }
    }
}

/// Reads what stands behind `edit`; `None` if it is no such key.
pub(crate) fn read_edit(words: &[&str], rest: &str) -> Option<Edit> {
    // Typed words are taken as they stand, blanks and all.
    let typed = || rest.split_once(char::is_whitespace).map(|(_, typed)| typed.trim().to_owned());
    Some(match words {
        ["top"] => Edit::Top,
        ["next"] => Edit::Next,
        ["back"] => Edit::Back,
        ["line", line] => Edit::Line(line.parse().ok()?),
        ["find", _, ..] => Edit::Find(typed()?),
        ["insert", _, ..] => Edit::Insert(typed()?),
        ["alter", _, ..] => Edit::Alter(typed()?),
        ["delete"] => Edit::Delete,
        ["delete", "block"] => Edit::DeleteBlock,
        ["delete", "program", name] => Edit::DeleteProgram((*name).to_owned()),
        ["new", name] => Edit::New((*name).to_owned()),
        _ => return None,
    })
}

impl Edit {
    /// True for what changes memory.
    pub fn changes(&self) -> bool {
        !matches!(self, Edit::Top | Edit::Next | Edit::Back | Edit::Line(_) | Edit::Find(_))
    }
}
