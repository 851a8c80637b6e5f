//! GJK iterated until its bounds meet: the distance of sets with smooth surfaces.
//!
//! The sets count as apart only if the support points along some direction leave a gap above rounding. Otherwise the lower
//! bound is 0, however far apart the iteration's points are.

use std::ops::ControlFlow;

use super::meeting::{Beginning, beginning};
use super::simplex::{Corner, Names, OriginPosition, Simplex};
use super::{DistanceLimits, Support, VECTOR_ROUNDING};
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
    pub names: Option<[Names; 2]>,
    pub iterations: u32,
}

/// What a search ended with.
pub enum Refined {
    Bounds(RefinedBounds),
    /// Sets that touch, or are about to: `lower` is their signed gap along the direction, and no other around it has a larger one.
    Touch(Nearby),
}

impl Refined {
    /// The bounds, whichever it ended with.
    pub fn bounds(self) -> RefinedBounds {
        match self {
            Self::Bounds(found) => found,
            Self::Touch(near) => RefinedBounds::of_nearby(near),
        }
    }
}

/// The closest points of two sets, to within the accepted gap.
#[derive(Clone, Copy, Debug)]
pub struct Nearby {
    /// A lower bound of the distance, and the unit direction from B to A that proves it.
    pub lower: f64,
    pub direction: Vec3,
    /// A point of A and one of B.
    pub points: [Vec3; 2],
    /// The names of the extreme points that these lie between.
    pub names: [Names; 2],
}

/// At most 400 steps, restarts included. A smaller value leaves more pairs with bounds that have not met.
const MAX_STEPS: u32 = 400;

/// After more than 50 steps in a row in which the bounds come no closer, the search is restarted. A smaller value restarts
/// searches that would still have gone on; a larger one spends more steps on those that would not.
const MAX_IDLE: u32 = 50;

/// `finish` is first tried when `upper - lower` is at most 0.15 `upper`, and again each time the quotient has shrunk by this
/// factor. A larger value tries it sooner, when the corners are less likely to be the final ones; a smaller one takes steps
/// that it would have saved. With 0.3 distances of cylinders, cones, capsules and hulls take 2 to 8 % more instructions, those of
/// two ellipsoids 3 % fewer.
const FIRST_FINISH: f64 = 0.15;

/// Where only a threshold is asked for, the search goes on without `finish` until the bounds are this close: most are decided by then,
/// and `finish` costs as much as a dozen steps. On cylinders, cones, ellipsoids and capsules asked at 0.99 and 1.01 of their
/// distance, 0.03 decides less and takes a tenth longer; smaller values gain nothing.
const THRESHOLD_GAP: f64 = 0.01;

/// At most 8 tries of `finish`, the last where the quotient is at most 0.15^8 = 3e-7.
const MAX_FINISHES: u32 = 8;

/// A search that is stuck is restarted at most 8 times. Restart k begins k/4 of the way from the direction between the points
/// to that of the best bound.
const MAX_RESTARTS: u32 = 8;

/// Bounds the distance of A and B until the bounds are [`tolerance::CERTIFIED_GAP`] times `size` apart, or no step improves
/// them, or `limits` allow to stop. No coordinate of A and B exceeds `size`. `start` is a guess of the direction from B to A.
/// Once the bounds are close, `finish` is called with the direction of the last step and the names of the extreme points that
/// the closest points lie between. It may end the search by returning closest points that are accurate enough. Where
/// points are no more than `close` apart, it is also called with `true`, for a touch.
pub fn refined<A: Support, B: Support>(
    a: &A,
    b: &B,
    start: Vec3,
    size: f64,
    limits: DistanceLimits,
    close: f64,
    finish: impl Fn(&[Names; 2], &Vec3, bool) -> Option<Nearby>,
) -> Refined {
    let limits = DistanceLimits {
        cutoff: limits.cutoff.max(tolerance::SUPPORT_ERROR * size),
        ..limits
    };
    let refinement = Refinement {
        a,
        b,
        start,
        walks_first: true,
        accepted: tolerance::CERTIFIED_GAP * size,
        limits,
        close,
        max_steps: MAX_STEPS,
        finish: Some(&finish),
    };
    // Decided only by more than the error of what the whole search finds.
    if let Some(limits) = limits.by_more_than(tolerance::SMOOTH_ERROR * size) {
        let (found, _) = with_widest(Refinement {
            limits,
            finish: None,
            ..refinement
        });
        if found.lower > limits.cutoff || found.upper <= limits.enough {
            return Refined::Bounds(found);
        }
    }
    let search = |walks_first: bool| {
        with_widest(Refinement {
            walks_first,
            ..refinement
        })
    };
    let (mut found, mut touch) = search(true);
    let is_proved = found.lower > tolerance::SUPPORT_ERROR * size || found.depth > 0.0;
    if !is_proved && touch.is_none() && found.upper > limits.enough {
        // Nearly touching: the corners of the walk may be too close together. One corner alone begins better.
        (found, touch) = search(false);
    }
    if let Some(near) = touch {
        return Refined::Touch(near);
    }
    if found.lower <= tolerance::SUPPORT_ERROR * size {
        (found.lower, found.direction) = (0.0, Vec3::zeros());
    }
    Refined::Bounds(found)
}

