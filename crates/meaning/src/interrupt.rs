//! M90 and M91: program interrupt. While it is on, the interrupt input ends the block that runs, drops its rest and
//! what was read ahead, and the program that said M91 goes on at its block P.

use base::{Condition, Point};
use syntax::Word;

use crate::block::Reading;
use crate::command::Command;
use crate::interpreter::Interpreter;
use crate::jump::{Found, Target};
use crate::reader::Reader;
use crate::word::Refusal;

/// Where the program goes on when the interrupt input turns on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Interrupt {
    pub(crate) found: Found,
    /// Programs on the levels of calls, that of M91 included.
    pub(crate) depth: usize,
}

impl Interrupt {
    /// The line on which the program goes on.
    pub fn line(&self) -> u64 {
        self.found.cursor.line
    }
}

impl Reading<'_> {
    /// M91 P: the block is looked for at once, so that a missing one is found before the input turns on.
    pub fn interrupt_on(&mut self, word: &Word) -> Result<(), Refusal> {
        let Some(number) = self.words.count(self.control(), b'P')?.filter(|&number| number > 0) else {
            return Err(self.words.alarm_at(Condition::CallTargetMissing, word).into());
        };
        let Some(frame) = self.calls.top() else { return Ok(()) };
        let (source, head) = (frame.source, frame.head);
        let program = self.words.place.program;
        let target = Target::Sequence { source, program, head, from: self.words.block.next, number };
        let found = self.locate(target, b'P')?;
        self.next.interrupt = Some(Interrupt { found, depth: self.calls.frames.len() });
        Ok(())
    }
}

impl Reader {
    /// Goes on where an interrupt leads; false if the program that said M91 is no longer being executed.
    fn go_to_interrupt(&mut self, interrupt: Interrupt, running: &Command) -> bool {
        let Interrupt { found, depth } = interrupt;
        if self.calls.frames.len() + 1 == depth {
            // The block that runs is the program's own M99, which has been read.
            self.calls.frames.push(running.frame);
        }
        let own = self.calls.frames.get_mut(depth.saturating_sub(1));
        let Some(frame) = own.filter(|frame| frame.source == found.source && frame.program == found.program) else {
            return false;
        };
        frame.cursor = found.cursor;
        frame.begun = found.cursor.offset > frame.head.offset;
        self.calls.frames.truncate(depth);
        self.calls.leave_loops(depth, found.cursor.offset);
        self.drop_what_is_sought();
        true
    }
}

impl Interpreter {
    /// The interrupt input has turned on, the axes standing at `machine` (mm, degrees). True if the program goes on
    /// elsewhere; false if no interrupt is in force. `begun` says that something of the block that runs has been
    /// executed: its codes stay in force then.
    pub fn interrupt(&mut self, machine: &Point, begun: bool) -> bool {
        let state = self.state_so_far(begun);
        let (Some(interrupt), Some(&running)) = (state.interrupt, self.executing()) else { return false };
        if !self.reader.go_to_interrupt(interrupt, &running) {
            return false;
        }
        self.go_on_from(state, machine);
        true
    }
}
