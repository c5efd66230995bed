//! What survives power-off: every cell with its name and its value, and how a set-up takes them up again.

use base::{AXES, Point};
use dialect::{Control, Fitting, Meaning, ParameterKind, ParameterSetting};
use machine::MachineFile;
use meaning::Memory;

use crate::configuration::{Configuration, ConfigurationError};
use crate::library::Library;
use crate::memory::{self, WorkSystem};
use crate::session::Session;
use crate::setup::{OffsetColumn, Setup};

/// The kinds of cells.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum CellKind {
    /// Offsets, mm.
    Offset,
    /// Origins of work systems, mm or degrees.
    Work,
    /// Parameters.
    Parameter,
    /// Variables that last.
    Variable,
}

/// A cell of the memory.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Cell {
    /// An offset of a column.
    Offset(OffsetColumn, u32),
    /// The origin of a stored work system along an axis.
    Work(usize, usize),
    /// The origin of the base system along an axis.
    Base(usize),
    /// The origin that counts in every system along an axis.
    External(usize),
    /// A parameter by its index.
    Parameter(usize),
    /// A variable by its number.
    Variable(u32),
}

/// A value that counts nanometres or microdegrees, in mm or degrees; parts of a count are said as such.
fn counts_text(counts: f64) -> String {
    let mm = counts / 1e6;
    if (mm * 1e6).round() == counts { mm.to_string() } else { format!("{counts} nm") }
}

fn counts_of(text: &str) -> Option<f64> {
    let counts = match text.strip_suffix(" nm") {
        Some(counts) => counts.parse::<f64>().ok()?,
        None => (text.parse::<f64>().ok()? * 1e6).round(),
    };
    counts.is_finite().then_some(counts)
}

impl Cell {
    /// Its kind, and its name among those of its kind.
    pub fn name(self, control: &Control, machine: &MachineFile) -> (CellKind, String) {
        let axis = |axis: usize| machine.axes.get(axis).map_or('?', |axis| char::from(axis.letter));
        match self {
            Cell::Offset(OffsetColumn::Common, number) => (CellKind::Offset, number.to_string()),
            Cell::Offset(OffsetColumn::Length, number) => (CellKind::Offset, format!("H{number}")),
            Cell::Offset(OffsetColumn::Radius, number) => (CellKind::Offset, format!("D{number}")),
            Cell::Work(system, of) => (CellKind::Work, format!("{} {}", stored_system(control, system), axis(of))),
            Cell::Base(of) => {
                let name = control.base_system.map_or_else(|| "base".to_owned(), |row| control.g_name(row));
                (CellKind::Work, format!("{name} {}", axis(of)))
            }
            Cell::External(of) => (CellKind::Work, format!("{} {}", memory::EXTERNAL, axis(of))),
            Cell::Parameter(index) => {
                (CellKind::Parameter, control.parameters.get(index).map_or_else(String::new, |row| row.name.clone()))
            }
            Cell::Variable(number) => (CellKind::Variable, number.to_string()),
        }
    }

    /// Its value as it is written down; `None` for a blank variable.
    pub fn text(self, control: &Control, value: f64) -> Option<String> {
        Some(match self {
            Cell::Variable(_) if value.is_nan() => return None,
            Cell::Variable(_) => value.to_string(),
            Cell::Parameter(index) => {
                let row = control.parameters.get(index)?;
                match row.kind {
                    ParameterKind::Bits => format!("{:08b}", value as u8),
                    ParameterKind::Choice => row.values.get(value as usize)?.clone(),
                    ParameterKind::Length | ParameterKind::Number => value.to_string(),
                }
            }
            _ => counts_text(value),
        })
    }
}

/// The name of a stored work system.
fn stored_system(control: &Control, index: usize) -> String {
    let mut rows = control.g_codes.iter();
    let row = rows.position(|code| code.meaning == Meaning::WorkSystem && usize::from(code.number) == index + 1);
    row.map_or_else(|| format!("work {}", index + 1), |row| control.g_name(row as u8))
}

