//! The return to a reference point by a dog: an axis runs towards the dog, creeps over it and stops at the mark behind.
//!
//! By hand it is a move of one axis. G28 makes it with every axis that has not been returned since power-on, in place of
//! the way from the intermediate point; those that have been returned go straight.

use base::AxisSet;
use machine::{Machine, ReferenceReturn, Signal};
use motion::Stroke;
use path::Shape;

use super::Session;
use super::by_hand::{ByHand, HandMove};
use crate::library::Library;

/// Halvings in which the time of an edge is found.
const HALVINGS: usize = 60;

/// An axis on its way to its reference point.
#[derive(Clone, Debug)]
pub(super) struct Search {
    pub axis: usize,
    point: f64,
    /// Its dog; without one it goes straight to the point.
    dog: Option<ReferenceReturn>,
    /// The ends of its present stroke.
    from: f64,
    to: f64,
    stroke: Stroke,
    /// mm/s², mm/s³.
    limits: [f64; 2],
    /// Towards the dog and on it, mm/s.
    speeds: [f64; 2],
    creeps: bool,
    on_dog: bool,
}

impl Search {
    fn new(
        axis: usize,
        from: f64,
        point: f64,
        dog: Option<ReferenceReturn>,
        speeds: [f64; 2],
        limits: [f64; 2],
    ) -> Search {
        let on_dog = dog.is_some_and(|dog| dog.is_on_dog(point, from));
        let stroke = Stroke::new(0.0, speeds[0], limits[0], limits[1]);
        let mut search = Search { axis, point, dog, from, to: from, stroke, limits, speeds, creeps: false, on_dog };
        let to = dog.and_then(|dog| dog.back(point, from)).unwrap_or(point);
        search.begin(to);
        search
    }

    fn begin(&mut self, to: f64) {
        self.to = to;
        self.stroke = Stroke::new((to - self.from).abs(), self.speeds[0], self.limits[0], self.limits[1]);
    }

    /// Where it is, and how fast.
    pub fn here(&self) -> [f64; 2] {
        let (here, sign) = (self.stroke.here(), (self.to - self.from).signum());
        if self.stroke.has_arrived() { [self.to, 0.0] } else { [self.from + sign * here.s, sign * here.speed] }
    }

    pub fn has_arrived(&self) -> bool {
        self.to == self.point && self.stroke.has_arrived()
    }

    pub fn dog(&self) -> Option<&ReferenceReturn> {
        self.dog.as_ref()
    }

    pub fn point(&self) -> f64 {
        self.point
    }

    /// The axis shall stand, or go on.
    pub fn hold(&mut self, held: bool) {
        self.stroke.hold(held);
    }

    pub fn stands(&self) -> bool {
        self.stroke.leg().is_none()
    }

    /// Another speed towards the dog.
    pub fn set_speed(&mut self, speed: f64) {
        self.speeds[0] = speed;
        if !self.creeps {
            self.stroke.set_speed(speed);
        }
    }

    /// The way to the next end of the dog in the present stroke.
    fn next_border(&self) -> Option<f64> {
        let (sign, s) = ((self.to - self.from).signum(), self.stroke.here().s);
        let ends = self.dog?.dog_at(self.point).map(|end| (end - self.from) * sign);
        // Its own end is passed, whatever the rounding.
        let leaves = if self.on_dog { ends[0].max(ends[1]) } else { ends[0].min(ends[1]) };
        let ahead = if leaves > s { leaves } else { f64::INFINITY };
        (ahead < (self.to - self.from).abs()).then_some(ahead)
    }

