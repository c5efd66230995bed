//! Closed contours against another program's offset: where nothing interferes, the tool's centre runs along what
//! `cavalier_contours` computes in its own way. Its outside corners are arcs, as after M96.
//!
//! The environment can ask for more of them: CONTOURS=1000000.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::disallowed_methods)]

mod contour;
mod watch;

use std::{fmt, panic};

use cavalier_contours::polyline::{PlineOffsetOptions, PlineSource, PlineSourceMut, PlineVertex, Polyline};
use contour::claims::{EXACTNESS, least_clearance};
use contour::measure::{Bow, Form, leaves};
use contour::program::{Bench, Corners, Job, text};
use contour::samples::samples_asked;
use contour::{Contour, generate};
use testkit::Random;

/// How many contours are compared if not said otherwise.
const CONTOURS: u64 = 10_000;

/// The shape between two vertices: `bulge` is the tangent of a quarter of the angle swept.
fn form_of(from: PlineVertex<f64>, to: PlineVertex<f64>) -> Form {
    let (a, b, bulge) = ([from.x, from.y], [to.x, to.y], from.bulge);
    if bulge == 0.0 {
        return Form::line(a, b);
    }
    let height = (1.0 / bulge - bulge) / 4.0;
    let center = [(a[0] + b[0]) / 2.0 - (b[1] - a[1]) * height, (a[1] + b[1]) / 2.0 + (b[0] - a[0]) * height];
    Form::arc(a, b, center, bulge > 0.0)
}

fn polyline(contour: &Contour) -> Polyline<f64> {
    let mut polyline = Polyline::new_closed();
    let mut add = |form: &Form, sweep: f64| polyline.add(form.from()[0], form.from()[1], (sweep / 4.0).tan());
    for form in contour.forms() {
        match form {
            // It knows no arc of more than half a turn.
            Form::Arc(bow) if bow.sweep.abs() > 3.0 => {
                add(&form, bow.sweep / 2.0);
                let half = Bow { from: form.at(0.5), ..bow };
                add(&Form::Arc(half), bow.sweep / 2.0);
            }
            Form::Arc(bow) => add(&form, bow.sweep),
            Form::Line(..) => add(&form, 0.0),
        };
    }
    polyline
}

/// The other program's offset, each closed curve of it; `None` if it stumbles over its own assertions.
fn theirs(contour: &Contour, side: f64) -> Option<Vec<Vec<Form>>> {
    let options = PlineOffsetOptions { pos_equal_eps: 1e-9, offset_dist_eps: 1e-7, ..PlineOffsetOptions::default() };
    let polyline = polyline(contour);
    let offsets = panic::catch_unwind(|| polyline.parallel_offset_opt(side, &options)).ok()?;
    let forms = |offset: &Polyline<f64>| offset.iter_segments().map(|(from, to)| form_of(from, to)).collect();
    Some(offsets.iter().map(forms).collect())
}

/// An offset that shows every element of the contour: nothing was cut off.
fn shows_all(contour: &Contour, offset: &[Form], side: f64) -> bool {
    contour.forms().iter().all(|element| {
        offset.iter().any(|form| {
            [0.0, 0.5, 1.0].iter().all(|&share| {
                let (at, beside) = element.foot(form.at(share));
                (-1e-6..=1.0 + 1e-6).contains(&at) && (beside - side).abs() <= EXACTNESS
            })
        })
    })
}

/// How the comparisons went.
#[derive(Default)]
struct Tally {
    equal: usize,
    /// Not computed by the other program.
    stumbled: usize,
    /// Refused by the control, and cut up by the other program.
    refused: usize,
    /// Those of them by which a false alarm would be known.
    shown: usize,
    /// The farthest that one of the equal ones leaves the other, mm.
    farthest: f64,
    /// Interference beyond the control's look-ahead.
    beyond: usize,
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tally { equal, shown: _, farthest, stumbled, refused, beyond } = self;
        write!(f, "{equal} equal to {farthest:.1e} mm, {refused} refused for interference, ")?;
        write!(f, "{beyond} with interference beyond the look-ahead, {stumbled} that the other did not compute")
    }
}

/// Compares one contour.
///
/// # Errors
/// What is different.
fn compare(bench: &mut Bench, seed: u64, tally: &mut Tally) -> Result<(), String> {
    let random = &mut Random::new(seed);
    let radius = (random.scaled(0.5, 20.0) * 1e3).round() / 1e3;
    let side = radius * random.pick(&[1.0, -1.0]);
    let size = radius * random.scaled(1.5, 20.0);
    let contour = generate::closed(random, size, 1000);
    let job = Job::new(side, Corners::Arcs);
    let round = contour.gone_round();
    let run = bench.run(&round, job);
    let told = |what: String| Err(format!("seed {seed}, offset 1 = {radius}: {what}\n{}", text(&round, job)));
    if run.alarm.is_some() && !run.is_interference() {
        return told(format!("alarm {:?}", run.alarm));
    }
    let Some(theirs) = theirs(&contour, side) else {
        tally.stumbled += 1;
        return Ok(());
    };
    let single = <&[Vec<Form>; 1]>::try_from(&theirs[..]).ok().map(|[offset]| offset);
    if run.alarm.is_some() {
        return match single.filter(|offset| shows_all(&contour, offset, side)) {
            Some(offset) => told(format!("{:?}, but this is an offset of all: {offset:?}", run.alarm)),
            None => {
                tally.refused += 1;
                Ok(())
            }
        };
    }
    let ours: Vec<Form> = run.between(1, contour.elements.len() + 1).copied().collect();
    let farthest = single.map_or(f64::INFINITY, |offset| leaves(&ours, offset, 4).max(leaves(offset, &ours, 4)));
    if farthest <= EXACTNESS {
        tally.equal += 1;
        tally.shown += usize::from(single.is_some_and(|offset| shows_all(&contour, offset, side)));
        tally.farthest = tally.farthest.max(farthest);
    } else if least_clearance(&contour, &ours, radius) < -EXACTNESS {
        tally.beyond += 1;
    } else {
        return told(format!("{} curves, up to {farthest} mm apart", theirs.len()));
    }
    Ok(())
}

#[test]
fn closed_contours_without_interference_equal_another_programs_offset() {
    let contours = samples_asked(CONTOURS);
    let (mut tally, bench, mut failures) = (Tally::default(), &mut Bench::new(), Vec::new());
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {})); // the other program's assertions
    for seed in 0..contours {
        failures.extend(compare(bench, seed, &mut tally).err());
    }
    panic::set_hook(hook);
    println!("{contours} closed contours: {tally}");
    failures.sort_by_key(String::len);
    assert!(failures.is_empty(), "{} differ, the smallest: {}", failures.len(), failures[0]);
    assert!(tally.equal as u64 * 2 > contours, "too few could be compared: {tally}");
    assert!(tally.shown * 10 > tally.equal * 9, "{} show every element: {tally}", tally.shown);
    assert!(tally.stumbled as u64 * 1000 < contours, "{tally}");
    assert!(tally.beyond as u64 * 10 < contours, "too much interference went unseen: {tally}");
}
