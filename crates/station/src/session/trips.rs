//! What stops the axes against everybody's will: overtravel switches, drives, spindle, power.

use base::{Alarm, Condition, Place};
use machine::{LimitSwitch, LogicAlarm, LogicFate};

use super::Session;
use super::awaiting::values_of;
use crate::fault::Fault;
use crate::library::Library;

impl<L: Library> Session<L> {
    /// Something breaks. Without effect if there is no such axis.
    pub fn break_down(&mut self, fault: Fault) {
        let axes = &self.configuration.machine.axes;
        let axis_of = |letter: u8| axes.iter().position(|axis| axis.letter == letter);
        match fault {
            Fault::Fin(fin) => self.machine.set_fin_fault(fin),
            Fault::Input(name) => {
                if let Some(line) = self.configuration.machine.logic.input(&name) {
                    self.machine.stick_line(line);
                }
            }
            Fault::SpindleSpeed => {
                let now = self.time();
                self.machine.set_spindle_weak(true, now, &mut self.events);
            }
            Fault::Limit(letter, positive, at) => {
                if let Some(axis) = axis_of(letter) {
                    self.machine.add_switch(LimitSwitch { axis, positive, at, on: false });
                }
            }
            Fault::Servo(letter) => {
                if let Some(axis) = axis_of(letter) {
                    let place = self.place_at_work();
                    self.trip(Alarm::new(Condition::ServoFault, place, place.block).on_axis(axis));
                }
            }
            Fault::Power => {
                self.interrupted = self.is_running().then(|| self.place());
                self.power_off();
            }
        }
    }

    /// The block being executed, if a program runs.
    fn place_at_work(&self) -> Place {
        if self.is_running() { self.place() } else { Place::default() }
    }

    /// The axes stop as fast as they can, and the alarm stands.
    fn trip(&mut self, alarm: Alarm) {
        self.break_off();
        self.tripped = None;
        self.settle_counters();
        self.closing = None;
        if self.alarm.is_none() {
            self.raise(alarm);
        }
    }

    /// What has happened since the last look and stops the axes; true if something has.
    pub(super) fn look_for_trips(&mut self) -> bool {
        if let Some(switch) = self.tripped.take() {
            let place = self.place_at_work();
            let alarm = Alarm::new(Condition::LimitSwitchReached, place, place.block);
            self.trip(alarm.with([switch.at, 0.0, 0.0]).on_axis(switch.axis));
            return true;
        }
        if let Some(late) = self.late_logic().filter(|late| late.at <= self.time().0) {
            self.give_logic_up(&late);
            return true;
        }
        let late = self.machine.spindle().gives_up().filter(|(at, _)| at.0 <= self.time().0);
        let Some((_, rpm)) = late.filter(|_| self.alarm.is_none() && self.powered) else { return false };
        let (place, now) = (self.place_at_work(), self.time());
        let reached = self.machine.spindle().rpm(now.0).abs();
        self.trip(Alarm::new(Condition::SpindleTooSlow, place, place.block).with([rpm, reached, 0.0]));
        self.machine.stop_spindle(now, &mut self.events);
        true
    }

    /// No look is needed before this time, s.
    pub(super) fn next_trip(&self) -> f64 {
        let spindle = self.machine.spindle().gives_up().map_or(f64::INFINITY, |(at, _)| at.0);
        let at = self.late_logic().map_or(spindle, |late| spindle.min(late.at));
        if self.alarm.is_none() && self.powered { at } else { f64::INFINITY }
    }

    /// What the builder's logic will give up, or has.
    fn late_logic(&self) -> Option<LogicAlarm> {
        if self.alarm.is_some() || !self.powered { None } else { self.machine.logic_gives_up() }
    }

    /// The builder's logic has waited too long, or does not know where to turn to.
    fn give_logic_up(&mut self, late: &LogicAlarm) {
        let place = late.place.unwrap_or_else(|| self.place_at_work());
        let condition = match late.wait {
            Some(_) => Condition::LogicTimeOut,
            None => Condition::LogicPositionMissing,
        };
        let values = values_of(late.code, late.wait.unwrap_or(0.0));
        self.trip(Alarm::new(condition, place, place.block).with(values));
        let now = self.time();
        self.machine.drop_late_logic(now, &mut self.events);
    }

    /// Steps and outputs of the builder's logic when something ends them.
    pub(super) fn end_logic(&mut self, fate: LogicFate) {
        let now = self.time();
        self.machine.end_logic(fate, now, &mut self.events);
    }

    /// The overtravel switches, each servo period while the axes move.
    pub(super) fn look_at_switches(&mut self) {
        let Some(setpoint) = self.setpoint() else { return };
        let now = self.time();
        let onto = self.machine.look_at_switches(&setpoint.position, &setpoint.velocity, now, &mut self.events);
        if onto.is_some() && self.tripped.is_none() {
            self.tripped = onto;
        }
    }

    /// RESET: what a script broke is whole again.
    pub(super) fn mend(&mut self) {
        // A switch that an axis has run onto while it came to stand for the RESET stops nothing any more.
        self.tripped = None;
        let own = self.configuration.machine.limit_switches().len();
        let now = self.time();
        self.machine.keep_switches(own, now, &mut self.events);
        if self.machine.spindle().is_weak() {
            self.machine.set_spindle_weak(false, now, &mut self.events);
        }
        self.machine.mend_logic(now, &mut self.events);
    }

    /// The block at which the power would interrupt a program, or has interrupted it.
    pub fn at_work(&self) -> Option<Place> {
        self.interrupted.or_else(|| self.is_running().then(|| self.place()))
    }

    /// The power comes back after it failed while this block was being executed.
    pub fn come_back_from(&mut self, place: Place) {
        self.power_off();
        self.interrupted = Some(place);
        self.power_on();
    }

    /// The power is back after it failed: what was interrupted is said.
    pub(super) fn tell_of_power_failure(&mut self) {
        if let Some(place) = self.interrupted.take() {
            let values = [place.line as f64, 0.0, 0.0];
            self.raise(Alarm::new(Condition::PowerFailed, place, place.block).with(values));
        }
    }
}
