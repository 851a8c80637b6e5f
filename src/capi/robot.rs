//! Robots and their builders.

use std::ffi::c_char;
use std::sync::{Arc, Mutex};

use super::body::cstk_body;
use super::boundary::{Failure, guard};
use super::exclusive::exclusively;
use super::handle::{self, Noun};
use super::input::{
    OptionsStruct, Output, OutputSlice, array, index_or_none, options, pose, slice, text,
    write_defaults,
};
use super::status::cstk_status;
use crate::body::Body;
use crate::error::{Error, ErrorKind};
use crate::pose::{Pose, Vec3};
use crate::robot::{JointKind, LinkDefinition, Robot, RobotBuilder, check_configuration};

/// Collects the links of a robot.
pub struct cstk_robot_builder {
    _opaque: [u8; 0],
}

/// A tree of links. Immutable; threads may share it. It keeps the bodies of its links.
pub struct cstk_robot {
    _opaque: [u8; 0],
}

pub(super) struct Builder(Mutex<RobotBuilder>);

impl Noun for Builder {
    type Handle = cstk_robot_builder;
    const KIND: u32 = 3;
    const NAME: &'static str = "cstk_robot_builder";
}

impl Noun for Robot {
    type Handle = cstk_robot;
    const KIND: u32 = 4;
    const NAME: &'static str = "cstk_robot";
}

/// How a joint moves its link.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_joint_kind {
    /// Not at all.
    CSTK_JOINT_FIXED = 0,
    /// Turns it about the axis; the coordinate is an angle in radians.
    CSTK_JOINT_REVOLUTE = 1,
    /// Shifts it along the axis; the coordinate is a length.
    CSTK_JOINT_PRISMATIC = 2,
}

impl cstk_joint_kind {
    fn decode(value: i32) -> Option<JointKind> {
        [
            (Self::CSTK_JOINT_FIXED, JointKind::Fixed),
            (Self::CSTK_JOINT_REVOLUTE, JointKind::Revolute),
            (Self::CSTK_JOINT_PRISMATIC, JointKind::Prismatic),
        ]
        .into_iter()
        .find_map(|(code, kind)| (code as i32 == value).then_some(kind))
    }
}

/// A link to be added. Write it with cstk_link_def_default first: a fixed link without name or body at the world's origin.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_link_def {
    pub size: u32,
    pub cookie: u32,
    /// A name of its own within the robot, UTF-8; NULL for "link<number>". It is copied.
    pub name: *const c_char,
    /// The link's geometry, or NULL for a frame without any. The robot keeps a reference.
    pub body: *const cstk_body,
    /// The number of the link it is attached to, or -1 for the world.
    pub parent: i32,
    /// A cstk_joint_kind.
    pub joint: i32,
    /// The joint's frame in the parent's frame: a pose of 12 doubles. The link's frame, in which its body stands, is
    /// pose(link) = pose(parent) at motion(coordinate), and coincides with the joint's frame at coordinate 0. For the
    /// report's (x, y, z, yaw, pitch, roll) see cstk_pose_from_euler.
    pub at: [f64; 12],
    /// The joint's axis in its own frame, of any length; default z.
    pub axis: [f64; 3],
    /// Which coordinate moves the joint, or -1 for the next unused one. Joints may share a coordinate.
    pub coordinate: i32,
    pub reserved: u32,
}

// SAFETY: repr(C), no padding (8 + 16 + 8 + 96 + 24 + 8 bytes), pointers only read after checks.
unsafe impl OptionsStruct for cstk_link_def {
    const COOKIE: u32 = 0x4353_0201;
    const NAME: &'static str = "cstk_link_def";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            name: std::ptr::null(),
            body: std::ptr::null(),
            parent: -1,
            joint: 0,
            at: Pose::identity().to_row_major(),
            axis: [0.0, 0.0, 1.0],
            coordinate: -1,
            reserved: 0,
        }
    }
}

fn with_builder(
    builder: *mut cstk_robot_builder,
    action: impl FnOnce(&mut RobotBuilder) -> Result<(), Failure>,
) -> Result<(), Failure> {
    // Held for the time of the call, whatever other threads release.
    let builder = handle::share::<Builder>(builder, "builder")?;
    // Additions are made whole or not at all, so that a fault leaves the builder sound.
    exclusively(&builder.0, "the builder", |_| {}, action)
}

/// Makes an empty builder for robots of dimension 2 (planar: joints turn about z or shift along x and y) or 3.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_create(
    dimension: u32,
    out: *mut *mut cstk_robot_builder,
) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        let builder = Builder(Mutex::new(RobotBuilder::new(dimension)?));
        out.write(handle::create(Arc::new(builder)));
        Ok(())
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_retain(
    builder: *mut cstk_robot_builder,
) -> cstk_status {
    guard(|| handle::retain::<Builder>(builder, "builder"))
}

/// Drops a reference. NULL is a no-op.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_release(
    builder: *mut cstk_robot_builder,
) -> cstk_status {
    guard(|| handle::release::<Builder>(builder, "builder"))
}

/// Writes the default link. `size` is sizeof(cstk_link_def).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_link_def_default(
    out: *mut cstk_link_def,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Adds a link; parents before children. Links are numbered from 0 as they are added; the number is written to `out`,
