//! How far, how fast and with what acceleration a point moves that links carry: bounds for the whole motion, from the joints alone.
//!
//! A motion goes from q0 with the constant velocity v for a unit of time, so every joint places its link by z = R y + p, with the link's
//! point y, a rotation R that turns at a rate of at most w, and a shift p that moves at a speed of at most l. Where v twists the link in
//! its own frame (free joints), p' = R v has the derivative R (w x v); in all other joints p' is constant: |p''| <= w l holds for
//! all. A turn at a constant rate has |R'| <= w and |R''| <= w^2; so has the product of three turns whose rates sum up to w.
//! Therefore, with bounds of |y|, |y'| and |y''|,
//!
//! |z| <= |y| + |p|,  |z'| <= w |y| + |y'| + l,  |z''| <= w^2 |y| + 2 w |y'| + |y''| + w l.
//!
//! The other way, from what carries the link into the link, y = R^T u with u = z - p, whose derivatives exceed those of z by those
//! of p, and the same for R^T. Frames that are fixed to one another add a length to |y| alone.

use super::statement::Carried;
use crate::nonzero::length;
use crate::pose::Vec3;
use crate::robot::{JointKind, Link};
use crate::space::Space;
use crate::tolerance::{DISTANCE_ERROR, EPSILON, SUM_SLACK};

/// The motion that a certificate is about.
pub(super) struct Course<'a> {
    pub space: &'a Space,
    pub q0: &'a [f64],
    pub v: Vec<f64>,
}

/// Bounds of a point, seen from a frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointBounds {
    /// Of its distance from the frame's origin.
    pub distance: f64,
    pub speed: f64,
    pub acceleration: f64,
}

/// What a joint does in the whole motion.
struct JointCourse {
    /// The largest rate of its turn, in radians.
    turn: f64,
    /// The largest speed of its shift, a length.
    shift: f64,
    /// A bound of the length of its shift.
    away: f64,
    /// The largest angle of a turn that is computed from a coordinate.
    angle: f64,
    /// Of a custom joint that moves, only speeds are known.
    has_acceleration: bool,
}

impl PointBounds {
    /// Of a point that rests this far from the frame's origin.
    fn at_rest(distance: f64) -> Self {
        Self {
            distance,
            speed: 0.0,
            acceleration: 0.0,
        }
    }

    /// From the link's frame to that of its joint.
    fn leave(&mut self, joint: &JointCourse) {
        self.turn(joint);
        self.shift(joint);
    }

    /// From the joint's frame to that of its link.
    fn enter(&mut self, joint: &JointCourse) {
        self.shift(joint);
        self.turn(joint);
    }

    fn turn(&mut self, joint: &JointCourse) {
        let w = joint.turn;
        self.acceleration += w * w * self.distance + 2.0 * w * self.speed;
        self.speed += w * self.distance;
        if !joint.has_acceleration {
            self.acceleration = f64::INFINITY;
        }
    }

    fn shift(&mut self, joint: &JointCourse) {
        self.acceleration += joint.turn * joint.shift;
        self.speed += joint.shift;
        self.distance += joint.away;
    }

    /// How far a point may be from the line between its two places `time` apart, at the time in between: |x''| t^2 / 8, and, as
    /// it is nearer in time to one of its places, |x'| t / 2 from that.
    pub fn displacement(&self, time: f64) -> f64 {
        if self.speed == 0.0 {
            return 0.0;
        }
        (0.125 * time * time * self.acceleration).min(0.5 * time * self.speed) * SUM_SLACK
    }
}

