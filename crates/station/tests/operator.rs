//! An operator who does anything at any time: never a panic, always a way on, and what is refused changes nothing.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use dialect::{Control, ParameterSetting};
use machine::{Event, EventKind};
use proptest::prelude::*;
use proptest::sample::select;
use station::{
    Action, Configuration, OffsetColumn, Operator, OverrideSwitch, Said, Session, Setup, Until, Value, Which,
    read_action,
};
use watch::{Texts, Watch, configuration, machine};

/// Programs with all that can hold one up, and (first) one that works whatever came before it.
const PROGRAMS: [&str; 11] = [
    "O1\nG21G90G53G00X1.Y2.Z3.\nM30\n",
    "O2\nG90G00X5.\nM00\nG01Y5.F500\nG91G81X1.Y1.Z-1.R-1.L3\nM02\n",
    "O3\nG90G00X5.\nX2000.\nG91\nG92X0Y0Z0\nG20\nM30\n",
    "O4\nM98P5L2\nM01\n/G00X1.\nG43Z5.H31\nT1M06\nS500M03\nM30\nO5\nG91G00X1.\nG04P500\nM99\n",
    "O6\nG91G00X1.",
    "O7\nG02X1.\nM30\n",
    "O8\nG41D31\nG01X5.F100\nG28X0\nM30\n",
    "",
    "O9\nM95\n#100=1\nM91P9\nM93\nG91G31X10.F1000\nWHILE[#100LT3]DO1\n#100=#100+1\nG00X#100\nEND1\nX1.\nX1.\nN9M30\n",
    "O10\nG51X0Y0P2000\nG01X1.F500\nG50\nG66P5\nG00Y1.\nG67\nG12I5.D31F300\n#3003=3\n#3004=7\nG76X2.Z-1.R0Q0.5F100\nG80M08\nG04P100\nM30\n",
    "M99P7\nN7M02\nN8G90G00X3.\nM99P8\n",
];

/// The same for a control whose programs are files.
const FILES: [&str; 11] = [
    "G21\nG90\nG53X1.Y2.Z3.\nM30\n",
    "G90G00X5.\nM00\nG01Y5.F500\nG91G81X1.Y1.Z-1.R-1.F100\nM02\n",
    "G90G00X5.\nX2000.\nG91\nG92X0Y0Z0\nG20\nM30\n",
    "M98 P4\nM01\n/G00X1.\nG43Z5.H1\nT1M06\nS500M03\nM30\n",
    "G91G00X1.\nG04P500\nM99\n",
    "G02X1.\nM30\n",
    "G41D1\nG01X5.F100\nG28X0\nM30\n",
    "",
    "#100=1\nG91G31X10.F1000\nWHILE[#100LT3]DO1\n#100=#100+1\nG00X#100\nEND1\nX1.\nX1.\nN9M30\n",
    "G51X0Y0P2000\nG01X1.F500\nG50\nG52X5.\nG68X0Y0R30.\nG00Y1.\nG69\nG76X2.Z-1.R0Q0.5F100\nG80\nM08\nG04P100\nM30\n",
    "N7M97P9\nN8G90G00X3.\nM99\nN9X1.\nM99\n",
];

/// Where the operator stands: a control, and a machine.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum At {
    Yasnac,
    /// The builder's logic changes tools and looks for dogs.
    ToolChanger,
    Incon,
}

fn place() -> impl Strategy<Value = At> {
    select(vec![At::Yasnac, At::Yasnac, At::ToolChanger, At::Incon])
}

/// Blocks to type.
const TYPED: &[&str] =
    &["G91G00X1.", "G01X2.F200;Y1.", "M03S100", "M00", "G200", "X#1", "M98P4", "G90G02X5.R3.F50", "M30", ";"];

/// More than proptest's own number of cases: each is cheap.
fn config() -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: default.cases.max(1000), ..default }
}

fn names(names: &'static [&'static str]) -> impl Strategy<Value = String> {
    select(names.to_vec()).prop_map(str::to_owned)
}

/// Actions that a panel has without a number of their own.
fn button() -> impl Strategy<Value = Action> {
    prop_oneof![
        1 => Just(Action::PowerOn),
        1 => Just(Action::PowerOff),
        10 => Just(Action::CycleStart),
        2 => Just(Action::FeedHold),
        4 => Just(Action::Reset),
        1 => Just(Action::EmergencyStop),
        2 => Just(Action::Release),
    ]
}

