//! Reads PCD files: ASCII, binary, and binary compressed as the Point Cloud Library writes it. No crate is used: the one
//! that reads all three asks for memory on the header's word, and brings regular expressions along.

use super::cloud::{Cloud, MAX_CLOUD_POINTS};
use super::lzf::decompress;
use crate::body::MAX_MESH_FILE_BYTES;
use crate::body::mesh_file::number_in;
use crate::body::number_type::{ByteOrder, NumberType};
use crate::error::{Error, ErrorKind, Result};

/// The longest header that is read. Headers have some 11 lines.
const MAX_HEADER_BYTES: usize = 1 << 16;

/// Parses a PCD file. Points with a coordinate that is NaN were not measured and are left out. The viewpoint is not applied:
/// the points are in the frame of the file.
pub fn parse_pcd(bytes: &[u8]) -> Result<Cloud> {
    let header = Header::parse(bytes)?;
    let data = &bytes[header.length..];
    match header.encoding {
        Encoding::Ascii => header.read_ascii(data),
        Encoding::Binary => {
            let size = header.row_size() as u64 * header.count;
            if (data.len() as u64) < size {
                let found = data.len();
                return Err(fail(format!(
                    "{found} bytes of data; {} points need {size}",
                    header.count
                )));
            }
            let row = header.row_size();
            header.read_binary(data, |point, column| point * row + header.before(column))
        }
        Encoding::Compressed => {
            let data = header.decompressed(data)?;
            // Of each field, the numbers of all points follow one another.
            let count = header.count as usize;
            header.read_binary(&data, |point, column| {
                header.before(column) * count + point * header.fields[column].size()
            })
        }
    }
}

fn fail(message: impl Into<String>) -> Error {
    Error::new(ErrorKind::Parse, message)
}

#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Ascii,
    Binary,
    Compressed,
}

struct Field {
    name: String,
    number: NumberType,
    /// How many numbers it has.
    count: usize,
}

impl Field {
    fn size(&self) -> usize {
        self.number.size() * self.count
    }
}

/// The most numbers of a field. Descriptors of features have some hundred.
const MAX_FIELD_COUNT: usize = 1 << 16;

struct Header {
    encoding: Encoding,
    fields: Vec<Field>,
    /// The fields x, y and z.
    xyz: [usize; 3],
    /// The number of points.
    count: u64,
    /// Up to the data.
    length: usize,
    lines: usize,
}

/// The words of the header's lines, without the first.
#[derive(Default)]
struct Lines {
    fields: Vec<String>,
    sizes: Vec<String>,
    types: Vec<String>,
    counts: Vec<String>,
    width: Vec<String>,
    height: Vec<String>,
    points: Vec<String>,
}

impl Header {
    fn parse(bytes: &[u8]) -> Result<Self> {
        let mut lines = Lines::default();
        let (mut length, mut number) = (0, 0);
        loop {
            let rest = &bytes[length..bytes.len().min(MAX_HEADER_BYTES).max(length)];
            let Some(end) = rest.iter().position(|&b| b == b'\n') else {
                return Err(fail("no line DATA ends the header"));
            };
            length += end + 1;
            number += 1;
            let line = String::from_utf8_lossy(&rest[..end]);
            let mut words = line.split_ascii_whitespace().map(str::to_string);
            let Some(first) = words.next().filter(|word| !word.starts_with('#')) else {
                continue;
            };
            let words: Vec<String> = words.collect();
            match first.as_str() {
                "VERSION" | "VIEWPOINT" => {}
                "FIELDS" | "COLUMNS" => lines.fields = words,
                "SIZE" => lines.sizes = words,
                "TYPE" => lines.types = words,
                "COUNT" => lines.counts = words,
                "WIDTH" => lines.width = words,
                "HEIGHT" => lines.height = words,
                "POINTS" => lines.points = words,
                "DATA" => {
                    let encoding = encoding_of(&words);
                    let encoding = encoding.map_err(|e| e.within(format_args!("line {number}")))?;
                    return lines.header(encoding, length, number);
                }
                _ => {
                    return Err(fail(format!(
                        "line {number}: \"{first}\" does not belong in a PCD header"
                    )));
                }
            }
        }
    }