    /// Goes on for a time; what is left of it at the point, or where it is held. Edges of the dog's switch are told with
    /// the time since then.
    pub fn advance(&mut self, seconds: f64, tell: &mut dyn FnMut(f64, bool)) -> f64 {
        let mut left = seconds;
        loop {
            let mut ahead = self.stroke;
            let rest = ahead.advance(left);
            let border = self.next_border().filter(|border| ahead.here().s >= *border);
            if let Some(border) = border {
                let time = self.time_to(border, left - rest);
                self.stroke.advance(time);
                left -= time;
                self.on_dog = !self.on_dog;
                tell(seconds - left, self.on_dog);
                if self.on_dog && self.to == self.point {
                    self.creeps = true;
                    self.stroke.set_speed(self.speeds[1]);
                }
                continue;
            }
            (self.stroke, left) = (ahead, rest);
            if !self.stroke.has_arrived() || self.to == self.point {
                return left;
            }
            self.from = self.to;
            self.on_dog = false;
            self.begin(self.point);
        }
    }

    /// The time in which the stroke comes so far; it does within the time given.
    fn time_to(&self, border: f64, most: f64) -> f64 {
        let (mut low, mut high) = (0.0, most);
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            let mut ahead = self.stroke;
            ahead.advance(middle);
            if ahead.here().s >= border {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    }
}

impl<L: Library> Session<L> {
    /// How an axis returns to its reference point from where it stands.
    pub(super) fn search(&self, axis: usize, by_dog: bool) -> Option<Search> {
        let row = self.configuration.machine.axes.get(axis)?;
        let point = row.reference_points.first().copied().unwrap_or(0.0);
        let limits = self.configuration.machine.limits();
        let dog = row.reference_return.filter(|_| by_dog);
        let rapid = self.motion.overrides().rapid(limits.axes[axis].rapid);
        let speeds = dog.map_or([rapid; 2], |dog| [self.search_speed(&dog), dog.feeds[1] / 60.0]);
        let from = self.machine.position()[axis];
        Some(Search::new(axis, from, point, dog, speeds, [limits.axes[axis].acceleration, limits.jerk(axis)]))
    }

    /// Axes begin to return.
    pub(super) fn begin_searches(&mut self, searches: Vec<Search>, of_program: bool) {
        let now = self.time().0;
        for search in &searches {
            self.tell_dog(search.axis, search.on_dog, now);
        }
        let from = *self.machine.position();
        self.by_hand = Some(ByHand::searching(HandMove::Home, from, searches, of_program));
    }

    /// Towards the dog, as the rapid override has it, mm/s.
    pub(super) fn search_speed(&self, dog: &ReferenceReturn) -> f64 {
        self.motion.overrides().rapid(dog.feeds[0] / 60.0)
    }

    /// The axes that the block in execution returns for the first time since power-on.
    pub(super) fn newly_returned(&self) -> AxisSet {
        self.returned().without(self.interpreter().state_before().reference.established)
    }

    /// The move to be made now is the way to the reference points, and an axis looks for its dog on it: that begins.
    pub(super) fn begin_search(&mut self) -> bool {
        let shaped = self.motion.upstream.current();
        let leads_there = matches!(shaped.shape, Shape::Rapid { .. }) && !shaped.stop_point;
        let axes = if leads_there { self.newly_returned() } else { AxisSet::NONE };
        let has_dog =
            |axis: usize| self.configuration.machine.axes.get(axis).is_some_and(|axis| axis.reference_return.is_some());
        if !axes.iter().any(has_dog) || self.real_shape().is_some() {
            return false;
        }
        let place = self.motion.upstream.current().place;
        self.machine.wait_to_move(&place, &mut self.events);
        let searches = self.returned().iter().filter_map(|axis| self.search(axis, axes.has(axis))).collect();
        self.rest();
        self.begin_searches(searches, true);
        true
    }

    /// What an axis' dog says, if that is new. It is listened to on the way to a reference point only.
    pub(super) fn tell_dog(&mut self, axis: usize, on: bool, at: f64) {
        if self.on_dog.has(axis) == on {
            return;
        }
        let this = AxisSet::only(axis);
        self.on_dog = if on { self.on_dog.or(this) } else { self.on_dog.without(this) };
        let time = base::Seconds(at);
        self.machine.tell_input(Signal::Deceleration(axis as u8), on, time, &mut self.events);
    }
}
