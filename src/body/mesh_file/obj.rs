//! Reads meshes from OBJ files: positions, faces and lines. No crate is used: tobj overflows on negative indices, others
//! round coordinates to single precision, and none reports the line of an error.

use crate::body::{Mesh, require_mesh_size};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;
use crate::whole_file::text_of;

/// The parts of a corner `v/vt/vn`.
const PARTS: [&str; 3] = ["vertex", "texture vertex", "normal"];

/// Parses an OBJ file. Line elements become faces without area, so that face indices match the file. Objects, groups and
/// materials are ignored, as vertex numbers run through them.
pub fn parse_obj(bytes: &[u8]) -> Result<Mesh> {
    let mut reader = Reader::default();
    // The beginning of a statement that continues on the next line.
    let mut begun = String::new();
    for (number, line) in text_of(bytes)?.lines().enumerate() {
        let number = number + 1;
        let code = line.split('#').next().unwrap_or_default();
        if let Some(part) = code.strip_suffix('\\') {
            begun.push_str(part);
            begun.push(' ');
            continue;
        }
        let read = if begun.is_empty() {
            reader.read(code, number)
        } else {
            begun.push_str(code);
            let read = reader.read(&begun, number);
            begun.clear();
            read
        };
        read.map_err(|e| at_line(number, e))?;
    }
    if !begun.is_empty() {
        return Err(fail(
            "the file ends in a line that is continued; it is truncated",
        ));
    }
    reader.finish()
}

fn fail(message: impl Into<String>) -> Error {
    Error::new(ErrorKind::Parse, message)
}

fn at_line(number: usize, error: Error) -> Error {
    error.within(format_args!("line {number}"))
}

#[derive(Default)]
struct Reader {
    mesh: Mesh,
    /// The numbers of texture vertices and normals so far.
    others: [usize; 2],
    /// The largest vertex index, counted from 1, and its line: it is checked at the end, as a face may precede its vertices.
    /// Texture vertices and normals may be missing: tools that simplify collision meshes drop them.
    largest: (usize, usize),
}

impl Reader {
    fn read(&mut self, statement: &str, line: usize) -> Result<()> {
        let mut words = statement.split_ascii_whitespace();
        match words.next() {
            Some("v") => self.mesh.vertices.push(position(words)?),
            Some("vt") => self.others[0] += 1,
            Some("vn") => self.others[1] += 1,
            Some("f" | "l") => {
                let before = self.mesh.indices.len();
                for word in words {
                    let index = self.corner(word, line)?;
                    self.mesh.indices.push(index);
                }
                let size = self.mesh.indices.len() - before;
                self.mesh.face_sizes.push(size as u32);
                require_mesh_size(&self.mesh)?;
            }
            _ => {}
        }
        Ok(())
    }

    /// The index of the corner's vertex, counted from 0.
    fn corner(&mut self, word: &str, line: usize) -> Result<u32> {
        let mut vertex = None;
        for (part, text) in word.split('/').enumerate() {
            if part >= PARTS.len() {
                return Err(fail(format!("corner \"{word}\" has more than 3 parts")));
            }
            if text.is_empty() && part > 0 {
                continue;
            }
            let index = self
                .index(part, text)
                .ok_or_else(|| self.no_index(part, text))?;
            if part == 0 {
                if index as usize >= self.largest.0 {
                    self.largest = (index as usize + 1, line);
                }
                vertex = Some(index);
            }
        }
        vertex.ok_or_else(|| fail("a corner has no vertex"))
    }

    /// Positive indices count from 1; negative ones count backwards from the elements read so far, -1 being the last.
    fn index(&self, part: usize, text: &str) -> Option<u32> {
        let number: i64 = text.parse().ok()?;
        let index = match number {
            0 => return None,
            1.. => number - 1,
            _ => number.checked_add(self.count(part) as i64)?,
        };
        u32::try_from(index).ok()
    }

    fn count(&self, part: usize) -> usize {
        match part {
            0 => self.mesh.vertices.len(),
            other => self.others[other - 1],
        }
    }

    fn no_index(&self, part: usize, text: &str) -> Error {
        fail(format!(
            "\"{text}\" is no index of a {}; {} come before it, counted from 1",
            PARTS[part],
            self.count(part)
        ))
    }

    fn finish(self) -> Result<Mesh> {
        let (largest, line) = self.largest;
        let count = self.mesh.vertices.len();
        if largest > count {
            let message =
                format!("vertex {largest} does not exist; there are {count}, counted from 1");
            return Err(at_line(line, fail(message)));
        }
        Ok(self.mesh)
    }
}

/// Three coordinates; a fourth number is a weight that divides them, three more are a colour.
fn position<'a>(words: impl Iterator<Item = &'a str>) -> Result<Vec3> {
    let mut numbers = [0.0f64; 6];
    let mut count = 0;
    for word in words {
        let place = numbers
            .get_mut(count)
            .ok_or_else(|| fail("a vertex has 3, 4 or 6 numbers, not more"))?;
        *place = word
            .parse()
            .map_err(|_| fail(format!("\"{word}\" is no number")))?;
        count += 1;
    }
    let [x, y, z, weight, ..] = numbers;
    match count {
        3 | 6 => Ok(Vec3::new(x, y, z)),
        4 if weight == 0.0 => Err(fail("the weight of a vertex is 0")),
        4 => Ok(Vec3::new(x, y, z) / weight),
        _ => Err(fail(format!("a vertex has 3, 4 or 6 numbers, not {count}"))),
    }
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
}
