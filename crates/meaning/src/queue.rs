//! The control's buffer: blocks read and not yet done, each with its own state.

use crate::command::Command;

/// Blocks that can be held, above any control's own depth (two ordinarily, up to seven in buffering mode).
const HELD: usize = 16;

/// A ring of commands. The front one is being executed.
pub(crate) struct Queue {
    ring: Vec<Option<Command>>,
    front: usize,
    len: usize,
}

impl Queue {
    pub fn new() -> Queue {
        Queue { ring: vec![None; HELD], front: 0, len: 0 }
    }

    pub fn len(&self) -> usize {
        self.len
    }

    /// The command being executed.
    pub fn front(&self) -> Option<&Command> {
        if self.len == 0 { None } else { self.ring[self.front].as_ref() }
    }

    /// The command read last.
    pub fn back(&self) -> Option<&Command> {
        if self.len == 0 { None } else { self.ring[(self.front + self.len - 1) % HELD].as_ref() }
    }

    /// Adds a command; the caller keeps the control's depth, which is below the ring's size.
    pub fn push(&mut self, command: &Command) {
        if self.len < HELD {
            self.ring[(self.front + self.len) % HELD] = Some(*command);
            self.len += 1;
        }
    }

    pub fn pop(&mut self) {
        if self.len > 0 {
            self.front = (self.front + 1) % HELD;
            self.len -= 1;
        }
    }

    pub fn clear(&mut self) {
        self.len = 0;
    }
}
