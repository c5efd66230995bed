//! The planner's times beside the shortest ones possible on the very path that it drives.

mod course;

use std::f64::consts::{PI, TAU};

use base::Point;
use course::oracle::{Piece, optimum};
use course::{arc, drive, feed, limits, line, point};
use meaning::{ArcMove, Plane};
use motion::{Limits, Move, Way};
use path::Arc;

/// Longer than the optimum by this at most: any path, and a single move.
const ANY: f64 = 1.03;
const SINGLE: f64 = 1.001;
/// What the grid of the optimum may be off.
const GRID: f64 = 2e-3;

/// Machines: three equal axes; axes of unlike limits, two of them rotary.
fn alike(tolerance: f64) -> Limits {
    limits(200.0, 500.0, tolerance)
}

fn unlike(tolerance: f64) -> Limits {
    let mut unlike = alike(tolerance);
    for (axis, (max_feed, acceleration)) in
        [(200.0, 500.0), (120.0, 1500.0), (60.0, 200.0), (30.0, 100.0), (90.0, 800.0)].into_iter().enumerate()
    {
        (unlike.axes[axis].max_feed, unlike.axes[axis].acceleration) = (max_feed, acceleration);
    }
    unlike.count = 5;
    unlike
}

fn curve(count: usize, f: f64, at: impl Fn(f64) -> [f64; 3]) -> Vec<Move> {
    let at = |index: usize| at(index as f64 / count as f64);
    (0..count).map(|index| line(at(index), at(index + 1), f)).collect()
}

fn polygon(corners: &[[f64; 3]], f: f64) -> Vec<Move> {
    corners.windows(2).map(|ends| line(ends[0], ends[1], f)).collect()
}

/// Two lines of 30 mm that meet at an angle, degrees off straight on.
fn corner(degrees: f64, f: f64) -> Vec<Move> {
    let turn = degrees.to_radians();
    polygon(&[[0.0; 3], [30.0, 0.0, 0.0], [30.0 + 30.0 * turn.cos(), 30.0 * turn.sin(), 0.0]], f)
}

/// From (radius, 0) by an angle, to another radius and height.
fn round(radius: f64, degrees: f64, [end_radius, height]: [f64; 2], f: f64) -> Vec<Move> {
    let angle = degrees.to_radians();
    let from = point([radius, 0.0, 0.0]);
    let mut to = point([end_radius * angle.cos(), end_radius * angle.sin(), height]);
    let full_circle = degrees == 360.0;
    if full_circle {
        (to[0], to[1]) = (from[0], from[1]);
    }
    let arc = ArcMove { to, plane: Plane::Xy, axes: [0, 1], center: [0.0; 2], clockwise: false, full_circle };
    let arc = Arc::new(&from, &arc);
    let way = Way::arc(&arc);
    vec![Move { way, feed: feed(f), share: way.length() / arc.plane_length(), stops: false }]
}

fn contour(f: f64) -> Vec<Move> {
    vec![
        line([0.0; 3], [40.0, 0.0, 0.0], f),
        arc([40.0, 0.0, 0.0], [50.0, 10.0, 0.0], [40.0, 10.0], false, f),
        line([50.0, 10.0, 0.0], [50.0, 30.0, 0.0], f),
        arc([50.0, 30.0, 0.0], [55.0, 35.0, 0.0], [55.0, 30.0], true, f),
        line([55.0, 35.0, 0.0], [70.0, 40.0, 0.0], f),
        line([70.0, 40.0, 0.0], [70.0, 60.0, 2.0], f),
        arc([70.0, 60.0, 2.0], [66.0, 62.0, 2.0], [67.5, 59.99], false, f),
        line([66.0, 62.0, 2.0], [0.0, 60.0, 0.0], f),
    ]
}

/// Round a square with rounded corners, lines and arcs by turns.
fn rounded_square(f: f64) -> Vec<Move> {
    let mut moves = Vec::new();
    for side in 0..8 {
        let turned = |[x, y]: [f64; 2]| match side % 4 {
            0 => [x, y, 0.0],
            1 => [-y, x, 0.0],
            2 => [-x, -y, 0.0],
            _ => [y, -x, 0.0],
        };
        let [u, v, _] = turned([5.0, -5.0]);
        moves.push(line(turned([-5.0, -8.0]), turned([5.0, -8.0]), f));
        moves.push(arc(turned([5.0, -8.0]), turned([8.0, -5.0]), [u, v], false, f));
    }
    moves
}

fn rotary() -> Vec<Move> {
    let five = |values: [f64; 5]| -> Point {
        let mut point = [0.0; base::AXES];
        point[..5].copy_from_slice(&values);
        point
    };
    let ends = [[0.0; 5], [10.0, 5.0, 1.0, 20.0, -3.0], [25.0, 5.0, 4.0, 35.0, -20.0], [25.0, -15.0, 4.0, 35.0, 30.0]];
    let at = |ends: &[[f64; 5]]| Way::line(&five(ends[0]), &five(ends[1]), 5);
    ends.windows(2).map(|ends| Move { way: at(ends), feed: feed(20_000.0), share: 1.0, stops: false }).collect()
}

