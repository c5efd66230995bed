//! A block as it was written.

use base::{Condition, Decimal, Span};

use crate::grammar::{Grammar, Grouping};

/// Where reading stands in a text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Cursor {
    /// Byte offset of the next character.
    pub offset: u64,
    /// 1-based line of that character.
    pub line: u64,
    /// Byte offset at which that line begins.
    pub line_start: u64,
    /// The rest of the line belongs to a block already given up as too long.
    pub skipping: bool,
}

impl Default for Cursor {
    fn default() -> Self {
        Cursor::HEAD
    }
}

impl Cursor {
    /// The head of a text.
    pub const HEAD: Cursor = Cursor { offset: 0, line: 1, line_start: 0, skipping: false };
}

/// A run of characters inside a block, counted from the block's first.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Extent {
    /// First character.
    pub at: u16,
    /// Number of characters.
    pub len: u16,
}

impl Extent {
    /// Cuts off what lies beyond a block of this length; at least its last character stays.
    pub(crate) fn clip(&mut self, block_len: u32) {
        let end = u16::try_from(block_len).unwrap_or(u16::MAX);
        self.at = self.at.min(end.saturating_sub(1));
        self.len = self.len.min(end - self.at);
    }

    /// The same as a place in the text.
    pub const fn span(self, block_start: u64) -> Span {
        Span { start: block_start + self.at as u64, len: self.len as u32 }
    }
}

/// What follows an address letter.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Value {
    /// A number.
    Number(Decimal),
    /// A variable or expression (`#1`, `-[#1+2]`); its text is the word's.
    Expression,
    /// Nothing that could be read; a fault stands at the place.
    Missing,
}

/// An address letter and what follows it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Word {
    /// The letter, always a capital.
    pub letter: u8,
    /// Where the word stands.
    pub extent: Extent,
    /// What follows the letter.
    pub value: Value,
}

/// A block-delete sign: with its switch on, everything after it is ignored.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Skip {
    /// The switch, 1 to 9; a bare `/` is 1.
    pub switch: u8,
    /// Index of the first word after the sign.
    pub first_word: u16,
    /// Where the sign stands.
    pub extent: Extent,
}

/// A macro statement's first word.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum StatementKind {
    /// `#1 = …`
    Assignment,
    /// `IF [ … ] …`
    If,
    /// `WHILE [ … ] DO n`
    While,
    /// `DO n`
    Do,
    /// `END n`
    End,
    /// `GOTO n`
    Goto,
}

/// A macro statement, recognised; what it says is read by the macro machine.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Statement {
    /// Its first word.
    pub kind: StatementKind,
    /// The whole statement.
    pub extent: Extent,
}

/// Something in the block that cannot be read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Fault {
    /// What is wrong.
    pub condition: Condition,
    /// Where.
    pub extent: Extent,
}

/// One block, reused from call to call so that reading does not allocate.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Block {
    /// Where the block begins: its first character that is not blank.
    pub start: Cursor,
    /// Characters from its first to its last, the end-of-block not counted.
    pub len: u32,
    /// Where the next block begins.
    pub next: Cursor,
    /// The block is the character `%` alone: start or end of the tape.
    pub rewind: bool,
    /// The words in their order.
    pub words: Vec<Word>,
    /// The block-delete signs in their order.
    pub skips: Vec<Skip>,
    /// The comments, parentheses included.
    pub comments: Vec<Extent>,
    /// The name of the program that the block calls, where a control calls programs by name.
    pub call_name: Option<Extent>,
    /// A macro statement, after the words if there are any.
    pub statement: Option<Statement>,
    /// A variable or expression stands in the place of some word's number.
    pub variables: bool,
    /// What could not be read, in order of place.
    pub faults: Vec<Fault>,
}

impl Default for Block {
    fn default() -> Self {
        Block {
            start: Cursor::HEAD,
            len: 0,
            next: Cursor::HEAD,
            rewind: false,
            words: Vec::with_capacity(32),
            skips: Vec::with_capacity(4),
            comments: Vec::with_capacity(4),
            call_name: None,
            statement: None,
            variables: false,
            faults: Vec::with_capacity(4),
        }
    }
}

impl Block {
    /// True if nothing but blanks and comments stands in it.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty() && self.statement.is_none() && self.faults.is_empty() && self.skips.is_empty()
    }

    /// True if a program begins with it, in a text that may hold several.
    pub fn begins_program(&self, grammar: &Grammar) -> bool {
        grammar.grouping == Grouping::OWords && self.words.first().is_some_and(|word| word.letter == b'O')
    }

    /// The whole number of the first word with this letter.
    pub fn whole_number(&self, letter: u8) -> Option<i64> {
        match self.words.iter().find(|word| word.letter == letter)?.value {
            Value::Number(number) => number.integer(),
            _ => None,
        }
    }

    /// The block's own characters as a place in the text.
    pub fn span(&self) -> Span {
        Span { start: self.start.offset, len: self.len }
    }

    pub(crate) fn clear(&mut self, start: Cursor) {
        self.start = start;
        self.next = start;
        self.len = 0;
        self.rewind = false;
        self.words.clear();
        self.skips.clear();
        self.comments.clear();
        self.call_name = None;
        self.statement = None;
        self.variables = false;
        self.faults.clear();
    }
}
