//! Text or tape, and in which code: decided once for a file, from its first bytes.
//!
//! The control decides by the first end-of-block: 0A is ISO, 80 is EIA. A file may also be text, in which both bytes
//! stand too (a line feed; a part of a letter in a comment), so the rows behind that end-of-block must bear it out:
//!
//! * ISO: rows with a hole in channel 8 that are ISO characters make up the tape's digits and many of its letters.
//!   Counted are rows outside comments and behind no `;`, where text has ASCII alone: there must be such rows, and
//!   two of them (one, if the label ends with `%`) for every row with an odd number of holes, as in text every `1`, `X`
//!   or blank has.
//! * EIA: its digits 1 to 9 are control characters that text never holds. One row in sixteen outside comments must be
//!   one, and three rows in four have an odd number of holes.
//!
//! What stands behind the `%` that ends the tape does not count. A tape without parity holes is text, and read as such.

use crate::code::{Codes, System, Table};
use crate::{END_OF_BLOCK, IGNORED, Punched, Reader, Text, UNREADABLE};

/// An image of a punched tape.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Tape {
    /// Its code.
    pub system: System,
    /// Rows up to and with the first end-of-block: the label, which is skipped.
    pub label: u64,
    /// Where the program begins: behind the label, or at the `%` that ends it.
    pub head: u64,
}

impl Tape {
    /// The tape that these rows begin, read in a code that is known; `None` if no block ends in them.
    pub fn new(system: System, rows: &[u8], codes: &Codes) -> Option<Tape> {
        let table = codes.table(system);
        let end = rows.iter().position(|&row| row == system.end_of_block())?;
        let is_blank = |row: u8| matches!(table.character(row), IGNORED | b' ' | b'\t');
        let last = rows[..end].iter().rposition(|&row| !is_blank(row));
        let rewind = last.filter(|&at| table.character(rows[at]) == b'%');
        let label = end as u64 + 1;
        Some(Tape { system, label, head: rewind.map_or(label, |at| at as u64) })
    }
}

/// How a file is read.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Format {
    /// As text.
    #[default]
    Text,
    /// As a punched tape.
    Tape(Tape),
}

impl Format {
    /// Where the program begins in the file.
    pub const fn head(self) -> u64 {
        match self {
            Format::Text => 0,
            Format::Tape(tape) => tape.head,
        }
    }

    /// Translates a chunk as [`Reader::translate`] does.
    pub fn translate(self, codes: &Codes, bytes: &mut [u8], at: u64, last: bool) -> usize {
        match self {
            Format::Text => Text.translate(bytes, at, last),
            Format::Tape(tape) => Punched::new(tape, codes).translate(bytes, at, last),
        }
    }
}

/// Says how a file is read that begins with these bytes; the more of them, the surer (a leader may be long).
pub fn recognise(bytes: &[u8], codes: &Codes) -> Format {
    // Both codes need bytes that ASCII does not have.
    if bytes.is_ascii() {
        return Format::Text;
    }
    let Some(first) = bytes.iter().find(|&&byte| matches!(byte, 0x0A | 0x80)) else { return Format::Text };
    let system = if *first == System::Iso.end_of_block() { System::Iso } else { System::Eia };
    let Some(tape) = Tape::new(system, bytes, codes) else { return Format::Text };
    let (table, program) = (codes.table(system), &bytes[tape.label as usize..]);
    let borne_out = match system {
        System::Iso => is_iso(program, &table, if tape.head < tape.label { 1 } else { 2 }),
        System::Eia => is_eia(program, &table),
    };
    if borne_out { Format::Tape(tape) } else { Format::Text }
}

/// `odds`: how many rows with a hole in channel 8 must stand against one that is wrong.
fn is_iso(program: &[u8], table: &Table, odds: usize) -> bool {
    let (mut with_parity, mut wrong, mut counts) = (0usize, 0usize, true);
    for &row in program {
        match (table.character(row), row & 0x7F) {
            (END_OF_BLOCK, _) => counts = true,
            (_, b'(' | b';') => counts = false,
            _ if !counts => {}
            (b'%', _) if with_parity > 0 => break,
            _ if !System::Iso.is_parity_right(row) => wrong += 1,
            (UNREADABLE, _) => {}
            _ => with_parity += usize::from(row >= 0x80),
        }
    }
    with_parity > 0 && wrong * odds <= with_parity
}