    fn row_size(&self) -> usize {
        self.fields.iter().map(Field::size).sum()
    }

    /// The bytes of a point before a field.
    fn before(&self, field: usize) -> usize {
        self.fields[..field].iter().map(Field::size).sum()
    }

    fn decompressed(&self, data: &[u8]) -> Result<Vec<u8>> {
        let sizes = data.get(..8).ok_or_else(truncated)?;
        let size = |at: usize| NumberType::U32.read(&sizes[at..], ByteOrder::Little) as u64;
        let (packed, unpacked) = (size(0), size(4));
        let wanted = self.row_size() as u64 * self.count;
        if unpacked != wanted {
            return Err(fail(format!(
                "{unpacked} bytes of unpacked data; {} points need {wanted}",
                self.count
            )));
        }
        if unpacked > MAX_MESH_FILE_BYTES {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!(
                    "{unpacked} bytes of unpacked data; at most {MAX_MESH_FILE_BYTES} are read"
                ),
            ));
        }
        let packed = data.get(8..8 + packed as usize).ok_or_else(truncated)?;
        decompress(packed, unpacked as usize)
            .ok_or_else(|| fail(format!("the compressed data do not hold {unpacked} bytes")))
    }

    fn read_ascii(&self, data: &[u8]) -> Result<Cloud> {
        let starts = self.xyz.map(|field| {
            let before = self.fields[..field].iter();
            before.map(|f| f.count).sum::<usize>()
        });
        let width: usize = self.fields.iter().map(|field| field.count).sum();
        let mut cloud = Cloud::default();
        let mut read = 0;
        for (i, line) in data.split(|&b| b == b'\n').enumerate() {
            if line.trim_ascii().is_empty() {
                continue;
            }
            let place = |e: Error| e.within(format_args!("line {}", self.lines + 1 + i));
            if read == self.count {
                let count = self.count;
                return Err(place(fail(format!("more than {count} points"))));
            }
            let mut xyz = [0.0; 3];
            let mut words = 0;
            for word in line
                .split(u8::is_ascii_whitespace)
                .filter(|w| !w.is_empty())
            {
                if let Some(axis) = starts.iter().position(|&start| start == words) {
                    xyz[axis] = number_in(word).map_err(place)?;
                }
                words += 1;
            }
            if words != width {
                return Err(place(fail(format!(
                    "{words} numbers; the fields are {width}"
                ))));
            }
            cloud.add(xyz).map_err(place)?;
            read += 1;
        }
        if read < self.count {
            return Err(fail(format!(
                "{read} points, not {}; the file is truncated",
                self.count
            )));
        }
        Ok(cloud)
    }

    /// `place` tells where in the data a field of a point is.
    fn read_binary(&self, data: &[u8], place: impl Fn(usize, usize) -> usize) -> Result<Cloud> {
        let mut cloud = Cloud::default();
        for point in 0..self.count as usize {
            let xyz = self.xyz.map(|field| {
                let bytes = &data[place(point, field)..];
                self.fields[field].number.read(bytes, ByteOrder::Little)
            });
            let added = cloud.add(xyz);
            added.map_err(|e| e.within(format_args!("point {point}")))?;
        }
        Ok(cloud)
    }
}

fn truncated() -> Error {
    fail("the data end; the file is truncated")
}

fn encoding_of(words: &[String]) -> Result<Encoding> {
    match words.first().map(String::as_str) {
        Some("ascii") => Ok(Encoding::Ascii),
        Some("binary") => Ok(Encoding::Binary),
        Some("binary_compressed") => Ok(Encoding::Compressed),
        Some(other) => Err(fail(format!("\"{other}\" is no kind of PCD data"))),
        None => Err(fail("DATA names no kind")),
    }
}

