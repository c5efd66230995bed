//! An operator who does anything at any time: never a panic, and always a way on.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use base::SourceId;
use machine::EventKind;
use proptest::prelude::*;
use proptest::sample::select;
use station::{Action, Loaded, Operator, Said, Session, Setup, Show, Until};
use syntax::Cursor;
use watch::{Texts, Watch, configuration, machine};

/// Programs with all that can hold one up, and (first) one that works whatever came before it.
const PROGRAMS: &[&str] = &[
    "O1\nG21G90G53G00X1.Y2.Z3.\nM30\n",
    "O2\nG90G00X5.\nM00\nG01Y5.F500\nG91G81X1.Y1.Z-1.R-1.L3\nM02\n",
    "O3\nG90G00X5.\nX2000.\nG91\nG92X0Y0Z0\nG20\nM30\n",
    "O4\nM98P5L2\nM01\n/G00X1.\nG43Z5.H31\nT1M06\nS500M03\nM30\nO5\nG91G00X1.\nG04P500\nM99\n",
    "O6\nG91G00X1.",
    "O7\nG02X1.\nM30\n",
    "O8\nG41D31\nG01X5.F100\nG28X0\nM30\n",
    "",
    "M99P7\nN7M02\nN8G90G00X3.\nM99P8\n",
];

/// More than proptest's own number of cases: each is cheap.
fn config() -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: default.cases.max(1000), ..default }
}

fn action() -> impl Strategy<Value = Action> {
    let name = prop_oneof![9 => (0..PROGRAMS.len()).prop_map(|n| n.to_string()), 1 => Just("none".to_owned())];
    let until = prop_oneof![
        Just(Until::Stop),
        Just(Until::End),
        Just(Until::Alarm),
        Just(Until::Idle),
        (0u64..8).prop_map(Until::Line)
    ];
    prop_oneof![
        2 => name.prop_map(Action::Select),
        4 => Just(Action::CycleStart),
        2 => Just(Action::Reset),
        1 => (select(vec!["EOP", "RWD", "skip"]), any::<bool>()).prop_map(|(name, on)| Action::Input(name.to_owned(), on)),
        2 => (select(vec!["single-block", "optional-stop", "block-delete", "dry-run"]), any::<bool>())
            .prop_map(|(name, on)| Action::Switch(name.to_owned(), None, on)),
        6 => until.prop_map(Action::Run),
        1 => select(vec![Show::Modal, Show::Position, Show::State]).prop_map(Action::Show),
        1 => Just(Action::NotBuilt("jog X + for 2".to_owned())),
    ]
}

struct Station {
    operator: Operator<Texts>,
    watch: Watch,
    events: Vec<EventKind>,
}

impl Station {
    fn new() -> Station {
        let texts = Texts { texts: PROGRAMS.iter().map(|text| text.as_bytes().to_vec()).collect(), ..Texts::default() };
        let session = Session::new(configuration(machine("stock-vmc", None), &Setup::default()), texts);
        let watch = Watch::new(&session, true);
        Station { operator: Operator::new(session), watch, events: Vec::new() }
    }

    fn perform(&mut self, action: &Action) {
        let Station { operator, watch, events } = self;
        let find = |_: &mut Texts, name: &str| {
            let index = name.parse().ok()?;
            Some(Loaded { source: SourceId(index), name: format!("P{index}"), head: Cursor::HEAD })
        };
        let mut tell = |session: &mut Session<Texts>, said: Said| {
            if let Said::Event(event) = said {
                watch.see(&event, session);
                events.push(event.kind);
            }
        };
        operator.perform(action, find, &mut tell).expect("texts in memory can be read");
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn whatever_was_done_reset_and_another_program_go_on(actions in prop::collection::vec(action(), 0..25)) {
        let mut station = Station::new();
        actions.iter().for_each(|action| station.perform(action));
        for input in ["EOP", "RWD"] {
            station.perform(&Action::Input(input.to_owned(), true));
        }
        station.perform(&Action::Switch("single-block".to_owned(), None, false));
        station.perform(&Action::Reset);
        let counts = station.operator.session.position().map(|mm| (mm * 1e6).round());
        prop_assert_eq!(station.operator.session.interpreter().read_state().machine, counts, "the control knows where the axes are");
        prop_assert!(station.operator.session.alarm().is_none());
        prop_assert!(!station.operator.session.is_running());
        station.perform(&Action::Select("0".to_owned()));
        station.events.clear();
        station.perform(&Action::CycleStart);
        station.perform(&Action::Run(Until::Idle));
        prop_assert!(matches!(station.events.first(), Some(EventKind::Start(_))), "{:?}", station.events);
        prop_assert!(station.events.iter().any(|kind| matches!(kind, EventKind::End { .. })), "{:?}", station.events);
        prop_assert_eq!(&station.operator.session.position()[..3], &[1.0, 2.0, 3.0]);
    }
}

/// What was read ahead of an alarm was never executed: it is not in force afterwards, whatever is pressed first.
#[test]
fn blocks_read_ahead_of_an_alarm_leave_nothing_behind() {
    let groups_after = |actions: &[Action]| {
        let mut station = Station::new();
        actions.iter().for_each(|action| station.perform(action));
        station.operator.session.interpreter().executing_state().groups
    };
    let until_alarm = [Action::Select("2".to_owned()), Action::CycleStart, Action::Run(Until::Alarm)];
    let reset_first = groups_after(&[&until_alarm[..], &[Action::Reset, Action::Select("0".to_owned())]].concat());
    let select_first = groups_after(&[&until_alarm[..], &[Action::Select("0".to_owned()), Action::Reset]].concat());
    assert_eq!(select_first, reset_first);
}
