//! The axes stand at the end of the first move at whose end they can: what follows it is no longer known.

use super::{JerkHorizon, Joint, Open, Piece};
use crate::way::Way;

/// A speed as little above what can be braked from is rounding.
const ROUNDING: f64 = 1e-12;
/// A way as short as this is none, mm.
const NOTHING: f64 = 1e-9;

impl JerkHorizon {
    /// Forgets what lies behind the end of the first move at whose end the axes can stand; how many moves are left.
    pub fn stand_soon(&mut self) -> usize {
        self.cut_here();
        let (first, s, from) = self.plan_is();
        let (mut square, mut moves) = (from, 0);
        for (index, piece) in self.pieces.iter().enumerate() {
            if index >= first {
                let way = if index == first { piece.end() - s } else { piece.length };
                square -= 2.0 * piece.push * way;
            }
            if !piece.ends {
                continue;
            }
            moves += 1;
            if piece.stops || (index >= first && square <= from * ROUNDING) {
                self.forget_behind(index);
                return moves;
            }
        }
        // As far as is known the axes cannot stand before the last move's end: there they always can.
        self.stop();
        self.settle_anew();
        self.pieces.iter().filter(|piece| piece.ends).count()
    }

    fn forget_behind(&mut self, last: usize) {
        self.pieces.truncate(last + 1);
        self.firm = self.pieces.len();
        let Some(&piece) = self.pieces.back() else { return };
        let mover = piece.moves[0];
        self.ways.truncate((piece.way + 1).saturating_sub(self.first_way) as usize);
        self.asked.truncate((mover + 1).saturating_sub(self.first_move) as usize);
        // The feed of a move that is no longer known does not matter.
        for piece in &mut self.pieces {
            piece.moves[1] = piece.moves[1].min(mover);
        }
        (self.last, self.closed) = (None, true);
        self.polygon.begin(0.0, 0, 0.0);
        if let Some(piece) = self.pieces.back_mut() {
            piece.stops = true;
        }
        self.zones.clear();
        self.add_rest_of_corner(&piece, mover);
        self.settle_anew();
    }

    /// A rounded corner is left out: from where the axes stand they go on to the end of the move.
    fn add_rest_of_corner(&mut self, piece: &Piece, mover: u64) {
        let (Some(way), Some(asked)) = (self.way(piece.way), self.asked(mover)) else { return };
        let way = Way::line(&way.at(piece.end()), &asked.to, self.limits.count);
        if way.length() <= NOTHING {
            return;
        }
        if let Some(piece) = self.pieces.back_mut() {
            piece.ends = false;
        }
        let open = Open { way, mover, start: Joint::Rest };
        self.window = self.wanted_window(&open);
        self.push(&way, 0.0, way.length(), [mover; 2]);
        if let Some(piece) = self.pieces.back_mut() {
            (piece.ends, piece.stops, piece.stroke) = (true, true, true);
        }
        self.zones.clear();
    }

    fn settle_anew(&mut self) {
        (self.settled, self.goal, self.ready) = (0, 0, false);
        self.settle();
    }
}
