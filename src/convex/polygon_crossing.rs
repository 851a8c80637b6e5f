//! Whether two polygons cross.

use super::outline::Outline;
use crate::lanes::{Instructions, along64, at64, sub64};
use crate::tolerance;

/// Whether an edge of B passes through A; `None` where the answer is within rounding.
#[inline(always)]
fn pierces<I: Instructions>(
    a: &Outline<I>,
    b: &Outline<I>,
    doubt: f64,
    rounding: f64,
) -> Option<bool> {
    let normal: [f64; 3] = a.normal.into();
    let (mut maybe, mut surely) = (false, false);
    for block in 0..b.blocks.len() {
        let (starts, ends) = (b.block(block), b.following(block));
        let from = along64(&starts, &normal) - a.splat(a.offset);
        let to = along64(&ends, &normal) - a.splat(a.offset);
        let at = from.quotient(from - to).unit();
        let along = sub64(&ends, &starts);
        let point = at64(&starts, &along, at);
        let inside = a.innermost(&point);
        let (low, high) = (from.min(to), from.max(to));
        let (plus, minus) = (a.splat(rounding), a.splat(-rounding));
        let misses = plus.less(low) | high.less(minus) | inside.less(a.splat(doubt));
        maybe |= misses != 0b1111;
        surely |= low.less(minus) & plus.less(high) & a.splat(-doubt).less(inside) != 0;
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
pub fn cross<I: Instructions>(a: &Outline<I>, b: &Outline<I>, size: f64) -> Option<bool> {
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
