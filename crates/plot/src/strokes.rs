//! The path in one view: rapids dashed and clipped at the panel, feeds in their colours, down cuts as signs.

use std::collections::BTreeSet;

use crate::arc::Curve;
use crate::canvas::{Canvas, short};
use crate::clip::Clipped;
use crate::colour::{PAPER, RAPID, hex};
use crate::dash::dash;
use crate::hole::DownCut;
use crate::ink::{FEED_WEIGHT, Ink};
use crate::label::Places;
use crate::palette::Palette;
use crate::path_data::PathData;
use crate::piece::Piece;
use crate::rect::Rect;
use crate::sign::hole_path;
use crate::stroke::Kind;
use crate::view::{Projection, View};

/// How far chords stand off an arc, in sheet units, unless that makes too many.
const CHORD: f64 = 0.08;

/// A difference in sheet units that is hardly seen however much the picture is enlarged.
const HARDLY: f64 = 0.02;

/// All arcs together are cut into about so many chords at most.
const MOST_CHORDS: usize = 200_000;

/// An arc is drawn in parts of less than a third of a turn: longer ones are ill-conditioned in SVG.
const PART_RAD: f64 = 2.0;

/// Rapids longer than this in all, in sheet units, are so close that dashes could not be told apart: they are solid.
const MOST_DASHED: f64 = 60_000.0;

/// The size of an arrow at the panel's side, and how near two arrows may be, in sheet units.
const ARROW: [f64; 2] = [9.0, 3.2];
const ARROW_GRID: f64 = 7.0;

/// The radius of a hole's sign, greatest and least, and of a plunge's dot.
const HOLE: [f64; 2] = [5.0, 1.0];
const PLUNGE: f64 = 1.9;

/// Draws the path.
pub(crate) fn draw_strokes(canvas: &mut Canvas, view: &View, pieces: &[Piece], palette: &Palette, ink: &Ink) {
    draw_rapids(canvas, view, pieces, ink);
    let pieces = seen(view, pieces.iter());
    let tolerance_mm = chord_tolerance(view, &pieces);
    let mut paths = vec![PathData::default(); palette.shades()];
    for piece in pieces.iter().filter(|piece| piece.kind == Kind::Feed) {
        if let Some(path) = paths.get_mut(palette.shade(piece.feed)) {
            draw_feed(path, view, piece, tolerance_mm);
        }
    }
    // Colours along a line are told apart where it is wide; where lines are dense there is no room for that.
    let wider = if matches!(palette, Palette::Speed { .. }) { 1.0 + ink.feed_weight / FEED_WEIGHT } else { 1.0 };
    let width = short(ink.feed_weight * wider);
    // Where the colour changes in steps along a line, round ends would lie over each other as dots; speeds go over into
    // each other, and hairlines of paper would be seen between them.
    let ends = if !matches!(palette, Palette::Scale { .. }) { "round" } else { "butt" };
    canvas.open(&format!("stroke-width=\"{width}\" stroke-linecap=\"{ends}\" stroke-linejoin=\"round\""));
    // The slow feeds lie on top: they are few, and dark.
    for (shade, path) in paths.into_iter().enumerate().rev() {
        let parts = path.finish();
        if !parts.is_empty() {
            canvas.open(&format!("stroke=\"{}\"", hex(palette.colour(shade))));
            parts.iter().for_each(|d| canvas.path(d, ""));
            canvas.close();
        }
    }
    canvas.close();
}

/// The pieces of which a view may show a part.
pub(crate) fn seen<'p>(view: &View, pieces: impl Iterator<Item = &'p Piece>) -> Vec<Piece> {
    pieces.filter(|piece| view.may_show(&piece.extent())).copied().collect()
}

/// Adds a solid piece to a path.
pub(crate) fn draw_feed(path: &mut PathData, view: &View, piece: &Piece, tolerance_mm: f64) {
    if view.is_window_on(&piece.extent()) {
        return piece.for_each_line(tolerance_mm, |from, to| {
            if let Some(part) = view.line(from, to) {
                path.line(part.from, part.to);
            }
        });
    }
    match piece.curve().filter(|curve| is_ellipse(view, curve)) {
        Some(curve) => draw_ellipse(path, view, piece, &curve),
        None => piece.for_each_line(tolerance_mm, |from, to| path.line(view.place(from), view.place(to))),
    }
}

/// True if the view shows the arc as part of an upright ellipse that is more than a line.
fn is_ellipse(view: &View, curve: &Curve) -> bool {
    let hardly_mm = HARDLY / view.scale;
    let flat = view.projection == Projection::Plan || curve.is_flat();
    flat && curve.is_round_in_plan(hardly_mm) && curve.bend_mm() > hardly_mm
}

/// The curve of an arc that is drawn as chords.
fn flattened(view: &View, piece: &Piece) -> Option<Curve> {
    piece.curve().filter(|curve| view.is_window_on(&piece.extent()) || !is_ellipse(view, curve))
}

/// Draws an arc in the XY plane exactly; of several turns on top of each other, one.
fn draw_ellipse(path: &mut PathData, view: &View, piece: &Piece, curve: &Curve) {
    let radii = view.projection.circle_radii().map(|radius| radius * curve.radius() * view.scale);
    let turns = (curve.sweep_rad.abs() / std::f64::consts::TAU).max(1.0);
    let parts = (curve.sweep_rad.abs() / turns / PART_RAD).ceil().max(1.0);
    let mut last = view.place(piece.from);
    for part in 1..=parts as usize {
        let whole = part as f64 == parts && turns == 1.0;
        let next = view.place(if whole { piece.to } else { curve.at(part as f64 / parts / turns) });
        path.ellipse(last, next, radii, curve.sweep_rad < 0.0);
        last = next;
    }
}

