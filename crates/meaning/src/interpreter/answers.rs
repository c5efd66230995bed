//! The answers to barriers, each given to whoever asked.

use base::SourceId;

use super::Interpreter;
use crate::pull::{Answer, BarrierKind, Quantity, StaleBarrier};

impl Interpreter {
    /// Answers the open barrier.
    ///
    /// # Errors
    /// `id` is not that of the open barrier; nothing changes then.
    pub fn resume(&mut self, id: u64, answer: Answer) -> Result<(), StaleBarrier> {
        let barrier = self.barrier.filter(|barrier| barrier.id == id).ok_or(StaleBarrier)?;
        self.barrier = None;
        match (barrier.kind, answer) {
            (BarrierKind::NeedBytes { source, offset, len }, Answer::Bytes(bytes, last)) => {
                self.take_bytes(source, offset, len, bytes, last);
            }
            (BarrierKind::NeedBytes { source, offset, len }, _) => self.take_bytes(source, offset, len, &[], true),
            (BarrierKind::NeedProgram { .. }, Answer::Program(source)) => self.reader.brought(Some((source, None))),
            (BarrierKind::NeedProgram { .. }, Answer::File(source, name)) => {
                self.reader.brought(Some((source, Some(name))));
            }
            (BarrierKind::NeedProgram { .. }, _) => self.reader.brought(None),
            (BarrierKind::NeedValue(quantity), answer) => {
                let value = if let Answer::Value(value) = answer { value } else { 0.0 };
                if quantity == Quantity::Clock {
                    self.reader.repetition.clock_was_read();
                }
                self.reader.answers.push((quantity, value));
            }
            (BarrierKind::SkipPosition, answer) => self.measured(answer),
            (BarrierKind::RunAgain, answer) => self.runs_again = Some(answer == Answer::Continue),
            (BarrierKind::CycleStart, Answer::Stop) => self.reader.end(),
            (BarrierKind::CycleStart, _) => {}
        }
        Ok(())
    }

    /// A move that waits for the skip signal has ended. Nothing has been read beyond its block.
    fn measured(&mut self, answer: Answer) {
        let Answer::Stands(at, signalled) = answer else { return };
        if let Some(command) = self.queue.front_mut().filter(|_| !self.expansion.is_idle()) {
            crate::skip::measured(&self.reader.setting, &mut self.expansion, command, &at, signalled);
            (self.reader.state.machine, self.reader.state.skip) = (command.after.machine, command.after.skip);
        }
    }

    /// Takes bytes in. Fewer than asked for are gathered and the rest asked for, so that any answer leads on; nothing
    /// at all and not the end would be asked for again for ever, and is taken for the end.
    fn take_bytes(&mut self, source: SourceId, offset: u64, len: usize, bytes: &[u8], last: bool) {
        let last = last || bytes.is_empty();
        if self.gathered.is_empty() && (last || bytes.len() >= len) {
            self.reader.take(source, offset, bytes, last);
            return;
        }
        self.gathered.extend_from_slice(bytes);
        if !last && bytes.len() < len {
            let (offset, len) = (offset + bytes.len() as u64, len - bytes.len());
            self.ask(BarrierKind::NeedBytes { source, offset, len });
            return;
        }
        let start = offset + bytes.len() as u64 - self.gathered.len() as u64;
        self.reader.take(source, start, &self.gathered, last);
        self.gathered.clear();
    }
}
