//! Scale, mirror and rotation: the one place where words of a program become places and distances on the machine.
//!
//! `machine = mirror(origin + rotate(c + k·(word − c)) − length) + length`: scaled about a point of the program, rotated
//! about another, which is scaled with it, then mirrored about a line of the machine. Every word that names a point, a
//! distance, a centre, a radius or an angle passes here; what does not pass (offsets, the way to a reference point, G53,
//! G92, depths of cut) says so where it is read.

use base::{AXES, AxisSet, Point};
use dialect::Meaning;

use crate::block::Reading;
use crate::cycle::pattern::sin_cos_deg;
use crate::setting::Setting;
use crate::state::State;

/// Scale, mirror and rotation act on the first axes of the machine only: X, Y, Z and one more.
pub const TRANSFORMED: usize = 4;
/// One value for each of these.
pub type Along = [f64; TRANSFORMED];

/// Rotation as it is in force.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Rotation {
    /// It is in force.
    pub on: bool,
    /// The two axes of its plane.
    pub axes: [u8; 2],
    /// Its centre along them, program coordinates before scaling, counts.
    pub center: [f64; 2],
    /// The angle, from the first axis towards the second; the sum of what was programmed where angles add up.
    pub degrees: f64,
}

impl Rotation {
    /// The axes of its plane.
    pub fn plane(&self) -> AxisSet {
        self.axes.iter().fold(AxisSet::NONE, |set, &axis| set.or(AxisSet::only(usize::from(axis))))
    }
}

/// Scale, mirror and rotation as they are in force.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Transform {
    /// Factor of distances along `scaled`; a negative one mirrors about the centre.
    pub factor: Along,
    /// The axes that are scaled; none without scaling.
    pub scaled: AxisSet,
    /// The point that stays in its place: program coordinates, counts.
    pub center: Along,
    /// Mirror image is on, for whichever axes.
    pub mirror: bool,
    /// The axes that are mirrored about a line.
    pub mirrored: AxisSet,
    /// Those of them that a switch mirrors.
    pub by_switch: AxisSet,
    /// Where each is mirrored: machine coordinates without the length offset, counts.
    pub line: Along,
    /// Rotation.
    pub rotation: Rotation,
    /// The axes whose last programmed coordinate is another than the one of the place where they stand, since scale or
    /// rotation changed without a move (policy `programmed-position`).
    pub apart: AxisSet,
    /// By how much it is more.
    pub gap: Along,
}

impl Default for Transform {
    /// Words mean what they say.
    fn default() -> Self {
        Transform {
            factor: [1.0; TRANSFORMED],
            scaled: AxisSet::NONE,
            center: [0.0; TRANSFORMED],
            mirror: false,
            mirrored: AxisSet::NONE,
            by_switch: AxisSet::NONE,
            line: [0.0; TRANSFORMED],
            rotation: Rotation::default(),
            apart: AxisSet::NONE,
            gap: [0.0; TRANSFORMED],
        }
    }
}

/// The value of an axis, if it is one of those.
fn of(along: &Along, axis: usize, otherwise: f64) -> f64 {
    along.get(axis).copied().unwrap_or(otherwise)
}

impl Transform {
    /// True while mirror image is on, for whichever axes.
    pub const fn is_mirror_on(&self) -> bool {
        self.mirror
    }

    /// True if words mean what they say.
    pub const fn is_plain(&self) -> bool {
        self.scaled.is_empty() && self.mirrored.is_empty() && !self.rotation.on
    }

    /// The factor along an axis without its sign.
    fn size_along(&self, axis: usize) -> f64 {
        if self.scaled.has(axis) { of(&self.factor, axis, 1.0).abs() } else { 1.0 }
    }

    /// True if distances along an axis change their sign, rotation aside.
    pub fn negates(&self, axis: usize) -> bool {
        self.mirrored.has(axis) != self.scales_over(axis)
    }

    fn scales_over(&self, axis: usize) -> bool {
        self.scaled.has(axis) && of(&self.factor, axis, 1.0) < 0.0
    }

    /// A distance along an axis, where nothing is rotated.
    pub fn distance(&self, axis: usize, distance: f64) -> f64 {
        let distance = if self.scaled.has(axis) { distance * of(&self.factor, axis, 1.0) } else { distance };
        if self.mirrored.has(axis) { -distance } else { distance }
    }

