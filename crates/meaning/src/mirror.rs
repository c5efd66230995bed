//! M94 and M95: mirror image. The axes are chosen by setting bits; their distances change sign from the point where
//! the image is switched on, which is a place on the machine. G92 on a mirrored axis makes its own point that place.

use base::AxisSet;

use crate::block::Reading;
use crate::transform::TRANSFORMED;

impl Reading<'_> {
    /// M95: the image begins where the axes stand. While it is on, M95 changes nothing.
    pub fn mirror_on(&mut self) {
        if self.next.transform.mirror {
            return;
        }
        self.next.transform.mirror = true;
        let Some(parameter) = self.control().mirror_setting else { return };
        let bits = self.setting.fitting.parameter(parameter) as u8;
        for (axis, facts) in self.setting.facts.axes.iter().enumerate().take(TRANSFORMED) {
            let bit = match facts.letter {
                b'X' => 0,
                b'Y' => 1,
                b'Z' => 2,
                _ => 3,
            };
            if bits & (1 << bit) != 0 {
                self.next.transform.mirrored.add(axis);
                self.mirror_here(axis);
            }
        }
    }

    /// M94: words mean what they say again.
    pub fn mirror_off(&mut self) {
        self.next.transform.mirror = false;
        self.next.transform.mirrored = AxisSet::NONE;
    }

    /// Where an axis stands once a changed length offset has been made up for.
    pub fn here(&self, axis: usize) -> f64 {
        let due = if Some(axis) == self.setting.length_axis { self.next.length_due } else { 0.0 };
        self.next.machine[axis] + due
    }

    /// An axis is mirrored about the point where it stands.
    pub fn mirror_here(&mut self, axis: usize) {
        let line = self.here(axis) - self.setting.length_on(self.next, axis);
        if let Some(place) = self.next.transform.line.get_mut(axis) {
            *place = line;
        }
    }
}
