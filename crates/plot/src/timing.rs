//! The chart of signals: a row for motion, one for each kind of code, one for each line that turns on or off, over time.
//!
//! Memory is bounded: behind so many edges the chart ends, and says so.

use crate::canvas::Canvas;
use crate::colour::{AXIS, GRID, INK, PAPER, RAPID, SOFT_INK};
use crate::drawing::Title;
use crate::label::{Anchor, Label, Places};
use crate::layout::MARGIN;
use crate::path_data::PathData;
use crate::rect::Rect;
use crate::scale::{Step, written};
use crate::sheet::draw_header;
use crate::text::width;

const WIDTH: f64 = 1200.0;
/// The least room for the names of rows.
const NAMES: f64 = 110.0;
const TOP: f64 = 130.0;
const ROW: f64 = 34.0;
/// The height of a line that is on.
const HIGH: f64 = 20.0;
const NUMBER: f64 = 15.0;
const NAME: f64 = 16.0;
/// Numbers of time stand at least so far apart.
const APART: f64 = 84.0;
/// The slope of an edge.
const SLOPE: f64 = 1.5;
/// More edges than these are not drawn.
const MOST_EDGES: usize = 4000;
/// Up to so many edges each has its line down to the axis.
const MOST_GUIDES: usize = 120;

const CUTTING: &str = "#2a788e";
const SIGNAL: &str = "#c2560a";

/// A row in which something lasts: a move, a code on its lines.
#[derive(Clone, Debug)]
struct Bar {
    row: u32,
    name: &'static str,
    during: [f64; 2],
    text: String,
    colour: &'static str,
}

/// A line that turns on and off.
#[derive(Clone, Debug)]
struct Level {
    row: u32,
    name: String,
    edges: Vec<(f64, bool)>,
}

/// What happens on the lines between control and machine, being drawn.
#[derive(Clone, Debug)]
pub struct Timing {
    title: Title,
    bars: Vec<Bar>,
    levels: Vec<Level>,
    seconds: f64,
    count: usize,
    window: Option<[f64; 2]>,
}

impl Timing {
    /// Nothing yet. A window shows these seconds alone.
    pub fn new(title: Title, window: Option<[f64; 2]>) -> Timing {
        Timing { title, bars: Vec::new(), levels: Vec::new(), seconds: 0.0, count: 0, window }
    }

    /// The program's name.
    pub fn name(&mut self, program: &str) {
        program.clone_into(&mut self.title.program);
    }

    fn has_room(&mut self, time: f64) -> bool {
        let seen = self.window.is_none_or(|window| time <= window[1]);
        let room = self.count < MOST_EDGES && seen;
        if room {
            self.count += 1;
            self.seconds = self.seconds.max(time);
        }
        room
    }

    /// A move lasts.
    pub fn moves(&mut self, cuts: bool, during: [f64; 2]) {
        if self.has_room(during[1]) {
            let colour = if cuts { CUTTING } else { RAPID };
            self.bars.push(Bar { row: 0, name: "motion", during, text: String::new(), colour });
        }
    }

    /// A code goes on its lines. Rows are drawn in the order of their numbers.
    pub fn code(&mut self, row: u32, name: &'static str, time: f64, text: String) {
        if self.has_room(time) {
            self.bars.push(Bar { row, name, during: [time, f64::INFINITY], text, colour: INK });
        }
    }

    /// The codes that are out are taken off their lines.
    pub fn codes_off(&mut self, time: f64) {
        for bar in self.bars.iter_mut().rev().take(16).filter(|bar| bar.during[1] == f64::INFINITY) {
            bar.during[1] = time;
        }
    }

    /// A line turns on or off. Rows are drawn in the order of their numbers, those of one number as they come.
    pub fn edge(&mut self, row: u32, name: &str, time: f64, on: bool) {
        if !self.has_room(time) {
            return;
        }
        match self.levels.iter_mut().find(|level| level.name == name) {
            Some(level) => level.edges.push((time, on)),
            None => self.levels.push(Level { row, name: name.to_owned(), edges: vec![(time, on)] }),
        }
    }

    /// The picture.
    pub fn svg(&self) -> String {
        let mut rows: Vec<(u32, &str)> = self.bars.iter().map(|bar| (bar.row, bar.name)).collect();
        rows.extend(self.levels.iter().map(|level| (level.row, level.name.as_str())));
        rows.sort_by_key(|row| row.0);
        let mut seen: Vec<(u32, &str)> = Vec::new();
        rows.into_iter().for_each(|row| {
            if !seen.contains(&row) {
                seen.push(row)
            }
        });
        let [from, to] = self.window.unwrap_or([0.0, self.seconds * 1.04]);
        let to = if to > from { to } else { from + 1.0 };
        let bottom = TOP + ROW * seen.len() as f64;
        let widest = seen.iter().map(|(_, name)| width(name, NAME)).fold(0.0, f64::max);
        let left = MARGIN + NAMES.max(widest + 14.0);
        let sheet =
            Sheet { rect: Rect { x: left, y: TOP, width: WIDTH - MARGIN - left, height: bottom - TOP }, from, to };
        let height = bottom + 66.0;
        let mut canvas = Canvas::new(WIDTH, height);
        canvas.title(&self.title.program);
        canvas.rect(&Rect { x: 0.0, y: 0.0, width: WIDTH, height }, &format!("fill=\"{PAPER}\""));
        draw_header(&mut canvas, &self.title, &self.facts(from, to), WIDTH);
        sheet.draw_grid(&mut canvas);
        self.draw_guides(&mut canvas, &sheet);
        for (index, (_, name)) in seen.iter().enumerate() {
            let base = TOP + ROW * (index as f64 + 1.0) - 7.0;
            let label = Label::new(*name, [left - 12.0, base - 0.5 * HIGH], NAME, Anchor::End).centred();
            canvas.text(&label, INK);
            let bars: Vec<&Bar> = self.bars.iter().filter(|bar| bar.name == *name).collect();
            if !bars.is_empty() {
                sheet.draw_bars(&mut canvas, &bars, base);
            }
            for level in self.levels.iter().filter(|level| level.name == *name) {
                sheet.draw_level(&mut canvas, level, base);
            }
        }
        canvas.finish()
    }

