//! From the command line to a configuration: the control's tables, the machine's file, the set-up.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use dialect::{Control, ControlFiles, ParameterSetting, builtin_controls, builtin_files, load_control};
use machine::{MachineFile, builtin_machine, builtin_machines, read_machine};
use station::{Configuration, OffsetColumn, Setup, read_setup};

use crate::arguments::SettingArguments;
use crate::failure::Failure;
use crate::texts::{Texts, folder_of};

/// The names of the controls at hand.
pub fn control_names(folder: Option<&Path>) -> Result<Vec<String>, Failure> {
    let Some(folder) = folder else {
        let mut names = builtin_controls();
        names.sort();
        return Ok(names);
    };
    let entries = fs::read_dir(folder).map_err(|e| Failure::call(format!("cannot read {}: {e}", folder.display())))?;
    let mut names = Vec::new();
    for name in entries.flatten().filter_map(|entry| entry.file_name().into_string().ok()) {
        if folder.join(&name).join("control.toml").is_file() {
            names.extend(files_of(folder, &name)?.names(&name));
        }
    }
    names.sort();
    if names.is_empty() {
        let folder = folder.display();
        return Err(Failure::call(format!("{folder}: no folder in it holds a control (control.toml)")));
    }
    Ok(names)
}

/// The files of the control of this name in a folder of controls, be it a folder of its own or a member of a family.
fn own_files(folder: &Path, name: &str) -> Result<ControlFiles, Failure> {
    if folder.join(name).join("control.toml").is_file() {
        return files_of(folder, name);
    }
    let entries = fs::read_dir(folder).map_err(|e| Failure::call(format!("cannot read {}: {e}", folder.display())))?;
    for family in entries.flatten().filter_map(|entry| entry.file_name().into_string().ok()) {
        if folder.join(&family).join("control.toml").is_file()
            && let Some(files) = files_of(folder, &family)?.of(&family, name)
        {
            return Ok(files);
        }
    }
    Err(Failure::call(format!("there is no control `{name}`")))
}

/// Loads a control by its name.
pub fn load(name: &str, folder: Option<&Path>) -> Result<Control, Failure> {
    let names = control_names(folder)?;
    if !names.iter().any(|known| known == name) {
        return Err(Failure::call(format!("there is no control `{name}`; the controls are: {}", names.join(", "))));
    }
    let files = match folder {
        None => builtin_files(name).ok_or_else(|| Failure::call(format!("there is no control `{name}`")))?,
        Some(folder) => own_files(folder, name)?,
    };
    load_control(&files).map_err(|errors| Failure::data(&errors))
}

fn files_of(folder: &Path, name: &str) -> Result<ControlFiles, Failure> {
    let own = folder.join(name);
    let cannot = |path: &Path, error: std::io::Error| Failure::call(format!("cannot read {}: {error}", path.display()));
    let mut tables = Vec::new();
    for entry in fs::read_dir(&own).map_err(|e| cannot(&own, e))?.flatten() {
        let path = entry.path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            let text = fs::read_to_string(&path).map_err(|e| cannot(&path, e))?;
            tables.push((entry.file_name().to_string_lossy().into_owned(), text));
        }
    }
    // A folder with a control's own tables alone takes the sentences that come with the program.
    let builtin = builtin_controls().first().and_then(|name| builtin_files(name));
    let shared = |name: &str| fs::read_to_string(folder.join(name)).ok();
    let conditions = shared("conditions.toml").or_else(|| builtin.as_ref().map(|files| files.conditions.clone()));
    let warnings = shared("warnings.toml").or_else(|| builtin.as_ref().map(|files| files.warnings.clone()));
    Ok(ControlFiles {
        folder: own.to_string_lossy().into_owned(),
        tables,
        member: None,
        conditions: conditions.unwrap_or_default(),
        warnings: warnings.unwrap_or_default(),
    })
}

fn machine(name: &str) -> Result<MachineFile, Failure> {
    let is_file = name.ends_with(".toml") || name.contains(['/', '\\']);
    if let (false, Some((file, text))) = (is_file, builtin_machine(name)) {
        return read_machine(&file, text).map_err(|errors| Failure::data(&errors));
    }
    if !is_file {
        let mut names: Vec<_> = builtin_machines().collect();
        names.sort_unstable();
        let names = names.join(", ");
        return Err(Failure::call(format!("there is no machine `{name}`; built in are {names}, or name a FILE.toml")));
    }
    let text = fs::read_to_string(name).map_err(|e| Failure::call(format!("cannot read {name}: {e}")))?;
    read_machine(name, &text).map_err(|errors| Failure::data(&errors))
}

/// The configuration that the command line asks for.
pub fn configuration(arguments: &SettingArguments) -> Result<Configuration, Failure> {
    let control = Arc::new(load(&arguments.control, arguments.controls.as_deref())?);
    configuration_over(control, arguments, &[])
}

