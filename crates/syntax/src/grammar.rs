//! The few things in which controls' program texts differ.

/// What `;` is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Semicolon {
    /// It ends the block, as printed for the end-of-block character.
    #[default]
    EndOfBlock,
    /// It ends the block, and the rest of the line is a comment.
    Comment,
}

/// What small letters are.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum LowerCase {
    /// Not a character of the control.
    #[default]
    Refuse,
    /// The same as capitals.
    Fold,
}

/// What `:` is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Colon {
    /// Another spelling of the letter O.
    #[default]
    ProgramNumber,
    /// Not a character of the control.
    Refuse,
}

/// How a text divides into programs.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Grouping {
    /// Each O word begins a program; one text may hold several.
    #[default]
    OWords,
    /// A file is a program.
    Files,
}

/// How a control's program text is read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Grammar {
    /// What `;` is.
    pub semicolon: Semicolon,
    /// What small letters are.
    pub lower_case: LowerCase,
    /// What `:` is.
    pub colon: Colon,
    /// How a text divides into programs.
    pub grouping: Grouping,
    /// Most characters of a block, its end included.
    pub block_length: u32,
}

impl Default for Grammar {
    fn default() -> Self {
        Grammar {
            semicolon: Semicolon::default(),
            lower_case: LowerCase::default(),
            colon: Colon::default(),
            grouping: Grouping::default(),
            block_length: u32::MAX,
        }
    }
}
