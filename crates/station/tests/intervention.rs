//! Axes moved by hand while a program is held: brought back to where they stood, the program goes on as if nobody had
//! touched it, in every case of the corpus and wherever it is held.

#![allow(clippy::expect_used, clippy::panic)]

#[allow(dead_code, reason = "only the cases are used here")]
mod driven;
mod watch;

use std::path::Path;

use base::{AXES, Point, Seconds};
use machine::EventKind;
use station::{HandMove, Session, Step};
use testkit::Dice;
use watch::Texts;

/// Places nearer than this are the same, mm or degrees.
const SAME: f64 = 2e-6;
/// What these do depends on when they do it, or ends at a place at which the axes happen to be.
const APART: &[&str] = &["macro-loop-ended-by-the-clock", "overtravel-in-a-run", "overtravel-in-a-trace"];
/// Seconds from one look at the hand to the next, at most.
const STRIDES: [f64; 4] = [0.001, 0.02, 0.3, 4.0];
/// Holds in a single program.
const MOST_HOLDS: u64 = 30;
/// Looks at the hand in a single program.
const LOOKS: u64 = 2000;

/// What of an event must stay as it is.
#[derive(Clone, Debug)]
struct Seen {
    line: u64,
    what: String,
    to: Point,
}

impl Seen {
    fn is(&self, other: &Seen) -> bool {
        let near = (0..AXES).all(|axis| (self.to[axis] - other.to[axis]).abs() < SAME);
        near && self.line == other.line && self.what == other.what
    }
}

fn note(seen: &mut Vec<Seen>, event: &machine::Event) {
    let (what, to) = match event.kind {
        EventKind::Rapid { to, .. } => ("rapid".to_owned(), to),
        EventKind::Feed { to, feed, .. } => (format!("feed {feed:.6}"), to),
        EventKind::Arc { arc, .. } => ("arc".to_owned(), arc.to),
        EventKind::Code(code) => (format!("{:?} {}", code.line, code.code), [0.0; AXES]),
        EventKind::End { kind, to, .. } => (format!("{kind:?}"), to),
        EventKind::Alarm(alarm) => (format!("{:?}", alarm.condition), [0.0; AXES]),
        _ => return,
    };
    seen.push(Seen { line: event.place.line, what, to });
}

/// The program to its end; the hand moves axes away and back where the dice say so. What was seen, and how often.
fn run(session: &mut Session<Texts>, mut dice: Option<&mut Dice>) -> (Vec<Seen>, u64) {
    session.run_live();
    session.start();
    let period = session.configuration().machine.limits().servo_period;
    let (mut seen, mut meddled, mut starts, mut holds) = (Vec::new(), 0, 0, 0);
    let stride = STRIDES[dice.as_mut().map_or(3, |dice| dice.throw(4) as usize)];
    for _ in 0..LOOKS {
        let stride = if holds < MOST_HOLDS { stride } else { 1e6 };
        let longer = dice.as_mut().map_or(stride, |dice| stride * dice.throw(1000) as f64 / 1000.0);
        let now = ((session.time().0 + longer) / period).ceil() * period;
        if let Some(dice) = &mut dice
            && holds < MOST_HOLDS
            && dice.throw(4) == 0
            && session.is_running()
        {
            holds += 1;
            session.feed_hold();
            while let Some(event) = session.next_told() {
                note(&mut seen, &event);
            }
            meddled += u64::from(session.is_stopped() && meddle(session, dice, &mut seen));
            if session.is_stopped() {
                session.start();
            }
        }
        loop {
            match session.next_until(Seconds(now)) {
                None => break,
                Some(Step::Event(event)) => note(&mut seen, &event),
                Some(Step::Stopped) if starts < 200 => {
                    starts += 1;
                    if let Some(dice) = &mut dice {
                        meddled += u64::from(meddle(session, dice, &mut seen));
                    }
                    session.start();
                }
                Some(Step::Stopped | Step::Idle) => {
                    let waits = session.waiting().is_some() && session.is_running();
                    if !waits {
                        return (seen, meddled);
                    }
                    session.let_time_pass(Seconds(now));
                    break;
                }
                Some(Step::Failed(error)) => panic!("texts in memory can be read: {error}"),
            }
        }
    }
    (seen, meddled)
}

