//! A control that exists nowhere else runs a program by its tables alone: no code knows of it.
//!
//! It has its own numbers for known meanings, hundredths of a millimetre, files for programs, one movement and one state a
//! block, a drilling cycle of other steps.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use std::sync::Arc;

use base::Condition;
use dialect::{Control, ControlFiles, load_control};
use machine::{EventKind, read_machine};
use station::{AfterAlarm, Configuration, Operator, Session, Setup, Show};
use watch::{Expect, Texts, run, select};

/// What every row says of its origin, so that the tables below are short.
const ORIGIN: &str = "certainty = \"D\"\nsource = \"a toy\"\n";

const CONTROL: &str = r#"
format = 1
name = "toy"
title = "Toy 1"
maker = "nobody"
summary = "a control for a test"
stock_machine = "none"
grammar = { semicolon = "comment", lower_case = "fold", colon = "refuse", percent = "ignore", block_delete = "head", block_length = 80, repeated_word = "refuse", programs = "files" }
increments = { metric_mm = 0.01, inch_in = 0.001, rotary_deg = 0.01 }
read_ahead = { blocks = 1, compensation = 1, buffering = 1 }
nesting = { subprograms = 1, macros = 1 }
offsets = { table = "common", highest = 9, limit_mm = 99.0 }
cycle = { spindle_forward = 43, spindle_reverse = 44, spindle_stop = 45, spindle_orient = 46, repeats = ["L"], steps = { drill = ["feed bottom", "rapid end"], spot = ["chip pecks", "rapid end"] } }
combination = { most_codes = 2, most_states = 1, most_states_with_movement = 1 }
"#;

/// Groups: number, name, code at power-on.
const GROUPS: &[(u8, &str, &str)] = &[
    (1, "motion", "G70"),
    (2, "plane", "G31"),
    (3, "distance", "G5"),
    (4, "feed-mode", "G41"),
    (5, "units", "G11"),
    (6, "radius-compensation", "G50"),
    (7, "length-compensation", "G52"),
    (8, "canned-cycle", "G54"),
    (9, "return-level", "G56"),
    (10, "work-coordinates", "G60"),
    (11, "stop-mode", "G62"),
    (12, "modal-macro", "G64"),
];

/// Codes: number, group (0 for a one-shot code), class, meaning.
const CODES: &[(u8, u8, &str, &str)] = &[
    (70, 1, "movement", "rapid"),
    (71, 1, "movement", "linear"),
    (72, 1, "movement", "arc-clockwise"),
    (31, 2, "state", "plane-xy"),
    (5, 3, "state", "absolute"),
    (6, 3, "state", "incremental"),
    (41, 4, "state", "feed-per-minute"),
    (11, 5, "state", "metric"),
    (12, 5, "state", "inch"),
    (50, 6, "state", "compensation-off"),
    (52, 7, "state", "length-off"),
    (54, 8, "state", "cycle-off"),
    (81, 8, "movement", "drill"),
    (82, 8, "movement", "spot"),
    (56, 9, "state", "return-initial"),
    (60, 10, "state", "work-system"),
    (62, 11, "state", "cutting-mode"),
    (64, 12, "state", "modal-macro-off"),
    (1, 0, "solo", "dwell"),
];

const ADDRESSES: &[(&str, &str)] = &[
    ("X", "kind = \"axis\"\nmetric = [-500.0, 500.0]"),
    ("Y", "kind = \"axis\"\nmetric = [-500.0, 500.0]"),
    ("Z", "kind = \"axis\"\nmetric = [-50.0, 50.0]"),
    ("I", "kind = \"length\""),
    ("J", "kind = \"length\""),
    ("R", "kind = \"length\""),
    ("Q", "kind = \"length\""),
    ("F", "kind = \"feed\""),
    ("P", "kind = \"time-or-number\"\nseconds = [0.0, 9.0]"),
    ("G", "kind = \"code\"\ndigits = 2\nrange = [0, 99]"),
    ("M", "kind = \"code\"\ndigits = 2\nrange = [0, 99]"),
    ("N", "kind = \"number\"\nrange = [1, 99]"),
];

