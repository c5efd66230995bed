//! Actions that last: `run`, a button pressed for a time, an increment. They go on to their end at once, or with the time
//! that passes on a clock.

use base::Seconds;
use dialect::Key;
use machine::EventKind;

use super::{Operator, Said};
use crate::action::{Action, Until};
use crate::library::{LibraryError, Shelf};
use crate::session::{Session, Step};

/// An action that has begun.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Lasting {
    until: Until,
    /// When it ends, if it is a matter of time.
    end: Option<Seconds>,
    /// An axis' button is let go at its end.
    presses: bool,
    /// The axes come to stand, and then this is done.
    stops_for: Option<Action>,
}

impl<L: Shelf> Operator<L> {
    /// True while an action lasts.
    pub fn is_busy(&self) -> bool {
        self.lasting.is_some()
    }

    /// Time passes by a clock: axes that an action stops take their time to stand, and the action lasts as long.
    pub fn run_by_the_clock(&mut self) {
        self.by_the_clock = true;
    }

    /// The action stops the axes first; true if that takes time.
    pub(super) fn stops_first(&mut self, action: &Action) -> bool {
        let stops = match action {
            Action::FeedHold => {
                let lets = self.session.interpreter().executing_state().feed_control & 1 == 0;
                lets && !self.session.is_tapping()
            }
            Action::Reset | Action::EmergencyStop | Action::PowerOff => true,
            Action::Key(name) => self.key(name) == Some(&Key::Reset),
            _ => false,
        };
        if !(self.by_the_clock && stops && self.session.is_driven()) {
            return false;
        }
        self.lasting = Some(Lasting { until: Until::Idle, end: None, presses: false, stops_for: Some(action.clone()) });
        true
    }

    /// What lasts is given up; an axis' button is let go.
    pub fn give_up(&mut self) {
        if self.lasting.take().is_some_and(|lasting| lasting.presses) {
            self.session.stop_by_hand();
        }
    }

    pub(super) fn last(&mut self, until: &Until, presses: bool) {
        let end = match until {
            Until::Seconds(seconds) => Some(self.session.time() + Seconds(*seconds)),
            _ => None,
        };
        self.lasting = Some(Lasting { until: until.clone(), end, presses, stops_for: None });
    }

    /// Lets time pass until the action that lasts has ended, at most to `limit`; true if that is not reached.
    ///
    /// Where no action lasts, the time passes to `limit`.
    ///
    /// # Errors
    /// A text could not be read.
    pub fn go_on(
        &mut self,
        limit: Option<Seconds>,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<bool, LibraryError> {
        let ended = self.pass(limit, tell)?;
        let presses = self.lasting.as_ref().is_some_and(|lasting| lasting.presses);
        if ended && presses && self.stops_first(&Action::FeedHold) {
            // Let go, the axis takes its time to stand.
            return self.go_on(limit, tell);
        }
        if ended {
            let stops_for = self.lasting.as_mut().and_then(|lasting| lasting.stops_for.take());
            self.give_up();
            if let Some(action) = stops_for {
                // It was not refused when it began.
                let _ = self.act(&action, tell)?;
            }
        }
        self.settle(tell)?;
        Ok(ended)
    }

    fn pass(
        &mut self,
        limit: Option<Seconds>,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<bool, LibraryError> {
        let stops = self.lasting.as_ref().is_some_and(|lasting| lasting.stops_for.is_some());
        // A program's axes are stopped from one setpoint to the next, not between them.
        let slows = stops && (self.session.is_moved_by_hand() || self.session.is_at_setpoint());
        let (until, end) = match &self.lasting {
            Some(Lasting { until, end, .. }) => (until.clone(), *end),
            None => (Until::Seconds(0.0), limit),
        };
        let to = match (end, limit) {
            (Some(end), Some(limit)) => Some(Seconds(end.0.min(limit.0))),
            (end, limit) => end.or(limit),
        };
        let in_time = self.lasting.is_some() && end.is_some_and(|end| Some(end) == to);
        loop {
            if slows {
                self.session.slow_down();
                if !self.session.is_driven() {
                    return Ok(true);
                }
            }
            self.take_waiting(tell)?;
            if let Until::Line(line) = until
                && self.session.line_begins().is_some_and(|place| place.line == line)
            {
                return Ok(true);
            }
            let step = match to {
                Some(to) => self.session.next_until(to),
                None => Some(self.session.next()),
            };
            let event = match (step, to) {
                (Some(Step::Event(event)), _) => event,
                (Some(Step::Failed(error)), _) => return Err(error),
                // It would wait for ever: nobody presses CYCLE START while this action lasts.
                (Some(Step::Stopped | Step::Idle), _) if end.is_none() => return Ok(true),
                (_, Some(to)) => {
                    self.session.let_time_pass(to);
                    return Ok(in_time);
                }
                (_, None) => return Ok(true),
            };
            tell(&mut self.session, Said::Event(event));
            let done = match (&until, event.kind) {
                (Until::Stop, EventKind::Stop(_))
                | (Until::Alarm, EventKind::Alarm(_))
                // What its end brings about is told with it.
                | (Until::End, EventKind::End { .. }) => true,
                _ => false,
            };
            if done {
                return Ok(true);
            }
        }
    }
}
