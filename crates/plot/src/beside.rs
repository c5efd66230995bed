//! The layers beside the path in a view: what the tool sweeps, the programmed contour, the tool, what is refused.

use crate::canvas::{Canvas, short};
use crate::colour::{ALARM, CONTOUR, DRIVEN, SWEPT, TOOL};
use crate::ink::{FEED_WEIGHT, Ink};
use crate::layers::DrawnLayers;
use crate::path_data::PathData;
use crate::piece::Piece;
use crate::stroke::Kind;
use crate::strokes::{chord_tolerance, draw_feed, draw_rapids, seen};
use crate::view::View;

/// The weights of the contour, of the driven path, of the tool and of a refused way, in sheet units.
pub(crate) const CONTOUR_WEIGHT: f64 = 1.3;
pub(crate) const DRIVEN_WEIGHT: f64 = 2.6;
pub(crate) const TOOL_WEIGHT: f64 = 0.9;
pub(crate) const REFUSED_WEIGHT: f64 = 3.4;

/// The look of a tool that does not fit, beside its colour.
pub(crate) const REFUSED_TOOL: &str = "fill-opacity=\"0.1\" stroke-width=\"1.6\"";

/// Draws what the tool sweeps, under everything else: of a move in the plane, a line as wide as the tool with round ends.
pub(crate) fn draw_swept(canvas: &mut Canvas, view: &View, layers: &DrawnLayers) {
    let mut radii: Vec<f64> = layers.swept.iter().map(|piece| piece.feed).collect();
    radii.sort_by(f64::total_cmp);
    radii.dedup();
    if radii.is_empty() {
        return;
    }
    canvas.open_clipped(&view.panel, &format!("stroke=\"{SWEPT}\" stroke-linecap=\"round\" stroke-linejoin=\"round\""));
    for radius in radii {
        let ways = layers.swept.iter().filter(|piece| piece.feed == radius);
        canvas.open(&format!("stroke-width=\"{}\"", short(2.0 * radius * view.scale)));
        draw_ways(canvas, view, ways);
        canvas.close();
    }
    canvas.close();
}

/// Draws the programmed contour, thinner than the path beside it where that is dense.
pub(crate) fn draw_contour(canvas: &mut Canvas, view: &View, layers: &DrawnLayers, ink: &Ink) {
    if layers.programmed.is_empty() {
        return;
    }
    let weight = short(ink.feed_weight.min(CONTOUR_WEIGHT));
    let look = format!("stroke=\"{CONTOUR}\" stroke-width=\"{weight}\" stroke-linecap=\"round\"");
    canvas.open_clipped(&view.panel, &look);
    draw_ways(canvas, view, layers.programmed.iter());
    canvas.close();
}

/// Draws the path that is driven, wider than the programmed one, which lies on it.
pub(crate) fn draw_driven(canvas: &mut Canvas, view: &View, layers: &DrawnLayers) {
    if layers.driven.is_empty() {
        return;
    }
    let ink = Ink::measure(view, &layers.driven);
    draw_rapids(canvas, view, &layers.driven, &ink);
    let weight = short(ink.feed_weight * DRIVEN_WEIGHT / FEED_WEIGHT);
    let look =
        format!("stroke=\"{DRIVEN}\" stroke-width=\"{weight}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
    canvas.open_clipped(&view.panel, &look);
    draw_ways(canvas, view, layers.driven.iter().filter(|piece| piece.kind == Kind::Feed));
    canvas.close();
}

/// Draws the tool at its places.
pub(crate) fn draw_tool(canvas: &mut Canvas, view: &View, layers: &DrawnLayers) {
    let circles = layers.places.circles(view);
    if circles.is_empty() {
        return;
    }
    canvas.open_clipped(&view.panel, &format!("stroke=\"{TOOL}\" stroke-width=\"{TOOL_WEIGHT}\""));
    for (at, radius) in circles {
        canvas.circle(at, radius);
    }
    canvas.close();
}

/// Draws the ways that the tool does not fit beside; in plan with the tool.
pub(crate) fn draw_refused(canvas: &mut Canvas, view: &View, layers: &DrawnLayers, in_plan: bool) {
    if layers.refused.is_empty() {
        return;
    }
    canvas.open_clipped(&view.panel, &format!("stroke=\"{ALARM}\" stroke-linecap=\"round\""));
    canvas.open(&format!("stroke-width=\"{REFUSED_WEIGHT}\""));
    draw_ways(canvas, view, layers.refused.iter().map(|refused| &refused.way));
    canvas.close();
    canvas.open(&format!("fill=\"{ALARM}\" {REFUSED_TOOL}"));
    for (at, radius) in layers.refused.iter().filter_map(|refused| refused.tool).filter(|_| in_plan) {
        canvas.circle(view.place(at), radius * view.scale);
    }
    canvas.close();
    canvas.close();
}

fn draw_ways<'p>(canvas: &mut Canvas, view: &View, ways: impl Iterator<Item = &'p Piece>) {
    let ways = seen(view, ways);
    let mut path = PathData::default();
    let tolerance_mm = chord_tolerance(view, &ways);
    for way in &ways {
        draw_feed(&mut path, view, way, tolerance_mm);
    }
    path.finish().iter().for_each(|d| canvas.path(d, ""));
}
