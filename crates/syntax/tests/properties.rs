//! Any bytes can be read: nothing is lost, nothing is counted wrong, and window borders leave no trace.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod reading;

use proptest::prelude::*;
use reading::{characters, check_print, read_all, said};
use syntax::{Block, BlockDelete, Colon, Cursor, Grammar, LowerCase, Outcome, Percent, Semicolon, read_block};

fn grammar() -> impl Strategy<Value = Grammar> {
    (any::<bool>(), any::<bool>(), any::<bool>(), prop_oneof![Just(u32::MAX), Just(40u32), Just(128)]).prop_map(
        |(comment, fold, colon, block_length)| Grammar {
            semicolon: if comment { Semicolon::Comment } else { Semicolon::EndOfBlock },
            lower_case: if fold { LowerCase::Fold } else { LowerCase::Refuse },
            colon: if colon { Colon::ProgramNumber } else { Colon::Refuse },
            named_call: if fold { Some(98) } else { None },
            percent: if fold { Percent::Ignore } else { Percent::EndOfTape },
            block_delete: if comment { BlockDelete::Head } else { BlockDelete::Anywhere },
            block_length,
            ..Grammar::default()
        },
    )
}

/// Pieces of which programs are made, in any order.
fn piece() -> impl Strategy<Value = Vec<u8>> {
    let word = ("[A-Z:]", "[-+]?[0-9]{0,6}[.]?[0-9]{0,4}").prop_map(|(letter, number)| format!("{letter}{number}"));
    let expression =
        ("[A-Z]", "(-)?#[0-9]{1,3}|\\[[#0-9+*]{0,6}\\]|#\\[#[0-9]\\]|-").prop_map(|(letter, text)| letter + &text);
    let statement = "#[0-9]{1,3}=[-#0-9+]{1,6}|IF\\[#1EQ[0-9]\\]GOTO ?[0-9]|WHILE\\[#1\\]DO1|END ?1|GOTO9|DO2";
    let sign = prop::sample::select(vec![
        "\n",
        "M98 AB1.NC L2",
        "M98",
        "\r\n",
        "\r",
        ";",
        "%",
        "/",
        "/2",
        "/ 9",
        " ",
        "\t",
        "(A)",
        "(",
        ")",
        "\0",
        "\x7F",
        ".",
        "-",
        "=",
        "x1",
        "\u{FEFF}",
    ]);
    prop_oneof![
        6 => word.prop_map(String::into_bytes),
        2 => expression.prop_map(String::into_bytes),
        1 => statement.prop_map(String::into_bytes),
        5 => sign.prop_map(|text| text.as_bytes().to_vec()),
        1 => prop::collection::vec(any::<u8>(), 1..4),
    ]
}

fn program() -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(piece(), 0..60).prop_map(|pieces| pieces.concat())
}

fn window_sizes() -> impl Strategy<Value = Vec<usize>> {
    prop_oneof![Just(vec![1]), Just(vec![7]), prop::collection::vec(1usize..40, 1..5)]
}

fn check(text: &[u8], grammar: &Grammar, sizes: &[usize]) {
    let blocks = read_all(text, grammar, &[text.len().max(1)]);
    assert_eq!(blocks, read_all(text, grammar, &[text.len().max(1)]), "twice the same");
    assert_eq!(said(&read_all(text, grammar, sizes)), said(&blocks), "windows of {sizes:?}");
    let whole = characters(text);
    blocks.iter().for_each(|block| check_print(block, &whole, grammar));
}

proptest! {
    #[test]
    fn any_bytes_are_read(text in prop::collection::vec(any::<u8>(), 0..300), grammar in grammar(), sizes in window_sizes()) {
        check(&text, &grammar, &sizes);
    }

    #[test]
    fn any_program_is_read(text in program(), grammar in grammar(), sizes in window_sizes()) {
        check(&text, &grammar, &sizes);
    }

    /// Runs longer than any block: comments, words, numbers and leaders of thousands of characters.
    #[test]
    fn windows_leave_no_trace_in_overlong_lines(
        runs in prop::collection::vec((prop::sample::select(b"(X1;) #[\0/".to_vec()), 4000usize..9000), 1..4),
        tail in program(),
        grammar in grammar(),
        size in prop_oneof![Just(1000usize), Just(8194), 8000usize..9000],
    ) {
        let mut text = Vec::new();
        for (byte, count) in runs {
            text.extend(std::iter::repeat_n(byte, count));
        }
        text.extend_from_slice(b")\n");
        text.extend_from_slice(&tail);
        let blocks = read_all(&text, &grammar, &[text.len()]);
        prop_assert_eq!(said(&read_all(&text, &grammar, &[size])), said(&blocks));
    }
}

/// The reader's promise: a window of 8192 + 2 characters is always enough.
#[test]
fn a_window_of_the_promised_size_is_always_enough() {
    for text in [
        "(".repeat(30_000),
        "X1".repeat(15_000),
        "\0".repeat(30_000),
        format!("#1={}", "1".repeat(30_000)),
        "1".repeat(30_000),
    ] {
        let (text, mut cursor, mut block) = (text.as_bytes(), Cursor::HEAD, Block::default());
        loop {
            let rest = &text[cursor.offset as usize..];
            let window = &rest[..rest.len().min(8194)];
            match read_block(window, window.len() == rest.len(), cursor, &Grammar::default(), &mut block) {
                Outcome::Block => cursor = block.next,
                Outcome::End => break,
                Outcome::More => panic!("{cursor:?} asks for more"),
            }
        }
    }
}
