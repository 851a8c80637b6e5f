//! Pairs of convex sets: bounds by GJK, exact distances by closed forms on features, contacts and their modes.

mod closest;
mod contact;
mod contact_normal;
mod cuboid_distance;
mod cuboids_within;
mod curved;
mod curved_contact;
mod distance;
mod extreme_vertex;
mod gauss_arcs;
mod nearest_edges;
mod nearest_parts;
mod outline;
mod penetration;
mod placed;
mod point_to_polygon;
mod point_to_smooth;
mod polygon_crossing;
mod polygon_distance;
mod surface_part;
mod swept_gap;

pub use closest::Closest;
pub use contact::{Contact, ContactMode, contacts, first_contact};
pub use distance::{
    DistanceScratch, PrimitiveDistance, closed_distance, measure, meeting_or_beyond, parts,
};
pub use outline::{MAX_CORNERS, Outline, moved};
pub use penetration::{Penetration, penetration};
pub use placed::{PlacedBuffer, PlacedPrimitive, Precision};
pub use polygon_distance::{Nearest, PolygonDistance, polygon_closest, polygon_distance};
pub use swept_gap::{Sweep, swept_gap};
