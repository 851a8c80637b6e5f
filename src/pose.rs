//! Rigid poses as homogeneous transforms, §4.1 eq. (8)–(11), and the relative pose of two bodies.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::lanes::{F64x4, Instructions, Work, along64, each3, with_widest};
use crate::tolerance;

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
        if are_poses([values]) {
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
        Ok(Self {
            rotation: quaternion.to_rotation_matrix().into_inner(),
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

    /// The product self * child: the pose of the child's child in this pose's parent frame.
    #[inline(always)]
    pub fn compose(&self, child: &Pose) -> Pose {
        let moved = turned64(&self.rotation, &child.translation) + lanes_of(&self.translation);
        Pose {
            rotation: turned_axes(&self.rotation, &child.rotation),
            translation: Vec3::new(moved.0[0], moved.0[1], moved.0[2]),
        }
    }

    /// The pose after a turn by `angle` radians about a unit axis of its own frame.
    #[inline(always)]
    pub fn turned_about(&self, axis: &Vec3, angle: f64) -> Pose {
        let rotation = match [axis.x, axis.y, axis.z].map(f64::abs) {
            [0.0, 0.0, 1.0] => turned_about_axis::<2>(&self.rotation, angle * axis.z),
            [0.0, 1.0, 0.0] => turned_about_axis::<1>(&self.rotation, angle * axis.y),
            [1.0, 0.0, 0.0] => turned_about_axis::<0>(&self.rotation, angle * axis.x),
            _ => turned_axes(&self.rotation, &rotation_about(axis, angle)),
        };
        Pose { rotation, ..*self }
    }

    /// The pose after a shift along a unit axis of its own frame.
    #[inline(always)]
    pub fn shifted_along(&self, axis: &Vec3, length: f64) -> Pose {
        Pose {
            translation: self.translation + turned(&self.rotation, axis) * length,
            ..*self
        }
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
    let (s, c) = angle.sin_cos();
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

/// Whether each 12 numbers are a pose, up to rounding: orthonormal columns, right-handed, and no coordinate too large. A
/// branch-free test that may reject a few valid poses; these take the slow path.
#[inline(always)]
pub(crate) fn are_poses<const N: usize>(rows: [&[f64; 12]; N]) -> bool {
    with_widest(ArePoses(rows))
}

struct ArePoses<'a, const N: usize>([&'a [f64; 12]; N]);

impl<const N: usize> Work for ArePoses<'_, N> {
    type Output = bool;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> bool {
        // A loop, for `Iterator::fold` is not always inlined.
        let mut all = true;
        for values in self.0 {
            all &= Self::is_pose(values);
        }
        all
    }
}

impl<const N: usize> ArePoses<'_, N> {
    #[inline(always)]
    fn is_pose(values: &[f64; 12]) -> bool {
        let (rows, _) = values.as_chunks::<4>();
        let rows = [rows[0], rows[1], rows[2]];
        let [x, y, z] = rows.map(F64x4);
        let [u, v, w] = rows.map(|[a, b, c, d]| F64x4([b, c, a, d]));
        let squares = x * x + y * y + z * z;
        let products = x * u + y * v + z * w;
        let off = (squares - F64x4::splat(1.0)).abs() + products.abs();
        let across = x * v - y * u;
        let z = rows[2];
        let determinant = across.0[0] * z[2] + across.0[1] * z[0] + across.0[2] * z[1];
        let far = rows[0][3].abs() + rows[1][3].abs() + rows[2][3].abs();
        let is_small = |k: usize| off.0[k] <= ROTATION_ROUNDING;
        is_small(0)
            & is_small(1)
            & is_small(2)
            & (determinant > 0.0)
            & (far <= tolerance::LARGEST_COORDINATE)
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
    fn run<I: Instructions>(self, _: I) -> Result<()> {
        for (i, values) in self.given.iter().enumerate() {
            let pose = Pose::as_given(values);
            if ArePoses::<1>::is_pose(values) {
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

/// The pose of B's frame centred at `center_b`, in A's frame centred at `center_a`.
///
/// The difference of the centres in the world is summed in double-double arithmetic: bodies far from the world's origin, or
/// modelled far from their own, would otherwise lose the significant digits.
#[inline(always)]
pub fn relative_centered(a: &Pose, center_a: &Vec3, b: &Pose, center_b: &Vec3) -> Pose {
    with_widest(Relative {
        poses: [a, b],
        centers: [center_a, center_b],
    })
}

struct Relative<'a> {
    poses: [&'a Pose; 2],
    centers: [&'a Vec3; 2],
}

impl Work for Relative<'_> {
    type Output = Pose;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Pose {
        let [a, b] = self.poses;
        let column = |pose: &Pose, j: usize| column64(&pose.rotation, j);
        let mut sum = TwoFold::new(lanes_of(&b.translation));
        sum.add(-lanes_of(&a.translation));
        // Fast path for centres at the bodies' origins, as of most single shapes.
        if *self.centers[1] != Vec3::zeros() {
            for j in 0..3 {
                sum.add_product(lanes, column(b, j), self.centers[1][j]);
            }
        }
        if *self.centers[0] != Vec3::zeros() {
            for j in 0..3 {
                sum.add_product(lanes, column(a, j), -self.centers[0][j]);
            }
        }
        let apart = sum.value().0;
        // The axes of B and the vector between the centres, both rotated into A's frame.
        let in_world = each3(|k| {
            let r = &b.rotation;
            F64x4([r[(k, 0)], r[(k, 1)], r[(k, 2)], apart[k]])
        });
        let [x, y, z] = each3(|i| {
            let axis = each3(|k| a.rotation[(k, i)]);
            along64(&in_world, &axis).0
        });
        Pose {
            rotation: Mat3::new(x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]),
            translation: Vec3::new(x[3], y[3], z[3]),
        }
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

/// matrix * axes, a column at a time.
#[inline(always)]
pub fn turned_axes(matrix: &Mat3, axes: &Mat3) -> Mat3 {
    of_columns(each3(|j| {
        let axis = Vec3::new(axes[(0, j)], axes[(1, j)], axes[(2, j)]);
        turned64(matrix, &axis)
    }))
}

/// A rotation after a turn about one of its own axes, the case of most joints: only two columns change.
#[inline(always)]
fn turned_about_axis<const AXIS: usize>(rotation: &Mat3, angle: f64) -> Mat3 {
    let (sine, cosine) = angle.sin_cos();
    let [i, j] = [(AXIS + 1) % 3, (AXIS + 2) % 3];
    let mut columns = each3(|k| column64(rotation, k));
    let (x, y) = (columns[i], columns[j]);
    columns[i] = x * cosine + y * sine;
    columns[j] = y * cosine - x * sine;
    of_columns(columns)
}

/// matrix * v, as [`turned`] has it, to the last bit; the fourth lane is 0.
#[inline(always)]
fn turned64(matrix: &Mat3, v: &Vec3) -> F64x4 {
    along64(&each3(|k| column64(matrix, k)), &[v.x, v.y, v.z])
}

#[inline(always)]
fn column64(matrix: &Mat3, k: usize) -> F64x4 {
    F64x4([matrix[(0, k)], matrix[(1, k)], matrix[(2, k)], 0.0])
}

#[inline(always)]
fn lanes_of(v: &Vec3) -> F64x4 {
    F64x4([v.x, v.y, v.z, 0.0])
}

#[inline(always)]
fn of_columns([x, y, z]: [F64x4; 3]) -> Mat3 {
    let ([x, y, z], [a, b, c]) = ([x.0, y.0, z.0], [0, 1, 2]);
    Mat3::new(x[a], y[a], z[a], x[b], y[b], z[b], x[c], y[c], z[c])
}

/// Double-double sums, after Dekker (1971) and Knuth's TwoSum.
struct TwoFold {
    high: F64x4,
    low: F64x4,
}

impl TwoFold {
    #[inline(always)]
    fn new(value: F64x4) -> Self {
        Self {
            high: value,
            low: F64x4::splat(0.0),
        }
    }

    #[inline(always)]
    fn add(&mut self, x: F64x4) {
        let sum = self.high + x;
        let part = sum - self.high;
        self.low = self.low + ((self.high - (sum - part)) + (x - part));
        self.high = sum;
    }

    #[inline(always)]
    fn add_product<I: Instructions>(&mut self, lanes: I, x: F64x4, y: f64) {
        let y = F64x4::splat(y);
        let product = x * y;
        self.add(product);
        self.low = self.low + lanes.product_error(x, y, product);
    }

    #[inline(always)]
    fn value(&self) -> F64x4 {
        self.high + self.low
    }
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
    fn relative_pose_keeps_its_digits_far_from_the_origin() {
        // Two bodies modelled around (1e9, 0, 0), turned alike, whose centres are 1e-6 apart.
        let center = Vec3::new(1e9, 1e9, 0.0);
        let rotation = rotation_about(&Vec3::new(0.6, 0.0, 0.8), 0.7);
        let a = Pose {
            rotation,
            translation: Vec3::zeros(),
        };
        let b = Pose {
            rotation,
            translation: Vec3::new(1e-6, 0.0, 0.0),
        };
        let relative = relative_centered(&a, &center, &b, &center);
        assert!((relative.translation.norm() - 1e-6).abs() < 1e-20);
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
