//! The last digits of corner points: how far each lies beside the offsets of the two elements that meet there, in
//! numbers of twice the usual length. Elements of 1 µm beside such of 1 m, up to a kilometre from the origin, corners
//! that are nearly none and such that nearly turn back.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::disallowed_methods)]

mod contour;
mod watch;

use std::f64::consts::{FRAC_PI_2, PI};

use contour::claims::TANGENT;
use contour::double::Double;
use contour::measure::{Form, Vector, add, times, toward};
use contour::program::{Bench, Corners, Job, Run, text};
use contour::samples::samples_asked;
use contour::{Contour, Element, Place, generate};
use testkit::Random;

/// How many pairs of elements are run if not said otherwise.
const CORNERS: u64 = 20_000;

/// How far a corner point may lie beside an offset element, mm.
fn bound(at: Vector) -> f64 {
    1e-9 * (at[0].abs().max(at[1].abs()) / 1e4).max(1.0)
}

/// From a place to a point, nm, without rounding.
fn way(from: Place, point: Vector) -> [Double; 2] {
    [0, 1].map(|axis| Double::product(point[axis], 1e6).minus(Double::whole(i128::from(from[axis]))))
}

fn whole(way: Place) -> [Double; 2] {
    way.map(|nm| Double::whole(i128::from(nm)))
}

fn between(from: Place, to: Place) -> Place {
    [to[0] - from[0], to[1] - from[1]]
}

fn scalar(a: [Double; 2], b: [Double; 2]) -> Double {
    a[0].times(b[0]).plus(a[1].times(b[1]))
}

fn long(a: [Double; 2]) -> Double {
    scalar(a, a).root()
}

/// How far a point is to the left of the line through `at` along `direction`, less `side`: mm.
fn beside_line(at: Place, direction: Place, side: f64, point: Vector) -> f64 {
    let (way, direction) = (way(at, point), whole(direction));
    let height = direction[0].times(way[1]).minus(direction[1].times(way[0])).over(long(direction));
    height.minus(Double::product(side, 1e6)).value().abs() / 1e6
}

/// The direction of an element at one of its ends, without rounding.
fn direction(element: &Element, at: Place) -> Place {
    match element.round {
        None => between(element.from, element.to),
        Some(round) => {
            let [x, y] = between(round.center, at);
            if round.ccw { [-y, x] } else { [y, -x] }
        }
    }
}

/// The angle from one direction to another, radians, + left, and its sine.
fn turn(directions: [Place; 2]) -> (f64, f64) {
    let [a, b] = directions.map(|way| way.map(i128::from));
    let (across, along) = ((a[0] * b[1] - a[1] * b[0]) as f64, (a[0] * b[0] + a[1] * b[1]) as f64);
    (across.atan2(along), across / across.hypot(along))
}

/// How far a point lies beside the offset of an element, mm.
fn beside(element: &Element, side: f64, point: Vector) -> f64 {
    let Some(round) = element.round else {
        return beside_line(element.from, direction(element, element.from), side, point);
    };
    let side = Double::product(if round.ccw { -side } else { side }, 1e6);
    let radius = long(whole(between(round.center, element.from))).plus(side);
    long(way(round.center, point)).minus(radius).value().abs() / 1e6
}

/// The worst of a run.
#[derive(Default)]
struct Worst {
    corners: usize,
    inside: usize,
    tangent: usize,
    /// Residuals over their bounds: the worst.
    share: f64,
    told: String,
}

impl Worst {
    fn take(&mut self, residual: f64, at: Vector, what: &str, program: impl Fn() -> String) {
        let share = residual / bound(at);
        assert!(share.is_finite(), "{what} at {at:?}\n{}", program());
        if share > self.share {
            self.share = share;
            self.told = format!("{what} at {at:?}: {residual:e} mm beside\n{}", program());
        }
    }

    /// Looks at the ends of every piece along an element, and at the points of every corner.
    fn see(&mut self, contour: &Contour, job: Job, run: &Run) {
        let program = || format!("offset 1 = {}\n{}", job.offset, text(contour, job));
        let side = job.side();
        for (index, element) in contour.elements.iter().enumerate().take(run.ran(contour.elements.len())) {
            let pieces: Vec<Form> = run.of(index).copied().collect();
            // An element that both corners take up to the last digit has no piece; what comes before and after it is seen.
            if pieces.is_empty() {
                continue;
            }
            for end in [pieces[0].from(), pieces[0].to()] {
                self.take(beside(element, side, end), end, "along an element", program);
            }
            let Some(next) = contour.elements.get(index + 1) else { continue };
            self.corners += 1;
            let (turn, sine) = turn([direction(element, element.to), direction(next, element.to)]);
            let is_back = sine.abs() <= 1e-9 && turn.abs() > 1.0;
            if (2.0 * side * (turn / 2.0).sin()).abs() < TANGENT {
                self.tangent += 1;
                self.take(beside(next, side, pieces[0].to()), pieces[0].to(), "tangent", program);
            } else if turn * side > 0.0 && !is_back {
                self.inside += 1;
                self.take(beside(next, side, pieces[0].to()), pieces[0].to(), "inside", program);
            } else {
                self.outside(element, next, job, &pieces, program);
            }
        }
    }