/// A path: its name, what the axes can do, and its moves.
type Path = (&'static str, Limits, Vec<Move>);

/// Name, machine, moves; single moves from rest to rest first.
fn paths() -> (Vec<Path>, usize) {
    let (even, uneven) = (alike(0.01), unlike(0.01));
    let diagonal = || vec![line([0.0; 3], [40.0, 25.0, -30.0], 60_000.0)];
    let singles = vec![
        ("line that reaches its feed", even, vec![line([0.0; 3], [200.0, 0.0, 0.0], 6000.0)]),
        ("line that does not", even, vec![line([0.0; 3], [5.0, 0.0, 0.0], 6000.0)]),
        ("diagonal of space, unlike axes", uneven, diagonal()),
        ("arc of 90°, r 10", even, round(10.0, 90.0, [10.0, 0.0], 6000.0)),
        ("arc of 30°, r 0.5", even, round(0.5, 30.0, [0.5, 0.0], 6000.0)),
        ("arc of 5°, r 300", even, round(300.0, 5.0, [300.0, 0.0], 6000.0)),
        ("arc of 200°, r 40, unlike axes", uneven, round(40.0, 200.0, [40.0, 0.0], 60_000.0)),
        ("full circle, r 25", even, round(25.0, 360.0, [25.0, 0.0], 60_000.0)),
        ("full circle, r 25, unlike axes", uneven, round(25.0, 360.0, [25.0, 0.0], 60_000.0)),
        ("full circle, r 25, F1000", even, round(25.0, 360.0, [25.0, 0.0], 1000.0)),
        ("helix", even, round(15.0, 300.0, [15.0, 12.0], 10_000.0)),
        ("helix, unlike axes", uneven, round(15.0, 360.0, [15.0, 40.0], 10_000.0)),
        ("spiral", even, round(5.0, 300.0, [30.0, 0.0], 10_000.0)),
        ("steep spiral, unlike axes", uneven, round(1.0, 200.0, [60.0, 5.0], 10_000.0)),
    ];
    let count = singles.len();
    let sine = |x: f64| [60.0 * x, 3.0 * (30.0 * x).sin(), 0.0];
    let wave = |x: f64| [40.0 * x, 12.0 * (TAU * x).cos(), 5.0 * (3.0 * PI * x).sin()];
    let zigzag: Vec<_> = (0..20).map(|n| [f64::from(n) * 2.0, f64::from(n % 2) * 1.5, 0.0]).collect();
    let more = vec![
        ("corner of 1°", even, corner(1.0, 6000.0)),
        ("corner of 15°", even, corner(15.0, 6000.0)),
        ("corner of 45°", even, corner(45.0, 6000.0)),
        ("corner of 90°", even, corner(90.0, 6000.0)),
        ("corner of 135°", even, corner(135.0, 6000.0)),
        ("corner of 145°, unlike axes", uneven, corner(145.0, 6000.0)),
        ("corner of 60°, tolerance 0.1", unlike(0.1), corner(60.0, 20_000.0)),
        ("zigzag", even, polygon(&zigzag, 6000.0)),
        ("chords of a sine, 0.1 mm", even, curve(600, 6000.0, sine)),
        ("chords of a sine, 1 mm", even, curve(60, 6000.0, sine)),
        ("chords of a sine, unlike axes", uneven, curve(600, 60_000.0, sine)),
        ("chords of a curve of space", uneven, curve(300, 10_000.0, wave)),
        ("contour of lines and arcs", even, contour(6000.0)),
        ("contour, F60000, tolerance 0.05", alike(0.05), contour(60_000.0)),
        ("contour, unlike axes", uneven, contour(6000.0)),
        ("rounded square", even, rounded_square(6000.0)),
        ("rounded square, unlike axes", uneven, rounded_square(6000.0)),
        ("rounded square, F1000", even, rounded_square(1000.0)),
        ("line into an arc and out", even, contour(3000.0)[..3].to_vec()),
        ("five axes, two of them rotary", uneven, rotary()),
    ];
    (singles.into_iter().chain(more).collect(), count)
}

/// Our time, and the shortest one on the path that we drive.
fn times(limits: &Limits, moves: &[Move]) -> [f64; 2] {
    let mut pieces: Vec<Piece> = Vec::new();
    let asked = moves[0].feed.mm_per_min / 60.0 * moves[0].share;
    let ours = drive(limits, moves, |way, leg| {
        let end = leg.at(leg.seconds).0;
        match pieces.last_mut() {
            Some(last) if last.way == *way => last.part[1] = end,
            _ => pieces.push(Piece { way: *way, part: [leg.s, end], feed: asked }),
        }
    });
    [ours.iter().sum(), optimum(limits, &pieces)]
}

#[test]
fn near_the_optimum() {
    let (paths, singles) = paths();
    let mut missed = Vec::new();
    println!("{:34} {:>10} {:>10} {:>8}", "path", "ours, s", "optimum, s", "ratio");
    for (index, (name, limits, moves)) in paths.iter().enumerate() {
        let [ours, shortest] = times(limits, moves);
        let ratio = ours / shortest;
        println!("{name:34} {ours:10.5} {shortest:10.5} {ratio:8.5}");
        let most = if index < singles { SINGLE } else { ANY };
        if !(1.0 - GRID..=most).contains(&ratio) {
            missed.push(format!("{name}: {ratio:.5}, at most {most}"));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}
