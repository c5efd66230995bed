//! Time as it passes at the machine: a move is under way from its first setpoint to its last, and the operator can
//! step in anywhere between.
//!
//! Dwells (`dwelling.rs`) and the answers to codes (`awaiting.rs`) take their time too.

use base::{AXES, AxisSet, Point, Seconds};
use machine::{Drives, Machine, StopCause};
use motion::{Setpoint, Timed};
use path::Shape;

use super::by_hand::ByHand;
use super::{Session, Step};
use crate::library::Library;

/// A move of which something is left.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct UnderWay {
    /// Time since it began, stops on the way counted in, s.
    elapsed: f64,
    /// Time in which the axes were driven, s.
    driven: f64,
}

/// Nearer to its end a move is over, mm or degrees.
const NEAR: f64 = 1e-7;
/// The part of a servo period by which a time may miss a setpoint's and still be it.
const ON_THE_DOT: f64 = 1e-6;
/// A look whether the axes still move, s.
const STRIDE_S: f64 = 1.0;

impl UnderWay {
    /// Time passes while the axes stand on the way.
    pub fn stand(&mut self, longer: f64) {
        self.elapsed += longer;
    }
}

impl<L: Library> Session<L> {
    /// Moves take their time, and can be broken into: what an operator needs.
    pub fn run_live(&mut self) {
        self.plan_ahead();
        self.live = true;
        self.attended = true;
    }

    /// As [`Session::next`], but no farther than to this time; `None` when it has come.
    pub fn next_until(&mut self, time: Seconds) -> Option<Step> {
        self.deadline = Some(time);
        let step = self.next();
        let is_up = self.is_time_up() && step == Step::Idle;
        self.deadline = None;
        (!is_up).then_some(step)
    }

    /// True if the time that was given is over: but for rounding, which leaves less than can be added to the time.
    pub(super) fn is_time_up(&self) -> bool {
        let now = self.time().0 + ON_THE_DOT * self.servo_period;
        self.deadline.is_some_and(|deadline| now >= deadline.0)
    }

    /// Where the axes are and how fast, while a move is under way.
    pub fn setpoint(&self) -> Option<Setpoint> {
        match &self.by_hand {
            Some(by_hand) => Some(by_hand.setpoint()),
            None => self
                .under_way
                .and_then(|_| self.motion.setpoint())
                .map(|setpoint| Setpoint { position: self.lock.uncounted(&setpoint.position), ..setpoint }),
        }
    }

    /// What is left of the move under way, mm and degrees.
    pub fn distance_to_go(&self) -> Point {
        if let Some(by_hand) = &self.by_hand {
            return by_hand.distance_to_go();
        }
        let position = match self.setpoint() {
            Some(setpoint) => setpoint.position,
            None if self.pulled && self.motion.upstream.is_rest() => self.position(),
            None => return [0.0; AXES],
        };
        let to = match &self.motion.upstream.current().shape {
            Shape::Rapid { to, .. } | Shape::Line { to, .. } => *to,
            Shape::Arc { arc, .. } => arc.to,
            _ => return [0.0; AXES],
        };
        let counted = self.lock.counted(&position);
        std::array::from_fn(|axis| to[axis] - counted[axis])
    }

    /// True while G28 sends axes to their reference points.
    pub(super) fn is_searching(&self) -> bool {
        self.by_hand.as_ref().is_some_and(ByHand::is_of_program)
    }

    /// True while the axes move.
    pub fn is_moving(&self) -> bool {
        self.live && (!self.motion.is_standing() || self.is_searching())
    }

    /// Something is to be touched that what follows depends on: the axes stand at the end of the first move at whose
    /// end they can.
    pub fn stand_soon(&mut self) {
        self.motion.stand_soon();
        self.rehearsal = None;
    }

    /// Time passes in which nothing happens.
    pub fn let_time_pass(&mut self, until: Seconds) {
        if let Some(by_hand) = &mut self.by_hand {
            by_hand.stand(until.0 - self.machine.time().0);
        } else {
            let trip = self.next_trip();
            if trip <= until.0 {
                self.stand(Seconds(trip));
                self.look_for_trips();
            }
            self.stand(until);
        }
    }

    /// The time since the move under way began.
    pub(super) fn elapsed(&self) -> f64 {
        let under_way = self.under_way.map(|under_way| under_way.elapsed);
        under_way.or(self.dwelling).or(self.by_hand.as_ref().map(ByHand::elapsed)).unwrap_or(0.0)
    }

