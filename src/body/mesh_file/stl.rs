//! Reads meshes from STL files, ASCII and binary. No crate is used: the available ones round the numbers of ASCII files to
//! single precision and do not report the line of an error.

use std::collections::HashMap;

use crate::body::{Mesh, MeshBudget, MeshSize, require_mesh_size};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::pose::Vec3;

pub fn parse_stl(bytes: &[u8]) -> Result<Mesh> {
    // A binary file is recognized by its length, since its header may begin like an ASCII file.
    let is_binary = bytes.get(80..84).is_some_and(|count| {
        let count = u32::from_le_bytes([count[0], count[1], count[2], count[3]]);
        bytes.len() as u64 == 84 + 50 * u64::from(count)
    });
    if is_binary {
        let faces = (bytes.len() as u64 - 84) / 50;
        let size = MeshSize {
            faces,
            indices: 3 * faces,
            squares: 0,
        };
        MeshBudget::default().take(size, false)?;
        return Ok(binary_stl(&bytes[84..]));
    }
    let first = bytes.trim_ascii_start().get(..5);
    if !first.is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) {
        return Err(Error::new(
            ErrorKind::Parse,
            format!(
                "neither ASCII STL nor a whole binary STL file: {} bytes",
                bytes.len()
            ),
        ));
    }
    ascii_stl(&String::from_utf8_lossy(bytes))
}

/// Triangles with equal vertices merged.
#[derive(Default)]
struct TriangleSoup {
    mesh: Mesh,
    known: HashMap<[u64; 3], u32>,
}

impl TriangleSoup {
    fn add_vertex(&mut self, [x, y, z]: [f64; 3]) {
        let fresh = self.mesh.vertices.len() as u32;
        // Adding zero makes -0 and 0 one number.
        let key = [x, y, z].map(|c| (c + 0.0).to_bits());
        let index = *self.known.entry(key).or_insert(fresh);
        if index == fresh {
            self.mesh.vertices.push(Vec3::new(x, y, z));
        }
        self.mesh.indices.push(index);
    }

    fn end_triangle(&mut self) {
        self.mesh.face_sizes.push(3);
    }
}

/// Records of 50 bytes: normal, three vertices, attribute.
fn binary_stl(records: &[u8]) -> Mesh {
    let mut soup = TriangleSoup::default();
    for record in records.chunks_exact(50) {
        for vertex in record[12..48].chunks_exact(12) {
            let at = |i: usize| {
                f64::from(f32::from_le_bytes([
                    vertex[i],
                    vertex[i + 1],
                    vertex[i + 2],
                    vertex[i + 3],
                ]))
            };
            soup.add_vertex([at(0), at(4), at(8)]);
        }
        soup.end_triangle();
    }
    soup.mesh
}

/// The lines of a text with their numbers, counted from 1. `\r\n` ends one line; a lone `\r` ends a statement within a line.
fn numbered_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.split('\n').enumerate();
    lines.flat_map(|(i, line)| line.split('\r').map(move |part| (i + 1, part)))
}

fn ascii_stl(text: &str) -> Result<Mesh> {
    let stopped =
        |line: usize, what: &str| Error::new(ErrorKind::Parse, format!("line {line}: {what}"));
    let mut soup = TriangleSoup::default();
    let mut corners = None;
    let mut closed = false;
    let mut last = 1;
    for (number, line) in numbered_lines(text) {
        let mut words = line.split_ascii_whitespace();
        let Some(keyword) = words.next() else {
            continue;
        };
        last = number;
        match (keyword.to_ascii_lowercase().as_str(), corners) {
            ("solid", None) => closed = false,
            ("endsolid", None) => closed = true,
            ("facet", None) => corners = Some(0),
            ("outer" | "endloop", Some(_)) => {}
            ("vertex", Some(count)) => {
                let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
                let vertex: [f64; 3] = numbers
                    .and_then(|numbers| numbers.try_into().ok())
                    .ok_or_else(|| stopped(number, "a vertex needs three numbers"))?;
                require_finite(&vertex, "coordinate")
                    .map_err(|e| e.within(format_args!("line {number}")))?;
                soup.add_vertex(vertex);
                corners = Some(count + 1);
            }
            ("endfacet", Some(3)) => {
                soup.end_triangle();
                require_mesh_size(&soup.mesh)
                    .map_err(|e| e.within(format_args!("line {number}")))?;
                corners = None;
            }
            ("endfacet", Some(count)) => {
                return Err(stopped(
                    number,
                    &format!("a facet has 3 vertices, not {count}"),
                ));
            }
            _ => {
                return Err(stopped(
                    number,
                    &format!("\"{keyword}\" does not belong here"),
                ));
            }
        }
    }
    if !closed {
        return Err(stopped(
            last,
            "the file ends without \"endsolid\"; it is truncated",
        ));
    }
    Ok(soup.mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stl_both_ways() {
        let ascii = b"solid x\n facet normal 0.0e+000 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n endfacet\nendsolid x\n";
        let mesh = parse_stl(ascii).unwrap();
        assert_eq!(mesh.face_sizes, vec![3]);

        let mut binary = b"solid that is binary all the same".to_vec();
        binary.resize(80, b' ');
        binary.extend(1u32.to_le_bytes());
        for x in [0f32, 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.] {
            binary.extend(x.to_le_bytes());
        }
        binary.extend([0, 0]);
        assert_eq!(parse_stl(&binary).unwrap().vertices, mesh.vertices);
        for cut in [10, 84, binary.len() - 1] {
            assert_eq!(
                parse_stl(&binary[..cut]).unwrap_err().kind,
                ErrorKind::Parse
            );
        }
        assert_eq!(
            parse_stl(&ascii[..ascii.len() - 20]).unwrap_err().kind,
            ErrorKind::Parse
        );
    }
}
