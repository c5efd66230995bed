//! Where the program goes on after a block: calls, macro calls, returns, jumps.

use super::Reader;
use crate::block::Flow;
use crate::command::{Command, Finish};
use crate::jump::Found;
use crate::operation::EndKind;
use crate::program::{CalledBy, Frame};
use crate::repetition::Moment;
use crate::user_macro::call::{Arguments, ModalCall};
use base::{Alarm, Condition, Place, Span};
use dialect::{Meaning, SubprogramTextEnd};
use syntax::Cursor;

/// What a jump is part of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum After {
    /// A block, whose state is in the making.
    Block,
    /// A macro statement.
    Statement,
}

impl Reader {
    /// Carries the program to where the block sends it.
    pub(super) fn follow(&mut self, flow: &Flow, command: &mut Command) -> Result<(), Alarm> {
        if matches!(flow, Flow::Next) {
            return Ok(());
        }
        self.jumps += 1;
        if self.jumps > self.loop_limit {
            let place = command.place;
            let jump = self.block.words.iter().find(|word| word.letter == b'M');
            let span = jump.map_or(place.block, |word| word.extent.span(place.block.start));
            let alarm = Alarm::new(Condition::EndlessLoop, place, span);
            let first = match flow {
                Flow::Jump(found) => found.cursor.line.min(place.line),
                Flow::Again => self.calls.top().map_or(place.line, |frame| frame.head.line),
                _ => place.line,
            };
            return Err(alarm.with([self.loop_limit as f64, first as f64, place.line as f64]));
        }
        match *flow {
            Flow::Next => {}
            Flow::Call { found, entry, repeats, large } => {
                self.enter(found, entry, repeats);
                if let Some(frame) = self.calls.frames.last_mut() {
                    frame.large = large;
                }
            }
            Flow::MacroCall(found, repeats) => {
                let arguments = self.arguments;
                self.enter_macro(found, repeats, CalledBy::Macro, &arguments);
            }
            Flow::ModalCall(found, repeats) => {
                self.modal = Some(ModalCall { found, repeats, arguments: self.arguments });
            }
            Flow::Return(found) => {
                self.leave(found);
                if let Some(found) = found
                    && self.comes_again(found.cursor, After::Block)
                {
                    self.asks_again = Some(found.cursor);
                }
            }
            Flow::Again => self.run_again(command),
            Flow::Jump(found) => {
                if self.comes_again(found.cursor, After::Block) {
                    command.finish = Finish::End(EndKind::M99);
                    command.stops_reading = true;
                }
                self.advance(found.cursor);
            }
        }
        Ok(())
    }

    /// Whether a jump leads to where the program has been before with nothing changed since, and so for ever round.
    ///
    /// A round without a move, dwell or stop is another matter: the loop limit ends it.
    pub(crate) fn comes_again(&mut self, cursor: Cursor, after: After) -> bool {
        if !self.moved {
            return false;
        }
        self.moved = false;
        let state = match after {
            After::Block => &self.next,
            After::Statement => &self.state,
        };
        self.repetition.comes_again(&Moment {
            cursor,
            state,
            variables: &self.setting.memory.variables,
            frames: &self.calls.frames,
            loops: &self.calls.loops,
            modal: self.modal.as_ref(),
            called_with: &self.called_with,
        })
    }

    pub(super) fn enter(&mut self, found: Found, entry: Cursor, repeats: u32) {
        let Found { source, program, cursor: head, .. } = found;
        let level = self.calls.top().map_or(0, |frame| frame.level);
        let called_by = CalledBy::Subprogram;
        let repeats = repeats.saturating_sub(1);
        let frame =
            Frame { program, source, head, entry, cursor: entry, called_by, level, repeats, ..Frame::default() };
        self.calls.frames.push(frame);
    }

    /// Enters a macro with local variables of its own.
    pub(super) fn enter_macro(&mut self, found: Found, repeats: u32, called_by: CalledBy, arguments: &Arguments) {
        self.enter(found, found.cursor, repeats);
        let Some(frame) = self.calls.frames.last_mut() else { return };
        frame.called_by = called_by;
        frame.level += 1;
        let level = usize::from(frame.level);
        if let Some(slot) = self.called_with.get_mut(level) {
            *slot = *arguments;
        }
        self.setting.memory.variables.set_locals(level, arguments);
    }

    /// Calls the modal macro after a move, unless the move is that macro's own.
    pub(super) fn call_after_move(&mut self, command: &Command) {
        let Some(modal) = self.modal else { return };
        let group = self.setting.control.roles.modal_macro;
        if self.setting.control.in_force(&self.state.groups, group) != Some(Meaning::ModalMacroCall) {
            self.modal = None;
            return;
        }
        let own = self.calls.frames.iter().any(|frame| frame.called_by == CalledBy::ModalMacro);
        let room = self.calls.macro_level() < self.setting.control.macro_levels;
        if command.body.moves() && !own && room {
            self.enter_macro(modal.found, modal.repeats, CalledBy::ModalMacro, &modal.arguments);
        }
    }

    pub(super) fn leave(&mut self, found: Option<Found>) {
        let Some(frame) = self.calls.frames.last_mut() else { return };
        if frame.repeats > 0 && found.is_none() {
            frame.repeats -= 1;
            frame.cursor = frame.entry;
            frame.begun = false;
            frame.opened = false;
            let level = usize::from(frame.level);
            if matches!(frame.called_by, CalledBy::Macro | CalledBy::ModalMacro)
                && let Some(arguments) = self.called_with.get(level)
            {
                self.setting.memory.variables.set_locals(level, arguments);
            }
            self.close_loops();
            return;
        }
        self.calls.frames.pop();
        self.close_loops();
        if let Some(found) = found {
            self.advance(found.cursor);
        }
    }

    /// A called program's text has ended before its M99: true if that is its way back.
    pub(super) fn returns_at_end(&mut self, frame: &Frame) -> bool {
        let returns = self.setting.fitting.policies.subprogram_text_end == SubprogramTextEnd::Return;
        if !returns || self.calls.frames.len() < 2 {
            return false;
        }
        let Cursor { offset, line, line_start, .. } = frame.cursor;
        let block = Span { start: offset, len: 0 };
        let Frame { program, source, .. } = *frame;
        self.unreturned = Some(Place { program, source, line, line_start, block, sequence: 0 });
        self.leave(None);
        true
    }

    /// Loops that a return has left are closed.
    pub(super) fn close_loops(&mut self) {
        let depth = self.calls.frames.len();
        let inside = self.calls.top().is_some_and(|frame| frame.begun);
        self.calls.loops.retain(|open| open.depth < depth || (open.depth == depth && inside));
    }

    /// M99 in the main program: it asks to be run again.
    pub(super) fn run_again(&mut self, command: &mut Command) {
        command.finish = Finish::End(EndKind::M99);
        command.stops_reading = true;
        self.calls.loops.clear();
        if let Some(main) = self.calls.frames.first_mut() {
            main.cursor = main.head;
            main.begun = false;
            main.opened = false;
        }
    }
}
