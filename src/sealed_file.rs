//! Binary files: a header with the kind, the version and checksums, then the content; and their numbers, written and read one by
//! one. docs/body-file.md and docs/certificate-file.md describe those that there are.

use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;
use crate::tolerance;

/// The bytes before the content.
pub const HEADER_BYTES: usize = 32;

/// A kind of file.
pub struct FileFormat {
    /// How the files begin.
    pub magic: [u8; 8],
    /// Other versions are refused.
    pub version: u32,
    /// What messages call such a file, with its article.
    pub name: &'static str,
}

impl FileFormat {
    /// The file with this content.
    pub fn seal(&self, mut content: Vec<u8>) -> Vec<u8> {
        let mut bytes = Writer::default();
        bytes.0.extend(self.magic);
        bytes.u32(self.version);
        bytes.u32(HEADER_BYTES as u32);
        bytes.count(content.len());
        bytes.u32(crc32fast::hash(&content));
        bytes.u32(crc32fast::hash(&bytes.0));
        bytes.0.append(&mut content);
        bytes.0
    }

    /// Reads the content after the header, if the file is complete, undamaged and of this version.
    pub fn open<'a>(&self, bytes: &'a [u8]) -> Result<Reader<'a>> {
        let fail = |message: String| Err(Error::new(ErrorKind::Parse, message));
        let Some((header, payload)) = bytes.split_at_checked(HEADER_BYTES) else {
            return fail(if self.magic.starts_with(&bytes[..bytes.len().min(8)]) {
                format!("the file is truncated: {} bytes", bytes.len())
            } else {
                format!("the file is no {} of libcstk", self.name)
            });
        };
        if header[..8] != self.magic {
            return fail(format!("the file is no {} of libcstk", self.name));
        }
        let mut fields = Reader {
            payload: &header[8..],
            place: 8,
        };
        let (version, header_bytes) = (fields.u32()?, fields.u32()?);
        let (length, sum, header_sum) = (fields.u64()?, fields.u32()?, fields.u32()?);
        // Before the checksum: a newer version may have another header.
        if version != self.version {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!(
                    "the file has format version {version}; this library reads {}",
                    self.version
                ),
            ));
        }
        if header_sum != crc32fast::hash(&header[..28]) || header_bytes as usize != HEADER_BYTES {
            return fail("the file's header is damaged".into());
        }
        if (payload.len() as u64) < length {
            return fail(format!(
                "the file is truncated: {} of {length} bytes follow the header",
                payload.len()
            ));
        }
        if payload.len() as u64 > length {
            return fail(format!(
                "the file is damaged: {} bytes follow the header instead of {length}",
                payload.len()
            ));
        }
        if sum != crc32fast::hash(payload) {
            return fail("the file is damaged: its checksum does not match".into());
        }
        Ok(Reader {
            payload,
            place: HEADER_BYTES,
        })
    }
}

/// Writes numbers, little-endian.
#[derive(Default)]
pub struct Writer(pub Vec<u8>);

impl Writer {
    pub fn u32(&mut self, value: u32) {
        self.0.extend(value.to_le_bytes());
    }

    pub fn u64(&mut self, value: u64) {
        self.0.extend(value.to_le_bytes());
    }

    pub fn f64(&mut self, value: f64) {
        self.0.extend(value.to_le_bytes());
    }

    pub fn count(&mut self, value: usize) {
        self.u64(value as u64);
    }

    pub fn vector(&mut self, vector: &Vec3) {
        self.numbers(vector.as_slice());
    }

    pub fn numbers(&mut self, values: &[f64]) {
        for &value in values {
            self.f64(value);
        }
    }
}

/// Reads a payload that passed its checksum. Its content is still not trusted.
pub struct Reader<'a> {
    pub payload: &'a [u8],
    /// The offset of the rest in the file, for messages.
    pub place: usize,
}

impl Reader<'_> {
    pub fn damaged(&self, what: &str) -> Error {
        Error::new(
            ErrorKind::Parse,
            format!("{what} cannot be right (before byte {})", self.place),
        )
    }

    pub fn take<const N: usize>(&mut self) -> Result<[u8; N]> {
        let (taken, rest) = self
            .payload
            .split_first_chunk::<N>()
            .ok_or_else(|| self.damaged("the length of the content"))?;
        self.payload = rest;
        self.place += N;
        Ok(*taken)
    }

    pub fn u32(&mut self) -> Result<u32> {
        Ok(u32::from_le_bytes(self.take()?))
    }

    pub fn u64(&mut self) -> Result<u64> {
        Ok(u64::from_le_bytes(self.take()?))
    }

    pub fn f64(&mut self) -> Result<f64> {
        let value = f64::from_le_bytes(self.take()?);
        if value.is_finite() && value.abs() <= 4.0 * tolerance::LARGEST_COORDINATE {
            Ok(value)
        } else {
            Err(self.damaged("a number"))
        }
    }

    pub fn length(&mut self) -> Result<f64> {
        let value = self.f64()?;
        if value >= 0.0 {
            Ok(value)
        } else {
            Err(self.damaged("a length"))
        }
    }

    pub fn vector(&mut self) -> Result<Vec3> {
        Ok(Vec3::new(self.f64()?, self.f64()?, self.f64()?))
    }

    /// Checks a count of items of at least `bytes` bytes each against the rest of the file, which bounds the memory needed.
    pub fn fitting(&self, count: u64, bytes: usize) -> Result<usize> {
        usize::try_from(count)
            .ok()
            .filter(|&count| count <= self.payload.len() / bytes)
            .ok_or_else(|| self.damaged("a count"))
    }

    pub fn count(&mut self, bytes: usize) -> Result<usize> {
        let count = self.u64()?;
        self.fitting(count, bytes)
    }

    pub fn short_count(&mut self, bytes: usize) -> Result<usize> {
        let count = self.u32()?;
        self.fitting(count.into(), bytes)
    }

    pub fn index(&mut self, below: usize) -> Result<u32> {
        let index = self.u32()?;
        if (index as usize) < below {
            Ok(index)
        } else {
            Err(self.damaged("an index"))
        }
    }

    pub fn flag(&mut self) -> Result<bool> {
        match self.u32()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(self.damaged("a flag")),
        }
    }

    /// Refuses content after the last number.
    pub fn end(&self) -> Result<()> {
        if self.payload.is_empty() {
            Ok(())
        } else {
            Err(self.damaged("the end: more follows"))
        }
    }
}