/// What may end a search: see [`refined`].
type Finish = fn(&[Names; 2], &Vec3, bool) -> Option<Nearby>;

/// What [`refined`] begins with, a walk towards the origin: a positive depth, a gap, or neither.
pub fn walked<A: Support, B: Support>(
    a: &A,
    b: &B,
    start: Vec3,
    size: f64,
    limits: DistanceLimits,
) -> RefinedBounds {
    let (found, _) = with_widest(Refinement {
        a,
        b,
        start,
        walks_first: true,
        accepted: tolerance::CERTIFIED_GAP * size,
        limits,
        close: f64::NEG_INFINITY,
        max_steps: 0,
        finish: None::<&Finish>,
    });
    found
}

impl RefinedBounds {
    /// The bounds of closest points.
    #[inline(always)]
    pub fn of_nearby(near: Nearby) -> Self {
        Self {
            lower: near.lower,
            direction: near.direction,
            upper: (near.points[0] - near.points[1]).norm(),
            depth: 0.0,
            points: near.points,
            names: Some(near.names),
            iterations: 0,
        }
    }

    /// Tries `finish`, if it is given, with the names of the simplex's corners, and takes its result. Returns whether there is one.
    fn finish(
        &mut self,
        simplex: &Simplex,
        direction: &Vec3,
        finish: Option<&impl Fn(&[Names; 2], &Vec3, bool) -> Option<Nearby>>,
    ) -> bool {
        let (Some(finish), Some(names)) = (finish, simplex.names()) else {
            return false;
        };
        let Some(near) = finish(&names, direction, false) else {
            return false;
        };
        *self = Self {
            iterations: self.iterations,
            ..Self::of_nearby(near)
        };
        true
    }
}

/// The sets whose distance is refined, and when to stop.
struct Refinement<'a, A, B, F> {
    a: &'a A,
    b: &'a B,
    start: Vec3,
    /// Whether a walk towards the origin finds the first corners.
    walks_first: bool,
    /// The bounds have met when they are this close.
    accepted: f64,
    limits: DistanceLimits,
    /// Sets with points this near to each other may touch.
    close: f64,
    max_steps: u32,
    /// `None` where bounds as close as [`THRESHOLD_GAP`] end the search.
    finish: Option<&'a F>,
}

impl<A, B, F> Clone for Refinement<'_, A, B, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<A, B, F> Copy for Refinement<'_, A, B, F> {}

impl<A, B, F> Work for Refinement<'_, A, B, F>
where
    A: Support,
    B: Support,
    F: Fn(&[Names; 2], &Vec3, bool) -> Option<Nearby>,
{
    type Output = (RefinedBounds, Option<Nearby>);

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> (RefinedBounds, Option<Nearby>) {
        let mut iteration = Iteration::new(self.start, self.close);
        if self.walks_first && iteration.begin(&self).is_break() {
            return (iteration.found, None);
        }
        while iteration.found.iterations < self.max_steps {
            if iteration.step(&self).is_break() {
                break;
            }
        }
        (iteration.found, iteration.touch)
    }
}

