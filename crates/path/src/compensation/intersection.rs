//! Where the tool's centre is beside two elements at once.
//!
//! Everything is counted from the foot of the first element's normal at the corner: `a` along that normal, `u` along its
//! tangent. Beside an element of curvature κ the centre runs where `κ(a² + u²)/2 + (sκ − 1)a = 0`; beside the next one,
//! turned by θ, where `κ(a² + u²)/2 + (sκ − cos θ)a + u sin θ + s(1 − cos θ) = 0`. A line is κ = 0, so one pair of
//! equations serves lines and arcs, and no centre far away spends any digits.

/// A corner between two elements.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Bend {
    /// Cosine of the turn from the first element's end to the second one's start.
    pub cos: f64,
    /// Its sine: positive to the left.
    pub sin: f64,
    /// Curvature of the first element at its end and of the second one at its start.
    pub curvature: [f64; 2],
}

impl Bend {
    /// 1 − cos θ, without loss where the turn is small.
    pub fn versine(&self) -> f64 {
        if self.cos > 0.0 { self.sin * self.sin / (1.0 + self.cos) } else { 1.0 - self.cos }
    }

    /// The place beside both elements by `s` (left positive) that lies nearest the corner, as `a` and `u`.
    pub fn meeting(&self, s: f64) -> Option<[f64; 2]> {
        let Bend { cos, sin, curvature: [first, second] } = *self;
        let versine = self.versine();
        if first == 0.0 && second == 0.0 {
            // Half the tangent: sin/(1 + cos), which is (1 − cos)/sin where the turn is large.
            let half = if cos > 0.0 { sin / (1.0 + cos) } else { versine / sin };
            return half.is_finite().then_some([0.0, -s * half]);
        }
        // Both equations together leave a straight line: A·a + B·u = C.
        let scale = first.abs().max(second.abs());
        let [k1, k2] = [first / scale, second / scale];
        let (a, b, c) = (k1 * cos - k2, -k1 * sin, k1 * s * versine);
        let square = a * a + b * b;
        let foot = [c / square * a, c / square * b];
        let along = [-b / square.sqrt(), a / square.sqrt()];
        // The one that bends more tells where on that line.
        let [fa, fu, constant, bend] = if first.abs() > second.abs() {
            [s * first - 1.0, 0.0, 0.0, first]
        } else {
            [s * second - cos, sin, s * versine, second]
        };
        let quadratic = [
            bend / 2.0,
            fa * along[0] + fu * along[1],
            bend / 2.0 * (foot[0] * foot[0] + foot[1] * foot[1]) + fa * foot[0] + fu * foot[1] + constant,
        ];
        let [one, other] = roots(quadratic)?.map(|way| [foot[0] + way * along[0], foot[1] + way * along[1]]);
        // From the corner itself the foot lies at (s, 0).
        let from_corner = |[a, u]: [f64; 2]| (s + a) * (s + a) + u * u;
        let nearest = if from_corner(one) <= from_corner(other) { one } else { other };
        nearest.iter().all(|way| way.is_finite()).then_some(nearest)
    }
}

/// The roots of `q[0] x² + q[1] x + q[2]`; the second is infinite where there is but one.
fn roots(q: [f64; 3]) -> Option<[f64; 2]> {
    let discriminant = q[1] * q[1] - 4.0 * q[0] * q[2];
    // Touching counts as meeting, within what rounding leaves of it.
    let discriminant = if discriminant.abs() <= 1e-15 * q[1] * q[1] { 0.0 } else { discriminant };
    if discriminant < 0.0 {
        return None;
    }
    let half = -0.5 * (q[1] + discriminant.sqrt().copysign(q[1]));
    if half == 0.0 {
        return Some([0.0, 0.0]);
    }
    Some([q[2] / half, half / q[0]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_those_of_a_quadratic() {
        assert_eq!(roots([1.0, -3.0, 2.0]), Some([1.0, 2.0]));
        assert_eq!(roots([1.0, 0.0, 1.0]), None);
        assert_eq!(roots([0.0, 2.0, -4.0]).map(|[one, _]| one), Some(2.0));
    }

    #[test]
    fn lines_meet_on_the_bisector() {
        let square = Bend { cos: 0.0, sin: 1.0, curvature: [0.0; 2] };
        assert_eq!(square.meeting(5.0), Some([0.0, -5.0]));
        assert_eq!(square.meeting(-5.0), Some([0.0, 5.0]));
    }

    #[test]
    fn a_line_meets_an_arc_where_both_are_as_far_away_as_the_tool_is_wide() {
        // Along +x to the corner, then counter-clockwise round (0, 10) turned by 30 degrees into it; the tool is left.
        let turn = 30f64.to_radians();
        let bend = Bend { cos: libm::cos(turn), sin: libm::sin(turn), curvature: [0.0, 0.1] };
        let [a, u] = bend.meeting(2.0).expect("they meet");
        let center = [-10.0 * libm::sin(turn), 10.0 * libm::cos(turn)];
        let place = [u, 2.0 + a];
        assert!(a.abs() < 1e-12);
        assert!((libm::hypot(place[0] - center[0], place[1] - center[1]) - 8.0).abs() < 1e-12);
        assert!(u < 0.0 && u > -2.0, "{u}");
    }
}
