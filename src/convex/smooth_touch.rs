//! The normal of smooth cores that touch or overlap by a little: the direction from B to A along which their signed gap is largest. Of cores
//! that overlap that gap is their depth, negated.
//!
//! The surfaces around the common point offer directions, and Newton's method ends at the normal. Where it does not, cores that are moved
//! apart lead on: if they are as far apart as D once moved by `shift` along n, then the direction m between their closest points has
//! gap(m) + shift m.n = D >= gap(n) + shift, so that gap(m) is at least gap(n), and larger by shift (1 - m.n). It ends where both are one: no
//! direction around it has a larger gap.

use super::closest::Closest;
use super::core::Core;
use super::placed::{PlacedPrimitive, Precision};
use super::smooth_distance::shifted_cores;
use super::touching_parts::TouchingParts;
use crate::gjk::Names;
use crate::pose::Vec3;
use crate::tolerance;

/// At most 40 steps towards the normal. With fewer, more normals stay off; their gaps are safe all the same.
const MAX_STEPS: usize = 40;

/// How far, in L, touching cores are moved apart in the first step, and in all others. Less brings the steps to the normal sooner, and away
/// from edges that are a little inside: at a sphere of radius R each divides its error by about (R + shift) / shift. More leaves less
/// rounding in the direction.
const SHIFTS: [f64; 2] = [1e-9, 1e-4];

/// The direction of the largest gap.
pub struct Touch {
    /// A unit vector from B to A.
    pub normal: Vec3,
    pub gap: f64,
    /// A point of A and one of B, where the gap is.
    pub points: [Vec3; 2],
    /// The names of the extreme points that these lie between, where they are known.
    pub names: Option<[Names; 2]>,
}

/// The touch of two cores with the given closest points, and a direction that they are apart or touch along, or zero; `None` where they
/// overlap by more than [`tolerance::JUST_INSIDE`] L. Even if the steps do not converge, the gap is that of the returned direction.
pub fn smooth_touch(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    closest: &Closest,
    direction: Vec3,
    precision: &Precision,
) -> Option<Touch> {
    let cores = [Core::of(r), Core::of(s)];
    let parts = TouchingParts::new([&cores[0], &cores[1]], closest.points, precision.size);
    let least = -tolerance::JUST_INSIDE * precision.size;
    let is_known = direction != Vec3::zeros();
    let along_known = is_known.then(|| parts.touch_along(&direction)).flatten();
    let (guess, found) = match along_known {
        Some(_) => (direction, along_known),
        None => parts.touch(direction),
    };
    if let Some(near) = found
        && near.lower >= least
    {
        return Some(Touch {
            normal: near.direction,
            gap: near.lower,
            points: near.points,
            names: Some(near.names),
        });
    }
    let found = moved_apart([r, s], &parts, guess, precision);
    (found.gap >= least).then_some(found)
}

/// The touch that steps from a guess lead to.
#[inline(never)]
fn moved_apart(
    [r, s]: [&PlacedPrimitive; 2],
    parts: &TouchingParts,
    guess: Vec3,
    precision: &Precision,
) -> Touch {
    let mut best = Touch {
        normal: guess,
        gap: parts.gap_along(&guess),
        points: parts.points,
        names: None,
    };
    for step in 0..MAX_STEPS {
        let least = SHIFTS[step.min(1)] * precision.size;
        // The cores are apart after it.
        let shift = least.max(-2.0 * best.gap);
        let by = best.normal * shift;
        let found = shifted_cores(r, s, by, by, precision);
        if found.direction == Vec3::zeros() {
            break;
        }
        let turned = (found.direction - best.normal).norm();
        let normal = found.direction.normalize();
        let gap = parts.gap_along(&normal);
        // Less only by what the direction is off.
        if gap < best.gap - tolerance::SUPPORT_ERROR * precision.size {
            if step == 0 {
                continue;
            }
            break;
        }
        best = Touch {
            normal,
            gap,
            points: [found.points[0] - by, found.points[1]],
            names: found.names,
        };
        if step > 0 && turned <= tolerance::NORMAL_STEP {
            break;
        }
    }
    best
}
