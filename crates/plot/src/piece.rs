//! One kept part of the path: a straight segment or an arc, as small as it can be stored.

use crate::arc::Curve;
use crate::extent::Extent;
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
        let mut last = self.from;
        curve.for_each_inner(curve.steps(tolerance_mm), |next| {
            line(last, next);
            last = next;
        });
        line(last, self.to);
    }

    /// The length of the path in mm.
    pub fn length_mm(&self) -> f64 {
        self.curve().map_or_else(|| distance(self.from, self.to), |curve| curve.length_mm())
    }

    /// The box around the piece.
    pub fn extent(&self) -> Extent {
        if let Some(curve) = self.curve() {
            return curve.extent(self.from, self.to);
        }
        let mut extent = Extent::EMPTY;
        extent.include(self.from);
        extent.include(self.to);
        extent
    }

    /// How many segments the piece counts for when it is drawn: an arc takes about two for each third of a turn.
    pub fn segments(&self) -> usize {
        self.arc.map_or(1, |arc| 2 + 2 * (arc.sweep_deg.abs() / 120.0).min(3.0) as usize)
    }
}

/// The distance of two points in mm.
pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    (x * x + y * y + z * z).sqrt()
}
