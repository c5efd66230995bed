//! The times of LinuxCNC 2.9 in simulation, measured, beside ours: axes of 200 mm/s and 500 mm/s², tolerance 0.01 mm.

mod course;
use course::{arc, drive, limits, line};
use motion::Move;

const PERIOD_S: f64 = 0.001;

fn seconds(tolerance: f64, moves: &[Move]) -> f64 {
    drive(&limits(200.0, 500.0, tolerance), moves, |_, _| {}).iter().sum()
}

fn square(times: usize) -> Vec<Move> {
    let corners = [[0.0, 0.0, 0.0], [20.0, 0.0, 0.0], [20.0, 20.0, 0.0], [0.0, 20.0, 0.0]];
    (0..4 * times).map(|side| line(corners[side % 4], corners[(side + 1) % 4], 3000.0)).collect()
}

/// A square with rounded corners, 714.2 mm in all.
fn slot(times: usize) -> Vec<Move> {
    let (radius, f) = (10.0, 4000.0);
    let half = (714.2 / times as f64 - 2.0 * std::f64::consts::PI * radius) / 8.0;
    // One side and the corner behind it, turned by quarters.
    let turned = |quarter: usize, [x, y]: [f64; 2]| match quarter % 4 {
        0 => [x, y, 0.0],
        1 => [-y, x, 0.0],
        2 => [-x, -y, 0.0],
        _ => [y, -x, 0.0],
    };
    let mut moves = Vec::new();
    for quarter in 0..4 * times {
        let at = |x: f64, y: f64| turned(quarter, [x, y]);
        let (start, end) = (at(-half, -half - radius), at(half, -half - radius));
        let [u, v, _] = at(half, -half);
        moves.push(line(start, end, f));
        moves.push(arc(end, at(half + radius, -half), [u, v], false, f));
    }
    moves
}

fn sine(chords: usize) -> Vec<Move> {
    let at = |index: usize| {
        let x = index as f64 * 0.1;
        [x, 3.0 * libm::sin(x / 2.0), 0.0]
    };
    (0..chords).map(|index| line(at(index), at(index + 1), 6000.0)).collect()
}

#[test]
fn no_slower_than_linuxcnc() {
    let straight = [line([0.0; 3], [200.0, 0.0, 0.0], 6000.0)];
    // Name, our time, LinuxCNC's, stops.
    let rows = [
        ("200 mm", seconds(0.01, &straight), 2.20, 1),
        ("square 10 times, exact", seconds(0.0, &square(10)), 20.48, 40),
        ("square 10 times", seconds(0.01, &square(10)), 20.02, 1),
        ("slot 5 times", seconds(0.01, &slot(5)), 11.40, 1),
        ("2001 chords", seconds(0.01, &sine(2001)), 8.03, 1),
        ("500 chords, exact", seconds(0.0, &sine(500)), 16.10, 500),
    ];
    for (name, ours, theirs, stops) in rows {
        println!("{name}: {ours:.3} s, LinuxCNC {theirs:.2} s");
        assert!(ours <= theirs + PERIOD_S * f64::from(stops), "{name}");
    }
}

/// The smooth curve's own optimum under these limits, found on a grid of 20,000 points, is 7.06 s.
#[test]
fn chords_are_driven_nearly_as_fast_as_their_curve_can_be() {
    assert!(seconds(0.01, &sine(2001)) <= 7.06 * 1.03);
}
