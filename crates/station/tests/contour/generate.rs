//! Random contours. Arcs are made so that both ends lie at one radius to the last digit, except where a test asks for
//! rounded ones.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::measure::{Vector, length, times, toward};
use super::{Contour, Element, Place};
use testkit::Random;

/// Directions (a, b)/c with whole numbers: what runs along them meets without rounding.
const TRIPLES: [[i64; 3]; 7] =
    [[1, 0, 1], [3, 4, 5], [5, 12, 13], [8, 15, 17], [7, 24, 25], [20, 21, 29], [12, 35, 37]];

fn nm(micrometres: f64, unit: i64) -> i64 {
    (micrometres * 1e3 / unit as f64).round() as i64 * unit
}

fn way(from: Place, step: Place) -> Place {
    [from[0] + step[0], from[1] + step[1]]
}

/// A step of about `mm` on a grid of `unit` nm.
fn step(mm: Vector, unit: i64) -> Place {
    mm.map(|mm| nm(mm * 1e3, unit))
}

/// An arc about which both ends lie on a coarse grid, and its centre on the fine one, `unit`: the chord from `from` along
/// about `chord` mm, swept by about `sweep` (+ counter-clockwise).
pub fn exact_arc(from: Place, chord: Vector, sweep: f64, unit: i64) -> Option<Element> {
    let coarse = 100 * unit;
    let half = times(chord, 0.5);
    let half = step(half, coarse);
    if half == [0, 0] {
        return None;
    }
    // The centre lies on the line that halves the chord, at whole multiples of its smallest step on the grid.
    let small = divisor(half[0], half[1]) / unit;
    let across = [-half[1] / small, half[0] / small];
    let height = length(half.map(|nm| nm as f64)) / (sweep / 2.0).tan();
    let steps = (height / length(across.map(|nm| nm as f64))).round() as i64;
    let center = way(way(from, half), [across[0] * steps, across[1] * steps]);
    let arc = Element::arc(from, way(way(from, half), half), center, sweep > 0.0);
    arc.is_exact().then_some(arc)
}

fn divisor(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { divisor(b, a % b) }
}

/// A change of direction: few at random, many straight on, square, or nearly back.
fn turn(random: &mut Random, outward: f64) -> f64 {
    let turn = match random.below(8) {
        0..=3 => random.between(0.0, 3.1),
        4 => random.scaled(1e-6, 1e-2),
        5 => FRAC_PI_2,
        6 => random.between(0.0, 0.8),
        _ => random.between(1.0, 2.2),
    };
    if random.chance(outward) { -turn } else { turn }
}

/// Lines and arcs at random, each beginning where the one before ended. `side` is where the tool is (+ left): outside
/// corners prevail, so that a share of the contours runs to its end.
pub fn walk(random: &mut Random, radius: f64, side: f64, unit: i64) -> Contour {
    let outward = random.pick(&[0.5, 0.7, 0.9]);
    let arcs = random.pick(&[0.0, 0.3, 0.5, 1.0]);
    let mut contour = Contour::default();
    let (mut at, mut heading) = (step([random.between(-80.0, 80.0), random.between(-80.0, 80.0)], unit), 0.0);
    for _ in 0..2 + random.below(9) {
        heading += turn(random, outward) * side.signum();
        let size = radius * random.scaled(0.3, 12.0);
        let element = if random.chance(arcs) {
            let sweep = random.scaled(0.1, 5.5) * random.pick(&[1.0, -1.0]);
            exact_arc(at, times(toward(heading + sweep / 2.0), size), sweep, unit)
        } else {
            let to = way(at, step(times(toward(heading), size), unit));
            Some(Element::line(at, to)).filter(Element::is_exact)
        };
        let Some(element) = element else { continue };
        at = element.to;
        let out = element.form().tangents()[1];
        heading = out[1].atan2(out[0]);
        contour.elements.push(element);
    }
    contour
}

/// A direction of `TRIPLES` in one of its eight positions: numerators and denominator.
fn whole_direction(random: &mut Random, most: i64) -> [i64; 3] {
    let fitting: Vec<_> = TRIPLES.into_iter().filter(|triple| triple[2] <= most).collect();
    let [a, b, c] = random.pick(&fitting);
    let [a, b] = random.pick(&[[a, b], [b, a]]);
    [a * random.pick(&[1, -1]), b * random.pick(&[1, -1]), c]
}

