/**
 * @file
 * cstk.h: the C-Space Toolkit. Generated from the Rust sources; do not edit.
 *
 * At a configuration q of a robot: is q free, in contact, or inside (cstk_classify)? how far from contact and between
 * which features (cstk_distance, cstk_witnesses)? which way is out, in joint space (cstk_gradients)? which step slides
 * along the contact (cstk_slide)? The same for two bodies at two poses: cstk_pair_distance and its companions.
 *
 * CONTENTS. Each section begins with a line "defgroup NAME", an introduction and an example; its types stand before its functions.
 *   @ref status             Versions, statuses, callbacks
 *   @ref pose               Poses
 *   @ref body               Bodies
 *   @ref hierarchy          Hierarchies
 *   @ref robot              Robots
 *   @ref urdf               URDF
 *   @ref srdf               SRDF
 *   @ref space              Spaces
 *   @ref environment        Environments
 *   @ref octree             Octrees
 *   @ref cobject            C-objects
 *   @ref query              Query contexts
 *   @ref at_configuration   Queries at a configuration
 *   @ref pair               Pair queries
 *   @ref object_pairs       Objects against objects
 *   @ref depth              Depths and signed distances
 *   @ref motion             Motions
 *   @ref certificate        Certificates
 *   @ref region             Regions
 *   @ref slide              Slides
 *   @ref batch              Batches
 *   @ref map                Maps
 *   @ref show               Pictures
 *
 * WORDS. Numbers like (§4.4) refer to the report the library succeeds: Xavier and LaFarge, A Configuration Space Toolkit for
 * Automated Spatial Reasoning, SAND97-0366, Sandia National Laboratories 1997. The r-side of an answer is the robot's link
 * (or body a); the s-side is an s-object, that is an obstacle, or a second link (or body b). A C-object is a set in the
 * robot's configuration space, such as all q at which some link meets some obstacle. A primitive is one convex polygon,
 * polyhedron or ready-made shape of a body. The shell, or stand-off, is the distance within which contacts are considered.
 *
 * CALLS. Every call that can fail returns a cstk_status; inputs come first, outputs last, and outputs are written only on
 * CSTK_OK, but for a batch that is cancelled, whose statuses tell which answers are written. The length of an output array stands
 * behind it. After a failure cstk_last_error_message() names the culprit. A failed call has changed nothing. The library never
 * prints, and ends the process in one case only: an allocation that fails (see MEMORY).
 *
 * OWNERSHIP. _create, _build and _snapshot give one reference, _retain adds one, _release drops one; releasing NULL is a
 * no-op. Objects keep alive what they refer to, so parts may be released as soon as the whole is made. A handle that was
 * released for good, or that is of another kind, is answered with CSTK_ERROR_WRONG_HANDLE as far as that can be known; do not
 * rely on it. Bodies, robots, spaces and C-objects never change once made, but for the user data that a body may be given once.
 * Strings and arrays passed in are copied.
 *
 * MEMORY. What a call holds is bounded by what it was given: arrays, files within their stated limits, max_count. Where an array
 * or a file of the caller's sets the size of one allocation, too little memory is answered with CSTK_ERROR_OUT_OF_MEMORY. Any
 * other allocation that fails ends the process (abort), as Rust's standard library has it; it does not unwind. Programs that
 * must survive that limit what they give. docs/robustness.md lists what is promised, each line with its test.
 *
 * THREADS. All objects may be shared by threads. Those that a call changes serve one at a time, and answer CSTK_ERROR_BUSY to
 * another: a cstk_query, of which each thread makes its own, a cstk_batch, a cstk_octree and the builders. After fork() a child
 * makes objects of its own: one of the parent's may be locked by a thread that the child does not have.
 *
 * OPTIONS. Structures with size and cookie are written by their _default function before fields are set; others are
 * refused with CSTK_ERROR_NOT_INITIALISED. The size passed to it is that of the structure itself, as your header has it: so many
 * bytes are written. Options may be NULL for the defaults, but for those that have a field without one: slide_options, the options
 * of cstk_slide_to, and clearance_options.
 *
 * UNITS AND FRAMES. Lengths are in the caller's unit, angles in radians. A pose is 12 doubles, row-major [R | t], from
 * child to parent frame: x_parent = R x_child + t. R may be off orthonormal by 1e-6; the nearest rotation is then used.
 * Matrices of Eigen, FCL or OpenGL are column-major: transpose them, and drop the last row. Points and normals in answers
 * are in the world. Planar worlds use the same structures with z = 0. Coordinates are at most 1e50, and the extent of a
 * polygon or polyhedron at least 1e-50.
 *
 * MEANING. A body is the union of its primitives as closed sets: in space a polygon is a surface and a polyhedron is solid;
 * in the plane a polygon is solid. The distance is the least over all pairs of primitives, 0 when they meet; its error is
 * at most 1e-12 of the largest coordinate of the pair (seen from the middle of one of them); smooth shapes state theirs. Answers do not depend on the
 * queries before them, nor on the number of threads, to the last bit.
 */

#ifndef CSTK_H
#define CSTK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Used before the sections that describe them. */
typedef struct cstk_hierarchy_options cstk_hierarchy_options;
typedef struct cstk_induced_options cstk_induced_options;

/**
 * @defgroup status Versions, statuses, callbacks
 *
 * Calls that can fail return a status, and leave a message that names the culprit. Callbacks report the progress of long
 * calls and release user data. In the examples of the sections below, check() stands for a program's own handling of a
 * status, which may begin like this:
 *
 * @code
     cstk_status status = cstk_query_create(&query);
     if (status != CSTK_OK) {
         fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
     }
 * @endcode
 * @{
 */

/**
 * The version this header belongs to.
 */
#define CSTK_VERSION_MAJOR 0

#define CSTK_VERSION_MINOR 1

#define CSTK_VERSION_PATCH 0

/**
 * The status of a call. Every call that can fail returns one; after any but CSTK_OK, cstk_last_error_message() says which
 * argument, which polygon, which line. A failed call has changed nothing and written no output.
 */
enum cstk_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The call succeeded.
   */
  CSTK_OK = 0,
  /**
   * A pointer that must not be NULL is.
   */
  CSTK_ERROR_NULL_ARGUMENT = 1,
  /**
   * A handle is of another kind, or was released.
   */
  CSTK_ERROR_WRONG_HANDLE = 2,
  /**
   * An options structure was not written by its _default function, or is damaged.
   */
  CSTK_ERROR_NOT_INITIALISED = 3,
  /**
   * An argument is outside its documented range.
   */
  CSTK_ERROR_INVALID_ARGUMENT = 4,
  /**
   * A number is NaN or infinite where a finite one is needed.
   */
  CSTK_ERROR_NOT_FINITE = 5,
  /**
   * An array or structure has the wrong size.
   */
  CSTK_ERROR_WRONG_SIZE = 6,
  /**
   * No item was given where at least one is needed: a body without primitives, a robot without links.
   */
  CSTK_ERROR_EMPTY = 7,
  /**
   * Geometry without extent: a repeated vertex, a polygon without area, an axis of length 0.
   */
  CSTK_ERROR_DEGENERATE = 8,
  /**
   * A polygon that turns inwards, winds more than once, or crosses itself.
   */
  CSTK_ERROR_NOT_CONVEX = 9,
  /**
   * A polygon whose vertices leave its plane, or a planar body that leaves z = 0.
   */
  CSTK_ERROR_NOT_PLANAR = 10,
  /**
   * The 3 x 3 part of a pose is not a rotation.
   */
  CSTK_ERROR_NOT_A_ROTATION = 11,
  /**
   * An id, index or name that does not exist.
   */
  CSTK_ERROR_NOT_FOUND = 12,
  /**
   * Something that the library does not support: an unknown file format, a change to a snapshot.
   */
  CSTK_ERROR_UNSUPPORTED = 13,
  /**
   * The operating system could not read or write a file.
   */
  CSTK_ERROR_IO = 14,
  /**
   * A file's contents cannot be understood; it may be truncated.
   */
  CSTK_ERROR_PARSE = 15,
  /**
   * A result could not be certified.
   */
  CSTK_ERROR_NOT_CONVERGED = 16,
  /**
   * The caller's progress function stopped the call; of an item of a batch: it was not reached.
   */
  CSTK_ERROR_CANCELLED = 17,
  /**
   * The object is in use by another thread, or by the call whose callback makes this one.
   */
  CSTK_ERROR_BUSY = 18,
  /**
   * An internal fault of the library, which was contained; please report it with the message.
   */
  CSTK_ERROR_INTERNAL = 19,
  /**
   * A callback failed; the message names it and what it returned.
   */
  CSTK_ERROR_CALLBACK_FAILED = 20,
  /**
   * A body was declared solid whose surface is not closed; the message names open edges.
   */
  CSTK_ERROR_NOT_CLOSED = 21,
  /**
   * The query needs more work than cstk_query_set_limit allows.
   */
  CSTK_ERROR_LIMIT = 22,
  /**
   * There is not enough memory for the input.
   */
  CSTK_ERROR_OUT_OF_MEMORY = 23,
  /**
   * A certificate does not prove what is asked; the message names the entry.
   */
  CSTK_ERROR_NOT_PROVED = 24,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_status cstk_status;
#else
typedef int32_t cstk_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Releases user data: called once, when nothing refers to them any more. It may call the
 * library; it must not throw.
 */
typedef void (*cstk_destroy_fn)(void *user);

/**
 * Receives the progress of a long call, from 0 to 1. Anything but 0 (CSTK_OK) ends the call with CSTK_ERROR_CANCELLED. It
 * is called on the thread that made the call; it must not throw.
 */
typedef int32_t (*cstk_progress_fn)(double fraction, void *user);


/**
 * Returns the version of the library that is linked, as "major.minor.patch"; static.
 */
const char *cstk_version(void);

/**
 * Returns the name of a status, such as "CSTK_ERROR_NOT_FINITE"; "unknown status" for an unknown number. Never NULL;
 * static.
 */
const char *cstk_status_name(int32_t status);

/**
 * Returns the message of this thread's last failed call; empty if none has failed. Valid until the next failure on this
 * thread. Never NULL; UTF-8.
 */
const char *cstk_last_error_message(void);

/** @} */

/**
 * @defgroup pose Poses
 *
 * Poses are 12 doubles, row-major [R | t]. They are converted from quaternions or from the report's Euler angles (§4.1),
 * whose rates are those of §4.3, and composed.
 *
 * @code
     const double above[7] = {0, 0, 0.5, 0, 0, 0, 1}; // x, y, z, and the quaternion x, y, z, w
     double lifted[12], both[12];
     check(cstk_pose_from_quaternion(above, lifted));
     check(cstk_pose_compose(lifted, pose_a, both));
 * @endcode
 * @{
 */

/**
 * The frame in which an angular velocity is written.
 */
enum cstk_angular_frame
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The inertial frame, as in eq. (33) and everywhere else in this header.
   */
  CSTK_ANGULAR_WORLD = 0,
  /**
   * The rotating body's own, as in eq. (25) to (31).
   */
  CSTK_ANGULAR_BODY = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_angular_frame cstk_angular_frame;
#else
typedef int32_t cstk_angular_frame;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus


/**
 * Converts the report's placement (§4.1, eq. 3-6) to a pose. `xyz_ypr` holds x, y, z and the angles yaw (about Y), pitch
 * (about the new Z) and roll (about the new X) in radians; `pose` receives 12 doubles.
 */
cstk_status cstk_pose_from_euler(const double *xyz_ypr,
                                 double *pose);

/**
 * The inverse of cstk_pose_from_euler (eq. 7). Where cos(pitch) = 0 only yaw + roll or yaw - roll is determined; roll is
 * then 0.
 */
cstk_status cstk_pose_to_euler(const double *pose_12,
                               double *xyz_ypr);

/**
 * Converts a placement as URDF and ROS have it to a pose. `xyz_rpy` holds x, y, z, and roll about the fixed X, then pitch about the
 * fixed Y, then yaw about the fixed Z, in radians; `pose` receives 12 doubles.
 */
cstk_status cstk_pose_from_rpy(const double *xyz_rpy,
                               double *pose);

/**
 * Converts a translation and a unit quaternion to a pose. `xyz_quaternion` holds x, y, z of the translation and x, y, z, w
 * of the quaternion, whose norm must be 1 to within 1e-6; `pose` receives 12 doubles.
 */
cstk_status cstk_pose_from_quaternion(const double *xyz_quaternion,
                                      double *pose);

/**
 * Composes poses: if `a` places frame 1 in frame 0 and `b` places frame 2 in frame 1, `out` places frame 2 in frame 0. All
 * are 12 doubles; `out` may be `a` or `b`.
 */
cstk_status cstk_pose_compose(const double *a,
                              const double *b,
                              double *out);

/**
 * Inverts a pose (eq. 10): if `pose_12` places frame 1 in frame 0, `out` places frame 0 in frame 1. 12 doubles each; both
 * may be the same.
 */
cstk_status cstk_pose_inverse(const double *pose_12,
                              double *out);

/**
 * Transforms a point from the child frame to the parent frame (eq. 8): `out` = R `point` + t. 3 doubles each; both may be
 * the same.
 */
cstk_status cstk_pose_transform_point(const double *pose_12,
                                      const double *point,
                                      double *out);

/**
 * The inverse of cstk_pose_from_quaternion; of the two quaternions of a rotation it writes the one with w >= 0.
 */
cstk_status cstk_pose_to_quaternion(const double *pose_12,
                                    double *xyz_quaternion);

/**
 * Converts yaw, pitch and roll (radians; §4.1, eq. 6) to a rotation matrix of 9 doubles, row-major.
 */
cstk_status cstk_euler_to_rotation(const double *yaw_pitch_roll,
                                   double *rotation);

/**
 * The inverse of cstk_euler_to_rotation (eq. 7). Where cos(pitch) = 0 it chooses roll 0, as cstk_pose_to_euler does.
 */
cstk_status cstk_euler_from_rotation(const double *rotation,
                                     double *yaw_pitch_roll);

/**
 * Writes the matrix of eq. (31), 9 doubles, row-major, which maps the rates of yaw, pitch and roll to an angular velocity.
 * `frame` is a cstk_angular_frame. The report prints the matrix for the body's frame, but uses it with the inertial
 * columns of (33), which only the inertial form fits.
 */
cstk_status cstk_euler_rates(const double *yaw_pitch_roll,
                             int32_t frame,
                             double *matrix);

/**
 * Writes the inverse of the matrix of cstk_euler_rates: maps an angular velocity to the rates of yaw, pitch and roll.
 * CSTK_ERROR_DEGENERATE where cos(pitch) = 0.
 */
cstk_status cstk_euler_rates_inverse(const double *yaw_pitch_roll,
                                     int32_t frame,
                                     double *matrix);

/**
 * Converts a basic Jacobian, as cstk_robot_jacobian writes it (eq. 33), to the Jacobian of x, y, z, yaw, pitch, roll (eq.
 * 22, 23), in place: 6 rows of `nv` doubles. `yaw_pitch_roll` are the link's, see cstk_pose_to_euler.
 * CSTK_ERROR_DEGENERATE where cos(pitch) = 0.
 */
cstk_status cstk_jacobian_to_euler(const double *yaw_pitch_roll,
                                   double *jacobian,
                                   size_t nv);

/**
 * The inverse of cstk_jacobian_to_euler; defined everywhere.
 */
cstk_status cstk_jacobian_from_euler(const double *yaw_pitch_roll, double *jacobian, size_t nv);

/** @} */

/**
 * @defgroup body Bodies
 *
 * A body is a rigid union of convex primitives: polygons, polyhedra, predefined shapes, points. A builder collects them,
 * from arrays or mesh files. A body never changes once built, and serves any number of links, obstacles and threads.
 *
 * @code
     const double half_extents[3] = {0.2, 0.1, 0.3};
     check(cstk_body_builder_create(3, &body_builder));
     check(cstk_body_builder_add_box(body_builder, pose_a, half_extents, 0));
     check(cstk_body_build(body_builder, NULL, NULL, NULL, &body));
     check(cstk_body_builder_release(body_builder));
 * @endcode
 * @{
 */

/**
 * Kinds of primitives.
 */
enum cstk_primitive_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
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
  /**
   * Given by a support function (cstk_body_builder_add_support).
   */
  CSTK_PRIMITIVE_SUPPORT_FUNCTION = 11,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_primitive_kind cstk_primitive_kind;
#else
typedef int32_t cstk_primitive_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Kinds of features of a primitive.
 */
enum cstk_feature_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  CSTK_FEATURE_VERTEX = 0,
  CSTK_FEATURE_EDGE = 1,
  CSTK_FEATURE_FACE = 2,
  /**
   * The inside of a solid.
   */
  CSTK_FEATURE_INTERIOR = 3,
  /**
   * The surface of a cylinder, cone, ellipsoid or support function; it has no vertices. Rounded primitives use the
   * features of their core.
   */
  CSTK_FEATURE_SURFACE = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_feature_kind cstk_feature_kind;
#else
typedef int32_t cstk_feature_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * A rigid union of convex primitives with its hierarchy. Immutable; threads may share it.
 */
typedef struct cstk_body cstk_body;

/**
 * Collects the primitives of a body. Serves one call at a time; another call meanwhile is CSTK_ERROR_BUSY.
 */
typedef struct cstk_body_builder cstk_body_builder;

/**
 * Writes to `point` (three doubles) a support point of a bounded convex set: one that is farthest along the unit vector
 * `direction` (three doubles). Returns CSTK_OK, or anything else for failure.
 */
typedef int32_t (*cstk_support_fn)(const double *direction, double *point, void *user);

/**
 * A primitive of a body. A sphere is a point with a radius, a capsule a segment with one: their features are those of this
 * core.
 */
typedef struct cstk_primitive {
  cstk_primitive_kind kind;
  /**
   * Numbers of features of the primitive, or of its core; 0 for cylinders, cones, ellipsoids and support functions.
   */
  uint32_t vertex_count;
  uint32_t edge_count;
  uint32_t face_count;
  /**
   * The radius around the core of spheres, capsules, rounded polygons and rounded polyhedra; 0 for others.
   */
  double radius;
  /**
   * The caller's tag; for a mesh face its index, for a point of a cloud the point's index.
   */
  uint64_t tag;
  uint64_t reserved[8];
} cstk_primitive;

/**
 * Statistics of a body and of the input it was built from.
 */
typedef struct cstk_body_statistics {
  /**
   * Convex primitives in the body.
   */
  uint64_t primitive_count;
  /**
   * Mesh faces that were not convex or not planar, and were split into triangles.
   */
  uint64_t faces_split;
  /**
   * Mesh faces without area, which were left out.
   */
  uint64_t faces_dropped;
  /**
   * Nodes of the hierarchy, and the number of its levels.
   */
  uint64_t node_count;
  uint64_t depth;
  /**
   * The axis-aligned bounding box of all vertices, in the frame in which the body was given.
   */
  double low[3];
  double high[3];
  /**
   * Connected pieces of the body: polygons that share vertices, and each polyhedron.
   */
  uint64_t piece_count;
  /**
   * Whether it was declared solid (cstk_body_builder_set_solid).
   */
  bool solid;
  uint8_t reserved_bytes[7];
  /**
   * Bodies that it was put together of (cstk_body_builder_add_body).
   */
  uint64_t part_count;
  /**
   * How far what the body stands for may be from it (cstk_body_builder_set_deviation).
   */
  double deviation;
  uint64_t reserved[4];
} cstk_body_statistics;

/**
 * A body that is part of a larger one (cstk_body_builder_add_body).
 */
typedef struct cstk_body_part {
  /**
   * The tag it was added with.
   */
  uint64_t tag;
  /**
   * Its primitives are `primitive_count` of the larger body's, from this one on, in their own order.
   */
  uint32_t first_primitive;
  uint32_t primitive_count;
  /**
   * The pose it was added at, from its frame to that of the larger body.
   */
  double pose[12];
  uint64_t reserved[4];
} cstk_body_part;


/**
 * Creates an empty builder for bodies of dimension 2 (planar worlds: all z are 0, polygons are solid) or 3 (polygons are
 * surfaces, unless cstk_body_builder_set_solid declares them the boundary of a solid). Release it with
 * cstk_body_builder_release.
 */
cstk_status cstk_body_builder_create(uint32_t dimension,
                                     cstk_body_builder **out);

/**
 * Adds a reference. CSTK_ERROR_WRONG_HANDLE if it is no builder.
 */
cstk_status cstk_body_builder_retain(cstk_body_builder *builder);

/**
 * Drops a reference; the last one frees the builder. NULL is a no-op.
 */
cstk_status cstk_body_builder_release(cstk_body_builder *builder);

/**
 * Adds a convex planar polygon: `point_count` vertices of three doubles in cyclic order, clockwise or counter-clockwise.
 * In 3-D it is a surface, in the plane it is solid. `tag` is any number of yours; witnesses return it.
 *
 * CSTK_ERROR_DEGENERATE, CSTK_ERROR_NOT_CONVEX or CSTK_ERROR_NOT_PLANAR, with a message that names the vertex. Vertices
 * may leave the plane by 1e-12 of the polygon's diameter. cstk_body_builder_add_mesh splits other polygons.
 */
cstk_status cstk_body_builder_add_polygon(cstk_body_builder *builder,
                                          const double *xyz,
                                          size_t point_count,
                                          uint64_t tag);

/**
 * Adds the convex hull of `point_count` points of three doubles: a solid, or a point, a segment or a flat polygon if the
 * points span no more. Points inside the hull are ignored.
 */
cstk_status cstk_body_builder_add_polyhedron(cstk_body_builder *builder,
                                             const double *xyz,
                                             size_t point_count,
                                             uint64_t tag);

/**
 * Adds the faces of a mesh as polygons. `vertices` holds `vertex_count` vertices of three doubles. Face f has
 * `face_sizes[f]` vertices; `face_sizes` has `face_count` entries, or is NULL for triangles. `indices` holds the vertex
 * indices of all faces, face after face, `index_count` in all. Faces are tagged with their index in this call; triangles
 * of a split face keep its tag.
 *
 * The mesh is scaled along its own x, y and z by the three factors of `scale` (NULL for 1), then moved by `pose` (NULL for
 * the identity). Negative factors mirror; the faces of a mirrored mesh are reversed, so that they still face outwards.
 * CSTK_ERROR_INVALID_ARGUMENT for a factor of magnitude below 1e-50 or above 1e50.
 *
 * Faces that are not convex or not planar are split into triangles; faces without area are left out and counted (see
 * cstk_body_get_statistics). CSTK_ERROR_NOT_FOUND for an index beyond the vertices, CSTK_ERROR_WRONG_SIZE for counts that
 * do not match, CSTK_ERROR_NOT_CONVEX for an outline that crosses itself. The message names the face, and nothing is
 * added.
 */
cstk_status cstk_body_builder_add_mesh(cstk_body_builder *builder,
                                       const double *vertices,
                                       size_t vertex_count,
                                       const uint32_t *face_sizes,
                                       size_t face_count,
                                       const uint32_t *indices,
                                       size_t index_count,
                                       const double *pose,
                                       const double *scale);

/**
 * Adds the mesh in a file as cstk_body_builder_add_mesh does, scaled by `scale` and moved by `pose`. The name must end in
 * .obj, .stl (ASCII or binary), .ply (the faces of a PLY file of any encoding) or .dae (COLLADA; scaled to metres by the
 * file's unit, `up_axis` not applied, as in the ROS tools; faces that a node mirrors are reversed). CSTK_ERROR_IO if the file cannot
 * be read, CSTK_ERROR_PARSE if it is damaged or truncated, CSTK_ERROR_UNSUPPORTED for another ending.
 */
cstk_status cstk_body_builder_add_mesh_file(cstk_body_builder *builder,
                                            const char *file,
                                            const double *pose,
                                            const double *scale);

/**
 * Adds the point cloud in a file as cstk_body_builder_add_points does: balls of `radius` around its points, scaled by `scale`
 * and moved by `pose` as a mesh is. The name must end in .pcd (the Point Cloud Library's files: ascii, binary and
 * binary_compressed) or .ply (the vertices of a PLY file: ascii, binary little or big endian). The viewpoint of a .pcd file
 * is not applied. Its points with a coordinate that is NaN were not measured, and are left out: `left_out` receives their
 * number, or is NULL. The others are tagged with their indices among those added.
 *
 * CSTK_ERROR_IO if the file cannot be read; CSTK_ERROR_PARSE if it is damaged or truncated; CSTK_ERROR_NOT_FINITE for an
 * infinite coordinate, in a .ply file also for NaN; CSTK_ERROR_EMPTY without points; CSTK_ERROR_UNSUPPORTED for another
 * ending, above 1 GiB (also unpacked) or above 2^26 points. The message names the line or the point, and nothing is added.
 */
cstk_status cstk_body_builder_add_cloud_file(cstk_body_builder *builder,
                                             const char *file,
                                             const double *pose,
                                             const double *scale,
                                             double radius,
                                             uint64_t *left_out);

/**
 * Adds a built body as a part, at `pose` (NULL for the identity; 12 doubles, from the part's frame to the builder's). The
 * same body may be added any number of times; the builder keeps a reference to it until the builder is released.
 *
 * The primitives are copied to their place, in their order; their tags, features and feature numbers stay. `tag` is that of
 * the part: witnesses give the number of the part (`r_part`, `s_part`), and cstk_body_get_part its tag, its pose and its
 * first primitive. Parts are numbered from 0 in the order in which they are added; those of a part stay its own.
 *
 * The part's hierarchy is taken over, not built again: cstk_body_build groups only the parts and what was added by itself,
 * and moves the parts' boxes to their places. (Trees that would get deeper than 56 levels, as of parts nested one in the
 * other, are grouped anew.) `aspect_limit` does not cut what is added beside parts. Answers are those of the same
 * primitives added one by one, but for the last digits of their vertices, which each motion rounds. A part that was built as a
 * solid stays one, whatever cstk_body_builder_set_solid says of the faces added by themselves; the body is then the union
 * of its solids.
 *
 * The primitives are copied because nodes and primitives are stored in the frame of their body: a query would otherwise
 * have to change frames within its innermost loop. Where one body stands in many places and memory matters, add it to an
 * environment as many objects instead: these share it.
 *
 * CSTK_ERROR_INVALID_ARGUMENT for a body of another dimension than the builder's, a pose that leaves the plane of a planar
 * builder, or coordinates beyond 1e50 after the motion.
 */
cstk_status cstk_body_builder_add_body(cstk_body_builder *builder,
                                       const cstk_body *body,
                                       const double *pose,
                                       uint64_t tag);

/**
 * Declares that all polygons and mesh faces together are the closed boundary of a solid (true), or surfaces (false, the
 * default). The inside of a solid counts: a body wholly inside it meets it, at distance 0. Polyhedra (flat ones too) are
 * not part of the boundary: they are solid by themselves. In the plane polygons are always solid, so this changes nothing.
 *
 * cstk_body_build checks that the boundary of everything added by then is closed. Edges join where their ends have the
 * same coordinates, to the last bit; along each edge as many faces must run one way as the other. Faces without area,
 * which are otherwise left out, count where others need them to join. Where exactly two faces share an edge and disagree,
 * faces are reversed; of each group of faces connected in this way, the orientation that covers the larger area is kept. A
 * point is inside where the boundary's winding number is not 0. Hence shells with the same orientation may overlap; a
 * cavity is a shell with the opposite orientation of the shell around it; and a boundary that faces inwards everywhere
 * bounds the same solid.
 */
cstk_status cstk_body_builder_set_solid(cstk_body_builder *builder,
                                        bool solid);

/**
 * States that the body stands for something else, such as a curved surface that its polygons approximate: no point of either is farther
 * than `deviation` from the other (their Hausdorff distance), where the inside of a solid counts. From 0, the default, to 1e50, in your
 * unit; for all primitives of the builder, those added later too. A body made of others (cstk_body_builder_add_body) has the largest
 * deviation of theirs and its own; cstk_body_refit and files keep it, `deviation` of cstk_body_statistics tells it.
 *
 * Answers are then about what the bodies stand for. Deviations of both bodies add up and act as a margin does (cstk_induced_options):
 * they are subtracted from every distance, so that lower bounds, classes, thresholds, motions, regions, slides, maps and certificates
 * say "apart" and "free" only if what the bodies stand for is. The upper bound of a distance is greater by twice their sum: the true
 * distance is from `lower` to `upper`. Points, normals, features and gradients are those of the bodies as they were built, distances and
 * clearances of contacts are less the deviations.
 *
 * That what bodies stand for meets is never proved if one states a deviation: CSTK_CLASS_INSIDE means that it may. For a complement,
 * where that would have to be proved, such pairs count as apart: no motion and no region is free of it because of them, and no region is
 * CSTK_REGION_INSIDE. cstk_pair_depth refuses them (CSTK_ERROR_UNSUPPORTED) if they may meet; signed distances of such pairs have a
 * lower bound of -INFINITY unless both bodies are single primitives. cstk_pair_penetration is of the primitives as they are.
 * CSTK_ERROR_NOT_FINITE, or CSTK_ERROR_INVALID_ARGUMENT for a deviation below 0 or too large.
 */
cstk_status cstk_body_builder_set_deviation(cstk_body_builder *builder,
                                            double deviation);

/**
 * Builds a body from the builder's primitives; the builder is unchanged and can be used further. `options` may be NULL for
 * the defaults; `progress` may be NULL; `user` is passed to it. CSTK_ERROR_EMPTY if nothing was added. For a body declared
 * solid: CSTK_ERROR_NOT_CLOSED if the boundary has open edges, or is one-sided (not orientable), with a message that names
 * edges and primitives; CSTK_ERROR_DEGENERATE if it bounds nothing, because each face has a copy that faces the other way.
 *
 * The hierarchy affects the speed of queries, never their answers. Building takes about 5 microseconds a polygon, and 1 to
 * 2 a point for bodies of points only (cstk_body_builder_add_points). Build once and share, or save the body
 * (cstk_body_save).
 */
cstk_status cstk_body_build(cstk_body_builder *builder,
                            const cstk_hierarchy_options *options,
                            cstk_progress_fn progress,
                            void *user,
                            cstk_body **out);

