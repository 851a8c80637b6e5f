//! A rigid pose: read, checked and inverted.

use std::cmp::Ordering;

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::lanes::{Doubles, F64x4, Instructions, Work, with_widest};
use crate::tolerance;
use crate::turn::Turn;

/// A point, vector or direction; points and lengths in the caller's unit.
pub type Vec3 = Vector3<f64>;
/// A rotation, or axes as columns.
pub type Mat3 = Matrix3<f64>;

/// A matrix this close to orthonormal is taken as a rotation without correction.
const ROTATION_ROUNDING: f64 = 8.0 * tolerance::EPSILON;

/// A rigid motion `x -> rotation x + translation`, from a child frame to its parent frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The child's axes as columns, in the parent frame.
    pub rotation: Mat3,
    /// The child's origin in the parent frame, in the caller's unit of length.
    pub translation: Vec3,
}

impl Pose {
    /// The pose whose child frame is its parent frame.
    pub const IDENTITY: Self = Self {
        rotation: Mat3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        translation: Vec3::new(0.0, 0.0, 0.0),
    };

    /// The same.
    pub fn identity() -> Self {
        Self::IDENTITY
    }

    /// A translation without rotation.
    pub fn from_translation(translation: Vec3) -> Self {
        Self {
            rotation: Mat3::identity(),
            translation,
        }
    }

    /// From 12 numbers, row-major `[R | t]`. R may be off orthonormal by [`tolerance::ROTATION`]; it is then replaced by
    /// the nearest rotation. Reflections are refused.
    #[inline(always)]
    pub fn from_row_major(values: &[f64; 12]) -> Result<Self> {
        let given = Self::as_given(values);
        // Fast path: almost all poses need no correction.
        if with_widest(IsPose(values)) {
            return Ok(given);
        }
        given.corrected(values)
    }

    /// Appends poses given in the same way; there must be room for them. Errors name the pose by its place in `argument`.
    pub fn read_row_major(
        given: &[[f64; 12]],
        argument: &str,
        poses: &mut Vec<Pose>,
    ) -> Result<()> {
        with_widest(ReadPoses {
            given,
            argument,
            poses,
        })
    }

    /// The same without a check.
    #[inline(always)]
    pub(crate) fn as_given(values: &[f64; 12]) -> Self {
        let v = values;
        Self {
            rotation: Mat3::new(v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10]),
            translation: Vec3::new(v[3], v[7], v[11]),
        }
    }

    #[cold]
    #[inline(never)]
    fn corrected(mut self, values: &[f64; 12]) -> Result<Self> {
        require_coordinates(values, "pose entry")?;
        self.rotation = nearest_rotation(self.rotation)?;
        Ok(self)
    }

    /// From a translation and a unit quaternion x, y, z, w, refused when its norm is off 1 by more than 1e-6.
    pub fn from_quaternion(translation: Vec3, xyzw: [f64; 4]) -> Result<Self> {
        let norm = xyzw.iter().map(|x| x * x).sum::<f64>().sqrt();
        // A norm that is NaN or infinite is refused here too.
        if norm.is_nan() || (norm - 1.0).abs() > tolerance::ROTATION {
            return Err(Error::new(
                ErrorKind::NotARotation,
                format!("the quaternion's norm is {norm}, not 1"),
            ));
        }
        let [x, y, z, w] = xyzw;
        let quaternion = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        let mut rotation = quaternion.to_rotation_matrix().into_inner();
        // A turn about an axis of the frame leaves that axis where it is: rounding would take it out of a planar world.
        for (k, others) in [[y, z], [z, x], [x, y]].into_iter().enumerate() {
            if others == [0.0; 2] {
                rotation[(k, k)] = 1.0;
            }
        }
        Ok(Self {
            rotation,
            translation,
        })
    }

    /// The unit quaternion x, y, z, w of the rotation; of the two, the one with w >= 0.
    pub fn to_quaternion(&self) -> [f64; 4] {
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(self.rotation);
        let unit = UnitQuaternion::from_rotation_matrix(&rotation);
        let q = unit.quaternion();
        let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
        [q.i, q.j, q.k, q.w].map(|x| x * sign)
    }

    /// An order by the numbers of the poses; zeros of either sign are equal.
    pub(crate) fn order(&self, other: &Self) -> Ordering {
        let numbers = |pose: &Self| pose.to_row_major().map(|x| x + 0.0);
        let pairs = numbers(self).into_iter().zip(numbers(other));
        pairs.fold(Ordering::Equal, |order, (a, b)| {
            order.then_with(|| a.total_cmp(&b))
        })
    }

    /// The pose as 12 numbers, row-major `[R | t]`: the inverse of [`Pose::from_row_major`].
    pub fn to_row_major(&self) -> [f64; 12] {
        let (r, t) = (&self.rotation, &self.translation);
        [
            r[(0, 0)],
            r[(0, 1)],
            r[(0, 2)],
            t.x, //
            r[(1, 0)],
            r[(1, 1)],
            r[(1, 2)],
            t.y, //
            r[(2, 0)],
            r[(2, 1)],
            r[(2, 2)],
            t.z,
        ]
    }

    /// A point of the child frame, in the parent frame.
    #[inline]
    pub fn transform_point(&self, point: &Vec3) -> Vec3 {
        turned(&self.rotation, point) + self.translation
    }

    /// The pose of the parent in the child frame.
    pub fn inverse(&self) -> Pose {
        let rotation = self.rotation.transpose();
        Pose {
            rotation,
            translation: -turned(&rotation, &self.translation),
        }
    }

    /// Whether the pose keeps the plane z = 0 and its orientation, as planar worlds need.
    pub fn is_planar(&self) -> bool {
        let r = &self.rotation;
        self.translation.z == 0.0
            && r[(2, 2)] == 1.0
            && [r[(0, 2)], r[(1, 2)], r[(2, 0)], r[(2, 1)]] == [0.0; 4]
    }
}

