//! Two numbers of a plane, as a direction or a way beside a corner. Local to the corner, so digits are not spent on
//! where in the shop it lies.

/// A way or direction in the plane.
pub(crate) type Vector = [f64; 2];

/// No way.
pub(crate) const NONE: Vector = [0.0; 2];

/// The sum.
pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

/// The difference.
pub(crate) fn less(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

/// So many times as long.
pub(crate) fn times(a: Vector, factor: f64) -> Vector {
    [a[0] * factor, a[1] * factor]
}

/// The scalar product.
pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The cross product: positive if `b` points left of `a`.
pub(crate) fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// The length.
pub(crate) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// A quarter turn to the left.
pub(crate) fn left(a: Vector) -> Vector {
    [-a[1], a[0]]
}

/// The angle from one direction to another, radians, in (−π, π].
pub(crate) fn angle(from: Vector, to: Vector) -> f64 {
    libm::atan2(cross(from, to), dot(from, to))
}
