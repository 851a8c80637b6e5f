//! Reads OctoMap's files: .bt, which tells of each leaf whether it is occupied, and .ot, which tells how likely.

use std::path::Path;

use super::cells::{Cells, Cube, WHOLE};
use crate::body::MAX_MESH_FILE_BYTES;
use crate::error::{Error, ErrorKind, Result};
use crate::whole_file::read_whole;

const BINARY: &[u8] = b"# Octomap OcTree binary file";
const FULL: &[u8] = b"# Octomap OcTree file";

/// The longest header that is read. Headers have some 7 lines.
const MAX_HEADER_BYTES: usize = 1 << 16;

/// Reads a file: the edge of a cell, and the occupied cells.
pub fn read_octomap_file(path: &Path, min_occupancy: f64) -> Result<(f64, Cells)> {
    parse_octomap(&read_whole(path, MAX_MESH_FILE_BYTES)?, min_occupancy)
}

/// Parses the bytes of a file, which tell themselves of which sort they are.
fn parse_octomap(bytes: &[u8], min_occupancy: f64) -> Result<(f64, Cells)> {
    if !(min_occupancy > 0.0 && min_occupancy < 1.0) {
        return Err(Error::invalid(format!(
            "the least occupancy is {min_occupancy}; it must be between 0 and 1"
        )));
    }
    let header = Header::parse(bytes)?;
    // OctoMap stores the logarithms of odds, and compares them, in single precision.
    let min_log_odds = (min_occupancy / (1.0 - min_occupancy)).ln() as f32;
    let mut reader = Reader {
        rest: &bytes[header.length..],
        cells: Cells::default(),
        count: 0,
        min_log_odds,
        colour_bytes: header.colour_bytes,
    };
    if header.size > 0 {
        reader.count = 1;
        match header.is_binary {
            true => reader.read_binary(WHOLE)?,
            false => reader.read_full(WHOLE)?,
        }
    }
    if reader.count != header.size {
        return Err(fail(format!(
            "{} nodes; the header says {}",
            reader.count, header.size
        )));
    }
    match reader.rest.len() {
        0 => Ok((header.resolution, reader.cells)),
        left => Err(fail(format!("{left} bytes are left after the last node"))),
    }
}

fn fail(message: impl Into<String>) -> Error {
    Error::new(ErrorKind::Parse, message)
}

struct Header {
    is_binary: bool,
    /// The number of nodes.
    size: u64,
    resolution: f64,
    /// The bytes of a node's colour in an .ot file.
    colour_bytes: usize,
    /// Up to the data.
    length: usize,
}

impl Header {
    fn parse(bytes: &[u8]) -> Result<Self> {
        let is_binary = bytes.starts_with(BINARY);
        if !is_binary && !bytes.starts_with(FULL) {
            return Err(fail(
                "it is no OctoMap file: the first line is neither that of a .bt nor of an .ot file",
            ));
        }
        let (mut id, mut size, mut resolution) = (None, None, None);
        let (mut length, mut number) = (0, 0);
        loop {
            let rest = &bytes[length..bytes.len().min(MAX_HEADER_BYTES).max(length)];
            let Some(end) = rest.iter().position(|&b| b == b'\n') else {
                return Err(fail("no line \"data\" ends the header"));
            };
            length += end + 1;
            number += 1;
            let line = String::from_utf8_lossy(&rest[..end]);
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            let at_line = |what: String| fail(format!("line {number}: {what}"));
            match words.as_slice() {
                [] => {}
                [word, ..] if word.starts_with('#') => {}
                ["id", word] => id = Some(word.to_string()),
                ["size", word] => {
                    let parsed = word.parse::<u64>();
                    size = Some(parsed.map_err(|_| at_line(format!("size \"{word}\"")))?);
                }
                ["res", word] => {
                    let parsed = word.parse::<f64>();
                    resolution = Some(parsed.map_err(|_| at_line(format!("res \"{word}\"")))?);
                }
                ["data"] => break,
                [word, ..] => return Err(at_line(format!("\"{word}\" does not belong here"))),
            }
        }
        let missing = |what: &str| fail(format!("the header has no line \"{what}\""));
        Ok(Self {
            is_binary,
            colour_bytes: colour_bytes(&id.ok_or_else(|| missing("id"))?)?,
            size: size.ok_or_else(|| missing("size"))?,
            resolution: resolution.ok_or_else(|| missing("res"))?,
            length,
        })
    }
}

/// The bytes of a node's colour in a tree of this kind.
fn colour_bytes(id: &str) -> Result<usize> {
    match id {
        "OcTree" | "OcTreeStamped" => Ok(0),
        "ColorOcTree" => Ok(3),
        _ => Err(Error::new(
            ErrorKind::Unsupported,
            format!("a tree of kind \"{id}\"; OcTree, OcTreeStamped and ColorOcTree are read"),
        )),
    }
}

struct Reader<'a> {
    rest: &'a [u8],
    cells: Cells,
    /// The number of nodes so far.
    count: u64,
    min_log_odds: f32,
    colour_bytes: usize,
}

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or_else(|| {
            fail(format!(
                "the data end at node {}; the file is truncated",
                self.count
            ))
        })?;
        self.rest = rest;
        Ok(taken)
    }

    fn child_of(&mut self, cube: Cube, octant: usize) -> Result<Cube> {
        if cube.level == 0 {
            let node = self.count;
            return Err(fail(format!("node {node} lies deeper than 16 levels")));
        }
        self.count += 1;
        Ok(cube.child(octant))
    }

    /// Reads a node that has children: two bits for each child, then those of them that have children.
    fn read_binary(&mut self, cube: Cube) -> Result<()> {
        let bits = self.take(2)?;
        let bits = u16::from_le_bytes([bits[0], bits[1]]);
        let mut inner = [None; 8];
        for (octant, inner) in inner.iter_mut().enumerate() {
            match (bits >> (2 * octant)) & 3 {
                // Not known.
                0 => {}
                // Free.
                1 => drop(self.child_of(cube, octant)?),
                2 => {
                    let child = self.child_of(cube, octant)?;
                    self.cells.set_cube(child, true)?;
                }
                _ => *inner = Some(self.child_of(cube, octant)?),
            }
        }
        for child in inner.into_iter().flatten() {
            self.read_binary(child)?;
        }
        Ok(())
    }

    /// Reads a node: the logarithm of its odds, its colour, a bit for each child that it has, and these.
    fn read_full(&mut self, cube: Cube) -> Result<()> {
        let node = self.count;
        let value = self.take(4)?;
        let log_odds = f32::from_le_bytes([value[0], value[1], value[2], value[3]]);
        self.take(self.colour_bytes)?;
        let children = self.take(1)?[0];
        if log_odds.is_nan() {
            return Err(Error::new(
                ErrorKind::NotFinite,
                format!("the occupancy of node {node} is NaN"),
            ));
        }
        if children == 0 && log_odds >= self.min_log_odds {
            self.cells.set_cube(cube, true)?;
        }
        for octant in (0..8).filter(|octant| children >> octant & 1 == 1) {
            let child = self.child_of(cube, octant)?;
            self.read_full(child)?;
        }
        Ok(())
    }
}
