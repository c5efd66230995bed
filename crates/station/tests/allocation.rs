//! A running program allocates nothing that depends on its length: memory does not grow, and time is not spent on it.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use std::fmt::Write;

use machine::EventKind;
use station::{AfterAlarm, Configuration, Session, Setup, Step};
use testkit::{Counting, allocations_so_far};
use watch::{Texts, configuration, load, machine, select};

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const SMALL: usize = 1_000;
const LARGE: usize = 100_000;

/// Runs until every buffer has been taken: the control keeps a few windows onto its texts.
const WARM: usize = 3;

/// A program of so many lines made by `line`, with a subprogram O2 behind it.
fn program(lines: usize, line: impl Fn(usize) -> String) -> Vec<u8> {
    let mut text = "%\nO1\nG90G17G21G54F500\nG00X0Y0Z50.\n".to_owned();
    for index in 0..lines {
        let _ = writeln!(text, "{}", line(index));
    }
    text += "G80G90G00X0Y0\nM30\nO2\nG91G01X1.F600\nX-1.\nM99\n%\n";
    text.into_bytes()
}

/// Allocations of a whole run of the text with this id, and how many blocks it had.
fn allocations(session: &mut Session<Texts>, source: u32) -> (u64, u64) {
    let before = allocations_so_far();
    select(session, source);
    session.start();
    let mut blocks = 0;
    loop {
        match session.next() {
            Step::Event(event) => match event.kind {
                EventKind::BlockDone => blocks += 1,
                EventKind::Alarm(alarm) => panic!("{:?} in line {}", alarm.condition, alarm.place.line),
                _ => {}
            },
            Step::Stopped => session.start(),
            Step::Idle => break,
            Step::Failed(error) => panic!("{error}"),
        }
    }
    (allocations_so_far() - before, blocks)
}

/// The same kind of program, short and long, after both have been run once.
fn check(what: &str, line: impl Fn(usize) -> String) {
    check_texts(what, vec![program(SMALL, &line), program(LARGE, &line)]);
}

fn check_texts(what: &str, texts: Vec<Vec<u8>>) {
    let texts = Texts { texts, ..Texts::default() };
    check_on(what, &configuration(machine("unlimited", None), &Setup::default()), &texts);
}

/// The same on a control whose programs are files and whose blocks have classes of codes; `SUB.CNC` can be called.
fn check_files(what: &str, line: impl Fn(usize) -> String) {
    let machine = machine("unlimited", None);
    let configuration = Configuration::new(load("incon-m84"), machine, &[&Setup::default()]).expect("they fit");
    let texts = [SMALL, LARGE].map(|lines| {
        let lines = (0..lines).map(|index| line(index) + "\n").collect::<String>();
        format!("G90G17G21\nG54F500\nG00X0Y0Z50.\n{lines}G15G50G69\nG80G90\nM30\nN9000G91G01X1.\nX-1.\nM99\n")
            .into_bytes()
    });
    let [short, long] = texts;
    let sub = b"G91G01X1.F600\nX-1.\nM99\n".to_vec();
    let texts =
        Texts { texts: vec![short, long, sub], files: vec![("SUB.CNC", base::SourceId(2))], ..Texts::default() };
    check_on(what, &configuration, &texts);
}

fn check_on(what: &str, configuration: &Configuration, texts: &Texts) {
    for after in [AfterAlarm::Stand, AfterAlarm::GoOn] {
        let mut session = Session::new(configuration.clone(), texts.clone());
        session.set_after_alarm(after);
        for _ in 0..WARM {
            allocations(&mut session, 1);
            allocations(&mut session, 0);
        }
        let (short, few) = allocations(&mut session, 0);
        let (long, many) = allocations(&mut session, 1);
        assert!(few >= SMALL as u64 && many >= LARGE as u64, "{what}: {few} and {many} blocks ran");
        assert_eq!(short, long, "{what}: allocations of {few} and of {many} blocks");
    }
}

#[test]
fn the_counter_counts() {
    let before = allocations_so_far();
    drop(std::hint::black_box(Box::new(1u8)));
    assert_eq!(allocations_so_far() - before, 1);
}

#[test]
fn lines_allocate_nothing() {
    check("lines", |n| format!("N{}G01X{}.5Y-.{}Z0(CUT)", n % 9999 + 1, n % 90, n % 77));
}

#[test]
fn tapes_allocate_nothing() {
    let how = tape::Punch { system: tape::System::Eia, leader: 100, even: true, semicolon_ends: true };
    let tape = |lines| {
        let text = program(lines, |n| format!("N{}G01X{}.5Y-.{}Z0(CUT)", n % 9999 + 1, n % 90, n % 77));
        tape::punch(&text, how, &tape::Codes::default()).expect("EIA has its characters")
    };
    check_texts("tapes", vec![tape(SMALL), tape(LARGE)]);
}

