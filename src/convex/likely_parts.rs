//! The parts of two surfaces that probably hold the closest points, without a search. A point, a segment or a box inside each core has
//! closest points in closed form; from these, nearest points of one core to the other's find the parts in a few steps. Where the guess is
//! right, Newton's method ends at the distance. On the way most cores that meet are seen to: a point of one is deep inside the other.

use std::ops::ControlFlow;

use super::core::{Core, SmoothCore};
use super::cuboid_distance::{nearest_parameter, way_from_cuboid};
use super::nearest_parts::NearestParts;
use super::placed::PlacedPrimitive;
use super::point_to_smooth::nearest_on_smooth;
use super::polytope_distance::cuboid;
use super::segment::{Segment, closest_parameters};
use crate::gjk::{DistanceLimits, Names, Nearby, Support};
use crate::lanes::{Instructions, Work};
use crate::pose::{Vec3, turned, turned_back};
use crate::primitive::{Cuboid, HIGH_END, LOW_END, SmoothKind};

/// How often each core's point nearest to the other's is taken. With 1 the guess is right for a tenth fewer pairs, with 3 for a twentieth
/// more, which takes longer than it spares.
const ROUNDS: usize = 2;

/// Two cores, and when what is known of them is enough.
pub struct LikelyParts<'a> {
    pub cores: [&'a Core<'a>; 2],
    /// How far apart the bounds of a distance may be.
    pub accepted: f64,
    /// A gap of no more than this proves nothing.
    pub least: f64,
    /// How deep a point has to be inside to prove that the cores meet.
    pub deep: f64,
    /// Cores whose gap is at most this may be about to touch.
    pub close: f64,
    /// The distance is not asked for where it is known to be at most `enough`, or more than `cutoff`.
    pub limits: DistanceLimits,
}

/// What a guess has proved.
pub enum ByParts {
    /// The cores are farther apart than the cutoff.
    Beyond {
        /// A unit direction from B to A, and the gap along it.
        direction: Vec3,
        gap: f64,
    },
    /// The closest points.
    Near(Nearby),
    /// A point of A and one of B that are near enough to each other.
    Within([Vec3; 2]),
    /// The cores meet: a point of both, and a ball around it that is in one of them.
    Meet { point: Vec3, depth: f64 },
    /// Nothing, but the cores are about to touch or do: points of them that are next to each other, and a guess of the unit direction from B to
    /// A, or zero.
    Close { points: [Vec3; 2], direction: Vec3 },
}

impl Work for LikelyParts<'_> {
    type Output = Option<ByParts>;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> Option<ByParts> {
        let inner = [Inner::of(self.cores[0])?, Inner::of(self.cores[1])?];
        let (points, mut names) = match self.nearest_points(&inner) {
            ControlFlow::Continue(found) => found,
            ControlFlow::Break(proved) => return proved,
        };
        let way = points[0] - points[1];
        if way.norm() <= self.limits.enough {
            return Some(ByParts::Within(points));
        }
        let direction = way.try_normalize(0.0).unwrap_or_else(Vec3::zeros);
        let close = ByParts::Close { points, direction };
        if direction == Vec3::zeros() {
            return Some(close);
        }
        let supports = self.supports(&direction);
        let gap = Self::gap_along(&direction, &supports);
        if gap > self.limits.cutoff {
            return Some(ByParts::Beyond { direction, gap });
        }
        if gap <= self.least {
            return Some(self.meeting_at(&supports, &inner).unwrap_or(close));
        }
        for side in 0..2 {
            // The other's point was its centre until now.
            if inner[1 - side].is_ellipsoid()
                && let Nearest::At(_, on) = inner[side].nearest(&supports[1 - side])
            {
                names[side] = on;
            }
        }
        let parts = NearestParts::new(self.cores, names, self.accepted)?;
        match parts.solve(&direction) {
            Some(near) => Some(ByParts::Near(near)),
            None => (gap <= self.close).then_some(close),
        }
    }
}

