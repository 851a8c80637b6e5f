//! What is read of a URDF file, and how.

use std::path::PathBuf;

use super::link_forms::LinkForms;
use crate::error::{Error, Result};
use crate::hierarchy::HierarchyOptions;
use crate::pose::Pose;
use crate::robot::RobotBuilder;

/// Which of a link's shapes become its body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UrdfGeometry {
    /// The `collision` shapes.
    Collision,
    /// The `visual` shapes.
    Visual,
    /// None: the links have frames only.
    None,
}

/// The joint between the root link and what carries the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BaseJoint {
    /// As [`JointKind::Fixed`].
    Fixed,
    /// As [`JointKind::Planar`].
    Planar,
    /// As [`JointKind::Free`].
    Free,
    /// As [`JointKind::FreeEuler`].
    FreeEuler,
}

/// How to read a URDF file.
#[derive(Clone, Debug)]
pub struct UrdfOptions {
    /// Which shapes become bodies.
    pub geometry: UrdfGeometry,
    /// The joint of the root link.
    pub base: BaseJoint,
    /// The link of the builder that carries the robot; `None` for the world.
    pub parent: Option<usize>,
    /// Where the root's joint is, in the frame of `parent`.
    pub at: Pose,
    /// Prepended to the names of links and joints, so that a file can be loaded twice.
    pub prefix: String,
    /// Folders to search for packages; after them come the URDF file's folder and those above it, then the folders of
    /// `AMENT_PREFIX_PATH` and `ROS_PACKAGE_PATH`.
    pub search: Vec<PathBuf>,
    /// With 3 or more, spheres, cylinders and capsules become polyhedra that enclose them, their circles divided into this
    /// many sides. With 0 they stay exact.
    pub sides: usize,
    /// How the links' hierarchies are built.
    pub hierarchy: HierarchyOptions,
    /// Whether meshes are surfaces, solids or convex hulls.
    pub forms: LinkForms,
    /// A folder that caches built bodies between loads; created if it does not exist.
    pub cache_folder: Option<PathBuf>,
}

impl Default for UrdfOptions {
    fn default() -> Self {
        Self {
            geometry: UrdfGeometry::Collision,
            base: BaseJoint::Fixed,
            parent: None,
            at: Pose::identity(),
            prefix: String::new(),
            search: Vec::new(),
            sides: 0,
            hierarchy: HierarchyOptions::default(),
            forms: LinkForms::default(),
            cache_folder: None,
        }
    }
}

/// The most sides a circle is divided into.
const MAX_SIDES: usize = 1024;

/// Refuses what cannot be read by these options into this builder.
pub(super) fn check(builder: &RobotBuilder, options: &UrdfOptions) -> Result<()> {
    if builder.dimension() != 3 {
        return Err(Error::invalid(
            "a URDF robot needs a robot builder of dimension 3",
        ));
    }
    if options.sides != 0 && !(3..=MAX_SIDES).contains(&options.sides) {
        return Err(Error::invalid(format!(
            "sides is {}; 0 and 3 to {MAX_SIDES} are possible",
            options.sides
        )));
    }
    Ok(())
}
