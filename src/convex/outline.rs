//! The outline of a flat polygon, four corners at a time.

use crate::lanes::{
    DoubleTriple, Doubles, Instructions, Plain, Points64, along64, cross64, dot64, each3, sub64,
};
use crate::pose::{Pose, Vec3};
use crate::primitive::Feature;

/// Polygons of at most this many corners are measured four edges at a time.
pub const MAX_CORNERS: usize = 64;

/// A convex polygon in space: its corners in cyclic order, in blocks of four; the last block is padded with the first corner.
#[derive(Clone, Copy)]
pub struct Outline<'a, I> {
    /// What it is computed with.
    pub lanes: I,
    pub blocks: &'a [Points64],
    pub corners: usize,
    /// The plane normal . x = offset.
    pub normal: Vec3,
    pub offset: f64,
}

impl<I: Instructions> Outline<'_, I> {
    #[inline(always)]
    pub fn corner(&self, i: usize) -> Vec3 {
        let block = &self.blocks[i / 4];
        Vec3::new(block[0].0[i % 4], block[1].0[i % 4], block[2].0[i % 4])
    }

    /// The same for code that is not compiled for these instructions.
    #[inline(always)]
    pub fn plain(&self) -> Outline<'_, Plain> {
        Outline {
            lanes: Plain,
            blocks: self.blocks,
            corners: self.corners,
            normal: self.normal,
            offset: self.offset,
        }
    }

    /// Four corners.
    #[inline(always)]
    pub fn block(&self, block: usize) -> DoubleTriple<I> {
        Doubles::points(self.lanes, &self.blocks[block])
    }

    #[inline(always)]
    pub fn splat(&self, value: f64) -> Doubles<I> {
        Doubles::splat(self.lanes, value)
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
    pub fn edge(&self, i: usize) -> (DoubleTriple<I>, DoubleTriple<I>) {
        let next = if i + 1 == self.corners { 0 } else { i + 1 };
        let start = Doubles::point(self.lanes, &self.corner(i).into());
        let end = Doubles::point(self.lanes, &self.corner(next).into());
        (start, sub64(&end, &start))
    }

    /// The next corner of each corner of a block.
    #[inline(always)]
    pub fn following(&self, block: usize) -> DoubleTriple<I> {
        let next = if block + 1 < self.blocks.len() {
            block + 1
        } else {
            0
        };
        let (corners, next) = (self.block(block), self.block(next));
        [
            corners[0].following(next[0]),
            corners[1].following(next[1]),
            corners[2].following(next[2]),
        ]
    }

    /// The corners of a block, and the edge vector from each to the next. Edges in the padding have length 0.
    #[inline(always)]
    pub fn edges(&self, block: usize) -> (DoubleTriple<I>, DoubleTriple<I>) {
        let starts = self.block(block);
        (starts, sub64(&self.following(block), &starts))
    }

    /// The extremes of direction . x over the polygon.
    #[inline(always)]
    pub fn extent_along(&self, direction: &[f64; 3]) -> (f64, f64) {
        let first = along64(&self.block(0), direction);
        let (mut low, mut high) = (first, first);
        for block in 1..self.blocks.len() {
            let along = along64(&self.block(block), direction);
            (low, high) = (low.min(along), high.max(along));
        }
        (low.least(), high.greatest())
    }

    /// Where another polygon lies relative to this one's plane. If it crosses the plane, it extends to both sides; the gap is
    /// then minus the smaller of its two extents.
    #[inline(always)]
    pub fn side(&self, other: &Outline<I>) -> Side {
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
        let extreme = self.splat(extreme);
        for block in 0..self.blocks.len() {
            let lanes = along64(&self.block(block), direction).equal(extreme);
            if lanes != 0 {
                return 4 * block + lanes.trailing_zeros() as usize;
            }
        }
        0
    }

    /// The corner nearest to a point.
    #[inline(always)]
    pub fn corner_near(&self, point: &Vec3) -> usize {
        let point = Doubles::point(self.lanes, &(*point).into());
        let (mut best, mut least) = (0, f64::INFINITY);
        for block in 0..self.blocks.len() {
            let apart = sub64(&self.block(block), &point);
            let squares = dot64(&apart, &apart);
            let own = squares.least();
            if own < least {
                let lanes = squares.equal(self.splat(own));
                (best, least) = (4 * block + lanes.trailing_zeros() as usize, own);
            }
        }
        best
    }

    /// Whether the foot of a point lies inside the polygon. Nothing lies inside of one whose corners are rounded onto a line or a point.
    #[inline(always)]
    pub fn is_under(&self, point: &Vec3) -> bool {
        let mut least = self.splat(0.0);
        let mut most = self.splat(0.0);
        let normal = Doubles::point(self.lanes, &self.normal.into());
        let point = Doubles::point(self.lanes, &(*point).into());
        for block in 0..self.blocks.len() {
            let (starts, along) = self.edges(block);
            let inwards = cross64(&normal, &along);
            let areas = dot64(&sub64(&point, &starts), &inwards);
            (least, most) = (least.min(areas), most.max(areas));
        }
        least.least() >= 0.0 && most.greatest() > 0.0
    }

    /// For each point the least signed area that it spans with an edge of the polygon; negative outside.
    #[inline(always)]
    pub fn innermost(&self, points: &DoubleTriple<I>) -> Doubles<I> {
        let mut least = self.splat(f64::INFINITY);
        let normal = Doubles::point(self.lanes, &self.normal.into());
        for (block, starts) in self.blocks.iter().enumerate() {
            let (_, along) = self.edges(block);
            let [x, y, z] = cross64(&normal, &along);
            let inwards = [x.array(), y.array(), z.array()];
            for lane in 0..(self.corners - 4 * block).min(4) {
                let corner = |from: &Points64| each3(|k| from[k].0[lane]);
                let start = Doubles::point(self.lanes, &corner(starts));
                let inward = Doubles::point(self.lanes, &corner(&inwards));
                least = least.min(dot64(&sub64(points, &start), &inward));
            }
        }
        least
    }
}

/// Moves the corners of a polygon into the buffer.
#[inline(always)]
pub fn moved<'a, I: Instructions>(
    outline: &Outline<I>,
    pose: &Pose,
    buffer: &'a mut [Points64],
) -> Outline<'a, I> {
    let r = &pose.rotation;
    let t = &pose.translation;
    for (block, to) in buffer[..outline.blocks.len()].iter_mut().enumerate() {
        let from = outline.block(block);
        for k in 0..3 {
            let row = [r[(k, 0)], r[(k, 1)], r[(k, 2)]];
            to[k] = (along64(&from, &row) + outline.splat(t[k])).array();
        }
    }
    let normal = r * outline.normal;
    Outline {
        lanes: outline.lanes,
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
