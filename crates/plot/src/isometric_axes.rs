//! The isometric view's rulers: the floor of the shown box with its grid, three axes with numbers, and the tripod.

use crate::canvas::Canvas;
use crate::colour::{AXIS, GRID, INK, SOFT_INK};
use crate::extent::Extent;
use crate::label::{Anchor, Label, Places};
use crate::plan_axes::{AXIS_SIZE, TICK_SIZE};
use crate::scale::{Step, written};
use crate::view::{COS_30, View};

/// The length of a tick, and how far outside its number and the axis' name stand.
const TICK: f64 = 6.0;
const NUMBER_AT: f64 = 13.0;

/// Numbers stand at least so far apart along their axis: X, Y, Z.
const APART: [f64; 3] = [54.0, 54.0, 28.0];

/// The length of the tripod's legs, and how far from the panel's sides it stands.
const LEG: f64 = 34.0;
const TRIPOD_INSET: f64 = 26.0;

/// One axis of the box as it is drawn: on the outline, where its numbers are free of the path.
struct Ruler {
    axis: usize,
    /// The box's corner where the axis' lowest value stands.
    from: [f64; 3],
    /// Outwards on the sheet.
    outwards: [f64; 2],
    anchor: Anchor,
}

fn rulers(frame: &Extent) -> [Ruler; 3] {
    let [low, high] = [frame.min, frame.max];
    [
        Ruler { axis: 0, from: low, outwards: [-COS_30, 0.5], anchor: Anchor::End },
        Ruler { axis: 1, from: [high[0], low[1], low[2]], outwards: [COS_30, 0.5], anchor: Anchor::Start },
        Ruler { axis: 2, from: low, outwards: [-1.0, 0.0], anchor: Anchor::End },
    ]
}

impl Ruler {
    fn point(&self, value: f64) -> [f64; 3] {
        let mut point = self.from;
        point[self.axis] = value;
        point
    }

    fn ticks(&self, view: &View, frame: &Extent) -> Vec<f64> {
        Step::at_least(APART[self.axis] / view.scale).ticks(frame.min[self.axis], frame.max[self.axis])
    }
}

/// Draws the floor under the path: its outline and grid at the box's lowest Z.
pub(crate) fn draw_isometric_floor(canvas: &mut Canvas, view: &View, frame: &Extent) {
    let ([left, front, floor], [right, back, _]) = (frame.min, frame.max);
    let [x_ruler, y_ruler, _] = rulers(frame);
    canvas.open(&format!("stroke=\"{GRID}\" stroke-width=\"1\""));
    for x in x_ruler.ticks(view, frame).into_iter().chain([left]) {
        canvas.line(view.place([x, front, floor]), view.place([x, back, floor]));
    }
    for y in y_ruler.ticks(view, frame).into_iter().chain([back]) {
        canvas.line(view.place([left, y, floor]), view.place([right, y, floor]));
    }
    canvas.close();
}

/// Draws axes, ticks, numbers and names, and the tripod in the emptiest corner.
pub(crate) fn draw_isometric_axes(canvas: &mut Canvas, view: &View, frame: &Extent, places: &mut Places) {
    canvas.open(&format!("stroke=\"{AXIS}\" stroke-width=\"1\""));
    let mut names = Vec::new();
    let mut numbers = Vec::new();
    for ruler in rulers(frame) {
        let (low, high) = (frame.min[ruler.axis], frame.max[ruler.axis]);
        canvas.line(view.place(ruler.point(low)), view.place(ruler.point(high)));
        let out = |value: f64, distance: f64| {
            let [x, y] = view.place(ruler.point(value));
            [x + ruler.outwards[0] * distance, y + ruler.outwards[1] * distance]
        };
        let ticks = ruler.ticks(view, frame);
        // The name stands between two numbers.
        let middle = match ticks.windows(2).nth(ticks.len().saturating_sub(2) / 2) {
            Some([left, right]) => 0.5 * (left + right),
            _ => 0.5 * (low + high),
        };
        let mut widest: f64 = 0.0;
        for tick in ticks {
            canvas.line(out(tick, 0.0), out(tick, TICK));
            let number = Label::new(written(tick), out(tick, NUMBER_AT), TICK_SIZE, ruler.anchor).centred();
            widest = widest.max(number.room().width);
            numbers.push(number);
        }
        names.push(name(&ruler, if ruler.axis == 2 { high } else { middle }, widest, &out));
    }
    canvas.close();
    for name in names {
        places.take(name.room());
        canvas.text(&name, INK);
    }
    for number in numbers.iter().filter(|number| view.panel.holds(&number.room()) && places.try_take(number)) {
        canvas.text(number, SOFT_INK);
    }
    draw_tripod(canvas, view, frame, places);
}

