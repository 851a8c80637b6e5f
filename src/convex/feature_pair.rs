//! Two features that define a normal by themselves: a corner and a face, or two edges that cross. Where sets touch at such features, that
//! normal proves it, and their own points are the contact: closest points that coincide tell neither.

use super::closest::Closest;
use super::placed::{PlacedPrimitive, Precision, gaps_along};
use super::segment::{Segment, closest_parameters};
use crate::pose::Vec3;
use crate::primitive::{Feature, FeatureKind};
use crate::tolerance;

/// The normal that two features define by themselves, up to sign: that of a face, or the common perpendicular of two edges. Exact however
/// close the points are.
#[inline(always)]
pub fn feature_normal(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    features: [Feature; 2],
) -> Option<Vec3> {
    use FeatureKind::{Edge, Face, Vertex};
    let [on_a, on_b] = features;
    match (on_a.kind, on_b.kind) {
        (Vertex, Face) => Some(b.normal(on_b.index as usize)),
        (Face, Vertex) => Some(a.normal(on_a.index as usize)),
        (Edge, Edge) => {
            let along = |placed: &PlacedPrimitive, edge: u32| {
                let (p, q) = placed.edge_ends(placed.shape.edges[edge as usize]);
                (q - p).normalize()
            };
            let cross = along(a, on_a.index).cross(&along(b, on_b.index));
            (cross.norm() > tolerance::PARALLEL_EDGES).then(|| cross.normalize())
        }
        _ => None,
    }
}

/// A vector without its component along a feature, if that is an edge.
#[inline(always)]
pub fn across(placed: &PlacedPrimitive, feature: Feature, vector: Vec3) -> Vec3 {
    if feature.kind != FeatureKind::Edge {
        return vector;
    }
    let (p, q) = placed.edge_ends(placed.shape.edges[feature.index as usize]);
    let along = (q - p).normalize();
    vector - along * along.dot(&vector)
}

/// The points of such features that are each other's feet: a corner and its foot inside a face, or the crossing of two edges between
/// their ends.
#[inline(always)]
pub fn feet_of_features(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    features: [Feature; 2],
) -> Option<[Vec3; 2]> {
    use FeatureKind::{Edge, Face, Vertex};
    let [on_a, on_b] = features;
    match (on_a.kind, on_b.kind) {
        (Vertex, Face) => {
            let corner = a.vertex(on_a.index);
            Some([corner, foot_in(b, on_b, &corner)?])
        }
        (Face, Vertex) => {
            let corner = b.vertex(on_b.index);
            Some([foot_in(a, on_a, &corner)?, corner])
        }
        (Edge, Edge) => {
            let segment = |placed: &PlacedPrimitive, edge: u32| {
                Segment::new(placed.edge_ends(placed.shape.edges[edge as usize]))
            };
            let (along_a, along_b) = (segment(a, on_a.index), segment(b, on_b.index));
            let (s, t) = closest_parameters(&along_a, &along_b);
            let is_between = |t: f64| t > 0.0 && t < 1.0;
            (is_between(s) && is_between(t)).then(|| [along_a.at(s), along_b.at(t)])
        }
        _ => None,
    }
}

/// The foot of a point on a face, if it is inside the face.
pub fn foot_in(placed: &PlacedPrimitive, face: Feature, point: &Vec3) -> Option<Vec3> {
    let face = face.index as usize;
    let (height, is_over) = placed.over_face(face, point);
    is_over.then(|| point - placed.normal(face) * height)
}

/// Two sets that touch at such features, or overlap there by no more than [`tolerance::JUST_INSIDE`] L.
pub struct FeatureTouch {
    /// Each other's feet.
    pub points: [Vec3; 2],
    /// The unit normal from B to A, along which no other points of the sets are nearer or deeper.
    pub normal: Vec3,
    /// What the points are apart along it; negative where the sets overlap.
    pub height: f64,
    /// What the sets overlap by along it and against it, together.
    width: f64,
}

impl FeatureTouch {
    /// `None` where the features' normal does not prove that no others are deeper.
    #[inline(never)]
    pub fn at(
        a: &PlacedPrimitive,
        b: &PlacedPrimitive,
        features: [Feature; 2],
        pair: &Precision,
    ) -> Option<Self> {
        let along = feature_normal(a, b, features)?;
        let points = feet_of_features(a, b, features)?;
        let [(gap, normal), (other, _)] = gaps_along(a, b, &along);
        let height = normal.dot(&(points[0] - points[1]));
        let is_proved = height - gap <= tolerance::CERTIFIED_GAP * pair.size;
        (is_proved && gap >= -tolerance::JUST_INSIDE * pair.size).then_some(Self {
            points,
            normal,
            height,
            width: -(gap + other),
        })
    }

    /// Whether no other direction parts the sets by a shorter move, and this one is told from its opposite.
    ///
    /// The features make a facet of the difference. Let 0 be d behind its plane and m the distance of 0's foot there from the facet's
    /// sides. Another facet's plane, at an angle f to it, has the disc of radius m around the foot before it: the foot is m sin f from
    /// it at least, and 0 is m sin f + d cos f. That is d or more where m >= d tan(f / 2): for all f up to a right angle if m >= d.
    /// Beyond that the plane is on the difference's other side, which is w away along the normal at some place, and less than D = 8 L
    /// aside. Where the plane rises by no more than w / 2 on that way, the foot is .4 w from it; else sin f is w / (3 D) at least. Both
    /// keep the foot 2 d away, and 0 thus d, if min(m, w) w >= 6 d D.
    pub fn is_least(
        &self,
        a: &PlacedPrimitive,
        b: &PlacedPrimitive,
        features: [Feature; 2],
        size: f64,
    ) -> bool {
        let depth = -self.height;
        if self.width <= tolerance::GAP_TIE * size {
            return false;
        }
        if depth <= 0.0 {
            return true;
        }
        let margin = margin_of_feet(a, b, features, &self.points);
        margin >= depth && margin.min(self.width) * self.width >= 48.0 * depth * size
    }