/// What one step leaves to the next.
struct Iteration {
    found: RefinedBounds,
    simplex: Simplex,
    /// The direction from B to A along which the next support points are taken, of any length.
    v: Vec3,
    /// The largest norm of a difference of support points so far.
    largest: f64,
    /// The smallest difference of the bounds so far, and the number of steps since it last shrank.
    least_gap: f64,
    idle: u32,
    restarts: u32,
    /// Whether the sets are taken to be apart even without a direction that proves it.
    is_apart: bool,
    finishes: u32,
    /// The quotient of the bounds' difference and the upper bound at which `finish` is tried next.
    finish_at: f64,
    /// The upper bound at which it is tried next for a touch, and what it found.
    touch_at: f64,
    touch: Option<Nearby>,
}

/// What a new corner does to the simplex.
enum Extended {
    /// The point of the simplex nearest to the origin, and the foot, whose direction is more accurate.
    Nearest(Corner, Vec3),
    /// The simplex contains the origin: the sets overlap.
    Overlap,
    /// The corner is no progress.
    Stuck,
}

impl Iteration {
    #[inline(always)]
    fn new(start: Vec3, close: f64) -> Self {
        Self {
            found: RefinedBounds {
                lower: 0.0,
                direction: Vec3::zeros(),
                upper: f64::INFINITY,
                depth: 0.0,
                points: [Vec3::zeros(); 2],
                names: None,
                iterations: 0,
            },
            simplex: Simplex::empty(),
            v: if start == Vec3::zeros() {
                Vec3::x()
            } else {
                start
            },
            largest: 0.0,
            least_gap: f64::INFINITY,
            idle: 0,
            restarts: 0,
            is_apart: false,
            finishes: 0,
            finish_at: FIRST_FINISH,
            touch_at: close,
            touch: None,
        }
    }

