//! Builders of bodies.

use std::ffi::{c_char, c_void};
use std::sync::Arc;

use crate::body::{Body, BodyBuilder, Mesh};
use crate::capi::body::body::cstk_body;
use crate::capi::boundary::{Failure, guard};
use crate::capi::handle;
use crate::capi::handle::Noun;
use crate::capi::hierarchy::options::cstk_hierarchy_options;
use crate::capi::input::{Output, array, collected, options_or_default, path, points, pose, slice};
use crate::capi::status::callbacks::{cstk_progress_fn, reporter};
use crate::capi::status::status::cstk_status;
use crate::exclusive::Exclusive;
use crate::pose::{Pose, Vec3};

/// Collects the primitives of a body. Serves one call at a time; another call meanwhile is CSTK_ERROR_BUSY.
pub struct cstk_body_builder {
    _opaque: [u8; 0],
}

pub(crate) struct Builder(Exclusive<BodyBuilder>);

impl Noun for Builder {
    type Handle = cstk_body_builder;
    const KIND: u32 = 1;
    const NAME: &'static str = "cstk_body_builder";
}

pub(crate) fn with_builder(
    builder: *mut cstk_body_builder,
    action: impl FnOnce(&mut BodyBuilder) -> Result<(), Failure>,
) -> Result<(), Failure> {
    // A callback may release the caller's last reference meanwhile.
    let builder = handle::share::<Builder>(builder, "builder")?;
    // Additions are made whole or not at all, so a panic leaves the builder sound.
    builder.0.with("the builder", |_| {}, action)
}

/// Creates an empty builder for bodies of dimension 2 (planar worlds: all z are 0, polygons are solid) or 3 (polygons are
/// surfaces, unless cstk_body_builder_set_solid declares them the boundary of a solid). Release it with
/// cstk_body_builder_release.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_create(
    dimension: u32,
    out: *mut *mut cstk_body_builder,
) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        let builder = Builder(Exclusive::new(BodyBuilder::new(dimension)?));
        out.write(handle::create(Arc::new(builder)));
        Ok(())
    })
}

/// Adds a reference. CSTK_ERROR_WRONG_HANDLE if it is no builder.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_retain(builder: *mut cstk_body_builder) -> cstk_status {
    guard(|| handle::retain::<Builder>(builder, "builder"))
}

/// Drops a reference; the last one frees the builder. NULL is a no-op.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_release(builder: *mut cstk_body_builder) -> cstk_status {
    guard(|| handle::release::<Builder>(builder, "builder"))
}

/// Adds a convex planar polygon: `point_count` vertices of three doubles in cyclic order, clockwise or counter-clockwise.
/// In 3-D it is a surface, in the plane it is solid. `tag` is any number of yours; witnesses return it.
///
/// CSTK_ERROR_DEGENERATE, CSTK_ERROR_NOT_CONVEX or CSTK_ERROR_NOT_PLANAR, with a message that names the vertex. Vertices
/// may leave the plane by 1e-12 of the polygon's diameter. cstk_body_builder_add_mesh splits other polygons.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_polygon(
    builder: *mut cstk_body_builder,
    xyz: *const f64,
    point_count: usize,
    tag: u64,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL; the caller states the length.
            let vertices = unsafe { points(xyz, point_count, "xyz")? };
            let index = builder.len();
            Ok(builder
                .add_polygon(vertices, tag)
                .map_err(|e| e.within(format_args!("polygon (primitive {index})")))?)
        })
    })
}

/// Adds the convex hull of `point_count` points of three doubles: a solid, or a point, a segment or a flat polygon if the
/// points span no more. Points inside the hull are ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_polyhedron(
    builder: *mut cstk_body_builder,
    xyz: *const f64,
    point_count: usize,
    tag: u64,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL; the caller states the length.
            let vertices = unsafe { points(xyz, point_count, "xyz")? };
            let index = builder.len();
            Ok(builder
                .add_polyhedron(vertices, tag)
                .map_err(|e| e.within(format_args!("polyhedron (primitive {index})")))?)
        })
    })
}

