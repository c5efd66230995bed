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

/// A program that is looked for outside the texts at hand.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wanted<'n> {
    /// By its number; of several files of that number the one with this ending comes first.
    Number(u32, &'n str),
    /// By its file's name with its ending, whatever the case of its letters.
    File(&'n str),
}

/// The texts at hand.
pub trait Library {
    /// Reads at most `len` bytes of a source from `offset` on into `bytes` (cleared first). Returns true if the
    /// source ends with them. Fewer bytes than asked for are fine; none at all is taken for the end.
    ///
    /// # Errors
    /// The source cannot be read.
    fn read(&mut self, source: SourceId, offset: u64, len: usize, bytes: &mut Vec<u8>) -> Result<bool, LibraryError>;

    /// The source that holds a program, outside the texts that are open already.
    ///
    /// # Errors
    /// A file of that name is there and cannot be read.
    fn find_program(&mut self, wanted: Wanted) -> Result<Option<SourceId>, LibraryError>;

    /// How many bytes a source has, if that is known without reading it.
    fn size(&self, _source: SourceId) -> Option<u64> {
        None
    }

    /// The name of a program that is a file, without folder and ending; `None` if it is not known.
    fn file_name(&self, _source: SourceId) -> Option<String> {
        None
    }
}

/// The texts at hand, and files to load from.
pub trait Shelf: Library {
    /// Opens a file that an operator loads; also its name as a program where no O word gives it one.
    ///
    /// # Errors
    /// The file cannot be read.
    fn open_file(&mut self, file: &str) -> Result<(SourceId, String), LibraryError>;

    /// This program is in the control's memory: [`Library::find_program`] finds it before any other.
    fn keep_in_memory(&mut self, program: Wanted, source: SourceId);

    /// This program is no longer in the control's memory.
    fn forget_in_memory(&mut self, _program: Wanted) {}

    /// Keeps a text that was written at the control.
    ///
    /// # Errors
    /// There is no room for it.
    fn hold_text(&mut self, _name: &str, _text: Vec<u8>) -> Result<SourceId, LibraryError> {
        Err(LibraryError("programs cannot be written here".to_owned()))
    }
}
