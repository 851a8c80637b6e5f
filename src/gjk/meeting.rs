//! Whether two sets meet: GJK that computes only on which side of the simplex the origin lies, not the closest point.

use super::Support;
use super::simplex::Corner;
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Vec3;
use crate::tolerance;

/// Sets that need more steps than this are mostly close to touching; the caller then computes their distance.
const MAX_STEPS: usize = 16;

/// `Some(true)` if A and B meet, `Some(false)` if they are farther apart than `cutoff`; `None` if neither is proved within a
/// few steps. No coordinate of A and B exceeds `size`. `start` is a guess of the direction from B to A, or zero.
pub fn meeting<A: Support, B: Support>(
    a: &A,
    b: &B,
    start: Vec3,
    size: f64,
    cutoff: f64,
) -> Option<bool> {
    // Directions are products of three lengths, and support functions square them: in units of the size they stay in range.
    let unit = power_of_two(size);
    with_widest(MeetingSearch {
        a,
        b,
        start: start / unit,
        inverse_unit: 1.0 / unit,
        depth: tolerance::TOUCH_DEPTH * (size / unit),
        cutoff: cutoff / unit,
    })
}

/// The largest power of two that is no larger than a length.
fn power_of_two(length: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(length.to_bits() & EXPONENT)
}

struct MeetingSearch<'a, A, B> {
    a: &'a A,
    b: &'a B,
    start: Vec3,
    inverse_unit: f64,
    /// The depth, in units, from which the origin counts as inside a tetrahedron.
    depth: f64,
    cutoff: f64,
}

impl<A: Support, B: Support> Work for MeetingSearch<'_, A, B> {
    type Output = Option<bool>;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> Option<bool> {
        let mut v = if self.start == Vec3::zeros() {
            Vec3::x()
        } else {
            self.start
        };
        let mut sides = Sides::Nothing;
        for _ in 0..MAX_STEPS {
            let square = v.norm_squared();
            if square == 0.0 {
                return None;
            }
            let corner = Corner::between(self.a.extreme(&-v), self.b.extreme(&v));
            let newest = corner.difference * self.inverse_unit;
            let along = v.dot(&newest);
            if along > 0.0 {
                // The origin is beyond the newest corner: `v` separates the sets, but maybe by less than the cutoff.
                let is_apart = along * along > self.cutoff * self.cutoff * square;
                return is_apart.then_some(false);
            }
            (sides, v) = match sides.with(newest) {
                Next::Beyond(sides, towards) => (sides, -towards),
                Next::Inside(corners) => {
                    return is_deep_inside(&corners, self.depth).then_some(true);
                }
            };
        }
        None
    }
}

/// The simplex: corners of the difference A - B, the newest first.
#[derive(Clone, Copy)]
enum Sides {
    Nothing,
    Point(Vec3),
    Segment(Vec3, Vec3),
    /// Counter-clockwise as seen from the origin.
    Triangle(Vec3, Vec3, Vec3),
}

enum Next {
    /// The origin is outside: the face of the simplex that it lies beyond, and the direction from that face to the origin.
    Beyond(Sides, Vec3),
    /// The origin is on the inner side of the three new faces.
    Inside([Vec3; 4]),
}

impl Sides {
    #[inline(always)]
    fn with(self, a: Vec3) -> Next {
        match self {
            Self::Nothing => Next::Beyond(Self::Point(a), -a),
            Self::Point(b) => beyond_segment(a, b),
            Self::Segment(b, c) => beyond_triangle(a, b, c),
            Self::Triangle(b, c, d) => {
                let (ab, ac, ad) = (b - a, c - a, d - a);
                // These normals point out of the tetrahedron: the origin and the newest corner are on the same side of the old
                // triangle.
                let outside = |normal: Vec3| normal.dot(&a) < 0.0;
                if outside(ab.cross(&ac)) {
                    beyond_triangle(a, b, c)
                } else if outside(ac.cross(&ad)) {
                    beyond_triangle(a, c, d)
                } else if outside(ad.cross(&ab)) {
                    beyond_triangle(a, d, b)
                } else {
                    Next::Inside([a, b, c, d])
                }
            }
        }
    }
}

#[inline(always)]
fn beyond_segment(a: Vec3, b: Vec3) -> Next {
    let ab = b - a;
    if ab.dot(&a) < 0.0 {
        Next::Beyond(Sides::Segment(a, b), ab.cross(&ab.cross(&a)))
    } else {
        Next::Beyond(Sides::Point(a), -a)
    }
}

#[inline(always)]
fn beyond_triangle(a: Vec3, b: Vec3, c: Vec3) -> Next {
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(&ac);
    if normal.cross(&ac).dot(&a) < 0.0 {
        if ac.dot(&a) < 0.0 {
            return Next::Beyond(Sides::Segment(a, c), ac.cross(&ac.cross(&a)));
        }
        return beyond_segment(a, b);
    }
    if ab.cross(&normal).dot(&a) < 0.0 {
        return beyond_segment(a, b);
    }
    if normal.dot(&a) < 0.0 {
        Next::Beyond(Sides::Triangle(a, b, c), normal)
    } else {
        Next::Beyond(Sides::Triangle(a, c, b), -normal)
    }
}

/// The rounding error of the triple product of three edges of a tetrahedron whose corners are differences of points with
/// coordinates up to 2: corners are at most 7 long and edges 14, so the error is within 14 * 14 * 7 * 5 EPSILON. It rejects the
/// normal of a needle, which is meaningless however deep the origin seems below it.
const VOLUME_ERROR: f64 = 8192.0 * tolerance::EPSILON;

/// Whether the origin is inside a tetrahedron, farther than `depth` from its faces.
#[inline(always)]
fn is_deep_inside(corners: &[Vec3; 4], depth: f64) -> bool {
    let is_inside = |i: usize, j: usize, k: usize, opposite: usize| {
        let a = corners[i];
        let normal = (corners[j] - a).cross(&(corners[k] - a));
        let towards = normal.dot(&(corners[opposite] - a));
        let height = -normal.dot(&a);
        let is_clear = height.abs() > VOLUME_ERROR;
        let is_deep = is_clear & (height * height > depth * depth * normal.norm_squared());
        (towards * height > 0.0) & is_deep
    };
    is_inside(0, 1, 2, 3) & is_inside(0, 2, 3, 1) & is_inside(0, 3, 1, 2) & is_inside(1, 2, 3, 0)
}
