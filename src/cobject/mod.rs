//! C-objects: sets in C-space, induced by contact or interference, and their unions (§2.2.4).

mod class;
#[allow(clippy::module_inception)]
mod cobject;

pub use class::Class;
pub use cobject::{CObject, InducedOptions, SObjects, Term};
