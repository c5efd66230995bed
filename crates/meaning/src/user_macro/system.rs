//! System variables: what the control knows and the machine is asked, behind the numbers from #1000 on.
//!
//! What the reader itself knows (modal state, offsets, end points) is read at once; inputs, the clock and present
//! positions are asked of the machine through a barrier and read again from its answers.

use base::{AXES, Condition, ProgramId, units::NM_PER_INCH};
use dialect::{Meaning, VariableMeaning, VariableRow};
use syntax::Extent;

use super::expression::unknown;
use super::trouble::Trouble;
use super::variables::{BLANK, Variables};
use crate::program::Names;
use crate::pull::Quantity;
use crate::setting::Setting;
use crate::state::State;

/// Where an expression reads its variables.
pub(crate) struct Source<'s> {
    pub setting: &'s Setting,
    pub state: &'s State,
    /// The level of local variables.
    pub level: usize,
    /// The running program.
    pub program: ProgramId,
    pub names: &'s Names,
    /// What the machine has answered for this statement.
    pub answers: &'s [(Quantity, f64)],
}

/// What a write to a system variable changed, beside the memory itself.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Written {
    /// An offset, by its number, now so many mm; what is stored of it, nanometres.
    Offset(u32, f64, f64),
    /// The origin of work system 1 to 6 (0: the shift of all) along an axis, now so many counts.
    Origin(u8, usize, f64),
    /// An output or clock: nothing that needs more work.
    Nothing,
    /// #3003.
    BlockControl(u8),
    /// #3004.
    FeedControl(u8),
    /// #3000: the alarm of this number.
    Alarm(f64),
}

