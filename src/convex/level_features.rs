//! Closest points in the middle of parallel features, a face and a face or an edge, or two edges: moved along them to an end of what the two
//! have in common, a corner over a face or an edge or two edges that cross. There the features have a contact mode (§4.4).

use super::closest::Closest;
use super::placed::PlacedPrimitive;
use super::segment::{Segment, closest_parameters};
use crate::pose::Vec3;
use crate::primitive::{Feature, FeatureKind};
use crate::tolerance;

/// A side that a way across a face leaves by less than this, as the sine of their angle, is parallel to it: what is then beyond the side is
/// within the rounding of the points.
const PARALLEL_SIDE: f64 = 8.0 * tolerance::EPSILON;

/// The closest points at such an end; the given ones where their features have an end alone, `None` where these have no end in common.
pub fn at_end(sides: [&PlacedPrimitive; 2], found: Closest, error: f64) -> Option<Closest> {
    use FeatureKind::{Edge, Face};
    let Closest {
        points, features, ..
    } = found;
    match features.map(|feature| feature.kind) {
        [Face, Face] => {
            let along = first_side(sides[0], features[0])?;
            let exits =
                [0, 1].map(|side| exit(sides[side], features[side], &points[0], &along, error));
            let side = usize::from(exits[1]?.0 < exits[0]?.0);
            let (length, edge) = exits[side]?;
            let mut features = features;
            features[side] = edge;
            let point = points[0] + along * length;
            along_edge(sides, features, side, &point, error)
        }
        [Edge, Face] => along_edge(sides, features, 0, &points[0], error),
        [Face, Edge] => along_edge(sides, features, 1, &points[1], error),
        [Edge, Edge] => Some(end_of_parallel(sides, features).unwrap_or(found)),
        _ => Some(found),
    }
}

/// The closest points where the edge on this side ends, or leaves the other side's face; from a point of the edge.
fn along_edge(
    sides: [&PlacedPrimitive; 2],
    mut features: [Feature; 2],
    side: usize,
    point: &Vec3,
    error: f64,
) -> Option<Closest> {
    let other = 1 - side;
    let edge = sides[side].shape.edges[features[side].index as usize];
    let segment = Segment::new(sides[side].edge_ends(edge));
    let [_, end] = segment.ends();
    let along = segment.along().try_normalize(0.0)?;
    let left = along.dot(&(end - point));
    let (length, crossed) = exit(sides[other], features[other], point, &along, error)?;
    let normal = sides[other].normal(features[other].index as usize);
    let mut points = [end; 2];
    if left <= length + error {
        let ring = &sides[other].shape.faces[features[other].index as usize].vertices;
        let height = normal.dot(&(end - sides[other].vertex(ring[0])));
        points[other] = end - normal * height;
        features[side] = Feature::vertex(edge[1]);
    } else {
        let ends = sides[other].shape.edges[crossed.index as usize];
        let across = Segment::new(sides[other].edge_ends(ends));
        let (s, t) = closest_parameters(&segment, &across);
        (points[side], points[other]) = (segment.at(s), across.at(t));
        features[other] = crossed;
    }
    // Of sides of very different lengths rounding may have moved the points aside.
    let way = points[0] - points[1];
    let aside = way - normal * normal.dot(&way);
    (aside.norm() <= error).then(|| Closest::between(points, features))
}

/// The nearest end of one of two edges to the other, where they are parallel. The other is an edge even there where it ends: so the contact's
/// normal is across it.
fn end_of_parallel(sides: [&PlacedPrimitive; 2], features: [Feature; 2]) -> Option<Closest> {
    let edges = [0, 1].map(|side| sides[side].shape.edges[features[side].index as usize]);
    let segments = [0, 1].map(|side| Segment::new(sides[side].edge_ends(edges[side])));
    let [a, b] = segments.each_ref().map(Segment::along);
    let sine_square = a.cross(b).norm_squared();
    if sine_square > tolerance::PARALLEL * tolerance::PARALLEL * a.norm_squared() * b.norm_squared()
    {
        return None;
    }
    let ends = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(side, end)| {
        let other = 1 - side;
        let point = segments[side].ends()[end];
        let place = segments[other].nearest_parameter(&point);
        let (mut points, mut features) = ([point; 2], features);
        points[other] = segments[other].at(place);
        features[side] = Feature::vertex(edges[side][end]);
        Closest::between(points, features)
    });
    ends.into_iter()
        .min_by(|one, other| one.distance.total_cmp(&other.distance))
}

/// The direction of a face's first side.
fn first_side(placed: &PlacedPrimitive, face: Feature) -> Option<Vec3> {
    let ring = &placed.shape.faces[face.index as usize].vertices;
    let (start, end) = placed.edge_ends([ring[0], ring[1]]);
    (end - start).try_normalize(0.0)
}

