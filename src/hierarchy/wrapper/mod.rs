//! The construction phase (§3.2.4): bounding volumes for the nodes of the subset tree.

mod bounding_sphere;
mod cover;
#[allow(clippy::module_inception)]
mod wrapper;
mod wrapper_shape;
mod wrapper_tree;
mod wrappers;

pub use cover::outwards;
pub use wrapper::Wrapper;
pub use wrapper_shape::Surface;
pub use wrapper_tree::{Frame, WrapperTree};
pub use wrappers::Wrappers;
