//! TOML tables read with their places, so that a wrong key or value is reported where it stands.
//!
//! Comes in: the text of a data file (a control's table, a machine, a set-up). Goes out: values, or every error of
//! the file with line and column. Must never know: what the values mean, and where the text came from.

mod error;
mod table;

pub use error::DataError;
pub use table::{Document, Entry, Table, nearest, place_of};
