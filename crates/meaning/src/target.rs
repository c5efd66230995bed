//! Where the axis words of a block lead: each axis by itself, or, where rotation or polar coordinates are in force,
//! together.

use base::{Alarm, AxisSet, Condition, Point};
use dialect::{LengthWithoutZ, PositionOffsetAbsolute, ReferenceVia};

use crate::block::Reading;
use crate::cycle::pattern::Places;

/// A place less than this beside where an axis stands is where it stands, counts.
const SAME_PLACE: f64 = 1e-3;

/// Axes placed together.
struct Together {
    /// The coordinates programmed before the block, and its own.
    from: Point,
    program: Point,
    /// Where they lead, machine coordinates.
    to: Point,
    moved: AxisSet,
}

impl Reading<'_> {
    /// Where an axis' word leads by itself, machine coordinates.
    #[inline]
    fn target(&mut self, axis: usize) -> Result<f64, Alarm> {
        self.length_axis_placed(axis);
        let (value, minus) = self.axis_word(axis)?;
        let now = self.next.machine[axis];
        let target = if self.absolute {
            self.placed(axis, value) + self.displacement_kept(axis)
        } else {
            now + self.next.transform.distance(axis, value) + self.length_change_on(axis)
        };
        let minus = minus != self.next.transform.negates(axis);
        Ok(self.position_offset_on(axis, target, minus && value == 0.0))
    }

    /// What of a displacement by G45 to G48 an absolute word keeps.
    #[inline]
    fn displacement_kept(&self, axis: usize) -> f64 {
        match self.setting.fitting.policies.position_offset_absolute {
            PositionOffsetAbsolute::Dropped => 0.0,
            PositionOffsetAbsolute::Kept => self.next.displacement[axis],
        }
    }

    /// A target lengthened or shortened by the block's G45 to G48.
    #[inline]
    fn position_offset_on(&mut self, axis: usize, target: f64, minus_zero: bool) -> f64 {
        let now = self.next.machine[axis];
        if let Some(offset) = self.position_offset {
            let change = offset.change(target - now, minus_zero);
            self.next.displacement[axis] += change;
            return target + change;
        }
        if self.absolute && self.setting.fitting.policies.position_offset_absolute == PositionOffsetAbsolute::Dropped {
            self.next.displacement[axis] = 0.0;
        }
        target
    }

    /// What an incremental word of the length axis has to make up for.
    #[inline]
    fn length_change_on(&self, axis: usize) -> f64 {
        if Some(axis) == self.setting.length_axis { self.length_change } else { 0.0 }
    }

    /// True if a word may lead another axis than its own, or counts from elsewhere than where its axis stands.
    #[inline]
    pub fn goes_together(&self) -> bool {
        let transform = &self.next.transform;
        transform.rotation.on || self.next.polar.on || !transform.apart.is_empty()
    }

    /// Writes every axis' target to `to`, these axes' where their words lead; returns the axes that move.
    #[inline]
    pub fn targets_of(&mut self, named: AxisSet, to: &mut Point) -> Result<AxisSet, Alarm> {
        if self.goes_together() {
            let together = self.targets_together(named)?;
            *to = together.to;
            return Ok(together.moved);
        }
        *to = self.next.machine;
        for axis in named.iter() {
            to[axis] = self.target(axis)?;
        }
        Ok(named)
    }

    /// Writes to `to` every named axis' target, and the length axis moved by a changed offset if it has no word of its
    /// own; returns the axes that move.
    pub fn targets(&mut self, to: &mut Point) -> Result<AxisSet, Alarm> {
        let named = self.axes_named();
        let mut moved = self.targets_of(named, to)?;
        let at_once = self.setting.fitting.policies.length_without_z == LengthWithoutZ::AtOnce;
        let changes = self.words.has(b'H') || self.groups_written & (1 << self.control().roles.length) != 0;
        if self.length_change != 0.0
            && at_once
            && (changes || !named.is_empty())
            && let Some(axis) = self.setting.length_axis
            && !moved.has(axis)
        {
            to[axis] += self.length_change;
            moved.add(axis);
            self.next.length_due = 0.0;
        }
        Ok(moved)
    }

    #[cold]
    fn targets_together(&mut self, named: AxisSet) -> Result<Together, Alarm> {
        let from = self.last_programmed();
        let mut program = from;
        let polar = if self.next.polar.on { self.polar_words(named, &from, &mut program)? } else { AxisSet::NONE };
        for axis in named.without(polar).iter() {
            let (value, _) = self.axis_word(axis)?;
            program[axis] = if self.absolute { value } else { from[axis] + value };
        }
        let mut moved = named.or(polar);
        let rotation = self.next.transform.rotation;
        let turned = rotation.plane();
        if rotation.on && !moved.and(turned).is_empty() {
            moved = moved.or(turned);
        }
        let placed = self.setting.placed_point(self.next, &program);
        let mut to = self.next.machine;
        for axis in moved.iter() {
            self.length_axis_placed(axis);
            self.next.transform.close_gap(axis);
            let kept = if self.absolute { self.displacement_kept(axis) } else { self.next.displacement[axis] };
            let target = self.position_offset_on(axis, placed[axis] + kept, false);
            if (target - to[axis]).abs() >= SAME_PLACE {
                to[axis] = target;
            }
        }
        Ok(Together { from, program, to, moved })
    }

    /// The places of a hole, so many times: once more by the same distances each time under G91.
    pub fn row_of_holes(&mut self, named: AxisSet, count: u32) -> Result<Places, Alarm> {
        let mut step = [0.0; base::AXES];
        if !self.goes_together() {
            let mut first = [0.0; base::AXES];
            self.targets_of(named, &mut first)?;
            for axis in named.iter() {
                if !self.absolute {
                    step[axis] = first[axis] - self.next.machine[axis];
                }
                self.now_known.add(axis);
            }
            return Ok(Places::Row { first, step, count });
        }
        self.refuse_turned_drilling()?;
        let Together { from, program, to: first, moved } = self.targets_together(named)?;
        self.now_known = self.now_known.or(moved);
        if self.absolute || count < 2 {
            return Ok(Places::Row { first, step, count });
        }
        if self.next.polar.on
            && let Some(places) = self.polar_row(&from, first, count)?
        {
            return Ok(places);
        }
        let mut way = [0.0; base::AXES];
        for axis in moved.iter() {
            way[axis] = program[axis] - from[axis];
        }
        if let (true, Some([u, v])) = (self.next.polar.on, self.plane_axes())
            && !named.has(u)
        {
            // A radius that stays what it is leads nowhere.
            (way[u], way[v]) = (0.0, 0.0);
        }
        step = self.next.transform.distances(&way);
        Ok(Places::Row { first, step, count })
    }

    /// A hole lies along the drilling axis: a plane that contains it cannot be turned or polar.
    fn refuse_turned_drilling(&self) -> Result<(), Alarm> {
        let roles = self.control().roles;
        let (rotation, polar) = (self.next.transform.rotation.on, self.next.polar.on);
        let drilling = self.setting.length_axis;
        let within = self.plane_axes().is_some_and(|axes| axes.iter().any(|&axis| Some(axis) == drilling));
        if !within || !(rotation || polar) {
            return Ok(());
        }
        let group = if rotation { roles.rotation } else { roles.polar };
        Err(self.motion_alarm(Condition::StateForbids).with([self.in_force_as(group), 0.0, 0.0]))
    }

    /// Where an axis' word leads as the intermediate point on the way to a reference point.
    pub fn via_targets(&mut self, named: AxisSet) -> Result<Point, Alarm> {
        if self.setting.fitting.policies.reference_via == ReferenceVia::Transformed {
            let mut via = [0.0; base::AXES];
            self.targets_of(named, &mut via)?;
            return Ok(via);
        }
        let mut via = self.next.machine;
        for axis in named.iter() {
            let (value, _) = self.axis_word(axis)?;
            via[axis] = if self.absolute {
                value + self.zero(axis) + self.displacement_kept(axis)
            } else {
                via[axis] + value + self.length_change_on(axis)
            };
            self.length_axis_placed(axis);
        }
        Ok(via)
    }
}
