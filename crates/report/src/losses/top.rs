//! The blocks that lose most, in bounded memory.
//!
//! Up to [`MOST`] blocks are counted exactly. When there are more, the lesser half is dropped, and what a dropped block
//! can have lost at most is remembered: a block that comes later may have lost so much before (the space-saving count of
//! Metwally, Agrawal and El Abbadi 2005, dropping many at a time).

use std::collections::BTreeMap;

use base::Place;
use meaning::CodeOut;

use super::cause::{CAUSES, Cause, Detail};

/// Blocks that are counted at the same time.
pub const MOST: usize = 8192;

/// What a block has lost.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Block {
    pub place: Place,
    /// By cause, s.
    pub lost: [f64; CAUSES],
    /// What it may have lost before it was counted, s.
    pub maybe: f64,
    /// Executions.
    pub times: u64,
    /// The numbers of each cause's last loss.
    pub details: [Detail; CAUSES],
}

impl Block {
    /// By all causes together, s.
    pub fn all(&self) -> f64 {
        self.lost.iter().sum()
    }
}

/// The list.
#[derive(Default)]
pub struct Top {
    blocks: BTreeMap<(u32, u64), Block>,
    /// What any block that is not on the list has lost at most, s.
    floor: f64,
    /// The numbers of the last cut, until it is known why it ended as it did.
    pub pending: Detail,
}

impl Top {
    /// A block loses time; `is_done` if its execution has been counted as done.
    pub fn add(&mut self, place: &Place, cause: Cause, seconds: f64, detail: Detail, is_done: bool) {
        let maybe = self.floor;
        let block = self.blocks.entry(key(place)).or_insert_with(|| Block {
            place: *place,
            lost: [0.0; CAUSES],
            maybe,
            times: u64::from(is_done),
            details: [Detail::default(); CAUSES],
        });
        block.lost[cause as usize] += seconds;
        block.details[cause as usize] = detail;
        if self.blocks.len() > MOST {
            self.drop_half();
        }
    }

    /// The code that a block has waited for.
    pub fn name(&mut self, place: &Place, code: Option<CodeOut>) {
        if let Some(block) = self.blocks.get_mut(&key(place)) {
            block.details[Cause::Waiting as usize].code = code;
        }
    }

    /// A block has been executed.
    pub fn done(&mut self, place: &Place) {
        if let Some(block) = self.blocks.get_mut(&key(place)) {
            block.times += 1;
        }
    }

    fn drop_half(&mut self) {
        let mut all: Vec<f64> = self.blocks.values().map(|block| block.all() + block.maybe).collect();
        let middle = all.len() / 2;
        let (_, border, _) = all.select_nth_unstable_by(middle, f64::total_cmp);
        let border = *border;
        self.blocks.retain(|_, block| block.all() + block.maybe > border);
        self.floor = self.floor.max(border);
    }

    /// The worst of the blocks, the worst first.
    pub fn worst(&self, count: usize) -> Vec<&Block> {
        let mut all: Vec<_> = self.blocks.values().collect();
        all.sort_by(|a, b| b.all().total_cmp(&a.all()));
        all.truncate(count);
        all
    }
}

fn key(place: &Place) -> (u32, u64) {
    (place.source.0, place.block.start)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(start: u64) -> Place {
        let mut place = Place::default();
        place.block.start = start;
        place
    }

    /// A block that loses much is found among many, and no bound is broken.
    #[test]
    fn what_loses_most_is_found_in_bounded_memory() {
        let mut top = Top::default();
        let (many, heavy) = (100_000, 7);
        for turn in 0..many {
            top.add(&at(1000 + turn), Cause::Corner, 1.0 + (turn % 10) as f64 / 100.0, Detail::default(), false);
            if turn % 10 == 0 {
                top.add(&at(heavy), Cause::Code, 1.0, Detail::default(), false);
            }
            assert!(top.blocks.len() <= MOST);
        }
        let worst = top.worst(1);
        let first = worst.first().expect("there are blocks");
        assert_eq!(first.place.block.start, heavy);
        assert!((first.all() - many as f64 / 10.0).abs() < 1e-9 && first.maybe == 0.0, "it never left the list");
        assert!(top.floor >= 1.0, "what was dropped had lost so much");
        let truth = |block: &Block| 1.0 + ((block.place.block.start - 1000) % 10) as f64 / 100.0;
        for block in top.blocks.values().filter(|block| block.place.block.start != heavy) {
            assert!(block.all() <= truth(block) + 1e-9 && truth(block) <= block.all() + block.maybe + 1e-9);
        }
    }

    #[test]
    fn repetitions_of_a_block_are_one_block() {
        let mut top = Top::default();
        for _ in 0..3 {
            top.add(&at(5), Cause::Dwell, 0.5, Detail::default(), false);
            top.done(&at(5));
        }
        top.done(&at(6));
        let worst = top.worst(9);
        assert_eq!(worst.iter().map(|block| (block.times, block.all())).collect::<Vec<_>>(), [(3, 1.5)]);
    }
}
