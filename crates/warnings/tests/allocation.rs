//! Watching allocates nothing that depends on the program's length.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod texts;

use std::fmt::Write;

use testkit::{Counting, allocations_so_far};
use texts::{configuration, session, watched};
use warnings::Watch;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// What watching a program of so many lines allocates, the session's own buffers apart.
fn allocations(lines: usize, line: impl Fn(usize) -> String) -> u64 {
    let mut text = "G90 G17 G40 G49 G80 G54 G98 F500\nG00 X0 Y0 Z50.\n".to_owned();
    for index in 0..lines {
        let _ = writeln!(text, "{}", line(index));
    }
    text += "M30\n";
    let configuration = configuration();
    let mut session = session(&configuration, text.as_bytes());
    let mut watch = Watch::new(&configuration);
    let before = allocations_so_far();
    let (events, found) = watched(&mut session, &mut watch, usize::MAX);
    assert!(events > lines, "{events} events of {lines} lines");
    assert!(found.iter().all(|finding| finding.rule.name() == "memory-size"), "{found:?}");
    allocations_so_far() - before
}

#[test]
fn watching_allocates_no_more_for_a_longer_program() {
    type Line = fn(usize) -> String;
    let lines: [(&str, Line); 4] = [
        ("moves", |index| format!("G01 X{}.5 Y{}. Z-{}.25", index % 90, index % 70, index % 9)),
        ("integers", |index| format!("G01 X{} Y{}", 1 + index % 9000, 1 + index % 700)),
        ("holes", |index| format!("G81 X{}. Y5. R2. Z-4. F100", index % 90)),
        ("modes", |index| format!("G9{} G01 X0. D31 S{}", index % 2, 100 + index % 900)),
    ];
    for (name, line) in lines {
        // The places of integers are kept up to a number that both programs pass.
        let (short, long) = (allocations(9_000, line), allocations(90_000, line));
        // The control's windows onto its text apart, which come and go with every 64 KiB.
        assert!(long < short + 200, "{name}: {short} for 9,000 lines and {long} for 90,000");
    }
}