/// The buttons of the manual modes.
fn by_hand() -> impl Strategy<Value = Action> {
    let axis = select(b"XZQ".to_vec());
    let seconds = prop::option::of(select(vec![0.0, 0.01, 0.5, 100.0]));
    let way = select(vec![0.0, 0.001, -0.1, 1.0, -1.0, 0.0004, 1e9]);
    prop_oneof![
        (axis.clone(), any::<bool>(), seconds).prop_map(|(axis, up, seconds)| Action::Jog(axis, up, seconds)),
        (axis.clone(), way).prop_map(|(axis, way)| Action::Step(axis, way)),
        axis.prop_map(Action::Home),
    ]
}

fn write() -> impl Strategy<Value = Action> {
    let number = select(vec![-1.0, 0.0, 10.0, 1e4, 1e9]);
    let percent = select(vec![0, 10, 25, 50, 55, 100, 200]);
    let switch = select(vec![OverrideSwitch::Feed, OverrideSwitch::Rapid, OverrideSwitch::Spindle]);
    prop_oneof![
        (select(vec!["EOP", "RWD", "FIN", "skip", "interrupt", "UI3", "nothing"]), any::<bool>())
            .prop_map(|(name, on)| Action::Input(name.to_owned(), on)),
        (
            names(&[
                "single-block",
                "optional-stop",
                "block-delete",
                "dry-run",
                "machine-lock",
                "display-lock",
                "aux-lock",
                "z-cancel",
                "manual-absolute",
                "override-cancel",
                "start-lock",
                "mirror-image",
                "nothing"
            ]),
            any::<bool>()
        )
            .prop_map(|(name, on)| {
                let which = if name == "mirror-image" { Which::Axis(b'X') } else { Which::One };
                Action::Switch(name, which, on)
            }),
        (switch, percent).prop_map(|(switch, percent)| Action::Override(switch, percent)),
        (select(vec![0, 31, 100]), number.clone()).prop_map(|(cell, mm)| Action::Offset(
            OffsetColumn::Common,
            cell,
            mm
        )),
        (names(&["G52", "G54", "G60"]), select(b"XQ".to_vec()), number.clone())
            .prop_map(|(system, axis, mm)| Action::Work(system, axis, mm)),
        (names(&["6005", "6001", "jog speed", "none"]), names(&["0", "1", "00000100", "x"]))
            .prop_map(|(name, value)| Action::Parameter(ParameterSetting { name, bit: None, value })),
        (select(vec![1, 100, 500, 4001, 9999]), prop::option::of(number))
            .prop_map(|(variable, value)| Action::Variable(variable, value)),
    ]
}

/// Programs, and where they are taken up.
const TAKEN_UP: &[&[&str]] = &[
    &["select P1", "restart line 4"],
    &["select P1", "restart line 5"],
    &["select P3", "restart O5 line 9 pass 2"],
    &["select P3", "restart line 3"],
    &["select P4", "restart line 2"],
    &["select P9", "restart line 4"],
];

/// What breaks.
fn written() -> impl Strategy<Value = Action> {
    let lines = [
        "fault fin never",
        "fault fin early",
        "fault fin stuck",
        "fault spindle-speed",
        "fault limit X + at 3",
        "fault servo X",
        "fault power",
        "input FIN on",
        "input FIN off",
        "origin X",
        "origin Z = 12.5",
        "origin all",
        "origin Q",
    ];
    let read = lines.iter().filter_map(|line| read_action(line).ok()).collect::<Vec<_>>();
    assert!(read.len() == lines.len(), "{} of {} lines are actions", read.len(), lines.len());
    select(read)
}

/// What is done with programs beside running them.
const OF_PROGRAMS: &[&str] = &[
    "restart line 2",
    "restart line 3",
    "restart line 6 pass 2",
    "restart N9",
    "restart O5 line 8 pass 2",
    "restart confirm",
    "restart confirm",
    "search N7",
    "search N9",
    "search O2",
    "mode edit",
    "mode edit",
    "edit top",
    "edit find X",
    "edit find ;",
    "edit insert X1. ;",
    "edit insert G01 F100",
    "edit alter G00",
    "edit delete",
    "edit delete block",
    "edit new O77",
    "edit delete program O3",
    "tape 1",
    "verify",
    "switch edit-lock on",
    "touch 31",
    "touch 5 at 10",
];

