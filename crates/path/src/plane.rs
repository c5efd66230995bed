//! Two numbers of a plane, as a place, a direction or a way; mm. Where they count from a corner near by, digits are not
//! spent on where in the shop it lies.

use base::{AXES, Point};

/// A place, way or direction in the plane.
pub type Vector = [f64; 2];

/// No way.
pub const NONE: Vector = [0.0; 2];

/// The sum.
#[inline]
pub fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

/// The difference.
#[inline]
pub fn less(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

/// So many times as long.
pub fn times(a: Vector, factor: f64) -> Vector {
    [a[0] * factor, a[1] * factor]
}

/// The scalar product.
#[inline]
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The cross product: positive if `b` points left of `a`.
#[inline]
pub fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// The length.
#[inline]
pub fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// A quarter turn to the left.
#[inline]
pub fn left(a: Vector) -> Vector {
    [-a[1], a[0]]
}

/// The angle from one direction to another, radians, in (−π, π].
pub fn angle(from: Vector, to: Vector) -> f64 {
    libm::atan2(cross(from, to), dot(from, to))
}

/// How far one place is from another.
pub fn distance(a: Vector, b: Vector) -> f64 {
    length(less(a, b))
}

/// The smaller of two numbers; quicker than `f64::min`, which looks for what is none.
#[inline]
pub fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers.
#[inline]
pub fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// A point's axes of the plane.
#[inline]
pub fn in_plane(point: &Point, axes: [u8; 2]) -> Vector {
    axes.map(|axis| point[usize::from(axis) % AXES])
}
