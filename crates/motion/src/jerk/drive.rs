//! Forwards: the plan runs ahead, and its mean over the window is driven, a whole move or a servo period at a time.

use std::collections::VecDeque;

use base::{AXES, Point};

use super::plan::{Legs, Plan, slow_down, speed_up};
use super::{JerkHorizon, Piece};
use crate::horizon::{Leg, Setpoint};
use crate::stroke::Stroke;
use crate::way::Way;

/// Steps in which the time is found at which a place is passed.
const STEPS: usize = 60;
/// Of the time looked for, what is near enough.
const NEAR: f64 = 1e-15;

/// What the plan did in the last window: a time of constant acceleration.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Past {
    speed: f64,
    acceleration: f64,
    seconds: f64,
}

/// How far the first piece has been driven.
#[derive(Clone, Debug, Default)]
pub(super) struct Drive {
    plan: Plan,
    /// The last window, its first entry as far as not forgotten; empty between runs.
    past: VecDeque<Past>,
    window: f64,
    stroke: Option<Stroke>,
    /// Where the axes are: place on the first piece's way, speed, acceleration.
    here: Leg,
    /// The leg being driven, whether the first piece ends with it, and the time spent in it.
    leg: Option<(Leg, bool)>,
    spent: f64,
    held: bool,
}

impl Drive {
    pub(super) fn clear(&mut self) {
        self.past.clear();
        let past = std::mem::take(&mut self.past);
        *self = Drive { past, ..Drive::default() };
    }

    /// The present leg as far as it is not driven, or where the axes stand.
    fn now(&self) -> Leg {
        let Some((leg, _)) = &self.leg else { return self.here };
        let (s, speed) = leg.at(self.spent);
        let acceleration = leg.acceleration + leg.jerk * self.spent;
        Leg { s, speed, acceleration, jerk: leg.jerk, seconds: leg.seconds - self.spent }
    }

    /// The plan's acceleration, and how long it stays so.
    fn ahead(&self) -> (f64, f64) {
        match self.plan.legs.get(self.plan.leg) {
            Some(leg) => (leg.acceleration, leg.seconds - self.plan.spent),
            None => (0.0, f64::INFINITY),
        }
    }

    /// The leg that the mean drives next.
    fn mean(&self) -> Option<Leg> {
        let first = self.past.front()?;
        let (acceleration, seconds) = self.ahead();
        let jerk = (acceleration - first.acceleration) / self.window;
        let mut leg = Leg {
            s: self.here.s,
            speed: self.here.speed,
            acceleration: (self.plan.speed - first.speed) / self.window,
            jerk,
            seconds: seconds.min(first.seconds),
        };
        if self.past.len() == 1 {
            // One leg fills the window: its mean is known anew.
            leg.speed = (first.speed + self.plan.speed) / 2.0;
        }
        leg.speed = leg.speed.max(0.0);
        Some(leg)
    }

    fn stands(&self) -> bool {
        let rests = |past: &Past| past.speed == 0.0 && past.acceleration == 0.0;
        self.plan.speed == 0.0
            && self.plan.leg >= self.plan.legs.count
            && self.past.len() == 1
            && self.past.iter().all(rests)
    }

    /// The plan and its past go on for a time in which neither changes its acceleration.
    fn advance(&mut self, seconds: f64) {
        let (acceleration, rest) = self.ahead();
        let speed = self.plan.speed;
        match self.past.back_mut() {
            Some(last) if last.acceleration == acceleration && (acceleration != 0.0 || last.speed == speed) => {
                last.seconds += seconds;
            }
            _ => self.past.push_back(Past { speed, acceleration, seconds }),
        }
        if let Some(leg) = self.plan.legs.get(self.plan.leg) {
            let spent = self.plan.spent + seconds;
            // Also where only the sum is rounded up to the whole leg: nothing is left of it then.
            if seconds >= rest || spent >= leg.seconds {
                (self.plan.s, self.plan.speed) = (leg.at(leg.seconds).0, self.plan.legs.speed);
                (self.plan.leg, self.plan.spent) = (self.plan.leg + 1, 0.0);
                if let Some(next) = self.plan.legs.get(self.plan.leg) {
                    (self.plan.s, self.plan.speed) = (next.s, next.speed);
                }
            } else {
                self.plan.spent = spent;
                (self.plan.s, self.plan.speed) = leg.at(spent);
            }
        }
        let Some(first) = self.past.front_mut() else { return };
        if seconds >= first.seconds {
            self.past.pop_front();
        } else {
            first.speed += first.acceleration * seconds;
            first.seconds -= seconds;
        }
    }
}

