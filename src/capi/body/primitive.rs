//! Describes the primitives of a body.

use crate::body::Body;
use crate::capi::body::body::{cstk_body, primitive_of};
use crate::capi::boundary::guard;
use crate::capi::handle;
use crate::capi::input::Output;
use crate::capi::status::status::cstk_status;
use crate::primitive::PrimitiveKind;

/// Kinds of primitives.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_primitive_kind {
    CSTK_PRIMITIVE_POINT = 0,
    CSTK_PRIMITIVE_SEGMENT = 1,
    CSTK_PRIMITIVE_POLYGON = 2,
    CSTK_PRIMITIVE_POLYHEDRON = 3,
    CSTK_PRIMITIVE_SPHERE = 4,
    CSTK_PRIMITIVE_CAPSULE = 5,
    CSTK_PRIMITIVE_ROUNDED_POLYGON = 6,
    CSTK_PRIMITIVE_ROUNDED_POLYHEDRON = 7,
    CSTK_PRIMITIVE_CYLINDER = 8,
    CSTK_PRIMITIVE_CONE = 9,
    CSTK_PRIMITIVE_ELLIPSOID = 10,
    /// Given by a support function (cstk_body_builder_add_support).
    CSTK_PRIMITIVE_SUPPORT_FUNCTION = 11,
}

impl From<PrimitiveKind> for cstk_primitive_kind {
    fn from(kind: PrimitiveKind) -> Self {
        match kind {
            PrimitiveKind::Point => Self::CSTK_PRIMITIVE_POINT,
            PrimitiveKind::Segment => Self::CSTK_PRIMITIVE_SEGMENT,
            PrimitiveKind::Polygon => Self::CSTK_PRIMITIVE_POLYGON,
            PrimitiveKind::Polyhedron => Self::CSTK_PRIMITIVE_POLYHEDRON,
            PrimitiveKind::Sphere => Self::CSTK_PRIMITIVE_SPHERE,
            PrimitiveKind::Capsule => Self::CSTK_PRIMITIVE_CAPSULE,
            PrimitiveKind::RoundedPolygon => Self::CSTK_PRIMITIVE_ROUNDED_POLYGON,
            PrimitiveKind::RoundedPolyhedron => Self::CSTK_PRIMITIVE_ROUNDED_POLYHEDRON,
            PrimitiveKind::Cylinder => Self::CSTK_PRIMITIVE_CYLINDER,
            PrimitiveKind::Cone => Self::CSTK_PRIMITIVE_CONE,
            PrimitiveKind::Ellipsoid => Self::CSTK_PRIMITIVE_ELLIPSOID,
            PrimitiveKind::SupportFunction => Self::CSTK_PRIMITIVE_SUPPORT_FUNCTION,
        }
    }
}

/// A primitive of a body. A sphere is a point with a radius, a capsule a segment with one: their features are those of this
/// core.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_primitive {
    pub kind: cstk_primitive_kind,
    /// Numbers of features of the primitive, or of its core; 0 for cylinders, cones, ellipsoids and support functions.
    pub vertex_count: u32,
    pub edge_count: u32,
    pub face_count: u32,
    /// The radius around the core of spheres, capsules, rounded polygons and rounded polyhedra; 0 for others.
    pub radius: f64,
    /// The caller's tag; for a mesh face its index, for a point of a cloud the point's index.
    pub tag: u64,
    pub reserved: [u64; 8],
}

/// Describes a primitive of the body. Primitives are numbered from 0 in the order in which they were added; the triangles
/// of a split face have consecutive numbers. cstk_body_get_statistics gives their number, and
/// cstk_body_get_feature_vertices their vertices: CSTK_FEATURE_VERTEX for one, CSTK_FEATURE_INTERIOR for all.
/// CSTK_ERROR_NOT_FOUND for an index beyond the last.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_primitive(
    body: *const cstk_body,
    index: u32,
    out: *mut cstk_primitive,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let out = Output::checked(out, "out")?;
        let primitive = primitive_of(body, index)?.shape;
        let [vertices, edges, faces] = primitive.feature_counts().map(|count| count as u32);
        out.write(cstk_primitive {
            kind: primitive.kind().into(),
            vertex_count: vertices,
            edge_count: edges,
            face_count: faces,
            radius: primitive.radius(),
            tag: body.tag(index),
            reserved: [0; 8],
        });
        Ok(())
    })
}
