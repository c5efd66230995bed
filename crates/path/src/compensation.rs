//! Tool radius compensation, as far as it is built: everything passes through, and the first move in the plane of
//! compensation is refused with `not yet built` rather than run beside its place.

use base::{Alarm, AxisSet, Condition, Place};
use meaning::Side;

/// The state of compensation along the path.
#[derive(Clone, Copy, Debug, Default)]
pub struct Compensation {
    refused: bool,
}

/// What becomes of a move.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Verdict {
    /// It runs as programmed.
    Pass,
    /// It runs, but where is not certain: an earlier move was refused.
    Uncertain,
    /// It is refused.
    Refuse(Alarm),
}

impl Compensation {
    /// Judges a move along `moving` axes, of which `plane` span the plane in force.
    pub(crate) fn judge(&mut self, side: Side, moving: AxisSet, plane: AxisSet, place: &Place) -> Verdict {
        if side == Side::Off {
            self.refused = false;
            return Verdict::Pass;
        }
        if self.refused {
            return Verdict::Uncertain;
        }
        if moving.and(plane).is_empty() {
            return Verdict::Pass;
        }
        self.refused = true;
        Verdict::Refuse(Alarm::new(Condition::NotYetBuilt, *place, place.block))
    }
}
