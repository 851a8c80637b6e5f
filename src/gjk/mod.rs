//! The distance of two convex sets given by support points, after Gilbert, Johnson and Keerthi (1988), §2.3.4.
//!
//! `lower` comes from a direction whose support was evaluated, so it is a safe bound even if the iteration fails. Where the
//! bounds have converged, the last simplex gives the closest points and their features; elsewhere the distance is computed from
//! features (see `convex`).

mod meeting;
mod refined;
mod simplex;

use self::meeting::beginning;
pub use self::meeting::{Proved, meeting};
pub use self::refined::{Nearby, Refined, RefinedBounds, refined, walked};
use self::simplex::{Corner, OriginPosition, Simplex};
pub use self::simplex::{Names, NearTriangle, NearestCorners};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Vec3;
use crate::tolerance;

/// A convex set given by its support function.
pub trait Support {
    fn extreme(&self, direction: &Vec3) -> Extreme;

    fn support(&self, direction: &Vec3) -> Vec3 {
        self.extreme(direction).point
    }
}

/// The support point along a direction, and its name within the set: the index of a vertex, or the number of a part of a smooth
/// surface, 0 where there is one part alone. Two support points of the same name lie on one smooth part (see
/// `convex/surface_part.rs`, which alone reads names of smooth sets).
#[derive(Clone, Copy, Debug)]
pub struct Extreme {
    pub point: Vec3,
    pub name: u32,
}

/// The convex hull of points.
pub struct PointCloud<'a>(pub &'a [Vec3]);

impl Support for PointCloud<'_> {
    #[inline(always)]
    fn extreme(&self, direction: &Vec3) -> Extreme {
        let (mut best, mut value) = (0, f64::NEG_INFINITY);
        for (i, point) in self.0.iter().enumerate() {
            let here = direction.dot(point);
            // Two conditional moves: no branch to mispredict.
            best = if here > value { i } else { best };
            value = if here > value { here } else { value };
        }
        Extreme {
            point: self.0[best],
            name: best as u32,
        }
    }
}

/// The bounds of the distance of two sets A and B.
#[derive(Clone, Copy, Debug)]
pub struct Gjk {
    /// The distance is at least this, up to the rounding of one support evaluation.
    pub lower: f64,
    /// The unit direction from B to A that proves `lower`; zero if there is none.
    pub direction: Vec3,
    /// The least norm of a vector found. The distance is at most this but for rounding, which needle-like triangles magnify.
    pub upper: f64,
    /// The distance is at most this: that of the closest points found. Infinite where the search ended beyond the cutoff.
    pub attained: f64,
    /// The sets overlap by at least this depth: a tetrahedron of the difference contains the origin with this margin.
    pub overlap: f64,
    /// A point of both sets, where `overlap` is positive.
    pub common: Vec3,
    /// A point of A and one of B, where their distance is at most `DistanceLimits::enough`, or where the sets overlap.
    pub near: Option<[Vec3; 2]>,
    /// The closest points found, and the corners they lie between; `None` for sets that overlap.
    pub nearest: Option<NearestCorners>,
    /// The triangle of the difference that the origin is nearly on, where there is one.
    pub across: Option<NearTriangle>,
}

/// The limits at which a distance computation may stop early.
#[derive(Clone, Copy, Debug)]
pub struct DistanceLimits {
    /// Stop when the distance is known to be at most this.
    pub enough: f64,
    /// Stop when the distance is known to be larger than this.
    pub cutoff: f64,
}

impl DistanceLimits {
    pub const EXACT: Self = Self {
        enough: f64::NEG_INFINITY,
        cutoff: f64::INFINITY,
    };

    /// The limits that decide a threshold by more than `error`, so that its answer is the distance's; `None` where no threshold is that large.
    pub fn by_more_than(self, error: f64) -> Option<Self> {
        (self.enough > error).then_some(Self {
            enough: self.enough - error,
            cutoff: self.cutoff + error,
        })
    }

    /// The limits for the cores of two sets whose radii sum to `radius`.
    pub fn of_cores(self, radius: f64) -> Self {
        Self {
            enough: self.enough + radius,
            cutoff: self.cutoff + radius,
        }
    }
}

/// At most 128 steps. If the bounds have not met by then, the caller compares features; a smaller limit would make that happen
/// more often.
const MAX_STEPS: usize = 128;

/// What rounding leaves of a vector that is a combination of differences of support points, times the largest of these: shorter ones, and
/// smaller differences of bounds, say nothing. A difference and a sum of products are off by 4 EPSILON.
const VECTOR_ROUNDING: f64 = 4.0 * tolerance::EPSILON;

/// The origin is nearly on a triangle that is no farther away than this, times the largest vector. It decides only where a direction is
/// guessed, which is proved before it is used: a larger value guesses for sets that do not touch, a smaller one leaves some that do without.
const NEARLY_ON: f64 = 1e-6;

/// Bounds the distance of A and B. Stops as soon as the limits allow. `start` is a guess of the direction from B to A, or zero.
pub fn gjk<A: Support, B: Support>(a: &A, b: &B, start: Vec3, limits: DistanceLimits) -> Gjk {
    with_widest(BoundsSearch {
        a,
        b,
        start,
        limits,
    })
}

