//! A tape drawn in characters: a line a row, its holes with the sprocket hole between channels 3 and 4, its character.

use std::fmt::Write;

use crate::code::{Codes, System, Table};
use crate::damage::{Fault, Guesses};
use crate::read::{Wrong, read_tape};
use crate::recognise::Tape;

/// Equal rows of blank tape beyond so many are counted, not drawn.
const MOST_BLANK: usize = 3;

/// Draws a tape; `tv` asks for the check of block parity.
pub fn draw(bytes: &[u8], tape: Tape, codes: &Codes, tv: bool) -> String {
    let table = codes.table(tape.system);
    let read = read_tape(bytes, tape, codes, tv);
    let mut findings = read.findings.iter().filter(|finding| matches!(finding.wrong, Wrong::Row { .. })).peekable();
    let mut odd = read.findings.iter().filter(|finding| matches!(finding.wrong, Wrong::Odd { .. })).peekable();
    let mut out = format!("{} code, {} rows\n\n     row  87654.321\n", tape.system.name(), bytes.len());
    let (mut at, mut line, mut block) = (0, 1, tape.head as usize);
    while let Some(&row) = bytes.get(at) {
        let blank = bytes[at..].iter().take_while(|&&row| row == 0).count();
        let _ = write!(out, "{at:>8} |{}|  {row:02X}", pattern(row));
        let in_program = at as u64 >= read.from && (at as u64) < read.to;
        if row == 0 {
            out.push_str("  blank");
        } else if !in_program {
            out.push_str(if (at as u64) < read.from { "  label" } else { "  not read" });
        } else {
            let _ = write!(out, "  {:<12}  {line}:{}", table.row_name(row), at - block + 1);
        }
        if let Some(finding) = findings.next_if(|finding| finding.at == at as u64) {
            mark(&finding.wrong, &table, &mut out);
        }
        let ends = in_program && row == table.system.end_of_block();
        if ends && let Some(finding) = odd.next_if(|finding| finding.block == block as u64) {
            mark(&finding.wrong, &table, &mut out);
        }
        out.push('\n');
        at += 1;
        if ends {
            (line, block) = (line + 1, at);
        }
        if blank > MOST_BLANK {
            let _ = writeln!(out, "         :         :  {} more rows of blank tape", blank - 1);
            at += blank - 1;
        }
    }
    out
}

/// The nine tracks of a row, channel 8 first.
fn pattern(row: u8) -> String {
    let hole = |bit: u8| if row >> bit & 1 == 1 { 'O' } else { ' ' };
    (3..8).rev().map(hole).chain(['.']).chain((0..3).rev().map(hole)).collect()
}

/// Says what is wrong, behind the row where it is.
fn mark(wrong: &Wrong, table: &Table, out: &mut String) {
    let should = match table.system {
        System::Iso => "even",
        System::Eia => "odd",
    };
    let _ = match wrong {
        Wrong::Row { fault: Fault::Parity(guesses), .. } => {
            write!(out, "  <-- holes not {should}, probably {}", Guesses::text(guesses.number()))
        }
        Wrong::Row { fault: Fault::Blank, .. } => write!(out, "  <-- blank tape inside the program"),
        Wrong::Row { fault: Fault::Unknown, .. } => write!(out, "  <-- no character of this code"),
        Wrong::Odd { rows } => write!(out, "  <-- {rows} characters in the block, not even"),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Format, recognise};

    #[test]
    fn a_tape_is_drawn_row_by_row() {
        let bytes = b"\0\0\0\0\0\x0B\x80\x67\x01\x80\x37\x03\x80\x0B\0\x01";
        let codes = Codes::default();
        let Format::Tape(tape) = recognise(bytes, &codes) else { panic!("no tape") };
        let drawn = "EIA code, 16 rows

     row  87654.321
       0 |     .   |  00  blank
         :         :  4 more rows of blank tape
       5 |    O. OO|  0B  %             1:1
       6 |O    .   |  80  end of block  1:2
       7 | OO  .OOO|  67  G             2:1
       8 |     .  O|  01  1             2:2
       9 |O    .   |  80  end of block  2:3  <-- 3 characters in the block, not even
      10 |  OO .OOO|  37  X             3:1
      11 |     . OO|  03  ?             3:2  <-- holes not odd, probably 7, 3, 2 or 1
      12 |O    .   |  80  end of block  3:3  <-- 3 characters in the block, not even
      13 |    O. OO|  0B  %             4:1
      14 |     .   |  00  blank
      15 |     .  O|  01  not read
";
        let out = draw(bytes, tape, &codes, true);
        assert_eq!(out, drawn, "{out}");
    }
}
