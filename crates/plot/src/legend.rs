//! The legend: every line and sign that occurs, with its meaning, in rows below the views.

use crate::beside::{CONTOUR_WEIGHT, DRIVEN_WEIGHT, REFUSED_TOOL, REFUSED_WEIGHT, TOOL_WEIGHT};
use crate::canvas::Canvas;
use crate::colour::{ALARM, AXIS, CONTOUR, DRIVEN, INK, RAPID, SWEPT, TOOL, hex};
use crate::detail::CIRCLED;
use crate::label::{Anchor, Label};
use crate::layout::MARGIN;
use crate::mark::MarkKind;
use crate::palette::Palette;
use crate::rect::Rect;
use crate::scale::{Step, written, written_deviation, written_range};
use crate::sign::{draw_sign, hole_path};
use crate::text::width;

const SIZE: f64 = 14.0;
const ROW: f64 = 28.0;
const BETWEEN: f64 = 34.0;
const LINE_SAMPLE: f64 = 34.0;
const SIGN_SAMPLE: f64 = 18.0;
const BAR: f64 = 420.0;
/// The room for a number below the scale.
const NUMBER: f64 = 48.0;
/// A row with the continuous scale is higher: its numbers stand below it.
const BAR_ROW: f64 = 50.0;

/// One entry of the legend.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Entry {
    /// The programmed contour's line.
    Contour,
    /// The programmed path's line, beside the one that is driven.
    Programmed,
    /// The programmed contour's line, and that of the commanded path beside it.
    ContourAndPath,
    /// The path that is driven, and how many times its deviation is drawn.
    Driven(f64),
    /// The circle round the largest deviation: how many mm that is, and how many times it is drawn beside the plan.
    Circled(f64, f64),
    /// The tool, with its radii in mm if there are few.
    Tool(Vec<f64>),
    /// The area that the tool sweeps.
    Swept,
    /// A way that the tool does not fit beside.
    Refused,
    /// The name of the path that runs, before its lines.
    Path,
    /// The rapids' line.
    Rapid,
    /// One of a few feeds: its shade and value in mm/min.
    Feed(usize, f64),
    /// The continuous scale between two feeds in mm/min.
    Scale(f64, f64),
    /// The scale of real speeds up to the fastest in mm/min.
    Speed(f64),
    /// A drilled hole.
    Hole,
    /// A mark.
    Sign(MarkKind),
}

impl Entry {
    fn text(&self) -> String {
        match self {
            Entry::Contour => "programmed contour".to_owned(),
            Entry::Programmed => "programmed path".to_owned(),
            Entry::ContourAndPath => "programmed contour, and the commanded path beside it".to_owned(),
            Entry::Driven(times) if *times != 1.0 => {
                format!("driven path, its deviation drawn {} times as large", written(*times))
            }
            Entry::Driven(_) => "driven path".to_owned(),
            Entry::Circled(by, times) => {
                format!(
                    "largest deviation, {} mm, at the right {} times as large",
                    written_deviation(*by),
                    written(*times)
                )
            }
            Entry::Speed(_) => "real speed, mm/min".to_owned(),
            Entry::Tool(radii) => tool_text(radii),
            Entry::Swept => "swept by the tool".to_owned(),
            Entry::Refused => "refused: the tool does not fit beside it".to_owned(),
            Entry::Path => "compensated path:".to_owned(),
            Entry::Rapid => "rapid".to_owned(),
            Entry::Feed(_, feed) => format!("feed {} mm/min", written(*feed)),
            Entry::Scale(slowest, fastest) => {
                format!("feed {} mm/min", written_range(slowest.round(), fastest.round()))
            }
            Entry::Hole => "drilled hole".to_owned(),
            Entry::Sign(kind) => kind.name().to_owned(),
        }
    }

    fn sample(&self) -> f64 {
        match self {
            Entry::Contour | Entry::Programmed | Entry::ContourAndPath | Entry::Driven(_) => LINE_SAMPLE,
            Entry::Swept | Entry::Refused | Entry::Rapid | Entry::Feed(..) => LINE_SAMPLE,
            Entry::Tool(_) | Entry::Circled(..) | Entry::Hole | Entry::Sign(_) => SIGN_SAMPLE,
            Entry::Path | Entry::Scale(..) | Entry::Speed(_) => 0.0,
        }
    }

