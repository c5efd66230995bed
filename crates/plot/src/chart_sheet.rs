//! The chart on its sheet: speed along the path, below it a panel for each axis that moves, all over the same time.

use crate::canvas::{Canvas, short};
use crate::chart::{AxisTrace, Chart};
use crate::colour::{AXIS, GRID, INK, PAPER, RAPID, SOFT_INK};
use crate::label::{Anchor, Label, Places};
use crate::layout::MARGIN;
use crate::path_data::PathData;
use crate::rect::Rect;
use crate::scale::{Step, written};
use crate::sheet::draw_header;
use crate::simplify::simplify;
use crate::text::width;
use crate::trace::{Spans, Trace};

const WIDTH: f64 = 1200.0;
/// The room for names and numbers at the left.
const NUMBERS: f64 = 138.0;
/// The row of the blocks' lines, and the panels' tops and heights below each other.
const BLOCKS_TOP: f64 = 124.0;
const BLOCKS_HEIGHT: f64 = 26.0;
const SPEED_HEIGHT: f64 = 290.0;
const AXIS_HEIGHT: f64 = 116.0;
const BETWEEN: f64 = 16.0;
/// What is so near to a line is not seen beside it.
const UNSEEN: f64 = 0.03;
/// Sizes of text.
const NUMBER: f64 = 15.0;
const NAME: f64 = 16.0;
/// Numbers stand at least so far apart, along time and upwards.
const APART: [f64; 2] = [84.0, 34.0];
/// The borders of more blocks are not drawn: there would be nothing else.
const MOST_BLOCKS: usize = 60;
/// Rapids that are more than so many times as fast as the fastest feed leave the panel.
const MOST_ABOVE_FEED: f64 = 2.5;
/// The legend's rows, and the line before a text.
const LEGEND_ROW: f64 = 28.0;
const SAMPLE: f64 = 36.0;

/// Lines of the chart: colour, weight, dashes.
type Line = (&'static str, f64, &'static str);
const CUTTING: Line = ("#2a788e", 2.0, "");
const POSITIONING: Line = (RAPID, 2.0, "");
const COMMANDED: Line = (INK, 1.5, "8 5");
const ALLOWED: Line = ("#c2560a", 2.2, "2 4");

/// A panel: time to the right, a value upwards.
struct Panel {
    rect: Rect,
    seconds: f64,
    range: [f64; 2],
}

impl Panel {
    fn x(&self, time: f64) -> f64 {
        self.rect.x + self.rect.width * time / self.seconds
    }

    fn y(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        self.rect.bottom() - self.rect.height * (value - low) / (high - low)
    }

    fn at(&self, [time, value]: [f64; 2]) -> [f64; 2] {
        [self.x(time), self.y(value)]
    }
}