impl JerkHorizon {
    /// Drives to the end of the next move: how long that takes, s. `leg` is shown every leg on its way, with the
    /// squared speed that the axes allow there.
    pub fn drive_move(&mut self, mut leg: impl FnMut(&Way, f64, &Leg)) -> f64 {
        let mut seconds = 0.0;
        while self.begin() {
            let rest = self.drive.now();
            if rest.seconds > 0.0
                && let Some((piece, way)) = self.pieces.front().and_then(|piece| Some((piece, self.way(piece.way)?)))
            {
                leg(way, piece.own * piece.own, &rest);
            }
            seconds += rest.seconds;
            if self.end_leg() {
                break;
            }
        }
        seconds
    }

    /// Drives for a time, at most to the end of the next move: the time that is left over, and whether the move has
    /// ended.
    pub fn drive_for(&mut self, mut seconds: f64) -> (f64, bool) {
        while self.begin() {
            let rest = self.drive.now().seconds;
            if rest > seconds {
                self.drive.spent += seconds;
                return (0.0, false);
            }
            seconds -= rest;
            if self.end_leg() {
                return (seconds, true);
            }
        }
        // Held or at a feed of none: the time passes standing.
        (if self.is_empty() { seconds } else { 0.0 }, false)
    }

    /// Where the axes are now, and how fast; `None` if nothing is under way.
    pub fn setpoint(&self) -> Option<Setpoint> {
        let way = self.way(self.pieces.front()?.way)?;
        let Leg { s, speed, .. } = self.drive.now();
        Some(Setpoint { position: way.at(s), velocity: way.slope(s).map(|slope| slope * speed) })
    }

    /// The acceleration of every axis now, mm/s², and its jerk, mm/s³.
    pub fn acceleration_and_jerk(&self) -> (Point, Point) {
        let nothing = ([0.0; AXES], [0.0; AXES]);
        let Some(way) = self.pieces.front().and_then(|piece| self.way(piece.way)) else { return nothing };
        self.drive.now().on(way)
    }

    /// True if the axes stand.
    pub fn is_standing(&self) -> bool {
        let here = self.drive.now();
        here.speed <= 0.0 && here.acceleration == 0.0
    }

    /// The axes shall stand as soon as they can, or go on.
    pub fn hold(&mut self, held: bool) {
        if self.drive.held != held {
            self.cut_here();
            self.drive.held = held;
            if let Some(stroke) = &mut self.drive.stroke {
                stroke.hold(held);
            }
        }
    }

    /// What is planned in the present piece is dropped; it is planned anew from here.
    pub(super) fn cut_here(&mut self) {
        if self.drive.leg.is_some() {
            self.drive.here = self.drive.now();
            let spent = self.drive.spent;
            (self.drive.leg, self.drive.spent) = (None, 0.0);
            if let Some(stroke) = &mut self.drive.stroke {
                stroke.advance(spent);
            } else if spent > 0.0 {
                self.drive.advance(spent);
            }
        }
        let plan = &mut self.drive.plan;
        (plan.legs, plan.leg, plan.spent) = (Legs::default(), 0, 0.0);
    }

    /// The overrides have changed.
    pub(super) fn give_stroke_its_speed(&mut self) {
        if let (Some(stroke), Some(piece)) = (&mut self.drive.stroke, self.pieces.front()) {
            stroke.set_speed(piece.fastest.min(piece.feed));
        }
    }

