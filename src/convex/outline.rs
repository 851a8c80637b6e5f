//! The outline of a flat polygon, four corners at a time.

use crate::lanes::{F64x4, Points64, along64, cross64, dot64, each3, splat64, sub64};
use crate::pose::{Pose, Vec3};
use crate::primitive::Feature;

/// Polygons of at most this many corners are measured four edges at a time.
pub const MAX_CORNERS: usize = 64;

/// A convex polygon in space: its corners in cyclic order, in blocks of four; the last block is padded with the first corner.
#[derive(Clone, Copy)]
pub struct Outline<'a> {
    pub blocks: &'a [Points64],
    pub corners: usize,
    /// The plane normal . x = offset.
    pub normal: Vec3,
    pub offset: f64,
}

impl Outline<'_> {
    #[inline(always)]
    pub fn corner(&self, i: usize) -> Vec3 {
        let block = &self.blocks[i / 4];
        Vec3::new(block[0].0[i % 4], block[1].0[i % 4], block[2].0[i % 4])
    }

    /// The point of an edge at a parameter, and the corner or edge that holds it. An edge index in the padding stands for
    /// corner 0.
    pub fn on_edge(&self, edge: usize, parameter: f64, error: f64) -> (Vec3, Feature) {
        let edge = if edge < self.corners { edge } else { 0 };
        let next = if edge + 1 == self.corners {
            0
        } else {
            edge + 1
        };
        let (start, end) = (self.corner(edge), self.corner(next));
        let point = start + (end - start) * parameter;
        if parameter <= 0.0 || (point - start).norm() <= error {
            (start, Feature::vertex(edge as u32))
        } else if parameter >= 1.0 || (point - end).norm() <= error {
            (end, Feature::vertex(next as u32))
        } else {
            (point, Feature::edge(edge as u32))
        }
    }

    /// A corner and the edge vector from it to the next, the same in all lanes.
    #[inline(always)]
    pub fn edge(&self, i: usize) -> (Points64, Points64) {
        let next = if i + 1 == self.corners { 0 } else { i + 1 };
        let corner = |i: usize| {
            let block = &self.blocks[i / 4];
            each3(|k| F64x4::splat(block[k].0[i % 4]))
        };
        let start = corner(i);
        (start, sub64(&corner(next), &start))
    }

    /// The next corner of each corner of a block. Edges in the padding have length 0.
    #[inline(always)]
    pub fn following(&self, block: usize) -> Points64 {
        let next = self.blocks.get(block + 1).unwrap_or(&self.blocks[0]);
        let block = &self.blocks[block];
        each3(|k| {
            let [_, b, c, d] = block[k].0;
            F64x4([b, c, d, next[k].0[0]])
        })
    }

    /// The extremes of direction . x over the polygon.
    #[inline(always)]
    pub fn extent_along(&self, direction: &[f64; 3]) -> (f64, f64) {
        let first = along64(&self.blocks[0], direction);
        let (mut low, mut high) = (first, first);
        for block in &self.blocks[1..] {
            let along = along64(block, direction);
            (low, high) = (low.min(along), high.max(along));
        }
        (low.least(), high.greatest())
    }

    /// Where another polygon lies relative to this one's plane. If it crosses the plane, it extends to both sides; the gap is
    /// then minus the smaller of its two extents.
    #[inline(always)]
    pub fn side(&self, other: &Outline) -> Side {
        let (low, high) = other.extent_along(&self.normal.into());
        let (above, below) = (low - self.offset, self.offset - high);
        Side {
            gap: above.max(below),
            extreme: if above > below { low } else { high },
        }
    }

    /// The height of a point over the plane.
    #[inline(always)]
    pub fn height(&self, point: &Vec3) -> f64 {
        self.normal.dot(&(point - self.corner(0)))
    }

    /// The first corner whose projection on a direction equals `extreme`.
    #[inline(always)]
    pub fn corner_with(&self, direction: &[f64; 3], extreme: f64) -> usize {
        for (block, corners) in self.blocks.iter().enumerate() {
            let along = along64(corners, direction);
            for lane in 0..4 {
                if along.0[lane] == extreme {
                    return 4 * block + lane;
                }
            }
        }
        0
    }

    /// The corner nearest to a point.
    #[inline(always)]
    pub fn corner_near(&self, point: &Vec3) -> usize {
        let point = splat64(&[point.x, point.y, point.z]);
        let (mut best, mut least) = (0, f64::INFINITY);
        for (block, corners) in self.blocks.iter().enumerate() {
            let apart = sub64(corners, &point);
            let squares = dot64(&apart, &apart);
            for lane in 0..4 {
                if squares.0[lane] < least {
                    (best, least) = (4 * block + lane, squares.0[lane]);
                }
            }
        }
        best
    }

    /// Whether the foot of a point lies inside the polygon.
    #[inline(always)]
    pub fn is_under(&self, point: &Vec3) -> bool {
        let mut least = F64x4::splat(0.0);
        let normal = splat64(&self.normal.into());
        for (block, starts) in self.blocks.iter().enumerate() {
            let inwards = cross64(&normal, &sub64(&self.following(block), starts));
            let from_start = sub64(&splat64(&[point.x, point.y, point.z]), starts);
            least = least.min(dot64(&from_start, &inwards));
        }
        least.least() >= 0.0
    }

    /// For each point the least signed area that it spans with an edge of the polygon; negative outside.
    #[inline(always)]
    pub fn innermost(&self, points: &Points64) -> F64x4 {
        let mut least = F64x4::splat(f64::INFINITY);
        let normal = splat64(&self.normal.into());
        for (block, starts) in self.blocks.iter().enumerate() {
            let inwards = cross64(&normal, &sub64(&self.following(block), starts));
            for lane in 0..(self.corners - 4 * block).min(4) {
                let start = each3(|k| F64x4::splat(starts[k].0[lane]));
                let inward = each3(|k| F64x4::splat(inwards[k].0[lane]));
                least = least.min(dot64(&sub64(points, &start), &inward));
            }
        }
        least
    }
}

/// Moves the corners of a polygon into the buffer.
#[inline(always)]
pub fn moved<'a>(outline: &Outline, pose: &Pose, buffer: &'a mut [Points64]) -> Outline<'a> {
    let r = &pose.rotation;
    let t = &pose.translation;
    for (to, from) in buffer.iter_mut().zip(outline.blocks) {
        for k in 0..3 {
            let row = [r[(k, 0)], r[(k, 1)], r[(k, 2)]];
            to[k] = along64(from, &row) + F64x4::splat(t[k]);
        }
    }
    let normal = r * outline.normal;
    Outline {
        blocks: &buffer[..outline.blocks.len()],
        corners: outline.corners,
        normal,
        offset: outline.offset + normal.dot(t),
    }
}

/// Where a polygon lies relative to another's plane: its distance from it, and the product of the plane's normal with its
/// corner nearest to the plane.
#[derive(Clone, Copy)]
pub struct Side {
    pub gap: f64,
    pub extreme: f64,
}