    /// A distance in the plane of these axes.
    pub fn vector(&self, plane: [usize; 2], distance: [f64; 2]) -> [f64; 2] {
        let [u, v] = plane;
        if !self.rotation.on {
            return [self.distance(u, distance[0]), self.distance(v, distance[1])];
        }
        let mut all = [0.0; AXES];
        (all[u], all[v]) = (distance[0], distance[1]);
        let all = self.distances(&all);
        [all[u], all[v]]
    }

    /// Distances along all axes.
    pub fn distances(&self, distances: &Point) -> Point {
        let mut all = *distances;
        for axis in self.scaled.iter() {
            all[axis] *= of(&self.factor, axis, 1.0);
        }
        if self.rotation.on {
            self.rotate(&mut all, [0.0; 2], self.turned());
        }
        for axis in self.mirrored.iter() {
            all[axis] = -all[axis];
        }
        all
    }

    /// A length that has no direction, in the plane of these axes: a radius. Of two factors the larger counts.
    pub fn size(&self, plane: [usize; 2], size: f64) -> f64 {
        if self.scaled.is_empty() { size } else { size * self.size_along(plane[0]).max(self.size_along(plane[1])) }
    }

    /// True if a circle in the plane of these axes would become an ellipse.
    pub fn stretches(&self, plane: [usize; 2]) -> bool {
        !self.scaled.is_empty() && self.size_along(plane[0]) != self.size_along(plane[1])
    }

    /// True if what turned clockwise in the plane of these axes turns the other way now.
    pub fn turns_over(&self, plane: [usize; 2]) -> bool {
        self.negates(plane[0]) != self.negates(plane[1])
    }

    /// The angle by which rotation really turns: scaling that mirrors one axis of the plane reverses it.
    fn turned(&self) -> f64 {
        let [u, v] = self.rotation.axes.map(usize::from);
        if self.scales_over(u) == self.scales_over(v) { self.rotation.degrees } else { -self.rotation.degrees }
    }

    fn rotate(&self, point: &mut Point, about: [f64; 2], degrees: f64) {
        let [u, v] = self.rotation.axes.map(usize::from);
        let (sin, cos) = sin_cos_deg(degrees);
        let (x, y) = (point[u] - about[0], point[v] - about[1]);
        point[u] = about[0] + (x * cos - y * sin);
        point[v] = about[1] + (x * sin + y * cos);
    }

    /// The centre of rotation once it is scaled.
    fn pivot(&self) -> [f64; 2] {
        let [u, v] = self.rotation.axes.map(usize::from);
        [self.scale(u, self.rotation.center[0]), self.scale(v, self.rotation.center[1])]
    }

    /// A program coordinate scaled, still in the program's own system.
    fn scale(&self, axis: usize, value: f64) -> f64 {
        if !self.scaled.has(axis) {
            return value;
        }
        let center = of(&self.center, axis, 0.0);
        center + of(&self.factor, axis, 1.0) * (value - center)
    }

    /// The program coordinate that is scaled to this one.
    fn unscale(&self, axis: usize, value: f64) -> f64 {
        let factor = of(&self.factor, axis, 1.0);
        if !self.scaled.has(axis) || factor == 0.0 {
            return value;
        }
        let center = of(&self.center, axis, 0.0);
        center + (value - center) / factor
    }

    fn reflect(&self, axis: usize, place: f64) -> f64 {
        if self.mirrored.has(axis) { 2.0 * of(&self.line, axis, 0.0) - place } else { place }
    }

    /// The axis stands where its last word says.
    pub fn close_gap(&mut self, axis: usize) {
        self.apart = self.apart.without(AxisSet::only(axis));
    }
}

impl Setting {
    /// The length offset in force on an axis.
    pub fn length_on(&self, state: &State, axis: usize) -> f64 {
        if Some(axis) == self.length_axis { state.length } else { 0.0 }
    }

    /// The machine coordinate to which a word of an axis leads where nothing is rotated, every offset but a displacement
    /// included (counts).
    pub fn placed(&self, state: &State, axis: usize, value: f64) -> f64 {
        let (transform, zero) = (&state.transform, self.zero(state, axis));
        if transform.is_plain() {
            return value + zero;
        }
        let length = self.length_on(state, axis);
        transform.reflect(axis, transform.scale(axis, value) + zero - length) + length
    }

    /// The place to which program coordinates lead, every offset but a displacement included (counts).
    pub fn placed_point(&self, state: &State, program: &Point) -> Point {
        let transform = &state.transform;
        let mut place = *program;
        for axis in transform.scaled.iter() {
            place[axis] = transform.scale(axis, place[axis]);
        }
        if transform.rotation.on {
            transform.rotate(&mut place, transform.pivot(), transform.turned());
        }
        for axis in 0..self.facts.axes.len().min(AXES) {
            let (zero, length) = (self.zero(state, axis), self.length_on(state, axis));
            place[axis] = transform.reflect(axis, place[axis] + zero - length) + length;
        }
        place
    }

