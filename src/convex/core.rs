//! The core of a primitive: what its radius is added to.

use super::placed::PlacedPrimitive;
use crate::gjk::{Extreme, Support};
use crate::pose::{Mat3, Vec3, turned, turned_back};
use crate::primitive::Smooth;

/// The support function of a core, for GJK.
pub struct Core<'a> {
    placed: &'a PlacedPrimitive<'a>,
    smooth: Option<(&'a Smooth, Mat3)>,
    shift: Vec3,
}

impl<'a> Core<'a> {
    /// The core moved by `shift`.
    pub fn shifted(placed: &'a PlacedPrimitive<'a>, shift: Vec3) -> Self {
        let smooth = placed.shape.smooth();
        Self {
            placed,
            smooth: smooth.map(|smooth| (smooth, placed.turned_axes(&smooth.axes))),
            shift,
        }
    }

    pub fn of(placed: &'a PlacedPrimitive<'a>) -> Self {
        Self::shifted(placed, Vec3::zeros())
    }

    /// The smooth set, if the core is one, with the directions of its axes in the common frame.
    pub fn smooth(&self) -> Option<(&Smooth, &Mat3)> {
        let (smooth, axes) = self.smooth.as_ref()?;
        Some((smooth, axes))
    }

    /// A vertex in the common frame. Vertex 0 of a smooth core is its origin.
    pub fn vertex(&self, index: u32) -> Vec3 {
        self.placed.vertex(index) + self.shift
    }
}

impl Support for Core<'_> {
    #[inline(always)]
    fn extreme(&self, direction: &Vec3) -> Extreme {
        let found = match &self.smooth {
            None => self.placed.extreme(direction),
            Some((smooth, axes)) => {
                let found = smooth.kind.extreme(&turned_back(axes, direction));
                Extreme {
                    point: self.placed.vertex(0) + turned(axes, &found.point),
                    ..found
                }
            }
        };
        Extreme {
            point: found.point + self.shift,
            ..found
        }
    }
}

/// Whether one of two primitives is more than the hull of its vertices.
pub fn is_curved(a: &PlacedPrimitive, b: &PlacedPrimitive) -> bool {
    a.shape.curve.is_some() || b.shape.curve.is_some()
}

/// Whether one of two cores is smooth: known only by its support function.
pub fn is_smooth(a: &PlacedPrimitive, b: &PlacedPrimitive) -> bool {
    a.shape.smooth().is_some() || b.shape.smooth().is_some()
}
