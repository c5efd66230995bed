//! Whatever an operator, a machine that fails and a script that plays it do: lines turn on and off by turns, time never
//! goes back, and a RESET leaves a control that runs its program.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use std::collections::BTreeMap;

use machine::{Event, EventKind, ReferenceReturn};
use station::{Action, Configuration, Operator, Said, Session, Setup, read_action};
use watch::{Texts, configuration, machine};

const PROGRAM: &str = "M91P9\nG00X10.M08\nS3000T2M03\nG01X60.F3000M10\nB5M05\nG31X80.F600\nN9G91G81X1.Z-2.R-1.F300L2M11\nM00\nG80G90G00X0Z0M06\nM30\n";

/// What can happen at any moment.
const ACTIONS: &[&str] = &[
    "cycle-start",
    "cycle-start",
    "cycle-start",
    "run for 0.013",
    "run for 0.4",
    "run for 3",
    "run until stop",
    "run until idle",
    "feed-hold",
    "reset",
    "emergency-stop",
    "release",
    "input FIN on",
    "input FIN off",
    "input skip on",
    "input skip off",
    "input interrupt on",
    "input interrupt off",
    "input EOP off",
    "input RWD on",
    "override feed 0",
    "override feed 200",
    "switch single-block on",
    "switch single-block off",
    "fault fin never",
    "fault fin early",
    "fault fin stuck",
    "fault spindle-speed",
    "fault limit X + at 30",
    "fault limit Z - at -1.5",
    "fault servo Z",
    "fault power",
    "power-on",
    "power-off",
];

/// What else there is to do at a machine whose builder's logic does what codes ask for.
const MORE: &[&str] = &[
    "mode memory",
    "mode memory",
    "mode jog",
    "mode return",
    "mode rapid",
    "jog X - for 0.3",
    "jog X +",
    "jog Z -",
    "home X",
    "home Z",
    "fault input unclamped stuck",
    "fault input clamped stuck",
    "fault input pocket stuck",
    "fault input index stuck",
    "fault input lifted stuck",
    "fault input at-b stuck",
    "override rapid 25",
    "override rapid 100",
    "run for 0.25",
    "run for 11",
];

/// The machines that come with such a logic, and a program that uses it.
const BUILT: [(&str, &str); 3] = [
    ("tool-changer", "T03\nM19\nM06\nG01X60.F3000\nT19\nG91G28X0Z0\nG90G00X3.T05\nM19\nM06\nM00\nM30\n"),
    ("index-table", "B90\nG91G28X0\nG90G01X60.F3000B300\nM00\nB0\nM30\n"),
    ("pallet-changer", "M60\nG91G28X0\nG90G01X60.F3000\nM00\nM60\nM30\n"),
];

/// Numbers in no order, the same every time.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % most
    }
}

struct Station {
    operator: Operator<Texts>,
    events: Vec<Event>,
}

impl Station {
    fn new(slow: bool) -> Station {
        let mut machine = machine("stock-vmc", None);
        if slow {
            let times = &mut machine.handshake;
            (times.set_up.0, times.strobe_off.0, times.fin_off.0) = (0.01, 0.02, 0.03);
            machine.spindle.waits = true;
            machine.magazine.pocket_time = 0.1;
        }
        Station::at(configuration(machine, &Setup::default()), PROGRAM)
    }

