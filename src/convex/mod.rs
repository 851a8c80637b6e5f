//! Pairs of convex sets: bounds by GJK, exact distances by closed forms on features, contacts and their modes.

mod closest;
mod contact;
mod contact_normal;
mod distance;
mod placed;

pub use closest::Closest;
pub use contact::{Contact, ContactMode, contacts};
pub use distance::{DistanceScratch, closest_points};
pub use placed::{Placed, PlacedBuffer, Precision};
