//! How thick lines are drawn, so that a dense path stays a texture and does not become a blob.

use crate::piece::Piece;
use crate::stroke::Kind;
use crate::view::View;

/// The weight of a line of a sparse path, and the least weight, in sheet units.
const FEED: [f64; 2] = [1.7, 0.3];
const RAPID: [f64; 2] = [1.0, 0.25];

/// Where the path is dense, lines cover about this part of the paper.
const COVERED: f64 = 0.5;

/// Density is measured in squares of this side, with lines told apart to the fine side, both in sheet units.
const SQUARE: f64 = 10.0;
const FINE: f64 = 0.25;

/// The densest tenth of the squares decides.
const DENSE_PART: f64 = 0.9;

/// Lines are measured up to this length in all, in sheet units; of longer paths every so-many-th line.
const MOST_LENGTH: f64 = 2e6;

/// The weights of lines in one view, in sheet units.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Weights {
    pub feed: f64,
    pub rapid: f64,
    /// Rapids are dashed unless there are so many that dashes could not be told apart.
    pub dashed: bool,
}

/// The weights for a path in a view.
pub(crate) fn weights(view: &View, pieces: &[Piece]) -> Weights {
    let feed = Density::measure(view, pieces, Kind::Feed);
    let rapid = Density::measure(view, pieces, Kind::Rapid);
    let weight = |[most, least]: [f64; 2], density: &Density| (COVERED / density.lines_per_unit).clamp(least, most);
    Weights { feed: weight(FEED, &feed), rapid: weight(RAPID, &rapid), dashed: rapid.length < 60_000.0 }
}

/// How close lines lie where they lie closest.
struct Density {
    /// How many lines cross a sheet unit.
    lines_per_unit: f64,
    /// The length of all lines seen, in sheet units.
    length: f64,
}

impl Density {
    fn measure(view: &View, pieces: &[Piece], kind: Kind) -> Density {
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
        Density { lines_per_unit: (dots.lines_per_unit() * every).max(f64::MIN_POSITIVE), length }
    }
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
}

impl Dots {
    fn new(view: &View) -> Dots {
        let columns = (view.panel.width / FINE) as usize + 1;
        let rows = (view.panel.height / FINE) as usize + 1;
        Dots { origin: [view.panel.x, view.panel.y], columns, rows, black: vec![false; columns * rows] }
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
        }
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
    use crate::rect::Rect;
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
        let feed = |pieces: Vec<Piece>| weights(&view, &pieces).feed;
        assert_eq!(feed(rows(10, 1)), FEED[0]);
        assert_eq!(feed(rows(10, 50)), FEED[0], "fifty passes over the same rows look like one");
        let close = feed(rows(500, 1));
        assert!((0.4..0.6).contains(&close), "rows one unit apart leave half the paper white: {close}");
        assert_eq!(feed(rows(100_000, 1)), FEED[1]);
    }
}