impl Course<'_> {
    /// Bounds, for all of the motion, of points that a link carries, or for `None` the world, as seen from another link: only the
    /// joints between the two count. `radius` gives the largest distance of the points from a point in the frame of what carries
    /// them.
    pub fn seen_from(
        &self,
        from: Option<usize>,
        link: Option<usize>,
        radius: impl Fn(&Vec3) -> f64,
    ) -> PointBounds {
        let mut inner = self.carriers(link);
        let mut outer = self.carriers(from);
        // What carries both moves neither as the other sees it.
        while inner.last().is_some() && inner.last() == outer.last() {
            inner.pop();
            outer.pop();
        }
        outer.reverse();
        // Joints' frames rest in the frames of the links before them, so lengths are between one joint's frame and the next.
        let across = outer.first().map_or(Vec3::zeros(), |link| self.arm(*link));
        let mut bounds = PointBounds::at_rest(match inner.is_empty() {
            true => radius(&across),
            false => radius(&Vec3::zeros()),
        });
        for (i, link) in inner.iter().enumerate() {
            bounds.leave(&self.joint(*link));
            let is_last = i + 1 == inner.len();
            let next = if is_last { across } else { Vec3::zeros() };
            bounds.distance += (self.arm(*link) - next).norm();
        }
        for (i, link) in outer.iter().enumerate() {
            if i > 0 {
                bounds.distance += self.arm(*link).norm();
            }
            bounds.enter(&self.joint(*link));
        }
        bounds
    }

    /// From the frame of a link's parent to that of its joint.
    fn arm(&self, link: usize) -> Vec3 {
        self.link(link).at.translation
    }

    fn link(&self, number: usize) -> &Link {
        self.space.link(number).expect("a link of the space")
    }

    /// What the rounding of a gap of two bodies is at most, of points no farther than `radii` from the origins of the frames of the
    /// links that carry them.
    ///
    /// In a chain of n links the pose of each is a product with two rotations. A product of matrices is off by at most 6
    /// epsilon, as a matrix; a turn by an angle of at most a by 4 epsilon, and by 2 a epsilon as the angle is the sum of a product; a sum of
    /// translations by 4 epsilon of its size. Each turns or moves all that comes after, so a point is off by at most n (20 + 2 a)
    /// epsilon times the sum s of the lengths of all arms; the relative pose and the support points add 32 epsilon s. Twice the error of
    /// measured distances, 2 [`DISTANCE_ERROR`] s and both deviations, keeps what is shown here out of what queries call inside.
    pub fn rounding(&self, sides: [Option<&Carried>; 2], radii: [f64; 2]) -> f64 {
        let (mut links, mut angle, mut size, mut deviations) = (0.0, 0.0f64, 0.0, 0.0);
        for (side, radius) in sides.into_iter().zip(radii) {
            size += radius;
            let Some(side) = side else {
                continue;
            };
            deviations += side.body.map_or(0.0, |body| body.deviation());
            // Where a body is modelled far from its frame's origin, and put back by its pose, lengths cancel, but not their rounding.
            size += side.body.map_or(0.0, |body| body.center().norm());
            size += side.pose.translation.norm();
            for link in self.carriers(side.link) {
                let joint = self.joint(link);
                links += 1.0;
                angle = angle.max(joint.angle);
                size += self.arm(link).norm() + joint.away;
            }
        }
        let relative = (32.0 + links * (20.0 + 2.0 * angle)) * EPSILON;
        2.0 * deviations + (2.0 * DISTANCE_ERROR + relative) * size
    }

    /// A link and all that carry it, the innermost first.
    fn carriers(&self, link: Option<usize>) -> Vec<usize> {
        std::iter::successors(link, |link| self.space.parent(*link)).collect()
    }

    fn joint(&self, number: usize) -> JointCourse {
        let offset = self.space.offsets()[self.space.robot_of(number)];
        let joint = &self.link(number).joint;
        let q = &self.q0[offset.coordinate + joint.coordinate..][..joint.kind.nq()];
        let v = &self.v[offset.velocity + joint.velocity..][..joint.kind.nv()];
        let farthest = |q: f64, v: f64| q.abs() + v.abs();
        let mut course = JointCourse {
            turn: 0.0,
            shift: 0.0,
            away: 0.0,
            angle: 0.0,
            has_acceleration: true,
        };
        match &joint.kind {
            JointKind::Fixed => {}
            JointKind::Revolute => {
                course.turn = (joint.multiplier * v[0]).abs();
                let angle = joint.multiplier.abs() * farthest(q[0], v[0]);
                course.angle = angle + joint.offset.abs();
            }
            JointKind::Prismatic => {
                course.shift = (joint.multiplier * v[0]).abs();
                course.away = (joint.multiplier * q[0]).abs() + joint.offset.abs();
            }
            JointKind::Planar => {
                (course.turn, course.shift) = (v[2].abs(), length(&v[..2]));
                (course.angle, course.away) = (farthest(q[2], v[2]), length(&q[..2]));
            }
            JointKind::Spherical => course.turn = length(v),
            JointKind::Free => {
                (course.turn, course.shift) = (length(&v[3..]), length(&v[..3]));
                course.away = length(&q[..3]);
            }
            JointKind::FreeEuler => {
                course.shift = length(&v[..3]);
                course.away = length(&q[..3]);
                for k in 3..6 {
                    course.turn += v[k].abs();
                    course.angle += farthest(q[k], v[k]);
                }
            }
            JointKind::Custom(custom) => {
                let rate: f64 = v.iter().map(|rate| rate.abs()).sum();
                if rate > 0.0 {
                    let speeds = custom.speeds();
                    let [turn, shift] = speeds.map_or([f64::INFINITY; 2], |speeds| {
                        [speeds.angular, speeds.linear].map(|speed| speed * rate)
                    });
                    (course.turn, course.shift) = (turn, shift);
                    course.has_acceleration = false;
                }
                let robot = &self.q0[offset.coordinate..];
                let start = joint.motion(robot);
                course.away = start.map_or(f64::INFINITY, |pose| pose.translation.norm());
            }
        }
        course.away += course.shift;
        course
    }
}
