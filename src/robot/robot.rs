//! The ensemble of links (the report's `build-ensemble`), immutable.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::Joint;
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::pose::Pose;
use crate::tolerance;

/// A link: where it is attached, how it moves, and its geometry if it has any.
#[derive(Clone, Debug)]
pub struct Link {
    pub name: String,
    pub body: Option<Arc<Body>>,
    /// The parent's index, always smaller; `None` for the world.
    pub parent: Option<usize>,
    /// The joint's frame, from the parent's frame, at coordinate 0.
    pub at: Pose,
    pub joint: Joint,
}

/// A robot. Links are numbered as they were added.
#[derive(Debug)]
pub struct Robot {
    serial: u64,
    dimension: u32,
    coordinates: usize,
    links: Vec<Link>,
}

impl Robot {
    pub(super) fn assemble(dimension: u32, coordinates: usize, links: Vec<Link>) -> Self {
        static NEXT_SERIAL: AtomicU64 = AtomicU64::new(1);
        Self {
            serial: NEXT_SERIAL.fetch_add(1, Ordering::Relaxed),
            dimension,
            coordinates,
            links,
        }
    }

    /// A number no other robot of this process has.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    pub fn dimension(&self) -> u32 {
        self.dimension
    }

    /// The number of coordinates, nq = nv.
    pub fn coordinates(&self) -> usize {
        self.coordinates
    }

    pub fn links(&self) -> &[Link] {
        &self.links
    }

    pub fn find_link(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|link| link.name == name)
    }
}

/// Refuses a configuration with the wrong number of entries, or with one that is not a usable number.
pub fn check_configuration(q: &[f64], coordinates: usize) -> Result<()> {
    if q.len() != coordinates {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "the configuration has {} entries, but there are {coordinates} coordinates",
                q.len()
            ),
        ));
    }
    require_finite(q, "configuration entry")?;
    match q
        .iter()
        .position(|x| x.abs() > tolerance::LARGEST_COORDINATE)
    {
        Some(i) => Err(Error::invalid(format!(
            "configuration entry {i} is too large: {}",
            q[i]
        ))),
        None => Ok(()),
    }
}