/**
 * Adds a tensor product Bezier patch as triangles: it is halved until each cell is proved to be within `tolerance` of two triangles.
 * Queries halve cells further where they are asked to (cstk_query_set_refinement). The body states the deviation that is left (cstk_body_builder_set_deviation), so that all answers hold for
 * the patch itself; the tolerance, in your unit, decides how near the bounds of a distance are to each other.
 *
 * `xyz` holds (degree_u + 1) x (degree_v + 1) control points of three doubles, row by row: those of one row have the same index in
 * u. `weights` holds one for each, all above 0, of a rational patch, or is NULL. All triangles have this tag. In 3-D
 * the patch is a surface; cstk_body_builder_set_solid does not count it among the faces of a boundary. Edges of a patch may be points.
 *
 * Degrees are from 1 to 32; a weight is at least 1e-6 of the largest: CSTK_ERROR_INVALID_ARGUMENT otherwise. CSTK_ERROR_WRONG_SIZE for
 * another number of points. CSTK_ERROR_LIMIT where the tolerance asks for more than 2^18 cells; halving it takes about twice as many.
 */
cstk_status cstk_body_builder_add_bezier_patch(cstk_body_builder *builder,
                                               uint32_t degree_u,
                                               uint32_t degree_v,
                                               const double *xyz,
                                               const double *weights,
                                               size_t point_count,
                                               double tolerance,
                                               uint64_t tag);

/**
 * Adds a NURBS surface as triangles: a tensor product B-spline surface, rational if it has weights. Knots are inserted until it is one
 * Bezier patch for each pair of knot spans that are not empty, and each patch is added as cstk_body_builder_add_bezier_patch does: what
 * that says of `tolerance`, the stated deviation, solids and tags holds here too. Patches are added in the order of their spans, those in
 * v running fastest.
 *
 * `knots_u` has degree_u + 1 entries more than there are rows of control points, `knots_v` degree_v + 1 more than there are columns. No
 * knot is less than the one before it. Counted from 0, the surface lies between knots `degree` and `count - 1 - degree`. These need not
 * have full multiplicity: unclamped and periodic knots are as good as clamped ones. `control_points` holds `point_count` points of three
 * doubles, row by row: those of one row have the same index in u. `weights` holds one for each, all above 0, or is NULL for ones.
 *
 * CSTK_ERROR_INVALID_ARGUMENT, with a message that names the knots or the weight: for degrees and weights as for a patch; for knots that
 * fall, are beyond 1e50, or are unequal but less than 2.3e-308 apart; if the surface has no extent; for a knot inside of it that is there
 * more often than its degree, where it would be torn; for any other that is there more often than its degree and once more.
 * CSTK_ERROR_WRONG_SIZE for another number of control points than the knots ask for. CSTK_ERROR_LIMIT for more than 2^18 patches, or
 * where the tolerance asks for more than 2^18 cells. Nothing is added then.
 */
cstk_status cstk_body_builder_add_nurbs_surface(cstk_body_builder *builder,
                                                uint32_t degree_u,
                                                uint32_t degree_v,
                                                const double *knots_u,
                                                size_t knot_count_u,
                                                const double *knots_v,
                                                size_t knot_count_v,
                                                const double *control_points,
                                                size_t point_count,
                                                const double *weights,
                                                double tolerance,
                                                uint64_t tag);

/**
 * Adds a ball around `center` (three doubles); in the plane a disc. Exact to 1e-12 of the largest coordinate, as points
 * are. A radius of 0 gives a point.
 */
cstk_status cstk_body_builder_add_sphere(cstk_body_builder *builder,
                                         const double *center,
                                         double radius,
                                         uint64_t tag);

/**
 * Adds all points within `radius` of the segment from `a` to `b` (three doubles each). Exact to 1e-12 of the largest
 * coordinate, as segments are. Along a face or another capsule it has several contacts, which span the common part.
 */
cstk_status cstk_body_builder_add_capsule(cstk_body_builder *builder,
                                          const double *a,
                                          const double *b,
                                          double radius,
                                          uint64_t tag);

/**
 * Adds the solid box with `half_extents` (three doubles, positive) around the origin of the frame at `pose`, along its
 * axes. It is a polyhedron, with the features and the exactness of one. Refused in the plane: use a polygon there.
 */
cstk_status cstk_body_builder_add_box(cstk_body_builder *builder,
                                      const double *pose,
                                      const double *half_extents,
                                      uint64_t tag);

/**
 * Adds the solid cylinder around the z axis of the frame at `pose`, from -half_length to half_length. Its surface is
 * smooth: distances are iterated, usually until they are known to about 1e-15 of the largest coordinate, and to 1e-11 of its
 * diameter at worst. `lower` and `upper` of the result allow for that worst case on either side, for each smooth primitive of the
 * pair, and for more where the iteration ends before. The feature of its contacts is CSTK_FEATURE_SURFACE, which counts as a
 * point in contact modes, and there is only one contact, even where it stands or lies on a face. cstk_pair_penetration refuses it.
 */
cstk_status cstk_body_builder_add_cylinder(cstk_body_builder *builder,
                                           const double *pose,
                                           double radius,
                                           double half_length,
                                           uint64_t tag);

/**
 * Adds the solid cone around the z axis of the frame at `pose`: the base at z = -height / 2, the apex at z = height / 2.
 * Smooth: see cstk_body_builder_add_cylinder.
 */
cstk_status cstk_body_builder_add_cone(cstk_body_builder *builder,
                                       const double *pose,
                                       double radius,
                                       double height,
                                       uint64_t tag);

/**
 * Adds the solid ellipsoid with `semi_axes` (three doubles, positive) around the origin of the frame at `pose`. Smooth:
 * see cstk_body_builder_add_cylinder.
 */
cstk_status cstk_body_builder_add_ellipsoid(cstk_body_builder *builder,
                                            const double *pose,
                                            const double *semi_axes,
                                            uint64_t tag);

/**
 * Adds all points within `radius` of a convex polygon given as for cstk_body_builder_add_polygon. As exact as the polygon,
 * whose features its contacts have.
 */
cstk_status cstk_body_builder_add_rounded_polygon(cstk_body_builder *builder,
                                                  const double *xyz,
                                                  size_t point_count,
                                                  double radius,
                                                  uint64_t tag);

/**
 * Adds all points within `radius` of the convex hull of `point_count` points. As exact as the hull, whose features its
 * contacts have.
 */
cstk_status cstk_body_builder_add_rounded_polyhedron(cstk_body_builder *builder,
                                                     const double *xyz,
                                                     size_t point_count,
                                                     double radius,
                                                     uint64_t tag);

/**
 * Adds a point cloud: balls of one radius around `point_count` points of three doubles, tagged with their indices. A
 * radius of 0 gives points. Exact to 1e-12 of the largest coordinate. On failure the message names the point, and nothing
 * is added.
 *
 * A body of points only builds in 1 to 2 microseconds a point, and takes less than 100 bytes a point: its points are split
 * top-down whatever the grouping, unless that is CSTK_GROUPING_BASIC. Its wrappers are computed when nodes of its
 * hierarchy are first inspected, which takes 10 to 30 microseconds and about 1 kB a point; queries do not need them. Mixed
 * with other primitives, points are built as those are, at up to 60 microseconds each: keep clouds in their own bodies.
 */
cstk_status cstk_body_builder_add_points(cstk_body_builder *builder,
                                         const double *xyz,
                                         size_t point_count,
                                         double radius);

/**
 * Adds a height field over the xy-plane: `nx` by `ny` nodes, at least two each way, `cell_x` and `cell_y` apart, the first
 * at the origin; `heights[j * nx + i]` is the z of node (i, j). Each cell is two triangles, split along the diagonal from
 * (i, j) to (i + 1, j + 1), both tagged with j * (nx - 1) + i. If `base` is NaN the field is a surface; otherwise it is
 * solid ground down to z = base, which must be below all heights, and each triangle becomes a prism. Exact to 1e-12 of the
 * largest coordinate. CSTK_ERROR_NOT_CONVERGED, with the cell, for a prism so steep that rounding leaves it no closed hull: its heights
 * differ by a million times its sides and more.
 */
cstk_status cstk_body_builder_add_height_field(cstk_body_builder *builder,
                                               size_t nx,
                                               size_t ny,
                                               const double *heights,
                                               double cell_x,
                                               double cell_y,
                                               double base);

/**
 * Adds the bounded convex set that the function `support` describes, in the frame in which the body is given. Smooth: see
 * cstk_body_builder_add_cylinder; its distances are as exact as the function's points.
 *
 * The function is called from any thread that queries the body, concurrently, and from within queries. It must be pure,
 * must not throw, and must not call back into the running query. It is tested here along the axes and 300 other
 * directions: CSTK_ERROR_CALLBACK_FAILED if it fails, CSTK_ERROR_NOT_FINITE if it writes numbers that are not finite, or
 * none, CSTK_ERROR_NOT_CONVEX if two points contradict each other. A later failure does not fail the query: the set then
 * counts as the bounding box found here. So an answer of "free" of the set stays safe; what is larger for the box is not: upper bounds of
 * distances, depths, and "free" of the set's complement.
 *
 * `destroy` may be NULL. It is called once with `user`, by the thread that drops the last reference to whatever uses the
 * function, and not if this call fails. Such a body cannot be saved.
 */
cstk_status cstk_body_builder_add_support(cstk_body_builder *builder,
                                          cstk_support_fn support,
                                          void *user,
                                          cstk_destroy_fn destroy,
                                          uint64_t tag);

/**
 * Describes a primitive of the body. Primitives are numbered from 0 in the order in which they were added; the triangles
 * of a split face have consecutive numbers. cstk_body_get_statistics gives their number, and
 * cstk_body_get_feature_vertices their vertices: CSTK_FEATURE_VERTEX for one, CSTK_FEATURE_INTERIOR for all.
 * CSTK_ERROR_NOT_FOUND for an index beyond the last.
 */
cstk_status cstk_body_get_primitive(const cstk_body *body,
                                    uint32_t index,
                                    cstk_primitive *out);

/**
 * Adds a reference.
 */
cstk_status cstk_body_retain(cstk_body *body);

/**
 * Drops a reference. NULL is a no-op. Robots and environments hold references to their bodies.
 */
cstk_status cstk_body_release(cstk_body *body);

/**
 * Attaches user data to a body, however it was created (§2.2.3). Witnesses return it: as `r_data` for a link's body, and
 * as `s_data` for the body of a link or of an s-object without its own data. A second call for the same body is
 * CSTK_ERROR_INVALID_ARGUMENT; one with NULL for both attaches nothing and is no call in this sense. `destroy` may be NULL; it is called once, by the thread that drops the last reference to
 * the body, and not if this call fails. Other threads may query the body meanwhile.
 */
cstk_status cstk_body_set_data(cstk_body *body,
                               void *data,
                               cstk_destroy_fn destroy);

/**
 * Writes the user data attached to a body, or NULL.
 */
cstk_status cstk_body_get_data(const cstk_body *body, void **out);

/**
 * Writes counts and extents.
 */
cstk_status cstk_body_get_statistics(const cstk_body *body,
                                     cstk_body_statistics *out);

/**
 * Writes which part of a body has this number; parts are numbered from 0 as they were added. CSTK_ERROR_NOT_FOUND if there
 * is none. The parts of a part are its own: its primitive `i` is the larger body's `first_primitive + i`.
 */
cstk_status cstk_body_get_part(const cstk_body *body,
                               uint32_t part,
                               cstk_body_part *out);

/**
 * Writes the vertices of a feature of a primitive, in the frame in which the body was given. A polygon has one face (0),
 * and its edge i joins vertices i and i + 1; the features of a polyhedron are those of its hull. `kind` is a
 * cstk_feature_kind. At most `max_count` points of three doubles are written to `xyz` (NULL if `max_count` is 0), and
 * their full number to `count`.
 */
cstk_status cstk_body_get_feature_vertices(const cstk_body *body,
                                           uint32_t primitive,
                                           int32_t kind,
                                           uint32_t feature,
                                           size_t max_count,
                                           double *xyz,
                                           size_t *count);

/**
 * Writes the vertices of all primitives, one primitive after the other, in the frame in which the body was given: those
 * of a polygon as it was added (of a mesh, face after face, less those left out, and triangle after triangle where a face
 * was split), the corners of a polyhedron's hull, the ends of a capsule, the centre of a sphere, the origin of a cylinder,
 * cone or ellipsoid, the points of a cloud. At most `max_count` points of three doubles are written to `xyz` (NULL if
 * `max_count` is 0), and their full number to `count`.
 */
cstk_status cstk_body_get_vertices(const cstk_body *body,
                                   size_t max_count,
                                   double *xyz,
                                   size_t *count);

/**
 * Writes a new body like `body` but with other vertices: `vertex_count` points of three doubles, in the order of
 * cstk_body_get_vertices. Primitives with their tags, features, radii and orientations stay, and so does the grouping of
 * the hierarchy, which both bodies share: only its boxes are fitted anew. That takes a small part of the time of a build
 * (docs/benchmarks.md), and answers are those of a body built of the moved primitives. Queries get slower as far as the
 * vertices leave the neighbours they were grouped with: build anew when the shape has changed altogether. `body` does not
 * change; it may be released. User data are not taken over. Parts keep their numbers, tags and the poses they were added at.
 *
 * Each primitive is checked as when it was added; the message names it. CSTK_ERROR_WRONG_SIZE for another number of
 * vertices, CSTK_ERROR_NOT_FINITE, CSTK_ERROR_DEGENERATE, CSTK_ERROR_NOT_PLANAR (for a polyhedron, a face that is no longer
 * planar), CSTK_ERROR_NOT_CONVEX (also for a polyhedron turned inside out). Of a solid, vertices of the boundary that had
 * the same coordinates must have the same again: CSTK_ERROR_NOT_CLOSED; CSTK_ERROR_UNSUPPORTED if faces without area close
 * it that share none of their vertices with others. Bodies with another wrapper than CSTK_WRAPPER_HULL, or with slabs
 * (`aspect_limit`), get wrappers anew, which takes longer.
 */
cstk_status cstk_body_refit(const cstk_body *body,
                            const double *xyz,
                            size_t vertex_count,
                            cstk_body **out);

/**
 * Saves the body with its hierarchy to a file. An existing file is replaced only once everything is written. The format is
 * described in docs/body-file.md. CSTK_ERROR_IO if the file cannot be written, CSTK_ERROR_UNSUPPORTED for a body with a
 * support function, which cannot be saved.
 */
cstk_status cstk_body_save(const cstk_body *body,
                           const char *file);

/**
 * Loads a body that cstk_body_save wrote. Nothing is rebuilt, and queries give the same answers as for the saved body, bit
 * for bit. CSTK_ERROR_IO if the file cannot be read, CSTK_ERROR_PARSE if it is truncated, altered or not a body file,
 * CSTK_ERROR_UNSUPPORTED for another version of the format. The checksum detects damage; it does not protect against
 * forgery.
 */
cstk_status cstk_body_load(const char *file,
                           cstk_body **out);

/** @} */

/**
 * @defgroup hierarchy Hierarchies
 *
 * Every body has a binary tree of bounding volumes over its primitives (§3.2). It affects the speed of queries, never
 * their answers. Options choose how it is built; its nodes can be measured, listed and drawn.
 *
 * @code
     cstk_hierarchy_options options;
     check(cstk_hierarchy_options_default(&options, sizeof options));
     options.threads = 2;
     check(cstk_body_build(body_builder, &options, NULL, NULL, &body));
 * @endcode
 * @{
 */

/**
 * The kind of convex bound at each node.
 */
enum cstk_wrapper_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Convex hulls, or oriented boxes where a hull has more than hull_vertex_limit vertices. The default. Unless a
   * primitive is cut into slabs, they are computed when nodes are first inspected, on as many threads as the build, and
   * the boxes that queries traverse are fitted to the primitives themselves.
   */
  CSTK_WRAPPER_HULL = 0,
  CSTK_WRAPPER_ORIENTED_BOX = 1,
  CSTK_WRAPPER_ALIGNED_BOX = 2,
  /**
   * Spheres around the vertices below the node.
   */
  CSTK_WRAPPER_TIGHT_SPHERE = 3,
  /**
   * Spheres around the children's spheres; the fastest to build, and loose.
   */
  CSTK_WRAPPER_MERGED_SPHERE = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_wrapper_kind cstk_wrapper_kind;
#else
typedef int32_t cstk_wrapper_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The algorithm that groups primitives into a binary tree.
 */
enum cstk_grouping
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Clusters edge-adjacent primitives, then near ones (the report's Simple Hybrid). The default. More than 16,384 parts
   * without pieces are first cut top-down into regions of at most that size. Bodies of points only
   * (cstk_body_builder_add_points), which have no edges, are split top-down altogether.
   */
  CSTK_GROUPING_HYBRID = 0,
  /**
   * Clusters near primitives, in such regions; needs no adjacency (the report's Basic Clustering).
   */
  CSTK_GROUPING_BASIC = 1,
  /**
   * Splits top-down by the surface-area heuristic; the fastest to build.
   */
  CSTK_GROUPING_TOP_DOWN = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_grouping cstk_grouping;
#else
typedef int32_t cstk_grouping;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Whether primitives that form a convex piece of the body get their own node, bounded exactly.
 */
enum cstk_pieces
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  CSTK_PIECES_OFF = 0,
  /**
   * Coplanar neighbours whose union is a convex polygon.
   */
  CSTK_PIECES_COPLANAR = 1,
  /**
   * Also edge-adjacent polygons that bound a convex part of a closed body.
   */
  CSTK_PIECES_PATCHES = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_pieces cstk_pieces;
#else
typedef int32_t cstk_pieces;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * A mesh of polygons, for display. Immutable; threads may share it.
 */
typedef struct cstk_mesh cstk_mesh;

/**
 * Options of a body's hierarchy. Write it with cstk_hierarchy_options_default first. They affect the speed of queries,
 * never their answers.
 */
struct cstk_hierarchy_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * The most vertices of a convex hull; larger ones become oriented boxes. At least 8; default 32.
   */
  uint32_t hull_vertex_limit;
  /**
   * The number of threads to build on; 0 for as many as the machine runs at once. Default 1. The hierarchy does not
   * depend on it.
   */
  uint32_t threads;
  /**
   * A cstk_grouping.
   */
  int32_t grouping;
  /**
   * A cstk_wrapper_kind.
   */
  int32_t wrapper;
  /**
   * A cstk_pieces.
   */
  int32_t pieces;
  uint32_t reserved;
  /**
   * A (at most 16), B and C of the cost of merging two clusters, diameter^A (B Fill + C Balance): Fill is the merged
   * diameter over the sum of the two, Balance the larger ratio of the two. Not negative.
   */
  double cost_diameter;
  double cost_fill;
  double cost_balance;
  /**
   * The largest diameter of clusters merged in the first round, and the largest gap between them; both double from round
   * to round. 0, the default, for limits that suit the primitives.
   */
  double diameter_limit;
  double gap_limit;
  /**
   * Primitives longer than this many times their width get several leaves, each bounding a part; witnesses still name
   * the primitive. At least 1.5, or 0, the default, for one leaf each.
   */
  double aspect_limit;
};

/**
 * Statistics of a body's hierarchy.
 */
typedef struct cstk_hierarchy_statistics {
  /**
   * A cstk_wrapper_kind.
   */
  cstk_wrapper_kind wrapper;
  uint32_t reserved_0;
  /**
   * The number of nodes, of leaves among them, and of nodes that hold a maximal convex piece.
   */
  uint64_t node_count;
  uint64_t leaf_count;
  uint64_t piece_count;
  /**
   * The number of levels, and the mean level of a leaf; the root's level is 0.
   */
  uint64_t depth;
  double mean_leaf_level;
  /**
   * Means over interior nodes. `balance`: the larger ratio of the children's diameters (1 is perfect spatial balance).
   * `fill`: the diameter over the sum of the children's (1/2: they overlap completely; above 1: they are apart).
   */
  double balance;
  double fill;
  /**
   * The mean number of tests for a random line through the body's box, a primitive counting as four nodes: compares
   * hierarchies of one body.
   */
  double expected_cost;
  /**
   * Build times in seconds, on the machine that built it: convex pieces and slender primitives; the tree of sets; the
   * boxes that queries traverse and the wrappers they are fitted to.
   */
  double preparation_seconds;
  double grouping_seconds;
  double construction_seconds;
  /**
   * Memory of the hierarchy and of the primitive data that queries read. It grows several times once the wrappers are
   * computed, for hulls and for bodies of points only, whose wrappers are computed when nodes are first inspected.
   */
  uint64_t memory_bytes;
  uint64_t reserved[8];
} cstk_hierarchy_statistics;

/**
 * Statistics of a level of a hierarchy.
 */
typedef struct cstk_level_statistics {
  /**
   * The number of nodes of the level, and of leaves above it. Together they cover the body.
   */
  uint64_t node_count;
  uint64_t leaves_above;
  /**
   * The total volume and surface area of the wrappers of all these nodes; flat wrappers count both sides.
   */
  double volume;
  double surface;
  uint64_t reserved[4];
} cstk_level_statistics;

/**
 * A node of a hierarchy. Nodes are numbered from 0, the root, in depth-first order.
 */
typedef struct cstk_hierarchy_node {
  /**
   * The children; both UINT32_MAX for a leaf.
   */
  uint32_t children[2];
  /**
   * A leaf's primitive; UINT32_MAX otherwise. A slender primitive may have several leaves.
   */
  uint32_t primitive;
  /**
   * 1 if the node holds a maximal convex piece, else 0.
   */
  uint32_t is_piece;
  /**
   * The wrapper: the convex hull of its corners (see cstk_body_get_node_corners), grown by `excess`. A sphere has one
   * corner, its centre, and `excess` is its radius.
   */
  uint64_t corner_count;
  double excess;
  /**
   * A sphere around the primitives below the node, in the frame in which the body was given.
   */
  double center[3];
  double radius;
  uint64_t reserved[4];
} cstk_hierarchy_node;

/**
 * The arrays of a mesh; they are valid as long as the mesh.
 */
typedef struct cstk_mesh_view {
  /**
   * `vertex_count` vertices of three doubles.
   */
  const double *vertices;
  size_t vertex_count;
  /**
   * For each face, its number of vertices, and the node it stands for.
   */
  const uint32_t *face_sizes;
  const uint32_t *face_nodes;
  size_t face_count;
  /**
   * The vertex indices of the faces, face after face, counter-clockwise seen from outside.
   */
  const uint32_t *indices;
  size_t index_count;
  uint64_t reserved[4];
} cstk_mesh_view;


/**
 * Writes the default options. `size` is sizeof(cstk_hierarchy_options).
 */
cstk_status cstk_hierarchy_options_default(cstk_hierarchy_options *out, size_t size);

/**
 * Writes statistics of the body's hierarchy; takes time in proportion to its nodes. Where wrappers are computed on first
 * inspection (hulls without an aspect_limit that cuts, and bodies of points only), axis-aligned boxes around the
 * primitives are measured instead.
 */
cstk_status cstk_body_get_hierarchy_statistics(const cstk_body *body,
                                               cstk_hierarchy_statistics *out);

/**
 * Writes statistics of a level of the hierarchy; the root's is 0. CSTK_ERROR_NOT_FOUND for a level it does not have.
 * Computes the wrappers' hulls: some tens of microseconds a node.
 */
cstk_status cstk_body_get_level_statistics(const cstk_body *body,
                                           uint32_t level,
                                           cstk_level_statistics *out);

/**
 * Writes the nodes of a level and the leaves above it, which together cover the body. At most `max_count` are written to
 * `nodes` (NULL if `max_count` is 0), and their full number to `count`. CSTK_ERROR_NOT_FOUND for a level that the
 * hierarchy does not have.
 */
cstk_status cstk_body_get_level_nodes(const cstk_body *body,
                                      uint32_t level,
                                      size_t max_count,
                                      uint32_t *nodes,
                                      size_t *count);

/**
 * Writes at most `max_count` nodes that cover the body, found by repeatedly replacing the node with the largest wrapper by
 * its children: for broad-phase structures of limited size. They are written to `nodes`, their number to `count`.
 * CSTK_ERROR_INVALID_ARGUMENT if `max_count` is 0.
 */
cstk_status cstk_body_get_cover_nodes(const cstk_body *body,
                                      size_t max_count,
                                      uint32_t *nodes,
                                      size_t *count);

/**
 * Describes a node. CSTK_ERROR_NOT_FOUND for a node that the hierarchy does not have.
 */
cstk_status cstk_body_get_node(const cstk_body *body,
                               uint32_t node,
                               cstk_hierarchy_node *out);

/**
 * Writes the corners of a node's wrapper, in the frame in which the body was given. At most `max_count` points of three
 * doubles are written to `xyz` (NULL if `max_count` is 0), and their full number to `count`. CSTK_ERROR_NOT_FOUND for a
 * node that the hierarchy does not have.
 */
cstk_status cstk_body_get_node_corners(const cstk_body *body,
                                       uint32_t node,
                                       size_t max_count,
                                       double *xyz,
                                       size_t *count);

/**
 * Creates a mesh of the wrappers of nodes, leaves as their primitives, in the frame in which the body was given. Release
 * it with cstk_mesh_release. CSTK_ERROR_NOT_FOUND for a node that the hierarchy does not have.
 */
cstk_status cstk_mesh_create_from_nodes(const cstk_body *body,
                                        const uint32_t *nodes,
                                        size_t node_count,
                                        cstk_mesh **out);

/**
 * Writes a picture of at least one node to a .glb file (glTF), neighbours in different colours, leaves as their
 * primitives. The name must end in .glb (CSTK_ERROR_UNSUPPORTED otherwise). The file is written whole or not at all;
 * CSTK_ERROR_IO if that fails.
 */
cstk_status cstk_body_show_nodes(const cstk_body *body,
                                 const uint32_t *nodes,
                                 size_t node_count,
                                 const char *file);

/**
 * Adds a reference.
 */
cstk_status cstk_mesh_retain(cstk_mesh *mesh);

/**
 * Drops a reference. NULL is a no-op.
 */
cstk_status cstk_mesh_release(cstk_mesh *mesh);

/**
 * Writes the arrays of the mesh; they are valid as long as the mesh.
 */
cstk_status cstk_mesh_get_view(const cstk_mesh *mesh, cstk_mesh_view *out);

/** @} */

/**
 * @defgroup robot Robots
 *
 * A robot is a tree of links, each with a joint to its parent and perhaps a body (§4.2). A builder collects the links. The
 * robot computes forward kinematics and Jacobians.
 *
 * @code
     cstk_link_def upper_arm;
     uint32_t link;
     check(cstk_link_def_default(&upper_arm, sizeof upper_arm));
     upper_arm.joint = CSTK_JOINT_REVOLUTE;
     upper_arm.body = body;
     check(cstk_robot_builder_add_link(robot_builder, &upper_arm, &link));
     check(cstk_robot_build(robot_builder, &robot));
 * @endcode
 * @{
 */

/**
 * How a joint moves its link, and its coordinates. Velocities (and so steps and gradients) are the coordinates' rates, one
 * each, except for joints with a unit quaternion x, y, z, w, which state theirs.
 */
enum cstk_joint_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Does not move.
   */
  CSTK_JOINT_FIXED = 0,
  /**
   * Rotates about the axis; the coordinate is an angle in radians.
   */
  CSTK_JOINT_REVOLUTE = 1,
  /**
   * Translates along the axis; the coordinate is a length.
   */
  CSTK_JOINT_PRISMATIC = 2,
  /**
   * Moves in the xy-plane of the joint's frame: x, y, and an angle about z.
   */
  CSTK_JOINT_PLANAR = 3,
  /**
   * Rotates about the origin. Four coordinates, a quaternion; three velocities, angular, in the link's frame.
   */
  CSTK_JOINT_SPHERICAL = 4,
  /**
   * Moves freely. Seven coordinates: x, y, z and a quaternion; six velocities: linear, then angular, in the link's
   * frame.
   */
  CSTK_JOINT_FREE = 5,
  /**
   * Moves freely, by the report's x, y, z, yaw, pitch, roll (§4.1): six coordinates. Singular at cos(pitch) = 0: there
   * no velocity turns the link about some axis.
   */
  CSTK_JOINT_FREE_EULER = 6,
  /**
   * Moves by callbacks; see cstk_custom_joint.
   */
  CSTK_JOINT_CUSTOM = 7,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_joint_kind cstk_joint_kind;
#else
typedef int32_t cstk_joint_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * A tree of links. Immutable; threads may share it. It keeps references to the bodies of its links.
 */
typedef struct cstk_robot cstk_robot;

/**
 * Collects the links of a robot. Serves one call at a time; another call meanwhile is CSTK_ERROR_BUSY.
 */
typedef struct cstk_robot_builder cstk_robot_builder;

/**
 * Writes the pose of the link in the joint's frame, 12 doubles, at the joint's `n` coordinates. Returns CSTK_OK, or
 * anything else to make the calling function fail with CSTK_ERROR_CALLBACK_FAILED.
 */
typedef int32_t (*cstk_joint_pose_fn)(const double *q, size_t n, double *pose, void *user);

/**
 * Writes the derivative of that pose: 6 rows of `n` doubles, row-major, three of the velocity of the link's origin, then
 * three of the angular velocity of the link, both in the joint's frame.
 */
typedef int32_t (*cstk_joint_jacobian_fn)(const double *q, size_t n, double *jacobian, void *user);

/**
 * A joint defined by callbacks: the report's arbitrary kinematics (§4). Write it with cstk_custom_joint_default first.
 * Both functions are called from any thread that uses the robot, concurrently, and from within queries; they must be pure,
 * must not throw, and must not call back into the running query. Numbers that are NaN or infinite (or left unwritten in a
 * Jacobian) are CSTK_ERROR_NOT_FINITE, a pose that is not rigid (or left unwritten) is CSTK_ERROR_NOT_A_ROTATION, and a
 * pose that leaves the plane of a planar robot or a number beyond 1e50 is CSTK_ERROR_INVALID_ARGUMENT.
 */
typedef struct cstk_custom_joint {
  uint32_t size;
  uint32_t cookie;
  /**
   * The number of coordinates, 1 to 64; as many velocities, their rates.
   */
  uint32_t coordinates;
  uint32_t reserved;
  /**
   * Both must be set.
   */
  cstk_joint_pose_fn pose;
  cstk_joint_jacobian_fn jacobian;
  /**
   * Passed to the functions.
   */
  void *user;
  /**
   * May be NULL. Called once for each link added with it, by the thread that drops the last reference to whatever uses
   * the link's joint; not called if adding the link fails.
   */
  cstk_destroy_fn destroy;
  /**
   * Upper bounds of the speed of the link's origin and of its angular speed (radians), per unit rate of any one
   * coordinate, at all coordinates. Negative, the default, means unknown: motions, regions and slides that move this joint
   * are then refused, since nothing can be proved about them.
   */
  double linear_speed;
  double angular_speed;
} cstk_custom_joint;

/**
 * The definition of a link and its joint. Write it with cstk_link_def_default first: a fixed link without name or body at
 * the world's origin.
 */
