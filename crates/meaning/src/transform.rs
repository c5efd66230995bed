//! Scale and mirror: the one place where words of a program become places and distances on the machine.
//!
//! `machine = mirror(origin + c + k·(word − c)) + length offset`: scaled about a point of the program, then mirrored
//! about a line of the machine. Every word that names a point, a distance, a centre, a radius or an angle passes here;
//! what does not pass (offsets, the way to a reference point, G53, G92, depths of cut) says so where it is read.

use base::{AXES, AxisSet, Point};
use dialect::Meaning;

use crate::block::Reading;
use crate::operation::Side;
use crate::setting::Setting;
use crate::state::State;

/// Scale and mirror as they are in force.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Transform {
    /// Factor of all distances along `scaled`.
    pub factor: f64,
    /// The axes that are scaled; none without scaling.
    pub scaled: AxisSet,
    /// The point that stays in its place: program coordinates, counts.
    pub center: Point,
    /// Mirror image is on, for whichever axes.
    pub mirror: bool,
    /// The axes that are mirrored.
    pub mirrored: AxisSet,
    /// Where each is mirrored: machine coordinates without the length offset, counts.
    pub line: Point,
}

impl Default for Transform {
    /// Words mean what they say.
    fn default() -> Self {
        Transform {
            factor: 1.0,
            scaled: AxisSet::NONE,
            center: [0.0; AXES],
            mirror: false,
            mirrored: AxisSet::NONE,
            line: [0.0; AXES],
        }
    }
}

impl Transform {
    /// True while mirror image is on, for whichever axes.
    pub const fn is_mirror_on(&self) -> bool {
        self.mirror
    }

    /// True if words mean what they say.
    pub const fn is_plain(&self) -> bool {
        self.scaled.is_empty() && self.mirrored.is_empty()
    }

    /// A distance along an axis.
    pub fn distance(&self, axis: usize, distance: f64) -> f64 {
        let factor = if self.scaled.has(axis) { self.factor } else { 1.0 };
        if self.mirrored.has(axis) { -distance * factor } else { distance * factor }
    }

    /// A length that has no direction, in the plane of these axes: a radius.
    pub fn size(&self, plane: [usize; 2], size: f64) -> f64 {
        if plane.iter().any(|&axis| self.scaled.has(axis)) { size * self.factor } else { size }
    }

    /// True if what turned clockwise in the plane of these axes turns the other way now.
    pub const fn turns_over(&self, plane: [usize; 2]) -> bool {
        self.mirrored.has(plane[0]) != self.mirrored.has(plane[1])
    }

    /// A direction in the plane of these axes, degrees from the first towards the second.
    pub const fn direction(&self, plane: [usize; 2], degrees: f64) -> f64 {
        match (self.mirrored.has(plane[0]), self.mirrored.has(plane[1])) {
            (false, false) => degrees,
            (true, false) => 180.0 - degrees,
            (false, true) => -degrees,
            (true, true) => 180.0 + degrees,
        }
    }

    /// A program coordinate scaled, still in the program's own system.
    fn scale(&self, axis: usize, value: f64) -> f64 {
        if !self.scaled.has(axis) {
            return value;
        }
        self.center[axis] + self.factor * (value - self.center[axis])
    }

    /// The program coordinate that is scaled to this one.
    fn unscale(&self, axis: usize, value: f64) -> f64 {
        if !self.scaled.has(axis) || self.factor == 0.0 {
            return value;
        }
        self.center[axis] + (value - self.center[axis]) / self.factor
    }

    fn reflect(&self, axis: usize, place: f64) -> f64 {
        if self.mirrored.has(axis) { 2.0 * self.line[axis] - place } else { place }
    }
}

impl Setting {
    /// The length offset in force on an axis.
    pub fn length_on(&self, state: &State, axis: usize) -> f64 {
        if Some(axis) == self.length_axis { state.length } else { 0.0 }
    }

