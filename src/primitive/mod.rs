//! Primitives: one convex polygon, or the convex hull of points. The leaves of every hierarchy.

mod convex;
mod faces;
mod feature;
mod hull;
mod planar_hull;
mod polygon;
mod polyhedron;

pub use convex::{Convex, Face};
pub use faces::{FaceSplit, split_face};
pub use feature::{Feature, FeatureKind};
pub use hull::{CheckedHull, checked_hull, excess_over, frame_of};
pub use planar_hull::{convex_hull_2d, monotone_chain, plane_axes};
pub use polygon::convex_polygon;
pub use polyhedron::convex_polyhedron;
