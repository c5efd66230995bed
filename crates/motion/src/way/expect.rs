//! What tests of ways make and expect.

use base::{AXES, Point};

use super::Way;

/// A place in the plane of the first two axes.
pub fn point(x: f64, y: f64) -> Point {
    let mut point = [0.0; AXES];
    (point[0], point[1]) = (x, y);
    point
}

/// Place, direction and bend go over from each way into the next.
pub fn steady(ways: &[Way]) {
    for pair in ways.windows(2) {
        let end = pair[0].length();
        for axis in 0..2 {
            let apart = [
                pair[0].at(end)[axis] - pair[1].at(0.0)[axis],
                pair[0].slope(end)[axis] - pair[1].slope(0.0)[axis],
                pair[0].bend(end)[axis] - pair[1].bend(0.0)[axis],
            ];
            assert!(apart.iter().all(|apart| apart.abs() < 1e-9), "{pair:?} {apart:?}");
        }
    }
}
