//! Pairs of convex sets: bounds by GJK, exact distances by closed forms on features, contacts and their modes.

mod closest;
mod contact;
mod contact_normal;
mod distance;
mod penetration;
mod placed;
mod polygon_distance;

pub use closest::Closest;
pub use contact::{Contact, ContactMode, contacts};
pub use distance::{DistanceScratch, closest_points};
pub use penetration::{Penetration, penetration};
pub use placed::{Placed, PlacedBuffer, Precision};
pub use polygon_distance::{
    MOST_CORNERS, Nearest, Outline, PolygonDistance, moved, polygon_closest, polygon_distance,
};
