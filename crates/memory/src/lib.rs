//! What survives power-off, in one SQLite file of a data folder. Comes in: [`Change`]s, a folder. Goes out: the
//! [`Content`], as values and as text. A change is there as a whole or not at all, and it is there once
//! [`Store::commit`] has returned. Must never know: what a program or an offset means.
#![allow(clippy::disallowed_types, clippy::disallowed_methods)] // This crate writes files: it stands at the edge.

mod content;
mod schema;
mod store;
mod trouble;

pub use content::{Change, Content, Kind, List, Program};
pub use schema::VERSION;
pub use store::{FILE, MOST_ENTRIES, Store};
pub use trouble::Trouble;
