//! The oriented box of a body in the world.

use crate::boxes::Extent;
use crate::pose::Vec3;

/// The oriented box of a body: the points center + sum c_i axis_i with |c_i| <= half_i. The third axis is the cross product
/// of the first two, which are orthonormal to within 2^-12 (see [`PackedBox`]).
///
/// [`PackedBox`]: crate::boxes::PackedBox
#[derive(Clone, Copy, Debug)]
pub struct OrientedBox {
    /// The centre, in the world.
    pub center: Vec3,
    /// The first two axes.
    pub axes: [Vec3; 2],
    /// Half the side along each axis.
    pub half: Vec3,
}

impl From<&Extent> for OrientedBox {
    fn from(extent: &Extent) -> Self {
        Self {
            center: extent.center(),
            axes: [Vec3::x(), Vec3::y()],
            half: extent.size() * 0.5,
        }
    }
}
