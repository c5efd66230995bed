//! Whatever an operator, a machine that fails and a script that plays it do: lines turn on and off by turns, time never
//! goes back, and a RESET leaves a control that runs its program.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use std::collections::BTreeMap;

use machine::{Event, EventKind};
use station::{Action, Operator, Said, Session, Setup, read_action};
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
        let mut session = Session::new(configuration(machine, &Setup::default()), Texts::one(PROGRAM));
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
