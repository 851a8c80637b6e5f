//! Bodies without an inside, whose depths are not defined.

use crate::body::Body;
use crate::error::{Error, ErrorKind, Result};

/// Refuses two bodies of which neither has an inside everywhere: the depth of surfaces in each other is not defined. The
/// message names a primitive of each.
pub fn require_inside(a: &Body, b: &Body) -> Result<()> {
    let (Some(flat_a), Some(flat_b)) = (without_inside(a), without_inside(b)) else {
        return Ok(());
    };
    Err(Error::new(
        ErrorKind::Unsupported,
        format!(
            "neither body has an inside everywhere: primitive {flat_a} of body_a and primitive {flat_b} of body_b are no solids \
             and bound none, so that no depth is defined"
        ),
    ))
}

/// Refuses bodies that may differ from what they stand for: a way out of theirs need not be one of what they stand for.
pub fn require_exact(a: &Body, b: &Body) -> Result<()> {
    let sides = [("body_a", a), ("body_b", b)];
    let Some((name, body)) = sides.iter().find(|(_, body)| body.stated_deviation() > 0.0) else {
        return Ok(());
    };
    Err(Error::new(
        ErrorKind::Unsupported,
        format!(
            "{name} stands for a set within {:e} of it, of which no depth is known",
            body.stated_deviation()
        ),
    ))
}

/// The first primitive without an inside that bounds no solid.
pub fn without_inside(body: &Body) -> Option<usize> {
    let is_planar = body.dimension() == 2;
    let mut shapes = body.primitives().iter().enumerate();
    let found = shapes.find(|(i, primitive)| {
        let shape = primitive.shape;
        let is_thick =
            shape.curve.is_some() || shape.is_solid() || (is_planar && !shape.faces.is_empty());
        let is_boundary = || body.solid().is_some_and(|solid| solid.sign(*i as u32) != 0);
        !is_thick && !is_boundary()
    });
    found.map(|(i, _)| i)
}