    /// A move that takes its time begins; false if it is executed as a whole.
    pub(super) fn begin_move(&mut self) -> bool {
        let shaped = self.motion.upstream.current();
        let place = shaped.place;
        let is_led = !shaped.until_signal || self.machine.awaits_skip();
        // Axes that were moved by hand without being counted make the same way, elsewhere.
        let is_whole = self.lock.held.is_empty() && self.returned().is_empty() && !self.in_force.display_lock;
        let real = self.real_shape();
        let ends_by_itself = is_led && (is_whole || real.is_none());
        let is_known = !self.motion.is_joined() || self.motion.knows_next();
        let cannot_end = match &real {
            Some(shaped) => self.machine.cannot_end(&Timed { shaped, ..self.motion.current() }),
            None => self.machine.cannot_end(&self.motion.current()),
        };
        // A cut of no length is no way for the planner: the rest of one that was held at its very end.
        let cuts = matches!(shaped.shape, Shape::Line { .. } | Shape::Arc { .. });
        let is_none = cuts && !self.motion.is_joined();
        if !ends_by_itself || !is_known || cannot_end || is_none {
            self.motion.plan();
            return false;
        }
        self.machine.wait_to_move(&place, &mut self.events);
        self.motion.begin();
        self.under_way = Some(UnderWay { elapsed: 0.0, driven: 0.0 });
        true
    }

    /// Lets the move under way go on to its end or the end of the time; false if nothing more comes of it.
    pub(super) fn go_on_moving(&mut self) -> bool {
        loop {
            let stride = self.machine.time().0 + self.elapsed() + STRIDE_S;
            let stride = stride.min(self.next_trip());
            if self.drive(self.deadline.map_or(stride, |deadline| deadline.0.min(stride))) {
                self.complete();
                return true;
            }
            if self.tripped.is_some() || self.next_trip() <= self.time().0 {
                return true;
            }
            if self.is_time_up() || self.motion.is_standing() {
                return false;
            }
        }
    }

    /// Drives the move under way until then, at most to its end; true if that is reached. Setpoints on the way go to the
    /// machine, if it takes them.
    fn drive(&mut self, until: f64) -> bool {
        let looks = !self.machine.switches().is_empty();
        if self.machine.drives().is_none() && !looks {
            return self.drive_on(until);
        }
        loop {
            let next = self.next_setpoint();
            let ended = self.drive_on(next.min(until));
            if ended || next > until {
                return ended;
            }
            if let Some(setpoint) = self.setpoint() {
                self.machine.follow(Seconds(next), &setpoint);
            }
            if looks {
                self.look_at_switches();
                if self.tripped.is_some() {
                    return false;
                }
            }
        }
    }

    /// When the next setpoint holds, s.
    pub(super) fn next_setpoint(&self) -> f64 {
        let period = self.servo_period;
        ((self.time().0 / period + ON_THE_DOT).floor() + 1.0) * period
    }

    fn drive_on(&mut self, until: f64) -> bool {
        let Some(under_way) = &mut self.under_way else { return true };
        let seconds = (until - self.machine.time().0 - under_way.elapsed).max(0.0);
        let (left, ended) = self.motion.drive_for(seconds);
        let driven = if ended { seconds - left } else { seconds };
        under_way.elapsed += driven;
        under_way.driven += driven;
        let now = self.time();
        self.machine.pass_signals(now, &mut self.events);
        ended
    }

    /// The axes have come to stand: the drives are sent where.
    pub(super) fn come_to_stand(&mut self) {
        if self.machine.drives().is_some() && self.motion.is_standing() {
            let (period, position) = (self.servo_period, *self.machine.position());
            let next = (self.time().0 / period - ON_THE_DOT).ceil() * period;
            self.machine.follow(Seconds(next), &Setpoint { position, velocity: [0.0; AXES] });
        }
    }

    /// Setpoints go to the machine every servo period, in steps of `increment`, mm or degrees; [`Session::drives`] shows
    /// what came of them.
    pub fn drive_in(&mut self, increment: f64) {
        self.machine.drive_in(increment);
    }

    /// From one setpoint to the next, s.
    pub fn servo_period(&self) -> f64 {
        self.servo_period
    }

    /// What the machine's drives have been sent.
    pub fn drives(&self) -> Option<&Drives> {
        self.machine.drives()
    }

    /// The skip signal has come in the move that waits for it: the move ends there.
    pub(super) fn skip_move_under_way(&mut self) {
        if !self.motion.upstream.current().until_signal || self.under_way.is_none() {
            return;
        }
        let at = self.setpoint().map(|setpoint| setpoint.position);
        self.machine.skip_at(at);
        self.complete();
        self.machine.skip_at(None);
        self.motion.drop_rest();
    }

    /// The move under way has ended.
    fn complete(&mut self) {
        let Some(UnderWay { elapsed, .. }) = self.under_way.take() else { return };
        self.motion.end(elapsed);
        self.perform_shape();
        self.come_to_stand();
    }

    /// The axes come to stand as fast as they can, from the next setpoint on; moves that end on the way are executed.
    pub(super) fn brake(&mut self) {
        let period = self.servo_period;
        if self.under_way.is_some() {
            let now = self.time().0;
            let setpoint = (now / period - ON_THE_DOT).ceil() * period;
            self.let_pass(setpoint);
            // What stands by an override at zero is held too.
            self.motion.hold(true);
        }
        while self.is_moving() && !self.stopped && self.alarm.is_none() {
            self.motion.hold(true);
            if self.under_way.is_some() {
                let now = self.time().0;
                self.let_pass(now + period);
            } else if self.pull() {
                self.pulled = false;
                self.execute();
            } else {
                break;
            }
        }
    }

