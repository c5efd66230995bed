//! The switches and overrides as the operator has set them, passed on to the stages: which blocks are read and how, which
//! axes and displays keep still, how fast.

use base::{AXES, AxisSet, Place, Point};
use machine::Machine;
use meaning::{RapidKind, Switches, TRANSFORMED};
use motion::Overrides;
use path::{Shape, Shaped};

use super::Session;
use super::by_hand::ByHand;
use crate::library::Library;
use crate::switches::{SessionSwitches, Which};

/// The axis of the switch Z-AXIS CANCEL.
pub(super) const CANCELLED_AXIS: u8 = b'Z';

/// Percents of the override switches.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Percents {
    /// Of the commanded feed.
    pub feed: u16,
    /// Of the rapid rate.
    pub rapid: u16,
    /// Of the commanded spindle speed.
    pub spindle: u16,
}

impl Default for Percents {
    /// Everything as commanded.
    fn default() -> Self {
        Percents { feed: 100, rapid: 100, spindle: 100 }
    }
}

impl<L: Library> Session<L> {
    /// Turns a switch.
    ///
    /// # Errors
    /// Why not, in words.
    pub fn set_switch(&mut self, name: &str, which: Which, on: bool) -> Result<(), String> {
        self.configuration.check_switch(name, which)?;
        self.switches.set(name, which, on)?;
        self.switched = true;
        self.pass_switches();
        self.pass_overrides();
        Ok(())
    }

    /// How the switches stand.
    pub fn switches(&self) -> SessionSwitches {
        self.switches
    }

    /// Turns the override switches.
    pub fn set_percents(&mut self, percents: Percents) {
        self.percents = percents;
        self.pass_overrides();
    }

    /// How the override switches stand.
    pub fn percents(&self) -> Percents {
        self.percents
    }

    /// The speeds in force.
    pub fn overrides(&self) -> &motion::Overrides {
        self.motion.overrides()
    }

    /// Parameters have been written: what is set from them is set anew.
    pub fn take_parameters(&mut self) {
        self.pass_overrides();
    }

    /// The switches that decide how blocks are read.
    pub(super) fn pass_switches(&mut self) {
        let SessionSwitches { optional_stop, block_delete, .. } = self.switches;
        let axes = &self.configuration.machine.axes;
        let mut mirror_image = AxisSet::NONE;
        let mirrored = |axis: &usize| self.switches.mirrors(axes[*axis].letter);
        (0..axes.len().min(TRANSFORMED)).filter(mirrored).for_each(|axis| mirror_image.add(axis));
        *self.interpreter_mut().switches_mut() = Switches { optional_stop, block_delete, mirror_image };
    }

    /// Which axes the switches in force hold.
    pub(super) fn pass_locks(&mut self) {
        let axes = &self.configuration.machine.axes;
        self.lock.held = AxisSet::NONE;
        for (index, axis) in axes.iter().enumerate().take(AXES) {
            if self.in_force.machine_lock || (self.in_force.z_cancel && axis.letter == CANCELLED_AXIS) {
                self.lock.held.add(index);
            }
        }
    }

    /// The feed override as it counts.
    pub(super) fn feed_percent(&self) -> u16 {
        if self.fixes_override || self.switches.override_cancel { 100 } else { self.percents.feed }
    }

    /// The speeds that override switches, DRY RUN and parameters give.
    pub(super) fn pass_overrides(&mut self) {
        let station = &self.configuration.control.station;
        let fitting = self.interpreter().fitting();
        let jog = fitting.parameter(station.jog_speed);
        let part = |percent: u16| f64::from(percent) / 100.0;
        let mut overrides =
            Overrides { feed: part(self.feed_percent()), spindle: part(self.percents.spindle), ..Overrides::default() };
        // The lowest step is a rate of its own, not a part of the axis' rate.
        match self.percents.rapid {
            0 => overrides.rapid_limit = fitting.parameter_if_any(station.lowest_rapid) / 60.0,
            percent => overrides.rapid = part(percent),
        }
        if self.in_force.dry_run {
            overrides.dry_run = Some(jog);
            if fitting.parameter(station.dry_run_rapid) != 0.0 {
                (overrides.rapid, overrides.rapid_limit) = (1.0, jog / 60.0);
            }
        }
        self.motion.set_overrides(overrides);
        self.pass_hand_speed();
    }

