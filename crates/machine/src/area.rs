//! The second stored stroke area: a box that no axis may enter, or none may leave. Lines, arcs and rapids at the axes'
//! own rates are judged by their true course, not by samples of it.

use base::{AXES, Point};
use meaning::StrokeArea;
use path::{Arc, Shape};

use crate::travel::{EXACTNESS, Met, Travel, along, at_own_rates};

/// Halvings that find the place on an arc to the last digit.
const HALVINGS: usize = 60;

/// What a move does to the area.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Offence {
    /// It enters a forbidden box at this point.
    Enters(Point),
    /// It leaves an allowed box; the furthest coordinate it would reach, and the box along that axis.
    Leaves([f64; 3]),
}

/// Where a move first offends against the area, and how.
pub fn offence(area: &StrokeArea, shape: &Shape, rates: Option<&Point>) -> Option<(Met, Offence)> {
    if area.outside {
        let allowed = Travel { low: area.low, high: area.high, axes: area.axes };
        let (exit, met) = allowed.meets(shape, rates)?;
        return Some((met, Offence::Leaves([exit.reaches, area.low[exit.axis], area.high[exit.axis]])));
    }
    let (met, at) = match shape {
        Shape::Rapid { from, to, .. } => match rates {
            Some(rates) => dog_leg(area, from, to, rates)?,
            None => line(area, from, to)?,
        },
        Shape::Line { from, to, .. } => line(area, from, to)?,
        Shape::Arc { arc, .. } => curve(area, arc)?,
        _ => return None,
    };
    Some((met, Offence::Enters(at)))
}

/// The stretch of 0 to 1 in which a point is inside on every axis so far, and the axis that came in last.
#[derive(Clone, Copy)]
struct Stretch {
    start: f64,
    end: f64,
    axis: Option<usize>,
}

impl Stretch {
    fn narrow(&mut self, axis: usize, start: f64, end: f64) {
        if self.axis.is_none() || start > self.start {
            self.axis = Some(axis);
        }
        self.start = self.start.max(start);
        self.end = self.end.min(end);
    }
}

fn met(area: &StrokeArea, axis: usize, at: f64, entering_from: &Point) -> Met {
    let from_below = entering_from[axis] <= (area.low[axis] + area.high[axis]) / 2.0;
    Met { axis, at, border: if from_below { area.low[axis] } else { area.high[axis] } }
}

/// On a straight way, as a fraction of it.
fn line(area: &StrokeArea, from: &Point, to: &Point) -> Option<(Met, Point)> {
    let mut inside = Stretch { start: 0.0, end: 1.0, axis: None };
    for axis in area.axes.iter() {
        let (low, high) = (area.low[axis] + EXACTNESS, area.high[axis] - EXACTNESS);
        let way = to[axis] - from[axis];
        if way == 0.0 {
            if from[axis] <= low || from[axis] >= high {
                return None;
            }
            continue;
        }
        let (one, other) = ((low - from[axis]) / way, (high - from[axis]) / way);
        inside.narrow(axis, one.min(other), one.max(other));
    }
    if inside.start.max(0.0) >= inside.end.min(1.0) {
        return None;
    }
    let at = inside.start.max(0.0);
    let axis = inside.axis.or_else(|| area.axes.iter().next())?;
    Some((met(area, axis, at, from), along(from, to, at)))
}

/// On a way on which every axis runs at its own rate until it arrives, as minutes since its start.
fn dog_leg(area: &StrokeArea, from: &Point, to: &Point, rates: &Point) -> Option<(Met, Point)> {
    let mut start = *from;
    let mut since = 0.0;
    // One axis after the other arrives; between two arrivals the way is straight.
    for _ in 0..AXES {
        let arrivals = (0..AXES).map(|axis| (to[axis] - from[axis]).abs() / rates[axis]);
        let until = arrivals.filter(|&at| at > since).fold(f64::INFINITY, f64::min);
        if until == f64::INFINITY {
            break;
        }
        let end = at_own_rates(from, to, rates, until);
        if let Some((mut met, at)) = line(area, &start, &end) {
            met.at = since + (until - since) * met.at;
            return Some((met, at));
        }
        (start, since) = (end, until);
    }
    None
}