/// Moves an axis or two away and back; true if one moved.
fn meddle(session: &mut Session<Texts>, dice: &mut Dice, seen: &mut Vec<Seen>) -> bool {
    session.set_switch("manual-absolute", station::Which::One, dice.throw(2) == 0).expect("a switch");
    let axes = session.configuration().machine.axes.len() as u64;
    let mut ways: Vec<(usize, f64)> =
        (0..=dice.throw(2)).map(|_| (dice.throw(axes) as usize, [0.5, -0.5, 1.25][dice.throw(3) as usize])).collect();
    let back: Vec<_> = ways.iter().map(|&(axis, way)| (axis, -way)).collect();
    let stood = session.position();
    // The ways there must not end at a border, or they do not lead back.
    let travel = session.configuration().machine.travel();
    let fits = |&(axis, way): &(usize, f64)| {
        let there = stood[axis] + 3.0 * way;
        travel.low[axis] < there && there < travel.high[axis]
    };
    if !ways.iter().all(fits) {
        return false;
    }
    ways.extend(back);
    let mut moved = false;
    for (axis, way) in ways {
        if session.begin_by_hand(axis, HandMove::By(way)).is_err() {
            return moved;
        }
        moved = true;
        loop {
            match session.next() {
                Step::Event(event) => note(seen, &event),
                Step::Stopped | Step::Idle => break,
                Step::Failed(error) => panic!("{error}"),
            }
        }
    }
    let stands = session.position();
    // A way by hand that an area cuts off raises the area's alarm.
    let cut_off = session.alarm().is_some();
    assert!(cut_off || (0..AXES).all(|axis| (stands[axis] - stood[axis]).abs() < SAME), "{stood:?} {stands:?}");
    moved
}

/// Everything that happened untouched must have happened in this order, between what the hand did.
fn compare(plain: &[Seen], touched: &[Seen]) -> Result<(), String> {
    let mut rest = touched.iter();
    for wanted in plain {
        if !rest.any(|seen| seen.is(wanted)) {
            return Err(format!("{wanted:?} is missing or out of its order"));
        }
    }
    // Beside them the parts before a hold, and what the hand moved.
    let same = |what: &str, list: &[Seen]| list.iter().filter(|seen| seen.what.starts_with(what)).count();
    for what in ["CodeLine", "M ", "S ", "T ", "B "] {
        if same(what, plain) != same(what, touched) {
            return Err(format!("another number of codes {what}"));
        }
    }
    Ok(())
}

#[test]
fn a_program_goes_on_as_if_nobody_had_touched_it() {
    let corpus = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases"));
    let only = std::env::var("ONLY").ok();
    let seed = std::env::var("SEED").map_or(1, |seed| seed.parse::<u64>().expect("SEED is a number"));
    let mut wrong = Vec::new();
    let (mut cases, mut meddled, mut cut_off) = (0u64, 0, 0);
    for family in sorted(corpus).into_iter().filter(|path| path.is_dir()) {
        for folder in sorted(&family).into_iter().filter(|path| path.join("case.toml").is_file()) {
            let name = folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            cases += 1;
            if only.as_ref().is_some_and(|only| *only != name) || APART.contains(&name.as_str()) {
                continue;
            }
            let sessions = [(); 2].map(|()| driven::case::session(&family, &folder));
            let [Some(mut plain), Some(mut touched)] = sessions else { continue };
            let mut dice = Dice((cases + 7919 * seed).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
            let (plain, _) = run(&mut plain, None);
            let (touched, times) = run(&mut touched, Some(&mut dice));
            meddled += times;
            if session_alarms(&touched) > session_alarms(&plain) {
                cut_off += 1;
                continue;
            }
            if let Err(what) = compare(&plain, &touched) {
                if only.is_some() {
                    println!("untouched: {plain:?}\ntouched: {touched:?}");
                }
                wrong.push(format!("{name}: {what}"));
            }
        }
    }
    println!("{cases} cases, {meddled} times moved by hand; {cut_off} ended at a border on the way");
    assert!(wrong.is_empty(), "{} of {cases} cases:\n{}", wrong.len(), wrong.join("\n"));
    assert!(only.is_some() || cases > 900 && meddled > 500 && cut_off < 20, "{cases} {meddled}");
}

/// Alarms that no block raised.
fn session_alarms(seen: &[Seen]) -> usize {
    seen.iter().filter(|seen| seen.line == 0 && !["rapid", "Text"].contains(&seen.what.as_str())).count()
}

fn sorted(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder of the corpus");
    let mut found: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    found.sort();
    found
}
