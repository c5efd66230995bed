//! Where the path's ink lies on a view: how thick lines are drawn, so that a dense path stays a texture and does not become
//! a blob, and where a label hides the least.

use crate::piece::Piece;
use crate::rect::Rect;
use crate::stroke::Kind;
use crate::view::View;

/// The weight of a line of a sparse path, and the least weight, in sheet units.
pub(crate) const FEED_WEIGHT: f64 = 1.7;
const FEED: [f64; 2] = [FEED_WEIGHT, 0.12];
const RAPID: [f64; 2] = [1.0, 0.12];

/// Where the path is dense, lines cover about this part of the paper.
const COVERED: f64 = 0.5;

/// Density is measured in squares of this side, with lines told apart to the fine side, both in sheet units.
const SQUARE: f64 = 10.0;
const FINE: f64 = 0.25;

/// The densest tenth of the squares decides.
const DENSE_PART: f64 = 0.9;

/// Lines are measured up to this length in all, in sheet units; of longer paths every so-many-th line.
const MOST_LENGTH: f64 = 2e6;

/// Labels look for room on squares of this side, in sheet units.
const LABEL_SQUARE: f64 = 2.0;

/// The ink of a view.
pub(crate) struct Ink {
    /// The weight of the feeds' lines in sheet units.
    pub feed_weight: f64,
    /// The weight of the rapids' lines in sheet units.
    pub rapid_weight: f64,
    feed: Dots,
    rapid: Dots,
}

impl Ink {
    /// Measures the path in a view.
    pub fn measure(view: &View, pieces: &[Piece]) -> Ink {
        let (feed, feed_lines) = measure(view, pieces, Kind::Feed);
        let (rapid, rapid_lines) = measure(view, pieces, Kind::Rapid);
        let weight = |[most, least]: [f64; 2], lines: f64| (COVERED / lines).clamp(least, most);
        Ink { feed_weight: weight(FEED, feed_lines), rapid_weight: weight(RAPID, rapid_lines), feed, rapid }
    }

    /// How much of the path lies under a rectangle: a number of small squares.
    pub fn under(&self, rect: &Rect) -> usize {
        self.feed.squares_under(rect) + self.rapid.squares_under(rect)
    }
}

/// The path of one kind as dots, and how many lines cross a sheet unit where they lie closest.
fn measure(view: &View, pieces: &[Piece], kind: Kind) -> (Dots, f64) {
    let chosen = || pieces.iter().filter(|piece| piece.kind == kind);
    let mut length = 0.0;
    for piece in chosen() {
        for_each_seen(view, piece, |from, to| length += libm::hypot(to[0] - from[0], to[1] - from[1]));
    }
    let every = (length / MOST_LENGTH).ceil().max(1.0);
    let mut dots = Dots::new(view);
    for piece in chosen().step_by(every as usize) {
        for_each_seen(view, piece, |from, to| dots.draw(from, to));
    }
    let lines = (dots.lines_per_unit() * every).max(f64::MIN_POSITIVE);
    (dots, lines)
}

fn for_each_seen(view: &View, piece: &Piece, mut line: impl FnMut([f64; 2], [f64; 2])) {
    piece.for_each_line(1.0 / view.scale, |from, to| {
        if let Some(part) = view.line(from, to) {
            line(part.from, part.to);
        }
    });
}

/// A panel as fine dots that lines blacken once, so that lines on top of each other count as one.
struct Dots {
    origin: [f64; 2],
    columns: usize,
    rows: usize,
    black: Vec<bool>,
    /// The coarser squares for labels that have ink in them, row by row.
    inked: Vec<bool>,
    inked_columns: usize,
}

impl Dots {
    fn new(view: &View) -> Dots {
        let columns = (view.panel.width / FINE) as usize + 1;
        let rows = (view.panel.height / FINE) as usize + 1;
        let inked_columns = (view.panel.width / LABEL_SQUARE) as usize + 1;
        let inked_rows = (view.panel.height / LABEL_SQUARE) as usize + 1;
        Dots {
            origin: [view.panel.x, view.panel.y],
            columns,
            rows,
            black: vec![false; columns * rows],
            inked: vec![false; inked_columns * inked_rows],
            inked_columns,
        }
    }

