//! What is handed on for a block that has been read: its command, an alarm instead of it, the end of the text.

use base::{Alarm, AxisSet, Condition, Place, Span};
use syntax::Cursor;

use super::{Read, Reader};
use crate::command::{Body, Command, Finish};
use crate::operation::{EndKind, Side};
use crate::program::Frame;
use crate::wording::Wording;

impl Reader {
    /// The block at hand begins; the one behind it stands at `next`.
    pub(crate) fn begin(&mut self, next: Cursor, command: &mut Command) {
        if let Some(frame) = self.calls.frames.last_mut() {
            command.first = !frame.begun;
            if !frame.begun {
                frame.first = self.block.start.offset;
            }
            // Copied before it is written to: a copy of what has just been written waits for it.
            command.frame = Frame { cursor: next, begun: true, ..*frame };
            (frame.cursor, frame.begun) = (next, true);
        }
        command.here = self.block.start;
        command.called = self.calls.frames.len() > 1;
    }

    /// The command says nothing yet but where it stands.
    pub(super) fn prepare(&self, command: &mut Command, place: Place) {
        command.block = self.blocks;
        command.place = place;
        command.from = self.state.machine;
        command.code_count = 0;
        command.optional_code = None;
        command.body = Body::Nothing;
        command.write = None;
        command.finish = Finish::Next;
        command.stops_reading = false;
        command.written = AxisSet::NONE;
        command.absolute = AxisSet::NONE;
        command.returned = AxisSet::NONE;
        command.offset = None;
        command.drops = AxisSet::NONE;
        command.wording = Wording::default();
        command.from_unknown = !self.state.unknown.axes.is_empty();
    }

    /// One block more has been read.
    pub(super) fn count(&mut self, command: &Command) {
        self.blocks += 1;
        if !matches!(command.body, Body::Nothing | Body::Set(..)) || command.finish != Finish::Next {
            self.jumps = 0;
            self.statements = 0;
            self.moved = true;
        }
    }

    /// The block is refused: it has no effect. Checking on, what it names becomes unknown.
    pub(crate) fn refuse(&mut self, alarm: Alarm, command: &mut Command) -> Option<Read> {
        let clouded = self.unknown_in_block().clouds(alarm.condition, &self.setting.control.roles, alarm.axis);
        if !self.goes_on || alarm.condition == Condition::EndlessLoop {
            self.ended = true;
        } else {
            self.forget_what_it_names();
        }
        if clouded {
            return None;
        }
        self.prepare(command, alarm.place);
        command.body = Body::Alarm(alarm);
        command.after = *self.state;
        self.blocks += 1;
        Some(Read::Command)
    }

    /// The text has ended before its program has.
    pub(super) fn end_of_text(&mut self, frame: &Frame, command: &mut Command) -> Read {
        let Cursor { offset, line, line_start, .. } = frame.cursor;
        self.prepare(
            command,
            Place {
                program: frame.program,
                source: frame.source,
                line,
                line_start,
                block: Span { start: offset, len: 0 },
                sequence: 0,
            },
        );
        command.finish = Finish::End(EndKind::Text);
        command.after = *self.state;
        command.side = Side::Off;
        command.offset = None;
        command.frame = *frame;
        command.here = frame.cursor;
        command.called = self.calls.frames.len() > 1;
        command.first = false;
        self.ended = true;
        Read::Command
    }
}
