//! The primitives in the order of the leaves, as the kernel's first tests read them.

use crate::lanes::{F64x4, Points64};
use crate::pose::Vec3;
use crate::primitive::Convex;

/// Polygons of up to so many corners are measured four edges at a time (see `convex::polygon_distance`).
pub const MOST_CORNERS: usize = 64;

/// A primitive, and its outline if it is a flat polygon of few corners.
#[derive(Clone, Copy, Debug)]
pub struct PackedPrimitive {
    /// The plane normal . x = offset of the outline.
    pub normal: Vec3,
    pub offset: f64,
    pub primitive: u32,
    first_block: u32,
    /// 0 for what is no such polygon.
    pub corners: u32,
    /// The corners are the primitive's vertices, in the same order.
    pub is_plain: bool,
}

#[derive(Clone, Debug, Default)]
pub struct PackedPrimitives {
    entries: Vec<PackedPrimitive>,
    blocks: Vec<Points64>,
}

impl PackedPrimitives {
    pub fn push(&mut self, primitive: u32, shape: &Convex) {
        let first_block = self.blocks.len() as u32;
        let mut entry = PackedPrimitive {
            normal: Vec3::zeros(),
            offset: 0.0,
            primitive,
            first_block,
            corners: 0,
            is_plain: false,
        };
        if let [face] = &shape.faces[..]
            && face.vertices.len() <= MOST_CORNERS
        {
            let corner = |i: usize| {
                let ring = &face.vertices;
                shape.vertices[ring[if i < ring.len() { i } else { 0 }] as usize]
            };
            entry.normal = face.normal;
            entry.offset = face.normal.dot(&corner(0));
            entry.corners = face.vertices.len() as u32;
            let vertices = 0..shape.vertices.len() as u32;
            entry.is_plain = face.vertices.iter().copied().eq(vertices);
            for block in 0..face.vertices.len().div_ceil(4) {
                self.blocks.push(
                    [0, 1, 2]
                        .map(|axis| F64x4(std::array::from_fn(|i| corner(4 * block + i)[axis]))),
                );
            }
        }
        self.entries.push(entry);
    }

    pub fn len(&self) -> usize {
        self.entries.len()
    }

    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    #[inline(always)]
    pub fn entry(&self, place: usize) -> &PackedPrimitive {
        &self.entries[place]
    }

    /// The corners of a polygon, four at a time; the last four are filled up with the first corner.
    #[inline(always)]
    pub fn outline(&self, entry: &PackedPrimitive) -> &[Points64] {
        let blocks = entry.corners.div_ceil(4) as usize;
        &self.blocks[entry.first_block as usize..][..blocks]
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.entries[..]) + size_of_val(&self.blocks[..])
    }
}
