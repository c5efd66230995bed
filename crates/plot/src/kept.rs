//! The path as far as it is kept: a bounded number of pieces, however many strokes come in.
//!
//! A straight chain of one kind and feed is simplified as it arrives. When the bound is reached, everything kept is
//! coarsened, first within what the sheet can show, then by leaving out what is covered, and only if that
//! does not help, visibly.

use crate::cover::drop_covered;
use crate::extent::Extent;
use crate::feeds::Feeds;
use crate::piece::Piece;
use crate::simplify::{WINDOW, simplify};
use crate::survey::Survey;

/// The most segments that are drawn, an arc counting for several.
pub(crate) const MOST_DRAWN: usize = 150_000;

/// Twice as many are kept, so that coarsening is seldom.
const MOST_KEPT: usize = 2 * MOST_DRAWN;

/// A coarsening is enough if it leaves at most so many. One that costs time makes more room, so that the next is far
/// away, and one that can be seen even more.
const ENOUGH: usize = MOST_DRAWN / 8 * 7;
const ENOUGH_COVERED: usize = MOST_DRAWN / 4 * 3;
const ENOUGH_VISIBLY: usize = MOST_DRAWN / 2;

/// The tolerance in mm of a path that is not coarsened: a tenth of a micrometre joins what is collinear.
const COLLINEAR_MM: f64 = 1e-4;

/// The tolerance of the first coarsening and the greatest that the sheet does not show, as parts of the extent. Each
/// coarsening is at least twice the one before, so that all errors together stay about 1/4000.
const FIRST_PART: f64 = 1.0 / 100_000.0;
const FAITHFUL_PART: f64 = 1.0 / 6_000.0;

/// The least size of a cell in which a second line is not drawn, as a part of the extent.
const CELL_PART: f64 = 1.0 / 8_192.0;

/// Looking for what is covered goes through at most so many cells: where lines are very long, cells are made larger.
const MOST_CELLS: f64 = 4e7;

/// The region in which the path is kept reaches so far beyond the cutting moves, as a part of the extent.
const REACH_PART: f64 = 0.25;

/// The path as it is drawn.
pub(crate) struct Drawn {
    pub pieces: Vec<Piece>,
    /// How far from its place a piece may be in mm, if that is more than the sheet hides.
    pub visible_error_mm: Option<f64>,
    /// How far from its place a piece may be in any case, mm.
    pub error_mm: f64,
}

/// The pieces that are kept, and the straight chain that is still growing.
#[derive(Clone, Debug)]
pub(crate) struct KeptPath {
    pieces: Vec<Piece>,
    /// The points of the growing chain; its kind and feed are those of the piece that began it.
    chain: Vec<[f64; 3]>,
    first_of_chain: Option<Piece>,
    /// The segments of the pieces.
    segments: usize,
    tolerance_mm: f64,
    /// The size of the cells in which nothing is drawn twice; 0 as long as that was not needed.
    cell_mm: f64,
}

impl KeptPath {
    /// An empty path.
    pub fn new() -> KeptPath {
        KeptPath {
            pieces: Vec::new(),
            chain: Vec::with_capacity(WINDOW + 1),
            first_of_chain: None,
            segments: 0,
            tolerance_mm: COLLINEAR_MM,
            cell_mm: 0.0,
        }
    }

    /// Takes a piece; the survey has already taken note of it.
    pub fn push(&mut self, piece: &Piece, survey: &Survey) {
        if piece.arc.is_some() {
            self.end_chain(survey);
            self.pieces.push(*piece);
            self.segments += piece.segments();
        } else {
            self.lengthen_chain(piece, survey);
        }
        if self.segments >= MOST_KEPT {
            self.coarsen(survey);
        }
    }

    /// What is to be drawn, in the order in which it came.
    pub fn drawn(&self, survey: &Survey) -> Drawn {
        let mut path = self.clone();
        path.end_chain(survey);
        if path.segments > MOST_DRAWN {
            path.coarsen(survey);
        } else if path.cell_mm > 0.0 {
            // What came after the last coarsening is thinned out like the rest, or it would look denser.
            path.leave_out_covered(survey);
        }
        let visible_error_mm = path.visible_error_mm(survey);
        Drawn { error_mm: path.tolerance_mm.max(path.cell_mm * 0.5), pieces: path.pieces, visible_error_mm }
    }

    fn visible_error_mm(&self, survey: &Survey) -> Option<f64> {
        let hidden = survey.subject().span() * FAITHFUL_PART;
        let error = self.tolerance_mm.max(self.cell_mm * 0.5);
        (self.tolerance_mm > COLLINEAR_MM && error > hidden * 1.5).then_some(error)
    }

