//! Bodies in files: the primitives and the whole hierarchy, so that loading builds nothing. docs/body-file.md describes
//! the format.

use std::fs;
use std::path::Path;

use super::{Body, BodyStatistics};
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::{
    BuildTimes, Frame, NODE_BYTES, Node, PackedTree, SubsetTree, WideNode, WrapperKind, WrapperTree,
};
use crate::pose::{Vec3, check_dimension};
use crate::primitive::{Convex, Face};
use crate::tolerance;
use crate::whole_file::write_whole;

const MAGIC: [u8; 8] = *b"cstkbody";
const VERSION: u32 = 2;
const HEADER_BYTES: usize = 32;
const LEAF: u32 = 1 << 31;

/// The kinds of wrappers by their numbers in files.
const KINDS: [WrapperKind; 5] = [
    WrapperKind::Hull,
    WrapperKind::OrientedBox,
    WrapperKind::AlignedBox,
    WrapperKind::TightSphere,
    WrapperKind::MergedSphere,
];

impl Body {
    /// Writes the body to a file. A file of that name is replaced when all is written, or left as it is.
    pub fn save(&self, path: &Path) -> Result<()> {
        write_whole(path, &self.to_bytes())
    }

    /// Reads a body from a file that [`Body::save`] wrote. It answers as the saved one does, bit for bit.
    pub fn load(path: &Path) -> Result<Self> {
        let named = |error: Error| error.within(path.display());
        let bytes = fs::read(path)
            .map_err(|error| Error::new(ErrorKind::Io, format!("{}: {error}", path.display())))?;
        Self::from_bytes(&bytes).map_err(named)
    }

    fn to_bytes(&self) -> Vec<u8> {
        let mut payload = Writer::default();
        payload.u32(self.dimension);
        payload.vector(&self.center);
        payload.u64(self.statistics.faces_split);
        payload.u64(self.statistics.faces_dropped);
        payload.vector(&self.statistics.low.into());
        payload.vector(&self.statistics.high.into());
        let times = &self.statistics.times;
        for seconds in [times.preparation, times.grouping, times.construction] {
            payload.f64(seconds);
        }
        payload.count(self.primitives.len());
        for (primitive, &tag) in self.primitives.iter().zip(&self.tags) {
            payload.u64(tag);
            payload.primitive(primitive);
        }
        payload.tree(&self.tree);
        payload.packed(&self.packed);
        let mut bytes = Writer::default();
        bytes.0.extend(MAGIC);
        bytes.u32(VERSION);
        bytes.u32(HEADER_BYTES as u32);
        bytes.count(payload.0.len());
        bytes.u32(crc32fast::hash(&payload.0));
        bytes.u32(crc32fast::hash(&bytes.0));
        bytes.0.append(&mut payload.0);
        bytes.0
    }

    fn from_bytes(bytes: &[u8]) -> Result<Self> {
        let payload = checked_payload(bytes)?;
        let mut reader = Reader {
            payload,
            place: HEADER_BYTES,
        };
        let dimension = reader.u32()?;
        check_dimension(dimension).map_err(|_| reader.damaged("the dimension"))?;
        let center = reader.vector()?;
        let mut statistics = BodyStatistics {
            faces_split: reader.u64()?,
            faces_dropped: reader.u64()?,
            low: reader.vector()?.into(),
            high: reader.vector()?.into(),
            times: BuildTimes {
                preparation: reader.f64()?,
                grouping: reader.f64()?,
                construction: reader.f64()?,
            },
            ..BodyStatistics::default()
        };
        let count = reader.count(28)?;
        if count == 0 || count >= LEAF as usize {
            return Err(reader.damaged("the number of primitives"));
        }
        let mut tags = Vec::with_capacity(count);
        let mut primitives = Vec::with_capacity(count);
        for _ in 0..count {
            tags.push(reader.u64()?);
            primitives.push(reader.primitive()?);
        }
        let tree = reader.tree(count)?;
        let packed = reader.packed(&primitives, &tree)?;
        if !reader.payload.is_empty() {
            return Err(reader.damaged("the end: more follows"));
        }
        statistics.primitives = count as u64;
        statistics.nodes = tree.subsets().nodes.len() as u64;
        statistics.depth = tree.subsets().depth() as u64;
        Ok(Self::assemble(
            dimension, center, primitives, tags, tree, packed, statistics,
        ))
    }
}

