//! The distance of two flat polygons, four edges at a time.

use super::closest::Closest;
use super::nearest_edges::{NearestEdges, nearest_edges};
use super::outline::{Outline, Side};
use super::polygon_crossing::cross;
use crate::lanes::{Instructions, Plain};
use crate::pose::Vec3;
use crate::primitive::Feature;
use crate::tolerance;

/// The result for the distance of two polygons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PolygonDistance {
    /// The distance is above the cutoff. The nearest features, unless a plane separated the polygons before these were
    /// computed.
    Beyond(Option<NearestFeatures>),
    /// The distance and the nearest features.
    Apart(f64, NearestFeatures),
    /// They certainly cross.
    Cross,
    /// They may cross: the answer is within rounding.
    Doubt,
}

/// The nearest features of two polygons that do not cross.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NearestFeatures {
    /// A corner of the first, over the inside of the second.
    FirstCorner(usize),
    /// A corner of the second, over the inside of the first.
    SecondCorner(usize),
    Edges(NearestEdges),
}

impl NearestFeatures {
    /// The vector between the closest points, from the second polygon to the first.
    #[inline(always)]
    pub fn across<I: Instructions>(&self, a: &Outline<I>, b: &Outline<I>) -> Vec3 {
        match *self {
            Self::FirstCorner(corner) => b.normal * b.height(&a.corner(corner)),
            Self::SecondCorner(corner) => a.normal * -a.height(&b.corner(corner)),
            Self::Edges(edges) => edges.across(a, b),
        }
    }
}

/// The distance of two polygons whose coordinates are at most `size`, unless it is above `cutoff`.
///
/// All points compared belong to the polygons, so the least distance is too large only by the rounding of the closest points, a
/// few EPSILON of `size`. If rounding puts a foot on the wrong side of an edge, the distance to that edge is the same within
/// rounding.
#[inline(always)]
pub fn polygon_distance<I: Instructions>(
    a: &Outline<I>,
    b: &Outline<I>,
    cutoff: f64,
    size: f64,
) -> PolygonDistance {
    let rounding = tolerance::INSIDE_DOUBT * size;
    let sides = [a.side(b), b.side(a)];
    let apart = sides[0].gap.max(sides[1].gap);
    if apart - rounding > cutoff {
        return PolygonDistance::Beyond(None);
    }
    if apart < rounding {
        match cross(a, b, size) {
            Some(false) => {}
            Some(true) => return PolygonDistance::Cross,
            None => return PolygonDistance::Doubt,
        }
    }
    let (distance, nearest) = nearest(a, b, &sides, size);
    if distance - rounding > cutoff {
        PolygonDistance::Beyond(Some(nearest))
    } else {
        PolygonDistance::Apart(distance, nearest)
    }
}

/// The closest points of polygons that do not cross, with the corners, edges and faces that hold them; `None` if they may
/// cross. A point within `error` of a corner counts as that corner.
#[inline(always)]
pub fn polygon_closest<I: Instructions>(
    a: &Outline<I>,
    b: &Outline<I>,
    size: f64,
    error: f64,
) -> Option<Closest> {
    let PolygonDistance::Apart(distance, nearest) = polygon_distance(a, b, f64::INFINITY, size)
    else {
        return None;
    };
    let over = |polygon: &Outline<I>, other: &Outline<I>, corner: usize| {
        let point = other.corner(corner);
        let foot = point - polygon.normal * polygon.height(&point);
        let vertex = if corner < other.corners { corner } else { 0 };
        (
            [foot, point],
            [Feature::face(0), Feature::vertex(vertex as u32)],
        )
    };
    let (points, features) = match nearest {
        NearestFeatures::FirstCorner(corner) => {
            let ([foot, point], [face, vertex]) = over(b, a, corner);
            ([point, foot], [vertex, face])
        }
        NearestFeatures::SecondCorner(corner) => over(a, b, corner),
        NearestFeatures::Edges(edges) => {
            let found = edges.points(a, b, error);
            (found.points, found.features)
        }
    };
    Some(Closest {
        distance,
        points,
        features,
        doubt: 0.0,
        depth: 0.0,
    })
}

/// The distance of polygons that do not cross, and their nearest features.
///
/// If the nearest feature is a corner over the other's inside, that plane separates the two, and no other corner is nearer to
/// it. If several corners are equally near, testing one suffices: either it is over the inside, or an edge from it to another
/// such corner passes over the outline equally near.
#[inline(always)]
fn nearest<I: Instructions>(
    a: &Outline<I>,
    b: &Outline<I>,
    sides: &[Side; 2],
    size: f64,
) -> (f64, NearestFeatures) {
    let rounding = tolerance::INSIDE_DOUBT * size;
    if sides[0].gap >= rounding {
        let corner = b.corner_with(&a.normal.into(), sides[0].extreme);
        let point = b.corner(corner);
        if a.is_under(&point) {
            return (
                a.height(&point).abs(),
                NearestFeatures::SecondCorner(corner),
            );
        }
    }
    if sides[1].gap >= rounding {
        let corner = a.corner_with(&b.normal.into(), sides[1].extreme);
        let point = a.corner(corner);
        if b.is_under(&point) {
            return (b.height(&point).abs(), NearestFeatures::FirstCorner(corner));
        }
    }
    let edges = nearest_edges(a, b, sides, size);
    let by_edges = (edges.distance(), NearestFeatures::Edges(edges));
    if sides.iter().any(|side| side.gap.abs() < rounding) {
        nearest_corner(&a.plain(), &b.plain(), by_edges)
    } else {
        by_edges
    }
}