#[test]
fn arcs_allocate_nothing() {
    check("arcs", |n| match n % 3 {
        0 => "G91G02X10.Y10.I10.F800.".to_owned(),
        1 => "G03X-10.Y-10.R10.".to_owned(),
        _ => "G90G02X3.Y4.I1.J-7.".to_owned(),
    });
}

#[test]
fn cycles_and_patterns_allocate_nothing() {
    check("cycles", |n| match n % 5 {
        0 => format!("G98G81X{}.Z-3.R2.F200", n % 50),
        1 => "G83Y5.Z-3.R2.Q.5L2".to_owned(),
        2 => "G70X1.Y2.I20.J15.L6".to_owned(),
        3 => "G84X2.Z-2.R1.P100F300".to_owned(),
        _ => "G80".to_owned(),
    });
}

#[test]
fn boring_and_round_holes_allocate_nothing() {
    check("boring", |n| match n % 7 {
        0 => format!("G99G76X{}.Z-3.R2.Q.5P10F200", n % 50),
        1 => "G77Y5.Z3.R-2.I.5L2".to_owned(),
        2 => "G88Y2.Z-3.R2.".to_owned(),
        3 => "G73Z-3.Q.5".to_owned(),
        4 => "G10P31R2.5".to_owned(),
        5 => "G13I10.D31".to_owned(),
        _ => "G80".to_owned(),
    });
}

#[test]
fn calls_allocate_nothing() {
    check("calls", |_| "M98P2L2".to_owned());
}

#[test]
fn offsets_and_codes_allocate_nothing() {
    check("offsets", |n| match n % 6 {
        0 => "G90G00G43Z10.H1".to_owned(),
        1 => "G91G01G45X5.D2".to_owned(),
        2 => "G49".to_owned(),
        3 => format!("S{}M03T{}", n % 3000, n % 99),
        4 => "G92X0Y0".to_owned(),
        _ => "/2G04P10M08".to_owned(),
    });
}

#[test]
fn macros_allocate_nothing() {
    check("macros", |n| match n % 6 {
        0 => "#1=0\nWHILE[#1LT2]DO1\nG91G01X1.F500\n#1=#1+1\nEND1\nG90X0".to_owned(),
        1 => format!("#10{}=SIN[{n}]*COS[#1]\nG00X#101", n % 10),
        2 => format!("IF[#1GT{n}]GOTO{n}\nG01Y[#1*2]F500.\nN{n}Y0"),
        3 => "G65P2A1.I2.\nG00X#100".to_owned(),
        4 => "#[101]=#5001\nM08".to_owned(),
        _ => "#2001=#4003\nG04P10".to_owned(),
    });
}

#[test]
fn transforms_and_polar_places_allocate_nothing() {
    check_files("transforms", |n| match n % 10 {
        0 => format!("G90G68X{}.Y0R30.", n % 50),
        1 => "G51X0Y0Z0P2000".to_owned(),
        2 => format!("G90G16G01X{}.Y45.", n % 40 + 1),
        3 => "G91G01X1.Y10.".to_owned(),
        4 => "G15".to_owned(),
        5 => "G51X1.Y1.I-1000J2000".to_owned(),
        6 => "G90G00X3.".to_owned(),
        7 => "G50\nG90G00X3.Y3.".to_owned(),
        8 => "G91G02X5.Y5.R20.F300".to_owned(),
        _ => "G69".to_owned(),
    });
}

#[test]
fn cycles_at_polar_places_allocate_nothing() {
    check_files("cycles", |n| match n % 6 {
        0 => format!("G90G16G81X{}.Y30.Z-3.R2.F200", n % 50 + 1),
        1 => "G91G83Y30.Z-3.R-1.Q.5K3".to_owned(),
        2 => "G90G15".to_owned(),
        3 => "G76X1.Y1.Z-3.R2.Q.5P10".to_owned(),
        4 => "G84Z-2.R1.P100F300".to_owned(),
        _ => "G80".to_owned(),
    });
}

#[test]
fn calls_by_name_allocate_nothing() {
    check_files("calls by name", |n| match n % 3 {
        0 => "M98 SUB L2".to_owned(),
        // Every block looks for its own N9000, through the whole text.
        1 if n < 30 => "M97P9000".to_owned(),
        _ => "G09G01X1.".to_owned(),
    });
}

#[test]
fn offsets_codes_and_macros_of_files_allocate_nothing() {
    check_files("offsets", |n| match n % 8 {
        0 => "G10L10P1R2.5".to_owned(),
        1 => "G90G43G00Z10.H1".to_owned(),
        2 => "G49\nG52X1.Y1.".to_owned(),
        3 => format!("G96S{}M03", n % 300 + 1),
        4 => format!("#1={n}\nG01X[#1/1000]"),
        5 => "WHILE[#1GT0]DO1\n#1=#1-#1\nG01Y#1\nEND1".to_owned(),
        6 => "IF[#1EQ0]THEN#2=1".to_owned(),
        _ => "G92X0Y0".to_owned(),
    });
}
