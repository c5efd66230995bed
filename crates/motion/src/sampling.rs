//! A move as it is driven, setpoint after setpoint, as close together as a picture of it needs.

use base::Point;
use path::Shape;

use crate::horizon::Setpoint;
use crate::planner::Stretch;
use crate::stage::Motion;
use crate::way::{Way, norm};

/// Setpoints of a rapid.
const OF_A_RAPID: u32 = 256;
/// Between two setpoints the speed changes by at most this part of the move's highest.
const PART_OF_SPEED: f64 = 1.0 / 48.0;
/// Of a stretch round a corner at least so many, however small it is: how far the corner is left is read from them.
const LEAST_OF_A_CORNER: f64 = 8.0;
/// Of one stretch at most so many.
const MOST_OF_A_STRETCH: f64 = 4096.0;

/// What is halved is halved at most so often, and parted into so many at first.
const HALVED: u32 = 12;
const AT_FIRST: u32 = 8;
/// How close a chord of it is, mm, and its velocities, as a part of the speed.
const CLOSE: f64 = 1e-4;
const CLOSE_SPEED: f64 = 0.01;

/// Shows setpoints of a motion of which nothing is known but where it is at a time, its first and its last among them.
pub(crate) fn sample_evenly(seconds: f64, at: impl Fn(f64) -> Setpoint, mut see: impl FnMut(f64, Setpoint)) {
    let mut before = (0.0, at(0.0));
    see(before.0, before.1);
    for part in 1..=AT_FIRST {
        let time = seconds * f64::from(part) / f64::from(AT_FIRST);
        let end = (time, at(time));
        halve([before, end], HALVED, &at, &mut see);
        see(end.0, end.1);
        before = end;
    }
}

fn halve(
    [from, to]: [(f64, Setpoint); 2],
    depth: u32,
    at: &impl Fn(f64) -> Setpoint,
    see: &mut impl FnMut(f64, Setpoint),
) {
    let time = (from.0 + to.0) / 2.0;
    let middle = (time, at(time));
    let off = |of: fn(&Setpoint) -> &Point| {
        let mean: Point = std::array::from_fn(|axis| (of(&from.1)[axis] + of(&to.1)[axis]) / 2.0 - of(&middle.1)[axis]);
        norm(&mean, base::AXES)
    };
    let speed = from.1.speed().max(to.1.speed());
    if depth > 0 && (off(|point| &point.position) > CLOSE || off(|point| &point.velocity) > CLOSE_SPEED * speed) {
        halve([from, middle], depth - 1, at, see);
        see(middle.0, middle.1);
        halve([middle, to], depth - 1, at, see);
    }
}

impl Stretch {
    /// Where the axes are after a time on it, and how fast.
    pub fn at(&self, seconds: f64) -> Setpoint {
        let (s, speed) = self.leg.at(seconds);
        Setpoint { position: self.way.at(s), velocity: self.way.slope(s).map(|slope| slope * speed) }
    }

    /// How many equal times part it so that the chords between stay this close to its way, and speeds to each other.
    fn parts(&self, tolerance_mm: f64, top: f64) -> f64 {
        let leg = &self.leg;
        let (end, last) = leg.at(leg.seconds);
        let mut change = (last - leg.speed).abs();
        if leg.jerk != 0.0 {
            change =
                change.max(leg.acceleration.abs().max((leg.acceleration + leg.jerk * leg.seconds).abs()) * leg.seconds);
        }
        let speeds = if top > 0.0 { change / (top * PART_OF_SPEED) } else { 0.0 };
        let driven = (end - leg.s).abs();
        let bends = match self.way {
            Way::Line { .. } => 0.0,
            // A chord of a curve with this bend stands off it by bend · chord² / 8. Equal times are unequal ways.
            _ => {
                let bend = [leg.s, (leg.s + end) / 2.0, end].map(|s| norm(&self.way.bend(s), base::AXES));
                let bend = bend.into_iter().fold(0.0, f64::max);
                let uneven = leg.speed.max(last) * leg.seconds / driven.max(f64::MIN_POSITIVE);
                driven * uneven.min(2.0) * (bend / (8.0 * tolerance_mm)).sqrt()
            }
        };
        let least = if matches!(self.way, Way::Blend { .. }) { LEAST_OF_A_CORNER } else { 1.0 };
        speeds.max(bends).ceil().clamp(least, MOST_OF_A_STRETCH)
    }
}

impl Motion {
    /// Shows setpoints of the move planned last, or of the present rapid, with the time since its beginning: straight
    /// between them it is left by no more than `tolerance_mm`. Nothing is shown of what is neither.
    pub fn sample(&self, tolerance_mm: f64, mut see: impl FnMut(f64, &Setpoint)) {
        if !self.samples().is_empty() {
            return self.samples().iter().for_each(|sample| see(sample.seconds, &sample.setpoint));
        }
        let stretches = self.stretches();
        if let Some(first) = stretches.first() {
            let ends = |stretch: &Stretch| stretch.leg.speed.max(stretch.leg.at(stretch.leg.seconds).1);
            let top = stretches.iter().map(ends).fold(0.0, f64::max);
            see(0.0, &first.at(0.0));
            let mut begun = 0.0;
            for stretch in stretches {
                let (parts, seconds) = (stretch.parts(tolerance_mm, top), stretch.leg.seconds);
                (1..=parts as u32).for_each(|part| {
                    let at = seconds * f64::from(part) / parts;
                    see(begun + at, &stretch.at(at));
                });
                begun += seconds;
            }
            return;
        }
        let Shape::Rapid { from, to, .. } = &self.upstream.current().shape else { return };
        let mut positioning = self.positioning(from, to);
        let step = self.current().duration.0 / f64::from(OF_A_RAPID);
        for part in 0..=OF_A_RAPID {
            see(step * f64::from(part), &positioning.setpoint());
            positioning.drive_for(step);
        }
    }
}
