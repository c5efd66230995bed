//! Where a block begins, told to whoever waits for one: it is read, and nothing of it has been executed.

use base::Place;

use super::Session;
use crate::library::Library;

impl<L: Library> Session<L> {
    /// The place of a block of which nothing has been executed yet, told once for each; `None` if something else
    /// comes first.
    pub fn block_begins(&mut self) -> Option<Place> {
        let busy = !self.has_told_all()
            || self.under_way.is_some()
            || self.dwelling.is_some()
            || self.closing.is_some()
            || self.is_approaching();
        if busy || self.stopped || self.ended || self.alarm.is_some() || !self.pull() {
            return None;
        }
        self.pulled = true;
        let shaped = self.motion.upstream.current();
        // The start of the program is no block; it has the number of the first one.
        // A macro statement has the number of the block behind it, and a place of its own.
        let (block, place) = (shaped.block, shaped.place);
        let is_told = self.told.is_some_and(|(number, told)| number == block && told.block.start == place.block.start);
        if place.line == 0 || is_told {
            return None;
        }
        self.told = Some((block, place));
        Some(place)
    }

    /// As [`Session::block_begins`], but of several blocks in a line the first one only.
    pub fn line_begins(&mut self) -> Option<Place> {
        let before = self.told;
        let place = self.block_begins()?;
        let block = self.motion.upstream.current().block;
        let is_behind = before.is_some_and(|(number, told)| {
            let same_line = (told.source, told.line) == (place.source, place.line);
            same_line && told.block.start < place.block.start && block <= number + 1
        });
        (!is_behind).then_some(place)
    }
}