/// which may be NULL. A free body is a chain of three prismatic and three revolute links.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_add_link(
    builder: *mut cstk_robot_builder,
    def: *const cstk_link_def,
    out: *mut u32,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let out = Output::optional(out, "out")?;
            // SAFETY: checked for size and cookie.
            let def = unsafe { options(def, "def")? };
            let kind = cstk_joint_kind::decode(def.joint).ok_or_else(|| {
                Error::invalid(format!("def->joint {} is no cstk_joint_kind", def.joint))
            })?;
            let name = if def.name.is_null() {
                ""
            } else {
                // SAFETY: the caller states that it is terminated.
                unsafe { text(def.name, "def->name")? }
            };
            let body = if def.body.is_null() {
                None
            } else {
                Some(handle::share::<Body>(def.body, "def->body")?)
            };
            let link = builder.add_link(LinkDefinition {
                name: name.to_string(),
                body,
                parent: index_or_none(def.parent, "def->parent")?,
                at: Pose::from_row_major(&def.at).map_err(|e| e.within("def->at"))?,
                kind,
                axis: Vec3::from(def.axis),
                coordinate: index_or_none(def.coordinate, "def->coordinate")?,
            })?;
            out.write(link as u32);
            Ok(())
        })
    })
}

/// Builds a robot from the links added so far; the builder is unchanged. CSTK_EMPTY if there are none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_build(
    builder: *mut cstk_robot_builder,
    out: *mut *mut cstk_robot,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let out = Output::checked(out, "out")?;
            out.write(handle::create(Arc::new(builder.build()?)));
            Ok(())
        })
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_retain(robot: *mut cstk_robot) -> cstk_status {
    guard(|| handle::retain::<Robot>(robot, "robot"))
}

/// Drops a reference. NULL is a no-op. Spaces keep the robots they use.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_release(robot: *mut cstk_robot) -> cstk_status {
    guard(|| handle::release::<Robot>(robot, "robot"))
}

/// Writes the number of coordinates (nq, which equals nv) and of links; either may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_size(
    robot: *const cstk_robot,
    nq: *mut usize,
    link_count: *mut usize,
) -> cstk_status {
    guard(|| {
        let robot = handle::borrow::<Robot>(robot, "robot")?;
        let nq = Output::optional(nq, "nq")?;
        let link_count = Output::optional(link_count, "link_count")?;
        nq.write(robot.coordinates());
        link_count.write(robot.links().len());
        Ok(())
    })
}

/// Writes the number of the link with this name. CSTK_NOT_FOUND if there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_find_link(
    robot: *const cstk_robot,
    name: *const c_char,
    out: *mut u32,
) -> cstk_status {
    guard(|| {
        let robot = handle::borrow::<Robot>(robot, "robot")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states that it is terminated.
        let name = unsafe { text(name, "name")? };
        let link = robot.find_link(name).ok_or_else(|| {
            Error::new(
                ErrorKind::NotFound,
                format!("the robot has no link \"{name}\""),
            )
        })?;
        out.write(link as u32);
        Ok(())
    })
}

/// The link poses of a robot at q, checked.
fn poses_at(robot: &Robot, q: &[f64], link: u32) -> Result<Vec<Pose>, Failure> {
    check_configuration(q, robot.coordinates())?;
    if link as usize >= robot.links().len() {
        return Err(Error::new(
            ErrorKind::NotFound,
            format!(
                "link {link} does not exist; the robot has {}",
                robot.links().len()
            ),
        )
        .into());
    }
    let mut poses = Vec::new();
    robot.link_poses(q, &mut poses);
    Ok(poses)
}

/// The pose of a link in the world at configuration q (forward kinematics, §4.2), as 12 doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_link_pose(
    robot: *const cstk_robot,
    q: *const f64,
    nq: usize,
    link: u32,
    pose: *mut f64,
) -> cstk_status {
    guard(|| {
        let robot = handle::borrow::<Robot>(robot, "robot")?;
        let out = OutputSlice::checked(pose, 12, "pose")?;
        // SAFETY: checked for NULL; the caller states the length.
        let q = unsafe { slice(q, nq, "q")? };
        let poses = poses_at(robot, q, link)?;
        out.write(&poses[link as usize].to_row_major());
        Ok(())
    })
}

/// The basic Jacobian (§4.3, eq. 33) at q of a point fixed to a link, given in the link's frame: 6 rows of nv doubles,
/// row-major; three rows of linear velocity of the point, then three of angular velocity of the link, both in the world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_jacobian(
    robot: *const cstk_robot,
    q: *const f64,
    nq: usize,
    link: u32,
    point: *const f64,
    jacobian: *mut f64,
) -> cstk_status {
    guard(|| {
        let robot = handle::borrow::<Robot>(robot, "robot")?;
        let out = OutputSlice::checked(jacobian, 6 * robot.coordinates(), "jacobian")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (q, point) = unsafe { (slice(q, nq, "q")?, array::<3>(point, "point")?) };
        crate::error::require_finite(point, "point entry")?;
        let poses = poses_at(robot, q, link)?;
        let world = poses[link as usize].transform_point(&Vec3::from(*point));
        out.write(&robot.jacobian(&poses, link as usize, &world));
        Ok(())
    })
}

/// Poses of all links, from `count` runs of 12 doubles.
pub(super) unsafe fn link_poses(
    values: *const f64,
    count: usize,
    argument: &str,
) -> Result<Vec<Pose>, Failure> {
    let numbers = count.saturating_mul(12);
    // SAFETY: as the caller states.
    let numbers = unsafe { slice(values, numbers, argument)? };
    numbers
        .chunks_exact(12)
        .enumerate()
        .map(|(i, values)| {
            // SAFETY: a slice of 12 doubles.
            unsafe { pose(values.as_ptr(), &format!("{argument}[{i}]")) }
        })
        .collect()
}
