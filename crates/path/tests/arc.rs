//! Arcs, helices and spirals: what one question answers agrees with what another does.

use base::{AXES, AxisSet, Point};
use meaning::{ArcMove, Plane};
use path::Arc;
use proptest::prelude::*;

/// Positions along an arc of up to a few metres, mm.
const EXACTNESS_MM: f64 = 1e-9;
/// Points at which an arc is looked at.
const SAMPLES: i32 = 500;

fn coordinate() -> impl Strategy<Value = f64> + Clone {
    // Whole thousandths, as programs write them, and often the same ones.
    prop_oneof![3 => (-50_000i32..50_000).prop_map(|n| f64::from(n) / 1000.0), 1 => (-3i32..3).prop_map(f64::from)]
}

fn arc() -> impl Strategy<Value = Arc> {
    let point = [coordinate(), coordinate(), coordinate()];
    let plane = prop::sample::select(vec![(Plane::Xy, [0u8, 1]), (Plane::Zx, [2, 0]), (Plane::Yz, [1, 2])]);
    (point.clone(), point, [coordinate(), coordinate()], plane, any::<bool>(), 0u8..4).prop_filter_map(
        "an arc does not start on its centre",
        |(from, to, center, (plane, axes), clockwise, kind)| {
            let [u, v] = axes.map(usize::from);
            let wide = |p: [f64; 3]| [p[0], p[1], p[2], 0.0, 0.0, 0.0, 0.0, 0.0];
            let (from, mut to) = (wide(from), wide(to));
            let out = [from[u] - center[0], from[v] - center[1]];
            if out == [0.0, 0.0] {
                return None;
            }
            match kind {
                0 => (to[u], to[v]) = (from[u], from[v]),
                1 => (to[u], to[v]) = (center[0] - out[0], center[1] - out[1]),
                2 => (to[u], to[v]) = (center[0] - out[1], center[1] + out[0]),
                _ => {}
            }
            let full_circle = from[u] == to[u] && from[v] == to[v];
            Some(Arc::new(&from, &ArcMove { to, plane, axes, center, clockwise, full_circle }))
        },
    )
}

fn samples(arc: &Arc) -> Vec<Point> {
    (0..=SAMPLES).map(|part| arc.at(f64::from(part) / f64::from(SAMPLES))).collect()
}

fn plane_distance(arc: &Arc, a: &Point, b: &Point) -> f64 {
    let [u, v] = arc.axes.map(usize::from);
    libm::hypot(a[u] - b[u], a[v] - b[v])
}

