//! The control's buffer: one block after the other is made ready while there is room for it.
//!
//! Making one ready takes a time. It begins when the one before is ready and a place is free: places are freed by the
//! blocks that are taken for execution. A block that is wanted before it is ready is waited for; the axes starve.

use std::collections::VecDeque;

/// The times of the blocks. Seconds since some beginning.
#[derive(Clone, Debug)]
pub struct Buffer {
    block_s: f64,
    places: usize,
    /// When the last block became ready.
    ready: f64,
    /// When as many blocks as there are places were taken, the last ones.
    taken: VecDeque<f64>,
}

impl Buffer {
    /// An empty one with so many places.
    pub fn new(block_s: f64, places: usize) -> Buffer {
        let places = places.max(1);
        Buffer { block_s, places, ready: 0.0, taken: VecDeque::with_capacity(places) }
    }

    /// Takes the next block: how long it is waited for from now on.
    pub fn take(&mut self, now: f64) -> f64 {
        if self.block_s <= 0.0 {
            return 0.0;
        }
        let mut begun = self.ready;
        if self.taken.len() == self.places {
            begun = begun.max(self.taken.pop_front().unwrap_or(begun));
        }
        self.ready = begun + self.block_s;
        let start = now.max(self.ready);
        self.taken.push_back(start);
        start - now
    }

    /// What is not taken yet is read only from now on.
    pub fn empty(&mut self, now: f64) {
        self.ready = now;
        self.taken.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The times at which blocks begin that take so long each.
    fn starts(buffer: &mut Buffer, lengths: &[f64]) -> Vec<f64> {
        let (mut now, mut starts) = (0.0, Vec::new());
        for length in lengths {
            now += buffer.take(now);
            starts.push(now);
            now += length;
        }
        starts
    }

    #[test]
    fn short_blocks_come_at_the_rate_at_which_they_are_made_ready() {
        let starts = starts(&mut Buffer::new(1.0, 2), &[0.25; 6]);
        assert_eq!(starts, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    }

    #[test]
    fn what_was_made_ready_in_a_long_block_is_used_up() {
        // By hand, two places: the long block begins at 1; the next are ready at 2 and 3, and wait. At 11 the first of
        // them is taken, which frees a place: the third is ready at 12, then one a second.
        let starts = starts(&mut Buffer::new(1.0, 2), &[10.0, 0.25, 0.25, 0.25, 0.25]);
        assert_eq!(starts, [1.0, 11.0, 11.25, 12.0, 13.0]);
    }

    #[test]
    fn more_places_hold_more() {
        let lengths = [20.0, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25];
        let waited = |places| {
            let starts = starts(&mut Buffer::new(1.0, places), &lengths);
            starts.windows(2).zip(lengths).filter(|(pair, length)| pair[1] - pair[0] > length + 1e-9).count()
        };
        // By hand: two places hold the first two of the nine short ones, four hold four and the fifth is ready just in
        // time, seven hold seven and the other two are ready while these are used up.
        assert_eq!([2, 4, 7].map(waited), [7, 4, 0]);
    }

    #[test]
    fn without_a_time_nothing_waits_and_emptied_it_begins_anew() {
        assert_eq!(starts(&mut Buffer::new(0.0, 2), &[0.0; 100]), [0.0; 100]);
        let mut buffer = Buffer::new(1.0, 2);
        starts(&mut buffer, &[10.0]);
        buffer.empty(11.0);
        assert_eq!(buffer.take(11.0), 1.0);
    }
}
