//! Pairs of convex sets: bounds by GJK, exact distances by closed forms on features, contacts and their modes. `distance.rs`,
//! `contacts.rs` and `penetration.rs` choose the file that treats a pair, by the form of its primitives.

mod beside_cylinder;
mod beside_plain_solid;
mod beyond;
mod closest;
mod contact;
mod contact_normal;
mod contacts;
mod core;
mod cuboid_axes;
mod cuboid_distance;
mod cuboids_closest;
mod cuboids_within;
mod curved_contacts;
mod distance;
mod every_feature;
mod expanding_polytope;
mod extreme_vertex;
mod facet_lines;
mod facet_normals;
mod feature_pair;
mod flat_contact;
mod gauss_arcs;
mod level_features;
mod likely_parts;
mod local_features;
mod near_ways;
mod nearest_edges;
mod nearest_parts;
mod outline;
mod parallel_cuboids;
mod penetration;
mod placed;
mod point_to_polygon;
mod point_to_smooth;
mod polygon_crossing;
mod polygon_distance;
mod polytope_contacts;
mod polytope_distance;
mod polytope_penetration;
mod segment;
mod smooth_distance;
mod smooth_touch;
mod surface_part;
mod sweep;
mod touching_parts;
mod way;
mod ways_out;

pub use self::core::Core;
pub use beside_plain_solid::BesidePlainSolid;
pub use beyond::Beyond;
pub use closest::Closest;
pub use contact::{Contact, ContactMode, mode_of};
pub use contacts::{contacts, first_contact};
pub use distance::{
    PrimitiveDistance, beyond_radii, closed_distance, measure, meeting_or_beyond,
    middle_of_overlap, parts,
};
pub use every_feature::DistanceScratch;
pub use flat_contact::is_flat_contact;
pub use outline::{MAX_CORNERS, Outline, moved};
pub use penetration::penetration;
pub use placed::{PlacedBuffer, PlacedPrimitive, Precision};
pub use polygon_distance::{NearestFeatures, PolygonDistance, polygon_closest, polygon_distance};
pub use polytope_distance::cuboid;
pub use polytope_penetration::Penetration;
pub use segment::{Segment, closest_parameters};
pub use sweep::{Extension, Sweep, stays_apart_along};
pub use way::HalfSpace;
pub use ways_out::{nearest_half_spaces, parting_half_spaces};
