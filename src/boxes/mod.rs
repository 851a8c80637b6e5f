//! Boxes: axis-aligned and oriented, in double precision and packed for the kernel, eight to a node.

mod boxes_by_eight;
mod extent;
mod four_spans;
mod oriented_box;
mod packed_box;
mod refit;
mod wide_node;
mod wide_node_bytes;

pub use boxes_by_eight::BoxesByEight;
pub use extent::Extent;
pub use four_spans::FourSpans;
pub use oriented_box::oriented_box;
pub use packed_box::{PackedBox, fitted_axes, simply_fitted_axes};
pub use refit::{AxisSpans, BoxMotion, StoredAxes};
pub(crate) use wide_node::{AXIS_UNITS, MAX_AXIS, MAX_PLACE};
pub use wide_node::{ChildPoints, EightBoxes, SIZE_STEPS, WideNode};
pub use wide_node_bytes::NODE_BYTES;
