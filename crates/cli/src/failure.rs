//! Why a command could not do its work.

use std::io;

use data::DataError;

/// A failed command.
#[derive(Debug)]
pub enum Failure {
    /// The call itself is wrong: a file that cannot be read, a set-up that does not fit.
    Call(String),
    /// Whoever read the output has gone.
    PipeClosed,
}

impl Failure {
    /// A wrong call, in words.
    pub fn call(message: impl std::fmt::Display) -> Failure {
        Failure::Call(format!("error: {message}"))
    }

    /// The errors of a data file.
    pub fn data(errors: &[DataError]) -> Failure {
        Failure::Call(errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n"))
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Failure {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Failure::PipeClosed,
            _ => Failure::call(error),
        }
    }
}
