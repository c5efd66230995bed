//! A dwell takes its time: the operator can step in, FEED HOLD interrupts it, CYCLE START lets the rest of it pass.

use base::Seconds;
use machine::Machine;

use super::Session;
use crate::library::Library;

impl<L: Library> Session<L> {
    /// A dwell begins.
    pub(super) fn begin_dwell(&mut self) -> bool {
        let place = self.motion.upstream.current().place;
        self.machine.wait_to_move(&place, &mut self.events);
        self.dwelling = Some(0.0);
        true
    }

    /// The dwell goes on to its end or the end of the time; false if nothing more comes of it.
    pub(super) fn go_on_dwelling(&mut self) -> bool {
        let Some(elapsed) = self.dwelling else { return true };
        let (since, duration) = (self.machine.time().0, self.motion.current().duration.0);
        let until = self.deadline.map_or(f64::INFINITY, |deadline| deadline.0).min(self.next_trip());
        if since + duration.max(elapsed) <= until {
            // Dwells are counted in turns of the spindle too: turned up on the way, it has turned often enough sooner.
            self.machine.stand_until(Seconds(since + (elapsed - duration).max(0.0)), &mut self.events);
            self.dwelling = None;
            self.perform_shape();
            return true;
        }
        self.dwelling = Some(elapsed.max(until - since));
        let now = self.time();
        self.machine.pass_signals(now, &mut self.events);
        self.next_trip() <= now.0
    }

    /// Time passes in which what is under way stands still.
    pub(super) fn stand(&mut self, until: Seconds) {
        let longer = (until.0 - self.time().0).max(0.0);
        match &mut self.under_way {
            Some(under_way) => under_way.stand(longer),
            None => {
                self.machine.pass_signals(until, &mut self.events);
                let since = self.machine.time() + Seconds(longer);
                self.machine.stand_until(since, &mut self.events);
                return;
            }
        }
        self.machine.pass_signals(until, &mut self.events);
    }

    /// What is left of the dwell becomes one of its own: the axes are moved by hand before it.
    pub(super) fn part_dwell(&mut self) {
        let Some(elapsed) = self.dwelling else { return };
        let duration = self.motion.current().duration.0;
        self.break_off_dwell();
        let left = if duration > 0.0 { (1.0 - elapsed / duration).max(0.0) } else { 0.0 };
        self.motion.upstream.keep_share(left);
        self.pulled = true;
    }

    /// What is left of the dwell is dropped; the time has passed.
    pub(super) fn break_off_dwell(&mut self) {
        if let Some(elapsed) = self.dwelling.take() {
            let now = self.machine.time() + Seconds(elapsed);
            self.machine.stand_until(now, &mut self.events);
        }
    }
}
