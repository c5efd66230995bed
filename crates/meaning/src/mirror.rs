//! M94 and M95, and the switches of the panel: mirror image. For M95 the axes are chosen by setting bits, each
//! switch has its own. Their distances change sign from the point where the image is switched on, which is a place on
//! the machine. G92 on a mirrored axis makes its own point that place. A switch acts from the next block that is read.

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
        let image = self.next.transform.by_switch.or(self.chosen());
        self.mirror(image);
    }

    /// M94: words mean what they say again, along the axes that no switch mirrors.
    pub fn mirror_off(&mut self) {
        self.next.transform.mirror = false;
        self.next.transform.mirrored = self.next.transform.by_switch;
    }

    /// The switches have been looked at as the block is read.
    pub fn follow_mirror_switches(&mut self) {
        let switches = self.setting.switches.mirror_image;
        if switches == self.next.transform.by_switch {
            return;
        }
        self.next.transform.by_switch = switches;
        let by_code = if self.next.transform.mirror { self.chosen() } else { AxisSet::NONE };
        self.mirror(switches.or(by_code));
    }

    /// These axes are mirrored and no others; those that were not begin where they stand.
    fn mirror(&mut self, image: AxisSet) {
        let begin = image.without(self.next.transform.mirrored);
        self.next.transform.mirrored = image;
        begin.iter().for_each(|axis| self.mirror_here(axis));
    }

    /// The axes that the setting chooses for M95.
    fn chosen(&self) -> AxisSet {
        let mut chosen = AxisSet::NONE;
        let Some(parameter) = self.control().mirror_setting else { return chosen };
        let bits = self.setting.fitting.parameter(parameter) as u8;
        for (axis, facts) in self.setting.facts.axes.iter().enumerate().take(TRANSFORMED) {
            let bit = match facts.letter {
                b'X' => 0,
                b'Y' => 1,
                b'Z' => 2,
                _ => 3,
            };
            if bits & (1 << bit) != 0 {
                chosen.add(axis);
            }
        }
        chosen
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
