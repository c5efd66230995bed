//! MDI: blocks typed at the panel are a text of their own, run once beside the program in memory.

use base::SourceId;
use meaning::Pointer;
use syntax::Cursor;

use super::Session;
use crate::library::Library;

/// The text that is typed at the panel. No file has this number.
pub const TYPED: SourceId = SourceId(u32::MAX);
/// Its name as a program.
const TYPED_NAME: &str = "MDI";

/// What has been typed, and the program in memory that waits meanwhile.
#[derive(Clone, Default)]
pub(super) struct Typed {
    pub text: Vec<u8>,
    /// It has been started: the next block typed begins a new text.
    run: bool,
    /// The program in memory and whether it stands at its head, while the typed text is in its place.
    waiting: Option<(Option<Pointer>, bool)>,
}

impl<L: Library> Session<L> {
    /// Types blocks; they are run together by [`Session::start_typed`].
    pub fn type_blocks(&mut self, blocks: &str) {
        if self.typed.run {
            self.typed.text.clear();
            self.typed.run = false;
        }
        self.typed.text.extend_from_slice(blocks.as_bytes());
        self.typed.text.push(b'\n');
    }

    /// What has been typed and not been run to its end.
    pub fn typed_blocks(&self) -> &[u8] {
        if self.typed.run && self.ended { &[] } else { &self.typed.text }
    }

    /// A part of a typed text, to show it.
    pub fn typed_text(&self) -> &[u8] {
        &self.typed.text
    }

    /// CYCLE START in MDI mode: runs what has been typed.
    pub fn start_typed(&mut self) {
        if self.typed.waiting.is_none() {
            self.typed.waiting = Some((self.interpreter().pointer(), self.rewound));
        }
        self.typed.run = true;
        let interpreter = self.interpreter_mut();
        interpreter.forget_texts();
        interpreter.select_at(TYPED, TYPED_NAME, Cursor::HEAD);
        self.pulled = false;
        self.between_blocks = true;
        self.told = None;
        self.rewound = true;
        self.ended = true;
        self.start();
    }

    /// True while the typed text is in the place of the program in memory.
    pub fn is_typed_selected(&self) -> bool {
        self.typed.waiting.is_some()
    }

    /// The program in memory is selected again, where it was left.
    pub fn come_back(&mut self) {
        let Some((pointer, rewound)) = self.typed.waiting.take() else { return };
        self.leave_program();
        self.rewound = rewound;
        if let Some(pointer) = pointer {
            self.interpreter_mut().go_back_to(pointer);
        }
    }

    /// What was typed is erased.
    pub(super) fn forget_typed(&mut self) {
        self.typed.run = true;
    }
}
