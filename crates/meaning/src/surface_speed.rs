//! G96 and G97: constant surface speed. Under G96 S is the speed of the surface that a tool on X cuts while the work
//! turns about Z, and the control makes rev/min of it: `n = S / (2π·|X|)`, X in the work system in force.
//!
//! The speed that goes out is that of the place from which a block starts, to the whole rev/min, never above a
//! parameter; it goes out with a block at whose start it has changed. G97 keeps that of its own place until an S.

use base::units::NM_PER_INCH;
use base::{Alarm, UnitSystem};
use dialect::Meaning;

use crate::block::Reading;
use crate::state::State;

impl Reading<'_> {
    /// True while the surface speed is kept, and in the block that ends it without an S of its own: the rev/min that
    /// are kept are those of the place where it ends.
    pub fn is_surface_speed(&self) -> bool {
        let control = self.setting.control.as_ref();
        let Some(group) = control.roles.surface_speed else { return false };
        let kept_by = |state: &State| control.in_force(&state.groups, group) == Some(Meaning::SurfaceSpeedOn);
        kept_by(self.next) || (kept_by(self.before) && !self.words.has(b'S'))
    }

    /// Takes S as the surface speed; the rev/min for it, if they are not those that the spindle has.
    #[cold]
    #[inline(never)]
    pub fn follow_surface(&mut self) -> Result<Option<u32>, Alarm> {
        let control = self.control();
        if let Some(speed) = self.words.count(control, b'S')? {
            // m/min or inch/min.
            let unit = if self.units == UnitSystem::Inch { NM_PER_INCH as f64 } else { 1e9 };
            self.next.surface_speed = f64::from(speed) * unit;
        }
        let Some(axis) = self.setting.facts.axis(b'X').filter(|_| self.next.surface_speed > 0.0) else {
            return Ok(None);
        };
        let radius = (self.next.machine[axis] - self.zero(axis)).abs();
        let limit = self.setting.fitting.parameter_if_any(control.feeds.spindle_limit);
        let limit = if limit > 0.0 { limit } else { f64::from(u32::MAX) };
        let turns = self.next.surface_speed / (2.0 * std::f64::consts::PI * radius);
        // On the centre itself no number of turns is enough.
        let speed = if turns < limit { turns.round() } else { limit } as u32;
        if speed == self.next.spindle {
            return Ok(None);
        }
        self.next.spindle = speed;
        Ok(Some(speed))
    }
}