/// What a control's memory kept, and nothing else.
pub fn kept_configuration(
    control: Arc<Control>,
    arguments: &SettingArguments,
    kept: &Setup,
) -> Result<Configuration, Failure> {
    let machine = machine(arguments.machine.as_deref().unwrap_or(&control.stock_machine))?;
    Configuration::new(control, machine, &[kept]).map_err(Failure::call)
}

/// The configuration that the command line asks for, on top of what a memory kept.
pub fn configuration_over(
    control: Arc<Control>,
    arguments: &SettingArguments,
    kept: &[&Setup],
) -> Result<Configuration, Failure> {
    let machine = machine(arguments.machine.as_deref().unwrap_or(&control.stock_machine))?;
    let file = match &arguments.setup {
        None => Setup::default(),
        Some(path) => {
            let name = path.to_string_lossy();
            let text = fs::read_to_string(path).map_err(|e| Failure::call(format!("cannot read {name}: {e}")))?;
            read_setup(&name, &text).map_err(|errors| Failure::data(&errors))?
        }
    };
    let line = setup_of(arguments, control.common_offsets)?;
    let mut setups = kept.to_vec();
    setups.extend([&file, &line]);
    Configuration::new(control, machine, &setups).map_err(Failure::call)
}

fn split<'t>(option: &str, text: &'t str) -> Result<(&'t str, &'t str), Failure> {
    text.split_once('=')
        .map(|(name, value)| (name.trim(), value.trim()))
        .ok_or_else(|| Failure::call(format!("--{option} {text}: write NAME=VALUE")))
}

fn number(option: &str, text: &str) -> Result<f64, Failure> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(Failure::call(format!("--{option}: `{text}` is no number"))),
    }
}

fn setup_of(arguments: &SettingArguments, common_offsets: bool) -> Result<Setup, Failure> {
    let mut setup = Setup::default();
    for text in &arguments.offset {
        setup.offsets.push(offset(text, common_offsets)?);
    }
    for text in &arguments.work {
        let (system, axes) = split("work", text)?;
        let mut said = Vec::new();
        for part in axes.split(',') {
            let part = part.trim();
            match part.as_bytes().first() {
                Some(letter @ b'A'..=b'Z') => {
                    if said.contains(letter) {
                        return Err(Failure::call(format!("--work {text}: {} is said twice", char::from(*letter))));
                    }
                    said.push(*letter);
                    setup.work.push((system.to_owned(), *letter, number("work", &part[1..])?))
                }
                _ => return Err(Failure::call(format!("--work {text}: write G54=X100,Y50,Z-20"))),
            }
        }
    }
    for text in &arguments.parameter {
        setup.parameters.push(parameter(text)?);
    }
    for text in &arguments.switch {
        setup.switches.push(station::split_switch(text).map_err(Failure::call)?);
    }
    for text in &arguments.option {
        let (name, state) = split("option", text)?;
        match state {
            "on" | "off" => setup.options.push((name.to_owned(), state == "on")),
            _ => return Err(Failure::call(format!("--option {text}: write {name}=on or {name}=off"))),
        }
    }
    for text in &arguments.policy {
        let (name, value) = split("policy", text)?;
        setup.policies.push((name.to_owned(), value.to_owned()));
    }
    Ok(setup)
}

/// `6005=0b100`, or `6005.2=1` for one bit.
pub fn parameter(text: &str) -> Result<ParameterSetting, Failure> {
    let (name, value) = split("parameter", text)?;
    let (name, bit) = match name.split_once('.') {
        Some((number, bit)) if number.bytes().all(|b| b.is_ascii_digit()) => {
            let bit = bit.parse().map_err(|_| Failure::call(format!("--parameter {text}: `{bit}` is no bit")))?;
            (number, Some(bit))
        }
        _ => (name, None),
    };
    Ok(ParameterSetting { name: name.to_owned(), bit, value: value.to_owned() })
}

/// `31=10.0`; with one common memory `H31` and `D31` name the same cell.
fn offset(text: &str, common: bool) -> Result<(OffsetColumn, u32, f64), Failure> {
    let (name, value) = split("offset", text)?;
    let (column, cell) = station::split_offset(name).map_err(|why| Failure::call(format!("--offset {text}: {why}")))?;
    let column = if common { OffsetColumn::Common } else { column };
    Ok((column, cell, number("offset", value)?))
}

/// The texts that a program's calls are looked up in: the folder of the file, then the library.
pub fn texts(file: &str, arguments: &SettingArguments) -> Result<Texts, Failure> {
    let mut folders = Vec::new();
    if file != "-" {
        folders.push(folder_of(file));
    }
    if let Some(library) = &arguments.library {
        if !library.is_dir() {
            return Err(Failure::call(format!("--library {}: there is no such folder", library.display())));
        }
        folders.push(library.clone());
    }
    Ok(Texts::new(folders))
}
