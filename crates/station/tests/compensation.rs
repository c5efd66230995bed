//! Tool radius compensation: random contours through the whole control, judged by geometry of the tests' own.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::disallowed_methods)]

mod contour;
mod watch;

use base::Condition;
use contour::claims::{Cut, Seen, check, cuts, same_path};
use contour::measure::{Form, Vector, add, apart, left_of, minus, times};
use contour::program::{Bench, Beside, Corners, Job, Piece, Run, text};
use contour::samples::samples_asked;
use contour::{Contour, generate};
use testkit::Random;

/// How many contours of each kind a test runs if not said otherwise.
const CONTOURS: u64 = 1500;

/// A contour and how it is run.
#[derive(Clone, Debug)]
struct Sample {
    contour: Contour,
    job: Job,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum Kind {
    Walk,
    Tangent,
    Rounded,
    Closed,
}

fn radius(random: &mut Random) -> f64 {
    (random.scaled(0.5, 20.0) * 1e3).round() / 1e3
}

/// The same seed makes the same sample. Coordinates are whole multiples of `unit` nm.
fn sample(seed: u64, kind: Kind, unit: i64) -> Sample {
    let random = &mut Random::new(seed);
    let corners = random.pick(&[Corners::Arcs, Corners::Intersections]);
    let side = radius(random) * random.pick(&[1.0, -1.0]);
    let contour = match kind {
        Kind::Walk => generate::walk(random, side.abs(), side, unit),
        Kind::Tangent => generate::tangent_walk(random, side.abs(), side, unit),
        Kind::Rounded => generate::rounded_walk(random, side.abs(), side),
        Kind::Closed => {
            let size = side.abs() * random.scaled(1.5, 20.0);
            generate::closed(random, size, unit).gone_round()
        }
    };
    Sample { contour, job: Job::new(side, corners) }
}

/// The samples of one kind that can be run.
fn samples(kind: Kind, unit: i64) -> impl Iterator<Item = Sample> {
    let first = 100_000_000 * kind as u64;
    let fits = move |sample: &Sample| sample.contour.is_whole() && (kind == Kind::Rounded || sample.contour.is_exact());
    (first..first + samples_asked(CONTOURS)).map(move |seed| sample(seed, kind, unit)).filter(fits)
}

/// The shortest run of elements that still fails: what is said of it, and its program.
fn smallest<B>(bench: &mut B, sample: &Sample, fails: impl Fn(&mut B, &Sample) -> Option<String>) -> String {
    let elements = sample.contour.elements.len();
    for count in 1..=elements {
        for first in 0..=elements - count {
            let part = Sample { contour: sample.contour.part(first..first + count), ..*sample };
            if let Some(why) = fails(bench, &part) {
                return format!("{why}\noffset 1 = {}\n{}", part.job.offset, text(&part.contour, part.job));
            }
        }
    }
    "it holds of every part".to_owned()
}

/// The control as it comes, and one that refuses to cut into what is near.
struct Benches {
    lenient: Bench,
    strict: Bench,
}

impl Benches {
    fn new() -> Benches {
        Benches { lenient: Bench::new(), strict: Bench::strict() }
    }
}

fn claim_fails(benches: &mut Benches, sample: &Sample) -> Option<String> {
    let Sample { contour, job } = sample;
    let [run, strict] = [benches.lenient.run(contour, *job), benches.strict.run(contour, *job)];
    if let Some(run) = [&run, &strict].into_iter().find(|run| run.alarm.is_some() && !run.is_interference()) {
        return Some(format!("alarm {:?}", run.alarm));
    }
    if let Err(why) = check(contour, *job, &run).and_then(|_| check(contour, *job, &strict)) {
        return Some(why);
    }
    // The elements that lead to a contour and away from it may be cut.
    let is_inner = |cut: &&Cut| cut.other > 0 && cut.other + 1 < contour.elements.len();
    if let Some(cut) = cuts(contour, *job, &strict, 1).iter().find(is_inner) {
        let is_main = run.of(cut.element).next().is_some_and(|main| main.distance(cut.at) < 1e-9);
        let part = if is_main { "main piece" } else { "corner" };
        return Some(format!("not seen of the {part}: {cut:?} {:?}", job.corners));
    }
    // What one refuses because it would cut, the other does, if it comes so far.
    let elements = contour.elements.len();
    let is_cut = matches!(strict.alarm, Some((Condition::ElementCut, _))) && run.ran(elements) > strict.ran(elements);
    (is_cut && cuts(contour, *job, &run, 2).is_empty())
        .then(|| format!("refused, but nothing is cut: {:?}", strict.alarm))
}

/// Runs all samples of a kind and holds every claim against them; how many ran to their end, of how many.
fn hold(kind: Kind) -> (usize, usize, Seen) {
    let benches = &mut Benches::new();
    let (mut whole, mut all, mut cut, mut seen) = (0, 0, 0, Seen::default());
    let mut failures = Failures::default();
    for sample in samples(kind, 1000) {
        all += 1;
        if let Some(why) = claim_fails(benches, &sample) {
            failures.take(why, sample);
            continue;
        }
        let run = benches.strict.run(&sample.contour, sample.job);
        seen.count(check(&sample.contour, sample.job, &run).expect("it held just now"));
        whole += usize::from(run.alarm.is_none());
        cut += usize::from(matches!(run.alarm, Some((Condition::ElementCut, _))));
    }
    println!("{kind:?}: {whole} of {all} ran to their end, {cut} would have cut, {seen:?}");
    failures.report(benches, claim_fails);
    (whole, all, seen)
}

/// What did not hold, told apart by the words of its sentence.
#[derive(Default)]
struct Failures(Vec<(String, usize, Sample)>);

impl Failures {
    fn take(&mut self, why: String, sample: Sample) {
        let words = why.split(|c: char| !c.is_ascii_alphabetic()).filter(|word| word.len() > 1).take(9);
        let kind = words.filter(|word| !word.contains("Cut")).collect::<Vec<_>>().join(" ");
        match self.0.iter_mut().find(|known| known.0 == kind) {
            Some(known) => {
                known.1 += 1;
                if sample.contour.elements.len() < known.2.contour.elements.len() {
                    known.2 = sample;
                }
            }
            None => self.0.push((kind, 1, sample)),
        }
    }

