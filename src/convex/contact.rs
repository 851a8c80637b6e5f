//! What a contact of two primitives is: two points, a normal, and the mode that follows from the features (§4.4, Fig. 17).

use super::placed::Precision;
use crate::pose::Vec3;
use crate::primitive::{Feature, FeatureKind};

/// The report's contact modes, r-feature first, and one for sets without features.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum ContactMode {
    PointPoint,
    PointEdge,
    EdgePoint,
    PointFace,
    FacePoint,
    EdgeEdge,
    /// The boundary of a pure set: no features.
    PureSet,
}

#[inline(always)]
pub fn mode_of(features: [Feature; 2]) -> Option<ContactMode> {
    use FeatureKind::{Edge, Face, Surface, Vertex};
    let as_point = |kind| if kind == Surface { Vertex } else { kind };
    match (as_point(features[0].kind), as_point(features[1].kind)) {
        (Vertex, Vertex) => Some(ContactMode::PointPoint),
        (Vertex, Edge) => Some(ContactMode::PointEdge),
        (Edge, Vertex) => Some(ContactMode::EdgePoint),
        (Vertex, Face) => Some(ContactMode::PointFace),
        (Face, Vertex) => Some(ContactMode::FacePoint),
        (Edge, Edge) => Some(ContactMode::EdgeEdge),
        _ => None,
    }
}

/// One contact of the r-primitive with the s-primitive: two points and the unit normal from s to r.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    pub points: [Vec3; 2],
    pub normal: Vec3,
    pub distance: f64,
    /// The signed distance: negative where the primitives overlap slightly.
    pub gap: f64,
    pub mode: ContactMode,
    pub features: [Feature; 2],
}

/// Where the sets overlap slightly, the closest points are arbitrary: moves the deepest contact to the front, unless the one at
/// the closest points is as deep.
pub fn deepest_first(found: &mut [Contact], precision: &Precision) {
    let Some(first) = found.first().map(|first| first.gap) else {
        return;
    };
    let is_deeper = |c: &Contact| c.gap < 0.0 && c.gap < first - precision.error;
    if found.iter().any(is_deeper) {
        found.sort_by(|a, b| a.gap.total_cmp(&b.gap));
    }
}
