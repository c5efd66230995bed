//! G10: the program writes tool offsets and work origins.
//!
//! It acts when the block is read, ahead of the blocks still being executed, and moves nothing: an offset counts from
//! the next block that calls for it, an origin from the next block read.

use base::{AXES, Alarm, AxisSet, Condition, Point, UnitSystem};
use dialect::{GCode, Meaning, UnitChangeOffsets};

use crate::block::Reading;
use crate::command::Body;
use crate::facts::Memory;
use crate::operation::SetValue;
use crate::setting::Setting;

/// A value that goes into memory.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum DataWrite {
    /// A tool offset, nanometres.
    Offset { number: u32, value: f64 },
    /// A tool radius, where radii have a column of their own, nanometres.
    Radius { number: u32, value: f64 },
    /// The origin that counts in every work system.
    External { origin: Point },
    /// The origin of a work system (index from 0), counts in machine coordinates.
    Work { system: usize, origin: Point },
}

/// What G10 writes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Length,
    Radius,
    Work,
}

impl Reading<'_> {
    /// G10: P and R write a tool offset, P and the axis words a work origin; a letter that the control names says
    /// which. In incremental mode the value is added to the stored one.
    pub fn write_data(&mut self) -> Result<(), Alarm> {
        let control = self.setting.control.as_ref();
        let kinds = &control.functions.data;
        let mut kind = Kind::Length;
        for &letter in &kinds.letters {
            let Some(value) = self.words.integer(control, letter)? else { continue };
            kind = match Some(value) {
                written if written == Some(kinds.work) => Kind::Work,
                written if written == kinds.length => Kind::Length,
                written if written == kinds.radius => Kind::Radius,
                _ => {
                    let alarm = self.words.alarm(Condition::DataKindUnknown, letter);
                    return Err(alarm.with([value as f64, 0.0, 0.0]));
                }
            };
        }
        let number = self.words.count(control, b'P')?;
        let is_work = kind == Kind::Work;
        let highest = if is_work { self.setting.memory.work.len() as u32 } else { control.highest_offset };
        let least = u32::from(!(is_work && control.functions.work.external));
        let Some(number) = number.filter(|&number| number >= least && number <= highest) else {
            let values = [f64::from(number.unwrap_or(0)), f64::from(highest), 0.0];
            return Err(self.at_word_or_code(b'P', Condition::DataNumber).with(values));
        };
        if is_work { self.write_work_origin(number) } else { self.write_offset(kind, number) }
    }

    fn at_word_or_code(&self, letter: u8, condition: Condition) -> Alarm {
        if self.words.has(letter) { self.words.alarm(condition, letter) } else { self.one_shot_alarm(condition) }
    }

    fn write_offset(&mut self, kind: Kind, number: u32) -> Result<(), Alarm> {
        let control = self.setting.control.as_ref();
        let Some(value) = self.words.length(control, b'R', self.units)? else {
            return Err(self.one_shot_alarm(Condition::DataValueMissing));
        };
        let memory = &self.setting.memory;
        let stored = if kind == Kind::Radius { memory.radius(number) } else { memory.length(number) };
        let before = self.offset(stored).unwrap_or(0.0);
        let value = if self.absolute { value } else { before + value };
        let inch = self.units == UnitSystem::Inch;
        let limit = self.setting.offset_limit(inch);
        if value.abs() > limit {
            return Err(self.words.alarm(Condition::OffsetRange, b'R').with([value / 1e6, limit / 1e6, 0.0]));
        }
        let stored = self.setting.offset_stored(value, inch);
        let (write, told) = match kind {
            Kind::Radius => {
                (DataWrite::Radius { number, value: stored }, SetValue::Radius { number, value: value / 1e6 })
            }
            _ => (DataWrite::Offset { number, value: stored }, SetValue::Offset { number, value: value / 1e6 }),
        };
        self.command.write = Some(write);
        self.command.body = Body::Set(told, None);
        Ok(())
    }

    fn write_work_origin(&mut self, number: u32) -> Result<(), Alarm> {
        // Number 0 is the origin that counts in every system.
        let system = (number as usize).checked_sub(1);
        let axes = self.axes_named();
        if axes.is_empty() {
            return Err(self.one_shot_alarm(Condition::DataValueMissing));
        }
        let memory = &self.setting.memory;
        let before = match system {
            None => memory.external,
            Some(index) => memory.work.get(index).copied().unwrap_or_default(),
        };
        let mut origin = before;
        for axis in axes.iter() {
            let (value, _) = self.axis_word(axis)?;
            origin[axis] = if self.absolute { value } else { before[axis] + value };
            self.check_origin(axis, origin[axis])?;
        }
        let (write, told) = match system {
            None => {
                let shift = self.setting.to_mm(&origin);
                (DataWrite::External { origin }, SetValue::Shift { code: None, axes, shift })
            }
            Some(system) => (DataWrite::Work { system, origin }, self.setting.work_origin(system, axes, &origin)),
        };
        self.command.write = Some(write);
        self.command.body = Body::Set(told, None);
        Ok(())
    }

    /// An origin that has grown beyond what a word of its axis can hold is refused.
    fn check_origin(&self, axis: usize, counts: f64) -> Result<(), Alarm> {
        let Some(facts) = self.setting.facts.axes.get(axis) else { return Ok(()) };
        let limit = self.setting.origin_limit(axis, self.units == UnitSystem::Inch);
        if counts.abs() <= limit {
            return Ok(());
        }
        Err(self.words.alarm(Condition::OffsetRange, facts.letter).with([counts / 1e6, limit / 1e6, 0.0]))
    }
}

