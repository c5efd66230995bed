//! What the memory holds, and changes to it, as values; all of it as readable text.

use std::collections::BTreeMap;

use toml::{Table, Value};

use crate::trouble::Trouble;

/// The kinds of values.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Kind {
    /// Tool offsets, mm.
    Offset,
    /// Origins of work systems, mm or degrees.
    Work,
    /// Parameters.
    Parameter,
    /// Variables that last.
    Variable,
    /// The operator's switches.
    Switch,
    /// What else the station remembers: the selected program.
    State,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Kind; 6] = [Kind::Offset, Kind::Work, Kind::Parameter, Kind::Variable, Kind::Switch, Kind::State];

    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Kind::Offset => "offsets",
            Kind::Work => "work",
            Kind::Parameter => "parameters",
            Kind::Variable => "variables",
            Kind::Switch => "switches",
            Kind::State => "state",
        }
    }

    pub(crate) fn named(name: &str) -> Option<Kind> {
        Kind::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// The histories.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum List {
    /// Alarms.
    Alarms,
    /// Runs of programs.
    Runs,
}

impl List {
    /// Every history.
    pub const ALL: [List; 2] = [List::Alarms, List::Runs];

    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            List::Alarms => "alarms",
            List::Runs => "runs",
        }
    }
}

/// A program's text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Program {
    /// The name under which it was loaded.
    pub name: String,
    /// Its bytes, exactly as loaded.
    pub text: Vec<u8>,
    /// It may not be edited.
    pub protected: bool,
}

/// One change.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Change {
    /// A program comes in, or takes the place of the one of its name.
    Load(Program),
    /// A program goes.
    Remove(String),
    /// A value is written; `None` forgets it.
    Write(Kind, String, Option<String>),
    /// An entry at the end of a history.
    Note(List, String),
}

/// All that the memory holds.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Content {
    /// Programs in the order in which they were loaded.
    pub programs: Vec<Program>,
    /// Values.
    pub values: BTreeMap<(Kind, String), String>,
    /// Histories, the oldest first.
    pub history: BTreeMap<List, Vec<String>>,
}

impl Content {
    /// As text that people read: TOML. The same content is always the same text.
    ///
    /// # Errors
    /// The text could not be built.
    pub fn export(&self) -> Result<String, Trouble> {
        let mut root = Table::new();
        for kind in Kind::ALL {
            let of_kind = self.values.iter().filter(|((of, _), _)| *of == kind);
            let table: Table = of_kind.map(|((_, name), value)| (name.clone(), Value::String(value.clone()))).collect();
            root.insert(kind.name().to_owned(), Value::Table(table));
        }
        let mut history = Table::new();
        for list in List::ALL {
            let entries = self.history.get(&list).into_iter().flatten().cloned().map(Value::String).collect();
            history.insert(list.name().to_owned(), Value::Array(entries));
        }
        root.insert("history".to_owned(), Value::Table(history));
        let programs = self.programs.iter().map(|program| {
            let mut table = Table::new();
            table.insert("name".to_owned(), Value::String(program.name.clone()));
            table.insert("protected".to_owned(), Value::Boolean(program.protected));
            match std::str::from_utf8(&program.text) {
                Ok(text) => table.insert("text".to_owned(), Value::String(text.to_owned())),
                // Images of tapes are no text: two hexadecimal digits a byte.
                Err(_) => {
                    let digits = program.text.iter().map(|byte| format!("{byte:02x}")).collect();
                    table.insert("bytes".to_owned(), Value::String(digits))
                }
            };
            Value::Table(table)
        });
        root.insert("programs".to_owned(), Value::Array(programs.collect()));
        toml::to_string(&root).map_err(|error| Trouble(format!("the memory cannot be written as text: {error}")))
    }

    /// Reads what [`Content::export`] wrote.
    ///
    /// # Errors
    /// What is not as an export writes it.
    pub fn import(text: &str) -> Result<Content, Trouble> {
        let root: Table = text.parse().map_err(|error| Trouble(format!("this is no export of a memory: {error}")))?;
        let mut content = Content::default();
        for (name, value) in &root {
            match (name.as_str(), Kind::named(name), value) {
                (_, Some(kind), Value::Table(table)) => {
                    for (name, value) in table {
                        let value = value.as_str().ok_or_else(|| no_text(name))?;
                        content.values.insert((kind, name.clone()), value.to_owned());
                    }
                }
                ("history", _, Value::Table(table)) => content.history = histories(table)?,
                ("programs", _, Value::Array(programs)) => {
                    content.programs = programs.iter().map(program).collect::<Result<_, _>>()?;
                }
                _ => return Err(Trouble(format!("`{name}` is no part of an export of a memory"))),
            }
        }
        for (at, program) in content.programs.iter().enumerate() {
            if content.programs.iter().take(at).any(|other| other.name == program.name) {
                return Err(Trouble(format!("the program {} is there twice", program.name)));
            }
        }
        Ok(content)
    }
}

fn no_text(name: &str) -> Trouble {
    Trouble(format!("`{name}` has no value between quotes"))
}

fn histories(table: &Table) -> Result<BTreeMap<List, Vec<String>>, Trouble> {
    let mut history = BTreeMap::new();
    for (name, entries) in table {
        let list = List::ALL.into_iter().find(|list| list.name() == name);
        let (Some(list), Some(entries)) = (list, entries.as_array()) else {
            return Err(Trouble(format!("there is no history `{name}`")));
        };
        let entries: Option<Vec<_>> = entries.iter().map(|entry| entry.as_str().map(str::to_owned)).collect();
        let entries = entries.ok_or_else(|| no_text(name))?;
        if !entries.is_empty() {
            history.insert(list, entries);
        }
    }
    Ok(history)
}

fn program(value: &Value) -> Result<Program, Trouble> {
    let text_of = |key: &str| value.get(key).and_then(Value::as_str);
    let name = text_of("name").ok_or_else(|| no_text("name"))?.to_owned();
    let text = match (text_of("text"), text_of("bytes")) {
        (Some(text), None) => text.as_bytes().to_vec(),
        (None, Some(digits)) => bytes_of(digits)
            .ok_or_else(|| Trouble(format!("program {name}: `bytes` are pairs of hexadecimal digits")))?,
        _ => return Err(Trouble(format!("program {name}: it has either `text` or `bytes`"))),
    };
    let protected = value.get("protected").and_then(Value::as_bool).unwrap_or(false);
    Ok(Program { name, text, protected })
}

fn bytes_of(digits: &str) -> Option<Vec<u8>> {
    let pairs = digits.as_bytes().chunks(2);
    pairs
        .map(|pair| match std::str::from_utf8(pair) {
            Ok(pair) if pair.len() == 2 => u8::from_str_radix(pair, 16).ok(),
            _ => None,
        })
        .collect()
}
