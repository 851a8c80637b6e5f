//! Robots of which only some joints move.

use std::sync::Arc;

use crate::capi::boundary::guard;
use crate::capi::handle;
use crate::capi::input::{Output, OutputSlice, collected, slice};
use crate::capi::robot::robot::cstk_robot;
use crate::capi::status::status::cstk_status;
use crate::error::{Error, ErrorKind};
use crate::robot::Robot;

/// Creates a robot of which only some joints move: a joint group as a robot of its own. It has the same links, by the same
/// numbers, names and bodies. `joints` holds `joint_count` numbers of links: the joints that move these, and those that
/// share a coordinate with one that is left, are left with all their coordinates; all others stand still where `q` (`nq` doubles) has them. q need not lie within limits;
/// duplicate joints count once. Coordinates and velocities that are left keep their order and are numbered anew; so are those
/// of groups and states (see cstk_robot_get_group). A space of it takes every query, gradient and motion, alone or with other
/// robots. cstk_robot_to_whole and cstk_robot_from_whole convert configurations. Without any joint the robot has no
/// coordinate. Release it with cstk_robot_release.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_create_frozen(
    robot: *const cstk_robot,
    joints: *const u32,
    joint_count: usize,
    q: *const f64,
    nq: usize,
    out: *mut *mut cstk_robot,
) -> cstk_status {
    guard(|| {
        let robot = &*handle::share::<Robot>(robot, "robot")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (joints, q) = unsafe { (slice(joints, joint_count, "joints")?, slice(q, nq, "q")?) };
        let joints = collected(joints.iter().map(|&link| link as usize), "joints")?;
        out.write(handle::create(Arc::new(robot.freeze(&joints, q)?)));
        Ok(())
    })
}

/// Writes the configuration, `whole_nq` doubles, of the robot that cstk_robot_create_frozen was given, at configuration q of
/// the robot that it made. CSTK_ERROR_EMPTY for any other robot.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_to_whole(
    robot: *const cstk_robot,
    q: *const f64,
    nq: usize,
    whole: *mut f64,
    whole_nq: usize,
) -> cstk_status {
    guard(|| {
        let robot = &*handle::share::<Robot>(robot, "robot")?;
        let out = OutputSlice::checked(whole, whole_nq, "whole")?;
        // SAFETY: checked for NULL; the caller states the length.
        let converted = robot.to_whole(unsafe { slice(q, nq, "q")? })?;
        if whole_nq != converted.len() {
            let needed = converted.len();
            let message = format!("whole has {whole_nq} entries; the whole robot has {needed}");
            return Err(Error::new(ErrorKind::WrongSize, message).into());
        }
        out.write(&converted);
        Ok(())
    })
}

/// Writes the coordinates, `nq` doubles, that are left to a robot that cstk_robot_create_frozen made, of a configuration of
/// the robot that it was made from (`whole_nq` doubles); those of frozen joints are ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_from_whole(
    robot: *const cstk_robot,
    whole: *const f64,
    whole_nq: usize,
    q: *mut f64,
    nq: usize,
) -> cstk_status {
    guard(|| {
        let robot = &*handle::share::<Robot>(robot, "robot")?;
        let out = OutputSlice::checked(q, nq, "q")?;
        // SAFETY: checked for NULL; the caller states the length.
        let converted = robot.from_whole(unsafe { slice(whole, whole_nq, "whole")? })?;
        if nq != converted.len() {
            let needed = converted.len();
            let message = format!("q has {nq} entries; the robot has {needed} coordinates");
            return Err(Error::new(ErrorKind::WrongSize, message).into());
        }
        out.write(&converted);
        Ok(())
    })
}
