//! Where the driven path is farthest from the commanded one, drawn so large that it is seen.

use crate::canvas::Canvas;
use crate::colour::INK;
use crate::extent::Extent;
use crate::layers::DrawnLayers;
use crate::layout::{ISOMETRIC_INSET, Layout, detail_layout};
use crate::piece::Piece;
use crate::view::{Projection, View};

/// A deviation of fewer sheet units is not seen beside the lines' own width; of so many it is seen well.
pub(crate) const SEEN: f64 = 2.0;
pub(crate) const SEEN_WELL: f64 = 8.0;

/// A window in which it is seen well is so many times as wide, and at least so wide, mm.
pub(crate) const WINDOW: f64 = 20.0;
const LEAST_WINDOW: f64 = 0.05;

/// The paths' own errors are at most this part of a window.
const ERROR_PART: f64 = 0.002;

/// A line that rises by more than this part of its longest side climbs.
const STEEP: f64 = 0.1;

/// The radius of the circle that shows in the plan where it is, in sheet units; at least.
const CIRCLE: f64 = 11.0;
/// The look of that circle.
pub(crate) const CIRCLED: &str = "stroke-width=\"1.4\"";

/// The largest deviation in a panel of its own.
pub(crate) struct Detail {
    pub view: View,
    /// The box that it shows.
    pub frame: Extent,
    /// Where the circle stands.
    pub at: [f64; 3],
}

impl Detail {
    /// The layout of a plan with a detail beside it, if there is a deviation that a plan of this scale hides.
    pub fn of(layers: &DrawnLayers, plan_scale: f64, plan: [f64; 2]) -> Option<(Layout, Detail)> {
        let farthest = layers.farthest.filter(|_| layers.exaggeration == 1.0)?;
        if farthest.by * plan_scale >= SEEN_WELL {
            return None;
        }
        let (layout, panel) = detail_layout(plan);
        let width = (farthest.by * WINDOW).max(LEAST_WINDOW).max(layers.error_mm / ERROR_PART);
        let half = 0.5 * width;
        // From above, what goes up or down lies on itself.
        let near = Extent { min: farthest.at, max: farthest.at }.grown(half);
        let climbs = |piece: &Piece| {
            let extent = piece.extent();
            let meets = (0..3).all(|axis| extent.min[axis] <= near.max[axis] && near.min[axis] <= extent.max[axis]);
            meets && extent.size(2) > STEEP * extent.span()
        };
        let is_seen_from_above = !layers.driven.iter().any(climbs);
        let projection = if is_seen_from_above { Projection::Plan } else { Projection::Isometric };
        let (half, inset) = match projection {
            Projection::Plan => ([half, half * panel.height / panel.width, half], [0.0; 4]),
            Projection::Isometric => ([0.5 * half; 3], ISOMETRIC_INSET),
        };
        let side = |sign: f64| std::array::from_fn(|axis| farthest.at[axis] + sign * half[axis]);
        let frame = Extent { min: side(-1.0), max: side(1.0) };
        let view = View::fit(projection, &frame, panel, inset);
        (farthest.by * view.scale >= SEEN).then_some((layout, Detail { view, frame, at: farthest.at }))
    }

    /// Draws in the plan where it is.
    pub fn circle(&self, canvas: &mut Canvas, plan: &View) {
        let radius = (0.5 * self.frame.size(0) * plan.scale).max(CIRCLE);
        canvas.open(&format!("stroke=\"{INK}\" {CIRCLED}"));
        canvas.circle(plan.place(self.at), radius);
        canvas.close();
    }

    /// How many times as large as in the plan it is drawn: two figures of it.
    pub fn times(&self, plan: &View) -> f64 {
        let times = self.view.scale / plan.scale;
        let ten = libm::pow(10.0, libm::log10(times).floor() - 1.0).max(1.0);
        (times / ten).round() * ten
    }
}
