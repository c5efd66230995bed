//! House style changes how a program looks and nothing of what it does; a text in house style stays as it is.

mod shop;
#[path = "../../station/tests/programs/mod.rs"]
mod written;

use std::collections::BTreeSet;

use machine::EventKind;
use meaning::EndKind;
use proptest::prelude::*;
use report::{Formatted, HouseStyle, Numbering, house_style, same_run};
use station::{AfterAlarm, Configuration, Step};

/// A random program may run for ever.
const MOST_EVENTS: u64 = 3000;

fn refused(configuration: &Configuration, text: &[u8]) -> BTreeSet<u64> {
    let mut session = shop::session(configuration, text);
    session.set_after_alarm(AfterAlarm::GoOn);
    session.start();
    let mut refused = BTreeSet::new();
    for _ in 0..MOST_EVENTS {
        match session.next() {
            Step::Event(event) => {
                if let EventKind::Alarm(alarm) = event.kind
                    && !matches!(alarm.condition, base::Condition::NotYetBuilt | base::Condition::MacroUser)
                {
                    refused.insert(alarm.place.block.start);
                }
            }
            Step::Stopped => session.start(),
            _ => break,
        }
    }
    refused
}

fn format(configuration: &Configuration, text: &[u8], numbering: Option<Numbering>) -> Result<Formatted, String> {
    let style = HouseStyle { axes: b"XYZ".to_vec(), numbering, refused: refused(configuration, text) };
    house_style(text, &configuration.control, &style)
}

/// The place of the first difference in the runs of two texts.
fn difference(configuration: &Configuration, old: &[u8], new: &[u8]) -> Option<String> {
    [AfterAlarm::Stand, AfterAlarm::GoOn].into_iter().find_map(|after| {
        let [mut first, mut second] = [old, new].map(|text| {
            let mut session = shop::session(configuration, text);
            session.set_after_alarm(after);
            session
        });
        let found = same_run(&mut first, &mut second, MOST_EVENTS).expect("the texts can be read");
        found.map(|it| format!("{after:?} line {} and line {}", it.first.line, it.second.line))
    })
}

/// True for a program that comes round for ever: when it is seen to do so depends on the numbers of its blocks.
fn comes_round(configuration: &Configuration, text: &[u8]) -> bool {
    [AfterAlarm::Stand, AfterAlarm::GoOn].into_iter().any(|after| {
        let mut session = shop::session(configuration, text);
        session.set_after_alarm(after);
        session.start();
        for _ in 0..MOST_EVENTS {
            match session.next() {
                Step::Event(event) => {
                    if matches!(event.kind, EventKind::End { kind: EndKind::M99 | EndKind::Loop, .. }) {
                        return true;
                    }
                }
                Step::Stopped => session.start(),
                _ => return false,
            }
        }
        true
    })
}

fn check(configuration: &Configuration, text: &[u8], name: &str) {
    let once = format(configuration, text, None).expect("nothing is numbered");
    let shown = || format!("{name}\n{}\n----\n{}", String::from_utf8_lossy(text), String::from_utf8_lossy(&once.text));
    assert_eq!(difference(configuration, text, &once.text), None, "{}", shown());
    let twice = format(configuration, &once.text, None).expect("nothing is numbered");
    assert!(twice.unchanged, "{}\n----\n{}", shown(), String::from_utf8_lossy(&twice.text));
    if !comes_round(configuration, text)
        && let Ok(numbered) = format(configuration, text, Some(Numbering { start: 10, step: 5 }))
    {
        let shown =
            || format!("{name}\n{}\n----\n{}", String::from_utf8_lossy(text), String::from_utf8_lossy(&numbered.text));
        assert_eq!(difference(configuration, text, &numbered.text), None, "{}", shown());
    }
}

#[test]
fn every_program_of_the_corpus_runs_as_before_and_is_settled_at_once() {
    let configuration = shop::configuration();
    for (path, text) in shop::programs() {
        check(&configuration, &text, &path.display().to_string());
    }
}

#[test]
fn random_programs_run_as_before_and_are_settled_at_once() {
    let configuration = shop::configuration();
    let mut runner = proptest::test_runner::TestRunner::new(ProptestConfig {
        cases: 12000,
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    let outcome = runner.run(&written::program(&configuration.control), |text| {
        check(&configuration, text.as_bytes(), "");
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
}

#[test]
fn numbers_are_given_anew_and_every_jump_leads_where_it_led() {
    let configuration = shop::configuration();
    let text = b"O1\nG91 G00 X1.\nM98 P2\nN7 X2.\nN8 X3.\nM30\nO2\nN1 G01 Y1. F100\nM99 P8\n";
    let numbered = format(&configuration, text, Some(Numbering { start: 10, step: 10 })).expect("it can be numbered");
    let wanted = "O1\nN10 G91 G00 X1.\nN20 M98 P2\nN30 X2.\nN40 X3.\nN50 M30\nO2\nN10 G01 Y1. F100\nN20 M99 P40\n";
    assert_eq!(String::from_utf8_lossy(&numbered.text), wanted);
}

#[test]
fn what_cannot_be_numbered_without_a_guess_is_refused() {
    let configuration = shop::configuration();
    let why = |text: &str| {
        let refused = format(&configuration, text.as_bytes(), Some(Numbering { start: 1, step: 1 }));
        refused.map(|formatted| String::from_utf8_lossy(&formatted.text).into_owned()).unwrap_err()
    };
    assert_eq!(why("O1\nN1 GOTO #5\nM30\n"), "line 2: a jump by a variable cannot be led to a new number");
    assert_eq!(why("O1\nN5\nN5\nM99 P5\n"), "line 4: block N5, to which it leads, stands twice in its program");
    assert_eq!(why("O1\nM99 P5\n"), "line 2: there is no block N5 to which it could lead");
    assert_eq!(why("O1\nG01 X..1\n"), "line 2: the block cannot be read, and its jumps neither");
    assert_eq!(why("O1\nN0 G04 P1\nM30\n"), "line 2: the block's number is not one of N1 to N99999");
    let two = "O1\nM98 P3\nN9 M98 P2\nM30\nO2\nG04 P1\nM98 P3\nN9\nM99\nO3\nM99 P9\n";
    assert_eq!(why(two), "line 11: N9 gets different numbers in the programs that call this one");
}

#[test]
fn line_ends_marks_and_what_stands_behind_the_tape_stay() {
    let configuration = shop::configuration();
    let formatted = |text: &[u8]| format(&configuration, text, None).expect("nothing is numbered").text;
    assert_eq!(
        formatted(b"\xEF\xBB\xBF%\r\nO1\r\nG0X1.\r\n\r\n%\r\nany thing  \r"),
        b"\xEF\xBB\xBF%\r\nO1\r\nG00 X1.\r\n\r\n%\r\nany thing  \r"
    );
    assert_eq!(formatted(b"G0X1.\rM30"), b"G00 X1.\rM30\r");
    assert_eq!(formatted(b"G00X1.;G92X0;;(END)\nM30"), b"G00 X1.\nG92 X0\n(END)\nM30\n");
    assert_eq!(formatted(b""), b"");
}
