//! The operator's shift in `examples/shift` does exactly what is written down beside it. `UPDATE_CASES=1` writes that anew.

#![allow(clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use std::path::PathBuf;
use std::process::Command;

#[test]
fn the_shift_is_what_is_written_down() {
    let folder = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/shift"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_cyclestart"));
    let output = command.args(["operate", "shift.txt"]).current_dir(&folder).output().expect("it can be run");
    let trace = String::from_utf8(output.stdout).expect("a trace is text");
    let file = folder.join("shift.trace");
    if std::env::var_os("UPDATE_CASES").is_some() {
        std::fs::write(&file, &trace).expect("it can be written");
    }
    let wanted = std::fs::read_to_string(&file).expect("the trace lies beside the script");
    for (line, (is, wanted)) in (1..).zip(trace.lines().zip(wanted.lines())) {
        assert_eq!(is, wanted, "shift.trace:{line}");
    }
    assert_eq!(trace.lines().count(), wanted.lines().count(), "so many lines");
    assert!(output.status.success(), "no alarm stands at the end of a shift");
}
