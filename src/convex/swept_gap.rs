//! The gap of two primitives along a direction over an interval of time.

use super::core::Core;
use super::placed::PlacedPrimitive;
use crate::gjk::Support;
use crate::pose::Vec3;

/// The velocity of A's points x, seen from B, at the middle of the interval, times half its length: linear + angular x x.
#[derive(Clone, Copy, Debug)]
pub struct Sweep {
    pub linear: Vec3,
    pub angular: Vec3,
    /// What the acceleration may take off a gap along a direction that moves with A, and along one that rests with B.
    pub bends: [f64; 2],
}

/// A lower bound of the gap through the interval along a unit direction from B to A: the better of those along the direction
/// as it moves with A, and as it rests with B. Of A's point a the place along n at the end is n . a + n . (v + w x a), that is
/// (n + n x w) . a + n . v, and linear in between but for the bend.
pub fn swept_gap(a: &PlacedPrimitive, b: &PlacedPrimitive, direction: &Vec3, sweep: &Sweep) -> f64 {
    let turned = direction.cross(&sweep.angular);
    let shift = direction.dot(&sweep.linear);
    let [ahead, behind] = [direction + turned, direction - turned];
    let rests_with_b = (least_along(a, &ahead) + shift).min(least_along(a, &behind) - shift)
        + least_along(b, &-direction)
        - sweep.bends[1];
    // B's points b move by -(v + w x b).
    let moves_with_a = least_along(a, direction)
        + (least_along(b, &-behind) + shift).min(least_along(b, &-ahead) - shift)
        - sweep.bends[0];
    rests_with_b.max(moves_with_a)
}

/// The least product of a direction, of any length, with the points of a primitive.
fn least_along(placed: &PlacedPrimitive, direction: &Vec3) -> f64 {
    let length = direction.norm();
    if length == 0.0 {
        return 0.0;
    }
    let back = direction / -length;
    let point = if placed.shape.smooth().is_some() {
        Core::of(placed).support(&back)
    } else {
        placed.support(&back)
    };
    -length * (back.dot(&point) + placed.shape.radius())
}
