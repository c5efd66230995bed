//! The edit display: a cursor on a word, words and blocks put in, altered and deleted, programs made and deleted.
//!
//! A change is made as a whole or not at all: the new text takes the place of the old one when it is complete.

use base::SourceId;
use dialect::{ModeKind, ModeRow};
use syntax::Cursor;

use super::{Loaded, Operator, memory_key, normal_name};
use crate::catalogue::programs_in;
use crate::display::Value;
use crate::edit::Edit;
use crate::library::{Library, LibraryError, Shelf, Wanted};
use crate::program_text::{Part, ProgramText, blocks_of_text, number_of, text_of};

/// Lines of a page of the edit display.
const PAGE: usize = 20;

type Outcome = Result<Result<(), String>, LibraryError>;

/// Why programs cannot be changed now.
pub(super) fn refusal(mode: &ModeRow, locked: bool, edit: &Edit) -> Option<String> {
    if mode.kind != ModeKind::Edit {
        return Some(format!("programs are edited in mode edit, not in mode {}", mode.name));
    }
    (locked && edit.changes()).then(|| LOCKED.to_owned())
}

/// The key EDIT LOCK.
pub(super) const LOCKED: &str = "EDIT LOCK is on: programs in memory are not changed";

impl<L: Shelf> Operator<L> {
    /// A key of the edit display; the inner error is why it is refused.
    pub(super) fn edit(&mut self, edit: &Edit) -> Outcome {
        if let Some(why) = refusal(self.mode(), self.session.is_edit_locked(), edit) {
            return Ok(Err(why));
        }
        match edit {
            Edit::New(name) => return self.new_program(name),
            Edit::DeleteProgram(name) => return self.delete_program(name),
            _ => {}
        }
        let Some(key) = self.selected.clone() else { return Ok(Err("no program is selected".to_owned())) };
        let Some(program) = self.text_of_program(&key)? else {
            return Ok(Err(format!("{key} is no longer in memory")));
        };
        let at = program.part_at(self.edit_at.max(program.from));
        // Before the first word of an empty program there is only its beginning.
        let nothing = Part { at: program.from, len: 0, line: 1, ends: true, block: program.from };
        let part = match program.parts.get(at) {
            Some(part) => *part,
            None if matches!(edit, Edit::Insert(_)) => nothing,
            None => return Ok(Err("the program is empty".to_owned())),
        };
        let cursor = match edit {
            Edit::Top => program.parts.first().copied(),
            Edit::Next => program.parts.get(at + 1).copied(),
            Edit::Back => at.checked_sub(1).and_then(|at| program.parts.get(at)).copied(),
            Edit::Line(line) => program.parts.iter().find(|part| part.line == *line).copied(),
            Edit::Find(word) => find(&program, at, word),
            _ => return self.change(&key, program, part, edit),
        };
        Ok(match cursor {
            Some(part) => {
                self.edit_at = part.at;
                Ok(())
            }
            None => Err(match edit {
                Edit::Find(word) => format!("{word} does not stand behind the cursor"),
                Edit::Line(line) => format!("the program has no line {line}"),
                _ => "the program ends there".to_owned(),
            }),
        })
    }

    /// Changes the selected program at the cursor.
    fn change(&mut self, key: &str, program: ProgramText, part: Part, edit: &Edit) -> Outcome {
        if let Some(number) = number_of(key)
            && self.is_protected(number)
        {
            return Ok(Ok(()));
        }
        let names_program = part.at == program.from && program.word(&part).starts_with(['O', 'o', ':']);
        let typed = match edit {
            Edit::Insert(words) | Edit::Alter(words) => match self.typed_words(words) {
                Ok(typed) => typed,
                Err(why) => return Ok(Err(why)),
            },
            _ => String::new(),
        };
        if names_program && matches!(edit, Edit::Alter(_) | Edit::Delete | Edit::DeleteBlock) {
            return Ok(Err("the program's number stands there; make a new program, or delete this one".to_owned()));
        }
        let (text, at) = changed(&program, &part, edit, &typed);
        let Some(source) = self.programs.get(key).map(|loaded| loaded.source) else { return Ok(Ok(())) };
        if let Err(why) = self.put_text(source, text)? {
            return Ok(Err(why));
        }
        self.edit_at = at;
        Ok(self.select_edited(key))
    }

    /// Typed words as they go into the text.
    fn typed_words(&self, words: &str) -> Result<String, String> {
        let grammar = self.session.configuration().control.grammar;
        if let Some(wrong) = words.chars().find(|character| !(' '..='~').contains(character) || *character == '%') {
            return Err(format!("`{wrong}` is not typed at this panel"));
        }
        let text = words.replace("; ", ";").replace(" ;", ";").replace(';', "\n");
        let mut names = false;
        blocks_of_text(text.as_bytes(), &grammar, |block| {
            names |= block.begins_program(&grammar);
            true
        });
        if names {
            return Err("a program's number is typed with edit new".to_owned());
        }
        Ok(text)
    }

