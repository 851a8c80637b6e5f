//! Poses and the report's Euler angles.

use super::boundary::guard;
use super::input::{OutputSlice, array, pose};
use super::status::cstk_status;
use crate::error::require_finite;
use crate::pose::{Mat3, Pose, Vec3, euler_to_rotation};

/// Converts a placement of the report (§4.1, eq. 3-6) to a pose: `xyz_ypr` holds x, y, z and the angles yaw (about Y),
/// pitch (about the new Z) and roll (about the new X) in radians; `pose` receives 12 doubles.
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
/// then given as 0.
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

/// Converts a translation and a unit quaternion to a pose: `xyz_quaternion` holds x, y, z of the translation and x, y, z, w
/// of the quaternion, whose norm may be off 1 by 1e-6; `pose` receives 12 doubles.
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

/// The pose `a` then `b`: if `a` places frame 1 in frame 0 and `b` places frame 2 in frame 1, `out` places frame 2 in
/// frame 0. All are 12 doubles; `out` may be `a` or `b`.
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

/// Converts yaw, pitch and roll (radians; §4.1, eq. 6) to a rotation of 9 doubles, row-major.
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
        let matrix: Mat3 = euler_to_rotation(angles[0], angles[1], angles[2]);
        out.write(matrix.transpose().as_slice());
        Ok(())
    })
}

/// The inverse of cstk_euler_to_rotation (eq. 7), with the same rule where cos(pitch) = 0 as cstk_pose_to_euler.
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
