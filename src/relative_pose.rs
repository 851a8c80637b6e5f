//! The pose of one centred body in the frame of another.

use crate::lanes::{Doubles, Instructions, Work, along64, with_widest};
use crate::pose::{Mat3, Pose, Rows, Vec3, column, turned};

/// A pose whose origin is at a point of its frame.
#[inline(always)]
pub(crate) fn centered(pose: &impl Rows, center: &Vec3) -> Pose {
    let entry = |i: usize, j: usize| pose.entry(i, j);
    let rotation = Mat3::new(
        entry(0, 0),
        entry(0, 1),
        entry(0, 2),
        entry(1, 0),
        entry(1, 1),
        entry(1, 2),
        entry(2, 0),
        entry(2, 1),
        entry(2, 2),
    );
    let origin = Vec3::new(entry(0, 3), entry(1, 3), entry(2, 3));
    Pose {
        rotation,
        translation: turned(&rotation, center) + origin,
    }
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

/// The same of poses that are stored in any way, within code that is compiled for an instruction set.
#[inline(always)]
pub(crate) fn relative_of<I: Instructions, P: Rows>(
    lanes: I,
    poses: [&P; 2],
    centers: [&Vec3; 2],
) -> Pose {
    Relative { poses, centers }.run(lanes)
}

struct Relative<'a, P> {
    poses: [&'a P; 2],
    centers: [&'a Vec3; 2],
}

impl<P: Rows> Relative<'_, P> {
    /// From the centre of A to that of B, in the world.
    #[inline(always)]
    fn apart<I: Instructions>(&self, lanes: I) -> [f64; 3] {
        let [a, b] = self.poses;
        let [is_a_centered, is_b_centered] = self.centers.map(|center| *center == Vec3::zeros());
        // Fast path for centres at the bodies' origins, as of most single shapes: to the last bit what the sum below would be.
        if is_a_centered && is_b_centered {
            let (at_a, at_b) = (column(lanes, a, 3), column(lanes, b, 3));
            // No -0, as no sum of the two has.
            let apart = at_b - at_a + Doubles::splat(lanes, 0.0);
            let [x, y, z, _] = apart.array().0;
            return [x, y, z];
        }
        let mut sum = TwoFold::new(lanes, column(lanes, b, 3));
        sum.add(column(lanes, a, 3) * -1.0);
        if !is_b_centered {
            for j in 0..3 {
                sum.add_product(column(lanes, b, j), self.centers[1][j]);
            }
        }
        if !is_a_centered {
            for j in 0..3 {
                sum.add_product(column(lanes, a, j), -self.centers[0][j]);
            }
        }
        let [x, y, z, _] = sum.value().array().0;
        [x, y, z]
    }
}

impl<P: Rows> Work for Relative<'_, P> {
    type Output = Pose;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Pose {
        let [a, b] = self.poses;
        let apart = self.apart(lanes);
        // The transpose of A's rotation turns the axes of B and the vector between the centres into A's frame. The fourth lanes
        // mean nothing.
        let rows = [a.row(lanes, 0), a.row(lanes, 1), a.row(lanes, 2)];
        let x = along64(&rows, &[b.entry(0, 0), b.entry(1, 0), b.entry(2, 0)]);
        let y = along64(&rows, &[b.entry(0, 1), b.entry(1, 1), b.entry(2, 1)]);
        let z = along64(&rows, &[b.entry(0, 2), b.entry(1, 2), b.entry(2, 2)]);
        let t = along64(&rows, &apart);
        let ([x, y, z], t) = ([x.array().0, y.array().0, z.array().0], t.array().0);
        Pose {
            rotation: Mat3::new(x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]),
            translation: Vec3::new(t[0], t[1], t[2]),
        }
    }
}

/// Double-double sums, after Dekker (1971) and Knuth's TwoSum.
struct TwoFold<I: Instructions> {
    high: Doubles<I>,
    low: Doubles<I>,
}

impl<I: Instructions> TwoFold<I> {
    #[inline(always)]
    fn new(lanes: I, value: Doubles<I>) -> Self {
        Self {
            high: value,
            low: Doubles::splat(lanes, 0.0),
        }
    }

    #[inline(always)]
    fn add(&mut self, x: Doubles<I>) {
        let sum = self.high + x;
        let part = sum - self.high;
        self.low = self.low + ((self.high - (sum - part)) + (x - part));
        self.high = sum;
    }

    #[inline(always)]
    fn add_product(&mut self, x: Doubles<I>, y: f64) {
        let product = x * y;
        self.add(product);
        self.low = self.low + x.product_error(x.splatted(y), product);
    }

    #[inline(always)]
    fn value(&self) -> Doubles<I> {
        self.high + self.low
    }
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;
    use crate::lanes::{Plain, with_each};
    use crate::pose::{IsPose, rotation_about};

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
    fn centres_at_one_place_are_nothing_apart() {
        let (a, mut b) = (Pose::identity(), Pose::identity());
        b.translation = Vec3::new(-0.0, 0.0, -0.0);
        let centers = [&Vec3::zeros(), &Vec3::zeros()];
        let poses = [&a, &b];
        let apart = Relative { poses, centers }.apart(Plain);
        assert!(apart.iter().all(|x| *x == 0.0 && x.is_sign_positive()));
    }

    #[test]
    fn every_instruction_set_sees_the_same_poses() {
        let mut random = Random::new(9);
        let mut next = || random.within(-1.0, 1.0);
        let (mut accepted, mut rejected) = (0, 0);
        for case in 0..4000 {
            let mut pose = || {
                let axis = Vec3::new(next(), next(), next()).normalize();
                let far = [1.0, 1e3, 1e9][case % 3];
                Pose {
                    rotation: rotation_about(&axis, 3.0 * next()),
                    translation: Vec3::new(next(), next(), next()) * far,
                }
            };
            let poses = [pose(), pose()];
            let mut rows = poses.map(|pose| pose.to_row_major());
            let centers = [0.0, 1.0].map(|far| Vec3::new(next(), next(), next()) * far);
            let centers = [&centers[case % 2], &centers[case / 2 % 2]];
            let widest = relative_centered(&poses[0], centers[0], &poses[1], centers[1]);
            let of_poses = with_each(|| Relative {
                poses: [&poses[0], &poses[1]],
                centers,
            });
            let of_rows = with_each(|| Relative {
                poses: [&rows[0], &rows[1]],
                centers,
            });
            let mut all = of_poses.iter().chain(&of_rows);
            assert!(all.all(|found| *found == widest), "{case}");
            // Some spoilt by little, some by much, some by what is no number.
            let spoilt = [0.0, 1e-15, 1e-8, 1.0, f64::NAN, f64::INFINITY][case % 6];
            rows[0][case / 6 % 12] += spoilt;
            let found = with_each(|| IsPose(&rows[0]));
            let is_one = found[0];
            assert!(found.iter().all(|other| *other == is_one), "{case}");
            assert!(!is_one || Pose::from_row_major(&rows[0]).is_ok());
            rejected += usize::from(!is_one && spoilt == 0.0);
            accepted += usize::from(is_one);
        }
        // What is off by a few roundings may be rejected: it takes the slow path.
        assert!(accepted > 1000 && rejected < 40, "{accepted} {rejected}");
    }
}