    /// Finds the first simplex; breaks where the sets overlap or touch.
    #[inline(always)]
    fn begin<A, B, F>(&mut self, sets: &Refinement<'_, A, B, F>) -> ControlFlow<()>
    where
        A: Support,
        B: Support,
    {
        let Beginning {
            simplex,
            lower,
            direction,
        } = beginning(sets.a, sets.b, sets.start);
        self.simplex = simplex;
        (self.found.lower, self.found.direction) = (lower, direction);
        if lower > sets.limits.cutoff {
            return ControlFlow::Break(());
        }
        self.largest = self.simplex.largest_square().sqrt();
        let rounding = VECTOR_ROUNDING * self.largest;
        match self.nearest(rounding) {
            Extended::Nearest(nearest, foot) => self.take_nearest(&nearest, foot, rounding),
            _ => ControlFlow::Break(()),
        }
    }

    /// One step of GJK; breaks when the bounds are good enough or cannot be improved.
    #[inline(always)]
    fn step<A, B, F>(&mut self, sets: &Refinement<'_, A, B, F>) -> ControlFlow<()>
    where
        A: Support,
        B: Support,
        F: Fn(&[Names; 2], &Vec3, bool) -> Option<Nearby>,
    {
        self.found.iterations += 1;
        let length = self.v.norm();
        let corner = self.support_corner(sets.a, sets.b, length);
        let gap = self.found.upper - self.found.lower;
        let limits = &sets.limits;
        let is_known = self.found.upper <= limits.enough || self.found.lower > limits.cutoff;
        let accepted = match sets.finish {
            Some(_) => sets.accepted,
            None => sets.accepted.max(THRESHOLD_GAP * self.found.upper),
        };
        if is_known || gap <= accepted {
            return ControlFlow::Break(());
        }
        let rounding = VECTOR_ROUNDING * self.largest;
        if self.found.lower > rounding
            && gap <= self.finish_at * self.found.upper
            && self.finishes < MAX_FINISHES
        {
            self.finishes += 1;
            self.finish_at = FIRST_FINISH * gap / self.found.upper;
            let direction = self.v / length;
            if self.found.finish(&self.simplex, &direction, sets.finish) {
                return ControlFlow::Break(());
            }
        }
        if self.found.upper <= self.touch_at
            && let (Some(finish), Some(names)) = (sets.finish, self.simplex.names())
        {
            self.touch_at = FIRST_FINISH * self.found.upper;
            self.touch = finish(&names, &(self.v / length), true);
            if self.touch.is_some() {
                return ControlFlow::Break(());
            }
        }
        self.idle = if gap < self.least_gap {
            0
        } else {
            self.idle + 1
        };
        self.least_gap = self.least_gap.min(gap);
        match self.extend(corner, rounding) {
            Extended::Nearest(nearest, foot) => self.take_nearest(&nearest, foot, rounding),
            Extended::Overlap => ControlFlow::Break(()),
            Extended::Stuck => {
                let direction = self.found.direction;
                if self.found.lower > rounding
                    && self.found.finish(&self.simplex, &direction, sets.finish)
                {
                    return ControlFlow::Break(());
                }
                self.restart()
            }
        }
    }

    /// Improves the bounds by the support points along `v`, and returns the corner between them.
    #[inline(always)]
    fn support_corner(&mut self, a: &impl Support, b: &impl Support, length: f64) -> Corner {
        let (on_a, on_b) = (a.extreme(&-self.v), b.extreme(&self.v));
        let corner = Corner::between(on_a, on_b);
        let difference = corner.difference;
        self.largest = self.largest.max(difference.norm());
        let lower = self.v.dot(&difference) / length;
        if lower > self.found.lower {
            self.found.lower = lower;
            self.found.direction = self.v / length;
        }
        if difference.norm() < self.found.upper {
            self.found.upper = difference.norm();
            self.found.points = [on_a.point, on_b.point];
        }
        corner
    }

    /// Adds a corner to the simplex and reduces it to the face nearest to the origin.
    #[inline(always)]
    fn extend(&mut self, corner: Corner, rounding: f64) -> Extended {
        let simplex = &mut self.simplex;
        if self.idle > MAX_IDLE || simplex.contains(&corner.difference) || simplex.is_full() {
            return Extended::Stuck;
        }
        simplex.push(corner);
        self.nearest(rounding)
    }

    /// Reduces the simplex to the face nearest to the origin, unless it contains the origin.
    #[inline(always)]
    fn nearest(&mut self, rounding: f64) -> Extended {
        let simplex = &mut self.simplex;
        if self.is_apart || self.found.lower > rounding {
            let (nearest, foot) = simplex.nearest_apart();
            return Extended::Nearest(nearest, foot);
        }
        match simplex.reduce() {
            OriginPosition::Inside { at, margin } if at.difference.norm() <= rounding => {
                (self.found.upper, self.found.depth) = (0.0, margin);
                self.found.points = [at.on_a; 2];
                Extended::Overlap
            }
            // The four corners are coplanar and have no inside: restart from the point that they combine to.
            OriginPosition::Inside { at, .. } => {
                *simplex = Simplex::empty();
                Extended::Nearest(at, at.difference)
            }
            // A point of the difference even where rounding spoilt the foot on a needle-like triangle.
            OriginPosition::Outside(point) => Extended::Nearest(simplex.combined(&point), point),
        }
    }

    /// Takes the simplex's nearest point as upper bound and the foot as next direction. Breaks where the sets touch.
    #[inline(always)]
    fn take_nearest(&mut self, nearest: &Corner, foot: Vec3, rounding: f64) -> ControlFlow<()> {
        let upper = nearest.difference.norm();
        if upper < self.found.upper {
            self.found.upper = upper;
            self.found.points = [nearest.on_a, nearest.on_a - nearest.difference];
        }
        if upper <= rounding {
            return ControlFlow::Break(());
        }
        self.v = if foot == Vec3::zeros() {
            nearest.difference
        } else {
            foot
        };
        ControlFlow::Continue(())
    }

    /// Restarts from the best direction known, after rounding has spoilt the corners. Breaks after too many restarts.
    #[inline(always)]
    fn restart(&mut self) -> ControlFlow<()> {
        let found = &self.found;
        self.restarts += 1;
        let is_known = found.direction != Vec3::zeros();
        if self.restarts > MAX_RESTARTS || !is_known && self.is_apart {
            return ControlFlow::Break(());
        }
        self.idle = 0;
        self.simplex = Simplex::empty();
        if !is_known {
            // The sets are so near that the direction between the points is mostly rounding; a triangle's normal is more
            // accurate.
            self.is_apart = true;
            self.v = found.points[0] - found.points[1];
            return ControlFlow::Continue(());
        }
        let between = (found.points[0] - found.points[1]) / found.upper;
        let part = f64::from(self.restarts) / 4.0;
        self.v = between + (found.direction - between) * part;
        ControlFlow::Continue(())
    }
}
