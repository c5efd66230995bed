//! Where things stand on the sheet: header, the two views, legend and notes.
//!
//! The views stand side by side or one above the other, with the room parted so that both are as large as can be.

use crate::rect::Rect;

/// The width of the sheet in sheet units; a unit is about a point of print on A4. A plan alone takes less.
pub(crate) const SHEET_WIDTH: f64 = 1600.0;
const PLAN_WIDTH: f64 = 1000.0;

/// The white margin at each side.
pub(crate) const MARGIN: f64 = 48.0;

/// The room for the plan's tick labels at its left and below.
pub(crate) const PLAN_LABELS: [f64; 2] = [62.0, 30.0];

/// What a view keeps free inside its panel: left, top, right, bottom.
pub(crate) const PLAN_INSET: [f64; 4] = [26.0; 4];
pub(crate) const ISOMETRIC_INSET: [f64; 4] = [64.0, 44.0, 64.0, 52.0];

/// Where the first panel's top is: below the header and the view's heading.
const VIEWS_TOP: f64 = 154.0;

/// The height of a view's heading.
const HEADING: f64 = 34.0;

/// The room between views side by side.
const BETWEEN: f64 = 44.0;

/// The least and the greatest height of the views together. With header and legend, the greatest gives A4 landscape.
const VIEWS_HEIGHT: [f64; 2] = [430.0, 850.0];

/// The same of a plan alone.
const PLAN_HEIGHT: [f64; 2] = [260.0, 680.0];

/// A plan beside a detail has this part of the width, and both are at least so high.
const PLAN_BESIDE_DETAIL: f64 = 0.54;
const DETAIL_HEIGHT: f64 = 520.0;

/// The least room for a panel.
const LEAST_PANEL: f64 = 130.0;

/// Views one above the other must be this much larger to be preferred, as a ratio of scale in both.
const SIDE_BY_SIDE_IS_BETTER: f64 = 1.1;

/// The places of the parts.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Layout {
    /// The width of the sheet.
    pub width: f64,
    pub plan: Rect,
    pub isometric: Option<Rect>,
    /// Where the room below the views begins.
    pub views_bottom: f64,
}

/// One way to part the room, with the height each view needs of it.
struct Arrangement {
    layout: Layout,
    /// Greater is better: the logarithm of both scales.
    worth: f64,
}

/// The best layout for flat pictures of these sizes (width, height, in mm).
pub(crate) fn layout(plan: [f64; 2], isometric: [f64; 2]) -> Layout {
    let parts = || (20..=80).map(|percent| f64::from(percent) / 100.0);
    let side_by_side = parts().map(|part| beside(plan, isometric, part));
    let stacked = parts().map(|part| above(plan, isometric, part));
    let mut best = beside(plan, isometric, 0.5);
    for other in side_by_side.chain(stacked) {
        if other.worth > best.worth + 1e-9 {
            best = other;
        }
    }
    best.layout
}

/// The layout of a plan alone, for a flat picture of this size.
pub(crate) fn plan_layout(plan: [f64; 2], inset: [f64; 4]) -> Layout {
    let width = PLAN_WIDTH - 2.0 * MARGIN - PLAN_LABELS[0];
    let (_, height) = fitted(plan, width, PLAN_HEIGHT[1], inset);
    let plan = Rect { x: MARGIN + PLAN_LABELS[0], y: VIEWS_TOP, width, height: height.max(PLAN_HEIGHT[0]) };
    Layout { width: PLAN_WIDTH, plan, isometric: None, views_bottom: plan.bottom() + PLAN_LABELS[1] }
}

/// The layout of a plan of this size with a detail beside it, and the detail's panel.
pub(crate) fn detail_layout(plan: [f64; 2]) -> (Layout, Rect) {
    let room = SHEET_WIDTH - 2.0 * MARGIN - 2.0 * PLAN_LABELS[0] - BETWEEN;
    let width = room * PLAN_BESIDE_DETAIL;
    let (_, height) = fitted(plan, width, VIEWS_HEIGHT[1] - PLAN_LABELS[1], PLAN_INSET);
    let plan = Rect { x: MARGIN + PLAN_LABELS[0], y: VIEWS_TOP, width, height: height.max(DETAIL_HEIGHT) };
    let x = plan.right() + BETWEEN + PLAN_LABELS[0];
    let detail = Rect { x, width: SHEET_WIDTH - MARGIN - x, ..plan };
    (Layout { width: SHEET_WIDTH, plan, isometric: None, views_bottom: plan.bottom() + PLAN_LABELS[1] }, detail)
}