    /// Time passes until then, or the move ends.
    fn let_pass(&mut self, until: f64) {
        if self.drive(until) {
            self.complete();
        }
    }

    /// True while axes are driven, by a program or by hand.
    pub fn is_driven(&self) -> bool {
        self.by_hand.as_ref().map_or_else(|| self.is_moving(), ByHand::moves)
    }

    /// True if it is just time for a setpoint.
    pub fn is_at_setpoint(&self) -> bool {
        let periods = self.time().0 / self.servo_period;
        (periods - periods.round()).abs() < ON_THE_DOT
    }

    /// The axes shall stand as soon as they can.
    pub fn slow_down(&mut self) {
        match &mut self.by_hand {
            Some(by_hand) => by_hand.slow_down(),
            None => self.motion.hold(true),
        }
    }

    /// FEED HOLD: the axes come to stand, the rest of the move is kept. In tapping it waits for the end of the retract.
    pub fn feed_hold(&mut self) {
        if self.is_searching() {
            self.hold_by_hand();
        } else if self.by_hand.is_some() {
            self.stop_by_hand();
            return self.hold_approach();
        }
        if self.is_tapping() {
            self.hold_waits = true;
            return;
        }
        if !self.is_searching() {
            self.brake();
        }
        self.hold_waits = false;
        if self.stopped || self.alarm.is_some() || self.ended {
            return;
        }
        let place = self.place();
        self.stopped = true;
        self.feed_held = true;
        self.tell(place, machine::EventKind::Stop(StopCause::FeedHold));
    }

    /// The move under way goes on.
    pub(super) fn release(&mut self) {
        self.motion.hold(false);
        if let Some(by_hand) = &mut self.by_hand {
            by_hand.hold(false);
        }
    }

    /// True while a tap is in the hole.
    pub fn is_tapping(&self) -> bool {
        self.live && self.tapping
    }

    /// A FEED HOLD that has waited for the end of tapping takes effect; true if it does.
    pub(super) fn takes_waiting_hold(&mut self) -> bool {
        let shaped = self.motion.upstream.current();
        let taps = match &shaped.shape {
            Shape::Line { feed, .. } | Shape::Arc { feed, .. } => Some(feed.tapping),
            Shape::Rapid { .. } | Shape::Close(_) => Some(false),
            _ => None,
        };
        self.tapping = taps.unwrap_or(self.tapping);
        if self.tapping || !self.hold_waits {
            return false;
        }
        // What comes next has been pulled and waits for CYCLE START.
        self.pulled = true;
        self.feed_hold();
        true
    }

    /// What is left of the move under way is dropped; the axes stand where they are, and it is told.
    pub(super) fn break_off(&mut self) {
        self.hold_waits = false;
        self.tapping = false;
        self.stop_by_hand();
        self.break_off_dwell();
        self.brake();
        self.end_here();
    }

    /// What is left of the move under way becomes a move of its own: the axes are moved by hand before it.
    pub(super) fn part_move(&mut self) {
        self.part_dwell();
        if self.is_at_end() {
            return self.complete();
        }
        if let Some(at) = self.end_here() {
            self.motion.upstream.keep_rest(&at);
            self.pulled = true;
            self.rehearsal = None;
        }
    }

    /// True if the move under way has been held just where it ends.
    fn is_at_end(&self) -> bool {
        let (Some(under_way), Some(setpoint)) = (&self.under_way, self.motion.setpoint()) else { return false };
        let (from, to) = match &self.motion.upstream.current().shape {
            Shape::Rapid { from, to, .. } | Shape::Line { from, to, .. } => (from, to),
            Shape::Arc { arc, .. } => (&arc.from, &arc.to),
            _ => return false,
        };
        let at = &setpoint.position;
        let near = |point: &Point| (0..AXES).all(|axis| (at[axis] - point[axis]).abs() < NEAR);
        // A full circle ends where it began: one period farther the axes are elsewhere.
        near(to) && (!near(from) || under_way.driven >= self.servo_period)
    }

    /// The move under way is executed as far as it has come; where the control counts the axes then.
    fn end_here(&mut self) -> Option<Point> {
        let Some(UnderWay { elapsed, .. }) = self.under_way.take() else {
            self.motion.drop_rest();
            return None;
        };
        let at = self.motion.setpoint().map(|setpoint| setpoint.position);
        let mut shaped = *self.motion.upstream.current();
        self.motion.end(elapsed);
        if let Some(at) = at {
            shaped.shape = shaped.shape.up_to(&at);
            let length = self.motion.time(&shaped).length;
            if self.lock.acts() {
                shaped.shape = self.lock.real(&shaped.shape, self.machine.position(), AxisSet::NONE);
            }
            let timed = motion::Timed { shaped: &shaped, ..self.motion.current() };
            let timed = motion::Timed { length, ..timed };
            // What could not be made as a whole was refused before it began.
            let _ = self.machine.execute(&timed, &mut self.events);
        }
        self.motion.drop_rest();
        at
    }
}
