//! Where holes are: one place repeated, a row, a circle. G70 and G72 make such places of their words.

use base::{AXES, Point};

/// The places of a block's holes (counts, machine coordinates).
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Places {
    /// `count` places, each `step` further than the one before.
    Row { first: Point, step: Point, count: u32 },
    /// `count` places on a circle; the other axes stand at `level`. The arms lead from the centre to 0 and 90 degrees.
    Circle {
        level: Point,
        axes: [u8; 2],
        center: [f64; 2],
        arms: [[f64; 2]; 2],
        first_deg: f64,
        step_deg: f64,
        count: u32,
    },
}

impl Places {
    /// How many there are.
    pub fn count(&self) -> u32 {
        match self {
            Places::Row { count, .. } | Places::Circle { count, .. } => *count,
        }
    }

    /// The place of this index, from 0.
    pub fn at(&self, index: u32) -> Point {
        match *self {
            Places::Row { first, step, .. } => {
                let mut place = first;
                for axis in 0..AXES {
                    place[axis] += step[axis] * f64::from(index);
                }
                place
            }
            Places::Circle { level, axes, center, arms: [first, second], first_deg, step_deg, .. } => {
                let (sin, cos) = sin_cos_deg(first_deg + step_deg * f64::from(index));
                let mut place = level;
                place[usize::from(axes[0])] = center[0] + (first[0] * cos + second[0] * sin);
                place[usize::from(axes[1])] = center[1] + (first[1] * cos + second[1] * sin);
                place
            }
        }
    }
}

/// Sine and cosine of an angle in degrees, exact at the quarters.
pub(crate) fn sin_cos_deg(degrees: f64) -> (f64, f64) {
    let turn = degrees % 360.0;
    match turn {
        0.0 => (0.0, 1.0),
        90.0 | -270.0 => (1.0, 0.0),
        180.0 | -180.0 => (0.0, -1.0),
        270.0 | -90.0 => (-1.0, 0.0),
        _ => libm::sincos(turn.to_radians()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bolt_circle_meets_its_axes_exactly() {
        let circle = Places::Circle {
            level: [0.0; AXES],
            axes: [0, 1],
            center: [0.0, 0.0],
            arms: [[40e6, 0.0], [0.0, 40e6]],
            first_deg: 30.0,
            step_deg: 60.0,
            count: 6,
        };
        assert_eq!(circle.at(1)[..2], [0.0, 40e6]);
        assert_eq!(circle.at(4)[..2], [0.0, -40e6]);
        assert!((circle.at(0)[0] - 34_641_016.151).abs() < 1.0 && (circle.at(0)[1] - 20e6).abs() < 1e-6);
    }
}