/// Adds the faces of a mesh as polygons. `vertices` holds `vertex_count` vertices of three doubles. Face f has
/// `face_sizes[f]` vertices; `face_sizes` has `face_count` entries, or is NULL for triangles. `indices` holds the vertex
/// indices of all faces, face after face, `index_count` in all. Faces are tagged with their index in this call; triangles
/// of a split face keep its tag.
///
/// The mesh is scaled along its own x, y and z by the three factors of `scale` (NULL for 1), then moved by `pose` (NULL for
/// the identity). Negative factors mirror; the faces of a mirrored mesh are reversed, so that they still face outwards.
/// CSTK_ERROR_INVALID_ARGUMENT for a factor of magnitude below 1e-50 or above 1e50.
///
/// Faces that are not convex or not planar are split into triangles; faces without area are left out and counted (see
/// cstk_body_get_statistics). CSTK_ERROR_NOT_FOUND for an index beyond the vertices, CSTK_ERROR_WRONG_SIZE for counts that
/// do not match, CSTK_ERROR_NOT_CONVEX for an outline that crosses itself. The message names the face, and nothing is
/// added.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_mesh(
    builder: *mut cstk_body_builder,
    vertices: *const f64,
    vertex_count: usize,
    face_sizes: *const u32,
    face_count: usize,
    indices: *const u32,
    index_count: usize,
    pose: *const f64,
    scale: *const f64,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL; the caller states the lengths.
            let (vertices, indices) = unsafe {
                (
                    points(vertices, vertex_count, "vertices")?,
                    slice(indices, index_count, "indices")?,
                )
            };
            let face_sizes = if face_sizes.is_null() {
                // One face more than the indices suffice for is enough to name the face that lacks them.
                let faces = face_count.min(index_count / 3 + 1);
                collected((0..faces).map(|_| 3), "face_sizes")?
            } else {
                // SAFETY: as above.
                let sizes = unsafe { slice(face_sizes, face_count, "face_sizes")? };
                collected(sizes.iter().copied(), "face_sizes")?
            };
            let mesh = Mesh {
                vertices: collected(vertices.iter().copied(), "vertices")?,
                face_sizes,
                indices: collected(indices.iter().copied(), "indices")?,
            };
            // SAFETY: the header states the lengths.
            let (pose, scale) = unsafe { (pose_or_identity(pose)?, scale_or_one(scale)?) };
            Ok(builder.add_mesh(&mesh.placed(&pose, &scale)?)?)
        })
    })
}

unsafe fn pose_or_identity(values: *const f64) -> Result<Pose, Failure> {
    if values.is_null() {
        return Ok(Pose::identity());
    }
    // SAFETY: as the caller states.
    unsafe { pose(values, "pose") }
}

/// Three factors.
unsafe fn scale_or_one(values: *const f64) -> Result<Vec3, Failure> {
    if values.is_null() {
        return Ok(Vec3::repeat(1.0));
    }
    // SAFETY: as the caller states.
    Ok(Vec3::from(*unsafe { array::<3>(values, "scale")? }))
}

/// Adds the mesh in a file as cstk_body_builder_add_mesh does, scaled by `scale` and moved by `pose`. The name must end in
/// .obj, .stl (ASCII or binary), .ply (the faces of a PLY file of any encoding) or .dae (COLLADA; scaled to metres by the
/// file's unit, `up_axis` not applied, as in the ROS tools; faces that a node mirrors are reversed). CSTK_ERROR_IO if the file cannot
/// be read, CSTK_ERROR_PARSE if it is damaged or truncated, CSTK_ERROR_UNSUPPORTED for another ending.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_mesh_file(
    builder: *mut cstk_body_builder,
    file: *const c_char,
    pose: *const f64,
    scale: *const f64,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL; the caller states that it is terminated, and the header the lengths.
            let (file, pose, scale) = unsafe {
                (
                    path(file, "file")?,
                    pose_or_identity(pose)?,
                    scale_or_one(scale)?,
                )
            };
            Ok(builder.add_mesh_file(file, &pose, &scale)?)
        })
    })
}

