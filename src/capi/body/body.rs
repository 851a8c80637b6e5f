//! Bodies.

use std::ffi::{c_char, c_void};
use std::sync::Arc;

use crate::body::Body;
use crate::capi::boundary::guard;
use crate::capi::handle;
use crate::capi::handle::Noun;
use crate::capi::input::{Output, OutputSlice, path, points};
use crate::capi::status::callbacks::cstk_destroy_fn;
use crate::capi::status::status::cstk_status;
use crate::capi::user_data::{CallerData, address};
use crate::error::{Error, ErrorKind};
use crate::primitive::{Feature, FeatureKind, Primitive};

/// A rigid union of convex primitives with its hierarchy. Immutable; threads may share it.
pub struct cstk_body {
    _opaque: [u8; 0],
}

impl Noun for Body {
    type Handle = cstk_body;
    const KIND: u32 = 2;
    const NAME: &'static str = "cstk_body";
}

/// Statistics of a body and of the input it was built from.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_body_statistics {
    /// Convex primitives in the body.
    pub primitive_count: u64,
    /// Mesh faces that were not convex or not planar, and were split into triangles.
    pub faces_split: u64,
    /// Mesh faces without area, which were left out.
    pub faces_dropped: u64,
    /// Nodes of the hierarchy, and the number of its levels.
    pub node_count: u64,
    pub depth: u64,
    /// The axis-aligned bounding box of all vertices, in the frame in which the body was given.
    pub low: [f64; 3],
    pub high: [f64; 3],
    /// Connected pieces of the body: polygons that share vertices, and each polyhedron.
    pub piece_count: u64,
    /// Whether it was declared solid (cstk_body_builder_set_solid).
    pub solid: bool,
    pub reserved_bytes: [u8; 7],
    /// Bodies that it was put together of (cstk_body_builder_add_body).
    pub part_count: u64,
    /// How far what the body stands for may be from it (cstk_body_builder_set_deviation).
    pub deviation: f64,
    pub reserved: [u64; 4],
}

/// A body that is part of a larger one (cstk_body_builder_add_body).
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_body_part {
    /// The tag it was added with.
    pub tag: u64,
    /// Its primitives are `primitive_count` of the larger body's, from this one on, in their own order.
    pub first_primitive: u32,
    pub primitive_count: u32,
    /// The pose it was added at, from its frame to that of the larger body.
    pub pose: [f64; 12],
    pub reserved: [u64; 4],
}

/// Kinds of features of a primitive.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_feature_kind {
    CSTK_FEATURE_VERTEX = 0,
    CSTK_FEATURE_EDGE = 1,
    CSTK_FEATURE_FACE = 2,
    /// The inside of a solid.
    CSTK_FEATURE_INTERIOR = 3,
    /// The surface of a cylinder, cone, ellipsoid or support function; it has no vertices. Rounded primitives use the
    /// features of their core.
    CSTK_FEATURE_SURFACE = 4,
}

impl From<FeatureKind> for cstk_feature_kind {
    fn from(kind: FeatureKind) -> Self {
        match kind {
            FeatureKind::Vertex => Self::CSTK_FEATURE_VERTEX,
            FeatureKind::Edge => Self::CSTK_FEATURE_EDGE,
            FeatureKind::Face => Self::CSTK_FEATURE_FACE,
            FeatureKind::Interior => Self::CSTK_FEATURE_INTERIOR,
            FeatureKind::Surface => Self::CSTK_FEATURE_SURFACE,
        }
    }
}

impl cstk_feature_kind {
    fn decode(value: i32) -> Option<FeatureKind> {
        [
            FeatureKind::Vertex,
            FeatureKind::Edge,
            FeatureKind::Face,
            FeatureKind::Interior,
            FeatureKind::Surface,
        ]
        .into_iter()
        .find(|&kind| Self::from(kind) as i32 == value)
    }
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_retain(body: *mut cstk_body) -> cstk_status {
    guard(|| handle::retain::<Body>(body, "body"))
}

/// Drops a reference. NULL is a no-op. Robots and environments hold references to their bodies.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_release(body: *mut cstk_body) -> cstk_status {
    guard(|| handle::release::<Body>(body, "body"))
}

