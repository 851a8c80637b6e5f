//! Points and vectors, and what is computed with them.

/// A point or vector: x, y, z.
pub type Point = [f64; 3];

/// `a + b`.
pub(crate) fn plus(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] + b[k])
}

/// `a - b`.
pub(crate) fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

/// `factor * a`.
pub(crate) fn times(factor: f64, a: Point) -> Point {
    a.map(|x| factor * x)
}

/// The inner product.
pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product.
pub(crate) fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The length.
pub(crate) fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// `a` scaled to length 1.
pub(crate) fn unit(a: Point) -> Point {
    times(1.0 / norm(a), a)
}

/// The point `share` of the way from `a` to `b`; exactly `a` at 0 and exactly `b` at 1.
pub(crate) fn between<const D: usize>(a: [f64; D], b: [f64; D], share: f64) -> [f64; D] {
    std::array::from_fn(|k| (1.0 - share) * a[k] + share * b[k])
}

/// Two unit vectors that complete `axis` (of length 1) to a right-handed frame.
pub(crate) fn across(axis: Point) -> (Point, Point) {
    let mut least = [0.0; 3];
    let k = (0..3).fold(0, |k, i| if axis[i].abs() < axis[k].abs() { i } else { k });
    least[k] = 1.0;
    let u = unit(cross(least, axis));
    (u, cross(axis, u))
}
