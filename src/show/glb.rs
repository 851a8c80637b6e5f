//! Writes coloured triangle meshes at poses as a glTF 2.0 binary (.glb): a JSON chunk and a buffer chunk.

use std::io::{self, Write};
use std::path::Path;

use serde_json::{Value, json};

use super::triangles::{STREAMED_CORNER, StreamExtent, TriangleStream, Triangles, write_stream};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::{Pose, Vec3};
use crate::whole_file::write_piecewise;

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

/// A colour: red, green, blue and opacity from 0 to 1.
pub type Colour = [f64; 4];

/// glTF's numbers for buffers of vertices, and for single precision.
const VERTICES: u32 = 34962;
const SINGLE: u32 = 5126;

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
        Some(self.add_corners(positions, normals, material))
    }

    fn add_corners(&mut self, positions: usize, normals: usize, material: usize) -> usize {
        self.meshes.push(json!({ "primitives": [{
            "attributes": { "POSITION": positions, "NORMAL": normals },
            "material": material,
        }]}));
        self.meshes.len() - 1
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
        self.add_values(times.iter().map(|&time| [time]), None)
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
        let places = poses.iter().map(|pose| pose.translation.into());
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
            ("translation", self.add_values::<3>(places, None)),
            ("rotation", self.add_values(turns.into_iter(), None)),
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
        let values = vectors.iter().map(|&vector| vector.into());
        self.add_values::<3>(values, Some(VERTICES))
    }

    /// Adds N numbers for each of several places or times, in single precision.
    fn add_values<const N: usize>(
        &mut self,
        values: impl ExactSizeIterator<Item = [f64; N]>,
        target: Option<u32>,
    ) -> usize {
        const TYPES: [&str; 5] = ["", "SCALAR", "VEC2", "VEC3", "VEC4"];
        let (start, count) = (self.buffer.len(), values.len());
        let mut low = [f32::INFINITY; N];
        let mut high = [f32::NEG_INFINITY; N];
        self.buffer.reserve(4 * N * count);
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
            "componentType": SINGLE,
            "count": count,
            "type": TYPES[N],
            "min": low.as_slice(),
            "max": high.as_slice(),
        }));
        self.accessors.len() - 1
    }

    /// Writes the file, whole or not at all; `extras` describe the scene.
    pub fn save(self, file: &Path, extras: Value) -> Result<()> {
        self.write(file, extras, 0, |_| Ok(()))
    }

    /// The same with one more named mesh, whose triangles are written behind all else without being kept.
    pub fn save_with(
        mut self,
        file: &Path,
        extras: Value,
        (name, triangles, material): (&str, &dyn TriangleStream, usize),
    ) -> Result<()> {
        let extent = StreamExtent::of(triangles);
        if extent.corners == 0 {
            return self.save(file, extras);
        }
        let streamed = extent.corners * STREAMED_CORNER;
        self.views.push(json!({
            "buffer": 0,
            "byteOffset": self.buffer.len(),
            "byteLength": streamed,
            "byteStride": STREAMED_CORNER,
            "target": VERTICES,
        }));
        let positions = self.accessors.len();
        for place in [0, STREAMED_CORNER / 2] {
            self.accessors.push(json!({
                "bufferView": self.views.len() - 1,
                "byteOffset": place,
                "componentType": SINGLE,
                "count": extent.corners,
                "type": "VEC3",
            }));
        }
        self.accessors[positions]["min"] = json!(extent.low);
        self.accessors[positions]["max"] = json!(extent.high);
        let mesh = self.add_corners(positions, positions + 1, material);
        self.add_node(name, mesh, &Pose::identity(), json!({}));
        self.write(file, extras, streamed, |file| write_stream(triangles, file))
    }

    /// Writes what is in the buffer, and so many bytes behind it.
    fn write(
        self,
        file: &Path,
        extras: Value,
        streamed: usize,
        write_streamed: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<()> {
        // All are floats, so the length is a multiple of four.
        let binary = self.buffer.len() + streamed;
        let text = self.text(extras, binary);
        let length = 28 + text.len() + binary;
        if u32::try_from(length).is_err() {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!("the picture would have {length} bytes, a .glb file has less than 2^32"),
            ));
        }
        write_piecewise(file, |file| {
            file.write_all(b"glTF")?;
            for number in [2, length as u32, text.len() as u32] {
                file.write_all(&number.to_le_bytes())?;
            }
            file.write_all(b"JSON")?;
            file.write_all(&text)?;
            file.write_all(&(binary as u32).to_le_bytes())?;
            file.write_all(b"BIN\0")?;
            file.write_all(&self.buffer)?;
            write_streamed(file)
        })
    }

    /// What describes the numbers, of which there are `binary` bytes; filled up to a multiple of four.
    fn text(&self, extras: Value, binary: usize) -> Vec<u8> {
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
            "buffers": [{ "byteLength": binary }],
        });
        if !self.channels.is_empty() {
            content["animations"] =
                json!([{ "samplers": self.samplers, "channels": self.channels }]);
        }
        let mut text = content.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        text
    }
}