impl LikelyParts<'_> {
    /// A point of each core that is near to the other, and the names of the parts that these are on; of an ellipsoid its centre. Breaks
    /// where something is proved before, or nothing can be.
    #[inline(always)]
    fn nearest_points(
        &self,
        inner: &[Inner; 2],
    ) -> ControlFlow<Option<ByParts>, ([Vec3; 2], [Names; 2])> {
        let Some((mut points, first)) = between_inner(inner) else {
            return ControlFlow::Break(None);
        };
        let mut names = [Names::one(0); 2];
        let begun = usize::from(inner.iter().any(|one| matches!(one, Inner::Cuboid(..))));
        for step in 0..begun + 2 * ROUNDS {
            // From an ellipsoid's centre the direction is hardly another one later.
            if step == begun
                && !inner.iter().any(Inner::is_ellipsoid)
                && let Some(beyond) = self.beyond_cutoff(&points)
            {
                return ControlFlow::Break(Some(beyond));
            }
            let side = (first + step) % 2;
            let point = points[1 - side];
            match inner[side].nearest(&point) {
                Nearest::Unknown => (),
                Nearest::At(there, on) => (points[side], names[side]) = (there, on),
                Nearest::Inside(depth) => {
                    return ControlFlow::Break(Some(self.meeting_or_close(point, depth)));
                }
            }
        }
        ControlFlow::Continue((points, names))
    }

    /// Whether the direction between two points parts the cores by more than the cutoff, if there is one. Of many pairs whose distance is
    /// bounded most do.
    #[inline(always)]
    fn beyond_cutoff(&self, points: &[Vec3; 2]) -> Option<ByParts> {
        let cutoff = self.limits.cutoff;
        if cutoff == f64::INFINITY {
            return None;
        }
        let direction = (points[0] - points[1]).try_normalize(0.0)?;
        let gap = Self::gap_along(&direction, &self.supports(&direction));
        (gap > cutoff).then_some(ByParts::Beyond { direction, gap })
    }

    /// Whether the cores meet where a support point of one is inside the other.
    #[inline(always)]
    fn meeting_at(&self, supports: &[Vec3; 2], inner: &[Inner; 2]) -> Option<ByParts> {
        (0..2).find_map(|side| {
            let point = supports[1 - side];
            match inner[side].nearest(&point) {
                Nearest::Inside(depth) if depth > self.deep => Some(ByParts::Meet { point, depth }),
                _ => None,
            }
        })
    }

    /// What a point of one core proves that is inside the other, so deep.
    #[inline(always)]
    fn meeting_or_close(&self, point: Vec3, depth: f64) -> ByParts {
        if depth > self.deep {
            return ByParts::Meet { point, depth };
        }
        ByParts::Close {
            points: [point; 2],
            direction: Vec3::zeros(),
        }
    }

    /// The support points of A and B towards each other, for a direction from B to A.
    #[inline(always)]
    fn supports(&self, direction: &Vec3) -> [Vec3; 2] {
        let [a, b] = self.cores;
        [a.support(&-direction), b.support(direction)]
    }

    #[inline(always)]
    fn gap_along(direction: &Vec3, supports: &[Vec3; 2]) -> f64 {
        direction.dot(&(supports[0] - supports[1]))
    }
}

/// Whether a core holds a point, up to a distance of `slack`; no where that has no closed form.
pub fn holds(core: &Core, point: &Vec3, slack: f64) -> bool {
    let Some(inner) = Inner::of(core) else {
        return core.smooth().is_none() && core.placed().holds(point, slack);
    };
    match inner.nearest(point) {
        Nearest::Inside(_) => true,
        Nearest::At(there, _) => (there - point).norm() <= slack,
        Nearest::Unknown => false,
    }
}

/// A core, with what is inside it and near to all of its surface: an axis, a centre, or the whole.
enum Inner<'a> {
    /// A hull of one or two vertices.
    Segment(Segment),
    Cuboid(&'a PlacedPrimitive<'a>, &'a Cuboid),
    /// A solid of revolution and its axis, from the low end to the high one.
    Round(&'a SmoothCore<'a>, Segment),
    Ellipsoid(&'a SmoothCore<'a>, Vec3),
}

/// The point of a core nearest to another point, and the names of the part that it is on.
enum Nearest {
    At(Vec3, Names),
    /// The other point is inside, at least this deep.
    Inside(f64),
    /// Not in closed form.
    Unknown,
}

impl<'a> Inner<'a> {
    /// `None` for hulls that are no boxes, and for the caller's support functions.
    #[inline(always)]
    fn of(core: &'a Core) -> Option<Self> {
        let Some(smooth) = core.smooth() else {
            return Some(match core.placed().vertex_count() {
                1 => Self::Segment(Segment::point(core.vertex(0))),
                2 => Self::Segment(Segment::new((core.vertex(0), core.vertex(1)))),
                _ => Self::Cuboid(core.placed(), cuboid(core.placed())?),
            });
        };
        let half = match *smooth.kind {
            SmoothKind::Cylinder { half_length, .. } => half_length,
            SmoothKind::Cone { height, .. } => 0.5 * height,
            SmoothKind::Ellipsoid { semi_axes } => return Some(Self::Ellipsoid(smooth, semi_axes)),
            SmoothKind::Function(_) => return None,
        };
        let up = smooth.axes.column(2) * half;
        let axis = Segment::new((smooth.center - up, smooth.center + up));
        Some(Self::Round(smooth, axis))
    }

    #[inline(always)]
    fn is_ellipsoid(&self) -> bool {
        matches!(self, Self::Ellipsoid(..))
    }

