//! The closest points of two boxes of which an axis of one is parallel to one of the other, as of those that stand on one floor: the
//! distance along that axis, and that of two rectangles across it.
//!
//! Of all closest points these are an end of what they have in common, on features that have a contact mode: a corner, or the crossing of
//! two edges. A direction proves them; where none does, the axes were not parallel enough.

use nalgebra::Vector2;

use super::cuboid_axes::{CuboidAxes, GAP_ERROR};
use crate::lanes::each3;
use crate::pose::{Vec3, turned_back};
use crate::tolerance;

/// The ends of a rectangle's sides.
const CORNERS: [Vector2<f64>; 4] = [
    Vector2::new(-1.0, -1.0),
    Vector2::new(1.0, -1.0),
    Vector2::new(1.0, 1.0),
    Vector2::new(-1.0, 1.0),
];

/// The closest points of boxes that are apart, each in its own box's frame; `None` where no axes are parallel. `size` is no less than any
/// coordinate of the two.
#[inline(always)]
pub fn parallel_closest(axes: &CuboidAxes, size: f64) -> Option<[Vec3; 2]> {
    let found = Candidate::of(axes, parallel_axes(axes, |_| true)?, size, 0.0)?;
    is_proved(axes, &found.way, size).then_some(found.points)
}

/// The same for boxes that may touch across this axis of one of them, 0 for A, or are just inside one another there: nothing proves these
/// points.
pub fn parallel_touching(
    axes: &CuboidAxes,
    (side, axis): (usize, usize),
    size: f64,
) -> Option<[Vec3; 2]> {
    let pair = parallel_axes(axes, |pair| pair[side] == axis)?;
    let found = Candidate::of(axes, pair, size, tolerance::JUST_INSIDE * size)?;
    Some(found.points)
}

/// What the closest points are if the axes are parallel enough.
struct Candidate {
    /// Each in its own box's frame.
    points: [Vec3; 2],
    /// From B's point to A's, in the frame of A.
    way: Vec3,
}

impl Candidate {
    /// Boxes that overlap along the parallel axes by less than `touch` count as apart there.
    #[inline(always)]
    fn of(axes: &CuboidAxes, [i, j]: [usize; 2], size: f64, touch: f64) -> Option<Self> {
        let (next, last) = ((i + 1) % 3, (i + 2) % 3);
        let (next_b, last_b) = ((j + 1) % 3, (j + 2) % 3);
        let [[a, d], [b, c]] = [[next, last], [next_b, last_b]];
        let across = Rectangles {
            half_a: Vector2::new(axes.half_a[a], axes.half_a[d]),
            half_b: Vector2::new(axes.half_b[b], axes.half_b[c]),
            between: Vector2::new(axes.between[a], axes.between[d]),
            turn: [
                Vector2::new(axes.turn[(a, b)], axes.turn[(d, b)]),
                Vector2::new(axes.turn[(a, c)], axes.turn[(d, c)]),
            ],
        };
        let flat = across.closest(GAP_ERROR * size)?;
        let along = Along::of(axes, i, j, touch);
        let place = |along: usize, height: f64, flat: Vector2<f64>| {
            let mut place = Vec3::zeros();
            place[along] = height;
            place[(along + 1) % 3] = flat.x;
            place[(along + 2) % 3] = flat.y;
            place
        };
        Some(Self {
            points: [
                place(i, along.points[0], flat.points[0]),
                place(j, along.points[1], flat.points[1]),
            ],
            way: place(i, along.way, flat.way),
        })
    }
}

/// An axis of each that are parallel, of those asked for.
#[inline(always)]
fn parallel_axes(axes: &CuboidAxes, is_asked: impl Fn([usize; 2]) -> bool) -> Option<[usize; 2]> {
    for i in 0..3 {
        let row = each3(|j| axes.turn[(i, j)].abs());
        for j in 0..3 {
            let off = row[(j + 1) % 3].max(row[(j + 2) % 3]);
            if off <= tolerance::PARALLEL_AXES && is_asked([i, j]) {
                return Some([i, j]);
            }
        }
    }
    None
}

/// The closest places along the parallel axes, of A and of B.
struct Along {
    points: [f64; 2],
    /// From B's to A's along A's axis; 0 where they overlap.
    way: f64,
}

impl Along {
    /// Where the boxes overlap by more than a touch, the low end of what they have in common.
    #[inline(always)]
    fn of(axes: &CuboidAxes, i: usize, j: usize, touch: f64) -> Self {
        let (half_a, half_b, between) = (axes.half_a[i], axes.half_b[j], axes.between[i]);
        let (low, high) = (between - half_b, between + half_b);
        let (on_a, on_b, way) = if low > half_a - touch {
            (half_a, -half_b, half_a - low)
        } else if high < touch - half_a {
            (-half_a, half_b, -half_a - high)
        } else {
            let common = low.max(-half_a);
            (common, (common - between).clamp(-half_b, half_b), 0.0)
        };
        Self {
            points: [on_a, on_b * axes.turn[(i, j)].signum()],
            way,
        }
    }
}

