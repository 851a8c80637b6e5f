//! The words of a scene file, read one by one, with failures that name the line.

use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::{Pose, Vec3};
use crate::whole_file::line_of;

/// How far the norm of a written quaternion may be off 1: three digits are.
const MAX_NORM_ERROR: f64 = 1e-2;

/// The text that is left to read.
pub struct Words<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Words<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { text, at: 0 }
    }

    /// The rest of the line, without white space around it.
    pub fn rest_of_line(&mut self) -> &'a str {
        let rest = &self.text[self.at..];
        let length = rest.find('\n').unwrap_or(rest.len());
        self.at += (length + 1).min(rest.len());
        rest[..length].trim()
    }

    /// The next line that is not empty, without reading on.
    pub fn next_line(&self) -> &'a str {
        let mut lines = self.text[self.at..].lines().map(str::trim);
        lines.find(|line| !line.is_empty()).unwrap_or_default()
    }

    /// The next word; `what` is what should stand there.
    pub fn word(&mut self, what: &str) -> Result<&'a str> {
        let rest = &self.text[self.at..];
        let start = self.at + rest.len() - rest.trim_ascii_start().len();
        let length = self.text[start..]
            .find(|c: char| c.is_ascii_whitespace())
            .unwrap_or(self.text.len() - start);
        if length == 0 {
            self.at = start;
            return Err(self.fault(
                ErrorKind::Parse,
                format!("the file ends where {what} should stand"),
            ));
        }
        self.at = start + length;
        Ok(&self.text[start..self.at])
    }

    pub fn count(&mut self, what: &str) -> Result<u64> {
        let word = self.word(what)?;
        word.parse().map_err(|_| {
            self.fault(
                ErrorKind::Parse,
                format!("\"{word}\" is no count: {what} should stand here"),
            )
        })
    }

    pub fn numbers<const N: usize>(&mut self, what: &str) -> Result<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            let word = self.word(what)?;
            *number = word.parse().map_err(|_| {
                self.fault(
                    ErrorKind::Parse,
                    format!("\"{word}\" is no number: {what} should stand here"),
                )
            })?;
            require_coordinates(&[*number], "number")
                .map_err(|e| self.fault(e.kind, format!("{what}: {}", e.message)))?;
        }
        Ok(numbers)
    }

    /// x, y, z, and a quaternion x, y, z, w.
    pub fn pose(&mut self, what: &str) -> Result<Pose> {
        let [x, y, z, quaternion @ ..] = self.numbers::<7>(what)?;
        let norm = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (norm - 1.0).abs() > MAX_NORM_ERROR {
            let message = format!("{what}: the quaternion's norm is {norm}, not 1");
            return Err(self.fault(ErrorKind::NotARotation, message));
        }
        let quaternion: [f64; 4] = quaternion.map(|x| x / norm);
        Pose::from_quaternion(Vec3::new(x, y, z), quaternion)
    }

    /// An error at the word that was read last.
    pub fn fault(&self, kind: ErrorKind, message: impl std::fmt::Display) -> Error {
        let last = self.at.saturating_sub(1);
        let line = line_of(self.text.as_bytes(), last);
        Error::new(kind, format!("line {line}: {message}"))
    }
}