/// How far a way in a face's plane, from a point over the face, leads to one of its sides, and the edge there; `None` where the point is
/// more than `error` beside the face.
fn exit(
    placed: &PlacedPrimitive,
    face: Feature,
    point: &Vec3,
    way: &Vec3,
    error: f64,
) -> Option<(f64, Feature)> {
    let ring = &placed.shape.faces[face.index as usize].vertices;
    let normal = placed.normal(face.index as usize);
    let mut nearest: Option<(f64, [u32; 2])> = None;
    for i in 0..ring.len() {
        let ends = [ring[i], ring[(i + 1) % ring.len()]];
        let (start, end) = placed.edge_ends(ends);
        let inwards = normal.cross(&(end - start));
        let inside = inwards.dot(&(point - start));
        if inside < -error * inwards.norm() {
            return None;
        }
        let slope = -inwards.dot(way);
        if slope <= PARALLEL_SIDE * inwards.norm() {
            continue;
        }
        let length = (inside / slope).max(0.0);
        if nearest.is_none_or(|(least, _)| length < least) {
            nearest = Some((length, ends));
        }
    }
    let (length, ends) = nearest?;
    let mut edges = placed.shape.edges.iter();
    let edge = edges.position(|edge| edge.iter().all(|end| ends.contains(end)))?;
    Some((length, Feature::edge(edge as u32)))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use cstk_scenes::Random;

    use super::*;
    use crate::convex::placed::gap_of_primitives;
    use crate::convex::{
        ContactMode, DistanceScratch, PlacedBuffer, Precision, PrimitiveDistance, measure, mode_of,
    };
    use crate::gjk::DistanceLimits;
    use crate::pose::{Pose, rotation_about};
    use crate::primitive::{Convex, FeatureKind, Form, convex_polyhedron};

    fn vector(random: &mut Random) -> Vec3 {
        Vec3::from(random.point(1.0))
    }

    /// An upright prism over a polygon, or a segment that lies flat.
    fn prism(random: &mut Random, corners: usize) -> Convex {
        let mut vertices = Vec::new();
        let (radius, half) = (random.within(0.05, 0.5), random.within(0.05, 0.5));
        for k in 0..corners {
            let (y, x) = (TAU * k as f64 / corners as f64).sin_cos();
            vertices.push(Vec3::new(radius * x, radius * y, half));
            vertices.push(Vec3::new(radius * x, radius * y, -half));
        }
        if corners == 2 {
            vertices = vec![vertices[0], vertices[2]];
        }
        convex_polyhedron(&vertices).unwrap()
    }

    /// Prisms on parallel floors: closest points are on features that have a contact mode, in the sets, and proved by their direction.
    #[test]
    fn level_prisms_have_a_contact_mode() {
        let random = &mut Random::new(3);
        let mut modes = [0; 6];
        for round in 0..5000 {
            let shapes = [
                prism(random, [2, 3, 4, 6, 24][round % 5]),
                prism(random, [3, 5, 6, 24][round % 4]),
            ];
            let forms = shapes.each_ref().map(Form::of);
            let common = match round % 3 {
                0 => Pose::identity().rotation,
                _ => rotation_about(&vector(random).normalize(), random.within(0.0, 6.0)),
            };
            let poses = [0, 1].map(|_| Pose {
                rotation: common * rotation_about(&Vec3::z(), random.within(0.0, TAU)),
                translation: vector(random),
            });
            let mut buffers = [PlacedBuffer::default(), PlacedBuffer::default()];
            let [buffer_a, buffer_b] = &mut buffers;
            let placed = [
                buffer_a.place(&shapes[0], forms[0].as_ref(), &poses[0]),
                buffer_b.place(&shapes[1], forms[1].as_ref(), &poses[1]),
            ];
            let precision = Precision {
                size: 2.0,
                error: tolerance::DISTANCE_ERROR * 2.0,
                planar: false,
            };
            let limits = DistanceLimits::EXACT;
            let scratch = &mut DistanceScratch::default();
            let PrimitiveDistance { closest, .. } =
                measure(&placed[0], &placed[1], &precision, limits, scratch).unwrap();
            if closest.distance < 1e-6 {
                continue;
            }
            let mode = mode_of(closest.features).expect("a contact mode");
            modes[mode as usize] += 1;
            if mode == ContactMode::EdgeEdge {
                let [a, b] = [0, 1].map(|side: usize| {
                    let edges = &placed[side].shape.edges;
                    let ends = edges[closest.features[side].index as usize];
                    *Segment::new(placed[side].edge_ends(ends)).along()
                });
                let sine = a.cross(&b).norm() / (a.norm() * b.norm());
                assert!(sine > 1e-9, "parallel edges: {closest:?}");
            }
            let way = closest.points[0] - closest.points[1];
            let gap = gap_of_primitives(&placed[0], &placed[1], &way.normalize());
            // The direction is off by the points' rounding over their distance.
            let rounding = 1e-14 + 4e-15 / closest.distance;
            assert!(
                (gap - closest.distance).abs() < rounding,
                "{gap} {closest:?}"
            );
            for (placed, point) in placed.iter().zip(&closest.points) {
                for _ in 0..50 {
                    let way = vector(random).normalize();
                    let (low, high) = placed.extent_along(&way);
                    let here = way.dot(point);
                    assert!(here > low - 1e-14 && here < high + 1e-14);
                }
            }
            for (side, placed) in placed.iter().enumerate() {
                if closest.features[side].kind == FeatureKind::Vertex {
                    let vertex = placed.vertex(closest.features[side].index);
                    assert!((vertex - closest.points[side]).norm() < 1e-12);
                }
            }
        }
        assert!(modes.iter().all(|count| *count > 100), "{modes:?}");
    }
}
