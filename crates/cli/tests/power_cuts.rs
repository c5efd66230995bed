//! The small edition of `benches/power_cuts.py`: the process is killed at random moments, and nothing said is lost.
#![cfg(unix)]

use std::process::Command;

#[test]
fn nothing_that_was_said_is_lost_when_the_power_is_cut() {
    let bench = concat!(env!("CARGO_MANIFEST_DIR"), "/../../benches/power_cuts.py");
    let mut command = Command::new("python3");
    command.args([bench, "20", "--program", env!("CARGO_BIN_EXE_cyclestart")]);
    let done = command.output().expect("python3 is needed to run the tests");
    let (out, errors) = (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert!(done.status.success(), "{out}{errors}");
    assert!(out.contains("killed 20 times") && out.contains("0 acknowledged writes lost"), "{out}");
}
