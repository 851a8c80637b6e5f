//! The core of a primitive: what its radius is added to.

use super::placed::PlacedPrimitive;
use crate::gjk::{Extreme, Support};
use crate::pose::{Mat3, Vec3, turned, turned_back};
use crate::primitive::{Feature, SmoothKind};

/// The support function of a core, for GJK.
pub struct Core<'a> {
    placed: &'a PlacedPrimitive<'a>,
    smooth: Option<SmoothCore<'a>>,
    shift: Vec3,
}

/// A smooth set in the common frame.
pub struct SmoothCore<'a> {
    pub kind: &'a SmoothKind,
    /// The directions of its axes, as columns.
    pub axes: Mat3,
    /// The origin of its own frame.
    pub center: Vec3,
}

impl SmoothCore<'_> {
    /// A point of the common frame, in the set's own.
    #[inline(always)]
    pub fn seen(&self, point: &Vec3) -> Vec3 {
        turned_back(&self.axes, &(point - self.center))
    }

    /// A point of the set's own frame, in the common one.
    #[inline(always)]
    pub fn moved(&self, local: &Vec3) -> Vec3 {
        self.center + turned(&self.axes, local)
    }
}

impl<'a> Core<'a> {
    /// The core moved by `shift`.
    pub fn shifted(placed: &'a PlacedPrimitive<'a>, shift: Vec3) -> Self {
        let smooth = placed.shape.smooth().map(|smooth| SmoothCore {
            kind: &smooth.kind,
            axes: placed.turned_axes(&smooth.axes),
            center: placed.vertex(0) + shift,
        });
        Self {
            placed,
            smooth,
            shift,
        }
    }

    pub fn of(placed: &'a PlacedPrimitive<'a>) -> Self {
        Self::shifted(placed, Vec3::zeros())
    }

    /// The smooth set, if the core is one.
    #[inline(always)]
    pub fn smooth(&self) -> Option<&SmoothCore<'a>> {
        self.smooth.as_ref()
    }

    /// The primitive that the core is of, where it was before it was moved.
    pub fn placed(&self) -> &'a PlacedPrimitive<'a> {
        self.placed
    }

    /// A vertex in the common frame.
    pub fn vertex(&self, index: u32) -> Vec3 {
        self.placed.vertex(index) + self.shift
    }
}

impl Support for Core<'_> {
    #[inline(always)]
    fn extreme(&self, direction: &Vec3) -> Extreme {
        match &self.smooth {
            None => {
                let found = self.placed.extreme(direction);
                Extreme {
                    point: found.point + self.shift,
                    ..found
                }
            }
            Some(smooth) => {
                let found = smooth.kind.extreme(&turned_back(&smooth.axes, direction));
                Extreme {
                    point: smooth.moved(&found.point),
                    ..found
                }
            }
        }
    }
}

/// The feature of a core at a point deep inside it.
pub fn inside(placed: &PlacedPrimitive) -> Feature {
    if placed.shape.smooth().is_some() {
        Feature::surface()
    } else {
        Feature::interior()
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
