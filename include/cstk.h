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
 *   @ref space              Spaces
 *   @ref environment        Environments
 *   @ref cobject            C-objects
 *   @ref query              Query contexts
 *   @ref at_configuration   Queries at a configuration
 *   @ref pair               Pair queries
 *   @ref slide              Slides
 *   @ref show               Pictures
 *
 * WORDS. Numbers like (§4.4) refer to the report the library succeeds: Xavier and LaFarge, A Configuration Space Toolkit for
 * Automated Spatial Reasoning, SAND97-0366, Sandia National Laboratories 1997. The r-side of an answer is the robot's link
 * (or body a); the s-side is an s-object, that is an obstacle, or a second link (or body b). A C-object is a set in the
 * robot's configuration space, such as all q at which some link meets some obstacle. A primitive is one convex polygon,
 * polyhedron or ready-made shape of a body. The shell, or stand-off, is the distance within which contacts are considered.
 *
 * CALLS. Every call that can fail returns a cstk_status; inputs come first, outputs last, and outputs are written only on
 * CSTK_OK. After a failure cstk_last_error_message() names the culprit. A failed call has changed nothing. The library
 * never prints, and ends the process in one case only: an allocation that fails (see MEMORY).
 *
 * OWNERSHIP. _create, _build and _snapshot give one reference, _retain adds one, _release drops one; releasing NULL is a
 * no-op. Objects keep alive what they refer to, so parts may be released as soon as the whole is made. A handle that was
 * released for good, or that is of another kind, is answered with CSTK_ERROR_WRONG_HANDLE as far as that can be known; do not
 * rely on it. Bodies, robots, spaces and C-objects never change once made. Strings and arrays passed in are copied.
 *
 * MEMORY. What a call holds is bounded by what it was given: arrays, files within their stated limits, max_count. Where an array
 * or a file of the caller's sets the size of one allocation, too little memory is answered with CSTK_ERROR_OUT_OF_MEMORY. Any
 * other allocation that fails ends the process (abort), as Rust's standard library has it; it does not unwind. Programs that
 * must survive that limit what they give. docs/robustness.md lists what is promised, each line with its test.
 *
 * THREADS. All objects may be shared by threads, but for query contexts: a cstk_query (and a builder) serves one call at a
 * time and answers CSTK_ERROR_BUSY to another. Make one per thread.
 *
 * OPTIONS. Structures with size and cookie are written by their _default function before fields are set; others are
 * refused with CSTK_ERROR_NOT_INITIALISED. Where a parameter is called options, NULL stands for the defaults.
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
 * Calls that can fail return a status, and leave a message that names the culprit. Long calls report how far they are, and
 * user data are given back, by functions of the caller. In the examples of the sections below, check() stands for what a
 * program does about a status; this is how it may begin.
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
 * How a call ended. Every call that can fail returns one; after any but CSTK_OK, cstk_last_error_message() says which
 * argument, which polygon, which line. A failed call has changed nothing and written no output.
 */
enum cstk_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The call did what was asked.
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
   * Nothing was given where at least one item is needed: a body without primitives, a robot without links.
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
   * Something the library does not do: an unknown file format, a change to a snapshot.
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
   * The caller's progress function asked to stop.
   */
  CSTK_ERROR_CANCELLED = 17,
  /**
   * The object is in use by another thread, or by the call whose callback makes this one.
   */
  CSTK_ERROR_BUSY = 18,
  /**
   * A fault of the library itself. It was contained; please report it with the message.
   */
  CSTK_ERROR_INTERNAL = 19,
  /**
   * A function of the caller's failed; the message names it and what it returned.
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
   * There is not enough memory for what the input asks for.
   */
  CSTK_ERROR_OUT_OF_MEMORY = 23,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_status cstk_status;
#else
typedef int32_t cstk_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Gives user data back to the caller, once, when nothing refers to it any more. It may call the library.
 */
typedef void (*cstk_destroy_fn)(void *user);

/**
 * Hears how far a long call has come, from 0 to 1. Anything but 0 (CSTK_OK) ends the call with CSTK_ERROR_CANCELLED. It is
 * called on the thread that made the call; it must not throw.
 */
typedef int32_t (*cstk_progress_fn)(double fraction, void *user);


/**
 * The version of the library that is linked, as "major.minor.patch"; static.
 */
const char *cstk_version(void);

/**
 * The name of a status, such as "CSTK_ERROR_NOT_FINITE"; "unknown status" for a number that is none. Never NULL; static.
 */
const char *cstk_status_name(int32_t status);

/**
 * The message of this thread's last failed call; empty if none has failed. Valid until the next failure on this thread.
 * Never NULL; UTF-8.
 */
const char *cstk_last_error_message(void);

/** @} */

/**
 * @defgroup pose Poses
 *
 * Poses are 12 doubles, row-major [R | t]. They are made from quaternions, or from the report's Euler angles (§4.1), whose
 * rates are those of §4.3, and composed.
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
   * The turning body's own, as in eq. (25) to (31).
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
 * Converts a placement of the report (§4.1, eq. 3-6) to a pose: `xyz_ypr` holds x, y, z and the angles yaw (about Y),
 * pitch (about the new Z) and roll (about the new X) in radians; `pose` receives 12 doubles.
 */
cstk_status cstk_pose_from_euler(const double *xyz_ypr,
                                 double *pose);

/**
 * The inverse of cstk_pose_from_euler (eq. 7). Where cos(pitch) = 0 only yaw + roll or yaw - roll is determined; roll is
 * then given as 0.
 */
cstk_status cstk_pose_to_euler(const double *pose_12,
                               double *xyz_ypr);

/**
 * Converts a translation and a unit quaternion to a pose: `xyz_quaternion` holds x, y, z of the translation and x, y, z, w
 * of the quaternion, whose norm may be off 1 by 1e-6; `pose` receives 12 doubles.
 */
cstk_status cstk_pose_from_quaternion(const double *xyz_quaternion,
                                      double *pose);

/**
 * The pose `a` then `b`: if `a` places frame 1 in frame 0 and `b` places frame 2 in frame 1, `out` places frame 2 in
 * frame 0. All are 12 doubles; `out` may be `a` or `b`.
 */
cstk_status cstk_pose_compose(const double *a,
                              const double *b,
                              double *out);

/**
 * The inverse of a pose (eq. 10): if `pose_12` places frame 1 in frame 0, `out` places frame 0 in frame 1. 12 doubles
 * each; both may be the same.
 */
cstk_status cstk_pose_inverse(const double *pose_12,
                              double *out);

/**
 * Carries a point of the child frame into the parent frame (eq. 8): `out` = R `point` + t. 3 doubles each; both may be the
 * same.
 */
cstk_status cstk_pose_transform_point(const double *pose_12,
                                      const double *point,
                                      double *out);

/**
 * The inverse of cstk_pose_from_quaternion; of the two quaternions of a rotation the one with w >= 0.
 */
cstk_status cstk_pose_to_quaternion(const double *pose_12,
                                    double *xyz_quaternion);

/**
 * Converts yaw, pitch and roll (radians; §4.1, eq. 6) to a rotation of 9 doubles, row-major.
 */
cstk_status cstk_euler_to_rotation(const double *yaw_pitch_roll, double *rotation);

/**
 * The inverse of cstk_euler_to_rotation (eq. 7), with the same rule where cos(pitch) = 0 as cstk_pose_to_euler.
 */
cstk_status cstk_euler_from_rotation(const double *rotation,
                                     double *yaw_pitch_roll);

/**
 * The matrix of eq. (31): 9 doubles, row-major, that turn the rates of yaw, pitch and roll into an angular velocity.
 * `frame` is a cstk_angular_frame; the report prints the matrix for the body's frame, and uses it beside the inertial
 * columns of (33), with which only the inertial form combines.
 */
cstk_status cstk_euler_rates(const double *yaw_pitch_roll,
                             int32_t frame,
                             double *matrix);

/**
 * The inverse of cstk_euler_rates: rates of yaw, pitch and roll from an angular velocity. CSTK_ERROR_DEGENERATE where cos(pitch) =
 * 0.
 */
cstk_status cstk_euler_rates_inverse(const double *yaw_pitch_roll,
                                     int32_t frame,
                                     double *matrix);

/**
 * Turns a basic Jacobian, as cstk_robot_jacobian writes it (eq. 33), into the Jacobian of x, y, z, yaw, pitch, roll (eq. 22,
 * 23), in place: 6 rows of `nv` doubles. `yaw_pitch_roll` are the link's, see cstk_pose_to_euler. CSTK_ERROR_DEGENERATE where
 * cos(pitch) = 0.
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
 * A body is a rigid union of convex primitives: polygons, polyhedra, ready-made shapes, points. A builder collects them, from
 * arrays or mesh files; what is built never changes, and serves any number of links, obstacles and threads.
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
   * The surface of a cylinder, cone, ellipsoid or set by a support function; it has no vertices. What has a radius holds
   * its points by the features of its core.
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
 * Collects the primitives of a body.
 */
typedef struct cstk_body_builder cstk_body_builder;

/**
 * Writes to `point` (three doubles) a point of a bounded convex set that is farthest along the unit vector `direction`.
 * Returns CSTK_OK, or anything else when it fails.
 */
typedef int32_t (*cstk_support_fn)(const double *direction, double *point, void *user);

/**
 * What a primitive is. A sphere is a point with a radius, a capsule a segment with one: its features are those of this core.
 */
typedef struct cstk_primitive {
  cstk_primitive_kind kind;
  /**
   * Features of the primitive, or of its core; 0 for cylinders, cones, ellipsoids and support functions.
   */
  uint32_t vertex_count;
  uint32_t edge_count;
  uint32_t face_count;
  /**
   * Around the core: of spheres, capsules, and rounded polygons and polyhedra. 0 for others.
   */
  double radius;
  /**
   * As it was given; of a mesh's face its index, of a point of a cloud its own.
   */
  uint64_t tag;
  uint64_t reserved[8];
} cstk_primitive;

/**
 * What became of a body's input, and what was built.
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
   * Mesh faces without area, left out.
   */
  uint64_t faces_dropped;
  /**
   * Nodes of the hierarchy, and its levels.
   */
  uint64_t node_count;
  uint64_t depth;
  /**
   * The box of all vertices, in the frame in which the body was given.
   */
  double low[3];
  double high[3];
  /**
   * What of the body hangs together: polygons that share vertices, and each polyhedron.
   */
  uint64_t piece_count;
  /**
   * It was declared solid (cstk_body_builder_set_solid).
   */
  bool solid;
  uint8_t reserved_bytes[7];
  uint64_t reserved[6];
} cstk_body_statistics;


/**
 * Makes an empty builder for bodies of dimension 2 (planar worlds: all z are 0, polygons are solid) or 3 (polygons are
 * surfaces, unless cstk_body_builder_set_solid says otherwise). Release it with cstk_body_builder_release.
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
 * Adds a convex planar polygon: `point_count` vertices of three doubles in cyclic order, either way round. In space it is a
 * surface, in the plane it is solid. `tag` is any number of yours; witnesses carry it.
 *
 * CSTK_ERROR_DEGENERATE, CSTK_ERROR_NOT_CONVEX or CSTK_ERROR_NOT_PLANAR with a message that names the vertex. Vertices may leave the plane
 * by 1e-12 of the polygon's diameter; use cstk_body_builder_add_mesh to have other polygons split.
 */
cstk_status cstk_body_builder_add_polygon(cstk_body_builder *builder,
                                          const double *xyz,
                                          size_t point_count,
                                          uint64_t tag);

/**
 * Adds the convex hull of `point_count` points of three doubles: a solid; or a point, a segment or a flat polygon where the
 * points are no more than that. Points inside the hull are ignored.
 */
cstk_status cstk_body_builder_add_polyhedron(cstk_body_builder *builder,
                                             const double *xyz,
                                             size_t point_count,
                                             uint64_t tag);

/**
 * Adds the faces of a mesh as polygons: `vertex_count` vertices of three doubles; `face_count` faces, face f having
 * `face_sizes[f]` vertices; and all their vertex indices, `index_count` in total, face after face. `face_sizes` may be
 * NULL for triangles. Faces are tagged with their index in this call; triangles of a split face carry its tag.
 *
 * The mesh is scaled along its own x, y and z by the three factors of `scale`, NULL for 1, then moved by `pose`, NULL for the
 * identity. Factors below 0 mirror; faces of what is mirrored are turned round, so that they face outwards as before.
 * CSTK_ERROR_INVALID_ARGUMENT for a factor nearer to 0 than 1e-50 or larger than 1e50.
 *
 * Faces that are not convex or not planar are split into triangles; faces without area are left out and counted (see
 * cstk_body_get_statistics). CSTK_ERROR_NOT_FOUND for an index beyond the vertices, CSTK_ERROR_WRONG_SIZE for counts that do not
 * match, CSTK_ERROR_NOT_CONVEX for an outline that crosses itself; the message names the face, and nothing is added.
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
 * Adds the mesh in a file as cstk_body_builder_add_mesh does, scaled by `scale` and moved by `pose`. The name ends in .obj, .stl (ASCII or binary) or .dae
 * (COLLADA; scaled to metres by the file's unit, `up_axis` not applied, as the tools of ROS have it).
 * CSTK_ERROR_IO if it cannot be read, CSTK_ERROR_PARSE if it is damaged or truncated, CSTK_ERROR_UNSUPPORTED for another ending.
 */