    /// A new program with nothing but its number.
    fn new_program(&mut self, name: &str) -> Outcome {
        let key = memory_key(name, self.files());
        if self.programs.contains_key(&key) {
            return Ok(Err(format!("{key} is in memory already")));
        }
        let text = match (number_of(&key), self.files()) {
            (Some(number), None) => format!("O{number}\n"),
            (None, None) => return Ok(Err(format!("`{name}` is no program number"))),
            (_, Some(_)) => String::new(),
        };
        if let Some((condition, value)) = self.load_refusal(&[(key.clone(), Cursor::HEAD)]) {
            self.session.raise_at_panel(condition, [value, 0.0, 0.0]);
            return Ok(Ok(()));
        }
        let source = self.session.library_mut().hold_text(&key, text.into_bytes())?;
        let called = self.files().map(|files| format!("{key}.{}", files.ending.to_ascii_uppercase()));
        match (number_of(&key), &called) {
            (_, Some(called)) => self.session.library_mut().keep_in_memory(Wanted::File(called), source),
            (Some(number), None) => self.session.library_mut().keep_in_memory(Wanted::Number(number, ""), source),
            (None, None) => {}
        }
        let loaded = Loaded {
            name: if called.is_some() { name.to_owned() } else { key.clone() },
            source,
            head: Cursor::HEAD,
            called,
        };
        self.programs.insert(key.clone(), loaded);
        self.edit_at = 0;
        Ok(self.select_edited(&key))
    }

    fn delete_program(&mut self, name: &str) -> Outcome {
        let key = memory_key(name, self.files());
        let Some(Loaded { source, .. }) = self.programs.get(&key).cloned() else {
            return Ok(Err(format!("there is no program {} in memory", normal_name(name))));
        };
        if let Some(number) = number_of(&key)
            && self.is_protected(number)
        {
            return Ok(Ok(()));
        }
        let Some(mut program) = self.text_of_program(&key)? else {
            return Ok(Err(format!("{key} is no longer in memory")));
        };
        program.text.drain(program.from..program.to);
        // Its own name goes first, so that a text without a number is not taken for it.
        let loaded = self.programs.remove(&key);
        if let Err(why) = self.put_text(source, program.text)? {
            self.programs.extend(loaded.map(|loaded| (key.clone(), loaded)));
            return Ok(Err(why));
        }
        self.forget_program(&key, loaded.and_then(|loaded| loaded.called).as_deref());
        self.restart = None;
        if self.selected.as_ref() == Some(&key) {
            self.selected = None;
            let nothing = self.session.library_mut().hold_text("", Vec::new())?;
            self.session.interpreter_mut().forget_texts();
            self.session.select(nothing, "", Cursor::HEAD);
        }
        Ok(Ok(()))
    }

    /// A text takes the place of another: every program of the old one stands in the new one, or is gone with it.
    fn put_text(&mut self, old: SourceId, text: Vec<u8>) -> Outcome {
        let grammar = self.session.configuration().control.grammar;
        let by_file = self.files().is_some();
        let own: Vec<String> =
            self.programs.iter().filter(|(_, loaded)| loaded.source == old).map(|(key, _)| key.clone()).collect();
        let name = own.first().cloned().unwrap_or_default();
        let source = self.session.library_mut().hold_text(&name, text)?;
        let found = if by_file { Vec::new() } else { programs_in(self.session.library_mut(), source, &grammar, None)? };
        for (number, _) in &found {
            let key = format!("O{number}");
            if self.programs.get(&key).is_some_and(|loaded| loaded.source != old) {
                return Ok(Err(format!("{key} is in memory already")));
            }
        }
        for key in own {
            let head = found.iter().find(|(number, _)| number_of(&key) == Some(*number)).map(|(_, head)| *head);
            let Some(loaded) = self.programs.get_mut(&key) else { continue };
            // A program without a number of its own begins with its text.
            let head = head.or((loaded.head == Cursor::HEAD).then_some(Cursor::HEAD));
            let called = loaded.called.clone();
            let Some(head) = head else {
                self.programs.remove(&key);
                self.forget_program(&key, called.as_deref());
                continue;
            };
            (loaded.source, loaded.head) = (source, head);
            let library = self.session.library_mut();
            match (number_of(&key), &called) {
                (_, Some(called)) => library.keep_in_memory(Wanted::File(called), source),
                (Some(number), None) => library.keep_in_memory(Wanted::Number(number, ""), source),
                (None, None) => {}
            }
        }
        self.session.interpreter_mut().forget_texts();
        Ok(Ok(()))
    }

    fn forget_program(&mut self, key: &str, called: Option<&str>) {
        let library = self.session.library_mut();
        match (number_of(key), called) {
            (_, Some(called)) => library.forget_in_memory(Wanted::File(called)),
            (Some(number), None) => library.forget_in_memory(Wanted::Number(number, "")),
            (None, None) => {}
        }
    }

    /// The program that was edited is selected, at its head; the cursor stays.
    fn select_edited(&mut self, key: &str) -> Result<(), String> {
        let at = self.edit_at;
        self.restart = None;
        let selected = self.select(key);
        self.edit_at = at;
        selected
    }

