//! `memory`: what `operate --memory` keeps, written as text, read back, and its histories.

use std::io::{Read, Write};
use std::path::Path;

use memory::{Content, List, Store};

use crate::arguments::{ExportArguments, ExportForm, HistoryArguments, ImportArguments, MemoryCommand};
use crate::failure::Failure;
use crate::output::write_file;

mod data_tape;

pub fn memory(command: &MemoryCommand) -> Result<bool, Failure> {
    match command {
        MemoryCommand::Export(arguments) => export(arguments),
        MemoryCommand::Import(arguments) => import(arguments),
        MemoryCommand::History(arguments) => history(arguments),
    }
}

/// The name under which this process holds a memory.
pub fn holder() -> String {
    format!("cyclestart, process {}", std::process::id())
}

/// A memory that is there already: a wrong name makes no empty one.
fn opened(folder: &Path) -> Result<Store, Failure> {
    if !folder.join(memory::FILE).is_file() {
        return Err(Failure::call(format!("there is no memory in {}", folder.display())));
    }
    Store::open(folder, &holder()).map_err(Failure::call)
}

fn export(arguments: &ExportArguments) -> Result<bool, Failure> {
    let content = opened(&arguments.folder)?.content().map_err(Failure::call)?;
    let text = match arguments.form {
        ExportForm::Text => content.export().map_err(Failure::call)?,
        ExportForm::Tape => data_tape::write(&content, arguments)?,
    };
    let own = arguments.folder.join(memory::FILE);
    write_file(arguments.output.as_deref().unwrap_or(Path::new("-")), text.as_bytes(), &[&own])?;
    Ok(true)
}

fn import(arguments: &ImportArguments) -> Result<bool, Failure> {
    let file = &arguments.file;
    let cannot = |error| Failure::call(format!("cannot read {file}: {error}"));
    let mut text = String::new();
    match file.as_str() {
        "-" => drop(std::io::stdin().read_to_string(&mut text).map_err(cannot)?),
        _ => text = std::fs::read_to_string(file).map_err(cannot)?,
    }
    if text.trim_start().starts_with('%') {
        return data_tape::read(arguments, text);
    }
    let content = Content::import(&text).map_err(|trouble| Failure::call(format!("{file}: {trouble}")))?;
    let mut store = Store::open(&arguments.folder, &holder()).map_err(Failure::call)?;
    store.replace(&content).map_err(Failure::call)?;
    Ok(true)
}

fn history(arguments: &HistoryArguments) -> Result<bool, Failure> {
    let content = opened(&arguments.folder)?.content().map_err(Failure::call)?;
    let mut out = std::io::stdout().lock();
    for list in List::ALL {
        for entry in content.history.get(&list).into_iter().flatten() {
            writeln!(out, "{}: {entry}", list.name())?;
        }
    }
    Ok(true)
}
