//! Backwards over the horizon: the highest speed at every cell from which the rest can be kept to.

use super::{Horizon, MOST_CELLS};
use crate::cell::Ends;

/// Cells that are looked at together at least.
const BATCH: usize = 64;

/// Moves that are asked for at a setpoint before they are needed.
const AT_A_TIME: usize = 4;

impl Horizon {
    /// True while more of what follows would let the next move be driven faster, or might; with nothing more to come,
    /// [`Horizon::stop`] says so.
    pub fn wants_more(&mut self) -> bool {
        let seen = self.cells.len();
        if self.closed || seen >= MOST_CELLS {
            self.settle();
            return false;
        }
        if seen < self.goal && !self.is_live {
            return true;
        }
        if seen >= self.goal {
            self.settle();
        }
        let unsettled = (seen - self.settled).max(BATCH);
        let is_enough = self.next_is_settled();
        if is_enough {
            if self.spare == 0 || self.settled >= unsettled {
                return false;
            }
            self.spare -= 1;
        }
        if seen >= self.goal {
            self.goal = (seen + unsettled).min(MOST_CELLS);
        }
        true
    }

    /// Setpoints are asked for one by one: so that no one of them takes long, a few moves are asked for at each, before
    /// they are needed. Or whole moves are driven.
    pub(super) fn set_live(&mut self, is_live: bool) {
        (self.is_live, self.spare) = (is_live, if is_live { AT_A_TIME } else { 0 });
    }

    /// The cells have changed, so their speeds are to be found anew.
    pub(super) fn look_again(&mut self) {
        (self.goal, self.looked) = (0, 0);
        self.settle();
    }

    /// The cell in which the next move ends.
    pub(super) fn next_end(&self) -> Option<usize> {
        // Of a corner under way the first half may be done.
        let from = usize::from(self.is_border_passed());
        (from..self.cells.len()).find(|&index| self.cells[index].ends != Ends::Not)
    }

    /// True if the next move can be driven as fast as if all the rest were known.
    fn next_is_settled(&self) -> bool {
        let end = self.next_end();
        // What is driven in a cell depends on the speed with which the next may begin.
        end.is_some_and(|end| end + 1 < self.settled || (self.cells[end].stops && end < self.looked))
    }

    /// The highest speed that may be driven at the end of a cell.
    pub(super) fn end_of(&self, index: usize) -> f64 {
        match (self.cells.get(index), self.cells.get(index + 1)) {
            (Some(cell), Some(next)) if !cell.stops => next.most * cell.gain,
            _ => 0.0,
        }
    }

    /// Gives every cell that is not final yet its highest speed, and finds which of them are final.
    fn settle(&mut self) {
        let seen = self.cells.len();
        let mut final_from = if self.closed { seen } else { self.settled };
        let mut entered_at = 0.0;
        // The last final one again: its own speed stays, but it may now lead to a higher one.
        let from = self.settled.saturating_sub(1);
        for (index, cell) in self.cells.range_mut(from..).enumerate().rev() {
            let index = from + index;
            let end = if cell.stops { 0.0 } else { entered_at * cell.gain };
            let before = [cell.peak, cell.leads_to];
            let is_held = cell.settle(end);
            entered_at = cell.most;
            // Its own limits hold it, or a stop: not where the look-ahead ends.
            if final_from <= index && (cell.stops || is_held) {
                final_from = index + 1;
            }
            // What lies before it was found with the same speed.
            if index < self.looked && before == [cell.peak, cell.leads_to] {
                break;
            }
        }
        self.looked = seen;
        self.settled = final_from.max(self.settled);
    }
}
