//! Where the selected program goes on, and whether programs may be changed.

use syntax::Cursor;

use super::Session;
use crate::library::Library;

impl<L: Library> Session<L> {
    /// The selected program goes on at this block of its text, everything else as it stands.
    pub fn point_at(&mut self, block: Cursor) {
        self.come_back();
        self.leave_program();
        self.interpreter_mut().go_to_block(block);
        (self.pulled, self.between_blocks, self.told) = (false, true, None);
        (self.rewound, self.ended) = (false, true);
    }

    /// True if CYCLE START would begin the selected program at its head.
    pub fn stands_at_head(&self) -> bool {
        self.rewound
    }

    /// The key EDIT LOCK is on.
    pub fn is_edit_locked(&self) -> bool {
        self.switches.edit_lock
    }
}
