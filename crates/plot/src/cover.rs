//! Leaves out what would be drawn on top of itself: a piece whose every cell, in both views, already has a piece of its
//! colour. This is what bounds a surface with more rows than the sheet has dots.

use crate::clip::clip;
use crate::extent::Extent;
use crate::feeds::Feeds;
use crate::piece::Piece;
use crate::rect::Rect;
use crate::stroke::Kind;
use crate::view::Projection;

/// The isometric picture is about twice as large in mm as the plan, and so are its cells.
const ISOMETRIC_CELL: f64 = 2.0;

/// Drops the pieces that add no cell to either view. Whatever lies outside the region counts as drawn.
pub(crate) fn drop_covered(pieces: &mut Vec<Piece>, region: &Extent, cell_mm: f64, feeds: &Feeds) {
    let group = |piece: &Piece| match piece.kind {
        Kind::Rapid => None,
        Kind::Feed => Some(feeds.colour_group(piece.feed)),
    };
    let mut groups: Vec<_> = pieces.iter().map(group).collect();
    groups.sort_unstable();
    groups.dedup();
    let mut plan = Cells::new(Projection::Plan, region, cell_mm);
    let mut isometric = Cells::new(Projection::Isometric, region, cell_mm * ISOMETRIC_CELL);
    let mut needed = vec![false; pieces.len()];
    for wanted in groups {
        plan.clear();
        isometric.clear();
        for (piece, needed) in pieces.iter().zip(&mut needed).filter(|(piece, _)| group(piece) == wanted) {
            let lines = |line: &mut dyn FnMut([f64; 3], [f64; 3])| piece.for_each_line(cell_mm * 0.25, line);
            lines(&mut |from, to| *needed = *needed || plan.is_new(from, to) || isometric.is_new(from, to));
            if *needed {
                lines(&mut |from, to| {
                    plan.mark(from, to);
                    isometric.mark(from, to);
                });
            }
        }
    }
    let mut index = 0;
    pieces.retain(|_| {
        index += 1;
        needed[index - 1]
    });
}

/// One view as cells that are drawn in or not.
struct Cells {
    projection: Projection,
    region: Rect,
    per_mm: f64,
    columns: usize,
    bits: Vec<u64>,
}

impl Cells {
    fn new(projection: Projection, region: &Extent, cell_mm: f64) -> Cells {
        let region = projection.flat_extent(region);
        let per_mm = 1.0 / cell_mm;
        let columns = (region.width * per_mm) as usize + 1;
        let rows = (region.height * per_mm) as usize + 1;
        Cells { projection, region, per_mm, columns, bits: vec![0; (columns * rows).div_ceil(64)] }
    }

    fn clear(&mut self) {
        self.bits.fill(0);
    }

    /// Marks the cells along a line.
    fn mark(&mut self, from: [f64; 3], to: [f64; 3]) {
        let Some((start, step, steps)) = self.walk(from, to) else {
            return;
        };
        for nth in 0..=steps {
            let cell = self.cell([0, 1].map(|axis| start[axis] + step[axis] * nth as f64));
            if let Some(word) = self.bits.get_mut(cell / 64) {
                *word |= 1 << (cell % 64);
            }
        }
    }

    /// True if somewhere along a line neither the cell nor the next nearest one, across or up, is marked.
    fn is_new(&self, from: [f64; 3], to: [f64; 3]) -> bool {
        let Some((start, step, steps)) = self.walk(from, to) else {
            return false;
        };
        (0..=steps).any(|nth| {
            let [x, y] = [0, 1].map(|axis| start[axis] + step[axis] * nth as f64);
            let nearest = |at: f64| if at.fract() < 0.5 { at - 1.0 } else { at + 1.0 };
            !self.is_marked([x, y]) && !self.is_marked([nearest(x), y]) && !self.is_marked([x, nearest(y)])
        })
    }

    fn is_marked(&self, at: [f64; 2]) -> bool {
        let cell = self.cell(at);
        self.bits.get(cell / 64).is_some_and(|word| word >> (cell % 64) & 1 == 1)
    }

    fn cell(&self, [column, row]: [f64; 2]) -> usize {
        row as usize * self.columns + (column as usize).min(self.columns - 1)
    }

    /// The part of a line in the region, in cells: where it starts, its steps of about a cell, and their number.
    fn walk(&self, from: [f64; 3], to: [f64; 3]) -> Option<([f64; 2], [f64; 2], usize)> {
        let part = clip(&self.region, self.projection.flat(from), self.projection.flat(to))?;
        let [start, end] =
            [part.from, part.to].map(|[x, y]| [(x - self.region.x) * self.per_mm, (y - self.region.y) * self.per_mm]);
        let steps = (end[0] - start[0]).abs().max((end[1] - start[1]).abs()).ceil().max(1.0);
        Some((start, [(end[0] - start[0]) / steps, (end[1] - start[1]) / steps], steps as usize))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(y: f64, feed: f64) -> Piece {
        Piece { kind: Kind::Feed, from: [0.0, y, 0.0], to: [100.0, y, 0.0], arc: None, feed }
    }

    #[test]
    fn a_row_in_the_same_cells_goes_and_every_other_stays() {
        let region = Extent { min: [0.0; 3], max: [100.0, 100.0, 0.0] };
        let mut feeds = Feeds::new();
        feeds.note(100.0);
        feeds.note(200.0);
        // The second lies in the cells of the first; the third has another colour, the fourth another place.
        let mut pieces = vec![row(50.1, 100.0), row(50.2, 100.0), row(50.2, 200.0), row(53.0, 100.0)];
        drop_covered(&mut pieces, &region, 1.0, &feeds);
        assert_eq!(pieces, [row(50.1, 100.0), row(50.2, 200.0), row(53.0, 100.0)]);
        let before = pieces.clone();
        drop_covered(&mut pieces, &region, 1.0, &feeds);
        assert_eq!(pieces, before, "dropping twice drops no more");
    }
}
