//! G27 to G30: the reference points of the machine, the ways to them and back.
//!
//! The intermediate point is a programmed one and is remembered on each axis for G29, as a place on the machine; the
//! reference points are the machine's, no offset, scale or mirror counts on the way to them. An axis that has not been
//! returned since power-on moves by G28 only, or no program begins: a parameter says, or a policy.

use base::{Alarm, AxisSet, Condition, Point};
use dialect::{Meaning, ReferenceFirst};

use crate::block::Reading;
use crate::command::Body;
use crate::operation::Side;
use crate::setting::Setting;

/// What is known of the reference points.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ReferenceData {
    /// Axes returned to their first reference point since power-on.
    pub established: AxisSet,
    /// Axes on which an intermediate point is remembered.
    pub remembered: AxisSet,
    /// The intermediate point of the last G28 or G30 on each axis: machine coordinates, counts.
    pub via: Point,
}

impl Setting {
    /// A reference point of an axis, 0 for the first; counts.
    fn reference_point(&self, axis: usize, which: usize) -> f64 {
        self.facts.axes.get(axis).and_then(|facts| facts.reference_points.get(which)).copied().unwrap_or(0.0)
    }
}

impl Reading<'_> {
    /// G28: by way of the intermediate point to the first reference point, which is established by it.
    pub fn reference_return(&mut self) -> Result<(), Alarm> {
        let axes = self.return_to(0)?;
        self.next.reference.established = self.next.reference.established.or(axes);
        self.command.returned = axes;
        Ok(())
    }

    /// G30: as G28 to the second, third or fourth point, by P.
    pub fn other_reference_return(&mut self) -> Result<(), Alarm> {
        let which = match self.words.count(self.control(), b'P')? {
            None => 2,
            Some(which @ 2..=4) => which,
            Some(other) => {
                let values = [f64::from(other), 2.0, 4.0];
                return Err(self.words.alarm(Condition::ValueOutOfRange, b'P').with(values));
            }
        };
        self.return_to(which as usize - 1).map(|_| ())
    }

    fn return_to(&mut self, which: usize) -> Result<AxisSet, Alarm> {
        let axes = self.reference_axes()?;
        self.leave_offset(axes)?;
        let mut to = self.next.machine;
        let via = self.via_targets(axes)?;
        for axis in axes.iter() {
            self.next.transform.close_gap(axis);
            to[axis] = self.setting.reference_point(axis, which);
            self.next.displacement[axis] = 0.0;
            self.next.reference.via[axis] = via[axis];
        }
        if self.control().functions.reference.drops_length
            && self.setting.length_axis.is_some_and(|axis| axes.has(axis))
        {
            // The axis stands at the point itself: the whole offset is due with its next movement.
            self.next.length_due = self.next.length;
        }
        self.next.reference.remembered = self.next.reference.remembered.or(axes);
        // Where the reference point is, the axis is known again, whatever came before.
        self.now_known = self.now_known.or(axes);
        self.next.machine = to;
        self.command.body = Body::Via { via, to, stops: true };
        Ok(axes)
    }

    /// G29: through the remembered intermediate point to the given one, from which an incremental word counts.
    pub fn return_from_reference(&mut self) -> Result<(), Alarm> {
        let axes = self.reference_axes()?;
        self.leave_offset(axes)?;
        for axis in axes.iter() {
            if !self.next.reference.remembered.has(axis) {
                return Err(self.axis_alarm(Condition::IntermediatePointMissing, axis));
            }
            self.next.machine[axis] = self.next.reference.via[axis];
            self.next.transform.close_gap(axis);
            if self.control().functions.reference.drops_length && Some(axis) == self.setting.length_axis {
                // The intermediate point holds the offset.
                (self.length_change, self.next.length_due) = (0.0, 0.0);
            }
        }
        let via = self.next.machine;
        let mut to = [0.0; base::AXES];
        let moved = self.targets_of(axes, &mut to)?;
        self.now_known = self.now_known.or(moved);
        self.next.machine = to;
        self.command.body = Body::Via { via, to, stops: true };
        Ok(())
    }

    /// The axes that a code of the reference points names; none is refused where the control wants one.
    fn reference_axes(&self) -> Result<AxisSet, Alarm> {
        let axes = self.axes_named();
        if axes.is_empty() && self.control().functions.reference.wants_axis {
            return Err(self.one_shot_alarm(Condition::AxisWordMissing));
        }
        Ok(axes)
    }

    /// G27: positions, then compares with the first reference point.
    pub fn reference_check(&mut self) -> Result<(), Alarm> {
        let axes = self.reference_axes()?;
        let offset = |axis: usize| {
            let length = if Some(axis) == self.setting.length_axis { self.next.length } else { 0.0 };
            length != 0.0 || self.next.displacement[axis] != 0.0
        };
        let by_place = self.control().functions.reference.checks_places;
        if self.command.side != Side::Off || !by_place && axes.iter().any(offset) {
            return Err(self.one_shot_alarm(Condition::ReferenceCheckWithOffset));
        }
        let mut to = [0.0; base::AXES];
        let moved = self.targets(&mut to)?;
        let [metric, _, rotary] = self.control().increments;
        let beside = axes.iter().find(|&axis| {
            let turns = self.setting.facts.axes.get(axis).is_some_and(|facts| facts.rotary);
            let increment = if turns { rotary } else { metric };
            (to[axis] - self.setting.reference_point(axis, 0)).abs() * 2.0 >= increment as f64
        });
        let alarm = beside.map(|axis| {
            let point = self.setting.reference_point(axis, 0);
            self.axis_alarm(Condition::ReferenceNotReached, axis).with([to[axis] / 1e6, point / 1e6, 0.0])
        });
        self.now_known = self.now_known.or(moved);
        self.next.machine = to;
        self.command.body = Body::Checked { to, alarm };
        Ok(())
    }

    /// Refuses to move an axis that has not been returned since power-on, unless that is what the block does; or to do
    /// anything before all have been, where the control says so.
    pub fn check_returned(&self) -> Result<(), Alarm> {
        let before_start = self.control().functions.reference.before_start;
        let (wanted, all) = match before_start {
            None if self.setting.fitting.policies.reference_first == ReferenceFirst::Start => {
                (self.setting.facts.all(), true)
            }
            None => (self.now_known, false),
            Some(parameter) if self.setting.fitting.parameter(parameter) == 0.0 => (self.setting.facts.all(), true),
            Some(_) => return Ok(()),
        };
        let missing = wanted.without(self.before.reference.established);
        match missing.iter().next() {
            Some(axis) if all || !matches!(self.one_shot, Some((Meaning::ReferenceReturn, _))) => {
                Err(self.axis_alarm(Condition::ReferenceNotDone, axis))
            }
            _ => Ok(()),
        }
    }

    /// An alarm about an axis, at its word if it has one.
    pub fn axis_alarm(&self, condition: Condition, axis: usize) -> Alarm {
        let letter = self.setting.facts.axes.get(axis).map_or(0, |facts| facts.letter);
        match self.words.word(letter) {
            Some(word) => self.words.alarm_at(condition, word).on_axis(axis),
            None => self.motion_alarm(condition).on_axis(axis),
        }
    }
}
