//! Tables that know which keys were asked for, so that every other key is an error with the nearest known one.

use std::cell::RefCell;
use std::ops::Range;

use toml::de::{DeTable, DeValue};

use crate::DataError;

/// A data file while it is read.
pub struct Document<'t> {
    file: String,
    text: &'t str,
    errors: RefCell<Vec<DataError>>,
}

impl<'t> Document<'t> {
    /// Reads a file's text with `build`; every error found on the way is returned together.
    ///
    /// # Errors
    /// All errors of the file, in the order in which they were found; the text's own TOML errors among them.
    pub fn read<T>(
        file: &str,
        text: &'t str,
        build: impl FnOnce(&mut Table<'_, 't>) -> T,
    ) -> Result<T, Vec<DataError>> {
        let document = Document { file: file.to_owned(), text, errors: RefCell::default() };
        let parsed = DeTable::parse(text).map_err(|error| {
            let range = error.span().unwrap_or(0..0);
            vec![DataError::at(file, text, range, error.message().to_owned())]
        })?;
        let range = parsed.span();
        let mut root = Table::new(&document, range, parsed.into_inner());
        let built = build(&mut root);
        root.finish();
        let errors = document.errors.into_inner();
        if errors.is_empty() { Ok(built) } else { Err(errors) }
    }

    fn report(&self, range: Range<usize>, message: String) {
        self.errors.borrow_mut().push(DataError::at(&self.file, self.text, range, message));
    }
}

/// A key and its value that a table lists freely (axes, offsets).
pub struct Entry<'d, 't> {
    /// The key.
    pub key: String,
    /// Where the key stands.
    pub at: Range<usize>,
    value: toml::Spanned<DeValue<'t>>,
    document: &'d Document<'t>,
}

/// A table while it is read. A key asked for and not there is `None`; a value of the wrong kind is reported and `None`.
pub struct Table<'d, 't> {
    document: &'d Document<'t>,
    range: Range<usize>,
    entries: Vec<Entry<'d, 't>>,
    known: Vec<&'static str>,
    found: Vec<&'static str>,
}

impl<'d, 't> Table<'d, 't> {
    fn new(document: &'d Document<'t>, range: Range<usize>, table: DeTable<'t>) -> Self {
        let entries = table
            .into_iter()
            .map(|(key, value)| Entry { at: key.span(), key: key.into_inner().into_owned(), value, document })
            .collect();
        Table { document, range, entries, known: Vec::new(), found: Vec::new() }
    }

    /// Where the table stands.
    pub fn range(&self) -> Range<usize> {
        self.range.clone()
    }

    /// Reports an error at a place of this file.
    pub fn error(&self, range: Range<usize>, message: impl Into<String>) {
        self.document.report(range, message.into());
    }

    /// Reports an error about the table as a whole, at its head.
    pub fn error_here(&self, message: impl Into<String>) {
        self.error(self.range(), message);
    }

    fn take(&mut self, key: &'static str) -> Option<Entry<'d, 't>> {
        self.known.push(key);
        let index = self.entries.iter().position(|entry| entry.key == key)?;
        self.found.push(key);
        Some(self.entries.remove(index))
    }

    /// The place of a key's value, if the key is there (before it is taken).
    pub fn place_of(&self, key: &str) -> Option<Range<usize>> {
        self.entries.iter().find(|entry| entry.key == key).map(|entry| entry.value.span())
    }

    /// A string.
    pub fn string(&mut self, key: &'static str) -> Option<String> {
        self.take(key)?.string()
    }

    /// A string that must be there.
    pub fn required_string(&mut self, key: &'static str) -> String {
        self.require(key);
        self.string(key).unwrap_or_default()
    }

    /// A whole number.
    pub fn integer(&mut self, key: &'static str) -> Option<i64> {
        self.take(key)?.integer()
    }

    /// A number, whole or not.
    pub fn number(&mut self, key: &'static str) -> Option<f64> {
        self.take(key)?.number()
    }

    /// True or false.
    pub fn boolean(&mut self, key: &'static str) -> Option<bool> {
        self.take(key)?.boolean()
    }

    /// A list of numbers.
    pub fn numbers(&mut self, key: &'static str) -> Option<Vec<f64>> {
        let entry = self.take(key)?;
        entry.list()?.into_iter().map(|item| item.number()).collect()
    }

