//! GJK iterated until its bounds meet: the distance of sets with smooth surfaces.
//!
//! The sets count as apart only if the support points along some direction leave a gap above rounding. Otherwise the lower
//! bound is 0, however far apart the iteration's points are.

use super::simplex::{Corner, CornerNames, Nearest, Simplex};
use super::{DistanceLimits, Support};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Vec3;
use crate::tolerance;

/// The bounds of the distance of two sets A and B with any surfaces.
#[derive(Clone, Copy, Debug)]
pub struct RefinedBounds {
    /// The distance is at least this, up to the rounding of one support evaluation; 0 if it does not exceed that rounding.
    pub lower: f64,
    /// The unit direction from B to A that proves `lower`; zero if there is none.
    pub direction: Vec3,
    /// The distance is at most this: that of `points`. 0 for sets that overlap.
    pub upper: f64,
    /// The sets overlap by at least this depth: a tetrahedron of the difference contains the origin with this margin.
    pub depth: f64,
    /// A point of A and one of B.
    pub points: [Vec3; 2],
    /// The names of the extreme points that the closest points lie between, if `finish` computed these.
    pub names: Option<CornerNames>,
    pub iterations: u32,
}

/// The closest points of two sets, to within the accepted gap.
#[derive(Clone, Copy, Debug)]
pub struct Nearby {
    /// A lower bound of the distance, and the unit direction from B to A that proves it.
    pub lower: f64,
    pub direction: Vec3,
    /// A point of A and one of B.
    pub points: [Vec3; 2],
}

/// At most 400 steps; more do not improve the bounds.
const MAX_STEPS: u32 = 400;

/// At most 50 steps in a row without progress.
const MAX_IDLE: u32 = 50;

/// `finish` is first tried when `upper - lower` is at most 0.3 `upper`, and again each time the quotient has shrunk by this
/// factor.
const FIRST_FINISH: f64 = 0.3;

/// At most 12 tries of `finish`.
const MAX_FINISHES: u32 = 12;

/// A search that is stuck is restarted at most 8 times.
const MAX_RESTARTS: u32 = 8;

/// Bounds the distance of A and B until the bounds are [`tolerance::CERTIFIED_GAP`] times `size` apart, or no step improves
/// them, or `limits` allow to stop. No coordinate of A and B exceeds `size`. `start` is a guess of the direction from B to A.
/// Once the bounds are close, `finish` gets that direction and the names of the extreme points that the closest points lie
/// between; it may return the closest points to the same accuracy.
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
    /// Tries `finish` with the names of the simplex's corners, and takes its result. Returns whether there is one.
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
                        // The four corners are coplanar and have no inside: restart from the point that they combine to.
                        Nearest::Inside { at, .. } => {
                            simplex = Simplex::empty();
                            Some((at, at.difference))
                        }
                        // A point of the difference even where rounding spoilt the foot on a needle-like triangle.
                        Nearest::Outside(point) => Some((simplex.combined(&point), point)),
                    }
                }
            };
            let Some((nearest, foot)) = next else {
                let direction = found.direction;
                if found.lower > rounding && found.finish(&simplex, &direction, &finish) {
                    break;
                }
                // Rounding has spoilt the corners: restart from the best direction known.
                restarts += 1;
                let is_known = found.direction != Vec3::zeros();
                if restarts > MAX_RESTARTS || !is_known && is_apart {
                    break;
                }
                idle = 0;
                simplex = Simplex::empty();
                if !is_known {
                    // The sets are so near that the direction between the points is mostly rounding; a triangle's normal is
                    // more accurate.
                    is_apart = true;
                    v = found.points[0] - found.points[1];
                    continue;
                }
                let between = (found.points[0] - found.points[1]) / found.upper;
                // Each restart uses another direction: from that between the nearest points to that of the best lower bound,
                // and as far beyond.
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