/// The part after the header, if the file is whole, unaltered and of a known version.
fn checked_payload(bytes: &[u8]) -> Result<&[u8]> {
    let fail = |message: String| Err(Error::new(ErrorKind::Parse, message));
    let Some((header, payload)) = bytes.split_at_checked(HEADER_BYTES) else {
        return fail(if MAGIC.starts_with(&bytes[..bytes.len().min(8)]) {
            format!("the file is truncated: {} bytes", bytes.len())
        } else {
            "the file is no body file of libcstk".into()
        });
    };
    if header[..8] != MAGIC {
        return fail("the file is no body file of libcstk".into());
    }
    let mut fields = Reader {
        payload: &header[8..],
        place: 8,
    };
    let (version, header_bytes) = (fields.u32()?, fields.u32()?);
    let (length, sum, header_sum) = (fields.u64()?, fields.u32()?, fields.u32()?);
    // Before its sum: a newer version may have another header.
    if version != VERSION {
        return Err(Error::new(
            ErrorKind::Unsupported,
            format!("the file has format version {version}; this library reads {VERSION}"),
        ));
    }
    if header_sum != crc32fast::hash(&header[..28]) || header_bytes as usize != HEADER_BYTES {
        return fail("the file's header is damaged".into());
    }
    if (payload.len() as u64) < length {
        return fail(format!(
            "the file is truncated: {} of {length} bytes follow the header",
            payload.len()
        ));
    }
    if payload.len() as u64 > length {
        return fail(format!(
            "the file is damaged: {} bytes follow the header instead of {length}",
            payload.len()
        ));
    }
    if sum != crc32fast::hash(payload) {
        return fail("the file is damaged: its checksum does not match".into());
    }
    Ok(payload)
}

#[derive(Default)]
struct Writer(Vec<u8>);

impl Writer {
    fn u32(&mut self, value: u32) {
        self.0.extend(value.to_le_bytes());
    }

    fn u64(&mut self, value: u64) {
        self.0.extend(value.to_le_bytes());
    }

    fn f64(&mut self, value: f64) {
        self.0.extend(value.to_le_bytes());
    }

    fn count(&mut self, value: usize) {
        self.u64(value as u64);
    }

    fn vector(&mut self, vector: &Vec3) {
        for &x in vector.iter() {
            self.f64(x);
        }
    }