/// On an arc, as a fraction of its sweep: between two points at which an axis turns round every axis runs one way.
fn curve(area: &StrokeArea, arc: &Arc) -> Option<(Met, Point)> {
    let (lowest, highest) = arc.extent();
    if area.axes.iter().any(|axis| highest[axis] <= area.low[axis] || lowest[axis] >= area.high[axis]) {
        return None;
    }
    let mut from = 0.0;
    for to in arc.turning_points().chain([1.0]) {
        let mut inside = Stretch { start: from, end: to, axis: None };
        for axis in area.axes.iter() {
            let (start, end) = stretch_of(arc, axis, [from, to], [area.low[axis], area.high[axis]]);
            inside.narrow(axis, start, end);
        }
        if inside.start < inside.end {
            let axis = inside.axis?;
            return Some((met(area, axis, inside.start, &arc.at(from)), arc.at(inside.start)));
        }
        from = to;
    }
    None
}

/// The stretch of `part`, in which an axis runs one way, where it is between two limits; empty if it never is.
fn stretch_of(arc: &Arc, axis: usize, part: [f64; 2], limits: [f64; 2]) -> (f64, f64) {
    let (low, high) = (limits[0] + EXACTNESS, limits[1] - EXACTNESS);
    let [first, last] = part.map(|s| arc.at(s)[axis]);
    let rises = last >= first;
    let (bottom, top) = if rises { (first, last) } else { (last, first) };
    if top <= low || bottom >= high {
        return (part[1], part[0]);
    }
    // Where the axis passes a limit in its direction.
    let pass = |limit: f64| {
        let [mut before, mut after] = part;
        for _ in 0..HALVINGS {
            let middle = (before + after) / 2.0;
            if (arc.at(middle)[axis] < limit) == rises { before = middle } else { after = middle }
        }
        before
    };
    let (entry, leave) = if rises { (low, high) } else { (high, low) };
    let is_past = |value: f64, limit: f64| if rises { value >= limit } else { value <= limit };
    let start = if is_past(first, entry) { part[0] } else { pass(entry) };
    let end = if is_past(last, leave) { pass(leave) } else { part[1] };
    (start, end)
}

#[cfg(test)]
mod tests {
    use base::AxisSet;
    use meaning::{ArcMove, Feed, Plane};

    use super::*;

    fn point(x: f64, y: f64, z: f64) -> Point {
        let mut point = [0.0; AXES];
        point[..3].copy_from_slice(&[x, y, z]);
        point
    }

    fn unit() -> StrokeArea {
        StrokeArea { axes: AxisSet(0b111), low: point(0.0, 0.0, 0.0), high: point(10.0, 10.0, 10.0), outside: false }
    }

    #[test]
    fn a_line_enters_through_the_face_it_meets_last() {
        let (met, at) = line(&unit(), &point(-10.0, -5.0, 5.0), &point(10.0, 15.0, 5.0)).expect("it enters");
        assert_eq!(met.axis, 0);
        assert!((met.at - 0.5).abs() < 1e-9 && (at[0]).abs() < 1e-8 && (at[1] - 5.0).abs() < 1e-8);
        assert!(line(&unit(), &point(-10.0, 0.0, 5.0), &point(20.0, 0.0, 5.0)).is_none(), "along a face");
        assert!(line(&unit(), &point(-5.0, 5.0, 5.0), &point(0.0, 5.0, 5.0)).is_none(), "up to a face");
        assert!(line(&unit(), &point(-5.0, 5.0, 0.0), &point(5.0, -5.0, 20.0)).is_none(), "past an edge");
    }

    #[test]
    fn a_dog_leg_enters_where_a_straight_way_would_not() {
        // X arrives after 10 mm, then Y runs on alone at X = 5.
        let (from, to, rates) = (point(-5.0, -20.0, 5.0), point(5.0, 20.0, 5.0), point(1.0, 1.0, 1.0));
        let (met, at) = dog_leg(&unit(), &from, &to, &rates).expect("it enters");
        assert_eq!(met.axis, 1);
        assert!((met.at - 20.0).abs() < 1e-6 && (at[0] - 5.0).abs() < 1e-6 && at[1].abs() < 1e-6);
        let past = point(-5.0, -5.0, 20.0);
        assert!(dog_leg(&unit(), &past, &point(5.0, 5.0, 15.0), &rates).is_none());
    }

