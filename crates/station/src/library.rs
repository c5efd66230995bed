//! Where program texts come from: the only way in which the stages reach one.

use base::SourceId;

/// A text that could not be read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LibraryError(pub String);

impl std::fmt::Display for LibraryError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for LibraryError {}

/// The texts at hand.
pub trait Library {
    /// Reads at most `len` bytes of a source from `offset` on into `bytes` (cleared first). Returns true if the
    /// source ends with them. Fewer bytes than asked for are fine; none at all is taken for the end.
    ///
    /// # Errors
    /// The source cannot be read.
    fn read(&mut self, source: SourceId, offset: u64, len: usize, bytes: &mut Vec<u8>) -> Result<bool, LibraryError>;

    /// The source that holds the program of this number, outside the texts that are open already.
    ///
    /// # Errors
    /// A file of that name is there and cannot be read.
    fn find_program(&mut self, number: u32) -> Result<Option<SourceId>, LibraryError>;
}

/// The texts at hand, and files to load from.
pub trait Shelf: Library {
    /// Opens a file that an operator loads; also its name as a program where no O word gives it one.
    ///
    /// # Errors
    /// The file cannot be read.
    fn open_file(&mut self, file: &str) -> Result<(SourceId, String), LibraryError>;

    /// The program of this number is in the control's memory: [`Library::find_program`] finds it before any other.
    fn keep_in_memory(&mut self, number: u32, source: SourceId);
}
