//! Looking changes nothing: every case of the corpus is run twice in the same strides, once with somebody who looks at any
//! display at any moment. What happens, and what stands in every display at the end, is the same to the last bit. ORG changes
//! nothing of what happens either.

#![allow(clippy::expect_used, clippy::panic)]

#[allow(dead_code, reason = "only the cases are used here")]
mod driven;
mod watch;

use std::path::{Path, PathBuf};

use base::Seconds;
use machine::Event;
use station::{OffsetColumn, Operator, Session, Show, Step, Value};
use testkit::Dice;
use watch::Texts;

/// Seconds from one look to the next, at most.
const STRIDES: [f64; 4] = [0.004, 0.05, 0.5, 6.0];
/// Looks at a single program.
const LOOKS: u64 = 400;
/// CYCLE STARTs of a single program.
const MOST_STARTS: u64 = 100;
/// Events of a single program: some never end.
const MOST_EVENTS: usize = 5000;

/// Every display there is.
fn displays() -> Vec<Show> {
    vec![
        Show::Position,
        Show::Command,
        Show::Modal,
        Show::Machine,
        Show::Alarm,
        Show::Alarms,
        Show::Feed,
        Show::Program,
        Show::State,
        Show::Diagnosis,
        Show::Works,
        Show::Variables,
        Show::Directory,
        Show::Displays,
        Show::Offset(OffsetColumn::Common, 1),
        Show::Work("G54".to_owned()),
        Show::Parameter("6005".to_owned(), Some(2)),
        Show::Variable(5021),
        Show::Variable(3001),
        Show::Offsets,
        Show::Parameters,
    ]
}

/// Does something at a moment that the dice have chosen.
type Does = fn(&mut Operator<Texts>, &mut Dice, &[Show]);

fn looks(operator: &mut Operator<Texts>, dice: &mut Dice, shows: &[Show]) {
    // The first ones, which a front end draws all the time, more often than the long lists.
    let most = dice.throw(shows.len() as u64) + 1;
    // Who looks may ask for the same block as often as he likes.
    operator.session.library_mut().again = 0;
    if let Some(show) = shows.get(dice.throw(most) as usize) {
        // A page that the control does not have is refused; that changes nothing either.
        let _ = operator.display(show);
    }
}

fn presses_org(operator: &mut Operator<Texts>, dice: &mut Dice, _: &[Show]) {
    let axis = dice.throw(operator.session.configuration().machine.axes.len() as u64) as usize;
    operator.session.preset_universal(axis, [0.0, -12.345][dice.throw(2) as usize]);
    let shown = operator.session.universal_display()[axis];
    assert!((shown - shown.round()).abs() < 1e-6 || (shown + 12.345).abs() < 1e-6, "{shown}");
}

/// The program to its end in strides that the dice give; with a second die something is done on the way, so often.
fn run(session: Session<Texts>, mut strides: Dice, mut hand: Option<(Dice, Does)>) -> Run {
    let mut operator = Operator::new(session);
    let shows = displays();
    let (mut events, mut starts, mut looked) = (Vec::new(), 0, 0);
    let mut look = |operator: &mut Operator<Texts>, one_in: u64| {
        if let Some((dice, does)) = &mut hand
            && dice.throw(one_in) == 0
        {
            looked += 1;
            does(operator, dice, &shows);
        }
    };
    operator.session.start();
    let stride = STRIDES[strides.throw(4) as usize];
    'looks: for _ in 0..LOOKS {
        let now = Seconds(operator.session.time().0 + stride * strides.throw(1000) as f64 / 1000.0);
        look(&mut operator, 1);
        while events.len() < MOST_EVENTS {
            match operator.session.next_until(now) {
                None => continue 'looks,
                Some(Step::Event(event)) => events.push(event),
                Some(Step::Stopped) if starts < MOST_STARTS => {
                    starts += 1;
                    look(&mut operator, 1);
                    operator.session.start();
                }
                Some(Step::Stopped | Step::Idle) => {
                    if operator.session.waiting().is_none() || !operator.session.is_running() {
                        break 'looks;
                    }
                    operator.session.let_time_pass(now);
                    continue 'looks;
                }
                Some(Step::Failed(error)) => panic!("texts in memory can be read: {error}"),
            }
            look(&mut operator, 3);
        }
        break;
    }
    (operator, events, looked)
}