    /// The points of an outside corner lie on the lines beside the tangents there.
    fn outside(&mut self, element: &Element, next: &Element, job: Job, pieces: &[Form], program: impl Fn() -> String) {
        let at = element.to;
        let directions = [direction(element, at), direction(next, at)];
        for piece in pieces {
            let point = piece.to();
            if job.corners == Corners::Arcs {
                // A foot is as far from the corner as the radius, and square to one of the elements.
                let spoke = way(at, point);
                let from_corner = long(spoke).minus(Double::product(job.offset.abs(), 1e6)).value().abs() / 1e6;
                let along = |&way: &Place| (scalar(spoke, whole(way)).over(long(whole(way))).value() / 1e6).abs();
                let along = directions.iter().map(along).fold(f64::INFINITY, f64::min);
                self.take(from_corner.max(along), point, "foot", &program);
                continue;
            }
            let lines = directions.map(|direction| beside_line(at, direction, job.side(), point));
            self.take(lines[0].min(lines[1]), point, "outside", &program);
            // The last point of an obtuse corner without arcs is the one where both lines meet.
            if turn(directions).0.abs() < FRAC_PI_2 - 1e-9 && element.round.is_none() && next.round.is_none() {
                self.take(lines[0].max(lines[1]), point, "intersection", &program);
            }
        }
    }
}

fn length(random: &mut Random) -> f64 {
    match random.below(4) {
        0 => 0.001,
        1 => 1000.0,
        _ => random.scaled(0.001, 1000.0),
    }
}

/// Two elements that meet at a corner of some kind, `far` mm from the origin.
fn pair(random: &mut Random, radius: f64, side: f64, far: f64) -> Option<Contour> {
    let angle = random.between(-PI, PI);
    let corner = [0, 1].map(|axis| ((far * toward(angle)[axis]) * 1e3).round() as i64 * 1000);
    let heading = random.between(-PI, PI);
    let turn = match random.below(5) {
        0 => random.scaled(1e-7, 1e-2),
        1 => PI - random.scaled(1e-7, 1e-2),
        _ => random.between(0.0, PI),
    } * random.pick(&[1.0, -1.0]);
    let inside = turn * side > 0.0;
    let mut size = || {
        let length = length(random);
        // Where the tool must stay short of an inside corner, the elements leave it room.
        if inside { length.max((1.1 * radius * (turn.abs() / 2.0).tan()).min(1000.0)) } else { length }
    };
    let sizes = [size(), size()];
    let step = |mm: f64, heading: f64| times(toward(heading), mm).map(|mm| (mm * 1e3).round() as i64 * 1000);
    let mut make = |size: f64, heading: f64, back: bool| {
        let sweep = random.scaled(0.01, 3.0) * random.pick(&[1.0, -1.0]);
        if size > 0.2 && random.chance(0.5) {
            // Of an arc that ends at the corner, first the way backwards from it.
            let (sweep, heading) = if back { (-sweep, heading + PI) } else { (sweep, heading) };
            let arc = generate::exact_arc(corner, times(toward(heading + sweep / 2.0), size), sweep, 1000)?;
            return Some(if back { arc.backwards() } else { arc });
        }
        let step = step(size, heading);
        let other = [0, 1].map(|axis| corner[axis] + if back { -step[axis] } else { step[axis] });
        Some(if back { Element::line(other, corner) } else { Element::line(corner, other) })
    };
    let elements = vec![make(sizes[0], heading, true)?, make(sizes[1], heading + turn, false)?];
    Some(Contour { elements }).filter(Contour::is_exact)
}

#[test]
fn corner_points_are_right_to_their_last_digits() {
    let (bench, mut worst, mut ran) = (&mut Bench::new(), Worst::default(), 0);
    let all = samples_asked(CORNERS);
    for seed in 0..all {
        let random = &mut Random::new(0xC0_0000 + seed);
        let radius = (random.scaled(0.01, 900.0) * 1e3).round() / 1e3;
        let side = radius * random.pick(&[1.0, -1.0]);
        let far = random.pick(&[0.0, 1.0, 1e2, 1e4, 1e5, 1e6]);
        let corners = random.pick(&[Corners::Arcs, Corners::Intersections]);
        let Some(contour) = pair(random, radius, side, far) else { continue };
        let job = Job { incremental: true, ..Job::new(side, corners) };
        let run = bench.run(&contour, job);
        assert!(run.alarm.is_none() || run.is_interference(), "{:?}\n{}", run.alarm, text(&contour, job));
        ran += usize::from(run.alarm.is_none());
        worst.see(&contour, job, &run);
    }
    let Worst { corners, inside, tangent, share, told } = worst;
    println!("{corners} corners, {inside} inside, {tangent} tangent; {ran} of {all} without alarm");
    println!("the worst has {share:.3} of what is allowed: {told}");
    assert!(share <= 1.0, "{told}");
    let (inside, tangent) = (inside as u64, tangent as u64);
    assert!(
        ran as u64 * 2 > all && inside * 10 > all && tangent * 100 > all,
        "{ran} ran, {inside} inside, {tangent} tangent"
    );
}

/// The measure itself sees a billionth of a millimetre.
#[test]
fn a_point_beside_its_place_is_seen() {
    let line = Element::line([999_999_999_000_000, 5_000_000], [1_000_000_000_000_000, 5_001_000]);
    let on = add(line.form().from(), [0.0, 3.0]);
    assert!(beside(&line, 3.0, on) < 2e-2, "the measure is of the right size");
    let arc = Element::arc([5_000_000, 0], [0, 5_000_000], [0, 0], true);
    assert!(beside(&arc, 2.0, [3.0, 0.0]) < 1e-30);
    let seen = beside(&arc, 2.0, [3.0 + 1e-9, 0.0]);
    assert!((seen - 1e-9).abs() < 1e-15, "{seen:e}");
}
