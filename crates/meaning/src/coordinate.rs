//! Program coordinates to machine coordinates: work systems, G92, length offset.
//!
//! `machine = word + origin of the system in force + external origin + common shift (+ length offset on its axis)`.

use base::{AXES, Alarm, AxisSet, Condition, UnitSystem};
use dialect::Meaning;

use crate::block::Reading;
use crate::command::Body;
use crate::operation::SetValue;
use crate::setting::Setting;
use crate::state::State;

/// The axis of the spindle: the tool length offset acts on it and cycles drill along it, whatever the plane.
pub const LENGTH_AXIS: u8 = b'Z';

impl Setting {
    /// Machine coordinate of program zero on an axis in a state, offsets included (counts).
    pub fn zero(&self, state: &State, axis: usize) -> f64 {
        let row = state.groups.0[self.control.roles.work];
        let origin = match self.control.g_codes.get(usize::from(row)) {
            Some(code) if code.meaning == Meaning::WorkSystem => {
                let index = usize::from(code.number.saturating_sub(1));
                self.memory.work.get(index).map_or(0.0, |origin| origin[axis])
            }
            _ => state.base_origin[axis],
        };
        let length = if Some(axis) == self.length_axis { state.length } else { 0.0 };
        origin + self.memory.external[axis] + state.common_shift[axis] + length
    }
}

impl Reading<'_> {
    /// Machine coordinate of program zero on an axis, offsets included.
    pub fn zero(&self, axis: usize) -> f64 {
        self.setting.zero(self.next, axis)
    }

    /// The length offset in force on an axis.
    fn length_on(&self, axis: usize) -> f64 {
        self.setting.length_on(self.next, axis)
    }

    /// Applies G43, G44, G49 and H: the new length offset takes the place of the old one.
    ///
    /// Returns by how much the length axis must move if its own word does not stand in the block; what a block without
    /// motion leaves over is due in the next one.
    pub fn change_length_offset(&mut self) -> Result<f64, Alarm> {
        let control = self.setting.control.as_ref();
        let written = self.groups_written & (1 << control.roles.length) != 0;
        let due = self.next.length_due;
        if !written && !self.words.has(b'H') {
            return Ok(due);
        }
        let factor = control.in_force(&self.next.groups, control.roles.length).and_then(Meaning::length_offset);
        let value = match factor {
            Some(factor) if factor != 0.0 => {
                let number = self.next.h;
                let Some(value) = self.offset(self.setting.memory.length(number)) else {
                    let highest = f64::from(control.highest_offset);
                    return Err(self.words.alarm(Condition::OffsetNumber, b'H').with([
                        f64::from(number),
                        highest,
                        0.0,
                    ]));
                };
                factor * value
            }
            _ => 0.0,
        };
        let change = value - self.next.length + due;
        self.next.length = value;
        self.next.length_due = change;
        Ok(change)
    }

    /// The length axis has its place now: nothing of a changed offset is due any more.
    pub fn length_axis_placed(&mut self, axis: usize) {
        if Some(axis) == self.setting.length_axis {
            self.next.length_due = 0.0;
        }
    }

    /// A stored offset as it counts in the unit in force: policy `unit-change-offsets`.
    pub fn offset(&self, stored: Option<f64>) -> Option<f64> {
        stored.map(|value| self.setting.offset_in(value, self.units == UnitSystem::Inch))
    }

    /// G92: the present position gets the given coordinates; nothing moves.
    ///
    /// Sets the base system and selects it (policy `g92-system = base`), or shifts all systems alike (`all`). A
    /// parameter can have the UNIVERSAL display preset too.
    pub fn set_coordinates(&mut self) -> Result<(), Alarm> {
        if self.control().functions.work.shifts_all {
            return self.shift_systems();
        }
        let control = self.control();
        let all_systems = self.setting.fitting.policies.g92_system == dialect::G92System::All;
        let axes = self.axes_named();
        if axes.is_empty() {
            return Ok(());
        }
        let mut shown = [0.0; AXES];
        let mut origin = [0.0; AXES];
        for axis in axes.iter() {
            self.length_axis_placed(axis);
            let (value, _) = self.axis_word(axis)?;
            shown[axis] = value;
            let machine = self.next.machine[axis];
            if all_systems {
                self.next.common_shift[axis] += machine - value - self.zero(axis);
                origin[axis] = machine - value - self.length_on(axis);
            } else {
                origin[axis] = machine - self.length_on(axis) - value;
                self.next.base_origin[axis] = origin[axis] - self.next.common_shift[axis];
            }
            self.mirror_here(axis);
        }
        if let (false, Some(base)) = (all_systems, control.base_system) {
            self.next.groups.0[control.roles.work] = base;
        }
        let universal = self.setting.presets_universal().then(|| {
            for axis in axes.iter() {
                self.next.universal_zero[axis] = self.next.machine[axis] - shown[axis];
            }
            SetValue::Universal { axes, shown: self.setting.to_mm(&shown) }
        });
        let system = self.next.groups.0[control.roles.work];
        let written = SetValue::WorkOrigin { system, axes, origin: self.setting.to_mm(&origin) };
        self.command.body = Body::Set(written, universal);
        self.next.displacement = clear(self.next.displacement, axes);
        Ok(())
    }
}

impl Reading<'_> {
    /// G92 where it shifts every system: the present place gets the given coordinates, the local origin of the named
    /// axes is gone. Without words the shift is taken back on all axes.
    fn shift_systems(&mut self) -> Result<(), Alarm> {
        let mut axes = self.axes_named();
        for axis in axes.iter() {
            self.length_axis_placed(axis);
            let (value, _) = self.axis_word(axis)?;
            self.next.common_shift[axis] += self.next.machine[axis] - value - self.zero(axis);
            self.next.local[axis] = 0.0;
        }
        if axes.is_empty() {
            axes = self.setting.facts.all();
            self.next.common_shift = self.next.local;
        }
        let (total, local) = (self.next.common_shift, self.next.local);
        let shift = self.setting.to_mm(&std::array::from_fn(|axis| total[axis] - local[axis]));
        let code = self.control().row_of(Meaning::SetCoordinates);
        self.command.body = Body::Set(SetValue::Shift { code, axes, shift }, None);
        self.next.displacement = clear(self.next.displacement, axes);
        Ok(())
    }
}

/// A point with these axes at zero.
pub(crate) fn clear(mut point: base::Point, axes: AxisSet) -> base::Point {
    for axis in axes.iter() {
        point[axis] = 0.0;
    }
    point
}