    /// The shape as the axes really make it; `None` if that is the counted one.
    pub(super) fn real_shape(&self) -> Option<Shaped> {
        if !self.lock.acts() && !self.in_force.display_lock {
            return None;
        }
        let mut shaped = *self.motion.upstream.current();
        let returned = if shaped.stop_point { AxisSet::NONE } else { self.returned() };
        shaped.shape = self.lock.real(&shaped.shape, self.machine.position(), returned);
        Some(shaped)
    }

    /// Axes that the block returns to their reference point: its last move leads there.
    pub(super) fn returned(&self) -> AxisSet {
        self.interpreter().executing().map_or(AxisSet::NONE, |command| command.returned)
    }

    /// The block is done. Axes that it has returned to their reference point stand there and are counted anew, also
    /// where the control thought that they stood there already. False while the rapid override does not let them.
    pub(super) fn settle_returned(&mut self, place: &Place) -> bool {
        if !self.lock.acts() {
            return true;
        }
        let astray = self.lock.astray(self.returned());
        let from = *self.machine.position();
        let mut to = from;
        for axis in astray.iter() {
            to[axis] = self.lock.counted(&from)[axis];
        }
        if to != from && self.motion.overrides().rapid_stands() {
            return false;
        }
        self.lock.settle(astray);
        if to != from {
            let shape = Shape::Rapid { from, to, kind: RapidKind::Checked };
            let shaped = Shaped { shape, place: *place, ..*self.motion.upstream.current() };
            let timed = self.motion.time(&shaped);
            if let Err(refusal) = self.machine.execute(&timed, &mut self.events) {
                self.raise(refusal.alarm);
            }
        }
        true
    }

    /// The counted move has been made; what the axes did not make of it is remembered.
    pub(super) fn count_move(&mut self) {
        let to = match &self.motion.upstream.current().shape {
            Shape::Rapid { to, .. } | Shape::Line { to, .. } => *to,
            Shape::Arc { arc, .. } => arc.to,
            _ => return,
        };
        let real = *self.machine.position();
        self.lock.arrived(&to, &real);
        if !self.motion.upstream.current().stop_point {
            self.lock.settle(self.returned().without(self.lock.held));
        }
    }

    /// The control counts from `before` to where it counts now; with DISPLAY LOCK on the displays do not.
    pub(super) fn pass_displays(&mut self, before: &Point) {
        if self.in_force.display_lock {
            let now = self.counted_position();
            self.keep_from_displays(&std::array::from_fn(|axis| now[axis] - before[axis]));
        }
    }

    /// The displays do not count this way.
    pub(super) fn keep_from_displays(&mut self, way: &Point) {
        for axis in 0..AXES {
            self.unseen[axis] += way[axis];
        }
    }

    /// Where the control counts the axes to be, mm and degrees in machine coordinates: where they are, but for those
    /// that a switch has held.
    pub fn counted_position(&self) -> Point {
        let held = self.by_hand.as_ref().filter(|_| self.switches.manual_absolute).and_then(ByHand::counted);
        held.unwrap_or_else(|| self.lock.counted(&self.position()))
    }

    /// The ABSOLUTE display: coordinates of the work system in force.
    pub fn work_display(&self) -> Point {
        self.seen(self.interpreter().work_position(&self.counted_position()))
    }

    /// The UNIVERSAL display.
    pub fn universal_display(&self) -> Point {
        self.seen(self.interpreter().universal_position(&self.counted_position()))
    }

    /// The UNIVERSAL display shows so much of an axis where it stands, mm or degrees.
    pub fn preset_universal(&mut self, axis: usize, shown: f64) {
        let counted = self.counted_position()[axis];
        let zero = (counted * 1e6).round() - ((shown + self.unseen[axis]) * 1e6).round();
        self.interpreter_mut().set_universal_zero(axis, zero);
    }

    fn seen(&self, mut shown: Point) -> Point {
        for axis in 0..AXES {
            shown[axis] -= self.unseen[axis];
        }
        shown
    }
}
