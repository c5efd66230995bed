//! The axes stand at the end of the first move at whose end they can: what follows it is no longer known.

use super::{Horizon, Open, pace};
use crate::cell::Ends;

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
            if self.stand_at(index) {
                self.look_from_here();
                return moves;
            }
        }
        // As far as is known the axes cannot stand before the last move's end: there they always can.
        let last = usize::from(self.open.is_some());
        self.stop();
        self.look_from_here();
        moves + last
    }

    /// Makes a stop of the end of the move that ends in this cell; false if the axes are too fast for that, or in the
    /// corner behind it already: then nothing changes.
    fn stand_at(&mut self, index: usize) -> bool {
        let cell = &self.cells[index];
        let (way, moves, stops) = (cell.way, cell.moves, cell.stops);
        if moves[0] != moves[1] {
            return self.unround(way, moves[0]);
        }
        self.cells[index].stops = true;
        let stands = stops || self.can_stand();
        self.cells[index].stops = stands;
        if stands {
            self.cells.truncate(index + 1);
            self.forget_behind(way, moves[0]);
        }
        stands
    }

    /// Makes a stop of a rounded corner: the way before it is driven to its end. False if the axes cannot stand there.
    fn unround(&mut self, blend: u64, before: u64) -> bool {
        let first = self.cells.iter().position(|cell| cell.way == blend);
        let (Some(first @ 1..), Some(round)) = (first, self.way(blend)) else { return false };
        let arm = round.length() / 2.0;
        let Some(way) = self.way(blend - 1).copied() else { return false };
        let from = way.length() - arm;
        let corner = self.cells.split_off(first);
        let gain = self.cells[first - 1].gain;
        self.link(pace(&way, from));
        let end = Open { way, number: blend - 1, mover: before, from, from_rest: false, enters: f64::INFINITY };
        self.end_at_rest(&end);
        let stands = self.can_stand();
        if stands {
            self.forget_behind(blend - 1, before);
        } else {
            self.cells.truncate(first);
            self.cells[first - 1].gain = gain;
            self.cells.extend(corner);
        }
        stands
    }

    /// True if the axes can stand at the next stop, if they begin to slow down now.
    fn can_stand(&self) -> bool {
        let mut x = self.speed_squared();
        for cell in &self.cells {
            if cell.braking(x).is_some() {
                return true;
            }
            if cell.stops {
                return false;
            }
            x = cell.slowest_after(x) / cell.gain;
        }
        true
    }

    /// The last cell, of this way and move, is the last thing known.
    fn forget_behind(&mut self, way: u64, mover: u64) {
        self.ways.truncate((way + 1).saturating_sub(self.first_way) as usize);
        self.asked.truncate((mover + 1).saturating_sub(self.first_move) as usize);
        (self.open, self.closed) = (None, true);
    }

    fn look_from_here(&mut self) {
        self.settled = 0;
        self.look_again();
    }
}