    fn draw(&mut self, from: [f64; 2], to: [f64; 2]) {
        let start = [0, 1].map(|axis| (from[axis] - self.origin[axis]) / FINE);
        let end = [0, 1].map(|axis| (to[axis] - self.origin[axis]) / FINE);
        let steps = (end[0] - start[0]).abs().max((end[1] - start[1]).abs()).ceil().max(1.0);
        for step in 0..steps as usize {
            let part = step as f64 / steps;
            let column = (start[0] + part * (end[0] - start[0])) as usize;
            let row = (start[1] + part * (end[1] - start[1])) as usize;
            if let Some(dot) = self.black.get_mut(row * self.columns + column) {
                *dot = true;
            }
            const SIDE: usize = (LABEL_SQUARE / FINE) as usize;
            if let Some(square) = self.inked.get_mut(row / SIDE * self.inked_columns + column / SIDE) {
                *square = true;
            }
        }
    }

    fn squares_under(&self, rect: &Rect) -> usize {
        let square = |value: f64, axis: usize| ((value - self.origin[axis]) / LABEL_SQUARE).max(0.0) as usize;
        let (left, right) = (square(rect.x, 0), square(rect.right(), 0).min(self.inked_columns - 1));
        let rows = square(rect.y, 1)..=square(rect.bottom(), 1);
        rows.map(|row| {
            let row = self.inked.get(row * self.inked_columns + left..=row * self.inked_columns + right);
            row.unwrap_or_default().iter().filter(|inked| **inked).count()
        })
        .sum()
    }

    fn lines_per_unit(&self) -> f64 {
        const SIDE: usize = (SQUARE / FINE) as usize;
        let across = self.columns.div_ceil(SIDE);
        let mut counts = vec![0_u32; across * self.rows.div_ceil(SIDE)];
        for (index, _) in self.black.iter().enumerate().filter(|(_, black)| **black) {
            counts[index / self.columns / SIDE * across + index % self.columns / SIDE] += 1;
        }
        counts.retain(|count| *count > 0);
        counts.sort_unstable();
        let dense = counts.get((counts.len() as f64 * DENSE_PART) as usize).copied().unwrap_or(0);
        f64::from(dense) * FINE / (SQUARE * SQUARE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extent::Extent;
    use crate::view::Projection;

    fn rows(count: u32, passes: u32) -> Vec<Piece> {
        let row = |y: f64| Piece { kind: Kind::Feed, from: [0.0, y, 0.0], to: [100.0, y, 0.0], arc: None, feed: 1.0 };
        (0..count * passes).map(|nth| row(f64::from(nth % count) * 100.0 / f64::from(count))).collect()
    }

    #[test]
    fn close_rows_are_drawn_thin_and_repeated_passes_are_not() {
        let extent = Extent { min: [0.0; 3], max: [100.0, 100.0, 0.0] };
        let panel = Rect { x: 0.0, y: 0.0, width: 500.0, height: 500.0 };
        let view = View::fit(Projection::Plan, &extent, panel, [0.0; 4]);
        let feed = |pieces: Vec<Piece>| Ink::measure(&view, &pieces).feed_weight;
        assert_eq!(feed(rows(10, 1)), FEED[0]);
        assert_eq!(feed(rows(10, 50)), FEED[0], "fifty passes over the same rows look like one");
        let close = feed(rows(500, 1));
        assert!((0.4..0.6).contains(&close), "rows one unit apart leave half the paper white: {close}");
        assert!(feed(rows(100_000, 1)) < 0.15);
        let ink = Ink::measure(&view, &rows(1, 1));
        let at = |y: f64| Rect { x: 100.0, y, width: 60.0, height: 10.0 };
        assert_eq!((ink.under(&at(100.0)), ink.under(&at(490.0))), (0, 31));
    }
}