    /// The program coordinates that lead to a place of the machine (counts).
    pub fn programmed(&self, state: &State, machine: &Point) -> Point {
        let transform = &state.transform;
        let mut program = *machine;
        for axis in 0..self.facts.axes.len().min(AXES) {
            let (zero, length) = (self.zero(state, axis), self.length_on(state, axis));
            program[axis] = if transform.is_plain() {
                machine[axis] - zero
            } else {
                transform.reflect(axis, machine[axis] - length) + length - zero
            };
        }
        if transform.rotation.on {
            transform.rotate(&mut program, transform.pivot(), -transform.turned());
        }
        for axis in transform.scaled.iter() {
            program[axis] = transform.unscale(axis, program[axis]);
        }
        program
    }

    /// The coordinates programmed last, the axes standing at `machine` (counts).
    pub fn last_programmed(&self, state: &State, machine: &Point) -> Point {
        let mut program = self.programmed(state, machine);
        for axis in state.transform.apart.iter() {
            program[axis] += of(&state.transform.gap, axis, 0.0);
        }
        program
    }

    /// After a reset: a scale, rotation or polar system that is no longer in force has no effect, and distances count
    /// from where the axes stand.
    pub fn end_transforms(&self, state: &mut State) {
        let roles = &self.control.roles;
        let in_force = |group: Option<usize>| group.and_then(|group| self.control.in_force(&state.groups, group));
        let (scaling, rotation, polar) = (in_force(roles.scaling), in_force(roles.rotation), in_force(roles.polar));
        if scaling != Some(Meaning::ScalingOn) {
            state.transform.scaled = AxisSet::NONE;
        }
        if rotation != Some(Meaning::RotationOn) {
            state.transform.rotation = Rotation::default();
        }
        state.polar.on &= polar == Some(Meaning::PolarOn);
        state.transform.apart = AxisSet::NONE;
    }
}

impl Reading<'_> {
    /// The machine coordinate to which a word of an axis leads where nothing is rotated.
    pub fn placed(&self, axis: usize, value: f64) -> f64 {
        self.setting.placed(self.next, axis, value)
    }

    /// The level of a canned cycle, a program coordinate along the drilling axis, as a machine coordinate. No mirror line
    /// acts on it, and in boring with a shift no scale.
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
        scaled || !self.control().functions.cycle.shifts(cycle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_image_turns_directions_about_its_axis() {
        let mirrored = |bits| Transform { mirrored: AxisSet(bits), ..Transform::default() };
        for (bits, to, over) in [
            (0b00, [3.0, 4.0], false),
            (0b01, [-3.0, 4.0], true),
            (0b10, [3.0, -4.0], true),
            (0b11, [-3.0, -4.0], false),
        ] {
            assert_eq!(mirrored(bits).vector([0, 1], [3.0, 4.0]), to);
            assert_eq!(mirrored(bits).turns_over([0, 1]), over);
        }
    }

    #[test]
    fn what_is_scaled_is_found_again() {
        let mut transform = Transform { scaled: AxisSet(0b1), ..Transform::default() };
        (transform.center[0], transform.factor[0]) = (12.0e6, 1.37);
        let there = transform.scale(0, 20.0e6);
        assert_eq!(there, 12.0e6 + 1.37 * 8.0e6);
        assert!((transform.unscale(0, there) - 20.0e6).abs() < 1e-6);
        assert_eq!(transform.scale(1, 20.0e6), 20.0e6);
    }

    #[test]
    fn a_mirror_in_the_plane_reverses_the_rotation() {
        let rotation = Rotation { on: true, axes: [0, 1], center: [0.0; 2], degrees: 90.0 };
        let mut transform = Transform { rotation, ..Transform::default() };
        assert_eq!(transform.vector([0, 1], [10.0, 0.0]), [0.0, 10.0]);
        transform.scaled = AxisSet(0b11);
        transform.factor = [-1.0, 1.0, 1.0, 1.0];
        // The part turned by 90 degrees, then mirrored: (10, 0) is (0, 10), which the mirror leaves.
        assert_eq!(transform.vector([0, 1], [10.0, 0.0]), [0.0, 10.0]);
        assert_eq!(transform.vector([0, 1], [0.0, 10.0]), [10.0, 0.0]);
    }
}
