//! Robots: their links and joints, forward kinematics and Jacobians.

use std::ffi::c_char;

use crate::capi::body::body::cstk_body;
use crate::capi::boundary::{Failure, guard};
use crate::capi::handle;
use crate::capi::handle::Noun;
use crate::capi::input::{Output, OutputSlice, array, slice, text};
use crate::capi::robot::joint::cstk_joint_kind;
use crate::capi::status::status::cstk_status;
use crate::error::{Error, ErrorKind, require_coordinates};
use crate::pose::{Pose, Vec3};
use crate::robot::{Link, Robot, RobotState, check_configuration};

/// A tree of links. Immutable; threads may share it. It keeps references to the bodies of its links.
pub struct cstk_robot {
    _opaque: [u8; 0],
}

impl Noun for Robot {
    type Handle = cstk_robot;
    const KIND: u32 = 4;
    const NAME: &'static str = "cstk_robot";
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_retain(robot: *mut cstk_robot) -> cstk_status {
    guard(|| handle::retain::<Robot>(robot, "robot"))
}

/// Drops a reference. NULL is a no-op. Spaces hold references to their robots.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_release(robot: *mut cstk_robot) -> cstk_status {
    guard(|| handle::release::<Robot>(robot, "robot"))
}

/// Writes the number of coordinates (nq), of velocities (nv; one fewer for each quaternion) and of links; each output may
/// be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_get_size(
    robot: *const cstk_robot,
    nq: *mut usize,
    nv: *mut usize,
    link_count: *mut usize,
) -> cstk_status {
    guard(|| {
        let robot = &*handle::share::<Robot>(robot, "robot")?;
        let nq = Output::optional(nq, "nq")?;
        let nv = Output::optional(nv, "nv")?;
        let link_count = Output::optional(link_count, "link_count")?;
        nq.write(robot.nq());
        nv.write(robot.nv());
        link_count.write(robot.links().len());
        Ok(())
    })
}

/// Writes the number of the link with this name. CSTK_ERROR_NOT_FOUND if there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_find_link(
    robot: *const cstk_robot,
    name: *const c_char,
    out: *mut u32,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states that it is terminated.
    guard(|| unsafe { find(robot, name, out, "link", Robot::find_link) })
}

/// Writes the number of the link that the joint with this name moves. CSTK_ERROR_NOT_FOUND if there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_find_joint(
    robot: *const cstk_robot,
    name: *const c_char,
    out: *mut u32,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states that it is terminated.
    guard(|| unsafe { find(robot, name, out, "joint", Robot::find_joint) })
}

unsafe fn find(
    robot: *const cstk_robot,
    name: *const c_char,
    out: *mut u32,
    what: &str,
    find: impl Fn(&Robot, &str) -> Option<usize>,
) -> Result<(), Failure> {
    let robot = &*handle::share::<Robot>(robot, "robot")?;
    let out = Output::checked(out, "out")?;
    // SAFETY: as the caller states.
    let name = unsafe { text(name, "name")? };
    let link = find(robot, name).ok_or_else(|| {
        let message = format!("the robot has no {what} \"{name}\"");
        Error::new(ErrorKind::NotFound, message)
    })?;
    out.write(link as u32);
    Ok(())
}

/// A link of a robot and the joint that moves it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_link_info {
    /// The parent link, or -1 for the world.
    pub parent: i32,
    pub joint: cstk_joint_kind,
    /// The joint has `nq` coordinates from `coordinate` on and `nv` velocities from `velocity` on, by their index in the
    /// robot.
    pub coordinate: u32,
    pub nq: u32,
    pub velocity: u32,
    pub nv: u32,
    pub has_body: bool,
    pub reserved_bytes: [u8; 7],
    /// See cstk_link_def.
    pub multiplier: f64,
    pub offset: f64,
    pub at: [f64; 12],
    pub axis: [f64; 3],
    pub reserved: [u64; 8],
}

/// Describes a link and its joint. CSTK_ERROR_NOT_FOUND for a link that the robot does not have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_get_link_info(
    robot: *const cstk_robot,
    link: u32,
    out: *mut cstk_link_info,
) -> cstk_status {
    guard(|| {
        let robot = &*handle::share::<Robot>(robot, "robot")?;
        let out = Output::checked(out, "out")?;
        let link = link_of(robot, link)?;
        let joint = &link.joint;
        out.write(cstk_link_info {
            parent: link.parent.map_or(-1, |parent| parent as i32),
            joint: cstk_joint_kind::of(&joint.kind),
            coordinate: joint.coordinate as u32,
            nq: joint.kind.nq() as u32,
            velocity: joint.velocity as u32,
            nv: joint.kind.nv() as u32,
            has_body: link.body.is_some(),
            reserved_bytes: [0; 7],
            multiplier: joint.multiplier,
            offset: joint.offset,
            at: link.at.to_row_major(),
            axis: joint.axis.into(),
            reserved: [0; 8],
        });
        Ok(())
    })
}

