//! What brings the control into another state than a program does: power, RESET, emergency stop, the end of a program.

use base::{AXES, Alarm, AxisSet, Condition, Place};
use dialect::{Fate, Occasion, StateItem};
use machine::{EventKind, LogicFate, Machine, ResetCause};

use super::Session;
use crate::library::Library;

impl<L: Library> Session<L> {
    /// RESET: whatever runs is dropped, an alarm is cleared, the table of states is applied.
    pub fn reset(&mut self) {
        self.reset_by(ResetCause::Key);
    }

    /// As [`Session::reset`], by another key.
    pub fn reset_by(&mut self, cause: ResetCause) {
        self.break_off();
        self.change_states(Occasion::Reset, cause);
        self.forget_typed();
    }

    /// The emergency stop button is pressed: the drives are off, and the counters follow the axes.
    pub fn press_emergency_stop(&mut self) {
        self.break_off();
        let place = if self.is_running() { self.place() } else { Place::default() };
        let alarm = Alarm::new(Condition::EmergencyStop, place, place.block);
        self.emergency = true;
        self.settle();
        let now = self.time();
        self.machine.stop_spindle(now, &mut self.events);
        self.tell(place, EventKind::Alarm(alarm));
        self.change_states(Occasion::EmergencyStop, ResetCause::EmergencyStop);
        self.forget_typed();
        self.alarm = Some(alarm);
    }

    /// The emergency stop button is released; its alarm stands until RESET.
    pub fn release_emergency_stop(&mut self) {
        self.emergency = false;
    }

    /// True while the emergency stop button is pressed.
    pub fn emergency_stop(&self) -> bool {
        self.emergency
    }

    /// The power goes off: what is under way is lost, what the memory keeps is kept.
    pub fn power_off(&mut self) {
        self.break_off();
        // A switch that an axis has run onto while it came to stand raises nothing without power.
        self.tripped = None;
        let now = self.time();
        self.machine.stop_spindle(now, &mut self.events);
        self.interpreter_mut().store_codes();
        self.drop_work();
        self.end_logic(LogicFate::Off);
        self.come_back();
        self.forget_typed();
        self.alarm = None;
        self.powered = false;
    }

    /// The power comes back. The axes stand where they stood.
    pub fn power_on(&mut self) {
        self.powered = true;
        self.end_logic(LogicFate::Initial);
        self.settle();
        self.unseen = [0.0; AXES];
        let position = *self.machine.position();
        self.motion.upstream.stand_at(&position);
        self.interpreter_mut().reset(Occasion::PowerOn, &position, false);
        self.rewound = true;
        self.look_for_label(Occasion::PowerOn);
        self.pass_overrides();
        self.tell_of_power_failure();
        if self.emergency {
            let alarm = Alarm::new(Condition::EmergencyStop, Place::default(), Place::default().block);
            self.tell(alarm.place, EventKind::Alarm(alarm));
            self.alarm = Some(alarm);
        }
    }

    /// True while the control has power.
    pub fn is_powered(&self) -> bool {
        self.powered
    }

    /// True from FEED HOLD to CYCLE START or RESET.
    pub fn is_held(&self) -> bool {
        self.feed_held
    }

    /// The interrupt input has turned on: if the program allows it, the rest of the block that runs is dropped and the
    /// program goes on elsewhere.
    pub(super) fn interrupt(&mut self) {
        if !self.is_running() || self.stopped {
            return;
        }
        let under_way = self.under_way.is_some() || self.dwelling.is_some() || self.is_moving();
        if under_way && self.interpreter().executing_state().interrupt.is_some() {
            self.break_off();
        }
        let (position, place) = (self.counted_position(), self.place());
        let begun = !self.pulled || self.begun == Some(self.motion.upstream.current().block);
        if !self.interpreter_mut().interrupt(&position, begun) {
            return;
        }
        self.codes.clear();
        self.closing = None;
        self.motion.upstream.stand_at(&position);
        self.between_blocks = true;
        self.pulled = false;
        self.told = None;
        if begun {
            self.machine.finish_block(&place, true, &mut self.events);
        }
    }

    pub(super) fn change_states(&mut self, occasion: Occasion, cause: ResetCause) {
        // A block that the axes are still on their way to has not begun either.
        let refused = self.alarm.is_some() || self.approach.is_some();
        // The block that was executed last belongs to it only while its program runs or ends by it.
        let belongs = self.is_running() || occasion == Occasion::ProgramEnd;
        let place = if belongs { self.place() } else { Place::default() };
        self.drop_work();
        let position = self.counted_position();
        self.motion.upstream.stand_at(&position);
        self.interpreter_mut().reset(occasion, &position, refused);
        // What was to be returned and has not arrived is not.
        let unfound = std::mem::replace(&mut self.unfound, AxisSet::NONE);
        if !unfound.is_empty() {
            self.interpreter_mut().lose_reference_points(unfound);
        }
        if occasion != Occasion::ProgramEnd && self.inputs.rwd == Some(true) {
            // The rewind input is held on: not only an end of a program rewinds.
            self.interpreter_mut().rewind();
            self.rewound = true;
        }
        self.look_for_label(occasion);
        self.alarm = None;
        if occasion != Occasion::ProgramEnd {
            let logic = &self.configuration.machine.logic;
            let fate = if occasion == Occasion::EmergencyStop { logic.emergency_stop } else { logic.reset };
            self.end_logic(fate);
            self.mend();
        }
        let groups = self.interpreter().read_state().groups;
        self.tell(place, EventKind::Reset { cause, groups });
    }

    /// Another program takes the place of this one. What was read ahead of an alarm or of a program broken off was never
    /// executed; of a program that has ended nothing is left but the codes in force and, under compensation, the tool
    /// beside its programmed place.
    pub(super) fn leave_program(&mut self) {
        if self.ended {
            self.settle_displacement();
        }
        let (mut position, refused) = (self.counted_position(), self.alarm.is_some());
        if self.ended && !refused {
            position = self.motion.upstream.programmed(&position);
        } else {
            self.motion.upstream.stand_at(&position);
        }
        self.interpreter_mut().restore(&position, refused);
    }

    /// LABEL SKIP, as the table of states says.
    fn look_for_label(&mut self, occasion: Occasion) {
        let interpreter = self.interpreter();
        let fate = interpreter.fitting().fate(interpreter.control(), StateItem::LabelSkip, occasion);
        self.label_skip |= fate == Fate::Initial;
    }

    /// True while LABEL SKIP is on.
    pub fn label_skip(&self) -> bool {
        self.label_skip
    }

    /// As far as the control counts, the axes are where they are.
    pub(super) fn settle_counters(&mut self) {
        let position = self.counted_position();
        self.motion.upstream.stand_at(&position);
    }

    /// The counters of all axes are set to where the axes are.
    fn settle(&mut self) {
        let axes = self.configuration.machine.travel().axes;
        self.lock.settle(axes);
    }

    /// Whatever is under way is dropped.
    fn drop_work(&mut self) {
        self.machine.drop_codes(&mut self.events);
        self.closing = None;
        self.approach = None;
        self.awaited = false;
        self.codes.clear();
        self.between_blocks = true;
        self.pulled = false;
        self.told = None;
        self.stopped = false;
        self.feed_held = false;
        self.ended = true;
    }
}