/// Refuses a dimension other than 2 (planar) or 3 (spatial).
pub fn check_dimension(dimension: u32) -> Result<()> {
    if dimension != 2 && dimension != 3 {
        return Err(Error::invalid(format!(
            "dimension must be 2 or 3, not {dimension}"
        )));
    }
    Ok(())
}

/// The rotation by `angle` radians about the unit vector `axis` (Rodrigues' formula).
pub fn rotation_about(axis: &Vec3, angle: f64) -> Mat3 {
    rotation_by(axis, Turn::by(angle))
}

/// The same, by the angle's sine and cosine.
pub(super) fn rotation_by(axis: &Vec3, turn: Turn) -> Mat3 {
    let (s, c) = (turn.sine, turn.cosine);
    let (v, [x, y, z]) = (1.0 - c, [axis.x, axis.y, axis.z]);
    let on_axis = |a: f64, b: f64| 1.0 - (a * a + b * b) * v;
    Mat3::new(
        on_axis(y, z),
        x * y * v - z * s,
        x * z * v + y * s,
        x * y * v + z * s,
        on_axis(x, z),
        y * z * v - x * s,
        x * z * v - y * s,
        y * z * v + x * s,
        on_axis(x, y),
    )
}

/// Whether 12 numbers are a pose, up to rounding: orthonormal columns, right-handed, and no coordinate too large. A branch-free
/// test that may reject a few valid poses; these take the slow path. For code that is compiled for an instruction set.
#[inline(always)]
pub(crate) fn is_pose<I: Instructions>(lanes: I, values: &[f64; 12]) -> bool {
    let [x, y, z] = [
        values.row(lanes, 0),
        values.row(lanes, 1),
        values.row(lanes, 2),
    ];
    let [u, v, w] = [x.rolled(), y.rolled(), z.rolled()];
    let squares = x * x + y * y + z * z;
    let products = x * u + y * v + z * w;
    let off = (squares - Doubles::splat(lanes, 1.0)).abs() + products.abs();
    let far = x.abs() + y.abs() + z.abs();
    let most = F64x4([
        ROTATION_ROUNDING,
        ROTATION_ROUNDING,
        ROTATION_ROUNDING,
        tolerance::LARGEST_COORDINATE,
    ]);
    let [a, b, c, _] = ((x * v - y * u) * w.rolled()).array().0;
    let is_right_handed = a + b + c > 0.0;
    off.ending(far).less(Doubles::load(lanes, &most)) == 0b1111 && is_right_handed
}

pub(crate) struct IsPose<'a>(pub &'a [f64; 12]);

impl Work for IsPose<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> bool {
        is_pose(lanes, self.0)
    }
}

/// Reads poses, one after the other.
struct ReadPoses<'a> {
    given: &'a [[f64; 12]],
    argument: &'a str,
    poses: &'a mut Vec<Pose>,
}

impl Work for ReadPoses<'_> {
    type Output = Result<()>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Result<()> {
        for (i, values) in self.given.iter().enumerate() {
            let pose = Pose::as_given(values);
            if is_pose(lanes, values) {
                self.poses.push(pose);
            } else {
                let corrected = pose.corrected(values);
                let name = self.argument;
                let named = corrected.map_err(|e| e.within(format_args!("{name}[{i}]")));
                self.poses.push(named?);
            }
        }
        Ok(())
    }
}

fn nearest_rotation(given: Mat3) -> Result<Mat3> {
    let error = |r: &Mat3| (r.transpose() * r - Mat3::identity()).amax();
    let off = error(&given);
    if off > tolerance::ROTATION || given.determinant() <= 0.0 {
        return Err(Error::new(
            ErrorKind::NotARotation,
            format!(
                "the 3x3 part is not a rotation: R^T R is off the identity by {off:.3e} (allowed {:e}), det R = {:.6}",
                tolerance::ROTATION,
                given.determinant()
            ),
        ));
    }
    // Newton's iteration for the orthogonal polar factor. It converges quadratically, so two steps from 1e-6 reach round-off.
    let (mut r, mut off) = (given, off);
    for _ in 0..3 {
        if off <= ROTATION_ROUNDING {
            break;
        }
        r = r * (Mat3::identity() * 1.5 - r.transpose() * r * 0.5);
        off = error(&r);
    }
    Ok(r)
}