/// The nearer of the nearest edges and of the corners over the other's inside, for polygons that neither plane separates.
#[inline(never)]
fn nearest_corner(
    a: &Outline<Plain>,
    b: &Outline<Plain>,
    by_edges: (f64, NearestFeatures),
) -> (f64, NearestFeatures) {
    let (mut distance, mut found) = by_edges;
    for (is_first, polygon, other) in [(false, a, b), (true, b, a)] {
        for block in 0..other.blocks.len() {
            let inside = polygon.innermost(&other.block(block)).array();
            for lane in 0..4 {
                let corner = 4 * block + lane;
                let point = other.corner(corner);
                let height = polygon.height(&point).abs();
                if inside.0[lane] >= 0.0 && height < distance && polygon.is_under(&point) {
                    distance = height;
                    found = if is_first {
                        NearestFeatures::FirstCorner(corner)
                    } else {
                        NearestFeatures::SecondCorner(corner)
                    };
                }
            }
        }
    }
    (distance, found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{F64x4, Points64, Work, each3, with_each};

    /// A regular polygon about a point, turned about two axes.
    struct Polygon {
        blocks: Vec<Points64>,
        corners: usize,
        normal: Vec3,
    }

    impl Polygon {
        fn new(corners: usize, center: Vec3, turns: [f64; 2]) -> Self {
            let [(s, c), (t, d)] = turns.map(f64::sin_cos);
            let (x, y) = (Vec3::new(c, s, 0.0), Vec3::new(-s * d, c * d, t));
            let corner = |i: usize| {
                let i = if i < corners { i } else { 0 };
                let (sin, cos) = (std::f64::consts::TAU * i as f64 / corners as f64).sin_cos();
                center + x * cos + y * sin
            };
            let block =
                |b: usize| each3(|k| F64x4([0, 1, 2, 3].map(|lane| corner(4 * b + lane)[k])));
            Self {
                blocks: (0..corners.div_ceil(4)).map(block).collect(),
                corners,
                normal: x.cross(&y),
            }
        }

        fn outline<I: Instructions>(&self, lanes: I) -> Outline<'_, I> {
            let first = each3(|k| self.blocks[0][k].0[0]);
            Outline {
                lanes,
                blocks: &self.blocks,
                corners: self.corners,
                normal: self.normal,
                offset: self.normal.dot(&Vec3::from(first)),
            }
        }
    }

    struct Measure<'a>(&'a Polygon, &'a Polygon);

    impl Work for Measure<'_> {
        type Output = (PolygonDistance, Option<[Vec3; 2]>);

        #[inline(always)]
        fn run<I: Instructions>(self, lanes: I) -> Self::Output {
            let (a, b) = (self.0.outline(lanes), self.1.outline(lanes));
            let closest = polygon_closest(&a, &b, 4.0, 1e-12);
            let distance = polygon_distance(&a, &b, f64::INFINITY, 4.0);
            (distance, closest.map(|closest| closest.points))
        }
    }

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let mut distances = Vec::new();
        for step in 0..1000 {
            let s = (step % 200) as f64;
            let [first, second] = [[4, 4], [3, 3], [3, 5], [7, 4], [12, 9]][step / 200];
            let a = Polygon::new(first, Vec3::zeros(), [0.0, 0.3]);
            let center = Vec3::new(0.02 * s, (0.7 * s).sin(), (0.3 * s).cos());
            let b = Polygon::new(second, center, [0.1 * s, 0.37 * s]);
            let found = with_each(|| Measure(&a, &b));
            assert!(found.iter().all(|other| *other == found[0]), "step {step}");
            distances.push(found[0].0);
        }
        assert!(distances.contains(&PolygonDistance::Cross));
        let features = |is_such: fn(&NearestFeatures) -> bool| {
            let is_far = |d: &PolygonDistance| matches!(d, PolygonDistance::Apart(x, f) if *x > 0.1 && is_such(f));
            distances.iter().any(is_far)
        };
        assert!(features(|f| matches!(f, NearestFeatures::Edges(_))));
        assert!(features(|f| matches!(f, NearestFeatures::FirstCorner(_))));
        assert!(features(|f| matches!(f, NearestFeatures::SecondCorner(_))));
    }
}
