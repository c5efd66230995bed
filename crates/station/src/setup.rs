//! The set-up file: offsets, work coordinates, parameters, switches, inputs, options, policies, start position.

use data::{DataError, Document, Entry, Table};
use dialect::ParameterSetting;

use crate::configuration::ConfigurationError;
use crate::switches::{MIRROR_IMAGE, Which, split_switch};

/// A column of the offset memory.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum OffsetColumn {
    /// The one memory that H and D share.
    Common,
    /// Lengths, by H.
    Length,
    /// Radii, by D.
    Radius,
}

impl OffsetColumn {
    /// The table of a set-up file that it is.
    pub(crate) const fn table(self) -> &'static str {
        match self {
            OffsetColumn::Common => "offsets",
            OffsetColumn::Length => "lengths",
            OffsetColumn::Radius => "radii",
        }
    }
}

/// What a set-up says; values as written, checked when they are applied to a control and a machine.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Setup {
    /// Column, number, value in mm.
    pub offsets: Vec<(OffsetColumn, u32, f64)>,
    /// System (`G54`), axis letter, machine coordinate of its origin in mm or degrees.
    pub work: Vec<(String, u8, f64)>,
    /// Parameters.
    pub parameters: Vec<ParameterSetting>,
    /// Switches that are on.
    pub switches: Vec<(String, Which)>,
    /// Inputs held by hand.
    pub inputs: Vec<(String, bool)>,
    /// Options.
    pub options: Vec<(String, bool)>,
    /// Policies.
    pub policies: Vec<(String, String)>,
    /// Axis letter, machine coordinate at power-on.
    pub start: Vec<(u8, f64)>,
    /// Axis letter, machine coordinate at which the skip signal comes.
    pub contact: Vec<(u8, f64)>,
    /// Axis letter, whether it has been returned to its reference point since power-on.
    pub returned: Vec<(u8, bool)>,
    /// What a memory kept: kind, name, value.
    pub kept: Vec<(crate::kept::CellKind, String, String)>,
    /// The file it was read from, and its text; `None` for what the command line says.
    pub source: Option<(String, String)>,
}

impl Setup {
    /// Refuses what a key says, with its line where it stands in a file.
    pub(crate) fn refuse(&self, path: &[&str], message: String) -> ConfigurationError {
        let place = self.source.as_ref().and_then(|(file, text)| Some((file, text, data::place_of(text, path)?)));
        ConfigurationError(match place {
            Some((file, text, range)) => DataError::at(file, text, range, message).statement(),
            None => message,
        })
    }
}

/// Reads a set-up file.
///
/// # Errors
/// Every error of the file, each naming its line and key.
pub fn read_setup(file: &str, text: &str) -> Result<Setup, Vec<DataError>> {
    Document::read(file, text, |root| {
        let mut setup = Setup { source: Some((file.to_owned(), text.to_owned())), ..Setup::default() };
        for column in [OffsetColumn::Common, OffsetColumn::Length, OffsetColumn::Radius] {
            let found = root.table(column.table(), |t| {
                t.rest().iter().filter_map(|entry| offset(entry, column)).collect::<Vec<_>>()
            });
            setup.offsets.extend(found.unwrap_or_default());
        }
        let work = root.table("work", |t| t.rest().into_iter().flat_map(work_system).collect());
        setup.work = work.unwrap_or_default();
        setup.parameters =
            root.table("parameters", |t| t.rest().iter().filter_map(parameter).collect()).unwrap_or_default();
        setup.switches =
            root.table("switches", |t| t.rest().into_iter().flat_map(switches).collect()).unwrap_or_default();
        setup.inputs = root.table("inputs", truths).unwrap_or_default();
        setup.options = root.table("options", truths).unwrap_or_default();
        setup.policies = root
            .table("policies", |t| t.rest().iter().filter_map(|e| Some((e.key.clone(), e.written()?))).collect())
            .unwrap_or_default();
        setup.start = root
            .table("start", |t| t.rest().iter().filter_map(|e| Some((letter(e)?, e.number()?))).collect())
            .unwrap_or_default();
        setup.contact = root.table("contact", |t| t.rest().into_iter().flat_map(contact).collect()).unwrap_or_default();
        setup.returned = root
            .table("returned", |t| t.rest().iter().filter_map(|e| Some((letter(e)?, e.boolean()?))).collect())
            .unwrap_or_default();
        setup
    })
}

fn offset(entry: &Entry, column: OffsetColumn) -> Option<(OffsetColumn, u32, f64)> {
    match entry.key.parse() {
        Ok(number) => Some((column, number, entry.number()?)),
        Err(_) => {
            entry.error(format!("`{}` is no offset number", entry.key));
            None
        }
    }
}

fn letter(entry: &Entry) -> Option<u8> {
    match entry.key.as_bytes() {
        [letter @ b'A'..=b'Z'] => Some(*letter),
        _ => {
            entry.error(format!("`{}` is no axis letter", entry.key));
            None
        }
    }
}

fn work_system(entry: Entry) -> Vec<(String, u8, f64)> {
    let system = entry.key.clone();
    let axes = entry.table(|t| t.rest().iter().filter_map(|e| Some((letter(e)?, e.number()?))).collect::<Vec<_>>());
    axes.unwrap_or_default().into_iter().map(|(axis, value)| (system.clone(), axis, value)).collect()
}

/// One coordinate of an axis, or a list of them.
fn contact(entry: Entry) -> Vec<(u8, f64)> {
    let Some(axis) = letter(&entry) else { return Vec::new() };
    if !entry.is_list() {
        return entry.number().map(|at| (axis, at)).into_iter().collect();
    }
    let faces = entry.list().unwrap_or_default();
    faces.iter().filter_map(|item| Some((axis, item.number()?))).collect()
}

fn parameter(entry: &Entry) -> Option<ParameterSetting> {
    Some(ParameterSetting { name: entry.key.clone(), bit: None, value: entry.written()? })
}

fn switches(entry: Entry) -> Vec<(String, Which)> {
    let name = entry.key.replace('_', "-");
    if name == "block-delete" || name == MIRROR_IMAGE {
        if let (Some(on), true) = (entry.boolean_or_none(), name == "block-delete") {
            return if on { vec![(name, Which::One)] } else { Vec::new() };
        }
        let items = entry.list().unwrap_or_default();
        let which = |item: &Entry| {
            let text = if name == MIRROR_IMAGE { item.string()? } else { item.integer()?.to_string() };
            split_switch(&format!("{name}={text}")).map_err(|why| item.error(why)).ok()
        };
        return items.iter().filter_map(which).collect();
    }
    match entry.boolean() {
        Some(true) => vec![(name, Which::One)],
        _ => Vec::new(),
    }
}

fn truths(table: &mut Table) -> Vec<(String, bool)> {
    table.rest().iter().filter_map(|entry| Some((entry.key.clone(), entry.boolean()?))).collect()
}
