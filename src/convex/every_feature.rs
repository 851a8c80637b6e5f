//! The closest points of two polytopes by comparing all features that can hold them: where no search has told which do.
//!
//! A pair of points that are no more than u apart lies between two planes across any direction n from B to A: n . x <= n . y + u, so that
//! x is no farther along n than B's farthest point and u, and y no less far than A's nearest point less u. A feature with points there
//! has a vertex there. So with an upper bound u of the distance and a direction along which the sets hardly overlap few features are
//! left, and the answer is that of all.

use super::closest::{Closest, FeatureSet, closest_features};
use super::expanding_polytope::{ExpandingPolytope, Overlap};
use super::placed::{PlacedPrimitive, Precision, gap_of_primitives};
use crate::pose::Vec3;
use crate::primitive::Feature;
use crate::tolerance;

/// What is known of the closest points.
pub struct Known {
    /// The distance is at most this.
    pub attained: f64,
    /// A unit direction from B to A that parts the sets, or along which they overlap by no more than a touch.
    pub direction: Option<Vec3>,
    /// A point of both, but for rounding.
    pub common: Option<Vec3>,
}

/// Scratch memory of the distance computation, reused from pair to pair.
#[derive(Default)]
pub struct DistanceScratch {
    /// The features of A that are compared.
    pub a: FeatureSet,
    /// The features of B.
    pub b: FeatureSet,
    polytope: ExpandingPolytope,
}

/// The closest points of two sets. Of those that clearly overlap none are looked for.
pub fn closest_of_all(
    [a, b]: [&PlacedPrimitive; 2],
    known: &Known,
    pair: &Precision,
    scratch: &mut DistanceScratch,
) -> Closest {
    let DistanceScratch {
        a: of_a,
        b: of_b,
        polytope,
    } = scratch;
    let touch_depth = tolerance::TOUCH_DEPTH * pair.size;
    let overlap = match known.direction {
        Some(_) => None,
        None => polytope.overlap([a, b], pair.size, touch_depth),
    };
    if let (Some(Overlap::Deep(depth)), Some(common)) = (overlap, known.common) {
        return Closest {
            depth,
            ..Closest::meeting_at(common, [Feature::interior(); 2])
        };
    }
    let direction = match overlap {
        Some(Overlap::Hardly(facet)) => Some(facet.normal),
        _ => known.direction.or_else(|| across_flat([a, b])),
    };
    match direction {
        Some(direction) => {
            // Edges that pass a face by this count as crossing it.
            let reach = known.attained + 2.0 * tolerance::INSIDE_DOUBT * pair.size;
            let [low, high] = [a.low_along(&direction), b.high_along(&direction)];
            of_a.set_reaching(a, &-direction, -(high + reach));
            of_b.set_reaching(b, &direction, low - reach);
        }
        None => {
            of_a.set_all(a);
            of_b.set_all(b);
        }
    }
    compared([a, b], pair, [of_a, of_b])
}

/// The closest points of some features. Those that touch or cross are tested first: they say more than a vertex of one set inside
/// the other.
fn compared(
    [a, b]: [&PlacedPrimitive; 2],
    pair: &Precision,
    [of_a, of_b]: [&FeatureSet; 2],
) -> Closest {
    let found = closest_features(a, of_a, b, of_b, true);
    if found.distance <= pair.error {
        return found;
    }
    let inside = |outer: &PlacedPrimitive, inner: &PlacedPrimitive, corners: &FeatureSet| {
        let mut corners = corners.vertices.iter().copied();
        let corner = corners.find(|&i| outer.contains(&inner.vertex(i)))?;
        Some((Feature::vertex(corner), inner.vertex(corner)))
    };
    if let Some((corner, point)) = inside(b, a, of_a) {
        return Closest::meeting_at(point, [corner, Feature::interior()]);
    }
    if let Some((corner, point)) = inside(a, b, of_b) {
        return Closest::meeting_at(point, [Feature::interior(), corner]);
    }
    found
}

