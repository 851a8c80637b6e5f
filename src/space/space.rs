//! The C-space of one or more robots (the report's `make-c-space-3d-world` and `make-c-space-planar-world`).

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::Coordinate;
use crate::error::{Error, ErrorKind, Result};
use crate::pose::{Pose, Vec3};
use crate::robot::{JointKind, Link, Robot, check_configuration};

/// The box within which the links' origins may move.
#[derive(Clone, Copy, Debug)]
pub struct WorldBox {
    pub low: [f64; 3],
    pub high: [f64; 3],
}

impl WorldBox {
    pub fn unbounded() -> Self {
        Self {
            low: [f64::NEG_INFINITY; 3],
            high: [f64::INFINITY; 3],
        }
    }

    pub fn contains(&self, point: &Vec3) -> bool {
        (0..3).all(|i| self.low[i] <= point[i] && point[i] <= self.high[i])
    }
}

/// Where a robot's links and coordinates begin in the space.
#[derive(Clone, Copy, Debug)]
struct Offset {
    link: usize,
    coordinate: usize,
}

/// A C-space. Links and coordinates are numbered through all robots, in the order given.
#[derive(Debug)]
pub struct Space {
    serial: u64,
    robots: Vec<Arc<Robot>>,
    offsets: Vec<Offset>,
    links: usize,
    coordinates: Vec<Coordinate>,
    world: WorldBox,
}

