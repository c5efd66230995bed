//! What happens, handed out: one event after the other, or all that a step has brought about at once.

use machine::{Event, EventKind};

use super::{Session, Step};
use crate::library::Library;

impl<L: Library> Session<L> {
    /// The next thing that happens.
    #[expect(clippy::should_implement_trait, reason = "it never ends for good: an operator can start again")]
    pub fn next(&mut self) -> Step {
        loop {
            if let Some(event) = self.next_told() {
                return Step::Event(event);
            }
            if let Some(step) = self.go_on() {
                return step;
            }
        }
    }

    /// As [`Session::next`] for whoever takes many events: what happened next, all of it at once, changes places with
    /// `told`, which is empty. `Some` if nothing happens, and why.
    pub fn next_events(&mut self, told: &mut Vec<Event>) -> Option<Step> {
        while self.has_told_all() {
            self.forget_told();
            if let Some(step) = self.go_on() {
                return Some(step);
            }
        }
        self.events.drain(..self.handed_out);
        self.handed_out = 0;
        std::mem::swap(&mut self.events, told);
        None
    }

    /// Goes on by a shape or an answer; `Some` where nothing happens by itself.
    #[inline]
    fn go_on(&mut self) -> Option<Step> {
        if let Some(error) = self.failed.take() {
            self.ended = true;
            return Some(Step::Failed(error));
        }
        if self.look_for_trips() {
            return None;
        }
        if self.by_hand.is_some() && (!self.stopped || !self.is_searching()) {
            return if self.go_on_by_hand() { None } else { Some(Step::Idle) };
        }
        if self.stopped {
            return Some(Step::Stopped);
        }
        if self.ended || self.alarm.is_some() || self.goes_round() || self.is_time_up() {
            return Some(Step::Idle);
        }
        if self.goes_on_approaching() {
            return None;
        }
        if self.closing.is_some() {
            let still = !self.go_on_closing() && self.has_told_all() && self.next_trip() > self.time().0;
            return still.then_some(Step::Idle);
        }
        if self.dwelling.is_some() {
            return if self.go_on_dwelling() { None } else { Some(Step::Idle) };
        }
        if self.under_way.is_some() {
            return if self.go_on_moving() { None } else { Some(Step::Idle) };
        }
        if self.pull() {
            if self.waits_for_tape() {
                self.pulled = true;
                return self.has_told_all().then_some(Step::Idle);
            }
            self.pulled = self.stands_still() || self.alarm.is_some();
            let held = self.pulled || self.live && self.takes_waiting_hold();
            if !held && self.waits_for_machine() {
                self.pulled = true;
                let still = self.has_told_all() && self.next_trip() > self.time().0;
                return still.then_some(Step::Idle);
            }
            if !held {
                self.execute();
            } else if self.has_told_all() {
                return Some(Step::Idle);
            }
        }
        None
    }

    /// What has happened and not been handed out yet, without letting time pass.
    pub fn next_told(&mut self) -> Option<Event> {
        let event = self.events.get(self.handed_out).copied();
        self.handed_out += 1;
        if let Some(Event { time, kind: EventKind::Alarm(alarm), .. }) = &event {
            self.note_alarm(alarm, *time);
        }
        if event.is_none() {
            self.forget_told();
        }
        event
    }

    pub(super) fn forget_told(&mut self) {
        self.events.clear();
        self.handed_out = 0;
    }

    pub(super) fn has_told_all(&self) -> bool {
        self.handed_out == self.events.len()
    }
}
