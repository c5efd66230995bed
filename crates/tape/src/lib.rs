//! Bytes to characters, one for one, so that a character's place in the file is its place in the program.
//!
//! Comes in: a chunk of a file as it is. Goes out: the same chunk in the control's characters (ASCII, with
//! [`END_OF_BLOCK`], [`IGNORED`] and [`UNREADABLE`]). Must never know: what the characters mean.
//! A file is ordinary text ([`Text`]) or the image of a punched tape, one byte a row ([`Punched`]): [`recognise`] says
//! which, [`faults`] what is wrong with its rows. The codes are ISO 840 and EIA RS-244 (`code.rs`).

mod code;
mod damage;
mod draw;
mod punch;
mod punched;
mod read;
mod recognise;
mod strip;
mod text;

pub use code::{CodeError, Codes, PUNCTUATION, System, Table, character_name, holes};
pub use damage::{Fault, Faults, Guesses, faults, is_odd};
pub use draw::draw;
pub use punch::{Lacking, Punch, punch};
pub use punched::Punched;
pub use read::{Finding, Written, Wrong, read_tape};
pub use recognise::{Format, Tape, recognise};
pub use strip::strip;
pub use text::Text;

/// The character that ends a line of the program.
pub const END_OF_BLOCK: u8 = b'\n';
/// The character that the control passes over, wherever it stands.
pub const IGNORED: u8 = 0;
/// The character that stands for a row of tape that is none: ASCII has this one, SUB, for characters found in error.
pub const UNREADABLE: u8 = 0x1A;

/// One way in which programs are stored as bytes.
pub trait Reader {
    /// Translates a chunk in place. `at` is the chunk's offset in its file, `last` says that the file ends with it.
    ///
    /// Returns how many bytes of the chunk are settled; the rest (at most a few bytes, never of the last chunk) must
    /// be offered again together with what follows. Never fails: what is no character stays as it is, for the next
    /// stage to point at.
    fn translate(&self, bytes: &mut [u8], at: u64, last: bool) -> usize;
}