const PARAMETERS: &[&str] =
    &["cycle clearance", "arc radius tolerance", "arc end limit", "jog speed", "dry run of rapid"];

const STATION: &str = r#"
overrides = { feed = [0, 100], rapid = [0, 100], spindle = [100] }
speeds = { jog = "jog speed", dry_run_rapid = "dry run of rapid" }
memory = {}
[[mode]]
name = "run"
kind = "memory"
text = "runs a program"
"#;

/// The one page that it has.
const DISPLAY: &str = "[[display]]\nkey = \"P\"\nname = \"place\"\nshows = \"position.machine\"\ntext = \"-\"\n";

const M_CODES: &str = r#"
range = { machine = [0, 98], control = [99, 99], extended = [1, 0] }
[[code]]
m = 77
meaning = "tape-end"
to_machine = true
stops_read_ahead = true
text = "end"
"#;

const MACHINE: &str = r#"
name = "table"
[axes.X]
kind = "linear"
travel = [-100.0, 100.0]
[axes.Y]
kind = "linear"
travel = [-100.0, 100.0]
[axes.Z]
kind = "linear"
travel = [-100.0, 100.0]
"#;

fn toy() -> Control {
    let origin = |rows: Vec<String>| rows.into_iter().map(|row| row + "\n" + ORIGIN).collect::<String>();
    let groups = GROUPS.iter().map(|(number, name, code)| {
        format!("[[group]]\nnumber = {number}\nname = \"{name}\"\npower_on = \"{code}\"\nreset = \"{code}\"")
    });
    let codes = CODES.iter().map(|&(number, group, class, meaning)| {
        let kind = if group == 0 { "one_shot = true".to_owned() } else { format!("group = {group}") };
        format!("[[code]]\ng = {number}\n{kind}\ndivision = \"basic\"\nclass = \"{class}\"\nmeaning = \"{meaning}\"\ntext = \"-\"")
    });
    let addresses = ADDRESSES.iter().map(|(letter, rest)| {
        let point = if "GMN".contains(letter) { "no" } else { "yes" };
        format!("[[address]]\nletter = \"{letter}\"\n{rest}\npoint = \"{point}\"\nalarm = \"NO\"\ntext = \"-\"")
    });
    let parameters = PARAMETERS
        .iter()
        .map(|name| format!("[[parameter]]\nname = \"{name}\"\nkind = \"length\"\ndefault = 1.0\ntext = \"-\""));
    let conditions: Vec<String> = Condition::ALL.iter().map(|condition| format!("\"{}\"", condition.id())).collect();
    let alarm = format!("[[alarm]]\nname = \"NO\"\ntext = \"no\"\nconditions = [{}]", conditions.join(", "));
    let shared = dialect::builtin_files("yasnac-mx1").expect("the sentences of all controls come with any");
    let tables = [
        ("control.toml", CONTROL.to_owned() + &origin(groups.collect())),
        ("g_codes.toml", origin(codes.collect())),
        ("m_codes.toml", M_CODES.to_owned() + ORIGIN),
        ("addresses.toml", origin(addresses.collect())),
        ("parameters.toml", origin(parameters.collect())),
        ("station.toml", [STATION, ORIGIN, DISPLAY, ORIGIN].concat()),
        ("alarms.toml", origin(vec![alarm])),
        ("macro.toml", "limits = { brackets = 1, loops = 1, triples = 1 }\n".to_owned()),
    ];
    let tables = tables.map(|(name, text)| (name.to_owned(), text)).to_vec();
    let files = ControlFiles { folder: "toy".to_owned(), tables, member: None, ..shared };
    match load_control(&files) {
        Ok(control) => control,
        Err(errors) => panic!("{}", errors.iter().map(|error| format!("{error}\n\n")).collect::<String>()),
    }
}

