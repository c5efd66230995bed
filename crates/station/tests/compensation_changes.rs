//! What changes along a compensated contour: the radius, the side, what is read ahead, a mirror image, full circles.
//! Each block is held against one of a contour that stays as it is: its end depends on its own radius and on the element
//! that follows, on nothing before it.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::disallowed_methods)]

mod contour;
mod watch;

use std::f64::consts::TAU;

use contour::measure::{Form, Vector, add, apart, left_of, times};
use contour::program::{Bench, Corners, Job, Run, text, text_with};
use contour::samples::samples_asked;
use contour::{Contour, Element, generate};
use testkit::Random;

/// How many contours a test runs if not said otherwise.
const CONTOURS: u64 = 1500;
/// Lengths that must be the same differ by less than this, mm.
const SAME: f64 = 1e-9;

/// Walks of lines and arcs, every third one tangent, each with a choice for every element.
fn samples(first: u64) -> impl Iterator<Item = (Contour, Job, Vec<bool>, Random)> {
    (first..first + samples_asked(CONTOURS)).filter_map(|seed| {
        let mut random = Random::new(seed);
        let corners = random.pick(&[Corners::Arcs, Corners::Intersections]);
        let radius = (random.scaled(0.5, 20.0) * 1e3).round() / 1e3;
        let side = radius * random.pick(&[1.0, -1.0]);
        let contour = match seed % 3 {
            0 => generate::tangent_walk(&mut random, radius, side, 1000),
            _ => generate::walk(&mut random, radius, side, 1000),
        };
        let choices = contour.elements.iter().map(|_| random.pick(&[true, false])).collect();
        let fits = contour.is_whole() && contour.is_exact();
        fits.then(|| (contour, Job::new(side, corners), choices, random))
    })
}

/// Where the pieces of an element's block end.
fn stations(run: &Run, element: usize) -> Vec<Vector> {
    run.of(element).map(Form::to).collect()
}

/// One block ends as the other one: its main piece can have a length in one of them only.
fn same_end(one: &[Vector], other: &[Vector]) -> bool {
    let (short, long) = if one.len() < other.len() { (one, other) } else { (other, one) };
    let tail = &long[long.len() - short.len()..];
    long.len() <= short.len() + 1 && short.iter().zip(tail).all(|(one, other)| apart(*one, *other) < SAME)
}

/// A foot at the end of an element (1) or at its beginning (0), for a tool so far to its left.
fn foot(element: &Element, end: usize, side: f64) -> Vector {
    let form = element.form();
    add([form.from(), form.to()][end], times(left_of(form.tangents()[end]), side))
}

/// Compares the ends of all blocks that ran in both; how many.
fn compare<'r>(
    contour: &Contour,
    run: &Run,
    program: &str,
    expected: impl Fn(usize) -> Result<&'r Run, Vec<Vector>>,
) -> usize {
    let elements = contour.elements.len();
    let mut compared = 0;
    for element in 0..run.ran(elements) {
        let wanted = match expected(element) {
            Ok(other) if other.ran(elements) <= element => continue,
            Ok(other) => stations(other, element),
            Err(places) => places,
        };
        let found = stations(run, element);
        assert!(same_end(&found, &wanted), "element {element}: {found:?}, not {wanted:?}, in\n{program}");
        compared += 1;
    }
    compared
}

#[test]
fn a_block_that_stops_reading_ends_square_and_changes_no_other_end() {
    let (mut bench, mut stops, mut all) = (Bench::new(), 0, 0);
    for (contour, job, choices, _) in samples(1_000_000) {
        let words = |element: usize| if choices[element] { "M01" } else { "" };
        let program = text_with(&contour, job, words);
        let run = bench.run_text(&program, job, contour.elements.len() as i64);
        let plain = bench.run(&contour, job);
        all += compare(&contour, &run, &program, |element| match choices[element] {
            false => Ok(&plain),
            true => Err(vec![foot(&contour.elements[element], 1, job.side())]),
        });
        stops += choices.iter().filter(|stops| **stops).count();
    }
    assert!(all > 3000 && stops > 1500, "{all} ends, {stops} stops");
}

#[test]
fn a_new_radius_acts_from_its_own_block_on() {
    let (mut bench, mut all) = (Bench::new(), 0);
    for (contour, job, choices, mut random) in samples(2_000_000) {
        let second = (job.offset * random.pick(&[0.3, 0.8, 1.1, 1.7]) * 1e3).round() / 1e3;
        bench.set_second_offset(second);
        let words = |element: usize| if choices[element] { "D02" } else { "D01" };
        let program = text_with(&contour, job, words);
        let run = bench.run_text(&program, job, contour.elements.len() as i64);
        let [one, other] = [job.offset, second].map(|offset| bench.run(&contour, Job { offset, ..job }));
        all += compare(&contour, &run, &program, |element| Ok(if choices[element] { &other } else { &one }));
    }
    assert!(all > 3000, "{all} ends");
}

