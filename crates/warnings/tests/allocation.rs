//! Watching allocates nothing that depends on the program's length.

#![allow(unsafe_code)] // a global allocator is unsafe by its signature
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod texts;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::fmt::Write;

use texts::{configuration, session, watched};
use warnings::Watch;

/// The system's allocator, counting each thread's calls that give memory.
struct Counting;

thread_local! {
    static TAKEN: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    // While a thread ends there is nothing left to count in.
    let _ = TAKEN.try_with(|taken| taken.set(taken.get() + 1));
}

// SAFETY: every call is handed to the system's allocator as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller keeps alloc's contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the pointer came from `alloc`, that is from the system's allocator.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: as for `dealloc`.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

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
    let before = TAKEN.get();
    let (events, found) = watched(&mut session, &mut watch, usize::MAX);
    assert!(events > lines, "{events} events of {lines} lines");
    assert!(found.iter().all(|finding| finding.rule.name() == "memory-size"), "{found:?}");
    TAKEN.get() - before
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