/// What is looked at.
const SHOWS: &str =
    "modal position machine alarm alarms feed program directory command diagnosis works variables state";

fn action() -> impl Strategy<Value = Action> {
    let program = prop_oneof![9 => (0..PROGRAMS.len()).prop_map(|n| format!("P{n}")), 1 => Just("none".to_owned())];
    let until = prop_oneof![
        Just(Until::Stop),
        Just(Until::End),
        Just(Until::Alarm),
        Just(Until::Idle),
        (0u64..8).prop_map(Until::Line),
        select(vec![0.005, 0.3]).prop_map(Until::Seconds)
    ];
    let show =
        select(SHOWS.split(' ').collect::<Vec<_>>()).prop_map(|what| read_action(&format!("show {what}")).expect(what));
    prop_oneof![
        2 => program.prop_map(Action::Select),
        8 => button(),
        3 => write(),
        3 => names(&["memory", "mdi", "tape", "jog", "step", "handle", "rapid", "return", "none"]).prop_map(Action::Mode),
        4 => by_hand(),
        2 => names(TYPED).prop_map(Action::Mdi),
        8 => until.prop_map(Action::Run),
        1 => show,
        2 => written(),
        1 => (0..PROGRAMS.len()).prop_map(|n| Action::Load(n.to_string(), None)),
        6 => select(OF_PROGRAMS.to_vec()).prop_map(|line| read_action(line).expect(line)),
    ]
}

struct Station {
    operator: Operator<Texts>,
    watch: Watch,
    events: Vec<Event>,
    /// The last action was refused.
    refused: bool,
    /// What has been written at the panel and taken, by the line that shows it.
    written: BTreeMap<String, String>,
}

/// What an action writes that nothing else does: where it is shown, and what stands there then.
fn writes(action: &Action) -> Option<(String, String)> {
    match action {
        Action::Offset(OffsetColumn::Common, cell, mm) => {
            Some((format!("offset {cell}"), format!("{:?}", Value::Number(*mm))))
        }
        Action::Work(system, axis, mm) => {
            Some((format!("work {system}"), format!("(\"{}\", Number({mm:?}))", char::from(axis.to_ascii_lowercase()))))
        }
        Action::Variable(500, value) => {
            Some(("variable 500".to_owned(), format!("{:?}", value.map_or(Value::Null, Value::Number))))
        }
        _ => None,
    }
}

impl Station {
    fn new() -> Station {
        Station::of(At::Yasnac)
    }

    fn of(at: At) -> Station {
        static INCON: LazyLock<Arc<Control>> = LazyLock::new(|| watch::load("incon-m84"));
        let programs = if at == At::Incon { FILES } else { PROGRAMS };
        let texts = Texts { texts: programs.iter().map(|text| text.as_bytes().to_vec()).collect(), ..Texts::default() };
        let configuration = match at {
            At::Yasnac => configuration(machine("stock-vmc", None), &Setup::default()),
            At::ToolChanger => configuration(machine("tool-changer", None), &Setup::default()),
            At::Incon => {
                let machine = machine("stock-vmc-4", None);
                Configuration::new(INCON.clone(), machine, &[&Setup::default()]).expect("the set-up fits")
            }
        };
        let session = Session::new(configuration, texts);
        let watch = Watch::new(&session, true);
        let mut station = Station {
            operator: Operator::new(session),
            watch,
            events: Vec::new(),
            refused: false,
            written: BTreeMap::new(),
        };
        for text in 0..PROGRAMS.len() {
            station.perform(&Action::Load(text.to_string(), Some(format!("P{text}"))));
        }
        station
    }

