//! What each axis can do.

use base::AXES;

/// The limits of one axis, in mm (degrees) and seconds.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AxisLimits {
    /// Rapid rate, mm/s.
    pub rapid: f64,
    /// Highest cutting feed, mm/s.
    pub max_feed: f64,
    /// Acceleration, mm/s².
    pub acceleration: f64,
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
}
