//! Runs the corpus in `cases/` against the program: every folder is a test of its own.

use std::process::ExitCode;

fn main() -> ExitCode {
    testkit::run_corpus(env!("CARGO_BIN_EXE_cyclestart"), concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases"))
}
