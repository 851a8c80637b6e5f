//! The closest points of two primitives in closed form, by enumeration of feature pairs.
//!
//! Every candidate is a pair of points on the two primitives, so the minimum is an upper bound in spite of rounding. It is the
//! distance if the enumerated features include those that hold the closest points.

use super::placed::PlacedPrimitive;
use super::segment::{Segment, closest_parameters};
use crate::pose::Vec3;
use crate::primitive::Feature;

/// A pair of closest points and the features that hold them. Where the sets meet, the distance is 0 and both points are the
/// same point of the intersection.
#[derive(Clone, Copy, Debug)]
pub struct Closest {
    pub distance: f64,
    pub points: [Vec3; 2],
    pub features: [Feature; 2],
    /// How far the distance may exceed the true one, beyond the pair's error. Above 0 only where no direction proves it: for smooth sets
    /// whose bounds did not converge, and hulls of which comparing features found it.
    pub doubt: f64,
    /// A lower bound of the depth by which meeting sets overlap.
    pub depth: f64,
}

impl Closest {
    #[inline(always)]
    pub fn between(points: [Vec3; 2], features: [Feature; 2]) -> Self {
        Self {
            distance: (points[0] - points[1]).norm(),
            points,
            features,
            doubt: 0.0,
            depth: 0.0,
        }
    }

    #[inline(always)]
    pub fn meeting_at(point: Vec3, features: [Feature; 2]) -> Self {
        Self {
            distance: 0.0,
            points: [point; 2],
            features,
            doubt: 0.0,
            depth: 0.0,
        }
    }

    /// The same with A and B swapped.
    pub fn swapped(self) -> Self {
        let ([on_a, on_b], [of_a, of_b]) = (self.points, self.features);
        Self {
            points: [on_b, on_a],
            features: [of_b, of_a],
            ..self
        }
    }

    fn offer(&mut self, other: Closest) {
        if other.distance < self.distance {
            *self = other;
        }
    }
}

/// The closest points of two hulls of one vertex or two each.
#[inline(always)]
pub fn closest_segments(a: &PlacedPrimitive, b: &PlacedPrimitive) -> Closest {
    if a.vertex_count() == 1 && b.vertex_count() == 1 {
        let points = [a.vertex(0), b.vertex(0)];
        return Closest::between(points, [Feature::vertex(0); 2]);
    }
    let segment = |placed: &PlacedPrimitive| match placed.shape.edges.first() {
        Some(&ends) => (Segment::new(placed.edge_ends(ends)), ends, Some(0)),
        None => (Segment::point(placed.vertex(0)), [0, 0], None),
    };
    let (on_a, ends_a, edge_a) = segment(a);
    let (on_b, ends_b, edge_b) = segment(b);
    let (s, t) = closest_parameters(&on_a, &on_b);
    Closest::between(
        [on_a.at(s), on_b.at(t)],
        [on_edge(s, ends_a, edge_a), on_edge(t, ends_b, edge_b)],
    )
}

/// Some features of a primitive, by index.
#[derive(Default)]
pub struct FeatureSet {
    pub vertices: Vec<u32>,
    pub edges: Vec<u32>,
    pub faces: Vec<u32>,
    /// Scratch: the vertices' projections on a direction.
    heights: Vec<f64>,
}

