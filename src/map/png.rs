//! PNG pictures (ISO/IEC 15948) of 8 bits a pixel, written without compression: maps are looked at and thrown away.

use std::io::{self, Write};

use crc32fast::Hasher;

use crate::error::{Error, Result};

/// The most bytes of a stored block of a zlib stream.
const MAX_STORED: usize = 0xFFFF;
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

/// A picture, written row by row from the top.
pub(super) struct Png {
    width: usize,
    height: usize,
    sides: [i32; 2],
    colors: Colors,
}

impl Png {
    /// Of `width` by `height` pixels, neither of them 0.
    pub fn new([width, height]: [usize; 2], colors: Colors) -> Result<Self> {
        let too_large = |_| Error::invalid(format!("{width} by {height} pixels are too many"));
        Ok(Self {
            width,
            height,
            sides: [
                i32::try_from(width).map_err(too_large)?,
                i32::try_from(height).map_err(too_large)?,
            ],
            colors,
        })
    }

    /// Writes the file; `pixel` is asked by row and column.
    pub fn write(
        &self,
        file: &mut dyn Write,
        pixel: impl Fn(usize, usize) -> u8,
    ) -> io::Result<()> {
        file.write_all(b"\x89PNG\r\n\x1a\n")?;
        let sides = self.sides.iter().flat_map(|side| side.to_be_bytes());
        let mut header: Vec<u8> = sides.collect();
        // 8 bits; colours; the methods of compression, filters and interlacing.
        let kind = match self.colors {
            Colors::Gray => 0,
            Colors::Palette(_) => 3,
        };
        header.extend([8, kind, 0, 0, 0]);
        write_chunk(file, b"IHDR", &header)?;
        if let Colors::Palette(colors) = self.colors {
            write_chunk(file, b"PLTE", &colors.concat())?;
        }
        let mut stream = StoredStream::new();
        for row in 0..self.height {
            // Without a filter.
            stream.push(file, 0)?;
            for column in 0..self.width {
                stream.push(file, pixel(row, column))?;
            }
        }
        stream.end(file)?;
        write_chunk(file, b"IEND", &[])
    }
}

fn write_chunk(file: &mut dyn Write, kind: &[u8; 4], content: &[u8]) -> io::Result<()> {
    // A stored block at most.
    file.write_all(&(content.len() as u32).to_be_bytes())?;
    file.write_all(kind)?;
    file.write_all(content)?;
    let mut sum = Hasher::new();
    sum.update(kind);
    sum.update(content);
    file.write_all(&sum.finalize().to_be_bytes())
}

/// A zlib stream of stored blocks, a chunk of the picture each.
struct StoredStream {
    block: Vec<u8>,
    is_begun: bool,
    sum: Adler32,
}

impl StoredStream {
    fn new() -> Self {
        Self {
            block: Vec::with_capacity(MAX_STORED),
            is_begun: false,
            sum: Adler32 { low: 1, high: 0 },
        }
    }

    fn push(&mut self, file: &mut dyn Write, byte: u8) -> io::Result<()> {
        if self.block.len() == MAX_STORED {
            self.write_block(file, false)?;
        }
        self.block.push(byte);
        Ok(())
    }

    fn end(mut self, file: &mut dyn Write) -> io::Result<()> {
        self.write_block(file, true)
    }

    fn write_block(&mut self, file: &mut dyn Write, is_last: bool) -> io::Result<()> {
        let mut chunk = Vec::with_capacity(self.block.len() + 16);
        if !self.is_begun {
            chunk.extend([0x78, 0x01]);
            self.is_begun = true;
        }
        // At most MAX_STORED.
        let length = self.block.len() as u16;
        chunk.push(u8::from(is_last));
        chunk.extend(length.to_le_bytes());
        chunk.extend((!length).to_le_bytes());
        chunk.extend_from_slice(&self.block);
        self.sum.add(&self.block);
        self.block.clear();
        if is_last {
            chunk.extend((self.sum.high << 16 | self.sum.low).to_be_bytes());
        }
        write_chunk(file, b"IDAT", &chunk)
    }
}

/// The check sum of a zlib stream.
struct Adler32 {
    low: u32,
    high: u32,
}

impl Adler32 {
    fn add(&mut self, bytes: &[u8]) {
        for run in bytes.chunks(ADLER_RUN) {
            for &byte in run {
                self.low += u32::from(byte);
                self.high += self.low;
            }
            self.low %= ADLER;
            self.high %= ADLER;
        }
    }
}