/// What a program does, an entry an event.
fn done(text: &str) -> Vec<String> {
    let machine = read_machine("table.toml", MACHINE).expect("it is valid");
    let configuration = Configuration::new(Arc::new(toy()), machine, &[&Setup::default()]).expect("they fit");
    let mut session = Session::new(configuration, Texts::one(text));
    session.set_after_alarm(AfterAlarm::GoOn);
    select(&mut session, 0);
    let events = run(&mut session, Expect { most_events: 100, stays_inside: false });
    let said = events.iter().filter_map(|event| match &event.kind {
        EventKind::Rapid { to, .. } => Some(format!("rapid {} {} {}", to[0], to[1], to[2])),
        EventKind::Feed { to, feed, .. } => Some(format!("feed {} {} {} f{feed}", to[0], to[1], to[2])),
        EventKind::Arc { arc, .. } => Some(format!("arc {}", arc.sweep.to_degrees().round())),
        EventKind::Dwell(dwell) => Some(format!("{dwell:?}")),
        EventKind::Code(code) => Some(format!("m{}", code.code)),
        EventKind::Alarm(alarm) => Some(format!("{} {}", event.place.line, alarm.condition.id())),
        _ => None,
    });
    said.collect()
}

#[test]
fn a_control_of_tables_alone_runs_a_program() {
    let text = ";A TOY\n%\ng6 g70 x1000 y-5.005\ng71 x1. f200\nG5 G72 X0 Y-5.01 I-5.5\nG1 P1500\nG81 X2. Y0 Z-3. R1. F50\nM77\n";
    assert_eq!(
        done(text),
        [
            "rapid 10 -5.01 0",
            "feed 11 -5.01 0 f200",
            "arc -180",
            "Seconds(1.5)",
            "rapid 2 0 0",
            "rapid 2 0 1",
            "feed 2 0 -3 f50",
            "rapid 2 0 0",
            "m77"
        ]
    );
}

#[test]
fn its_rules_are_its_own() {
    let text = "G70 G5 X1.\nG31 G5\nG5 G1 P1\nG01 X1.\nA1.\nG90\nG5 G31 G70 X1.\nX501.\n";
    assert_eq!(
        done(text),
        [
            "1 g-order",
            "2 g-too-many",
            "3 g-not-alone",
            // G1 is its dwell, and X has no place there but as a time.
            "Seconds(1.0)",
            "5 address-unavailable",
            "6 g-unknown",
            "7 g-too-many",
            "8 value-out-of-range",
        ]
    );
}

#[test]
fn what_a_cycle_needs_follows_from_its_steps() {
    let text = "G82 X2. Z-3. R1. F50\nG82 X2. Z-3. R1. Q3. F50\nM77\n";
    assert_eq!(
        done(text),
        [
            "1 cycle-peck-missing",
            "rapid 2 0 0",
            "rapid 2 0 1",
            "feed 2 0 -2 f50",
            // Back by the clearance.
            "rapid 2 0 -1",
            "feed 2 0 -3 f50",
            "rapid 2 0 0",
            "m77"
        ]
    );
}

#[test]
fn a_page_that_it_does_not_have_is_refused() {
    let machine = read_machine("table.toml", MACHINE).expect("it is valid");
    let configuration = Configuration::new(Arc::new(toy()), machine, &[&Setup::default()]).expect("they fit");
    let mut operator = Operator::new(Session::new(configuration, Texts::one("")));
    for show in [Show::Position, Show::State, Show::Machine, Show::Feed, Show::Displays] {
        assert!(operator.display(&show).is_ok(), "{show}");
    }
    for show in [Show::Command, Show::Diagnosis, Show::Alarms, Show::Offsets, Show::Work("G60".to_owned()), Show::Modal]
    {
        let page = show.display().expect("it is a page");
        let why = format!("the Toy 1 has no page that shows {page}; `show displays` lists its pages");
        assert_eq!(operator.display(&show), Err(why));
    }
}