/// Adds the point cloud in a file as cstk_body_builder_add_points does: balls of `radius` around its points, scaled by `scale`
/// and moved by `pose` as a mesh is. The name must end in .pcd (the Point Cloud Library's files: ascii, binary and
/// binary_compressed) or .ply (the vertices of a PLY file: ascii, binary little or big endian). The viewpoint of a .pcd file
/// is not applied. Its points with a coordinate that is NaN were not measured, and are left out: `left_out` receives their
/// number, or is NULL. The others are tagged with their indices among those added.
///
/// CSTK_ERROR_IO if the file cannot be read; CSTK_ERROR_PARSE if it is damaged or truncated; CSTK_ERROR_NOT_FINITE for an
/// infinite coordinate, in a .ply file also for NaN; CSTK_ERROR_EMPTY without points; CSTK_ERROR_UNSUPPORTED for another
/// ending, above 1 GiB (also unpacked) or above 2^26 points. The message names the line or the point, and nothing is added.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_cloud_file(
    builder: *mut cstk_body_builder,
    file: *const c_char,
    pose: *const f64,
    scale: *const f64,
    radius: f64,
    left_out: *mut u64,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let left_out = Output::optional(left_out, "left_out")?;
            // SAFETY: checked for NULL; the caller states that it is terminated, and the header the lengths.
            let (file, pose, scale) = unsafe {
                (
                    path(file, "file")?,
                    pose_or_identity(pose)?,
                    scale_or_one(scale)?,
                )
            };
            left_out.write(builder.add_cloud_file(file, &pose, &scale, radius)?);
            Ok(())
        })
    })
}

/// Adds a built body as a part, at `pose` (NULL for the identity; 12 doubles, from the part's frame to the builder's). The
/// same body may be added any number of times; the builder keeps a reference to it until the builder is released.
///
/// The primitives are copied to their place, in their order; their tags, features and feature numbers stay. `tag` is that of
/// the part: witnesses give the number of the part (`r_part`, `s_part`), and cstk_body_get_part its tag, its pose and its
/// first primitive. Parts are numbered from 0 in the order in which they are added; those of a part stay its own.
///
/// The part's hierarchy is taken over, not built again: cstk_body_build groups only the parts and what was added by itself,
/// and moves the parts' boxes to their places. (Trees that would get deeper than 56 levels, as of parts nested one in the
/// other, are grouped anew.) `aspect_limit` does not cut what is added beside parts. Answers are those of the same
/// primitives added one by one, but for the last digits of their vertices, which each motion rounds. A part that was built as a
/// solid stays one, whatever cstk_body_builder_set_solid says of the faces added by themselves; the body is then the union
/// of its solids.
///
/// The primitives are copied because nodes and primitives are stored in the frame of their body: a query would otherwise
/// have to change frames within its innermost loop. Where one body stands in many places and memory matters, add it to an
/// environment as many objects instead: these share it.
///
/// CSTK_ERROR_INVALID_ARGUMENT for a body of another dimension than the builder's, a pose that leaves the plane of a planar
/// builder, or coordinates beyond 1e50 after the motion.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_body(
    builder: *mut cstk_body_builder,
    body: *const cstk_body,
    pose: *const f64,
    tag: u64,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let body = handle::share::<Body>(body, "body")?;
            // SAFETY: the header states the length.
            let pose = unsafe { pose_or_identity(pose)? };
            Ok(builder.add_body(&body, &pose, tag)?)
        })
    })
}

