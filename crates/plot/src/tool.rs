//! The places at which the tool is drawn as a circle: the ends of its moves, thinned out until circles can be told apart.

use std::collections::BTreeSet;

use crate::view::View;

/// More places than this are not kept.
const MOST_KEPT: usize = 20_000;

/// More circles than this are not drawn.
const MOST_DRAWN: usize = 80;

/// The least distance of two places that are kept, at first, in mm.
const FIRST_CELL_MM: f64 = 1e-3;

/// Circles on the sheet stay so far apart: sheet units, and parts of their radius.
const APART: f64 = 6.0;
const APART_PART: f64 = 0.3;

/// Places of the tool, with its radius there.
#[derive(Clone, Debug, Default)]
pub(crate) struct ToolPlaces {
    kept: Vec<([f64; 3], f64)>,
    cells: BTreeSet<[i64; 3]>,
    /// Two places in one cell are one; 0 before there are any.
    cell_mm: f64,
}

impl ToolPlaces {
    /// The tool stands here, all in mm.
    pub fn add(&mut self, at: [f64; 3], radius: f64) {
        self.cell_mm = self.cell_mm.max(FIRST_CELL_MM);
        if !self.cells.insert(cell(at, radius, self.cell_mm)) {
            return;
        }
        self.kept.push((at, radius));
        while self.kept.len() > MOST_KEPT {
            self.cell_mm *= 2.0;
            let (cell_mm, cells) = (self.cell_mm, &mut self.cells);
            cells.clear();
            self.kept.retain(|(at, radius)| cells.insert(cell(*at, *radius, cell_mm)));
        }
    }

    /// The circles on the sheet: where, and their radius in sheet units.
    pub fn circles(&self, view: &View) -> Vec<([f64; 2], f64)> {
        let all: Vec<_> = self.kept.iter().map(|(at, radius)| (view.place(*at), radius * view.scale)).collect();
        let mut apart = 1.0;
        loop {
            let mut chosen: Vec<([f64; 2], f64)> = Vec::new();
            for (at, radius) in &all {
                let least = (radius * APART_PART).max(APART) * apart;
                let is_near = |(other, size): &([f64; 2], f64)| {
                    size == radius && libm::hypot(other[0] - at[0], other[1] - at[1]) < least
                };
                if !chosen.iter().any(is_near) {
                    chosen.push((*at, *radius));
                }
                if chosen.len() > MOST_DRAWN {
                    break;
                }
            }
            if chosen.len() <= MOST_DRAWN {
                return chosen;
            }
            apart *= 1.5;
        }
    }
}

fn cell([x, y, _]: [f64; 3], radius: f64, cell_mm: f64) -> [i64; 3] {
    [x, y, radius].map(|value| (value / cell_mm).round() as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extent::Extent;
    use crate::rect::Rect;
    use crate::view::Projection;

    #[test]
    fn a_long_way_in_small_steps_is_a_bounded_number_of_circles() {
        let mut places = ToolPlaces::default();
        for step in 0..200_000 {
            let angle = f64::from(step) * 1e-4;
            places.add([50.0 * libm::cos(angle) + angle, 50.0 * libm::sin(angle), 0.0], 5.0);
        }
        assert!(places.kept.len() <= MOST_KEPT && places.kept.len() > 1_000);
        let extent = Extent { min: [-50.0, -50.0, 0.0], max: [70.0, 50.0, 0.0] };
        let panel = Rect { x: 0.0, y: 0.0, width: 600.0, height: 500.0 };
        let view = View::fit(Projection::Plan, &extent, panel, [0.0; 4]);
        let circles = places.circles(&view);
        assert!((20..=MOST_DRAWN).contains(&circles.len()), "{}", circles.len());
        assert!(circles.iter().all(|(_, radius)| (radius - 25.0).abs() < 1e-9));
    }
}