impl FeatureSet {
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.edges.clear();
        self.faces.clear();
    }

    pub fn set_all(&mut self, placed: &PlacedPrimitive) {
        self.clear();
        self.vertices.extend(0..placed.vertex_count() as u32);
        self.edges.extend(0..placed.shape.edges.len() as u32);
        self.faces.extend(0..placed.shape.faces.len() as u32);
    }

    /// All edges; a planar primitive's outline.
    pub fn set_outline(&mut self, placed: &PlacedPrimitive) {
        self.clear();
        self.edges.extend(0..placed.shape.edges.len() as u32);
    }

    /// The features with a vertex that is at least as far along `direction` as `height`.
    pub fn set_reaching(&mut self, placed: &PlacedPrimitive, direction: &Vec3, height: f64) {
        self.clear();
        let heights = placed.vertices().iter().map(|v| direction.dot(v));
        let reaching = (0..).zip(heights).filter(|(_, here)| *here >= height);
        self.vertices.extend(reaching.map(|(i, _)| i));
        if let Some(incidence) = placed.incidence() {
            for &i in &self.vertices {
                self.edges.extend(incidence.edges_of(i));
                self.faces.extend(incidence.faces_of(i));
            }
            for features in [&mut self.edges, &mut self.faces] {
                features.sort_unstable();
                features.dedup();
            }
            return;
        }
        let reaches = |i: &u32| self.vertices.binary_search(i).is_ok();
        let edges = placed.shape.edges.iter().zip(0..);
        let edges = edges.filter(|(edge, _)| edge.iter().any(reaches));
        self.edges.extend(edges.map(|(_, i)| i));
        let faces = placed.shape.faces.iter().zip(0..);
        let faces = faces.filter(|(face, _)| face.vertices.iter().any(reaches));
        self.faces.extend(faces.map(|(_, i)| i));
    }

    /// The features whose vertices all lie within `tolerance` of the farthest vertex along `direction`.
    pub fn set_supporting(&mut self, placed: &PlacedPrimitive, direction: &Vec3, tolerance: f64) {
        self.clear();
        self.heights.clear();
        let heights = placed.vertices().iter().map(|v| direction.dot(v));
        self.heights.extend(heights);
        let farthest = self
            .heights
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        let supports = |&i: &u32| self.heights[i as usize] >= farthest - tolerance;
        let vertices = (0..placed.vertex_count() as u32).filter(supports);
        self.vertices.extend(vertices);
        if self.vertices.len() == 1 {
            return;
        }
        let edges = placed.shape.edges.iter().zip(0..);
        let edges = edges.filter(|(edge, _)| edge.iter().all(supports));
        self.edges.extend(edges.map(|(_, i)| i));
        // Faces have three vertices at least.
        if self.vertices.len() > 2 {
            let faces = placed.shape.faces.iter().zip(0..);
            let faces = faces.filter(|(face, _)| face.vertices.iter().all(supports));
            self.faces.extend(faces.map(|(_, i)| i));
        }
    }

    /// The edges as segments with their vertices and index. Without edges, each vertex gives a segment of length 0.
    fn segments<'a>(
        &'a self,
        placed: &'a PlacedPrimitive,
    ) -> impl Iterator<Item = (Segment, [u32; 2], Option<u32>)> + 'a {
        let edges = self.edges.iter().map(|&e| {
            let ends = placed.shape.edges[e as usize];
            (Segment::new(placed.edge_ends(ends)), ends, Some(e))
        });
        let lone = if self.edges.is_empty() {
            &self.vertices[..]
        } else {
            &[]
        };
        edges.chain(
            lone.iter()
                .map(|&i| (Segment::point(placed.vertex(i)), [i, i], None)),
        )
    }
}

/// The least distance over the enumerated features. With `crossings`, edges that pass through faces count as meeting.
pub fn closest_features(
    a: &PlacedPrimitive,
    features_a: &FeatureSet,
    b: &PlacedPrimitive,
    features_b: &FeatureSet,
    crossings: bool,
) -> Closest {
    let mut best = Closest {
        distance: f64::INFINITY,
        points: [Vec3::zeros(); 2],
        features: [Feature::interior(); 2],
        doubt: 0.0,
        depth: 0.0,
    };
    if crossings {
        if let Some(found) = crossing(a, features_a, b, features_b) {
            return found;
        }
        if let Some(found) = crossing(b, features_b, a, features_a) {
            return found.swapped();
        }
    }
    for (segment_a, ends_a, edge_a) in features_a.segments(a) {
        for (segment_b, ends_b, edge_b) in features_b.segments(b) {
            let (s, t) = closest_parameters(&segment_a, &segment_b);
            let points = [segment_a.at(s), segment_b.at(t)];
            if (points[0] - points[1]).norm_squared() < best.distance * best.distance {
                best.offer(Closest::between(
                    points,
                    [on_edge(s, ends_a, edge_a), on_edge(t, ends_b, edge_b)],
                ));
            }
        }
    }
    vertices_over_faces(a, features_a, b, features_b, |closest| best.offer(closest));
    vertices_over_faces(b, features_b, a, features_a, |closest| {
        best.offer(closest.swapped());
    });
    best
}

fn on_edge(parameter: f64, ends: [u32; 2], edge: Option<u32>) -> Feature {
    match edge {
        Some(edge) if parameter > 0.0 && parameter < 1.0 => Feature::edge(edge),
        _ if parameter >= 1.0 => Feature::vertex(ends[1]),
        _ => Feature::vertex(ends[0]),
    }
}

fn vertices_over_faces(
    a: &PlacedPrimitive,
    features_a: &FeatureSet,
    b: &PlacedPrimitive,
    features_b: &FeatureSet,
    mut offer: impl FnMut(Closest),
) {
    for &f in &features_b.faces {
        for &i in &features_a.vertices {
            let point = a.vertex(i);
            let (height, inside) = b.over_face(f as usize, &point);
            // A point below a face of a solid is inside, or nearer to another face.
            if inside && (height >= 0.0 || !b.shape.is_solid()) {
                let foot = point - b.normal(f as usize) * height;
                offer(Closest {
                    distance: height.abs(),
                    points: [point, foot],
                    features: [Feature::vertex(i), Feature::face(f)],
                    doubt: 0.0,
                    depth: 0.0,
                });
            }
        }
    }
}