    /// A protected program is not changed: the alarm says so.
    fn is_protected(&mut self, number: u32) -> bool {
        let interpreter = self.session.interpreter();
        let protected = interpreter.fitting().protects(interpreter.control(), number);
        if protected {
            self.session.raise_at_panel(base::Condition::ProgramProtected, [f64::from(number), 0.0, 0.0]);
        }
        protected
    }
}

impl<L: Library> Operator<L> {
    fn text_of_program(&mut self, key: &str) -> Result<Option<ProgramText>, LibraryError> {
        let Some(Loaded { source, head, .. }) = self.programs.get(key).cloned() else { return Ok(None) };
        let interpreter = self.session.interpreter();
        let (grammar, codes) = (interpreter.control().grammar, interpreter.fitting().tape_codes(interpreter.control()));
        let text = text_of(self.session.library_mut(), source, codes)?;
        let number = number_of(key).filter(|_| self.session.configuration().control.files.is_none());
        let empty = ProgramText { text: text.clone(), parts: Vec::new(), from: 0, to: text.len() };
        let found = number.and_then(|number| ProgramText::of(text.clone(), Some(number), &grammar));
        let first = || (head == Cursor::HEAD).then(|| ProgramText::of(text.clone(), None, &grammar).unwrap_or(empty));
        Ok(found.or_else(first))
    }

    /// The page of the edit display: the cursor and the lines around it.
    pub(crate) fn edit_page(&mut self) -> Option<[(String, Value); 2]> {
        if self.mode().kind != ModeKind::Edit {
            return None;
        }
        let key = self.selected.clone()?;
        let program = self.text_of_program(&key).ok()??;
        let part = program.parts.get(program.part_at(self.edit_at.max(program.from))).copied();
        let line = part.map_or(1, |part| part.line);
        let first = line.saturating_sub(PAGE as u64 / 2);
        let cursor = part.map_or(Value::Null, |part| {
            Value::object([("line", Value::Number(part.line as f64)), ("word", Value::Text(program.word(&part)))])
        });
        let lines = program.lines(first, PAGE).into_iter().map(Value::Text).collect();
        Some([("cursor".to_owned(), cursor), ("text".to_owned(), Value::List(lines))])
    }
}

/// The next part behind the cursor that is this word, or has this address.
fn find(program: &ProgramText, at: usize, wanted: &str) -> Option<Part> {
    let wanted: String = wanted.chars().filter(|character| *character != ' ').collect::<String>().to_ascii_uppercase();
    let is_address = wanted.len() == 1 && wanted.starts_with(|letter: char| letter.is_ascii_uppercase());
    let is_it = |part: &&Part| {
        let word: String = program.word(part).chars().filter(|character| *character != ' ').collect();
        let word = word.to_ascii_uppercase();
        word == wanted || is_address && word.starts_with(&wanted)
    };
    program.parts.iter().skip(at + 1).find(is_it).copied()
}

/// The text after the change, and where the cursor stands then.
fn changed(program: &ProgramText, part: &Part, edit: &Edit, typed: &str) -> (Vec<u8>, usize) {
    let text = &program.text;
    let is_blank = |at: usize| text.get(at).is_some_and(|byte| *byte == b' ' || *byte == b'\t');
    let end = part.at + part.len;
    let (from, to, new) = match edit {
        // Behind the end of a block the words begin the next one.
        Edit::Insert(_) if part.ends => {
            let blank = if typed.ends_with('\n') || matches!(text.get(end), None | Some(b'\n')) { "" } else { " " };
            let lacks_end = end > 0 && !text[..end].ends_with(b"\n") && !text[..end].ends_with(b";");
            (end, end, format!("{}{typed}{blank}", if lacks_end { "\n" } else { "" }))
        }
        Edit::Insert(_) => {
            let blank = if typed.starts_with('\n') { "" } else { " " };
            // What follows the cursor's word belongs to the block that was begun last.
            let follows = typed.ends_with('\n') && is_blank(end);
            (end, if follows { end + 1 } else { end }, format!("{blank}{typed}"))
        }
        Edit::Alter(_) if part.ends => {
            (part.at, end, format!(" {typed}{}", if typed.ends_with('\n') { "" } else { " " }))
        }
        Edit::Alter(_) => (part.at, end, typed.to_owned()),
        Edit::DeleteBlock => {
            let block_end = program.parts.iter().find(|other| other.ends && other.block == part.block);
            (part.block, block_end.map_or(program.to, |end| end.at + end.len), String::new())
        }
        _ if part.ends => (part.at, end, " ".to_owned()),
        _ => {
            let mut from = part.at;
            while from > part.block && is_blank(from - 1) {
                from -= 1;
            }
            let mut to = end;
            while from == part.block && is_blank(to) {
                to += 1;
            }
            (from, to, String::new())
        }
    };
    let mut changed = text[..from].to_vec();
    changed.extend_from_slice(new.as_bytes());
    changed.extend_from_slice(&text[to..]);
    // Behind what was put in the cursor stands on its last word.
    let last = new.trim_end().rfind([' ', '\n']).map_or(0, |at| at + 1);
    let cursor = if new.trim().is_empty() { from } else { from + last };
    (changed, cursor)
}
