//! Pulling: operations out of the block at the queue's front, blocks into the queue behind it.

use base::Place;

use super::Interpreter;
use crate::command::{Body, Command, Finish};
use crate::operation::{Act, Close, EndKind, Operation};
use crate::pull::{Barrier, BarrierKind, Pull};
use crate::reader::Read;
use crate::state::State;
use crate::supply::WINDOW;

/// What the block being executed has next.
enum Front {
    /// An operation.
    Operation,
    /// The question whether the main program runs again.
    Question,
}

impl Interpreter {
    /// The next operation. It stays as it is until the next call.
    #[expect(clippy::should_implement_trait, reason = "a pull has barriers, which an iterator does not")]
    pub fn next(&mut self) -> Pull<&Operation> {
        if let Some(barrier) = self.barrier {
            return Pull::Barrier(barrier);
        }
        loop {
            if self.measures {
                self.measures = false;
                return Pull::Barrier(self.ask(BarrierKind::SkipPosition));
            }
            if self.waits_for_start {
                self.waits_for_start = false;
                return Pull::Barrier(self.ask(BarrierKind::CycleStart));
            }
            match self.next_of_front() {
                Some(Front::Operation) => return Pull::Item(&self.operation),
                Some(Front::Question) => return Pull::Barrier(self.ask(BarrierKind::RunAgain)),
                None => {}
            }
            if let Some(barrier) = self.read_ahead() {
                return Pull::Barrier(barrier);
            }
            if self.tell_note() {
                return Pull::Item(&self.operation);
            }
            match self.queue.front() {
                Some(command) => self.expansion.begin(command),
                None => return Pull::End,
            }
        }
    }

    /// Makes an operation of the next write to a variable, if the blocks read before it are done.
    fn tell_note(&mut self) -> bool {
        let due = match (self.reader.notes.front(), self.queue.front()) {
            (Some(note), Some(command)) => note.before <= command.block && !matches!(command.body, Body::Start(_)),
            (Some(_), None) => self.started,
            (None, _) => false,
        };
        let Some(note) = self.reader.notes.pop_front_if(|_| due) else { return false };
        self.operation =
            Operation { block: note.before, place: note.place, act: Act::Set(note.value), ..Operation::default() };
        true
    }

    /// Makes the next operation of the block being executed; the block leaves the queue when it is done.
    fn next_of_front(&mut self) -> Option<Front> {
        if self.expansion.is_idle() {
            return None;
        }
        let command = self.queue.front()?;
        if !self.expansion.next(command, &self.reader.setting, &mut self.operation) {
            self.expansion.end();
            self.queue.pop();
            self.reader.ahead = 0;
            return None;
        }
        self.measures = self.operation.until_signal;
        if let Act::Close(close) = self.operation.act {
            if matches!(command.finish, Finish::End(EndKind::M99 | EndKind::Loop)) {
                match self.runs_again.take() {
                    None => {
                        // The close comes again when the question is answered.
                        self.expansion.close_again();
                        return Some(Front::Question);
                    }
                    Some(true) => self.operation.act = Act::Close(Close::Next),
                    Some(false) => {}
                }
            }
            self.waits_for_start = matches!(close, Close::Stop(_));
            if matches!(self.operation.act, Act::Close(Close::End(_))) {
                self.reader.end();
            }
        }
        // The manual part of a cycle.
        self.waits_for_start |= matches!(self.operation.act, Act::Await(Some(_)));
        Some(Front::Operation)
    }

    /// Fills the queue to the control's depth: the block to execute and those read ahead of it.
    fn read_ahead(&mut self) -> Option<Barrier> {
        // Checking on, a block must be judged by the later stages before the next one is read.
        let [blocks, _, buffering] = self.reader.setting.control.read_ahead;
        let depth = |state: &State| if state.buffering { buffering } else { blocks } + 1;
        let goes_on = self.reader.goes_on;
        while self.queue.len() < (if goes_on { 1 } else { depth(&self.reader.state) }) {
            match self.read_one() {
                Ok(true) => {}
                Ok(false) => break,
                Err(barrier) => return Some(barrier),
            }
        }
        None
    }

    /// The block so many behind the one being executed, as far as the control reads ahead in compensation; `None` if it
    /// cannot be seen from here.
    ///
    /// # Errors
    /// A barrier must be answered first.
    #[inline]
    pub fn look_ahead(&mut self, index: usize) -> Result<Option<&Command>, Barrier> {
        if index >= self.queue.len() {
            self.read_to(index)?;
        }
        Ok(self.queue.behind(index))
    }

    fn read_to(&mut self, index: usize) -> Result<(), Barrier> {
        if let Some(barrier) = self.barrier {
            return Err(barrier);
        }
        let [_, compensation, _] = self.reader.setting.control.read_ahead;
        while self.queue.len() <= index {
            if index > compensation || !self.read_one()? {
                break;
            }
        }
        Ok(())
    }

    /// The operation handed out last.
    pub fn current(&self) -> &Operation {
        &self.operation
    }

    /// Reads one block into the queue; false if none can be read before those in it are done.
    fn read_one(&mut self) -> Result<bool, Barrier> {
        if self.queue.back().is_some_and(|command| command.stops_reading) {
            return Ok(false);
        }
        match self.reader.read(self.queue.slot()) {
            Read::Command => {
                if !self.started {
                    self.start();
                }
                self.queue.take_in();
                Ok(true)
            }
            Read::NeedBytes { source, offset } => Err(self.ask(BarrierKind::NeedBytes { source, offset, len: WINDOW })),
            Read::NeedProgram { program } => Err(self.ask(BarrierKind::NeedProgram { program })),
            // Motion must have ended: the blocks in the queue come first.
            Read::NeedValue(quantity) if quantity.waits_for_motion() && self.queue.len() > 0 => Ok(false),
            Read::NeedValue(quantity) => Err(self.ask(BarrierKind::NeedValue(quantity))),
            Read::Pause if self.queue.len() > 0 => Ok(false),
            Read::Pause => {
                self.reader.ahead = 0;
                Ok(true)
            }
            Read::Ended => Ok(false),
        }
    }

    /// The first block has been read, so the program's name is known: the program begins before it.
    fn start(&mut self) {
        self.started = true;
        let first = *self.queue.slot();
        let start = self.queue.slot();
        *start = Command::empty(&self.start_state);
        start.place = Place { program: first.place.program, source: first.place.source, ..Place::default() };
        start.body = Body::Start(self.start_state.groups);
        self.queue.take_in();
        *self.queue.slot() = first;
    }

    pub(super) fn ask(&mut self, kind: BarrierKind) -> Barrier {
        self.barriers += 1;
        let barrier = Barrier { id: self.barriers, kind };
        self.barrier = Some(barrier);
        barrier
    }
}
