//! The C-Space Toolkit. At a robot configuration q: is q free, in contact or inside; how far is contact, and between which
//! features; which way is out, in joint space; which step slides along the contact.
//!
//! Data flow in one direction, in the order of the modules below; each imports only from those above it.
//!
//! "(§ 2.3)" names a section of the report: Xavier and LaFarge, A Configuration Space Toolkit for Automated Spatial Reasoning,
//! Sandia National Laboratories SAND97-0366, 1997.
//!
//! The modules that these docs show are the Rust API: what the C API offers, without its handles. All others are internal, visible
//! to tests and benchmarks alone, and may change with any version. docs/architecture.md explains how they work together.

// The lengths and angles below which the library does not distinguish, and what is rounded by how much, each with its reason.
pub mod tolerance;

// Lengths and products that are 0 only where all they are made of is.
mod nonzero;

// What can go wrong: a kind and a message that names the culprit.
pub mod error;

// Panics of the library's own code become errors, and are not printed.
mod contained;

// Objects that serve one call at a time.
mod exclusive;

// Addresses of the caller's that answers hand back.
#[doc(hidden)]
pub mod user_data;

// Counts what queries look at, and ends those that look at too much.
#[doc(hidden)]
pub mod work_meter;

// A vector in chunks that states of an environment share.
mod cow_vec;

// Which of many indices changed.
#[doc(hidden)]
pub mod index_set;

// SIMD: eight `f32` or four `f64` at a time, chosen for the processor at run time.
#[doc(hidden)]
pub mod lanes;

// Buffers of borrowed items, used again by the next query.
mod reused;

// Memory of a size that a caller's input decides.
mod room;

// Files written whole or not at all, and read within limits.
mod whole_file;

// The elements of URDF, SRDF and COLLADA files.
mod xml;

// Sines and cosines, four angles at a time.
mod turn;

// Rigid poses, checked and composed.
pub mod pose;

// Where one body is, seen from another, in twice the digits.
mod relative_pose;

// The report's yaw, pitch, roll and their rates.
pub mod euler;

// Binary files with a header and checksums: their numbers, written and read one by one.
mod sealed_file;

// Conversions to parry's vectors, for convex hulls.
mod parry_adapter;

// GJK: bounds of a distance from below and above, whether two sets meet, simplices.
#[doc(hidden)]
pub mod gjk;

// Convex primitives: hulls of vertices with their features, radii, smooth sets by support function.
pub mod primitive;

// Two primitives in one frame: distance, closest features, contacts, penetration.
#[doc(hidden)]
pub mod convex;

// Axis-aligned and oriented boxes, packed in 16-bit numbers, eight side by side.
#[doc(hidden)]
pub mod boxes;

// Bounding volume hierarchies: grouping, wrappers, and the packed tree that queries walk.
pub mod hierarchy;

// Immutable bodies: built, read from meshes, saved and loaded; solids.
pub mod body;

// Two bodies at two poses: the traversal of two packed trees, box bounds, contained pieces.
#[doc(hidden)]
pub mod pair;

// The depth of two bodies that meet: bounds of the least translation that parts them.
#[doc(hidden)]
pub mod depth;

// Bounds of bodies at poses: what decides which pairs are looked at.
#[doc(hidden)]
pub mod body_bounds;

// Links and joints, forward kinematics, Jacobians, motion bounds.
pub mod robot;

// Robots from URDF files.
pub mod urdf;

// SRDF files: disabled pairs of links, joint groups, named states, end effectors.
pub mod srdf;

// The C-space of robots: topology, ranges, steps, samples, the world box.
pub mod space;

// S-objects, changed while others query; the dynamic tree over them.
pub mod environment;

// Octrees of occupied cells: from OctoMap's files, changed cell by cell while in an environment.
pub mod octree;

// MoveIt's planning scenes as objects of an environment.
pub mod planning_scene;

// C-objects: induced sets, pure sets, unions, intersections, complements.
pub mod cobject;

// The queries at a configuration and of pairs of bodies, one file each.
pub mod query;

// Motions, paths and boxes of C-space proved free, clearances, shorter paths, and slides.
pub mod motion;

// Certificates of free motions: made, checked by a routine of their own, saved and loaded.
pub mod certificate;

// Many questions in one call, on several threads, in one state of the world.
pub mod batch;

// Maps of C-space: what is free on a grid over some coordinates, saved for NumPy and as pictures.
pub mod map;

// Pictures as glTF files.
pub mod show;

// The C API: converts, checks, calls; one folder or file a section of the header.
#[doc(hidden)]
#[cfg(not(test))]
pub mod capi;