cstk_status cstk_body_builder_add_mesh_file(cstk_body_builder *builder,
                                            const char *file,
                                            const double *pose,
                                            const double *scale);

/**
 * Declares that the polygons and mesh faces, all together, are the closed boundary of a solid (true), or surfaces (false,
 * the default). In a solid the inside counts: a body wholly inside it meets it, at distance 0. Polyhedra are solid by
 * themselves and take no part; in the plane polygons are solid anyway, and this changes nothing.
 *
 * It is cstk_body_build that checks whether the boundary is closed, of all that was added till then. Edges join where
 * their ends have the same coordinates, to the last bit, and as many faces must run along each one way as the other;
 * faces without area that were left out count where others need them to join. Faces that alone share an edge are turned
 * round where they have to be: the larger part by area of what so hangs together stays as it was given. A point is
 * inside where the boundary's winding number is not 0. So shells that face the same way may overlap; a cavity is a shell
 * that faces the other way than the one around it; and a boundary that faces inwards all over bounds the same solid.
 */
cstk_status cstk_body_builder_set_solid(cstk_body_builder *builder,
                                        bool solid);

/**
 * Builds a body from what the builder holds; the builder is unchanged and may go on. `options` may be NULL for the
 * defaults; `progress` may be NULL, `user` is passed to it. CSTK_ERROR_EMPTY if nothing was added. For a body declared solid,
 * CSTK_ERROR_NOT_CLOSED if its boundary has open edges, or one side only, with a message that names edges and primitives;
 * CSTK_ERROR_DEGENERATE if it bounds nothing, as each face has a copy that faces the other way.
 *
 * The hierarchy of a body decides how fast it is asked, never what it answers. It takes about 5 microseconds a polygon, and
 * 1 to 2 a point where there is nothing else (cstk_body_builder_add_points); build once and share, or keep the body in a
 * file (cstk_body_save).
 */
cstk_status cstk_body_build(cstk_body_builder *builder,
                            const cstk_hierarchy_options *options,
                            cstk_progress_fn progress,
                            void *user,
                            cstk_body **out);

/**
 * Adds a ball around `center` (three doubles); in the plane a disc. As exact as a point: 1e-12 of the largest coordinate.
 * A radius of 0 leaves the point.
 */
cstk_status cstk_body_builder_add_sphere(cstk_body_builder *builder,
                                         const double *center,
                                         double radius,
                                         uint64_t tag);

/**
 * Adds all points within `radius` of the segment from `a` to `b` (three doubles each). As exact as a segment: 1e-12 of the
 * largest coordinate. Along a face or another capsule it has the contacts that span both.
 */
cstk_status cstk_body_builder_add_capsule(cstk_body_builder *builder,
                                          const double *a,
                                          const double *b,
                                          double radius,
                                          uint64_t tag);

/**
 * Adds the solid box with `half_extents` (three doubles, positive) around the origin of the frame at `pose`, along its
 * axes. It is a polyhedron, with a polyhedron's features and exactness. Not in the plane: there it is a polygon.
 */
cstk_status cstk_body_builder_add_box(cstk_body_builder *builder,
                                      const double *pose,
                                      const double *half_extents,
                                      uint64_t tag);

/**
 * Adds the solid cylinder around the z axis of the frame at `pose`, from -half_length to half_length. Its surface is smooth:
 * distances are iterated until a lower and an upper bound agree, to 1e-11 of its diameter at worst and about 1e-15 of the
 * largest coordinate as a rule; where they would not, `lower` and `upper` of an answer tell. Its contacts have
 * CSTK_FEATURE_SURFACE for a feature, which counts as a point in their modes, and there is one only, even where it stands or lies
 * on a face. cstk_pair_penetration refuses it.
 */
cstk_status cstk_body_builder_add_cylinder(cstk_body_builder *builder,
                                           const double *pose,
                                           double radius,
                                           double half_length,
                                           uint64_t tag);

/**
 * Adds the solid cone around the z axis of the frame at `pose`: the base at z = -height / 2, the apex at z = height / 2.
 * Smooth, with what that means for cstk_body_builder_add_cylinder.
 */
cstk_status cstk_body_builder_add_cone(cstk_body_builder *builder,
                                       const double *pose,
                                       double radius,
                                       double height,
                                       uint64_t tag);

/**
 * Adds the solid ellipsoid with `semi_axes` (three doubles, positive) around the origin of the frame at `pose`. Smooth, with
 * what that means for cstk_body_builder_add_cylinder.
 */
cstk_status cstk_body_builder_add_ellipsoid(cstk_body_builder *builder,
                                            const double *pose,
                                            const double *semi_axes,
                                            uint64_t tag);

/**
 * Adds all points within `radius` of a convex polygon given as for cstk_body_builder_add_polygon. As exact as the polygon;
 * the features of contacts are the polygon's.
 */
cstk_status cstk_body_builder_add_rounded_polygon(cstk_body_builder *builder,
                                                  const double *xyz,
                                                  size_t point_count,
                                                  double radius,
                                                  uint64_t tag);

/**
 * Adds all points within `radius` of the convex hull of points. As exact as the hull; the features of contacts are its.
 */
cstk_status cstk_body_builder_add_rounded_polyhedron(cstk_body_builder *builder,
                                                     const double *xyz,
                                                     size_t point_count,
                                                     double radius,
                                                     uint64_t tag);

/**
 * Adds balls of one radius around `point_count` points of three doubles, tagged with their indices: a point cloud. A radius
 * of 0 leaves the points. Exact to 1e-12 of the largest coordinate. The message of a failure names the point; nothing is
 * added then.
 *
 * A body of nothing but points is built in 1 to 2 microseconds a point, and holds less than 100 bytes of each: points are
 * split from the top whatever the grouping, unless that is CSTK_GROUPING_BASIC. Its wrappers are made when nodes of its
 * hierarchy are first looked at, which takes 10 to 30 microseconds and about 1 kB a point; queries do without. Beside other
 * primitives points are built as those are, at up to 60 microseconds each: keep clouds in bodies of their own.
 */
cstk_status cstk_body_builder_add_points(cstk_body_builder *builder,
                                         const double *xyz,
                                         size_t point_count,
                                         double radius);

/**
 * Adds a grid of heights over the plane of x and y: `nx` by `ny` nodes, two at least each way, `cell_x` and `cell_y` apart,
 * the first at the origin; `heights[j * nx + i]` is the z of node (i, j). Every cell is two triangles, split along the
 * diagonal from (i, j) to (i + 1, j + 1), both tagged with j * (nx - 1) + i. With `base` NaN the field is a surface; else it
 * is solid ground down to z = base, which must be below all heights: each triangle becomes a prism. Exact to 1e-12 of the
 * largest coordinate.
 */
cstk_status cstk_body_builder_add_height_field(cstk_body_builder *builder,
                                               size_t nx,
                                               size_t ny,
                                               const double *heights,
                                               double cell_x,
                                               double cell_y,
                                               double base);

/**
 * Adds the bounded convex set that `support` describes, in the frame in which the body is given. Smooth, with what that
 * means for cstk_body_builder_add_cylinder: its distances are as exact as the function's points.
 *
 * The function is called by any thread that asks about the body, several at once, also within queries; it must be pure, must
 * not throw, and must not call back into the query that asks. It is tried here along the axes and 300 other directions:
 * CSTK_ERROR_CALLBACK_FAILED if it fails, CSTK_ERROR_NOT_FINITE if it answers (or leaves unwritten) what is not finite,
 * CSTK_ERROR_NOT_CONVEX if two answers show that it is no support function. A query cannot end with its failure: where it fails
 * then, the set counts as the box that was found here, so that what is called free is free.
 *
 * `destroy` may be NULL. It is called once with `user`, by whichever thread drops the last reference to what uses the
 * function; not when this call fails. Such a body cannot be saved.
 */
cstk_status cstk_body_builder_add_support(cstk_body_builder *builder,
                                          cstk_support_fn support,
                                          void *user,
                                          cstk_destroy_fn destroy,
                                          uint64_t tag);

/**
 * Writes what a primitive of the body is. Primitives are numbered from 0 in the order in which they were added, triangles of
 * a split face side by side; cstk_body_get_statistics tells how many there are, and cstk_body_get_feature_vertices where the
 * vertices are: CSTK_FEATURE_VERTEX for one, CSTK_FEATURE_INTERIOR for all. CSTK_ERROR_NOT_FOUND for an index beyond the last.
 */
cstk_status cstk_body_get_primitive(const cstk_body *body,
                                    uint32_t index,
                                    cstk_primitive *out);

/**
 * Adds a reference.
 */
cstk_status cstk_body_retain(cstk_body *body);

/**
 * Drops a reference. NULL is a no-op. Robots and environments keep the bodies they use.
 */
cstk_status cstk_body_release(cstk_body *body);

/**
 * Attaches data of the caller's to a body, however it was made (§2.2.3): witnesses hand them back, as `r_data` for a link's
 * body, and as `s_data` for a link's or for that of an s-object without data of its own. Once for each body: the second call
 * is CSTK_ERROR_INVALID_ARGUMENT. `destroy` may be NULL; it is called once, by whichever thread drops the last reference to the
 * body, and not when this call fails. Other threads may ask about the body meanwhile.
 */
cstk_status cstk_body_set_data(cstk_body *body,
                               void *data,
                               cstk_destroy_fn destroy);

/**
 * Writes the data attached to a body, or NULL.
 */
cstk_status cstk_body_get_data(const cstk_body *body, void **out);

/**
 * Writes counts and extents.
 */
cstk_status cstk_body_get_statistics(const cstk_body *body,
                                     cstk_body_statistics *out);

/**
 * The vertices of a feature of a primitive, in the frame in which the body was given: a polygon has one face (0), its
 * edge i joins vertices i and i + 1; the features of a polyhedron are those of its hull. `kind` is a cstk_feature_kind.
 * At most `max_count` points of three doubles are written to `xyz` (NULL if `max_count` is 0), and their full number to
 * `count`.
 */
cstk_status cstk_body_get_feature_vertices(const cstk_body *body,
                                           uint32_t primitive,
                                           int32_t kind,
                                           uint32_t feature,
                                           size_t max_count,
                                           double *xyz,
                                           size_t *count);

/**
 * Writes the body with its hierarchy to a file; a file of that name is replaced when all is written, or left as it is.
 * docs/body-file.md describes the format. CSTK_ERROR_IO if it cannot be written, CSTK_ERROR_UNSUPPORTED for a body with a support
 * function, which no file can hold.
 */
cstk_status cstk_body_save(const cstk_body *body,
                           const char *file);

/**
 * Reads a body that cstk_body_save wrote; nothing is built, and it answers as the saved one does, bit for bit. CSTK_ERROR_IO if
 * the file cannot be read, CSTK_ERROR_PARSE if it is truncated, altered or no body file, CSTK_ERROR_UNSUPPORTED if it is of another
 * version of the format. The checksum finds damage; it is no protection against forgery.
 */
cstk_status cstk_body_load(const char *file,
                           cstk_body **out);

/** @} */

/**
 * @defgroup hierarchy Hierarchies
 *
 * Every body carries a binary tree of bounding volumes over its primitives (§3.2). It decides how fast the body is asked, never what
 * is answered. Options choose how it is built; its nodes can be measured, listed and drawn.
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
   * Convex hulls, oriented boxes where a hull has more than hull_vertex_limit vertices. The default. Where
   * no primitive is cut into slabs they are made when nodes are first looked at, on as many threads as the build, and
   * the boxes that queries walk are fitted to the primitives themselves.
   */
  CSTK_WRAPPER_HULL = 0,
  CSTK_WRAPPER_ORIENTED_BOX = 1,
  CSTK_WRAPPER_ALIGNED_BOX = 2,
  /**
   * Spheres around the vertices below.
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
   * Clustering of edge-adjacent primitives, then of what is near (the report's Simple Hybrid). The default. More than
   * 16,384 parts without pieces are first cut into regions of no more, from the top. Bodies of nothing but points
   * (cstk_body_builder_add_points), which have no edges, are split from the top altogether.
   */
  CSTK_GROUPING_HYBRID = 0,
  /**
   * Clustering of what is near, in such regions; needs no adjacency (the report's Basic Clustering).
   */
  CSTK_GROUPING_BASIC = 1,
  /**
   * Top-down splits by the surface-area heuristic; the fastest to build.
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
 * Whether primitives that form a convex piece of the body get a node of their own, bounded exactly.
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
   * These, and edge-adjacent polygons that bound a convex part of a closed body.
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
 * Polygons in space, for looking at. Immutable; threads may share it.
 */
