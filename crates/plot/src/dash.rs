//! Dashed lines whose dashes lie on fixed places of the sheet.
//!
//! A rapid out and back, or several over one another, would fill each other's gaps and look solid. Here the dashes
//! depend only on where the line lies, not on where it starts, so lines on top of each other have the same dashes.

use crate::path_data::PathData;

/// The length of a dash with its gap, and of the dash, in sheet units.
const PERIOD: f64 = 10.0;
const DASH: f64 = 6.0;

/// A line's ends are always drawn to this length, so that corners show.
const END: f64 = 1.5;

/// Draws a dashed line.
pub(crate) fn dash(path: &mut PathData, from: [f64; 2], to: [f64; 2]) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = libm::hypot(along[0], along[1]);
    if length < END {
        return path.line(from, to);
    }
    // The same direction for a line and its reverse: to the right, or down if it is upright.
    let upright = along[0].abs() < 1e-6 * length;
    let reversed = if upright { along[1] < 0.0 } else { along[0] < 0.0 };
    let (start, end) = if reversed { (to, from) } else { (from, to) };
    let direction = [(end[0] - start[0]) / length, (end[1] - start[1]) / length];
    let first = start[0] * direction[0] + start[1] * direction[1];
    let mut draw = |low: f64, high: f64| {
        let at = |s: f64| [start[0] + s * direction[0], start[1] + s * direction[1]];
        path.line(at(low), at(high));
    };
    let mut dash = (first / PERIOD).floor() * PERIOD - first;
    while dash < length {
        let (low, high) = (dash.max(0.0), (dash + DASH).min(length));
        let low = if low < END { 0.0 } else { low };
        let high = if high > length - END { length } else { high };
        if high > low {
            draw(low, high);
        }
        // The ends of the line that fall into a gap.
        let gap = dash + DASH;
        if gap <= 0.0 && dash + PERIOD >= END {
            draw(0.0, END);
        }
        if gap <= length - END && dash + PERIOD > length {
            draw(length - END, length);
        }
        dash += PERIOD;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(from: [f64; 2], to: [f64; 2]) -> String {
        let mut path = PathData::default();
        dash(&mut path, from, to);
        path.finish().concat()
    }

    #[test]
    fn a_line_and_its_reverse_have_the_same_dashes() {
        assert_eq!(drawn([3.0, 7.0], [93.0, 51.0]), drawn([93.0, 51.0], [3.0, 7.0]));
        assert_eq!(drawn([3.0, 7.0], [3.0, 51.0]), drawn([3.0, 51.0], [3.0, 7.0]));
    }

    #[test]
    fn dashes_lie_on_fixed_places_and_ends_are_drawn() {
        assert_eq!(drawn([0.0, 5.0], [26.0, 5.0]), "M0 5l6 0M10 5l6 0M20 5l6 0");
        assert_eq!(drawn([8.0, 5.0], [19.5, 5.0]), "M8 5l1.5 0M10 5l6 0M18 5l1.5 0");
        assert_eq!(drawn([-3.0, 5.0], [2.0, 5.0]), "M-3 5l1.5 0M0 5l2 0");
    }
}
