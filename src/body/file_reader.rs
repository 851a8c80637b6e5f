//! Reads numbers, primitives and hierarchies from the bytes of a body file.

use smallvec::SmallVec;

use super::file_writer::{
    CONE, CYLINDER, ELLIPSOID, KINDS, LEAF, OF_CLOUD, OF_GROUPS, OF_TREE, PLAIN, POINTS, ROUNDED,
    SHAPE,
};
use super::part::BodyPart;
use super::solid::{BoundaryRun, Solid, Surfaces};
use crate::boxes::{NODE_BYTES, WideNode};
use crate::error::Result;
use crate::hierarchy::grouping::Groups;
use crate::hierarchy::packed::{PackedTree, is_cloud};
use crate::hierarchy::wrapper::{Frame, WrapperTree, Wrappers};
use crate::hierarchy::{Ball, HierarchyOptions, Node, SubsetTree, WrapperKind};
use crate::pose::{Mat3, Pose, Vec3};
use crate::primitive::{
    Convex, Curve, Face, Primitive, Primitives, SharedList, Smooth, SmoothKind, sphere,
};
use crate::sealed_file::Reader;

/// The most levels of a tree: 2 log2 n for n = 2^31 leaves.
const MAX_DEPTH: u32 = 62;

impl Reader<'_> {
    /// The radius and smooth set of a curved primitive.
    fn curve(&mut self) -> Result<Option<(f64, Option<Smooth>)>> {
        let kind = self.u32()?;
        if kind == PLAIN {
            return Ok(None);
        }
        let radius = self.length()?;
        if kind == ROUNDED {
            return Ok(Some((radius, None)));
        }
        let sizes = Vec3::new(self.length()?, self.length()?, self.length()?);
        let axes = Mat3::from_columns(&[self.vector()?, self.vector()?, self.vector()?]);
        let off = axes.transpose() * axes - Mat3::identity();
        if off.amax() > 1e-9 {
            return Err(self.damaged("the axes of a smooth primitive"));
        }
        let kind = match kind {
            CYLINDER => SmoothKind::Cylinder {
                radius: sizes.x,
                half_length: sizes.y,
            },
            CONE => SmoothKind::Cone {
                radius: sizes.x,
                height: sizes.y,
            },
            ELLIPSOID => SmoothKind::Ellipsoid { semi_axes: sizes },
            _ => return Err(self.damaged("the kind of a primitive")),
        };
        Ok(Some((radius, Some(Smooth { kind, axes }))))
    }

    /// The primitives of a planar or spatial body.
    pub fn primitives(&mut self, planar: bool) -> Result<Primitives> {
        // A point is the smallest primitive.
        let count = self.count(24)?;
        if count == 0 || count >= LEAF as usize {
            return Err(self.damaged("the number of primitives"));
        }
        let mut primitives = Primitives::default();
        while primitives.len() < count {
            match self.u32()? {
                SHAPE => {
                    let tag = self.u64()?;
                    primitives.push(self.primitive(planar)?, tag);
                }
                POINTS => {
                    let points = self.count(24)?;
                    if points == 0 || points > count - primitives.len() {
                        return Err(self.damaged("the number of points"));
                    }
                    let radius = self.length()?;
                    let shape = sphere(&Vec3::zeros(), radius, planar);
                    let shape = shape.map_err(|_| self.damaged("a radius"))?;
                    let points: Vec<Vec3> =
                        (0..points).map(|_| self.vector()).collect::<Result<_>>()?;
                    primitives.push_points(&shape, points.into_iter());
                }
                _ => return Err(self.damaged("the sort of a primitive")),
            }
        }
        Ok(primitives)
    }

    /// A shape of a planar or spatial body.
    fn primitive(&mut self, planar: bool) -> Result<Convex> {
        let (vertices, edges, faces) = (
            self.short_count(24)?,
            self.short_count(8)?,
            self.short_count(28)?,
        );
        let deviation = self.length()?;
        let curve = self.curve()?;
        let is_smooth = matches!(&curve, Some((_, Some(_))));
        if vertices == 0 || edges == 0 || (is_smooth && (vertices, edges, faces) != (1, 1, 0)) {
            return Err(self.damaged("a primitive"));
        }
        let vertices: SmallVec<[Vec3; 3]> = (0..vertices)
            .map(|_| self.vector())
            .collect::<Result<_>>()?;
        let edges: Vec<[u32; 2]> = (0..edges)
            .map(|_| Ok([self.index(vertices.len())?, self.index(vertices.len())?]))
            .collect::<Result<_>>()?;
        let faces: SmallVec<[Face; 1]> = (0..faces)
            .map(|_| {
                let normal = self.vector()?;
                let corners = self.short_count(4)?;
                if corners < 3 || (normal.norm() - 1.0).abs() > 1e-9 {
                    return Err(self.damaged("a face"));
                }
                let corners = (0..corners).map(|_| self.index(vertices.len()));
                Ok(Face {
                    vertices: SharedList::of_corners(corners.collect::<Result<_>>()?),
                    normal,
                })
            })
            .collect::<Result<_>>()?;
        let mut read = Convex {
            vertices,
            edges: SharedList::of_edges(edges),
            faces,
            deviation,
            curve: None,
        };
        if let Some((radius, smooth)) = curve {
            let curve = Curve::new(&read, radius, smooth, planar);
            // False if a face does not fit its edges.
            if !curve.bounds().iter().flatten().all(|x| x.is_finite()) {
                return Err(self.damaged("a curved primitive"));
            }
            read.curve = Some(Box::new(curve));
        }
        Ok(read)
    }

    /// The wrapper tree or what builds it on demand, and the numbers of nodes and levels.
    pub fn wrappers(&mut self, primitives: &Primitives) -> Result<(Wrappers, [u64; 2])> {
        let wrapper = *KINDS
            .get(self.u32()? as usize)
            .ok_or_else(|| self.damaged("the kind of wrappers"))?;
        let shape_of = |subsets: &SubsetTree| [subsets.nodes.len(), subsets.depth()];
        let (wrappers, shape) = match self.u32()? {
            OF_TREE => {
                let tree = self.tree(primitives.len(), wrapper)?;
                let shape = shape_of(tree.subsets());
                (Wrappers::Eager(Box::new(tree)), shape)
            }
            OF_GROUPS => {
                let options = self.options(wrapper)?;
                let groups = self.groups(primitives.len())?;
                let shape = shape_of(&groups.subsets);
                (Wrappers::of_groups(groups, &options), shape)
            }
            OF_CLOUD => {
                let options = self.options(wrapper)?;
                let depth = self.u32()?;
                if !is_cloud(primitives, &options) || depth > MAX_DEPTH {
                    return Err(self.damaged("what is said of the hierarchy"));
                }
                let shape = [2 * primitives.len() - 1, depth as usize];
                (Wrappers::of_cloud(&options), shape)
            }
            _ => return Err(self.damaged("what is said of the wrappers")),
        };
        Ok((wrappers, shape.map(|n| n as u64)))
    }

    fn options(&mut self, wrapper: WrapperKind) -> Result<HierarchyOptions> {
        let options = HierarchyOptions {
            wrapper,
            hull_vertex_limit: self.u32()?,
            ..HierarchyOptions::default()
        };
        let checked = options.check();
        checked.map_err(|_| self.damaged("what is said of the hierarchy"))?;
        Ok(options)
    }

    fn groups(&mut self, primitives: usize) -> Result<Groups> {
        let count = self.count(4)?;
        let nodes = (0..count).map(|i| self.node(i as u32));
        let nodes = nodes.collect::<Result<_>>()?;
        let groups = self.sound(nodes, primitives)?;
        // The time to build wrappers grows with the levels.
        match groups.subsets.depth() <= MAX_DEPTH as usize + 1 {
            true => Ok(groups),
            false => Err(self.damaged("the depth of the tree")),
        }
    }

    fn node(&mut self, index: u32) -> Result<Node> {
        let code = self.u32()?;
        Ok(match code & LEAF {
            0 => Node::Interior {
                children: [index + 1, code],
            },
            _ => Node::Leaf {
                primitive: code & !LEAF,
            },
        })
    }

    /// Reads which nodes hold pieces, and checks that the nodes form a tree.
    fn sound(&mut self, nodes: Vec<Node>, primitives: usize) -> Result<Groups> {
        let count = self.count(4)?;
        let pieces: Vec<u32> = (0..count)
            .map(|_| self.index(nodes.len()))
            .collect::<Result<_>>()?;
        let subsets = SubsetTree { nodes };
        if !subsets.is_sound(primitives) {
            return Err(self.damaged("the tree"));
        }
        // Pieces must not be nested: the hull of a piece has no vertex limit.
        let sizes = subsets.sizes();
        if !pieces.is_sorted_by(|&a, &b| a + sizes[a as usize] <= b) {
            return Err(self.damaged("the pieces"));
        }
        Ok(Groups { subsets, pieces })
    }

    fn tree(&mut self, primitives: usize, kind: WrapperKind) -> Result<WrapperTree> {
        let count = self.count(48)?;
        let mut nodes = Vec::with_capacity(count);
        let mut frames = Vec::with_capacity(count);
        let mut corners = Vec::new();
        for i in 0..count {
            nodes.push(self.node(i as u32)?);
            let corner_count = self.short_count(24)?;
            frames.push(Frame {
                first_corner: corners.len(),
                corner_count,
                excess: self.length()?,
                center: self.vector()?,
                radius: self.length()?,
            });
            if corner_count == 0 {
                return Err(self.damaged("a wrapper"));
            }
            for _ in 0..corner_count {
                corners.push(self.vector()?);
            }
        }
        let Groups { subsets, pieces } = self.sound(nodes, primitives)?;
        Ok(WrapperTree::from_parts(
            subsets, frames, corners, kind, pieces,
        ))
    }

    pub fn packed(&mut self, primitives: &Primitives, ball: Ball) -> Result<PackedTree> {
        let leaves = self.count(4)?;
        let order: Vec<u32> = (0..leaves)
            .map(|_| self.index(primitives.len()))
            .collect::<Result<_>>()?;
        let count = self.count(NODE_BYTES)?;
        let nodes: Vec<WideNode> = (0..count)
            .map(|_| {
                let bytes = self.take()?;
                WideNode::from_bytes(&bytes).ok_or_else(|| self.damaged("a node of boxes"))
            })
            .collect::<Result<_>>()?;
        PackedTree::from_parts(nodes, &order, primitives, ball)
            .ok_or_else(|| self.damaged("the tree of boxes"))
    }

    pub fn solid(&mut self, primitives: &Primitives) -> Result<Option<Solid>> {
        if !self.flag()? {
            return Ok(None);
        }
        let mut sign_of = |primitive: Primitive| {
            let sign = i8::from_le_bytes(self.take()?);
            let is_possible = match sign {
                0 => true,
                -1 | 1 => primitive.shape.faces.len() == 1,
                _ => false,
            };
            is_possible
                .then_some(sign)
                .ok_or_else(|| self.damaged("a sign"))
        };
        let mut surfaces = Surfaces {
            signs: primitives.iter().map(&mut sign_of).collect::<Result<_>>()?,
            ..Surfaces::default()
        };
        let count = self.count(8)?;
        for _ in 0..count {
            let vertices = self.short_count(24)?;
            if vertices < 3 {
                return Err(self.damaged("a face without area"));
            }
            let vertices = (0..vertices).map(|_| self.vector());
            surfaces.scraps.push(vertices.collect::<Result<_>>()?);
            surfaces.scrap_boundaries.push(self.u32()?);
        }
        let count = self.count(8)?;
        for _ in 0..count {
            surfaces.runs.push(BoundaryRun {
                first: self.u32()?,
                boundary: self.u32()?,
            });
        }
        // Numbers are of boundaries that there are.
        let most = count.max(1);
        let runs = surfaces.runs.iter().map(|run| &run.boundary);
        let are_few = runs
            .chain(&surfaces.scrap_boundaries)
            .all(|&boundary| (boundary as usize) < most);
        let are_sorted = surfaces.runs.is_sorted_by(|a, b| a.first < b.first);
        let count = surfaces.count();
        let are_runs = surfaces.scrap_boundaries.iter().all(|&of| of < count);
        if !are_few || !are_sorted || !are_runs {
            return Err(self.damaged("the boundaries"));
        }
        let solid = Solid::new(surfaces, primitives);
        solid.map(Some).ok_or_else(|| self.damaged("a boundary"))
    }

    /// The bodies that a body of this many primitives was put together of.
    pub fn parts(&mut self, primitives: usize, planar: bool) -> Result<Vec<BodyPart>> {
        let count = self.count(112)?;
        let mut end = 0;
        let mut parts = Vec::with_capacity(count);
        for _ in 0..count {
            let (first, count, tag) = (self.u32()?, self.u32()?, self.u64()?);
            let mut numbers = [0.0; 12];
            for number in &mut numbers {
                *number = self.f64()?;
            }
            let pose = Pose::from_row_major(&numbers).map_err(|_| self.damaged("a pose"))?;
            let is_after = u64::from(first) >= end && count > 0;
            end = u64::from(first) + u64::from(count);
            if !is_after || end > primitives as u64 || (planar && !pose.is_planar()) {
                return Err(self.damaged("a part"));
            }
            parts.push(BodyPart {
                first,
                count,
                tag,
                pose,
            });
        }
        Ok(parts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sealed_file::Writer;

    /// A chain of nodes is a valid tree but for its depth, and its wrappers would take far too long to build.
    #[test]
    fn deep_trees_are_refused() {
        let read = |leaves: u32| {
            let mut writer = Writer::default();
            writer.count(2 * leaves as usize - 1);
            for leaf in 0..leaves - 1 {
                writer.u32(2 * leaf + 2);
                writer.u32(LEAF | leaf);
            }
            writer.u32(LEAF | (leaves - 1));
            writer.count(0);
            let mut reader = Reader {
                payload: &writer.0,
                place: 0,
            };
            reader.groups(leaves as usize).map(|g| g.subsets.depth())
        };
        assert_eq!(read(63).unwrap(), 63);
        assert!(read(64).is_err());
    }

    /// Nested pieces would store a hull without vertex limit at every level.
    #[test]
    fn nested_pieces_are_refused() {
        let read = |pieces: &[u32]| {
            let mut writer = Writer::default();
            // Two pairs of leaves.
            let nodes = [4, 3, LEAF, LEAF | 1, 6, LEAF | 2, LEAF | 3];
            writer.count(nodes.len());
            nodes.iter().for_each(|&node| writer.u32(node));
            writer.count(pieces.len());
            pieces.iter().for_each(|&piece| writer.u32(piece));
            let mut reader = Reader {
                payload: &writer.0,
                place: 0,
            };
            reader.groups(4).is_ok()
        };
        assert!(read(&[]) && read(&[1]) && read(&[1, 4]) && read(&[2, 4]));
        assert!(!read(&[1, 2]) && !read(&[0, 1]) && !read(&[4, 1]) && !read(&[4, 4]));
    }

    /// The first edge of the core is parallel to the normal of its face, so that no box can have both as axes.
    #[test]
    fn faces_upright_to_their_edges_are_refused() {
        let read = |normal: [f64; 3]| {
            let mut writer = Writer::default();
            [3u32, 3, 1].iter().for_each(|&count| writer.u32(count));
            writer.f64(0.0);
            writer.u32(ROUNDED);
            writer.f64(1.0);
            let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
            corners
                .iter()
                .for_each(|&corner| writer.vector(&corner.into()));
            [0u32, 1, 1, 2, 2, 0]
                .iter()
                .for_each(|&end| writer.u32(end));
            writer.vector(&normal.into());
            [3u32, 0, 1, 2]
                .iter()
                .for_each(|&number| writer.u32(number));
            let mut reader = Reader {
                payload: &writer.0,
                place: 0,
            };
            reader.primitive(false).is_ok()
        };
        assert!(read([0.0, 0.0, 1.0]));
        assert!(!read([1.0, 0.0, 0.0]));
    }
}
