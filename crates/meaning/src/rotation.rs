//! G68 and G69: everything turned in the plane about a point.
//!
//! The centre is the two axis words of the plane, under G91 counted from the present position, which is also that of a
//! word left out. Where a parameter says so, angles under G91 add up until G69.

use base::{Alarm, AxisSet, Condition, Point};
use dialect::{Meaning, ProgrammedPosition};

use crate::block::Reading;
use crate::transform::{Rotation, TRANSFORMED};

/// A program coordinate this near to a whole count is that count: what rotation derives is found again so.
const EXACTNESS: f64 = 1e-3;

/// A count that rounding has moved by a hair.
pub(crate) fn settled(counts: f64) -> f64 {
    let whole = counts.round();
    if (counts - whole).abs() < EXACTNESS { whole } else { counts }
}

impl Reading<'_> {
    /// The coordinates programmed last.
    pub fn last_programmed(&self) -> Point {
        self.setting.last_programmed(self.next, &self.undisplaced()).map(settled)
    }

    /// What the place where the axes stand is called under the scale and rotation in force.
    pub fn present(&self) -> Point {
        self.setting.programmed(self.next, &self.undisplaced()).map(settled)
    }

    /// Where the axes stand but for G45 to G48, machine coordinates.
    fn undisplaced(&self) -> Point {
        let mut machine = self.next.machine;
        for axis in 0..self.setting.facts.axes.len().min(base::AXES) {
            machine[axis] = self.here(axis) - self.next.displacement[axis];
        }
        machine
    }

    /// Scale and rotation have changed: whether the axes keep the coordinates programmed last is the policy's.
    pub fn keep_programmed(&mut self, last: &Point) {
        self.next.transform.apart = AxisSet::NONE;
        if self.setting.fitting.policies.programmed_position != ProgrammedPosition::Kept {
            return;
        }
        let now = self.last_programmed();
        for axis in 0..self.setting.facts.axes.len().min(TRANSFORMED) {
            let gap = last[axis] - now[axis];
            if gap.abs() >= EXACTNESS {
                self.next.transform.apart.add(axis);
                self.next.transform.gap[axis] = gap;
            }
        }
    }

    /// The two axes of the plane in force.
    pub fn plane_axes(&self) -> Option<[usize; 2]> {
        match self.plane().letters().map(|letter| self.setting.facts.axis(letter)) {
            [Some(u), Some(v)] => Some([u, v]),
            _ => None,
        }
    }

    /// The block's G68 or G69, if it has one.
    pub fn rotation_code(&self) -> Option<Meaning> {
        let group = self.control().roles.rotation?;
        if self.groups_written & (1 << group) == 0 {
            return None;
        }
        self.control().in_force(&self.next.groups, group)
    }

    /// Turns rotation on or off; true if the block's words were the centre and nothing moves.
    pub fn rotation(&mut self, code: Meaning) -> Result<bool, Alarm> {
        let control = self.setting.control.as_ref();
        // The rotation before has no part in where the new centre is.
        let before = std::mem::take(&mut self.next.transform.rotation);
        let (Meaning::RotationOn, Some(rule)) = (code, control.rotation) else { return Ok(false) };
        let here = self.present();
        let Some([u, v]) = self.plane_axes() else {
            return Err(self.group_alarm(Condition::AddressUnavailable, control.roles.rotation));
        };
        let plane = AxisSet::only(u).or(AxisSet::only(v));
        if let Some(axis) = self.axes_named().without(plane).iter().next() {
            return Err(self.axis_alarm(Condition::AxisWordsClaimedTwice, axis));
        }
        let center = [self.centre_of(u, true, &here)?, self.centre_of(v, true, &here)?];
        let angle = self.words.angle(control, rule.angle)?.unwrap_or(0.0) / 1e6;
        if angle.abs() > rule.most_deg {
            let values = [angle, -rule.most_deg, rule.most_deg];
            return Err(self.words.alarm(Condition::ValueOutOfRange, rule.angle).with(values));
        }
        let adds_up = !self.absolute && self.setting.fitting.parameter_if_any(rule.adds_up) == 1.0;
        let before = if adds_up { before.degrees } else { 0.0 };
        self.next.transform.rotation = Rotation { on: true, axes: [u as u8, v as u8], center, degrees: before + angle };
        Ok(true)
    }

    /// The centre of scale or rotation along an axis, program coordinates; the present position if it has no word.
    pub fn centre_of(&self, axis: usize, by_distance: bool, here: &Point) -> Result<f64, Alarm> {
        let named = self.setting.facts.axes.get(axis).is_some_and(|facts| self.words.has(facts.letter));
        if !named {
            return Ok(here[axis]);
        }
        let (value, _) = self.axis_word(axis)?;
        Ok(if by_distance && !self.absolute { here[axis] + value } else { value })
    }

    /// Modal codes of scale, rotation and polar coordinates; true if the block's words were a centre and nothing moves.
    #[cold]
    pub fn take_transforms(&mut self) -> Result<bool, Alarm> {
        let roles = self.control().roles;
        let (scaling, rotation) = (self.scaling_code(), self.rotation_code());
        let plane_written = self.groups_written & (1 << roles.plane) != 0;
        if plane_written && self.next.transform.rotation.on && rotation != Some(Meaning::RotationOff) {
            let turned = self.next.transform.rotation.axes.map(usize::from);
            if self.plane_axes().is_some_and(|axes| axes != turned) {
                let code = self.in_force_as(roles.rotation);
                return Err(self.group_alarm(Condition::StateForbids, Some(roles.plane)).with([code, 0.0, 0.0]));
            }
        }
        let mut taken = false;
        if scaling.is_some() || rotation.is_some() {
            let last = self.last_programmed();
            if let Some(code) = scaling {
                taken |= self.scaling(code)?;
            }
            if let Some(code) = rotation {
                taken |= self.rotation(code)?;
            }
            self.keep_programmed(&last);
        }
        self.take_polar(plane_written);
        Ok(taken)
    }

    /// The axes of a turned plane of which only one is named, while the place of the other is unknown: its coordinate
    /// decides where both go.
    pub fn half_turned(&self, named: AxisSet, unknown: AxisSet) -> AxisSet {
        let rotation = &self.next.transform.rotation;
        if !rotation.on {
            return AxisSet::NONE;
        }
        let plane = rotation.plane();
        let (there, missing) = (plane.and(named), plane.without(named));
        if there.is_empty() || missing.and(unknown).is_empty() { AxisSet::NONE } else { plane }
    }

    /// The number of the code in force in a group, for a message.
    pub fn in_force_as(&self, group: Option<usize>) -> f64 {
        let row = group.map_or(dialect::NO_CODE, |group| self.next.groups.0[group]);
        self.control().g_codes.get(usize::from(row)).map_or(0.0, |row| f64::from(row.code))
    }
}