/// The name of an axis: beside the middle of X and Y, outside their numbers, and above the top of Z.
fn name(ruler: &Ruler, at: f64, widest: f64, out: &impl Fn(f64, f64) -> [f64; 2]) -> Label {
    let text = ["X mm", "Y mm", "Z mm"][ruler.axis];
    if ruler.axis == 2 {
        let [x, y] = out(at, 0.0);
        return Label::new(text, [x, y - 10.0], AXIS_SIZE, Anchor::Middle);
    }
    let [x, y] = out(at, NUMBER_AT);
    let beyond = ruler.outwards[0].signum() * (widest + 12.0);
    Label::new(text, [x + beyond, y + 8.0], AXIS_SIZE, ruler.anchor).centred()
}

fn draw_tripod(canvas: &mut Canvas, view: &View, frame: &Extent, places: &mut Places) {
    let directions = [[COS_30, 0.5], [COS_30, -0.5], [0.0, -1.0]];
    let [x, y] = tripod_origin(view, frame);
    canvas.open(&format!("stroke=\"{INK}\" stroke-width=\"1.4\" stroke-linecap=\"round\""));
    for [dx, dy] in directions {
        canvas.line([x, y], [x + dx * LEG, y + dy * LEG]);
    }
    canvas.close();
    for ([dx, dy], letter) in directions.into_iter().zip(["X", "Y", "Z"]) {
        let at = [x + dx * (LEG + 10.0), y + dy * (LEG + 10.0)];
        let label = Label::new(letter, at, AXIS_SIZE, Anchor::Middle).centred();
        places.take(label.room());
        canvas.text(&label, INK);
    }
}

/// The corner of the panel that is farthest from the box's picture.
fn tripod_origin(view: &View, frame: &Extent) -> [f64; 2] {
    let panel = view.panel;
    let (left, right) = (panel.x + TRIPOD_INSET, panel.right() - TRIPOD_INSET - LEG);
    let (top, bottom) = (panel.y + TRIPOD_INSET + LEG + 8.0, panel.bottom() - TRIPOD_INSET - 0.5 * LEG);
    let outline = outline(view, frame);
    let mut best = ([left, bottom], f64::NEG_INFINITY);
    for corner in [[left, bottom], [right, bottom], [left, top], [right, top]] {
        let nearest = outline
            .iter()
            .map(|[x, y]| libm::hypot(x - corner[0] - 0.5 * LEG, y - corner[1] + 0.25 * LEG))
            .fold(f64::INFINITY, f64::min);
        // Bottom left is where a draughtsman looks for it: another corner must be clearly emptier.
        let better = nearest > best.1 * 1.25 || best.1 == f64::NEG_INFINITY;
        if better {
            best = (corner, nearest);
        }
    }
    best.0
}

/// Points on the edges of the box, on the sheet.
fn outline(view: &View, frame: &Extent) -> Vec<[f64; 2]> {
    let corners = frame.corners();
    let mut points = Vec::new();
    for (index, from) in corners.iter().enumerate() {
        for axis in (0..3).filter(|axis| index >> axis & 1 == 0) {
            let to = corners[index | 1 << axis];
            for part in 0..=16 {
                let part = f64::from(part) / 16.0;
                points.push(view.place(std::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]))));
            }
        }
    }
    points
}
