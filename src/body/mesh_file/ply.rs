//! Reads PLY files, ASCII and binary: vertices and faces. No crate is used: those that are kept up read elements into maps
//! by name, one allocation a vertex, and bring a parser generator along.

use std::fmt::Display;

use crate::body::number_type::{ByteOrder, NumberType};
use crate::body::{MAX_CLOUD_POINTS, Mesh, MeshBudget, MeshSize};
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::Vec3;

/// The longest header that is read. Headers have some 20 lines.
const MAX_HEADER_BYTES: usize = 1 << 16;

/// Parses a PLY file: the coordinates of its element "vertex", and the faces of its element "face" if it has one. Other
/// elements and properties are skipped.
pub fn parse_ply(bytes: &[u8]) -> Result<Mesh> {
    let header = Header::parse(bytes)?;
    let mut source = Source {
        rest: &bytes[header.length..],
        line: header.lines,
        row: Vec::new(),
        encoding: header.encoding,
    };
    let mut mesh = Mesh::default();
    for element in &header.elements {
        let columns = element.columns()?;
        for i in 0..element.count {
            let read = source.row(element, &columns, &mut mesh);
            read.map_err(|e| e.within(source.place(&element.name, i)))?;
        }
    }
    source.finish()?;
    Ok(mesh)
}

fn fail(message: impl Into<String>) -> Error {
    Error::new(ErrorKind::Parse, message)
}

/// How numbers are stored.
#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Ascii,
    Binary(ByteOrder),
}

struct Property {
    name: String,
    /// The type of the length, if it is a list.
    length: Option<NumberType>,
    number: NumberType,
}

struct Element {
    name: String,
    count: u64,
    properties: Vec<Property>,
}

/// What is taken of an element.
enum Columns {
    Nothing,
    /// The numbers of the properties x, y and z.
    Vertex([usize; 3]),
    /// The number of the list of vertices.
    Face(usize),
}

struct Header {
    encoding: Encoding,
    elements: Vec<Element>,
    /// Up to the data.
    length: usize,
    lines: usize,
}

impl Header {
    fn parse(bytes: &[u8]) -> Result<Self> {
        let mut header = Self {
            encoding: Encoding::Ascii,
            elements: Vec::new(),
            length: 0,
            lines: 0,
        };
        let mut has_encoding = false;
        loop {
            let rest = &bytes[header.length..bytes.len().min(MAX_HEADER_BYTES)];
            let Some(end) = rest.iter().position(|&b| b == b'\n') else {
                return Err(match header.lines {
                    0 => fail("it is no PLY file: the first line is not \"ply\""),
                    _ => fail("the header does not end; the file is truncated"),
                });
            };
            header.length += end + 1;
            header.lines += 1;
            let line = String::from_utf8_lossy(&rest[..end]);
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            let at_line = |e: Error| e.within(format_args!("line {}", header.lines));
            match (header.lines, words.as_slice()) {
                (1, ["ply"]) => {}
                (1, _) => return Err(fail("it is no PLY file: the first line is not \"ply\"")),
                (_, [] | ["comment" | "obj_info", ..]) => {}
                (_, ["end_header"]) if has_encoding => return Ok(header),
                (_, ["end_header"]) => return Err(at_line(fail("no line names the format"))),
                (_, ["format", name, "1.0"]) => {
                    header.encoding = encoding_of(name).map_err(at_line)?;
                    has_encoding = true;
                }
                (_, ["element", name, count]) => {
                    if header.elements.iter().any(|e| e.name == *name) {
                        return Err(at_line(fail(format!("a second element \"{name}\""))));
                    }
                    let element = element_of(name, count).map_err(at_line)?;
                    header.elements.push(element);
                }
                (_, ["property", words @ ..]) => {
                    let property = property_of(words).map_err(at_line)?;
                    let element = header.elements.last_mut();
                    let element =
                        element.ok_or_else(|| at_line(fail("a property of no element")))?;
                    element.properties.push(property);
                }
                (_, [word, ..]) => {
                    return Err(at_line(fail(format!("\"{word}\" does not belong here"))));
                }
            }
        }
    }
}

fn encoding_of(name: &str) -> Result<Encoding> {
    match name {
        "ascii" => Ok(Encoding::Ascii),
        "binary_little_endian" => Ok(Encoding::Binary(ByteOrder::Little)),
        "binary_big_endian" => Ok(Encoding::Binary(ByteOrder::Big)),
        _ => Err(fail(format!("\"{name}\" is no format of PLY files"))),
    }
}

fn element_of(name: &str, count: &str) -> Result<Element> {
    let count = count
        .parse()
        .map_err(|_| fail(format!("\"{count}\" is no number of elements")))?;
    if name == "vertex" && count > MAX_CLOUD_POINTS {
        return Err(Error::new(
            ErrorKind::Unsupported,
            format!("{count} vertices; at most {MAX_CLOUD_POINTS} are possible"),
        ));
    }
    Ok(Element {
        name: name.to_string(),
        count,
        properties: Vec::new(),
    })
}

fn property_of(words: &[&str]) -> Result<Property> {
    let (length, number, name) = match words {
        ["list", length, number, name] => (Some(number_type(length)?), number, name),
        [number, name] => (None, number, name),
        _ => return Err(fail("a property has a type and a name")),
    };
    Ok(Property {
        name: (*name).to_string(),
        length,
        number: number_type(number)?,
    })
}

fn number_type(name: &str) -> Result<NumberType> {
    Ok(match name {
        "char" | "int8" => NumberType::I8,
        "uchar" | "uint8" => NumberType::U8,
        "short" | "int16" => NumberType::I16,
        "ushort" | "uint16" => NumberType::U16,
        "int" | "int32" => NumberType::I32,
        "uint" | "uint32" => NumberType::U32,
        "float" | "float32" => NumberType::F32,
        "double" | "float64" => NumberType::F64,
        _ => return Err(fail(format!("\"{name}\" is no type of PLY files"))),
    })
}