    fn perform(&mut self, action: &Action) {
        let Station { operator, watch, events, refused, written } = self;
        let moving = operator.session.is_moving();
        *refused = false;
        let mut tell = |session: &mut Session<Texts>, said: Said| match said {
            Said::Event(event) => {
                watch.see(&event, session);
                events.push(event);
            }
            // An action that had to wait is refused in a later one.
            Said::Refused { action: of, .. } => *refused |= of == action.to_string(),
            Said::Shown { .. } => {}
        };
        let (from, dead) =
            (operator.session.position(), operator.session.emergency_stop() || !operator.session.is_powered());
        let before = operator.session.time();
        operator.perform(action, &mut tell).expect("texts in memory can be read");
        assert!(operator.session.time() >= before, "time runs on: {action}");
        let may_move = match action {
            // What is refused in it is an action that had to wait.
            Action::Run(_) => !dead,
            Action::Jog(..) | Action::Step(..) => !dead && !*refused,
            // The axes come to stand.
            Action::Fault(_) => true,
            Action::FeedHold | Action::Reset | Action::EmergencyStop | Action::PowerOff | Action::Input(..) => {
                !*refused
            }
            _ => false,
        };
        let to = operator.session.position();
        let moved = from.iter().zip(to).any(|(from, to)| (from - to).abs() > 1e-6);
        match writes(action) {
            // It may wait, and be refused then.
            Some((shown, _)) if moving => drop(written.remove(&shown)),
            Some((shown, value)) if !*refused => drop(written.insert(shown, value)),
            // What it writes is not known here.
            None if matches!(action, Action::Touch(..)) => drop(written.remove("offset 31")),
            _ => {}
        }
        assert!(may_move || !moved, "no motion without a cause: {action}, {from:?} to {to:?}");
    }

    fn script(&mut self, lines: &[&str]) {
        lines.iter().for_each(|line| self.perform(&read_action(line).expect(line)));
    }

    /// Every axis by hand to its reference point.
    fn return_axes(&mut self) {
        self.script(&["mode return"]);
        let letters: Vec<_> =
            self.operator.session.configuration().machine.axes.iter().map(|axis| axis.letter).collect();
        for letter in letters {
            self.perform(&Action::Home(letter));
            assert!(!self.refused, "home {}", char::from(letter));
            self.script(&["run until idle"]);
        }
    }

    fn shows(&mut self, what: &str) -> String {
        let Ok(Action::Show(show)) = read_action(&format!("show {what}")) else { panic!("{what}") };
        format!("{:?}", self.operator.display(&show))
    }
}

/// Everything that the panel can show.
const PAGES: &[&str] = &[
    "modal",
    "position",
    "machine",
    "alarm",
    "feed",
    "program",
    "state",
    "offset 31",
    "work G52",
    "work G54",
    "parameter 6005",
    "parameter 6001",
    "parameter jog speed",
];

/// Brings any station back to where nothing is in the way.
const TIDY: &[&str] = &[
    "power-on",
    "release",
    "input EOP on",
    "input RWD on",
    "fault fin never",
    "switch single-block off",
    "switch machine-lock off",
    "switch z-cancel off",
    "switch edit-lock off",
    "switch start-lock off",
    "switch mirror-image=X off",
    "override feed 100",
    "override rapid 100",
    "reset",
    "mode memory",
];

