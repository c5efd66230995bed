//! A program taken up in its middle is the program run from its head, from there on: state, codes and motion.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

#[path = "driven/case.rs"]
mod case;
mod watch;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use machine::{Event, EventKind};
use meaning::State;
use station::{At, BlockTarget, HandMove, RestartPlan, Session, Setup, Step, read_setup};
use watch::{Texts, machine};

/// Events after which a program is given up.
const MOST_EVENTS: usize = 3_000;
/// Blocks at which each program is taken up.
const SAMPLES: usize = 6;

/// What a program does, without its times.
#[derive(Clone, PartialEq, Debug)]
enum Deed {
    Rapid(base::Point),
    Feed(base::Point, f64),
    Arc(base::Point, [f64; 2], f64),
    Code(meaning::CodeOut),
    Stop(machine::StopCause),
    Alarm(base::Condition, u64),
    End(meaning::EndKind),
}

fn deed(event: &Event) -> Option<(u64, Deed)> {
    let deed = match event.kind {
        EventKind::Rapid { to, .. } => Deed::Rapid(to),
        EventKind::Feed { to, feed, .. } => Deed::Feed(to, feed),
        EventKind::Arc { arc, feed, .. } => Deed::Arc(arc.to, arc.center, feed),
        EventKind::Code(code) => Deed::Code(code),
        EventKind::Stop(cause) => Deed::Stop(cause),
        EventKind::Alarm(alarm) => Deed::Alarm(alarm.condition, alarm.place.line),
        EventKind::End { kind, .. } => Deed::End(kind),
        _ => return None,
    };
    Some((event.place.line, deed))
}

/// A block of a run: the state before it, and what had been done by then.
struct Begun {
    target: BlockTarget,
    state: State,
    done: usize,
}

struct Run {
    begun: Vec<Begun>,
    deeds: Vec<(u64, Deed)>,
}

fn run(session: &mut Session<Texts>) -> Run {
    let mut run = Run { begun: Vec::new(), deeds: Vec::new() };
    let mut passes: BTreeMap<(String, u64), u32> = BTreeMap::new();
    while run.deeds.len() < MOST_EVENTS && run.begun.len() < MOST_EVENTS {
        if let Some(place) = session.line_begins() {
            let interpreter = session.interpreter();
            let program = interpreter.program_name(place.program).to_owned();
            let pass = passes.entry((program.clone(), place.line)).or_insert(0);
            *pass += 1;
            let target = BlockTarget { program: Some(program), at: At::Line(place.line), pass: Some(*pass) };
            let state = *interpreter.state_before();
            run.begun.push(Begun { target, state, done: run.deeds.len() });
        }
        match session.next() {
            Step::Event(event) => run.deeds.extend(deed(&event)),
            Step::Stopped => session.start(),
            Step::Idle => break,
            Step::Failed(error) => panic!("texts in memory can be read: {error}"),
        }
    }
    run
}

/// True if both do the same. An overtravel switch is looked at each servo period, and where in one it is met is chance.
fn are_alike(rest: &[(u64, Deed)], whole: &[(u64, Deed)], period_s: f64) -> bool {
    let [.., (line, Deed::Feed(to, feed)), trip @ (_, Deed::Alarm(base::Condition::LimitSwitchReached, _))] = rest
    else {
        return rest == whole;
    };
    let [.., (own_line, Deed::Feed(own_to, own_feed)), own_trip] = whole else { return false };
    let near = to.iter().zip(own_to).all(|(to, own)| (to - own).abs() <= feed / 60.0 * period_s);
    let before = rest.len() - 2;
    near && (line, feed, trip) == (own_line, own_feed, own_trip) && whole.get(..whole.len() - 2) == rest.get(..before)
}

/// How the axes stand when a program is taken up.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stand {
    /// Where the whole run has begun.
    AtTheHead,
    /// There too, and moves take their time.
    Live,
    /// Elsewhere: what the program does not place is left alone.
    Elsewhere,
}

/// Axes that stand elsewhere.
const JOGGED: [usize; 2] = [0, 1];

/// Moves axes by hand.
fn jog(session: &mut Session<Texts>) {
    session.run_live();
    session.set_switch("manual-absolute", station::Which::One, true).unwrap();
    for axis in JOGGED {
        // A lock switch may be on.
        let _ = session.begin_by_hand(axis, HandMove::By(-3.0 - axis as f64));
        while let Step::Event(_) = session.next() {}
    }
}

/// The codes that the machine still wants are given by MDI, in the order in which they are named.
fn give(session: &mut Session<Texts>, target: &BlockTarget, plan: RestartPlan) -> Result<RestartPlan, String> {
    if plan.give.is_empty() {
        return Ok(plan);
    }
    for (line, code) in &plan.give {
        session.type_blocks(&format!("{line:?}{code}"));
        session.start_typed();
        run(session);
        session.come_back();
    }
    let after = session.plan_restart(target, None).map_err(|why| format!("{target}: {why}"))?;
    let is_there = after.give.is_empty();
    is_there.then_some(after).ok_or_else(|| format!("{target}: {:?} does not bring the machine there", plan.give))
}