typedef struct cstk_link_def {
  uint32_t size;
  uint32_t cookie;
  /**
   * Unique within the robot, UTF-8; NULL for "link<number>". It is copied.
   */
  const char *name;
  /**
   * The link's geometry, or NULL for a frame without any. The robot keeps a reference.
   */
  const cstk_body *body;
  /**
   * The number of the parent link, or -1 for the world.
   */
  int32_t parent;
  /**
   * A cstk_joint_kind.
   */
  int32_t joint;
  /**
   * The joint's frame in the parent's frame: a pose of 12 doubles. The link's frame, in which its body is given, is
   * pose(link) = pose(parent) at motion(coordinate), and coincides with the joint's frame at coordinate 0. For the
   * report's (x, y, z, yaw, pitch, roll) see cstk_pose_from_euler.
   */
  double at[12];
  /**
   * The axis of a revolute or prismatic joint in the joint's frame, of any length; default z.
   */
  double axis[3];
  /**
   * The joint's first coordinate, or -1 for the next unused ones. A revolute or prismatic joint may use a single
   * coordinate of an earlier joint, and so mimic it; other joints have their own coordinates.
   */
  int32_t coordinate;
  uint32_t reserved;
  /**
   * The joint's name, unique within the robot, UTF-8; NULL for none. It is copied.
   */
  const char *joint_name;
  /**
   * A revolute or prismatic joint moves by multiplier * coordinate + offset; default 1 and 0.
   */
  double multiplier;
  double offset;
  /**
   * The range of a revolute or prismatic joint's coordinate, which a space may override; radians or lengths. The default
   * is infinite: a revolute joint then turns on a circle. Finite ones are at most 1e50 in size. Ignored where the joint shares an earlier joint's coordinate.
   */
  double lower;
  double upper;
  /**
   * For CSTK_JOINT_CUSTOM, else NULL. It is copied.
   */
  const cstk_custom_joint *custom;
} cstk_link_def;

/**
 * A link of a robot and the joint that moves it.
 */
typedef struct cstk_link_info {
  /**
   * The parent link, or -1 for the world.
   */
  int32_t parent;
  cstk_joint_kind joint;
  /**
   * The joint has `nq` coordinates from `coordinate` on and `nv` velocities from `velocity` on, by their index in the
   * robot.
   */
  uint32_t coordinate;
  uint32_t nq;
  uint32_t velocity;
  uint32_t nv;
  bool has_body;
  uint8_t reserved_bytes[7];
  /**
   * See cstk_link_def.
   */
  double multiplier;
  double offset;
  double at[12];
  double axis[3];
  uint64_t reserved[8];
} cstk_link_info;


/**
 * Writes the defaults: one coordinate, and nothing else. `size` is sizeof(cstk_custom_joint).
 */
cstk_status cstk_custom_joint_default(cstk_custom_joint *out, size_t size);

/**
 * Creates an empty builder for robots of dimension 2 (planar: joints turn about z or shift along x and y) or 3. Release it
 * with cstk_robot_builder_release.
 */
cstk_status cstk_robot_builder_create(uint32_t dimension,
                                      cstk_robot_builder **out);

/**
 * Adds a reference.
 */
cstk_status cstk_robot_builder_retain(cstk_robot_builder *builder);

/**
 * Drops a reference. NULL is a no-op.
 */
cstk_status cstk_robot_builder_release(cstk_robot_builder *builder);

/**
 * Writes the default link. `size` is sizeof(cstk_link_def).
 */
cstk_status cstk_link_def_default(cstk_link_def *out, size_t size);

/**
 * Adds a link; parents before children. Links are numbered from 0 in the order in which they are added; the number is
 * written to `out`, which may be NULL.
 */
cstk_status cstk_robot_builder_add_link(cstk_robot_builder *builder,
                                        const cstk_link_def *def,
                                        uint32_t *out);

/**
 * Builds a robot from the links added so far; the builder is unchanged. CSTK_ERROR_EMPTY if there are none.
 */
cstk_status cstk_robot_build(cstk_robot_builder *builder,
                             cstk_robot **out);

/**
 * Adds a reference.
 */
cstk_status cstk_robot_retain(cstk_robot *robot);

/**
 * Drops a reference. NULL is a no-op. Spaces hold references to their robots.
 */
cstk_status cstk_robot_release(cstk_robot *robot);

/**
 * Writes the number of coordinates (nq), of velocities (nv; one fewer for each quaternion) and of links; each output may
 * be NULL.
 */
cstk_status cstk_robot_get_size(const cstk_robot *robot,
                                size_t *nq,
                                size_t *nv,
                                size_t *link_count);

/**
 * Writes the number of the link with this name. CSTK_ERROR_NOT_FOUND if there is none.
 */
cstk_status cstk_robot_find_link(const cstk_robot *robot, const char *name, uint32_t *out);

/**
 * Writes the number of the link that the joint with this name moves. CSTK_ERROR_NOT_FOUND if there is none.
 */
cstk_status cstk_robot_find_joint(const cstk_robot *robot,
                                  const char *name,
                                  uint32_t *out);

/**
 * Describes a link and its joint. CSTK_ERROR_NOT_FOUND for a link that the robot does not have.
 */
cstk_status cstk_robot_get_link_info(const cstk_robot *robot,
                                     uint32_t link,
                                     cstk_link_info *out);

/**
 * Writes the body of a link, with a reference that the caller must release. CSTK_ERROR_EMPTY if the link has none.
 */
cstk_status cstk_robot_get_body(const cstk_robot *robot,
                                uint32_t link,
                                cstk_body **out);

/**
 * Writes a link's name, NUL-terminated, into a buffer of `capacity` bytes, and the name's length without the terminator to
 * `length`, which may be NULL. With a NULL buffer of capacity 0 only the length is written. CSTK_ERROR_WRONG_SIZE if the
 * name does not fit.
 */
cstk_status cstk_robot_get_link_name(const cstk_robot *robot,
                                     uint32_t link,
                                     char *buffer,
                                     size_t capacity,
                                     size_t *length);

/**
 * Writes the name of the joint that moves a link, "" if it has none; arguments as for cstk_robot_get_link_name.
 */
cstk_status cstk_robot_get_joint_name(const cstk_robot *robot,
                                      uint32_t link,
                                      char *buffer,
                                      size_t capacity,
                                      size_t *length);

/**
 * Writes the pose of a link in the world at configuration q (`nq` doubles; forward kinematics, §4.2), as 12 doubles.
 */
cstk_status cstk_robot_link_pose(const cstk_robot *robot,
                                 const double *q,
                                 size_t nq,
                                 uint32_t link,
                                 double *pose);

/**
 * Writes the basic Jacobian (§4.3, eq. 33) at q of a point fixed to a link; `point` is given in the link's frame. 6 rows
 * of nv doubles, row-major: three rows of linear velocity of the point, then three of angular velocity of the link, both
 * in the world.
 */
cstk_status cstk_robot_jacobian(const cstk_robot *robot,
                                const double *q,
                                size_t nq,
                                uint32_t link,
                                const double *point,
                                double *jacobian);

/**
 * Creates a robot of which only some joints move: a joint group as a robot of its own. It has the same links, by the same
 * numbers, names and bodies. `joints` holds `joint_count` numbers of links: the joints that move these, and those that
 * share a coordinate with one that is left, are left with all their coordinates; all others stand still where `q` (`nq` doubles) has them. q need not lie within limits;
 * duplicate joints count once. Coordinates and velocities that are left keep their order and are numbered anew; so are those
 * of groups and states (see cstk_robot_get_group). A space of it takes every query, gradient and motion, alone or with other
 * robots. cstk_robot_to_whole and cstk_robot_from_whole convert configurations. Without any joint the robot has no
 * coordinate. Release it with cstk_robot_release.
 */
cstk_status cstk_robot_create_frozen(const cstk_robot *robot,
                                     const uint32_t *joints,
                                     size_t joint_count,
                                     const double *q,
                                     size_t nq,
                                     cstk_robot **out);

/**
 * Writes the configuration, `whole_nq` doubles, of the robot that cstk_robot_create_frozen was given, at configuration q of
 * the robot that it made. CSTK_ERROR_EMPTY for any other robot.
 */
cstk_status cstk_robot_to_whole(const cstk_robot *robot,
                                const double *q,
                                size_t nq,
                                double *whole,
                                size_t whole_nq);

/**
 * Writes the coordinates, `nq` doubles, that are left to a robot that cstk_robot_create_frozen made, of a configuration of
 * the robot that it was made from (`whole_nq` doubles); those of frozen joints are ignored.
 */
cstk_status cstk_robot_from_whole(const cstk_robot *robot,
                                  const double *whole,
                                  size_t whole_nq,
                                  double *q,
                                  size_t nq);

/** @} */

/**
 * @defgroup urdf URDF
 *
 * Robots from URDF files and texts: links, joints, limits, and the meshes and shapes of their collision geometry.
 *
 * @code
     uint32_t root;
     check(cstk_robot_builder_create(3, &robot_builder));
     check(cstk_robot_builder_load_urdf(robot_builder, "arm.urdf", NULL, NULL, NULL, &root));
     check(cstk_robot_build(robot_builder, &robot));
 * @endcode
 * @{
 */

/**
 * Which shapes of a URDF file's links become their bodies.
 */
enum cstk_urdf_geometry
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The `collision` elements.
   */
  CSTK_URDF_COLLISION = 0,
  /**
   * The `visual` elements.
   */
  CSTK_URDF_VISUAL = 1,
  /**
   * None: the links have frames only, and no mesh file is read.
   */
  CSTK_URDF_NO_GEOMETRY = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_urdf_geometry cstk_urdf_geometry;
#else
typedef int32_t cstk_urdf_geometry;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What the meshes of a link, or of a scene's object, stand for.
 */
enum cstk_mesh_form
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Their faces: a body wholly inside a mesh does not meet it.
   */
  CSTK_MESH_SURFACE = 0,
  /**
   * The solid that their faces bound, where all meshes of the body together are closed (see cstk_body_builder_set_solid);
   * else their faces.
   */
  CSTK_MESH_SOLID = 1,
  /**
   * The convex hull of each mesh, a solid: what Drake and many MoveIt set-ups use.
   */
  CSTK_MESH_HULL = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_mesh_form cstk_mesh_form;
#else
typedef int32_t cstk_mesh_form;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The form of one link's meshes.
 */
typedef struct cstk_link_mesh_form {
  /**
   * The link's name in the file, without a prefix.
   */
  const char *link;
  /**
   * A cstk_mesh_form.
   */
  int32_t form;
  uint32_t reserved;
} cstk_link_mesh_form;

/**
 * Options for reading a URDF file. Write it with cstk_urdf_options_default first.
 */
typedef struct cstk_urdf_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * A cstk_urdf_geometry; default CSTK_URDF_COLLISION.
   */
  int32_t geometry;
  /**
   * The joint of the root link: CSTK_JOINT_FIXED (the default), _PLANAR, _FREE or _FREE_EULER.
   */
  int32_t base;
  /**
   * The link of the builder that carries the robot, or -1 for the world.
   */
  int32_t parent;
  /**
   * 0, the default, keeps spheres, cylinders and capsules exact. 3 to 1024 replaces them by polyhedra that enclose them,
   * their circles divided into this many sides; contacts then span a cylinder's faces.
   */
  uint32_t sides;
  /**
   * The frame of the root's joint in the parent's frame: a pose of 12 doubles.
   */
  double at[12];
  /**
   * Prepended to the names of links and joints, so that a file can be loaded twice; may be NULL.
   */
  const char *prefix;
  /**
   * Folders to search for the packages of package:// names, before the URDF file's folder and those above it. Last come
   * the folders of the environment variables AMENT_PREFIX_PATH (packages lie in the folder share of each) and
   * ROS_PACKAGE_PATH (each and the folders up to 4 levels below it, known by their names).
   */
  const char *const *package_paths;
  size_t package_path_count;
  /**
   * How the links' hierarchies are built; NULL for the defaults.
   */
  const cstk_hierarchy_options *hierarchy;
  /**
   * A folder that caches the links' bodies, so that the next load builds none of them; created if it does not exist.
   * NULL, the default, for none. The key of a body is a digest of its meshes' bytes, its shapes and these options. A
   * file that is damaged, or from another version of the library, is rebuilt and replaced. Processes may share the
   * folder. Nothing is ever deleted from it. Whoever can write to it can change the robot's shapes.
   */
  const char *cache_folder;
  /**
   * Forms of links whose meshes stand for something else than mesh_form says, by name: `link_form_count` entries; NULL,
   * the default, for none. CSTK_ERROR_NOT_FOUND for a name that no link has.
   */
  const cstk_link_mesh_form *link_forms;
  size_t link_form_count;
  /**
   * A cstk_mesh_form, for all other links; default CSTK_MESH_SURFACE.
   */
  int32_t mesh_form;
  uint32_t reserved;
} cstk_urdf_options;

/**
 * What was read from a URDF file, what was built, and what was skipped.
 */
typedef struct cstk_urdf_report {
  /**
   * The number of the root link in the builder.
   */
  uint32_t root;
  /**
   * The number of `link` and of `joint` elements.
   */
  uint32_t link_count;
  uint32_t joint_count;
  /**
   * Links that have a body. A robot without any never collides.
   */
  uint32_t links_with_body;
  /**
   * Links without a body that have shapes of the kind not requested: `visual` with CSTK_URDF_COLLISION, and the reverse.
   * If it is not 0, request the other kind, or load both as two robots.
   */
  uint32_t links_with_other_shapes;
  /**
   * The number of different bodies: links with equal shapes share one.
   */
  uint32_t body_count;
  /**
   * Bodies read from the cache folder; the others were built.
   */
  uint32_t bodies_from_cache;
  /**
   * Built bodies that could not be written to the cache folder.
   */
  uint32_t cache_failures;
  /**
   * The number of shapes of all links; those of a shared body count once for each link.
   */
  uint32_t shape_count;
  uint32_t mesh_file_count;
  /**
   * Elements of the robot, its links, joints and shapes that were skipped: inertia, materials, transmissions, shapes of
   * the other kind.
   */
  uint32_t skipped_elements;
  /**
   * Bodies whose meshes are closed and became solids, where CSTK_MESH_SOLID asks for it.
   */
  uint32_t solid_body_count;
  /**
   * The number of convex primitives; those of a shared body count once.
   */
  uint64_t primitive_count;
  /**
   * Mesh faces that were not convex or not planar and were split into triangles, and those without area, which were left
   * out.
   */
  uint64_t faces_split;
  uint64_t faces_dropped;
  uint64_t reserved[6];
} cstk_urdf_report;


/**
 * Writes the default options. `size` is sizeof(cstk_urdf_options).
 */
cstk_status cstk_urdf_options_default(cstk_urdf_options *out, size_t size);

/**
 * Adds the robot of a URDF file to a builder of dimension 3: links and joints under their names, depth first, parents
 * before children, siblings in file order. The root link's number is written to `root`, which may be NULL. `urdf_options`
 * may be NULL for the defaults; `progress` may be NULL and receives the fraction of the links done; `user` is passed to
 * it.
 *
 * Joints: fixed, revolute and prismatic (with their limits), continuous, floating, planar, spherical; mimic. Shapes: box,
 * sphere, cylinder, capsule, and meshes in OBJ, STL, PLY and DAE, scaled (as by cstk_body_builder_add_mesh); the shapes of one link become
 * one body. Meshes are surfaces unless the options' mesh forms make them solids or convex hulls. A mesh file is read once, and links with equal shapes share one
 * body, and its cstk_body_set_data. Everything else in the file is skipped; cstk_robot_builder_get_urdf_report counts it.
 * Error messages name the file, the line and the element; the builder is then unchanged.
 *
 * Limits, beyond which a file is CSTK_ERROR_UNSUPPORTED: 64 MiB for the URDF file, 1 GiB for a mesh file; 2^17 links; 2^23
 * faces and 2^25 indices of faces, in one mesh file and in all bodies of the robot together, of which 2^20 faces and 2^22
 * indices may come from repeated use of a mesh or a geometry; 2^14 corners of a face, and 2^35 for the squares of the corners
 * of all faces added up, 2^31 of those repeated. In XML, 2^23 tags, 2^12 attributes of an element, 2^8 namespaces; in DAE, 2^20 nodes, transforms
 * and instances, 64 levels. Only regular files are read.
 */
cstk_status cstk_robot_builder_load_urdf(cstk_robot_builder *builder,
                                         const char *file,
                                         const cstk_urdf_options *urdf_options,
                                         cstk_progress_fn progress,
                                         void *user,
                                         uint32_t *root);

/**
 * As cstk_robot_builder_load_urdf, from a NUL-terminated text in memory, UTF-8 and at most 64 MiB: what the robot_description
 * of ROS holds. Names of meshes are relative to `folder`; where it is NULL they must be absolute, or in packages. Error
 * messages begin with "URDF text", then name line and element.
 */
cstk_status cstk_robot_builder_load_urdf_text(cstk_robot_builder *builder,
                                              const char *urdf,
                                              const char *folder,
                                              const cstk_urdf_options *urdf_options,
                                              cstk_progress_fn progress,
                                              void *user,
                                              uint32_t *root);

/**
 * Writes the report on the URDF file or text that was last added to the builder. CSTK_ERROR_EMPTY if there is none.
 */
cstk_status cstk_robot_builder_get_urdf_report(cstk_robot_builder *builder,
                                               cstk_urdf_report *out);

/** @} */

/**
 * @defgroup srdf SRDF
 *
 * What an SRDF file says of a robot: which pairs of links not to test, joint groups, named states, end effectors. It is read
 * into the builder that holds the robot's links, after its URDF file.
 *
 * @code
     uint32_t arm, home;
     cstk_joint_group group;
     cstk_robot *arm_alone = NULL;
     check(cstk_robot_builder_load_urdf(robot_builder, "arm.urdf", NULL, NULL, NULL, NULL));
     check(cstk_robot_builder_load_srdf(robot_builder, "arm.srdf", NULL));
     check(cstk_robot_build(robot_builder, &robot));
     check(cstk_robot_find_group(robot, "arm", &arm));
     check(cstk_robot_find_state(robot, "arm", "home", &home));
     check(cstk_robot_apply_state(robot, home, q, nq));
     check(cstk_robot_get_group(robot, arm, &group));
     check(cstk_robot_create_frozen(robot, group.joints, group.joint_count, q, nq, &arm_alone));
 * @endcode
 * @{
 */

/**
 * Options for reading an SRDF file. Write it with cstk_srdf_options_default first.
 */
typedef struct cstk_srdf_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * Prepended to all names of the file, also of groups, states and end effectors: the prefix that the URDF file was
   * loaded with; may be NULL.
   */
  const char *prefix;
  /**
   * Nonzero: elements that name a link, joint or group that is not there are skipped, and the report counts them (a file
   * for a robot with a hand, read for the robot without); so are virtual joints to links that are no roots. 0, the
   * default: they are refused.
   */
  uint32_t skip_unknown;
  uint32_t reserved;
} cstk_srdf_options;

/**
 * What was read from an SRDF file, and what was skipped.
 */
typedef struct cstk_srdf_report {
  /**
   * The number of elements of each kind that were read; groups inside others are not counted.
   */
  uint32_t group_count;
  uint32_t state_count;
  uint32_t end_effector_count;
  uint32_t virtual_joint_count;
  uint32_t passive_joint_count;
  /**
   * The pairs that `disable_collisions` elements name, each counted once.
   */
  uint32_t disabled_pair_count;
  /**
   * Elements of other kinds, directly in the robot or in a group.
   */
  uint32_t skipped_elements;
  /**
   * Elements that were left out since they name what is not there; see skip_unknown.
   */
  uint32_t unknown_names;
  /**
   * Values in states that are not applied: for joints that are not in the state's group, as MoveIt has it, for joints without
   * coordinates (a fixed one, or a base that was loaded with another joint), and for those whose coordinate another joint of
   * the state sets.
   */
  uint32_t unused_values;
  uint32_t reserved_number;
  uint64_t reserved[4];
} cstk_srdf_report;

/**
 * Counts of what SRDF files say of a robot.
 */
typedef struct cstk_semantics {
  uint32_t group_count;
  uint32_t state_count;
  uint32_t end_effector_count;
  uint32_t virtual_joint_count;
  /**
   * The passive joints, by the number of the link that each moves, ascending. The array belongs to the robot.
   */
  const uint32_t *passive_joints;
  size_t passive_joint_count;
  uint64_t reserved[4];
} cstk_semantics;

/**
 * A joint group. Name and arrays belong to the robot and live as long as it.
 */
typedef struct cstk_joint_group {
  const char *name;
  /**
   * The joints, by the number of the link that each moves, ascending: those named, those on chains, those of groups in
   * it; also joints that are fixed.
   */
  const uint32_t *joints;
  size_t joint_count;
  /**
   * Where their coordinates stand in q, ascending; none twice where joints share one.
   */
  const uint32_t *coordinates;
  size_t coordinate_count;
  uint64_t reserved[4];
} cstk_joint_group;

/**
 * A named state. Name and arrays belong to the robot and live as long as it.
 */
typedef struct cstk_named_state {
  const char *name;
  /**
   * The index of its group, or -1 where the file names none.
   */
  int32_t group;
  uint32_t reserved_number;
  /**
   * The coordinates that it sets, ascending, and their values.
   */
  const uint32_t *coordinates;
  const double *values;
  size_t count;
  uint64_t reserved[4];
} cstk_named_state;

/**
 * An end effector. Name and array belong to the robot and live as long as it.
 */
typedef struct cstk_end_effector {
  const char *name;
  /**
   * The index of the group of its joints.
   */
  uint32_t group;
  /**
   * The index of the arm's group, or -1 where the file names none.
   */
  int32_t parent_group;
  /**
   * The link that carries it.
   */
  uint32_t parent_link;
  uint32_t reserved_number;
  /**
   * The links with bodies that an object it holds may touch, for CSTK_CHANGE_ATTACH: those that its joints move, and the
   * parent link.
   */
  const uint32_t *touch_links;
  size_t touch_count;
  uint64_t reserved[4];
} cstk_end_effector;

/**
 * A virtual joint: how the file means the robot to be carried. What carries it is the `base` of cstk_urdf_options; its
 * joint gets this name. Names belong to the robot and live as long as it.
 */
typedef struct cstk_virtual_joint {
  const char *name;
  const char *parent_frame;
  /**
   * CSTK_JOINT_FIXED, _PLANAR or, for a floating one, _FREE.
   */
  cstk_joint_kind kind;
  /**
   * The root link.
   */
  uint32_t child_link;
  uint64_t reserved[4];
} cstk_virtual_joint;


/**
 * Writes the default options. `size` is sizeof(cstk_srdf_options).
 */
cstk_status cstk_srdf_options_default(cstk_srdf_options *out, size_t size);

/**
 * Adds what an SRDF file says to a builder that holds the robot's links, which cstk_robot_builder_load_urdf added; what
 * cstk_robot_build makes then has it. `srdf_options` may be NULL for the defaults. Read are `disable_collisions`,
 * `disable_default_collisions` and `enable_collisions` (a pair named by the first is never tested; one that only a link's
 * default rules out is tested if it is enabled), `group` (joints, links, chains, groups), `group_state`, `end_effector`,
 * `virtual_joint` and `passive_joint`; everything else is skipped and counted. Several files may be added, under different
 * prefixes. The pairs go to cstk_space_get_enabled_pairs and cstk_find_link_pairs.
 *
 * Error messages name the file, the line and the element; the builder is then unchanged. Refused are names that are not
 * there, URDF files, names with `${` (xacro that was not expanded), two groups, end effectors or states of a group with one name, groups that hold each other, a virtual joint to a link
 * that is no root, values of the wrong number. Limits, beyond which a file is CSTK_ERROR_UNSUPPORTED: 64 MiB; 2^12 groups and
 * 2^22 joints in all of them together; 2^12 states; 2^12 end effectors and 2^20 touch links in all of them; 2^8 virtual
 * joints; those of XML at cstk_robot_builder_load_urdf.
 */
cstk_status cstk_robot_builder_load_srdf(cstk_robot_builder *builder,
                                         const char *file,
                                         const cstk_srdf_options *srdf_options);

/**
 * As cstk_robot_builder_load_srdf, from a NUL-terminated text in memory, UTF-8: what the robot_description_semantic of ROS
 * holds. Error messages begin with "SRDF text".
 */
cstk_status cstk_robot_builder_load_srdf_text(cstk_robot_builder *builder,
                                              const char *srdf,
                                              const cstk_srdf_options *srdf_options);

/**
 * Writes the report on the SRDF file or text that was last added to the builder. CSTK_ERROR_EMPTY if there is none.
 */
cstk_status cstk_robot_builder_get_srdf_report(cstk_robot_builder *builder,
                                               cstk_srdf_report *out);

/**
 * Rules out a pair of links, by their names, for self-collision, as `disable_collisions` of an SRDF file does.
 * CSTK_ERROR_NOT_FOUND for a name that no link of the builder has.
 */
cstk_status cstk_robot_builder_disable_pair(cstk_robot_builder *builder,
                                            const char *r_link,
                                            const char *s_link);

/**
 * Writes the counts of what SRDF files say of the robot; all are 0 where none was read. The pairs to test are written by
 * cstk_space_get_enabled_pairs.
 */
cstk_status cstk_robot_get_semantics(const cstk_robot *robot,
                                     cstk_semantics *out);

/**
 * Writes the index of the group with this name. CSTK_ERROR_NOT_FOUND if there is none.
 */
cstk_status cstk_robot_find_group(const cstk_robot *robot, const char *name, uint32_t *out);

/**
 * Writes the index of the end effector with this name. CSTK_ERROR_NOT_FOUND if there is none.
 */
cstk_status cstk_robot_find_end_effector(const cstk_robot *robot, const char *name, uint32_t *out);

/**
 * Writes the index of the state with this name. `group` names its group; NULL for a state of which the file names none.
 * CSTK_ERROR_NOT_FOUND if there is no such group or state.
 */
cstk_status cstk_robot_find_state(const cstk_robot *robot,
                                  const char *group,
                                  const char *name,
                                  uint32_t *out);

/**
 * Writes a joint group, by its index. CSTK_ERROR_NOT_FOUND for an index that the robot does not have.
 */
cstk_status cstk_robot_get_group(const cstk_robot *robot,
                                 uint32_t group,
                                 cstk_joint_group *out);

/**
 * Writes a named state, by its index. CSTK_ERROR_NOT_FOUND for an index that the robot does not have.
 */
cstk_status cstk_robot_get_state(const cstk_robot *robot,
                                 uint32_t state,
                                 cstk_named_state *out);

/**
 * Puts the values of a named state, by its index, into the configuration q (`nq` doubles); all other coordinates of q stay
 * as they are.
 */
cstk_status cstk_robot_apply_state(const cstk_robot *robot,
                                   uint32_t state,
                                   double *q,
                                   size_t nq);

/**
 * Writes an end effector, by its index. CSTK_ERROR_NOT_FOUND for an index that the robot does not have.
 */
cstk_status cstk_robot_get_end_effector(const cstk_robot *robot,
                                        uint32_t end_effector,
                                        cstk_end_effector *out);

/**
 * Writes a virtual joint, by its index. CSTK_ERROR_NOT_FOUND for an index that the robot does not have.
 */
cstk_status cstk_robot_get_virtual_joint(const cstk_robot *robot,
                                         uint32_t virtual_joint,
                                         cstk_virtual_joint *out);

/** @} */

/**
 * @defgroup space Spaces
 *
 * A space is the C-space of one or more robots: their coordinates, the coordinates' ranges, and the world box. It offers
 * what planners need: samples, differences, steps, interpolation, limits, link poses.
 *
 * @code
     uint64_t random = 1;
     const cstk_robot *robots[1] = {robot};
     check(cstk_space_create(robots, 1, NULL, 0, NULL, &space));
     check(cstk_space_sample(space, &random, q));
 * @endcode
 * @{
 */

/**
 * The topology of a coordinate.
 */
enum cstk_range_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The circle: angles in radians, equal modulo 2 pi. The limits are ignored.
   */
  CSTK_RANGE_CIRCLE = 0,
  /**
   * The closed interval from lower to upper; either may be infinite.
   */
  CSTK_RANGE_INTERVAL = 1,
  /**
   * The joint's default: its limits; without any, a circle for angles and the whole line for lengths.
   */
  CSTK_RANGE_DEFAULT = 2,
  /**
   * One of the four entries of a unit quaternion: the only range of the coordinates of such joints.
   */
  CSTK_RANGE_QUATERNION = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_range_kind cstk_range_kind;
#else
typedef int32_t cstk_range_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The C-space of one or more robots. Immutable; threads may share it. It keeps references to its robots.
 */
typedef struct cstk_space cstk_space;

/**
 * The range of a coordinate.
 */
typedef struct cstk_range {
  /**
   * A cstk_range_kind.
   */
  int32_t kind;
  uint32_t reserved;
  double lower;
  double upper;
} cstk_range;

/**
 * The first link, coordinate and velocity of a robot in a space.
 */
typedef struct cstk_space_offset {
  uint32_t link;
  uint32_t coordinate;
  uint32_t velocity;
  uint32_t reserved;
} cstk_space_offset;


/**
 * Creates the C-space of `robot_count` robots. Links and coordinates are numbered through all robots, in the order given.
 *
 * `ranges` holds one range per coordinate, or is NULL with `range_count` 0 for all defaults; see cstk_range_kind. A range
 * of one value freezes its coordinate. `world_box` holds low x, y, z, high x, y, z: bounds for the links' origins; NULL
 * for none. Ranges and box limit slides and cstk_space_contains; other queries answer anywhere. Robots of dimension 2 make
 * a planar world, of dimension 3 a spatial one (the report's make-c-space-planar-world and make-c-space-3d-world).
 */
cstk_status cstk_space_create(const cstk_robot *const *robots,
                              size_t robot_count,
                              const cstk_range *ranges,
                              size_t range_count,
                              const double *world_box,
                              cstk_space **out);

/**
 * Adds a reference.
 */
cstk_status cstk_space_retain(cstk_space *space);

/**
 * Drops a reference. NULL is a no-op. C-objects hold a reference to their space.
 */
cstk_status cstk_space_release(cstk_space *space);

/**
 * Writes the number of entries of a configuration (nq), of a velocity or gradient (nv), and of links; each output may be
 * NULL.
 */
cstk_status cstk_space_get_size(const cstk_space *space,
                                size_t *nq,
                                size_t *nv,
                                size_t *link_count);

/**
 * Writes the name of a link, by number in the space; see cstk_robot_get_link_name.
 */
cstk_status cstk_space_get_link_name(const cstk_space *space,
                                     uint32_t link,
                                     char *buffer,
                                     size_t capacity,
                                     size_t *length);

