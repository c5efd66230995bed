//! The program is chosen, and CYCLE START begins it or lets it go on.

use syntax::Cursor;

use super::Session;
use crate::library::Library;

impl<L: Library> Session<L> {
    /// Chooses the program to run, which begins at `head` in its text.
    pub fn select(&mut self, source: base::SourceId, name: &str, head: Cursor) {
        self.come_back();
        self.leave_program();
        self.interpreter_mut().select_at(source, name, head);
        self.pulled = false;
        self.between_blocks = true;
        self.told = None;
        self.rewound = true;
        self.ended = true;
    }

    /// CYCLE START: begins the selected program, or goes on after a stop.
    pub fn start(&mut self) {
        self.restart_rehearsal();
        if self.ended {
            self.reader = None;
            let rewound = self.rewound;
            let interpreter = self.interpreter_mut();
            if rewound {
                interpreter.rewind();
            } else {
                interpreter.go_on_after_end();
            }
        }
        self.ended = false;
        self.rewound = false;
        self.stopped = false;
        self.feed_held = false;
        self.release();
    }

    /// CYCLE START in tape mode: as [`Session::start`], and a tape that stands in its middle is read on behind the next
    /// end of block while LABEL SKIP is on.
    pub fn start_tape(&mut self) {
        let (begins, skips) = (self.ended, self.ended && !self.rewound && self.label_skip);
        self.start();
        if begins {
            self.load_reader();
        }
        self.label_skip = false;
        if skips {
            self.interpreter_mut().skip_label();
        }
    }

    /// The program from its head once more, everything else as it stands.
    pub fn start_over(&mut self) {
        self.rewound = true;
        self.ended = true;
        self.start();
    }
}
