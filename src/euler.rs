//! The report's Euler angles (§4.1) and their rates (§4.3): yaw about Y, pitch about the new Z, roll about the new X.
//!
//! Where a printed formula of the report is wrong, the corrected one is used here, proved by a test: eq. (7) needs two-argument
//! arctangents; the inertial-frame columns of (33) and the body-frame rates of (31) do not combine as printed, so each function
//! here states the frame of its angular velocities.

use crate::error::{Error, ErrorKind, Result};
use crate::pose::{Mat3, Pose, Vec3, rotation_about};
use crate::turn::Turn;

/// Below this cos(pitch), the yaw and roll axes coincide up to rounding.
const SINGULAR: f64 = 1e-12;

/// The frame in which an angular velocity is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngularFrame {
    /// The turning body's own, as in eq. (25) to (31).
    Body,
    /// The inertial frame, as in eq. (33).
    World,
}

/// The rotation of eq. (6), body to inertial frame, from yaw, pitch and roll in radians.
pub fn euler_to_rotation([yaw, pitch, roll]: [f64; 3]) -> Mat3 {
    let (sy, cy) = Turn::by(yaw).pair();
    let (sp, cp) = Turn::by(pitch).pair();
    let (sr, cr) = Turn::by(roll).pair();
    Mat3::new(
        cp * cy,
        -cr * sp * cy + sr * sy,
        sr * sp * cy + cr * sy,
        sp,
        cr * cp,
        -sr * cp,
        -cp * sy,
        cr * sp * sy + sr * cy,
        -sr * sp * sy + cr * cy,
    )
}

/// Yaw, pitch (within a quarter turn) and roll of a rotation, eq. (7) with two-argument arctangents. Where cos(pitch) = 0
/// only yaw + roll or yaw - roll is determined; roll is then 0.
pub fn rotation_to_euler(r: &Mat3) -> [f64; 3] {
    let cos_pitch = r[(0, 0)].hypot(r[(2, 0)]);
    let pitch = r[(1, 0)].atan2(cos_pitch);
    if cos_pitch > SINGULAR {
        let yaw = (-r[(2, 0)]).atan2(r[(0, 0)]);
        // (7) has -T23 / T22, which loses digits as cos(pitch) falls. With the yaw removed first, the same angle is accurate.
        let (s, c) = Turn::by(yaw).pair();
        let roll = (s * r[(0, 1)] + c * r[(2, 1)]).atan2(s * r[(0, 2)] + c * r[(2, 2)]);
        [yaw, pitch, roll]
    } else {
        [r[(0, 2)].atan2(r[(2, 2)]), pitch, 0.0]
    }
}

/// The matrix of eq. (31): angular velocity from the rates of yaw, pitch and roll.
pub fn euler_rates([yaw, pitch, roll]: [f64; 3], frame: AngularFrame) -> Mat3 {
    let (sp, cp) = Turn::by(pitch).pair();
    match frame {
        AngularFrame::Body => {
            let (sr, cr) = Turn::by(roll).pair();
            Mat3::new(sp, 0.0, 1.0, cr * cp, sr, 0.0, -sr * cp, cr, 0.0)
        }
        // The matrix of (31), rotated by (6).
        AngularFrame::World => {
            let (sy, cy) = Turn::by(yaw).pair();
            Mat3::new(0.0, sy, cp * cy, 1.0, 0.0, sp, 0.0, cy, -cp * sy)
        }
    }
}

/// The inverse of [`euler_rates`]: rates of yaw, pitch and roll from an angular velocity. Refused where cos(pitch) = 0.
pub fn euler_rates_inverse(angles: [f64; 3], frame: AngularFrame) -> Result<Mat3> {
    let [yaw, pitch, roll] = angles;
    let (sp, cp) = Turn::by(pitch).pair();
    if cp.abs() <= SINGULAR {
        return Err(Error::new(
            ErrorKind::Degenerate,
            format!(
                "at pitch {pitch} yaw and roll turn about one axis: their rates are not determined"
            ),
        ));
    }
    let t = sp / cp;
    Ok(match frame {
        AngularFrame::Body => {
            let (sr, cr) = Turn::by(roll).pair();
            Mat3::new(0.0, cr / cp, -sr / cp, 0.0, sr, cr, 1.0, -cr * t, sr * t)
        }
        AngularFrame::World => {
            let (sy, cy) = Turn::by(yaw).pair();
            Mat3::new(-t * cy, 1.0, t * sy, sy, 0.0, cy, cy / cp, 0.0, -sy / cp)
        }
    })
}

/// Converts the basic Jacobian J_omega of a frame, 6 x n row-major with its angular rows in the inertial frame as in (33), into
/// the Jacobian J of x, y, z, yaw, pitch, roll, eq. (22)–(23). `angles` are the frame's yaw, pitch and roll. Refused where
/// cos(pitch) = 0.
pub fn basic_to_euler_jacobian(jacobian: &mut [f64], angles: [f64; 3]) -> Result<()> {
    let matrix = euler_rates_inverse(angles, AngularFrame::World)?;
    turn_angular_rows(jacobian, &matrix);
    Ok(())
}

/// The inverse of [`basic_to_euler_jacobian`]; defined everywhere.
pub fn euler_to_basic_jacobian(jacobian: &mut [f64], angles: [f64; 3]) {
    turn_angular_rows(jacobian, &euler_rates(angles, AngularFrame::World));
}

fn turn_angular_rows(jacobian: &mut [f64], matrix: &Mat3) {
    let n = jacobian.len() / 6;
    let angular = &mut jacobian[3 * n..];
    for i in 0..n {
        let turned = matrix * Vec3::new(angular[i], angular[n + i], angular[2 * n + i]);
        for row in 0..3 {
            angular[row * n + i] = turned[row];
        }
    }
}

impl Pose {
    /// From the report's `(x, y, z, yaw, pitch, roll)`, eq. (3)–(6) and (8).
    pub fn from_euler(&[x, y, z, yaw, pitch, roll]: &[f64; 6]) -> Self {
        Self {
            rotation: euler_to_rotation([yaw, pitch, roll]),
            translation: Vec3::new(x, y, z),
        }
    }

    /// From x, y, z, and URDF's angles: roll about the fixed x, then pitch about the fixed y, then yaw about the fixed z.
    pub fn from_rpy(&[x, y, z, roll, pitch, yaw]: &[f64; 6]) -> Self {
        let turn = |axis: Vec3, angle: f64| rotation_about(&axis, angle);
        Self {
            rotation: turn(Vec3::z(), yaw) * turn(Vec3::y(), pitch) * turn(Vec3::x(), roll),
            translation: Vec3::new(x, y, z),
        }
    }

    /// The inverse of [`Pose::from_euler`], with the rule of [`rotation_to_euler`] where cos(pitch) = 0.
    pub fn to_euler(&self) -> [f64; 6] {
        let [yaw, pitch, roll] = rotation_to_euler(&self.rotation);
        let t = &self.translation;
        [t.x, t.y, t.z, yaw, pitch, roll]
    }
}
