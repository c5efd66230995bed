//! What the axes are asked for, servo period by servo period, in every case of the corpus and in longer programs: never
//! above the speed, acceleration and jerk of any axis, and never farther off the path than a corner may be left.
//!
//! The environment can ask for more: PERIODS of a single program at most, PROGRAMS_IN a folder of programs to drive as
//! well. `benches/limits.py` asks for both. ONLY names a single case, SEED
//! other deeds of the hand.

#![allow(clippy::expect_used, clippy::panic)]

mod driven;
mod watch;

use std::path::{Path, PathBuf};

use driven::{Figures, Hand, drive};
use station::Session;
use watch::{Texts, configuration, machine, select};

/// Servo periods of a single program.
const PERIODS: u64 = 1500;

fn periods() -> u64 {
    std::env::var("PERIODS").map_or(PERIODS, |count| count.parse().expect("PERIODS is a number"))
}

fn sorted(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder of the corpus");
    let mut found: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    found.sort();
    found
}

/// Drives every case that is a program, as the hand does what it does; the figures of all.
fn over_cases(hand: impl Fn(u64) -> Hand) -> Figures {
    let corpus = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases"));
    let (mut all, mut wrong) = (Figures::default(), Vec::new());
    let only = std::env::var("ONLY").ok();
    for family in sorted(corpus).into_iter().filter(|path| path.is_dir()) {
        for folder in sorted(&family).into_iter().filter(|path| path.join("case.toml").is_file()) {
            let Some(mut session) = driven::case::session(&family, &folder) else { continue };
            let name = folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            if only.as_ref().is_some_and(|only| *only != name) {
                all.programs += 1;
                continue;
            }
            if let Err(what) = drive(&mut session, periods(), &mut hand(all.programs), &mut all) {
                wrong.push(format!("{name}: {what}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {} cases:\n{}", wrong.len(), all.programs, wrong.join("\n"));
    all
}

#[test]
fn every_case_keeps_to_the_limits_of_its_machine() {
    let all = over_cases(|_| Hand::off());
    println!("cases: {all}");
    assert!(all.programs > 900 && all.periods > 100_000, "{all}");
}

#[test]
fn so_does_every_case_with_holds_and_overrides_thrown_in() {
    let seed = std::env::var("SEED").map_or(0, |seed| seed.parse::<u64>().expect("SEED is a number"));
    let all = over_cases(|program| Hand::on(program + 1_000_003 * seed));
    println!("cases, overrides, holds and single block thrown in: {all}");
    assert!(all.acts > 1000, "{all}");
}

fn longer() -> Vec<(String, Vec<u8>)> {
    let mut programs: Vec<_> =
        driven::programs::all().into_iter().map(|(name, text)| (name.to_owned(), text.into_bytes())).collect();
    if let Some(folder) = std::env::var_os("PROGRAMS_IN") {
        for path in sorted(Path::new(&folder)) {
            programs.push((path.display().to_string(), std::fs::read(&path).expect("a program")));
        }
    }
    programs
}

#[test]
fn longer_programs_keep_to_them_under_every_model() {
    for (name, text) in longer() {
        for model in ["trapezoid", "jerk", "classic"] {
            for hand in [Hand::off(), Hand::on(7)] {
                let mut machine = machine("stock-vmc", Some(1e6));
                driven::programs::set_model(&mut machine, model);
                let mut session = Session::new(configuration(machine, &driven::programs::setup()), Texts::one(&*text));
                select(&mut session, 0);
                let (mut hand, mut all) = (hand, Figures::default());
                let is_on = hand.is_on();
                if let Err(what) = drive(&mut session, 20 * periods(), &mut hand, &mut all) {
                    panic!("{name}, model {model}, hand {is_on}: {what}");
                }
                println!("{name}, model {model}{}: {all}", if is_on { ", thrown in" } else { "" });
                assert!(all.periods > 1000 && all.moves > 2, "{name}: {all}");
            }
        }
    }
}
