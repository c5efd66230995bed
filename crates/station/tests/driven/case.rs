//! A case of the corpus as a session: its control, machine, set-up, texts.

use std::path::Path;
use std::sync::Arc;

use base::SourceId;
use dialect::{ParameterSetting, builtin_files, load_control};
use machine::{builtin_machine, read_machine};
use station::{Configuration, OffsetColumn, Session, Setup, read_setup, split_offset, split_switch};
use syntax::Cursor;
use testkit::Case;

use crate::watch::Texts;

/// Commands whose case is no program that is run.
const OTHERS: &[&str] = &["operate", "tape", "diff", "fmt", "controls", "coverage"];

/// The session of a case; `None` if it is no program, or nothing that can be set up so.
pub fn session(family: &Path, folder: &Path) -> Option<Session<Texts>> {
    let case = Case::read(folder).ok()?;
    if OTHERS.contains(&case.run.first()?.as_str()) {
        return None;
    }
    let family = family.file_name()?.to_string_lossy().into_owned();
    let mut words = case.run.iter().chain(&case.arguments);
    let (mut name, mut machine, mut file) = (case.control.clone().unwrap_or(family), None, Setup::default());
    let (mut line, mut offsets) = (Setup::default(), Vec::new());
    while let Some(word) = words.next() {
        let mut value = || words.next().map(String::as_str);
        match word.as_str() {
            "--control" => name = value()?.to_owned(),
            "--machine" => machine = value(),
            "--setup" => file = read_setup("case", &std::fs::read_to_string(folder.join(value()?)).ok()?).ok()?,
            "--offset" => offsets.push(value()?.to_owned()),
            "--work" => work(&mut line, value()?)?,
            "--parameter" => line.parameters.push(parameter(value()?)?),
            "--switch" => line.switches.push(split_switch(value()?).ok()?),
            "--option" => {
                let (name, state) = value()?.split_once('=')?;
                line.options.push((name.to_owned(), state == "on"));
            }
            "--policy" => {
                let (name, value) = value()?.split_once('=')?;
                line.policies.push((name.to_owned(), value.to_owned()));
            }
            _ => {}
        }
    }
    let control = Arc::new(load_control(&builtin_files(&name)?).ok()?);
    for offset in &offsets {
        let (cell, value) = offset.split_once('=')?;
        let (column, cell) = split_offset(cell).ok()?;
        let column = if control.common_offsets { OffsetColumn::Common } else { column };
        line.offsets.push((column, cell, value.parse().ok()?));
    }
    let machine = machine.unwrap_or(&control.stock_machine);
    let machine = match builtin_machine(machine) {
        Some((file, text)) => read_machine(&file, text),
        None => read_machine(machine, &std::fs::read_to_string(folder.join(machine)).ok()?),
    };
    let configuration = Configuration::new(control, machine.ok()?, &[&file, &line]).ok()?;
    let mut session = Session::new(configuration, texts(folder, case.file.as_deref()?)?);
    session.select(SourceId(0), "case", Cursor::HEAD);
    Some(session)
}

fn work(setup: &mut Setup, text: &str) -> Option<()> {
    let (system, axes) = text.split_once('=')?;
    for part in axes.split(',') {
        setup.work.push((system.to_owned(), *part.as_bytes().first()?, part.get(1..)?.parse().ok()?));
    }
    Some(())
}

fn parameter(text: &str) -> Option<ParameterSetting> {
    let (name, value) = text.split_once('=')?;
    let (name, bit) = match name.split_once('.') {
        Some((number, bit)) if number.bytes().all(|byte| byte.is_ascii_digit()) => (number, bit.parse().ok()),
        _ => (name, None),
    };
    Some(ParameterSetting { name: name.to_owned(), bit, value: value.to_owned() })
}

/// The program, and what lies beside it under its number.
fn texts(folder: &Path, file: &str) -> Option<Texts> {
    let file = if file == "-" { "in.nc" } else { file.split(':').next()? };
    let mut texts = Texts::one(std::fs::read(folder.join(file)).ok()?);
    for entry in std::fs::read_dir(folder).ok()?.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let number = name.trim_start_matches('O').split('.').next().and_then(|number| number.parse().ok());
        if let (Some(number), Ok(text)) = (number, std::fs::read(entry.path())) {
            texts.programs.push((number, SourceId(texts.texts.len() as u32)));
            texts.texts.push(text);
        }
    }
    Some(texts)
}