    fn lengthen_chain(&mut self, piece: &Piece, survey: &Survey) {
        let goes_on = self.first_of_chain.as_ref().is_some_and(|first| joins(first, piece, &survey.feeds))
            && self.chain.last() == Some(&piece.from);
        if !goes_on || self.chain.len() > WINDOW {
            self.end_chain(survey);
            self.chain.push(piece.from);
            self.first_of_chain = Some(*piece);
        }
        self.chain.push(piece.to);
    }

    fn end_chain(&mut self, survey: &Survey) {
        if let Some(like) = self.first_of_chain.take() {
            let before = self.pieces.len();
            put_chain(&self.chain, &like, self.tolerance_mm, &mut self.pieces);
            self.segments += self.pieces.len() - before;
        }
        self.chain.clear();
        if self.segments >= MOST_KEPT {
            self.coarsen(survey);
        }
    }

    /// Brings the number of pieces down, by the least harmful means that does.
    fn coarsen(&mut self, survey: &Survey) {
        let span = survey.subject().span().max(COLLINEAR_MM);
        while let Some(tolerance_mm) = self.next_hidden_tolerance(span) {
            self.tolerance_mm = tolerance_mm;
            self.simplify_again(&survey.feeds);
            if self.segments <= ENOUGH {
                return;
            }
        }
        let length: f64 = self.pieces.iter().map(|piece| piece.length_mm().min(span)).sum();
        let least = (span * CELL_PART).max(length / MOST_CELLS);
        self.cell_mm = self.cell_mm.max(libm::exp2(libm::log2(least).ceil()));
        self.leave_out_covered(survey);
        let mut enough = ENOUGH_COVERED;
        while self.segments > enough {
            enough = ENOUGH_VISIBLY;
            self.tolerance_mm *= 2.0;
            self.cell_mm *= 2.0;
            self.simplify_again(&survey.feeds);
            self.leave_out_covered(survey);
        }
    }

    fn leave_out_covered(&mut self, survey: &Survey) {
        drop_covered(&mut self.pieces, &region(survey), self.cell_mm, &survey.feeds);
        self.count();
    }

    fn count(&mut self) {
        self.segments = self.pieces.iter().map(Piece::segments).sum();
    }

    /// The next greater tolerance, if it is worth a pass and the sheet does not show it.
    fn next_hidden_tolerance(&self, span_mm: f64) -> Option<f64> {
        let next = (self.tolerance_mm * 4.0).max(span_mm * FIRST_PART).min(span_mm * FAITHFUL_PART);
        (next >= self.tolerance_mm * 2.0).then_some(next)
    }

    /// Joins what is kept with the present tolerance: small arcs become chords, chains lose points.
    fn simplify_again(&mut self, feeds: &Feeds) {
        let mut fewer: Vec<Piece> = Vec::with_capacity(self.pieces.len());
        let mut like: Option<Piece> = None;
        let mut chain: Vec<[f64; 3]> = Vec::new();
        for mut piece in self.pieces.drain(..) {
            if piece.curve().is_some_and(|curve| curve.bend_mm() <= 0.25 * self.tolerance_mm) {
                piece.arc = None;
            }
            let goes_on = piece.arc.is_none()
                && chain.last() == Some(&piece.from)
                && like.as_ref().is_some_and(|first| joins(first, &piece, feeds));
            if !goes_on {
                if let Some(like) = like.take() {
                    put_chain(&chain, &like, self.tolerance_mm, &mut fewer);
                }
                chain.clear();
                if piece.arc.is_some() {
                    fewer.push(piece);
                    continue;
                }
                chain.push(piece.from);
                like = Some(piece);
            }
            chain.push(piece.to);
        }
        if let Some(like) = like {
            put_chain(&chain, &like, self.tolerance_mm, &mut fewer);
        }
        self.pieces = fewer;
        self.count();
    }
}

/// Where the path is kept when lines are left out.
fn region(survey: &Survey) -> Extent {
    survey.subject().grown(survey.subject().span() * REACH_PART)
}

/// True if the second piece is drawn in the first one's way.
fn joins(first: &Piece, second: &Piece, feeds: &Feeds) -> bool {
    first.kind == second.kind && feeds.alike(first.feed, second.feed)
}

