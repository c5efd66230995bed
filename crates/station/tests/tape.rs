//! The image of a tape runs as the text that it holds: the same events at the same lines and columns, in any pieces.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod programs;
mod watch;

use base::SourceId;
use machine::{Event, EventKind};
use proptest::prelude::*;
use proptest::sample::select;
use station::{AfterAlarm, Session, Setup, programs_in};
use tape::{Codes, Format, Punch, System, Tape, punch, read_tape, recognise};
use watch::{Expect, Texts, configuration, control, machine, run, select as select_text};

/// The codes with rows for all macro characters, and the parameters that say so.
fn codes() -> (Codes, Setup) {
    let mut codes = Codes::default();
    let mut setup = Setup::default();
    let names = ["number sign", "equals sign", "asterisk", "left bracket", "right bracket"];
    for ((character, row), name) in tape::PUNCTUATION.into_iter().zip([0x0D, 0x1C, 0x5B, 0x5D, 0x5E]).zip(names) {
        codes.assign(character, row).expect("the row is free");
        let name = format!("eia code of {name}");
        setup.parameters.push(dialect::ParameterSetting { name, bit: None, value: format!("{row:08b}") });
    }
    (codes, setup)
}

/// What an event says, apart from byte offsets, which a leader shifts.
fn said(event: &Event, session: &Session<Texts>) -> String {
    let place = &event.place;
    let program = session.interpreter().program_name(place.program);
    match &event.kind {
        EventKind::Alarm(alarm) => {
            let (condition, column, len) = (alarm.condition, place.column(alarm.span), alarm.span.len);
            format!("{program} {}:{column}+{len} {condition:?} {:?}", place.line, alarm.values)
        }
        // A program that ends with its text ends behind the tape's trailer.
        EventKind::BlockDone | EventKind::End { .. } => format!("{program} {} {:?}", place.line, event.kind),
        kind => format!("{program} {}:{} {kind:?} {}", place.line, place.column(place.block), event.time.0),
    }
}

fn events(bytes: &[u8], setup: &Setup, after: AfterAlarm, pieces: &[usize]) -> Vec<String> {
    let configuration = configuration(machine("unlimited", None), setup);
    let mut session = Session::new(configuration, Texts::one(bytes).in_pieces(pieces));
    session.set_after_alarm(after);
    session.interpreter_mut().set_loop_limit(100);
    select_text(&mut session, 0);
    let events = run(&mut session, Expect { most_events: 1000, stays_inside: false });
    events.iter().map(|event| said(event, &session)).collect()
}

/// A tape that is sure to be recognised: what a program says behind its first blocks is left to chance.
fn surely_tape(head: &str, text: &str) -> String {
    format!("{head}N1234G91G01X-12.5Y47.8F200(TWELVE)\nN1248G01X12.5Y-47.8\nN1247M05\n{text}")
}

/// At least so many cases; the environment can ask for more.
fn config(cases: u32) -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: cases.max(default.cases), ..default }
}