    fn facts(&self, from: f64, to: f64) -> String {
        let edges: usize = self.levels.iter().map(|level| level.edges.len()).sum();
        let mut facts =
            format!("{} s to {} s   \u{b7}   {edges} edges", written(from), written((to * 1e3).round() / 1e3));
        if self.count >= MOST_EDGES {
            facts.push_str("   \u{b7}   the chart ends here: choose a part of the time");
        }
        facts
    }

    /// Thin lines through the rows at every edge, while they are few.
    fn draw_guides(&self, canvas: &mut Canvas, sheet: &Sheet) {
        let mut times: Vec<f64> = self.levels.iter().flat_map(|level| level.edges.iter().map(|edge| edge.0)).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times.retain(|time| sheet.shows(*time));
        if times.len() > MOST_GUIDES {
            return;
        }
        canvas.open(&format!("stroke=\"{AXIS}\" stroke-width=\"0.7\" stroke-dasharray=\"1 4\""));
        for time in times {
            canvas.line([sheet.x(time), TOP], [sheet.x(time), sheet.rect.bottom()]);
        }
        canvas.close();
    }
}

/// Time to the right, rows downwards.
struct Sheet {
    rect: Rect,
    from: f64,
    to: f64,
}

impl Sheet {
    fn x(&self, time: f64) -> f64 {
        self.rect.x + self.rect.width * ((time - self.from) / (self.to - self.from)).clamp(0.0, 1.0)
    }

    fn shows(&self, time: f64) -> bool {
        time >= self.from && time <= self.to
    }

    fn draw_grid(&self, canvas: &mut Canvas) {
        let (rect, seconds) = (&self.rect, self.to - self.from);
        let ticks = Step::at_least(seconds * APART / rect.width).ticks(self.from, self.to);
        canvas.open(&format!("stroke=\"{GRID}\" stroke-width=\"1\""));
        for tick in &ticks {
            canvas.line([self.x(*tick), rect.y], [self.x(*tick), rect.bottom() + 6.0]);
        }
        canvas.close();
        canvas.text(&Label::new("time, s", [MARGIN, rect.bottom() + 24.0], NAME, Anchor::Start), INK);
        for tick in ticks {
            let at = [self.x(tick), rect.bottom() + 24.0];
            canvas.text(&Label::new(written(tick), at, NUMBER, Anchor::Middle), SOFT_INK);
        }
    }

    fn draw_bars(&self, canvas: &mut Canvas, bars: &[&Bar], base: f64) {
        let mut places = Places::default();
        for bar in bars.iter().filter(|bar| bar.during[1] >= self.from && bar.during[0] <= self.to) {
            let [x, end] = bar.during.map(|time| self.x(time));
            let box_ = Rect { x, y: base - HIGH, width: (end - x).max(0.8), height: HIGH };
            if bar.text.is_empty() {
                canvas.rect(&box_, &format!("fill=\"{0}\" fill-opacity=\"0.35\" stroke=\"{0}\"", bar.colour));
                continue;
            }
            canvas.rect(&box_, &format!("fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\"", bar.colour));
            let label = Label::new(bar.text.as_str(), [(x + end) / 2.0, base - 0.5 * HIGH], NUMBER, Anchor::Middle);
            let label = label.centred();
            if width(&label.text, NUMBER) + 4.0 <= end - x && places.try_take(&label) {
                canvas.text(&label, INK);
            }
        }
    }

    fn draw_level(&self, canvas: &mut Canvas, level: &Level, base: f64) {
        let y = |on: bool| if on { base - HIGH } else { base };
        let before = level.edges.first().is_some_and(|(_, on)| !on);
        let mut at = [self.rect.x, y(before)];
        let mut path = PathData::default();
        for (time, to) in &level.edges {
            if *time > self.to {
                break;
            }
            if *time < self.from {
                at[1] = y(*to);
                continue;
            }
            let x = self.x(*time);
            path.line(at, [x, at[1]]);
            path.line([x, at[1]], [x + SLOPE, y(*to)]);
            at = [x + SLOPE, y(*to)];
        }
        path.line(at, [self.rect.right(), at[1]]);
        for d in path.finish() {
            canvas.path(&d, &format!("stroke=\"{SIGNAL}\" stroke-width=\"2\" fill=\"none\""));
        }
    }
}
