//! Any bytes can be read as a tape or as text; a text punched and read is the same text; no damage goes unseen.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod tapes;

use proptest::prelude::*;
use proptest::sample::select;
use tape::{Codes, Format, Punch, System, Tape, Wrong, punch, recognise};
use tapes::{check_bytes, check_drawings, check_round_trip, codes, normal};

fn system() -> impl Strategy<Value = System> {
    select(vec![System::Iso, System::Eia])
}

/// Words that programs are made of, with the characters that both codes have.
fn word() -> impl Strategy<Value = String> {
    prop_oneof![
        8 => ("[GXYZMNFSTHD]", "[-+]?[1-9][0-9]{0,4}[.]?[0-9]{0,3}").prop_map(|(letter, number)| letter + &number),
        1 => select(vec!["/", "/2", " ", "(PLATE 3/4, NO. 5)", "\t", "G00", "X0"]).prop_map(str::to_owned),
    ]
}

/// A program as a person would have it punched: it begins and ends with %, and says something.
fn program() -> impl Strategy<Value = String> {
    let block = prop::collection::vec(word(), 1..8).prop_map(|words| words.concat());
    prop::collection::vec(block, 2..20).prop_map(|blocks| format!("%\nO1\n{}\nM30\n%\n", blocks.join("\n")))
}

/// Any characters that a tape can hold, and others.
fn text() -> impl Strategy<Value = Vec<u8>> {
    let piece = prop_oneof![
        6 => word().prop_map(String::into_bytes),
        4 => select(vec!["\n", "\r\n", "\r", ";", "; \n", "%", "(A;B)", "(", ")", "#1=[2*3]", ":", ",", "&", "\0", "\x7F"])
            .prop_map(|text| text.as_bytes().to_vec()),
        1 => select(vec!["é", "\u{FEFF}", "a", "?"]).prop_map(|text| text.as_bytes().to_vec()),
    ];
    prop::collection::vec(piece, 0..30).prop_map(|pieces| pieces.concat())
}

/// A comment as people write it in any alphabet, in the encodings of their day.
fn comment() -> impl Strategy<Value = Vec<u8>> {
    let utf_8 = "[A-Z0-9 .:äöüÄÖÜßéèàçñøØ°µ€–„“АБВГДЕЖ日本語]{0,30}".prop_map(String::into_bytes);
    let bytes = prop::collection::vec((0x20u8..=0xFF).prop_filter("no end", |b| !matches!(b, b'(' | b')')), 0..30);
    prop_oneof![utf_8, bytes].prop_map(|inside| [b"(", inside.as_slice(), b")"].concat())
}

proptest! {
    #[test]
    fn any_bytes_are_read(
        bytes in prop::collection::vec(any::<u8>(), 0..200), system in system(), tv in any::<bool>(), size in 1usize..20,
    ) {
        check_bytes(&bytes, system, &Codes::default(), tv, size);
        check_bytes(&bytes, system, &codes(), tv, size);
        check_drawings(&bytes, system, &codes());
    }

    #[test]
    fn a_text_comes_back_from_tape(text in text(), system in system(), even in any::<bool>()) {
        check_round_trip(&text, system, even, &codes());
    }

    #[test]
    fn the_tape_of_a_program_is_recognised(program in program(), system in system(), even in any::<bool>()) {
        let how = Punch { system, leader: 40, even, semicolon_ends: true };
        let image = punch(program.as_bytes(), how, &Codes::default()).expect("both codes have its characters");
        let Format::Tape(tape) = recognise(&image, &Codes::default()) else { panic!("taken for text") };
        prop_assert_eq!((tape.system, tape.head), (system, 40));
    }

    #[test]
    fn a_text_with_comments_of_any_kind_is_no_tape(
        program in program(), first in comment(), others in prop::collection::vec(comment(), 0..4), crlf in any::<bool>(),
    ) {
        let end: &[u8] = if crlf { b"\r\n" } else { b"\n" };
        let mut text = [first.as_slice(), end].concat();
        let mut comments = others.iter();
        for line in program.lines() {
            text.extend_from_slice(line.as_bytes());
            text.extend(comments.next().into_iter().flatten());
            text.extend_from_slice(end);
        }
        prop_assert_eq!(recognise(&text, &Codes::default()), Format::Text, "{}", text.escape_ascii());
    }

    #[test]
    fn one_wrong_hole_is_found_and_named(program in program(), system in system(), place in any::<prop::sample::Index>(), channel in 0u8..8) {
        let how = Punch { system, leader: 10, even: false, semicolon_ends: true };
        let whole = punch(program.as_bytes(), how, &Codes::default()).expect("both codes have its characters");
        // Behind the label, before the % that ends the tape.
        let end = whole.len() - 12;
        let at = 12 + place.index(end - 12);
        let mut image = whole.clone();
        image[at] ^= 1 << channel;
        let Format::Tape(tape) = recognise(&image, &Codes::default()) else { panic!("taken for text") };
        prop_assert_eq!(tape.system, system);
        let read = tape::read_tape(&image, tape, &Codes::default(), false);
        prop_assert_eq!(read.findings.len(), 1);
        prop_assert_eq!(read.findings[0].at, at as u64);
        let Wrong::Row { row, .. } = read.findings[0].wrong else { panic!("{:?}", read.findings) };
        prop_assert_eq!(row, image[at]);
    }
}

#[test]
fn the_property_tests_compare_with_a_text_that_differs() {
    assert_eq!(normal(b"\xEF\xBB\xBFG1;G2 ; \r\nM30"), b"G1\nG2 \nM30\n");
    let image = punch(b"%\nG1\n", Punch { system: System::Iso, leader: 0, even: true, semicolon_ends: true }, &codes());
    let image = image.expect("ISO has its characters");
    assert!(Tape::new(System::Eia, &image, &codes()).is_none());
}