    /// The closest points; `None` where the sets overlap, and these features are not proved to be those of the shortest way out, or no point
    /// of both sets is known. `common` is one, or none.
    pub fn closest(
        &self,
        [a, b]: [&PlacedPrimitive; 2],
        features: [Feature; 2],
        common: Option<Vec3>,
        pair: &Precision,
    ) -> Option<Closest> {
        if self.height >= -pair.error {
            return Some(Closest::between(self.points, features));
        }
        if !self.is_least(a, b, features, pair.size) {
            return None;
        }
        let common = common.or_else(|| {
            // A corner below a face is mostly in both sets; of edges that have passed each other, what is between them.
            let between = match features.map(|feature| feature.kind) {
                [FeatureKind::Vertex, _] => self.points[0],
                [_, FeatureKind::Vertex] => self.points[1],
                _ => 0.5 * (self.points[0] + self.points[1]),
            };
            let is_held = |side: &&PlacedPrimitive| side.holds(&between, pair.error);
            [a, b].iter().all(is_held).then_some(between)
        });
        Some(Closest::meeting_at(common?, features))
    }
}

/// How far the foot of 0 in the features' facet of the difference is from its sides, at least.
fn margin_of_feet(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    features: [Feature; 2],
    points: &[Vec3; 2],
) -> f64 {
    let [on_a, on_b] = features;
    match features.map(|feature| feature.kind) {
        [FeatureKind::Vertex, _] => b.depth_in_face(on_b.index as usize, &points[1]),
        [_, FeatureKind::Vertex] => a.depth_in_face(on_a.index as usize, &points[0]),
        _ => {
            let ends = |placed: &PlacedPrimitive, edge: Feature| {
                placed.edge_ends(placed.shape.edges[edge.index as usize])
            };
            let (ends_a, ends_b) = (ends(a, on_a), ends(b, on_b));
            let left = |(start, end): (Vec3, Vec3), point: &Vec3| {
                (point - start).norm().min((end - point).norm())
            };
            let along = |(start, end): (Vec3, Vec3)| (end - start).normalize();
            let sine = along(ends_a).cross(&along(ends_b)).norm();
            sine * left(ends_a, &points[0]).min(left(ends_b, &points[1]))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pose::Pose;
    use crate::primitive::{Convex, block, convex_polyhedron};

    /// A pyramid whose apex points down and back, and is its lowest corner along x and along z.
    fn pyramid(apex: Vec3) -> Convex {
        let base = [
            [1.0, 0.3, 0.5],
            [1.0, -0.3, 0.5],
            [0.5, 0.3, 1.0],
            [0.5, -0.3, 1.0],
        ];
        let mut corners = vec![apex];
        corners.extend(base.map(|arm| apex + Vec3::from(arm)));
        convex_polyhedron(&corners).unwrap()
    }

    /// What the cube of half length 1 touches at its upper face with this corner of a pyramid, and whether that is the shortest way out.
    fn touch(apex: Vec3, corner: Vec3) -> Option<bool> {
        let shapes = [
            pyramid(apex),
            block(&Pose::identity(), &Vec3::repeat(1.0)).unwrap(),
        ];
        let [a, b] = shapes
            .each_ref()
            .map(|shape| PlacedPrimitive::at_home(shape, None));
        let corner = a
            .vertices()
            .iter()
            .position(|at| (at - corner).norm() < 1e-9);
        let upper = b.shape.faces.iter().position(|face| face.normal.z > 0.5);
        let features = [
            Feature::vertex(corner.unwrap() as u32),
            Feature::face(upper.unwrap() as u32),
        ];
        let pair = Precision {
            size: 2.0,
            error: tolerance::DISTANCE_ERROR * 2.0,
            planar: false,
        };
        let found = FeatureTouch::at(&a, &b, features, &pair)?;
        assert!((found.height - (apex.z - 1.0)).abs() < 1e-15 && found.normal == Vec3::z());
        Some(found.is_least(&a, &b, features, pair.size))
    }

    #[test]
    fn the_nearest_facet_is_told_by_where_its_foot_is() {
        let depth = 1e-11;
        let inside = Vec3::new(0.4, 0.0, 1.0 - depth);
        assert_eq!(touch(inside, inside), Some(true));
        assert_eq!(
            touch(Vec3::new(0.4, 0.0, 1.0), Vec3::new(0.4, 0.0, 1.0)),
            Some(true)
        );
        // Out along x is a third as far.
        let at_edge = Vec3::new(1.0 - depth / 3.0, 0.0, 1.0 - depth);
        assert_eq!(touch(at_edge, at_edge), Some(false));
        // Beside the face, deeper than just inside, and another corner than the lowest.
        let beside = Vec3::new(1.1, 0.0, 1.0 - depth);
        assert_eq!(touch(beside, beside), None);
        let deep = Vec3::new(0.4, 0.0, 1.0 - 1e-5);
        assert_eq!(touch(deep, deep), None);
        let apex = Vec3::new(-0.5, 0.0, 1.0 - depth);
        assert_eq!(touch(apex, apex + Vec3::new(1.0, 0.3, 0.5)), None);
    }
}