/// Appends a chain of points as straight pieces.
fn put_chain(chain: &[[f64; 3]], like: &Piece, tolerance_mm: f64, pieces: &mut Vec<Piece>) {
    let mut points = Vec::with_capacity(chain.len());
    simplify(chain, tolerance_mm, &mut points);
    let straight = points.windows(2).map(|pair| Piece { from: pair[0], to: pair[1], arc: None, ..*like });
    pieces.extend(straight.filter(|piece| piece.from != piece.to));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simplify::Line;
    use crate::stroke::{Arc, Kind, Plane};

    /// Pushes pieces and gives what is kept of them.
    fn kept(pieces: impl Iterator<Item = Piece>) -> (KeptPath, Survey) {
        let (mut path, mut survey) = (KeptPath::new(), Survey::new());
        for piece in pieces {
            survey.note(&piece, 1);
            path.push(&piece, &survey);
            assert!(path.segments <= MOST_KEPT + WINDOW);
        }
        (path, survey)
    }

    fn straight(from: [f64; 3], to: [f64; 3], feed: f64) -> Piece {
        Piece { kind: Kind::Feed, from, to, arc: None, feed }
    }

    fn surface(row: usize, column: usize) -> [f64; 3] {
        let column = if row.is_multiple_of(2) { column } else { 999 - column };
        let [x, y] = [column as f64 * 0.2, row as f64 * 0.2];
        [x, y, 6.0 * libm::sin(x / 4.0) * libm::cos(y / 14.0)]
    }

    #[test]
    fn a_coarsened_surface_is_everywhere_near_its_place() {
        let points: Vec<_> = (0..500_000).map(|nth| surface(nth / 1000, nth % 1000)).collect();
        let (path, survey) = kept(points.windows(2).map(|pair| straight(pair[0], pair[1], 900.0)));
        let drawn = path.drawn(&survey);
        assert!(path.tolerance_mm > COLLINEAR_MM, "the bound was reached");
        assert_eq!(drawn.visible_error_mm, None);
        let segments: usize = drawn.pieces.iter().map(Piece::segments).sum();
        assert!(segments <= MOST_DRAWN);
        let lines: Vec<Line> = drawn.pieces.iter().map(|piece| Line::new(piece.from, piece.to)).collect();
        let allowed_mm = survey.subject().span() / 4000.0;
        for point in points.iter().step_by(2477) {
            let nearest = lines.iter().map(|line| line.distance_squared(*point)).fold(f64::INFINITY, f64::min).sqrt();
            assert!(nearest <= allowed_mm, "{nearest} mm away, {allowed_mm} allowed");
        }
        // Nothing was drawn that is not on the surface.
        for piece in drawn.pieces.iter().step_by(97) {
            let [x, y, z] = std::array::from_fn(|axis| 0.5 * (piece.from[axis] + piece.to[axis]));
            assert!((z - 6.0 * libm::sin(x / 4.0) * libm::cos(y / 14.0)).abs() <= 2.0 * allowed_mm);
        }
    }

    #[test]
    fn a_short_program_is_kept_as_it_is() {
        let pieces = [
            straight([0.0; 3], [10.0, 0.0, 0.0], 100.0),
            straight([10.0, 0.0, 0.0], [20.0, 0.0, 0.0], 100.0),
            straight([20.0, 0.0, 0.0], [30.0, 0.0, 0.0], 101.0),
            straight([30.0, 0.0, 0.0], [30.0, 0.01, 0.0], 101.0),
        ];
        let (path, survey) = kept(pieces.into_iter());
        let joined = straight([0.0; 3], [20.0, 0.0, 0.0], 100.0);
        assert_eq!(path.drawn(&survey).pieces, [joined, pieces[2], pieces[3]], "only the collinear ones are joined");
    }

    #[test]
    fn a_million_collinear_strokes_are_a_handful() {
        let point = |nth: u32| [f64::from(nth) * 0.001, 0.0, 0.0];
        let (path, survey) = kept((0..1_000_000).map(|nth| straight(point(nth), point(nth + 1), 100.0)));
        assert!(path.drawn(&survey).pieces.len() < 2_500);
    }

    #[test]
    fn many_circles_stay_circles_and_are_bounded() {
        let circle = |nth: u32| {
            let [x, y] = [f64::from(nth % 300), f64::from(nth / 300)];
            let arc = Some(Arc { plane: Plane::Xy, center: [x, y], sweep_deg: 360.0 });
            Piece { arc, ..straight([x + 2.0, y, 0.0], [x + 2.0, y, 0.0], 100.0) }
        };
        let (path, survey) = kept((0..60_000).map(circle));
        let drawn = path.drawn(&survey);
        assert!(drawn.pieces.iter().map(Piece::segments).sum::<usize>() <= MOST_DRAWN);
        assert!(drawn.pieces.len() > 5_000 && drawn.pieces.iter().all(|piece| piece.arc.is_some()));
    }
}
