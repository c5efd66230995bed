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

/// The most segments that are kept, an arc counting for several.
pub(crate) const MOST_SEGMENTS: usize = 150_000;

/// A coarsening is enough if it leaves at most so many. One that costs time makes more room, so that the next is far
/// away, and one that can be seen even more.
const ENOUGH: usize = MOST_SEGMENTS / 8 * 7;
const ENOUGH_COVERED: usize = MOST_SEGMENTS / 4 * 3;
const ENOUGH_VISIBLY: usize = MOST_SEGMENTS / 2;

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
        if self.segments >= MOST_SEGMENTS {
            self.coarsen(survey);
        }
    }

    /// Everything that is kept, in the order in which it came.
    pub fn pieces(&self, survey: &Survey) -> Vec<Piece> {
        let mut pieces = self.pieces.clone();
        if let Some(like) = &self.first_of_chain {
            put_chain(&self.chain, like, self.tolerance_mm, &mut pieces);
        }
        if self.cell_mm > 0.0 {
            // What came after the last coarsening is thinned out like the rest, or it would look denser.
            drop_covered(&mut pieces, &region(survey), self.cell_mm, &survey.feeds);
        }
        pieces
    }

    /// How far from its place a piece may be drawn in mm, if that is more than the sheet hides.
    pub fn visible_error_mm(&self, survey: &Survey) -> Option<f64> {
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
        if self.segments >= MOST_SEGMENTS {
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