typedef struct cstk_mesh cstk_mesh;

/**
 * How a body's hierarchy is built. Write it with cstk_hierarchy_options_default first. Answers do not depend on it, only
 * their speed does.
 */
struct cstk_hierarchy_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * Wrappers are convex hulls of at most so many vertices; larger ones become oriented boxes. At least 8; default 32.
   */
  uint32_t hull_vertex_limit;
  /**
   * Threads to build on; 0 for as many as the machine runs at once. Default 1. The hierarchy does not depend on it.
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
   * The cost of merging two bodies is diameter^A (B Fill + C Balance): Fill is the merged diameter over the sum of the
   * two, Balance the greater ratio of the two. These are A (at most 16), B and C; not negative.
   */
  double cost_diameter;
  double cost_fill;
  double cost_balance;
  /**
   * The largest diameter of bodies merged in the first round, and the largest gap between them; both double from round
   * to round. 0, the default, for limits that suit the primitives.
   */
  double diameter_limit;
  double gap_limit;
  /**
   * Primitives longer than this many times their width get several leaves, each bounding a part; witnesses name the
   * primitive as ever. At least 1.5, or 0, the default, for one leaf each.
   */
  double aspect_limit;
};

/**
 * What a body's hierarchy is like.
 */
typedef struct cstk_hierarchy_statistics {
  /**
   * A cstk_wrapper_kind.
   */
  cstk_wrapper_kind wrapper;
  uint32_t reserved_0;
  /**
   * Nodes; the leaves among them; the nodes that hold a maximal convex piece.
   */
  uint64_t node_count;
  uint64_t leaf_count;
  uint64_t piece_count;
  /**
   * Levels, and the mean level of a leaf; the root's is 0.
   */
  uint64_t depth;
  double mean_leaf_level;
  /**
   * Means over interior nodes: the greater ratio of the children's diameters (1 is perfect spatial balance), and the
   * diameter over the sum of the children's (1/2: they overlap wholly; above 1: they are apart).
   */
  double balance;
  double fill;
  /**
   * The mean number of tests that a random line through the body's box makes, a primitive counting as four nodes: for
   * comparing hierarchies of one body.
   */
  double expected_cost;
  /**
   * Seconds the phases took on the machine that built it: convex pieces and slender primitives, the tree of sets, the
   * boxes that queries walk with the wrappers that they are fitted to.
   */
  double preparation_seconds;
  double grouping_seconds;
  double construction_seconds;
  /**
   * Memory of the hierarchy and of what queries read of the primitives. Of hulls and of a body of nothing but points,
   * whose wrappers are made when nodes are first looked at, it is several times more afterwards.
   */
  uint64_t memory_bytes;
  uint64_t reserved[8];
} cstk_hierarchy_statistics;

/**
 * A level of a hierarchy.
 */
typedef struct cstk_level_statistics {
  /**
   * Nodes of the level; leaves of the levels above it. Together they cover the body.
   */
  uint64_t node_count;
  uint64_t leaves_above;
  /**
   * Sums of the volumes and surfaces of all these nodes' wrappers; flat wrappers have two sides.
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
   * The children; UINT32_MAX both for a leaf.
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
   * A sphere around the primitives below, in the frame in which the body was given.
   */
  double center[3];
  double radius;
  uint64_t reserved[4];
} cstk_hierarchy_node;

/**
 * What a mesh holds: pointers that live as long as the mesh.
 */