    /// Finds the next leg if there is none; false if the axes stand and shall.
    fn begin(&mut self) -> bool {
        if self.drive.leg.is_some() {
            return true;
        }
        let Some(&first) = self.pieces.front() else { return false };
        let next = if first.stroke { self.next_of_stroke(&first) } else { self.next_of_mean(&first) };
        self.drive.leg = next;
        self.drive.spent = 0.0;
        next.is_some()
    }

    fn next_of_stroke(&mut self, piece: &Piece) -> Option<(Leg, bool)> {
        let stroke = self.drive.stroke.unwrap_or_else(|| self.stroke(piece));
        self.drive.stroke = Some(stroke);
        match stroke.leg() {
            Some(leg) => Some((leg, false)),
            None if stroke.has_arrived() => Some((Leg { s: piece.end(), ..Leg::default() }, true)),
            None => {
                // It stands, whatever speed rounding has left at the end of its last leg.
                self.drive.here = stroke.here();
                None
            }
        }
    }

    fn next_of_mean(&mut self, first: &Piece) -> Option<(Leg, bool)> {
        if self.drive.past.is_empty() {
            // A run begins.
            self.drive.window = first.window;
            self.drive.past.push_back(Past { speed: 0.0, acceleration: 0.0, seconds: first.window });
            self.drive.plan = Plan { s: first.from, ..Plan::default() };
            self.drive.here = Leg { s: first.from, ..Leg::default() };
        }
        self.plan_on();
        if self.drive.stands() {
            self.drive.here = Leg { s: self.drive.here.s, ..Leg::default() };
            // The mean has come to where the plan stands, but for rounding.
            let arrived = self.drive.plan.ended || self.drive.plan.index > 0 && self.drive.here.s >= first.end();
            return arrived.then_some((Leg { s: first.end(), ..Leg::default() }, true));
        }
        let mut leg = self.drive.mean()?;
        let mut ends = false;
        if self.drive.plan.index > 0
            && let Some(seconds) = passes(&leg, first.end())
        {
            (leg.seconds, ends) = (seconds, true);
        }
        Some((leg, ends))
    }

    /// Plans what lies before the plan, if nothing does.
    fn plan_on(&mut self) {
        while self.drive.plan.leg >= self.drive.plan.legs.count && !self.drive.plan.ended {
            let plan = self.drive.plan;
            let Some(piece) = self.pieces.get(plan.index) else { return };
            if plan.legs.reaches {
                let (index, speed) = (plan.index + 1, plan.speed);
                match self.pieces.get(index) {
                    Some(next) if !piece.stops => {
                        self.drive.plan = Plan { index, s: next.from, speed, ..Plan::default() };
                        continue;
                    }
                    _ => (self.drive.plan.speed, self.drive.plan.ended) = (0.0, piece.stops),
                }
                return;
            }
            let end = self.end_of(plan.index);
            let legs = if self.drive.held {
                slow_down(piece, plan.s, plan.speed)
            } else {
                speed_up(piece, plan.s, plan.speed, end)
            };
            let next = &mut self.drive.plan;
            (next.legs, next.leg, next.spent) = (legs, 0, 0.0);
            if legs.count == 0 && !legs.reaches {
                next.speed = 0.0;
                return;
            }
        }
    }

    /// The leg has been driven; true if a move ends with it.
    fn end_leg(&mut self) -> bool {
        let Some((leg, ends)) = self.drive.leg.take() else { return false };
        self.drive.spent = 0.0;
        let (s, speed) = leg.at(leg.seconds);
        self.drive.here = Leg { s, speed, ..Leg::default() };
        if let Some(stroke) = &mut self.drive.stroke {
            stroke.advance(leg.seconds);
        } else if leg.seconds > 0.0 {
            self.drive.advance(leg.seconds);
        }
        ends && self.end_piece()
    }

