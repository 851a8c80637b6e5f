//! Primitives: convex polygons, convex hulls of points, rounded and smooth sets. The leaves of every hierarchy.

mod convex;
mod cuboid;
mod curve;
mod direction_cells;
mod faces;
mod feature;
mod form;
mod hull;
mod incidence;
mod kind;
mod moved_vertices;
mod planar_hull;
mod point_tree;
mod polygon;
mod polyhedron;
mod posed;
mod primitives;
mod ready_made;
mod smooth;
mod support_function;

pub use convex::{Convex, Face};
pub use cuboid::Cuboid;
pub use curve::Curve;
pub use faces::{FaceSplit, split_face};
pub use feature::{Feature, FeatureKind};
pub use form::Form;
pub use hull::{CheckedHull, checked_hull, excess_over, frame_of};
pub use kind::PrimitiveKind;
pub use planar_hull::{convex_hull_2d, monotone_chain, outline, plane_axes};
pub use polygon::convex_polygon;
pub use polyhedron::convex_polyhedron;
pub use posed::PosedPrimitives;
pub use primitives::{Primitive, PrimitiveGroup, Primitives};
pub use ready_made::{block, capsule, cone, cylinder, ellipsoid, rounded, sphere, support_set};
pub use smooth::{HIGH_END, LOW_END, Smooth, SmoothKind};
pub use support_function::{SupportFunction, WatchedSupport};
