//! What the operator writes into the control's memory: offsets and work origins, their ranges checked.

use dialect::{Control, Meaning};
use machine::MachineFile;
use meaning::Memory;

use crate::configuration::ConfigurationError;
use crate::setup::OffsetColumn;

fn wrong(message: String) -> ConfigurationError {
    ConfigurationError(message)
}

/// The column of an offset that was named by its number or its letter and number: with one common memory H and D name
/// the same cell.
pub(crate) fn named_column(control: &Control, column: OffsetColumn) -> OffsetColumn {
    if control.common_offsets { OffsetColumn::Common } else { column }
}

/// Writes an offset, mm.
pub(crate) fn write_offset(
    control: &Control,
    memory: &mut Memory,
    column: OffsetColumn,
    number: u32,
    mm: f64,
) -> Result<(), ConfigurationError> {
    let (title, limit) = (&control.title, control.offset_limit_mm);
    if mm.abs() > limit {
        return Err(wrong(format!("offset {number} = {mm}: an offset lies within ±{limit} mm")));
    }
    let table = match (column, &mut memory.radii) {
        (OffsetColumn::Common, None) | (OffsetColumn::Length, Some(_)) => &mut memory.lengths,
        (OffsetColumn::Radius, Some(radii)) => radii,
        (OffsetColumn::Common, Some(_)) => {
            return Err(wrong(format!("the {title} keeps lengths and radii apart: write H{number}= or D{number}=")));
        }
        (_, None) => return Err(wrong(format!("the {title} has one common memory: write it under [offsets]"))),
    };
    if table.set(number, (mm * 1e6).round()) {
        Ok(())
    } else {
        let highest = control.highest_offset;
        Err(wrong(format!("there is no offset {number}; the {title} has 1 to {highest}")))
    }
}

/// An offset in mm that was named by its number or its letter and number; `None` if there is none.
pub(crate) fn read_named_offset(control: &Control, memory: &Memory, column: OffsetColumn, number: u32) -> Option<f64> {
    let counts = match named_column(control, column) {
        OffsetColumn::Common if !control.common_offsets => None,
        OffsetColumn::Radius => memory.radius(number),
        _ => memory.length(number),
    };
    counts.map(|counts| counts / 1e6)
}

/// The name of the origin that counts in every system.
pub(crate) const EXTERNAL: &str = "external";

/// A work system, by where its origin is kept.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum WorkSystem {
    /// One of the stored ones.
    Stored(usize),
    /// The base system, which a program sets.
    Base,
    /// The origin that counts in every system.
    External,
}

/// The work system of this name.
pub(crate) fn work_system(control: &Control, memory: &Memory, name: &str) -> Result<WorkSystem, ConfigurationError> {
    let row = control.g_codes.iter().enumerate().find(|(row, _)| control.g_name(*row as u8) == name);
    match row {
        Some((_, code)) if code.meaning == Meaning::WorkSystem => {
            let index = usize::from(code.number.saturating_sub(1));
            match memory.work.get(index) {
                Some(_) => Ok(WorkSystem::Stored(index)),
                None => Err(wrong(format!("{name} is no work system"))),
            }
        }
        None if name == EXTERNAL && control.functions.work.external => Ok(WorkSystem::External),
        Some((row, _)) if Some(row as u8) == control.base_system => Ok(WorkSystem::Base),
        _ => Err(wrong(format!("{name} is no work system of the {}", control.title))),
    }
}

/// The index of the axis with this letter.
pub(crate) fn axis_of(machine: &MachineFile, letter: u8) -> Result<usize, ConfigurationError> {
    let found = machine.axes.iter().position(|axis| axis.letter == letter);
    found.ok_or_else(|| wrong(format!("the machine {} has no axis {}", machine.name, char::from(letter))))
}