/// What every display shows, and every cell that lasts holds.
fn shown(operator: &mut Operator<Texts>) -> Vec<(String, Result<Value, String>)> {
    let mut shown: Vec<_> = displays().iter().map(|show| (show.to_string(), operator.display(show))).collect();
    operator.session.see_kept(&mut |cell, value| {
        shown.push((format!("{cell:?}"), Ok(Value::Text(value.to_bits().to_string()))));
    });
    shown
}

/// A blank variable is no number: what is unlike itself is compared as it is written.
fn same<T: PartialEq + std::fmt::Debug>(one: &T, other: &T) -> bool {
    one == other || format!("{one:?}") == format!("{other:?}")
}

type Run = (Operator<Texts>, Vec<Event>, u64);

fn compare_events(plain: &Run, watched: &Run) -> String {
    let differs = plain.1.iter().zip(&watched.1).find(|(one, other)| !same(*one, *other));
    if let Some((one, other)) = differs {
        return format!("{one:?}\n    {other:?}");
    }
    if plain.1.len() != watched.1.len() {
        return format!("{} events, {} where somebody looks", plain.1.len(), watched.1.len());
    }
    if plain.0.session.time() == watched.0.session.time() { String::new() } else { "another time".to_owned() }
}

fn compare(plain: &mut Run, watched: &mut Run) -> String {
    let differs = compare_events(plain, watched);
    if !differs.is_empty() {
        return differs;
    }
    let (plain, watched) = (shown(&mut plain.0), shown(&mut watched.0));
    let differs = plain.iter().zip(&watched).find(|(one, other)| !same(*one, *other));
    differs.map_or_else(String::new, |(one, other)| format!("{one:?}\n    {other:?}"))
}

#[test]
fn nothing_follows_from_a_look_at_a_display() {
    let (programs, looked) = run_all(looks, compare);
    println!("{programs} programs, {looked} looks at displays");
    assert!(std::env::var("ONLY").is_ok() || programs > 900 && looked > 20_000, "{programs} {looked}");
}

#[test]
fn nothing_but_a_display_follows_from_org() {
    let (programs, pressed) = run_all(presses_org, |plain, watched| compare_events(plain, watched));
    println!("{programs} programs, ORG pressed {pressed} times");
    assert!(std::env::var("ONLY").is_ok() || programs > 900 && pressed > 20_000, "{programs} {pressed}");
}

/// Every program of the corpus twice, once with a hand that does this on the way: how many, and how often it was done.
fn run_all(does: Does, compare: fn(&mut Run, &mut Run) -> String) -> (u64, u64) {
    let corpus = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases"));
    let only = std::env::var("ONLY").ok();
    let seed = std::env::var("SEED").map_or(1, |seed| seed.parse::<u64>().expect("SEED is a number"));
    let (mut wrong, mut cases, mut programs, mut looked) = (Vec::new(), 0u64, 0, 0);
    for family in sorted(corpus).into_iter().filter(|path| path.is_dir()) {
        for folder in sorted(&family).into_iter().filter(|path| path.join("case.toml").is_file()) {
            let name = folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            cases += 1;
            if only.as_ref().is_some_and(|only| *only != name) {
                continue;
            }
            let sessions = [(); 2].map(|()| driven::case::session(&family, &folder));
            let [Some(plain), Some(watched)] = sessions else { continue };
            let seed = (cases + 7919 * seed).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
            let mut plain = run(plain, Dice(seed), None);
            let mut watched = run(watched, Dice(seed), Some((Dice(seed.rotate_left(17) | 1), does)));
            programs += 1;
            looked += watched.2;
            let differs = compare(&mut plain, &mut watched);
            if !differs.is_empty() {
                wrong.push(format!("{name}: {differs}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {programs} programs:\n{}", wrong.len(), wrong.join("\n"));
    (programs, looked)
}

fn sorted(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder of the corpus");
    let mut found: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    found.sort();
    found
}
