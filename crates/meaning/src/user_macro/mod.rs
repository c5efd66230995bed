//! The user macro: variables, expressions, loops, calls with arguments.
//!
//! Comes in: the statements and variable words of blocks. They are compiled once to a small bytecode that is kept by
//! the place of its block ([`store::Store`]), so that a loop does not read its text anew. Statements are carried out
//! when they are read, ahead of the moves before them, as the control does; what must be asked of the machine
//! (inputs, positions, the clock) is a barrier. Must never know: which control is loaded; numbers, letters and
//! limits come from its table of macros.
//!
//! Manual: YASNAC LX3, pages 84 and 92; where it is silent practice of Fanuc 6M/10M/0M, row by row in `macro.toml`.

pub(crate) mod call;
mod code;
mod evaluation;
mod expression;
pub(crate) mod flow;
pub(crate) mod number;
mod scanner;
pub(crate) mod statement;
pub(crate) mod store;
mod system;
pub(crate) mod trouble;
mod variables;
mod words;

pub(crate) use variables::LOCALS;
pub use variables::{BLANK, Variables};
