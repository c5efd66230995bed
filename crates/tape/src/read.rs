//! A whole tape as text, with everything that is wrong with it.

use crate::code::{Codes, DELETE, Table};
use crate::damage::{Fault, faults, is_odd};
use crate::recognise::Tape;
use crate::{END_OF_BLOCK, IGNORED, UNREADABLE};

/// What is wrong at a place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wrong {
    /// A row.
    Row {
        /// As it was read.
        row: u8,
        /// What is wrong with it.
        fault: Fault,
    },
    /// The block's number of rows, its end counted, is odd.
    Odd {
        /// That number.
        rows: u64,
    },
}

/// Something wrong on a tape, and where.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Finding {
    /// What.
    pub wrong: Wrong,
    /// The line of the text, from 1: the tape's blocks counted, with a `%` that ends its label.
    pub line: u64,
    /// Offset of the block's first row.
    pub block: u64,
    /// Rows of the block, its end not counted.
    pub rows: u32,
    /// Offset of the row; of the block's first for a fault of the whole block.
    pub at: u64,
}

/// What was read.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Written {
    /// The program, each damaged row as what it probably was; rows that are passed over are left out.
    pub text: Vec<u8>,
    /// What is wrong, in order of place.
    pub findings: Vec<Finding>,
    /// The rows that were read: from the program's head to its end.
    pub from: u64,
    /// The end of those rows.
    pub to: u64,
    /// Rows behind the program's end that are not blank.
    pub unread: u64,
}

/// Reads a tape up to the `%` that ends its program. `tv` asks for the check of block parity.
pub fn read_tape(bytes: &[u8], tape: Tape, codes: &Codes, tv: bool) -> Written {
    let table = codes.table(tape.system);
    let head = usize::try_from(tape.head).unwrap_or(usize::MAX).min(bytes.len());
    let label = usize::try_from(tape.label).unwrap_or(usize::MAX).min(bytes.len());
    let mut written = Written { from: head as u64, ..Written::default() };
    let (mut at, mut line, mut begun) = (head, 1, false);
    while at < bytes.len() {
        let (rows, end, says) = block(&bytes[at..], &table, begun);
        let next = at + rows;
        // What ends the label is checked no more than the label.
        if at >= label {
            written.check(&bytes[at..next], at, line, &table, tv && end == End::Block);
        } else {
            written.spell(&bytes[at..next], &table);
        }
        begun |= says;
        at = next;
        line += 1;
        if end == End::Tape {
            break;
        }
    }
    written.to = at as u64;
    // The end-of-block of the last `%` belongs to it.
    let behind = bytes.get(at..).unwrap_or_default();
    let end = behind.iter().position(|&row| row != 0 && table.character(row) != IGNORED);
    let behind = match end {
        Some(end) if table.character(behind[end]) == END_OF_BLOCK && written.text.ends_with(b"%") => {
            written.text.push(END_OF_BLOCK);
            written.to += end as u64 + 1;
            &behind[end + 1..]
        }
        _ => behind,
    };
    written.unread = behind.iter().filter(|&&row| row != 0).count() as u64;
    written
}

/// How a block ends.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    /// At its end-of-block.
    Block,
    /// At the `%` that ends the program.
    Tape,
    /// With the file.
    File,
}

/// The rows of the block that begins here, its end counted, and whether anything but comments stands in it.
fn block(rows: &[u8], table: &Table, begun: bool) -> (usize, End, bool) {
    let (mut in_comment, mut says) = (false, false);
    for (at, &row) in rows.iter().enumerate() {
        match table.character(row) {
            END_OF_BLOCK => return (at + 1, End::Block, says),
            b'%' if (begun || says) && !in_comment => return (at + 1, End::Tape, says),
            b'(' => in_comment = true,
            b')' => in_comment = false,
            IGNORED | b' ' | b'\t' => {}
            _ => says |= !in_comment,
        }
    }
    (rows.len(), End::File, says)
}