/// The normal of a flat set, towards A, along which the sets overlap least.
fn across_flat([a, b]: [&PlacedPrimitive; 2]) -> Option<Vec3> {
    let flat = [a, b].into_iter().filter(|placed| placed.shape.is_flat());
    let normals = flat.flat_map(|placed| [placed.normal(0), -placed.normal(0)]);
    let gap = |normal: &Vec3| gap_of_primitives(a, b, normal);
    normals.max_by(|one, other| gap(one).total_cmp(&gap(other)))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use cstk_scenes::Random;

    use super::*;
    use crate::convex::PlacedBuffer;
    use crate::pose::{Pose, rotation_about};
    use crate::primitive::{Convex, Form, convex_polyhedron};

    fn vector(random: &mut Random) -> Vec3 {
        Vec3::from(random.point(1.0))
    }

    /// A hull of points, a prism or a double pyramid, of more edges than are compared at once.
    fn solid(random: &mut Random, kind: usize) -> Convex {
        let ring = |height: f64| {
            (0..20).map(move |k| {
                let (y, x) = (TAU * f64::from(k) / 20.0).sin_cos();
                Vec3::new(x, y, height)
            })
        };
        let height = 10f64.powf(random.within(-3.0, 0.0));
        let points: Vec<Vec3> = match kind {
            0 => (0..30).map(|_| vector(random).normalize()).collect(),
            1 => ring(height).chain(ring(-height)).collect(),
            _ => ring(0.0)
                .chain([Vec3::z() * height, -Vec3::z() * height])
                .collect(),
        };
        convex_polyhedron(&points).unwrap()
    }

    /// Sets about to touch: what is left of the features gives the answer that all give, to the last digit.
    #[test]
    fn few_features_answer_as_all_do() {
        let random = &mut Random::new(17);
        let (mut kept, mut all, mut meeting) = (0, 0, 0);
        for round in 0..180 {
            let shapes = [solid(random, round % 3), solid(random, round / 3 % 3)];
            let forms = shapes.each_ref().map(Form::of);
            let rotation = match round % 4 {
                0 => Pose::identity().rotation,
                _ => rotation_about(&vector(random).normalize(), random.within(0.0, 6.0)),
            };
            let way = match round % 5 {
                0 => Vec3::z(),
                _ => vector(random).normalize(),
            };
            let at = |length: f64| Pose {
                rotation,
                translation: way * length,
            };
            let a = PlacedPrimitive::at_home(&shapes[0], forms[0].as_ref());
            let size = 4.0;
            let pair = Precision {
                size,
                error: tolerance::DISTANCE_ERROR * size,
                planar: false,
            };
            let mut scratch = DistanceScratch::default();
            let mut measured = |length: f64| {
                let mut buffer = PlacedBuffer::default();
                let pose = at(length);
                let b = buffer.place(&shapes[1], forms[1].as_ref(), &pose);
                scratch.a.set_all(&a);
                scratch.b.set_all(&b);
                compared([&a, &b], &pair, [&scratch.a, &scratch.b])
            };
            let (mut low, mut high) = (0.0, size);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                let meets = measured(middle).distance <= pair.error;
                *(if meets { &mut low } else { &mut high }) = middle;
            }
            let off = match round % 2 {
                0 => 10f64.powf(random.within(-17.0, -5.0)),
                _ => -10f64.powf(random.within(-17.0, -10.0)),
            };
            let want = measured(low + off);
            let mut buffer = PlacedBuffer::default();
            let pose = at(low + off);
            let b = buffer.place(&shapes[1], forms[1].as_ref(), &pose);
            let separating = (want.points[0] - want.points[1]).try_normalize(1e-8);
            for direction in [None, separating] {
                let known = Known {
                    attained: want.distance,
                    direction,
                    common: None,
                };
                let found = closest_of_all([&a, &b], &known, &pair, &mut scratch);
                assert_eq!(found.points, want.points, "{round}");
                assert_eq!(found.features, want.features, "{round}");
                kept += scratch.a.edges.len() * scratch.b.edges.len();
                all += a.shape.edges.len() * b.shape.edges.len();
            }
            meeting += usize::from(want.distance <= pair.error);
        }
        assert!((30..150).contains(&meeting), "{meeting} of 180 meet");
        assert!(8 * kept < all, "{kept} of {all} pairs of edges");
    }
}