    fn primitive(&mut self, primitive: &Convex) {
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

    fn tree(&mut self, tree: &WrapperTree) {
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

    fn packed(&mut self, packed: &PackedTree) {
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

/// Reads a payload that passed its checksum; what it says is still not trusted.
struct Reader<'a> {
    payload: &'a [u8],
    /// Where in the file the rest begins, for messages.
    place: usize,
}

impl Reader<'_> {
    fn damaged(&self, what: &str) -> Error {
        Error::new(
            ErrorKind::Parse,
            format!("{what} cannot be right (before byte {})", self.place),
        )
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N]> {
        let (taken, rest) = self
            .payload
            .split_first_chunk::<N>()
            .ok_or_else(|| self.damaged("the length of the content"))?;
        self.payload = rest;
        self.place += N;
        Ok(*taken)
    }

    fn u32(&mut self) -> Result<u32> {
        Ok(u32::from_le_bytes(self.take()?))
    }

    fn u64(&mut self) -> Result<u64> {
        Ok(u64::from_le_bytes(self.take()?))
    }

    fn f64(&mut self) -> Result<f64> {
        let value = f64::from_le_bytes(self.take()?);
        if value.is_finite() && value.abs() <= 4.0 * tolerance::LARGEST_COORDINATE {
            Ok(value)
        } else {
            Err(self.damaged("a number"))
        }
    }

    fn length(&mut self) -> Result<f64> {
        let value = self.f64()?;
        if value >= 0.0 {
            Ok(value)
        } else {
            Err(self.damaged("a length"))
        }
    }

    fn vector(&mut self) -> Result<Vec3> {
        Ok(Vec3::new(self.f64()?, self.f64()?, self.f64()?))
    }

    /// A number of things of which each takes `bytes` at least, so that it cannot ask for more memory than the file has.
    fn fitting(&self, count: u64, bytes: usize) -> Result<usize> {
        usize::try_from(count)
            .ok()
            .filter(|&count| count <= self.payload.len() / bytes)
            .ok_or_else(|| self.damaged("a count"))
    }

    fn count(&mut self, bytes: usize) -> Result<usize> {
        let count = self.u64()?;
        self.fitting(count, bytes)
    }

    fn short_count(&mut self, bytes: usize) -> Result<usize> {
        let count = self.u32()?;
        self.fitting(count.into(), bytes)
    }

    fn index(&mut self, below: usize) -> Result<u32> {
        let index = self.u32()?;
        if (index as usize) < below {
            Ok(index)
        } else {
            Err(self.damaged("an index"))
        }
    }

    fn primitive(&mut self) -> Result<Convex> {
        let (vertices, edges, faces) = (
            self.short_count(24)?,
            self.short_count(8)?,
            self.short_count(28)?,
        );
        let deviation = self.length()?;
        if vertices == 0 || edges == 0 {
            return Err(self.damaged("a primitive"));
        }
        let vertices: Vec<Vec3> = (0..vertices)
            .map(|_| self.vector())
            .collect::<Result<_>>()?;
        let edges: Vec<[u32; 2]> = (0..edges)
            .map(|_| Ok([self.index(vertices.len())?, self.index(vertices.len())?]))
            .collect::<Result<_>>()?;
        let faces: Vec<Face> = (0..faces)
            .map(|_| {
                let normal = self.vector()?;
                let corners = self.short_count(4)?;
                if corners < 3 || (normal.norm() - 1.0).abs() > 1e-9 {
                    return Err(self.damaged("a face"));
                }
                let corners = (0..corners).map(|_| self.index(vertices.len()));
                Ok(Face {
                    vertices: corners.collect::<Result<_>>()?,
                    normal,
                })
            })
            .collect::<Result<_>>()?;
        Ok(Convex {
            vertices,
            edges,
            faces,
            deviation,
        })
    }

    fn tree(&mut self, primitives: usize) -> Result<WrapperTree> {
        let kind = *KINDS
            .get(self.u32()? as usize)
            .ok_or_else(|| self.damaged("the kind of wrappers"))?;
        let count = self.count(48)?;
        let pieces = self.count(4)?;
        let mut nodes = Vec::with_capacity(count);
        let mut frames = Vec::with_capacity(count);
        let mut corners = Vec::new();
        for i in 0..count {
            let code = self.u32()?;
            nodes.push(if code & LEAF != 0 {
                Node::Leaf {
                    primitive: code & !LEAF,
                }
            } else {
                Node::Interior {
                    children: [i as u32 + 1, code],
                }
            });
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
        let pieces: Vec<u32> = (0..pieces)
            .map(|_| self.index(count))
            .collect::<Result<_>>()?;
        let subsets = SubsetTree { nodes };
        if !subsets.is_sound(primitives) || !pieces.is_sorted_by(|a, b| a < b) {
            return Err(self.damaged("the tree"));
        }
        Ok(WrapperTree::from_parts(
            subsets, frames, corners, kind, pieces,
        ))
    }

    fn packed(&mut self, primitives: &[Convex], tree: &WrapperTree) -> Result<PackedTree> {
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
        PackedTree::from_parts(nodes, &order, primitives, tree)
            .ok_or_else(|| self.damaged("the tree of boxes"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::BodyBuilder;
    use crate::hierarchy::HierarchyOptions;

    fn steps(wrapper: WrapperKind) -> Body {
        let mut builder = BodyBuilder::new(3).unwrap();
        for i in 0..40 {
            let (x, z) = (f64::from(i), 0.3 * f64::from(i % 7));
            let square = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)];
            let square = square.map(|(u, v)| Vec3::new(x + u, v, z));
            builder
                .add_polygon(&square, u64::from(i as u32) + 100)
                .unwrap();
        }
        builder
            .add_polyhedron(
                &(0..8)
                    .map(|i| {
                        Vec3::new(
                            f64::from(i & 1),
                            f64::from(i >> 1 & 1),
                            f64::from(i >> 2) - 3.0,
                        )
                    })
                    .collect::<Vec<_>>(),
                7,
            )
            .unwrap();
        let options = HierarchyOptions {
            wrapper,
            ..Default::default()
        };
        builder.build(&options, &mut |_| Ok(())).unwrap()
    }

    #[test]
    fn a_loaded_body_is_the_saved_one() {
        for kind in KINDS {
            let saved = steps(kind);
            let loaded = Body::from_bytes(&saved.to_bytes()).unwrap();
            assert_eq!(loaded.tree, saved.tree);
            assert_eq!(loaded.packed, saved.packed);
            assert_eq!(loaded.primitives, saved.primitives);
            assert_eq!(loaded.tags, saved.tags);
            assert_eq!(loaded.center, saved.center);
            assert_eq!(loaded.radius, saved.radius);
            assert_eq!(loaded.deviation, saved.deviation);
            assert_eq!(loaded.statistics.depth, saved.statistics.depth);
            assert_ne!(loaded.serial(), saved.serial());
        }
    }

    #[test]
    fn every_truncation_and_every_flipped_bit_is_refused() {
        let bytes = steps(WrapperKind::Hull).to_bytes();
        for length in 0..bytes.len() {
            assert!(
                Body::from_bytes(&bytes[..length]).is_err(),
                "{length} bytes"
            );
        }
        let mut altered = bytes.clone();
        for place in 0..bytes.len() {
            altered[place] ^= 1 << (place % 8);
            assert!(Body::from_bytes(&altered).is_err(), "byte {place}");
            altered[place] = bytes[place];
        }
        altered.push(0);
        assert!(Body::from_bytes(&altered).is_err());
        altered = bytes;
        altered[8] = 3;
        let error = Body::from_bytes(&altered).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Unsupported);
        assert!(error.message.contains("version 3"), "{}", error.message);
    }

    /// Content that passes the checksum but was not written by us must not lead out of bounds.
    #[test]
    fn forged_content_is_refused_or_harmless() {
        let bytes = steps(WrapperKind::Hull).to_bytes();
        for place in (HEADER_BYTES..bytes.len()).step_by(4) {
            for value in [u32::MAX, 0, LEAF | 40, 3] {
                let mut forged = bytes.clone();
                let end = (place + 4).min(bytes.len());
                forged[place..end].copy_from_slice(&value.to_le_bytes()[..end - place]);
                let sum = crc32fast::hash(&forged[HEADER_BYTES..]);
                forged[24..28].copy_from_slice(&sum.to_le_bytes());
                let sum = crc32fast::hash(&forged[..28]);
                forged[28..32].copy_from_slice(&sum.to_le_bytes());
                if let Ok(body) = Body::from_bytes(&forged) {
                    assert_eq!(body.tree().level(0), vec![0]);
                    assert!(body.tree().subsets().is_sound(body.primitives().len()));
                }
            }
        }
    }
}
