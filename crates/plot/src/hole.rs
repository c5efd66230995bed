//! Where the tool cuts straight down: drilled holes, and plunges that begin a cut.

use crate::piece::Piece;
use crate::stroke::Kind;

/// A place in plan where the tool cuts straight down.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct DownCut {
    /// X and Y in mm.
    pub at: [f64; 2],
    /// mm/min.
    pub feed: f64,
    /// True if the tool leaves as it came: a hole. False if it goes on cutting sideways.
    pub is_hole: bool,
}

/// The places where the path cuts straight down, in its order. A hole drilled in several pecks is one.
pub(crate) fn down_cuts(pieces: &[Piece]) -> Vec<DownCut> {
    let mut found = Vec::new();
    let mut open: Option<DownCut> = None;
    for piece in pieces {
        let here = [piece.from[0], piece.from[1]];
        let stays = piece.arc.is_none() && here == [piece.to[0], piece.to[1]];
        if open.is_some_and(|cut| cut.at != here) {
            found.extend(open.take());
        }
        if stays && piece.kind == Kind::Feed && piece.to[2] < piece.from[2] && open.is_none() {
            open = Some(DownCut { at: here, feed: piece.feed, is_hole: true });
        }
        if !stays && let Some(mut cut) = open.take() {
            cut.is_hole = piece.kind == Kind::Rapid;
            found.push(cut);
        }
    }
    found.extend(open);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(moves: &[(Kind, [f64; 3])]) -> Vec<Piece> {
        let mut from = [0.0, 0.0, 5.0];
        moves
            .iter()
            .map(|(kind, to)| {
                let piece = Piece { kind: *kind, from, to: *to, arc: None, feed: 100.0 };
                from = *to;
                piece
            })
            .collect()
    }

    #[test]
    fn a_pecked_hole_is_one_hole_and_a_plunge_is_none() {
        use Kind::{Feed, Rapid};
        let cuts = down_cuts(&path(&[
            (Rapid, [10.0, 0.0, 5.0]),
            (Feed, [10.0, 0.0, -5.0]),
            (Rapid, [10.0, 0.0, 5.0]),
            (Rapid, [10.0, 0.0, -4.0]),
            (Feed, [10.0, 0.0, -9.0]),
            (Rapid, [10.0, 0.0, 5.0]),
            (Rapid, [20.0, 0.0, 5.0]),
            (Feed, [20.0, 0.0, -3.0]),
            (Feed, [30.0, 0.0, -3.0]),
            (Feed, [30.0, 0.0, 5.0]),
        ]));
        let seen: Vec<_> = cuts.iter().map(|cut| (cut.at, cut.is_hole)).collect();
        assert_eq!(seen, [([10.0, 0.0], true), ([20.0, 0.0], false)]);
    }

    #[test]
    fn a_program_that_ends_in_the_hole_has_a_hole() {
        assert!(down_cuts(&path(&[(Kind::Feed, [0.0, 0.0, -1.0])]))[0].is_hole);
    }
}