/**
 * Writes the number of the link with this name. CSTK_ERROR_NOT_FOUND if there is none; CSTK_ERROR_INVALID_ARGUMENT if several robots
 * of the space have one: see cstk_robot_find_link and cstk_space_get_offset then.
 */
cstk_status cstk_space_find_link(const cstk_space *space,
                                 const char *name,
                                 uint32_t *out);

/**
 * Writes where the links, coordinates and velocities of the space's `robot`-th robot begin: add them to the robot's own
 * numbers. Robots are counted from 0.
 */
cstk_status cstk_space_get_offset(const cstk_space *space,
                                  size_t robot,
                                  cstk_space_offset *out);

/**
 * Writes the range of a coordinate; its kind is never CSTK_RANGE_DEFAULT.
 */
cstk_status cstk_space_get_range(const cstk_space *space,
                                 size_t coordinate,
                                 cstk_range *out);

/**
 * Writes whether every coordinate of q is in its range and every link's origin in the world box.
 */
cstk_status cstk_space_contains(const cstk_space *space,
                                const double *q,
                                size_t nq,
                                bool *out);

/**
 * Writes whether every coordinate of q is in its range, and to `coordinate`, which may be NULL, the first that is not
 * (CSTK_NONE if all are).
 */
cstk_status cstk_space_within_limits(const cstk_space *space,
                                     const double *q,
                                     size_t nq,
                                     bool *out,
                                     uint32_t *coordinate);

/**
 * Writes whether the origin of every link is in the world box at q, and to `link`, which may be NULL, the first that is
 * not (CSTK_NONE if all are).
 */
cstk_status cstk_space_within_world(const cstk_space *space,
                                    const double *q,
                                    size_t nq,
                                    bool *out,
                                    uint32_t *link);

/**
 * Writes the poses of all links at q, in the world: 12 doubles for each link of the space.
 */
cstk_status cstk_space_link_poses(const cstk_space *space,
                                  const double *q,
                                  size_t nq,
                                  double *poses);

/**
 * Writes the basic Jacobian (eq. 33) at q of a point fixed to a link of the space; as cstk_robot_jacobian, with the
 * space's nv.
 */
cstk_status cstk_space_jacobian(const cstk_space *space,
                                const double *q,
                                size_t nq,
                                uint32_t link,
                                const double *point,
                                double *jacobian);

/**
 * Writes the neutral configuration, nq doubles: all coordinates 0, and identity quaternions 0, 0, 0, 1. It may be out of
 * range.
 */
cstk_status cstk_space_get_neutral(const cstk_space *space,
                                   double *q);

/**
 * Writes the configuration reached from `q` with velocity `v` (`nv` doubles) after a unit of time: straight for intervals
 * and circles (which are not wrapped), at constant angular velocity for quaternions, along a screw for free joints. `out`
 * has `nq` doubles and may be `q`.
 */
cstk_status cstk_space_step(const cstk_space *space,
                            const double *q,
                            size_t nq,
                            const double *v,
                            size_t nv,
                            double *out);

/**
 * Writes the smallest velocity that leads from `q0` to `q1` in a unit of time, nv doubles: circles go the shorter way
 * round (opposite angles the way of q1 - q0), quaternions turn by at most half a turn. From q1 to q0 it is the same way back, on
 * circles to the last bit.
 */
cstk_status cstk_space_difference(const cstk_space *space,
                                  const double *q0,
                                  const double *q1,
                                  size_t nq,
                                  double *v);

/**
 * Writes the configuration at parameter `t` of the way from `q0` (t = 0) to `q1` (t = 1) at the constant velocity of
 * cstk_space_difference; `t` may lie outside [0, 1]. `out` has `nq` doubles and may be `q0` or `q1`. Free joints follow a
 * screw: their origin does not move straight, but where one of its coordinates does, that one stays between its ends. See
 * cstk_space_distance.
 */
cstk_status cstk_space_interpolate(const cstk_space *space,
                                   const double *q0,
                                   const double *q1,
                                   size_t nq,
                                   double t,
                                   double *out);

/**
 * Writes the length of the difference of two configurations, each velocity multiplied by its weight: `weights` has nv
 * doubles, none negative, or is NULL for 1 each. It is a metric, except with free joints, or with unequal weights of a
 * spherical joint: there the triangle inequality fails. For planning trees use a chain of prismatic x, y, z and a
 * spherical joint instead, which translates straight and rotates separately.
 */
cstk_status cstk_space_distance(const cstk_space *space,
                                const double *q0,
                                const double *q1,
                                size_t nq,
                                const double *weights,
                                double *out);

/**
 * cstk_space_distance from `q` to each of `count` configurations: `others` has count * nq doubles, one configuration after the
 * other, and `distances` receives `count` doubles. So a planner finds the nearest nodes of its tree in few calls. The message names
 * the first of `others` that is no configuration, and nothing is written then.
 */
cstk_status cstk_space_distances(const cstk_space *space,
                                 const double *q,
                                 const double *others,
                                 size_t count,
                                 size_t nq,
                                 const double *weights,
                                 double *distances);

/**
 * Writes a configuration drawn uniformly from the coordinates' ranges, and uniformly from the rotations for quaternions.
 * `state` is the state of the random number generator: any number to begin with; each call advances it. Equal states give
 * equal configurations, on every machine. CSTK_ERROR_UNSUPPORTED, naming the coordinate, where a range is unbounded.
 */
cstk_status cstk_space_sample(const cstk_space *space,
                              uint64_t *state,
                              double *q);

/**
 * Writes the nearest configuration with all coordinates in range; quaternions are normalized. `out` has `nq` doubles and
 * may be `q`.
 */
cstk_status cstk_space_clamp(const cstk_space *space,
                             const double *q,
                             size_t nq,
                             double *out);

/**
 * Writes the same configuration with circles in [0, 2 pi), as in §4.4, and unit quaternions with w >= 0. `out` has `nq`
 * doubles and may be `q`.
 */
cstk_status cstk_space_wrap(const cstk_space *space,
                            const double *q,
                            size_t nq,
                            double *out);

/**
 * Writes all pairs of links with bodies but those that SRDF files (or cstk_robot_builder_disable_pair) rule out, as
 * cstk_cobject_induced_links takes them: at most `max_count` pairs of two link numbers each to `pairs` (NULL if `max_count`
 * is 0), and their full number to `count`. Links of different robots are all paired. Nothing is sampled: where no SRDF file
 * was read joined links are among the pairs; cstk_find_link_pairs finds those.
 */
cstk_status cstk_space_get_enabled_pairs(const cstk_space *space,
                                         size_t max_count,
                                         uint32_t *pairs,
                                         size_t *count);

/** @} */

/**
 * @defgroup environment Environments
 *
 * An environment holds s-objects, the obstacles: bodies at poses. Changes are applied together or not at all, while other
 * threads query: a query sees the state before or after, never between. Objects can be attached to links.
 *
 * @code
     cstk_environment_change table;
     uint64_t id;
     check(cstk_environment_change_default(&table, sizeof table));
     table.kind = CSTK_CHANGE_ADD;
     table.body = body;
     check(cstk_environment_apply(environment, &table, 1, &id, NULL));
 * @endcode
 * @{
 */

/**
 * The kinds of changes.
 */
enum cstk_change_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Adds `body` at `pose`; the new object's id is an output of cstk_environment_apply.
   */
  CSTK_CHANGE_ADD = 0,
  /**
   * Moves object `id` to `pose`; an attached object is detached.
   */
  CSTK_CHANGE_MOVE = 1,
  /**
   * Deletes object `id`.
   */
  CSTK_CHANGE_DELETE = 2,
  /**
   * Attaches object `id` to `link` of `space` at `pose`, in the link's frame: a grasp. Nothing is rebuilt. To grasp an
   * object where it is, pass the inverse of the link's pose composed with the object's pose. To release it in place, use
   * CSTK_CHANGE_MOVE with the link's pose composed with `pose`. Attaching an attached object changes its pose or its
   * touch links.
   */
  CSTK_CHANGE_ATTACH = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_change_kind cstk_change_kind;
#else
typedef int32_t cstk_change_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * A set of s-objects. It may be changed while other threads query it: each query sees one consistent state. It keeps
 * references to the bodies of its objects.
 */
typedef struct cstk_environment cstk_environment;

/**
 * A change of an environment. Write it with cstk_environment_change_default first: an addition at the world's origin.
 */
typedef struct cstk_environment_change {
  uint32_t size;
  uint32_t cookie;
  /**
   * A cstk_change_kind.
   */
  int32_t kind;
  uint32_t reserved;
  /**
   * The object to move, delete or attach.
   */
  uint64_t id;
  /**
   * The body to add.
   */
  const cstk_body *body;
  /**
   * The body's frame, 12 doubles: in the world, for CSTK_CHANGE_ATTACH in the link's frame.
   */
  double pose[12];
  /**
   * For CSTK_CHANGE_ATTACH: the space, and the number of the link that holds the object. The object moves with the link. Given
   * with CSTK_CHANGE_ADD, the new object comes attached, `pose` then in the link's frame.
   * Queries in other spaces on sets that include the object fail with CSTK_ERROR_UNSUPPORTED, since its pose is unknown
   * there. In a set of links against s-objects, it is tested against the other s-objects as the link itself is
   * (`r_object` of a witness names it); and as an s-object against the links, except the link that holds it and the
   * `touch_count` links in `touch_links` (the fingers, say). Those may touch it only while it is attached: for approach
   * and retreat create a second set with `allowed` of cstk_induced_options. It is tested against other objects that its
   * touch links hold, not against those that its own link holds.
   */
  const cstk_space *space;
  const uint32_t *touch_links;
  uint32_t link;
  uint32_t touch_count;
  /**
   * For CSTK_CHANGE_ADD: user data, returned with witnesses. `destroy` may be NULL; it is called once, by the thread
   * that drops the last state that holds the object, and not if the change fails.
   */
  void *data;
  cstk_destroy_fn destroy;
  /**
   * For CSTK_CHANGE_ADD: the object's name, UTF-8, which is copied; NULL or empty for none. Several objects may have one name.
   */
  const char *name;
} cstk_environment_change;

/**
 * The state of an s-object.
 */
typedef struct cstk_object_info {
  uint64_t id;
  /**
   * In the world, or, for an attached object, in the link's frame.
   */
  double pose[12];
  /**
   * The link that it is attached to, by number in the space it was attached with; CSTK_NONE if it is not attached.
   */
  uint32_t link;
  /**
   * The number of other links that may touch it while it is attached.
   */
  uint32_t touch_count;
  /**
   * Its user data, or its body's if it has none, or NULL.
   */
  void *data;
  uint64_t reserved[8];
} cstk_object_info;

/**
 * Options for reading a planning scene. Write it with cstk_scene_options_default first.
 */
typedef struct cstk_scene_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * Where the scene's frame is in the world: a pose of 12 doubles.
   */
  double at[12];
  /**
   * How the objects' hierarchies are built; NULL for the defaults.
   */
  const cstk_hierarchy_options *hierarchy;
  /**
   * A cstk_mesh_form, for all meshes; default CSTK_MESH_SURFACE.
   */
  int32_t mesh_form;
  uint32_t reserved;
} cstk_scene_options;


/**
 * Creates an empty environment.
 */
cstk_status cstk_environment_create(cstk_environment **out);

/**
 * Adds a reference.
 */
cstk_status cstk_environment_retain(cstk_environment *environment);

/**
 * Drops a reference. NULL is a no-op. C-objects hold references to their environments.
 */
cstk_status cstk_environment_release(cstk_environment *environment);

/**
 * Writes the default change. `size` is sizeof(cstk_environment_change).
 */
cstk_status cstk_environment_change_default(cstk_environment_change *out, size_t size);

/**
 * Applies `count` changes together: all of them or, on failure, none. `ids` receives the id of the object of each change
 * (`count` entries, or NULL); `version` the environment's new version (or NULL). Ids are never reused, and are unique in
 * the process. All changes have the size of the first.
 *
 * A change takes some microseconds, whatever the number of objects, and much less when many are applied in one call: the
 * bounding volumes above objects that stay near are refitted in one pass. After changes of at least a sixteenth of the
 * objects the tree over all objects may be rebuilt (some microseconds an object). Meanwhile other threads that apply
 * changes wait; queries never do. The environment keeps the memory of the state before the last change for the next
 * change; if a query or a snapshot still holds that state, the changed parts are copied.
 *
 * CSTK_ERROR_NOT_FOUND for an unknown or deleted id, CSTK_ERROR_UNSUPPORTED for a snapshot.
 */
cstk_status cstk_environment_apply(cstk_environment *environment,
                                   const cstk_environment_change *changes,
                                   size_t count,
                                   uint64_t *ids,
                                   uint64_t *version);

/**
 * Creates a snapshot: an environment that stays as this one is now. It can be used wherever an environment can, but not
 * changed.
 */
cstk_status cstk_environment_snapshot(const cstk_environment *environment,
                                      cstk_environment **out);

/**
 * Writes the number of objects and the version, which counts the successful calls of cstk_environment_apply; either may be
 * NULL.
 */
cstk_status cstk_environment_get_state(const cstk_environment *environment,
                                       size_t *object_count,
                                       uint64_t *version);

/**
 * Writes the ids of the objects in the order in which they were added: at most `max_count` to `ids` (NULL if `max_count`
 * is 0), and their full number to `count`.
 */
cstk_status cstk_environment_get_objects(const cstk_environment *environment,
                                         size_t max_count,
                                         uint64_t *ids,
                                         size_t *count);

/**
 * Writes the pose, the attachment and the data of an s-object. CSTK_ERROR_NOT_FOUND for an unknown or deleted id.
 */
cstk_status cstk_environment_get_object_info(const cstk_environment *environment,
                                             uint64_t id,
                                             cstk_object_info *out);

/**
 * Writes the name of an s-object, empty if it has none: see cstk_robot_get_link_name for the buffer. CSTK_ERROR_NOT_FOUND for an
 * unknown or deleted id.
 */
cstk_status cstk_environment_get_object_name(const cstk_environment *environment,
                                             uint64_t id,
                                             char *buffer,
                                             size_t capacity,
                                             size_t *length);

/**
 * Writes the id of the s-object with this name; of several the one that was added first. It looks at one object after the other.
 * CSTK_ERROR_NOT_FOUND if there is none.
 */
cstk_status cstk_environment_find_object(const cstk_environment *environment,
                                         const char *name,
                                         uint64_t *out);

/**
 * Writes the pose (12 doubles) of an s-object: in the world, or in the frame of the link that it is attached to (see
 * cstk_environment_get_object_info). CSTK_ERROR_NOT_FOUND for an unknown or deleted id.
 */
cstk_status cstk_environment_get_object_pose(const cstk_environment *environment,
                                             uint64_t id,
                                             double *pose);

/**
 * Writes the default options. `size` is sizeof(cstk_scene_options).
 */
cstk_status cstk_scene_options_default(cstk_scene_options *out, size_t size);

/**
 * Adds the objects of a MoveIt planning scene, a `.scene` file (the text that MoveIt exports, of either version), to an
 * environment: all of them in one change, or none. Each object becomes one s-object: boxes, spheres, cylinders, cones and
 * meshes at their poses, one body. The scene ends at the word `.`; text after it is not read. Its user data (`s_data` of a witness) is its name, a NUL-terminated string that lives as
 * long as the object. Colours and subframes are skipped. The ids are written in the order of the file: at most `max_count` to
 * `ids` (NULL if `max_count` is 0), and their full number to `count`, which may be NULL. `scene_options` may be NULL.
 *
 * Error messages name the file, the line and the object. Refused are unknown shapes, planes (they have no end; see
 * cstk_cobject_below_floor), objects without shapes, two objects of one name. Limits, beyond which a file is
 * CSTK_ERROR_UNSUPPORTED: 1 GiB, 2^17 shapes, 2^23 triangles.
 */
cstk_status cstk_environment_load_scene(cstk_environment *environment,
                                        const char *file,
                                        const cstk_scene_options *scene_options,
                                        size_t max_count,
                                        uint64_t *ids,
                                        size_t *count);

/**
 * As cstk_environment_load_scene, from a NUL-terminated text in memory, UTF-8. Error messages begin with "scene text".
 */
cstk_status cstk_environment_load_scene_text(cstk_environment *environment,
                                             const char *scene,
                                             const cstk_scene_options *scene_options,
                                             size_t max_count,
                                             uint64_t *ids,
                                             size_t *count);

/** @} */

/**
 * @defgroup octree Octrees
 *
 * An octree holds which cells of a grid are occupied: what a depth camera maps. Its cells are changed one by one or many
 * together, also while it is placed in an environment: only the objects around them are replaced, in one change, so that a
 * query sees the cells before it or after it. It is read from OctoMap's files, and gives a body where it need not change.
 *
 * @code
     const double seen[6] = {1.52, 0.33, 0.71, 1.52, 0.38, 0.71}, vanished[3] = {0.97, 0.12, 0.05};
     cstk_octree *map;
     check(cstk_octree_load("room.bt", 0.5, &map));
     check(cstk_octree_place(map, environment, pose_a, NULL, NULL));
     check(cstk_octree_set(map, seen, 2, true, NULL));
     check(cstk_octree_set(map, vanished, 1, false, NULL));
     check(cstk_octree_release(map));
 * @endcode
 * @{
 */

/**
 * Which cells of a grid are occupied. Serves one call at a time; another call meanwhile is CSTK_ERROR_BUSY. Queries on the
 * environment that it is placed in may run at any time.
 */
typedef struct cstk_octree cstk_octree;


/**
 * Creates an octree without occupied cells. Cell (i, j, k) reaches from i to i + 1 times `resolution` along x, and so on, in
 * the octree's frame, for whole numbers from -2^15 to 2^15 - 1: the grid of an OcTree of OctoMap with 16 levels.
 * CSTK_ERROR_INVALID_ARGUMENT, CSTK_ERROR_NOT_FINITE for a resolution that is not positive or finite, or whose grid would
 * pass 1e50.
 */
cstk_status cstk_octree_create(double resolution,
                               cstk_octree **out);

/**
 * Reads an octree from a file of OctoMap's: .bt, whose leaves are occupied or free, or .ot (of kind OcTree, OcTreeStamped or
 * ColorOcTree), whose leaves are occupied if their probability is at least `min_occupancy` (between 0 and 1; OctoMap takes
 * .5). What is free or unknown is empty. Which of both a file is, its first line tells.
 *
 * CSTK_ERROR_PARSE for a file that is no such file, truncated, longer than its nodes, deeper than 16 levels, or of another
 * number of nodes than it says; CSTK_ERROR_NOT_FINITE for an occupancy that is NaN; CSTK_ERROR_UNSUPPORTED for another kind
 * of tree, above 1 GiB, or above 2^24 inner nodes. The message names the line or the node.
 */
cstk_status cstk_octree_load(const char *file,
                             double min_occupancy,
                             cstk_octree **out);

/**
 * Adds a reference.
 */
cstk_status cstk_octree_retain(cstk_octree *octree);

/**
 * Drops a reference. NULL is a no-op. The objects of an octree that is placed stay in the environment as they are when the
 * last reference goes: cstk_octree_remove takes them out before.
 */
cstk_status cstk_octree_release(cstk_octree *octree);

/**
 * Makes the cells around `point_count` points (three doubles each, in the octree's frame) occupied, or empty. A point between
 * two cells belongs to the upper one. `changed` receives the number of cells that were not so before, or is NULL.
 *
 * Where the octree is placed, the environment changes once, by the objects around the changed cells: each holds 4 x 4 x 4
 * cells, or a larger cube of occupied cells. The time is that of these objects' bodies, and does not depend on how
 * many other cells there are, but for the upkeep of the environment's tree (see cstk_environment_apply).
 * CSTK_ERROR_NOT_FINITE or CSTK_ERROR_INVALID_ARGUMENT for a point that is not finite or beyond the grid, with its number;
 * CSTK_ERROR_UNSUPPORTED above 2^24 inner nodes. Nothing has changed then.
 */
cstk_status cstk_octree_set(cstk_octree *octree,
                            const double *xyz,
                            size_t point_count,
                            bool occupied,
                            size_t *changed);

/**
 * Writes to `occupied` (`point_count` entries) whether the cells around points are occupied. Errors as of cstk_octree_set.
 */
cstk_status cstk_octree_get(const cstk_octree *octree,
                            const double *xyz,
                            size_t point_count,
                            bool *occupied);

/**
 * Makes the cells that are occupied in `other` occupied. CSTK_ERROR_INVALID_ARGUMENT if the resolutions differ. The
 * environment follows as after cstk_octree_set.
 */
cstk_status cstk_octree_insert(cstk_octree *octree,
                               const cstk_octree *other);

/**
 * Writes the edge of a cell, the number of occupied cells, and the number of objects that the octree is in its environment;
 * each may be NULL.
 */
cstk_status cstk_octree_get_state(const cstk_octree *octree,
                                  double *resolution,
                                  uint64_t *cell_count,
                                  size_t *object_count);

/**
 * Writes the occupied cells as cubes: eight cells, or cubes, that fill a cube of the octree are one. Four doubles each, the
 * lowest corner and the edge: at most `max_count` cubes to `cubes` (NULL if `max_count` is 0), and their full number to
 * `count`. Equal cells have equal cubes in equal order, however they became so.
 */
cstk_status cstk_octree_get_cubes(const cstk_octree *octree,
                                  size_t max_count,
                                  double *cubes,
                                  size_t *count);

/**
 * Builds a body of the occupied cells, in the octree's frame: each cube of cstk_octree_get_cubes is a solid box, tagged with
 * its number. It does not change any more, and may be a link or a part as any body. `options` may be NULL; `progress` may be
 * NULL; `user` is passed to it. CSTK_ERROR_EMPTY if no cell is occupied, CSTK_ERROR_UNSUPPORTED above 2^22 cubes.
 */
cstk_status cstk_octree_build_body(const cstk_octree *octree,
                                   const cstk_hierarchy_options *options,
                                   cstk_progress_fn progress,
                                   void *user,
                                   cstk_body **out);

/**
 * Places the octree in an environment, its frame at `pose` (12 doubles), in one change. From now on changes of cells change
 * the environment too. It can be in one environment at a time: CSTK_ERROR_INVALID_ARGUMENT if it is in one.
 *
 * To queries the octree is several s-objects, which cover its occupied cells and are as exact as boxes; their ids change with
 * the cells. All have the user data `data`, so that the `s_data` of a witness names the octree. `destroy` may be NULL; it is
 * called once, by the thread that drops the last state that holds an object, and not if this call fails; it must not call
 * the octree. A C-object that is to be about the octree alone takes all objects of an environment that holds nothing else.
 * Do not move, attach or delete the objects one by one; those that are gone are not missed.
 *
 * The objects stand at rounded places. So that there is no gap between them, each reaches over its neighbours by up to 2e-15 L, where L
 * is how far it is from the octree's origin and that from the world's together; distances may be too small by twice that.
 *
 * CSTK_ERROR_UNSUPPORTED for a snapshot.
 */
cstk_status cstk_octree_place(cstk_octree *octree,
                              cstk_environment *environment,
                              const double *pose,
                              void *data,
                              cstk_destroy_fn destroy);

/**
 * Moves an octree within its environment, in one change. Its objects keep their ids, but for those that get so much farther from
 * the world's origin, or nearer to it, that they must reach over their neighbours by more or by less. CSTK_ERROR_NOT_FOUND if
 * the octree is in none.
 */
cstk_status cstk_octree_move(cstk_octree *octree,
                             const double *pose);

/**
 * Takes an octree out of its environment, in one change; its cells stay. A no-op if it is in none.
 */
cstk_status cstk_octree_remove(cstk_octree *octree);

/** @} */

/**
 * @defgroup cobject C-objects
 *
 * A C-object is a set in a space (§2.1.3). Induced sets hold all q at which links meet obstacles or each other; pure sets
 * are given by coordinates or by callbacks; unions, intersections, complements and differences combine other sets.
 *
 * @code
     cstk_cobject *obstacles, *limits, *forbidden;
     check(cstk_cobject_induced(space, NULL, 0, environment, NULL, 0, NULL, &obstacles));
     cstk_pure_options in_lengths;
     check(cstk_pure_options_default(&in_lengths, sizeof in_lengths));
     in_lengths.scale = 1.0; // so that distances from the limits compare with those of links
     check(cstk_cobject_beyond_limits(space, &in_lengths, &limits));
     const cstk_cobject *parts[2] = {obstacles, limits};
     check(cstk_cobject_union(parts, 2, &forbidden));
 * @endcode
 * @{
 */

/**
 * A set in C-space: induced by contact or interference of links with s-objects or links, given by coordinates, or combined
 * from others. Immutable (except for the environments it refers to); threads may share it. It keeps references to its
 * space and environments.
 */
typedef struct cstk_cobject cstk_cobject;

/**
 * A pair that may meet: a link, or an s-object attached to it, and an s-object.
 */
typedef struct cstk_allowed_pair {
  /**
   * A link, by number in the space.
   */
  uint32_t link;
  uint32_t reserved;
  /**
   * The s-object attached to the link that may meet `object`, or 0 for the link's own body.
   */
  uint64_t attached;
  /**
   * The s-object that it may meet.
   */
  uint64_t object;
} cstk_allowed_pair;

/**
 * Options of an induced C-object. Write it with cstk_induced_options_default first.
 */
struct cstk_induced_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * Distances above 0 and up to this classify as CSTK_CLASS_CONTACT. Default 0.
   */
  double contact_epsilon;
  /**
   * Grows the s-objects by this length: it is subtracted from every distance, so that configurations nearer than the
   * margin are inside. Points and normals remain those of the real surfaces. Default 0.
   */
  double margin;
  /**
   * Pairs that may meet, left out of a set of links against s-objects: `allowed_count` entries; NULL, the default, for
   * none. Ids are not checked: an object may be added later. Sets are cheap to create; to allow other pairs, create
   * another one.
   */
  const cstk_allowed_pair *allowed;
  size_t allowed_count;
  /**
   * 1 leaves out, of a set of links against s-objects, the pairs of bodies that no coordinate moves: the base and the table
   * that it stands on, which else is always the nearest, with a gradient of 0. Whether the robot meets its surroundings where it
   * stands is then not asked; what is held is tested against the base, and all else. Default 0.
   */
  uint32_t leave_out_unmoved;
  uint32_t reserved;
};

/**
 * Writes the class of configuration q (`nq` doubles), a cstk_class. Returns CSTK_OK, or anything else to make the query
 * fail with CSTK_ERROR_CALLBACK_FAILED.
 */
typedef int32_t (*cstk_predicate_class_fn)(const double *q, size_t nq, int32_t *out, void *user);

/**
 * Writes the signed distance of q from the set, in C-space units: positive where the class is not CSTK_CLASS_INSIDE,
 * otherwise 0 or minus the depth.
 */
typedef int32_t (*cstk_predicate_distance_fn)(const double *q, size_t nq, double *out, void *user);

/**
 * Writes the derivative of that distance to `row`: `nv` doubles, one per velocity of cstk_space_step.
 */
typedef int32_t (*cstk_predicate_gradient_fn)(const double *q,
                                              size_t nq,
                                              double *row,
                                              size_t nv,
                                              void *user);

/**
 * A set defined by callbacks. Write it with cstk_predicate_default first. The functions are called from any thread that
 * queries the set, concurrently, and from within queries; they must be pure, must not throw, and must not call back into
 * the running query. Slides refuse sets with predicates. Results are checked: a number that is not finite, an unknown
 * class, or a distance that contradicts the class is CSTK_ERROR_CALLBACK_FAILED.
 */
typedef struct cstk_predicate {
  uint32_t size;
  uint32_t cookie;
  /**
   * Must be set. It alone decides what is in contact; contact_epsilon of the options is ignored.
   */
  cstk_predicate_class_fn classify;
  /**
   * May be NULL: then distances are unknown outside the set (CSTK_DISTANCE_LOWER_BOUND, from 0), as are distances from
   * its complement where the class is not CSTK_CLASS_OUTSIDE, and the set has witnesses only where it holds q. Distances
   * are at most 1e50.
   */
  cstk_predicate_distance_fn distance;
  /**
   * May be NULL: then cstk_gradients and cstk_pseudo_normal are CSTK_ERROR_UNSUPPORTED within epsilon of the set. If
   * `distance` is NULL too, the set has no gradients: no witness outside, one without a contact inside.
   */
  cstk_predicate_gradient_fn gradient;
  /**
   * Passed to the functions.
   */
  void *user;
  /**
   * May be NULL. Called once, by the thread that drops the last reference to whatever uses the functions.
   */
  cstk_destroy_fn destroy;
  /**
   * 1 if the distance function gives lower bounds outside the set, 0 (the default) if it gives distances.
   */
  uint32_t distance_is_bound;
  /**
   * 1 if the distance function gives minus the depth inside (the exact distance from the complement). Default 0: what it gives
   * below 0 then counts as 0.
   */
  uint32_t knows_depth;
} cstk_predicate;

/**
 * Options of a pure set. Write it with cstk_pure_options_default first.
 */
typedef struct cstk_pure_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * Distances above 0 and up to this classify as CSTK_CLASS_CONTACT; in C-space units, for floors and the world box in
   * lengths. Default 0.
   */
  double contact_epsilon;
  /**
   * The length that a C-space unit stands for. Distances of the set are multiplied by it, which makes them comparable
   * with those of induced sets. With 0, the default, they are not comparable, and distance queries on a set that mixes
   * both are refused.
   */
  double scale;
} cstk_pure_options;


/**
 * Writes the default options. `size` is sizeof(cstk_induced_options).
 */
cstk_status cstk_induced_options_default(cstk_induced_options *out, size_t size);

/**
 * Creates the set of configurations at which a link meets an s-object.
 *
 * `links` holds `link_count` link numbers of the space; `link_count` 0 means all links (CSTK_ERROR_EMPTY if none has a
 * body). That includes links that no joint moves, such as a base: their gradients are 0, and they may always be the
 * nearest. Objects attached to these links are tested with them (see CSTK_CHANGE_ATTACH): a frame without a body, such as
 * a tool frame, must be among `links` for that. The robot is not tested against itself; see cstk_cobject_induced_links.
 * `ids` holds `id_count` ids of objects of the environment; `id_count` 0 means all its objects, including those added
 * later. An object that is deleted later contributes nothing. An object of another dimension than the robots makes queries
 * fail. `options` may be NULL for the defaults.
 */
cstk_status cstk_cobject_induced(const cstk_space *space,
                                 const uint32_t *links,
                                 size_t link_count,
                                 const cstk_environment *environment,
                                 const uint64_t *ids,
                                 size_t id_count,
                                 const cstk_induced_options *options,
                                 cstk_cobject **out);