/// Declares that all polygons and mesh faces together are the closed boundary of a solid (true), or surfaces (false, the
/// default). The inside of a solid counts: a body wholly inside it meets it, at distance 0. Polyhedra (flat ones too) are
/// not part of the boundary: they are solid by themselves. In the plane polygons are always solid, so this changes nothing.
///
/// cstk_body_build checks that the boundary of everything added by then is closed. Edges join where their ends have the
/// same coordinates, to the last bit; along each edge as many faces must run one way as the other. Faces without area,
/// which are otherwise left out, count where others need them to join. Where exactly two faces share an edge and disagree,
/// faces are reversed; of each group of faces connected in this way, the orientation that covers the larger area is kept. A
/// point is inside where the boundary's winding number is not 0. Hence shells with the same orientation may overlap; a
/// cavity is a shell with the opposite orientation of the shell around it; and a boundary that faces inwards everywhere
/// bounds the same solid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_set_solid(
    builder: *mut cstk_body_builder,
    solid: bool,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            builder.set_solid(solid);
            Ok(())
        })
    })
}

/// States that the body stands for something else, such as a curved surface that its polygons approximate: no point of either is farther
/// than `deviation` from the other (their Hausdorff distance), where the inside of a solid counts. From 0, the default, to 1e50, in your
/// unit; for all primitives of the builder, those added later too. A body made of others (cstk_body_builder_add_body) has the largest
/// deviation of theirs and its own; cstk_body_refit and files keep it, `deviation` of cstk_body_statistics tells it.
///
/// Answers are then about what the bodies stand for. Deviations of both bodies add up and act as a margin does (cstk_induced_options):
/// they are subtracted from every distance, so that lower bounds, classes, thresholds, motions, regions, slides, maps and certificates
/// say "apart" and "free" only if what the bodies stand for is. The upper bound of a distance is greater by twice their sum: the true
/// distance is from `lower` to `upper`. Points, normals, features and gradients are those of the bodies as they were built, distances and
/// clearances of contacts are less the deviations.
///
/// That what bodies stand for meets is never proved if one states a deviation: CSTK_CLASS_INSIDE means that it may. For a complement,
/// where that would have to be proved, such pairs count as apart: no motion and no region is free of it because of them, and no region is
/// CSTK_REGION_INSIDE. cstk_pair_depth refuses them (CSTK_ERROR_UNSUPPORTED) if they may meet; signed distances of such pairs have a
/// lower bound of -INFINITY unless both bodies are single primitives. cstk_pair_penetration is of the primitives as they are.
/// CSTK_ERROR_NOT_FINITE, or CSTK_ERROR_INVALID_ARGUMENT for a deviation below 0 or too large.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_set_deviation(
    builder: *mut cstk_body_builder,
    deviation: f64,
) -> cstk_status {
    guard(|| with_builder(builder, |builder| Ok(builder.set_deviation(deviation)?)))
}

/// Builds a body from the builder's primitives; the builder is unchanged and can be used further. `options` may be NULL for
/// the defaults; `progress` may be NULL; `user` is passed to it. CSTK_ERROR_EMPTY if nothing was added. For a body declared
/// solid: CSTK_ERROR_NOT_CLOSED if the boundary has open edges, or is one-sided (not orientable), with a message that names
/// edges and primitives; CSTK_ERROR_DEGENERATE if it bounds nothing, because each face has a copy that faces the other way.
///
/// The hierarchy affects the speed of queries, never their answers. Building takes about 5 microseconds a polygon, and 1 to
/// 2 a point for bodies of points only (cstk_body_builder_add_points). Build once and share, or save the body
/// (cstk_body_save).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_build(
    builder: *mut cstk_body_builder,
    options: *const cstk_hierarchy_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    out: *mut *mut cstk_body,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for size and cookie.
            let options = unsafe { options_or_default(options, "options")? };
            let options = options.decode()?;
            let mut report = reporter(progress, user);
            let body = builder.build(&options, &mut report)?;
            out.write(handle::create(Arc::new(body)));
            Ok(())
        })
    })
}