/// The chord tolerance in mm with which all arcs of the path stay a bounded number of chords.
pub(crate) fn chord_tolerance(view: &View, pieces: &[Piece]) -> f64 {
    let mut tolerance_mm = CHORD / view.scale;
    let flattened: Vec<Curve> =
        pieces.iter().filter(|piece| piece.arc.is_some()).filter_map(|piece| flattened(view, piece)).collect();
    for _ in 0..8 {
        let chords: usize = flattened.iter().map(|curve| curve.steps(tolerance_mm)).sum();
        if chords <= MOST_CHORDS {
            break;
        }
        tolerance_mm *= 2.0;
    }
    tolerance_mm
}

/// Draws the rapids, those on the same line once.
pub(crate) fn draw_rapids(canvas: &mut Canvas, view: &View, pieces: &[Piece], ink: &Ink) {
    let mut lines = Vec::new();
    let mut drawn = BTreeSet::new();
    let mut arrows = Arrows::default();
    let mut length = 0.0;
    for piece in pieces.iter().filter(|piece| piece.kind == Kind::Rapid) {
        piece.for_each_line(CHORD / view.scale, |from, to| {
            let Some(part) = view.line(from, to) else {
                return;
            };
            arrows.note(&part);
            // Out and back on the same line is one line.
            let [from, to] = [part.from, part.to].map(|end| end.map(|at| (at * 20.0).round() as i64));
            if from != to && drawn.insert([from.min(to), from.max(to)]) {
                length += libm::hypot(part.to[0] - part.from[0], part.to[1] - part.from[1]);
                lines.push((part.from, part.to));
            }
        });
    }
    let mut path = PathData::default();
    let draw = if length > MOST_DASHED { PathData::line } else { dash };
    for (from, to) in lines {
        draw(&mut path, from, to);
    }
    canvas.open(&format!("stroke=\"{RAPID}\" stroke-width=\"{}\"", short(ink.rapid_weight)));
    path.finish().iter().for_each(|d| canvas.path(d, ""));
    canvas.close();
    if !arrows.d.is_empty() {
        canvas.path(&arrows.d, &format!("fill=\"{RAPID}\""));
    }
}

/// The arrows where rapids leave the panel, none on top of another.
#[derive(Default)]
struct Arrows {
    d: String,
    drawn: BTreeSet<[i64; 2]>,
}

impl Arrows {
    fn note(&mut self, part: &Clipped) {
        let along = [part.to[0] - part.from[0], part.to[1] - part.from[1]];
        let length = libm::hypot(along[0], along[1]);
        let cell = part.to.map(|at| (at / ARROW_GRID).round() as i64);
        if !part.leaves || length < 1e-6 || !self.drawn.insert(cell) {
            return;
        }
        let ([x, y], [dx, dy], [long, half]) = (part.to, along.map(|part| part / length), ARROW);
        let back = [x - dx * long, y - dy * long];
        for (command, at) in [
            ('M', [x, y]),
            ('L', [back[0] - dy * half, back[1] + dx * half]),
            ('L', [back[0] + dy * half, back[1] - dx * half]),
        ] {
            self.d.push_str(&format!("{command}{} {}", short(at[0]), short(at[1])));
        }
        self.d.push('z');
    }
}

/// Draws the down cuts of a plan.
pub(crate) fn draw_down_cuts(
    canvas: &mut Canvas,
    view: &View,
    cuts: &[DownCut],
    palette: &Palette,
    places: &mut Places,
) {
    // Repeated cuts on one place are drawn once.
    let mut seen = BTreeSet::new();
    let mut distinct: Vec<(&DownCut, [f64; 2])> = Vec::new();
    for cut in cuts {
        let at = view.place([cut.at[0], cut.at[1], 0.0]);
        if seen.insert((at.map(|at| (at * 2.0).round() as i64), cut.is_hole)) {
            distinct.push((cut, at));
        }
    }
    let holes = distinct.iter().filter(|(cut, _)| cut.is_hole);
    let radius = hole_radius(&holes.map(|(_, at)| *at).collect::<Vec<_>>());
    for shade in 0..palette.shades() {
        let colour = hex(palette.colour(shade));
        let of_shade = || distinct.iter().filter(|(cut, _)| palette.shade(cut.feed) == shade);
        if of_shade().next().is_none() {
            continue;
        }
        canvas.open(&format!("fill=\"{colour}\""));
        for (_, at) in of_shade().filter(|(cut, _)| !cut.is_hole) {
            canvas.circle(*at, PLUNGE.min(radius));
        }
        canvas.close();
        let mut holes = String::new();
        for (_, at) in of_shade().filter(|(cut, _)| cut.is_hole) {
            holes.push_str(&hole_path(*at, radius));
            if radius > 2.0 {
                places.take(Rect { x: at[0], y: at[1], width: 0.0, height: 0.0 }.grown(radius));
            }
        }
        if !holes.is_empty() {
            let weight = short((radius * 0.28).max(0.3));
            canvas.path(&holes, &format!("fill=\"{PAPER}\" stroke=\"{colour}\" stroke-width=\"{weight}\""));
        }
    }
}

/// The radius at which so many signs in their area do not touch each other.
fn hole_radius(at: &[[f64; 2]]) -> f64 {
    if at.len() < 2 {
        return HOLE[0];
    }
    let bounds = at.iter().fold([f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY], |b, [x, y]| {
        [b[0].min(*x), b[1].min(*y), b[2].max(*x), b[3].max(*y)]
    });
    let (wide, high) = (bounds[2] - bounds[0], bounds[3] - bounds[1]);
    let gaps = at.len() as f64 - 1.0;
    let apart = (wide * high / gaps).sqrt().max(wide.max(high) / gaps);
    (apart * 0.28).clamp(HOLE[1], HOLE[0])
}
