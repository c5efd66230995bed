//! Seconds by kind.

use std::ops::AddAssign;

use machine::{Event, EventKind};
use motion::Pace;

/// Seconds by kind.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Split {
    /// Cutting moves.
    pub cutting: f64,
    /// Positioning moves.
    pub rapid: f64,
    /// Dwells.
    pub dwell: f64,
    /// Nothing moves, and the machine has not answered yet.
    pub waiting: f64,
    /// What of cutting is more than at the programmed feed throughout.
    pub lost_cutting: f64,
    /// What of positioning is more than at the rapid rate throughout.
    pub lost_rapid: f64,
}

impl Split {
    /// What an event takes.
    pub fn of(event: &Event) -> Split {
        let none = Split::default();
        match &event.kind {
            EventKind::Rapid { duration, length, pace, .. } => {
                Split { rapid: duration.0, lost_rapid: lost(duration.0, *length, pace), ..none }
            }
            EventKind::Feed { duration, length, pace, .. } | EventKind::Arc { duration, length, pace, .. } => {
                Split { cutting: duration.0, lost_cutting: lost(duration.0, *length, pace), ..none }
            }
            EventKind::Dwell(dwell) => Split { dwell: dwell.seconds(), ..none },
            EventKind::Waited(duration) => Split { waiting: duration.0, ..none },
            _ => none,
        }
    }

    /// All together.
    pub fn total(&self) -> f64 {
        self.cutting + self.rapid + self.dwell + self.waiting
    }

    /// What is lost of cutting and positioning.
    pub fn lost(&self) -> f64 {
        self.lost_cutting + self.lost_rapid
    }
}

impl AddAssign for Split {
    fn add_assign(&mut self, other: Split) {
        self.cutting += other.cutting;
        self.rapid += other.rapid;
        self.dwell += other.dwell;
        self.waiting += other.waiting;
        self.lost_cutting += other.lost_cutting;
        self.lost_rapid += other.lost_rapid;
    }
}

/// The speed that a move asks for, mm/s; a cut at the rapid rate asks for what the axes allow. 0: it was not planned.
pub(crate) fn asked(pace: &Pace) -> f64 {
    if pace.asked.is_finite() { pace.asked } else { f64::from(pace.allowed) }
}

/// What a move takes longer than at the speed that it asks for, s.
pub(crate) fn lost(seconds: f64, length: f64, pace: &Pace) -> f64 {
    let asked = asked(pace);
    if asked > 0.0 && asked.is_finite() { (seconds - length / asked).max(0.0) } else { 0.0 }
}