/**
 * Creates the set of configurations at which the two links of some pair meet: one robot with itself, or robots with each
 * other. `pairs` holds 2 * `pair_count` link numbers; the second of a pair is the nominal s-object. Joined links touch at
 * every configuration: leave such pairs out (see cstk_find_link_pairs). Without any pair the set is empty. CSTK_ERROR_EMPTY for a
 * link without a body.
 */
cstk_status cstk_cobject_induced_links(const cstk_space *space,
                                       const uint32_t *pairs,
                                       size_t pair_count,
                                       const cstk_induced_options *options,
                                       cstk_cobject **out);

/**
 * Writes a reference to the space that the set is in, to be released with cstk_space_release.
 */
cstk_status cstk_cobject_get_space(const cstk_cobject *cobject, cstk_space **out);

/**
 * Adds a reference.
 */
cstk_status cstk_cobject_retain(cstk_cobject *cobject);

/**
 * Drops a reference. NULL is a no-op.
 */
cstk_status cstk_cobject_release(cstk_cobject *cobject);

/**
 * Creates the union of `count` C-objects of one space: its class is the largest of theirs. It keeps references to its
 * parts. A body pair that several induced parts hold in the same state counts once, with the largest margin; a pair of links in one
 * part and the same two the other way round in another are two pairs.
 *
 * Sets of any kind may be combined, to a depth of 256 (a union in a union adds no level). A union may be grown one part at
 * a time: each call takes time in proportion to `count`, the first query of the result in proportion to all parts. All
 * queries on a union of induced sets are exact; for other compounds cstk_distance reports what is known:
 * - a union is as near as its nearest part;
 * - an intersection is no nearer than its farthest part: CSTK_DISTANCE_LOWER_BOUND, except for 0 where all parts are 0;
 * - a complement is moved down to the leaves, by De Morgan's laws. The distance from the complement of a pure set (other
 *   than a predicate) is exact; from that of an induced set it is 0 where nothing meets, otherwise unknown:
 *   CSTK_DISTANCE_LOWER_BOUND, from 0.
 *
 * cstk_within(t) is true where the lower bound is at most t. (Where surfaces are refined, see cstk_query_set_refinement, it may also be
 * false within `gap` of that: it has proved a higher bound.) cstk_witnesses and cstk_gradients list every pair of every induced leaf
 * within epsilon, and every pure leaf (or its complement), whatever the tree combines them to; rows are the
 * derivatives of those distances. Complements and the sets beyond limits are open: on their boundary the distance is 0,
 * but the class is not CSTK_CLASS_INSIDE. Lengths and C-space units are not compared: CSTK_ERROR_UNSUPPORTED for distances
 * where a pure set without a scale is combined with an induced one.
 */
cstk_status cstk_cobject_union(const cstk_cobject *const *parts,
                               size_t count,
                               cstk_cobject **out);

/**
 * Creates the intersection of `count` C-objects of one space: its class is the smallest of theirs. See cstk_cobject_union.
 */
cstk_status cstk_cobject_intersection(const cstk_cobject *const *parts,
                                      size_t count,
                                      cstk_cobject **out);

/**
 * Creates the complement of a C-object: it exchanges CSTK_CLASS_INSIDE and CSTK_CLASS_OUTSIDE; contact stays. Bodies that state a
 * deviation (cstk_body_builder_set_deviation) count as apart in it. See
 * cstk_cobject_union.
 */
cstk_status cstk_cobject_complement(const cstk_cobject *part,
                                    cstk_cobject **out);

/**
 * Creates the difference `of` without `without`: the intersection of `of` with the complement of `without`. See
 * cstk_cobject_union.
 */
cstk_status cstk_cobject_difference(const cstk_cobject *of,
                                    const cstk_cobject *without,
                                    cstk_cobject **out);

/**
 * Creates a copy of a set with user data attached (§2.2.3), under a new number. Witnesses, distances and explanations of
 * every C-object that has the copy as a leaf return `data`. `destroy` may be NULL; it is called once, by the thread that
 * drops the last reference to whatever carries the data, and not if this call fails.
 */
cstk_status cstk_cobject_with_data(const cstk_cobject *cobject,
                                   void *data,
                                   cstk_destroy_fn destroy,
                                   cstk_cobject **out);

/**
 * Creates a copy of an induced or pure set with its own shell for cstk_slide: its contacts constrain a step within `shell`
 * instead of `max_shell` of the slide's options, and the desired distance scales with it: one of a tenth of max_shell
 * becomes a tenth of `shell`. The links of a robot are mostly near each other, so a self-collision set with a shell of one
 * or two steps' motion, in a union with obstacles that have a larger one, makes steps several times faster. `shell` is a
 * length above 0, for a pure set in the unit of its distances. Other queries ignore it. The copy keeps the data and gets a
 * new number (cstk_cobject_get_data). CSTK_ERROR_UNSUPPORTED for a union, an intersection or a complement: give shells to
 * the parts before combining them.
 */
cstk_status cstk_cobject_with_shell(const cstk_cobject *cobject,
                                    double shell,
                                    cstk_cobject **out);

/**
 * Creates the C-object `of` with what the caller knows of it: at every configuration in the interior of `within` its class is
 * `known`, a cstk_class: CSTK_CLASS_OUTSIDE or CSTK_CLASS_INSIDE. There queries need not look at geometry (§2.2.3): boxes that cstk_region_grow or
 * cstk_region_classify has proved free are such sets. `within` is a box, a ball or a half-space (cstk_cobject_box, _ball,
 * _halfspace), an intersection of these (a polytope), or a union of those. Its contact epsilons and scales are ignored. Sets are
 * looked at one after the other.
 *
 * The library takes the caller's word: it must hold in every state of the environments that the C-object is asked in, and where `of`
 * has a contact epsilon, CSTK_CLASS_OUTSIDE says that there is no contact either, which the proof of a box does not. A wrong word
 * makes wrong answers. What each query does with it:
 * - classes: in the interior of a set the known class; on its boundary, within rounding of it, outside it, and at link poses `of` is
 *   asked. cstk_within with threshold 0 does the same, with a threshold above 0 it asks `of`;
 * - motions, paths and shortcuts with threshold 0, boxes of C-space and maps: the parts of a motion or box inside a set are known, the
 *   others proved. A straight motion between two configurations of one box, ball or polytope is known without any geometry, but for
 *   free joints and rotations that move near its boundary. With a threshold above 0 `of` is asked;
 * - distances, witnesses, gradients, explanations, signed distances, clearances and slides ask `of`, for nothing is known of
 *   distances; so do certificates, which take nobody's word: they are those of `of`.
 *
 * It may be part of any other set, and counts as one level of its depth. It takes no shell (give it to `of`).
 * CSTK_ERROR_INVALID_ARGUMENT for CSTK_CLASS_CONTACT or sets of two spaces, CSTK_ERROR_UNSUPPORTED for other sets as `within`.
 * Threads may share it, as any C-object.
 */
cstk_status cstk_cobject_with_known(const cstk_cobject *of,
                                    const cstk_cobject *within,
                                    int32_t known,
                                    cstk_cobject **out);

/**
 * Writes the user data of a C-object (or NULL) and its number, by which witnesses and explanations name it as a leaf;
 * either output may be NULL. No two sets of a process share a number; the complement of a complement is the original set,
 * with its number.
 */
cstk_status cstk_cobject_get_data(const cstk_cobject *cobject,
                                  void **data,
                                  uint64_t *number);

/**
 * Writes the defaults: no functions. `size` is sizeof(cstk_predicate).
 */
cstk_status cstk_predicate_default(cstk_predicate *out, size_t size);

/**
 * Writes the default options. `size` is sizeof(cstk_pure_options).
 */
cstk_status cstk_pure_options_default(cstk_pure_options *out, size_t size);

/**
 * Creates the set of configurations with a coordinate outside its range in the space: the joint limits as an obstacle. The
 * set is open: a configuration at a limit is not inside. Distances are measured to the nearest limit, in units of the
 * coordinates. `options` may be NULL for the defaults, here and below. A space without limits gives an empty set.
 */
cstk_status cstk_cobject_beyond_limits(const cstk_space *space,
                                       const cstk_pure_options *options,
                                       cstk_cobject **out);

/**
 * Creates the set of configurations at which the origin of some link is outside the world box of the space. It measures in
 * lengths, whatever the scale, and can be queried at link poses. Open, as cstk_cobject_beyond_limits.
 */
cstk_status cstk_cobject_beyond_world(const cstk_space *space,
                                      const cstk_pure_options *options,
                                      cstk_cobject **out);

/**
 * Creates the set of configurations at which the body of a link meets the half-space normal . x <= offset of the world: an
 * unbounded floor, wall or ceiling. `normal` has three doubles and any length above 0; in the plane its z is 0. `links`
 * holds `link_count` link numbers; `link_count` 0 means all links with a body. Leave out a base that stands on the floor.
 * For a margin, increase the offset. Objects attached to links are not tested; a large box in the environment can test
 * them.
 *
 * Queries are exact and take logarithmic time. The set measures in lengths, whatever the scale, to the lowest point of
 * all, and can be queried at link poses. Contacts are at that point (see CSTK_MODE_PURE_SET), and have a gradient inside
 * as well. The distance from the complement is unknown where it is not 0.
 */
cstk_status cstk_cobject_below_floor(const cstk_space *space,
                                     const uint32_t *links,
                                     size_t link_count,
                                     const double *normal,
                                     double offset,
                                     const cstk_pure_options *options,
                                     cstk_cobject **out);

/**
 * Creates the set of configurations with every coordinate i in [low[i], high[i]] (`nq` doubles each). -INFINITY and
 * INFINITY leave a coordinate free; for quaternions both are required. On a circle the interval is the arc from low[i]
 * upwards to high[i], which must not be less: from 3 to 4, say, past pi; it has two ends or none. The distance is the root
 * of the sum of squares, with angles the shorter way round.
 */
cstk_status cstk_cobject_box(const cstk_space *space,
                             const double *low,
                             const double *high,
                             size_t nq,
                             const cstk_pure_options *options,
                             cstk_cobject **out);

/**
 * Creates the set of configurations with normal . q <= offset (`normal` has `nq` doubles). Entries for coordinates on
 * circles and of quaternions must be 0.
 */
cstk_status cstk_cobject_halfspace(const cstk_space *space,
                                   const double *normal,
                                   size_t nq,
                                   double offset,
                                   const cstk_pure_options *options,
                                   cstk_cobject **out);

/**
 * Creates the set of configurations within `radius` of `center` (`nq` doubles). The distance is the root of the sum of
 * squared differences: angles the shorter way round, quaternions by the angle of rotation, free joints by translation and
 * rotation.
 */
cstk_status cstk_cobject_ball(const cstk_space *space,
                              const double *center,
                              size_t nq,
                              double radius,
                              const cstk_pure_options *options,
                              cstk_cobject **out);

/**
 * Creates a set defined by callbacks. `predicate` is copied; its user data are released by `destroy` when nothing refers
 * to the set any more, and not if this call fails.
 */
cstk_status cstk_cobject_predicate(const cstk_space *space,
                                   const cstk_predicate *predicate,
                                   const cstk_pure_options *options,
                                   cstk_cobject **out);

/** @} */

/**
 * @defgroup query Query contexts
 *
 * A query context holds one thread's caches and scratch memory, and the lists that its last call wrote. Its caches change
 * how long an answer takes, never the answer (§2.3.4).
 *
 * @code
     cstk_query_statistics work;
     check(cstk_query_create(&query));
     check(cstk_query_set_limit(query, 1000000));
     check(cstk_query_get_statistics(query, true, &work));
     check(cstk_query_release(query));
 * @endcode
 * @{
 */

/**
 * Which contacts are computed for each witness of a list (cstk_query_set_contacts). They take most of the time of a
 * witness.
 */
enum cstk_contacts_listed
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * All contacts: parallel features have several. The initial setting of a context.
   */
  CSTK_CONTACTS_ALL = 0,
  /**
   * The contact at the witness points.
   */
  CSTK_CONTACTS_NEAREST = 1,
  /**
   * No contacts and no gradients. Touching and overlapping are then not distinguished: `overlapping` is true at distance
   * 0.
   */
  CSTK_CONTACTS_NONE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_contacts_listed cstk_contacts_listed;
#else
typedef int32_t cstk_contacts_listed;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * One thread's caches and scratch memory, and the owner of the arrays in its results. A context serves one thread at a
 * time; other calls meanwhile return CSTK_ERROR_BUSY. Create one per thread. Caches change how long an answer takes, never
 * the answer.
 */
typedef struct cstk_query cstk_query;

/**
 * The work done by a query context.
 */
typedef struct cstk_query_statistics {
  /**
   * Pairs of hierarchy nodes whose wrappers were tested, including pairs of bodies; for rays into solids, the nodes; for motions and
   * regions, what is decided without nodes too: a look each.
   */
  uint64_t node_pairs;
  /**
   * Primitive pairs tested; for rays, the faces.
   */
  uint64_t primitive_pairs;
  /**
   * Witnesses of earlier queries that were tested first.
   */
  uint64_t cache_hits;
  /**
   * Those of `primitive_pairs` whose distance was computed, not polygons that a remembered direction separates.
   */
  uint64_t primitive_distances;
  uint64_t reserved[4];
} cstk_query_statistics;


/**
 * Creates a query context.
 */
cstk_status cstk_query_create(cstk_query **out);

/**
 * Adds a reference.
 */
cstk_status cstk_query_retain(cstk_query *query);

/**
 * Drops a reference. NULL is a no-op.
 */
cstk_status cstk_query_release(cstk_query *query);

/**
 * Writes the version of an environment that the last query of a C-object, of objects or of a configuration with this context saw, also
 * one that failed after it began to look; queries of two bodies or of a space's link pairs see none and change nothing. CSTK_ERROR_NOT_FOUND
 * if that query's C-object does not refer to the environment, or there was no such query yet.
 */
cstk_status cstk_query_get_version(cstk_query *query,
                                   const cstk_environment *environment,
                                   uint64_t *out);

/**
 * Sets which contacts cstk_witnesses, cstk_gradients, cstk_pseudo_normal, cstk_pair_witnesses and their variants compute
 * with this context from now on; `listed` is a cstk_contacts_listed. Witnesses and their distances do not depend on it.
 * cstk_slide ignores it; cstk_slide_step and cstk_spring_step need lists with all contacts. CSTK_ERROR_INVALID_ARGUMENT
 * for another number.
 */
cstk_status cstk_query_set_contacts(cstk_query *query,
                                    int32_t listed);

/**
 * Limits the work of each later query with this context to `node_and_primitive_pairs`: of every call that takes the
 * context and answers, or slides, from cstk_pair_within to cstk_find_link_pairs. A query that needs more returns
 * CSTK_ERROR_LIMIT and writes nothing; those that have an outcome for it, as motions, boxes of C-space and slides, end with that, and
 * write what they have proved. The context can be used again at once. 0, the initial setting, means no limit.
 *
 * Work is what cstk_query_statistics counts as `node_pairs` and `primitive_pairs`: a million takes from 10 milliseconds
 * (nodes of meshes) to a second (primitives other than polygons). Penetrations of polyhedra also count each two edges that
 * are compared. The work depends on the query and on what the context remembers of earlier ones, not on the thread or on
 * the machine's load: contexts that run the same queries from creation on reach the limit at the same call. Fixed costs of
 * a call do not count: kinematics, callbacks, and pure sets but where a proof looks at one.
 */
cstk_status cstk_query_set_limit(cstk_query *query,
                                 uint64_t node_and_primitive_pairs);

/**
 * Has later queries with this context refine the curved surfaces that bodies stand for (cstk_body_builder_add_bezier_patch and
 * cstk_body_builder_add_nurbs_surface) until their answers are known to `gap`, in your unit; INFINITY, the initial setting, for never.
 *
 * Without it an answer knows a curved surface up to the deviation that its body states. With it
 *
 * - the bounds of a distance are at most `gap` apart (cstk_distance, cstk_pair_distance and their variants),
 * - thresholds and classes are decided unless the distance is within `gap` of the threshold; doubt counts as within
 *   (cstk_classify, cstk_within, cstk_pair_within and their variants).
 *
 * Witness points and normals are those of the refined parts, features and tags those of the triangles. What is about equally near
 * over much of a surface ends after 16384 steps, with the bounds that are proved by then: the distance is CSTK_DISTANCE_LOWER_BOUND
 * where they are farther apart than `gap`. Each step counts as one of `node_pairs` (cstk_query_set_limit).
 *
 * Not refined are lists of witnesses, verdicts (cstk_explain: its class too), the class and distance of cstk_pseudo_normal, queries of all pairs of objects, motions, regions, slides, maps, batches (they have
 * contexts of their own), depths and signed distances; bodies whose builder was told of a deviation (cstk_body_builder_set_deviation), bodies read from files, refitted
 * bodies, and surfaces with more than 2^20 control points once knots are inserted: they are answered for as without it. Bodies made of others (cstk_body_builder_add_body) are refined as these are.
 *
 * CSTK_ERROR_INVALID_ARGUMENT for a gap that is not above 0, CSTK_ERROR_NOT_FINITE for NaN.
 */
cstk_status cstk_query_set_refinement(cstk_query *query,
                                      double gap);

/**
 * Writes the work done since the context was created, or since the last call with `reset`; `reset` sets the counts to 0.
 */
cstk_status cstk_query_get_statistics(cstk_query *query,
                                      bool reset,
                                      cstk_query_statistics *out);

/** @} */

/**
 * @defgroup at_configuration Queries at a configuration
 *
 * Operations 4 to 8 of §2.2.4 for a C-object: is q free, how far is it from contact, between what, which way is out, and
 * why. Callers with their own kinematics pass link poses instead of q.
 *
 * @code
     cstk_class place;
     cstk_distance_result nearest;
     check(cstk_classify(query, cobject, q, nq, &place));
     check(cstk_distance(query, cobject, q, nq, INFINITY, &nearest));
 * @endcode
 * @{
 */

/**
 * Means "none" in fields that hold the number of a link or a coordinate.
 */
#define CSTK_NONE 4294967295

/**
 * The class of a configuration. The order is that of the set algebra: a union takes the largest.
 */
enum cstk_class
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Farther away than the contact epsilon.
   */
  CSTK_CLASS_OUTSIDE = 0,
  /**
   * Apart, but no farther than the contact epsilon; doubt within rounding counts as contact.
   */
  CSTK_CLASS_CONTACT = 1,
  /**
   * The sets meet: distance 0.
   */
  CSTK_CLASS_INSIDE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_class cstk_class;
#else
typedef int32_t cstk_class;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * How much is known of a distance.
 */
enum cstk_distance_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The distance is known, up to rounding.
   */
  CSTK_DISTANCE_EXACT = 0,
  /**
   * Only `lower` and `upper` are known; `distance` equals `lower`.
   */
  CSTK_DISTANCE_LOWER_BOUND = 1,
  /**
   * Nothing is within max_distance: `lower` is max_distance less rounding, `distance` and `upper` are infinite.
   */
  CSTK_DISTANCE_BEYOND_MAX = 2,
  /**
   * The set is empty; all three are infinite.
   */
  CSTK_DISTANCE_EMPTY = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_distance_kind cstk_distance_kind;
#else
typedef int32_t cstk_distance_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The contact modes of §4.4: the r-feature, then the s-feature.
 */
enum cstk_contact_mode
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  CSTK_MODE_POINT_POINT = 0,
  CSTK_MODE_POINT_EDGE = 1,
  CSTK_MODE_EDGE_POINT = 2,
  CSTK_MODE_POINT_FACE = 3,
  CSTK_MODE_FACE_POINT = 4,
  CSTK_MODE_EDGE_EDGE = 5,
  /**
   * The boundary of a pure set: there are no features. Points and normal are 0, except for the world box (at the link's
   * origin) and for a floor (at the link's lowest point).
   */
  CSTK_MODE_PURE_SET = 6,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_contact_mode cstk_contact_mode;
#else
typedef int32_t cstk_contact_mode;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The verdict on a pair of links.
 */
enum cstk_pair_verdict
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The pair should be tested: it touched in some samples, or belongs to different robots.
   */
  CSTK_PAIR_TEST = 0,
  /**
   * The links are joined, with no body in between, or fixed to each other.
   */
  CSTK_PAIR_ADJACENT = 1,
  /**
   * The links touch at rest.
   */
  CSTK_PAIR_AT_REST = 2,
  /**
   * The links touch in all samples, or almost all.
   */
  CSTK_PAIR_ALWAYS = 3,
  /**
   * The links touched in no sample; still tested unless skip_never is set.
   */
  CSTK_PAIR_NEVER = 4,
  /**
   * The robot's SRDF file, or cstk_robot_builder_disable_pair, rules the pair out.
   */
  CSTK_PAIR_DISABLED = 5,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_pair_verdict cstk_pair_verdict;
#else
typedef int32_t cstk_pair_verdict;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * A pair of primitives, a piece of one body wholly inside the other, or a pure set. The links of a pure set are CSTK_NONE,
 * except `r_link` of the world box and of floors: the link nearest to the set, or deepest in it.
 */
typedef struct cstk_witness {
  /**
   * The link, by number in the space; 0 in queries on two bodies or on objects against
   * objects.
   */
  uint32_t r_link;
  /**
   * The second link, or the link that the s-object is attached to; CSTK_NONE for other s-objects and for bodies.
   */
  uint32_t s_link;
  /**
   * The s-object's id, or 0.
   */
  uint64_t s_object;
  /**
   * The primitives' numbers in their bodies, and their tags.
   */
  uint32_t r_primitive;
  uint32_t s_primitive;
  uint64_t r_tag;
  uint64_t s_tag;
  /**
   * The primitives' distance, less the C-object's margin and at least 0.
   */
  double distance;
  /**
   * The contacts are `contact_count` entries of the list from `first_contact` on. Parallel features have several
   * contacts, which span their common part.
   */
  uint32_t first_contact;
  uint32_t contact_count;
  /**
   * The primitives overlap more than slightly, or `contained` is set: there is no contact and no gradient. With
   * CSTK_CONTACTS_NONE every pair at distance 0 counts as overlapping.
   */
  bool overlapping;
  /**
   * A connected piece of one body lies wholly inside the other, a solid. The primitives, which do not meet, are the
   * lowest of the piece and the lowest of the part of the solid's boundary around it.
   */
  bool contained;
  /**
   * The distance is that of the set's complement.
   */
  bool complemented;
  uint8_t reserved_bytes[1];
  /**
   * For joint limits and C-space boxes, the coordinate that decides: the one farthest outside its range, or nearest to
   * an end of it (the distance combines all coordinates). Otherwise CSTK_NONE.
   */
  uint32_t coordinate;
  /**
   * The leaf C-object that the pair belongs to, by its number (cstk_cobject_get_data), and its data; 0 and NULL in
   * queries on two bodies.
   */
  uint64_t cobject;
  void *cobject_data;
  /**
   * The data of the r-side's body, and of the s-object or, if it has none, of its body; NULL for none.
   */
  void *r_data;
  void *s_data;
  /**
   * The s-object attached to `r_link` that is the r-side, or 0 for the link's own body. In queries on objects against objects,
   * the first object.
   */
  uint64_t r_object;
  /**
   * The parts of their bodies that the primitives belong to, by number (cstk_body_get_part); CSTK_NONE for primitives
   * that were added to their bodies by themselves.
   */
  uint32_t r_part;
  uint32_t s_part;
  uint64_t reserved[3];
} cstk_witness;

/**
 * A contact. The r-side is the link (or body a), the s-side the s-object, second link or body b.
 */
typedef struct cstk_contact {
  /**
   * The witness points, in the world.
   */
  double r_point[3];
  double s_point[3];
  /**
   * Of length 1, in the world, from the s-side to the r-side; also valid at exact touch.
   */
  double normal[3];
  /**
   * The distance between the points, less the C-object's margin and at least 0.
   */
  double distance;
  cstk_contact_mode mode;
  /**
   * The features that hold the points; cstk_body_get_feature_vertices gives their vertices.
   */
  cstk_feature_kind r_feature_kind;
  uint32_t r_feature;
  cstk_feature_kind s_feature_kind;
  uint32_t s_feature;
  uint32_t reserved_word;
  /**
   * The signed distance between the points, less the C-object's margin. It is negative within the margin, and where
   * primitives overlap slightly: by at most 1e-6 of the pair's size, or, for round ones, as deep as their radii allow
   * while their cores are apart: by 1e-6 of
   * the pair's size at least, where a smooth core is a thousand times smaller than the radii.
   */
  double clearance;
  uint64_t reserved[2];
} cstk_contact;

/**
 * A distance with safe bounds: lower <= truth <= upper.
 */
typedef struct cstk_distance_result {
  cstk_distance_kind kind;
  /**
   * Whether `witness`, `r_point` and `s_point` are set: the nearest primitive pair. Ties (equal to the last bit) go to
   * the lowest ids.
   */
  bool has_witness;
  /**
   * Whether `contact` is set: the contact at these points. An overlap has none; parallel features have more, see
   * cstk_witnesses.
   */
  bool has_contact;
  uint8_t reserved_bytes[2];
  /**
   * 0 if and only if the sets meet, the s-side grown by the C-object's margin.
   */
  double distance;
  /**
   * Never above the true distance. Where `distance` is finite, `lower` is 0 if and only if `distance` is.
   */
  double lower;
  /**
   * Never below the true distance; infinite where nothing better is known, for an intersection, a difference or a
   * complement.
   */
  double upper;
  /**
   * The witness points, in the world. Where the sets overlap both are one common point; for a piece inside a solid both
   * are a vertex of the piece.
   */
  double r_point[3];
  double s_point[3];
  cstk_witness witness;
  cstk_contact contact;
  /**
   * The version of the environment that the query saw, the largest of several; 0 without an environment.
   */
  uint64_t environment_version;
  uint64_t reserved[8];
} cstk_distance_result;

/**
 * Witnesses, nearest first, with their contacts. The arrays belong to the query context and stay valid until its next call
 * or its release.
 */
typedef struct cstk_witness_list {
  const cstk_witness *witnesses;
  size_t witness_count;
  const cstk_contact *contacts;
  size_t contact_count;
  /**
   * One row of `nv` doubles per contact (not per witness): the derivative of its distance with respect to each velocity.
   * NULL without gradients.
   */
  const double *gradients;
  size_t nv;
  /**
   * There are more witnesses than max_count; these are the nearest.
   */
  bool truncated;
  /**
   * cstk_query_set_contacts has left out contacts: cstk_slide_step and cstk_spring_step refuse the list.
   */
  bool contacts_left_out;
  uint8_t reserved_bytes[6];
  uint64_t environment_version;
  uint64_t reserved[8];
} cstk_witness_list;

/**
 * Class, distance, witnesses and gradients at one configuration: Appendix A's cstk-pseudo-normal.
 */
typedef struct cstk_pseudo_normal_result {
  cstk_class point_class;
  uint32_t reserved;
  cstk_distance_result distance;
  /**
   * Witnesses, contacts and gradients within the shell.
   */
  cstk_witness_list list;
} cstk_pseudo_normal_result;

/**
 * The class of one leaf of a C-object's tree, and its part in the class of the whole.
 */
typedef struct cstk_verdict {
  /**
   * The leaf, by its number (cstk_cobject_get_data), and its data.
   */
  uint64_t cobject;
  void *data;
  /**
   * The class with respect to the leaf itself.
   */
  cstk_class leaf_class;
  /**
   * Whether the tree takes the leaf's complement.
   */
  bool complemented;
  /**
   * Whether the class of the whole rests on this leaf (and on the other decisive ones): from the root to the leaf, each
   * part has the class of the union or intersection that holds it.
   */
  bool decisive;
  uint8_t reserved_bytes[2];
  /**
   * The witnesses of the leaf's class, if it is decisive: `witness_count` entries of the list from `first_witness` on.
   */
  uint32_t first_witness;
  uint32_t witness_count;
  uint64_t reserved[2];
} cstk_verdict;

/**
 * A class and the leaves and witnesses that decide it. The arrays belong to the query context and stay valid until its
 * next call or its release.
 */
typedef struct cstk_explanation {
  cstk_class point_class;
  uint32_t reserved_word;
  /**
   * Every leaf; twice if both it and its complement are used.
   */
  const cstk_verdict *leaves;
  size_t leaf_count;
  /**
   * Pairs that meet where the leaf's class is CSTK_CLASS_INSIDE, or are within its contact epsilon where it is
   * CSTK_CLASS_CONTACT. As for classes, doubt within rounding counts as within, so that `distance` may exceed the
   * epsilon by rounding.
   */
  cstk_witness_list list;
  uint64_t reserved[4];
} cstk_explanation;

/**
 * Options of cstk_find_link_pairs. Write it with cstk_link_pair_options_default first.
 */
typedef struct cstk_link_pair_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * The number of configurations sampled; default 1000.
   */
  uint64_t samples;
  /**
   * The seed of the sampling; default 0. Equal seeds give equal answers.
   */
  uint64_t seed;
  /**
   * The configuration at rest, nq doubles of the space; NULL, the default, for all coordinates 0, clamped to their
   * ranges. Coordinates without bounds are not sampled: they stay at rest.
   */
  const double *rest;
  /**
   * Links within this distance count as touching; default 0.
   */
  double margin;
  /**
   * Pairs that touch in at least this fraction of the samples count as always touching; default 0.95.
   */
  double always;
  /**
   * Nonzero: leaves out pairs that touched in no sample. Sampling does not prove that they cannot touch. Default 0.
   */
  uint32_t skip_never;
  uint32_t reserved;
} cstk_link_pair_options;

/**
 * A pair of links with bodies, the lower number first.
 */
typedef struct cstk_link_pair {
  uint32_t r_link;
  uint32_t s_link;
  cstk_pair_verdict verdict;
  /**
   * The robots of the two links, in the order of the space.
   */
  uint32_t r_robot;
  uint32_t s_robot;
  uint32_t reserved;
  /**
   * The fraction of the samples in which the links touch; 0 where the verdict needed no samples.
   */
  double share;
} cstk_link_pair;

/**
 * All pairs of links with bodies. The arrays belong to the query context and stay valid until its next call or its
 * release.
 */
typedef struct cstk_link_pair_list {
  const cstk_link_pair *pairs;
  size_t count;
  /**
   * The pairs to test, two link numbers each, as cstk_cobject_induced_links takes them; NULL if there are none.
   */
  const uint32_t *tested;
  size_t tested_count;
  uint64_t reserved[4];
} cstk_link_pair_list;

/**
 * Options of cstk_prove_clear_pairs. Write it with cstk_clear_pair_options_default first.
 */