fn is_eia(program: &[u8], table: &Table) -> bool {
    let (mut all, mut digits, mut wrong, mut counts) = (0usize, 0usize, 0usize, true);
    for &row in program {
        match table.character(row) {
            END_OF_BLOCK | b')' => counts = true,
            b'(' => counts = false,
            _ if !counts || row == 0 => continue,
            b'%' if digits > 0 => break,
            b'1'..=b'9' if row < 0x20 => digits += 1,
            _ => wrong += usize::from(!System::Eia.is_parity_right(row)),
        }
        all += 1;
    }
    digits > 0 && digits * 16 >= all && wrong * 4 <= all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tape(system: System, label: u64, head: u64) -> Format {
        Format::Tape(Tape { system, label, head })
    }

    fn recognised(bytes: &[u8]) -> Format {
        recognise(bytes, &Codes::default())
    }

    #[test]
    fn the_first_end_of_block_after_the_leader_tells_the_code() {
        assert_eq!(recognised(b"\0\0\0\xA5\x0A\xCF\xB1\x0A\xA5"), tape(System::Iso, 5, 3));
        assert_eq!(recognised(b"\0\0\x0B\x80\x46\x01\x80\x0B"), tape(System::Eia, 4, 2));
    }

    #[test]
    fn a_label_needs_no_valid_code() {
        assert_eq!(recognised(b"\0\x7E\x11\x11\x7E\0\x0A\xCF\xB1\x0A\xA5"), tape(System::Iso, 7, 7));
        assert_eq!(recognised(b"\x7E\x11\x11\x7E\0\x0B\0\0\x80\x46\x01\x80\x0B"), tape(System::Eia, 9, 5));
    }

    #[test]
    fn damaged_tapes_are_still_tapes() {
        // % O1 G0X1 M30, the O's channel 7 filled; the same in EIA with an extra hole in the X.
        assert_eq!(recognised(b"\xA5\x0A\x8F\xB1\x0A\x47\x30\xD8\xB1\x0A\x4D\x33\x30\x0A"), tape(System::Iso, 2, 0));
        assert_eq!(recognised(b"\x0B\x80\x46\x01\x80\x67\x20\xB7\x01\x80\x54\x13\x20\x80"), tape(System::Eia, 2, 0));
    }

    #[test]
    fn text_is_text_whatever_its_comments_hold() {
        let texts: [&[u8]; 12] = [
            b"%\nO1\nG0X1\nM30\n%\n",
            b"\0\0\0%\r\nO1\r\nG0X1\r\n",
            b"",
            b"\x80",
            b"\xC9\x0A",
            "\u{FEFF}%\nO1 (FRÄSEN Ø5 – PLATTE)\nG0X1\n".as_bytes(),
            // Every character outside the comments has an even number of holes, as ISO rows have.
            "G03Y5.\n(éàéàØØÉ)\nG0Z9.\nM30\n".as_bytes(),
            b"G03Y5.\n(\xD8\xD8\xC9\xC9 \xE9)\nG0Z9.\nM30\n",
            b"G03Y5.\n;\xD8\xD8\xC9\xC9\xC9\nG0Z9.\nM30\n",
            // No-break blanks from a word processor; a euro sign of Windows; a text that DOS has ended.
            b"%\nG01\xA0X10\xA0Y20\nM30\n",
            b"(PREIS 5 \x80)\nG01X1Y2\nX12Y47\n\x1A",
            b"(\x80)X1X2X4X7X8X1X2X4\x1A",
        ];
        for text in texts {
            assert_eq!(recognised(text), Format::Text, "{}", text.escape_ascii());
        }
    }
}
