//! Poses.
//!
//! Poses are 12 doubles, row-major [R | t]. They are converted from quaternions or from the report's Euler angles (§4.1),
//! whose rates are those of §4.3, and composed.
//!
//! ```c
//! const double above[7] = {0, 0, 0.5, 0, 0, 0, 1}; // x, y, z, and the quaternion x, y, z, w
//! double lifted[12], both[12];
//! check(cstk_pose_from_quaternion(above, lifted));
//! check(cstk_pose_compose(lifted, pose_a, both));
//! ```

use super::boundary::{Failure, guard};
use super::input::{OutputSlice, array, pose, slice};
use crate::capi::status::status::cstk_status;
use crate::error::{require_coordinates, require_finite};
use crate::euler::{
    AngularFrame, basic_to_euler_jacobian, euler_rates, euler_rates_inverse,
    euler_to_basic_jacobian, euler_to_rotation,
};
use crate::pose::{Mat3, Pose, Vec3};

/// Converts the report's placement (§4.1, eq. 3-6) to a pose. `xyz_ypr` holds x, y, z and the angles yaw (about Y), pitch
/// (about the new Z) and roll (about the new X) in radians; `pose` receives 12 doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pose_from_euler(xyz_ypr: *const f64, pose: *mut f64) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL; the header states the lengths.
        let placement = unsafe { array::<6>(xyz_ypr, "xyz_ypr")? };
        let out = OutputSlice::checked(pose, 12, "pose")?;
        require_finite(placement, "xyz_ypr entry")?;
        out.write(&Pose::from_euler(placement).to_row_major());
        Ok(())
    })
}

/// The inverse of cstk_pose_from_euler (eq. 7). Where cos(pitch) = 0 only yaw + roll or yaw - roll is determined; roll is
/// then 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pose_to_euler(pose_12: *const f64, xyz_ypr: *mut f64) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL; the header states the length.
        let given = unsafe { pose(pose_12, "pose_12")? };
        let out = OutputSlice::checked(xyz_ypr, 6, "xyz_ypr")?;
        out.write(&given.to_euler());
        Ok(())
    })
}

/// Converts a placement as URDF and ROS have it to a pose. `xyz_rpy` holds x, y, z, and roll about the fixed X, then pitch about the
/// fixed Y, then yaw about the fixed Z, in radians; `pose` receives 12 doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pose_from_rpy(xyz_rpy: *const f64, pose: *mut f64) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL; the header states the lengths.
        let placement = unsafe { array::<6>(xyz_rpy, "xyz_rpy")? };
        let out = OutputSlice::checked(pose, 12, "pose")?;
        require_finite(placement, "xyz_rpy entry")?;
        out.write(&Pose::from_rpy(placement).to_row_major());
        Ok(())
    })
}

/// Converts a translation and a unit quaternion to a pose. `xyz_quaternion` holds x, y, z of the translation and x, y, z, w
/// of the quaternion, whose norm must be 1 to within 1e-6; `pose` receives 12 doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pose_from_quaternion(
    xyz_quaternion: *const f64,
    pose: *mut f64,
) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL; the header states the length.
        let given = unsafe { array::<7>(xyz_quaternion, "xyz_quaternion")? };
        let out = OutputSlice::checked(pose, 12, "pose")?;
        require_finite(given, "xyz_quaternion entry")?;
        let [x, y, z, quaternion @ ..] = *given;
        let made = Pose::from_quaternion(Vec3::new(x, y, z), quaternion)
            .map_err(|e| e.within("xyz_quaternion"))?;
        out.write(&made.to_row_major());
        Ok(())
    })
}

/// Composes poses: if `a` places frame 1 in frame 0 and `b` places frame 2 in frame 1, `out` places frame 2 in frame 0. All
/// are 12 doubles; `out` may be `a` or `b`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pose_compose(
    a: *const f64,
    b: *const f64,
    out: *mut f64,
) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL; the header states the lengths.
        let (a, b) = unsafe { (pose(a, "a")?, pose(b, "b")?) };
        let out = OutputSlice::checked(out, 12, "out")?;
        out.write(&a.compose(&b).to_row_major());
        Ok(())
    })
}