/// The chart as SVG.
pub(crate) fn chart_sheet(chart: &Chart) -> String {
    let moving: Vec<&AxisTrace> =
        chart.axes.iter().filter(|axis| axis.velocity.lowest < 0.0 || axis.velocity.highest > 0.0).collect();
    let seconds = if chart.seconds > 0.0 { chart.seconds } else { 1.0 };
    let left = MARGIN + NUMBERS;
    let rect = |y: f64, height: f64| Rect { x: left, y, width: WIDTH - MARGIN - left, height };
    let speed_top = BLOCKS_TOP + BLOCKS_HEIGHT;
    let cutting = chart.commanded.iter().map(|(_, feed)| feed).fold(chart.cutting.highest, f64::max);
    // Rapids are many times as fast: beside them no difference between feeds would be seen.
    let has_room = cutting <= 0.0 || chart.rapid.highest <= MOST_ABOVE_FEED * cutting;
    let highest = if has_room { cutting.max(chart.rapid.highest) } else { cutting };
    let speed = Panel {
        rect: rect(speed_top, SPEED_HEIGHT),
        seconds,
        range: [0.0, if highest > 0.0 { highest * 1.08 } else { 1.0 }],
    };
    let beyond = chart.rapid.highest > speed.range[1];
    let mut panels = Vec::new();
    let mut top = speed.rect.bottom() + BETWEEN;
    for axis in &moving {
        let alike = moving.iter().filter(|other| other.axis.turns == axis.axis.turns);
        let most = alike.map(|other| other.velocity.highest.max(-other.velocity.lowest)).fold(0.0, f64::max) * 1.12;
        panels.push((Panel { rect: rect(top, AXIS_HEIGHT), seconds, range: [-most, most] }, *axis));
        top += AXIS_HEIGHT + BETWEEN;
    }
    let bottom = top - BETWEEN;
    let notes = notes(chart, beyond);
    let legend_top = bottom + 58.0;
    let entries = legend(chart);
    let height = legend_top + LEGEND_ROW + LEGEND_ROW * notes.len() as f64 + 18.0;

    let mut canvas = Canvas::new(WIDTH, height);
    canvas.title(&chart.title.program);
    canvas.rect(&Rect { x: 0.0, y: 0.0, width: WIDTH, height }, &format!("fill=\"{PAPER}\""));
    draw_header(&mut canvas, &chart.title, &facts(chart), WIDTH);
    draw_time_grid(&mut canvas, &speed, bottom);
    draw_blocks(&mut canvas, chart, &speed, bottom);
    draw_frame(&mut canvas, &speed, ["speed", "mm/min"]);
    if chart.rapid.highest > 0.0 {
        canvas.open_clipped(&speed.rect, "");
        draw_area(&mut canvas, &speed, &chart.rapid, POSITIONING);
        canvas.close();
    }
    draw_area(&mut canvas, &speed, &chart.cutting, CUTTING);
    draw_steps(&mut canvas, &speed, &chart.allowed, ALLOWED);
    draw_steps(&mut canvas, &speed, &chart.commanded, COMMANDED);
    for (panel, axis) in &panels {
        let unit = if axis.axis.turns { "\u{b0}/min" } else { "mm/min" };
        draw_frame(&mut canvas, panel, [&axis.axis.letter.to_string(), unit]);
        draw_trace(&mut canvas, panel, &axis.velocity, CUTTING);
    }
    draw_legend(&mut canvas, &entries, legend_top);
    for (row, note) in notes.iter().enumerate() {
        let at = [MARGIN, legend_top + LEGEND_ROW * (row as f64 + 1.5)];
        canvas.text(&Label::new(note.as_str(), at, NUMBER, Anchor::Start).centred(), SOFT_INK);
    }
    canvas.finish()
}

/// Times and the highest speed in one line.
fn facts(chart: &Chart) -> String {
    let standing = (chart.seconds - chart.cutting_s - chart.rapid_s).max(0.0);
    let mut parts = vec![format!("{} s", written_seconds(chart.seconds))];
    for (name, seconds) in [("cutting", chart.cutting_s), ("rapid", chart.rapid_s), ("standing", standing)] {
        if seconds >= 0.0005 {
            parts.push(format!("{name} {} s", written_seconds(seconds)));
        }
    }
    if chart.cutting.highest > 0.0 {
        parts.push(format!("fastest cut {} mm/min", written(chart.cutting.highest.round())));
    }
    parts.join("   \u{b7}   ")
}

fn written_seconds(seconds: f64) -> String {
    if seconds < 100.0 { format!("{seconds:.3}") } else { format!("{seconds:.1}") }
}

/// Border, grid and numbers of a panel.
fn draw_frame(canvas: &mut Canvas, panel: &Panel, [name, unit]: [&str; 2]) {
    let rect = &panel.rect;
    let span = panel.range[1] - panel.range[0];
    let ticks = Step::at_least(span * APART[1] / rect.height).ticks(panel.range[0], panel.range[1]);
    canvas.open(&format!("stroke=\"{GRID}\" stroke-width=\"1\""));
    for tick in &ticks {
        canvas.line([rect.x, panel.y(*tick)], [rect.right(), panel.y(*tick)]);
    }
    canvas.close();
    canvas.rect(rect, &format!("stroke=\"{AXIS}\" stroke-width=\"1\""));
    for tick in ticks {
        let label = Label::new(written(tick), [rect.x - 9.0, panel.y(tick)], NUMBER, Anchor::End).centred();
        canvas.text(&label, SOFT_INK);
    }
    let middle = rect.middle()[1];
    canvas.text(&Label::new(name, [MARGIN, middle - 12.0], NAME, Anchor::Start).centred(), INK);
    canvas.text(&Label::new(unit, [MARGIN, middle + 12.0], NUMBER, Anchor::Start).centred(), SOFT_INK);
}

