//! The winding number of a solid's boundary around a point: the signed count of the faces that a ray from the point crosses.
//!
//! Coordinates are rounded to a lattice of 2^-60 of the boundary's largest coordinate, so products of their differences are
//! integers of less than 128 bits. The side of an edge on which the point lies, seen along the ray, is therefore exact; a point
//! on an edge is treated as moved by (e, e^2) for an infinitesimal e. So each ray crosses only the insides of faces. The
//! surface with rounded vertices is as closed as the given one, and the count is exact for it. It is nowhere farther from the
//! given surface than 2^-59 of the boundary's largest coordinate.
//!
//! A face over the point is above it by at least their distance. Its height is a mean of the corners' heights with exact
//! products as weights, so it is accurate to 4 EPSILON of the largest coordinate: the sign is certain for points farther from
//! the boundary than a pair's error.

use super::box_bounds::ROUNDING;
use super::near_primitives::NearPrimitives;
use crate::body::{Body, Solid};
use crate::boxes::PackedBox;
use crate::hierarchy::packed::power_of_two_above;
use crate::lanes::each3;
use crate::pose::Vec3;

/// Lattice steps from 0 to the largest coordinate.
const STEPS: f64 = (1u64 << 60) as f64;

/// The winding of a solid's boundary around a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Winding {
    /// The winding number, counter-clockwise seen from outside: 0 for a point outside the solid. If the solid has several
    /// boundaries, that of the first one around the point.
    pub number: i32,
    /// The first of the body's pieces that winds around it, in a boundary that is around it.
    pub piece: Option<u32>,
}

/// Scratch memory of rays, reused from one to the next.
#[derive(Default)]
pub struct RayScratch {
    pub(super) near: NearPrimitives,
    /// The winding number of each piece that the ray crosses, in each boundary.
    counts: Vec<Count>,
}

/// The winding number of a piece, as far as it belongs to a boundary.
struct Count {
    piece: u32,
    boundary: u32,
    number: i32,
}

/// The winding of a body's boundary around a point in the body's frame; 0 if the body is not a solid. Correct for points
/// farther from the boundary than a pair's error (see `Precision`).
pub fn winding(body: &Body, point: &Vec3, scratch: &mut RayScratch) -> Winding {
    let Some((solid, ray)) = body
        .solid()
        .and_then(|solid| Some((solid, Ray::out_of(solid, point)?)))
    else {
        return Winding::default();
    };
    // The boxes hold the primitives before these are rounded to the lattice. That moves them by far less than the slack, which
    // is in the tree's unit, as large as any coordinate.
    let ray_box = ray.in_units(body.packed().scale());
    let RayScratch { near, counts } = scratch;
    let primitives = near.find(body.packed(), ray_box, 2.0 * ROUNDING);
    counts.clear();
    let mut count = |piece: u32, boundary: u32, passes: i32| {
        if passes != 0 {
            let is_same = |count: &&mut Count| (count.piece, count.boundary) == (piece, boundary);
            match counts.iter_mut().find(is_same) {
                Some(count) => count.number += passes,
                None => counts.push(Count {
                    piece,
                    boundary,
                    number: passes,
                }),
            }
        }
    };
    for &primitive in primitives {
        let sign = solid.sign(primitive);
        if sign != 0 {
            let ring = body.primitives().get(primitive as usize).vertices;
            let boundary = solid.boundary_of(primitive);
            count(
                body.pieces().of(primitive),
                boundary,
                sign * ray.passes(ring),
            );
        }
    }
    for (i, ring) in solid.scraps().iter().enumerate() {
        let boundary = solid.boundary_of_scrap(i);
        count(body.pieces().of_scrap(i), boundary, ray.passes(ring));
    }
    winding_of(counts)
}

fn winding_of(counts: &[Count]) -> Winding {
    let number_of = |boundary: u32| -> i32 {
        let own = counts.iter().filter(|count| count.boundary == boundary);
        own.map(|count| count.number).sum()
    };
    let is_around = |count: &&Count| count.number != 0 && number_of(count.boundary) != 0;
    let around = || counts.iter().filter(is_around);
    let first = around().map(|count| count.boundary).min();
    Winding {
        number: first.map_or(0, number_of),
        piece: around().map(|count| count.piece).min(),
    }
}