proptest! {
    #[test]
    fn it_begins_and_ends_where_it_says_and_turns_the_way_it_says(arc in arc()) {
        prop_assert_eq!(arc.at(0.0), arc.from);
        prop_assert_eq!(arc.at(1.0), arc.to);
        prop_assert!(arc.sweep != 0.0 && arc.sweep.abs() <= std::f64::consts::TAU);
        // Just before its end it is just before its end point: the sweep leads there.
        prop_assert!(plane_distance(&arc, &arc.at(1.0 - 1e-12), &arc.to) < EXACTNESS_MM);
        prop_assert!(plane_distance(&arc, &arc.at(1e-12), &arc.from) < EXACTNESS_MM);
    }

    #[test]
    fn its_length_is_that_of_many_short_lines(arc in arc()) {
        let points = samples(&arc);
        let lines: f64 = points.windows(2).map(|pair| plane_distance(&arc, &pair[0], &pair[1])).sum();
        let length = arc.plane_length();
        prop_assert!(lines <= length * (1.0 + 1e-12) + EXACTNESS_MM, "{lines} {length}");
        // Chords of a 500th of a circle are shorter than it by less than (τ/500)²/24.
        prop_assert!(lines >= length * (1.0 - 1e-4), "{lines} {length}");
        prop_assert!(arc.length() >= length);
    }

    #[test]
    fn its_extent_holds_every_point_and_no_more(arc in arc()) {
        let (low, high) = arc.extent();
        let (mut seen_low, mut seen_high) = (arc.from, arc.from);
        for point in samples(&arc) {
            for axis in 0..AXES {
                prop_assert!(point[axis] >= low[axis] - EXACTNESS_MM, "axis {axis}: {} below {}", point[axis], low[axis]);
                prop_assert!(point[axis] <= high[axis] + EXACTNESS_MM, "axis {axis}: {} above {}", point[axis], high[axis]);
                seen_low[axis] = seen_low[axis].min(point[axis]);
                seen_high[axis] = seen_high[axis].max(point[axis]);
            }
        }
        // Between two samples a point can stand out by the sagitta of a 500th of a circle.
        let sagitta = arc.radius[0].max(arc.radius[1]) * 2e-4 + EXACTNESS_MM;
        for axis in 0..AXES {
            prop_assert!(seen_low[axis] - low[axis] <= sagitta, "axis {axis}: {} {}", seen_low[axis], low[axis]);
            prop_assert!(high[axis] - seen_high[axis] <= sagitta, "axis {axis}: {} {}", seen_high[axis], high[axis]);
        }
    }

    #[test]
    fn it_leaves_a_box_exactly_where_its_extent_says_it_does(arc in arc(), part in 0.05f64..0.95, axis in 0usize..3) {
        let axes = AxisSet(0b111);
        let (low, mut high) = arc.extent();
        let (low_wide, reach) = (low.map(|mm| mm - 1.0), high[axis]);
        high = high.map(|mm| mm + 1.0);
        prop_assert_eq!(arc.first_exit(axes, &low_wide, &high), None);
        // A border between the start and the furthest point is crossed, and up to there it is not.
        high[axis] = arc.from[axis] + (reach - arc.from[axis]) * part;
        if reach - high[axis] <= 1e-6 || high[axis] < arc.from[axis] {
            return Ok(()); // it does not go that way
        }
        let exit = arc.first_exit(axes, &low_wide, &high);
        prop_assert!(exit.is_some());
        if let Some((s, which)) = exit {
            prop_assert_eq!(which, axis);
            prop_assert!((arc.at(s)[axis] - high[axis]).abs() < 1e-6, "{} {}", arc.at(s)[axis], high[axis]);
            for part in 0..=SAMPLES {
                let here = s * f64::from(part) / f64::from(SAMPLES);
                prop_assert!(arc.at(here)[axis] <= high[axis] + EXACTNESS_MM);
            }
        }
    }

    #[test]
    fn mirrored_and_reversed_arcs_agree(arc in arc()) {
        let [u, _] = arc.axes.map(usize::from);
        let clockwise = arc.sweep < 0.0;
        let full_circle = plane_distance(&arc, &arc.from, &arc.to) == 0.0;
        let flip = |mut point: Point| {
            point[u] = -point[u];
            point
        };
        let mirrored = Arc::new(&flip(arc.from), &ArcMove {
            to: flip(arc.to), plane: arc.plane, axes: arc.axes, center: [-arc.center[0], arc.center[1]],
            clockwise: !clockwise, full_circle,
        });
        prop_assert!((mirrored.sweep + arc.sweep).abs() < 1e-12);
        prop_assert!((mirrored.length() - arc.length()).abs() < EXACTNESS_MM);
        let back = Arc::new(&arc.to, &ArcMove {
            to: arc.from, plane: arc.plane, axes: arc.axes, center: arc.center, clockwise: !clockwise, full_circle,
        });
        prop_assert!((back.sweep + arc.sweep).abs() < 1e-12);
        prop_assert!((back.length() - arc.length()).abs() < EXACTNESS_MM);
        let (middle, same) = (arc.at(0.5), back.at(0.5));
        prop_assert!((0..3).all(|axis| (middle[axis] - same[axis]).abs() < EXACTNESS_MM), "{middle:?} {same:?}");
    }
}
