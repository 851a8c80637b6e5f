//! The primitives in leaf order, packed for the first tests of a primitive pair.

use crate::convex::MAX_CORNERS;
use crate::lanes::{F64x4, Points64};
use crate::pose::Vec3;
use crate::primitive::{Convex, Form};

/// A primitive, with the index of its outline if it is a flat polygon of at most `MAX_CORNERS` corners, or of its form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PackedPrimitive {
    pub primitive: u32,
    /// Index of its outline in `data` or of its form in `forms`; `NONE` without either.
    first: u32,
    /// Number of corners of the outline; 0 without one.
    pub corners: u8,
    /// Whether the corners are the primitive's vertices in the same order.
    pub is_plain: bool,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct PackedPrimitives {
    entries: Vec<PackedPrimitive>,
    /// For each outline the plane normal . x = offset, then blocks of four corners as x, y and z lanes: a triangle or a
    /// quadrilateral takes two cache lines.
    data: Vec<F64x4>,
    /// The forms of other primitives that have many vertices or are boxes.
    forms: Vec<Form>,
}

/// The index of an entry without outline or form.
const NONE: u32 = u32::MAX;

/// The plane of a polygon, and its corners in blocks of four; the last block is padded with the first corner.
pub struct PackedOutline<'a> {
    pub normal: Vec3,
    pub offset: f64,
    pub blocks: &'a [Points64],
}

/// The normal and offset of a triangle's plane, and the x, y and z of its corners.
pub type PackedTriangle = [F64x4; 4];

impl PackedPrimitives {
    pub fn push(&mut self, primitive: u32, shape: &Convex) {
        if let Some(triangle) = packed_triangle(shape) {
            self.entries.push(PackedPrimitive {
                primitive,
                first: self.data.len() as u32,
                corners: 3,
                is_plain: true,
            });
            self.data.extend_from_slice(&triangle);
            return;
        }
        let mut entry = PackedPrimitive {
            primitive,
            first: NONE,
            corners: 0,
            is_plain: false,
        };
        if shape.is_flat()
            && let [face] = &shape.faces[..]
            && face.vertices.len() <= MAX_CORNERS
        {
            let ring = &face.vertices;
            let corner = |i: usize| {
                let i = if i < ring.len() { i } else { 0 };
                shape.vertices[ring[i] as usize]
            };
            entry.first = self.data.len() as u32;
            entry.corners = ring.len() as u8;
            let vertices = 0..shape.vertices.len() as u32;
            entry.is_plain = ring.iter().copied().eq(vertices);
            let normal = face.normal;
            let offset = normal.dot(&corner(0));
            self.data
                .push(F64x4([normal.x, normal.y, normal.z, offset]));
            for block in 0..ring.len().div_ceil(4) {
                let four = |axis: usize| std::array::from_fn(|i| corner(4 * block + i)[axis]);
                self.data.extend([0, 1, 2].map(|axis| F64x4(four(axis))));
            }
        } else if let Some(form) = Form::of(shape) {
            entry.first = self.forms.len() as u32;
            self.forms.push(form);
        }
        self.entries.push(entry);
    }

    /// Reserves memory for `more` primitives.
    pub fn reserve(&mut self, more: usize) {
        self.entries.reserve_exact(more);
    }

    /// Reserves memory for as many primitives and outlines as others hold.
    pub fn reserve_as(&mut self, others: &Self) {
        self.entries.reserve_exact(others.entries.len());
        self.data.reserve_exact(others.data.len());
    }

    pub fn len(&self) -> usize {
        self.entries.len()
    }

    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    pub fn entries(&self) -> &[PackedPrimitive] {
        &self.entries
    }

    #[inline(always)]
    pub fn entry(&self, place: usize) -> &PackedPrimitive {
        &self.entries[place]
    }

    /// The outline of an entry that has corners.
    #[inline(always)]
    pub fn outline(&self, entry: &PackedPrimitive) -> PackedOutline<'_> {
        let blocks = usize::from(entry.corners).div_ceil(4);
        let record = &self.data[entry.first as usize..][..1 + 3 * blocks];
        let [x, y, z, offset] = record[0].0;
        PackedOutline {
            normal: Vec3::new(x, y, z),
            offset,
            blocks: record[1..].as_chunks().0,
        }
    }

    /// The plane and the corners of a triangle whose corners are its vertices in order; `None` for other primitives.
    #[inline(always)]
    pub fn triangle(&self, place: usize) -> Option<&PackedTriangle> {
        let entry = &self.entries[place];
        let is_one = entry.corners == 3 && entry.is_plain;
        is_one.then(|| self.data[entry.first as usize..].first_chunk())?
    }

    /// The form that finds support vertices of an entry's core, if it has many vertices or is a box.
    #[inline(always)]
    pub fn form(&self, entry: &PackedPrimitive) -> Option<&Form> {
        match entry.corners {
            0 => self.forms.get(entry.first as usize),
            _ => None,
        }
    }

    pub fn bytes(&self) -> usize {
        let forms: usize = self.forms.iter().map(Form::bytes).sum();
        size_of_val(&self.entries[..]) + size_of_val(&self.data[..]) + forms
    }
}

/// A flat triangle whose face has its vertices in order: most primitives are.
#[inline(always)]
fn packed_triangle(shape: &Convex) -> Option<PackedTriangle> {
    let ([a, b, c], [face]) = (&shape.vertices[..], &shape.faces[..]) else {
        return None;
    };
    if shape.curve.is_some() || *face.vertices != [0, 1, 2] {
        return None;
    }
    let normal = &face.normal;
    // The last block is padded with the first corner.
    let four = |k: usize| F64x4([a[k], b[k], c[k], a[k]]);
    let plane = F64x4([normal.x, normal.y, normal.z, normal.dot(a)]);
    Some([plane, four(0), four(1), four(2)])
}