/// Takes up a program at blocks all over it; how many there were, and what was wrong.
fn take_up(session: impl Fn() -> Session<Texts>, stand: Stand) -> Result<usize, String> {
    // Overtravel switches are met by axes that take their time.
    let mut whole = session();
    let has_switches = !whole.configuration().machine.limit_switches().is_empty();
    if has_switches {
        whole.run_live();
    }
    whole.start();
    let whole = run(&mut whole);
    if whole.deeds.len() >= MOST_EVENTS || whole.begun.len() >= MOST_EVENTS {
        return Ok(0);
    }
    let step = whole.begun.len().div_ceil(SAMPLES).max(1);
    let mut taken = 0;
    for begun in whole.begun.iter().skip(step / 2).step_by(step) {
        let target = &begun.target;
        let mut session = session();
        match stand {
            Stand::AtTheHead if !has_switches => {}
            Stand::AtTheHead | Stand::Live => session.run_live(),
            Stand::Elsewhere => jog(&mut session),
        }
        let plan = match session.plan_restart(target, None) {
            Ok(plan) => plan,
            // From where the axes stand there may be no way, and a lock switch may be on.
            Err(why) if why.contains("the way there") || why.contains("lock switch") => continue,
            // An arc may need the place where the program began.
            Err(why) if stand == Stand::Elsewhere && why.contains("on the way") => continue,
            Err(why) => return Err(format!("{target}: {why}")),
        };
        let elsewhere = stand == Stand::Elsewhere;
        if plan.way.asked.clock
            || plan.way.asked.skip
            || elsewhere && JOGGED.iter().any(|axis| plan.unplaced.has(*axis))
        {
            continue;
        }
        let gives = !plan.give.is_empty();
        let plan = give(&mut session, target, plan)?;
        session.restart(target, None, &plan, false).map_err(|why| format!("{target}: {why}"))?;
        let mut state = *session.interpreter().state_before();
        if gives && begun.state.miscellaneous == 0 {
            // A program that has commanded no M code finds the last one that was given.
            state.miscellaneous = 0;
        }
        if state != begun.state && !elsewhere {
            return Err(format!("{target}: the state: {state:?}\nand not {:?}", begun.state));
        }
        let rest = run(&mut session);
        // Behind the way of the axes to the place, which belongs to no line.
        let moved = rest.deeds.iter().take_while(|(line, _)| *line == 0).count();
        let period = session.servo_period();
        if moved != plan.legs.len() || !are_alike(&rest.deeds[moved..], &whole.deeds[begun.done..], period) {
            let wanted = &whole.deeds[begun.done..];
            return Err(format!(
                "{target}: {moved} of {:?}, then {:?}\nand not {wanted:?}",
                plan.legs,
                &rest.deeds[moved..]
            ));
        }
        taken += 1;
    }
    Ok(taken)
}

fn all_cases(family: &str, every: usize, stand: Stand) -> usize {
    let family = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases")).join(family);
    let mut folders: Vec<PathBuf> = fs::read_dir(&family).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    let (mut taken, mut wrong) = (0, Vec::new());
    for folder in folders.iter().step_by(every).filter(|folder| case::session(&family, folder).is_some()) {
        match take_up(|| case::session(&family, folder).unwrap(), stand) {
            Ok(blocks) => taken += blocks,
            Err(why) => wrong.push(format!("{}: {why}", folder.display())),
        }
    }
    assert!(wrong.is_empty(), "{} programs:\n{}", wrong.len(), wrong.join("\n"));
    taken
}

#[test]
fn every_case_of_the_yasnac_is_taken_up_in_its_middle() {
    let taken = all_cases("yasnac-mx1", 1, Stand::AtTheHead);
    println!("{taken} blocks");
    assert!(taken > 1000, "{taken} blocks");
}

#[test]
fn every_case_of_the_incon_is_taken_up_in_its_middle() {
    let taken = all_cases("incon-m8x", 1, Stand::AtTheHead);
    println!("{taken} blocks");
    assert!(taken > 100, "{taken} blocks");
}

#[test]
fn the_axes_go_there_step_by_step_too() {
    assert!(all_cases("yasnac-mx1", 10, Stand::Live) > 100);
}

/// From wherever the axes stand the way leads to the same place, unless it is said that it does not.
#[test]
fn it_does_not_matter_where_the_axes_stand() {
    let taken = all_cases("yasnac-mx1", 2, Stand::Elsewhere) + all_cases("incon-m8x", 2, Stand::Elsewhere);
    println!("{taken} blocks from elsewhere");
    assert!(taken > 100, "{taken} blocks");
}

#[test]
fn the_example_is_taken_up_at_every_line() {
    let example = |name: &str| fs::read(format!("{}/../../examples/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let text = example("plate.nc");
    let setup: Setup =
        read_setup("plate.setup.toml", &String::from_utf8(example("plate.setup.toml")).unwrap()).unwrap();
    let configuration = watch::configuration(machine("stock-vmc", None), &setup);
    let session = || {
        let mut session = Session::new(configuration.clone(), Texts::one(text.clone()));
        watch::select(&mut session, 0);
        session
    };
    assert!(take_up(session, Stand::AtTheHead).unwrap() > 4);
}
