//! Fewer points for the same polyline: every point left out is within a tolerance of the line drawn in its place.
//!
//! Douglas and Peucker's rule, in windows of bounded length so that no input makes it slow. Because a polyline is
//! continuous, what is drawn is then nowhere farther than the tolerance from the path either.

/// The most points that one window holds.
pub(crate) const WINDOW: usize = 512;

/// Gives the points that must stay, the first and the last among them, to `keep`.
pub(crate) fn simplify(points: &[[f64; 3]], tolerance_mm: f64, keep: &mut Vec<[f64; 3]>) {
    keep.clear();
    let Some(first) = points.first() else {
        return;
    };
    keep.push(*first);
    let mut open = Vec::with_capacity(64);
    let mut start = 0;
    while start + 1 < points.len() {
        let end = (start + WINDOW).min(points.len() - 1);
        // A stack of windows, the nearest on top: what is settled comes out in order.
        open.push((start, end));
        while let Some((from, to)) = open.pop() {
            match farthest(&points[from..=to], tolerance_mm) {
                Some(within) => {
                    open.push((from + within, to));
                    open.push((from, from + within));
                }
                None => keep.push(points[to]),
            }
        }
        start = end;
    }
}

/// The index of the point farthest from the line between first and last, if it is beyond the tolerance.
fn farthest(points: &[[f64; 3]], tolerance_mm: f64) -> Option<usize> {
    let (first, last) = (*points.first()?, *points.last()?);
    let line = Line::new(first, last);
    let mut beyond = tolerance_mm * tolerance_mm;
    let mut found = None;
    for (index, point) in points.iter().enumerate().take(points.len() - 1).skip(1) {
        let squared = line.distance_squared(*point);
        if squared > beyond {
            beyond = squared;
            found = Some(index);
        }
    }
    found
}

/// A straight segment, ready for many distances.
pub(crate) struct Line {
    from: [f64; 3],
    along: [f64; 3],
    per_length_squared: f64,
}

impl Line {
    /// The segment between two points.
    pub fn new(from: [f64; 3], to: [f64; 3]) -> Line {
        let along = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let squared = dot(along, along);
        Line { from, along, per_length_squared: if squared > 0.0 { 1.0 / squared } else { 0.0 } }
    }

    /// The square of a point's distance from the segment, in mm².
    pub fn distance_squared(&self, point: [f64; 3]) -> f64 {
        let to_point = [point[0] - self.from[0], point[1] - self.from[1], point[2] - self.from[2]];
        let at = (dot(to_point, self.along) * self.per_length_squared).clamp(0.0, 1.0);
        let away =
            [to_point[0] - at * self.along[0], to_point[1] - at * self.along[1], to_point[2] - at * self.along[2]];
        dot(away, away)
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn nearest(point: [f64; 3], polyline: &[[f64; 3]]) -> f64 {
        polyline
            .windows(2)
            .map(|pair| Line::new(pair[0], pair[1]).distance_squared(point))
            .fold(f64::INFINITY, f64::min)
            .sqrt()
    }

    #[test]
    fn points_on_a_line_leave_two() {
        let points: Vec<_> = (0..400).map(|i| [f64::from(i), 2.0 * f64::from(i), 0.0]).collect();
        let mut kept = Vec::new();
        simplify(&points, 1e-6, &mut kept);
        assert_eq!(kept, [points[0], points[399]]);
    }

    #[test]
    fn a_move_that_turns_back_on_itself_keeps_its_end() {
        let mut kept = Vec::new();
        simplify(&[[0.0; 3], [10.0, 0.0, 0.0], [5.0, 0.0, 0.0]], 0.1, &mut kept);
        assert_eq!(kept.len(), 3);
    }

    proptest! {
        #[test]
        fn no_point_is_farther_than_the_tolerance(
            steps in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64, -0.3..0.3f64), 2..1500),
            tolerance in 0.01..3.0f64,
        ) {
            let mut at = [0.0; 3];
            let points: Vec<[f64; 3]> = steps.iter().map(|(x, y, z)| {
                at = [at[0] + x, at[1] + y, at[2] + z];
                at
            }).collect();
            let mut kept = Vec::new();
            simplify(&points, tolerance, &mut kept);
            prop_assert_eq!(kept.first(), points.first());
            prop_assert_eq!(kept.last(), points.last());
            for point in &points {
                prop_assert!(nearest(*point, &kept) <= tolerance * (1.0 + 1e-9));
            }
            // What is drawn is near the path too.
            for pair in kept.windows(2) {
                for part in 0..8 {
                    let t = f64::from(part) / 8.0;
                    let drawn = std::array::from_fn(|axis| pair[0][axis] + t * (pair[1][axis] - pair[0][axis]));
                    prop_assert!(nearest(drawn, &points) <= tolerance * (1.0 + 1e-9));
                }
            }
        }
    }
}