/// The closest points of two rectangles, each in its own frame.
#[derive(Clone, Copy, Default)]
struct Flat {
    points: [Vector2<f64>; 2],
    /// From B's point to A's, in the frame of A. Across a side it has that side's normal: a difference of the points would be off it by
    /// their rounding.
    way: Vector2<f64>,
}

/// Two rectangles in the frame of the first, at its centre.
struct Rectangles {
    half_a: Vector2<f64>,
    half_b: Vector2<f64>,
    /// The centre of B.
    between: Vector2<f64>,
    /// The axes of B.
    turn: [Vector2<f64>; 2],
}

impl Rectangles {
    /// Where they meet, a point of both that is a corner of one or the crossing of two sides.
    #[inline(always)]
    fn closest(&self, error: f64) -> Option<Flat> {
        let mut least = f64::INFINITY;
        let mut best = Flat::default();
        for corner in CORNERS {
            let on_b = corner.component_mul(&self.half_b);
            let place = self.of_b(&on_b);
            let on_a = clamped(&place, &self.half_a);
            let (way, points) = (on_a - place, [on_a, on_b]);
            if way.norm_squared() < least {
                (least, best) = (way.norm_squared(), Flat { points, way });
            }
        }
        for corner in CORNERS {
            let on_a = corner.component_mul(&self.half_a);
            let place = self.seen_by_b(&on_a);
            let on_b = clamped(&place, &self.half_b);
            let (seen, points) = (place - on_b, [on_a, on_b]);
            if seen.norm_squared() < least {
                let way = self.turn[0] * seen.x + self.turn[1] * seen.y;
                (least, best) = (seen.norm_squared(), Flat { points, way });
            }
        }
        if least > error * error && self.overlap() {
            return self.crossing();
        }
        Some(best)
    }

    /// A point of B, in the frame of A.
    #[inline(always)]
    fn of_b(&self, point: &Vector2<f64>) -> Vector2<f64> {
        self.between + self.turn[0] * point.x + self.turn[1] * point.y
    }

    /// A point of A, in the frame of B.
    #[inline(always)]
    fn seen_by_b(&self, point: &Vector2<f64>) -> Vector2<f64> {
        let way = point - self.between;
        Vector2::new(self.turn[0].dot(&way), self.turn[1].dot(&way))
    }

    /// Whether no side parts the two.
    fn overlap(&self) -> bool {
        let ([x, y], seen) = (self.turn, self.seen_by_b(&Vector2::zeros()));
        let reach_b = x.abs() * self.half_b.x + y.abs() * self.half_b.y;
        let reach_a = Vector2::new(x.abs().dot(&self.half_a), y.abs().dot(&self.half_a));
        let at_a = self.between.abs() - self.half_a - reach_b;
        let at_b = seen.abs() - self.half_b - reach_a;
        at_a.max().max(at_b.max()) < 0.0
    }

    /// Where a side of B crosses one of A.
    #[inline(never)]
    fn crossing(&self) -> Option<Flat> {
        let corners = CORNERS.map(|corner| corner.component_mul(&self.half_b));
        for k in 0..4 {
            let (from, to) = (corners[k], corners[(k + 1) % 4]);
            let (start, end) = (self.of_b(&from), self.of_b(&to));
            for (across, along) in [(0, 1), (1, 0)] {
                for bound in [-self.half_a[across], self.half_a[across]] {
                    let part = (bound - start[across]) / (end[across] - start[across]);
                    let other = start[along] + (end[along] - start[along]) * part;
                    if part > 0.0 && part < 1.0 && other.abs() <= self.half_a[along] {
                        let mut on_a = Vector2::zeros();
                        (on_a[across], on_a[along]) = (bound, other);
                        return Some(Flat {
                            points: [on_a, from + (to - from) * part],
                            way: Vector2::zeros(),
                        });
                    }
                }
            }
        }
        None
    }
}

#[inline(always)]
fn clamped(point: &Vector2<f64>, half: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(
        point.x.clamp(-half.x, half.x),
        point.y.clamp(-half.y, half.y),
    )
}

/// Whether the direction of a way from B to A, in the frame of A, proves that the boxes are as far apart as it is long.
#[inline(always)]
fn is_proved(axes: &CuboidAxes, way: &Vec3, size: f64) -> bool {
    let distance = way.norm();
    let direction = way / distance;
    let seen_by_b = turned_back(&axes.turn, &direction);
    let extents = direction.abs().dot(&axes.half_a) + seen_by_b.abs().dot(&axes.half_b);
    let lower = -direction.dot(&axes.between) - extents;
    distance > GAP_ERROR * size && (distance - lower).abs() <= tolerance::CERTIFIED_GAP * size
}
