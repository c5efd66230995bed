//! Any program through the whole interpreter: never a panic, never a step that does not end, never an impossible event.
//!
//! The last byte of an input chooses machine, mode and pieces, so that a program is an input as it is.

#![no_main]

use std::sync::LazyLock;

use fuzz::watch::{Expect, Texts, configuration, machine, run, select};
use libfuzzer_sys::fuzz_target;
use machine::EventKind;
use report::{Excerpt, Format, render};
use station::{AfterAlarm, Configuration, OffsetColumn, Session, Setup};

/// Events after which a run is given up; most inputs end long before.
const MOST_EVENTS: usize = 400;
/// Jumps without motion after which a program is endless.
const MOST_JUMPS: u64 = 50;

static WIDE: LazyLock<Configuration> = LazyLock::new(|| configuration(machine("unlimited", None), &setup()));
static TIGHT: LazyLock<Configuration> = LazyLock::new(|| configuration(machine("stock-vmc", Some(40.0)), &setup()));

fn setup() -> Setup {
    let offsets = [(1, 12.5), (2, -3.25), (11, 0.0), (31, 8.0), (99, 999.999)];
    Setup {
        offsets: offsets.iter().map(|&(number, mm)| (OffsetColumn::Common, number, mm)).collect(),
        work: vec![("G54".into(), b'X', 10.0), ("G55".into(), b'Z', -20.0)],
        ..Setup::default()
    }
}

fuzz_target!(|input: &[u8]| {
    let Some((&mode, text)) = input.split_last() else { return };
    let bit = |bit: u8| mode & (1 << bit) != 0;
    let mut configuration = if bit(0) { TIGHT.clone() } else { WIDE.clone() };
    configuration.switches.block_delete = if bit(4) { 0b11 } else { 0 };
    configuration.switches.optional_stop = bit(5);
    configuration.switches.single_block = bit(6);
    let texts = Texts::one(text);
    let texts = if bit(2) { texts.in_pieces(&[7, 1, 30]) } else { texts };
    let mut session = Session::new(configuration, texts);
    session.set_after_alarm(if bit(1) { AfterAlarm::GoOn } else { AfterAlarm::Stand });
    session.interpreter_mut().set_loop_limit(MOST_JUMPS);
    select(&mut session, 0);
    let events = run(&mut session, Expect { most_events: MOST_EVENTS, stays_inside: !bit(1) });
    if bit(3) {
        // The faces of an alarm, as `check` shows it.
        let alarm = events.iter().find_map(|event| match &event.kind {
            EventKind::Alarm(alarm) => Some(alarm),
            _ => None,
        });
        if let Some(alarm) = alarm {
            let (place, control) = (&alarm.place, session.configuration().control.clone());
            let column = place.column(alarm.span);
            let line = &text[(place.line_start as usize).min(text.len())..];
            let excerpt = Excerpt::new("fuzz.nc", place.line, line, column, alarm.span.len);
            let diagnostic = control.diagnose(alarm, &excerpt.word, alarm.axis.map(|_| ('X', false)));
            for format in [Format::Text { colour: false }, Format::Json, Format::Sarif, Format::Github] {
                assert!(!render(&diagnostic, &excerpt, format).is_empty());
            }
        }
    }
});