impl Lines {
    fn header(self, encoding: Encoding, length: usize, lines: usize) -> Result<Header> {
        if self.fields.is_empty() {
            return Err(fail("the header has no line FIELDS"));
        }
        let fields: Vec<Field> = (0..self.fields.len())
            .map(|i| self.field(i))
            .collect::<Result<_>>()?;
        for (words, name) in [(&self.sizes, "SIZE"), (&self.types, "TYPE")] {
            if words.len() > fields.len() {
                return Err(fail(format!("{name} has more entries than FIELDS")));
            }
        }
        let mut xyz = [0; 3];
        for (place, name) in xyz.iter_mut().zip(["x", "y", "z"]) {
            let mut all = fields.iter();
            let found = all.position(|field| field.name == name && field.count == 1);
            *place = found.ok_or_else(|| fail(format!("the points have no field {name}")))?;
        }
        Ok(Header {
            encoding,
            fields,
            xyz,
            count: self.count()?,
            length,
            lines,
        })
    }

    fn field(&self, i: usize) -> Result<Field> {
        let name = self.fields[i].clone();
        let word = |words: &[String], line: &str| {
            let word = words.get(i).cloned();
            word.ok_or_else(|| fail(format!("{line} has no entry for field {name}")))
        };
        let (kind, size) = (word(&self.types, "TYPE")?, word(&self.sizes, "SIZE")?);
        let number = number_type(&kind, &size)
            .ok_or_else(|| fail(format!("field {name} has type {kind} and size {size}")))?;
        let count = match self.counts.is_empty() {
            true => 1,
            false => {
                let count = word(&self.counts, "COUNT")?;
                let parsed = count.parse().ok();
                parsed
                    .filter(|count| (1..=MAX_FIELD_COUNT).contains(count))
                    .ok_or_else(|| fail(format!("field {name} has count {count}")))?
            }
        };
        Ok(Field {
            name,
            number,
            count,
        })
    }

    /// The number of points, by POINTS, or by WIDTH and HEIGHT; they must agree.
    fn count(&self) -> Result<u64> {
        let number = |words: &[String], line: &str| match words.first() {
            None => Ok(None),
            Some(word) => match word.parse::<u64>() {
                Ok(number) => Ok(Some(number)),
                Err(_) => Err(fail(format!("{line} is \"{word}\", no number"))),
            },
        };
        let width = number(&self.width, "WIDTH")?;
        let height = number(&self.height, "HEIGHT")?;
        let area = width.map(|width| width.saturating_mul(height.unwrap_or(1)));
        let count = match (number(&self.points, "POINTS")?, area) {
            (Some(points), Some(area)) if points != area => {
                return Err(fail(format!(
                    "POINTS is {points}, but WIDTH times HEIGHT {area}"
                )));
            }
            (Some(count), _) | (None, Some(count)) => count,
            (None, None) => return Err(fail("the header does not tell the number of points")),
        };
        match count <= MAX_CLOUD_POINTS {
            true => Ok(count),
            false => Err(Error::new(
                ErrorKind::Unsupported,
                format!("{count} points; at most {MAX_CLOUD_POINTS} are possible"),
            )),
        }
    }
}

fn number_type(kind: &str, size: &str) -> Option<NumberType> {
    Some(match (kind, size) {
        ("I", "1") => NumberType::I8,
        ("I", "2") => NumberType::I16,
        ("I", "4") => NumberType::I32,
        ("I", "8") => NumberType::I64,
        ("U", "1") => NumberType::U8,
        ("U", "2") => NumberType::U16,
        ("U", "4") => NumberType::U32,
        ("U", "8") => NumberType::U64,
        ("F", "4") => NumberType::F32,
        ("F", "8") => NumberType::F64,
        _ => return None,
    })
}
