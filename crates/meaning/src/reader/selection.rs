//! Where the reader stands: at the head of a program, sent on after a stop, at its end.

use base::{AxisSet, Point, ProgramId, SourceId};
use syntax::{Cursor, Grouping};

use super::Reader;
use crate::command::Command;
use crate::jump::{Found, Target};
use crate::program::{Frame, ProgramKey};
use crate::repetition::Repetition;

impl Reader {
    /// Puts the reader at the head of a program, which begins at `head` in its text; `name` is used if no O word names it.
    pub fn select(&mut self, source: SourceId, name: &str, head: Cursor) {
        let program = self.names.intern(name);
        self.calls.frames.clear();
        self.calls.frames.push(Frame { program, source, head, entry: head, cursor: head, ..Frame::default() });
        self.rewind();
    }

    /// Goes back to the head of the main program.
    pub fn rewind(&mut self) {
        self.calls.frames.truncate(1);
        if let Some(main) = self.calls.frames.first_mut() {
            main.cursor = main.head;
            main.begun = false;
            main.opened = false;
        }
        self.passes_over = false;
        self.search = None;
        self.blocks = 0;
        self.ended = false;
        self.jumps = 0;
        self.calls.loops.clear();
        self.notes.clear();
        self.answers.clear();
        self.statements = 0;
        self.variables_doubtful = false;
        self.asks_again = None;
        self.repetition = Repetition::default();
    }

    /// What is being looked for or asked for is of no use any more.
    pub fn drop_what_is_sought(&mut self) {
        self.search = None;
        self.ended = false;
        self.jumps = 0;
        self.answers.clear();
        self.asks_again = None;
        self.repetition = Repetition::default();
    }

    /// Goes on in the main program at the block after a command, or (`again`) with that block once more.
    ///
    /// A command of a subprogram has no way back to its caller any more: the main program's head is next.
    pub fn go_to(&mut self, command: &Command, again: bool) {
        self.rewind();
        if !command.called
            && let Some(main) = self.calls.frames.first_mut()
        {
            main.cursor = if again { command.here } else { command.frame.cursor };
            main.begun = main.cursor.offset > main.head.offset && !(again && command.first);
        }
    }

    /// Goes on in the main program at this block.
    pub fn go_to_block(&mut self, block: Cursor) {
        self.rewind();
        if let Some(main) = self.calls.frames.first_mut() {
            main.begun = block.offset > main.head.offset;
            main.cursor = block;
        }
    }

    /// Reads on in another main program, where it was left.
    pub fn go_back_to(&mut self, frame: Frame) {
        self.calls.frames.clear();
        self.calls.frames.push(frame);
        let cursor = frame.cursor;
        let (begun, opened) = (frame.begun, frame.opened);
        self.rewind();
        if let Some(main) = self.calls.frames.first_mut() {
            (main.cursor, main.begun, main.opened) = (cursor, begun, opened);
        }
    }

    /// Reads on after a program's end.
    pub fn go_on(&mut self) {
        self.ended = false;
    }

    /// Stops reading until [`Reader::rewind`].
    pub fn end(&mut self) {
        self.ended = true;
        self.search = None;
    }

    /// The program that was asked for, or that there is none.
    ///
    /// Where a program is a file, the source is the program; `name` is its file's.
    pub fn brought(&mut self, brought: Option<(SourceId, Option<&str>)>) {
        let Some(search) = &mut self.search else { return };
        let target = search.target();
        let found = match (brought, target) {
            (Some((source, name)), Target::Program { program, .. })
                if self.setting.control.grammar.grouping == Grouping::Files =>
            {
                let program = match (program, name) {
                    (ProgramKey::Number(number), _) => self.names.numbered(number),
                    (ProgramKey::File { .. }, Some(name)) => self.names.intern(name),
                    (ProgramKey::File { name, .. }, None) => name,
                };
                Some(Found { source, program, cursor: Cursor::HEAD, enters: false })
            }
            (brought, _) => {
                if search.brought(brought.map(|(source, _)| source)) {
                    return;
                }
                None
            }
        };
        self.calls.remember(target, found);
        self.search = None;
    }

    /// The main program.
    pub fn main_program(&self) -> Option<(ProgramId, SourceId)> {
        self.calls.frames.first().map(|frame| (frame.program, frame.source))
    }

    /// Sets where the axes stand (counts).
    pub fn stand_at(&mut self, machine: Point) {
        self.state.machine = machine;
        self.state.transform.apart = AxisSet::NONE;
    }
}
