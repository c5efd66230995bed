//! What can go wrong with the memory's files, in words.

use std::path::Path;

use rusqlite::{Error, ErrorCode};

/// Why the memory could not be opened or written: the file, what happened, what to do.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{0}")]
pub struct Trouble(pub String);

impl Trouble {
    /// What the operating system says of a file.
    pub(crate) fn file(path: &Path, doing: &str, error: &std::io::Error) -> Trouble {
        Trouble(format!("cannot {doing} {}: {error}; check that the folder exists and may be written", path.display()))
    }

    /// What SQLite says of the memory's file.
    pub(crate) fn sqlite(path: &Path, error: &Error) -> Trouble {
        let remedy = match error.sqlite_error_code() {
            Some(ErrorCode::DiskFull) => "the disk is full: make room and write again; nothing was changed",
            Some(ErrorCode::ReadOnly | ErrorCode::PermissionDenied) => {
                "it may not be written: give this user the right to write the folder and its files; nothing was changed"
            }
            Some(ErrorCode::CannotOpen) => "check that the folder exists and may be written",
            Some(ErrorCode::SystemIoFailure) => {
                "the disk failed or is full: check it, then open the memory again; nothing of this was acknowledged"
            }
            Some(ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked) => "another program has it open: end that first",
            Some(ErrorCode::NotADatabase | ErrorCode::DatabaseCorrupt) => {
                "it is damaged: put it aside and import the last export into a new folder"
            }
            _ => "nothing was changed",
        };
        Trouble(format!("{}: {error}; {remedy}", path.display()))
    }
}