    #[test]
    fn an_arc_that_dips_in_for_a_hair_is_found() {
        // A circle of radius 10 about (5, 19.999): its lowest point dips a thousandth into the box.
        let arc = |y: f64| {
            let from = point(15.0, y, 5.0);
            let of = ArcMove {
                to: point(-5.0, y, 5.0),
                plane: Plane::Xy,
                axes: [0, 1],
                center: [5.0, y],
                clockwise: true,
                full_circle: false,
            };
            Arc::new(&from, &of)
        };
        let (met, at) = curve(&unit(), &arc(19.999)).expect("it dips in");
        assert_eq!((met.axis, met.border), (1, 10.0));
        assert!((at[1] - 10.0).abs() < 1e-8 && (at[0] - 5.1414).abs() < 1e-3, "{at:?}");
        assert!(curve(&unit(), &arc(20.0)).is_none(), "it touches");
        let shape = Shape::Arc {
            arc: arc(19.999),
            feed: Feed { mm_per_min: 1.0, exact_stop: false, tapping: false, per_revolution: false, way_mm: 0.0 },
        };
        assert!(offence(&StrokeArea { outside: true, ..unit() }, &shape, None).is_some(), "it begins outside");
    }

    /// Numbers in no order, the same every time.
    struct Numbers(u64);

    impl Numbers {
        /// A whole number of tenths up to ± `most` mm.
        fn next(&mut self, most: u64) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((self.0 >> 33) % (20 * most + 1)) as f64 / 10.0 - most as f64
        }

        fn point(&mut self) -> Point {
            point(self.next(20), self.next(20), self.next(20))
        }
    }

    /// What small steps see of a move: whether any of them is inside by more than a hair.
    fn seen(area: &StrokeArea, at: impl Fn(f64) -> Point) -> Option<f64> {
        let inside = |p: &Point| area.axes.iter().all(|a| p[a] > area.low[a] + 1e-6 && p[a] < area.high[a] - 1e-6);
        (0..=2000).map(|step| f64::from(step) / 2000.0).find(|&s| inside(&at(s)))
    }

    fn check(area: &StrokeArea, found: Option<(Met, Point)>, whole: f64, at: impl Fn(f64) -> Point) {
        let seen = seen(area, |s| at(s * whole)).map(|s| s * whole);
        if let Some(seen) = seen {
            let (met, _) = found.expect("small steps see it enter");
            assert!(met.at <= seen + 1e-9, "{} {seen}", met.at);
        }
        if let Some((met, place)) = found {
            let near = |axis: usize| place[axis] > area.low[axis] - 1e-6 && place[axis] < area.high[axis] + 1e-6;
            assert!(area.axes.iter().all(near), "it enters at the box: {place:?}");
            let on_face = (place[met.axis] - met.border).abs() < 1e-6;
            assert!(on_face || met.at == 0.0, "{met:?} {place:?}");
            assert!(seen.is_none_or(|seen| seen - met.at < 0.001 * whole || on_face), "{met:?}");
        }
    }

    #[test]
    fn what_is_found_is_what_small_steps_see() {
        let (mut numbers, rates) = (Numbers(1), point(3.0, 5.0, 2.0));
        for round in 0..3000 {
            let (from, to, area) = (numbers.point(), numbers.point(), unit());
            check(&area, line(&area, &from, &to), 1.0, |s| along(&from, &to, s));
            check(&area, dog_leg(&area, &from, &to, &rates), 20.0, |t| at_own_rates(&from, &to, &rates, t));
            let of = ArcMove {
                to,
                plane: Plane::Xy,
                axes: [0, 1],
                center: [numbers.next(20), numbers.next(20)],
                clockwise: round % 2 == 0,
                full_circle: false,
            };
            let arc = Arc::new(&from, &of);
            if arc.radius[0] > 0.0 && arc.radius[1] > 0.0 {
                check(&area, curve(&area, &arc), 1.0, |s| arc.at(s));
            }
        }
    }
}
