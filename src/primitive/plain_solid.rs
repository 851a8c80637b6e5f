//! Solids whose point nearest to another point follows from a few comparisons.

use super::{Form, Primitive, SmoothKind};

/// Whether a primitive is a box, a cylinder or a cone in space, with or without a radius around it.
pub fn is_plain_solid(primitive: Primitive, form: Option<&Form>) -> bool {
    let shape = primitive.shape;
    if shape.curve.as_ref().is_some_and(|curve| curve.planar) {
        return false;
    }
    match shape.smooth() {
        Some(smooth) => matches!(
            smooth.kind,
            SmoothKind::Cylinder { .. } | SmoothKind::Cone { .. }
        ),
        None => form.is_some_and(|form| form.cuboid().is_some()),
    }
}
