//! A straight way from rest to rest along S-curves, which may be held, released and given another speed at any time.

use crate::horizon::Leg;
use crate::scurve::SCurve;

/// Two ramps of three stretches each, and what lies between.
const MOST_LEGS: usize = 7;
/// A rest of way shorter than this is none, mm.
const NOTHING_LEFT: f64 = 1e-9;
/// Halvings in which the speed between two ramps is found.
const HALVINGS: usize = 60;

/// A way from rest to rest under way. Where nobody intervenes it is an [`SCurve`].
///
/// What follows an intervention begins at a speed `v` and an acceleration `a`: a ramp to a speed `c` at which the
/// acceleration is none, and a ramp from there to rest at the end. `c` is as high as the way allows and not above what
/// is asked. Taken straight to none, the acceleration leaves the speed `v ± a²/2j`: from there on a higher `c` takes
/// more way, so that it is found by halving. Where there is no such `c`, what is under way is ended at rest as soon
/// as can be, and the remainder is a new move.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stroke {
    distance: f64,
    /// The speed asked for, and the limits.
    speed: f64,
    acceleration: f64,
    jerk: f64,
    held: bool,
    legs: [Leg; MOST_LEGS],
    count: usize,
    leg: usize,
    /// The time spent in the present leg.
    spent: f64,
}

impl Stroke {
    /// At its beginning, the axes standing. mm, mm/s, mm/s², mm/s³.
    pub fn new(distance: f64, speed: f64, acceleration: f64, jerk: f64) -> Stroke {
        let legs = [Leg::default(); MOST_LEGS];
        let mut stroke =
            Stroke { distance, speed, acceleration, jerk, held: false, legs, count: 0, leg: 0, spent: 0.0 };
        stroke.start(0.0);
        stroke
    }

    /// The rest of the present leg; `None` where the axes stand: at the end, or held.
    pub fn leg(&self) -> Option<Leg> {
        let leg = self.legs[..self.count].get(self.leg)?;
        let (s, speed) = leg.at(self.spent);
        let acceleration = leg.acceleration + leg.jerk * self.spent;
        Some(Leg { s, speed, acceleration, jerk: leg.jerk, seconds: leg.seconds - self.spent })
    }

    /// Where it is, how fast and with which acceleration.
    pub fn here(&self) -> Leg {
        self.leg().unwrap_or_else(|| Leg { s: self.standing_at(), ..Leg::default() })
    }

    /// True at its end.
    pub fn has_arrived(&self) -> bool {
        self.leg >= self.count && self.distance - self.standing_at() <= NOTHING_LEFT
    }

    /// Goes on for a time: what is left of it at the end, or where the axes stand.
    pub fn advance(&mut self, mut seconds: f64) -> f64 {
        while self.leg < self.count {
            let rest = self.legs[self.leg].seconds - self.spent;
            if rest > seconds {
                self.spent += seconds;
                return 0.0;
            }
            seconds -= rest;
            (self.leg, self.spent) = (self.leg + 1, 0.0);
            if self.leg >= self.count && !self.held && !self.has_arrived() {
                self.start(self.standing_at());
            }
        }
        seconds
    }

    /// The highest speed from now on, mm/s.
    pub fn set_speed(&mut self, speed: f64) {
        if self.speed != speed {
            self.speed = speed;
            self.plan();
        }
    }

    /// The axes shall stand as soon as they can, or go on.
    pub fn hold(&mut self, held: bool) {
        if self.held != held {
            self.held = held;
            self.plan();
        }
    }

    fn standing_at(&self) -> f64 {
        self.legs[..self.count].last().map_or(0.0, |last| last.at(last.seconds).0)
    }

    /// From rest at `s` to the end.
    fn start(&mut self, s: f64) {
        let curve = SCurve::new(self.distance - s, self.speed, self.acceleration, self.jerk);
        let from = Leg { s, ..Leg::default() };
        self.clear(&from);
        if curve.top > 0.0 && curve.seconds().is_finite() {
            self.go(&from, curve.top);
        }
    }

