//! Rapid positioning with linear acceleration, every axis for itself.

use base::{AXES, Point};

use crate::horizon::{Leg, Setpoint};

/// One axis from where it is to its end: faster, steady, slower.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
struct Ramp {
    /// The whole way, mm, and to which side it leads.
    way: f64,
    side: f64,
    legs: [Leg; 3],
}

/// What one axis may do: its rate, mm/s, and its acceleration, mm/s².
pub type Rate = (f64, f64);

impl Ramp {
    /// On from a place and a speed. At the rate zero the axis comes to stand and stays there.
    fn plan(&mut self, s: f64, speed: f64, (rate, acceleration): Rate) {
        let rest = self.way - s;
        if rest <= 0.0 {
            self.legs = [Leg { s: self.way, ..Leg::default() }; 3];
            return;
        }
        let double = 2.0 * acceleration;
        if rate <= 0.0 {
            let slowing =
                Leg { s, speed, acceleration: -acceleration, seconds: speed / acceleration, ..Leg::default() };
            let stands = s + speed * speed / double;
            self.legs = [slowing, Leg { s: stands, seconds: f64::INFINITY, ..Leg::default() }, Leg::default()];
            return;
        }
        let reached = (speed * speed / 2.0 + acceleration * rest).sqrt().max(speed);
        let top = rate.min(reached);
        let (change, fall) = ((top * top - speed * speed).abs() / double, top * top / double);
        let steady = (rest - change - fall).max(0.0);
        self.legs = [
            Leg {
                s,
                speed,
                acceleration: acceleration.copysign(top - speed),
                seconds: (top - speed).abs() / acceleration,
                ..Leg::default()
            },
            Leg { s: s + change, speed: top, acceleration: 0.0, seconds: steady / top, ..Leg::default() },
            Leg {
                s: self.way - fall,
                speed: top,
                acceleration: -acceleration,
                seconds: top / acceleration,
                ..Leg::default()
            },
        ];
    }

    /// When it begins to slow down for its end.
    fn released(&self) -> f64 {
        self.legs[0].seconds + self.legs[1].seconds
    }

    fn seconds(&self) -> f64 {
        self.released() + self.legs[2].seconds
    }

    /// How far it has come after a time, and how fast it is then.
    fn at(&self, mut seconds: f64) -> (f64, f64) {
        for leg in &self.legs {
            if seconds < leg.seconds {
                return leg.at(seconds);
            }
            seconds -= leg.seconds;
        }
        (self.way, 0.0)
    }
}

/// A rapid move.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Rapid {
    /// Where it began.
    from: Point,
    /// Where it ends.
    pub to: Point,
    ramps: [Ramp; AXES],
    /// How long it takes until all axes have been slowed down, s.
    pub seconds: f64,
    /// How long until the last one begins to slow down, s.
    pub released: f64,
}

impl Rapid {
    /// From rest.
    pub fn new(from: &Point, to: &Point, rates: &[Rate; AXES]) -> Rapid {
        let mut rapid = Rapid { from: *from, to: *to, ..Rapid::default() };
        for (axis, ramp) in rapid.ramps.iter_mut().enumerate() {
            let way = to[axis] - from[axis];
            (ramp.way, ramp.side) = (way.abs(), 1f64.copysign(way));
        }
        rapid.plan(0.0, rates);
        rapid
    }

    /// On from where the axes are after a time, with other rates. Its time begins anew.
    pub fn plan(&mut self, after: f64, rates: &[Rate; AXES]) {
        (self.seconds, self.released) = (0.0, 0.0);
        for (ramp, rate) in self.ramps.iter_mut().zip(rates) {
            if ramp.way > 0.0 {
                let (s, speed) = if after > 0.0 { ramp.at(after) } else { (ramp.legs[0].s, ramp.legs[0].speed) };
                ramp.plan(s, speed, *rate);
                self.seconds = self.seconds.max(ramp.seconds());
                self.released = self.released.max(ramp.released());
            }
        }
    }

    /// Where the axes are after a time, and how fast.
    pub fn at(&self, seconds: f64) -> Setpoint {
        let mut setpoint = Setpoint { position: self.to, velocity: [0.0; AXES] };
        for (axis, ramp) in self.ramps.iter().enumerate() {
            let (s, speed) = ramp.at(seconds);
            if s < ramp.way {
                setpoint.position[axis] = self.from[axis] + ramp.side * s;
                setpoint.velocity[axis] = ramp.side * speed;
            }
        }
        setpoint
    }
}
