//! Which random programs a test takes.

use std::panic::AssertUnwindSafe;

/// How many samples a test takes: `default`, or what the environment asks for with PROGRAMS.
pub fn samples_asked(default: u64) -> u64 {
    std::env::var("PROGRAMS").map_or(default, |count| count.parse().expect("PROGRAMS is a number"))
}

/// The numbers of the samples that a test takes: as [`samples_asked`] says, or only those of ONLY=1831,3419.
pub fn seeds_asked(default: u64) -> Vec<u64> {
    match std::env::var("ONLY") {
        Ok(only) => only.split(',').map(|seed| seed.parse().expect("ONLY is a list of numbers")).collect(),
        Err(_) => (0..samples_asked(default)).collect(),
    }
}

/// Runs a check for many numbers and tells of the first ones that fail, and of how many do.
pub fn over_seeds(default: u64, check: impl Fn(u64) -> Result<(), String>) {
    let seeds = seeds_asked(default);
    let mut wrong = Vec::new();
    for &seed in &seeds {
        let checked = std::panic::catch_unwind(AssertUnwindSafe(|| check(seed)));
        let checked = checked.unwrap_or_else(|panic| Err(panic.downcast_ref::<String>().cloned().unwrap_or_default()));
        if let Err(what) = checked {
            wrong.push(format!("program {seed}: {what}"));
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {} programs:\n{}",
        wrong.len(),
        seeds.len(),
        wrong[..wrong.len().min(25)].join("\n")
    );
}