typedef struct cstk_mesh_view {
  /**
   * `vertex_count` vertices of three doubles.
   */
  const double *vertices;
  size_t vertex_count;
  /**
   * Per face, its number of vertices, and the node it stands for.
   */
  const uint32_t *face_sizes;
  const uint32_t *face_nodes;
  size_t face_count;
  /**
   * The vertices of the faces, face after face, counter-clockwise seen from outside.
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
 * Describes the body's hierarchy. Takes time in proportion to its nodes. Where wrappers are made when they are first looked
 * at (hulls without an aspect_limit that cuts, and nothing but points) it is described by the boxes around the
 * primitives, along the axes of coordinates.
 */
cstk_status cstk_body_get_hierarchy_statistics(const cstk_body *body,
                                               cstk_hierarchy_statistics *out);

/**
 * Measures a level of the hierarchy; the root's is 0. CSTK_ERROR_NOT_FOUND for a level it does not have. The wrappers' hulls are
 * computed for it: some tens of microseconds a node.
 */
cstk_status cstk_body_get_level_statistics(const cstk_body *body,
                                           uint32_t level,
                                           cstk_level_statistics *out);

/**
 * The nodes of a level and the leaves above it, which together cover the body. At most `max_count` are written to `nodes`
 * (NULL if `max_count` is 0), and their full number to `count`. CSTK_ERROR_NOT_FOUND for a level the hierarchy does not have.
 */
cstk_status cstk_body_get_level_nodes(const cstk_body *body,
                                      uint32_t level,
                                      size_t max_count,
                                      uint32_t *nodes,
                                      size_t *count);

/**
 * At most `max_count` nodes that cover the body as tightly as opening the largest wrapper again and again gets: for
 * broad-phase structures of limited size. They are written to `nodes`, their number to `count`. CSTK_ERROR_INVALID_ARGUMENT
 * if `max_count` is 0.
 */
cstk_status cstk_body_get_cover_nodes(const cstk_body *body,
                                      size_t max_count,
                                      uint32_t *nodes,
                                      size_t *count);

/**
 * Describes a node. CSTK_ERROR_NOT_FOUND for one the hierarchy does not have.
 */
cstk_status cstk_body_get_node(const cstk_body *body,
                               uint32_t node,
                               cstk_hierarchy_node *out);

/**
 * The corners of a node's wrapper, in the frame in which the body was given. At most `max_count` points of three doubles
 * are written to `xyz` (NULL if `max_count` is 0), and their full number to `count`. CSTK_ERROR_NOT_FOUND for a node the
 * hierarchy does not have.
 */
cstk_status cstk_body_get_node_corners(const cstk_body *body,
                                       uint32_t node,
                                       size_t max_count,
                                       double *xyz,
                                       size_t *count);

/**
 * The wrappers of nodes as one mesh, in the frame in which the body was given; leaves as their primitives. Release it with
 * cstk_mesh_release. CSTK_ERROR_NOT_FOUND for a node the hierarchy does not have.
 */
cstk_status cstk_mesh_create_from_nodes(const cstk_body *body,
                                        const uint32_t *nodes,
                                        size_t node_count,
                                        cstk_mesh **out);

/**
 * Writes a picture of nodes, of which there must be at least one, to a .glb file that glTF viewers open, neighbours in
 * different colours, leaves as their primitives. The name must end in .glb (CSTK_ERROR_UNSUPPORTED otherwise). The file is
 * written whole or not at all; CSTK_ERROR_IO if that fails.
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
 * Shows what the mesh holds; the pointers live as long as the mesh.
 */
cstk_status cstk_mesh_get_view(const cstk_mesh *mesh, cstk_mesh_view *out);

/** @} */

/**
 * @defgroup robot Robots
 *
 * A robot is a tree of links, each with a joint to its parent and perhaps a body (§4.2). A builder collects the links; forward
 * kinematics and Jacobians come with the robot.
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
 * How a joint moves its link, and by which coordinates. Velocities (and so steps and gradients) are the coordinates' rates,
 * one each, but where the coordinates hold a unit quaternion x, y, z, w: there they are as said.
 */
enum cstk_joint_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Not at all.
   */
  CSTK_JOINT_FIXED = 0,
  /**
   * Turns it about the axis; the coordinate is an angle in radians.
   */
  CSTK_JOINT_REVOLUTE = 1,
  /**
   * Shifts it along the axis; the coordinate is a length.
   */
  CSTK_JOINT_PRISMATIC = 2,
  /**
   * Moves it in the xy-plane of the joint's frame: x, y, and an angle about z.
   */
  CSTK_JOINT_PLANAR = 3,
  /**
   * Turns it about its origin. Four coordinates, a quaternion; three velocities, angular, in the link's frame.
   */
  CSTK_JOINT_SPHERICAL = 4,
  /**
   * Moves it freely. Seven coordinates, x, y, z and a quaternion; six velocities, linear then angular, in the link's
   * frame.
   */
  CSTK_JOINT_FREE = 5,
  /**
   * Moves it freely, by the report's x, y, z, yaw, pitch, roll (§4.1): six coordinates. Where cos(pitch) = 0 they cannot
   * turn it about every axis.
   */
  CSTK_JOINT_FREE_EULER = 6,
  /**
   * By functions of the caller; see cstk_custom_joint.
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
 * A tree of links. Immutable; threads may share it. It keeps the bodies of its links.
 */
typedef struct cstk_robot cstk_robot;

/**
 * Collects the links of a robot.
 */
typedef struct cstk_robot_builder cstk_robot_builder;

/**
 * Writes the pose of the link in the joint's frame, 12 doubles, at the joint's own `n` coordinates. Returns CSTK_OK, or
 * anything else to make the call that asked fail with CSTK_ERROR_CALLBACK_FAILED.
 */
typedef int32_t (*cstk_joint_pose_fn)(const double *q, size_t n, double *pose, void *user);

/**
 * Writes the derivative of that pose, 6 rows of `n` doubles, row-major: velocity of the link's origin, then angular
 * velocity of the link, both in the joint's frame.
 */
typedef int32_t (*cstk_joint_jacobian_fn)(const double *q, size_t n, double *jacobian, void *user);

/**
 * A joint by functions of the caller: the report's arbitrary kinematics (§4). Write it with cstk_custom_joint_default
 * first. Both functions are called by any thread that asks about the robot, several at once, also within queries; they
 * must be pure, must not throw, and must not call back into the query that asks. Numbers that are NaN or infinite (or
 * left unwritten in a Jacobian) are answered with CSTK_ERROR_NOT_FINITE, a pose that is none (or left unwritten) with
 * CSTK_ERROR_NOT_A_ROTATION, one that leaves the plane of a planar robot and numbers beyond 1e50 with CSTK_ERROR_INVALID_ARGUMENT.
 */
typedef struct cstk_custom_joint {
  uint32_t size;
  uint32_t cookie;
  /**
   * How many coordinates it has, 1 to 64; as many velocities, their rates.
   */
  uint32_t coordinates;
  uint32_t reserved;
  /**
   * Both must be set.
   */
  cstk_joint_pose_fn pose;
  cstk_joint_jacobian_fn jacobian;
  /**
   * Handed to the functions.
   */
  void *user;
  /**
   * May be NULL. Called once for each link that was added with it, by whichever thread drops the last reference to what
   * uses the link's joint; not called when adding the link fails.
   */
  cstk_destroy_fn destroy;
  /**
   * Bounds of the speed of the link's origin and of its turning, in radians, per unit of any one coordinate, wherever it
   * stands. Negative, the default: not known; then slides that move this joint are refused, as their way cannot be proved
   * free.
   */
  double linear_speed;
  double angular_speed;
} cstk_custom_joint;

/**
 * A link to be added. Write it with cstk_link_def_default first: a fixed link without name or body at the world's origin.
 */
typedef struct cstk_link_def {
  uint32_t size;
  uint32_t cookie;
  /**
   * A name of its own within the robot, UTF-8; NULL for "link<number>". It is copied.
   */
  const char *name;
  /**
   * The link's geometry, or NULL for a frame without any. The robot keeps a reference.
   */
  const cstk_body *body;
  /**
   * The number of the link it is attached to, or -1 for the world.
   */
  int32_t parent;
  /**
   * A cstk_joint_kind.
   */
  int32_t joint;
  /**
   * The joint's frame in the parent's frame: a pose of 12 doubles. The link's frame, in which its body stands, is
   * pose(link) = pose(parent) at motion(coordinate), and coincides with the joint's frame at coordinate 0. For the
   * report's (x, y, z, yaw, pitch, roll) see cstk_pose_from_euler.
   */
  double at[12];
  /**
   * The axis of a revolute or prismatic joint in the joint's frame, of any length; default z.
   */
  double axis[3];
  /**
   * The first of the coordinates that move the joint, or -1 for the next unused ones. Revolute and prismatic joints may
   * follow a single coordinate of any earlier joint, and so mimic it; other joints have coordinates of their own.
   */
  int32_t coordinate;
  uint32_t reserved;
  /**
   * A name of the joint's own within the robot, UTF-8, or NULL for none. It is copied.
   */
  const char *joint_name;
  /**
   * A revolute or prismatic joint follows multiplier * coordinate + offset; default 1 and 0.
   */
  double multiplier;
  double offset;
  /**
   * The range of a revolute or prismatic joint's coordinate, unless the space says otherwise; the default is infinite:
   * revolute joints then turn on the circle. Ignored where the joint shares an earlier one's coordinate.
   */
  double lower;
  double upper;
  /**
   * For CSTK_JOINT_CUSTOM, else NULL. It is copied.
   */
  const cstk_custom_joint *custom;
} cstk_link_def;

/**
 * What a robot knows of a link and the joint that moves it.
 */
typedef struct cstk_link_info {
  /**
   * The link it is attached to, or -1 for the world.
   */
  int32_t parent;
  cstk_joint_kind joint;
  /**
   * The joint's coordinates are `nq` from `coordinate`, its velocities `nv` from `velocity`; both counted in the robot.
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
 * Makes an empty builder for robots of dimension 2 (planar: joints turn about z or shift along x and y) or 3.
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
 * Adds a link; parents before children. Links are numbered from 0 as they are added; the number is written to `out`,
 * which may be NULL.
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
 * Drops a reference. NULL is a no-op. Spaces keep the robots they use.
 */
cstk_status cstk_robot_release(cstk_robot *robot);

/**
 * Writes the number of coordinates (nq), of velocities (nv; less by one for each quaternion) and of links; each may be NULL.
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
 * Writes what the robot knows of a link.
 */
cstk_status cstk_robot_get_link_info(const cstk_robot *robot,
                                     uint32_t link,
                                     cstk_link_info *out);

/**
 * Gives the body of a link, with a reference for the caller to release. CSTK_ERROR_EMPTY if it has none.
 */
cstk_status cstk_robot_get_body(const cstk_robot *robot,
                                uint32_t link,
                                cstk_body **out);

/**
 * Writes a link's name, terminated, into a buffer of `capacity` bytes, and the name's length without the terminator to
 * `length`, which may be NULL. A NULL buffer of capacity 0 asks for the length alone; CSTK_ERROR_WRONG_SIZE if the name does not
 * fit.
 */
cstk_status cstk_robot_get_link_name(const cstk_robot *robot,
                                     uint32_t link,
                                     char *buffer,
                                     size_t capacity,
                                     size_t *length);

/**
 * The same for the name of the joint that moves the link; "" if it has none.
 */
cstk_status cstk_robot_get_joint_name(const cstk_robot *robot,
                                      uint32_t link,
                                      char *buffer,
                                      size_t capacity,
                                      size_t *length);

/**
 * The pose of a link in the world at configuration q (forward kinematics, §4.2), as 12 doubles.
 */
cstk_status cstk_robot_link_pose(const cstk_robot *robot,
                                 const double *q,
                                 size_t nq,
                                 uint32_t link,
                                 double *pose);

/**
 * The basic Jacobian (§4.3, eq. 33) at q of a point fixed to a link, given in the link's frame: 6 rows of nv doubles,
 * row-major; three rows of linear velocity of the point, then three of angular velocity of the link, both in the world.
 */
cstk_status cstk_robot_jacobian(const cstk_robot *robot,
                                const double *q,
                                size_t nq,
                                uint32_t link,
                                const double *point,
                                double *jacobian);

/** @} */

/**
 * @defgroup urdf URDF
 *
 * Robots from URDF files: links, joints, limits, and the meshes and shapes of their collision geometry.
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
   * None: the links have frames only, and no mesh file is looked for.
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
 * How to read a URDF file. Write it with cstk_urdf_options_default first.
 */
typedef struct cstk_urdf_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * A cstk_urdf_geometry; default CSTK_URDF_COLLISION.
   */
  int32_t geometry;
  /**
   * How the root link is joined to what carries the robot: CSTK_JOINT_FIXED (the default), _PLANAR, _FREE or
   * _FREE_EULER.
   */
  int32_t base;
  /**
   * The link of the builder that carries the robot, or -1 for the world.
   */
  int32_t parent;
  /**
   * 0, the default, for spheres, cylinders and capsules as they are. Or into how many sides their circles are divided,
   * 3 to 1024: polyhedra that hold the shapes, with contacts that span a cylinder's faces.
   */
  uint32_t sides;
  /**
   * Where the robot stands on its parent: a pose of 12 doubles.
   */
  double at[12];
  /**
   * Put before the names of links and joints, so that a file can be read twice; may be NULL.
   */
  const char *prefix;
  /**
   * Folders in which the packages of package:// names are looked for; the folders that hold the URDF file are looked
   * through after them.
   */
  const char *const *package_paths;
  size_t package_path_count;
  /**
   * How the links' hierarchies are built; NULL for the defaults.
   */
  const cstk_hierarchy_options *hierarchy;
  /**
   * A folder that keeps the links' bodies, so that the next load builds none of them; made if there is none. NULL, the
   * default, for none. A body is kept under a digest of its meshes' bytes, its shapes and these options; a file that is
   * damaged, of other content or of another version of the library is built anew and replaced. Processes may share the
   * folder. Nothing is ever deleted from it. Who can write to it can change the robot's shapes.
   */
  const char *cache_folder;
} cstk_urdf_options;

/**
 * What was read from a URDF file, what was built, and what was passed over.
 */
typedef struct cstk_urdf_report {
  /**
   * The number of the root link in the builder.
   */
  uint32_t root;
  /**
   * The `link` and `joint` elements.
   */
  uint32_t link_count;
  uint32_t joint_count;
  /**
   * Links that have a body. A robot without any meets nothing.
   */
  uint32_t links_with_body;
  /**
   * Links without a body that have shapes of the kind that was not asked for: `visual` with CSTK_URDF_COLLISION, and so
   * on. Where it is not 0, ask for that kind, or for both in two robots.
   */
  uint32_t links_with_other_shapes;
  /**
   * The links' bodies: links of equal shapes share one.
   */
  uint32_t body_count;
  /**
   * Those of them that were read from the cache folder; the others were built.
   */
  uint32_t bodies_from_cache;
  /**
   * Built bodies that could not be written to the cache folder.
   */
  uint32_t cache_failures;
  /**
   * The shapes that the bodies consist of, those of a shared body once for each link.
   */
  uint32_t shape_count;
  uint32_t mesh_file_count;
  /**
   * Elements in the robot, its links, joints and shapes that were passed over: inertia, materials, transmissions, shapes
   * of the other kind.
   */
  uint32_t skipped_elements;
  uint32_t reserved_number;
  /**
   * Convex primitives of the bodies, those of a shared body once.
   */
  uint64_t primitive_count;
  /**
   * Mesh faces that were not convex or not planar and became triangles, and those without area that were left out.
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
 * Adds the robot of a URDF file to a builder of dimension 3: links and joints under their names, parents before
 * children, branch by branch, the branches of a link in the order of its joints in the file; the root link's number is
 * written to `root`, which may be NULL. `urdf_options` may be NULL for the defaults; `progress`, which may be NULL, is
 * told the part of the links that is done, `user` is passed to it.
 *
 * Joints: fixed, revolute and prismatic (with their limits), continuous, floating, planar, spherical; mimic. Shapes:
 * box, sphere, cylinder, capsule, and meshes in OBJ, STL and DAE, scaled; several of one link become one body. Meshes
 * are surfaces: what is wholly inside one does not meet it. A mesh file is read once, and links of equal shapes share one
 * body: cstk_body_set_data then is for all of them. Whatever else the file says is passed over;
 * cstk_robot_builder_get_urdf_report tells what was found. Failures name the file, the line and the element; the builder is
 * then as it was.
 *
 * Limits, beyond which a file is CSTK_ERROR_UNSUPPORTED: 64 MiB for the URDF file, 1 GiB for a mesh file; 2^17 links; 2^23 faces
 * and 2^25 indices of faces, in one mesh file and in all bodies of the robot together; of these 2^20 faces and 2^22 indices
 * that are made by referring to a mesh or a geometry again; 2^14 corners of a face. In XML, 2^23 tags, 2^12 attributes of an element, 2^8
 * namespaces; in DAE, 2^20 nodes, transforms and instances, 64 levels. Only regular files are read.
 */
cstk_status cstk_robot_builder_load_urdf(cstk_robot_builder *builder,
                                         const char *file,
                                         const cstk_urdf_options *urdf_options,
                                         cstk_progress_fn progress,
                                         void *user,
                                         uint32_t *root);

/**
 * Writes what became of the URDF file that was last added to the builder. CSTK_ERROR_EMPTY if there is none.
 */
cstk_status cstk_robot_builder_get_urdf_report(cstk_robot_builder *builder,
                                               cstk_urdf_report *out);

/** @} */

/**
 * @defgroup space Spaces
 *
 * A space is the C-space of one robot or several: its coordinates, their ranges, and the world box. It offers what planners do
 * with configurations: samples, differences, steps, interpolation, limits, link poses.
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
   * What the joint says: its limits; without any, a circle for angles and the whole line for lengths.
   */
  CSTK_RANGE_DEFAULT = 2,
  /**
   * One of the four entries of a unit quaternion: what joints with quaternions say, and nothing else may be said of them.
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
 * The C-space of one or more robots. Immutable; threads may share it. It keeps its robots.
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
 * Where a robot's numbers begin in a space.
 */
typedef struct cstk_space_offset {
  uint32_t link;
  uint32_t coordinate;
  uint32_t velocity;
  uint32_t reserved;
} cstk_space_offset;


/**
 * Makes the C-space of `robot_count` robots, whose links and coordinates are numbered through in the order given.
 *
 * `ranges` holds one range per coordinate, or is NULL with `range_count` 0 where each has its default; see
 * cstk_range_kind. A range of one value freezes its coordinate. `world_box` holds low x, y, z, high x, y, z: where the
 * links' origins may be; NULL for everywhere. Ranges and box limit slides and cstk_space_contains; other queries answer
 * anywhere. Robots of dimension 2 make a planar world, of dimension 3 a spatial one (the report's
 * make-c-space-planar-world and make-c-space-3d-world).
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
 * Drops a reference. NULL is a no-op. C-objects keep their space.
 */
cstk_status cstk_space_release(cstk_space *space);

/**
 * Writes the number of entries of a configuration (nq), of a velocity or gradient (nv), and of links; each may be NULL.
 */
cstk_status cstk_space_get_size(const cstk_space *space,
                                size_t *nq,
                                size_t *nv,
                                size_t *link_count);

/**
 * Writes the name of a link, numbered through the space; see cstk_robot_get_link_name.
 */
cstk_status cstk_space_get_link_name(const cstk_space *space,
                                     uint32_t link,
                                     char *buffer,
                                     size_t capacity,
                                     size_t *length);

/**
 * Writes where the links, coordinates and velocities of the space's `robot`-th robot begin: add them to the robot's own.
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
 * Writes whether the origin of every link's frame is in the world box at q, and to `link`, which may be NULL, the first that
 * is not (CSTK_NONE if all are).
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
 * The basic Jacobian (eq. 33) at q of a point fixed to a link of the space; as cstk_robot_jacobian, with the space's nv.
 */
cstk_status cstk_space_jacobian(const cstk_space *space,
                                const double *q,
                                size_t nq,
                                uint32_t link,
                                const double *point,
                                double *jacobian);

/**
 * Writes the configuration of no shift and no turn: zeros, and quaternions 0, 0, 0, 1. It may be out of range.
 */
cstk_status cstk_space_get_neutral(const cstk_space *space,
                                   double *q);

/**
 * The configuration that velocity `v` of `nv` doubles leads to from `q` in a unit of time: straight for intervals and
 * circles (which are not wrapped), at constant angular velocity for quaternions, along a screw for free joints. `out` has
 * `nq` doubles and may be `q`.
 */
cstk_status cstk_space_step(const cstk_space *space,
                            const double *q,
                            size_t nq,
                            const double *v,
                            size_t nv,
                            double *out);

/**
 * The smallest velocity that leads from `q0` to `q1` in a unit of time, nv doubles: circles go the shorter way round (the
 * negative one of two that are equal), quaternions turn by at most half a turn.
 */
cstk_status cstk_space_difference(const cstk_space *space,
                                  const double *q0,
                                  const double *q1,
                                  size_t nq,
                                  double *v);

/**
 * The configuration at parameter `t` of the way from `q0` (t = 0) to `q1` (t = 1) at the constant velocity of
 * cstk_space_difference; `t` may lie beyond. `out` has `nq` doubles and may be one of the two. On free joints this way is a
 * screw: the origin does not go straight. See cstk_space_distance.
 */
cstk_status cstk_space_interpolate(const cstk_space *space,
                                   const double *q0,
                                   const double *q1,
                                   size_t nq,
                                   double t,
                                   double *out);

/**
 * The length of the difference of two configurations, each velocity times its weight: `weights` has nv doubles, none
 * negative, or is NULL for 1 each. A metric, but with free joints, or unequal weights of a
 * spherical one: there the triangle inequality fails. For planning
 * trees use a chain of prismatic x, y, z and a spherical joint instead, which goes straight and turns apart.
 */
cstk_status cstk_space_distance(const cstk_space *space,
                                const double *q0,
                                const double *q1,
                                size_t nq,
                                const double *weights,
                                double *out);

/**
 * Draws a configuration uniformly from the coordinates' ranges; quaternions uniformly from the rotations. `state` is that of
 * the stream of random numbers: any number to begin with; each call advances it. Equal states give equal configurations, on
 * every machine. CSTK_ERROR_UNSUPPORTED, naming the coordinate, where a range is unbounded.
 */
cstk_status cstk_space_sample(const cstk_space *space,
                              uint64_t *state,
                              double *q);

/**
 * The nearest configuration whose coordinates are all in range; quaternions are made unit. `out` has `nq` doubles and may be
 * `q`.
 */
cstk_status cstk_space_clamp(const cstk_space *space,
                             const double *q,
                             size_t nq,
                             double *out);

/**
 * The same configuration with circles in [0, 2 pi), as §4.4 has them, and quaternions unit with w >= 0. `out` has `nq`
 * doubles and may be `q`.
 */
cstk_status cstk_space_wrap(const cstk_space *space,
                            const double *q,
                            size_t nq,
                            double *out);

/** @} */

/**
 * @defgroup environment Environments
 *
 * An environment holds s-objects, the obstacles: bodies at poses. Changes are applied together or not at all, while others
 * query; a query sees the state before or after, never between. Objects can be attached to links.
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
 * What a change does.
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
   * Moves object `id` to `pose`; one that is attached to a link is let go there.
   */
  CSTK_CHANGE_MOVE = 1,
  /**
   * Deletes object `id`.
   */
  CSTK_CHANGE_DELETE = 2,
  /**
   * Fixes object `id` to `link` of `space` at `pose`, in the link's frame: a grasp. Nothing is built anew. To take an
   * object from where it stands, `pose` is the inverse of the link's pose composed with the object's; to set it down
   * there again, CSTK_CHANGE_MOVE to the link's pose composed with that. Attached once more, it gets another pose or
   * other touch links.
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
 * The set of s-objects. It may be changed while other threads query it: each query sees one state, whole. It keeps the
 * bodies of its objects.
 */
typedef struct cstk_environment cstk_environment;

/**
 * One change. Write it with cstk_environment_change_default first: an addition at the world's origin.
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
   * The object to move or delete.
   */
  uint64_t id;
  /**
   * The body to add.
   */
  const cstk_body *body;
  /**
   * Where it stands: the body's frame in the world, 12 doubles; for CSTK_CHANGE_ATTACH in the link's frame.
   */
  double pose[12];
  /**
   * For CSTK_CHANGE_ATTACH the space, and the number of its link that holds the object. In other spaces sets that the
   * object belongs to are refused with CSTK_ERROR_UNSUPPORTED: where it is is not known there. The object moves with the
   * link. In a set of links against s-objects it is tested against the other s-objects as the link itself is (r_object
   * of a witness names it), and as an s-object against the links, but for the one that holds it and `touch_count`
   * others, `touch_links` (the fingers, say). These may touch it only while it is held: for approach and retreat make
   * a second set with `allowed` of cstk_induced_options.
   */
  const cstk_space *space;
  const uint32_t *touch_links;
  uint32_t link;
  uint32_t touch_count;
  /**
   * For CSTK_CHANGE_ADD data of the caller's, handed back with witnesses; `destroy` may be NULL, and is called once, by
   * whichever thread drops the last state that holds the object, not when the change fails.
   */
  void *data;
  cstk_destroy_fn destroy;
} cstk_environment_change;

/**
 * An s-object, as it is in one state of its environment.
 */
typedef struct cstk_object_info {
  uint64_t id;
  /**
   * In the world, or, where the object is attached to a link, in that link's frame.
   */
  double pose[12];
  /**
   * The link that it is attached to, numbered through the space it was attached with; CSTK_NONE if it is let go.
   */
  uint32_t link;
  /**
   * How many other links may touch it meanwhile.
   */
  uint32_t touch_count;
  /**
   * Its data, or its body's where it has none of its own, or NULL.
   */
  void *data;
  uint64_t reserved[8];
} cstk_object_info;


/**
 * Makes an empty environment.
 */
cstk_status cstk_environment_create(cstk_environment **out);

/**
 * Adds a reference.
 */
cstk_status cstk_environment_retain(cstk_environment *environment);

/**
 * Drops a reference. NULL is a no-op. C-objects keep the environments they refer to.
 */
cstk_status cstk_environment_release(cstk_environment *environment);

/**
 * Writes the default change. `size` is sizeof(cstk_environment_change).
 */
cstk_status cstk_environment_change_default(cstk_environment_change *out, size_t size);

/**
 * Applies `count` changes as one: all of them or, on failure, none. `ids` receives the id of the object each change is
 * about (`count` entries, or NULL); `version` the environment's new version (or NULL). Ids are never used again, and
 * are unique in the process. All changes have the size of the first.
 *
 * A change takes some microseconds, whatever the number of objects, and many changes in one call much less each: boxes above
 * objects that stay near are refitted in one pass. At times the tree over all objects is built anew (some microseconds an
 * object): after changes of a sixteenth of the objects at the earliest. Other threads that change wait meanwhile; those that
 * query never do. The environment keeps the memory of the state before the last change for the next one; a call that finds
 * that state held by a query or a snapshot copies the parts it changes.
 *
 * CSTK_ERROR_NOT_FOUND for an id that is not there (any more), CSTK_ERROR_UNSUPPORTED for a snapshot.
 */
cstk_status cstk_environment_apply(cstk_environment *environment,
                                   const cstk_environment_change *changes,
                                   size_t count,
                                   uint64_t *ids,
                                   uint64_t *version);

/**
 * Makes an environment that stays as this one is now. It serves wherever an environment does, but cannot be changed.
 */
cstk_status cstk_environment_snapshot(const cstk_environment *environment,
                                      cstk_environment **out);

/**
 * Writes the number of objects and the version, which counts the calls of cstk_environment_apply that succeeded; either
 * may be NULL.
 */
cstk_status cstk_environment_get_state(const cstk_environment *environment,
                                       size_t *object_count,
                                       uint64_t *version);

/**
 * Writes the ids of the objects in the order in which they came: at most `max_count` to `ids` (NULL if that is 0), and their
 * full number to `count`.
 */
cstk_status cstk_environment_get_objects(const cstk_environment *environment,
                                         size_t max_count,
                                         uint64_t *ids,
                                         size_t *count);

/**
 * Writes where an s-object is and what holds it. CSTK_ERROR_NOT_FOUND if there is none with this id (any more).
 */
cstk_status cstk_environment_get_object_info(const cstk_environment *environment,
                                             uint64_t id,
                                             cstk_object_info *out);

/**
 * Writes the pose (12 doubles) of an s-object: in the world, or in the frame of the link that it is attached to (see
 * cstk_environment_get_object_info). CSTK_ERROR_NOT_FOUND if there is none with this id.
 */
cstk_status cstk_environment_get_object_pose(const cstk_environment *environment,
                                             uint64_t id,
                                             double *pose);

/** @} */

/**
 * @defgroup cobject C-objects
 *
 * A C-object is a set in a space (§2.1.3). Induced sets are all q at which links meet obstacles or each other; pure sets are
 * given by coordinates or by functions of the caller; unions, intersections, complements and differences are made of others.
 *
 * @code
     cstk_cobject *obstacles, *limits, *forbidden;
     check(cstk_cobject_induced(space, NULL, 0, environment, NULL, 0, NULL, &obstacles));
     check(cstk_cobject_beyond_limits(space, NULL, &limits));
     const cstk_cobject *parts[2] = {obstacles, limits};
     check(cstk_cobject_union(parts, 2, &forbidden));
 * @endcode
 * @{
 */

/**
 * A set in C-space: induced by contact or interference of links with s-objects or links, given by coordinates, or made of
 * others. Immutable (but for the environments it refers to); threads may share it. It keeps its space and environments.
 */
typedef struct cstk_cobject cstk_cobject;

/**
 * A pair that may meet: a link, and an s-object.
 */
typedef struct cstk_allowed_pair {
  /**
   * A link of the space.
   */
  uint32_t link;
  uint32_t reserved;
  /**
   * An s-object that is attached to the link and stands in its place, or 0 for the link's own body.
   */
  uint64_t attached;
  /**
   * The s-object it may meet.
   */
  uint64_t object;
} cstk_allowed_pair;

/**
 * How an induced C-object measures. Write it with cstk_induced_options_default first.
 */
struct cstk_induced_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * Distances above 0 and up to this classify as CSTK_CLASS_CONTACT. Default 0.
   */
  double contact_epsilon;
  /**
   * Grows the s-objects by this length: it is taken off every distance of the C-object, so that configurations nearer
   * than the margin are inside. Points and normals stay those of the real surfaces. Default 0.
   */
  double margin;
  /**
   * Pairs that are left out of a set of links against s-objects: `allowed_count` of them; NULL, the default, for none. Ids
   * are not checked: an object may come later. Sets are made in no time; who allows other pairs makes another one.
   */
  const cstk_allowed_pair *allowed;
  size_t allowed_count;
};

