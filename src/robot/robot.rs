//! The ensemble of links (the report's `build-ensemble`), immutable.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::names::Names;
use super::whole::Whole;
use super::{Block, BlockKind, Coordinate, Joint, JointKind, Semantics};
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::Pose;
use crate::tolerance;

/// A link: where it is attached, how it moves, and its geometry if it has any.
#[derive(Clone, Debug)]
pub struct Link {
    /// Unique within the robot.
    pub name: String,
    /// Unique within the robot, or empty.
    pub joint_name: String,
    /// The geometry, in the link's frame; `None` for a link that only carries others.
    pub body: Option<Arc<Body>>,
    /// The parent's index, always smaller; `None` for the world.
    pub parent: Option<usize>,
    /// The joint's frame, from the parent's frame, at coordinate 0.
    pub at: Pose,
    /// The joint that moves the link relative to `at`.
    pub joint: Joint,
}

/// The coordinates of a robot, as its joints define them.
#[derive(Clone, Debug, Default)]
pub(super) struct Coordinates {
    /// The range of each; a space may override it.
    pub ranges: Vec<Coordinate>,
    /// Whether a coordinate may be a circle: a whole turn leaves every link where it was.
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

/// The links, with indices by name.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    pub list: Vec<Link>,
    pub names: Names,
    /// Maps a joint's name to the link that it moves.
    pub joint_names: Names,
    /// Those with revolute joints.
    turning: Vec<usize>,
}

impl Links {
    pub fn push(&mut self, link: Link) {
        let index = self.list.len();
        self.names.add(&link.name, index);
        self.joint_names.add(&link.joint_name, index);
        if matches!(link.joint.kind, JointKind::Revolute) {
            self.turning.push(index);
        }
        self.list.push(link);
    }
}

/// A robot: links and their joints. Links are numbered in the order in which they were added. Threads may share it.
#[derive(Debug)]
pub struct Robot {
    serial: u64,
    dimension: u32,
    links: Links,
    coordinates: Coordinates,
    semantics: Semantics,
    /// Of a robot with frozen joints.
    whole: Option<Whole>,
}

impl Robot {
    pub(super) fn assemble(
        dimension: u32,
        links: Links,
        coordinates: Coordinates,
        semantics: Semantics,
    ) -> Self {
        static NEXT_SERIAL: AtomicU64 = AtomicU64::new(1);
        Self {
            serial: NEXT_SERIAL.fetch_add(1, Ordering::Relaxed),
            dimension,
            links,
            coordinates,
            semantics,
            whole: None,
        }
    }

    pub(super) fn set_whole(&mut self, whole: Whole) {
        self.whole = Some(whole);
    }

    pub(super) fn whole(&self) -> Option<&Whole> {
        self.whole.as_ref()
    }

    /// What SRDF files say of the robot.
    pub fn semantics(&self) -> &Semantics {
        &self.semantics
    }

    /// A number that no other robot of this process has.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    /// 2 for a planar robot, 3 for a spatial one.
    pub fn dimension(&self) -> u32 {
        self.dimension
    }

    /// The number of coordinates of a configuration.
    pub fn nq(&self) -> usize {
        self.coordinates.ranges.len()
    }

    /// The number of velocities: one fewer than coordinates for each quaternion.
    pub fn nv(&self) -> usize {
        self.coordinates.nv()
    }

    /// The coordinates' ranges, from the joints' kinds and limits.
    pub fn ranges(&self) -> &[Coordinate] {
        &self.coordinates.ranges
    }

    /// Whether a coordinate may be a circle: a whole turn of it leaves every link where it was. True for custom joints,
    /// where only the caller can know.
    pub fn is_periodic(&self, coordinate: usize) -> bool {
        self.coordinates.periodic[coordinate]
    }

    /// The blocks of coordinates that move together.
    pub fn blocks(&self) -> &[Block] {
        &self.coordinates.blocks
    }

    /// All links, parents before children.
    pub fn links(&self) -> &[Link] {
        &self.links.list
    }

    /// The links with revolute joints.
    pub(super) fn turning_links(&self) -> &[usize] {
        &self.links.turning
    }

    /// The number of the link with this name.
    pub fn find_link(&self, name: &str) -> Option<usize> {
        self.links.names.find(name)
    }

    /// The number of the link that the joint with this name moves; joints without a name are not found.
    pub fn find_joint(&self, name: &str) -> Option<usize> {
        self.links.joint_names.find(name)
    }

    /// Refuses a joint motion that takes a link of a planar robot out of its plane; only custom joints can.
    pub(super) fn check_motion(&self, motion: &Pose) -> Result<()> {
        if self.dimension == 2 && !motion.is_planar() {
            return Err(Error::invalid("the joint leaves the plane z = 0"));
        }
        Ok(())
    }
}

/// Refuses a configuration that has the wrong number of entries, an entry that is not a usable number, or a quaternion that
/// is not of unit length.
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
    if blocks.len() == nq {
        // Lines alone: other blocks have several coordinates.
        return Ok(());
    }
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
