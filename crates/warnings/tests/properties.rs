//! Any text can be watched: no panic, every finding in the text, the same every time, and nothing of the run changes.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod texts;

use base::Severity;
use proptest::prelude::*;
use station::Step;
use texts::{configuration, session, watched};
use warnings::{Outcomes, Watch, power_on_trials, second_piece};

const MOST_EVENTS: usize = 2000;

/// A word that means something to some rule.
fn word() -> impl Strategy<Value = String> {
    let codes = prop::sample::select(vec![
        "G00",
        "G01",
        "G02",
        "G04",
        "G10",
        "G17",
        "G20",
        "G28",
        "G43",
        "G45",
        "G49",
        "G50",
        "G51",
        "G52",
        "G53",
        "G54",
        "G68",
        "G77",
        "G80",
        "G81",
        "G83",
        "G87",
        "G90",
        "G91",
        "G92",
        "G94",
        "G95",
        "G99",
        "M00",
        "M01",
        "M02",
        "M03",
        "M06",
        "M30",
        "M94",
        "M95",
        "M98P2",
        "M99",
        "M99P3",
        "N3",
        "/",
        "(ALLOW: ENDLESS)",
        "O2",
        "%",
        "#1=#1+1",
        "GOTO3",
        "IF[#1EQ2]GOTO3",
    ]);
    let letter = prop::sample::select(b"XYZABFHDIJKRQPLST".to_vec());
    let number =
        prop_oneof![(-200i32..2000).prop_map(|n| n.to_string()), (-99.0..99.0f64).prop_map(|n| format!("{n:.2}"))];
    prop_oneof![
        2 => codes.prop_map(str::to_owned),
        2 => (letter, number).prop_map(|(letter, number)| format!("{}{number}", char::from(letter))),
    ]
}

fn program() -> impl Strategy<Value = String> {
    let block = prop::collection::vec(word(), 0..5).prop_map(|words| words.join(" "));
    prop::collection::vec(block, 1..25).prop_map(|blocks| blocks.join("\n"))
}

/// The events of a run that nobody watches.
fn unwatched(text: &[u8]) -> usize {
    let mut session = session(&configuration(), text);
    let mut events = 0;
    session.start();
    while events < MOST_EVENTS {
        match session.next() {
            Step::Event(_) => events += 1,
            Step::Stopped => session.start(),
            _ => break,
        }
    }
    events
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn any_text_can_be_watched(text in program()) {
        let configuration = configuration();
        let mut findings = Vec::new();
        for _ in 0..2 {
            let mut session = session(&configuration, text.as_bytes());
            let mut watch = Watch::new(&configuration);
            let (events, found) = watched(&mut session, &mut watch, MOST_EVENTS);
            prop_assert_eq!(events, unwatched(text.as_bytes()));
            for finding in &found {
                let block = finding.place.block;
                prop_assert!(block.end() <= text.len() as u64, "{:?}", finding);
                let bytes = &text.as_bytes()[block.start as usize..block.end() as usize];
                if let Some(diagnostic) = finding.show(&configuration.control, bytes, watch.widest(), Severity::Warning) {
                    prop_assert!(!diagnostic.message.is_empty() && !diagnostic.message.contains(['{', '?']), "{}", diagnostic.message);
                    prop_assert!(!diagnostic.why.contains(['{', '?']) && !diagnostic.help.contains(['{', '?']), "{:?}", diagnostic);
                }
            }
            findings.push(found);
        }
        prop_assert_eq!(&findings[0], &findings[1]);
    }

    #[test]
    fn any_text_can_be_run_beside_itself(text in program()) {
        let configuration = configuration();
        let fresh = || session(&configuration, text.as_bytes());
        let watch = Watch::new(&configuration);
        // A session in which nothing has run is the same as another.
        let said = second_piece(&mut fresh(), &mut fresh(), &watch, 2).expect("it is in memory");
        prop_assert!(said.is_none(), "{:?}", said);
        let trials = power_on_trials(&configuration.control, &configuration.fitting, 1);
        let mut outcomes = Outcomes::default();
        for trial in trials.into_iter().take(4) {
            let otherwise = station::Configuration { fitting: trial.fitting.clone(), ..configuration.clone() };
            let mut other = session(&otherwise, text.as_bytes());
            outcomes.run(&mut fresh(), &mut other, trial, 1).expect("it is in memory");
        }
        prop_assert!(outcomes.findings().iter().all(|finding| finding.place.block.end() <= text.len() as u64));
    }
}