impl Space {
    /// `ranges` has one entry per coordinate, or none for the defaults: circles for coordinates of revolute joints, the
    /// whole line for prismatic ones.
    pub fn new(robots: Vec<Arc<Robot>>, ranges: &[Coordinate], world: WorldBox) -> Result<Self> {
        static NEXT_SERIAL: AtomicU64 = AtomicU64::new(1);
        let Some(first) = robots.first() else {
            return Err(Error::new(
                ErrorKind::Empty,
                "a space needs at least one robot",
            ));
        };
        if robots
            .iter()
            .any(|robot| robot.dimension() != first.dimension())
        {
            return Err(Error::invalid(
                "planar and spatial robots cannot share a space",
            ));
        }
        let mut offsets = Vec::new();
        let (mut links, mut defaults) = (0, Vec::new());
        for robot in &robots {
            offsets.push(Offset {
                link: links,
                coordinate: defaults.len(),
            });
            links += robot.links().len();
            defaults.extend(default_ranges(robot));
        }
        let coordinates = if ranges.is_empty() {
            defaults
        } else {
            ranges.to_vec()
        };
        let expected = offsets.last().map_or(0, |o| o.coordinate)
            + robots.last().map_or(0, |robot| robot.coordinates());
        if coordinates.len() != expected {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "{} ranges given for {expected} coordinates",
                    coordinates.len()
                ),
            ));
        }
        for (i, coordinate) in coordinates.iter().enumerate() {
            if let Coordinate::Interval { lower, upper } = *coordinate {
                if lower.is_nan() || upper.is_nan() {
                    return Err(Error::new(
                        ErrorKind::NotFinite,
                        format!("range {i} holds a NaN"),
                    ));
                }
                if lower > upper || lower == f64::INFINITY || upper == f64::NEG_INFINITY {
                    return Err(Error::invalid(format!(
                        "range {i} is empty: {lower} to {upper}"
                    )));
                }
            }
        }
        let prismatic = robots.iter().zip(&offsets).flat_map(|(robot, offset)| {
            let joints = robot.links().iter().map(|link| link.joint);
            let moved = joints.filter(|joint| joint.kind == JointKind::Prismatic);
            moved.map(|joint| offset.coordinate + joint.coordinate)
        });
        for i in prismatic {
            if coordinates[i] == Coordinate::Circle {
                return Err(Error::invalid(format!(
                    "range {i} is a circle, but coordinate {i} moves a prismatic joint"
                )));
            }
        }
        for i in 0..3 {
            if world.low[i].is_nan() || world.high[i].is_nan() {
                return Err(Error::new(
                    ErrorKind::NotFinite,
                    "the world box holds a NaN",
                ));
            }
            if world.low[i] > world.high[i] {
                return Err(Error::invalid(format!(
                    "the world box is empty along axis {i}: {} to {}",
                    world.low[i], world.high[i]
                )));
            }
        }
        Ok(Self {
            serial: NEXT_SERIAL.fetch_add(1, Ordering::Relaxed),
            robots,
            offsets,
            links,
            coordinates,
            world,
        })
    }

    /// A number no other space of this process has.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    pub fn dimension(&self) -> u32 {
        self.robots[0].dimension()
    }

    pub fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    pub fn link_count(&self) -> usize {
        self.links
    }

    /// A link of the space; `None` if there is no such number.
    pub fn link(&self, link: usize) -> Option<&Link> {
        (link < self.links).then(|| {
            let robot = self.robot_of(link);
            &self.robots[robot].links()[link - self.offsets[robot].link]
        })
    }

    /// The poses of all links at q.
    pub fn link_poses(&self, q: &[f64]) -> Vec<Pose> {
        let mut poses = Vec::with_capacity(self.links);
        for (robot, offset) in self.robots.iter().zip(&self.offsets) {
            let end = offset.coordinate + robot.coordinates();
            robot.link_poses(&q[offset.coordinate..end], &mut poses);
        }
        poses
    }

    /// Refuses a configuration with the wrong number of entries, or with one that is not a usable number.
    pub fn check_configuration(&self, q: &[f64]) -> Result<()> {
        check_configuration(q, self.coordinates.len())
    }

    /// Adds `sign` times the derivative of `normal . point` to `row`, for a point fixed to a link; eq. (39).
    pub fn add_gradient(
        &self,
        poses: &[Pose],
        link: usize,
        point: &Vec3,
        normal: &Vec3,
        sign: f64,
        row: &mut [f64],
    ) {
        let robot = self.robot_of(link);
        let offset = self.offsets[robot];
        let own = &poses[offset.link..];
        for column in self.robots[robot].ancestry(own, link - offset.link, point) {
            row[offset.coordinate + column.coordinate] += sign * normal.dot(&column.linear);
        }
    }

    /// No point of the link's body moves farther than this on the straight segment from q0 to q1.
    pub fn motion_bound(&self, link: usize, q0: &[f64], q1: &[f64]) -> f64 {
        let robot = self.robot_of(link);
        let offset = self.offsets[robot];
        let end = offset.coordinate + self.robots[robot].coordinates();
        let own = offset.coordinate..end;
        self.robots[robot].motion_bound(link - offset.link, &q0[own.clone()], &q1[own])
    }

    /// Whether every coordinate is in its range and every link's origin in the world box.
    pub fn contains(&self, q: &[f64]) -> bool {
        self.coordinates.iter().zip(q).all(|(c, x)| c.contains(*x))
            && self
                .link_poses(q)
                .iter()
                .all(|pose| self.world.contains(&pose.translation))
    }

    /// The nearest configuration whose coordinates are all in range.
    pub fn clamp(&self, q: &[f64]) -> Vec<f64> {
        self.coordinates
            .iter()
            .zip(q)
            .map(|(c, x)| c.clamp(*x))
            .collect()
    }

    fn robot_of(&self, link: usize) -> usize {
        self.offsets.partition_point(|offset| offset.link <= link) - 1
    }
}

fn default_ranges(robot: &Robot) -> Vec<Coordinate> {
    let mut ranges = vec![Coordinate::Circle; robot.coordinates()];
    for link in robot.links() {
        if link.joint.kind == JointKind::Prismatic {
            ranges[link.joint.coordinate] = Coordinate::Interval {
                lower: f64::NEG_INFINITY,
                upper: f64::INFINITY,
            };
        }
    }
    ranges
}