/// Writes the body of a link, with a reference that the caller must release. CSTK_ERROR_EMPTY if the link has none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_get_body(
    robot: *const cstk_robot,
    link: u32,
    out: *mut *mut cstk_body,
) -> cstk_status {
    guard(|| {
        let robot = &*handle::share::<Robot>(robot, "robot")?;
        let out = Output::checked(out, "out")?;
        let found = link_of(robot, link)?;
        let body = found.body.clone().ok_or_else(|| {
            let message = format!("link {link} (\"{}\") has no body", found.name);
            Error::new(ErrorKind::Empty, message)
        })?;
        out.write(handle::create(body));
        Ok(())
    })
}

/// Writes a link's name, NUL-terminated, into a buffer of `capacity` bytes, and the name's length without the terminator to
/// `length`, which may be NULL. With a NULL buffer of capacity 0 only the length is written. CSTK_ERROR_WRONG_SIZE if the
/// name does not fit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_get_link_name(
    robot: *const cstk_robot,
    link: u32,
    buffer: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> cstk_status {
    guard(|| {
        let robot = &*handle::share::<Robot>(robot, "robot")?;
        write_text(&link_of(robot, link)?.name, buffer, capacity, length)
    })
}

/// Writes the name of the joint that moves a link, "" if it has none; arguments as for cstk_robot_get_link_name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_get_joint_name(
    robot: *const cstk_robot,
    link: u32,
    buffer: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> cstk_status {
    guard(|| {
        let robot = &*handle::share::<Robot>(robot, "robot")?;
        write_text(&link_of(robot, link)?.joint_name, buffer, capacity, length)
    })
}

pub(crate) fn write_text(
    text: &str,
    buffer: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> Result<(), Failure> {
    let length = Output::optional(length, "length")?;
    if buffer.is_null() && capacity == 0 {
        length.write(text.len());
        return Ok(());
    }
    let out = OutputSlice::checked(buffer.cast::<u8>(), capacity, "buffer")?;
    if text.len() >= capacity {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "the name takes {} bytes with its terminator, the buffer has {capacity}",
                text.len() + 1
            ),
        )
        .into());
    }
    out.write(&[text.as_bytes(), b"\0"].concat());
    length.write(text.len());
    Ok(())
}

fn link_of(robot: &Robot, link: u32) -> Result<&Link, Failure> {
    robot.links().get(link as usize).ok_or_else(|| {
        Error::new(
            ErrorKind::NotFound,
            format!(
                "link {link} does not exist; the robot has {}",
                robot.links().len()
            ),
        )
        .into()
    })
}

/// The link poses of a robot at q, checked.
fn poses_at(robot: &Robot, q: &[f64], link: u32) -> Result<Vec<Pose>, Failure> {
    check_configuration(q, robot.nq(), robot.blocks())?;
    link_of(robot, link)?;
    Ok(robot.link_poses(q)?)
}

/// Writes the pose of a link in the world at configuration q (`nq` doubles; forward kinematics, §4.2), as 12 doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_link_pose(
    robot: *const cstk_robot,
    q: *const f64,
    nq: usize,
    link: u32,
    pose: *mut f64,
) -> cstk_status {
    guard(|| {
        let robot = &*handle::share::<Robot>(robot, "robot")?;
        let out = OutputSlice::checked(pose, 12, "pose")?;
        // SAFETY: checked for NULL; the caller states the length.
        let q = unsafe { slice(q, nq, "q")? };
        let poses = poses_at(robot, q, link)?;
        out.write(&poses[link as usize].to_row_major());
        Ok(())
    })
}

/// Writes the basic Jacobian (§4.3, eq. 33) at q of a point fixed to a link; `point` is given in the link's frame. 6 rows
/// of nv doubles, row-major: three rows of linear velocity of the point, then three of angular velocity of the link, both
/// in the world.
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
        let robot = &*handle::share::<Robot>(robot, "robot")?;
        let out = OutputSlice::checked(jacobian, 6 * robot.nv(), "jacobian")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (q, point) = unsafe { (slice(q, nq, "q")?, array::<3>(point, "point")?) };
        require_coordinates(point, "point entry")?;
        let poses = poses_at(robot, q, link)?;
        let world = poses[link as usize].transform_point(&Vec3::from(*point));
        let state = RobotState { q, poses: &poses };
        out.write(&robot.jacobian(state, link as usize, &world)?);
        Ok(())
    })
}

/// Reads `count` poses of 12 doubles each, into memory that is reused.
pub(crate) unsafe fn read_poses(
    values: *const f64,
    count: usize,
    argument: &str,
    poses: &mut Vec<Pose>,
) -> Result<(), Failure> {
    let numbers = count.saturating_mul(12);
    // SAFETY: as the caller states.
    let numbers = unsafe { slice(values, numbers, argument)? };
    poses.clear();
    let room = poses.try_reserve(count);
    room.map_err(|e| Error::memory(e).within(argument))?;
    let (twelves, _) = numbers.as_chunks::<12>();
    Ok(Pose::read_row_major(twelves, argument, poses)?)
}
