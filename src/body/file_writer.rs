//! Writes numbers, primitives and hierarchies as the bytes of a body file.

use super::part::BodyPart;
use super::solid::Solid;
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::grouping::Groups;
use crate::hierarchy::packed::PackedTree;
use crate::hierarchy::wrapper::{WrapperTree, Wrappers};
use crate::hierarchy::{Node, WrapperKind};
use crate::pose::{Mat3, Vec3};
use crate::primitive::{Convex, PrimitiveGroup, Primitives, Smooth, SmoothKind};
use crate::sealed_file::Writer;

/// The leaf bit in the code of a node.
pub const LEAF: u32 = 1 << 31;

/// The codes of the groups of primitives: one shape, or points of one radius.
pub const SHAPE: u32 = 0;
pub const POINTS: u32 = 1;

/// The codes of what follows of the wrappers: nothing, the wrapper tree, or the groups.
pub const OF_CLOUD: u32 = 0;
pub const OF_TREE: u32 = 1;
pub const OF_GROUPS: u32 = 2;

/// The codes of the kinds of shapes.
pub const PLAIN: u32 = 0;
pub const ROUNDED: u32 = 1;
pub const CYLINDER: u32 = 2;
pub const CONE: u32 = 3;
pub const ELLIPSOID: u32 = 4;

/// The kinds of wrappers, indexed by their codes.
pub const KINDS: [WrapperKind; 5] = [
    WrapperKind::Hull,
    WrapperKind::OrientedBox,
    WrapperKind::AlignedBox,
    WrapperKind::TightSphere,
    WrapperKind::MergedSphere,
];

impl Writer {
    /// Fails for a support function and names the primitive.
    pub fn primitives(&mut self, primitives: &Primitives) -> Result<()> {
        self.count(primitives.len());
        let mut index = 0;
        for group in primitives.groups() {
            match group {
                PrimitiveGroup::Shape(shape, tag) => {
                    self.u32(SHAPE);
                    self.u64(tag);
                    let written = self.primitive(shape);
                    written.map_err(|error| error.within(format_args!("primitive {index}")))?;
                    index += 1;
                }
                PrimitiveGroup::Points(shape, points) => {
                    self.u32(POINTS);
                    self.count(points.len());
                    self.f64(shape.radius());
                    for point in points {
                        self.vector(point);
                    }
                    index += points.len();
                }
            }
        }
        Ok(())
    }

    /// Fails for a support function.
    fn primitive(&mut self, primitive: &Convex) -> Result<()> {
        self.u32(primitive.vertices.len() as u32);
        self.u32(primitive.edges.len() as u32);
        self.u32(primitive.faces.len() as u32);
        self.f64(primitive.deviation);
        self.curve(primitive)?;
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
        Ok(())
    }

    /// Writes the kind of a primitive, and the radius, sizes and axes that the kind has.
    fn curve(&mut self, primitive: &Convex) -> Result<()> {
        let Some(curve) = &primitive.curve else {
            self.u32(PLAIN);
            return Ok(());
        };
        let (kind, sizes, axes) = match &curve.smooth {
            None => (ROUNDED, Vec3::zeros(), Mat3::identity()),
            Some(Smooth { kind, axes }) => match kind {
                SmoothKind::Cylinder {
                    radius,
                    half_length,
                } => (CYLINDER, Vec3::new(*radius, *half_length, 0.0), *axes),
                SmoothKind::Cone { radius, height } => {
                    (CONE, Vec3::new(*radius, *height, 0.0), *axes)
                }
                SmoothKind::Ellipsoid { semi_axes } => (ELLIPSOID, *semi_axes, *axes),
                SmoothKind::Function(_) => {
                    return Err(Error::new(
                        ErrorKind::Unsupported,
                        "it is a support function of the caller's, which no file can hold",
                    ));
                }
            },
        };
        self.u32(kind);
        self.f64(curve.radius);
        if kind != ROUNDED {
            self.vector(&sizes);
            for column in axes.column_iter() {
                self.vector(&column.into_owned());
            }
        }
        Ok(())
    }

    /// Writes the wrapper tree, or what it is built from on demand.
    pub fn wrappers(&mut self, wrappers: &Wrappers, depth: u64) {
        let kind = KINDS.iter().position(|&kind| kind == wrappers.kind());
        self.u32(kind.unwrap_or(0) as u32);
        match wrappers {
            Wrappers::Eager(tree) => {
                self.u32(OF_TREE);
                self.tree(tree);
            }
            Wrappers::OnDemand {
                groups: Some(groups),
                options,
                ..
            } => {
                self.u32(OF_GROUPS);
                self.u32(options.hull_vertex_limit);
                self.groups(groups);
            }
            Wrappers::OnDemand {
                groups: None,
                options,
                ..
            } => {
                self.u32(OF_CLOUD);
                self.u32(options.hull_vertex_limit);
                self.u32(depth as u32);
            }
        }
    }

    fn groups(&mut self, groups: &Groups) {
        self.count(groups.subsets.nodes.len());
        for node in &groups.subsets.nodes {
            self.node(node);
        }
        self.pieces(&groups.pieces);
    }

    fn node(&mut self, node: &Node) {
        self.u32(match *node {
            Node::Leaf { primitive } => LEAF | primitive,
            Node::Interior { children } => children[1],
        });
    }

    fn pieces(&mut self, pieces: &[u32]) {
        self.count(pieces.len());
        for &piece in pieces {
            self.u32(piece);
        }
    }

    fn tree(&mut self, tree: &WrapperTree) {
        self.count(tree.subsets().nodes.len());
        for (i, node) in tree.subsets().nodes.iter().enumerate() {
            self.node(node);
            let wrapper = tree.wrapper(i as u32);
            self.u32(wrapper.corners.len() as u32);
            self.f64(wrapper.excess);
            self.vector(&wrapper.center);
            self.f64(wrapper.radius);
            for corner in wrapper.corners {
                self.vector(corner);
            }
        }
        self.pieces(tree.pieces());
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

    /// Writes the boundaries of the solid, if there is one.
    pub fn solid(&mut self, solid: Option<&Solid>) {
        let Some(Solid { surfaces, .. }) = solid else {
            return self.u32(0);
        };
        self.u32(1);
        let signs = surfaces.signs.iter();
        self.0.extend(signs.flat_map(|sign| sign.to_le_bytes()));
        self.count(surfaces.scraps.len());
        for (scrap, &boundary) in surfaces.scraps.iter().zip(&surfaces.scrap_boundaries) {
            self.u32(scrap.len() as u32);
            for vertex in scrap {
                self.vector(vertex);
            }
            self.u32(boundary);
        }
        self.count(surfaces.runs.len());
        for run in &surfaces.runs {
            self.u32(run.first);
            self.u32(run.boundary);
        }
    }

    /// Writes where the bodies are that the body was put together of.
    pub fn parts(&mut self, parts: &[BodyPart]) {
        self.count(parts.len());
        for part in parts {
            self.u32(part.first);
            self.u32(part.count);
            self.u64(part.tag);
            for number in part.pose.to_row_major() {
                self.f64(number);
            }
        }
    }
}
