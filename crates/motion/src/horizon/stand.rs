//! The axes stand at the end of the first move at whose end they can: what follows it is no longer known.

use super::Horizon;
use crate::cell::{Cell, Edge, Ends};

/// A speed as little above what can be braked from is rounding.
const ROUNDING: f64 = 1.0 + 1e-9;

impl Horizon {
    /// Forgets what lies behind the end of the first move at whose end the axes can stand; how many moves are left.
    pub fn stand_soon(&mut self) -> usize {
        self.cut_here();
        let mut moves = 0;
        for index in 0..self.cells.len() {
            if self.cells[index].ends == Ends::Not {
                continue;
            }
            moves += 1;
            if self.cells[index].stops || self.can_stand(index) {
                self.forget_behind(index);
                return moves;
            }
        }
        // As far as is known the axes cannot stand before the last move's end: there they always can.
        self.stop();
        self.settled = 0;
        self.look_again();
        moves + 1
    }

    /// True if the axes can stand where the move ends that ends in this cell.
    fn can_stand(&self, last: usize) -> bool {
        let mut most = self.up_to_border(last).most_before(0.0);
        for cell in self.cells.range(..last).rev() {
            let end = if cell.stops { 0.0 } else { most * cell.gain };
            most = cell.most_before(end);
        }
        self.speed_squared() <= most * ROUNDING
    }

    /// The part of a cell up to the end of its move.
    fn up_to_border(&self, index: usize) -> Cell {
        let cell = &self.cells[index];
        let (Ends::At(border), Some(way)) = (cell.ends, self.way(cell.way)) else { return *cell };
        let part = [cell.part[0], border.max(cell.part[0])];
        let edges = part.map(|s| Edge::new(way, s));
        let rate = self.rate(cell.moves);
        let mut part = Cell::bent(&self.limits, cell.way, part, [&edges[0], &edges[1]], rate, cell.share);
        (part.moves, part.feed_allows) = (cell.moves, cell.feed_allows);
        part
    }

    fn forget_behind(&mut self, last: usize) {
        let mut cell = self.up_to_border(last);
        (cell.ends, cell.stops) = (Ends::AtEnd, true);
        self.cells.truncate(last);
        self.cells.push_back(cell);
        self.ways.truncate((cell.way + 1).saturating_sub(self.first_way) as usize);
        self.asked.truncate((cell.moves[1] + 1).saturating_sub(self.first_move) as usize);
        (self.open, self.closed) = (None, true);
        self.settled = 0;
        self.look_again();
    }
}