/// Attaches user data to a body, however it was created (§2.2.3). Witnesses return it: as `r_data` for a link's body, and
/// as `s_data` for the body of a link or of an s-object without its own data. A second call for the same body is
/// CSTK_ERROR_INVALID_ARGUMENT; one with NULL for both attaches nothing and is no call in this sense. `destroy` may be NULL; it is called once, by the thread that drops the last reference to
/// the body, and not if this call fails. Other threads may query the body meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_set_data(
    body: *mut cstk_body,
    data: *mut c_void,
    destroy: cstk_destroy_fn,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let kept = CallerData::new(data, destroy);
        if let Some(data) = kept.as_user_data() {
            body.set_data(data)?;
        }
        kept.take_ownership();
        Ok(())
    })
}

/// Writes the user data attached to a body, or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_data(
    body: *const cstk_body,
    out: *mut *mut c_void,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let out = Output::checked(out, "out")?;
        out.write(address(body.data()));
        Ok(())
    })
}

/// Writes counts and extents.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_statistics(
    body: *const cstk_body,
    out: *mut cstk_body_statistics,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let out = Output::checked(out, "out")?;
        let s = body.statistics();
        out.write(cstk_body_statistics {
            primitive_count: s.primitives,
            faces_split: s.faces_split,
            faces_dropped: s.faces_dropped,
            node_count: s.nodes,
            depth: s.depth,
            low: s.low,
            high: s.high,
            piece_count: body.piece_count() as u64,
            solid: s.is_solid,
            reserved_bytes: [0; 7],
            part_count: body.parts().len() as u64,
            deviation: body.stated_deviation(),
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// Writes which part of a body has this number; parts are numbered from 0 as they were added. CSTK_ERROR_NOT_FOUND if there
/// is none. The parts of a part are its own: its primitive `i` is the larger body's `first_primitive + i`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_part(
    body: *const cstk_body,
    part: u32,
    out: *mut cstk_body_part,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let out = Output::checked(out, "out")?;
        let count = body.parts().len();
        let found = body.parts().get(part as usize).ok_or_else(|| {
            let message = format!("part {part} does not exist; the body has {count}");
            Error::new(ErrorKind::NotFound, message)
        })?;
        out.write(cstk_body_part {
            tag: found.tag,
            first_primitive: found.first,
            primitive_count: found.count,
            pose: found.pose.to_row_major(),
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// The primitive of a body with this index.
pub(crate) fn primitive_of(body: &Body, primitive: u32) -> Result<Primitive<'_>, Error> {
    let count = body.primitives().len();
    body.primitives()
        .try_get(primitive as usize)
        .ok_or_else(|| {
            let message = format!("primitive {primitive} does not exist; the body has {count}");
            Error::new(ErrorKind::NotFound, message)
        })
}

/// Writes the vertices of a feature of a primitive, in the frame in which the body was given. A polygon has one face (0),
/// and its edge i joins vertices i and i + 1; the features of a polyhedron are those of its hull. `kind` is a
/// cstk_feature_kind. At most `max_count` points of three doubles are written to `xyz` (NULL if `max_count` is 0), and
/// their full number to `count`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_feature_vertices(
    body: *const cstk_body,
    primitive: u32,
    kind: i32,
    feature: u32,
    max_count: usize,
    xyz: *mut f64,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let room = OutputSlice::checked(xyz, max_count.saturating_mul(3), "xyz")?;
        let count = Output::checked(count, "count")?;
        let kind = cstk_feature_kind::decode(kind)
            .ok_or_else(|| Error::invalid(format!("kind {kind} is no cstk_feature_kind")))?;
        let found = primitive_of(body, primitive)?;
        let indices = found
            .shape
            .feature_vertices(Feature {
                kind,
                index: feature,
            })
            .ok_or_else(|| {
                Error::new(
                    ErrorKind::NotFound,
                    format!("primitive {primitive} has no {kind:?} {feature}"),
                )
            })?;
        let coordinates: Vec<f64> = indices
            .iter()
            .map(|&i| found.vertices[i as usize] + body.center())
            .flat_map(<[f64; 3]>::from)
            .collect();
        room.write(&coordinates);
        count.write(indices.len());
        Ok(())
    })
}

