//! PNG pictures (ISO/IEC 15948) of 8 bits a pixel, written without compression: maps are looked at and thrown away.

use crc32fast::Hasher;

use crate::error::{Error, Result};

/// The most bytes of a stored block of a zlib stream.
const MAX_STORED: usize = 0xFFFF;
/// The most bytes that a chunk is given; a PNG's may have 2^31.
const MAX_CHUNK: usize = 1 << 24;
/// Adler-32's modulus, and after how many bytes its sums must be reduced at the latest.
const ADLER: u32 = 65521;
const ADLER_RUN: usize = 5552;

/// What a byte of a picture stands for.
pub(super) enum Colors {
    /// A shade: 0 is black, 255 white.
    Gray,
    /// The number of one of these colours: red, green, blue.
    Palette(&'static [[u8; 3]]),
}

/// A picture of `width` pixels a row, from the top. `pixels` are whole rows, and not empty.
pub(super) fn png(width: usize, colors: &Colors, pixels: &[u8]) -> Result<Vec<u8>> {
    let height = pixels.len() / width;
    let too_large = |_| Error::invalid(format!("{width} by {height} pixels are too many"));
    let sides = [
        i32::try_from(width).map_err(too_large)?,
        i32::try_from(height).map_err(too_large)?,
    ];
    let mut file = Vec::new();
    file.try_reserve(pixels.len() + pixels.len() / 1000 + (1 << 12))
        .map_err(Error::memory)?;
    file.extend_from_slice(b"\x89PNG\r\n\x1a\n");
    let mut header: Vec<u8> = sides.iter().flat_map(|side| side.to_be_bytes()).collect();
    // 8 bits; colours; the methods of compression, filters and interlacing.
    let kind = match colors {
        Colors::Gray => 0,
        Colors::Palette(_) => 3,
    };
    header.extend([8, kind, 0, 0, 0]);
    push_chunk(&mut file, b"IHDR", &header);
    if let Colors::Palette(colors) = colors {
        push_chunk(&mut file, b"PLTE", &colors.concat());
    }
    let mut rows = Vec::new();
    rows.try_reserve_exact(pixels.len() + height)
        .map_err(Error::memory)?;
    for row in pixels.chunks_exact(width) {
        // Without a filter.
        rows.push(0);
        rows.extend_from_slice(row);
    }
    for part in zlib(&rows)?.chunks(MAX_CHUNK) {
        push_chunk(&mut file, b"IDAT", part);
    }
    push_chunk(&mut file, b"IEND", &[]);
    Ok(file)
}

fn push_chunk(file: &mut Vec<u8>, kind: &[u8; 4], content: &[u8]) {
    // At most MAX_CHUNK.
    file.extend_from_slice(&(content.len() as u32).to_be_bytes());
    file.extend_from_slice(kind);
    file.extend_from_slice(content);
    let mut sum = Hasher::new();
    sum.update(kind);
    sum.update(content);
    file.extend_from_slice(&sum.finalize().to_be_bytes());
}

/// A zlib stream of stored blocks.
fn zlib(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut stream = Vec::new();
    stream
        .try_reserve_exact(bytes.len() + 5 * bytes.len().div_ceil(MAX_STORED) + 6)
        .map_err(Error::memory)?;
    stream.extend_from_slice(&[0x78, 0x01]);
    let mut blocks = bytes.chunks(MAX_STORED).peekable();
    while let Some(block) = blocks.next() {
        // At most MAX_STORED.
        let length = block.len() as u16;
        stream.push(u8::from(blocks.peek().is_none()));
        stream.extend_from_slice(&length.to_le_bytes());
        stream.extend_from_slice(&(!length).to_le_bytes());
        stream.extend_from_slice(block);
    }
    stream.extend_from_slice(&adler32(bytes).to_be_bytes());
    Ok(stream)
}

fn adler32(bytes: &[u8]) -> u32 {
    let (mut low, mut high) = (1u32, 0u32);
    for run in bytes.chunks(ADLER_RUN) {
        for &byte in run {
            low += u32::from(byte);
            high += low;
        }
        low %= ADLER;
        high %= ADLER;
    }
    high << 16 | low
}
