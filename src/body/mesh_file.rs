//! Meshes from OBJ and STL files, through the crates tobj and stl_io.

use std::io::{BufReader, Cursor};
use std::path::Path;

use super::builder::Mesh;
use crate::error::{Error, ErrorKind, Result};
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
        other => {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!("mesh files end in .obj or .stl, not \".{other}\""),
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

fn parse_stl(bytes: &[u8]) -> Result<Mesh> {
    let mut bytes = bytes.to_vec();
    // A binary file is known by its length; its free header may begin like an ASCII file.
    let is_binary = bytes.get(80..84).is_some_and(|count| {
        let count = u32::from_le_bytes([count[0], count[1], count[2], count[3]]);
        bytes.len() as u64 == 84 + 50 * u64::from(count)
    });
    if is_binary {
        bytes[..80].fill(0);
    } else if !bytes.trim_ascii_start().starts_with(b"solid") {
        return Err(Error::new(
            ErrorKind::Parse,
            format!(
                "neither ASCII STL nor a whole binary STL file: {} bytes",
                bytes.len()
            ),
        ));
    } else if !bytes
        .trim_ascii_end()
        .rsplit(|&b| b == b'\n' || b == b'\r')
        .next()
        .is_some_and(|line| line.trim_ascii().starts_with(b"endsolid"))
    {
        return Err(Error::new(
            ErrorKind::Parse,
            "the ASCII STL file has no closing \"endsolid\"; it is truncated",
        ));
    }
    let load = |bytes: &[u8]| stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|e| e.to_string());
    let stl = load(&bytes).map_err(|message| {
        if is_binary {
            Error::new(ErrorKind::Parse, message)
        } else {
            naming_the_line(&bytes, |part| load(part).map(|_| ()))
        }
    })?;
    Ok(Mesh {
        vertices: stl
            .vertices
            .iter()
            .map(|v| Vec3::new(f64::from(v.0[0]), f64::from(v.0[1]), f64::from(v.0[2])))
            .collect(),
        face_sizes: vec![3; stl.faces.len()],
        indices: stl
            .faces
            .iter()
            .flat_map(|face| face.vertices.map(|i| i as u32))
            .collect(),
    })
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