    /// A list of whole numbers.
    pub fn integers(&mut self, key: &'static str) -> Option<Vec<i64>> {
        let entry = self.take(key)?;
        entry.list()?.into_iter().map(|item| item.integer()).collect()
    }

    /// A list of strings.
    pub fn strings(&mut self, key: &'static str) -> Option<Vec<String>> {
        let entry = self.take(key)?;
        entry.list()?.into_iter().map(|item| item.string()).collect()
    }

    /// One of several words; `None` if the key is absent, the error reported if the word is none of them.
    pub fn choice<T: Copy>(&mut self, key: &'static str, words: &[(&str, T)]) -> Option<T> {
        let range = self.place_of(key).unwrap_or_default();
        let word = self.string(key)?;
        let found = words.iter().find(|(name, _)| *name == word).map(|&(_, value)| value);
        if found.is_none() {
            let names: Vec<_> = words.iter().map(|(name, _)| *name).collect();
            self.error(range, format!("{key} = \"{word}\" is not one of {}", names.join(", ")));
        }
        found
    }

    /// A table inside this one, read by `build`.
    pub fn table<T>(&mut self, key: &'static str, build: impl FnOnce(&mut Table<'d, 't>) -> T) -> Option<T> {
        self.take(key)?.table(build)
    }

    /// Every table of an array of tables, read by `build`.
    pub fn tables<T>(&mut self, key: &'static str, mut build: impl FnMut(&mut Table<'d, 't>) -> T) -> Vec<T> {
        let Some(list) = self.take(key).and_then(Entry::list) else { return Vec::new() };
        list.into_iter().filter_map(|entry| entry.table(&mut build)).collect()
    }

    /// Every entry that was not asked for by name, in the order of the file.
    pub fn rest(&mut self) -> Vec<Entry<'d, 't>> {
        std::mem::take(&mut self.entries)
    }

    /// Reports the key as missing if it is not there.
    pub fn require(&mut self, key: &'static str) {
        if !self.found.contains(&key) && !self.entries.iter().any(|entry| entry.key == key) {
            self.error_here(format!("`{key}` is missing"));
        }
    }

    fn finish(&mut self) {
        for entry in std::mem::take(&mut self.entries) {
            entry.unknown(&self.known);
        }
    }
}

impl<'d, 't> Entry<'d, 't> {
    /// Reports this key as unknown, naming the nearest of the known ones.
    pub fn unknown(&self, known: &[&str]) {
        let key = &self.key;
        let near = nearest(key, known.iter().copied());
        let hint = near.map(|name| format!(", perhaps `{name}` is meant")).unwrap_or_default();
        self.document.report(self.at.clone(), format!("`{key}` is not a known key{hint}"));
    }

    /// Reports an error at this entry's value.
    pub fn error(&self, message: impl Into<String>) {
        self.document.report(self.value.span(), message.into());
    }

    fn wrong<T>(&self, wanted: &str) -> Option<T> {
        self.error(format!("`{}` wants {wanted}", self.key));
        None
    }

    /// The value as a string.
    pub fn string(&self) -> Option<String> {
        match self.value.get_ref() {
            DeValue::String(text) => Some(text.to_string()),
            _ => self.wrong("a text in quotes"),
        }
    }

    /// The value as a whole number.
    pub fn integer(&self) -> Option<i64> {
        match self.value.get_ref() {
            DeValue::Integer(number) => {
                i64::from_str_radix(number.as_str(), number.radix()).ok().or_else(|| self.wrong("a whole number"))
            }
            _ => self.wrong("a whole number"),
        }
    }

    /// The value as a number.
    pub fn number(&self) -> Option<f64> {
        match self.value.get_ref() {
            DeValue::Integer(_) => self.integer().map(|whole| whole as f64),
            DeValue::Float(number) => match number.as_str().parse::<f64>() {
                Ok(value) if value.is_finite() => Some(value),
                _ => self.wrong("a finite number"),
            },
            _ => self.wrong("a number"),
        }
    }

    /// The value as true or false.
    pub fn boolean(&self) -> Option<bool> {
        match self.value.get_ref() {
            DeValue::Boolean(value) => Some(*value),
            _ => self.wrong("true or false"),
        }
    }

    /// The value if it is true or false; any other kind is no error.
    pub fn boolean_or_none(&self) -> Option<bool> {
        match self.value.get_ref() {
            DeValue::Boolean(value) => Some(*value),
            _ => None,
        }
    }

