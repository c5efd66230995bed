//! The two codes of punched tape as tables: ISO 840 (even number of holes, channel 8) and EIA RS-244 (odd, channel 5).
//!
//! A row of tape is a byte, channel 8 its highest bit; the sprocket hole is not counted. Source: ISO 840 and EIA
//! RS-244-A; which rows a control passes over is the practice of Fanuc 6M/10M/0M, taken where no YASNAC page was found.

use crate::{END_OF_BLOCK, IGNORED, UNREADABLE};

/// A tape code.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum System {
    /// ISO 840: ASCII with a parity hole in channel 8, every row with an even number of holes.
    Iso,
    /// EIA RS-244: every row with an odd number of holes, the parity hole in channel 5.
    Eia,
}

impl System {
    /// The name for people.
    pub const fn name(self) -> &'static str {
        match self {
            System::Iso => "ISO",
            System::Eia => "EIA",
        }
    }

    /// The row that ends a block.
    pub const fn end_of_block(self) -> u8 {
        match self {
            System::Iso => 0x0A,
            System::Eia => 0x80,
        }
    }

    /// True if the number of holes is right for a character of this code.
    pub const fn is_parity_right(self, row: u8) -> bool {
        row.count_ones() % 2 == matches!(self, System::Eia) as u32
    }
}

/// What is punched for a character: its ISO row and its EIA row.
type Row = (u8, u8, u8);

/// The characters that both codes have.
#[rustfmt::skip]
const SHARED: &[Row] = &[
    (b'0', 0x30, 0x20), (b'1', 0xB1, 0x01), (b'2', 0xB2, 0x02), (b'3', 0x33, 0x13), (b'4', 0xB4, 0x04),
    (b'5', 0x35, 0x15), (b'6', 0x36, 0x16), (b'7', 0xB7, 0x07), (b'8', 0xB8, 0x08), (b'9', 0x39, 0x19),
    (b'A', 0x41, 0x61), (b'B', 0x42, 0x62), (b'C', 0xC3, 0x73), (b'D', 0x44, 0x64), (b'E', 0xC5, 0x75),
    (b'F', 0xC6, 0x76), (b'G', 0x47, 0x67), (b'H', 0x48, 0x68), (b'I', 0xC9, 0x79), (b'J', 0xCA, 0x51),
    (b'K', 0x4B, 0x52), (b'L', 0xCC, 0x43), (b'M', 0x4D, 0x54), (b'N', 0x4E, 0x45), (b'O', 0xCF, 0x46),
    (b'P', 0x50, 0x57), (b'Q', 0xD1, 0x58), (b'R', 0xD2, 0x49), (b'S', 0x53, 0x32), (b'T', 0xD4, 0x23),
    (b'U', 0x55, 0x34), (b'V', 0x56, 0x25), (b'W', 0xD7, 0x26), (b'X', 0xD8, 0x37), (b'Y', 0x59, 0x38),
    (b'Z', 0x5A, 0x29), (b'+', 0x2B, 0x70), (b'-', 0x2D, 0x40), (b'.', 0x2E, 0x6B), (b',', 0xAC, 0x3B),
    (b'/', 0xAF, 0x31), (b'&', 0xA6, 0x0E), (b'(', 0x28, 0x1A), (b')', 0xA9, 0x4A),
    (END_OF_BLOCK, 0x0A, 0x80), (b'%', 0xA5, 0x0B), (b' ', 0xA0, 0x10), (b'\t', 0x09, 0x3E), (BACK_SPACE, 0x88, 0x2A),
];

/// Rows without a character, passed over: ISO carriage return and delete.
const ISO_IGNORED: &[u8] = &[0x8D, 0xFF];
/// Delete, upper case, lower case.
const EIA_IGNORED: &[u8] = &[0x7F, 0x7C, 0x7A];

/// The back space moves a printer's head; a control does not know it.
const BACK_SPACE: u8 = 0x08;

/// The macro characters, for which EIA has no row of its own.
pub const PUNCTUATION: [u8; 5] = [b'#', b'=', b'*', b'[', b']'];

