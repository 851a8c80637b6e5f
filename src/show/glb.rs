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

/// glTF's number for buffers of vertices.
const VERTICES: u32 = 34962;

/// Builds a glTF document.
#[derive(Default)]
pub struct Document {
    buffer: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    nodes: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
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

    /// Adds the times of a motion, in seconds, rising.
    pub fn add_times(&mut self, times: &[f64]) -> usize {
        self.add_values(&times.iter().map(|&time| [time]).collect::<Vec<_>>(), None)
    }

    /// Adds a named node that has a pose at each of the times; viewers interpolate between them.
    pub fn add_moving_node(
        &mut self,
        name: &str,
        mesh: usize,
        (times, poses): (usize, &[Pose]),
        extras: Value,
    ) {
        let node = self.nodes.len();
        self.nodes
            .push(json!({ "name": name, "mesh": mesh, "extras": extras }));
        let places: Vec<[f64; 3]> = poses.iter().map(|pose| pose.translation.into()).collect();
        let mut turns: Vec<[f64; 4]> = Vec::with_capacity(poses.len());
        for pose in poses {
            let turn = pose.to_quaternion();
            // Of the two quaternions of a rotation the one nearer to the last.
            let along = turns.last().map_or(1.0, |last| {
                last.iter().zip(turn).map(|(a, b)| a * b).sum::<f64>()
            });
            turns.push(turn.map(|x| if along < 0.0 { -x } else { x }));
        }
        for (path, values) in [
            ("translation", self.add_values(&places, None)),
            ("rotation", self.add_values(&turns, None)),
        ] {
            self.samplers
                .push(json!({ "input": times, "output": values }));
            self.channels.push(json!({
                "sampler": self.samplers.len() - 1,
                "target": { "node": node, "path": path },
            }));
        }
    }

    fn add_vectors(&mut self, vectors: &[Vec3]) -> usize {
        let values: Vec<[f64; 3]> = vectors.iter().map(|&vector| vector.into()).collect();
        self.add_values(&values, Some(VERTICES))
    }

    /// Adds N numbers for each of several places or times, in single precision.
    fn add_values<const N: usize>(&mut self, values: &[[f64; N]], target: Option<u32>) -> usize {
        const TYPES: [&str; 5] = ["", "SCALAR", "VEC2", "VEC3", "VEC4"];
        let start = self.buffer.len();
        let mut low = [f32::INFINITY; N];
        let mut high = [f32::NEG_INFINITY; N];
        for value in values {
            for i in 0..N {
                let x = value[i] as f32;
                low[i] = low[i].min(x);
                high[i] = high[i].max(x);
                self.buffer.extend(x.to_le_bytes());
            }
        }
        let mut view = json!({
            "buffer": 0,
            "byteOffset": start,
            "byteLength": self.buffer.len() - start,
        });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": 5126,
            "count": values.len(),
            "type": TYPES[N],
            "min": low.as_slice(),
            "max": high.as_slice(),
        }));
        self.accessors.len() - 1
    }

    /// The file's bytes; `extras` describe the scene.
    pub fn into_bytes(self, extras: Value) -> Vec<u8> {
        let roots: Vec<usize> = (0..self.nodes.len()).collect();
        let mut content = json!({
            "asset": { "version": "2.0", "generator": concat!("cstk ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "nodes": roots, "extras": extras }],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.buffer.len() }],
        });
        if !self.channels.is_empty() {
            content["animations"] =
                json!([{ "samplers": self.samplers, "channels": self.channels }]);
        }
        let mut text = content.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bytes = Vec::with_capacity(28 + text.len() + self.buffer.len());
        bytes.extend(b"glTF");
        bytes.extend(2u32.to_le_bytes());
        bytes.extend(((28 + text.len() + self.buffer.len()) as u32).to_le_bytes());
        bytes.extend((text.len() as u32).to_le_bytes());
        bytes.extend(b"JSON");
        bytes.extend(text);
        // All are floats, so the buffer's length is a multiple of four.
        bytes.extend((self.buffer.len() as u32).to_le_bytes());
        bytes.extend(b"BIN\0");
        bytes.extend(self.buffer);
        bytes
    }
}
