//! C-objects: sets in C-space, induced by contact or interference, given by coordinates, or combined of others (§2.2.4).

mod class;
#[allow(clippy::module_inception)]
mod cobject;
mod induced;
mod joined;
mod leaf;
mod measure;
mod predicate;
mod pure;
mod pure_motion;
mod reach;
mod spans;
mod stand;
mod world_place;

pub use class::Class;
pub use cobject::{CObject, Set};
pub use induced::{AllowedPair, BodyPairs, Induced, InducedOptions, SObjects};
pub use leaf::Leaf;
pub use predicate::Predicate;
pub use pure::{PureOptions, PureSet, PureShape};
pub use reach::{Measure, Reach};
pub use stand::Stand;
pub use world_place::WorldPlace;
