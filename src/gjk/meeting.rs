//! Whether two sets meet: GJK that computes only on which side of the simplex the origin lies, not the closest point.

use super::Support;
use super::simplex::{Corner, Simplex};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Vec3;
use crate::tolerance;

/// Sets that need more steps than this are mostly close to touching; the caller then computes their distance.
const MAX_STEPS: usize = 16;

/// What a few steps have proved of two sets.
pub enum Proved {
    /// They meet.
    Meet,
    /// They are farther apart than the cutoff.
    Beyond {
        /// A direction from B to A along which they are, of any length.
        direction: Vec3,
        /// The lowest point of A - B along it.
        lowest: Vec3,
    },
}

/// Whether A and B meet or are farther apart than `cutoff`; `None` if neither is proved within a few steps. No coordinate of A and B
/// exceeds `size`. `start` is a guess of the direction from B to A, or zero.
pub fn meeting<A: Support, B: Support>(
    a: &A,
    b: &B,
    start: Vec3,
    size: f64,
    cutoff: f64,
) -> Option<Proved> {
    // Directions are products of three lengths, and support functions square them: in units of the size they stay in range.
    let unit = power_of_two_below(size);
    with_widest(MeetingSearch {
        a,
        b,
        start: start / unit,
        unit,
        inverse_unit: 1.0 / unit,
        depth: tolerance::TOUCH_DEPTH * (size / unit),
        cutoff: cutoff / unit,
    })
}

/// The largest power of two that is no larger than a length.
fn power_of_two_below(length: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(length.to_bits() & EXPONENT)
}

struct MeetingSearch<'a, A, B> {
    a: &'a A,
    b: &'a B,
    start: Vec3,
    unit: f64,
    inverse_unit: f64,
    /// The depth, in units, from which the origin counts as inside a tetrahedron.
    depth: f64,
    cutoff: f64,
}

impl<A: Support, B: Support> Work for MeetingSearch<'_, A, B> {
    type Output = Option<Proved>;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> Option<Proved> {
        let in_units = |corner: Corner| corner.difference * self.inverse_unit;
        match walk(self.a, self.b, self.start, in_units).1 {
            End::Apart { newest, v } => {
                // `v` separates the sets, but maybe by less than the cutoff.
                let along = v.dot(&newest);
                let is_apart = along * along > self.cutoff * self.cutoff * v.norm_squared();
                is_apart.then(|| Proved::Beyond {
                    direction: v,
                    lowest: newest * self.unit,
                })
            }
            End::Inside(corners) => is_deep_inside(&corners, self.depth).then_some(Proved::Meet),
            End::Open => None,
        }
    }
}

/// Where to begin the search for the point of the difference A - B nearest to the origin.
pub(super) struct Beginning {
    /// At least one corner: a tetrahedron around the origin where the sets overlap by much.
    pub simplex: Simplex,
    /// The gap along `direction`, if that parts the sets, else 0.
    pub lower: f64,
    /// The unit direction from B to A.
    pub direction: Vec3,
}

/// Walks towards the origin until a tetrahedron holds it or a direction parts it from the sets.
#[inline(always)]
pub(super) fn beginning<A: Support, B: Support>(a: &A, b: &B, start: Vec3) -> Beginning {
    let largest = start.amax();
    let unit = if largest > 0.0 && largest < f64::INFINITY {
        power_of_two_below(largest)
    } else {
        1.0
    };
    let inverse_unit = 1.0 / unit;
    let in_units = |corner: Corner| Corner {
        difference: corner.difference * inverse_unit,
        ..corner
    };
    let (sides, end) = walk(a, b, start * inverse_unit, in_units);
    let mut simplex = Simplex::empty();
    let (mut lower, mut direction) = (0.0, Vec3::zeros());
    let mut push = |corner: Corner| {
        let difference = corner.difference * unit;
        if !simplex.contains(&difference) {
            simplex.push(Corner {
                difference,
                ..corner
            });
        }
    };
    match (sides, end) {
        (_, End::Inside(corners)) => corners.into_iter().for_each(&mut push),
        (sides, end) => {
            match sides {
                Sides::Nothing => (),
                Sides::Point(a) => push(a),
                Sides::Segment(a, b) => [b, a].into_iter().for_each(&mut push),
                Sides::Triangle(a, b, c) => [c, b, a].into_iter().for_each(&mut push),
            }
            if let End::Apart { newest, v } = end {
                push(newest);
                let length = v.norm();
                let gap = v.dot(&newest.difference) / length * unit;
                if gap > 0.0 {
                    (lower, direction) = (gap, v / length);
                }
            }
        }
    }
    Beginning {
        simplex,
        lower,
        direction,
    }
}