typedef struct cstk_clear_pair_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * The most blocks of cells that are tried for a pair, at least 1. More prove more, and take longer. Default 20000.
   */
  uint64_t max_blocks;
} cstk_clear_pair_options;

/**
 * What cstk_prove_clear_pairs has proved.
 */
typedef struct cstk_clear_pair_summary {
  /**
   * The pairs of the set.
   */
  size_t pair_count;
  /**
   * Those of them that have cells which are proved.
   */
  size_t proved_count;
  /**
   * The mean of the part of their cells that is proved, from 0 to 1; 0 without such pairs.
   */
  double proved_share;
  /**
   * The memory that the cells take.
   */
  size_t bytes;
  uint64_t reserved[4];
} cstk_clear_pair_summary;

/**
 * A pair of primitives that meet, and the shortest translation that separates them.
 */
typedef struct cstk_penetration {
  /**
   * The primitives' numbers in their bodies, and their tags.
   */
  uint32_t r_primitive;
  uint32_t s_primitive;
  uint64_t r_tag;
  uint64_t s_tag;
  /**
   * The length of the translation; 0 for primitives that only touch, or whose interiors do not meet.
   */
  double depth;
  /**
   * The direction in which body a must move: a unit vector in the world, from body b to body a.
   */
  double direction[3];
  /**
   * A point of each primitive, in the world, that the translation brings together: s_point = r_point + depth *
   * direction.
   */
  double r_point[3];
  double s_point[3];
  /**
   * The parts of their bodies that the primitives belong to, as in a cstk_witness.
   */
  uint32_t r_part;
  uint32_t s_part;
  uint64_t reserved[5];
} cstk_penetration;

/**
 * Primitive pairs that meet, deepest first. The array belongs to the query context and stays valid until its next call or
 * its release.
 */
typedef struct cstk_penetration_list {
  const cstk_penetration *penetrations;
  size_t count;
  /**
   * Each body is a single convex primitive, so that the first entry separates the bodies. Otherwise an entry separates
   * its two primitives only.
   */
  bool of_whole_bodies;
  /**
   * More pairs meet than max_count; these are the deepest.
   */
  bool truncated;
  uint8_t reserved_bytes[6];
  uint64_t reserved[5];
} cstk_penetration_list;


/**
 * Writes the class of configuration q: inside the C-object, in contact with it, or outside (§2.2.4, operation 4). `q` has
 * `nq` doubles, as many as the space has coordinates.
 */
cstk_status cstk_classify(cstk_query *query,
                          const cstk_cobject *cobject,
                          const double *q,
                          size_t nq,
                          cstk_class *out);

/**
 * cstk_classify for callers with their own kinematics. `link_poses` holds the pose of every link of the space in the
 * world, 12 doubles each, `link_count` poses in all. Such callers compute a contact's gradient as n^T (J_r - J_s), with
 * their own Jacobians of the points r_point and s_point of the links.
 */
cstk_status cstk_classify_at_link_poses(cstk_query *query,
                                        const cstk_cobject *cobject,
                                        const double *link_poses,
                                        size_t link_count,
                                        cstk_class *out);

/**
 * Writes whether the distance at q is at most `threshold` (not negative; may be INFINITY). Doubt within rounding counts as
 * within. For unions of induced sets and closed pure sets, threshold 0 gives true where cstk_classify gives
 * CSTK_CLASS_INSIDE. It is also true on the boundary of an open set (at a joint limit, say), and where only a lower bound
 * of the distance from an intersection or a complement is known, although the class is lower there: use cstk_classify to
 * decide whether a configuration is allowed. Cheaper than cstk_distance.
 */
cstk_status cstk_within(cstk_query *query,
                        const cstk_cobject *cobject,
                        const double *q,
                        size_t nq,
                        double threshold,
                        bool *out);

/**
 * cstk_within with link poses instead of q; see cstk_classify_at_link_poses.
 */
cstk_status cstk_within_at_link_poses(cstk_query *query,
                                      const cstk_cobject *cobject,
                                      const double *link_poses,
                                      size_t link_count,
                                      double threshold,
                                      bool *out);

/**
 * Writes the distance from contact at q, and the nearest primitive pair (§2.2.4, operation 6). Distances above
 * `max_distance` are not computed, which saves time: the result is then CSTK_DISTANCE_BEYOND_MAX. Pass INFINITY for no
 * maximum.
 */
cstk_status cstk_distance(cstk_query *query,
                          const cstk_cobject *cobject,
                          const double *q,
                          size_t nq,
                          double max_distance,
                          cstk_distance_result *out);

/**
 * cstk_distance with link poses instead of q; see cstk_classify_at_link_poses.
 */
cstk_status cstk_distance_at_link_poses(cstk_query *query,
                                        const cstk_cobject *cobject,
                                        const double *link_poses,
                                        size_t link_count,
                                        double max_distance,
                                        cstk_distance_result *out);

/**
 * cstk_distance and the gradient of the nearest pair in one call: `gradient` receives `nv` doubles, as many as the space has
 * velocities: the derivative of the distance of `contact` with respect to them, as cstk_gradients has it. It is 0 where has_contact is
 * false: where nothing is near, or the two overlap.
 */
cstk_status cstk_distance_with_gradient(cstk_query *query,
                                        const cstk_cobject *cobject,
                                        const double *q,
                                        size_t nq,
                                        double max_distance,
                                        cstk_distance_result *out,
                                        double *gradient,
                                        size_t nv);

/**
 * Writes all primitive pairs at most `epsilon` apart at q, none missing, none twice (§2.2.4, operation 7), and their
 * contacts. Within rounding of epsilon, cstk_within may be true where no witness is listed. If there are more than
 * `max_count` pairs, the nearest are listed and `truncated` is set. Neighbouring faces of a mesh share edges and vertices,
 * so that one physical contact may have several witnesses. A piece of a body that lies inside another, a solid, is a
 * witness at distance 0 (see `contained`). The arrays stay valid until the next call with this query context.
 */
cstk_status cstk_witnesses(cstk_query *query,
                           const cstk_cobject *cobject,
                           const double *q,
                           size_t nq,
                           double epsilon,
                           size_t max_count,
                           cstk_witness_list *out);

/**
 * cstk_witnesses with link poses instead of q; see cstk_classify_at_link_poses.
 */
cstk_status cstk_witnesses_at_link_poses(cstk_query *query,
                                         const cstk_cobject *cobject,
                                         const double *link_poses,
                                         size_t link_count,
                                         double epsilon,
                                         size_t max_count,
                                         cstk_witness_list *out);

/**
 * cstk_witnesses, with the gradient of each contact's distance (§2.2.4, operation 8; §4.4): its derivative with respect to
 * the velocities of cstk_space_step, the way out in joint space. Row i, at gradients + i * nv, belongs to contacts[i];
 * overlapping witnesses have neither contact nor row. A large epsilon visits every pair, whatever max_count: for the
 * nearest pair alone, call cstk_distance first and pass its `upper`, if finite, as epsilon. The arrays stay valid until
 * the next call with this query context.
 */
cstk_status cstk_gradients(cstk_query *query,
                           const cstk_cobject *cobject,
                           const double *q,
                           size_t nq,
                           double epsilon,
                           size_t max_count,
                           cstk_witness_list *out);

/**
 * Writes the class and the distance at q, and the witnesses and gradients within `max_shell`, at most `max_count`
 * witnesses. `normalize` scales gradients to length 1, except those of length 0. The list's arrays stay valid until the
 * next call with this query context.
 */
cstk_status cstk_pseudo_normal(cstk_query *query,
                               const cstk_cobject *cobject,
                               const double *q,
                               size_t nq,
                               double max_shell,
                               size_t max_count,
                               bool normalize,
                               cstk_pseudo_normal_result *out);

/**
 * Writes the class of q as cstk_classify does without refinement, and what decides it: the leaves of the C-object, and at most `max_count`
 * primitive pairs (§2.2.4, operations 4 and 5). Slower than cstk_classify, since every leaf is tested. `q` has `nq`
 * doubles.
 */
cstk_status cstk_explain(cstk_query *query,
                         const cstk_cobject *cobject,
                         const double *q,
                         size_t nq,
                         size_t max_count,
                         cstk_explanation *out);

/**
 * cstk_explain with link poses instead of q; see cstk_classify_at_link_poses.
 */
cstk_status cstk_explain_at_link_poses(cstk_query *query,
                                       const cstk_cobject *cobject,
                                       const double *link_poses,
                                       size_t link_count,
                                       size_t max_count,
                                       cstk_explanation *out);

/**
 * Writes the default options. `size` is sizeof(cstk_link_pair_options).
 */
cstk_status cstk_link_pair_options_default(cstk_link_pair_options *out, size_t size);

/**
 * Writes which pairs of links of the space to test for self-collision, and why the others are left out: links that are
 * joined, that touch at rest, that touch in at least `always` of the sampled configurations, or that an SRDF file rules out
 * (cstk_space_get_enabled_pairs tells these without sampling). Links of different robots
 * are always tested. Pass `tested` to cstk_cobject_induced_links (it may be empty); to allow further pairs, leave them
 * out. Set `margin` to at least the margin plus the contact epsilon of that set; otherwise pairs that are always in
 * contact are tested. `options` may be NULL for the defaults; `progress` may be NULL; `user` is passed to it.
 */
cstk_status cstk_find_link_pairs(cstk_query *query,
                                 const cstk_space *space,
                                 const cstk_link_pair_options *options,
                                 cstk_progress_fn progress,
                                 void *user,
                                 cstk_link_pair_list *out);

/**
 * Writes the default options. `size` is sizeof(cstk_clear_pair_options).
 */
cstk_status cstk_clear_pair_options_default(cstk_clear_pair_options *out, size_t size);

/**
 * Creates a copy of a set of link pairs (cstk_cobject_induced_links) that knows by proof where its links are apart. How two links stand
 * to each other depends on the joints between them alone: for each pair that up to three coordinates move so, the space of these
 * coordinates is divided into cells, and cells are proved free of contact as boxes of C-space are (cstk_region_classify). It is done once for
 * a robot, takes from some milliseconds to some seconds, and needs no environment.
 *
 * The copy has the same class at every configuration, up to rounding. What only asks for contact need not look at a pair inside a proved
 * cell: cstk_classify, cstk_within with a threshold up to the contact epsilon, lists of contacts, batches, maps, and straight motions with a
 * threshold up to it, where the whole motion stays in proved cells, and what is made of such motions: paths, shortcuts and slides. Motions
 * that are not free may end at times that differ, within their tolerance, from those of the set without proofs, and slides may go
 * farther. Distances ignore the proofs; so do queries at link poses, which do not know coordinates, and certificates, which take
 * nobody's word. The whole call counts as one query for cstk_query_set_limit.
 *
 * The joints between must be revolute or prismatic, with limits or whole turns; other pairs are asked as before. The copy keeps the data
 * and the shell, and gets a new number (cstk_cobject_get_data). CSTK_ERROR_UNSUPPORTED for all other C-objects: prove pairs before a set
 * is combined. `options` may be NULL for the defaults; `progress` may be NULL; `user` is passed to it. `summary` may be NULL.
 */
cstk_status cstk_prove_clear_pairs(cstk_query *query,
                                   const cstk_cobject *cobject,
                                   const cstk_clear_pair_options *options,
                                   cstk_progress_fn progress,
                                   void *user,
                                   cstk_clear_pair_summary *summary,
                                   cstk_cobject **out);

/** @} */

/**
 * @defgroup pair Pair queries
 *
 * Two bodies at two poses, without a robot: the queries that FCL and Coal offer.
 *
 * @code
     cstk_distance_result nearest;
     bool meet;
     check(cstk_pair_distance(query, body, pose_a, body, pose_b, INFINITY, &nearest));
     check(cstk_pair_within(query, body, pose_a, body, pose_b, 0, &meet));
 * @endcode
 * @{
 */

/**
 * Writes the distance of body a at pose_a from body b at pose_b, and the nearest primitive pair. Poses are 12 doubles,
 * row-major [R | t], the body's frame in the world. Distances above `max_distance` are not computed: the result is then
 * CSTK_DISTANCE_BEYOND_MAX. Pass INFINITY for no maximum.
 */
cstk_status cstk_pair_distance(cstk_query *query,
                               const cstk_body *body_a,
                               const double *pose_a,
                               const cstk_body *body_b,
                               const double *pose_b,
                               double max_distance,
                               cstk_distance_result *out);

/**
 * Writes whether the two bodies are at most `threshold` apart (not negative; may be INFINITY); with 0, whether they meet.
 * Doubt within rounding counts as within. Cheaper than a distance.
 */
cstk_status cstk_pair_within(cstk_query *query,
                             const cstk_body *body_a,
                             const double *pose_a,
                             const cstk_body *body_b,
                             const double *pose_b,
                             double threshold,
                             bool *out);

/**
 * Writes all primitive pairs at most `epsilon` apart, none missing, none twice, and their contacts. Each piece of a body
 * that lies inside the other, a solid, is listed at distance 0 (see `contained`). If there are more than `max_count`, the
 * nearest are listed and `truncated` is set. The arrays stay valid until the next call with this query context.
 */
cstk_status cstk_pair_witnesses(cstk_query *query,
                                const cstk_body *body_a,
                                const double *pose_a,
                                const cstk_body *body_b,
                                const double *pose_b,
                                double epsilon,
                                size_t max_count,
                                cstk_witness_list *out);

/**
 * Writes all primitive pairs that meet, none missing, none twice, and their penetration: the shortest translation that
 * separates the two. It separates bodies of one convex primitive each; for bodies of several it separates the two
 * primitives only (see `of_whole_bodies`). Exact to rounding, with radii too. A pair of polyhedra mostly takes some
 * microseconds; where nearly all ways out are as long, as of balls of many corners about one centre, the work grows with the pairs of
 * their edges that face each other. CSTK_ERROR_UNSUPPORTED where a cylinder, cone,
 * ellipsoid or support function meets another primitive. A body wholly inside a solid (cstk_body_builder_set_solid) meets
 * none of its primitives, and is not listed. If there are more than `max_count` pairs, the deepest are listed and
 * `truncated` is set. The array stays valid until the next call with this query context.
 */
cstk_status cstk_pair_penetration(cstk_query *query,
                                  const cstk_body *body_a,
                                  const double *pose_a,
                                  const cstk_body *body_b,
                                  const double *pose_b,
                                  size_t max_count,
                                  cstk_penetration_list *out);

/** @} */

/**
 * @defgroup object_pairs Objects against objects
 *
 * The objects of an environment, each with each, or with each of a second environment, without a robot: what is near in a
 * simulation of contacts, a scene as it is loaded, a bin of parts. All near pairs are found in one run through the tree over the
 * objects; each answer is that of the pair query of the two bodies. Objects that are attached to links have no place here:
 * CSTK_ERROR_UNSUPPORTED.
 *
 * @code
     cstk_object_pair_list near;
     cstk_witness_list touching;
     check(cstk_environment_pairs(query, environment, NULL, 0.01, 4096, NULL, &near));
     check(cstk_environment_witnesses(query, environment, NULL, 0.001, 4096, NULL, &touching));
 * @endcode
 * @{
 */

/**
 * Writes to `out` whether a pair of objects is asked about, by their ids and data. Returns CSTK_OK, or anything else to make the
 * query fail with CSTK_ERROR_CALLBACK_FAILED. It is called on the thread that made the call, for pairs that may be near, in any
 * order and possibly more than once; it must be pure, must not throw, and must not use the query context.
 */
typedef int32_t (*cstk_object_filter_fn)(uint64_t r_object,
                                         uint64_t s_object,
                                         void *r_data,
                                         void *s_data,
                                         bool *out,
                                         void *user);

/**
 * Options of the queries of objects against objects. Write it with cstk_object_pair_options_default first.
 */
typedef struct cstk_object_pair_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * NULL, the default, for all pairs.
   */
  cstk_object_filter_fn filter;
  /**
   * Passed to the filter.
   */
  void *user;
  /**
   * Nonzero: cstk_environment_pairs measures the distance of each pair that it lists. Default 0.
   */
  uint32_t with_distances;
  uint32_t reserved;
} cstk_object_pair_options;

/**
 * Two objects that are near each other. Within one environment `r_object` is the lower id; of two environments it is the object of
 * the first.
 */
typedef struct cstk_object_pair {
  uint64_t r_object;
  uint64_t s_object;
  /**
   * The data of the objects, or of their bodies if they have none; NULL for none.
   */
  void *r_data;
  void *s_data;
  /**
   * CSTK_CLASS_INSIDE if they meet, else CSTK_CLASS_CONTACT.
   */
  cstk_class pair_class;
  uint32_t reserved_word;
  uint64_t reserved[2];
} cstk_object_pair;

/**
 * Pairs of objects in order of ids. The arrays belong to the query context and stay valid until its next call or its release.
 */
typedef struct cstk_object_pair_list {
  const cstk_object_pair *pairs;
  size_t count;
  /**
   * The distance of each pair, with its witness and contact; NULL unless the options ask for them.
   */
  const cstk_distance_result *distances;
  /**
   * There are more pairs than max_count; these have the lowest ids.
   */
  bool truncated;
  uint8_t reserved_bytes[7];
  /**
   * The larger one of two environments.
   */
  uint64_t environment_version;
  uint64_t reserved[4];
} cstk_object_pair_list;


/**
 * Writes the default options: all pairs, without distances. `size` is sizeof(cstk_object_pair_options).
 */
cstk_status cstk_object_pair_options_default(cstk_object_pair_options *out,
                                             size_t size);

/**
 * Writes the pairs of objects at most `distance` apart (not negative; may be INFINITY), with 0 those that meet, in order of ids:
 * of `environment` with `other`, or, where `other` is NULL, within `environment`, each pair once. Doubt within rounding counts as
 * within. If there are more than `max_count`, those with the lowest ids are listed and `truncated` is set. `options` may be NULL
 * for the defaults. The arrays stay valid until the next call with this query context.
 */
cstk_status cstk_environment_pairs(cstk_query *query,
                                   const cstk_environment *environment,
                                   const cstk_environment *other,
                                   double distance,
                                   size_t max_count,
                                   const cstk_object_pair_options *options,
                                   cstk_object_pair_list *out);

/**
 * Writes whether any pair of objects is at most `threshold` apart (not negative; may be INFINITY); with 0, whether any two meet:
 * of `environment` with `other`, or, where `other` is NULL, within `environment`. Doubt within rounding counts as within. It stops
 * at the first pair. `options` may be NULL.
 */
cstk_status cstk_environment_within(cstk_query *query,
                                    const cstk_environment *environment,
                                    const cstk_environment *other,
                                    double threshold,
                                    const cstk_object_pair_options *options,
                                    bool *out);

/**
 * Writes the distance of the nearest pair of objects, their witness points and contact: of `environment` with `other`, or, where
 * `other` is NULL, within `environment`. Ties go to the lowest ids. The witness names the two as `r_object` and `s_object`.
 * Distances above `max_distance` are not computed: the result is then CSTK_DISTANCE_BEYOND_MAX. Without any pair it is
 * CSTK_DISTANCE_EMPTY. `options` may be NULL.
 */
cstk_status cstk_environment_distance(cstk_query *query,
                                      const cstk_environment *environment,
                                      const cstk_environment *other,
                                      double max_distance,
                                      const cstk_object_pair_options *options,
                                      cstk_distance_result *out);

/**
 * Writes all pairs of primitives of two objects at most `epsilon` apart, none missing, none twice, nearest first, and their
 * contacts: of `environment` with `other`, or, where `other` is NULL, within `environment`. They name the objects as `r_object`
 * and `s_object`. If there are more than `max_count`, the nearest are listed and `truncated` is set. `options` may be NULL. The
 * arrays stay valid until the next call with this query context.
 */
cstk_status cstk_environment_witnesses(cstk_query *query,
                                       const cstk_environment *environment,
                                       const cstk_environment *other,
                                       double epsilon,
                                       size_t max_count,
                                       const cstk_object_pair_options *options,
                                       cstk_witness_list *out);

/** @} */

/**
 * @defgroup depth Depths and signed distances
 *
 * The depth of two bodies that meet is the least length of a translation after which they do not meet. For two convex primitives
 * cstk_pair_penetration has it in closed form; for unions and solids it is bounded from both sides by a search, as closely as the
 * work allows. Planners that optimise take the signed distance: the distance of what is apart, minus the depth of what meets,
 * with its derivative on both sides.
 *
 * @code
     cstk_depth_result deep;
     cstk_signed_distance_list near;
     check(cstk_pair_depth(query, body, pose_a, body, pose_b, NULL, &deep));
     check(cstk_signed_distances(query, cobject, q, nq, 0.1, 64, NULL, &near));
 * @endcode
 * @{
 */

/**
 * What the row of a signed distance is.
 */
enum cstk_gradient_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The derivative of the signed distance.
   */
  CSTK_GRADIENT_DERIVATIVE = 0,
  /**
   * Several features are equally near, or several translations equally short: the derivative of one of them. The signed
   * distance has no derivative here.
   */
  CSTK_GRADIENT_ONE_OF_SEVERAL = 1,
  /**
   * The bodies meet, and their depth is not known to the tolerance, or its translation does not follow from what touches after
   * it: the derivative of the length of the translation found, its direction held.
   */
  CSTK_GRADIENT_APPROXIMATE = 2,
  /**
   * The bodies meet, and neither has an inside everywhere: no depth is defined. The row and the normal are 0.
   */
  CSTK_GRADIENT_UNDEFINED = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_gradient_kind cstk_gradient_kind;
#else
typedef int32_t cstk_gradient_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Options of the search for depths. Write it with cstk_depth_options_default first.
 */
typedef struct cstk_depth_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * The search ends when its bounds are this close, a length; 0, the default, for 1e-6 of the size of the pair. Polytopes
   * mostly end closer than any tolerance.
   */
  double tolerance;
  /**
   * The search ends after this many steps, with the bounds that it has; 0, the default, for 1000. A step takes some
   * microseconds between few primitives, and a millisecond or some between solids, even of few faces.
   */
  uint64_t max_steps;
  uint64_t reserved[2];
} cstk_depth_options;

/**
 * Bounds of a depth, with a translation that parts the bodies. All 0 for bodies that are apart.
 */
typedef struct cstk_depth_result {
  /**
   * Whether the bodies meet.
   */
  bool meet;
  /**
   * The bounds are within the tolerance, or as close as rounding allows.
   */
  bool tight;
  uint8_t reserved_bytes[6];
  /**
   * No shorter translation parts the bodies.
   */
  double lower;
  /**
   * The length of `translation`. Never below the true depth: infinite, with a translation of 0, only if no translation was proved
   * to part them.
   */
  double upper;
  /**
   * After body a has moved by it, in the world, the bodies are proved apart: by a little more than rounding.
   */
  double translation[3];
  /**
   * The steps of the search.
   */
  uint64_t steps;
  uint64_t reserved[4];
} cstk_depth_result;

/**
 * The signed distance of two bodies, less the C-object's margin.
 */
typedef struct cstk_signed_distance {
  /**
   * Which bodies; of bodies that are apart, the nearest primitives. It has no contacts.
   */
  cstk_witness witness;
  /**
   * The distance; of bodies that meet, minus the length of the shortest translation found that parts them. Minus the margin
   * where no depth is defined.
   */
  double distance;
  /**
   * Never above the true signed distance; -INFINITY where no depth is defined.
   */
  double lower;
  /**
   * Never below the true signed distance.
   */
  double upper;
  /**
   * The unit vector, in the world, along which the r-side gets away from the s-side.
   */
  double normal[3];
  /**
   * The witness points, in the world; of bodies that meet, two that touch after the translation, where they are before it.
   */
  double r_point[3];
  double s_point[3];
  cstk_gradient_kind gradient_kind;
  uint32_t reserved_word;
  uint64_t reserved[4];
} cstk_signed_distance;

/**
 * The signed distances of body pairs, least first. The arrays belong to the query context and stay valid until its next call or
 * its release.
 */
typedef struct cstk_signed_distance_list {
  const cstk_signed_distance *pairs;
  size_t count;
  /**
   * One row of `nv` doubles per pair: the derivative of its distance with respect to each velocity. See `gradient_kind`.
   */
  const double *gradients;
  size_t nv;
  /**
   * There are more pairs than max_count; these have the least distances.
   */
  bool truncated;
  uint8_t reserved_bytes[7];
  uint64_t environment_version;
  uint64_t reserved[4];
} cstk_signed_distance_list;


/**
 * Writes the default options. `size` is sizeof(cstk_depth_options).
 */
cstk_status cstk_depth_options_default(cstk_depth_options *out, size_t size);

/**
 * Writes bounds of the depth of body a at pose_a in body b at pose_b, and a translation of body a, in the world, that is proved to
 * part them. Unions and solids (cstk_body_builder_set_solid) count as a whole: the depth is exact to rounding for unions of
 * polytopes and for solids whose boundary is convex and has at most 4096 faces, and bounded to the tolerance for others, if the steps
 * suffice; `tight` tells. CSTK_ERROR_UNSUPPORTED if the bodies
 * meet and each has a primitive without an inside, such as a polygon that bounds no solid; the message names them. A surface in
 * a solid has a depth. `options` may be NULL for the defaults. Poses are 12 doubles, row-major [R | t], the body's frame in the
 * world.
 */
cstk_status cstk_pair_depth(cstk_query *query,
                            const cstk_body *body_a,
                            const double *pose_a,
                            const cstk_body *body_b,
                            const double *pose_b,
                            const cstk_depth_options *options,
                            cstk_depth_result *out);

/**
 * Writes the signed distances, less the margin, of all pairs of bodies of the C-object that are at most `max_distance` apart (not
 * negative; may be INFINITY) at configuration q: of links, attached objects and s-objects, each pair with the derivative of its
 * signed distance with respect to the velocities. The C-object is an induced set or a union of such, else
 * CSTK_ERROR_UNSUPPORTED. Apart, distances are as cstk_distance has them; of bodies that meet, they are minus the depth, bounded as
 * cstk_pair_depth does with these options, of which NULL stands for the defaults. `gradient_kind` tells where there is no
 * derivative, and where no depth. If there are more than `max_count` pairs, those with the least distances are listed and `truncated`
 * is set. The arrays stay valid until the next call with this query context.
 */
cstk_status cstk_signed_distances(cstk_query *query,
                                  const cstk_cobject *cobject,
                                  const double *q,
                                  size_t nq,
                                  double max_distance,
                                  size_t max_count,
                                  const cstk_depth_options *options,
                                  cstk_signed_distance_list *out);

/** @} */

/**
 * @defgroup motion Motions
 *
 * A whole motion between two configurations, on a path through several, on a curve or as a function of yours
 * gives it, proved free or followed to its first contact; the same of two bodies without a robot; the least distance along a
 * motion or a path; and paths made shorter by proofs. Nothing is sampled: bounds over intervals of time cover the motion, however thin an obstacle is (§2.3.1; Figure 1 shows
 * what sampling misses).
 *
 * @code
     cstk_motion_result found;
     double contact[6];
     check(cstk_motion(query, cobject, q0, q1, nq, NULL, contact, &found));
     if (found.outcome == CSTK_MOTION_HIT) {
         printf("contact at %g of the way\n", found.times[1]);
     }
     cstk_clearance_options options;
     cstk_clearance_result clearance;
     check(cstk_clearance_options_default(&options, sizeof options));
     options.tolerance = 1e-3;
     check(cstk_motion_clearance(query, cobject, q0, q1, nq, &options, NULL, &clearance));
     printf("never nearer than %g\n", clearance.lower);
 * @endcode
 * @{
 */

/**
 * How a motion ends.
 */
enum cstk_motion_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Proved: at every time from 0 to 1 the distance is larger than the threshold.
   */
  CSTK_MOTION_FREE = 0,
  /**
   * There is contact at times[1]. All before times[0] is proved free, and the two differ by at most the tolerance, unless
   * any_contact was set.
   */
  CSTK_MOTION_HIT = 1,
  /**
   * All before times[0] is proved free; up to times[1], at most the tolerance later, the motion comes so near the threshold that
   * rounding decides. What comes after is not looked at.
   */
  CSTK_MOTION_NEAR = 2,
  /**
   * The limit of cstk_query_set_limit ended the proof, or the distance at a contact needs more; all before times[0] is proved free.
   */
  CSTK_MOTION_UNDECIDED = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_motion_outcome cstk_motion_outcome;
#else
typedef int32_t cstk_motion_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What is known of a clearance. The bounds hold whatever the outcome.
 */
enum cstk_clearance_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The motion is proved free, as cstk_motion says it, and the bounds are within the tolerance; of bodies with a deviation (see
   * cstk_body_builder_set_deviation) farther apart by what it leaves open.
   */
  CSTK_CLEARANCE_KNOWN = 0,
  /**
   * There is contact at `time`, not always the first: `lower` is 0, and `upper` 0 or what rounding leaves.
   */
  CSTK_CLEARANCE_HIT = 1,
  /**
   * Proved: at every time the distance is larger than max_distance, which is `lower`.
   */
  CSTK_CLEARANCE_BEYOND_MAX = 2,
  /**
   * The C-object is empty: there is nothing to hit, and both bounds are infinite.
   */
  CSTK_CLEARANCE_EMPTY = 3,
  /**
   * Rounding does not let the bounds come within the tolerance; if `lower` is 0, it may decide whether the motion is free.
   */
  CSTK_CLEARANCE_NEAR = 4,
  /**
   * The limit of cstk_query_set_limit ended the work. (Where the distance at q0 already needs more, the call ends with
   * CSTK_ERROR_LIMIT.)
   */
  CSTK_CLEARANCE_UNDECIDED = 5,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_clearance_outcome cstk_clearance_outcome;
#else
typedef int32_t cstk_clearance_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * How the work on a path ended.
 */
enum cstk_shortcut_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * All attempts were made, or the path is straight.
   */
  CSTK_SHORTCUT_DONE = 0,
  /**
   * The limit of cstk_query_set_limit ended the attempts. The path is what was reached until then.
   */
  CSTK_SHORTCUT_LIMITED = 1,
  /**
   * The given path is not proved free: `given` says where. It is handed back as it was.
   */
  CSTK_SHORTCUT_NOT_FREE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_shortcut_outcome cstk_shortcut_outcome;
#else
typedef int32_t cstk_shortcut_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Options of a motion. Write it with cstk_motion_options_default first.
 */
typedef struct cstk_motion_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * A distance of at most this counts as contact: a length, finite, at least 0. 0, the default, asks for configurations
   * that cstk_classify calls CSTK_CLASS_INSIDE.
   */
  double threshold;
  /**
   * How exactly the time of the first contact is found, as a part of the motion: 1e-12 to 1. Default 1e-6.
   */
  double tolerance;
  /**
   * Nonzero: yes or no; any contact on the motion will do, found in less time than the first, and no distance is told there.
   * Default 0.
   */
  uint32_t any_contact;
  uint32_t reserved;
} cstk_motion_options;