proptest! {
    #![proptest_config(config())]

    #[test]
    fn whatever_was_done_reset_and_another_program_go_on(at in place(), actions in prop::collection::vec(action(), 0..25)) {
        let mut station = Station::of(at);
        actions.iter().for_each(|action| station.perform(action));
        station.script(TIDY);
        let counts = station.operator.session.counted_position().map(|mm| (mm * 1e6).round());
        prop_assert_eq!(station.operator.session.interpreter().read_state().machine, counts, "the control knows where the axes are");
        prop_assert!(station.operator.session.alarm().is_none());
        prop_assert!(!station.operator.session.is_running());
        for (shown, value) in station.written.clone() {
            let shows = station.shows(&shown);
            prop_assert!(shows.contains(&value), "{} was written as {}: {}", shown, value, shows);
        }
        // What a lock has kept back is made up for by the return to the reference point, which power-on asks for anyway.
        station.script(&["power-off", "power-on"]);
        station.return_axes();
        station.script(&["mode memory", "load 0 as P0", "select P0"]);
        station.events.clear();
        station.script(&["cycle-start", "run until idle"]);
        let kinds: Vec<EventKind> = station.events.iter().map(|event| event.kind).collect();
        prop_assert!(matches!(kinds.first(), Some(EventKind::Start(_))), "{:?}", kinds);
        prop_assert!(kinds.iter().any(|kind| matches!(kind, EventKind::End { .. })), "{:?}", kinds);
        prop_assert_eq!(&station.operator.session.position()[..3], &[1.0, 2.0, 3.0]);
    }

    /// On its way to where a program is taken up, too.
    #[test]
    fn a_restart_can_be_broken_into(
        target in select(TAKEN_UP.to_vec()),
        moved in any::<bool>(),
        period in 0.0f64..3.0,
        actions in prop::collection::vec(action(), 0..12),
    ) {
        let mut station = Station::new();
        if moved {
            station.script(&["mode jog", "jog X + for 0.5", "jog Z - for 0.5", "mode memory"]);
        }
        station.script(target);
        prop_assert!(!station.refused, "{:?}", target);
        station.script(&["restart confirm", "cycle-start"]);
        prop_assert!(!station.refused, "{:?}", target);
        station.perform(&Action::Run(Until::Seconds(period)));
        actions.iter().for_each(|action| station.perform(action));
        station.script(TIDY);
        let counts = station.operator.session.counted_position().map(|mm| (mm * 1e6).round());
        prop_assert_eq!(station.operator.session.interpreter().read_state().machine, counts, "the control knows where the axes are");
        prop_assert!(!station.operator.session.is_running());
        station.script(&["power-off", "power-on", "mode mdi", "mdi G91G28X0Y0Z0", "cycle-start", "run until idle", "mode memory", "load 0 as P0", "select P0", "cycle-start", "run until idle"]);
        prop_assert_eq!(&station.operator.session.position()[..3], &[1.0, 2.0, 3.0]);
    }

    #[test]
    fn what_is_refused_changes_nothing(at in place(), actions in prop::collection::vec(action(), 0..25)) {
        let (mut all, mut taken) = (Station::of(at), Station::of(at));
        for action in &actions {
            let before: Vec<String> = PAGES.iter().map(|page| all.shows(page)).collect();
            let (events, time) = (all.events.len(), all.operator.session.time());
            all.perform(action);
            if all.refused {
                let after: Vec<String> = PAGES.iter().map(|page| all.shows(page)).collect();
                prop_assert_eq!(before, after, "{}", action);
                prop_assert_eq!((events, time), (all.events.len(), all.operator.session.time()), "{}", action);
            } else {
                taken.perform(action);
                prop_assert!(!taken.refused, "{}", action);
            }
        }
        prop_assert_eq!(all.events, taken.events);
    }
}

/// What was read ahead of an alarm was never executed: it is not in force afterwards, whatever is pressed first.
#[test]
fn blocks_read_ahead_of_an_alarm_leave_nothing_behind() {
    let groups_after = |lines: &[&str]| {
        let mut station = Station::new();
        station.script(lines);
        station.operator.session.interpreter().executing_state().groups
    };
    let until_alarm = ["select P2", "cycle-start", "run until alarm"];
    let reset_first = groups_after(&[&until_alarm[..], &["reset", "select P0"]].concat());
    let select_first = groups_after(&[&until_alarm[..], &["select P0", "reset"]].concat());
    assert_eq!(select_first, reset_first);
}

/// After a run under MACHINE LOCK the axes stand elsewhere than the control counts; G28 brings them together again, also
/// where the control thinks that they stand on the reference point already.
#[test]
fn the_reference_point_is_a_place_on_the_machine() {
    for under_lock in ["G91G00X50.", "G91G00X50.;X-50."] {
        for between in ["G91G00X-7.", "G90G53G00X0"] {
            let mut station = Station::new();
            station.script(&["mode mdi", "switch machine-lock on"]);
            station.perform(&Action::Mdi(under_lock.to_owned()));
            station.script(&["cycle-start", "run until idle", "switch machine-lock off"]);
            station.perform(&Action::Mdi(between.to_owned()));
            station.script(&["cycle-start", "run until idle", "mdi G91G28X0", "cycle-start", "run until idle"]);
            let session = &station.operator.session;
            assert_eq!((session.position()[0], session.counted_position()[0]), (0.0, 0.0), "{under_lock} {between}");
        }
    }
}

/// Blocks typed in MDI leave the program in memory where it was.
#[test]
fn typed_blocks_leave_the_program_where_it_was() {
    let places = |lines: &[&str]| {
        let mut station = Station::new();
        station.script(lines);
        station.events.clear();
        station.script(&["mode memory", "cycle-start", "run until stop"]);
        station.events.iter().map(|event| event.place).collect::<Vec<_>>()
    };
    let stopped = ["select P1", "cycle-start", "run until stop", "reset"];
    let typed = ["mode mdi", "mdi M03S100", "cycle-start", "run until idle"];
    assert_eq!(places(&[&stopped[..], &typed[..]].concat()), places(&stopped));
}