/// A pose as its rows `[R | t]`, however it is stored.
pub(crate) trait Rows {
    /// An entry of a row; that of the fourth column is the translation's.
    fn entry(&self, row: usize, column: usize) -> f64;

    /// A row in a register.
    fn row<I: Instructions>(&self, lanes: I, row: usize) -> Doubles<I>;
}

impl Rows for Pose {
    #[inline(always)]
    fn entry(&self, row: usize, column: usize) -> f64 {
        match column {
            3 => self.translation[row],
            _ => self.rotation[(row, column)],
        }
    }

    #[inline(always)]
    fn row<I: Instructions>(&self, lanes: I, row: usize) -> Doubles<I> {
        let (r, t) = (&self.rotation, &self.translation);
        Doubles::four(lanes, &[r[(row, 0)], r[(row, 1)], r[(row, 2)], t[row]])
    }
}

/// A pose as callers give it, row-major.
impl Rows for [f64; 12] {
    #[inline(always)]
    fn entry(&self, row: usize, column: usize) -> f64 {
        self[4 * row + column]
    }

    #[inline(always)]
    fn row<I: Instructions>(&self, lanes: I, row: usize) -> Doubles<I> {
        let (rows, _) = self.as_chunks::<4>();
        Doubles::four(lanes, &rows[row])
    }
}

/// matrix * v, written out: nalgebra's general product takes several times as long.
#[inline(always)]
pub fn turned(matrix: &Mat3, v: &Vec3) -> Vec3 {
    let row = |i: usize| matrix[(i, 0)] * v.x + matrix[(i, 1)] * v.y + matrix[(i, 2)] * v.z;
    Vec3::new(row(0), row(1), row(2))
}

/// The transpose of a matrix times v, written out.
#[inline(always)]
pub fn turned_back(matrix: &Mat3, v: &Vec3) -> Vec3 {
    let column = |j: usize| matrix[(0, j)] * v.x + matrix[(1, j)] * v.y + matrix[(2, j)] * v.z;
    Vec3::new(column(0), column(1), column(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quaternions_turn_as_axes_do() {
        let (axis, angle) = (Vec3::new(0.36, 0.48, 0.8), 1.3f64);
        let v = axis * (angle / 2.0).sin();
        let xyzw = [v.x, v.y, v.z, (angle / 2.0).cos()];
        let pose = Pose::from_quaternion(Vec3::x(), xyzw).unwrap();
        assert!((pose.rotation - rotation_about(&axis, angle)).amax() < 1e-15);
        let long = xyzw.map(|x| x * 1.00001);
        let error = Pose::from_quaternion(Vec3::x(), long).unwrap_err();
        assert_eq!(error.kind, ErrorKind::NotARotation);
    }

    #[test]
    fn turns_and_shifts_are_those_of_composed_poses() {
        let frame = Pose {
            rotation: rotation_about(&Vec3::new(0.36, 0.48, 0.8), 0.4),
            translation: Vec3::new(1.0, 2.0, 3.0),
        };
        let sixth = Vec3::new(0.36, -0.8, 0.48);
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
        for axis in axes
            .into_iter()
            .flat_map(|axis| [axis, -axis])
            .chain([sixth])
        {
            // Rodrigues' formula by matrices.
            let cross = axis.cross_matrix();
            let turn =
                Mat3::identity() + cross * 1.1f64.sin() + cross * cross * (1.0 - 1.1f64.cos());
            let turned = frame.turned_about(&axis, 1.1);
            assert!((turned.rotation - frame.rotation * turn).amax() < 1e-15);
            assert_eq!(turned.translation, frame.translation);
            let shifted = frame.shifted_along(&axis, 0.7);
            let expected = frame.compose(&Pose::from_translation(axis * 0.7));
            assert!((shifted.translation - expected.translation).amax() < 1e-15);
            assert_eq!(shifted.rotation, frame.rotation);
        }
    }

    #[test]
    fn reflections_and_shears_are_refused() {
        let mut values = Pose::identity().to_row_major();
        values[0] = -1.0;
        assert_eq!(
            Pose::from_row_major(&values).unwrap_err().kind,
            ErrorKind::NotARotation
        );
        let mut values = Pose::identity().to_row_major();
        values[1] = 1e-3;
        assert_eq!(
            Pose::from_row_major(&values).unwrap_err().kind,
            ErrorKind::NotARotation
        );
        values[1] = 1e-8;
        let pose = Pose::from_row_major(&values).unwrap();
        assert!((pose.rotation.transpose() * pose.rotation - Mat3::identity()).amax() < 1e-15);
    }
}
