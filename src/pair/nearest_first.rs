//! The pairs that wait to be visited, nearest on top.

use crate::hierarchy::Unit;
use crate::lanes::F32x8;

/// A pair of units, with the bound of its distance in units of the pair.
#[derive(Clone, Copy)]
pub struct Entry {
    pub bound: f32,
    pub a: Unit,
    pub b: Unit,
}

/// Puts those of up to eight pairs on the stack whose bound is at most the cutoff, the nearest on top.
#[inline(always)]
pub fn push_nearest_last(
    stack: &mut Vec<Entry>,
    bounds: &F32x8,
    count: usize,
    cutoff: f32,
    pair: impl Fn(usize) -> [Unit; 2],
) {
    let mut kept = 0u32;
    for lane in 0..8 {
        kept |= u32::from(bounds.0[lane] <= cutoff) << lane;
    }
    kept &= (1 << count) - 1;
    let first = stack.len();
    while kept != 0 {
        let lane = kept.trailing_zeros() as usize;
        kept &= kept - 1;
        let bound = bounds.0[lane & 7];
        let [a, b] = pair(lane);
        let mut place = stack.len();
        stack.push(Entry { bound, a, b });
        while place > first && stack[place - 1].bound < bound {
            stack.swap(place - 1, place);
            place -= 1;
        }
    }
}
