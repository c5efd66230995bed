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

/// What `%` is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Percent {
    /// A block of its own, the start or end of a tape.
    #[default]
    EndOfTape,
    /// Alone on a line it says nothing; elsewhere it is not a character of the control.
    Ignore,
}

/// Where a block-delete sign may stand.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum BlockDelete {
    /// Anywhere, with the number of a switch behind it: the rest of the block is skipped.
    #[default]
    Anywhere,
    /// At the block's head or behind its number, for one switch and the whole block.
    Head,
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
    /// What `%` is.
    pub percent: Percent,
    /// Where a block-delete sign may stand.
    pub block_delete: BlockDelete,
    /// The M code behind which the name of a program's file stands, up to a blank, a comment or the end of the block.
    pub named_call: Option<u32>,
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
            percent: Percent::default(),
            block_delete: BlockDelete::default(),
            named_call: None,
            block_length: u32::MAX,
        }
    }
}
