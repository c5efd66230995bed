//! What is claimed of every centre path, judged from the programmed elements alone.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::measure::{Form, Vector, add, apart, cross, distance_to_all, dot, left_of, minus, times};
use super::program::{Corners, Job, Run};
use super::{Contour, measure};

/// How exactly the tool keeps its distance, mm.
pub const EXACTNESS: f64 = 1e-6;
/// Feet of a corner nearer than this, mm, make it no corner.
pub const TANGENT: f64 = 1e-6;
/// Points of each piece that are looked at beside those where a distance can be least.
const SAMPLES: usize = 24;

/// One corner as the programmed elements say it.
struct Corner {
    at: Vector,
    tangents: [Vector; 2],
    feet: [Vector; 2],
    /// How much the path turns, + left, radians.
    turn: f64,
    arcs: [bool; 2],
}

impl Corner {
    fn new(before: &Form, after: &Form, side: f64) -> Corner {
        let tangents = [before.tangents()[1], after.tangents()[0]];
        let [t1, t2] = tangents;
        let at = after.from();
        let feet = tangents.map(|tangent| add(at, times(left_of(tangent), side)));
        let arcs = [before, after].map(|form| matches!(form, Form::Arc(_)));
        let mut turn = cross(t1, t2).atan2(dot(t1, t2));
        // Straight back is gone round outside, whichever way it leans.
        if cross(t1, t2).abs() <= 1e-9 && dot(t1, t2) < 0.0 {
            turn = -PI.copysign(side);
        }
        Corner { at, tangents, feet, turn, arcs }
    }

    fn is_tangent(&self) -> bool {
        apart(self.feet[0], self.feet[1]) < TANGENT
    }

    fn is_inside(&self, side: f64) -> bool {
        side * self.turn > 0.0
    }

    /// The points between which the pieces at an outside corner run.
    fn stations(&self, side: f64, corners: Corners) -> Vec<Vector> {
        let [foot1, foot2] = self.feet;
        if corners == Corners::Arcs {
            return vec![foot1, foot2];
        }
        let mut stations = if self.arcs[0] { vec![foot1] } else { vec![] };
        if self.turn.abs() <= FRAC_PI_2 + 1e-12 {
            let sum = add(minus(foot1, self.at), minus(foot2, self.at));
            stations.push(add(self.at, times(sum, 2.0 * side * side / dot(sum, sum))));
        } else {
            stations.push(add(foot1, times(self.tangents[0], side.abs())));
            stations.push(minus(foot2, times(self.tangents[1], side.abs())));
        }
        if self.arcs[1] {
            stations.push(foot2);
        }
        stations
    }
}

/// How much of a contour was looked at.
#[derive(Clone, Copy, Default, Debug)]
pub struct Seen {
    pub elements: usize,
    pub inside: usize,
    pub outside: usize,
    pub tangent: usize,
    pub points: usize,
}

impl Seen {
    pub fn count(&mut self, other: Seen) {
        self.elements += other.elements;
        self.inside += other.inside;
        self.outside += other.outside;
        self.tangent += other.tangent;
        self.points += other.points;
    }
}

/// A run, and what it was to do.
struct Claim<'a> {
    forms: &'a [Form],
    run: &'a Run,
    side: f64,
    corners: Corners,
    /// `EXACTNESS`, and what arcs that end beside their circle cost.
    exactness: f64,
}

/// How exactly the tool can keep its distance where arcs end beside their circle: they are taken as spirals, whose
/// normal is not their spoke.
fn exactness(contour: &Contour, job: Job) -> f64 {
    let bent = contour.elements.iter().map(|element| {
        let slope = element.growth() / element.form().length();
        2.0 * element.growth() + job.offset.abs() * slope * slope
    });
    EXACTNESS + bent.fold(0.0, f64::max)
}

/// Holds a run against what was programmed.
///
/// # Errors
/// The first claim that does not hold.
pub fn check(contour: &Contour, job: Job, run: &Run) -> Result<Seen, String> {
    let forms = contour.forms();
    let exactness = exactness(contour, job);
    let claim = Claim { forms: &forms, run, side: job.side(), corners: job.corners, exactness };
    let mut seen = Seen::default();
    for element in 0..run.ran(forms.len()) {
        seen.elements += 1;
        claim.main_piece(element)?;
        seen.points += claim.clearance(element)?;
        claim.corner(element, &mut seen)?;
    }
    Ok(seen)
}

/// A place where the tool, beside one element, is inside another one.
#[derive(Clone, Copy, Debug)]
pub struct Cut {
    pub element: usize,
    pub other: usize,
    pub depth: f64,
    pub at: Vector,
}

/// Where the tool is inside elements up to `reach` before or behind the one that it runs beside.
pub fn cuts(contour: &Contour, job: Job, run: &Run, reach: usize) -> Vec<Cut> {
    let forms = contour.forms();
    let exactness = exactness(contour, job);
    let mut cuts = Vec::new();
    for element in 0..run.ran(forms.len()) {
        for other in element.saturating_sub(reach)..(element + reach + 1).min(forms.len()) {
            let points = run.of(element).flat_map(|piece| piece.nearest_to(&forms[other], SAMPLES));
            let depths = points.map(|at| (job.offset.abs() - forms[other].distance(at), at));
            let Some((depth, at)) = depths.max_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
            if depth > exactness {
                cuts.push(Cut { element, other, depth, at });
            }
        }
    }
    cuts
}

