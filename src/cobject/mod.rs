//! C-objects: sets in C-space, induced by contact or interference, given by coordinates, or combined from others (§2.2.4).

mod bounded_distance;
mod class;
mod clear_cells;
mod clear_pairs;
#[allow(clippy::module_inception)]
mod cobject;
mod compound;
mod exceptions;
mod induced;
mod known;
mod leaf;
mod link_rows;
mod measure;
mod measured;
mod predicate;
mod pure;
mod pure_motion;
mod set;
mod space_state;
mod spans;
mod world_place;

pub use bounded_distance::{BoundedDistance, Measure};
pub use class::Class;
pub use clear_cells::{CellAxis, ClearCells, MAX_CELL_AXES};
pub use clear_pairs::ClearPairs;
pub use cobject::CObject;
pub use exceptions::{AllowedPair, Exceptions, LeftOut};
pub use induced::{BodyPairs, Induced, InducedOptions, LinksAndObjects, SObjects};
pub use known::{Around, ConvexSets, KnownClass};
pub use leaf::Leaf;
pub use link_rows::{LinkRow, LinkRows};
pub use measured::Measured;
pub use predicate::Predicate;
pub use pure::{PureOptions, PureSet, PureShape};
pub use set::Set;
pub use space_state::SpaceState;
pub use world_place::WorldPlace;