struct BoundsSearch<'a, A, B> {
    a: &'a A,
    b: &'a B,
    start: Vec3,
    limits: DistanceLimits,
}

impl<A: Support, B: Support> Work for BoundsSearch<'_, A, B> {
    type Output = Gjk;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> Gjk {
        let Self {
            a,
            b,
            start,
            limits,
        } = self;
        let mut found = Gjk::unknown();
        let (mut simplex, mut largest_square, mut v) = (Simplex::empty(), 0.0, Vec3::x());
        // Without a guess the sets may be points and thin hulls, whose simplices are needles: these begin with one corner.
        if start != Vec3::zeros() {
            let begun = beginning(a, b, start);
            (found.lower, found.direction) = (begun.lower, begun.direction);
            if begun.lower > limits.cutoff {
                return found;
            }
            simplex = begun.simplex;
            largest_square = simplex.largest_square();
            v = match simplex.reduce() {
                OriginPosition::Inside { margin, at } => {
                    found.take_inside(&simplex, margin, &at, largest_square);
                    return found;
                }
                OriginPosition::Outside(point) => point,
            };
            found.upper = v.norm();
            if found.upper <= limits.enough && found.take_near(&simplex, &v, limits.enough) {
                return found;
            }
            if found.upper <= VECTOR_ROUNDING * largest_square.sqrt() {
                found.take_nearest(&simplex, &v, largest_square);
                return found;
            }
        }
        for _ in 0..MAX_STEPS {
            let inverse_length = 1.0 / v.norm();
            let on_a = a.extreme(&-v);
            let on_b = b.extreme(&v);
            let corner = Corner::between(on_a, on_b);
            let w = corner.difference;
            largest_square = largest_square.max(w.norm_squared());
            let lower = v.dot(&w) * inverse_length;
            if lower > found.lower {
                found.lower = lower;
                found.direction = v * inverse_length;
                if lower > limits.cutoff {
                    return found;
                }
            }
            let rounding = VECTOR_ROUNDING * largest_square.sqrt();
            if found.upper - found.lower <= rounding || simplex.contains(&w) || simplex.is_full() {
                break;
            }
            simplex.push(corner);
            match simplex.reduce() {
                OriginPosition::Inside { margin, at } => {
                    found.take_inside(&simplex, margin, &at, largest_square);
                    return found;
                }
                OriginPosition::Outside(point) => {
                    let upper = point.norm();
                    v = point;
                    if upper >= found.upper {
                        break;
                    }
                    found.upper = upper;
                    if upper <= limits.enough && found.take_near(&simplex, &point, limits.enough) {
                        return found;
                    }
                    if upper <= rounding {
                        break;
                    }
                }
            }
        }
        found.take_nearest(&simplex, &v, largest_square);
        found
    }
}

impl Gjk {
    /// The bounds before the first step.
    #[inline(always)]
    fn unknown() -> Self {
        Self {
            lower: 0.0,
            direction: Vec3::zeros(),
            upper: f64::INFINITY,
            attained: f64::INFINITY,
            overlap: 0.0,
            common: Vec3::zeros(),
            near: None,
            nearest: None,
            across: None,
        }
    }

    /// Takes the result of a tetrahedron that contains the origin. If its corners do not combine to the origin, it is flat and
    /// rounding decided its sides.
    #[inline(always)]
    fn take_inside(&mut self, simplex: &Simplex, margin: f64, at: &Corner, largest_square: f64) {
        let off = at.difference.norm();
        if off <= tolerance::CERTIFIED_GAP * largest_square.sqrt() {
            (self.overlap, self.upper) = (margin, 0.0);
            self.common = at.on_a;
            self.near = Some([at.on_a; 2]);
        }
        self.upper = self.upper.min(off);
        self.attained = if self.near.is_some() { 0.0 } else { off };
        self.take_across(simplex, margin, largest_square);
    }

    /// Takes the closest points that the search ends with.
    #[inline(always)]
    fn take_nearest(&mut self, simplex: &Simplex, foot: &Vec3, largest_square: f64) {
        self.nearest = simplex.nearest(foot);
        if let Some(nearest) = &self.nearest {
            self.attained = nearest.difference.norm();
            self.take_across(simplex, self.attained, largest_square);
        }
    }

    /// Takes the triangle that the origin is nearly on, at a distance from it.
    #[inline(always)]
    fn take_across(&mut self, simplex: &Simplex, distance: f64, largest_square: f64) {
        if distance * distance <= NEARLY_ON * NEARLY_ON * largest_square {
            self.across = simplex.nearest_triangle();
        }
    }

    /// Takes the nearest points if they are within `enough`. On a needle-like triangle they may not be, although the foot is:
    /// rounding may put it nearer to the origin than any point of the triangle.
    #[inline(always)]
    fn take_near(&mut self, simplex: &Simplex, foot: &Vec3, enough: f64) -> bool {
        let nearest = simplex.combined(foot);
        let distance = nearest.difference.norm();
        let is_near = distance <= enough;
        if is_near {
            self.attained = distance;
            self.near = Some([nearest.on_a, nearest.on_a - nearest.difference]);
        }
        is_near
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