    /// True if the value is a list.
    pub fn is_list(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::Array(_))
    }

    /// The value as a string, or a number or truth value as it is written.
    pub fn written(&self) -> Option<String> {
        match self.value.get_ref() {
            DeValue::String(text) => Some(text.to_string()),
            DeValue::Integer(_) => self.integer().map(|number| number.to_string()),
            DeValue::Float(_) => self.number().map(|number| number.to_string()),
            DeValue::Boolean(value) => Some(value.to_string()),
            _ => self.wrong("a single value"),
        }
    }

    /// The value as a list.
    pub fn list(self) -> Option<Vec<Entry<'d, 't>>> {
        let Entry { key, value, document, .. } = self;
        let range = value.span();
        match value.into_inner() {
            DeValue::Array(items) => Some(
                // What is wrong with one of several tables stands there, not at the key of all.
                items.into_iter().map(|value| Entry { key: key.clone(), at: value.span(), value, document }).collect(),
            ),
            _ => {
                document.report(range, format!("`{key}` wants a list"));
                None
            }
        }
    }

    /// The value as a table, read by `build`.
    pub fn table<T>(self, build: impl FnOnce(&mut Table<'d, 't>) -> T) -> Option<T> {
        let Entry { key, at, value, document } = self;
        match value.into_inner() {
            DeValue::Table(table) => {
                let mut table = Table::new(document, at, table);
                let built = build(&mut table);
                table.finish();
                Some(built)
            }
            _ => {
                document.report(at, format!("`{key}` wants a table"));
                None
            }
        }
    }
}

/// The place of a key in a text that has been read: the tables that lead to it, then the key, `_` as good as `-`.
pub fn place_of(text: &str, path: &[&str]) -> Option<Range<usize>> {
    let plain = |name: &str| name.replace('_', "-");
    let mut table = DeTable::parse(text).ok()?.into_inner();
    let (last, tables) = path.split_last()?;
    for name in tables {
        let (_, inner) = table.into_iter().find(|(key, _)| plain(key.get_ref()) == plain(name))?;
        let DeValue::Table(inner) = inner.into_inner() else { return None };
        table = inner;
    }
    table.into_iter().find(|(key, _)| plain(key.get_ref()) == plain(last)).map(|(key, _)| key.span())
}

/// The name most like `wanted`, if one is at all like it.
pub fn nearest<'a>(wanted: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = wanted.to_lowercase();
    names
        .map(|name| (strsim::jaro_winkler(&wanted, &name.to_lowercase()), name))
        .filter(|(likeness, _)| *likeness > 0.7)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<(f64, Vec<i64>), Vec<DataError>> {
        Document::read("file.toml", text, |root| {
            root.require("speed");
            let speed = root.number("speed").unwrap_or(0.0);
            let codes = root.tables("code", |row| row.integer("g").unwrap_or(-1));
            (speed, codes)
        })
    }

    #[test]
    fn values_come_out_in_the_files_order() {
        assert_eq!(read("speed = 2\n[[code]]\ng = 4\n[[code]]\ng = 0x10"), Ok((2.0, vec![4, 16])));
    }

    #[test]
    fn every_error_names_its_line_and_key() {
        let errors = read("sped = 2\n[[code]]\ng = \"4\"\n").expect_err("three errors");
        let said: Vec<_> = errors.iter().map(|e| format!("{}:{} {}", e.line, e.column, e.message)).collect();
        assert_eq!(
            said,
            [
                "1:1 `speed` is missing",
                "3:5 `g` wants a whole number",
                "1:1 `sped` is not a known key, perhaps `speed` is meant",
            ]
        );
    }

    #[test]
    fn a_key_is_found_by_the_tables_that_lead_to_it() {
        let text = "[work.G54]\nX = 1\n[switches]\noptional_stop = true\n";
        assert_eq!(place_of(text, &["work", "G54", "X"]), Some(11..12));
        assert_eq!(place_of(text, &["switches", "optional-stop"]), Some(28..41));
        assert_eq!(place_of(text, &["work", "G55", "X"]), None);
    }

    #[test]
    fn broken_toml_is_an_error_like_any_other() {
        let errors = read("speed = = 2").expect_err("not TOML");
        assert_eq!((errors[0].line, errors[0].column), (1, 9));
        assert!(errors[0].to_string().contains("file.toml:1:9"));
    }
}