impl Source<'_> {
    pub fn variables(&self) -> &Variables {
        &self.setting.memory.variables
    }

    /// Nanometres of one unit of length in force.
    fn unit(&self, axis: usize) -> f64 {
        let rotary = self.setting.facts.axes.get(axis).is_some_and(|facts| facts.rotary);
        unit_of(self.setting, self.state, rotary)
    }

    fn ask(&self, quantity: Quantity) -> Result<f64, Trouble> {
        let answer = self.answers.iter().find(|(asked, _)| *asked == quantity);
        answer.map(|(_, value)| *value).ok_or(Trouble::Needs(quantity))
    }

    /// Reads any variable by its number.
    pub fn read(&self, number: u32, place: Extent) -> Result<f64, Trouble> {
        let table = &self.setting.control.user_macro;
        let Some(row) = table.variable(number) else { return Err(unknown(number, place)) };
        if !row.read {
            return Err(Trouble::Refused(Condition::MacroWriteOnly, place, [f64::from(number), 0.0, 0.0]));
        }
        let index = number - row.from;
        let variables = self.variables();
        Ok(match row.meaning {
            VariableMeaning::Null | VariableMeaning::UserAlarm => BLANK,
            VariableMeaning::Local => variables.local(self.level, number.min(255) as u8),
            VariableMeaning::CommonVolatile => variables.volatile(variables.index(0, number)),
            VariableMeaning::CommonPermanent => variables.permanent(variables.index(1, number)),
            VariableMeaning::InputBit => f64::from((self.ask(Quantity::Inputs)? as u32) >> index.min(31) & 1),
            VariableMeaning::InputWord => self.ask(Quantity::Inputs)?,
            VariableMeaning::OutputBit => f64::from(variables.outputs >> index.min(31) & 1),
            VariableMeaning::OutputWord => f64::from(variables.outputs),
            VariableMeaning::Offset => self.offset(number, place)?,
            VariableMeaning::WorkOriginOfAxis | VariableMeaning::WorkOriginOfSystem => {
                let (system, axis) = self.origin_of(row, index, number, place)?;
                self.origin(system, axis) / self.unit(axis)
            }
            VariableMeaning::Clock => self.ask(Quantity::Clock)? * 1000.0 + variables.clock_shift[0],
            VariableMeaning::RunHours => self.ask(Quantity::Clock)? / 3600.0 + variables.clock_shift[1],
            VariableMeaning::BlockControl => f64::from(self.state.block_control),
            VariableMeaning::FeedControl => f64::from(self.state.feed_control),
            VariableMeaning::GroupCode => self.group_code(index + 1),
            VariableMeaning::ModalWord => self.modal_word(row.letter),
            VariableMeaning::BlockEnd
            | VariableMeaning::MachinePosition
            | VariableMeaning::WorkPosition
            | VariableMeaning::SkipPosition
            | VariableMeaning::ToolOffset
            | VariableMeaning::ServoDeviation => self.position(row.meaning, index as usize, number, place)?,
        })
    }

    fn offset(&self, number: u32, place: Extent) -> Result<f64, Trouble> {
        let index = number - self.first_offset();
        match self.setting.memory.length(index) {
            Some(stored) => {
                let unit = unit_of(self.setting, self.state, false);
                Ok(self.setting.offset_in(stored, unit != 1e6) / unit)
            }
            None => Err(unknown(number, place)),
        }
    }

    /// The number that would stand for offset 0.
    fn first_offset(&self) -> u32 {
        let range = self.setting.control.user_macro.range_of(VariableMeaning::Offset);
        range.map_or(0, |(from, _)| from.saturating_sub(1))
    }

    /// Which system's origin, along which axis.
    fn origin_of(&self, row: &VariableRow, index: u32, number: u32, place: Extent) -> Result<(u8, usize), Trouble> {
        let (system, axis) = match row.meaning {
            VariableMeaning::WorkOriginOfAxis => (index as u8, usize::from(row.which.saturating_sub(1))),
            _ => (row.which, index as usize),
        };
        if axis >= self.setting.facts.axes.len().min(AXES) {
            return Err(unknown(number, place));
        }
        Ok((system, axis))
    }

    fn origin(&self, system: u8, axis: usize) -> f64 {
        match system.checked_sub(1) {
            None if self.setting.control.functions.work.external => self.setting.memory.external[axis],
            None => self.state.common_shift[axis],
            Some(index) => self.setting.memory.work.get(usize::from(index)).map_or(0.0, |origin| origin[axis]),
        }
    }

    fn group_code(&self, number: u32) -> f64 {
        let control = &self.setting.control;
        let index = control.groups.iter().position(|group| u32::from(group.number) == number);
        let row = index.and_then(|index| control.g_codes.get(usize::from(self.state.groups.0[index])));
        row.map_or(BLANK, |code| f64::from(code.code))
    }

    fn modal_word(&self, letter: u8) -> f64 {
        let state = self.state;
        match letter {
            b'B' => f64::from(state.index),
            b'D' => f64::from(state.d),
            b'F' => state.feed.nanometres / unit_of(self.setting, state, false),
            b'H' => f64::from(state.h),
            b'M' => f64::from(state.miscellaneous),
            b'N' => f64::from(state.sequence),
            b'O' => f64::from(self.names.number(self.program)),
            b'S' => f64::from(state.spindle),
            _ => f64::from(state.tool),
        }
    }

    fn position(&self, meaning: VariableMeaning, axis: usize, number: u32, place: Extent) -> Result<f64, Trouble> {
        let state = self.state;
        if axis >= self.setting.facts.axes.len().min(AXES) {
            return Err(unknown(number, place));
        }
        let length = if Some(axis) == self.setting.length_axis { state.length } else { 0.0 };
        let unit = self.unit(axis);
        Ok(match meaning {
            VariableMeaning::BlockEnd => {
                let mut machine = self.setting.upright(state, &state.machine);
                for axis in 0..AXES {
                    machine[axis] -= state.displacement[axis];
                }
                // What a changed length offset has not moved yet counts as moved.
                if let Some(axis) = self.setting.length_axis {
                    machine[axis] += state.length_due;
                }
                self.setting.last_programmed(state, &machine)[axis] / unit
            }
            VariableMeaning::MachinePosition => self.ask(Quantity::Position(axis as u8))? * 1e6 / unit,
            VariableMeaning::WorkPosition => {
                let machine = self.ask(Quantity::Position(axis as u8))? * 1e6;
                (machine - (self.setting.zero(state, axis) - length)) / unit
            }
            VariableMeaning::SkipPosition => state.skip[axis] / unit,
            VariableMeaning::ToolOffset => (length + state.displacement[axis]) / unit,
            _ => self.ask(Quantity::Deviation(axis as u8))? * 1e6 / unit,
        })
    }

    /// What a write to a system variable would change; refuses what cannot be written.
    pub fn written(&self, number: u32, value: f64, place: Extent) -> Result<Written, Trouble> {
        let table = &self.setting.control.user_macro;
        let Some(row) = table.variable(number) else { return Err(unknown(number, place)) };
        if !row.write {
            return Err(Trouble::Refused(Condition::MacroReadOnly, place, [f64::from(number), 0.0, 0.0]));
        }
        let index = number - row.from;
        let filled = if value.is_nan() { 0.0 } else { value };
        Ok(match row.meaning {
            VariableMeaning::Offset => {
                let unit = unit_of(self.setting, self.state, false);
                let mm = filled * unit / 1e6;
                let limit = self.setting.offset_limit(unit != 1e6) / 1e6;
                if mm.abs() > limit {
                    return Err(Trouble::Refused(Condition::OffsetRange, place, [mm, limit, 0.0]));
                }
                let counts = (mm * 1e6).round();
                let stored = self.setting.offset_stored(counts, unit != 1e6);
                Written::Offset(number - self.first_offset(), counts / 1e6, stored)
            }
            VariableMeaning::WorkOriginOfAxis | VariableMeaning::WorkOriginOfSystem => {
                let (system, axis) = self.origin_of(row, index, number, place)?;
                let counts = (filled * self.unit(axis)).round();
                let limit = self.setting.origin_limit(axis, unit_of(self.setting, self.state, false) != 1e6);
                if counts.abs() > limit {
                    return Err(Trouble::Refused(Condition::OffsetRange, place, [counts / 1e6, limit / 1e6, 0.0]));
                }
                Written::Origin(system, axis, counts)
            }
            VariableMeaning::BlockControl => Written::BlockControl(filled.clamp(0.0, 255.0) as u8),
            VariableMeaning::FeedControl => Written::FeedControl(filled.clamp(0.0, 255.0) as u8),
            VariableMeaning::UserAlarm => Written::Alarm(filled),
            _ => Written::Nothing,
        })
    }

    /// The outputs after a write to one of their variables.
    pub fn outputs_after(&self, row: &VariableRow, number: u32, value: f64) -> u32 {
        let outputs = self.variables().outputs;
        if row.meaning == VariableMeaning::OutputWord {
            return value.round().clamp(0.0, f64::from(u32::MAX)) as u32;
        }
        let bit = 1u32 << (number - row.from).min(31);
        if value.round() as i64 & 1 != 0 { outputs | bit } else { outputs & !bit }
    }

    /// How far the clock (0) or hour counter (1) is from what it is to show from now on.
    pub fn clock_shift(&self, which: usize, value: f64) -> Result<f64, Trouble> {
        let seconds = self.ask(Quantity::Clock)?;
        Ok(value - if which == 0 { seconds * 1000.0 } else { seconds / 3600.0 })
    }
}

/// Nanometres (microdegrees of a rotary axis) in one unit of a variable.
pub(crate) fn unit_of(setting: &Setting, state: &State, rotary: bool) -> f64 {
    match setting.control.in_force(&state.groups, setting.control.roles.units) {
        Some(Meaning::Inch) if !rotary => NM_PER_INCH as f64,
        _ => 1e6,
    }
}
