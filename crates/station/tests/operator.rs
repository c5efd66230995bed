//! An operator who does anything at any time: never a panic, always a way on, and what is refused changes nothing.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod walk;
mod watch;

use machine::EventKind;
use proptest::prelude::*;
use proptest::sample::select;
use station::{Action, Until};
use walk::{Station, action, config, places};

/// Actions of a walk, one less.
const LONGEST: usize = 81;

/// Programs, and where they are taken up.
const TAKEN_UP: &[&[&str]] = &[
    &["select P1", "restart line 4"],
    &["select P1", "restart line 5"],
    &["select P3", "restart O5 line 9 pass 2"],
    &["select P3", "restart line 3"],
    &["select P4", "restart line 2"],
    &["select P9", "restart line 4"],
];

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
    "offset H1",
    "offset D8",
    "work G52",
    "work G54",
    "work external",
    "parameter 6005",
    "parameter 6001",
    "parameter jog speed",
    "variable 500",
];

/// Brings any station back to where nothing is in the way.
const TIDY: &[&str] = &[
    "power-on",
    "release",
    "input EOP on",
    "input RWD on",
    "input FIN off",
    "fault fin never",
    "switch single-block off",
    "switch dry-run off",
    "switch machine-lock off",
    "switch display-lock off",
    "switch z-cancel off",
    "switch edit-lock off",
    "switch start-lock off",
    "switch mirror-image=X off",
    "override feed 100",
    "override rapid 100",
    "reset",
    "mode memory",
];

/// Behind that and a return by hand of every axis, which power-on asks for: what a lock has kept back is made up for by the
/// return to the reference point.
const FIRST_PROGRAM: &[&str] =
    &["mode mdi", "mdi G91G28X0Y0Z0", "cycle-start", "run until idle", "mode memory", "load 0 as P0", "select P0"];

/// The station can always be brought back to work, and the control knows where the axes are.
fn goes_on(station: &mut Station) {
    station.script(TIDY);
    let session = &station.operator.session;
    let counts = session.counted_position().map(|mm| (mm * 1e6).round());
    assert_eq!(session.interpreter().read_state().machine, counts, "the control knows where the axes are");
    assert!(session.alarm().is_none(), "RESET clears {:?}", session.alarm());
    assert!(!session.is_in_program());
    station.loses_nothing();
    station.script(&["mode return"]);
    for letter in station.letters() {
        station.script(&[&format!("home {letter}"), "run until idle"]);
    }
    station.script(FIRST_PROGRAM);
    station.events.clear();
    station.script(&["cycle-start", "run until idle"]);
    let kinds: Vec<EventKind> = station.events.iter().map(|event| event.kind).collect();
    assert!(matches!(kinds.first(), Some(EventKind::Start(_))), "{kinds:?}");
    assert!(kinds.iter().any(|kind| matches!(kind, EventKind::End { .. })), "{kinds:?}");
    assert_eq!(&station.operator.session.position()[..3], &[1.0, 2.0, 3.0]);
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn whatever_was_done_reset_and_another_program_go_on(
        place in 0..places::count(),
        actions in prop::collection::vec(action(), 0..LONGEST),
    ) {
        let mut station = Station::new(place);
        actions.iter().for_each(|action| station.perform(action));
        goes_on(&mut station);
    }

    /// On its way to where a program is taken up, too.
    #[test]
    fn a_restart_can_be_broken_into(
        place in 0..places::count(),
        target in select(TAKEN_UP.to_vec()),
        moved in any::<bool>(),
        period in 0.0f64..3.0,
        actions in prop::collection::vec(action(), 0..LONGEST),
    ) {
        let mut station = Station::new(place);
        if moved {
            station.script(&["mode jog", "jog X + for 0.5", "jog Z - for 0.5", "mode memory"]);
        }
        station.script(target);
        station.script(&["restart confirm", "cycle-start"]);
        // Programs of one family are not all programs of the other.
        prop_assert!(!station.refused || place > 0, "{:?}", target);
        station.perform(&Action::Run(Until::Seconds(period)));
        actions.iter().for_each(|action| station.perform(action));
        goes_on(&mut station);
    }

    #[test]
    fn what_is_refused_changes_nothing(
        place in 0..places::count(),
        actions in prop::collection::vec(action(), 0..LONGEST),
    ) {
        let (mut all, mut taken) = (Station::new(place), Station::new(place));
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
        let mut station = Station::new(0);
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
            let mut station = Station::new(0);
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
        let mut station = Station::new(0);
        station.script(lines);
        station.events.clear();
        station.script(&["mode memory", "cycle-start", "run until stop"]);
        station.events.iter().map(|event| event.place).collect::<Vec<_>>()
    };
    let stopped = ["select P1", "cycle-start", "run until stop", "reset"];
    let typed = ["mode mdi", "mdi M03S100", "cycle-start", "run until idle"];
    assert_eq!(places(&[&stopped[..], &typed[..]].concat()), places(&stopped));
}

/// What is refused in a held move leaves the moves behind it as they were planned.
#[test]
fn a_write_refused_while_a_move_is_held_costs_no_time() {
    let events = |between: &[&str]| {
        // Here lengths and radii have columns of their own, and a number alone is no cell.
        let mut station = Station::new(5);
        station.script(&["select P13", "cycle-start", "run for 0.005", "feed-hold"]);
        for line in between {
            station.script(&[line]);
            assert!(station.refused, "{line}");
        }
        station.script(&["cycle-start", "run for 7"]);
        station.events
    };
    assert_eq!(events(&["offset 31 = 10", "work G60 X = 1", "switch nothing on"]), events(&[]));
}
