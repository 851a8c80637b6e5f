//! The closest points of two primitives in closed form, by enumeration of feature pairs.
//!
//! Every candidate is a pair of points on the two primitives, so the minimum is an upper bound in spite of rounding. It is the
//! distance if the enumerated features include those that hold the closest points.

use super::placed::PlacedPrimitive;
use crate::pose::Vec3;
use crate::primitive::Feature;

/// A pair of closest points and the features that hold them. Where the sets meet, the distance is 0 and both points are the
/// same point of the intersection.
#[derive(Clone, Copy, Debug)]
pub struct Closest {
    pub distance: f64,
    pub points: [Vec3; 2],
    pub features: [Feature; 2],
    /// How far the distance may exceed the true one, beyond the pair's error. Above 0 only for smooth sets whose bounds did not
    /// converge.
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
        if let Some((point, edge, face)) = crossing(a, features_a, b, features_b) {
            return Closest::meeting_at(point, [Feature::edge(edge), Feature::face(face)]);
        }
        if let Some((point, edge, face)) = crossing(b, features_b, a, features_a) {
            return Closest::meeting_at(point, [Feature::face(face), Feature::edge(edge)]);
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

/// The first edge of A that passes through a face of B: the point, the edge and the face.
fn crossing(
    a: &PlacedPrimitive,
    features_a: &FeatureSet,
    b: &PlacedPrimitive,
    features_b: &FeatureSet,
) -> Option<(Vec3, u32, u32)> {
    for &f in &features_b.faces {
        let origin = b.vertex(b.shape.faces[f as usize].vertices[0]);
        let normal = b.normal(f as usize);
        for &e in &features_a.edges {
            let (p, q) = a.edge_ends(a.shape.edges[e as usize]);
            let (hp, hq) = (normal.dot(&(p - origin)), normal.dot(&(q - origin)));
            if (hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0) {
                let point = p + (q - p) * (hp / (hp - hq));
                if b.over_face(f as usize, &point).1 {
                    return Some((point, e, f));
                }
            }
        }
    }
    None
}

/// A segment with its direction.
pub struct Segment {
    start: Vec3,
    end: Vec3,
    along: Vec3,
    square: f64,
}

impl Segment {
    pub fn new((start, end): (Vec3, Vec3)) -> Self {
        let along = end - start;
        Self {
            start,
            end,
            along,
            square: along.norm_squared(),
        }
    }

    /// A segment of length 0.
    pub fn point(at: Vec3) -> Self {
        Self {
            start: at,
            end: at,
            along: Vec3::zeros(),
            square: 0.0,
        }
    }

    #[inline(always)]
    pub fn ends(&self) -> [Vec3; 2] {
        [self.start, self.end]
    }

    /// From the start to the end.
    #[inline(always)]
    pub fn along(&self) -> &Vec3 {
        &self.along
    }

    #[inline(always)]
    pub fn at(&self, parameter: f64) -> Vec3 {
        if parameter >= 1.0 {
            self.end
        } else {
            self.start + self.along * parameter
        }
    }

    pub fn nearest_parameter(&self, point: &Vec3) -> f64 {
        if self.square > 0.0 {
            (self.along.dot(&(point - self.start)) / self.square).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}

/// Parameters of the closest points of two segments.
///
/// The lines' parameters are computed from the cross product of the directions. Nearly parallel directions make the parameters
/// inaccurate, but the distance then depends on them as much less: it is fully accurate at any angle. With the usual
/// determinant it would lose half its digits.
#[inline(always)]
pub fn closest_parameters(p: &Segment, q: &Segment) -> (f64, f64) {
    // A segment of length 0 is a point.
    if p.square == 0.0 {
        return (0.0, q.nearest_parameter(&p.start));
    }
    if q.square == 0.0 {
        return (p.nearest_parameter(&q.start), 0.0);
    }
    closest_of_lines(p, q)
}

fn closest_of_lines(p: &Segment, q: &Segment) -> (f64, f64) {
    let cross = p.along.cross(&q.along);
    let square = cross.norm_squared();
    let between = q.start - p.start;
    let mut best = (0.0, 0.0);
    let mut least = f64::INFINITY;
    let mut offer = |s: f64, t: f64| {
        let d = (p.at(s) - q.at(t)).norm_squared();
        if d < least {
            least = d;
            best = (s, t);
        }
    };
    if square > 0.0 {
        let s = between.cross(&q.along).dot(&cross) / square;
        let t = between.cross(&p.along).dot(&cross) / square;
        if s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0 {
            offer(s, t);
            if square > 1e-4 * p.square * q.square {
                return (s, t);
            }
        }
    }
    offer(0.0, q.nearest_parameter(&p.start));
    offer(1.0, q.nearest_parameter(&p.end));
    offer(p.nearest_parameter(&q.start), 0.0);
    offer(p.nearest_parameter(&q.end), 1.0);
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearly_parallel_segments_keep_their_digits() {
        // Lines that cross in projection at their middles, 1e-3 apart, at angles down to 1e-12.
        for angle in [1e-1, 1e-4, 1e-8, 1e-12] {
            let p = Segment::new((Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0)));
            let q = Segment::new((Vec3::new(-1.0, -angle, 1e-3), Vec3::new(1.0, angle, 1e-3)));
            let (s, t) = closest_parameters(&p, &q);
            assert!(((p.at(s) - q.at(t)).norm() - 1e-3).abs() < 1e-17, "{angle}");
        }
    }
}
