//! Writes coloured triangle meshes at poses as a glTF 2.0 binary (.glb): a JSON chunk and a buffer chunk.

use std::path::Path;

use serde_json::{Value, json};

use crate::error::{Error, ErrorKind, Result};
use crate::pose::{Pose, Vec3};

/// Fails unless the name ends in .glb.
pub fn require_glb(path: &Path) -> Result<()> {
    if path.extension().is_some_and(|ending| ending == "glb") {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::Unsupported,
        format!("{}: the name of a picture ends in .glb", path.display()),
    ))
}

/// Triangles with a normal at each corner.
#[derive(Default)]
pub struct Triangles {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
}

impl Triangles {
    /// A flat triangle, counter-clockwise around `normal`.
    pub fn push(&mut self, corners: [Vec3; 3], normal: Vec3) {
        self.positions.extend(corners);
        self.normals.extend([normal; 3]);
    }
}

/// A colour: red, green, blue and opacity from 0 to 1.
pub type Colour = [f64; 4];

/// Builds a glTF document.
#[derive(Default)]
pub struct Document {
    buffer: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    nodes: Vec<Value>,
}

impl Document {
    /// Adds a material; `both_sides` for surfaces that are visible from behind.
    pub fn add_material(&mut self, name: &str, colour: Colour, both_sides: bool) -> usize {
        self.materials.push(json!({
            "name": name,
            "doubleSided": both_sides,
            "pbrMetallicRoughness": {
                "baseColorFactor": colour,
                "metallicFactor": 0.0,
                "roughnessFactor": 0.6,
            },
        }));
        self.materials.len() - 1
    }

    /// Adds a mesh; `None` if it has no triangle.
    pub fn add_mesh(&mut self, triangles: &Triangles, material: usize) -> Option<usize> {
        if triangles.positions.is_empty() {
            return None;
        }
        let positions = self.add_vectors(&triangles.positions);
        let normals = self.add_vectors(&triangles.normals);
        self.meshes.push(json!({ "primitives": [{
            "attributes": { "POSITION": positions, "NORMAL": normals },
            "material": material,
        }]}));
        Some(self.meshes.len() - 1)
    }

    /// Adds a named node that shows a mesh at a pose; `extras` are data for the reader.
    pub fn add_node(&mut self, name: &str, mesh: usize, pose: &Pose, extras: Value) {
        let (r, t) = (&pose.rotation, &pose.translation);
        let mut columns: Vec<f64> = Vec::with_capacity(16);
        for j in 0..3 {
            columns.extend([r[(0, j)], r[(1, j)], r[(2, j)], 0.0]);
        }
        columns.extend([t.x, t.y, t.z, 1.0]);
        self.nodes
            .push(json!({ "name": name, "mesh": mesh, "matrix": columns, "extras": extras }));
    }

    fn add_vectors(&mut self, vectors: &[Vec3]) -> usize {
        let start = self.buffer.len();
        let mut low = [f32::INFINITY; 3];
        let mut high = [f32::NEG_INFINITY; 3];
        for vector in vectors {
            for i in 0..3 {
                let x = vector[i] as f32;
                low[i] = low[i].min(x);
                high[i] = high[i].max(x);
                self.buffer.extend(x.to_le_bytes());
            }
        }
        self.views.push(json!({
            "buffer": 0,
            "byteOffset": start,
            "byteLength": self.buffer.len() - start,
            "target": 34962,
        }));
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": 5126,
            "count": vectors.len(),
            "type": "VEC3",
            "min": low,
            "max": high,
        }));
        self.accessors.len() - 1
    }

    /// The file's bytes; `extras` describe the scene.
    pub fn into_bytes(self, extras: Value) -> Vec<u8> {
        let roots: Vec<usize> = (0..self.nodes.len()).collect();
        let mut text = json!({
            "asset": { "version": "2.0", "generator": concat!("cstk ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "nodes": roots, "extras": extras }],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.buffer.len() }],
        })
        .to_string()
        .into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bytes = Vec::with_capacity(28 + text.len() + self.buffer.len());
        bytes.extend(b"glTF");
        bytes.extend(2u32.to_le_bytes());
        bytes.extend(((28 + text.len() + self.buffer.len()) as u32).to_le_bytes());
        bytes.extend((text.len() as u32).to_le_bytes());
        bytes.extend(b"JSON");
        bytes.extend(text);
        // Three floats a corner, so the buffer's length is a multiple of four.
        bytes.extend((self.buffer.len() as u32).to_le_bytes());
        bytes.extend(b"BIN\0");
        bytes.extend(self.buffer);
        bytes
    }
}