/**
 * Writes where configuration q (`nq` doubles) stands: a cstk_class. Returns CSTK_OK, or anything else to make the query
 * fail with CSTK_ERROR_CALLBACK_FAILED.
 */
typedef int32_t (*cstk_predicate_class_fn)(const double *q, size_t nq, int32_t *out, void *user);

/**
 * Writes how far q is from the set, in units of C-space: positive where the class is not CSTK_CLASS_INSIDE, and there 0, or minus
 * the depth.
 */
typedef int32_t (*cstk_predicate_distance_fn)(const double *q, size_t nq, double *out, void *user);

/**
 * Writes the derivative of that distance, `nv` doubles, one a velocity of cstk_space_step.
 */
typedef int32_t (*cstk_predicate_gradient_fn)(const double *q,
                                              size_t nq,
                                              double *row,
                                              size_t nv,
                                              void *user);

/**
 * A set by functions of the caller. Write it with cstk_predicate_default first. The functions are called by any thread
 * that asks about the set, several at once, also within queries; they must be pure, must not throw, and must not call
 * back into the query that asks. Slides take no sets with predicates. What they write is checked: numbers that are none,
 * a class that is none, and a distance that does not fit the class are answered with CSTK_ERROR_CALLBACK_FAILED.
 */
typedef struct cstk_predicate {
  uint32_t size;
  uint32_t cookie;
  /**
   * Must be set. It alone says what is in contact; the options' contact_epsilon is not looked at.
   */
  cstk_predicate_class_fn classify;
  /**
   * May be NULL: then distances are not known outside the set (CSTK_DISTANCE_LOWER_BOUND, from 0), nor those from its complement
   * where the class is not CSTK_CLASS_OUTSIDE, and it has witnesses only where it holds q. Distances are at most 1e50.
   */
  cstk_predicate_distance_fn distance;
  /**
   * May be NULL: then cstk_gradients and cstk_pseudo_normal are refused within epsilon of the set (CSTK_ERROR_UNSUPPORTED).
   * Without a distance function either, the set has no gradients: no witness outside, one without a contact inside.
   */
  cstk_predicate_gradient_fn gradient;
  /**
   * Handed to the functions.
   */
  void *user;
  /**
   * May be NULL. Called once, by whichever thread drops the last reference to what uses the functions.
   */
  cstk_destroy_fn destroy;
  /**
   * The distance function gives lower bounds outside: the truth may be more. Default 0.
   */
  uint32_t distance_is_bound;
  /**
   * The distance function gives minus the depth inside: the distance from the complement, exactly. Default 0.
   */
  uint32_t knows_depth;
} cstk_predicate;

/**
 * How a pure set measures. Write it with cstk_pure_options_default first.
 */
typedef struct cstk_pure_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * Distances above 0 and up to this classify as CSTK_CLASS_CONTACT; in units of C-space, for floors and the world box in
   * lengths. Default 0.
   */
  double contact_epsilon;
  /**
   * The length that a unit of C-space stands for. Distances of the set are multiplied by it, and so can be compared with
   * those of induced sets; 0, the default: they are not, and queries of distance of both together are refused.
   */
  double scale;
} cstk_pure_options;


