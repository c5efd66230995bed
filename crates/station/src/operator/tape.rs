//! The tape reader: a tape put in, run in mode tape, compared with memory.

use base::SourceId;
use dialect::ModeKind;
use syntax::Cursor;

use super::{Begins, Operator, Said, memory_key};
use crate::display::Value;
use crate::library::{LibraryError, Shelf};
use crate::program_text::{ProgramText, blocks_of_text, number_of, text_of};
use crate::session::Session;

/// A block of a program: its line and its words as one text.
type Line = (u64, String);

impl<L: Shelf> Operator<L> {
    /// Puts a tape into the reader, at its head.
    pub(super) fn put_in_tape(&mut self, file: &str) -> Result<(), LibraryError> {
        let (source, name) = self.session.library_mut().open_file(file)?;
        self.tape = Some((name, source));
        if let Some(selected) = self.selected.clone() {
            // Whatever tape was in its middle is no longer there.
            let _ = self.select(&selected);
        }
        Ok(())
    }

    /// The text that CYCLE START begins in this mode takes the place of another mode's.
    pub(super) fn take_its_text(&mut self, begins: Begins) -> Result<(), String> {
        let now = self.session.interpreter().main_program().map(|(_, source)| source);
        match (begins, &self.tape, &self.selected) {
            (Begins::Tape, Some((name, source)), _) => {
                let (name, source) = (name.clone(), *source);
                if now != Some(source) {
                    self.session.interpreter_mut().forget_texts();
                    self.session.select(source, &name, Cursor::HEAD);
                }
                Ok(())
            }
            (Begins::Memory, Some((_, source)), Some(key)) if now == Some(*source) => {
                let key = key.clone();
                self.select(&key)
            }
            _ => Ok(()),
        }
    }

    /// Compares the tape in the reader with the programs in memory, or with one of them; the inner error is why not.
    pub(super) fn verify(
        &mut self,
        name: Option<&str>,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<Result<(), String>, LibraryError> {
        if !matches!(self.mode().kind, ModeKind::Edit | ModeKind::Tape) {
            return Ok(Err(format!("a tape is verified in modes edit and tape, not in mode {}", self.mode().name)));
        }
        let Some((tape_name, tape)) = self.tape.clone() else {
            return Ok(Err("there is no tape in the reader".to_owned()));
        };
        let mut compared = Vec::new();
        for key in self.tape_programs(&tape_name, tape, name)? {
            let Some(memory) = self.programs.get(&key).map(|loaded| loaded.source) else {
                return Ok(Err(format!("there is no program {key} in memory")));
            };
            let (on_tape, in_memory) = (self.blocks(tape, &key)?, self.blocks(memory, &key)?);
            compared.push(verified(&key, &on_tape, &in_memory));
        }
        if compared.is_empty() {
            return Ok(Err("there is no program on the tape".to_owned()));
        }
        tell(&mut self.session, Said::Shown { what: "verify".to_owned(), value: Value::List(compared) });
        Ok(Ok(()))
    }

    /// The names in memory of the programs on the tape.
    fn tape_programs(
        &mut self,
        tape_name: &str,
        tape: SourceId,
        name: Option<&str>,
    ) -> Result<Vec<String>, LibraryError> {
        if let Some(name) = name {
            return Ok(vec![memory_key(name, self.files())]);
        }
        let (grammar, text) = self.text(tape)?;
        let mut keys = Vec::new();
        if self.files().is_none() {
            blocks_of_text(&text, &grammar, |block| {
                let number = block.whole_number(b'O').filter(|_| block.begins_program(&grammar));
                keys.extend(number.map(|number| format!("O{number}")));
                true
            });
        }
        if keys.is_empty() {
            keys.push(memory_key(tape_name, self.files()));
        }
        keys.dedup();
        Ok(keys)
    }

    fn text(&mut self, source: SourceId) -> Result<(syntax::Grammar, Vec<u8>), LibraryError> {
        let interpreter = self.session.interpreter();
        let (grammar, codes) = (interpreter.control().grammar, interpreter.fitting().tape_codes(interpreter.control()));
        Ok((grammar, text_of(self.session.library_mut(), source, codes)?))
    }

    /// The blocks of a program that say anything.
    fn blocks(&mut self, source: SourceId, key: &str) -> Result<Vec<Line>, LibraryError> {
        let (grammar, text) = self.text(source)?;
        let number = number_of(key).filter(|_| self.files().is_none());
        let found = number.and_then(|number| ProgramText::of(text.clone(), Some(number), &grammar));
        let Some(program) = found.or_else(|| ProgramText::of(text, None, &grammar)) else { return Ok(Vec::new()) };
        let mut blocks: Vec<(usize, Line)> = Vec::new();
        for part in program.parts.iter().filter(|part| !part.ends) {
            let word: String = program.word(part).chars().filter(|character| *character != ' ').collect();
            match blocks.last_mut() {
                Some((block, (_, words))) if *block == part.block => *words = format!("{words} {word}"),
                _ => blocks.push((part.block, (part.line, word))),
            }
        }
        Ok(blocks.into_iter().map(|(_, block)| block).collect())
    }
}

/// What came of comparing a program: alike, or the first block that differs.
fn verified(key: &str, on_tape: &[Line], in_memory: &[Line]) -> Value {
    let differs = (0..on_tape.len().max(in_memory.len()))
        .map(|index| (on_tape.get(index), in_memory.get(index)))
        .find(|(tape, memory)| tape.map(|(_, words)| words) != memory.map(|(_, words)| words));
    let block = |found: Option<&Line>| match found {
        None => Value::Null,
        Some((line, words)) => {
            Value::object([("line", Value::Number(*line as f64)), ("block", Value::Text(words.clone()))])
        }
    };
    let mut fields = vec![("program", Value::Text(key.to_owned())), ("alike", Value::Truth(differs.is_none()))];
    if let Some((tape, memory)) = differs {
        fields.extend([("tape", block(tape)), ("memory", block(memory))]);
    }
    Value::fields(fields)
}
