//! What the operator's override switches and DRY RUN make of the commanded speeds.

use meaning::{Dwell, Feed};

/// The speeds as the operator has set them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Overrides {
    /// Part of the commanded feed; 0 stands still.
    pub feed: f64,
    /// Part of the rapid rate.
    pub rapid: f64,
    /// Part of the commanded spindle speed, which a feed per revolution follows.
    pub spindle: f64,
    /// The highest rate in rapid, mm/s.
    pub rapid_limit: f64,
    /// The feed of every cutting move in place of the commanded one, mm/min.
    pub dry_run: Option<f64>,
}

impl Default for Overrides {
    /// Everything as commanded.
    fn default() -> Self {
        Overrides { feed: 1.0, rapid: 1.0, spindle: 1.0, rapid_limit: f64::INFINITY, dry_run: None }
    }
}

impl Overrides {
    /// The feed that is told, mm/min: as commanded, or that of DRY RUN.
    pub fn commanded(&self, feed: &Feed) -> f64 {
        self.dry_run.unwrap_or(feed.mm_per_min)
    }

    /// The feed at which a cut runs, mm/min, before any axis' limits. Tapping knows no feed override, and DRY RUN has
    /// the jog speed in its place.
    pub fn actual(&self, feed: &Feed) -> f64 {
        if let Some(jog) = self.dry_run {
            return jog;
        }
        if feed.mm_per_min == f64::INFINITY {
            return f64::INFINITY;
        }
        let spindle = if feed.per_revolution { self.spindle } else { 1.0 };
        let part = if feed.tapping { 1.0 } else { self.feed };
        feed.mm_per_min * spindle * part
    }

    /// True for a cut at the rapid rate, which the rapid override acts on and not that of the feed.
    pub fn at_rapid(&self, feed: &Feed) -> bool {
        self.dry_run.is_none() && feed.mm_per_min == f64::INFINITY
    }

    /// How long a dwell lasts, s; turns of the spindle follow its override.
    pub fn dwell(&self, dwell: Dwell) -> f64 {
        match dwell {
            Dwell::Seconds(_) => dwell.seconds(),
            Dwell::Revolutions { .. } => dwell.seconds() / self.spindle,
        }
    }

    /// True if nothing runs at the rapid rate.
    pub fn rapid_stands(&self) -> bool {
        self.rapid <= 0.0 || self.rapid_limit <= 0.0
    }

    /// True if a cut at the rapid rate is not at the axes' own.
    pub(crate) fn rapid_tells(&self) -> bool {
        self.rapid != 1.0 || self.rapid_limit < f64::INFINITY || self.dry_run.is_some()
    }

    /// The rapid rate of an axis, mm/s, of its own `rate`.
    pub fn rapid(&self, rate: f64) -> f64 {
        (rate * self.rapid).min(self.rapid_limit)
    }
}
