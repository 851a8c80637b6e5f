//! The same iteration carried on until its bounds meet: the distance of sets whose surfaces are no polygons.
//!
//! "Apart" needs a proof: a direction whose support points, evaluated on both sides, leave a gap above rounding. Without one
//! the lower bound is 0, whatever the points that the iteration reached.

use super::simplex::{Corner, CornerNames, Nearest, Simplex};
use super::{DistanceLimits, Support};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Vec3;
use crate::tolerance;

/// What was found out about the distance of two sets A and B, whatever their surfaces.
#[derive(Clone, Copy, Debug)]
pub struct RefinedBounds {
    /// The distance is at least this, up to the rounding of one support evaluation. 0 unless it is above that rounding.
    pub lower: f64,
    /// The unit direction from B to A that proves `lower`; zero if there is none.
    pub direction: Vec3,
    /// The distance is at most this: that of `points`. 0 for sets that overlap.
    pub upper: f64,
    /// The sets overlap at least this deep: a tetrahedron of the difference holds the origin with this margin.
    pub depth: f64,
    /// A point of A and one of B.
    pub points: [Vec3; 2],
    /// Between what the points are, where that told their distance.
    pub names: Option<CornerNames>,
    pub iterations: u32,
}

/// Points of two sets that are nearest, but for what a caller accepts.
#[derive(Clone, Copy, Debug)]
pub struct Nearby {
    /// What a direction proves the distance to be at least, and that unit direction, from B to A.
    pub lower: f64,
    pub direction: Vec3,
    /// A point of A and one of B.
    pub points: [Vec3; 2],
}

/// More steps than this bring nothing.
const MAX_STEPS: u32 = 400;

/// So many steps in a row may bring nothing.
const MAX_IDLE: u32 = 50;

/// `finish` is first tried when `upper - lower` is at most 0.3 `upper`, and again each time that the quotient has shrunk by the
/// same factor.
const FIRST_FINISH: f64 = 0.3;

/// At most 12 tries of `finish`.
const MAX_FINISHES: u32 = 12;

/// A search begins anew so often where it got stuck.
const MAX_RESTARTS: u32 = 8;

/// Bounds the distance of A and B until the bounds are [`tolerance::CERTIFIED_GAP`] times `size` apart, or no step brings
/// them nearer, or the distance is known as well as is wanted. No coordinate of A and B is larger than `size`. `start` is a
/// guess of the direction from B to A. Once the bounds are near one another, `finish` is given that direction and between what
/// the nearest points are, and may tell them to the same accuracy.
pub fn refined<A: Support, B: Support>(
    a: &A,
    b: &B,
    start: Vec3,
    size: f64,
    limits: DistanceLimits,
    finish: impl Fn(&CornerNames, &Vec3) -> Option<Nearby>,
) -> RefinedBounds {
    let limits = DistanceLimits {
        cutoff: limits.cutoff.max(tolerance::SUPPORT_ERROR * size),
        ..limits
    };
    let mut found = with_widest(Search {
        a,
        b,
        start,
        accepted: tolerance::CERTIFIED_GAP * size,
        limits,
        finish,
    });
    if found.lower <= tolerance::SUPPORT_ERROR * size {
        (found.lower, found.direction) = (0.0, Vec3::zeros());
    }
    found
}

impl RefinedBounds {
    /// Whether the distance is told by what the corners of a simplex are between.
    fn finish(
        &mut self,
        simplex: &Simplex,
        direction: &Vec3,
        finish: impl Fn(&CornerNames, &Vec3) -> Option<Nearby>,
    ) -> bool {
        let Some(names) = simplex.names() else {
            return false;
        };
        let Some(near) = finish(&names, direction) else {
            return false;
        };
        self.lower = near.lower;
        self.direction = near.direction;
        self.upper = (near.points[0] - near.points[1]).norm();
        self.points = near.points;
        self.names = Some(names);
        true
    }
}

struct Search<'a, A, B, F> {
    a: &'a A,
    b: &'a B,
    start: Vec3,
    accepted: f64,
    limits: DistanceLimits,
    finish: F,
}

