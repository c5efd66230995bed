//! Any bytes, in windows of any size: the reading stages never fail, never stand still, and lose no character.
//!
//! The last byte of an input chooses the control's grammar and the window sizes, so that a program is an input as it is.

#![no_main]

use fuzz::reading::{characters, check_print, read_all, said};
use libfuzzer_sys::fuzz_target;
use syntax::{BlockDelete, Colon, Grammar, LowerCase, Percent, Semicolon};

fuzz_target!(|input: &[u8]| {
    let Some((&mode, text)) = input.split_last() else { return };
    let bit = |bit: u8| mode & (1 << bit) != 0;
    let grammar = Grammar {
        semicolon: if bit(0) { Semicolon::Comment } else { Semicolon::EndOfBlock },
        lower_case: if bit(1) { LowerCase::Fold } else { LowerCase::Refuse },
        colon: if bit(2) { Colon::Refuse } else { Colon::ProgramNumber },
        percent: if bit(6) { Percent::Ignore } else { Percent::EndOfTape },
        block_delete: if bit(6) { BlockDelete::Head } else { BlockDelete::Anywhere },
        named_call: bit(7).then_some(98),
        block_length: if bit(3) { u32::MAX } else { 40 },
        ..Grammar::default()
    };
    let sizes: &[usize] = match mode >> 4 & 3 {
        0 => &[1],
        1 => &[7],
        2 => &[2, 3, 11, 1],
        _ => &[64, 5],
    };
    let blocks = read_all(text, &grammar, &[text.len()]);
    assert_eq!(said(&read_all(text, &grammar, sizes)), said(&blocks), "windows of {sizes:?}");
    let whole = characters(text);
    for block in &blocks {
        check_print(block, &whole, &grammar);
    }
});