const fn iso_characters() -> [u8; 256] {
    let mut table = [UNREADABLE; 256];
    // ISO is ASCII with parity, so a comment may hold any of its printing characters.
    let mut character = 0x20u8;
    while character < 0x7F {
        let parity = (character.count_ones() as u8 & 1) << 7;
        table[(character | parity) as usize] = character;
        character += 1;
    }
    fill(table, true, ISO_IGNORED)
}

const fn fill(mut table: [u8; 256], iso: bool, ignored: &[u8]) -> [u8; 256] {
    let mut i = 0;
    while i < SHARED.len() {
        let (character, iso_row, eia_row) = SHARED[i];
        table[if iso { iso_row } else { eia_row } as usize] = character;
        i += 1;
    }
    let mut i = 0;
    while i < ignored.len() {
        table[ignored[i] as usize] = IGNORED;
        i += 1;
    }
    table[0] = IGNORED;
    table
}

const ISO: [u8; 256] = iso_characters();
const EIA: [u8; 256] = fill([UNREADABLE; 256], false, EIA_IGNORED);

/// Both codes as a control has them: EIA rows for `# = * [ ]` as its parameters say.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Codes {
    /// EIA rows of [`PUNCTUATION`], 0 for none.
    punctuation: [u8; 5],
}

/// A row that cannot be given to a character.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum CodeError {
    /// EIA rows have an odd number of holes.
    Even,
    /// The row is that of another character, or of none that is read.
    Taken,
    /// Only [`PUNCTUATION`] is given rows.
    Fixed,
}

impl Codes {
    /// Gives a character of [`PUNCTUATION`] its EIA row; row 0 takes it away.
    ///
    /// # Errors
    /// The row cannot be one, or another character has it.
    pub fn assign(&mut self, character: u8, row: u8) -> Result<(), CodeError> {
        let Some(index) = PUNCTUATION.iter().position(|&known| known == character) else {
            return Err(CodeError::Fixed);
        };
        if row != 0 {
            if !System::Eia.is_parity_right(row) {
                return Err(CodeError::Even);
            }
            let others = self.punctuation.iter().enumerate();
            if EIA[usize::from(row)] != UNREADABLE || others.into_iter().any(|(at, &own)| at != index && own == row) {
                return Err(CodeError::Taken);
            }
        }
        self.punctuation[index] = row;
        Ok(())
    }

    /// The characters of a code by their rows.
    pub fn table(&self, system: System) -> Table {
        let mut characters = match system {
            System::Iso => ISO,
            System::Eia => EIA,
        };
        if system == System::Eia {
            for (&character, &row) in PUNCTUATION.iter().zip(&self.punctuation) {
                if row != 0 {
                    characters[usize::from(row)] = character;
                }
            }
        }
        Table { system, characters }
    }
}

/// What every row of a code is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Table {
    /// The code.
    pub system: System,
    characters: [u8; 256],
}

impl Table {
    /// The character of a row: [`IGNORED`] and [`UNREADABLE`] are two of them.
    pub const fn character(&self, row: u8) -> u8 {
        self.characters[row as usize]
    }

    /// The row of a character, if the code has it.
    pub fn row(&self, character: u8) -> Option<u8> {
        if matches!(character, IGNORED | UNREADABLE) {
            return None;
        }
        self.characters.iter().position(|&known| known == character).map(|row| row as u8)
    }

    /// What a row is called where it is shown.
    pub fn row_name(&self, row: u8) -> String {
        match (row, self.system, self.character(row)) {
            (0, ..) => "blank".to_owned(),
            (0x8D, System::Iso, _) => "carriage return".to_owned(),
            (0x7C, System::Eia, _) => "upper case".to_owned(),
            (0x7A, System::Eia, _) => "lower case".to_owned(),
            (.., IGNORED) => character_name(DELETE),
            (.., UNREADABLE) => "?".to_owned(),
            (.., character) => character_name(character),
        }
    }

    pub(crate) fn translate(&self, rows: &mut [u8]) {
        for row in rows {
            *row = self.characters[usize::from(*row)];
        }
    }
}

/// The channels of a row's holes, the highest first: `8 5 1`, and `no hole` for blank tape.
pub fn holes(row: u8) -> String {
    let channels: Vec<_> =
        (0..8).rev().filter(|bit| row >> bit & 1 == 1).map(|bit| char::from(b'1' + bit).to_string()).collect();
    if channels.is_empty() { "no hole".to_owned() } else { channels.join(" ") }
}