    fn width(&self) -> f64 {
        let beside = if matches!(self, Entry::Scale(..) | Entry::Speed(_)) { BAR } else { self.sample() };
        // A name stands close to what it names.
        let before = if matches!(self, Entry::Path) { -BETWEEN * 0.6 } else { 10.0 };
        beside + before + width(&self.text(), SIZE)
    }
}

/// The entries in rows.
pub(crate) struct Legend {
    rows: Vec<Vec<Entry>>,
}

impl Legend {
    /// The legend of these entries, as few rows as the sheet's width allows.
    pub fn new(entries: Vec<Entry>, sheet_width: f64) -> Legend {
        let mut rows: Vec<Vec<Entry>> = Vec::new();
        let mut used = f64::INFINITY;
        for entry in entries {
            let wide = entry.width();
            if used + wide > sheet_width - 2.0 * MARGIN {
                rows.push(Vec::new());
                used = 0.0;
            }
            used += wide + BETWEEN;
            if let Some(row) = rows.last_mut() {
                row.push(entry);
            }
        }
        Legend { rows }
    }

    /// The height that the legend takes.
    pub fn height(&self) -> f64 {
        self.rows.iter().map(|row| row_height(row)).sum()
    }

    /// Draws the legend with its top at a height of the sheet.
    pub fn draw(&self, canvas: &mut Canvas, top: f64, palette: &Palette) {
        let mut y = top;
        for row in &self.rows {
            let mut x = MARGIN;
            for entry in row {
                draw_entry(canvas, entry, [x, y + 0.5 * ROW], palette);
                x += entry.width() + BETWEEN;
            }
            y += row_height(row);
        }
    }
}

fn row_height(row: &[Entry]) -> f64 {
    if row.iter().any(|entry| matches!(entry, Entry::Scale(..) | Entry::Speed(_))) { BAR_ROW } else { ROW }
}

fn draw_entry(canvas: &mut Canvas, entry: &Entry, [x, y]: [f64; 2], palette: &Palette) {
    let middle = [x + 0.5 * entry.sample(), y];
    match entry {
        Entry::Contour | Entry::Programmed | Entry::ContourAndPath => {
            draw_sample(canvas, [x, y], CONTOUR, CONTOUR_WEIGHT)
        }
        Entry::Driven(_) => draw_sample(canvas, [x, y], DRIVEN, DRIVEN_WEIGHT),
        Entry::Refused => {
            draw_sample(canvas, [x, y], ALARM, REFUSED_WEIGHT);
            canvas.open(&format!("fill=\"{ALARM}\" stroke=\"{ALARM}\" {REFUSED_TOOL}"));
            canvas.circle(middle, 7.0);
            canvas.close();
        }
        Entry::Swept => {
            let part = Rect { x, y: y - 7.0, width: LINE_SAMPLE, height: 14.0 };
            canvas.rect(&part, &format!("rx=\"7\" fill=\"{SWEPT}\""));
        }
        Entry::Circled(..) => {
            canvas.open(&format!("stroke=\"{INK}\" {CIRCLED}"));
            canvas.circle(middle, 8.0);
            canvas.close();
        }
        Entry::Tool(_) => {
            canvas.open(&format!("stroke=\"{TOOL}\" stroke-width=\"{TOOL_WEIGHT}\""));
            canvas.circle(middle, 8.0);
            canvas.close();
        }
        Entry::Path => {
            return canvas.text(&Label::new(entry.text(), [x, y], SIZE, Anchor::Start).centred(), INK);
        }
        Entry::Rapid => {
            canvas.open(&format!("stroke=\"{RAPID}\" stroke-width=\"1.2\" stroke-dasharray=\"6 4\""));
            canvas.line([x, y], [x + LINE_SAMPLE, y]);
            canvas.close();
        }
        Entry::Feed(shade, _) => {
            draw_sample(canvas, [x, y], &hex(palette.colour(*shade)), 3.0);
        }
        Entry::Hole => {
            canvas.path(&hole_path(middle, 5.0), &format!("stroke=\"{INK}\" stroke-width=\"1.4\""));
        }
        Entry::Sign(kind) => draw_sign(canvas, *kind, middle),
        Entry::Scale(slowest, fastest) => {
            return draw_scale(canvas, entry, [x, y], scale_ticks(*slowest, *fastest), palette);
        }
        Entry::Speed(fastest) => {
            let ticks = Step::at_least((fastest * NUMBER / BAR).max(f64::MIN_POSITIVE)).ticks(0.0, *fastest);
            return draw_scale(canvas, entry, [x, y], ticks, palette);
        }
    }
    let label = Label::new(entry.text(), [x + entry.sample() + 10.0, y], SIZE, Anchor::Start).centred();
    canvas.text(&label, INK);
}