/**
 * Writes the default options. `size` is sizeof(cstk_induced_options).
 */
cstk_status cstk_induced_options_default(cstk_induced_options *out, size_t size);

/**
 * Makes the set of configurations at which a link meets an s-object.
 *
 * `links` holds `link_count` numbers of links of the space; with `link_count` 0 all are meant (CSTK_ERROR_EMPTY if none has a
 * body), those too that no joint moves, such as a base: their gradients are 0, and they may always be nearest. What a
 * link of these holds is tested with it (see CSTK_CHANGE_ATTACH): a frame without a body, such as a tool's, counts for
 * what it holds, and must be among `links` for that. Links 0 to i - 1 give the set of the first i links. The robot with
 * itself is not meant; see cstk_cobject_induced_links. `ids` holds `id_count` ids of objects of the environment; with
 * `id_count` 0 all its objects are meant, those added later too. An object that is deleted later contributes nothing;
 * one of another dimension than the robots is refused by the queries that meet it. `options` may be NULL for the
 * defaults.
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
 * Makes the set of configurations at which the two links of some pair meet: one robot with itself, or robots with each
 * other. `pairs` holds 2 * `pair_count` link numbers; the second of a pair is the nominal s-object. Links that are
 * joined touch at every configuration; leave such pairs out. Without any pair the set is empty.
 */
cstk_status cstk_cobject_induced_links(const cstk_space *space,
                                       const uint32_t *pairs,
                                       size_t pair_count,
                                       const cstk_induced_options *options,
                                       cstk_cobject **out);

/**
 * Adds a reference.
 */
cstk_status cstk_cobject_retain(cstk_cobject *cobject);

/**
 * Drops a reference. NULL is a no-op.
 */
cstk_status cstk_cobject_release(cstk_cobject *cobject);

/**
 * Makes the union of `count` C-objects of one space: its class is the largest of theirs. It keeps its parts. A
 * body pair that several induced parts hold in one state counts once, with the largest margin.
 *
 * Sets of any kind may be combined, to a depth of 256 (unions in unions count as one). A union may be grown one part at a
 * time: a call takes time in proportion to `count`, the first query of the whole in proportion to all parts. Of a union of induced sets every
 * query is exact; of other compounds cstk_distance says what it knows:
 * - a union is as near as its nearest part;
 * - an intersection is no nearer than its farthest part: CSTK_DISTANCE_LOWER_BOUND, but for 0 where all parts are 0;
 * - a complement is taken of the leaves, by De Morgan's laws. From the complement of a pure set (no predicate) the distance
 *   is exact; from that of an induced set it is 0 where nothing meets, and not known inside: CSTK_DISTANCE_LOWER_BOUND, from 0.
 *
 * cstk_within(t) holds where the lower bound is at most t. cstk_witnesses and cstk_gradients list every pair of every
 * induced leaf within epsilon, and every pure leaf (or its complement), whatever the tree makes of them; rows are the
 * derivatives of those distances. Complements and the sets beyond limits are open: on their boundary the distance is 0,
 * but the class is not CSTK_CLASS_INSIDE. Lengths and units of C-space are not compared: CSTK_ERROR_UNSUPPORTED for distances where
 * a pure set without a scale meets an induced one.
 */
cstk_status cstk_cobject_union(const cstk_cobject *const *parts,
                               size_t count,
                               cstk_cobject **out);

/**
 * Makes the intersection of `count` C-objects of one space: its class is the smallest of theirs. See cstk_cobject_union.
 */
cstk_status cstk_cobject_intersection(const cstk_cobject *const *parts,
                                      size_t count,
                                      cstk_cobject **out);

/**
 * Makes the complement of a C-object: CSTK_CLASS_INSIDE where that is CSTK_CLASS_OUTSIDE, and the other way round; contact stays. See
 * cstk_cobject_union.
 */
cstk_status cstk_cobject_complement(const cstk_cobject *part,
                                    cstk_cobject **out);

/**
 * Makes the set of what is in `of` and not in `without`: the intersection with the complement. See cstk_cobject_union.
 */
cstk_status cstk_cobject_difference(const cstk_cobject *of,
                                    const cstk_cobject *without,
                                    cstk_cobject **out);

/**
 * Makes the same set with data of the caller's attached (§2.2.3). Witnesses, distances and explanations of every C-object
 * that has the new one as a leaf hand `data` back. `destroy` may be NULL; it is called once, by whichever thread drops the
 * last reference to what carries the data, and not when this call fails.
 */
cstk_status cstk_cobject_with_data(const cstk_cobject *cobject,
                                   void *data,
                                   cstk_destroy_fn destroy,
                                   cstk_cobject **out);

/**
 * Makes the same induced or pure set with a shell of its own for cstk_slide: its contacts constrain a step up to that distance,
 * instead of `max_shell` of the slide's options, and it is kept at the same part of it: with a desired distance of a tenth of
 * max_shell, at a tenth of `shell`. Links of a robot are mostly near each other: a self-collision set with a shell of one or
 * two steps' motion, in a union with obstacles that are looked for from afar, makes steps several times faster. `shell` is a
 * length, for a pure set in the unit of its distances, larger than 0. Other queries do not look at it. The set keeps its data
 * and takes a number of its own (cstk_cobject_get_data). A union, an intersection or a complement is refused:
 * CSTK_ERROR_UNSUPPORTED; its parts take shells before they are combined.
 */
cstk_status cstk_cobject_with_shell(const cstk_cobject *cobject,
                                    double shell,
                                    cstk_cobject **out);

/**
 * Writes the data attached to a C-object (or NULL) and its number, by which witnesses and explanations name it as a leaf;
 * either may be NULL. No two sets of a process have one number; the
 * complement of a complement is the set itself, and so has its number.
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
 * Makes the set of configurations with a coordinate beyond its range in the space: the joint limits as an obstacle. At a
 * limit the configuration is not inside yet (the set is open). Distances are those from the nearest limit, in units of the
 * coordinates. `options` may be NULL for the defaults, here and below. A space without limits gives an empty set.
 */
cstk_status cstk_cobject_beyond_limits(const cstk_space *space,
                                       const cstk_pure_options *options,
                                       cstk_cobject **out);

/**
 * Makes the set of configurations at which the origin of some link is outside the world box of the space. It measures in
 * lengths, whatever the scale, and answers at link poses too. Open, as cstk_cobject_beyond_limits.
 */
cstk_status cstk_cobject_beyond_world(const cstk_space *space,
                                      const cstk_pure_options *options,
                                      cstk_cobject **out);

/**
 * Makes the set of configurations at which the body of a link reaches the half-space normal . x <= offset of the world
 * (`normal`: three doubles of any length; in the plane its z is 0): a floor, a wall or a ceiling without end. `links` holds
 * `link_count` numbers of links; with `link_count` 0 all that have a body are meant. Leave out a base that stands on the
 * floor. A margin is had by a larger offset. What links hold is not tested: where they carry something, a large box in the
 * environment sees that.
 *
 * Exact, and asked in logarithmic time: it measures in lengths, whatever the scale, to the lowest point of all, and answers
 * at link poses too. Contacts are at that point (see CSTK_MODE_PURE_SET), and have a gradient where it is inside as well. The
 * distance from its complement is not known where it is not 0.
 */
cstk_status cstk_cobject_below_floor(const cstk_space *space,
                                     const uint32_t *links,
                                     size_t link_count,
                                     const double *normal,
                                     double offset,
                                     const cstk_pure_options *options,
                                     cstk_cobject **out);

/**
 * Makes the set of configurations whose every coordinate i is from low[i] to high[i] (`nq` doubles each; -INFINITY and
 * INFINITY leave a coordinate free, and must do so for quaternions). On a circle the interval is the arc from low[i]
 * upwards to high[i], which is no less: from 3 to 4, say, past pi; it has two ends or none. The distance is the root of
 * the sum of the squares, angles the shorter way round.
 */
cstk_status cstk_cobject_box(const cstk_space *space,
                             const double *low,
                             const double *high,
                             size_t nq,
                             const cstk_pure_options *options,
                             cstk_cobject **out);

/**
 * Makes the set of configurations with normal . q <= offset (`nq` doubles). Entries for coordinates on circles and of
 * quaternions must be 0.
 */
cstk_status cstk_cobject_halfspace(const cstk_space *space,
                                   const double *normal,
                                   size_t nq,
                                   double offset,
                                   const cstk_pure_options *options,
                                   cstk_cobject **out);

/**
 * Makes the set of configurations at most `radius` from `center` (`nq` doubles): by the root of the sum of the squares of
 * differences, angles the shorter way round, quaternions by the angle of the turn, free joints by shift and turn.
 */
cstk_status cstk_cobject_ball(const cstk_space *space,
                              const double *center,
                              size_t nq,
                              double radius,
                              const cstk_pure_options *options,
                              cstk_cobject **out);

/**
 * Makes a set that functions of the caller define. `predicate` is copied; its data are given back when nothing refers to the
 * set any more, and not when this call fails.
 */
cstk_status cstk_cobject_predicate(const cstk_space *space,
                                   const cstk_predicate *predicate,
                                   const cstk_pure_options *options,
                                   cstk_cobject **out);

/** @} */

/**
 * @defgroup query Query contexts
 *
 * A query context holds one thread's caches and scratch memory, and the lists that its last call wrote. What it remembers
 * changes how long an answer takes, never the answer (§2.3.4).
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
 * Which contacts come with each witness of a list (cstk_query_set_contacts). Finding them takes most of the time that a
 * witness takes.
 */
enum cstk_contacts_listed
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * All: parallel features have several. With these a context begins.
   */
  CSTK_CONTACTS_ALL = 0,
  /**
   * The one at the closest points.
   */
  CSTK_CONTACTS_NEAREST = 1,
  /**
   * None, and no gradients. It is then not told whether what meets touches or overlaps: at distance 0 `overlapping` is true.
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
 * One thread's caches and scratch memory, and the home of the arrays it answers with. A context serves one thread at a
 * time and answers CSTK_ERROR_BUSY otherwise; make one per thread. Caches change how long an answer takes, never the answer.
 */
typedef struct cstk_query cstk_query;

/**
 * The work a query context has done.
 */
typedef struct cstk_query_statistics {
  /**
   * Pairs of hierarchy nodes whose wrappers were tested, pairs of bodies with them; of rays into solids, the nodes.
   */
  uint64_t node_pairs;
  /**
   * Primitive pairs that were looked at; of rays, the faces.
   */
  uint64_t primitive_pairs;
  /**
   * Witnesses of earlier queries that were evaluated first.
   */
  uint64_t cache_hits;
  /**
   * Of `primitive_pairs` those whose distance was asked for: polygons that a direction known before parts are left out.
   */
  uint64_t primitive_distances;
  uint64_t reserved[4];
} cstk_query_statistics;


/**
 * Makes a query context.
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
 * Writes the version of an environment that the last query with this context saw: of each environment that its C-object
 * refers to. CSTK_ERROR_NOT_FOUND if it refers to others only, or nothing was asked yet.
 */
cstk_status cstk_query_get_version(cstk_query *query,
                                   const cstk_environment *environment,
                                   uint64_t *out);

/**
 * Sets which contacts come with the witnesses that cstk_witnesses, cstk_gradients, cstk_pseudo_normal, cstk_pair_witnesses and
 * their variants list with this context from now on; `listed` is a cstk_contacts_listed. Witnesses and their distances are
 * the same with each. cstk_slide asks for what it needs itself; cstk_slide_step and cstk_spring_step need lists with all
 * contacts. CSTK_ERROR_INVALID_ARGUMENT for another number.
 */
cstk_status cstk_query_set_contacts(cstk_query *query,
                                    int32_t listed);

/**
 * Limits the work of each query with this context from now on to `node_and_primitive_pairs`: of every call that is given the
 * context and answers, or slides, from cstk_pair_within to cstk_find_link_pairs. A query that needs more returns CSTK_ERROR_LIMIT and
 * writes nothing; the context can be asked again at once. 0 stands for no limit, with which a context begins.
 *
 * What counts is what cstk_query_statistics counts as `node_pairs` and `primitive_pairs`: a million takes from 10
 * milliseconds (nodes of meshes) to a second (primitives that are no polygons). Penetrations of polyhedra count each two edges that are compared, too. The work depends on the question
 * and on what the context remembers of earlier ones, neither on the thread nor on the machine's load: a context asked the
 * same from its creation on ends at the same call. Not counted is what a call takes whatever it finds: kinematics, pure
 * sets, functions of the caller.
 */
cstk_status cstk_query_set_limit(cstk_query *query,
                                 uint64_t node_and_primitive_pairs);

