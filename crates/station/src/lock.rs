//! MACHINE LOCK and Z-AXIS CANCEL: axes that do not move while the control counts as if they did.
//!
//! What the control counts and where an axis really stands then differ; the difference stays when the switch is turned
//! off, until the counters are set anew (power-on, emergency stop, return to the reference point).

use base::{AXES, AxisSet, Point};
use path::{Arc, Shape};

/// Which axes are held, and by how much the counted position is ahead of the real one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct AxisLock {
    /// Axes that do not move.
    pub held: AxisSet,
    /// Counted position less real position, mm and degrees.
    ahead: Point,
    /// Some axis' difference is not zero.
    differs: bool,
}

impl Default for AxisLock {
    fn default() -> Self {
        AxisLock { held: AxisSet::NONE, ahead: [0.0; AXES], differs: false }
    }
}

impl AxisLock {
    /// True if the machine does not simply do what is counted.
    pub fn acts(&self) -> bool {
        self.differs || !self.held.is_empty()
    }

    /// What the control counts while the axes stand at `real`.
    pub fn counted(&self, real: &Point) -> Point {
        let mut counted = *real;
        if self.differs {
            for axis in 0..AXES {
                counted[axis] += self.ahead[axis];
            }
        }
        counted
    }

    /// Where the axes stand while the control counts `counted`.
    pub fn uncounted(&self, counted: &Point) -> Point {
        let mut real = *counted;
        if self.differs {
            for axis in 0..AXES {
                real[axis] -= self.ahead[axis];
            }
        }
        real
    }

    /// The counters of these axes are set to where the axes really are.
    pub fn settle(&mut self, axes: AxisSet) {
        for axis in axes.iter() {
            self.ahead[axis] = 0.0;
        }
        self.differs = self.ahead.iter().any(|&mm| mm != 0.0);
    }

    /// An axis has been moved by hand without being counted.
    pub fn moved_uncounted(&mut self, axis: usize, way: f64) {
        self.counted_unmoved(axis, -way);
    }

    /// An axis that is held has been counted as if it were moved by hand.
    pub fn counted_unmoved(&mut self, axis: usize, way: f64) {
        self.ahead[axis] += way;
        self.differs = self.ahead.iter().any(|&mm| mm != 0.0);
    }

    /// The move that the axes really make of a counted one, from where they really stand. Axes that are `returned` to
    /// their reference point by it end there, for that is a place on the machine.
    pub fn real(&self, shape: &Shape, at: &Point, returned: AxisSet) -> Shape {
        match *shape {
            Shape::Rapid { from, to, kind } => {
                let counted = to;
                let (mut from, mut to) = self.ends(&from, &to, at);
                for axis in returned.without(self.held).iter() {
                    (from[axis], to[axis]) = (at[axis], counted[axis]);
                }
                Shape::Rapid { from, to, kind }
            }
            Shape::Line { from, to, feed } => {
                let (from, to) = self.ends(&from, &to, at);
                Shape::Line { from, to, feed }
            }
            Shape::Arc { arc, feed } => {
                let (from, to) = self.ends(&arc.from, &arc.to, at);
                if arc.axes.iter().any(|&axis| self.held.has(usize::from(axis))) {
                    // What is left of the arc is its shadow on the axes that move.
                    return Shape::Line { from, to, feed };
                }
                let [u, v] = arc.axes.map(usize::from);
                let center = [arc.center[0] - self.ahead[u], arc.center[1] - self.ahead[v]];
                Shape::Arc { arc: Arc { from, to, center, ..arc }, feed }
            }
            other => other,
        }
    }

    fn ends(&self, from: &Point, to: &Point, at: &Point) -> (Point, Point) {
        let (mut real_from, mut real_to) = (*at, *at);
        for axis in 0..AXES {
            if !self.held.has(axis) {
                real_from[axis] = from[axis] - self.ahead[axis];
                real_to[axis] = to[axis] - self.ahead[axis];
            }
        }
        (real_from, real_to)
    }

    /// Which of these axes are free and stand elsewhere than the control counts.
    pub fn astray(&self, axes: AxisSet) -> AxisSet {
        let mut astray = AxisSet::NONE;
        for axis in axes.without(self.held).iter().filter(|&axis| self.ahead[axis] != 0.0) {
            astray.add(axis);
        }
        astray
    }

    /// A counted move has ended at `counted` while the axes really stand at `real`.
    pub fn arrived(&mut self, counted: &Point, real: &Point) {
        for axis in self.held.iter() {
            self.ahead[axis] = counted[axis] - real[axis];
        }
        self.differs = self.ahead.iter().any(|&mm| mm != 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meaning::RapidKind;

    fn point(x: f64, z: f64) -> Point {
        let mut point = [0.0; AXES];
        (point[0], point[2]) = (x, z);
        point
    }

    #[test]
    fn a_held_axis_stays_and_keeps_its_difference() {
        let mut lock = AxisLock { held: AxisSet::only(2), ..AxisLock::default() };
        let shape = Shape::Rapid { from: point(0.0, 0.0), to: point(5.0, -3.0), kind: RapidKind::Checked };
        let real = lock.real(&shape, &point(0.0, 0.0), AxisSet::NONE);
        assert_eq!(real, Shape::Rapid { from: point(0.0, 0.0), to: point(5.0, 0.0), kind: RapidKind::Checked });
        lock.arrived(&point(5.0, -3.0), &point(5.0, 0.0));
        assert_eq!(lock.counted(&point(5.0, 0.0)), point(5.0, -3.0));
        lock.held = AxisSet::NONE;
        assert!(lock.acts(), "the difference stays");
        let back = Shape::Rapid { from: point(5.0, -3.0), to: point(5.0, -1.0), kind: RapidKind::Checked };
        let real = lock.real(&back, &point(5.0, 0.0), AxisSet::NONE);
        assert_eq!(real, Shape::Rapid { from: point(5.0, 0.0), to: point(5.0, 2.0), kind: RapidKind::Checked });
        lock.settle(AxisSet::only(2));
        assert!(!lock.acts());
    }
}