/// Inverts a pose (eq. 10): if `pose_12` places frame 1 in frame 0, `out` places frame 0 in frame 1. 12 doubles each; both
/// may be the same.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pose_inverse(pose_12: *const f64, out: *mut f64) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL; the header states the lengths.
        let given = unsafe { pose(pose_12, "pose_12")? };
        let out = OutputSlice::checked(out, 12, "out")?;
        out.write(&given.inverse().to_row_major());
        Ok(())
    })
}

/// Transforms a point from the child frame to the parent frame (eq. 8): `out` = R `point` + t. 3 doubles each; both may be
/// the same.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pose_transform_point(
    pose_12: *const f64,
    point: *const f64,
    out: *mut f64,
) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL; the header states the lengths.
        let (given, point) = unsafe { (pose(pose_12, "pose_12")?, array::<3>(point, "point")?) };
        let out = OutputSlice::checked(out, 3, "out")?;
        require_coordinates(point, "point entry")?;
        out.write(given.transform_point(&Vec3::from(*point)).as_slice());
        Ok(())
    })
}

/// The inverse of cstk_pose_from_quaternion; of the two quaternions of a rotation it writes the one with w >= 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pose_to_quaternion(
    pose_12: *const f64,
    xyz_quaternion: *mut f64,
) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL; the header states the length.
        let given = unsafe { pose(pose_12, "pose_12")? };
        let out = OutputSlice::checked(xyz_quaternion, 7, "xyz_quaternion")?;
        let t = given.translation;
        let [x, y, z, w] = given.to_quaternion();
        out.write(&[t.x, t.y, t.z, x, y, z, w]);
        Ok(())
    })
}

/// Converts yaw, pitch and roll (radians; §4.1, eq. 6) to a rotation matrix of 9 doubles, row-major.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_euler_to_rotation(
    yaw_pitch_roll: *const f64,
    rotation: *mut f64,
) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL; the header states the length.
        let angles = unsafe { array::<3>(yaw_pitch_roll, "yaw_pitch_roll")? };
        let out = OutputSlice::checked(rotation, 9, "rotation")?;
        require_finite(angles, "yaw_pitch_roll entry")?;
        out.write(&row_major(&euler_to_rotation(*angles)));
        Ok(())
    })
}

/// The inverse of cstk_euler_to_rotation (eq. 7). Where cos(pitch) = 0 it chooses roll 0, as cstk_pose_to_euler does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_euler_from_rotation(
    rotation: *const f64,
    yaw_pitch_roll: *mut f64,
) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL; the header states the length.
        let r = unsafe { array::<9>(rotation, "rotation")? };
        let out = OutputSlice::checked(yaw_pitch_roll, 3, "yaw_pitch_roll")?;
        let values = [
            r[0], r[1], r[2], 0.0, r[3], r[4], r[5], 0.0, r[6], r[7], r[8], 0.0,
        ];
        let pose = Pose::from_row_major(&values).map_err(|e| e.within("rotation"))?;
        out.write(&pose.to_euler()[3..]);
        Ok(())
    })
}

/// The frame in which an angular velocity is written.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_angular_frame {
    /// The inertial frame, as in eq. (33) and everywhere else in this header.
    CSTK_ANGULAR_WORLD = 0,
    /// The rotating body's own, as in eq. (25) to (31).
    CSTK_ANGULAR_BODY = 1,
}

impl cstk_angular_frame {
    fn decode(value: i32) -> Result<AngularFrame, Failure> {
        match value {
            0 => Ok(AngularFrame::World),
            1 => Ok(AngularFrame::Body),
            _ => Err(Failure::new(
                cstk_status::CSTK_ERROR_INVALID_ARGUMENT,
                format!("frame {value} is no cstk_angular_frame"),
            )),
        }
    }
}