impl Setting {
    /// How far the origin of a work system may lie from machine zero, counts: what a word of its axis can hold.
    pub(crate) fn origin_limit(&self, axis: usize, inch: bool) -> f64 {
        let address = self.facts.axes.get(axis).and_then(|facts| Some((facts, self.control.address(facts.letter)?)));
        match address {
            None => f64::INFINITY,
            Some((facts, address)) if facts.rotary => address.rotary[1] * 1e6,
            Some((_, address)) if inch => address.inch[1] * base::units::NM_PER_INCH as f64,
            Some((_, address)) => address.metric[1] * 1e6,
        }
    }

    /// The origin of a work system (index from 0) as it is told.
    pub(crate) fn work_origin(&self, system: usize, axes: AxisSet, origin: &Point) -> SetValue {
        let is_it = |row: &GCode| row.meaning == Meaning::WorkSystem && usize::from(row.number) == system + 1;
        let row = self.control.g_codes.iter().position(is_it).unwrap_or(0);
        SetValue::WorkOrigin { system: row as u8, axes, origin: self.to_mm(origin) }
    }

    /// A stored offset as it counts in the unit in force: policy `unit-change-offsets`.
    pub(crate) fn offset_in(&self, stored: f64, inch: bool) -> f64 {
        let [metric, per_inch, _] = self.control.increments;
        if inch && self.keeps_digits() { stored / metric as f64 * per_inch as f64 } else { stored }
    }

    /// What is stored of an offset that counts so much in the unit in force.
    pub(crate) fn offset_stored(&self, value: f64, inch: bool) -> f64 {
        let [metric, per_inch, _] = self.control.increments;
        if inch && self.keeps_digits() { value / per_inch as f64 * metric as f64 } else { value }
    }

    fn keeps_digits(&self) -> bool {
        self.fitting.policies.unit_change_offsets == UnitChangeOffsets::Keep
    }

    /// The largest offset, nanometres: as many least increments in inch input as in metric.
    pub(crate) fn offset_limit(&self, inch: bool) -> f64 {
        let [metric, per_inch, _] = self.control.increments;
        self.control.offset_limit_mm * 1e6 * if inch { per_inch as f64 / metric as f64 } else { 1.0 }
    }
}

impl Memory {
    /// Writes a value; returns by what the mark of the memory's content changes.
    pub(crate) fn write(&mut self, write: DataWrite) -> u64 {
        match write {
            DataWrite::Offset { number, value } => {
                let before = self.lengths.value(number).unwrap_or(0.0);
                self.lengths.set(number, value);
                mark(u64::from(number), before) ^ mark(u64::from(number), value)
            }
            DataWrite::Radius { number, value } => {
                let Some(radii) = &mut self.radii else { return 0 };
                let before = radii.value(number).unwrap_or(0.0);
                radii.set(number, value);
                let place = RADIUS_PLACES + u64::from(number);
                mark(place, before) ^ mark(place, value)
            }
            DataWrite::External { origin } => {
                let change = origin_mark(self.work.len(), &self.external, &origin);
                self.external = origin;
                change
            }
            DataWrite::Work { system, origin } => {
                let Some(stored) = self.work.get_mut(system) else { return 0 };
                let change = origin_mark(system, stored, &origin);
                *stored = origin;
                change
            }
        }
    }
}

/// By what the mark changes with an origin.
fn origin_mark(system: usize, before: &Point, after: &Point) -> u64 {
    (0..AXES).fold(0, |change, axis| {
        let place = WORK_PLACES + (system * AXES + axis) as u64;
        change ^ mark(place, before[axis]) ^ mark(place, after[axis])
    })
}

/// Places of radii in the mark, beyond every offset number.
const RADIUS_PLACES: u64 = 1 << 31;
/// Places of work origins in the mark, beyond every offset number.
const WORK_PLACES: u64 = 1 << 32;

/// A value and its place, mixed so that memories with different contents differ in their mark.
fn mark(place: u64, value: f64) -> u64 {
    let mut bits = (value + 0.0).to_bits() ^ place.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for factor in [0xbf58_476d_1ce4_e5b9, 0x94d0_49bb_1331_11eb] {
        bits = (bits ^ (bits >> 30)).wrapping_mul(factor);
    }
    bits ^ (bits >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::facts::OffsetTable;
    use crate::user_macro::Variables;

    #[test]
    fn the_mark_comes_back_with_the_value() {
        let files = dialect::builtin_files("yasnac-mx1").expect("it is built in");
        let control = dialect::load_control(&files).expect("it loads");
        let variables = Variables::new(&control.user_macro, 1);
        let mut memory = Memory {
            lengths: OffsetTable::new(99),
            radii: None,
            work: [[0.0; AXES]; 6],
            external: [0.0; AXES],
            variables,
        };
        let first = memory.write(DataWrite::Offset { number: 3, value: 5e6 });
        let second = memory.write(DataWrite::Offset { number: 3, value: 0.0 });
        assert!(first != 0 && first ^ second == 0);
        let mut origin = [0.0; AXES];
        origin[2] = -20e6;
        assert_ne!(memory.write(DataWrite::Work { system: 0, origin }), 0);
        assert_eq!(memory.write(DataWrite::Work { system: 0, origin }), 0);
        assert_eq!(memory.work[0][2], -20e6);
    }
}
