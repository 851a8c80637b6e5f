//! The distance of two convex sets given by support points, after Gilbert, Johnson and Keerthi (1988), §2.3.4.
//!
//! Whatever the iteration does, `lower` comes from a direction whose support was evaluated, so it is safe. Where the bounds have
//! come together, the corners between which it ended tell the nearest points and their features; elsewhere distances are
//! finished on features (see `convex`).

mod meeting;
mod refined;
mod simplex;

pub use self::meeting::meeting;
pub use self::refined::{Nearby, RefinedBounds, refined};
use self::simplex::{Corner, Nearest, Simplex};
pub use self::simplex::{CornerNames, NearestCorners};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Vec3;
use crate::tolerance;

/// A convex set that can tell its point farthest along a direction.
pub trait Support {
    fn extreme(&self, direction: &Vec3) -> Extreme;

    fn support(&self, direction: &Vec3) -> Vec3 {
        self.extreme(direction).point
    }
}

/// The point farthest along a direction, and the name by which the set knows it: the number of a vertex, or of a part of a
/// smooth surface.
#[derive(Clone, Copy, Debug)]
pub struct Extreme {
    pub point: Vec3,
    pub name: u32,
}

/// The hull of points.
pub struct PointCloud<'a>(pub &'a [Vec3]);

impl Support for PointCloud<'_> {
    #[inline(always)]
    fn extreme(&self, direction: &Vec3) -> Extreme {
        let (mut best, mut value) = (0, f64::NEG_INFINITY);
        for (i, point) in self.0.iter().enumerate() {
            let here = direction.dot(point);
            // Two selections, which need not be foreseen as a branch would.
            best = if here > value { i } else { best };
            value = if here > value { here } else { value };
        }
        Extreme {
            point: self.0[best],
            name: best as u32,
        }
    }
}

/// What the iteration found out about two sets A and B.
#[derive(Clone, Copy, Debug)]
pub struct Gjk {
    /// The distance is at least this, up to the rounding of one support evaluation.
    pub lower: f64,
    /// The unit direction from B to A that proves `lower`; zero if there is none.
    pub direction: Vec3,
    /// The distance is at most this.
    pub upper: f64,
    /// The sets overlap at least this deep: a tetrahedron of the difference holds the origin with this margin.
    pub overlap: f64,
    /// A point of both sets, where `overlap` is positive.
    pub common: Vec3,
    /// A point of A and one of B, where they are near enough.
    pub near: Option<[Vec3; 2]>,
    /// The nearest points that were found, and between which corners; none of sets that overlap.
    pub nearest: Option<NearestCorners>,
}

/// How well a distance is to be known.
#[derive(Clone, Copy, Debug)]
pub struct DistanceLimits {
    /// A distance that is known to be no larger is known well enough.
    pub enough: f64,
    /// One that is known to be larger is, too.
    pub cutoff: f64,
}

impl DistanceLimits {
    pub const EXACT: Self = Self {
        enough: f64::NEG_INFINITY,
        cutoff: f64::INFINITY,
    };

    /// The same of sets that are rounded by a radius around those that are asked about.
    pub fn of_cores(self, radius: f64) -> Self {
        Self {
            enough: self.enough + radius,
            cutoff: self.cutoff + radius,
        }
    }
}

/// Bounds the distance of A and B. Stops as soon as it is known as well as is wanted. `start` is a guess of the direction from B
/// to A, or zero.
pub fn gjk<A: Support, B: Support>(a: &A, b: &B, start: Vec3, limits: DistanceLimits) -> Gjk {
    with_widest(Search {
        a,
        b,
        start,
        limits,
    })
}

struct Search<'a, A, B> {
    a: &'a A,
    b: &'a B,
    start: Vec3,
    limits: DistanceLimits,
}

impl<A: Support, B: Support> Work for Search<'_, A, B> {
    type Output = Gjk;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> Gjk {
        let Self {
            a,
            b,
            start,
            limits,
        } = self;
        let mut found = Gjk {
            lower: 0.0,
            direction: Vec3::zeros(),
            upper: f64::INFINITY,
            overlap: 0.0,
            common: Vec3::zeros(),
            near: None,
            nearest: None,
        };
        let mut v = if start == Vec3::zeros() {
            Vec3::x()
        } else {
            start
        };
        let mut simplex = Simplex::empty();
        let mut scale = 0.0f64;
        for _ in 0..128 {
            let inverse_length = 1.0 / v.norm();
            let on_a = a.extreme(&-v);
            let on_b = b.extreme(&v);
            let corner = Corner::between(on_a, on_b);
            let w = corner.difference;
            scale = scale.max(w.norm_squared());
            let lower = v.dot(&w) * inverse_length;
            if lower > found.lower {
                found.lower = lower;
                found.direction = v * inverse_length;
                if lower > limits.cutoff {
                    return found;
                }
            }
            let rounding = 4.0 * tolerance::EPSILON * scale.sqrt();
            if found.upper - found.lower <= rounding || simplex.contains(&w) || simplex.is_full() {
                break;
            }
            simplex.push(corner);
            match simplex.reduce() {
                Nearest::Inside { margin, at } => {
                    // Where the corners do not combine to the origin, rounding has decided the sides.
                    let off = at.difference.norm();
                    if off <= tolerance::CERTIFIED_GAP * scale.sqrt() {
                        (found.overlap, found.upper) = (margin, 0.0);
                        found.common = at.on_a;
                        found.near = Some([at.on_a; 2]);
                    }
                    found.upper = found.upper.min(off);
                    return found;
                }
                Nearest::Outside(point) => {
                    let upper = point.norm();
                    v = point;
                    if upper >= found.upper {
                        break;
                    }
                    found.upper = upper;
                    if upper <= limits.enough {
                        // The foot on a needle of a triangle may be nearer than any point of it.
                        let nearest = simplex.combined(&point);
                        if nearest.difference.norm() <= limits.enough {
                            found.near = Some([nearest.on_a, nearest.on_a - nearest.difference]);
                            return found;
                        }
                    }
                    if upper <= rounding {
                        break;
                    }
                }
            }
        }
        found.nearest = simplex.nearest(&v);
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube_at(x: f64) -> Vec<Vec3> {
        (0..8)
            .map(|i| Vec3::new(x + (i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64))
            .collect()
    }

    #[test]
    fn bounds_meet_for_cubes() {
        let (a, b) = (cube_at(0.0), cube_at(3.0));
        let found = gjk(
            &PointCloud(&a),
            &PointCloud(&b),
            Vec3::zeros(),
            DistanceLimits::EXACT,
        );
        assert!((found.lower - 2.0).abs() < 1e-14 && (found.upper - 2.0).abs() < 1e-14);
        assert!((found.direction + Vec3::x()).amax() < 1e-14);
    }

    #[test]
    fn overlap_is_seen() {
        let (a, b) = (cube_at(0.0), cube_at(0.7));
        let found = gjk(
            &PointCloud(&a),
            &PointCloud(&b),
            Vec3::new(0.3, 0.2, 0.1),
            DistanceLimits::EXACT,
        );
        assert_eq!(found.upper, 0.0);
        assert_eq!(found.lower, 0.0);
    }
}
