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
    /// A block of the tape is to begin now: when all of it has been read.
    fn read(&mut self, place: &Place, now: f64) -> f64 {
        let room = if self.begun.len() >= self.depth { self.begun.pop_front() } else { None };
        let end = place.block.end() + 1;
        self.since = self.since.max(room.unwrap_or(self.since)) + end.abs_diff(self.at) as f64 / self.speed;
        self.at = end;
        self.begun.push_back(now.max(self.since));
        self.since
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

    /// A block begins: if it comes from the tape, not before it has been read.
    pub(super) fn wait_for_tape(&mut self) {
        let place = self.motion.upstream.current().place;
        let Some(reader) = &mut self.reader else { return };
        if place.source != reader.source || place.line == 0 {
            return;
        }
        let now = self.machine.time().0 - reader.ahead;
        let read = reader.read(&place, now);
        if read <= now {
            return;
        }
        match &mut self.met {
            // The axes come to stand before a block that will not be there.
            Some(met) => {
                reader.ahead -= read - now;
                met.push_back(Ahead::Rest);
            }
            None => {
                self.machine.stand_until(Seconds(read), &mut self.events);
                self.tell(place, EventKind::Waited(Seconds(read - now)));
            }
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