/**
 * What was found of a motion.
 */
typedef struct cstk_motion_result {
  cstk_motion_outcome outcome;
  /**
   * `distance` holds the distance at times[1], with witness and contact: for hits and near motions, unless any_contact was set or
   * lengths and units of C-space mix in the C-object: cstk_explain at the configuration reached then names what decides.
   */
  bool has_distance;
  uint8_t reserved_bytes[3];
  /**
   * See cstk_motion_outcome; 1 and 1 for a free motion.
   */
  double times[2];
  cstk_distance_result distance;
  uint64_t reserved[8];
} cstk_motion_result;

/**
 * What was found of a path.
 */
typedef struct cstk_path_result {
  /**
   * The number of the segment that `motion` is about; segment i leads from point i to point i + 1. It is the first that is not
   * free, or the one with the contact if any contact was asked for; the last segment of a path that is free.
   */
  size_t segment;
  /**
   * The answer of that segment, with times from 0 to 1 within it.
   */
  cstk_motion_result motion;
  uint64_t reserved[4];
} cstk_path_result;

/**
 * Writes a motion's configuration at time `t`, from 0 to 1, into `q`, and the first and second derivatives of its coordinates by the
 * time into `rates` and `accelerations`: `nq` doubles each. Anything but 0 (CSTK_OK) ends the call with
 * CSTK_ERROR_CALLBACK_FAILED. It must give the same at the same time, and must not throw. It is called on the thread that made the
 * call; it may call the library with other query contexts.
 */
typedef int32_t (*cstk_motion_fn)(double t,
                                  double *q,
                                  double *rates,
                                  double *accelerations,
                                  size_t nq,
                                  void *user);

/**
 * Options of a clearance. Write it with cstk_clearance_options_default first, then set `tolerance`. Distances are lengths, or in
 * units of C-space for pure sets without a scale.
 */
typedef struct cstk_clearance_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * The bounds come out at most this far apart: a distance, finite. Must be set, larger than 0. Where the motion is smooth
   * at its nearest place, the work grows with the inverse square root of the tolerance.
   */
  double tolerance;
  /**
   * Or at most this part of the upper bound apart, if that is more: at least 0, less than 1. Default 0.
   */
  double relative_tolerance;
  /**
   * A clearance above this is only known to be so, in less time: a distance, at least 0. Default INFINITY.
   */
  double max_distance;
} cstk_clearance_options;

/**
 * The least distance along a motion.
 */
typedef struct cstk_clearance_result {
  cstk_clearance_outcome outcome;
  uint32_t reserved_word;
  /**
   * Proved: no distance on the motion is smaller.
   */
  double lower;
  /**
   * The distance at `time` is no larger; infinite if only a lower bound is known.
   */
  double upper;
  /**
   * Where the nearest place was found, from 0 to 1. Of several within the tolerance it is any.
   */
  double time;
  /**
   * The distance at `time`, with witness and contact.
   */
  cstk_distance_result distance;
  uint64_t reserved[8];
} cstk_clearance_result;

/**
 * The least distance along a path.
 */
typedef struct cstk_path_clearance_result {
  /**
   * The number of the segment with the nearest place; segment i leads from point i to point i + 1. Where nothing is nearer than
   * max_distance, any.
   */
  size_t segment;
  /**
   * The bounds are of the whole path; `time` and `distance` are those of the nearest place, in its segment.
   */
  cstk_clearance_result clearance;
  uint64_t reserved[4];
} cstk_path_clearance_result;

/**
 * Options of cstk_path_shortcut. Write it with cstk_shortcut_options_default first.
 */
typedef struct cstk_shortcut_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * So many pairs of places on the path are tried, the first from end to end. Default 100.
   */
  uint64_t attempts;
  /**
   * The places are drawn with this seed: the same call has the same answer. Default 0.
   */
  uint64_t seed;
  /**
   * What comes at most this near counts as contact, as in cstk_motion_options: the path keeps farther than this. Default 0.
   */
  double threshold;
} cstk_shortcut_options;

/**
 * A path: configurations one after the other, with straight motions between them. The array belongs to the query context and stays
 * valid until its next call or its release; that call may take it.
 */
typedef struct cstk_path {
  /**
   * count * nq doubles; NULL if there are none, as in a space without coordinates, which has one configuration.
   */
  const double *points;
  size_t count;
  size_t nq;
  uint64_t reserved[3];
} cstk_path;

/**
 * A path made shorter.
 */
typedef struct cstk_shortcut_result {
  cstk_shortcut_outcome outcome;
  uint32_t reserved_word;
  /**
   * Unless the outcome is CSTK_SHORTCUT_NOT_FREE, cstk_motion proves each of its segments free.
   */
  cstk_path path;
  /**
   * The lengths of the given path and of this one, which is never longer: sums of cstk_space_distance without weights.
   */
  double length_before;
  double length_after;
  /**
   * How many times the path was cut.
   */
  uint64_t cuts;
  /**
   * As cstk_motion_path tells it: the first segment of the given path that is not proved free, with some contact of it, or the last.
   * Unlike there, no points are looked at before.
   */
  cstk_path_result given;
  uint64_t reserved[8];
} cstk_shortcut_result;


/**
 * Writes the default options. `size` is sizeof(cstk_motion_options).
 */
cstk_status cstk_motion_options_default(cstk_motion_options *out, size_t size);

/**
 * Proves that the motion from q0 to q1 keeps clear of a C-object, or finds its first contact. The motion is that of
 * cstk_space_interpolate, as time goes from 0 to 1; the environments are those at the call. `q0` and `q1` have `nq` doubles;
 * `options` may be NULL for the defaults; `reached` may be NULL, or receives the configuration at times[1], `nq` doubles, and
 * may be q0 or q1.
 *
 * Every C-object that cstk_classify takes: links, link pairs, attached objects, unions, intersections, complements. Of the
 * complement of an induced set freedom is proved where primitives overlap more deeply than the motion can change, or where a body is
 * inside a solid; elsewhere the answer may be near. With a threshold above 0 the complement of an induced set counts as contact
 * everywhere, as for cstk_within. CSTK_ERROR_UNSUPPORTED, naming the set, for predicates that do not measure and for custom joints
 * that move without stating their speeds; and for a threshold above 0 where lengths and units of C-space mix.
 *
 * A solid that the motion starts outside of is not entered without contact. A motion along contact at a distance of 0 is a hit at
 * its start; one that grazes ends near.
 * Bodies that keep their places relative to each other are asked at the start alone. Where the motion takes them so far away that
 * their places are rounded by more than their gap, cstk_classify may call them inside.
 */
cstk_status cstk_motion(cstk_query *query,
                        const cstk_cobject *cobject,
                        const double *q0,
                        const double *q1,
                        size_t nq,
                        const cstk_motion_options *options,
                        double *reached,
                        cstk_motion_result *out);

/**
 * Proves that a path keeps clear of a C-object, or finds its first contact: cstk_motion for each of its segments in turn, all in
 * the state that the environments are in at the call. `points` has point_count * nq doubles, one configuration after the other;
 * `point_count` is at least 1, and a single point is a segment that rests. `options` are those of cstk_motion, and may be NULL for the
 * defaults; their tolerance is of each segment's time. `progress` may be NULL; it is called before each segment, and `user` is
 * passed to it. `reached` may be NULL, or receives the configuration at motion.times[1] of the segment, `nq` doubles.
 *
 * Unless the outcome is a hit and any_contact was set, all segments before the one of the answer are proved free. With
 * any_contact, the points and the middles of the segments are looked at first, so that most contacts are found in a fraction of the
 * time of a proof.
 *
 * The limit of cstk_query_set_limit counts for the whole path. What it ends is CSTK_MOTION_UNDECIDED, never CSTK_ERROR_LIMIT.
 * CSTK_ERROR_WRONG_SIZE if there is no point, or `nq` is not that of the space; errors name the point or the segment.
 * CSTK_ERROR_CANCELLED where `progress` says so. CSTK_ERROR_UNSUPPORTED as for cstk_motion.
 */
cstk_status cstk_motion_path(cstk_query *query,
                             const cstk_cobject *cobject,
                             const double *points,
                             size_t point_count,
                             size_t nq,
                             const cstk_motion_options *options,
                             cstk_progress_fn progress,
                             void *user,
                             double *reached,
                             cstk_path_result *out);

/**
 * Proves that the motion on a Bezier curve keeps clear of a C-object, or finds its first contact, as cstk_motion does on a segment.
 * `points` has count * nq doubles, the control points, one configuration after the other; `count` is from 1 to 17. At time t each
 * coordinate is what de Casteljau's construction makes of its control values; coordinates on circles are not taken the shorter way
 * round. Coordinates of joints with quaternions must be the same in all control points: CSTK_ERROR_UNSUPPORTED otherwise.
 * `options`, `reached` and `out` as for cstk_motion. CSTK_ERROR_WRONG_SIZE if there is no point or `nq` is not that of the space.
 */
cstk_status cstk_motion_curve(cstk_query *query,
                              const cstk_cobject *cobject,
                              const double *points,
                              size_t count,
                              size_t nq,
                              const cstk_motion_options *options,
                              double *reached,
                              cstk_motion_result *out);

/**
 * The same on a B-spline of a degree from 1 to 16, with `count` control points, more than its degree, and `knot_count` knots that
 * never fall: count + degree + 1 of them. The parameter goes from the knot of number `degree` to that of number `count`; times of
 * the result go from 0 to 1 in proportion to it. What is before and behind is the caller's to leave out. A knot between the two
 * stands there at most `degree` times: with more the curve may jump, which is CSTK_ERROR_INVALID_ARGUMENT.
 */
cstk_status cstk_motion_spline(cstk_query *query,
                               const cstk_cobject *cobject,
                               size_t degree,
                               const double *knots,
                               size_t knot_count,
                               const double *points,
                               size_t count,
                               size_t nq,
                               const cstk_motion_options *options,
                               double *reached,
                               cstk_motion_result *out);

/**
 * Proves that a motion that `function` gives keeps clear of a C-object, or finds its first contact, as cstk_motion does on a segment.
 * `user` is passed to `function`. `max_rates` and `max_accelerations` have `nq` doubles each, at least 0: bounds of the absolute
 * first and second derivatives of every coordinate for all times from 0 to 1. The configuration and its first derivative are
 * continuous; the second may jump. What is proved holds if the rates are the derivatives of q and these bounds hold. Both are
 * compared with what `function` gives wherever it is asked, at times in any order, and CSTK_ERROR_INVALID_ARGUMENT names the time and
 * the coordinate that does not fit.
 *
 * Coordinates on circles are not taken the shorter way round. Coordinates of joints with quaternions must not change, and their
 * max_rates be 0: CSTK_ERROR_UNSUPPORTED otherwise. `options`, `reached` and `out` as for cstk_motion. CSTK_ERROR_WRONG_SIZE if `nq`
 * is not that of the space.
 */
cstk_status cstk_motion_function(cstk_query *query,
                                 const cstk_cobject *cobject,
                                 cstk_motion_fn function,
                                 void *user,
                                 const double *max_rates,
                                 const double *max_accelerations,
                                 size_t nq,
                                 const cstk_motion_options *options,
                                 double *reached,
                                 cstk_motion_result *out);

/**
 * Proves that two bodies that move keep farther apart than the threshold, or finds their first contact. From time 0 to 1 each body
 * goes from its start to its end on a screw: with constant velocity in its own frame, by the shortest rotation. A translation is a
 * straight line, and is followed exactly. Poses are 12 doubles, row-major [R | t], the body's frame in the world.
 *
 * `options` are those of cstk_motion, and may be NULL. `reached` may be NULL, or receives the poses of both bodies at times[1], 24
 * doubles. `out` as for cstk_motion; a body inside a solid one is in contact, as for cstk_pair_within.
 * CSTK_ERROR_INVALID_ARGUMENT for bodies of different dimension.
 */
cstk_status cstk_pair_motion(cstk_query *query,
                             const cstk_body *body_a,
                             const double *start_a,
                             const double *end_a,
                             const cstk_body *body_b,
                             const double *start_b,
                             const double *end_b,
                             const cstk_motion_options *options,
                             double *reached,
                             cstk_motion_result *out);

/**
 * Writes the default options. `size` is sizeof(cstk_clearance_options).
 */
cstk_status cstk_clearance_options_default(cstk_clearance_options *out, size_t size);

/**
 * Finds the least distance from a C-object along the motion from q0 to q1, that of cstk_motion: two bounds, the lower one proved for
 * every time, the upper one the distance at a time of the motion. Distances are those of cstk_distance, less the margins of the
 * C-object. It takes a few times as long as cstk_motion, for small tolerances longer.
 *
 * `q0` and `q1` have `nq` doubles; `clearance_options` must not be NULL; `nearest` may be NULL, or receives the configuration at
 * `time`, `nq` doubles, and may be q0 or q1. CSTK_ERROR_UNSUPPORTED as for cstk_motion, for C-objects that hold an intersection or a
 * complement, from which no exact distance is known, and for pure sets without a scale among
 * induced ones.
 */
cstk_status cstk_motion_clearance(cstk_query *query,
                                  const cstk_cobject *cobject,
                                  const double *q0,
                                  const double *q1,
                                  size_t nq,
                                  const cstk_clearance_options *clearance_options,
                                  double *nearest,
                                  cstk_clearance_result *out);

/**
 * Finds the least distance from a C-object along a path: that of cstk_motion_clearance over all its segments, in the state that the
 * environments are in at the call. `points` has count * nq doubles, one configuration after the other; `count` is at least 1, and a
 * single point is a segment that rests. `clearance_options` are those of cstk_motion_clearance and must not be NULL. `nearest`
 * may be NULL, or receives the configuration at the nearest place, `nq` doubles. `progress` may be NULL; it is called before each
 * segment, and `user` is passed to it.
 *
 * Segments whose points are near come first; of most others it is only proved that they are no nearer than what was found. So
 * it takes little longer than cstk_motion_path, but for the segments near the nearest place. A path that meets the C-object ends the
 * search: its contact is not always the first.
 *
 * The limit of cstk_query_set_limit counts for the whole path. What it ends is CSTK_CLEARANCE_UNDECIDED, with a lower bound of 0, once
 * a first segment is known; CSTK_ERROR_LIMIT before. CSTK_ERROR_WRONG_SIZE if there is no point, or `nq` is not that of the space;
 * errors name the point or the segment. CSTK_ERROR_CANCELLED where `progress` says so. CSTK_ERROR_UNSUPPORTED as for
 * cstk_motion_clearance.
 */
cstk_status cstk_path_clearance(cstk_query *query,
                                const cstk_cobject *cobject,
                                const double *points,
                                size_t count,
                                size_t nq,
                                const cstk_clearance_options *clearance_options,
                                cstk_progress_fn progress,
                                void *user,
                                double *nearest,
                                cstk_path_clearance_result *out);

/**
 * Writes the default options. `size` is sizeof(cstk_shortcut_options).
 */
cstk_status cstk_shortcut_options_default(cstk_shortcut_options *out, size_t size);

/**
 * Makes a path shorter by straight motions that are proved free: for each attempt two places on the path are drawn, uniformly by
 * length, and what lies between them is replaced by the straight motion where that is shorter and proved free. Its ends
 * stay, to the last bit. The given path is proved first. All is done in the state that the environments are in at the call.
 *
 * `points` has count * nq doubles, one configuration after the other; `count` is at least 1. `options` may be NULL for the defaults.
 * `progress` may be NULL; it is called before each segment of the given path and before each attempt, and `user` is passed to
 * it. The path of the answer belongs to the query context; it may be given to the next call.
 *
 * The limit of cstk_query_set_limit counts for the whole call. An attempt costs a motion that any contact ends, and where
 * it succeeds two more. CSTK_ERROR_WRONG_SIZE if there is no point, or `nq` is not that of the space; errors name the point or the
 * segment. CSTK_ERROR_CANCELLED where `progress` says so. CSTK_ERROR_UNSUPPORTED as for cstk_motion.
 */
cstk_status cstk_path_shortcut(cstk_query *query,
                               const cstk_cobject *cobject,
                               const double *points,
                               size_t count,
                               size_t nq,
                               const cstk_shortcut_options *options,
                               cstk_progress_fn progress,
                               void *user,
                               cstk_shortcut_result *out);

/** @} */

/**
 * @defgroup certificate Certificates
 *
 * A proof that a whole motion is free, kept for those who must trust the answer. A certificate lists what it claims: two bodies, or
 * groups of their primitives, keep apart along a direction over an interval of time. cstk_certificate_verify checks a certificate by
 * a short routine of its own, which uses forward kinematics and support points and nothing of what found the proof. Certificates are
 * saved and loaded (docs/certificate-file.md), and are about content, not handles: they hold for robots, bodies and environments
 * that were made anew alike.
 *
 * @code
     cstk_certificate *certificate;
     cstk_motion_result found;
     check(cstk_motion_certificate(query, cobject, q0, q1, nq, NULL, NULL, &found, &certificate));
     if (certificate != NULL) {
         check(cstk_certificate_verify(certificate, cobject, q0, q1, nq, 0));
         check(cstk_certificate_save(certificate, "edge.certificate"));
     }
     check(cstk_certificate_release(certificate));
 * @endcode
 * @{
 */

/**
 * A proof that a motion keeps clear of a C-object. Immutable; threads may share it. It refers to no other object.
 */
typedef struct cstk_certificate cstk_certificate;

/**
 * What a certificate is of.
 */
typedef struct cstk_certificate_summary {
  /**
   * The number of coordinates of its motion.
   */
  size_t nq;
  /**
   * The number of its entries.
   */
  size_t entry_count;
  /**
   * Everything stays farther away than this; a length.
   */
  double threshold;
  /**
   * A SHA-256 digest of the robots, bodies, poses, margins and sets that it is about.
   */
  uint8_t fingerprint[32];
  uint64_t reserved[8];
} cstk_certificate_summary;

/**
 * One claim of a certificate: over an interval of time two groups of primitives stay farther apart than the threshold and the margin,
 * since gap - displacement is larger. Along the direction their gap is at least `gap` at both ends of the interval, and in between
 * no point of them moves off the line between its two places by more than `displacement`, seen from the body that carries the
 * direction. Of a floor or a side of the world box, the second side is the plane; of a set given in C-space there are no bodies, and gap
 * and displacement are of its distance.
 */
typedef struct cstk_certificate_entry {
  /**
   * The number of what the C-object asks about, in an order by content (docs/certificate-file.md): body pairs, links over floors or
   * in the world box, sets given in C-space. Several entries may be of one item.
   */
  uint32_t item;
  /**
   * The side in whose body's frame the direction rests: 0 or 1.
   */
  uint32_t carrier;
  /**
   * The links that carry the bodies of the two sides, r-side first; UINT32_MAX for what rests in the world.
   */
  uint32_t links[2];
  /**
   * The number of primitives of each side; cstk_certificate_get_primitives lists them.
   */
  uint32_t primitive_counts[2];
  /**
   * The interval, within 0 and 1.
   */
  double times[2];
  /**
   * Of length 1, from the second side to the first; 0 for a set given in C-space.
   */
  double direction[3];
  /**
   * With rounding counted; lengths.
   */
  double gap;
  double displacement;
  uint64_t reserved[4];
} cstk_certificate_entry;


/**
 * The same as cstk_motion, with a certificate where the motion is free. `certificate` receives one, or NULL where the motion is not
 * free. Making it takes longer than the proof of cstk_motion, by far for meshes.
 *
 * In rare cases the motion is free, and the certificate cannot show it: where it comes as near the threshold as rounding, the outcome
 * is CSTK_MOTION_NEAR; where the limit of cstk_query_set_limit ended the making, CSTK_MOTION_UNDECIDED with times of 1.
 *
 * Certificates are of links against s-objects and one another, attached objects, margins and allowed pairs, solids, floors, the world box,
 * limits, boxes, half-spaces and balls of C-space, and of unions of these. Of an intersection they show, one interval after another,
 * that the motion keeps out of some part. CSTK_ERROR_UNSUPPORTED, naming the leaf, for complements, predicates, and bodies
 * with a support function of the caller's, but for parts of intersections that are free without them; and as for cstk_motion.
 * CSTK_ERROR_LIMIT for more than 4 million body pairs or steps of the proof.
 */
cstk_status cstk_motion_certificate(cstk_query *query,
                                    const cstk_cobject *cobject,
                                    const double *q0,
                                    const double *q1,
                                    size_t nq,
                                    const cstk_motion_options *options,
                                    double *reached,
                                    cstk_motion_result *out,
                                    cstk_certificate **certificate);

/**
 * Adds a reference.
 */
cstk_status cstk_certificate_retain(cstk_certificate *certificate);

/**
 * Drops a reference. NULL is a no-op.
 */
cstk_status cstk_certificate_release(cstk_certificate *certificate);

/**
 * Checks that a certificate proves the motion from q0 to q1 free of a C-object in the state that its environments are in at the call,
 * and farther away than `threshold` everywhere. CSTK_OK if it does. CSTK_ERROR_NOT_PROVED if it does not, with the entry that
 * fails in the message: if the certificate was made for other bodies, poses, robots or sets, another motion or threshold, or if it
 * was altered. `q0` and `q1` have `nq` doubles.
 *
 * What an entry claims is computed anew from the bodies' primitives at the link poses of both ends of its interval, with rounding
 * counted; that the entries cover all primitives of all body pairs that the C-object asks about, at all times, is checked too. Maps of
 * custom joints are called and must be what they were; the speeds that they state are taken for granted. All else as
 * for cstk_motion.
 */
cstk_status cstk_certificate_verify(const cstk_certificate *certificate,
                                    const cstk_cobject *cobject,
                                    const double *q0,
                                    const double *q1,
                                    size_t nq,
                                    double threshold);

/**
 * Writes what a certificate is of.
 */
cstk_status cstk_certificate_get_summary(const cstk_certificate *certificate,
                                         cstk_certificate_summary *out);

/**
 * Writes the first and last configuration of the motion, `nq` doubles each; CSTK_ERROR_WRONG_SIZE if it has another number of
 * coordinates.
 */
cstk_status cstk_certificate_get_ends(const cstk_certificate *certificate,
                                      size_t nq,
                                      double *q0,
                                      double *q1);

/**
 * Writes an entry, counted from 0.
 */
cstk_status cstk_certificate_get_entry(const cstk_certificate *certificate,
                                       size_t index,
                                       cstk_certificate_entry *out);

/**
 * Lists the primitives of one side of an entry, 0 or 1, by their indices in the body. At most `max_count` are written to
 * `primitives` (NULL if `max_count` is 0), and their full number to `count`.
 */
cstk_status cstk_certificate_get_primitives(const cstk_certificate *certificate,
                                            size_t index,
                                            uint32_t side,
                                            size_t max_count,
                                            uint32_t *primitives,
                                            size_t *count);

/**
 * Saves a certificate to a file. An existing file is replaced only once everything is written. CSTK_ERROR_IO if the file
 * cannot be written.
 */
cstk_status cstk_certificate_save(const cstk_certificate *certificate,
                                  const char *file);

/**
 * Loads a certificate that cstk_certificate_save wrote. It proves nothing before cstk_certificate_verify accepts it, wherever the file
 * comes from. CSTK_ERROR_IO if the file cannot be read, CSTK_ERROR_PARSE if it is truncated, altered or no certificate file,
 * CSTK_ERROR_UNSUPPORTED for another version of the format. The memory used is bounded by the size of the file.
 */
cstk_status cstk_certificate_load(const char *file,
                                  cstk_certificate **out);

/** @} */

/**
 * @defgroup region Regions
 *
 * Whole boxes of C-space, proved free or inside, and boxes grown around a configuration until contacts stop them. What is called
 * free is so at every configuration of the box: bounds over parts of the box cover it, no sample decides.
 *
 * @code
     cstk_region_result around;
     double low[6], high[6];
     check(cstk_region_grow(query, cobject, q, nq, NULL, 0, NULL, low, high, NULL, 0));
     check(cstk_region_classify(query, cobject, low, high, nq, NULL, NULL, NULL, &around));
     if (around.outcome == CSTK_REGION_FREE) {
         printf("joint 0 may go from %g to %g, whatever the others do in the box\n", low[0], high[0]);
     }
 * @endcode
 * @{
 */

/**
 * What is known of a box. "Inside" is CSTK_CLASS_INSIDE, as cstk_classify says it.
 */
enum cstk_region_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Proved: no configuration of the box is inside the C-object.
   */
  CSTK_REGION_FREE = 0,
  /**
   * Proved: every configuration of the box is inside.
   */
  CSTK_REGION_INSIDE = 1,
  /**
   * One configuration of the box is inside, and another is not.
   */
  CSTK_REGION_MIXED = 2,
  /**
   * Neither was found with max_boxes parts, or within the limit of cstk_query_set_limit, or some part is too small to be halved: within
   * rounding of a contact, where more parts do not help. (Where the class of a single configuration already needs more, the call
   * ends with CSTK_ERROR_LIMIT.)
   */
  CSTK_REGION_UNDECIDED = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_region_outcome cstk_region_outcome;
#else
typedef int32_t cstk_region_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What stops a side of a grown box.
 */
enum cstk_side_stop
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * It was not to grow: its weight is 0, or it belongs to a quaternion or to the rotation of a free joint.
   */
  CSTK_SIDE_FIXED = 0,
  /**
   * The end of the coordinate's range; on a circle half a turn from q.
   */
  CSTK_SIDE_RANGE = 1,
  /**
   * max_side of the options.
   */
  CSTK_SIDE_MAX = 2,
  /**
   * There is contact at a configuration that the tolerance would add: `distance` says of what.
   */
  CSTK_SIDE_CONTACT = 3,
  /**
   * What the tolerance would add could not be proved free with max_boxes parts; `distance` is that in the part looked at
   * last.
   */
  CSTK_SIDE_UNPROVED = 4,
  /**
   * The limit of cstk_query_set_limit ended the growth.
   */
  CSTK_SIDE_LIMITED = 5,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_side_stop cstk_side_stop;
#else
typedef int32_t cstk_side_stop;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Options of cstk_region_classify. Write it with cstk_region_options_default first.
 */
typedef struct cstk_region_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * The most parts that the box is halved into, at least 1. Default 1000.
   */
  uint64_t max_boxes;
} cstk_region_options;

/**
 * Options of cstk_region_grow. Write it with cstk_growth_options_default first.
 */
typedef struct cstk_growth_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * A side is stopped when it cannot grow by this times its weight, or by a quarter of what all sides could grow together, if that
   * is less; above 0. Smaller values take more proofs. Default 0.01.
   */
  double tolerance;
  /**
   * No side goes farther from q than this times its weight; finite, above 0. Default 4.
   */
  double max_side;
  /**
   * The most parts that each proof halves its box into, at least 1. Default 200.
   */
  uint64_t max_boxes;
} cstk_growth_options;

/**
 * What was found of a box.
 */
typedef struct cstk_region_result {
  cstk_region_outcome outcome;
  /**
   * A configuration that is inside is known.
   */
  bool has_inside;
  /**
   * A configuration that is not inside is known.
   */
  bool has_outside;
  uint8_t reserved_bytes[2];
  /**
   * The part of the box's volume that is proved to be as its middle is, from 0 to 1; 0 for a mixed box.
   */
  double proved;
  uint64_t reserved[8];
} cstk_region_result;

/**
 * A side of a grown box.
 */
typedef struct cstk_region_side {
  cstk_side_stop stop;
  /**
   * `distance` is set: for contacts and what is unproved, unless lengths and units of C-space mix in the C-object.
   */
  bool has_distance;
  uint8_t reserved_bytes[3];
  /**
   * The distance, with its witness, at a configuration that stops the side.
   */
  cstk_distance_result distance;
  uint64_t reserved[4];
} cstk_region_side;


/**
 * Writes the default options. `size` is sizeof(cstk_region_options).
 */
cstk_status cstk_region_options_default(cstk_region_options *out, size_t size);

/**
 * Writes the default options. `size` is sizeof(cstk_growth_options).
 */
cstk_status cstk_growth_options_default(cstk_growth_options *out, size_t size);

/**
 * Proves that no configuration of a box is inside a C-object, or that all are, or finds one of each. `low` and `high` have `nq`
 * doubles in the units of configurations, none of `low` above its partner; coordinates may be equal. On a circle the box is the arc
 * from `low` upwards to `high`, which may pass the place where angles wrap. `options` may be NULL for the defaults; `inside` and
 * `outside` may be NULL, or receive configurations of the box, `nq` doubles, where the result says that they are known.
 *
 * The entries of a quaternion must be equal in `low` and `high`, and no custom joint may move that does not state its speeds:
 * CSTK_ERROR_UNSUPPORTED otherwise. The cost grows with the number of parts: a part takes some microseconds.
 */
cstk_status cstk_region_classify(cstk_query *query,
                                 const cstk_cobject *cobject,
                                 const double *low,
                                 const double *high,
                                 size_t nq,
                                 const cstk_region_options *options,
                                 double *inside,
                                 double *outside,
                                 cstk_region_result *out);

/**
 * Grows a box around q that is proved free: no configuration of it is inside the C-object, which q must not be. First all sides grow
 * together, then each as far as it can, in turn. `low` and `high` receive its ends, `nq` doubles each; one of them may be q. Angles
 * do not wrap: on a circle the box is the arc from `low` upwards to `high`. Quaternions stay as they are. The box is within the
 * coordinates' ranges unless q is not. The same call has the same answer.
 *
 * `weights` has `nv` doubles, at least 0: a side of weight 2 grows twice as far as one of weight 1, one of weight 0 not at all.
 * It may be NULL with an `nv` of 0: then each is 1, a radian or a length. `options` may be NULL for the defaults. `sides` may be
 * NULL with a `side_count` of 0; else it receives what stops each side, twice as many as the space has velocities: the lower side of
 * the first, its upper side, the lower side of the second, and so on; of a free joint's position, those of x, y and z stand with its
 * linear velocities.
 *
 * CSTK_ERROR_INVALID_ARGUMENT where q is inside, CSTK_ERROR_UNSUPPORTED where a custom joint would move that does not state its
 * speeds. The cost is that of some hundred calls of cstk_region_classify; sides of many turns of a joint take as many times more.
 */
cstk_status cstk_region_grow(cstk_query *query,
                             const cstk_cobject *cobject,
                             const double *q,
                             size_t nq,
                             const double *weights,
                             size_t nv,
                             const cstk_growth_options *options,
                             double *low,
                             double *high,
                             cstk_region_side *sides,
                             size_t side_count);

/** @} */

