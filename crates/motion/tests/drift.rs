//! Setpoints rounded to the increment of the drives: what has been sent adds up to the place programmed, however many.
//!
//! The environment can ask for more servo periods: PERIODS=10000000.

mod course;

use base::AXES;
use course::watch::{end_of, fill};
use course::{arc, limits, line};
use motion::{Horizon, Move};

const PERIODS: u64 = 200_000;
/// mm.
const INCREMENT: f64 = 1e-4;

/// A round of lines, arcs and a rotary axis' worth of thirds, over and over; its places are whole increments.
fn round() -> Vec<Move> {
    vec![
        line([0.0; 3], [33.3333, 0.0, -1.7], 5000.0),
        arc([33.3333, 0.0, -1.7], [43.3333, 10.0, 0.4], [33.3333, 10.0], false, 3000.0),
        line([43.3333, 10.0, 0.4], [43.3333, 27.7777, 0.4], 8000.0),
        arc([43.3333, 27.7777, 0.4], [43.3333, 27.7777, 1.1], [40.0, 20.0], true, 4000.0),
        line([43.3333, 27.7777, 1.1], [-7.0, 3.0, 0.0], 6000.0),
        line([-7.0, 3.0, 0.0], [0.0; 3], 6000.0),
    ]
}

#[test]
fn nothing_is_lost_and_nothing_is_added() {
    let wanted = std::env::var("PERIODS").map_or(PERIODS, |count| count.parse().expect("PERIODS is a number"));
    let limits = limits(200.0, 900.0, 0.01);
    let moves = round();
    // What the drives have been sent, increments.
    let (mut sent, mut periods, mut rounds) = ([0i64; AXES], 0u64, 0);
    let counts = |place: f64| (place / INCREMENT).round() as i64;
    let mut send = |place: &base::Point| {
        for axis in 0..AXES {
            // One after the other, as to a real drive: only differences go out.
            let step = counts(place[axis]) - sent[axis];
            sent[axis] += step;
        }
        sent
    };
    let mut horizon = Horizon::new(limits);
    let mut left_over = 0.0;
    while periods < wanted {
        let (mut shown, mut done) = (0, 0);
        while done < moves.len() {
            fill(&mut horizon, &moves, &mut shown);
            let (over, ended) = horizon.drive_for(limits.servo_period - left_over);
            if ended {
                (left_over, done) = (limits.servo_period - over, done + 1);
                continue;
            }
            left_over = 0.0;
            periods += 1;
            if let Some(setpoint) = horizon.setpoint() {
                send(&setpoint.position);
            }
        }
        rounds += 1;
        let end = end_of(&moves[moves.len() - 1]);
        assert_eq!(send(&end), end.map(counts), "round {rounds}");
    }
    println!("{periods} periods, {rounds} rounds");
}

/// The same along one straight move that takes all the periods.
#[test]
fn a_move_of_any_length_ends_where_it_should_and_when() {
    let wanted = std::env::var("PERIODS").map_or(PERIODS, |count| count.parse().expect("PERIODS is a number"));
    let limits = limits(200.0, 500.0, 0.01);
    // 60 mm/min: a thousandth of a mm each period.
    let end = [wanted as f64 * 1e-3, 0.0, 0.0];
    let long = line([0.0; 3], end, 60.0);
    let mut horizon = Horizon::new(limits);
    let mut shown = 0;
    fill(&mut horizon, &[long], &mut shown);
    let (mut sent, mut periods) = (0i64, 0u64);
    loop {
        let (over, ended) = horizon.drive_for(limits.servo_period);
        if ended {
            let seconds = periods as f64 * limits.servo_period + limits.servo_period - over;
            let exact = end[0] + 1.0 / 500.0;
            assert!((seconds - exact).abs() < 1e-9 * exact, "{seconds} s, {exact} s");
            break;
        }
        periods += 1;
        let at = horizon.setpoint().expect("under way").position[0];
        let step = (at / INCREMENT).round() as i64 - sent;
        assert!((0..=11).contains(&step), "{step} increments in a period of ten");
        sent += step;
    }
    let step = (end[0] / INCREMENT).round() as i64 - sent;
    assert!((0..=11).contains(&step), "the last step is as the others: {step}");
}