/**
 * Writes the work done since the context was made, or since the last call with `reset`.
 */
cstk_status cstk_query_get_statistics(cstk_query *query,
                                      bool reset,
                                      cstk_query_statistics *out);

/** @} */

/**
 * @defgroup at_configuration Queries at a configuration
 *
 * Operations 4 to 8 of §2.2.4 for a C-object: is q free, how far from contact, between what, which way is out, and why. Callers with
 * kinematics of their own ask at link poses instead of q.
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
 * Stands for "no such number" in fields that hold a link's number.
 */
#define CSTK_NONE 4294967295

/**
 * Where a configuration stands. The order is that of the set algebra: a union takes the largest.
 */
enum cstk_class
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Farther from contact than the contact epsilon.
   */
  CSTK_CLASS_OUTSIDE = 0,
  /**
   * Apart, by at most the contact epsilon; doubt within rounding counts as contact.
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
 * What a distance says.
 */
enum cstk_distance_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The distance, to rounding.
   */
  CSTK_DISTANCE_EXACT = 0,
  /**
   * Only `lower` and `upper` are known; `distance` repeats `lower`.
   */
  CSTK_DISTANCE_LOWER_BOUND = 1,
  /**
   * Nothing is within max_distance: `lower` is max_distance, less rounding; `distance` and `upper` are infinite.
   */
  CSTK_DISTANCE_BEYOND_MAX = 2,
  /**
   * There is nothing to measure to; all three are infinite.
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
   * The boundary of a pure set: there are no features. Points and normal are 0; of the world box they are those of the
   * link's origin, of a floor those of the link's lowest point.
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
 * What was found out about a pair of links.
 */
enum cstk_pair_verdict
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * To be tested: the two touched in some samples, or are of different robots.
   */
  CSTK_PAIR_TEST = 0,
  /**
   * The two are joined, with no link that has a body in between, or fixed to each other.
   */
  CSTK_PAIR_ADJACENT = 1,
  /**
   * They touch at rest.
   */
  CSTK_PAIR_AT_REST = 2,
  /**
   * They touch in all samples, or nearly.
   */
  CSTK_PAIR_ALWAYS = 3,
  /**
   * They touched in no sample; tested all the same unless skip_never.
   */
  CSTK_PAIR_NEVER = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum cstk_pair_verdict cstk_pair_verdict;
#else
typedef int32_t cstk_pair_verdict;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * One pair of primitives, or a piece of one body wholly inside the other; or one pure set, whose links are CSTK_NONE,
 * but for `r_link` of the world box and of floors: the link that is nearest to them, or farthest into them.
 */
typedef struct cstk_witness {
  /**
   * The link, numbered through the space; 0 for pairs of bodies.
   */
  uint32_t r_link;
  /**
   * The second link, or the one that the s-object is attached to; CSTK_NONE if the s-side is another s-object or a body.
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
   * Its contacts are `contact_count` entries of the list from `first_contact`. Parallel features have several, which
   * span the common part.
   */
  uint32_t first_contact;
  uint32_t contact_count;
  /**
   * The primitives overlap, deeper than just inside, or `contained`: there is no contact, and no gradient. With
   * CSTK_CONTACTS_NONE all at distance 0 counts as overlapping.
   */
  bool overlapping;
  /**
   * A piece of one body (what of it hangs together) lies wholly inside the other, a solid. The primitives do not meet:
   * they stand for the two, the lowest of the piece and the lowest of what of the solid's boundary is around it.
   */
  bool contained;
  /**
   * The set's complement is meant.
   */
  bool complemented;
  uint8_t reserved_bytes[1];
  /**
   * Of joint limits and C-space boxes the coordinate that decides: the one farthest beyond its range, or nearest to
   * its end (distances combine all); else CSTK_NONE.
   */
  uint32_t coordinate;
  /**
   * The leaf C-object that the pair is of, as cstk_cobject_get_data numbers it, and its data; 0 and NULL for pairs of
   * bodies.
   */
  uint64_t cobject;
  void *cobject_data;
  /**
   * The data of the r-side's body and of the s-object, or of its body where it has none of its own; NULL where there
   * are none.
   */
  void *r_data;
  void *s_data;
  /**
   * The s-object attached to r_link that is the r-side, or 0 for the link's own body.
   */
  uint64_t r_object;
  uint64_t reserved[4];
} cstk_witness;

/**
 * One contact. The r-side is the link (or body a), the s-side the s-object, second link or body b.
 */
typedef struct cstk_contact {
  /**
   * The two points, in the world.
   */
  double r_point[3];
  double s_point[3];
  /**
   * Unit, in the world, from the s-side to the r-side; right at exact touch too.
   */
  double normal[3];
  /**
   * The distance between the points, less the C-object's margin and at least 0.
   */
  double distance;
  cstk_contact_mode mode;
  /**
   * The features that hold the points; for their vertices see cstk_body_get_feature_vertices.
   */
  cstk_feature_kind r_feature_kind;
  uint32_t r_feature;
  cstk_feature_kind s_feature_kind;
  uint32_t s_feature;
  uint32_t reserved_word;
  /**
   * The distance between the points, less the C-object's margin, with its sign: negative within the margin, and where the
   * primitives are just inside one another (by at most 1e-6 of the pair's size), or as deep as their radii let
   * round ones be while their cores are apart.
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
   * `witness` and the points below hold the nearest primitive pair; ties (equal to the last bit) go to the lowest ids.
   */
  bool has_witness;
  /**
   * `contact` holds the contact at these points. An overlap has none. Parallel features have more; see
   * cstk_witnesses.
   */
  bool has_contact;
  uint8_t reserved_bytes[2];
  /**
   * 0 exactly when the sets meet, the s-side grown by the C-object's margin.
   */
  double distance;
  /**
   * Never above the truth. Where `distance` is finite, 0 exactly when that is.
   */
  double lower;
  /**
   * Never below the truth: infinite where of an intersection, a difference or a complement no more is known.
   */
  double upper;
  /**
   * The closest points, in the world, r-side and s-side. Where the sets overlap, both are one common point; of a piece
   * inside a solid, a vertex of the piece.
   */
  double r_point[3];
  double s_point[3];
  cstk_witness witness;
  cstk_contact contact;
  /**
   * The version of the environment that was measured, the largest of several; 0 where there is none.
   */
  uint64_t environment_version;
  uint64_t reserved[8];
} cstk_distance_result;

/**
 * Primitive pairs, nearest first, with their contacts. The arrays belong to the query context and stay valid until its
 * next call or its release.
 */
typedef struct cstk_witness_list {
  const cstk_witness *witnesses;
  size_t witness_count;
  const cstk_contact *contacts;
  size_t contact_count;
  /**
   * One row of `nv` doubles per contact (not per witness): by how much its distance grows per unit of each
   * velocity. NULL where there is none.
   */
  const double *gradients;
  size_t nv;
  /**
   * There are more witnesses than max_count; these are the nearest.
   */
  bool truncated;
  /**
   * Not all contacts are listed, by cstk_query_set_contacts: cstk_slide_step and cstk_spring_step refuse such a list.
   */
  bool contacts_left_out;
  uint8_t reserved_bytes[6];
  uint64_t environment_version;
  uint64_t reserved[8];
} cstk_witness_list;

/**
 * Everything about one configuration: Appendix A's cstk-pseudo-normal.
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
 * What one leaf of a C-object's tree says of a configuration.
 */
typedef struct cstk_verdict {
  /**
   * The leaf, as cstk_cobject_get_data numbers it, and its data.
   */
  uint64_t cobject;
  void *data;
  /**
   * The class with respect to the leaf itself.
   */
  cstk_class leaf_class;
  /**
   * The tree takes the leaf's complement.
   */
  bool complemented;
  /**
   * The class of the whole rests on this leaf (and on the other decisive ones): on the way down to it the part's class was
   * that of each union and intersection.
   */
  bool decisive;
  uint8_t reserved_bytes[2];
  /**
   * The pairs of primitives that made the leaf's class, if it is decisive: `witness_count` entries of the list.
   */
  uint32_t first_witness;
  uint32_t witness_count;
  uint64_t reserved[2];
} cstk_verdict;

/**
 * A class with its reasons. The arrays belong to the query context and stay valid until its next call or its release.
 */
typedef struct cstk_explanation {
  cstk_class point_class;
  uint32_t reserved_word;
  /**
   * Every leaf; one that is meant both as it is and by its complement stands twice.
   */
  const cstk_verdict *leaves;
  size_t leaf_count;
  /**
   * Pairs that meet where the leaf's class is CSTK_CLASS_INSIDE, or are within its contact epsilon where it is CSTK_CLASS_CONTACT: as
   * for classes, doubt within rounding counts as within, so that `distance` may be above the epsilon by that.
   */
  cstk_witness_list list;
  uint64_t reserved[4];
} cstk_explanation;

/**
 * How pairs of links are judged. Write it with cstk_link_pair_options_default first.
 */
typedef struct cstk_link_pair_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * How many configurations are drawn from the space; default 1000.
   */
  uint64_t samples;
  /**
   * Decides which; default 0. Equal seeds give equal answers.
   */
  uint64_t seed;
  /**
   * The configuration at rest, as many doubles as the space has coordinates; NULL, the default, for all at 0, clamped to
   * their ranges. Coordinates without bounds stay as at rest.
   */
  const double *rest;
  /**
   * Links at most this far apart count as touching; default 0.
   */
  double margin;
  /**
   * Pairs that touch in this share of the samples, or more, always touch; default 0.95.
   */
  double always;
  /**
   * Nonzero: pairs that touched in no sample are left out of the pairs to test, too. No sampling proves that they
   * cannot touch. Default 0.
   */
  uint32_t skip_never;
  uint32_t reserved;
} cstk_link_pair_options;

/**
 * A pair of links that have bodies, the lower number first.
 */
typedef struct cstk_link_pair {
  uint32_t r_link;
  uint32_t s_link;
  cstk_pair_verdict verdict;
  /**
   * The robots that the two are of, in the order of the space's.
   */
  uint32_t r_robot;
  uint32_t s_robot;
  uint32_t reserved;
  /**
   * The share of the samples in which they touch; 0 where the verdict needed none.
   */
  double share;
} cstk_link_pair;

/**
 * All pairs of links that have bodies. The arrays belong to the query context and stay valid until its next call or its
 * release.
 */
typedef struct cstk_link_pair_list {
  const cstk_link_pair *pairs;
  size_t count;
  /**
   * The pairs to test, two numbers each, as cstk_cobject_induced_links takes them; NULL where there is none.
   */
  const uint32_t *tested;
  size_t tested_count;
  uint64_t reserved[4];
} cstk_link_pair_list;

/**
 * A pair of primitives that meet, and the shortest translation that takes the two apart.
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
   * How far; 0 for primitives that only touch, or have no inside in common.
   */
  double depth;
  /**
   * Which way body a has to go: a unit vector in the world, from body b to body a.
   */
  double direction[3];
  /**
   * A point of each, in the world, that the translation brings together: s_point = r_point + depth * direction.
   */
  double r_point[3];
  double s_point[3];
  uint64_t reserved[6];
} cstk_penetration;

/**
 * Primitive pairs that meet, the deepest first. The array belongs to the query context and stays valid until its next
 * call or its release.
 */
