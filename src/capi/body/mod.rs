//! Bodies.
//!
//! A body is a rigid union of convex primitives: polygons, polyhedra, predefined shapes, points. A builder collects them,
//! from arrays or mesh files. A body never changes once built, and serves any number of links, obstacles and threads.
//!
//! ```c
//! const double half_extents[3] = {0.2, 0.1, 0.3};
//! check(cstk_body_builder_create(3, &body_builder));
//! check(cstk_body_builder_add_box(body_builder, pose_a, half_extents, 0));
//! check(cstk_body_build(body_builder, NULL, NULL, NULL, &body));
//! check(cstk_body_builder_release(body_builder));
//! ```

pub mod builder;

pub mod surfaces;

pub mod shapes;

pub mod primitive;

#[allow(clippy::module_inception)]
pub mod body;
