//! Rigid motions and paths.

use crate::point::{Point, between, minus, norm, unit};

/// A rigid motion: the rows of `[R|t]`, 12 doubles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose(pub [f64; 12]);

impl Pose {
    /// The motion that moves nothing.
    pub fn identity() -> Pose {
        Pose::translation([0.0; 3])
    }

    /// The translation by `t`.
    pub fn translation([x, y, z]: Point) -> Pose {
        Pose([1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, y, 0.0, 0.0, 1.0, z])
    }

    /// The rotation by `angle` radians, right-handed, about the line through the origin along `axis` (any length but
    /// 0).
    pub fn rotation(axis: Point, angle: f64) -> Pose {
        let [x, y, z] = unit(axis);
        let (s, c) = angle.sin_cos();
        let d = 1.0 - c;
        Pose([
            c + x * x * d,
            x * y * d - z * s,
            x * z * d + y * s,
            0.0,
            y * x * d + z * s,
            c + y * y * d,
            y * z * d - x * s,
            0.0,
            z * x * d - y * s,
            z * y * d + x * s,
            c + z * z * d,
            0.0,
        ])
    }

    /// The motion that does `first` and then `self`.
    pub fn compose(&self, first: &Pose) -> Pose {
        let mut product = [0.0; 12];
        for (row, out) in product.chunks_exact_mut(4).enumerate() {
            for (column, entry) in out.iter_mut().enumerate() {
                let own = &self.0[4 * row..4 * row + 4];
                let rotated: f64 = (0..3).map(|k| own[k] * first.0[4 * k + column]).sum();
                *entry = if column == 3 {
                    rotated + own[3]
                } else {
                    rotated
                };
            }
        }
        Pose(product)
    }

    /// Where `p` goes.
    pub fn apply(&self, p: Point) -> Point {
        std::array::from_fn(|row| {
            let m = &self.0[4 * row..4 * row + 4];
            m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3]
        })
    }

    /// The translation part.
    pub(crate) fn offset(&self) -> Point {
        [self.0[3], self.0[7], self.0[11]]
    }

    /// Whether the rotation part is exactly the identity.
    pub(crate) fn is_translation(&self) -> bool {
        Pose::translation(self.offset()) == *self
    }
}

/// `count` translations along the polyline through `waypoints`, equally far apart along it, both ends included.
pub(crate) fn polyline(waypoints: &[Point], count: usize) -> Vec<Pose> {
    let lengths: Vec<f64> = waypoints
        .windows(2)
        .map(|leg| norm(minus(leg[1], leg[0])))
        .collect();
    let total: f64 = lengths.iter().sum();
    let at = |step: usize| {
        let mut rest = total * step as f64 / (count - 1) as f64;
        let mut leg = 0;
        while leg + 1 < lengths.len() && rest > lengths[leg] {
            rest -= lengths[leg];
            leg += 1;
        }
        let share = (rest / lengths[leg]).min(1.0);
        Pose::translation(between(waypoints[leg], waypoints[leg + 1], share))
    };
    (0..count).map(at).collect()
}

/// `count` translations from waypoint to waypoint, each leg in the same time, slowing to rest at every waypoint.
pub(crate) fn stop_and_go(waypoints: &[Point], count: usize) -> Vec<Pose> {
    let legs = waypoints.len() - 1;
    let at = |step: usize| {
        let time = (legs * step) as f64 / (count - 1) as f64;
        let leg = (time as usize).min(legs - 1);
        let share = time - leg as f64;
        let eased = share * share * (3.0 - 2.0 * share);
        Pose::translation(between(waypoints[leg], waypoints[leg + 1], eased))
    };
    (0..count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: Point, b: Point) -> bool {
        norm(minus(a, b)) < 1e-15
    }

    #[test]
    fn a_quarter_turn_about_z_takes_x_to_y() {
        let turn = Pose::rotation([0.0, 0.0, 3.0], std::f64::consts::FRAC_PI_2);
        assert!(near(turn.apply([1.0, 0.0, 0.5]), [0.0, 1.0, 0.5]));
    }

    #[test]
    fn compose_does_the_argument_first() {
        let turn = Pose::rotation([1.0, 2.0, 3.0], 0.7);
        let shift = Pose::translation([0.1, -0.2, 0.3]);
        let p = [0.3, 0.5, -0.4];
        let both = turn.compose(&shift);
        assert!(near(both.apply(p), turn.apply(shift.apply(p))));
    }

    #[test]
    fn paths_begin_and_end_where_they_should() {
        let waypoints = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 3.0, 0.0]];
        for path in [polyline(&waypoints, 9), stop_and_go(&waypoints, 9)] {
            assert_eq!(path.len(), 9);
            assert_eq!(path[0].offset(), waypoints[0]);
            assert_eq!(path[8].offset(), waypoints[2]);
        }
        assert_eq!(polyline(&waypoints, 9)[2].offset(), waypoints[1]);
        assert_eq!(stop_and_go(&waypoints, 9)[4].offset(), waypoints[1]);
    }
}