/// Lines and arcs that meet tangentially, to the last digit, or at corners: all along whole-numbered directions.
pub fn tangent_walk(random: &mut Random, radius: f64, side: f64, unit: i64) -> Contour {
    let most = if unit > 1000 { 5 } else { 37 };
    let corners = random.pick(&[0.0, 0.0, 0.3]);
    let mut contour = Contour::default();
    let mut at = step([random.between(-80.0, 80.0), random.between(-80.0, 80.0)], unit);
    let mut heading = whole_direction(random, most);
    for _ in 0..2 + random.below(9) {
        if random.chance(corners) {
            heading = whole_direction(random, most);
        }
        let size = radius * random.scaled(0.5, 10.0);
        let [a, b, c] = heading;
        let element = if random.chance(0.5) {
            let steps = nm(size * 1e3 / c as f64, unit).max(unit);
            Element::line(at, way(at, [a * steps, b * steps]))
        } else {
            // The spokes at both ends are a quarter turn beside the directions there.
            let next = whole_direction(random, most);
            // Mostly the shorter way round.
            let shorter = a * next[1] - b * next[0] > 0;
            let ccw = if random.chance(0.9) { shorter } else { random.chance(0.5) };
            let to_center = if ccw { 1 } else { -1 };
            let size = if ccw == (side > 0.0) { size + 1.2 * radius } else { size };
            let steps = nm(size * 1e3 / (c * next[2]) as f64, unit).max(unit) * to_center;
            let center = way(at, [-b * next[2] * steps, a * next[2] * steps]);
            let end = way(center, [next[1] * c * steps, -next[0] * c * steps]);
            if end == at {
                continue;
            }
            heading = next;
            Element::arc(at, end, center, ccw)
        };
        at = element.to;
        contour.elements.push(element);
    }
    contour
}

/// Tangent lines and arcs as a programming system writes them: every coordinate rounded to the micrometre.
pub fn rounded_walk(random: &mut Random, radius: f64, side: f64) -> Contour {
    let mut contour = Contour::default();
    let (mut at, mut heading) = (step([random.between(-80.0, 80.0), random.between(-80.0, 80.0)], 1000), 0.0);
    for _ in 0..2 + random.below(9) {
        if random.chance(0.2) {
            heading += turn(random, 0.8) * side.signum();
        }
        let size = radius * random.scaled(0.5, 10.0);
        let element = if random.chance(0.5) {
            Element::line(at, way(at, step(times(toward(heading), size), 1000)))
        } else {
            let sweep = random.between(0.2, 4.0) * random.pick(&[1.0, -1.0]);
            let size = if sweep * side > 0.0 { size + 1.2 * radius } else { size };
            let spoke = heading + FRAC_PI_2.copysign(sweep);
            let center = way(at, step(times(toward(spoke), size), 1000));
            let true_radius = length([0, 1].map(|axis| (center[axis] - at[axis]) as f64 / 1e6));
            heading += sweep;
            let out = heading - FRAC_PI_2.copysign(sweep);
            Element::arc(at, way(center, step(times(toward(out), true_radius), 1000)), center, sweep > 0.0)
        };
        if element.from == element.to {
            continue;
        }
        at = element.to;
        contour.elements.push(element);
    }
    contour
}

/// A closed contour that goes once round the origin, counter-clockwise, convex or not, some of its sides arcs.
pub fn closed(random: &mut Random, size: f64, unit: i64) -> Contour {
    let most = random.pick(&[3, 9, 27]);
    let corners = 3 + random.below(most);
    let rough = random.pick(&[0.0, 0.05, 0.2, 0.5, 0.8]);
    let arcs = random.pick(&[0.0, 0.3, 0.7]);
    let bulge = random.pick(&[0.4, 1.2, 3.0, 4.5]);
    let uneven = random.between(0.0, 0.7) / corners as f64;
    let angles: Vec<f64> =
        (0..corners).map(|n| (n as f64 / corners as f64 + random.between(-uneven, uneven) / 2.0) * TAU).collect();
    let places: Vec<Vector> =
        angles.iter().map(|&angle| times(toward(angle), size * (1.0 + random.between(-rough, rough)))).collect();
    let first = step(places[0], unit);
    let mut contour = Contour::default();
    let mut at = first;
    for place in places.into_iter().skip(1) {
        let goal = step(place, unit);
        let chord = [0, 1].map(|axis| (goal[axis] - at[axis]) as f64 / 1e6);
        let sweep = random.scaled(0.05, bulge) * random.pick(&[1.0, -1.0]);
        let arc = if random.chance(arcs) { exact_arc(at, chord, sweep, unit) } else { None };
        let element = arc.unwrap_or(Element::line(at, goal));
        at = element.to;
        contour.elements.push(element);
    }
    contour.elements.push(Element::line(at, first));
    contour
}
