//! Coordinates on a binary grid, so that sums of them are exact.

use crate::point::Point;

/// `p` with its coordinates rounded to even multiples of 2⁻⁴⁰.
///
/// Sums, differences and halves of such points are exact as long as they stay below 2¹², so faces made from a few of
/// them by adding are planar to the last bit however small they are.
pub(crate) fn snapped(p: Point) -> Point {
    const STEPS: f64 = (1u64 << 39) as f64;
    p.map(|x| (x * STEPS).round() / STEPS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_snapped_points_are_exact() {
        let a = snapped([1.0 / 3.0, 0.1, -123.4])[0];
        let b = snapped([1e-4 / 7.0, 0.0, 0.0])[0];
        assert_eq!((a + b) - a, b);
        assert!((a - 1.0 / 3.0).abs() < 1e-12);
    }
}
