//! Any text can be run: no panic, no endless step, every event at its place, the same every time.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod programs;
mod watch;

use base::SourceId;
use machine::Event;
use proptest::prelude::*;
use station::{AfterAlarm, Configuration, OffsetColumn, Session, Setup, programs_in};
use watch::{Expect, Texts, configuration, control, machine, run, select};

/// Events after which a program counts as endless.
const MOST_EVENTS: usize = 3000;
/// Jumps without motion after which the control calls a program endless.
const MOST_JUMPS: u64 = 300;

/// At least so many cases; the environment can ask for more.
fn config(cases: u32) -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: cases.max(default.cases), ..default }
}

/// How a program is run.
#[derive(Clone, Copy, Debug)]
struct Mode {
    /// Travel of every axis, ± mm.
    travel: Option<f64>,
    after_alarm: AfterAlarm,
    block_delete: u16,
    optional_stop: bool,
    single_block: bool,
    at_border: bool,
}

fn mode() -> impl Strategy<Value = Mode> {
    let travel = prop::sample::select(vec![None, Some(1000.0), Some(30.0)]);
    let after = prop::sample::select(vec![AfterAlarm::Stand, AfterAlarm::GoOn]);
    (travel, after, prop::sample::select(vec![0u16, 1, 0b11]), any::<bool>(), any::<bool>(), any::<bool>()).prop_map(
        |(travel, after_alarm, block_delete, optional_stop, single_block, at_border)| Mode {
            travel,
            after_alarm,
            block_delete,
            optional_stop,
            single_block,
            at_border,
        },
    )
}

fn set_up(mode: Mode) -> Configuration {
    let policies = if mode.at_border { vec![("stroke-check".to_owned(), "at-border".to_owned())] } else { Vec::new() };
    let setup = Setup {
        offsets: vec![
            (OffsetColumn::Common, 1, 12.5),
            (OffsetColumn::Common, 2, -3.25),
            (OffsetColumn::Common, 31, 8.0),
        ],
        work: vec![("G54".into(), b'X', 10.0), ("G55".into(), b'Z', -20.0)],
        policies,
        ..Setup::default()
    };
    let mut configuration = configuration(machine("stock-vmc", Some(mode.travel.unwrap_or(9e6))), &setup);
    configuration.switches.block_delete = mode.block_delete;
    configuration.switches.optional_stop = mode.optional_stop;
    configuration.switches.single_block = mode.single_block;
    configuration
}

fn events(text: &[u8], pieces: &[usize], mode: Mode) -> Vec<Event> {
    let mut session = Session::new(set_up(mode), Texts::one(text).in_pieces(pieces));
    session.set_after_alarm(mode.after_alarm);
    session.interpreter_mut().set_loop_limit(MOST_JUMPS);
    select(&mut session, 0);
    run(&mut session, Expect { most_events: MOST_EVENTS, stays_inside: mode.after_alarm == AfterAlarm::Stand })
}

/// Twice the same, and the same however the text is handed out.
fn check(text: &[u8], pieces: &[usize], mode: Mode) {
    let once = events(text, &[], mode);
    assert_eq!(once, events(text, &[], mode), "twice");
    assert_eq!(once, events(text, pieces, mode), "pieces of {pieces:?}");
}

fn pieces() -> impl Strategy<Value = Vec<usize>> {
    prop_oneof![Just(vec![1]), Just(vec![7]), prop::collection::vec(1usize..60, 1..4)]
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn any_bytes_are_run(text in prop::collection::vec(any::<u8>(), 0..200), pieces in pieces(), mode in mode()) {
        check(&text, &pieces, mode);
    }
}

proptest! {
    #![proptest_config(config(1500))]

    #[test]
    fn any_program_is_run(text in programs::program(&control()), pieces in pieces(), mode in mode()) {
        check(text.as_bytes(), &pieces, mode);
    }
}

proptest! {
    #[test]
    fn the_programs_of_a_text_are_found_in_any_pieces(text in programs::program(&control()), pieces in pieces()) {
        let grammar = control().grammar;
        let whole = programs_in(&mut Texts::one(text.as_str()), SourceId(0), &grammar, None);
        prop_assert_eq!(&programs_in(&mut Texts::one(text.as_str()).in_pieces(&pieces), SourceId(0), &grammar, None), &whole);
        for (number, cursor) in whole.expect("texts in memory can be read") {
            let here = &text.as_bytes()[cursor.offset as usize..];
            prop_assert!(here.starts_with(b"O") || here.starts_with(b":"), "O{number} at {cursor:?}");
        }
    }
}

/// What is found before an alarm does not depend on what follows the alarm.
#[test]
fn checking_on_begins_as_running_does() {
    let text = "G90G00X1.\nG01X2.F100\nX99999999.\nG00X3.\nM30\n";
    let mode = |after_alarm| Mode {
        travel: None,
        after_alarm,
        block_delete: 0,
        optional_stop: false,
        single_block: false,
        at_border: false,
    };
    let stands = events(text.as_bytes(), &[], mode(AfterAlarm::Stand));
    let goes_on = events(text.as_bytes(), &[], mode(AfterAlarm::GoOn));
    assert!(goes_on.len() > stands.len());
    assert_eq!(goes_on[..stands.len()], stands);
}