/// Every cell that the control has, always in the same order.
fn see_cells(
    (control, fitting): (&Control, &Fitting),
    axes: usize,
    (memory, base_origin): (&Memory, &Point),
    see: &mut dyn FnMut(Cell, f64),
) {
    let lengths = if memory.radii.is_some() { OffsetColumn::Length } else { OffsetColumn::Common };
    let columns = [(Some(&memory.lengths), lengths), (memory.radii.as_ref(), OffsetColumn::Radius)];
    for (table, column) in columns {
        for number in 1..=control.highest_offset {
            if let Some(counts) = table.and_then(|table| table.value(number)) {
                see(Cell::Offset(column, number), counts);
            }
        }
    }
    let axes = axes.min(AXES);
    for (system, origin) in memory.work.iter().enumerate() {
        origin.iter().take(axes).enumerate().for_each(|(axis, &counts)| see(Cell::Work(system, axis), counts));
    }
    if control.base_system.is_some() {
        base_origin.iter().take(axes).enumerate().for_each(|(axis, &counts)| see(Cell::Base(axis), counts));
    }
    if control.functions.work.external {
        memory.external.iter().take(axes).enumerate().for_each(|(axis, &counts)| see(Cell::External(axis), counts));
    }
    (0..control.parameters.len()).for_each(|index| see(Cell::Parameter(index), fitting.parameter(index)));
    memory.variables.kept().for_each(|(number, value)| see(Cell::Variable(number), value));
}

impl<L: Library> Session<L> {
    /// Shows every cell that survives power-off, always in the same order.
    pub fn see_kept(&mut self, see: &mut dyn FnMut(Cell, f64)) {
        self.interpreter_mut().store_codes();
        let axes = self.configuration().machine.axes.len();
        let interpreter = self.interpreter();
        let of_control = (interpreter.control().as_ref(), interpreter.fitting());
        see_cells(of_control, axes, (interpreter.memory(), interpreter.lasting_base_origin()), see);
    }
}

impl Configuration {
    /// As [`Session::see_kept`], of a control that has not been powered on.
    pub fn see_kept(&self, see: &mut dyn FnMut(Cell, f64)) {
        let of_control = (self.control.as_ref(), &self.fitting);
        see_cells(of_control, self.machine.axes.len(), (&self.memory, &self.base_origin), see);
    }

    /// Takes up a kept value.
    pub(crate) fn take_kept(&mut self, kind: CellKind, name: &str, text: &str) -> Result<(), ConfigurationError> {
        let wrong =
            || ConfigurationError(format!("the memory holds {name} = {text}, which this control does not have"));
        let control = self.control.clone();
        match kind {
            CellKind::Offset => {
                let (column, number) = crate::script::split_offset(name).map_err(|_| wrong())?;
                let counts = counts_of(text).ok_or_else(wrong)?;
                let table = match (memory::named_column(&control, column), &mut self.memory.radii) {
                    (OffsetColumn::Common, None) | (OffsetColumn::Length, Some(_)) => &mut self.memory.lengths,
                    (OffsetColumn::Radius, Some(radii)) => radii,
                    _ => return Err(wrong()),
                };
                if table.set(number, counts) { Ok(()) } else { Err(wrong()) }
            }
            CellKind::Work => {
                let (system, letter) = name.rsplit_once(' ').ok_or_else(wrong)?;
                let [letter] = letter.as_bytes() else { return Err(wrong()) };
                let axis = memory::axis_of(&self.machine, *letter)?;
                let counts = counts_of(text).ok_or_else(wrong)?;
                let found = memory::work_system(&control, &self.memory, system);
                let origin = match found {
                    Ok(WorkSystem::Stored(index)) => self.memory.work.get_mut(index),
                    Ok(WorkSystem::External) => Some(&mut self.memory.external),
                    Ok(WorkSystem::Base) => Some(&mut self.base_origin),
                    Err(_) => None,
                };
                *origin.and_then(|origin| origin.get_mut(axis)).ok_or_else(wrong)? = counts;
                Ok(())
            }
            CellKind::Variable => {
                let (number, value) = (name.parse::<u32>().ok(), text.parse::<f64>().ok());
                let (Some(number), Some(value)) = (number, value.filter(|value| value.is_finite())) else {
                    return Err(wrong());
                };
                if self.memory.variables.set_kept(number, value) { Ok(()) } else { Err(wrong()) }
            }
            // They stand with the set-up's other parameters, for they may choose the axes' letters.
            CellKind::Parameter => Ok(()),
        }
    }
}

impl Setup {
    /// Takes up a kept value by its name; it is looked at when the set-up is applied.
    pub fn keep(&mut self, kind: CellKind, name: &str, text: &str) {
        match kind {
            CellKind::Parameter => {
                let (name, value) = (name.to_owned(), text.to_owned());
                self.parameters.push(ParameterSetting { name, bit: None, value });
            }
            _ => self.kept.push((kind, name.to_owned(), text.to_owned())),
        }
    }
}