#[test]
fn a_new_side_is_gone_over_to_from_square_ends() {
    let (mut bench, mut changes, mut all) = (Bench::new(), 0, 0);
    for (contour, job, choices, _) in samples(3_000_000) {
        let words = |element: usize| if choices[element] { "G42" } else { "G41" };
        // The way onto the contour is on the first element's side.
        let job = Job { right: choices[0], ..job };
        let program = text_with(&contour, job, words);
        let run = bench.run_text(&program, job, contour.elements.len() as i64);
        let [left, right] = [false, true].map(|right| Job { right, ..job });
        let runs = [left, right].map(|job| bench.run(&contour, job));
        let of = |element: usize| usize::from(choices[element]);
        let side = |element: usize| [left, right][of(element)].side();
        all += compare(&contour, &run, &program, |element| {
            let next = contour.elements.get(element + 1);
            let Some(next) = next.filter(|_| choices[element] != choices[element + 1]) else {
                return Ok(&runs[of(element)]);
            };
            let own = &contour.elements[element];
            let mut places = vec![foot(own, 1, side(element))];
            if own.round.is_some() || next.round.is_some() {
                places.push(foot(next, 0, side(element + 1)));
            }
            Err(places)
        });
        changes += choices.windows(2).filter(|pair| pair[0] != pair[1]).count();
    }
    assert!(all > 3000 && changes > 1500, "{all} ends, {changes} changes");
}

#[test]
fn a_mirror_image_of_the_mirrored_contour_is_the_contour() {
    let [mut bench, mut mirroring] = [Bench::new(), Bench::mirroring()];
    let mut all = 0;
    for (contour, job, ..) in samples(4_000_000) {
        let program =
            text(&contour.mirrored(), Job { right: !job.right, ..job }).replacen("\nG94\n", "\nG94\nM95\n", 1);
        let run = mirroring.run_text(&program, job, contour.elements.len() as i64);
        let plain = bench.run(&contour, job);
        assert_eq!(run.alarm, plain.alarm, "in\n{program}");
        let pairs = run.pieces.iter().zip(&plain.pieces);
        let same = pairs.filter(|(one, other)| apart(one.form.to(), other.form.to()) < SAME).count();
        assert!(same == plain.pieces.len() && same == run.pieces.len(), "{same} pieces are the same in\n{program}");
        all += same;
    }
    assert!(all > 3000, "{all} pieces");
}

#[test]
fn a_full_circle_in_an_arc_is_a_full_circle_beside_it() {
    let (mut bench, mut all) = (Bench::new(), 0);
    for (contour, job, _, mut random) in samples(5_000_000) {
        let halved = contour.split().0;
        // Where two halves of an arc meet.
        let meet = |pair: &[Element]| pair[0].round.is_some() && pair[0].round == pair[1].round;
        let places: Vec<usize> =
            halved.elements.windows(2).enumerate().filter(|(_, pair)| meet(pair)).map(|(index, _)| index + 1).collect();
        if places.is_empty() {
            continue;
        }
        let place = random.pick(&places);
        let next = halved.elements[place];
        let mut circled = halved.clone();
        circled.elements.insert(place, Element { to: next.from, ..next });
        let (plain, run) = (bench.run(&halved, job), bench.run(&circled, job));
        if plain.alarm.is_some() {
            continue;
        }
        let program = text(&circled, job);
        assert_eq!(run.alarm, None, "in\n{program}");
        let round: Vec<&Form> = run.of(place).collect();
        let [Form::Arc(bow)] = round[..] else { panic!("{round:?} in\n{program}") };
        let center = bow.center;
        let sweep = if next.round.unwrap().ccw { TAU } else { -TAU };
        assert!((bow.sweep - sweep).abs() < SAME && apart(bow.from, bow.to) < SAME, "{bow:?} in\n{program}");
        assert!(apart(center, contour::mm(next.round.unwrap().center)) < SAME, "{bow:?} in\n{program}");
        let rest = run.pieces.iter().filter(|piece| piece.element != place as i64);
        let same = rest.zip(&plain.pieces).filter(|(one, other)| apart(one.form.to(), other.form.to()) < SAME).count();
        assert_eq!([same, run.pieces.len()], [plain.pieces.len(), plain.pieces.len() + 1], "in\n{program}");
        all += 1;
    }
    assert!(all > 100, "{all} circles");
}
