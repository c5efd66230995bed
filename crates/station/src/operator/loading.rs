//! Programs come into memory: from a file, or from where they were kept.

use std::collections::BTreeSet;

use base::{Condition, SourceId};
use dialect::FileNames;
use syntax::Cursor;

use super::{Loaded, Operator, ends_with, memory_key, normal_name, without_ending};
use crate::catalogue::programs_in;
use crate::library::{LibraryError, Shelf, Wanted};
use crate::program_text::number_of;

impl<L: Shelf> Operator<L> {
    /// Loads a file into memory: every program that it holds.
    pub(super) fn load(&mut self, file: &str, name: Option<&str>) -> Result<(), LibraryError> {
        let grammar = self.session.configuration().control.grammar;
        let files = self.files().cloned();
        let interpreter = self.session.interpreter();
        let codes = interpreter.fitting().tape_codes(interpreter.control());
        let shelf = self.session.library_mut();
        let (source, own_name) = shelf.open_file(file)?;
        if let Some(files) = files {
            return self.load_file(name.unwrap_or(file), (source, name.unwrap_or(&own_name)), &files);
        }
        let shelf = self.session.library_mut();
        let found = programs_in(shelf, source, &grammar, codes)?;
        let mut names = Vec::new();
        // A name given by hand, or the file's where no O word stands in it, is that of the text's first program.
        match name {
            Some(name) => names.push((normal_name(name), Cursor::HEAD)),
            None if found.is_empty() => names.push((normal_name(&own_name), Cursor::HEAD)),
            None => {}
        }
        names.extend(found.into_iter().map(|(number, head)| (format!("O{number}"), head)));
        if let Some((condition, value)) = self.load_refusal(&names) {
            self.session.raise_at_panel(condition, [value, 0.0, 0.0]);
            return Ok(());
        }
        let mut reloaded = false;
        for (name, head) in names.into_iter().rev() {
            reloaded |= self.selected.as_ref() == Some(&name);
            self.register(name, source, head);
        }
        self.take_new_texts(reloaded);
        Ok(())
    }

    /// Loads a file that is one program, known by its name without case.
    fn load_file(
        &mut self,
        file: &str,
        (source, shown): (SourceId, &str),
        files: &FileNames,
    ) -> Result<(), LibraryError> {
        let shown = without_ending(shown, files);
        let key = shown.to_ascii_uppercase();
        let names = [(key.clone(), Cursor::HEAD)];
        if let Some((condition, value)) = self.load_refusal(&names) {
            self.session.raise_at_panel(condition, [value, 0.0, 0.0]);
            return Ok(());
        }
        let reloaded = self.selected.as_ref() == Some(&key);
        self.register_file(shown, file, source, files);
        self.take_new_texts(reloaded);
        Ok(())
    }

    /// What was remembered of programs is worth nothing; the one that was selected may have been replaced.
    fn take_new_texts(&mut self, reloaded: bool) {
        self.session.interpreter_mut().forget_texts();
        if let (true, Some(name)) = (reloaded, self.selected.clone()) {
            let _ = self.select(&name);
        }
    }

    /// Why memory does not take these programs, if it does not, and the number that says so.
    pub(super) fn load_refusal(&self, names: &[(String, Cursor)]) -> Option<(Condition, f64)> {
        let interpreter = self.session.interpreter();
        let (control, fitting) = (interpreter.control(), interpreter.fitting());
        let numbers = names.iter().filter_map(|(name, _)| number_of(name));
        if let Some(number) = numbers.into_iter().find(|&number| fitting.protects(control, number)) {
            return Some((Condition::ProgramProtected, f64::from(number)));
        }
        let more: BTreeSet<&str> =
            names.iter().map(|(name, _)| name.as_str()).filter(|name| !self.programs.contains_key(*name)).collect();
        let most = fitting.most_programs(control)?;
        (self.programs.len() + more.len() > most).then_some((Condition::MemoryFull, most as f64))
    }

    /// Puts a text back into memory with the programs that stood in it, as they were listed; with none, what is found
    /// there. On a control whose programs are files it is the program of that file.
    ///
    /// # Errors
    /// The text cannot be read.
    pub fn put_back(
        &mut self,
        name: &str,
        source: SourceId,
        programs: Vec<(String, Cursor)>,
    ) -> Result<(), LibraryError> {
        if let Some(files) = self.files().cloned() {
            self.register_file(without_ending(name, &files), name, source, &files);
            return Ok(());
        }
        let programs = if programs.is_empty() { self.found_in(name, source)? } else { programs };
        for (name, head) in programs {
            self.register(memory_key(&name, None), source, head);
        }
        Ok(())
    }

    /// The programs of a text, as loading finds them; the text's own name if there are none.
    fn found_in(&mut self, name: &str, source: SourceId) -> Result<Vec<(String, Cursor)>, LibraryError> {
        let interpreter = self.session.interpreter();
        let codes = interpreter.fitting().tape_codes(interpreter.control());
        let grammar = interpreter.control().grammar;
        let found = programs_in(self.session.library_mut(), source, &grammar, codes)?;
        let mut names: Vec<_> = found.into_iter().map(|(number, head)| (format!("O{number}"), head)).collect();
        let name = memory_key(name, None);
        if !names.iter().any(|(found, _)| *found == name) {
            names.push((name, Cursor::HEAD));
        }
        Ok(names)
    }

    /// A program of this name is in memory; others call it by its number.
    fn register(&mut self, name: String, source: SourceId, head: Cursor) {
        if let Some(number) = number_of(&name) {
            self.session.library_mut().keep_in_memory(Wanted::Number(number, ""), source);
        }
        self.programs.insert(name.clone(), Loaded { name, source, head, called: None });
    }

    /// A file is in memory; others call it by its name and ending.
    fn register_file(&mut self, shown: &str, file: &str, source: SourceId, files: &FileNames) {
        let key = shown.to_ascii_uppercase();
        let large = files.large.as_ref().filter(|large| ends_with(file, large));
        let called = format!("{key}.{}", large.unwrap_or(&files.ending).to_ascii_uppercase());
        self.session.library_mut().keep_in_memory(Wanted::File(&called), source);
        self.programs.insert(key, Loaded { name: shown.to_owned(), source, head: Cursor::HEAD, called: Some(called) });
    }
}
