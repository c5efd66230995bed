//! One kept part of the path: a straight segment or an arc, as small as it can be stored.

use crate::arc::Curve;
use crate::stroke::{Arc, Kind};

/// A part of the path that is drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Piece {
    pub kind: Kind,
    /// Start in mm.
    pub from: [f64; 3],
    /// End in mm.
    pub to: [f64; 3],
    pub arc: Option<Arc>,
    /// mm/min; 0 for a rapid.
    pub feed: f64,
}

impl Piece {
    /// The curve of an arc; `None` for a straight segment.
    pub fn curve(&self) -> Option<Curve> {
        self.arc.map(|arc| Curve::new(self.from, self.to, &arc))
    }

    /// Calls `line` for each straight segment of the piece, an arc being cut into chords that stand off it by at most
    /// `tolerance_mm`.
    pub fn for_each_line(&self, tolerance_mm: f64, mut line: impl FnMut([f64; 3], [f64; 3])) {
        let Some(curve) = self.curve() else {
            return line(self.from, self.to);
        };
        let steps = curve.steps(tolerance_mm);
        let mut last = self.from;
        for step in 1..=steps {
            let next = if step == steps { self.to } else { curve.at(step as f64 / steps as f64) };
            line(last, next);
            last = next;
        }
    }
}

/// The distance of two points in mm.
pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    (x * x + y * y + z * z).sqrt()
}
