//! Whether a direction parts two primitives over an interval of time, or over a box of configurations.

use smallvec::SmallVec;

use super::core::Core;
use super::placed::PlacedPrimitive;
use crate::gjk::Support;
use crate::pose::{Displacement, Vec3};

/// Primitives with more vertices are bounded by support points: each displacement then takes off the most that any vertex gives it.
const MAX_LISTED_VERTICES: usize = 64;

/// Which way displacements go from where primitives and boxes are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extension {
    /// Each displacement times any factor from -1 to 1.
    BothWays,
    /// The one displacement times any factor from 0 to 1.
    OneWay,
}

/// How A's points move, seen from B: by a sum of displacements. For an interval of time there is one, a velocity times a time; for a box of
/// configurations there is one for each coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Sweep<'a> {
    pub displacements: &'a [Displacement],
    pub extension: Extension,
    /// What the acceleration may take off a gap where the displacement ends, along a direction that moves with A, and along one
    /// that rests with B.
    pub bends: [f64; 2],
}

/// Whether the gap through the interval along a unit direction from B to A is surely more than `needed`: along the direction as it rests
/// with B, or as it moves with A. Of A's point a the place along n at the end is n . a + n . (v + w x a), that is (n + n x w) . a + n . v.
/// In between it is linear but for the bend, which grows with the square of the time: the least is at an end of the interval.
pub fn stays_apart_along(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    direction: &Vec3,
    sweep: &Sweep,
    needed: f64,
) -> bool {
    let &[by] = sweep.displacements else {
        return stays_apart_over_box(a, b, direction, sweep, needed);
    };
    let turned = direction.cross(&by.angular);
    let shift = direction.dot(&by.linear);
    let of_b = least_along(b, &-direction);
    let [with_a, with_b] = sweep.bends;
    if sweep.extension == Extension::OneWay {
        let of_a = least_along(a, direction);
        return of_a + of_b > needed
            && (least_along(a, &(direction + turned)) + of_b - with_b + shift > needed
                || of_a + least_along(b, &(turned - direction)) - with_a + shift > needed);
    }
    let [ahead, behind] = [direction + turned, direction - turned];
    let rests_with_b =
        (least_along(a, &ahead) + shift).min(least_along(a, &behind) - shift) + of_b - with_b;
    // Only where that leaves it open are three more support points looked for. B's points b move by -(v + w x b).
    rests_with_b > needed
        || least_along(a, direction)
            + (least_along(b, &-behind) + shift).min(least_along(b, &-ahead) - shift)
            - with_a
            > needed
}

/// The same for any number of twists.
fn stays_apart_over_box(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    direction: &Vec3,
    sweep: &Sweep,
    needed: f64,
) -> bool {
    let [with_a, with_b] = sweep.bends;
    let along = |by: &Displacement| Along {
        turned: direction.cross(&by.angular),
        shift: direction.dot(&by.linear),
    };
    let moves: Moves = sweep.displacements.iter().map(along).collect();
    let rests_with_b = least_moved(a, direction, &moves) + least_along(b, &-direction) - with_b;
    rests_with_b > needed
        || least_along(a, direction) + least_moved(b, &-direction, &moves) - with_a > needed
}

/// How far a displacement moves points along a direction: a point x by `shift + turned . x`.
struct Along {
    turned: Vec3,
    shift: f64,
}

/// Of all displacements.
type Moves = SmallVec<[Along; 16]>;

/// The least place along a direction that any sum of displacements, each either way, gives a point of a primitive. Of a point x it is
/// n . x - sum |shift + turned . x|, which is concave in x: the least over a polytope is at a vertex.
fn least_moved(placed: &PlacedPrimitive, direction: &Vec3, moves: &[Along]) -> f64 {
    let is_listed = placed.shape.smooth().is_none() && placed.vertex_count() <= MAX_LISTED_VERTICES;
    if !is_listed {
        let moved = moves.iter().map(|Along { turned, shift }| {
            let least = shift + least_along(placed, turned);
            let most = shift - least_along(placed, &-turned);
            most.max(-least)
        });
        return least_along(placed, direction) - moved.sum::<f64>();
    }
    let mut least = f64::INFINITY;
    for index in 0..placed.vertex_count() as u32 {
        let vertex = placed.vertex(index);
        let moved = moves
            .iter()
            .map(|by| (by.shift + by.turned.dot(&vertex)).abs());
        least = least.min(direction.dot(&vertex) - moved.sum::<f64>());
    }
    let radius = placed.shape.radius();
    if radius > 0.0 {
        let turns = moves.iter().map(|by| by.turned.norm());
        least -= radius * (direction.norm() + turns.sum::<f64>());
    }
    least
}

/// The least product of a direction, of any length, with the points of a primitive.
fn least_along(placed: &PlacedPrimitive, direction: &Vec3) -> f64 {
    let length = direction.norm();
    if length == 0.0 {
        return 0.0;
    }
    let back = direction / -length;
    let point = Core::of(placed).support(&back);
    -length * (back.dot(&point) + placed.shape.radius())
}