    /// Leaves the first piece; true if a move ends with it.
    fn end_piece(&mut self) -> bool {
        let Some(piece) = self.pieces.pop_front() else { return false };
        if piece.stops {
            self.drive.stroke = None;
            self.drive.past.clear();
            self.drive.plan = Plan::default();
        }
        self.drive.plan.index = self.drive.plan.index.saturating_sub(1);
        self.firm = self.firm.saturating_sub(1);
        self.settled = self.settled.saturating_sub(1);
        self.goal = self.goal.saturating_sub(1);
        self.drive.here.s = self.pieces.front().map_or(0.0, |next| next.from);
        if self.pieces.front().is_none_or(|next| next.way != piece.way) {
            self.ways.pop_front();
            self.first_way += 1;
        }
        if self.pieces.is_empty() && self.last.is_none() {
            self.closed = false;
        }
        if piece.ends {
            self.drop_move();
        }
        piece.ends
    }

    fn drop_move(&mut self) {
        self.ready = false;
        // A corner's feed is that of both moves: the first stays until its corner is driven.
        let last = self.last.as_ref().map_or(u64::MAX, |open| open.mover);
        let open = self.polygon.first_mover().map_or(last, |first| first.min(last));
        let needed = self.pieces.front().map_or(open, |piece| piece.moves[0]);
        while self.first_move < needed && self.asked.pop_front().is_some() {
            self.first_move += 1;
        }
    }

    /// A straight piece from rest to rest: all that its axes can do.
    fn stroke(&self, piece: &Piece) -> Stroke {
        let slope = self.way(piece.way).map_or([0.0; AXES], |way| way.slope(0.0));
        let (mut acceleration, mut jerk) = (f64::INFINITY, f64::INFINITY);
        for (limit, slope) in self.limits.axes[..self.limits.count].iter().zip(slope) {
            if slope != 0.0 {
                acceleration = acceleration.min(limit.acceleration / slope.abs());
                jerk = jerk.min(limit.jerk / slope.abs());
            }
        }
        let mut stroke = Stroke::new(piece.length, piece.fastest.min(piece.feed), acceleration, jerk);
        stroke.hold(self.drive.held);
        stroke
    }
}

impl JerkHorizon {
    /// The first piece that the plan has not left, where it is on it, and its squared speed.
    pub(super) fn plan_is(&self) -> (usize, f64, f64) {
        let plan = &self.drive.plan;
        match self.pieces.front() {
            // Nothing is planned yet, or a stroke that ends with its piece.
            Some(first) if self.drive.past.is_empty() => (0, first.from, 0.0),
            _ => (plan.index, plan.s, plan.speed * plan.speed),
        }
    }
}

impl Leg {
    /// What every axis does at its beginning: acceleration, mm/s², and jerk, mm/s³.
    pub fn on(&self, way: &Way) -> (Point, Point) {
        let (slope, bend, twist) = (way.slope(self.s), way.bend(self.s), way.twist(self.s));
        let (v, u, w) = (self.speed, self.acceleration, self.jerk);
        (
            std::array::from_fn(|axis| slope[axis] * u + bend[axis] * v * v),
            std::array::from_fn(|axis| slope[axis] * w + (3.0 * bend[axis] * u + twist[axis] * v * v) * v),
        )
    }
}

/// When a leg passes a place, if it does.
fn passes(leg: &Leg, place: f64) -> Option<f64> {
    if leg.at(leg.seconds).0 < place {
        return None;
    }
    let (mut low, mut high) = (0.0, leg.seconds);
    if leg.s >= place {
        return Some(0.0);
    }
    let mut seconds = if leg.speed > 0.0 { ((place - leg.s) / leg.speed).min(high) } else { high };
    for _ in 0..STEPS {
        let (s, speed) = leg.at(seconds);
        let missing = place - s;
        if missing > 0.0 {
            low = seconds;
        } else {
            high = seconds;
        }
        let mut next = seconds + missing / speed;
        if !(low..=high).contains(&next) {
            next = (low + high) / 2.0;
        }
        if (next - seconds).abs() <= NEAR * leg.seconds {
            return Some(next);
        }
        seconds = next;
    }
    Some(seconds)
}
