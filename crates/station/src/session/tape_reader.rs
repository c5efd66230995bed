//! The tape reader's speed: a block whose characters have not come yet is waited for, and the axes stand.
//!
//! The reader runs ahead by as many blocks as the control's buffer holds, and waits while that is full. A jump in the
//! tape lets it run there, at the same speed.

use std::collections::VecDeque;

use base::{Place, Seconds, SourceId};
use machine::{EventKind, Machine};
use motion::Ahead;

use super::Session;
use crate::library::Library;

/// A tape in the reader.
#[derive(Clone, Debug)]
pub(super) struct TapeReader {
    source: SourceId,
    /// Characters a second.
    speed: f64,
    /// Blocks that the buffer holds beside the one being executed.
    depth: usize,
    /// The reader stands behind this character, since then.
    at: u64,
    since: f64,
    /// When the blocks in the buffer were begun, s.
    begun: VecDeque<f64>,
    /// In a rehearsal: by how much longer its moves have lasted than they will, s.
    ahead: f64,
}

impl TapeReader {
    /// True for a block of this tape.
    fn reads(&self, place: &Place) -> bool {
        place.source == self.source && place.line > 0
    }

    /// When all of a block of the tape has been read.
    fn read_at(&self, place: &Place) -> f64 {
        let room = if self.begun.len() >= self.depth { self.begun.front().copied() } else { None };
        let rows = (place.block.end() + 1).abs_diff(self.at);
        self.since.max(room.unwrap_or(self.since)) + rows as f64 / self.speed
    }

    /// A block of the tape begins now.
    fn begin(&mut self, place: &Place, now: f64) {
        self.since = self.read_at(place);
        self.at = place.block.end() + 1;
        if self.begun.len() >= self.depth {
            self.begun.pop_front();
        }
        self.begun.push_back(now.max(self.since));
    }
}

impl<L: Library> Session<L> {
    /// The reader begins to read the selected program at the place where it goes on.
    pub(super) fn load_reader(&mut self) {
        let speed = self.configuration.machine.tape_speed;
        let interpreter = self.interpreter();
        let (Some((_, source)), true) = (interpreter.main_program(), speed > 0.0) else { return };
        let at = interpreter.pointer().map_or(0, |pointer| pointer.offset());
        let [depth, ..] = self.configuration.control.read_ahead;
        let since = self.time().0;
        let begun = VecDeque::with_capacity(depth + 1);
        self.reader = Some(TapeReader { source, speed, depth: depth.max(1), at, since, begun, ahead: 0.0 });
    }

    /// The tape stands at its head.
    pub(super) fn wind_back(&mut self) {
        if let Some(reader) = &mut self.reader {
            reader.at = 0;
        }
    }

    /// True if the block that is next has not been read when the time that is given is over.
    pub(super) fn waits_for_tape(&mut self) -> bool {
        if self.reader.is_none() || !self.between_blocks || self.met.is_some() || self.is_moving() {
            return false;
        }
        let (place, now) = (self.motion.upstream.current().place, self.machine.time().0);
        let read =
            self.reader.as_ref().filter(|reader| reader.reads(&place)).map_or(now, |reader| reader.read_at(&place));
        let limit = self.deadline.map_or(f64::INFINITY, |deadline| deadline.0).min(self.next_trip()).max(now);
        let until = read.min(limit);
        if until > now {
            self.machine.stand_until(Seconds(until), &mut self.events);
            self.tell(place, EventKind::Waited(Seconds(until - now)));
        }
        read > limit
    }

    /// A block begins, perhaps one of the tape. In a rehearsal the axes come to stand before one that is not there yet.
    pub(super) fn take_from_tape(&mut self) {
        let place = self.motion.upstream.current().place;
        let Some(reader) = self.reader.as_mut().filter(|reader| reader.reads(&place)) else { return };
        let now = self.machine.time().0 - reader.ahead;
        let late = reader.read_at(&place) - now;
        reader.begin(&place, now);
        if let (Some(met), true) = (&mut self.met, late > 0.0) {
            reader.ahead -= late;
            met.push_back(Ahead::Rest);
        }
    }

    /// In a rehearsal: a move that begins and ends at rest would not last as long if it did not.
    pub(super) fn count_time_ahead(&mut self) {
        let timed = self.motion.current();
        let sooner = if timed.feed > 0.0 { timed.duration.0 - timed.length / timed.feed * 60.0 } else { 0.0 };
        if let Some(reader) = &mut self.reader {
            reader.ahead += sooner.max(0.0);
        }
    }
}
