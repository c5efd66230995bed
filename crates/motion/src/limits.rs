//! What each axis can do, and how the control leads the tool from one block into the next.

use base::{AXES, Point};

/// The limits of one axis, in mm (degrees) and seconds.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct AxisLimits {
    /// Rapid rate, mm/s.
    pub rapid: f64,
    /// Highest cutting feed, mm/s.
    pub max_feed: f64,
    /// Acceleration, mm/s².
    pub acceleration: f64,
    /// Change of acceleration, mm/s³, which model `jerk` keeps to; infinite where the machine names none.
    pub jerk: f64,
}

/// How motion follows from the path.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum Model {
    /// Speed changes at constant acceleration.
    #[default]
    Trapezoid,
    /// As trapezoid, and the acceleration itself changes steadily.
    Jerk,
    /// As the controls of the time: linear rapid, exponential cutting feed behind the interpolator.
    Classic(Classic),
}

/// What the model of the old controls is made of.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Classic {
    /// Time from rest to the rapid rate, s: constant acceleration.
    pub rapid_s: f64,
    /// Time constant of the exponential acceleration of cutting feeds, s.
    pub feed_s: f64,
    /// Time that the control needs to make one block ready, s.
    pub block_s: f64,
    /// Blocks that it can hold ready.
    pub buffer: u32,
    /// In-position width, mm: a stop is over when every axis is nearer to its end.
    pub in_position_mm: f64,
}

/// The limits of all axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limits {
    /// One entry an axis; those beyond `count` are never moved.
    pub axes: [AxisLimits; AXES],
    /// How many axes there are.
    pub count: usize,
    /// True if rapid positioning runs in a straight line; false if every axis runs at its own rate.
    pub straight_rapid: bool,
    /// How motion follows from the path.
    pub model: Model,
    /// How far a corner that is passed without a stop may be left, mm; 0: every corner is a stop.
    pub corner_tolerance: f64,
    /// The time from one setpoint to the next, s.
    pub servo_period: f64,
}

impl Limits {
    /// The jerk of an axis as its model keeps to it, mm/s³.
    pub fn jerk(&self, axis: usize) -> f64 {
        if self.model == Model::Jerk { self.axes[axis].jerk } else { f64::INFINITY }
    }
}

/// The limits as the cells of a way want them, so that little is divided.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Scale {
    /// Each axis' acceleration, mm/s².
    pub acceleration: Point,
    /// One by it.
    pub per_acceleration: Point,
    /// One by each axis' rate, mm/s.
    pub per_rate: Point,
    /// How many axes there are.
    pub count: usize,
}

impl Scale {
    /// The limits with one of the axes' rates.
    pub fn new(limits: &Limits, rate: fn(&AxisLimits) -> f64) -> Scale {
        let mut scale = Scale { count: limits.count.min(AXES), ..Scale::default() };
        for (axis, limit) in limits.axes.iter().enumerate().take(limits.count) {
            scale.acceleration[axis] = limit.acceleration;
            (scale.per_acceleration[axis], scale.per_rate[axis]) = (1.0 / limit.acceleration, 1.0 / rate(limit));
        }
        scale
    }
}

impl Default for Limits {
    /// No axis, exact corners, setpoints every millisecond.
    fn default() -> Self {
        Limits {
            axes: [AxisLimits::default(); AXES],
            count: 0,
            straight_rapid: false,
            model: Model::Trapezoid,
            corner_tolerance: 0.0,
            servo_period: 0.001,
        }
    }
}
