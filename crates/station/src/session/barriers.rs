//! The questions of the stages, answered from the library and the operator's buttons.

use base::SourceId;
use machine::Machine;
use meaning::{Answer, Barrier, BarrierKind, ProgramKey, Pull, Quantity};

use super::{Session, TYPED};
use crate::library::{Library, LibraryError, Wanted};

impl<L: Library> Session<L> {
    /// Pulls the next shape; false if a question had to be answered, a stop was met or there is no more.
    pub(super) fn pull(&mut self) -> bool {
        if self.pulled {
            return true;
        }
        loop {
            match self.motion.next() {
                Pull::Item(()) => return true,
                Pull::End => {
                    self.ended = true;
                    return false;
                }
                Pull::Barrier(barrier) => {
                    if !self.answer(barrier) {
                        return false;
                    }
                }
            }
        }
    }

    /// Answers a question of the stages; false if that cannot be done now.
    #[cold]
    #[inline(never)]
    fn answer(&mut self, barrier: Barrier) -> bool {
        if let Some(asked) = &mut self.asked {
            asked.note(&barrier.kind);
        }
        let answered = match barrier.kind {
            BarrierKind::NeedBytes { source: TYPED, offset, .. } => {
                let text = &self.typed.text;
                let from = usize::try_from(offset).unwrap_or(usize::MAX).min(text.len());
                self.motion.resume(barrier.id, Answer::Bytes(&text[from..], true))
            }
            BarrierKind::NeedBytes { source, offset, len } => {
                match self.library.read(source, offset, len, &mut self.bytes) {
                    Ok(last) => self.motion.resume(barrier.id, Answer::Bytes(&self.bytes, last)),
                    Err(error) => {
                        self.failed = Some(error);
                        return false;
                    }
                }
            }
            BarrierKind::NeedProgram { program } => match self.find_program(program) {
                Ok(Some(source)) => match self.library.file_name(source) {
                    Some(name) => self.motion.resume(barrier.id, Answer::File(source, &name)),
                    None => self.motion.resume(barrier.id, Answer::Program(source)),
                },
                Ok(None) => self.motion.resume(barrier.id, Answer::NotFound),
                Err(error) => {
                    self.failed = Some(error);
                    return false;
                }
            },
            BarrierKind::NeedValue(quantity) => {
                self.rest_to_answer(quantity);
                let value = self.value_of(quantity);
                self.motion.resume(barrier.id, Answer::Value(value))
            }
            // The stop was told when its block closed; here CYCLE START has been pressed.
            BarrierKind::CycleStart => self.motion.resume(barrier.id, Answer::Continue),
            BarrierKind::SkipPosition => {
                let answer = Answer::Stands(self.counted_position(), self.machine.was_skipped());
                self.motion.resume(barrier.id, answer)
            }
            BarrierKind::RunAgain => {
                self.rounds += u32::from(self.repeats_main);
                if self.goes_round() {
                    // The question stays open until the operator lets the program run on.
                    return false;
                }
                let answer = if self.repeats_main { Answer::Continue } else { Answer::Stop };
                self.motion.resume(barrier.id, answer)
            }
        };
        debug_assert!(answered.is_ok(), "a barrier is answered in the moment it is met");
        true
    }

    /// A program that is called, from the library.
    fn find_program(&mut self, program: ProgramKey) -> Result<Option<SourceId>, LibraryError> {
        let wanted = match program {
            ProgramKey::Number(number) => {
                let files = self.configuration.control.files.as_ref();
                Wanted::Number(number, files.map_or("", |files| &files.ending))
            }
            ProgramKey::File { name, .. } => Wanted::File(self.motion.upstream.upstream.program_name(name)),
        };
        self.library.find_program(wanted)
    }

    /// What a macro reads of the machine.
    fn value_of(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Inputs => f64::from(self.inputs.interface),
            Quantity::Clock => self.machine.time().0,
            Quantity::Position(axis) => self.machine.position().get(usize::from(axis)).copied().unwrap_or(0.0),
            // The virtual machine follows its command exactly.
            Quantity::Deviation(_) => 0.0,
        }
    }
}
