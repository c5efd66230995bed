//! The control's buffer: blocks read and not yet done, each with its own state.

use crate::command::Command;

/// Blocks that can be held, above any control's own depth (two ordinarily, up to seven in buffering mode).
const HELD: usize = 16;

/// A ring of commands. The front one is being executed; a new one is written in its place and then taken in.
#[derive(Clone)]
pub(crate) struct Queue {
    ring: Vec<Command>,
    front: usize,
    len: usize,
    /// The place before the front holds the command that was executed last.
    has_previous: bool,
}

impl Queue {
    pub fn new(empty: &Command) -> Queue {
        Queue { ring: vec![*empty; HELD], front: 0, len: 0, has_previous: false }
    }

    pub fn len(&self) -> usize {
        self.len
    }

    /// The command being executed.
    pub fn front(&self) -> Option<&Command> {
        if self.len == 0 { None } else { self.ring.get(self.front) }
    }

    /// The command so many behind the one being executed.
    pub fn behind(&self, index: usize) -> Option<&Command> {
        if index < self.len { self.ring.get((self.front + index) % HELD) } else { None }
    }

    /// As [`Queue::behind`], to write what an operator writes.
    pub fn behind_mut(&mut self, index: usize) -> Option<&mut Command> {
        if index < self.len { self.ring.get_mut((self.front + index) % HELD) } else { None }
    }

    /// The command being executed, to correct where it ends.
    pub fn front_mut(&mut self) -> Option<&mut Command> {
        if self.len == 0 { None } else { self.ring.get_mut(self.front) }
    }

    /// The command read last.
    pub fn back(&self) -> Option<&Command> {
        if self.len == 0 { None } else { self.ring.get((self.front + self.len - 1) % HELD) }
    }

    /// The place for the next command; the caller keeps the control's depth, which is below the ring's size.
    pub fn slot(&mut self) -> &mut Command {
        let index = (self.front + self.len.min(HELD - 1)) % HELD;
        &mut self.ring[index]
    }

    /// Takes in the command that has been written into its place.
    pub fn take_in(&mut self) {
        self.len = (self.len + 1).min(HELD);
    }

    pub fn pop(&mut self) {
        if self.len > 0 {
            self.front = (self.front + 1) % HELD;
            self.len -= 1;
            self.has_previous = true;
        }
    }

    pub fn clear(&mut self) {
        self.len = 0;
        self.has_previous = false;
    }

    /// The command being executed and the one before it, to write what an operator writes behind them.
    pub fn kept_mut(&mut self) -> impl Iterator<Item = &mut Command> {
        let (front, before) = (self.front, (self.front + HELD - 1) % HELD);
        let (has_front, has_before) = (self.len > 0, self.has_previous);
        let kept = move |index| index == front && has_front || index == before && has_before;
        self.ring.iter_mut().enumerate().filter(move |(index, _)| kept(*index)).map(|(_, command)| command)
    }

    /// The command executed last and the one before it, even if a reset has dropped the queue since.
    pub fn done(&self) -> [&Command; 2] {
        [&self.ring[self.front], &self.ring[(self.front + HELD - 1) % HELD]]
    }

    /// The command that was executed before the front one; there is one from the program's second block on.
    pub fn previous(&self) -> Option<&Command> {
        if self.has_previous { self.ring.get((self.front + HELD - 1) % HELD) } else { None }
    }
}
