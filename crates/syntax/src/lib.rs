//! Characters to blocks: words with their places, comments, block delete, macro statements recognised.
//!
//! Comes in: a window of a program's characters and a [`Cursor`]. Goes out: one [`Block`] at a time, reused from
//! call to call. Never fails: what is wrong becomes a [`Fault`] at its place. Must never know: what any code
//! means, or which control reads it; the few things in which controls' texts differ are in [`Grammar`].

mod block;
mod grammar;
mod layout;
mod lexer;
mod macro_text;
mod number;
mod print;
mod statement;

pub use block::{Block, Cursor, Extent, Fault, Skip, Statement, StatementKind, Value, Word};
pub use grammar::{BlockDelete, Colon, Grammar, Grouping, LowerCase, Percent, Semicolon};
pub use layout::{Item, lay_out, take_apart};
pub use lexer::{LONGEST, Outcome, read_block};
pub use macro_text::goto_number;
pub use print::print_block;
