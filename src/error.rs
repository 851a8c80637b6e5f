//! The errors of the library: a kind for programs, and a message for people that names the culprit.

use std::fmt;

use crate::tolerance;

/// What went wrong. The C layer maps each kind to one status number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// An argument has a value outside its documented range.
    InvalidArgument,
    /// A number is NaN or infinite where a finite one is needed.
    NotFinite,
    /// An array or structure has the wrong number of entries.
    WrongSize,
    /// Nothing was given where at least one item is needed.
    Empty,
    /// Geometry without extent: a repeated vertex, a polygon without area.
    Degenerate,
    /// A polygon that turns inwards or winds more than once.
    NotConvex,
    /// A polygon whose vertices leave its plane.
    NotPlanar,
    /// A body was declared solid whose surface has open edges, or one side only.
    NotClosed,
    /// A matrix that is not a rotation, or an axis that is not a direction.
    NotARotation,
    /// An id, index or name that does not exist.
    NotFound,
    /// A combination that the library does not compute.
    Unsupported,
    /// An operating-system failure while reading or writing a file.
    Io,
    /// A file whose contents cannot be understood.
    Parse,
    /// A computation that could not be certified.
    NotConverged,
    /// The caller's progress function asked to stop.
    Cancelled,
    /// A function of the caller's failed.
    Callback,
    /// The object is in use by another thread, or by the call this one is made from.
    Busy,
    /// The call needs more work than its limit allows.
    Limit,
    /// There is not enough memory for what the input asks for.
    OutOfMemory,
    /// A certificate does not prove what is asked.
    NotProved,
    /// A fault of the library itself, which was contained.
    Internal,
}

/// A failure: its kind and the sentence that names the culprit.
#[derive(Clone, Debug)]
pub struct Error {
    /// What kind of failure it is, for programs.
    pub kind: ErrorKind,
    /// One sentence for people that names the culprit.
    pub message: String,
}

impl Error {
    /// An error of this kind with this message.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Self {
            kind,
            message: message.into(),
        }
    }

    /// An [`ErrorKind::InvalidArgument`] with this message.
    pub fn invalid(message: impl Into<String>) -> Self {
        Self::new(ErrorKind::InvalidArgument, message)
    }

    /// A failure of the operating system.
    pub fn io(error: std::io::Error) -> Self {
        let kind = match error.kind() {
            std::io::ErrorKind::OutOfMemory => ErrorKind::OutOfMemory,
            _ => ErrorKind::Io,
        };
        Self::new(kind, error.to_string())
    }

    /// Memory that could not be reserved.
    pub fn memory(error: std::collections::TryReserveError) -> Self {
        Self::new(ErrorKind::OutOfMemory, error.to_string())
    }

    /// Puts the culprit's container in front: `polygon 3: vertex 2 is NaN`.
    pub fn within(mut self, container: impl fmt::Display) -> Self {
        self.message = format!("{container}: {}", self.message);
        self
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

/// A result whose failure is an [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// Refuses a NaN or infinite coordinate, naming its place as `what index`.
pub fn require_finite(values: &[f64], what: &str) -> Result<()> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(i) => Err(Error::new(
            ErrorKind::NotFinite,
            format!("{what} {i} is {}", values[i]),
        )),
    }
}

/// Refuses a number that is not finite, or beyond [`tolerance::LARGEST_COORDINATE`], naming its place as `what index`.
pub fn require_coordinates(values: &[f64], what: &str) -> Result<()> {
    // Not a number is no less than anything.
    let are_usable = |usable, value: &f64| usable & (value.abs() <= tolerance::LARGEST_COORDINATE);
    if values.iter().fold(true, are_usable) {
        return Ok(());
    }
    require_finite(values, what)?;
    let is_too_large = |value: &f64| value.abs() > tolerance::LARGEST_COORDINATE;
    match values.iter().position(is_too_large) {
        None => Ok(()),
        Some(i) => Err(Error::invalid(format!(
            "{what} {i} is too large: {:e}",
            values[i]
        ))),
    }
}
