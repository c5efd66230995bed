//! How near two ways in a plane come to each other: lines and arcs, exactly.

use crate::compensation::{Vector, add, angle, cross, dot, length, less, times};

/// A way in a plane, mm.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Curve {
    /// Straight from here to there.
    Line([Vector; 2]),
    /// An arc.
    Arc {
        /// Its centre.
        center: Vector,
        /// From the centre to its start.
        spoke: Vector,
        /// The angle that it sweeps, radians, + counter-clockwise.
        sweep: f64,
    },
}

impl Curve {
    /// Where it begins and ends.
    pub fn ends(&self) -> [Vector; 2] {
        match *self {
            Curve::Line(ends) => ends,
            Curve::Arc { center, spoke, sweep } => {
                let (sin, cos) = libm::sincos(sweep);
                let end = [spoke[0] * cos - spoke[1] * sin, spoke[0] * sin + spoke[1] * cos];
                [add(center, spoke), add(center, end)]
            }
        }
    }

    /// The lowest and highest coordinates that it can reach; those of the whole circle for an arc.
    pub fn bounds(&self) -> [Vector; 2] {
        match *self {
            Curve::Line([a, b]) => [[a[0].min(b[0]), a[1].min(b[1])], [a[0].max(b[0]), a[1].max(b[1])]],
            Curve::Arc { center, spoke, .. } => {
                let radius = length(spoke);
                [less(center, [radius; 2]), add(center, [radius; 2])]
            }
        }
    }

    /// How far a point is from it, mm.
    pub fn distance_to(&self, point: Vector) -> f64 {
        match *self {
            Curve::Line([from, to]) => {
                let way = less(to, from);
                let along = dot(less(point, from), way) / dot(way, way);
                // A line without length has no direction: its start is all of it.
                let along = if along.is_nan() { 0.0 } else { along.clamp(0.0, 1.0) };
                length(less(point, add(from, times(way, along))))
            }
            Curve::Arc { center, spoke, sweep } => {
                let towards = less(point, center);
                if sweeps_over(spoke, sweep, towards) {
                    return (length(towards) - length(spoke)).abs();
                }
                let [from, to] = self.ends();
                length(less(point, from)).min(length(less(point, to)))
            }
        }
    }

    /// How near another way comes, mm; 0 where they cross.
    pub fn distance(&self, other: &Curve) -> f64 {
        if self.crosses(other) {
            return 0.0;
        }
        let to = |curve: &Curve, points: [Vector; 2]| {
            points.into_iter().map(|point| curve.distance_to(point)).fold(f64::INFINITY, f64::min)
        };
        let mut nearest = to(other, self.ends()).min(to(self, other.ends()));
        for (curve, beside) in [(self, other), (other, self)] {
            let Curve::Arc { center, .. } = *beside else { continue };
            // Square to both: towards the other's centre, or away from it.
            match *curve {
                Curve::Line([from, to]) => {
                    let way = less(to, from);
                    let along = dot(less(center, from), way) / dot(way, way);
                    if along > 0.0 && along < 1.0 {
                        nearest = nearest.min(beside.distance_to(add(from, times(way, along))));
                    }
                }
                Curve::Arc { center: own, spoke, sweep } => {
                    let towards = less(center, own);
                    let apart = length(towards);
                    for sign in [1.0, -1.0] {
                        let direction = times(towards, sign / apart);
                        if apart > 0.0 && sweeps_over(spoke, sweep, direction) {
                            nearest = nearest.min(beside.distance_to(add(own, times(direction, length(spoke)))));
                        }
                    }
                }
            }
        }
        nearest
    }

    fn crosses(&self, other: &Curve) -> bool {
        match (*self, *other) {
            (Curve::Line([a, b]), Curve::Line([c, d])) => {
                let (ab, cd) = (less(b, a), less(d, c));
                let splits = |way, from, p, q| cross(way, less(p, from)) * cross(way, less(q, from)) < 0.0;
                splits(ab, a, c, d) && splits(cd, c, a, b)
            }
            (Curve::Line([from, to]), Curve::Arc { center, spoke, sweep })
            | (Curve::Arc { center, spoke, sweep }, Curve::Line([from, to])) => {
                let way = less(to, from);
                let square = dot(way, way);
                let middle = dot(less(center, from), way) / square;
                let beside = less(add(from, times(way, middle)), center);
                let half = ((dot(spoke, spoke) - dot(beside, beside)) / square).sqrt();
                // No number where the line passes the circle by.
                [middle - half, middle + half].into_iter().any(|along| {
                    (0.0..=1.0).contains(&along)
                        && sweeps_over(spoke, sweep, less(add(from, times(way, along)), center))
                })
            }
            (
                Curve::Arc { center: a, spoke: first, sweep },
                Curve::Arc { center: b, spoke: second, sweep: other_sweep },
            ) => {
                let towards = less(b, a);
                let square = dot(towards, towards);
                let along = (square + dot(first, first) - dot(second, second)) / (2.0 * square);
                let half = (dot(first, first) / square - along * along).sqrt();
                let aside = [-towards[1], towards[0]];
                [half, -half].into_iter().any(|half| {
                    let point = add(a, add(times(towards, along), times(aside, half)));
                    let [from_a, from_b] = [less(point, a), less(point, b)];
                    half.is_finite() && sweeps_over(first, sweep, from_a) && sweeps_over(second, other_sweep, from_b)
                })
            }
        }
    }
}

/// True if an arc's spoke passes this direction.
fn sweeps_over(spoke: Vector, sweep: f64, direction: Vector) -> bool {
    let turn = angle(spoke, direction) * sweep.signum();
    let turn = if turn < 0.0 { turn + std::f64::consts::TAU } else { turn };
    turn <= sweep.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Small steps along both.
    fn by_steps(a: &Curve, b: &Curve) -> f64 {
        let at = |curve: &Curve, s: f64| match *curve {
            Curve::Line([from, to]) => add(from, times(less(to, from), s)),
            Curve::Arc { center, spoke, sweep } => Curve::Arc { center, spoke, sweep: sweep * s }.ends()[1],
        };
        let steps = 400;
        let mut nearest = f64::INFINITY;
        for i in 0..=steps {
            let point = at(a, f64::from(i) / f64::from(steps));
            for j in 0..=steps {
                nearest = nearest.min(length(less(point, at(b, f64::from(j) / f64::from(steps)))));
            }
        }
        nearest
    }

    #[test]
    fn distances_agree_with_small_steps() {
        let mut seed = 7u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as f64 / f64::from(1u32 << 31) * 2.0 - 1.0
        };
        let mut point = |size: f64| [random() * size, random() * size];
        let mut crossing = 0;
        for round in 0..400 {
            let mut curve = |is_arc: bool| match is_arc {
                true => Curve::Arc { center: point(10.0), spoke: point(5.0), sweep: point(6.2)[0] },
                false => Curve::Line([point(10.0), point(10.0)]),
            };
            let (a, b) = (curve(round % 2 == 0), curve(round % 3 == 0));
            let (exact, near) = (a.distance(&b), by_steps(&a, &b));
            crossing += u32::from(exact == 0.0);
            assert!(exact <= near + 1e-12 && near - exact < 0.2, "{a:?} {b:?} {exact} {near}");
        }
        assert!((20..380).contains(&crossing), "{crossing}");
    }
}
