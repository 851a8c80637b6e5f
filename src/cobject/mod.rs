//! C-objects: sets in C-space, induced by contact or interference, given by coordinates, or combined of others (§2.2.4).

mod class;
#[allow(clippy::module_inception)]
mod cobject;
mod induced;
mod leaf;
mod measure;
mod predicate;
mod pure;

pub use class::Class;
pub use cobject::{CObject, Set};
pub use induced::{AllowedPair, BodyPairs, Induced, InducedOptions, SObjects};
pub use leaf::Leaf;
pub use measure::{Measure, Reach, Stand, WorldPlace};
pub use predicate::Predicate;
pub use pure::{PureOptions, PureSet, PureShape};
