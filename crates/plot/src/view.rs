//! How a point in mm comes to its place on the sheet: plan and isometric projection, scale, panel.

use crate::clip::{Clipped, clip};
use crate::extent::Extent;
use crate::rect::Rect;

/// The cosine of 30°, the slope of the isometric axes being one half.
pub(crate) const COS_30: f64 = 0.866_025_403_784_438_6;

/// What is drawn as a whole is at most so large, in sheet units: renderers count in single precision.
const MOST_WHOLE: f64 = 5_000.0;
/// What is so near to a panel may be seen in it: a line has a width.
const EDGE: f64 = 10.0;

/// A parallel projection.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Projection {
    /// From above: X right, Y up.
    Plan,
    /// X right and down, Y right and up, Z up, all to the same scale.
    Isometric,
}

impl Projection {
    /// A point in the flat picture, in mm: right, up.
    pub fn flat(self, [x, y, z]: [f64; 3]) -> [f64; 2] {
        match self {
            Projection::Plan => [x, y],
            Projection::Isometric => [(x + y) * COS_30, z + 0.5 * (y - x)],
        }
    }

    /// The rectangle in the flat picture that a box fills, in mm.
    pub fn flat_extent(self, extent: &Extent) -> Rect {
        let mut flat = Extent::EMPTY;
        for corner in extent.corners() {
            let [right, up] = self.flat(corner);
            flat.include([right, up, 0.0]);
        }
        Rect { x: flat.min[0], y: flat.min[1], width: flat.size(0), height: flat.size(1) }
    }

    /// The radii right and up of the picture of a circle of radius 1 in the XY plane. In both projections it is an
    /// ellipse that stands upright.
    pub fn circle_radii(self) -> [f64; 2] {
        match self {
            Projection::Plan => [1.0, 1.0],
            Projection::Isometric => [std::f64::consts::SQRT_2 * COS_30, std::f64::consts::FRAC_1_SQRT_2],
        }
    }
}

/// A projection placed on the sheet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub projection: Projection,
    /// Where on the sheet it is seen.
    pub panel: Rect,
    /// Sheet units a mm.
    pub scale: f64,
    /// The flat point in mm that lies in the middle of the panel.
    middle: [f64; 2],
}

impl View {
    /// The view of a box, as large as fits in the panel less `inset` on each side: left, top, right, bottom.
    pub fn fit(projection: Projection, extent: &Extent, panel: Rect, inset: [f64; 4]) -> View {
        let flat = projection.flat_extent(extent);
        let [left, top, right, bottom] = inset;
        let across = (panel.width - left - right) / flat.width.max(f64::MIN_POSITIVE);
        let up = (panel.height - top - bottom) / flat.height.max(f64::MIN_POSITIVE);
        let scale = across.min(up);
        let [x, y] = flat.middle();
        let middle = [x + 0.5 * (right - left) / scale, y + 0.5 * (top - bottom) / scale];
        View { projection, panel, scale, middle }
    }

    /// The place of a point in mm on the sheet; Y points down there.
    pub fn place(&self, point: [f64; 3]) -> [f64; 2] {
        let [right, up] = self.projection.flat(point);
        let [x, y] = self.panel.middle();
        [x + (right - self.middle[0]) * self.scale, y - (up - self.middle[1]) * self.scale]
    }

    /// True if the point is seen in the panel.
    pub fn shows(&self, point: [f64; 3]) -> bool {
        self.panel.contains(self.place(point))
    }

    /// The part of a line between two points in mm that is seen, on the sheet.
    pub fn line(&self, from: [f64; 3], to: [f64; 3]) -> Option<Clipped> {
        clip(&self.panel, self.place(from), self.place(to))
    }

    /// True if a part of the box may be seen in the panel.
    pub fn may_show(&self, extent: &Extent) -> bool {
        let flat = self.projection.flat_extent(extent);
        let ([x, y], room) = (flat.middle(), [self.panel.width, self.panel.height]);
        let apart = [(x - self.middle[0], flat.width), (y - self.middle[1], flat.height)];
        apart
            .into_iter()
            .zip(room)
            .all(|((apart, size), room)| apart.abs() <= 0.5 * size + (0.5 * room + EDGE) / self.scale)
    }

    /// True if the panel is a window on a small part of the box: as a whole its picture would be too large to be exact.
    pub fn is_window_on(&self, extent: &Extent) -> bool {
        let flat = self.projection.flat_extent(extent);
        flat.width.max(flat.height) * self.scale > MOST_WHOLE
    }

    /// The lowest and highest value of X (`axis` 0) or Y (1) that a plan's panel shows, in mm.
    pub fn plan_range(&self, axis: usize) -> [f64; 2] {
        let half = 0.5 * if axis == 0 { self.panel.width } else { self.panel.height } / self.scale;
        [self.middle[axis] - half, self.middle[axis] + half]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEAR: f64 = 1e-9;

    #[test]
    fn the_isometric_axes_point_where_a_draughtsman_draws_them() {
        let flat = |point| Projection::Isometric.flat(point);
        assert_eq!(flat([1.0, 0.0, 0.0]), [COS_30, -0.5]);
        assert_eq!(flat([0.0, 1.0, 0.0]), [COS_30, 0.5]);
        assert_eq!(flat([0.0, 0.0, 1.0]), [0.0, 1.0]);
    }

    #[test]
    fn a_circle_seen_isometrically_is_the_ellipse_that_is_drawn() {
        let [wide, high] = Projection::Isometric.circle_radii();
        for step in 0..36 {
            let angle = f64::from(step) * 10f64.to_radians();
            let [x, y] = Projection::Isometric.flat([angle.cos(), angle.sin(), 0.0]);
            assert!(((x / wide).powi(2) + (y / high).powi(2) - 1.0).abs() < NEAR);
        }
    }

    #[test]
    fn a_fitted_box_touches_its_inset_and_keeps_one_scale() {
        let extent = Extent { min: [0.0, 0.0, -5.0], max: [200.0, 50.0, 0.0] };
        let panel = Rect { x: 100.0, y: 50.0, width: 500.0, height: 400.0 };
        let view = View::fit(Projection::Plan, &extent, panel, [40.0, 10.0, 20.0, 30.0]);
        let [left, low] = view.place([0.0, 0.0, 0.0]);
        let [right, high] = view.place([200.0, 50.0, 0.0]);
        assert!((left - 140.0).abs() < NEAR && (right - 580.0).abs() < NEAR);
        assert!(((right - left) / 200.0 - (low - high) / 50.0).abs() < NEAR);
        assert!((low - high) < 360.0 && high > 60.0 && low < 420.0);
        let [from, to] = view.plan_range(0);
        assert!(view.shows([from, 25.0, 0.0]) && view.shows([to, 25.0, 0.0]) && !view.shows([to + 1.0, 25.0, 0.0]));
    }
}