impl Written {
    fn check(&mut self, rows: &[u8], at: usize, line: u64, table: &Table, tv: bool) {
        let own = rows.len() - usize::from(rows.last() == Some(&table.system.end_of_block()));
        let place = |wrong, index: usize| Finding {
            wrong,
            line,
            block: at as u64,
            rows: u32::try_from(own).unwrap_or(u32::MAX),
            at: (at + index) as u64,
        };
        let mut from = 0;
        for (index, fault) in faults(rows, table) {
            self.findings.push(place(Wrong::Row { row: rows[index], fault }, index));
            self.spell(&rows[from..index], table);
            if let Fault::Parity(guesses) = fault {
                match guesses.characters().next() {
                    None => self.text.push(b'?'),
                    Some(DELETE) => {}
                    Some(character) => self.text.push(character),
                }
                from = index + 1;
            } else {
                from = index;
            }
        }
        self.spell(&rows[from..], table);
        let rows = rows.len() as u64;
        if tv && is_odd(rows) {
            self.findings.push(place(Wrong::Odd { rows }, 0));
        }
    }

    fn spell(&mut self, rows: &[u8], table: &Table) {
        let characters = rows.iter().map(|&row| table.character(row)).filter(|&character| character != IGNORED);
        self.text.extend(characters.map(|character| if character == UNREADABLE { b'?' } else { character }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Format, System, recognise};

    fn read(bytes: &[u8], tv: bool) -> Written {
        let codes = Codes::default();
        match recognise(bytes, &codes) {
            Format::Tape(tape) => read_tape(bytes, tape, &codes, tv),
            Format::Text => panic!("no tape"),
        }
    }

    #[test]
    fn the_program_between_its_two_rewind_stops_is_read() {
        let iso = read(b"\0\0\xA5\x0A\xCF\xB1\x8D\x0A\xFFG30\xD8\xB1\0\x0A\xA5\x0A\0\0AB", true);
        assert_eq!((iso.text.as_slice(), iso.unread), (&b"%\nO1\nG30X1\n%\n"[..], 2));
        assert_eq!((iso.from, iso.to), (2, 18));
        let eia = read(b"\0\x0B\x80\x46\x01\x7C\x80\x67\x01\x37\x01\x80\x0B\0\0", false);
        assert_eq!((eia.text.as_slice(), eia.findings.len(), eia.unread), (&b"%\nO1\nG1X1\n%"[..], 0, 0));
    }

    #[test]
    fn a_label_is_left_out_and_does_not_count_as_a_line() {
        let read = read(b"\x7E\x11\x7E\0\x80\x46\x01\x80\x67\x37\x37\x01\x80", true);
        assert_eq!(read.text, b"O1\nGXX1\n");
        let [odd, long] = read.findings[..] else { panic!("{:?}", read.findings) };
        assert_eq!((odd.line, odd.block, odd.wrong), (1, 5, Wrong::Odd { rows: 3 }));
        assert_eq!((long.line, long.block, long.rows, long.wrong), (2, 8, 4, Wrong::Odd { rows: 5 }));
    }

    #[test]
    fn a_damaged_row_is_named_and_read_as_what_it_probably_was() {
        // G1X1?. with 32: 3 with a hole filled as much as 2 or 6.
        let read = read(b"\xA5\x0AG\xB1\xD8\xB1\x32\x2E\x0AM30\x0A\xA5", false);
        assert_eq!(read.text, b"%\nG1X13.\nM30\n%");
        let [finding] = read.findings[..] else { panic!("{:?}", read.findings) };
        assert_eq!((finding.line, finding.block, finding.at, finding.rows), (2, 2, 6, 6));
        let Wrong::Row { row: 0x32, fault: Fault::Parity(guesses) } = finding.wrong else { panic!("{finding:?}") };
        assert_eq!(guesses.characters().collect::<Vec<_>>(), b"3620");
    }

    #[test]
    fn a_block_whose_end_is_damaged_runs_into_the_next() {
        // The first end-of-block 8A.
        let tape = Tape::new(System::Iso, b"\xA5\x0A", &Codes::default()).expect("it has an end of block");
        let read = read_tape(b"\xA5\x0AG\xB1\x8AM30\x0A\xA5", tape, &Codes::default(), true);
        assert_eq!(read.text, b"%\nG1\nM30\n%");
        let [row, odd] = read.findings[..] else { panic!("{:?}", read.findings) };
        assert_eq!((row.at, odd.wrong), (4, Wrong::Odd { rows: 7 }));
    }
}
