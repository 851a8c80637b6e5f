//! Numbers, primitives and hierarchies as bytes of a body file.

use crate::hierarchy::{Node, PackedTree, WrapperKind, WrapperTree};
use crate::pose::Vec3;
use crate::primitive::Convex;

/// Marks leaves among the codes of nodes.
pub const LEAF: u32 = 1 << 31;

/// The kinds of wrappers by their numbers in files.
pub const KINDS: [WrapperKind; 5] = [
    WrapperKind::Hull,
    WrapperKind::OrientedBox,
    WrapperKind::AlignedBox,
    WrapperKind::TightSphere,
    WrapperKind::MergedSphere,
];

#[derive(Default)]
pub struct Writer(pub Vec<u8>);

impl Writer {
    pub fn u32(&mut self, value: u32) {
        self.0.extend(value.to_le_bytes());
    }

    pub fn u64(&mut self, value: u64) {
        self.0.extend(value.to_le_bytes());
    }

    pub fn f64(&mut self, value: f64) {
        self.0.extend(value.to_le_bytes());
    }

    pub fn count(&mut self, value: usize) {
        self.u64(value as u64);
    }

    pub fn vector(&mut self, vector: &Vec3) {
        for &x in vector.iter() {
            self.f64(x);
        }
    }

    pub fn primitive(&mut self, primitive: &Convex) {
        self.u32(primitive.vertices.len() as u32);
        self.u32(primitive.edges.len() as u32);
        self.u32(primitive.faces.len() as u32);
        self.f64(primitive.deviation);
        for vertex in &primitive.vertices {
            self.vector(vertex);
        }
        for &i in primitive.edges.as_flattened() {
            self.u32(i);
        }
        for face in &primitive.faces {
            self.vector(&face.normal);
            self.u32(face.vertices.len() as u32);
            for &i in &face.vertices {
                self.u32(i);
            }
        }
    }

    pub fn tree(&mut self, tree: &WrapperTree) {
        let kind = KINDS.iter().position(|&kind| kind == tree.kind());
        self.u32(kind.unwrap_or(0) as u32);
        self.count(tree.subsets().nodes.len());
        self.count(tree.pieces().len());
        for (i, node) in tree.subsets().nodes.iter().enumerate() {
            self.u32(match *node {
                Node::Leaf { primitive } => LEAF | primitive,
                Node::Interior { children } => children[1],
            });
            let wrapper = tree.wrapper(i as u32);
            self.u32(wrapper.corners.len() as u32);
            self.f64(wrapper.excess);
            self.vector(&wrapper.center);
            self.f64(wrapper.radius);
            for corner in wrapper.corners {
                self.vector(corner);
            }
        }
        for &piece in tree.pieces() {
            self.u32(piece);
        }
    }

    pub fn packed(&mut self, packed: &PackedTree) {
        self.count(packed.primitives().len());
        for entry in packed.primitives().entries() {
            self.u32(entry.primitive);
        }
        self.count(packed.nodes().len());
        for node in packed.nodes() {
            self.0.extend(node.to_bytes());
        }
    }
}