/// What a character is called where it is shown: `space`, `end of block`; printing ones as they are.
pub fn character_name(character: u8) -> String {
    let name = match character {
        b' ' => "space",
        b'\t' => "tab",
        BACK_SPACE => "back space",
        END_OF_BLOCK => "end of block",
        DELETE => "delete",
        _ => return char::from(character).to_string(),
    };
    name.to_owned()
}

/// Stands for every row that is passed over (delete, carriage return, case shifts) where a damaged row is guessed.
pub(crate) const DELETE: u8 = 0x7F;

#[cfg(test)]
mod tests {
    use super::*;

    /// Characters that ISO has besides; in EIA those of [`PUNCTUATION`] have a row only where a parameter gives one.
    const ISO_ONLY: &[(u8, u8)] = &[(b':', 0x3A), (b'#', 0xA3), (b'=', 0xBD), (b'*', 0xAA), (b'[', 0xDB), (b']', 0xDD)];

    #[test]
    fn every_row_of_the_tables_has_the_parity_of_its_code() {
        for &(character, iso, eia) in SHARED {
            assert!(System::Iso.is_parity_right(iso), "{character:02X}");
            assert!(System::Eia.is_parity_right(eia), "{character:02X}");
        }
        assert!(ISO_ONLY.iter().all(|&(_, row)| System::Iso.is_parity_right(row)));
        assert!(ISO_IGNORED.iter().all(|&row| System::Iso.is_parity_right(row)));
        assert!(EIA_IGNORED.iter().all(|&row| System::Eia.is_parity_right(row)));
    }

    #[test]
    fn iso_is_ascii_with_parity_and_agrees_with_its_table() {
        let table = Codes::default().table(System::Iso);
        let shared = SHARED.iter().map(|&(character, iso, _)| (character, iso));
        for (character, row) in shared.chain(ISO_ONLY.iter().copied()) {
            assert_eq!(row & 0x7F, character);
            assert_eq!((table.character(row), table.row(character)), (character, Some(row)));
        }
        assert_eq!([0x00, 0x8D, 0xFF].map(|row| table.character(row)), [IGNORED; 3]);
        let unreadable = (0..=255).filter(|&row| table.character(row) == UNREADABLE).count();
        // 128 rows of wrong parity, and the 27 control characters that are none of ours.
        assert_eq!(unreadable, 128 + 27);
    }

    #[test]
    fn eia_has_each_character_once_and_no_macro_characters() {
        let table = Codes::default().table(System::Eia);
        for &(character, _, row) in SHARED {
            assert_eq!((table.character(row), table.row(character)), (character, Some(row)));
        }
        let readable = (0..=255).filter(|&row| !matches!(table.character(row), UNREADABLE | IGNORED)).count();
        assert_eq!(readable, SHARED.len());
        assert!(PUNCTUATION.iter().all(|&character| table.row(character).is_none()));
    }

    #[test]
    fn macro_characters_take_the_rows_they_are_given() {
        let mut codes = Codes::default();
        assert_eq!(codes.assign(b'=', 0x0D), Ok(()));
        assert_eq!(codes.assign(b'#', 0x0D), Err(CodeError::Taken));
        assert_eq!(codes.assign(b'#', 0x01), Err(CodeError::Taken));
        assert_eq!(codes.assign(b'#', 0x7F), Err(CodeError::Taken));
        assert_eq!(codes.assign(b'#', 0x03), Err(CodeError::Even));
        assert_eq!(codes.assign(b'$', 0x0D), Err(CodeError::Fixed));
        let table = codes.table(System::Eia);
        assert_eq!((table.character(0x0D), table.row(b'=')), (b'=', Some(0x0D)));
        assert_eq!(codes.table(System::Iso), Codes::default().table(System::Iso));
        assert_eq!(codes.assign(b'=', 0), Ok(()));
        assert_eq!(codes, Codes::default());
    }

    #[test]
    fn holes_are_named_by_their_channels() {
        assert_eq!((holes(0x91), holes(0), holes(0xFF)), ("8 5 1".into(), "no hole".into(), "8 7 6 5 4 3 2 1".into()));
    }
}