typedef struct cstk_penetration_list {
  const cstk_penetration *penetrations;
  size_t count;
  /**
   * Each body is one convex primitive: the first entry takes the bodies apart. Else an entry takes apart its two
   * primitives only.
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
 * Writes whether configuration q is inside the C-object, in contact with it, or outside (§2.2.4, operation 4). `q` has
 * `nq` doubles, as many as the space has coordinates.
 */
cstk_status cstk_classify(cstk_query *query,
                          const cstk_cobject *cobject,
                          const double *q,
                          size_t nq,
                          cstk_class *out);

/**
 * cstk_classify for callers with kinematics of their own: `link_poses` holds the pose of every link of the space in the
 * world, `link_count` runs of 12 doubles. Such callers get a contact's gradient as n^T (J_r - J_s), with their Jacobians of
 * the links' points r_point and s_point.
 */
cstk_status cstk_classify_at_link_poses(cstk_query *query,
                                        const cstk_cobject *cobject,
                                        const double *link_poses,
                                        size_t link_count,
                                        cstk_class *out);

/**
 * Writes whether the distance at q is at most `threshold` (not negative; may be INFINITY). Doubt within rounding counts
 * as within. Of unions of induced sets and closed pure sets it is true with threshold 0 where cstk_classify says
 * CSTK_CLASS_INSIDE. At the boundary of an open set (at a joint limit, say), and where of an intersection or a complement only a
 * lower bound of the distance is known, it is true where the class is less: ask cstk_classify whether a configuration is
 * allowed. Cheaper than a distance.
 */
cstk_status cstk_within(cstk_query *query,
                        const cstk_cobject *cobject,
                        const double *q,
                        size_t nq,
                        double threshold,
                        bool *out);

/**
 * cstk_within with the pose of every link, as in cstk_classify_at_link_poses.
 */
cstk_status cstk_within_at_link_poses(cstk_query *query,
                                      const cstk_cobject *cobject,
                                      const double *link_poses,
                                      size_t link_count,
                                      double threshold,
                                      bool *out);

/**
 * Writes the distance at q from contact, and the nearest pair of primitives (§2.2.4, operation 6). Distances beyond
 * `max_distance` (INFINITY to have them all) are not computed, which saves time; the answer is then CSTK_DISTANCE_BEYOND_MAX.
 */
cstk_status cstk_distance(cstk_query *query,
                          const cstk_cobject *cobject,
                          const double *q,
                          size_t nq,
                          double max_distance,
                          cstk_distance_result *out);

/**
 * cstk_distance with the pose of every link, as in cstk_classify_at_link_poses.
 */
cstk_status cstk_distance_at_link_poses(cstk_query *query,
                                        const cstk_cobject *cobject,
                                        const double *link_poses,
                                        size_t link_count,
                                        double max_distance,
                                        cstk_distance_result *out);

/**
 * Writes all pairs of primitives at most `epsilon` apart at q, none missing, none twice (§2.2.4, operation 7), and their
 * contacts. Within rounding of epsilon, cstk_within may hold where no witness is given. Of more than `max_count` pairs, the
 * nearest are given and `truncated` is set. Neighbouring faces of a mesh share edges and vertices, so that one physical
 * contact may have several witnesses. Each piece of a body that lies inside another, a solid, is a witness too, at distance
 * 0 (see `contained`). The arrays stay valid until the next call with this query context.
 */
cstk_status cstk_witnesses(cstk_query *query,
                           const cstk_cobject *cobject,
                           const double *q,
                           size_t nq,
                           double epsilon,
                           size_t max_count,
                           cstk_witness_list *out);

/**
 * cstk_witnesses with the pose of every link, as in cstk_classify_at_link_poses.
 */
cstk_status cstk_witnesses_at_link_poses(cstk_query *query,
                                         const cstk_cobject *cobject,
                                         const double *link_poses,
                                         size_t link_count,
                                         double epsilon,
                                         size_t max_count,
                                         cstk_witness_list *out);

/**
 * cstk_witnesses, and for each contact the gradient of its distance (§2.2.4, operation 8; §4.4): by how much it grows
 * per unit of each velocity of cstk_space_step, the way out in joint space. For the nearest pair alone ask cstk_distance
 * first and give its `upper` as epsilon where that is finite: a large epsilon visits every pair, whatever max_count. Row
 * i, at gradients + i * nv, is that of contacts[i]; overlapping witnesses have no contact and no row. The arrays stay
 * valid until the next call with this query context.
 */
cstk_status cstk_gradients(cstk_query *query,
                           const cstk_cobject *cobject,
                           const double *q,
                           size_t nq,
                           double epsilon,
                           size_t max_count,
                           cstk_witness_list *out);

/**
 * Writes class, distance, and the witnesses and gradients within `max_shell` at q. With `normalize`, gradients have
 * length 1 (those of length 0 stay). The list's arrays stay valid until the next call with this query context.
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
 * Writes the class of q as cstk_classify does, and what made it: which leaves of the C-object, and which pairs of primitives
 * (§2.2.4, operations 4 and 5). Every leaf is asked, so it takes longer. At most `max_count` pairs are listed.
 */
cstk_status cstk_explain(cstk_query *query,
                         const cstk_cobject *cobject,
                         const double *q,
                         size_t nq,
                         size_t max_count,
                         cstk_explanation *out);

/**
 * Writes the default options. `size` is sizeof(cstk_link_pair_options).
 */
cstk_status cstk_link_pair_options_default(cstk_link_pair_options *out, size_t size);

/**
 * Writes which pairs of links of the space to test for self-collision, and why not the others: those joined, those that
 * touch at rest, and those that touch in at least `always` of the sampled configurations are left out. Links of different
 * robots are always tested. Give `tested` to cstk_cobject_induced_links (it may be empty); to
 * allow further pairs, leave them out. Two links may count as touching by `margin`: take no less than the margin of that set
 * together with its contact epsilon, else pairs are tested that are always in contact. `options`
 * may be NULL for the defaults; `progress` may be NULL, `user` is passed to it.
 */
cstk_status cstk_find_link_pairs(cstk_query *query,
                                 const cstk_space *space,
                                 const cstk_link_pair_options *options,
                                 cstk_progress_fn progress,
                                 void *user,
                                 cstk_link_pair_list *out);

/** @} */

/**
 * @defgroup pair Pair queries
 *
 * Two bodies at two poses: what is asked of FCL or Coal.
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
 * Writes the distance of body a at pose_a from body b at pose_b, and the nearest pair of primitives. Poses are 12
 * doubles, row-major [R | t], the body's frame in the world. Distances beyond `max_distance` (INFINITY to have them
 * all) are not computed; the answer is then CSTK_DISTANCE_BEYOND_MAX.
 */
cstk_status cstk_pair_distance(cstk_query *query,
                               const cstk_body *body_a,
                               const double *pose_a,
                               const cstk_body *body_b,
                               const double *pose_b,
                               double max_distance,
                               cstk_distance_result *out);

/**
 * Writes whether the two bodies are at most `threshold` apart (not negative; may be INFINITY); 0 asks whether they meet.
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
 * Writes all pairs of primitives at most `epsilon` apart, none missing, none twice, and their contacts; and at distance 0
 * each piece of a body that lies inside the other, a solid (see `contained`). Of more than `max_count`, the nearest are
 * given and `truncated` is set. The arrays stay valid until the next call with this query context.
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
 * Writes all pairs of primitives that meet, none missing, none twice, and how deep they are in one another: the shortest
 * translation that takes the two apart. Bodies of one convex primitive each are taken apart by it; those of several are
 * not, for it is about two primitives only (see `of_whole_bodies`). Exact to rounding, with radii too; the work for a
 * pair of polyhedra grows with the number of their edges and with that of the pairs of edges that face each other.
 * CSTK_ERROR_UNSUPPORTED where a cylinder, cone, ellipsoid
 * or support function meets another primitive. What lies wholly inside a solid (cstk_body_builder_set_solid) meets none
 * of its primitives: nothing is listed for it. Of more than `max_count` pairs, the deepest are given and `truncated` is
 * set. The array stays valid until the next call with this query context.
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
 * @defgroup slide Slides
 *
 * The step that slides along contact, proved free on its whole way, and its two halves for callers who put them together
 * themselves (§2.2.4, Appendix A).
 *
 * @code
     cstk_slide_options options;
     cstk_slide_result slid;
     check(cstk_slide_options_default(&options, sizeof options));
     options.max_shell = 0.05;
     check(cstk_slide(query, cobject, q, nq, step, nv, &options, q, &slid));
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
   * A step was found, and it keeps clear of the C-object all the way.
   */
  CSTK_SLIDE_MOVED = 0,
  /**
   * The configuration is inside the C-object; nothing was moved.
   */
  CSTK_SLIDE_INSIDE = 1,
  /**
   * No step leads on: contacts, ranges or the world box are in the way, or q itself is out of them (a joint held by a
   * range of one value must have it to the last bit; see cstk_space_clamp); nothing was moved. Of all steps as long as
   * the floor none that keeps clear, keeps its distance (or the desired one, if that is less), the ranges and the box
   * gains more than 1 % of its length along the step asked for, to first order. With a contact_count of 0 the step is
   * 0, ranges or the world box are in the way, or the shell is so short that even the step of the floor's length
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
 * How to slide. Write it with cstk_slide_options_default first, then set `max_shell`.
 */
typedef struct cstk_slide_options {
  uint32_t size;
  uint32_t cookie;
  /**
   * The stand-off: contacts up to this distance constrain the step. Must be set, larger than 0;
   * two or three times as far as a step moves the robot does well. Parts of the C-object may have shells of their own:
   * see cstk_cobject_with_shell.
   */
  double max_shell;
  /**
   * The distance at which the robot slides; where it is nearer it is pushed out. Negative, the default, stands for a
   * tenth of max_shell. Independent of the C-object's contact epsilon. A part with a shell of its own keeps the same
   * part of that.
   */
  double desired_distance;
  /**
   * Not 0: lengthens the step along the contact to that of the step asked for, at most fourfold; 0, the default,
   * leaves what is left of the step. (The report's normalize?)
   */
  uint32_t normalize;
  /**
   * At most this many witnesses are considered, the nearest first. Default 256.
   */
  uint32_t max_witnesses;
  /**
   * A step is halved until it is accepted, or is shorter than this part of the step asked for. Default 1/1024.
   */
  double floor;
} cstk_slide_options;

/**
 * What a slide did.
 */
typedef struct cstk_slide_result {
  cstk_slide_outcome outcome;
  /**
   * How many contacts within the shells there were at q.
   */
  uint32_t contact_count;
  /**
   * The distance at the configuration given, and at the one reached.
   */
  double distance_before;
  double distance_after;
  uint64_t reserved[8];
} cstk_slide_result;


/**
 * Writes the default options. `size` is sizeof(cstk_slide_options).
 */
cstk_status cstk_slide_options_default(cstk_slide_options *out, size_t size);

/**
 * Takes one step from q that slides along contacts instead of running into them (Appendix A): `step` itself where
 * nothing is within the shell; else the nearest step (by the sum of the velocities' squares, as they are) that brings no
 * contact nearer than the desired distance (or than the nearest is, if that is less) and keeps to the ranges and the
 * world box, pushed out where the robot is within that distance, corrected where it leads, and halved until the whole
 * way is proved free. Along a contact only part of the step is left; see `normalize`.
 *
 * The proof takes each pair of bodies, and each link with a floor or the world box, for itself: by its own distance, and by
 * how far the joints between the two can move them relative to each other, or a link along the normal of a plane between
 * it and an obstacle. Pairs that no joint of the step moves relative to each other may touch. A pair that touches at q and moves is taken on the word of its contacts' gradients for the
 * first 1e-4 of max_shell (or of the smallest link's radius), and must be apart from there on, unless the whole way is
 * shorter than that. Of two bodies with more than 64 primitive pairs only the nearest constrain a step: at most 8, no more
 * than 1 % of the shell farther apart than the first.
 *
 * `slide_options` must not be NULL. `q` and `reached` have `nq` doubles and may be the same; `step`, a velocity for a unit of
 * time, has `nv`. Unless the outcome is CSTK_SLIDE_MOVED, `reached` receives q. A slide may creep, gaining little more
 * than 1 % a step; who wants to stop then looks at what was gained. The C-object is an induced or pure set or a union of
 * such, without predicates: else, and where a custom joint that changes some distance does not state its speeds,
 * CSTK_ERROR_UNSUPPORTED.
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
 * The report's slide-step: of the contacts of a list with gradients (cstk_gradients, or cstk_pseudo_normal without
 * `normalize`), the step nearest to `step` that brings none nearer than `desired_distance`, nor nearer at all where it
 * is within that already; to first order, and without a look at ranges or the way. `normalize` is that of
 * cstk_slide_options. `step` and `out` have `nv` doubles, that of the list, and may be the same. `found` is false, and
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
 * The report's compute-spring-step: the shortest step that takes all contacts of a list out to `desired_distance`, to first
 * order; where they stand against each other, out to the largest distance they can share. `found` is false, and `out` zero,
 * where no contact is nearer or none can be helped. See cstk_slide_step for the list.
 */
cstk_status cstk_spring_step(const cstk_witness_list *list,
                             size_t nv,
                             double desired_distance,
                             double *out,
                             bool *found);

/** @} */

/**
 * @defgroup show Pictures
 *
 * Robots among obstacles as glTF files.
 *
 * @code
     check(cstk_show(cobject, q, nq, "cell.glb"));
 * @endcode
 * @{
 */

/**
 * Writes the scene at q to a .glb file that glTF viewers open (the report's show-c-object): links, s-objects, the nearest
 * pair of points and those within the contact epsilon (red), each contact's normal (green) and the way its point moves
 * along the gradient (blue). Distances and gradients stand in the nodes' extras. The name must end in .glb
 * (CSTK_ERROR_UNSUPPORTED otherwise). The file is written whole or not at all; CSTK_ERROR_IO if that fails.
 */
cstk_status cstk_show(const cstk_cobject *cobject,
                      const double *q,
                      size_t nq,
                      const char *file);

/** @} */

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* CSTK_H */