/// Writes the vertices of all primitives, one primitive after the other, in the frame in which the body was given: those
/// of a polygon as it was added (of a mesh, face after face, less those left out, and triangle after triangle where a face
/// was split), the corners of a polyhedron's hull, the ends of a capsule, the centre of a sphere, the origin of a cylinder,
/// cone or ellipsoid, the points of a cloud. At most `max_count` points of three doubles are written to `xyz` (NULL if
/// `max_count` is 0), and their full number to `count`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_vertices(
    body: *const cstk_body,
    max_count: usize,
    xyz: *mut f64,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let room = OutputSlice::checked(xyz, max_count.saturating_mul(3), "xyz")?;
        let count = Output::checked(count, "count")?;
        let first = body.vertices().take(max_count);
        let coordinates: Vec<f64> = first.flat_map(<[f64; 3]>::from).collect();
        room.write(&coordinates);
        count.write(body.vertex_count());
        Ok(())
    })
}

/// Writes a new body like `body` but with other vertices: `vertex_count` points of three doubles, in the order of
/// cstk_body_get_vertices. Primitives with their tags, features, radii and orientations stay, and so does the grouping of
/// the hierarchy, which both bodies share: only its boxes are fitted anew. That takes a small part of the time of a build
/// (docs/benchmarks.md), and answers are those of a body built of the moved primitives. Queries get slower as far as the
/// vertices leave the neighbours they were grouped with: build anew when the shape has changed altogether. `body` does not
/// change; it may be released. User data are not taken over. Parts keep their numbers, tags and the poses they were added at.
///
/// Each primitive is checked as when it was added; the message names it. CSTK_ERROR_WRONG_SIZE for another number of
/// vertices, CSTK_ERROR_NOT_FINITE, CSTK_ERROR_DEGENERATE, CSTK_ERROR_NOT_PLANAR (for a polyhedron, a face that is no longer
/// planar), CSTK_ERROR_NOT_CONVEX (also for a polyhedron turned inside out). Of a solid, vertices of the boundary that had
/// the same coordinates must have the same again: CSTK_ERROR_NOT_CLOSED; CSTK_ERROR_UNSUPPORTED if faces without area close
/// it that share none of their vertices with others. Bodies with another wrapper than CSTK_WRAPPER_HULL, or with slabs
/// (`aspect_limit`), get wrappers anew, which takes longer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_refit(
    body: *const cstk_body,
    xyz: *const f64,
    vertex_count: usize,
    out: *mut *mut cstk_body,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let vertices = unsafe { points(xyz, vertex_count, "xyz")? };
        out.write(handle::create(Arc::new(body.refit(vertices)?)));
        Ok(())
    })
}

/// Saves the body with its hierarchy to a file. An existing file is replaced only once everything is written. The format is
/// described in docs/body-file.md. CSTK_ERROR_IO if the file cannot be written, CSTK_ERROR_UNSUPPORTED for a body with a
/// support function, which cannot be saved.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_save(
    body: *const cstk_body,
    file: *const c_char,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        // SAFETY: checked for NULL; the caller states that it is terminated.
        let file = unsafe { path(file, "file")? };
        Ok(body.save(file)?)
    })
}

/// Loads a body that cstk_body_save wrote. Nothing is rebuilt, and queries give the same answers as for the saved body, bit
/// for bit. CSTK_ERROR_IO if the file cannot be read, CSTK_ERROR_PARSE if it is truncated, altered or not a body file,
/// CSTK_ERROR_UNSUPPORTED for another version of the format. The checksum detects damage; it does not protect against
/// forgery.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_load(
    file: *const c_char,
    out: *mut *mut cstk_body,
) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states that it is terminated.
        let file = unsafe { path(file, "file")? };
        out.write(handle::create(Arc::new(Body::load(file)?)));
        Ok(())
    })
}