impl Element {
    fn columns(&self) -> Result<Columns> {
        // An element without properties has no bytes, so the file's length would not bound their number.
        if self.properties.is_empty() && self.count > 0 {
            return Err(fail(format!("element \"{}\" has no property", self.name)));
        }
        let find = |names: &[&str], is_list: bool| {
            let mut all = self.properties.iter();
            all.position(|p| names.contains(&&*p.name) && p.length.is_some() == is_list)
        };
        match self.name.as_str() {
            "vertex" => {
                let mut columns = [0; 3];
                for (column, name) in columns.iter_mut().zip(["x", "y", "z"]) {
                    *column = find(&[name], false)
                        .ok_or_else(|| fail(format!("the vertices have no property {name}")))?;
                }
                Ok(Columns::Vertex(columns))
            }
            "face" => Ok(match find(&["vertex_indices", "vertex_index"], true) {
                Some(column) => Columns::Face(column),
                None => Columns::Nothing,
            }),
            _ => Ok(Columns::Nothing),
        }
    }
}

/// What is left of the file's data.
struct Source<'a> {
    rest: &'a [u8],
    /// The line read last; of binary data, the header's last.
    line: usize,
    /// The numbers of a row, ASCII.
    row: Vec<f64>,
    encoding: Encoding,
}

impl Source<'_> {
    /// Names an element in messages.
    fn place(&self, element: &str, i: u64) -> String {
        match self.encoding {
            Encoding::Ascii => format!("{element} {i} (line {})", self.line),
            Encoding::Binary(_) => format!("{element} {i}"),
        }
    }

    /// Reads an element.
    fn row(&mut self, element: &Element, columns: &Columns, mesh: &mut Mesh) -> Result<()> {
        if self.encoding == Encoding::Ascii {
            self.next_line()?;
        }
        let mut used = 0;
        let mut vertex = [0.0; 3];
        for (p, property) in element.properties.iter().enumerate() {
            let Some(length) = property.length else {
                let number = self.number(property.number, &mut used)?;
                if let Columns::Vertex(at) = columns
                    && let Some(axis) = at.iter().position(|&column| column == p)
                {
                    vertex[axis] = number;
                }
                continue;
            };
            let length = self.number(length, &mut used)?;
            let length = whole(length, "a list's length")?;
            let is_face = matches!(columns, Columns::Face(column) if *column == p);
            if is_face {
                let mut size = MeshSize::of(mesh);
                size.faces += 1;
                size.indices += u64::from(length);
                MeshBudget::default().take(size, false)?;
            }
            for _ in 0..length {
                let number = self.number(property.number, &mut used)?;
                if is_face {
                    mesh.indices.push(whole(number, "the index of a vertex")?);
                }
            }
            if is_face {
                mesh.face_sizes.push(length);
            }
        }
        if used < self.row.len() {
            let count = self.row.len();
            return Err(fail(format!("{count} numbers; there should be {used}")));
        }
        if let Columns::Vertex(_) = columns {
            require_coordinates(&vertex, "coordinate")?;
            mesh.vertices.push(Vec3::from(vertex));
        }
        Ok(())
    }

    /// Parses the numbers of the next line that is not blank.
    fn next_line(&mut self) -> Result<()> {
        self.row.clear();
        while self.row.is_empty() {
            if self.rest.is_empty() {
                return Err(truncated());
            }
            let end = self.rest.iter().position(|&b| b == b'\n');
            let (line, rest) = match end {
                Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
                None => (self.rest, &[][..]),
            };
            self.rest = rest;
            self.line += 1;
            for word in line
                .split(u8::is_ascii_whitespace)
                .filter(|w| !w.is_empty())
            {
                self.row.push(number_in(word)?);
            }
        }
        Ok(())
    }

    /// The next number of the row.
    fn number(&mut self, kind: NumberType, used: &mut usize) -> Result<f64> {
        match self.encoding {
            Encoding::Ascii => {
                let number = self.row.get(*used).copied();
                *used += 1;
                number.ok_or_else(|| fail(format!("{} numbers are too few", self.row.len())))
            }
            Encoding::Binary(order) => {
                let (number, rest) = self
                    .rest
                    .split_at_checked(kind.size())
                    .ok_or_else(truncated)?;
                self.rest = rest;
                Ok(kind.read(number, order))
            }
        }
    }

    /// Fails for data after the last element.
    fn finish(&self) -> Result<()> {
        let is_left = match self.encoding {
            Encoding::Ascii => !self.rest.trim_ascii().is_empty(),
            Encoding::Binary(_) => !self.rest.is_empty(),
        };
        match is_left {
            false => Ok(()),
            true => Err(fail(format!(
                "{} bytes are left after the last element",
                self.rest.len()
            ))),
        }
    }
}

fn truncated() -> Error {
    fail("the file ends; it is truncated")
}

/// A number of an ASCII file.
pub(in crate::body) fn number_in(word: &[u8]) -> Result<f64> {
    let number = std::str::from_utf8(word).ok().and_then(|w| w.parse().ok());
    number.ok_or_else(|| {
        let word = String::from_utf8_lossy(&word[..word.len().min(40)]);
        fail(format!("\"{word}\" is no number"))
    })
}

fn whole(number: f64, what: impl Display) -> Result<u32> {
    match number >= 0.0 && number < f64::from(u32::MAX) && number.fract() == 0.0 {
        true => Ok(number as u32),
        false => Err(fail(format!("{number} is not {what}"))),
    }
}