/// A ray along a coordinate axis.
struct Ray {
    from: Vec3,
    axis: usize,
    /// Whether it goes up the axis.
    up: bool,
    /// The length up to where it leaves the boundary's box.
    length: f64,
    /// Steps of the lattice per unit.
    steps: f64,
    /// The point on the lattice.
    start: [i64; 3],
}

impl Ray {
    /// The shortest axis-parallel ray out of a solid's box; `None` for points outside the box.
    fn out_of(solid: &Solid, point: &Vec3) -> Option<Self> {
        let extent = solid.extent();
        if extent.outside(point) > 0.0 {
            return None;
        }
        let (below, above) = (point - extent.low, extent.high - point);
        let (down, up) = (below.imin(), above.imin());
        let is_up = above[up] < below[down];
        let steps = STEPS / power_of_two_above(extent.low.amax().max(extent.high.amax()));
        Some(Self {
            from: *point,
            axis: if is_up { up } else { down },
            up: is_up,
            length: above[up].min(below[down]),
            steps,
            start: each3(|k| (point[k] * steps) as i64),
        })
    }

    /// The ray as a box, in units of a tree.
    fn in_units(&self, unit: f64) -> PackedBox {
        let mut middle = self.from;
        middle[self.axis] += if self.up { 0.5 } else { -0.5 } * self.length;
        let mut half = [0.0; 3];
        half[self.axis] = ((0.5 * self.length / unit) as f32).next_up();
        PackedBox {
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            center: each3(|k| (middle[k] / unit) as f32),
            half,
        }
    }

    /// How often the ray leaves through the face of a ring of vertices, minus how often it enters; the ring runs
    /// counter-clockwise seen from outside.
    fn passes(&self, ring: &[Vec3]) -> i32 {
        let first = self.seen(&ring[0]);
        let mut before = self.seen(&ring[1]);
        let mut count = 0;
        for vertex in &ring[2..] {
            let next = self.seen(vertex);
            count += pass([&first, &before, &next]);
            before = next;
        }
        if self.up { count } else { -count }
    }

    /// A vertex relative to the point, on the lattice: two coordinates across the ray, then the one along it.
    fn seen(&self, vertex: &Vec3) -> [i64; 3] {
        let along = |k: usize| (vertex[k] * self.steps) as i64 - self.start[k];
        let height = along(self.axis);
        [
            along((self.axis + 1) % 3),
            along((self.axis + 2) % 3),
            if self.up { height } else { -height },
        ]
    }
}

/// The signed crossing of the ray with a triangle: 1 if it runs counter-clockwise in the coordinates across the ray, -1 if
/// clockwise, 0 if the ray does not cross it.
fn pass(corners: [&[i64; 3]; 3]) -> i32 {
    let [a, b, c] = corners;
    let sides = [side(b, c), side(c, a), side(a, b)];
    let [(x, _), (y, _), (z, _)] = sides;
    if x != y || y != z || x == 0 {
        return 0;
    }
    let height = |corner: &[i64; 3], (_, weight): (i32, f64)| weight.abs() * corner[2] as f64;
    let above = height(a, sides[0]) + height(b, sides[1]) + height(c, sides[2]);
    if above > 0.0 { x } else { 0 }
}

/// The side of the line from a to b on which the point, moved by (e, e^2), lies: 1 for left, -1 for right. Also twice the
/// signed area of the triangle, with the point unmoved.
fn side(a: &[i64; 3], b: &[i64; 3]) -> (i32, f64) {
    let product = |i: i64, j: i64| i128::from(i) * i128::from(j);
    let area = product(a[0], b[1]) - product(a[1], b[0]);
    let moved = || (a[1] - b[1]).signum() as i32;
    let moved_more = || (b[0] - a[0]).signum() as i32;
    let side = match area.signum() as i32 {
        0 if a[1] != b[1] => moved(),
        0 => moved_more(),
        side => side,
    };
    (side, area as f64)
}
