//! What the operator does in mid-path: feed hold, emergency stop, single block, DRY RUN, overrides of rapid and spindle.

mod course;

use course::program::Program;
use course::watch::{Act, fill, watch};
use course::{arc, limits, line};
use meaning::Feed;
use motion::{Horizon, Move, Overrides};

const PERIOD_S: f64 = 0.001;
const FAST: f64 = 6000.0;
/// How far off its stop an axis is a period before, mm.
const LAST_MM: f64 = 500.0 * PERIOD_S * PERIOD_S / 2.0 * 1.001;

/// 100 mm/s, 500 mm/s²: it stands after 10 mm, and 0.2 s.
fn program(moves: Vec<Move>) -> Program {
    Program { limits: limits(200.0, 500.0, 0.01), moves }
}

fn tapping(mut cut: Move) -> Move {
    cut.feed = Feed { tapping: true, ..cut.feed };
    cut
}

/// A horizon that sees a whole program, driven so many periods.
fn driven(program: &Program, periods: usize) -> Horizon {
    let mut horizon = Horizon::new(program.limits);
    let mut shown = 0;
    fill(&mut horizon, &program.moves, &mut shown);
    for _ in 0..periods {
        drive(&mut horizon);
    }
    horizon
}

/// One servo period, over the ends of moves; how many those were.
fn drive(horizon: &mut Horizon) -> usize {
    let (mut left, mut ends) = (PERIOD_S, 0);
    loop {
        let (over, ended) = horizon.drive_for(left);
        if !ended {
            return ends;
        }
        (left, ends) = (over, ends + 1);
    }
}

fn periods_to_stand(horizon: &mut Horizon) -> usize {
    (0..10_000)
        .position(|_| {
            drive(horizon);
            horizon.is_standing()
        })
        .expect("it stands")
}

#[test]
fn a_hold_stands_as_soon_as_the_axes_can_and_goes_on_from_there() {
    let program = program(vec![line([0.0; 3], [100.0, 0.0, 0.0], FAST)]);
    let mut horizon = driven(&program, 500);
    let at = horizon.setpoint().expect("under way").position[0];
    horizon.hold(true);
    let periods = periods_to_stand(&mut horizon);
    assert!((199..=201).contains(&periods), "{periods} periods from 100 mm/s at 500 mm/s²");
    let stood = horizon.setpoint().expect("under way").position[0];
    assert!((stood - at - 10.0).abs() < 1e-9, "{stood} mm, held at {at} mm");
    assert!(horizon.is_held());
    for _ in 0..100 {
        drive(&mut horizon);
    }
    assert_eq!(horizon.setpoint().expect("held").position[0], stood);
    horizon.hold(false);
    assert!(!horizon.is_held());
    drive(&mut horizon);
    assert!(horizon.setpoint().expect("goes on").position[0] > stood);
}

#[test]
fn a_hold_waits_until_tapping_is_over_and_an_emergency_stop_does_not() {
    let down = tapping(line([0.0; 3], [0.0, 0.0, -20.0], 3000.0));
    let up = tapping(line([0.0, 0.0, -20.0], [0.0; 3], 3000.0));
    let program = program(vec![down, up, line([0.0; 3], [50.0, 0.0, 0.0], FAST)]);
    let mut held = driven(&program, 200);
    let mut stopped = held.clone();
    held.hold(true);
    let mut ends = 0;
    for _ in 0..5000 {
        ends += drive(&mut held);
        let mut shown = program.moves.len();
        fill(&mut held, &program.moves, &mut shown);
    }
    assert_eq!(ends, 2, "down and up are driven to their ends");
    assert!(held.is_held());
    stopped.emergency_stop();
    let periods = periods_to_stand(&mut stopped);
    assert!((99..=101).contains(&periods), "{periods} periods from 50 mm/s at 500 mm/s²");
    assert!(stopped.is_held());
}

#[test]
fn a_hold_in_a_corner_or_on_an_arc_keeps_to_the_path() {
    let moves = vec![
        line([0.0; 3], [30.0, 0.0, 0.0], FAST),
        arc([30.0, 0.0, 0.0], [30.0, 20.0, 0.0], [30.0, 10.0], false, FAST),
        line([30.0, 20.0, 0.0], [0.0, 25.0, 0.0], FAST),
        line([0.0, 25.0, 0.0], [0.0, 0.0, 10.0], FAST),
    ];
    let program = program(moves);
    for at in (0..2000).step_by(61) {
        watch(&program, &[(at, Act::Hold(true)), (at + 300, Act::Hold(false))]).expect("limits and path are kept to");
    }
}

