//! Any bytes as a punched tape of either code: every wrong hole is named, nothing is lost, what was read can be punched.
//!
//! The last byte of an input chooses the checks and the codes, so that a text or an image is an input as it is.

#![no_main]

use std::sync::LazyLock;

use fuzz::tapes::{check_bytes, check_drawings, codes};
use libfuzzer_sys::fuzz_target;
use tape::{Codes, System};

static ALL: LazyLock<Codes> = LazyLock::new(codes);

fuzz_target!(|input: &[u8]| {
    let Some((&mode, bytes)) = input.split_last() else { return };
    let bit = |bit: u8| mode & (1 << bit) != 0;
    let codes = if bit(0) { *ALL } else { Codes::default() };
    let size = [1, 2, 7, 64][usize::from(mode >> 4 & 3)];
    let system = if bit(2) { System::Iso } else { System::Eia };
    check_bytes(bytes, system, &codes, bit(1), size);
    // Drawing takes longer than everything else together.
    if mode >> 3 == 0b10101 {
        check_drawings(bytes, system, &codes);
    }
});