proptest! {
    #![proptest_config(config(600))]

    #[test]
    fn a_tape_runs_as_its_text(
        text in programs::program(&control()),
        system in select(vec![System::Iso, System::Eia]),
        after in select(vec![AfterAlarm::Stand, AfterAlarm::GoOn]),
        head in select(vec!["%\n", "", "\n"]),
        pieces in select(vec![vec![], vec![1], vec![7, 30]]),
    ) {
        let (codes, setup) = codes();
        let text = surely_tape(head, &text);
        let how = Punch { system, leader: 20, even: false, semicolon_ends: true };
        // Small letters and a colon are no EIA.
        let Ok(image) = punch(text.as_bytes(), how, &codes) else { return Ok(()) };
        let Format::Tape(tape) = recognise(&image, &codes) else { panic!("taken for text") };
        let mut read = read_tape(&image, tape, &codes, false).text;
        if read.ends_with(b"\n%\n") {
            read.pop();
        }
        prop_assert_eq!(events(&image, &setup, after, &pieces), events(&read, &setup, after, &[]));
    }

    #[test]
    fn the_programs_of_a_tape_are_those_of_its_text(text in programs::program(&control()), pieces in select(vec![vec![], vec![3]])) {
        let (codes, _) = codes();
        let text = surely_tape("%\n", &text);
        let how = Punch { system: System::Eia, leader: 20, even: false, semicolon_ends: true };
        let Ok(image) = punch(text.as_bytes(), how, &codes) else { return Ok(()) };
        let tape = Tape::new(System::Eia, &image, &codes).expect("an end of block is always punched");
        let read = read_tape(&image, tape, &codes, false).text;
        let list = |bytes: &[u8], pieces: &[usize]| {
            let found = programs_in(&mut Texts::one(bytes).in_pieces(pieces), SourceId(0), &control().grammar, Some(codes));
            let found = found.expect("texts in memory can be read");
            found.into_iter().map(|(number, cursor)| (number, cursor.line)).collect::<Vec<_>>()
        };
        prop_assert_eq!(list(&image, &pieces), list(&read, &[]));
    }

    /// Whatever is wrong with a tape, every event has its place in it, in whatever pieces it is read.
    #[test]
    fn any_damage_has_its_place(
        text in programs::program(&control()),
        system in select(vec![System::Iso, System::Eia]),
        after in select(vec![AfterAlarm::Stand, AfterAlarm::GoOn]),
        block_parity in any::<bool>(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let (codes, mut setup) = codes();
        let bit = dialect::ParameterSetting { name: "tv check".to_owned(), bit: Some(0), value: u8::from(block_parity).to_string() };
        setup.parameters.push(bit);
        let text = surely_tape("%\n", &text);
        let how = Punch { system, leader: 5, even: block_parity, semicolon_ends: true };
        let Ok(mut image) = punch(text.as_bytes(), how, &codes) else { return Ok(()) };
        for (place, row) in damage {
            let at = place.index(image.len());
            image[at] = row;
        }
        prop_assert_eq!(events(&image, &setup, after, &[7, 1, 30]), events(&image, &setup, after, &[]));
    }

    /// Wherever a hole is wrong, the tape does not run past it as if nothing were.
    #[test]
    fn no_wrong_hole_is_run_over(place in 0usize..60, channel in 0u8..8, system in select(vec![System::Iso, System::Eia])) {
        let text = surely_tape("%\n", "G91G00X1.\nG01X12.345Y7.F100(CUT)\nM30\n%\n");
        let how = Punch { system, leader: 5, even: false, semicolon_ends: true };
        let mut image = punch(text.as_bytes(), how, &Codes::default()).expect("both codes have its characters");
        image[7 + place] ^= 1 << channel;
        let events = events(&image, &Setup::default(), AfterAlarm::Stand, &[]);
        let last = events.last().expect("something happens");
        prop_assert!(last.contains("CharacterParity") || last.contains("TapeBlank"), "{}", last);
    }
}

/// A program found in the middle of a source is on a tape only if the tape's beginning says so.
#[test]
fn a_tape_is_recognised_wherever_reading_begins() {
    let how = Punch { system: System::Eia, leader: 5, even: false, semicolon_ends: true };
    let image = punch(b"%\nO1\nG00X1.\nM30\nO2\nG00X2.\nM30\n%\n", how, &Codes::default()).expect("EIA has them all");
    let codes = Some(Codes::default());
    let programs = programs_in(&mut Texts::one(image.as_slice()), SourceId(0), &control().grammar, codes);
    let (number, head) = programs.expect("texts in memory can be read")[1];
    assert_eq!((number, head.line), (2, 5));
    let configuration = configuration(machine("unlimited", None), &Setup::default());
    let mut session = Session::new(configuration, Texts::one(image.as_slice()));
    session.select(SourceId(0), "O2", head);
    let events = run(&mut session, Expect { most_events: 100, stays_inside: true });
    let moves: Vec<_> = events.iter().filter(|event| matches!(event.kind, EventKind::Rapid { .. })).collect();
    assert_eq!((moves.len(), moves[0].place.line), (1, 6));
}