    #[inline(always)]
    fn nearest(&self, point: &Vec3) -> Nearest {
        match self {
            Self::Segment(segment) => {
                let place = segment.nearest_parameter(point);
                let names = if place <= 0.0 {
                    Names::one(0)
                } else if place >= 1.0 {
                    Names::one(1)
                } else {
                    Names::two(0, 1)
                };
                Nearest::At(segment.at(place), names)
            }
            Self::Cuboid(placed, cuboid) => nearest_of_cuboid(point, placed, cuboid),
            Self::Round(smooth, _) => nearest_of_round(point, smooth),
            Self::Ellipsoid(smooth, semi_axes) => {
                let scaled = smooth.seen(point).component_div(semi_axes).norm();
                if scaled < 1.0 {
                    Nearest::Inside((1.0 - scaled) * semi_axes.min())
                } else {
                    Nearest::Unknown
                }
            }
        }
    }
}

#[inline(always)]
fn nearest_of_cuboid(point: &Vec3, placed: &PlacedPrimitive, cuboid: &Cuboid) -> Nearest {
    let seen = cuboid.seen(&placed.seen(point));
    let Some(way) = way_from_cuboid(&seen, cuboid) else {
        return Nearest::Inside((cuboid.half - seen.abs()).min());
    };
    let Some(names) = placed.names_of(cuboid.feature_towards(&seen)) else {
        return Nearest::Unknown;
    };
    let way = placed.turned(&turned(&cuboid.axes, &way));
    Nearest::At(point - way, names)
}

#[inline(always)]
fn nearest_of_round(point: &Vec3, smooth: &SmoothCore) -> Nearest {
    let local = smooth.seen(point);
    let half = match *smooth.kind {
        SmoothKind::Cylinder { half_length, .. } => half_length,
        SmoothKind::Cone { height, .. } => 0.5 * height,
        SmoothKind::Ellipsoid { .. } | SmoothKind::Function(_) => return Nearest::Unknown,
    };
    let there = match nearest_on_smooth(&local, smooth.kind) {
        Some(there) if there != local => there,
        _ => return Nearest::Inside(depth_in_round(&local, smooth.kind)),
    };
    let names = if there.z >= half {
        Names::one(HIGH_END)
    } else if there.z <= -half {
        Names::one(LOW_END)
    } else {
        Names::two(LOW_END, HIGH_END)
    };
    Nearest::At(smooth.moved(&there), names)
}

/// How far a point in a cylinder or a cone is from its surface.
#[inline(always)]
fn depth_in_round(local: &Vec3, kind: &SmoothKind) -> f64 {
    let away = (local.x * local.x + local.y * local.y).sqrt();
    match *kind {
        SmoothKind::Cylinder {
            radius,
            half_length,
        } => (radius - away).min(half_length - local.z.abs()),
        SmoothKind::Cone { radius, height } => {
            let half = 0.5 * height;
            let from_side = (half - local.z) * radius - away * height;
            (local.z + half).min(from_side / radius.hypot(height))
        }
        SmoothKind::Ellipsoid { .. } | SmoothKind::Function(_) => 0.0,
    }
}

/// The closest points of what is inside two cores, and which of them is to be looked for first: a box takes the other's point until then.
/// `None` for two boxes.
#[inline(always)]
fn between_inner(inner: &[Inner; 2]) -> Option<([Vec3; 2], usize)> {
    let segments = [0, 1].map(|side| match &inner[side] {
        Inner::Segment(segment) | Inner::Round(_, segment) => Some(*segment),
        Inner::Ellipsoid(smooth, _) => Some(Segment::point(smooth.center)),
        Inner::Cuboid(..) => None,
    });
    match (segments, inner) {
        ([Some(a), Some(b)], _) => {
            let (s, t) = closest_parameters(&a, &b);
            Some(([a.at(s), b.at(t)], 0))
        }
        ([Some(a), None], [_, Inner::Cuboid(placed, cuboid)]) => {
            Some(([nearest_to_cuboid(&a, placed, cuboid); 2], 1))
        }
        ([None, Some(b)], [Inner::Cuboid(placed, cuboid), _]) => {
            Some(([nearest_to_cuboid(&b, placed, cuboid); 2], 0))
        }
        _ => None,
    }
}

/// The point of a segment nearest to a box.
#[inline(always)]
fn nearest_to_cuboid(segment: &Segment, placed: &PlacedPrimitive, cuboid: &Cuboid) -> Vec3 {
    let from = cuboid.seen(&placed.seen(&segment.ends()[0]));
    let along = turned_back(&cuboid.axes, &placed.turned_back(segment.along()));
    segment.at(nearest_parameter(&from, &along, &cuboid.half))
}