/// The grid of time through all panels, and its numbers below the last.
fn draw_time_grid(canvas: &mut Canvas, speed: &Panel, bottom: f64) {
    let rect = &speed.rect;
    let ticks = time_ticks(speed);
    canvas.open(&format!("stroke=\"{GRID}\" stroke-width=\"1\""));
    for tick in &ticks {
        canvas.line([speed.x(*tick), rect.y], [speed.x(*tick), bottom + 6.0]);
    }
    canvas.close();
    let name = Label::new("time, s", [MARGIN, bottom + 23.0], NAME, Anchor::Start);
    canvas.text(&name, INK);
    for tick in ticks {
        canvas.text(&Label::new(written(tick), [speed.x(tick), bottom + 23.0], NUMBER, Anchor::Middle), SOFT_INK);
    }
}

/// The lines of the blocks where there is room, and the blocks' borders.
fn draw_blocks(canvas: &mut Canvas, chart: &Chart, speed: &Panel, bottom: f64) {
    let middle = BLOCKS_TOP + 0.5 * BLOCKS_HEIGHT;
    let name = Label::new("line", [MARGIN, middle], NAME, Anchor::Start).centred();
    canvas.text(&name, INK);
    if chart.blocks.iter().count() > MOST_BLOCKS {
        return draw_lines_at(canvas, chart, speed, middle);
    }
    let mut borders = PathData::default();
    for ([from, _], _) in chart.blocks.iter().skip(1) {
        borders.line([speed.x(from), BLOCKS_TOP + 4.0], [speed.x(from), bottom]);
    }
    for d in borders.finish() {
        canvas.path(&d, &format!("stroke=\"{AXIS}\" stroke-width=\"0.8\" stroke-dasharray=\"1 3\""));
    }
    let mut places = Places::default();
    for ([from, to], line) in chart.blocks.iter() {
        let label =
            Label::new(line.to_string(), [speed.x((from + to) / 2.0), middle], NUMBER, Anchor::Middle).centred();
        let room = speed.x(to) - speed.x(from);
        if width(&label.text, NUMBER) + 4.0 <= room && places.try_take(&label) {
            canvas.text(&label, SOFT_INK);
        }
    }
}

/// Of many blocks, the lines of those at the times that have a number.
fn draw_lines_at(canvas: &mut Canvas, chart: &Chart, speed: &Panel, middle: f64) {
    let mut blocks = chart.blocks.iter().peekable();
    let mut places = Places::default();
    for tick in time_ticks(speed) {
        while blocks.next_if(|([_, to], _)| *to <= tick).is_some() {}
        let Some((_, line)) = blocks.peek() else { return };
        let label = Label::new(line.to_string(), [speed.x(tick), middle], NUMBER, Anchor::Middle).centred();
        if places.try_take(&label) {
            canvas.text(&label, SOFT_INK);
        }
    }
}

fn time_ticks(speed: &Panel) -> Vec<f64> {
    Step::at_least(speed.seconds * APART[0] / speed.rect.width).ticks(0.0, speed.seconds)
}

/// A trace on the sheet, without the points that would not be seen.
fn drawn(panel: &Panel, trace: &Trace) -> Vec<[f64; 3]> {
    let points: Vec<[f64; 3]> = trace.points().iter().map(|point| panel.at(*point)).map(|[x, y]| [x, y, 0.0]).collect();
    let mut fewer = Vec::new();
    simplify(&points, UNSEEN, &mut fewer);
    fewer
}

fn draw_trace(canvas: &mut Canvas, panel: &Panel, trace: &Trace, (colour, weight, _): Line) {
    let mut path = PathData::default();
    for pair in drawn(panel, trace).windows(2) {
        let [from, to] = [pair[0], pair[1]].map(|[x, y, _]| [x, y]);
        path.line(from, to);
    }
    canvas.open(&format!("stroke=\"{colour}\" stroke-width=\"{weight}\" stroke-linejoin=\"round\""));
    path.finish().iter().for_each(|d| canvas.path(d, ""));
    canvas.close();
}

