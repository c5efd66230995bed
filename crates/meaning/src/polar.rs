//! G15 and G16: places by radius and angle. The first axis word of the plane is the radius, the second the angle, from
//! the first axis towards the second.
//!
//! A radius under G90 counts from program zero, one under G91 makes the place where the tool stands the pole. An angle
//! under G91 is added to the one before. A word left out keeps its last value; both begin as those of the place at which
//! polar coordinates are turned on, or the plane changes.

use base::{Alarm, AxisSet, Condition, Point};
use dialect::Meaning;

use crate::block::Reading;
use crate::cycle::pattern::{Places, sin_cos_deg};

/// Polar coordinates as they are in force.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Polar {
    /// They are in force.
    pub on: bool,
    /// Where they count from: program coordinates in the plane, counts.
    pub pole: [f64; 2],
    /// The radius last programmed, counts.
    pub radius: f64,
    /// The angle last programmed.
    pub degrees: f64,
}

impl Polar {
    /// The place, program coordinates in the plane.
    fn place(&self) -> [f64; 2] {
        let (sin, cos) = sin_cos_deg(self.degrees);
        [self.pole[0] + self.radius * cos, self.pole[1] + self.radius * sin]
    }
}

impl Reading<'_> {
    /// Takes the block's G15 or G16.
    pub fn take_polar(&mut self, plane_written: bool) {
        let Some(group) = self.control().roles.polar else { return };
        let on = self.control().in_force(&self.next.groups, group) == Some(Meaning::PolarOn);
        let begins = on && (!self.next.polar.on || plane_written && self.plane_changed());
        self.next.polar.on = on;
        if let (true, Some([u, v])) = (begins, self.plane_axes()) {
            let here = self.last_programmed();
            let radius = libm::hypot(here[u], here[v]);
            let degrees = if radius > 0.0 { libm::atan2(here[v], here[u]).to_degrees() } else { 0.0 };
            self.next.polar = Polar { on, pole: [0.0; 2], radius, degrees };
        }
    }

    fn plane_changed(&self) -> bool {
        let plane = self.control().roles.plane;
        self.before.groups.0[plane] != self.next.groups.0[plane]
    }

    /// Reads the words of the plane as radius and angle into `program`; the axes that are placed by them.
    pub fn polar_words(&mut self, named: AxisSet, from: &Point, program: &mut Point) -> Result<AxisSet, Alarm> {
        let Some([u, v]) = self.plane_axes() else { return Ok(AxisSet::NONE) };
        let mut polar = self.next.polar;
        if named.has(u) {
            polar.radius = self.axis_word(u)?.0;
            polar.pole = if self.absolute { [0.0; 2] } else { [from[u], from[v]] };
        }
        if named.has(v) {
            let angle = self.polar_angle(v)?;
            polar.degrees = if self.absolute { angle } else { polar.degrees + angle };
        }
        if !named.has(u) && !named.has(v) {
            return Ok(AxisSet::NONE);
        }
        self.next.polar = polar;
        [program[u], program[v]] = polar.place();
        Ok(AxisSet::only(u).or(AxisSet::only(v)))
    }

    /// The angle in the word of the plane's second axis.
    fn polar_angle(&self, axis: usize) -> Result<f64, Alarm> {
        let letter = self.setting.facts.axes.get(axis).map_or(0, |facts| facts.letter);
        Ok(self.words.angle(self.control(), letter)?.unwrap_or(0.0) / 1e6)
    }

    /// The places of a hole repeated under G91, each by the same words from the one before: `from` before the first,
    /// which lies at `program` and `to`.
    pub fn polar_row(&mut self, from: &Point, to: Point, count: u32) -> Result<Option<Places>, Alarm> {
        let Some([u, v]) = self.plane_axes() else { return Ok(None) };
        let (chain, turns) = (self.named(u), self.named(v));
        let step_deg = if turns { self.polar_angle(v)? } else { 0.0 };
        if step_deg % 360.0 == 0.0 {
            // One after the other in a row, or all in one place; the caller's steps say so.
            return Ok(None);
        }
        let others = self.axes_named().without(AxisSet::only(u)).without(AxisSet::only(v));
        let drilling = self.setting.length_axis.map_or(AxisSet::NONE, AxisSet::only);
        if let Some(axis) = others.without(drilling).iter().next() {
            return Err(self.axis_alarm(Condition::StateForbids, axis).with([
                self.in_force_as(self.control().roles.polar),
                0.0,
                0.0,
            ]));
        }
        let polar = self.next.polar;
        // A chain of equal steps, each turned by the same angle against the last, lies on a circle too.
        let (center, radius, first_deg) = if chain {
            let radius = polar.radius / (2.0 * sin_cos_deg(step_deg / 2.0).0);
            let first = polar.degrees + step_deg / 2.0 - 90.0;
            let (sin, cos) = sin_cos_deg(first - step_deg);
            ([from[u] - radius * cos, from[v] - radius * sin], radius, first)
        } else {
            (polar.pole, polar.radius, polar.degrees)
        };
        let at = |degrees: f64| {
            let (sin, cos) = sin_cos_deg(degrees);
            [center[0] + radius * cos, center[1] + radius * sin]
        };
        let last = f64::from(count.saturating_sub(1));
        self.next.polar.degrees = polar.degrees + last * step_deg;
        if chain {
            self.next.polar.pole = at(first_deg + (last - 1.0) * step_deg);
        }
        let mut middle = *from;
        [middle[u], middle[v]] = center;
        let middle = self.setting.placed_point(self.next, &middle);
        let transform = self.next.transform;
        Ok(Some(Places::Circle {
            level: to,
            axes: [u as u8, v as u8],
            center: [middle[u], middle[v]],
            arms: [transform.vector([u, v], [radius, 0.0]), transform.vector([u, v], [0.0, radius])],
            first_deg,
            step_deg,
            count,
        }))
    }

    fn named(&self, axis: usize) -> bool {
        self.setting.facts.axes.get(axis).is_some_and(|facts| self.words.has(facts.letter))
    }
}