    /// Anew from here.
    fn plan(&mut self) {
        let here = self.here();
        if self.held || self.speed <= 0.0 {
            self.clear(&here);
            return self.push_ramp(&here, 0.0);
        }
        if here.speed <= 0.0 && here.acceleration == 0.0 {
            return self.start(here.s);
        }
        let eased = (here.speed + here.acceleration * here.acceleration.abs() / (2.0 * self.jerk)).max(0.0);
        if self.needs(&here, self.speed) <= self.distance {
            self.clear(&here);
            return self.go(&here, self.speed);
        }
        if self.speed < eased || self.needs(&here, eased) > self.distance {
            self.clear(&here);
            return self.push_ramp(&here, 0.0);
        }
        let (mut low, mut high) = (eased, self.speed);
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            if self.needs(&here, middle) <= self.distance {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.clear(&here);
        self.go(&here, low);
    }

    /// Where the ramps to a speed and from there to rest end.
    fn needs(&self, here: &Leg, speed: f64) -> f64 {
        let turn = self.ramp(here, speed).1;
        self.ramp(&turn, 0.0).1.s
    }

    /// To a speed, at that speed, and to rest at the end.
    fn go(&mut self, here: &Leg, speed: f64) {
        let between = self.distance - self.needs(here, speed);
        self.push_ramp(here, speed);
        let mut turn = self.ramp(here, speed).1;
        if between > 0.0 && speed > 0.0 {
            self.push(&Leg { s: turn.s, speed, seconds: between / speed, ..Leg::default() });
            turn.s += between;
        }
        self.push_ramp(&turn, 0.0);
    }

    fn clear(&mut self, here: &Leg) {
        (self.count, self.leg, self.spent) = (0, 0, 0.0);
        // Where it stands is told by a leg, if only by one of no time.
        self.legs[0] = Leg { seconds: 0.0, ..*here };
        if here.s > 0.0 {
            (self.count, self.leg) = (1, 1);
        }
    }

    fn push_ramp(&mut self, here: &Leg, speed: f64) {
        for leg in &self.ramp(here, speed).0 {
            self.push(leg);
        }
    }

    fn push(&mut self, leg: &Leg) {
        if leg.seconds <= 0.0 {
            return;
        }
        if self.leg == self.count {
            (self.count, self.leg) = (0, 0);
        }
        if self.count < MOST_LEGS {
            self.legs[self.count] = *leg;
            self.count += 1;
        }
    }

    /// The fastest change to a speed without acceleration, in three legs, and where it ends.
    fn ramp(&self, here: &Leg, speed: f64) -> ([Leg; 3], Leg) {
        let (jerk, most) = (self.jerk, self.acceleration);
        let eased = here.speed + here.acceleration * here.acceleration.abs() / (2.0 * jerk);
        // As if the speed were to rise.
        let up = if speed >= eased { 1.0 } else { -1.0 };
        let (first, gain) = (up * here.acceleration, up * (speed - here.speed));
        let free = (jerk * gain + first * first / 2.0).max(0.0).sqrt();
        let peak = free.min(most).max(first);
        let level = if free > most {
            ((gain - (2.0 * peak * peak - first * first) / (2.0 * jerk)) / most).max(0.0)
        } else {
            0.0
        };
        let mut legs = [Leg::default(); 3];
        let mut at = (here.s, here.speed);
        let parts = [(first, jerk, (peak - first) / jerk), (peak, 0.0, level), (peak, -jerk, peak / jerk)];
        for (leg, (acceleration, jerk, seconds)) in legs.iter_mut().zip(parts) {
            *leg = Leg { s: at.0, speed: at.1, acceleration: up * acceleration, jerk: up * jerk, seconds };
            if seconds > 0.0 {
                at = leg.at(seconds);
            }
        }
        (legs, Leg { s: at.0, speed, ..Leg::default() })
    }
}
