//! From where the path is seen, and how much of it.

use crate::extent::Extent;

/// The height of a window for each of its width.
const WINDOW_HEIGHT: f64 = 0.7;

/// From where the path is seen.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Look {
    /// Plan and isometric.
    Both,
    /// From above only.
    Plan,
    /// From above, and only what is around a place: X, Y in mm, and so many mm in width.
    Around([f64; 2], f64),
}

impl Look {
    /// What is shown of a frame.
    pub(crate) fn frame(&self, frame: Extent) -> Extent {
        let Look::Around([x, y], width) = self else { return frame };
        let half = [width / 2.0, width / 2.0 * WINDOW_HEIGHT];
        let at = |side: f64, z: f64| [x + side * half[0], y + side * half[1], z];
        Extent { min: at(-1.0, frame.min[2]), max: at(1.0, frame.max[2]) }
    }

    /// What is left free around it: left, top, right, bottom.
    pub(crate) fn inset(&self, whole: [f64; 4]) -> [f64; 4] {
        if matches!(self, Look::Around(..)) { [0.0; 4] } else { whole }
    }
}