    /// At a machine with a logic of its builder's, dogs and overtravel switches.
    fn built((name, program): (&str, &'static str), tells: bool) -> Station {
        let mut machine = machine(name, None);
        for (axis, dog_end) in machine.axes.iter_mut().zip([5.0, 3.0, 4.0]) {
            let (positive, dog, grid) = (true, [dog_end, 30.0], 10.0);
            axis.reference_return = Some(ReferenceReturn { positive, dog, grid, feeds: [6000.0, 300.0] });
            axis.limit_switches = Some([-900.0, 900.0]);
        }
        let mut configuration = configuration(machine, &Setup::default());
        configuration.not_returned.add(0);
        configuration.start[0] = -60.0;
        let ready = configuration.machine.logic.input("ready");
        configuration.lines.extend(ready.map(|line| (line, true)));
        let mut station = Station::at(configuration, program);
        station.operator.session.tell_signals(tells);
        station
    }

    fn at(configuration: Configuration, program: &'static str) -> Station {
        let mut session = Session::new(configuration, Texts::one(program));
        session.tell_signals(true);
        let mut station = Station { operator: Operator::new(session), events: Vec::new() };
        station.perform(&Action::Load("0".to_owned(), Some("P".to_owned())));
        station.script(&["select P"]);
        station
    }

    fn perform(&mut self, action: &Action) {
        let events = &mut self.events;
        let mut tell = |_: &mut Session<Texts>, said: Said| {
            if let Said::Event(event) = said {
                events.push(event);
            }
        };
        self.operator.perform(action, &mut tell).expect("texts in memory can be read");
    }

    fn script(&mut self, lines: &[&str]) {
        lines.iter().for_each(|line| self.perform(&read_action(line).expect(line)));
    }
}

/// Lines turn on and off by turns, time never goes back.
fn check(done: &[&str], events: &[Event]) {
    let mut lines: BTreeMap<String, bool> = BTreeMap::new();
    let mut time = 0.0;
    for event in events {
        assert!(event.time.0 >= time - 1e-9, "{done:?}\n{event:?} comes after {time}");
        time = event.time.0;
        if let EventKind::Signal(signal, on) = event.kind {
            let name = signal.name(|code| format!("M{code}R"), |axis| axis.to_string(), |line| format!("line {line}"));
            assert_ne!(lines.insert(name.clone(), on), Some(on), "{done:?}\n{name} is {on} already at {time}");
        }
    }
}

#[test]
fn lines_turn_on_and_off_by_turns_and_reset_mends_everything() {
    let mut numbers = Numbers(7);
    for round in 0..20_000 {
        let mut station = Station::new(round % 2 == 0);
        let done: Vec<&str> = (0..numbers.below(40)).map(|_| ACTIONS[numbers.below(ACTIONS.len())]).collect();
        station.script(&done);
        check(&done, &station.events);
        // FIN is still the script's, if it ever was; everything else is whole again.
        let by_script = done.iter().any(|line| line.starts_with("input FIN"));
        station.script(&["power-on", "release", "input interrupt off", "input skip off", "switch single-block off"]);
        station.script(&["override feed 100", "reset", "select P"]);
        let session = &station.operator.session;
        assert!(session.alarm().is_none() && session.waiting().is_none(), "{done:?}");
        if by_script || done.iter().any(|line| line.contains("power") || line.contains("emergency")) {
            continue;
        }
        let before = station.events.len();
        station.script(&["cycle-start", "run until stop", "cycle-start", "run until end"]);
        check(&done, &station.events);
        let ended = station.events[before..].iter().any(|event| matches!(event.kind, EventKind::End { .. }));
        assert!(ended, "{done:?}\n{:?}", station.events.last());
    }
}

#[test]
fn a_machine_of_its_builders_logic_is_whole_again_after_reset() {
    let mut numbers = Numbers(11);
    for round in 0..6_000 {
        let built = BUILT[round % BUILT.len()];
        let mut station = Station::built(built, round % 2 == 0);
        let all = ACTIONS.len() + 2 * MORE.len();
        let mut done: Vec<&str> = Vec::new();
        for _ in 0..numbers.below(30) {
            let which = numbers.below(all);
            done.push(ACTIONS.get(which).copied().unwrap_or_else(|| MORE[(which - ACTIONS.len()) % MORE.len()]));
        }
        done.retain(|line| !line.starts_with("input"));
        station.script(&done);
        check(&done, &station.events);
        station.script(&["power-on", "release", "switch single-block off", "override feed 100", "override rapid 100"]);
        // What turns and slides comes to stand; axes go where the program can begin.
        station.script(&["reset", "run for 5", "mode memory", "select P"]);
        let session = &station.operator.session;
        assert!(session.alarm().is_none() && session.waiting().is_none(), "{built:?} {done:?}");
        let before = station.events.len();
        let lost = done.iter().any(|line| line.contains("power") || line.contains("emergency"));
        // A RESET in the middle leaves axes that have not been returned; the first blocks of each program ask for X and Z.
        station.script(&[
            "mode return",
            "home X",
            "run until idle",
            "home Y",
            "run until idle",
            "home Z",
            "run until idle",
        ]);
        station.script(&["mode memory", "cycle-start", "run until stop", "cycle-start", "run until end"]);
        check(&done, &station.events);
        let ended = station.events[before..].iter().any(|event| matches!(event.kind, EventKind::End { .. }));
        let alarm = station.operator.session.alarm();
        assert!(ended, "{built:?} {done:?} {lost}\n{:?} {alarm:?}", station.events.last());
    }
}