/**
 * @defgroup slide Slides
 *
 * Steps that slide along contacts, proved free on their whole way: one, or as many as lead to a goal; and the two halves of a step
 * for callers who combine them themselves (§2.2.4, Appendix A).
 *
 * @code
     cstk_slide_options options;
     cstk_slide_result slid;
     check(cstk_slide_options_default(&options, sizeof options));
     options.max_shell = 0.05;
     check(cstk_slide(query, cobject, q, nq, step, nv, &options, q, &slid));
     cstk_slide_to_options way;
     cstk_slide_to_result led;
     check(cstk_slide_to_options_default(&way, sizeof way));
     way.step = 0.02;
     check(cstk_slide_to(query, cobject, q0, q1, q1, nq, NULL, 0, &options, &way, NULL, NULL, &led));
     printf("%zu configurations\n", led.path.count);
 * @endcode
 * @{
 */

/**
 * How a slide ended.
 */
enum cstk_slide_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * A step was found, and the whole motion is proved free.
   */
  CSTK_SLIDE_MOVED = 0,
  /**
   * The configuration is inside the C-object; it is not moved.
   */
  CSTK_SLIDE_INSIDE = 1,
  /**
   * No step is possible: contacts, ranges or the world box block the way, or q itself violates ranges or box (a joint
   * held by a range of one value must have it to the last bit; see cstk_space_clamp). The configuration is not moved. To
   * first order, no step as long as the floor that stays free, keeps its distance (or the desired one, if that is less),
   * the ranges and the box gains more than 1 % of its length along the requested step. With a contact_count of 0 the
   * step is 0, or ranges or the world box block it, or the shell is so short that even a step of the floor's length
   * leads beyond it.
   */
  CSTK_SLIDE_BLOCKED = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_slide_outcome cstk_slide_outcome;
#else
typedef int32_t cstk_slide_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Why a slide to a goal ended.
 */
enum cstk_slide_to_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The last configuration is in the goal, or no farther from it than the tolerance.
   */
  CSTK_SLIDE_TO_ARRIVED = 0,
  /**
   * q is inside the C-object; it is not moved.
   */
  CSTK_SLIDE_TO_INSIDE = 1,
  /**
   * No sliding step is possible: see CSTK_SLIDE_BLOCKED.
   */
  CSTK_SLIDE_TO_BLOCKED = 2,
  /**
   * Steps are possible, but more than max_idle_steps in a row gained nothing.
   */
  CSTK_SLIDE_TO_IDLE = 3,
  /**
   * max_steps sliding steps were taken.
   */
  CSTK_SLIDE_TO_STEPS = 4,
  /**
   * The limit of cstk_query_set_limit ended the work.
   */
  CSTK_SLIDE_TO_LIMITED = 5,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_slide_to_outcome cstk_slide_to_outcome;
#else
typedef int32_t cstk_slide_to_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Options of a slide. Write it with cstk_slide_options_default first, then set `max_shell`.
 */
typedef struct cstk_slide_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * Contacts up to this distance constrain the step. Must be set, larger than 0; two or three times as far as a step
   * moves the robot works well. Parts of the C-object may have their own shells: see cstk_cobject_with_shell.
   */
  double max_shell;
  /**
   * The distance at which the robot slides; where it is nearer it is pushed out. Negative, the default, means a tenth of
   * max_shell. Independent of the C-object's contact epsilon. For a part with its own shell it is scaled with that
   * shell.
   */
  double desired_distance;
  /**
   * Nonzero: lengthens the step along the contact to the length of the requested step, at most fourfold. 0, the default,
   * keeps what is left of the step. (The report's normalize?)
   */
  uint32_t normalize;
  /**
   * The most witnesses considered, the nearest first. Default 256.
   */
  uint32_t max_witnesses;
  /**
   * A step is halved until it is accepted, or shorter than this fraction of the requested step. Default 1/1024.
   */
  double floor;
} cstk_slide_options;

/**
 * The result of a slide.
 */
typedef struct cstk_slide_result {
  cstk_slide_outcome outcome;
  /**
   * The number of contacts within the shells at q.
   */
  uint32_t contact_count;
  /**
   * The distance at q, and at the configuration reached.
   */
  double distance_before;
  double distance_after;
  uint64_t reserved[8];
} cstk_slide_result;

/**
 * Options of cstk_slide_to. Write it with cstk_slide_to_options_default first, then set `step`. Lengths are those of
 * cstk_space_distance with the weights of the call.
 */
typedef struct cstk_slide_to_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * The length of a sliding step. Must be set, larger than 0.
   */
  double step;
  /**
   * The robot has arrived where it is no farther than this from the goal; at least 0, the default: in the goal.
   */
  double tolerance;
  /**
   * A sliding step that comes nearer to the goal by less than this part of `step` gains nothing; at least 0, less than 1.
   * Default 0.05.
   */
  double min_gain;
  /**
   * No more sliding steps than this are taken; at least 1. Default 1000.
   */
  uint64_t max_steps;
  /**
   * The slide ends after more than this many steps in a row that gain nothing. Corners take one or two. Default 3.
   */
  uint64_t max_idle_steps;
  /**
   * The straight motion to the goal is tried at the start, after this many sliding steps each time, and within a step of the goal; at
   * least 1. Default 8.
   */
  uint64_t steps_between_motions;
} cstk_slide_to_options;

/**
 * Where a slide to a goal led.
 */
typedef struct cstk_slide_to_result {
  cstk_slide_to_outcome outcome;
  uint32_t reserved_word;
  /**
   * The configurations from q on. The motion from each to the next, that of cstk_space_interpolate, is proved free.
   */
  cstk_path path;
  /**
   * How far the last of them is from the goal.
   */
  double remaining;
  /**
   * How many sliding steps were tried, and how many straight motions to the goal.
   */
  uint64_t steps;
  uint64_t motions;
  uint64_t reserved[8];
} cstk_slide_to_result;


/**
 * Writes the default options. `size` is sizeof(cstk_slide_options).
 */
cstk_status cstk_slide_options_default(cstk_slide_options *out, size_t size);

/**
 * Takes one step from q that slides along contacts instead of running into them (Appendix A). Where nothing is within the
 * shell, it is `step` itself. Otherwise it is the nearest step (by the unweighted sum of squared velocities) that brings
 * no contact nearer than the desired distance (or than the nearest contact, if that is nearer) and keeps to the ranges and
 * the world box. A robot within the desired distance is pushed out to it. The step is corrected at its end, and halved
 * until the whole motion is proved free. Along a contact only part of the step is left; see `normalize`.
 *
 * The proof is that of cstk_motion: each pair of primitives, and each link with a floor or the world box, is parted by
 * bounds over intervals of the way, so that a robot slides along what is only a rounding error away. The way is the straight one by
 * the velocity that leads to `reached`, a part of `step` and what contacts turned it to: a step of more than half a turn about a circle
 * goes all of it, where cstk_motion from q to `reached` would go the shorter way. Pairs that no joint of
 * the step moves relative to each other may touch. For a pair that touches at q and moves, the gradients of its contacts are
 * trusted for the first 1e-4 of max_shell (or of the radius of the smallest body that a link carries); from there on it must be apart, unless the
 * whole motion is shorter, or a plane separates the two bodies and the motion goes along it. So it is for a pair that is apart at q by
 * no more than rounding (some 1e-11 of its size and place), but its contacts stay apart, to second order. Of two bodies with more than
 * 64 primitive pairs only the nearest constrain a step: at most 8, no more than 1 % of the shell farther apart than the
 * nearest.
 *
 * `slide_options` must not be NULL. `q` and `reached` have `nq` doubles and may be the same; `step`, a velocity for a unit
 * of time, has `nv`. Unless the outcome is CSTK_SLIDE_MOVED, `reached` receives q. A slide may creep, gaining little more
 * than 1 % a step: callers who want to stop then should check the gain. The C-object must be an induced set, a pure set
 * other than a predicate, or a union of such: CSTK_ERROR_UNSUPPORTED otherwise, and where a custom joint that changes some
 * distance does not state its speeds.
 */
cstk_status cstk_slide(cstk_query *query,
                       const cstk_cobject *cobject,
                       const double *q,
                       size_t nq,
                       const double *step,
                       size_t nv,
                       const cstk_slide_options *slide_options,
                       double *reached,
                       cstk_slide_result *out);

/**
 * The report's slide-step. From a list with gradients (cstk_gradients, or cstk_pseudo_normal without `normalize`),
 * computes the step nearest to `step` that brings no contact nearer than `desired_distance`, and contacts that are nearer
 * already no nearer still. It is a first-order step: ranges are ignored and the motion is not checked. `normalize` is that
 * of cstk_slide_options. `step` and `out` have `nv` doubles, that of the list, and may be the same. `found` is false, and
 * `out` zero, where less than 1 % of the step would be left.
 */
cstk_status cstk_slide_step(const cstk_witness_list *list,
                            const double *step,
                            size_t nv,
                            double desired_distance,
                            bool normalize,
                            double *out,
                            bool *found);

/**
 * The report's compute-spring-step: the shortest step that takes all contacts of a list out to `desired_distance`, to
 * first order; where contacts oppose each other, out to the largest distance they can share. No step is longer than 1000 times what one
 * contact alone asks for: contacts that oppose each other to within a thousandth count as opposed. `out` has `nv` doubles.
 * `found` is false, and `out` zero, where no contact is nearer or none can move out. See cstk_slide_step for the list.
 */
cstk_status cstk_spring_step(const cstk_witness_list *list,
                             size_t nv,
                             double desired_distance,
                             double *out,
                             bool *found);

/**
 * Writes the default options. `size` is sizeof(cstk_slide_to_options).
 */
cstk_status cstk_slide_to_options_default(cstk_slide_to_options *out, size_t size);

/**
 * Leads the robot from q towards a goal: straight as far as that is proved free, then by steps of cstk_slide towards the goal, with
 * another straight motion from time to time, until it has arrived, is blocked or gets no farther. It looks ahead by one
 * step and remembers nothing: what a planner calls its local planner. All is done in the state that the environments are in at the
 * call; the same call has the same answer.
 *
 * The goal is the box from `goal_low` to `goal_high`, which may be the same pointer: then it is one configuration. On a circle the box
 * is the arc from low upwards to high. A coordinate from -INFINITY to INFINITY may have any value. The entries of a
 * quaternion must be equal in both, or all four be free. `q`, `goal_low` and `goal_high` have `nq` doubles. `weights` has `nv`
 * doubles, larger than 0, and may be NULL with an `nv` of 0: then each is 1. What is measured is the distance from the nearest
 * configuration of the box, each velocity multiplied by its weight.
 *
 * `slide_options` are those of cstk_slide, `options` those of the whole way; neither may be NULL. `progress` may be NULL; it is called
 * before each sliding step, and `user` is passed to it. The path of the answer belongs to the query context; it may be given to the
 * next call. It keeps to the ranges and the world box at its points, unless q does not: then it is blocked.
 *
 * A motion whose start touches is proved as cstk_slide proves it; all others cstk_motion proves too. Where q is in the goal the path is q
 * alone, and nothing is asked. The limit of cstk_query_set_limit counts for the whole way and ends it with
 * CSTK_SLIDE_TO_LIMITED. CSTK_ERROR_CANCELLED where `progress` says so. CSTK_ERROR_UNSUPPORTED as for cstk_slide, but only where a sliding
 * step is needed: what the straight motion decides is answered for every C-object that cstk_motion takes.
 */
cstk_status cstk_slide_to(cstk_query *query,
                          const cstk_cobject *cobject,
                          const double *q,
                          const double *goal_low,
                          const double *goal_high,
                          size_t nq,
                          const double *weights,
                          size_t nv,
                          const cstk_slide_options *slide_options,
                          const cstk_slide_to_options *options,
                          cstk_progress_fn progress,
                          void *user,
                          cstk_slide_to_result *out);

/** @} */

/**
 * @defgroup batch Batches
 *
 * Many configurations, motions or pairs of poses in one call, on several threads, all in the state that the environments are in at the
 * call. Answers stand in order of the items, equal to those of single calls bit for bit, whatever the number of threads.
 *
 * Every item has a status. One that fails (a NaN among its coordinates, say) fails alone: the others are answered, and the call returns
 * CSTK_OK; cstk_last_error_message() then names the first that failed. Entries of items with another status than CSTK_OK mean nothing.
 * Where progress or the first hit ends a batch, the items that were not reached have CSTK_ERROR_CANCELLED, and those with CSTK_OK are
 * answered: unlike other calls, a batch that its progress function cancels has written to its arrays, and its cstk_batch_result, which
 * counts what was answered until then and has no hit. A call that fails otherwise has written nothing.
 *
 * Progress is told between items, every 20 milliseconds or more often, also while the last items are with other threads; an item that
 * has begun is answered before a cancelled call returns.
 *
 * The arrays are the caller's, and nobody else may use them during the call. What a batch reads may overlap; what it writes overlaps
 * nothing else, which CSTK_ERROR_INVALID_ARGUMENT refuses. Callbacks of C-objects and bodies
 * are called from the batch's threads, several at once.
 *
 * @code
     double configurations[1000 * 6] = {0};
     cstk_class classes[1000];
     cstk_status statuses[1000];
     cstk_batch_result done;
     cstk_batch *batch;
     check(cstk_batch_create(&batch));
     check(cstk_classify_batch(batch, cobject, configurations, 1000, 6, NULL, NULL, NULL, classes, statuses, &done));
     if (done.failed > 0) {
         fprintf(stderr, "%s\n", cstk_last_error_message());
     }
     check(cstk_batch_release(batch));
 * @endcode
 * @{
 */

/**
 * The caches and scratch memory of a batch's threads, kept from one call to the next: once warm, calls allocate a little for their
 * threads and nothing for their items. Items that do allocate are motions, gradients of pure sets and of custom joints, predicates,
 * balls of C-space, and contacts of what touches. A batch serves one call at a time; other calls meanwhile return CSTK_ERROR_BUSY.
 * Caches change how long answers take, never the answers.
 */
typedef struct cstk_batch cstk_batch;

/**
 * How a batch is worked off. Write it with cstk_batch_options_default first. Answers depend on `limit` alone.
 */
typedef struct cstk_batch_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * The number of threads, the caller's among them, at most 1024; 0, the default, for as many as the machine runs at once. Few
   * items have fewer.
   */
  uint32_t threads;
  /**
   * Nonzero: the batch ends at its first hit, the one with the lowest number. All items before it are answered, those after it have
   * the status CSTK_ERROR_CANCELLED. Default 0.
   */
  uint32_t stop_at_hit;
  /**
   * Limits the work of each item as cstk_query_set_limit does: an item that needs more has the status CSTK_ERROR_LIMIT (a motion
   * the outcome CSTK_MOTION_UNDECIDED). Each item is then asked as by a new context, so that nothing depends on other items
   * or threads; that takes longer. 0, the default, for no limit.
   */
  uint64_t limit;
} cstk_batch_options;

/**
 * How a batch ended; also written where its progress function cancels it, of the items until then.
 */
typedef struct cstk_batch_result {
  /**
   * How many items have the status CSTK_OK.
   */
  size_t answered;
  /**
   * How many have another, but for those that were not reached.
   */
  size_t failed;
  /**
   * The first of these, if `failed` is not 0. cstk_last_error_message() tells why it failed.
   */
  size_t first_failed;
  /**
   * The first hit, if `has_hit` is set.
   */
  size_t first_hit;
  /**
   * stop_at_hit was set, and there was a hit: of cstk_classify_batch CSTK_CLASS_INSIDE, of cstk_within_batch and
   * cstk_pair_within_batch true, of distances 0, of motions any outcome but CSTK_MOTION_FREE.
   */
  bool has_hit;
  uint8_t reserved_bytes[7];
  /**
   * The version of the environment that all items saw, the largest of several; 0 without an environment.
   */
  uint64_t environment_version;
  uint64_t reserved[4];
} cstk_batch_result;


/**
 * Creates a batch, without threads: they come and go with each call.
 */
cstk_status cstk_batch_create(cstk_batch **out);

/**
 * Adds a reference.
 */
cstk_status cstk_batch_retain(cstk_batch *batch);

/**
 * Drops a reference. NULL is a no-op.
 */
cstk_status cstk_batch_release(cstk_batch *batch);

/**
 * Writes the default options. `size` is sizeof(cstk_batch_options).
 */
cstk_status cstk_batch_options_default(cstk_batch_options *out, size_t size);

/**
 * Writes the work done by all threads of the batch since it was created, or since the last call with `reset`; `reset` sets the counts
 * to 0. What the threads remember, and with it the work, may differ from run to run.
 */
cstk_status cstk_batch_get_statistics(cstk_batch *batch,
                                      bool reset,
                                      cstk_query_statistics *out);

/**
 * cstk_classify for `count` configurations: `q` has count * nq doubles, one configuration after the other. `options` may be NULL for
 * the defaults. `progress` may be NULL; it is called on this thread, with the part of the items that is done, and `user` is passed to
 * it. `classes` and `statuses` receive `count` entries each, in order. A count of 0 is a batch without items; its arrays may be NULL.
 * Configurations that lie near each other in the order of `q`, those of a path say, are answered in less time.
 *
 * CSTK_ERROR_WRONG_SIZE if `nq` is not that of the space, or count * nq too large; CSTK_ERROR_CANCELLED where `progress` says so.
 */
cstk_status cstk_classify_batch(cstk_batch *batch,
                                const cstk_cobject *cobject,
                                const double *q,
                                size_t count,
                                size_t nq,
                                const cstk_batch_options *options,
                                cstk_progress_fn progress,
                                void *user,
                                cstk_class *classes,
                                cstk_status *statuses,
                                cstk_batch_result *out);

/**
 * cstk_within for `count` configurations; `within` and `statuses` receive `count` entries each. All else as for cstk_classify_batch.
 */
cstk_status cstk_within_batch(cstk_batch *batch,
                              const cstk_cobject *cobject,
                              const double *q,
                              size_t count,
                              size_t nq,
                              double threshold,
                              const cstk_batch_options *options,
                              cstk_progress_fn progress,
                              void *user,
                              bool *within,
                              cstk_status *statuses,
                              cstk_batch_result *out);

/**
 * cstk_distance for `count` configurations. `distances` and `results` receive `count` entries each: the field `distance`, and the whole
 * answer. `gradients` receives count * nv doubles, nv being the number of the space's velocities: row i is the gradient of
 * results[i].contact, as cstk_gradients has it for the nearest pair with CSTK_CONTACTS_NEAREST, and 0 where has_contact is false.
 * What is not wanted may be NULL, `nv` then 0 without gradients. All else as for cstk_classify_batch.
 */
cstk_status cstk_distance_batch(cstk_batch *batch,
                                const cstk_cobject *cobject,
                                const double *q,
                                size_t count,
                                size_t nq,
                                double max_distance,
                                const cstk_batch_options *options,
                                cstk_progress_fn progress,
                                void *user,
                                double *distances,
                                cstk_distance_result *results,
                                double *gradients,
                                size_t nv,
                                cstk_status *statuses,
                                cstk_batch_result *out);

/**
 * cstk_motion for `count` motions, number i from q0 + i * nq to q1 + i * nq: both have count * nq doubles. Of the segments of a path
 * with n points, `q1` is q0 + nq and `count` n - 1. `motion_options` are those of cstk_motion, and may be NULL for the defaults.
 * `reached` may be NULL, or receives count * nq doubles, the configurations at times[1]; unlike cstk_motion's it must be an array of
 * its own. `results` and `statuses` receive `count` entries each. All else as for cstk_classify_batch.
 */
cstk_status cstk_motion_batch(cstk_batch *batch,
                              const cstk_cobject *cobject,
                              const double *q0,
                              const double *q1,
                              size_t count,
                              size_t nq,
                              const cstk_motion_options *motion_options,
                              const cstk_batch_options *options,
                              cstk_progress_fn progress,
                              void *user,
                              double *reached,
                              cstk_motion_result *results,
                              cstk_status *statuses,
                              cstk_batch_result *out);

/**
 * cstk_pair_within for `count` pairs of poses: `poses_a` and `poses_b` have 12 * count doubles each. With threshold 0, whether the bodies
 * meet. `within` and `statuses` receive `count` entries each. A pose that is none fails its own item alone. All else as for
 * cstk_classify_batch.
 */
cstk_status cstk_pair_within_batch(cstk_batch *batch,
                                   const cstk_body *body_a,
                                   const double *poses_a,
                                   const cstk_body *body_b,
                                   const double *poses_b,
                                   size_t count,
                                   double threshold,
                                   const cstk_batch_options *options,
                                   cstk_progress_fn progress,
                                   void *user,
                                   bool *within,
                                   cstk_status *statuses,
                                   cstk_batch_result *out);

/**
 * cstk_pair_distance for `count` pairs of poses: `poses_a` and `poses_b` have 12 * count doubles each. `distances` and `results` receive
 * `count` entries each, the field `distance` and the whole answer; what is not wanted may be NULL. All else as for
 * cstk_pair_within_batch.
 */
cstk_status cstk_pair_distance_batch(cstk_batch *batch,
                                     const cstk_body *body_a,
                                     const double *poses_a,
                                     const cstk_body *body_b,
                                     const double *poses_b,
                                     size_t count,
                                     double max_distance,
                                     const cstk_batch_options *options,
                                     cstk_progress_fn progress,
                                     void *user,
                                     double *distances,
                                     cstk_distance_result *results,
                                     cstk_status *statuses,
                                     cstk_batch_result *out);

/** @} */

/**
 * @defgroup map Maps
 *
 * What is free on a grid over one to six coordinates, the others held: the class or the distance at the middle of every cell, or what is
 * proved of every whole cell. Maps are built coarse to fine: blocks of cells that are proved alike are filled at once, others are halved.
 * For classes, blocks of up to 16 cells are not proved but asked cell by cell. Where the cells are small beside the bodies, the cost
 * follows the boundary of the set rather than the number of cells; CSTK_MAP_CELLS costs more, as every cell at the boundary is a proof of
 * up to max_boxes parts. Maps are saved as arrays of NumPy's.
 *
 * @code
     cstk_map_axis axes[2] = {{0, 0, -3.14, 3.14, 512, 0, 0}, {1, 0, -3.14, 3.14, 512, 0, 0}};
     cstk_map *map;
     cstk_map_view view;
     check(cstk_map_build(cobject, q, nq, axes, 2, NULL, NULL, NULL, &map));
     check(cstk_map_get_view(map, &view));
     if (view.values[3 * 512 + 7] == CSTK_CLASS_OUTSIDE) {
         printf("free in row 3, column 7\n");
     }
     check(cstk_map_save(map, "map.npy"));
     check(cstk_map_show(map, "map.png"));
     check(cstk_map_release(map));
 * @endcode
 * @{
 */

/**
 * What a map tells of its cells.
 */
enum cstk_map_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The cstk_class at the middle of each cell, as cstk_classify has it. Where a C-object has contact epsilons or pure sets, what is
   * proved not to be inside may be in contact, and is asked cell by cell; so are all cells where nothing can be proved, since a
   * predicate without distances or a custom joint states no speed.
   */
  CSTK_MAP_CLASSES = 0,
  /**
   * The distance at the middle of each cell, as cstk_distance has it; every cell is asked.
   */
  CSTK_MAP_DISTANCES = 1,
  /**
   * The cstk_region_outcome of each whole cell, as cstk_region_classify has it: free or inside is proved at every configuration of the
   * cell.
   */
  CSTK_MAP_CELLS = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_map_kind cstk_map_kind;
#else
typedef int32_t cstk_map_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * A map of C-space. Immutable; threads may share it. It refers to no other object.
 */
typedef struct cstk_map cstk_map;

/**
 * Options of a map. Write it with cstk_map_options_default first.
 */
typedef struct cstk_map_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * A cstk_map_kind. Default CSTK_MAP_CLASSES.
   */
  int32_t kind;
  /**
   * The number of threads, the caller's among them, at most 1024; 0, the default, for as many as the machine runs at once. The map
   * does not depend on it.
   */
  uint32_t threads;
  /**
   * Distances above this are not computed: infinity stands for them. Default infinity.
   */
  double max_distance;
  /**
   * The most parts that the proof of a single cell halves it into, at least 1. Default 64.
   */
  uint64_t max_boxes;
} cstk_map_options;

/**
 * An interval of a coordinate, cut into equal cells. The middle of cell i is low + (high - low) * ((i + 0.5) / cells).
 */
typedef struct cstk_map_axis {
  /**
   * The coordinate's number in the space; none of a quaternion's.
   */
  uint32_t coordinate;
  uint32_t reserved_word;
  /**
   * Where the first cell begins and the last ends; finite, `low` below `high`. On a circle they may pass the place where angles
   * wrap.
   */
  double low;
  double high;
  /**
   * How many cells there are, at least 1.
   */
  size_t cells;
  /**
   * The map is of a part of the cells: of `count` from number `first` on, or of all from there on where `count` is 0. They have the
   * values that they have on a map of all cells, so that several machines may build a map in parts.
   */
  size_t first;
  size_t count;
} cstk_map_axis;

/**
 * The arrays of a map; they are valid as long as the map.
 */
typedef struct cstk_map_view {
  cstk_map_kind kind;
  uint32_t reserved_word;
  /**
   * The axes, in the order given; their `count` is not 0.
   */
  const cstk_map_axis *axes;
  size_t axis_count;
  /**
   * One entry for each cell of the map, row-major: of the last axis neighbours follow one another. NULL for distances.
   */
  const uint8_t *values;
  /**
   * The same of distances; NULL for other kinds.
   */
  const double *distances;
  size_t cell_count;
  /**
   * How many boxes it took to prove, and how many configurations were asked one by one.
   */
  uint64_t proofs;
  uint64_t questions;
  uint64_t reserved[4];
} cstk_map_view;


/**
 * Writes the default options. `size` is sizeof(cstk_map_options).
 */
cstk_status cstk_map_options_default(cstk_map_options *out, size_t size);

/**
 * Builds a map of a C-object. `axes` are `axis_count` intervals of different coordinates, 1 to 6; the other coordinates are those of
 * `q`, `nq` doubles. `options` may be NULL for the defaults. `progress` may be NULL; it is called on this thread, and `user` is passed
 * to it, between blocks of cells and while other threads work. The first failure ends the work. All cells see the state that the
 * environments are in at the call. Callbacks of C-objects and bodies are called from the map's threads, several at once.
 *
 * The map holds a byte a cell, or 8 of distances. CSTK_ERROR_WRONG_SIZE for too many axes or cells, CSTK_ERROR_OUT_OF_MEMORY where the
 * values do not fit into memory, CSTK_ERROR_CANCELLED where `progress` says so; CSTK_ERROR_UNSUPPORTED for coordinates of a
 * quaternion, for distances where lengths and units of C-space mix, and, of CSTK_MAP_CELLS, for custom joints and predicates that state
 * no speed.
 */
cstk_status cstk_map_build(const cstk_cobject *cobject,
                           const double *q,
                           size_t nq,
                           const cstk_map_axis *axes,
                           size_t axis_count,
                           const cstk_map_options *options,
                           cstk_progress_fn progress,
                           void *user,
                           cstk_map **out);

/**
 * Writes the arrays of a map.
 */
cstk_status cstk_map_get_view(const cstk_map *map, cstk_map_view *out);

/**
 * Writes the values to a file that NumPy's load reads (.npy): an array with as many dimensions as the map has axes, of 8-bit unsigned
 * numbers, or of doubles for distances. The file is written whole or not at all; CSTK_ERROR_IO if that fails. This takes less than a
 * megabyte of memory besides the map, whatever its size.
 */
cstk_status cstk_map_save(const cstk_map *map,
                          const char *file);

/**
 * Writes a picture of a map. Of two axes (.png), a pixel a cell: the first axis goes to the right, the second up. Classes are white
 * (outside), orange (contact) and dark red (inside); cells white (free), dark red (inside), light gray (mixed) and gray (undecided). A
 * distance of 0 is black, the largest that is finite, and what is infinite, white. The picture is not compressed: a byte a cell.
 *
 * Of three axes (.glb, a glTF file), the boundary of the cells that are inside, at distance 0, or not proved free, in the coordinates of
 * the axes as x, y and z. It is closed: beyond the map nothing is inside. The surface goes between the middles of unlike cells and
 * rounds edges and corners off, so that it may be nearer than the cells' own boundary, by half a cell at most: it is to be looked at.
 *
 * The file is written whole or not at all; CSTK_ERROR_IO if that fails, CSTK_ERROR_UNSUPPORTED for maps with another number of axes, for
 * another ending than .glb of a map with three, and for a boundary of more than 29 million faces: each takes 144 bytes, and a .glb file
 * has less than 4 GB. This takes less than a megabyte of memory besides the map, whatever its size.
 */
cstk_status cstk_map_show(const cstk_map *map,
                          const char *file);

/**
 * Adds a reference.
 */
cstk_status cstk_map_retain(cstk_map *map);

/**
 * Drops a reference. NULL is a no-op.
 */
cstk_status cstk_map_release(cstk_map *map);

/** @} */

/**
 * @defgroup show Pictures
 *
 * Robots among obstacles as glTF files, at a configuration or on a path.
 *
 * @code
     check(cstk_show(cobject, q, nq, "cell.glb"));
     check(cstk_show_path(cobject, q, 1, nq, 8, "path.glb"));
 * @endcode
 * @{
 */

/**
 * Writes the scene at q to a .glb file (glTF; the report's show-c-object): links, s-objects, the nearest pair of points
 * and the contacts within the contact epsilon (red), each contact's normal (green) and the direction in which its point
 * moves along the gradient (blue). Distances and gradients are in the nodes' extras. `q` has `nq` doubles. The name must
 * end in .glb (CSTK_ERROR_UNSUPPORTED otherwise). The file is written whole or not at all; CSTK_ERROR_IO if that fails.
 */
cstk_status cstk_show(const cstk_cobject *cobject,
                      const double *q,
                      size_t nq,
                      const char *file);

/**
 * Writes a .glb file in which the robots move along a path among the s-objects: links and what is attached to them have a pose at every
 * point of the path, and at moments between that are at most 1/240 of the path apart. It takes `seconds`, larger than 0, at constant
 * speed, as cstk_space_distance measures without weights. `points` has count * nq doubles, one configuration after the other; `count`
 * is at least 1 and at most 10000. Whether the path is free is not asked. The name must end in .glb (CSTK_ERROR_UNSUPPORTED
 * otherwise). The file is written whole or not at all; CSTK_ERROR_IO if that fails.
 */
cstk_status cstk_show_path(const cstk_cobject *cobject,
                           const double *points,
                           size_t count,
                           size_t nq,
                           double seconds,
                           const char *file);

/** @} */

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* CSTK_H */