/// Writes the matrix of eq. (31), 9 doubles, row-major, which maps the rates of yaw, pitch and roll to an angular velocity.
/// `frame` is a cstk_angular_frame. The report prints the matrix for the body's frame, but uses it with the inertial
/// columns of (33), which only the inertial form fits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_euler_rates(
    yaw_pitch_roll: *const f64,
    frame: i32,
    matrix: *mut f64,
) -> cstk_status {
    // SAFETY: checked for NULL; the header states the length.
    guard(|| unsafe {
        rates(yaw_pitch_roll, frame, matrix, |angles, frame| {
            Ok(euler_rates(angles, frame))
        })
    })
}

/// Writes the inverse of the matrix of cstk_euler_rates: maps an angular velocity to the rates of yaw, pitch and roll.
/// CSTK_ERROR_DEGENERATE where cos(pitch) = 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_euler_rates_inverse(
    yaw_pitch_roll: *const f64,
    frame: i32,
    matrix: *mut f64,
) -> cstk_status {
    // SAFETY: checked for NULL; the header states the length.
    guard(|| unsafe { rates(yaw_pitch_roll, frame, matrix, euler_rates_inverse) })
}

unsafe fn rates(
    yaw_pitch_roll: *const f64,
    frame: i32,
    matrix: *mut f64,
    rates: impl Fn([f64; 3], AngularFrame) -> crate::error::Result<Mat3>,
) -> Result<(), Failure> {
    // SAFETY: as the caller states.
    let angles = unsafe { array::<3>(yaw_pitch_roll, "yaw_pitch_roll")? };
    let out = OutputSlice::checked(matrix, 9, "matrix")?;
    require_finite(angles, "yaw_pitch_roll entry")?;
    let frame = cstk_angular_frame::decode(frame)?;
    out.write(&row_major(&rates(*angles, frame)?));
    Ok(())
}

/// Converts a basic Jacobian, as cstk_robot_jacobian writes it (eq. 33), to the Jacobian of x, y, z, yaw, pitch, roll (eq.
/// 22, 23), in place: 6 rows of `nv` doubles. `yaw_pitch_roll` are the link's, see cstk_pose_to_euler.
/// CSTK_ERROR_DEGENERATE where cos(pitch) = 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_jacobian_to_euler(
    yaw_pitch_roll: *const f64,
    jacobian: *mut f64,
    nv: usize,
) -> cstk_status {
    guard(|| {
        // SAFETY: as below.
        unsafe {
            convert_jacobian(yaw_pitch_roll, jacobian, nv, |matrix, angles| {
                Ok(basic_to_euler_jacobian(matrix, angles)?)
            })
        }
    })
}

/// The inverse of cstk_jacobian_to_euler; defined everywhere.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_jacobian_from_euler(
    yaw_pitch_roll: *const f64,
    jacobian: *mut f64,
    nv: usize,
) -> cstk_status {
    guard(|| {
        // SAFETY: as below.
        unsafe {
            convert_jacobian(yaw_pitch_roll, jacobian, nv, |matrix, angles| {
                euler_to_basic_jacobian(matrix, angles);
                Ok(())
            })
        }
    })
}

unsafe fn convert_jacobian(
    yaw_pitch_roll: *const f64,
    jacobian: *mut f64,
    nv: usize,
    convert: impl FnOnce(&mut [f64], [f64; 3]) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let entries = nv.saturating_mul(6);
    // SAFETY: checked for NULL; the caller states the lengths.
    let (angles, given) = unsafe {
        (
            array::<3>(yaw_pitch_roll, "yaw_pitch_roll")?,
            slice(jacobian.cast_const(), entries, "jacobian")?,
        )
    };
    require_finite(angles, "yaw_pitch_roll entry")?;
    require_coordinates(given, "jacobian entry")?;
    let out = OutputSlice::checked(jacobian, entries, "jacobian")?;
    let mut matrix = given.to_vec();
    convert(&mut matrix, *angles)?;
    out.write(&matrix);
    Ok(())
}

fn row_major(matrix: &Mat3) -> [f64; 9] {
    let mut values = [0.0; 9];
    values.copy_from_slice(matrix.transpose().as_slice());
    values
}