/// Where the axes come to stand when single block is switched on at this period, mm along X: as seen in the last period
/// before.
fn stands_at(program: &Program, period: usize) -> f64 {
    let mut horizon = driven(program, period);
    let mut last = horizon.setpoint().expect("under way");
    let at = last.position[0];
    let mut left = horizon.stand_soon();
    while left > 0 {
        let (_, ended) = horizon.drive_for(PERIOD_S);
        left -= usize::from(ended);
        last = horizon.setpoint().unwrap_or(last);
    }
    assert!(horizon.is_empty() && last.speed() <= 500.0 * PERIOD_S * 1.001, "{last:?}");
    assert!(last.position[0] >= at);
    last.position[0]
}

#[test]
fn single_block_stands_at_the_first_end_at_which_it_can() {
    // Ends at each 4 mm, some corners among them; 10 mm are needed from full speed.
    let at = |n: usize| [4.0 * n as f64, if n.is_multiple_of(3) { 0.01 } else { 0.0 }, 0.0];
    let program = program((0..25).map(|n| line(at(n), at(n + 1), FAST)).collect());
    for period in (1..500).step_by(3) {
        let horizon = driven(&program, period);
        let setpoint = horizon.setpoint().expect("under way");
        let (x, speed) = (setpoint.position[0], setpoint.velocity[0]);
        let needed = x + speed * speed / 1000.0;
        let first = (needed / 4.0 - 1e-3).ceil() * 4.0;
        let stood = stands_at(&program, period);
        // In the corner behind a block it is too late for its end.
        let is_at = |end: f64| (end - stood).abs() <= LAST_MM;
        assert!(is_at(first) || (is_at(first + 4.0) && first - x < 0.5), "{period}: {x} mm, {stood} mm");
    }
}

#[test]
fn dry_run_and_overrides_set_the_speed() {
    let mut rapid = line([60.0, 0.0, 0.0], [160.0, 0.0, 0.0], f64::INFINITY);
    let mut turning = line([0.0; 3], [60.0, 0.0, 0.0], 1200.0);
    turning.feed.per_revolution = true;
    (turning.stops, rapid.stops) = (true, true);
    let mut limits = limits(80.0, 5000.0, 0.01);
    for axis in &mut limits.axes {
        axis.rapid = 150.0;
    }
    let program = Program { limits, moves: vec![turning, rapid] };
    let none = Overrides::default();
    // Speeds of the cut and of the move at the rapid rate, mm/s.
    let rows = [
        (none, 20.0, 150.0),
        (Overrides { spindle: 0.5, ..none }, 10.0, 150.0),
        (Overrides { feed: 1.5, spindle: 1.2, ..none }, 36.0, 150.0),
        (Overrides { rapid: 0.25, ..none }, 20.0, 37.5),
        (Overrides { rapid_limit: 5.0, ..none }, 20.0, 5.0),
        (Overrides { dry_run: Some(3000.0), feed: 0.5, rapid: 0.25, ..none }, 50.0, 50.0),
        (Overrides { dry_run: Some(60_000.0), ..none }, 80.0, 80.0),
    ];
    for (overrides, cut, at_rapid) in rows {
        let mut horizon = Horizon::new(program.limits);
        horizon.set_overrides(overrides);
        let (mut shown, mut fastest) = (0, [0.0f64; 2]);
        for top in &mut fastest {
            fill(&mut horizon, &program.moves, &mut shown);
            horizon.drive_move(|_, _, leg| *top = top.max(leg.speed));
        }
        assert!((fastest[0] - cut).abs() < 1e-9 && (fastest[1] - at_rapid).abs() < 1e-9, "{fastest:?}, {overrides:?}");
    }
}

#[test]
fn the_feed_comes_down_as_hard_as_the_axes_can() {
    let ways = [
        vec![line([0.0; 3], [100.0, 0.0, 0.0], FAST)],
        vec![arc([0.0; 3], [0.0, 80.0, 0.0], [0.0, 40.0], false, FAST)],
    ];
    for moves in ways {
        let program = program(moves);
        let mut held = driven(&program, 400);
        let mut lowered = held.clone();
        held.hold(true);
        lowered.set_overrides(Overrides { feed: 0.0, ..Overrides::default() });
        let periods = [periods_to_stand(&mut held), periods_to_stand(&mut lowered)];
        assert!(periods[0].abs_diff(periods[1]) <= 1, "{periods:?}");
    }
}

#[test]
fn tapping_knows_no_feed_override() {
    let cut = line([0.0; 3], [0.0, 0.0, -20.0], 600.0);
    let times = [cut, tapping(cut)].map(|cut| {
        let halved = Act::Override(Overrides { feed: 0.5, ..Overrides::default() });
        watch(&program(vec![cut]), &[(0, halved)]).expect("limits are kept to").times[0]
    });
    assert!((times[0] - 4.01).abs() < 1e-9 && (times[1] - 2.02).abs() < 1e-9, "{times:?}");
}
