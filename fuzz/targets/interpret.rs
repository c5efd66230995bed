//! Any program through the whole interpreter: never a panic, never a step that does not end, never an impossible event.
//!
//! The first byte of an input chooses the control, the last one machine, mode and pieces; a program is an input as it is.

#![no_main]

use std::sync::LazyLock;

use dialect::Control;
use fuzz::watch::{Expect, run, select};
use fuzz::{Fleet, texts};
use libfuzzer_sys::fuzz_target;
use machine::EventKind;
use report::{Excerpt, Format, render};
use station::{AfterAlarm, OffsetColumn, Session, Setup};

/// Events after which a run is given up; most inputs end long before.
const MOST_EVENTS: usize = 400;
/// Jumps without motion after which a program is endless.
const MOST_JUMPS: u64 = 50;
/// Travel of every axis to both sides, mm and degrees.
const WIDE: f64 = 9e6;
const TIGHT: f64 = 40.0;

static FLEETS: LazyLock<[Fleet; 4]> = LazyLock::new(|| {
    [(WIDE, false), (TIGHT, false), (WIDE, true), (TIGHT, true)].map(|(travel, other)| Fleet::new(travel, setup, other))
});

fn setup(control: &Control) -> Setup {
    let column = if control.common_offsets { OffsetColumn::Common } else { OffsetColumn::Length };
    let offsets = [(1, 12.5), (2, -3.25), (11, 0.0), (31, 8.0), (99, 999.999)];
    Setup {
        offsets: offsets.iter().map(|&(number, mm)| (column, number, mm)).collect(),
        work: vec![("G54".into(), b'X', 10.0), ("G55".into(), b'Z', -20.0)],
        ..Setup::default()
    }
}

fuzz_target!(|input: &[u8]| {
    let Some((&mode, text)) = input.split_last() else { return };
    let bit = |bit: u8| mode & (1 << bit) != 0;
    let (mut configuration, text) = FLEETS[usize::from(mode & 1 | mode >> 6 & 2)].choose(text);
    configuration.switches.block_delete = if bit(4) { 0b11 } else { 0 };
    configuration.switches.optional_stop = bit(5);
    configuration.switches.single_block = bit(6);
    let texts = texts(text);
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
