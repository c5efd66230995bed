//! A text punched on tape: leader, rows, trailer.

use crate::code::{Codes, System, Table};
use crate::{END_OF_BLOCK, IGNORED, Reader, Text};

/// How a tape is punched.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Punch {
    /// The code.
    pub system: System,
    /// Rows of blank tape before and behind the program.
    pub leader: usize,
    /// A blank makes blocks even whose number of characters is odd.
    pub even: bool,
    /// `;` ends a block, as it does on the control's screen.
    pub semicolon_ends: bool,
}

/// A character that the code does not have.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lacking {
    /// The character as written; a byte that is none as `\xFF`.
    pub character: String,
    /// 1-based line.
    pub line: u64,
    /// 1-based column in bytes.
    pub column: u64,
}

/// Punches a text.
///
/// A control skips what stands before the first end-of-block, so a text that does not begin with a `%` alone
/// has an end-of-block punched before it.
///
/// # Errors
/// Every character that the code lacks.
pub fn punch(text: &[u8], how: Punch, codes: &Codes) -> Result<Vec<u8>, Vec<Lacking>> {
    let table = codes.table(how.system);
    let mut characters = text.to_vec();
    Text.translate(&mut characters, 0, true);
    let mut tape = vec![0; how.leader];
    if !begins_with_rewind_stop(&characters, how.semicolon_ends) {
        tape.push(how.system.end_of_block());
    }
    let mut puncher = Puncher { table, how, text, begins: 0, tape, lacking: Vec::new(), open: false };
    puncher.punch(&characters);
    if !puncher.lacking.is_empty() {
        return Err(puncher.lacking);
    }
    let mut tape = puncher.tape;
    tape.resize(tape.len() + how.leader, 0);
    Ok(tape)
}

/// True if the first block is a `%` alone.
fn begins_with_rewind_stop(characters: &[u8], semicolon_ends: bool) -> bool {
    let ends = |&character: &u8| character == END_OF_BLOCK || (semicolon_ends && character == b';');
    let block = characters.split(ends).next().unwrap_or_default();
    let mut said = block.iter().filter(|&&character| !matches!(character, IGNORED | b' ' | b'\t'));
    said.next() == Some(&b'%') && said.next().is_none()
}

struct Puncher<'t> {
    table: Table,
    how: Punch,
    text: &'t [u8],
    /// Where the block begins on the tape.
    begins: usize,
    tape: Vec<u8>,
    lacking: Vec<Lacking>,
    /// Characters stand in the block.
    open: bool,
}

impl Puncher<'_> {
    fn punch(&mut self, characters: &[u8]) {
        self.begins = self.tape.len();
        let (mut line, mut line_start, mut at, mut in_comment) = (1, 0, 0, false);
        while let Some(&character) = characters.get(at) {
            at += 1;
            match character {
                IGNORED => continue,
                END_OF_BLOCK => {
                    self.end_block();
                    (line, line_start, in_comment) = (line + 1, at, false);
                    continue;
                }
                b';' if self.how.semicolon_ends && !in_comment => {
                    // A line end right behind it ends the same block.
                    let blanks = |&&c: &&u8| matches!(c, IGNORED | b' ' | b'\t');
                    let blank = characters[at..].iter().take_while(blanks).count();
                    if characters.get(at + blank) == Some(&END_OF_BLOCK) {
                        at += blank;
                    } else {
                        self.end_block();
                    }
                    continue;
                }
                b'(' => in_comment = true,
                b')' => in_comment = false,
                _ => {}
            }
            self.open = true;
            match self.table.row(character) {
                Some(row) => self.tape.push(row),
                None => {
                    let (character, len) = written(&self.text[at - 1..]);
                    let column = (at - line_start) as u64;
                    self.lacking.push(Lacking { character, line, column });
                    at += len - 1;
                }
            }
        }
        // A last line without its end; behind the `%` that ends the program nothing is read, but one that begins it
        // ends the label.
        let ends_tape = self.tape.last() == self.table.row(b'%').as_ref() && self.begins > self.how.leader;
        if self.open && !ends_tape {
            self.end_block();
        }
    }

    fn end_block(&mut self) {
        let rows = self.tape.len() - self.begins;
        if self.how.even && rows.is_multiple_of(2) {
            self.tape.extend(self.table.row(b' '));
        }
        self.tape.push(self.how.system.end_of_block());
        self.begins = self.tape.len();
        self.open = false;
    }
}

/// The character that these bytes begin with, and how many of them it is.
fn written(bytes: &[u8]) -> (String, usize) {
    let head = &bytes[..bytes.len().min(4)];
    let valid = match std::str::from_utf8(head) {
        Ok(text) => text,
        Err(error) => std::str::from_utf8(&head[..error.valid_up_to()]).unwrap_or_default(),
    };
    match valid.chars().next() {
        Some(character) if !character.is_control() => (character.to_string(), character.len_utf8()),
        _ => (format!("\\x{:02X}", head.first().unwrap_or(&0)), 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn how(system: System) -> Punch {
        Punch { system, leader: 2, even: false, semicolon_ends: true }
    }

    fn punched(text: &str, how: Punch) -> Vec<u8> {
        punch(text.as_bytes(), how, &Codes::default()).expect("the code has every character")
    }

    #[test]
    fn leader_rows_and_trailer() {
        assert_eq!(punched("%\nO1\n%\n", how(System::Iso)), b"\0\0\xA5\x0A\xCF\xB1\x0A\xA5\x0A\0\0");
        assert_eq!(punched("%\nO1\n%", how(System::Eia)), b"\0\0\x0B\x80\x46\x01\x80\x0B\0\0");
    }

    #[test]
    fn what_the_control_would_skip_gets_an_end_of_block_before_it() {
        assert_eq!(punched("G1\n", how(System::Eia)), b"\0\0\x80\x67\x01\x80\0\0");
        assert_eq!(punched("\u{FEFF} %\r\nG1", how(System::Eia)), b"\0\0\x10\x0B\x80\x67\x01\x80\0\0");
    }

    #[test]
    fn every_way_to_write_the_end_of_a_block_is_one_row() {
        assert_eq!(
            punched("%\r\nG1;G2; \nG3;", how(System::Eia)),
            b"\0\0\x0B\x80\x67\x01\x80\x67\x02\x80\x67\x13\x80\0\0"
        );
    }

    #[test]
    fn blocks_are_made_even() {
        let how = Punch { even: true, ..how(System::Eia) };
        assert_eq!(punched("%\nG1\nG12\n", how), b"\0\0\x0B\x80\x67\x01\x10\x80\x67\x01\x02\x80\0\0");
    }

    #[test]
    fn characters_that_the_code_lacks_are_named_where_they_stand() {
        let lacking =
            punch("%\n#1=2\n(é)\n".as_bytes(), how(System::Eia), &Codes::default()).expect_err("EIA lacks them");
        let said: Vec<_> = lacking.iter().map(|l| (l.character.as_str(), l.line, l.column)).collect();
        assert_eq!(said, [("#", 2, 1), ("=", 2, 3), ("é", 3, 2)]);
        assert_eq!(
            punch(b"\xFF", how(System::Iso), &Codes::default()).expect_err("no character")[0].character,
            "\\xFF"
        );
        let mut codes = Codes::default();
        assert_eq!((codes.assign(b'#', 0x0D), codes.assign(b'=', 0x1C)), (Ok(()), Ok(())));
        assert!(punch(b"#1=2", how(System::Eia), &codes).is_ok());
    }
}