/// How a walk ended.
enum End<C> {
    /// The direction `v` parts the sets: the origin is beyond the newest corner.
    Apart { newest: C, v: Vec3 },
    /// The origin is inside these corners.
    Inside([C; 4]),
    /// Neither is known after the most steps.
    Open,
}

/// Walks from simplex to simplex towards the origin. `kept` makes of a corner what is kept of it, in units in which the sets are
/// about 1 large.
#[inline(always)]
fn walk<A: Support, B: Support, C: Place>(
    a: &A,
    b: &B,
    start: Vec3,
    kept: impl Fn(Corner) -> C,
) -> (Sides<C>, End<C>) {
    let mut v = if start == Vec3::zeros() {
        Vec3::x()
    } else {
        start
    };
    let mut sides = Sides::Nothing;
    for _ in 0..MAX_STEPS {
        if v.norm_squared() == 0.0 {
            break;
        }
        let newest = kept(Corner::between(a.extreme(&-v), b.extreme(&v)));
        if v.dot(&newest.at()) > 0.0 {
            return (sides, End::Apart { newest, v });
        }
        (sides, v) = match sides.with(newest) {
            Next::Beyond(sides, towards) => (sides, -towards),
            Next::Inside(corners) => return (sides, End::Inside(corners)),
        };
    }
    (sides, End::Open)
}

/// What is kept of a corner of the difference A - B.
trait Place: Copy {
    /// The difference.
    fn at(&self) -> Vec3;
}

impl Place for Vec3 {
    #[inline(always)]
    fn at(&self) -> Vec3 {
        *self
    }
}

impl Place for Corner {
    #[inline(always)]
    fn at(&self) -> Vec3 {
        self.difference
    }
}

/// The simplex: corners of the difference A - B, the newest first.
#[derive(Clone, Copy)]
enum Sides<C> {
    Nothing,
    Point(C),
    Segment(C, C),
    /// Counter-clockwise as seen from the origin.
    Triangle(C, C, C),
}

enum Next<C> {
    /// The origin is outside: the face of the simplex that it lies beyond, and the direction from that face to the origin.
    Beyond(Sides<C>, Vec3),
    /// The origin is on the inner side of the three new faces.
    Inside([C; 4]),
}

impl<C: Place> Sides<C> {
    #[inline(always)]
    fn with(self, a: C) -> Next<C> {
        match self {
            Self::Nothing => Next::Beyond(Self::Point(a), -a.at()),
            Self::Point(b) => beyond_segment(a, b),
            Self::Segment(b, c) => beyond_triangle(a, b, c),
            Self::Triangle(b, c, d) => {
                let at = a.at();
                let (ab, ac, ad) = (b.at() - at, c.at() - at, d.at() - at);
                // These normals point out of the tetrahedron: the origin and the newest corner are on the same side of the old
                // triangle.
                let outside = |normal: Vec3| normal.dot(&at) < 0.0;
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
fn beyond_segment<C: Place>(a: C, b: C) -> Next<C> {
    let at = a.at();
    let ab = b.at() - at;
    if ab.dot(&at) < 0.0 {
        Next::Beyond(Sides::Segment(a, b), ab.cross(&ab.cross(&at)))
    } else {
        Next::Beyond(Sides::Point(a), -at)
    }
}

#[inline(always)]
fn beyond_triangle<C: Place>(a: C, b: C, c: C) -> Next<C> {
    let at = a.at();
    let (ab, ac) = (b.at() - at, c.at() - at);
    let normal = ab.cross(&ac);
    if normal.cross(&ac).dot(&at) < 0.0 {
        if ac.dot(&at) < 0.0 {
            return Next::Beyond(Sides::Segment(a, c), ac.cross(&ac.cross(&at)));
        }
        return beyond_segment(a, b);
    }
    if ab.cross(&normal).dot(&at) < 0.0 {
        return beyond_segment(a, b);
    }
    if normal.dot(&at) < 0.0 {
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
