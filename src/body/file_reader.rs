//! Numbers, primitives and hierarchies from the bytes of a body file.

use super::Solid;
use super::file_writer::{CONE, CYLINDER, ELLIPSOID, KINDS, LEAF, PLAIN, ROUNDED};
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::{Frame, NODE_BYTES, Node, PackedTree, SubsetTree, WideNode, WrapperTree};
use crate::pose::{Mat3, Vec3};
use crate::primitive::{Convex, Curve, Face, Smooth, SmoothKind};
use crate::tolerance;

/// Reads a payload that passed its checksum; what it says is still not trusted.
pub struct Reader<'a> {
    pub payload: &'a [u8],
    /// Where in the file the rest begins, for messages.
    pub place: usize,
}

impl Reader<'_> {
    pub fn damaged(&self, what: &str) -> Error {
        Error::new(
            ErrorKind::Parse,
            format!("{what} cannot be right (before byte {})", self.place),
        )
    }

    pub fn take<const N: usize>(&mut self) -> Result<[u8; N]> {
        let (taken, rest) = self
            .payload
            .split_first_chunk::<N>()
            .ok_or_else(|| self.damaged("the length of the content"))?;
        self.payload = rest;
        self.place += N;
        Ok(*taken)
    }

    pub fn u32(&mut self) -> Result<u32> {
        Ok(u32::from_le_bytes(self.take()?))
    }

    pub fn u64(&mut self) -> Result<u64> {
        Ok(u64::from_le_bytes(self.take()?))
    }

    pub fn f64(&mut self) -> Result<f64> {
        let value = f64::from_le_bytes(self.take()?);
        if value.is_finite() && value.abs() <= 4.0 * tolerance::LARGEST_COORDINATE {
            Ok(value)
        } else {
            Err(self.damaged("a number"))
        }
    }

    pub fn length(&mut self) -> Result<f64> {
        let value = self.f64()?;
        if value >= 0.0 {
            Ok(value)
        } else {
            Err(self.damaged("a length"))
        }
    }

    pub fn vector(&mut self) -> Result<Vec3> {
        Ok(Vec3::new(self.f64()?, self.f64()?, self.f64()?))
    }

    /// A number of things of which each takes `bytes` at least, so that it cannot ask for more memory than the file has.
    pub fn fitting(&self, count: u64, bytes: usize) -> Result<usize> {
        usize::try_from(count)
            .ok()
            .filter(|&count| count <= self.payload.len() / bytes)
            .ok_or_else(|| self.damaged("a count"))
    }

    pub fn count(&mut self, bytes: usize) -> Result<usize> {
        let count = self.u64()?;
        self.fitting(count, bytes)
    }

    pub fn short_count(&mut self, bytes: usize) -> Result<usize> {
        let count = self.u32()?;
        self.fitting(count.into(), bytes)
    }

    pub fn index(&mut self, below: usize) -> Result<u32> {
        let index = self.u32()?;
        if (index as usize) < below {
            Ok(index)
        } else {
            Err(self.damaged("an index"))
        }
    }

    pub fn flag(&mut self) -> Result<bool> {
        match self.u32()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(self.damaged("a flag")),
        }
    }

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

    /// A primitive of a body of the plane or of space.
    pub fn primitive(&mut self, planar: bool) -> Result<Convex> {
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
        let mut read = Convex {
            vertices,
            edges,
            faces,
            deviation,
            curve: None,
        };
        if let Some((radius, smooth)) = curve {
            read.curve = Some(Box::new(Curve::new(&read, radius, smooth, planar)));
        }
        Ok(read)
    }

    pub fn tree(&mut self, primitives: usize) -> Result<WrapperTree> {
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

    pub fn packed(&mut self, primitives: &[Convex], tree: &WrapperTree) -> Result<PackedTree> {
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

    pub fn solid(&mut self, primitives: &[Convex]) -> Result<Option<Solid>> {
        if !self.flag()? {
            return Ok(None);
        }
        let mut sign_of = |primitive: &Convex| {
            let sign = i8::from_le_bytes(self.take()?);
            let is_possible = match sign {
                0 => true,
                -1 | 1 => primitive.faces.len() == 1,
                _ => false,
            };
            is_possible
                .then_some(sign)
                .ok_or_else(|| self.damaged("a sign"))
        };
        let signs = primitives.iter().map(&mut sign_of).collect::<Result<_>>()?;
        let count = self.count(4)?;
        let mut scraps = Vec::with_capacity(count);
        for _ in 0..count {
            let vertices = self.short_count(24)?;
            if vertices < 3 {
                return Err(self.damaged("a face without area"));
            }
            scraps.push(
                (0..vertices)
                    .map(|_| self.vector())
                    .collect::<Result<_>>()?,
            );
        }
        let solid = Solid::new(signs, scraps, primitives);
        solid.map(Some).ok_or_else(|| self.damaged("a boundary"))
    }
}