    /// The machine coordinate to which a word of an axis leads, every offset but a displacement included (counts).
    pub fn placed(&self, state: &State, axis: usize, value: f64) -> f64 {
        let (transform, zero) = (&state.transform, self.zero(state, axis));
        if transform.is_plain() {
            return value + zero;
        }
        let length = self.length_on(state, axis);
        transform.reflect(axis, transform.scale(axis, value) + zero - length) + length
    }

    /// The word of an axis that leads to a machine coordinate (counts).
    pub fn programmed(&self, state: &State, axis: usize, machine: f64) -> f64 {
        let (transform, zero) = (&state.transform, self.zero(state, axis));
        if transform.is_plain() {
            return machine - zero;
        }
        let length = self.length_on(state, axis);
        transform.unscale(axis, transform.reflect(axis, machine - length) + length - zero)
    }

    /// After a reset: a scale that is no longer in force has no effect.
    pub fn end_scaling(&self, state: &mut State) {
        let scaling = self.control.roles.scaling.and_then(|group| self.control.in_force(&state.groups, group));
        if scaling != Some(Meaning::ScalingOn) {
            state.transform.scaled = AxisSet::NONE;
        }
    }
}

impl Reading<'_> {
    /// The machine coordinate to which a word of an axis leads.
    pub fn placed(&self, axis: usize, value: f64) -> f64 {
        self.setting.placed(self.next, axis, value)
    }

    /// The level of a canned cycle, a program coordinate along the drilling axis, as a machine coordinate. It is not
    /// mirrored, and in boring with a shift not scaled.
    pub fn level_placed(&self, cycle: Meaning, axis: usize, level: f64) -> f64 {
        let level = if self.scales_levels(cycle) { self.next.transform.scale(axis, level) } else { level };
        level + self.zero(axis)
    }

    /// The level of a canned cycle that lies at a machine coordinate.
    pub fn level_programmed(&self, cycle: Meaning, axis: usize, machine: f64) -> f64 {
        let level = machine - self.zero(axis);
        if self.scales_levels(cycle) { self.next.transform.unscale(axis, level) } else { level }
    }

    fn scales_levels(&self, cycle: Meaning) -> bool {
        let scaled = self.setting.fitting.policies.scaling_bore_levels == dialect::ScalingBoreLevels::Scaled;
        scaled || !matches!(cycle, Meaning::FineBore | Meaning::BackBore)
    }

    /// The side of the path on which the tool runs: a mirror image exchanges left and right.
    pub fn exchange_side(&mut self) {
        if self.command.side == Side::Off || self.next.transform.mirrored.is_empty() {
            return;
        }
        let axes = self.plane().letters().map(|letter| self.setting.facts.axis(letter));
        if let [Some(u), Some(v)] = axes
            && self.next.transform.turns_over([u, v])
        {
            self.command.side = if self.command.side == Side::Left { Side::Right } else { Side::Left };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_image_turns_directions_about_its_axis() {
        let mirrored = |bits| Transform { mirrored: AxisSet(bits), ..Transform::default() };
        for (bits, direction, over) in
            [(0b00, 30.0, false), (0b01, 150.0, true), (0b10, -30.0, true), (0b11, 210.0, false)]
        {
            assert_eq!(mirrored(bits).direction([0, 1], 30.0), direction);
            assert_eq!(mirrored(bits).turns_over([0, 1]), over);
        }
    }

    #[test]
    fn what_is_scaled_is_found_again() {
        let mut transform = Transform { factor: 1.37, scaled: AxisSet(0b1), ..Transform::default() };
        transform.center[0] = 12.0e6;
        let there = transform.scale(0, 20.0e6);
        assert_eq!(there, 12.0e6 + 1.37 * 8.0e6);
        assert!((transform.unscale(0, there) - 20.0e6).abs() < 1e-6);
        assert_eq!(transform.scale(1, 20.0e6), 20.0e6);
    }
}