    /// Fails, if anything did, with the smallest program of each kind of failure.
    fn report<B>(&self, bench: &mut B, fails: impl Fn(&mut B, &Sample) -> Option<String>) {
        let mut report = String::new();
        for (_, times, sample) in &self.0 {
            report += &format!("\n{times} times: {}", smallest(bench, sample, &fails));
        }
        assert!(report.is_empty(), "{report}");
    }
}

#[test]
fn the_tool_keeps_its_distance_from_lines_and_arcs() {
    let (whole, all, seen) = hold(Kind::Walk);
    assert!(whole * 4 > all, "{whole} of {all} without interference");
    assert!(seen.inside > 500 && seen.outside > 2000, "{seen:?}");
}

#[test]
fn the_tool_keeps_its_distance_where_elements_are_tangent() {
    let (whole, all, seen) = hold(Kind::Tangent);
    assert!(whole * 4 > all && seen.tangent > 2000, "{whole} of {all}, {seen:?}");
}

#[test]
fn the_tool_keeps_its_distance_from_rounded_arcs() {
    let (whole, all, seen) = hold(Kind::Rounded);
    assert!(whole * 4 > all && seen.elements > 2000, "{whole} of {all}, {seen:?}");
}

/// The checks themselves see a path that is two millionths beside its place, at the end of any piece.
#[test]
fn a_path_beside_its_place_is_seen() {
    let (bench, mut seen, mut all) = (&mut Bench::new(), 0, 0);
    for sample in samples(Kind::Walk, 1000).chain(samples(Kind::Closed, 1000)) {
        let Sample { contour, job } = &sample;
        let run = bench.run(contour, *job);
        for index in 0..run.pieces.len() {
            let mut spoilt = run.clone();
            let Piece { element, form: Form::Line(from, to) } = spoilt.pieces[index] else { continue };
            // The way on and off is not judged, nor is a block before an alarm.
            if element < 0 || element as usize >= contour.elements.len() || apart(from, to) < 1e-3 {
                continue;
            }
            let aside = times(left_of(minus(to, from)), 2.1e-6 / apart(from, to));
            spoilt.pieces[index].form = Form::Line(from, add(to, aside));
            all += 1;
            seen += usize::from(check(contour, *job, &spoilt).is_err());
        }
    }
    assert!(seen == all && all > 5000, "{seen} of {all} are seen");
}

#[test]
fn the_tool_keeps_its_distance_on_the_other_control() {
    let (bench, mut failures, mut whole, mut all) = (&mut Bench::other(), Failures::default(), 0, 0);
    let fails = |bench: &mut Bench, sample: &Sample| {
        let run = bench.run(&sample.contour, sample.job);
        let stranger = run.alarm.filter(|_| !run.is_interference()).map(|alarm| format!("alarm {alarm:?}"));
        stranger.or_else(|| check(&sample.contour, sample.job, &run).err())
    };
    for sample in [Kind::Walk, Kind::Tangent, Kind::Closed].into_iter().flat_map(|kind| samples(kind, 1000)) {
        let sample = Sample { job: Job { corners: Corners::Unsaid, ..sample.job }, ..sample };
        all += 1;
        match fails(bench, &sample) {
            Some(why) => failures.take(why, sample),
            None => whole += usize::from(bench.run(&sample.contour, sample.job).alarm.is_none()),
        }
    }
    println!("{whole} of {all} ran to their end");
    failures.report(bench, fails);
    assert!(whole * 2 > all, "{whole} of {all}");
}

#[test]
fn the_tool_keeps_its_distance_from_closed_contours() {
    let (whole, all, seen) = hold(Kind::Closed);
    assert!(whole * 3 > all && seen.inside > 1000 && seen.outside > 1000, "{whole} of {all}, {seen:?}");
}

/// A variant of a sample, and how a form of the sample's path is seen in it.
type Variant = (&'static str, Sample, fn(Vector) -> Vector);

/// Two runs are one and the same, seen through a map of the plane: what is different.
fn differs(one: &Run, other: &Run, map: fn(Vector) -> Vector) -> Option<String> {
    if one.alarm != other.alarm || one.pieces.len() != other.pieces.len() {
        let [a, b] = [one, other].map(|run| (run.alarm, run.pieces.len()));
        return Some(format!("{a:?} and {b:?}"));
    }
    let moved = |one: &Piece, other: &Piece| {
        let ends = [(one.form.from(), other.form.from()), (one.form.to(), other.form.to())];
        let centers = match (one.form, other.form) {
            (Form::Line(..), Form::Line(..)) => 0.0,
            (Form::Arc(a), Form::Arc(b)) => apart(map(a.center), b.center).max((a.sweep.abs() - b.sweep.abs()).abs()),
            _ => f64::INFINITY,
        };
        ends.iter().map(|&(one, other)| apart(map(one), other)).fold(centers, f64::max)
    };
    let mut pairs = one.pieces.iter().zip(&other.pieces);
    let (a, b) = pairs.find(|(a, b)| a.element != b.element || moved(a, b) > SAME)?;
    Some(format!("{a:?} and {b:?}"))
}

/// Lengths in two runs that must be the same differ by less than this, mm.
const SAME: f64 = 1e-9;

fn variants(sample: &Sample) -> Vec<Variant> {
    let Sample { contour, job } = sample;
    let other_side = Job { right: !job.right, ..*job };
    let with = |contour: Contour, job: Job| Sample { contour, job };
    vec![
        ("turned over", with(contour.mirrored(), other_side), |[x, y]| [-x, y]),
        ("turned by 90 degrees", with(contour.turned(1), *job), |[x, y]| [-y, x]),
        ("turned by 180 degrees", with(contour.turned(2), *job), |[x, y]| [-x, -y]),
        ("turned by 270 degrees", with(contour.turned(3), *job), |[x, y]| [y, -x]),
        (
            "the other code with a negative radius",
            with(contour.clone(), Job { offset: -job.offset, ..other_side }),
            |at| at,
        ),
        ("with the third axis", with(contour.clone(), Job { beside: Beside::Third, ..*job }), |at| at),
        ("with lines at rapid rate", with(contour.clone(), Job { beside: Beside::Rapid, ..*job }), |at| at),
        ("with dwells between", with(contour.clone(), Job { beside: Beside::Block("G04P10"), ..*job }), |at| at),
        ("with codes between", with(contour.clone(), Job { beside: Beside::Block("M08"), ..*job }), |at| at),
        ("with empty blocks between", with(contour.clone(), Job { beside: Beside::Block(""), ..*job }), |at| at),
        (
            "with moves beside the plane between",
            with(contour.clone(), Job { beside: Beside::Block("G01Z1.0"), ..*job }),
            |at| at,
        ),
        ("incremental", with(contour.clone(), Job { incremental: true, ..*job }), |at| at),
        ("in the ZX plane", with(contour.clone(), Job { plane: 1, ..*job }), |at| at),
        ("in the YZ plane", with(contour.clone(), Job { plane: 2, ..*job }), |at| at),
    ]
}

fn variants_differ(bench: &mut Bench, sample: &Sample) -> Option<String> {
    let run = bench.run(&sample.contour, sample.job);
    variants(sample).into_iter().find_map(|(name, variant, map)| {
        let other = bench.run(&variant.contour, variant.job);
        differs(&run, &other, map).map(|what| format!("{name}: {what}\n{}", text(&variant.contour, variant.job)))
    })
}

#[test]
fn mirrored_turned_and_in_other_planes_the_path_is_the_same() {
    let bench = &mut Bench::new();
    let mut failures = Failures::default();
    for sample in [Kind::Walk, Kind::Tangent, Kind::Closed].into_iter().flat_map(|kind| samples(kind, 1000)) {
        if let Some(why) = variants_differ(bench, &sample) {
            failures.take(why, sample);
        }
    }
    failures.report(bench, variants_differ);
}

fn inches_differ(bench: &mut Bench, sample: &Sample) -> Option<String> {
    let [run, other] = [false, true].map(|inch| bench.run(&sample.contour, Job { inch, ..sample.job }));
    // The way on and off is rounded to other units, so only what lies between is compared.
    let [run, other] = [run, other].map(|run| Run { pieces: Vec::from(run.contour(&sample.contour)), ..run });
    differs(&run, &other, |at| at)
}

#[test]
fn in_inches_the_path_is_the_same() {
    let bench = &mut Bench::new();
    let mut failures = Failures::default();
    for sample in [Kind::Walk, Kind::Tangent, Kind::Closed].into_iter().flat_map(|kind| samples(kind, 127_000)) {
        if let Some(why) = inches_differ(bench, &sample) {
            failures.take(why, sample);
        }
    }
    failures.report(bench, inches_differ);
}

/// Compares the whole centre paths of a sample and a variant of it that both run to their end.
fn paths_differ(bench: &mut Bench, sample: &Sample, variant: &Sample) -> Option<Result<(), String>> {
    let [one, other] = [sample, variant].map(|sample| bench.run(&sample.contour, sample.job));
    if one.alarm.is_some() || other.alarm.is_some() {
        return None;
    }
    let forms = |run: &Run, sample: &Sample| -> Vec<Form> {
        run.contour(&sample.contour).iter().map(|piece| piece.form).collect()
    };
    let same = same_path(&forms(&one, sample), &forms(&other, variant), SAME);
    Some(if same { Ok(()) } else { Err(format!("another path than\n{}", text(&variant.contour, variant.job))) })
}

fn backwards(sample: &Sample) -> Sample {
    Sample { contour: sample.contour.backwards(), job: Job { right: !sample.job.right, ..sample.job } }
}

fn split(sample: &Sample) -> Sample {
    Sample { contour: sample.contour.split().0, ..*sample }
}

/// Runs a sample and its variant; how many were compared, of how many.
fn compare(variant: fn(&Sample) -> Sample) -> (usize, usize) {
    let bench = &mut Bench::new();
    let (mut compared, mut all, mut failures) = (0, 0, Failures::default());
    let fails =
        |bench: &mut Bench, sample: &Sample| paths_differ(bench, sample, &variant(sample)).and_then(Result::err);
    for sample in [Kind::Walk, Kind::Tangent, Kind::Closed].into_iter().flat_map(|kind| samples(kind, 1000)) {
        all += 1;
        match paths_differ(bench, &sample, &variant(&sample)) {
            None => {}
            Some(Ok(())) => compared += 1,
            Some(Err(why)) => failures.take(why, sample),
        }
    }
    println!("{compared} of {all} compared");
    failures.report(bench, fails);
    (compared, all)
}

#[test]
fn the_other_way_round_the_path_is_the_same() {
    let (compared, all) = compare(backwards);
    assert!(compared * 3 > all, "{compared} of {all}");
}

#[test]
fn elements_in_two_parts_make_the_same_path() {
    let (compared, all) = compare(split);
    assert!(compared * 3 > all, "{compared} of {all}");
    let more: usize = samples(Kind::Walk, 1000).map(|sample| sample.contour.split().1).sum();
    assert!(more > 2000, "{more} elements were split");
}
