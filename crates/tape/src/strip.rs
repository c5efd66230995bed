//! A tape drawn true to scale as SVG: strips of one-inch tape, each character under its row.
//!
//! Measures: ISO 1154 (tape 25.4 mm wide, rows and channels 2.54 mm apart, feed holes 9.96 mm from the edge).

use std::fmt::Write;

use crate::code::{Codes, Table};
use crate::read::{Wrong, read_tape};
use crate::recognise::Tape;

const TAPE_MM: f64 = 25.4;
const PITCH_MM: f64 = 2.54;
const FEED_FROM_EDGE_MM: f64 = 9.96;
const HOLE_RADIUS_MM: f64 = 0.915;
const FEED_RADIUS_MM: f64 = 0.585;
/// Rows of a strip: one fits across a sheet of A4.
const ROWS: usize = 100;
/// From one strip to the next; the characters stand in between.
const STRIP_MM: f64 = 34.0;
const MARGIN_MM: f64 = 5.0;

/// Draws a tape.
pub fn strip(bytes: &[u8], tape: Tape, codes: &Codes) -> String {
    let table = codes.table(tape.system);
    let read = read_tape(bytes, tape, codes, false);
    let mut wrong = read
        .findings
        .iter()
        .filter(|finding| matches!(finding.wrong, Wrong::Row { .. }))
        .map(|finding| finding.at as usize)
        .peekable();
    let strips = bytes.len().div_ceil(ROWS).max(1);
    let width = ROWS.min(bytes.len()) as f64 * PITCH_MM + 2.0 * MARGIN_MM;
    let height = strips as f64 * STRIP_MM + MARGIN_MM;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.2}mm\" height=\"{height:.2}mm\" \
         viewBox=\"0 0 {width:.2} {height:.2}\">\n<style>.tape{{fill:#f3e5b8;stroke:#b8a468;stroke-width:.2}}\
         circle{{fill:#3a3320}}.wrong{{fill:#e03020;opacity:.45}}\
         text{{font:2.4px monospace;text-anchor:middle;fill:#222}}</style>\n"
    );
    for (index, rows) in bytes.chunks(ROWS).enumerate() {
        let top = MARGIN_MM + index as f64 * STRIP_MM;
        let length = rows.len() as f64 * PITCH_MM;
        let _ = writeln!(
            out,
            "<rect class=\"tape\" x=\"{MARGIN_MM}\" y=\"{top}\" width=\"{length:.2}\" height=\"{TAPE_MM}\"/>"
        );
        for (place, &row) in rows.iter().enumerate() {
            let at = index * ROWS + place;
            let x = MARGIN_MM + (place as f64 + 0.5) * PITCH_MM;
            if wrong.next_if_eq(&at).is_some() {
                let left = x - PITCH_MM / 2.0;
                let _ = writeln!(
                    out,
                    "<rect class=\"wrong\" x=\"{left:.2}\" y=\"{top}\" width=\"{PITCH_MM}\" height=\"{TAPE_MM}\"/>"
                );
            }
            holes(row, x, top, &mut out);
            if (read.from..read.to).contains(&(at as u64)) {
                letter(row, &table, x, top + TAPE_MM + 3.2, &mut out);
            }
        }
    }
    out.push_str("</svg>\n");
    out
}

fn holes(row: u8, x: f64, top: f64, out: &mut String) {
    // Channel 1 lies at the edge from which the feed holes are measured: the lower one here.
    let feed = top + TAPE_MM - FEED_FROM_EDGE_MM;
    let _ = write!(out, "<circle cx=\"{x:.2}\" cy=\"{feed:.2}\" r=\"{FEED_RADIUS_MM}\"/>");
    for bit in (0..8).filter(|bit| row >> bit & 1 == 1) {
        // Three channels below the feed holes, five above.
        let tracks = if bit < 3 { 3.0 - f64::from(bit) } else { 2.0 - f64::from(bit) };
        let y = feed + tracks * PITCH_MM;
        let _ = write!(out, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{HOLE_RADIUS_MM}\"/>");
    }
    out.push('\n');
}

/// The character under its row, the end of block as the control prints it.
fn letter(row: u8, table: &Table, x: f64, y: f64, out: &mut String) {
    let shown = match table.character(row) {
        crate::END_OF_BLOCK => ";",
        b'&' => "&amp;",
        b'<' => "&lt;",
        b'>' => "&gt;",
        crate::UNREADABLE => "?",
        0..=b' ' => return,
        character => {
            let _ = writeln!(out, "<text x=\"{x:.2}\" y=\"{y:.2}\">{}</text>", char::from(character));
            return;
        }
    };
    let _ = writeln!(out, "<text x=\"{x:.2}\" y=\"{y:.2}\">{shown}</text>");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::System;

    #[test]
    fn every_hole_is_a_circle_and_every_wrong_row_is_marked() {
        let bytes = b"\0\x0B\x80\x67\x03\x0E\x80\x0B";
        let tape = Tape::new(System::Eia, bytes, &Codes::default()).expect("it has an end of block");
        let svg = strip(bytes, tape, &Codes::default());
        let punched: usize = bytes.iter().map(|row| row.count_ones() as usize).sum();
        assert_eq!(svg.matches("<circle").count(), punched + bytes.len());
        assert_eq!(svg.matches("class=\"wrong\"").count(), 1);
        assert!(svg.contains(">&amp;</text>") && svg.ends_with("</svg>\n"));
        // Channel 8 lies 2.74 mm from the upper edge.
        assert!(svg.contains("cy=\"7.74\""), "{svg}");
    }
}