impl<A, B, F> Work for Search<'_, A, B, F>
where
    A: Support,
    B: Support,
    F: Fn(&CornerNames, &Vec3) -> Option<Nearby>,
{
    type Output = RefinedBounds;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> RefinedBounds {
        let Self {
            a,
            b,
            start,
            accepted,
            limits,
            finish,
        } = self;
        let mut found = RefinedBounds {
            lower: 0.0,
            direction: Vec3::zeros(),
            upper: f64::INFINITY,
            depth: 0.0,
            points: [Vec3::zeros(); 2],
            names: None,
            iterations: 0,
        };
        let mut v = if start == Vec3::zeros() {
            Vec3::x()
        } else {
            start
        };
        let mut simplex = Simplex::empty();
        let mut scale = 0.0f64;
        let (mut least, mut idle) = (f64::INFINITY, 0);
        let mut restarts = 0;
        let mut is_apart = false;
        let (mut finishes, mut finish_at) = (0, FIRST_FINISH);
        while found.iterations < MAX_STEPS {
            found.iterations += 1;
            let length = v.norm();
            let (on_a, on_b) = (a.extreme(&-v), b.extreme(&v));
            let corner = Corner::between(on_a, on_b);
            let difference = corner.difference;
            scale = scale.max(difference.norm());
            let lower = v.dot(&difference) / length;
            if lower > found.lower {
                found.lower = lower;
                found.direction = v / length;
            }
            if difference.norm() < found.upper {
                found.upper = difference.norm();
                found.points = [on_a.point, on_b.point];
            }
            let is_known = found.upper <= limits.enough || found.lower > limits.cutoff;
            if is_known || found.upper - found.lower <= accepted {
                break;
            }
            let rounding = 4.0 * tolerance::EPSILON * scale;
            let gap = found.upper - found.lower;
            if found.lower > rounding && gap <= finish_at * found.upper && finishes < MAX_FINISHES {
                finishes += 1;
                finish_at = FIRST_FINISH * gap / found.upper;
                if found.finish(&simplex, &(v / length), &finish) {
                    break;
                }
            }
            idle = if gap < least { 0 } else { idle + 1 };
            least = least.min(gap);
            let next = if idle > MAX_IDLE || simplex.contains(&difference) || simplex.is_full() {
                None
            } else {
                simplex.push(corner);
                if is_apart || found.lower > rounding {
                    Some(simplex.nearest_apart())
                } else {
                    match simplex.reduce() {
                        Nearest::Inside { at, margin } if at.difference.norm() <= rounding => {
                            (found.upper, found.depth) = (0.0, margin);
                            found.points = [at.on_a; 2];
                            break;
                        }
                        // The four lie in a plane, and nothing is inside: on from a point that they do combine to.
                        Nearest::Inside { at, .. } => {
                            simplex = Simplex::empty();
                            Some((at, at.difference))
                        }
                        // A point of the difference, whatever rounding did to the foot on a needle of a triangle.
                        Nearest::Outside(point) => Some((simplex.combined(&point), point)),
                    }
                }
            };
            let Some((nearest, foot)) = next else {
                let direction = found.direction;
                if found.lower > rounding && found.finish(&simplex, &direction, &finish) {
                    break;
                }
                // Where rounding has spoilt the corners, others are begun with from the best direction known.
                restarts += 1;
                let is_known = found.direction != Vec3::zeros();
                if restarts > MAX_RESTARTS || !is_known && is_apart {
                    break;
                }
                idle = 0;
                simplex = Simplex::empty();
                if !is_known {
                    // So near that the direction between points is mostly rounding: that of a triangle's normal is not.
                    is_apart = true;
                    v = found.points[0] - found.points[1];
                    continue;
                }
                let between = (found.points[0] - found.points[1]) / found.upper;
                // Each time another one, from the nearest points' to the one that proves most, and as far beyond.
                let part = f64::from(restarts) / 4.0;
                v = between + (found.direction - between) * part;
                continue;
            };
            let upper = nearest.difference.norm();
            if upper < found.upper {
                found.upper = upper;
                found.points = [nearest.on_a, nearest.on_a - nearest.difference];
            }
            if upper <= rounding {
                break;
            }
            v = if foot == Vec3::zeros() {
                nearest.difference
            } else {
                foot
            };
        }
        found
    }
}
