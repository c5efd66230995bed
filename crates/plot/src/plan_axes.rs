//! The plan's ruler: grid, ticks and numbers in mm along X and Y.

use crate::canvas::Canvas;
use crate::colour::{AXIS, GRID, INK, SOFT_INK};
use crate::label::{Anchor, Label, Places};
use crate::scale::{Step, written};
use crate::view::View;

/// The size of the numbers along axes.
pub(crate) const TICK_SIZE: f64 = 13.0;

/// The size of the axes' names.
pub(crate) const AXIS_SIZE: f64 = 14.0;

/// The length of a tick.
const TICK: f64 = 6.0;

/// Numbers stand at least so far apart, along X and along Y.
const APART: [f64; 2] = [76.0, 26.0];

/// Draws the grid under the path.
pub(crate) fn draw_plan_grid(canvas: &mut Canvas, view: &View) {
    let panel = view.panel;
    canvas.open(&format!("stroke=\"{GRID}\" stroke-width=\"1\""));
    let [xs, ys] = ticks(view);
    for x in &xs {
        let at = view.place([*x, 0.0, 0.0])[0];
        canvas.line([at, panel.y], [at, panel.bottom()]);
    }
    for y in &ys {
        let at = view.place([0.0, *y, 0.0])[1];
        canvas.line([panel.x, at], [panel.right(), at]);
    }
    canvas.close();
}

/// Draws border, ticks, numbers and the axes' names over the path.
pub(crate) fn draw_plan_axes(canvas: &mut Canvas, view: &View, places: &mut Places) {
    let panel = view.panel;
    let [xs, ys] = ticks(view);
    canvas.open(&format!("stroke=\"{AXIS}\" stroke-width=\"1\""));
    canvas.rect(&panel, "");
    let x_name = Label::new("X mm", [panel.x - TICK - 4.0, panel.bottom() + 21.0], AXIS_SIZE, Anchor::End);
    let y_name = Label::new("Y mm", [panel.x - TICK - 4.0, panel.y - 13.0], AXIS_SIZE, Anchor::End);
    let mut numbers = Vec::new();
    for x in xs {
        let at = view.place([x, 0.0, 0.0])[0];
        canvas.line([at, panel.bottom()], [at, panel.bottom() + TICK]);
        numbers.push(Label::new(written(x), [at, panel.bottom() + 21.0], TICK_SIZE, Anchor::Middle));
    }
    for y in ys {
        let at = view.place([0.0, y, 0.0])[1];
        canvas.line([panel.x - TICK, at], [panel.x, at]);
        numbers.push(Label::new(written(y), [panel.x - TICK - 4.0, at], TICK_SIZE, Anchor::End).centred());
    }
    canvas.close();
    for name in [x_name, y_name] {
        places.take(name.room());
        canvas.text(&name, INK);
    }
    for number in numbers.iter().filter(|number| places.try_take(number)) {
        canvas.text(number, SOFT_INK);
    }
}

/// The ticks along X and Y: the same step if the panel is high enough, so that the grid is square.
fn ticks(view: &View) -> [Vec<f64>; 2] {
    let [x_range, y_range] = [0, 1].map(|axis| view.plan_range(axis));
    let step = Step::at_least(APART[0] / view.scale);
    let square = step.ticks(y_range[0], y_range[1]);
    let ys =
        if square.len() >= 3 { square } else { Step::at_least(APART[1] / view.scale).ticks(y_range[0], y_range[1]) };
    [step.ticks(x_range[0], x_range[1]), ys]
}
