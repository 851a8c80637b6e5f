//! Meshes from OBJ files, through the crate tobj, and from STL and COLLADA files.

use std::collections::HashMap;
use std::io::BufReader;
use std::path::Path;

use super::Mesh;
use super::collada::parse_collada;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::pose::Vec3;

/// Reads a mesh; the ending of the file's name tells its format. The file is read whole or refused.
pub fn read_mesh_file(path: &Path) -> Result<Mesh> {
    let ending = path
        .extension()
        .map(|e| e.to_string_lossy().to_ascii_lowercase())
        .unwrap_or_default();
    let read = match ending.as_str() {
        "obj" => parse_obj,
        "stl" => parse_stl,
        "dae" => parse_collada,
        "" => {
            return Err(Error::new(
                ErrorKind::Unsupported,
                "mesh files end in .obj, .stl or .dae; this name has no ending",
            ));
        }
        other => {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!("mesh files end in .obj, .stl or .dae, not \".{other}\""),
            ));
        }
    };
    let bytes = std::fs::read(path).map_err(|e| Error::new(ErrorKind::Io, e.to_string()))?;
    let mesh = read(&bytes)?;
    if mesh.face_sizes.is_empty() {
        return Err(Error::new(ErrorKind::Empty, "the file holds no face"));
    }
    Ok(mesh)
}

/// Names the line at which reading stopped: the readers do not tell, so the shortest beginning of the file that fails in
/// the same way is looked for.
fn naming_the_line(bytes: &[u8], read: impl Fn(&[u8]) -> std::result::Result<(), String>) -> Error {
    let message = read(bytes).err().unwrap_or_default();
    let ends: Vec<usize> = (0..bytes.len()).filter(|&i| bytes[i] == b'\n').collect();
    let fails = |&end: &usize| read(&bytes[..=end]).is_err_and(|m| m == message);
    let line = ends.partition_point(|end| !fails(end));
    let from = if line == 0 { 0 } else { ends[line - 1] + 1 };
    let to = ends.get(line).copied().unwrap_or(bytes.len());
    let text = String::from_utf8_lossy(&bytes[from.min(to)..to]);
    let not_finite = text
        .split_whitespace()
        .find(|word| word.parse::<f64>().is_ok_and(|x| !x.is_finite()));
    let line = line + 1;
    match not_finite {
        Some(word) => Error::new(
            ErrorKind::NotFinite,
            format!(
                "line {line}: a coordinate is {}",
                word.parse::<f64>().unwrap_or(f64::NAN)
            ),
        ),
        None => Error::new(ErrorKind::Parse, format!("line {line}: {message}")),
    }
}

fn parse_obj(bytes: &[u8]) -> Result<Mesh> {
    // Points and lines are kept as faces without area, so that the numbers of the faces stay those of the file.
    let options = tobj::LoadOptions::default();
    let load = |bytes: &[u8]| {
        // Materials do not matter here: whatever file is named, an empty one is read.
        tobj::load_obj_buf(&mut BufReader::new(bytes), &options, |_| {
            tobj::load_mtl_buf(&mut BufReader::new(&b""[..]))
        })
        .map_err(|e| e.to_string())
    };
    let Ok((models, _)) = load(bytes) else {
        return Err(naming_the_line(bytes, |part| load(part).map(|_| ())));
    };
    let mut mesh = Mesh::default();
    for model in models {
        let base = mesh.vertices.len() as u32;
        mesh.vertices.extend(
            model
                .mesh
                .positions
                .chunks_exact(3)
                .map(Vec3::from_column_slice),
        );
        mesh.indices
            .extend(model.mesh.indices.iter().map(|i| base + i));
        if model.mesh.face_arities.is_empty() {
            mesh.face_sizes
                .extend(model.mesh.indices.chunks(3).map(|face| face.len() as u32));
        } else {
            mesh.face_sizes.extend(&model.mesh.face_arities);
        }
    }
    Ok(mesh)
}

/// STL, read here rather than by a crate: those at hand round the numbers of ASCII files to single precision and do not
/// say at which line they stopped.
fn parse_stl(bytes: &[u8]) -> Result<Mesh> {
    // A binary file is known by its length; its free header may begin like an ASCII file.
    let is_binary = bytes.get(80..84).is_some_and(|count| {
        let count = u32::from_le_bytes([count[0], count[1], count[2], count[3]]);
        bytes.len() as u64 == 84 + 50 * u64::from(count)
    });
    if is_binary {
        return Ok(binary_stl(&bytes[84..]));
    }
    if !bytes.trim_ascii_start().starts_with(b"solid") {
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

/// Triangles, each vertex once.
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

    fn finish(mut self) -> Mesh {
        self.mesh.face_sizes = vec![3; self.mesh.indices.len() / 3];
        self.mesh
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
    }
    soup.finish()
}

fn ascii_stl(text: &str) -> Result<Mesh> {
    let stopped = |line: usize, what: &str| {
        Error::new(ErrorKind::Parse, format!("line {}: {what}", line + 1))
    };
    let mut soup = TriangleSoup::default();
    let mut corners = None;
    let mut closed = false;
    let mut last = 0;
    for (number, line) in text.split(['\n', '\r']).enumerate() {
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
                let numbers: Vec<f64> = words.map_while(|word| word.parse().ok()).collect();
                let vertex: [f64; 3] = numbers
                    .try_into()
                    .map_err(|_| stopped(number, "a vertex needs three numbers"))?;
                require_finite(&vertex, "coordinate")
                    .map_err(|e| e.within(format_args!("line {}", number + 1)))?;
                soup.add_vertex(vertex);
                corners = Some(count + 1);
            }
            ("endfacet", Some(3)) => corners = None,
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
    Ok(soup.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_of_an_obj_stay_polygons() {
        let text = b"mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5e-1\nusemtl x\nf 1 2 3 4\nf 1/1 2/2 3/3\n";
        let mesh = parse_obj(text).unwrap();
        assert_eq!(mesh.face_sizes, vec![4, 3]);
        assert_eq!(mesh.vertices[3].z, 0.05);
    }

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