/// The scale at which a picture fits a panel, and the panel's height that it needs then.
fn fitted(size: [f64; 2], width: f64, height: f64, inset: [f64; 4]) -> (f64, f64) {
    let [left, top, right, bottom] = inset;
    let across = (width - left - right) / size[0].max(f64::MIN_POSITIVE);
    let up = (height - top - bottom) / size[1].max(f64::MIN_POSITIVE);
    let scale = across.min(up);
    (scale, (scale * size[1] + top + bottom).max(LEAST_PANEL).min(height))
}

fn beside(plan: [f64; 2], isometric: [f64; 2], part: f64) -> Arrangement {
    let room = SHEET_WIDTH - 2.0 * MARGIN - PLAN_LABELS[0] - BETWEEN;
    let (plan_width, isometric_width) = (room * part, room * (1.0 - part));
    let most = VIEWS_HEIGHT[1] - PLAN_LABELS[1];
    let (plan_scale, plan_height) = fitted(plan, plan_width, most, PLAN_INSET);
    let (isometric_scale, isometric_height) = fitted(isometric, isometric_width, most, ISOMETRIC_INSET);
    let height = plan_height.max(isometric_height).max(VIEWS_HEIGHT[0]);
    let plan = Rect { x: MARGIN + PLAN_LABELS[0], y: VIEWS_TOP, width: plan_width, height };
    let isometric = Rect { x: plan.right() + BETWEEN, y: VIEWS_TOP, width: isometric_width, height };
    let views_bottom = plan.bottom() + PLAN_LABELS[1];
    let layout = Layout { width: SHEET_WIDTH, plan, isometric: Some(isometric), views_bottom };
    Arrangement { layout, worth: worth(plan_scale, isometric_scale) + 2.0 * libm::log(SIDE_BY_SIDE_IS_BETTER) }
}

fn above(plan: [f64; 2], isometric: [f64; 2], part: f64) -> Arrangement {
    let width = SHEET_WIDTH - 2.0 * MARGIN - PLAN_LABELS[0];
    let room = VIEWS_HEIGHT[1] - PLAN_LABELS[1] - HEADING;
    let (plan_scale, plan_height) = fitted(plan, width, room * part, PLAN_INSET);
    let (isometric_scale, isometric_height) = fitted(isometric, width, room * (1.0 - part), ISOMETRIC_INSET);
    let x = MARGIN + PLAN_LABELS[0];
    let plan = Rect { x, y: VIEWS_TOP, width, height: plan_height };
    let top = plan.bottom() + PLAN_LABELS[1] + HEADING;
    let isometric = Rect { x, y: top, width, height: isometric_height };
    let layout = Layout { width: SHEET_WIDTH, plan, isometric: Some(isometric), views_bottom: isometric.bottom() };
    Arrangement { layout, worth: worth(plan_scale, isometric_scale) }
}

fn worth(plan_scale: f64, isometric_scale: f64) -> f64 {
    libm::log(plan_scale.max(f64::MIN_POSITIVE)) + libm::log(isometric_scale.max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plate_stands_beside_its_isometric_and_a_bar_above_it() {
        let views = |plan, isometric| {
            let layout = layout(plan, isometric);
            (layout.plan, layout.isometric.expect("both views"))
        };
        let (plan, isometric) = views([200.0, 150.0], [303.0, 195.0]);
        assert!(plan.right() < isometric.x && plan.y == isometric.y);
        let (plan, isometric) = views([1000.0, 20.0], [883.0, 520.0]);
        assert!(plan.bottom() < isometric.y && plan.width > 1300.0);
        let (plan, isometric) = views([20.0, 1000.0], [883.0, 520.0]);
        assert!(plan.right() < isometric.x && plan.width < 400.0);
    }

    #[test]
    fn everything_stays_on_the_sheet() {
        for (plan, isometric) in [([1.0, 1.0], [2.0, 1.0]), ([1e6, 1e-6], [1e6, 1e6]), ([1e-9, 1e-9], [1e-9, 3.0])] {
            let layout = layout(plan, isometric);
            for panel in [layout.plan, layout.isometric.expect("both views")] {
                assert!(panel.x >= MARGIN && panel.right() <= SHEET_WIDTH - MARGIN + 1e-6, "{layout:?}");
                assert!(panel.height >= LEAST_PANEL && panel.bottom() <= layout.views_bottom, "{layout:?}");
            }
        }
    }
}