impl Claim<'_> {
    fn near(&self, a: Vector, b: Vector) -> bool {
        apart(a, b) <= self.exactness
    }

    /// The block's first piece runs along its element, on the right side, in the right direction.
    fn main_piece(&self, element: usize) -> Result<(), String> {
        let programmed = &self.forms[element];
        let Some(main) = self.run.of(element).next() else {
            // Both its corners take it up to the last digit: the tool stands beside it.
            let stands = programmed.foot(self.run.end_before(element)).1;
            let held = (stands - self.side).abs() <= self.exactness;
            return if held { Ok(()) } else { Err(format!("element {element}: no piece of it")) };
        };
        let held = match (programmed, main) {
            (Form::Line(..), Form::Line(from, to)) => {
                [from, to].iter().all(|&&end| (programmed.foot(end).1 - self.side).abs() <= self.exactness)
                    && dot(minus(*to, *from), programmed.tangents()[0]) > 0.0
            }
            (Form::Arc(bow), Form::Arc(path)) => {
                let wanted = |radius: f64| radius - self.side * bow.sweep.signum();
                self.near(bow.center, path.center)
                    && bow.sweep * path.sweep > 0.0
                    && path.sweep.abs() <= bow.sweep.abs() + self.exactness / path.radius[0].max(1e-3)
                    && path.radius.iter().all(|radius| {
                        bow.radius.iter().any(|&programmed| (radius - wanted(programmed)).abs() <= self.exactness)
                    })
            }
            _ => false,
        };
        let start = element == 0 && !self.near(main.from(), self.foot(0, 0));
        let end = element + 1 == self.forms.len() && !self.near(main.to(), self.foot(element, 1));
        if !held || start || end {
            return Err(format!("element {element}: {main:?} does not run along {programmed:?}"));
        }
        Ok(())
    }

    fn foot(&self, element: usize, end: usize) -> Vector {
        let form = &self.forms[element];
        let at = if end == 0 { form.from() } else { form.to() };
        add(at, times(left_of(form.tangents()[end]), self.side))
    }

    /// The block's first piece runs at the radius. Returns how many points were looked at.
    fn clearance(&self, element: usize) -> Result<usize, String> {
        let programmed = &self.forms[element];
        let Some(main) = self.run.of(element).next() else { return Ok(0) };
        let points = main.nearest_to(programmed, SAMPLES);
        for &point in &points {
            let (share, beside) = programmed.foot(point);
            let distance = programmed.distance(point);
            let is_beside = (0.0..=1.0).contains(&share) && (beside - self.side).abs() > self.exactness;
            if is_beside || distance < self.side.abs() - self.exactness {
                return Err(format!("element {element}: the tool runs {beside} mm beside it, {distance} mm from it"));
            }
        }
        Ok(points.len())
    }

    /// The corner at the element's end.
    fn corner(&self, element: usize, seen: &mut Seen) -> Result<(), String> {
        let Some(next) = self.forms.get(element + 1) else { return Ok(()) };
        let corner = Corner::new(&self.forms[element], next, self.side);
        let pieces: Vec<Form> = self.run.of(element).copied().collect();
        let end = self.run.end_before(element + 1);
        let wrong =
            |what: &str| Err(format!("corner {element} ({} degrees): {what}, {pieces:?}", corner.turn.to_degrees()));
        if corner.is_tangent() {
            seen.tangent += 1;
            let middle = times(add(corner.feet[0], corner.feet[1]), 0.5);
            return if self.near(end, middle) { Ok(()) } else { wrong("the tangent point is missed") };
        }
        if corner.is_inside(self.side) {
            seen.inside += 1;
            // Of a short element the point can lie beside its start: then on the line or circle through it.
            let beside = [&self.forms[element], next].map(|form| form.foot(end).1);
            let meets = beside.iter().all(|beside| (beside - self.side).abs() <= self.exactness);
            return if meets && pieces.len() <= 1 { Ok(()) } else { wrong("the inside point is missed") };
        }
        seen.outside += 1;
        let stations = corner.stations(self.side, self.corners);
        let ends: Vec<Vector> = pieces.iter().map(Form::to).collect();
        let is_end = |station: &Vector| distance_to_all(&[Form::line(*station, *station)], end) <= self.exactness;
        if ends.iter().any(|end| !stations.iter().any(|station| self.near(*end, *station)))
            || stations.iter().any(|station| !ends.iter().any(|end| self.near(*end, *station)))
            || !stations.last().is_some_and(is_end)
        {
            return wrong(&format!("the path should lead through {stations:?}"));
        }
        if self.corners == Corners::Arcs && !pieces.iter().skip(1).all(|piece| self.goes_round(piece, &corner)) {
            return wrong("no arc about the corner");
        }
        Ok(())
    }

    fn goes_round(&self, piece: &Form, corner: &Corner) -> bool {
        let Form::Arc(bow) = piece else { return false };
        let turn = corner.turn.clamp(-TAU, TAU);
        self.near(bow.center, corner.at)
            && bow.radius.iter().all(|radius| (radius - self.side.abs()).abs() <= self.exactness)
            && (bow.sweep - turn).abs() * self.side.abs() <= self.exactness * 2.0
    }
}

/// The least distance of a whole path to a whole contour, less the radius: negative where the tool cuts into it.
pub fn least_clearance(contour: &Contour, path: &[Form], radius: f64) -> f64 {
    let forms = contour.forms();
    let mut least = f64::INFINITY;
    for piece in path {
        for form in &forms {
            for point in piece.nearest_to(form, SAMPLES) {
                least = least.min(form.distance(point) - radius);
            }
        }
    }
    least
}

/// Two paths run through the same points in the same order.
pub fn same_path(one: &[Form], other: &[Form], exactness: f64) -> bool {
    let length = |path: &[Form]| path.iter().map(Form::length).sum::<f64>();
    let pieces = (one.len() + other.len()) as f64;
    (length(one) - length(other)).abs() <= exactness * 4.0 * pieces
        && measure::leaves(one, other, 5) <= exactness
        && measure::leaves(other, one, 5) <= exactness
}
