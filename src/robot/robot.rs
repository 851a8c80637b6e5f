//! The ensemble of links (the report's `build-ensemble`), immutable.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::names::Names;
use super::{Block, BlockKind, Coordinate, Joint};
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::Pose;
use crate::tolerance;

/// A link: where it is attached, how it moves, and its geometry if it has any.
#[derive(Clone, Debug)]
pub struct Link {
    pub name: String,
    /// Empty for none.
    pub joint_name: String,
    pub body: Option<Arc<Body>>,
    /// The parent's index, always smaller; `None` for the world.
    pub parent: Option<usize>,
    /// The joint's frame, from the parent's frame, at coordinate 0.
    pub at: Pose,
    pub joint: Joint,
}

/// What the links' joints make of the coordinates.
#[derive(Clone, Debug, Default)]
pub(super) struct Coordinates {
    /// The range of each, unless a space says otherwise.
    pub ranges: Vec<Coordinate>,
    /// Whether a whole turn of a coordinate leaves every link where it was: whether it may be a circle.
    pub periodic: Vec<bool>,
    pub blocks: Vec<Block>,
}

impl Coordinates {
    pub fn nv(&self) -> usize {
        self.blocks
            .last()
            .map_or(0, |block| block.velocity + block.kind.nv())
    }
}

/// The links, and what finds them by name.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    pub list: Vec<Link>,
    pub names: Names,
    /// Each leads to the link that the joint moves.
    pub joint_names: Names,
}

impl Links {
    pub fn push(&mut self, link: Link) {
        let index = self.list.len();
        self.names.add(&link.name, index);
        self.joint_names.add(&link.joint_name, index);
        self.list.push(link);
    }
}

/// A robot. Links are numbered as they were added.
#[derive(Debug)]
pub struct Robot {
    serial: u64,
    dimension: u32,
    links: Links,
    coordinates: Coordinates,
}

impl Robot {
    pub(super) fn assemble(dimension: u32, links: Links, coordinates: Coordinates) -> Self {
        static NEXT_SERIAL: AtomicU64 = AtomicU64::new(1);
        Self {
            serial: NEXT_SERIAL.fetch_add(1, Ordering::Relaxed),
            dimension,
            links,
            coordinates,
        }
    }

    /// A number no other robot of this process has.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    pub fn dimension(&self) -> u32 {
        self.dimension
    }

    /// The number of coordinates of a configuration.
    pub fn nq(&self) -> usize {
        self.coordinates.ranges.len()
    }

    /// The number of velocities: that of coordinates, less one for each quaternion.
    pub fn nv(&self) -> usize {
        self.coordinates.nv()
    }

    /// The coordinates' ranges, by the joints' kinds and limits.
    pub fn ranges(&self) -> &[Coordinate] {
        &self.coordinates.ranges
    }

    /// Whether a coordinate may be a circle: a whole turn of it leaves every link where it was, or only the caller's map can
    /// know.
    pub fn is_periodic(&self, coordinate: usize) -> bool {
        self.coordinates.periodic[coordinate]
    }

    /// The coordinates in runs that move together.
    pub fn blocks(&self) -> &[Block] {
        &self.coordinates.blocks
    }

    pub fn links(&self) -> &[Link] {
        &self.links.list
    }

    pub fn find_link(&self, name: &str) -> Option<usize> {
        self.links.names.find(name)
    }

    /// The link that a joint of this name moves; joints without a name are not found.
    pub fn find_joint(&self, name: &str) -> Option<usize> {
        self.links.joint_names.find(name)
    }

    /// Refuses what would take a link of a planar robot out of its plane; only maps of the caller can.
    pub(super) fn check_motion(&self, motion: &Pose) -> Result<()> {
        if self.dimension == 2 && !motion.is_planar() {
            return Err(Error::invalid("the joint leaves the plane z = 0"));
        }
        Ok(())
    }
}

/// Refuses a configuration with the wrong number of entries, with one that is not a usable number, or with a quaternion that
/// is none.
pub fn check_configuration(q: &[f64], nq: usize, blocks: &[Block]) -> Result<()> {
    if q.len() != nq {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "the configuration has {} entries, but there are {nq} coordinates",
                q.len()
            ),
        ));
    }
    require_coordinates(q, "configuration entry")?;
    for block in blocks {
        if block.kind == BlockKind::Line {
            continue;
        }
        let end = block.coordinate + block.kind.nq();
        let norm = q[end - 4..end].iter().map(|x| x * x).sum::<f64>().sqrt();
        if (norm - 1.0).abs() > tolerance::ROTATION {
            return Err(Error::new(
                ErrorKind::NotARotation,
                format!(
                    "configuration entries {} to {} are a quaternion of norm {norm}, not 1",
                    end - 4,
                    end - 1
                ),
            ));
        }
    }
    Ok(())
}