/// A trace with the area below it, both only where it is above zero.
fn draw_area(canvas: &mut Canvas, panel: &Panel, trace: &Trace, (colour, weight, _): Line) {
    if trace.highest <= 0.0 {
        return;
    }
    let mut path = PathData::default();
    let mut area = String::new();
    let zero = panel.y(0.0);
    for pair in drawn(panel, trace).windows(2).filter(|pair| pair[0][1] < zero || pair[1][1] < zero) {
        let ends = [pair[0], pair[1]].map(|[x, y, _]| [x, y]);
        path.line(ends[0], ends[1]);
        if ends[0][0] < ends[1][0] {
            let [[left, from], [right, to], zero] = [ends[0], ends[1], [zero; 2]].map(|at| at.map(short));
            area.push_str(&format!("M{left} {}V{from}L{right} {to}V{}z", zero[0], zero[1]));
        }
    }
    // One colour instead of a transparent one: neighbours would show where they meet.
    canvas.path(&area, &format!("fill=\"{}\"", pale(colour)));
    canvas.open(&format!("stroke=\"{colour}\" stroke-width=\"{weight}\" stroke-linejoin=\"round\""));
    path.finish().iter().for_each(|d| canvas.path(d, ""));
    canvas.close();
}

fn pale(colour: &str) -> &'static str {
    if colour == RAPID { "#eef0f2" } else { "#dbeaee" }
}

/// Values that hold for a time each, as steps.
fn draw_steps(canvas: &mut Canvas, panel: &Panel, spans: &Spans<f64>, (colour, weight, dashes): Line) {
    let mut path = PathData::default();
    let mut last: Option<[f64; 2]> = None;
    for ([from, to], value) in spans.iter() {
        let ends = [panel.at([from, value]), panel.at([to, value])];
        if let Some(last) = last.filter(|last| (last[0] - ends[0][0]).abs() < 0.005) {
            path.line(last, ends[0]);
        }
        path.line(ends[0], ends[1]);
        last = Some(ends[1]);
    }
    canvas.open(&format!("stroke=\"{colour}\" stroke-width=\"{weight}\" stroke-dasharray=\"{dashes}\""));
    path.finish().iter().for_each(|d| canvas.path(d, ""));
    canvas.close();
}

/// The lines that occur, with their names.
fn legend(chart: &Chart) -> Vec<(Line, &'static str)> {
    let mut entries = Vec::new();
    if chart.cutting.highest > 0.0 {
        entries.push((CUTTING, "speed along the path"));
    }
    if chart.rapid.highest > 0.0 {
        entries.push((POSITIONING, "of rapids"));
    }
    if chart.commanded.iter().next().is_some() {
        entries.push((COMMANDED, "commanded feed"));
    }
    if chart.allowed.iter().next().is_some() {
        entries.push((ALLOWED, "where the axes' limits allow less"));
    }
    entries
}

fn draw_legend(canvas: &mut Canvas, entries: &[(Line, &'static str)], top: f64) {
    let (mut x, y) = (MARGIN, top + 0.5 * LEGEND_ROW);
    for ((colour, weight, dashes), text) in entries {
        canvas.open(&format!("stroke=\"{colour}\" stroke-width=\"{weight}\" stroke-dasharray=\"{dashes}\""));
        canvas.line([x, y], [x + SAMPLE, y]);
        canvas.close();
        canvas.text(&Label::new(*text, [x + SAMPLE + 10.0, y], NUMBER, Anchor::Start).centred(), INK);
        x += SAMPLE + 10.0 + width(text, NUMBER) + 34.0;
    }
}

/// What the chart does not show.
fn notes(chart: &Chart, beyond: bool) -> Vec<String> {
    let traces = [&chart.cutting, &chart.rapid].into_iter().chain(chart.axes.iter().map(|axis| &axis.velocity));
    let mut notes = Vec::new();
    if chart.seconds <= 0.0 {
        notes.push("Nothing takes time.".to_owned());
    }
    if beyond {
        notes.push(format!("Rapids leave the picture: up to {} mm/min.", written(chart.rapid.highest.round())));
    }
    if traces.into_iter().any(|trace| trace.is_thinned) {
        let long =
            "The program is long: of values that lie closer than a line is wide, the lowest and the highest are drawn.";
        notes.push(long.to_owned());
    }
    notes
}