/// Draws a sample of a line.
fn draw_sample(canvas: &mut Canvas, [x, y]: [f64; 2], colour: &str, weight: f64) {
    canvas.open(&format!("stroke=\"{colour}\" stroke-width=\"{weight}\" stroke-linecap=\"round\""));
    canvas.line([x, y], [x + LINE_SAMPLE, y]);
    canvas.close();
}

/// The tool with its radii.
fn tool_text(radii: &[f64]) -> String {
    let written: Vec<_> = radii.iter().map(|radius| written(*radius)).collect();
    match written.as_slice() {
        [] => "tool".to_owned(),
        [one] => format!("tool, radius {one} mm"),
        many => format!("tool, radii {} mm", many.join(", ")),
    }
}

/// Draws the continuous scale: the shades in equal ratios, with round numbers below.
fn draw_scale(canvas: &mut Canvas, entry: &Entry, [x, y]: [f64; 2], ticks: Vec<f64>, palette: &Palette) {
    let label = Label::new(entry.text(), [x, y], SIZE, Anchor::Start).centred();
    let left = x + width(&label.text, SIZE) + 10.0;
    canvas.text(&label, INK);
    let shades = palette.shades();
    let each = BAR / shades as f64;
    for shade in 0..shades {
        // Each reaches under the next, so that no hairline of paper is left between them.
        let under = if shade + 1 < shades { 1.0 } else { 0.0 };
        let part = Rect { x: left + shade as f64 * each, y: y - 6.0, width: each + under, height: 12.0 };
        canvas.rect(&part, &format!("fill=\"{}\"", hex(palette.colour(shade))));
    }
    canvas.open(&format!("stroke=\"{AXIS}\" stroke-width=\"1\""));
    for feed in &ticks {
        let at = left + palette.place(*feed) * BAR;
        canvas.line([at, y + 6.0], [at, y + 11.0]);
    }
    canvas.close();
    for feed in ticks {
        let at = left + palette.place(feed) * BAR;
        canvas.text(&Label::new(written(feed), [at, y + 25.0], SIZE - 1.0, Anchor::Middle), INK);
    }
}

/// Round feeds on the scale, all so far apart that their numbers do not touch: 1, 2, 5 of every decade if the scale is
/// wide, only 1 if it is very wide, else equal steps.
fn scale_ticks(slowest: f64, fastest: f64) -> Vec<f64> {
    // The scale is logarithmic: so much of a ratio, as a logarithm, has room for a number.
    let apart = NUMBER / BAR * libm::log(fastest / slowest);
    if fastest / slowest < 8.0 {
        let least = fastest * (1.0 - libm::exp(-apart));
        return Step::at_least(least.max(f64::MIN_POSITIVE)).ticks(slowest, fastest);
    }
    let (mut feed, next) = if apart < libm::log(2.0) {
        (Step::at_least(slowest).times(1.0), 1.5)
    } else {
        (libm::pow(10.0, libm::log10(slowest).ceil()), 8.0)
    };
    let mut ticks = Vec::new();
    while feed <= fastest * (1.0 + 1e-9) && ticks.len() < 60 {
        ticks.push(feed);
        feed = Step::at_least(feed * next).times(1.0);
    }
    ticks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_ticked_at_round_feeds() {
        assert_eq!(scale_ticks(90.0, 1200.0), [100.0, 200.0, 500.0, 1000.0]);
        assert_eq!(scale_ticks(600.0, 4200.0), [1000.0, 2000.0, 3000.0, 4000.0]);
        assert_eq!(scale_ticks(480.0, 620.0), [480.0, 500.0, 520.0, 540.0, 560.0, 580.0, 600.0, 620.0]);
        assert_eq!(scale_ticks(3.0, 20_000.0), [10.0, 100.0, 1000.0, 10_000.0]);
    }

    #[test]
    fn a_long_legend_takes_more_rows() {
        let few = Legend::new(vec![Entry::Rapid, Entry::Feed(0, 100.0)], 1600.0);
        let many = Legend::new((0..20).map(|nth| Entry::Feed(nth, 1000.0)).collect(), 1600.0);
        assert_eq!(few.height(), ROW);
        assert!(many.height() >= 2.0 * ROW);
    }
}
