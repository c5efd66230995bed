//! What every reading of a tape keeps. The fuzz target `tape` uses it too.

#![allow(dead_code)] // each test takes what it needs of it

use tape::{
    Codes, END_OF_BLOCK, Fault, Format, IGNORED, Punch, System, Tape, UNREADABLE, Written, Wrong, draw, punch,
    read_tape, recognise, strip,
};

/// The codes with rows for all macro characters.
pub fn codes() -> Codes {
    let mut codes = Codes::default();
    for (character, row) in [(b'#', 0x0D), (b'=', 0x1C), (b'*', 0x5B), (b'[', 0x5D), (b']', 0x5E)] {
        codes.assign(character, row).expect("the rows are free");
    }
    codes
}

/// Asserts what holds of any bytes read as a tape.
pub fn check_tape(bytes: &[u8], tape: Tape, codes: &Codes, tv: bool) -> Written {
    let table = codes.table(tape.system);
    let read = read_tape(bytes, tape, codes, tv);
    assert!(tape.head <= tape.label && tape.label <= bytes.len() as u64, "{tape:?}");
    assert!(read.from == tape.head && read.from <= read.to && read.to <= bytes.len() as u64, "{read:?}");
    assert!(!read.text.iter().any(|character| matches!(*character, IGNORED | UNREADABLE)), "{read:?}");
    for finding in &read.findings {
        assert!(read.from <= finding.block && finding.block <= finding.at && finding.at < read.to, "{finding:?}");
        assert!(tape.label <= finding.at, "a label is not checked: {finding:?}");
        let row = bytes[finding.at as usize];
        let right = tape.system.is_parity_right(row);
        match finding.wrong {
            Wrong::Odd { rows } => assert!(tv && rows % 2 == 1, "{finding:?}"),
            Wrong::Row { fault: Fault::Blank, .. } => assert!(row == 0 && tape.system == System::Eia, "{finding:?}"),
            Wrong::Row { row: said, fault: Fault::Unknown } => {
                assert!(said == row && right && table.character(row) == UNREADABLE, "{finding:?}");
            }
            Wrong::Row { row: said, fault: Fault::Parity(guesses) } => {
                assert!(said == row && !right, "{finding:?}");
                for guess in guesses.characters().filter(|guess| *guess != 0x7F) {
                    let meant = table.row(guess).expect("a guess is a character of the code");
                    assert_eq!((meant ^ row).count_ones(), 1, "{finding:?}");
                }
            }
        }
    }
    // Every row of wrong parity is named.
    let wrong = bytes[tape.label as usize..read.to.max(tape.label) as usize].iter();
    let wrong = wrong.filter(|&&row| row != 0 && !tape.system.is_parity_right(row)).count();
    let named = |wrong: &Wrong| matches!(wrong, Wrong::Row { fault: Fault::Parity(_), .. });
    assert_eq!(read.findings.iter().filter(|finding| named(&finding.wrong)).count(), wrong);
    read
}

/// Asserts that the bytes are translated the same in chunks of any size.
pub fn check_chunks(bytes: &[u8], format: Format, codes: &Codes, size: usize) {
    let mut whole = bytes.to_vec();
    assert_eq!(format.translate(codes, &mut whole, 0, true), bytes.len());
    let (mut at, mut take) = (0, size);
    while at < bytes.len() {
        let end = (at + take).min(bytes.len());
        let mut chunk = bytes[at..end].to_vec();
        let settled = format.translate(codes, &mut chunk, at as u64, end == bytes.len());
        assert_eq!(chunk[..settled], whole[at..at + settled]);
        // What is not settled is offered again with more behind it.
        (at, take) = (at + settled, if settled == 0 { take + 1 } else { size });
    }
}

/// Asserts that a text punched and read again is the same, without a finding; nothing if the code lacks a character.
pub fn check_round_trip(text: &[u8], system: System, even: bool, codes: &Codes) -> Option<Vec<u8>> {
    let how = Punch { system, leader: 3, even, semicolon_ends: true };
    let image = punch(text, how, codes).ok()?;
    let tape = Tape::new(system, &image, codes).expect("an end of block is always punched");
    let read = check_tape(&image, tape, codes, even);
    // A `%` ends a tape wherever it stands, and what stands behind it is read no more.
    assert_eq!(read.findings, [], "{}", text.escape_ascii());
    if read.unread == 0 && !even {
        let normal = normal(text);
        assert!(read.text == normal, "{}\n{}", read.text.escape_ascii(), normal.escape_ascii());
    }
    Some(image)
}

/// A text as it comes from a tape: line ends alike, the last line ended, blocks at `;` on lines of their own.
pub fn normal(text: &[u8]) -> Vec<u8> {
    let mut characters = text.to_vec();
    Format::Text.translate(&Codes::default(), &mut characters, 0, true);
    characters.retain(|&character| character != IGNORED);
    let (mut normal, mut in_comment, mut rest) = (Vec::new(), false, characters.as_slice());
    while let Some((&character, behind)) = rest.split_first() {
        rest = behind;
        match character {
            b'(' => in_comment = true,
            b')' | END_OF_BLOCK => in_comment = false,
            _ => {}
        }
        if character == b';' && !in_comment {
            normal.push(END_OF_BLOCK);
            let blank = rest.iter().take_while(|c| matches!(c, b' ' | b'\t')).count();
            if rest.get(blank) == Some(&END_OF_BLOCK) {
                rest = &rest[blank + 1..];
            }
        } else {
            normal.push(character);
        }
    }
    let first = normal.split(|&c| c == END_OF_BLOCK).next().unwrap_or_default();
    let label = first.iter().filter(|c| !matches!(c, b' ' | b'\t')).eq(b"%");
    if label {
        // Blanks before the `%` that ends the label are the label's.
        let head = normal.iter().position(|&c| c == b'%').unwrap_or(0);
        normal.drain(..head);
    }
    let label = label && !normal.contains(&END_OF_BLOCK);
    if !normal.is_empty() && !normal.ends_with(b"\n") && (!normal.ends_with(b"%") || label) {
        normal.push(END_OF_BLOCK);
    }
    normal
}

/// Asserts everything of any bytes: as what they are recognised, as a tape of this code, and as a text to be punched.
pub fn check_bytes(bytes: &[u8], system: System, codes: &Codes, tv: bool, size: usize) {
    let format = recognise(bytes, codes);
    assert!(format == Format::Text || !bytes.is_ascii(), "ASCII is text");
    check_chunks(bytes, format, codes, size);
    check_round_trip(bytes, system, tv, codes);
    let Some(tape) = Tape::new(system, bytes, codes) else { return };
    if format != Format::Tape(tape) {
        check_chunks(bytes, Format::Tape(tape), codes, size);
    }
    let read = check_tape(bytes, tape, codes, tv);
    // A tape without faults is punched again as what it says; `?` stands in a comment for a row that is none.
    if read.findings.is_empty() && !read.text.iter().any(|character| b";?".contains(character)) {
        check_round_trip(&read.text, system, false, codes).expect("what was read can be punched");
    }
}

/// Asserts that a tape can be drawn.
pub fn check_drawings(bytes: &[u8], system: System, codes: &Codes) {
    if let Some(tape) = Tape::new(system, bytes, codes) {
        assert!(draw(bytes, tape, codes, true).lines().count() > 3);
        assert!(strip(bytes, tape, codes).ends_with("</svg>\n"));
    }
}
