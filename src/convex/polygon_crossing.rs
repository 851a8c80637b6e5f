//! Whether two polygons cross.

use super::outline::Outline;
use crate::lanes::{F64x4, along64, each3, sub64};
use crate::tolerance;

/// Whether an edge of B passes through A; `None` where the answer is within rounding.
#[inline(always)]
fn pierces(a: &Outline, b: &Outline, doubt: f64, rounding: f64) -> Option<bool> {
    let normal: [f64; 3] = a.normal.into();
    let (mut maybe, mut surely) = (false, false);
    for block in 0..b.blocks.len() {
        let (starts, ends) = (&b.blocks[block], &b.following(block));
        let from = along64(starts, &normal) - F64x4::splat(a.offset);
        let to = along64(ends, &normal) - F64x4::splat(a.offset);
        let at = from.quotient(from - to).unit();
        let along = sub64(ends, starts);
        let point = each3(|k| starts[k] + along[k] * at);
        let inside = a.innermost(&point);
        for lane in 0..4 {
            let low = from.0[lane].min(to.0[lane]);
            let high = from.0[lane].max(to.0[lane]);
            maybe |= (low <= rounding) & (high >= -rounding) & (inside.0[lane] >= doubt);
            surely |= (low < -rounding) & (high > rounding) & (inside.0[lane] > -doubt);
        }
    }
    if surely {
        Some(true)
    } else if maybe {
        None
    } else {
        Some(false)
    }
}

/// Whether two polygons cross that neither plane separates; `None` where the answer is within rounding.
#[inline(always)]
pub fn cross(a: &Outline, b: &Outline, size: f64) -> Option<bool> {
    let rounding = tolerance::INSIDE_DOUBT * size;
    // The slack is an area, because the error of a short edge's direction is multiplied by the length it is compared with.
    let doubt = -rounding * size;
    match pierces(a, b, doubt, rounding) {
        Some(true) => Some(true),
        first => match (first, pierces(b, a, doubt, rounding)) {
            (_, Some(true)) => Some(true),
            (Some(false), Some(false)) => Some(false),
            _ => None,
        },
    }
}