/// Where the first edge of A that does passes through a face of B.
fn crossing(
    a: &PlacedPrimitive,
    features_a: &FeatureSet,
    b: &PlacedPrimitive,
    features_b: &FeatureSet,
) -> Option<Closest> {
    for &f in &features_b.faces {
        let origin = b.vertex(b.shape.faces[f as usize].vertices[0]);
        let normal = b.normal(f as usize);
        for &e in &features_a.edges {
            let (p, q) = a.edge_ends(a.shape.edges[e as usize]);
            let (hp, hq) = (normal.dot(&(p - origin)), normal.dot(&(q - origin)));
            if (hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0) {
                let point = p + (q - p) * (hp / (hp - hq));
                if b.over_face(f as usize, &point).1 {
                    return Some(Closest {
                        depth: crossing_depth(b, f as usize, &point, &(q - p), [hp, hq]),
                        ..Closest::meeting_at(point, [Feature::edge(e), Feature::face(f)])
                    });
                }
            }
        }
    }
    None
}

/// A lower bound, but for rounding, of the depth by which an edge along `way` overlaps a face that it passes through at `point`; its ends
/// are at `heights`.
///
/// To part the two, one of them moves until 0 is no longer inside the set of the differences of their points. That set is a prism whose
/// caps are at the heights. Its sides hold the edge's direction and pass 0 at the foot's distance from the face's edges, shortened by at
/// most the sine of the angle at which the edge meets the plane.
fn crossing_depth(
    placed: &PlacedPrimitive,
    face: usize,
    point: &Vec3,
    way: &Vec3,
    heights: [f64; 2],
) -> f64 {
    let [hp, hq] = heights.map(f64::abs);
    let sine = (hp + hq) / way.norm();
    hp.min(hq)
        .min(sine * placed.depth_in_face(face, point))
        .max(0.0)
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;
    use crate::primitive::convex_polygon;

    fn vector(random: &mut Random) -> Vec3 {
        Vec3::from(random.point(1.0))
    }

    type Triangle = [Vec3; 3];

    /// Whether an edge of one triangle passes through the other, by the signs of volumes.
    fn cross(a: &Triangle, b: &Triangle) -> bool {
        let volume = |p: &Vec3, q: &Vec3, r: &Vec3, s: &Vec3| (q - p).cross(&(r - p)).dot(&(s - p));
        let passes = |[p, q]: [&Vec3; 2], [x, y, z]: &Triangle| {
            let sides = [(x, y), (y, z), (z, x)].map(|(from, to)| volume(p, q, from, to) > 0.0);
            volume(x, y, z, p) * volume(x, y, z, q) < 0.0
                && sides[1..].iter().all(|s| *s == sides[0])
        };
        let edges = [[0, 1], [1, 2], [2, 0]];
        edges.into_iter().any(|edge| passes(edge.map(|i| &a[i]), b))
            || edges.into_iter().any(|edge| passes(edge.map(|i| &b[i]), a))
    }

    /// Triangles that cross by a depth still do after any shorter move; and some such moves, made a little longer, part them.
    #[test]
    fn crossing_triangles_overlap_by_their_depth() {
        let mut random = Random::new(3);
        let (mut crossings, mut tight) = (0, 0);
        for round in 0..20_000 {
            let triangle = |random: &mut Random| [0; 3].map(|_| vector(random));
            let a = triangle(&mut random);
            let mut b = triangle(&mut random);
            // Half of them nearly part along the edge from the first corner.
            if round % 2 == 0 {
                b[0] = a[0] * 0.3 + a[1] * 0.3 + a[2] * 0.4 + (b[0] - b[1]) * 1e-3;
            }
            let shapes = [a, b].map(|corners| convex_polygon(&corners));
            let [Ok(shape_a), Ok(shape_b)] = &shapes else {
                continue;
            };
            let placed = [shape_a, shape_b].map(|shape| PlacedPrimitive::at_home(shape, None));
            let mut sets = [FeatureSet::default(), FeatureSet::default()];
            sets[0].set_all(&placed[0]);
            sets[1].set_all(&placed[1]);
            let found = closest_features(&placed[0], &sets[0], &placed[1], &sets[1], true);
            assert_eq!(found.distance == 0.0, cross(&a, &b), "{a:?} {b:?}");
            if found.distance > 0.0 {
                continue;
            }
            crossings += 1;
            let normals = placed.each_ref().map(|placed| placed.normal(0));
            let ways = [
                vector(&mut random),
                vector(&mut random),
                normals[0],
                normals[1],
            ];
            for way in ways.into_iter().flat_map(|way| [way, -way]) {
                let way = way.normalize();
                let moved = |depth: f64| b.map(|corner| corner + way * depth);
                assert!(
                    cross(&a, &moved(0.999 * found.depth)),
                    "{found:?} {a:?} {b:?}"
                );
                tight += usize::from(!cross(&a, &moved(1.001 * found.depth)));
            }
        }
        assert!(
            crossings > 2000 && tight > crossings / 4,
            "{crossings} {tight}"
        );
    }
}
