//! Bytes to characters, one for one, so that a character's place in the file is its place in the program.
//!
//! Comes in: a chunk of a file as it is. Goes out: the same chunk in the control's characters (ASCII, with
//! [`END_OF_BLOCK`] and [`IGNORED`]). Must never know: what the characters mean.
//! A reader for punched tape (EIA RS-244, ISO 840) is another [`Reader`]: one byte of tape is one character too.

mod text;

pub use text::Text;

/// The character that ends a line of the program.
pub const END_OF_BLOCK: u8 = b'\n';
/// The character that the control passes over, wherever it stands.
pub const IGNORED: u8 = 0;

/// One way in which programs are stored as bytes.
pub trait Reader {
    /// Translates a chunk in place. `at` is the chunk's offset in its file, `last` says that the file ends with it.
    ///
    /// Returns how many bytes of the chunk are settled; the rest (at most a few bytes, never of the last chunk) must
    /// be offered again together with what follows. Never fails: what is no character stays as it is, for the next
    /// stage to point at.
    fn translate(&self, bytes: &mut [u8], at: u64, last: bool) -> usize;
}
