//! The C-space of one or more robots (the report's `make-c-space-3d-world` and `make-c-space-planar-world`).

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::WorldBox;
use super::link_bodies::LinkBodies;
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::{Pose, Vec3};
use crate::robot::{
    Block, Column, Coordinate, CoordinateCourses, Link, LinkMotions, Robot, RobotState,
    check_configuration,
};

/// The first link, coordinate and velocity of a robot in the space.
#[derive(Clone, Copy, Debug)]
pub struct Offset {
    /// Number of the robot's first link.
    pub link: usize,
    /// Index of the robot's first coordinate.
    pub coordinate: usize,
    /// Index of the robot's first velocity.
    pub velocity: usize,
}

/// The C-space of one or more robots. Links and coordinates are numbered through all robots, in the order given. Immutable;
/// threads may share it.
#[derive(Debug)]
pub struct Space {
    serial: u64,
    pub(super) robots: Vec<Arc<Robot>>,
    offsets: Vec<Offset>,
    links: usize,
    bodies: LinkBodies,
    nv: usize,
    coordinates: Vec<Coordinate>,
    blocks: Vec<Block>,
    world: WorldBox,
}

impl Space {
    /// Makes a space. `ranges` has one entry per coordinate, or is empty; `None` keeps the joint's default: its limits, a
    /// circle for revolute joints without limits, the whole line for lengths.
    pub fn new(
        robots: Vec<Arc<Robot>>,
        ranges: &[Option<Coordinate>],
        world: WorldBox,
    ) -> Result<Self> {
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
        let mut bodies = Vec::new();
        let (mut links, mut nv) = (0, 0);
        let (mut coordinates, mut periodic, mut blocks) = (Vec::new(), Vec::new(), Vec::new());
        for robot in &robots {
            let offset = Offset {
                link: links,
                coordinate: coordinates.len(),
                velocity: nv,
            };
            offsets.push(offset);
            links += robot.links().len();
            bodies.extend(robot.links().iter().map(|link| link.body.clone()));
            nv += robot.nv();
            coordinates.extend_from_slice(robot.ranges());
            periodic.extend((0..robot.nq()).map(|c| robot.is_periodic(c)));
            blocks.extend(robot.blocks().iter().map(|block| Block {
                coordinate: block.coordinate + offset.coordinate,
                velocity: block.velocity + offset.velocity,
                ..*block
            }));
        }
        if !ranges.is_empty() && ranges.len() != coordinates.len() {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "{} ranges given for {} coordinates",
                    ranges.len(),
                    coordinates.len()
                ),
            ));
        }
        for (i, (range, default)) in ranges.iter().zip(&mut coordinates).enumerate() {
            if let Some(range) = range {
                check_range(*range, *default, periodic[i])
                    .map_err(|e| e.within(format_args!("range {i}")))?;
                *default = *range;
            }
        }
        world.check()?;
        Ok(Self {
            serial: NEXT_SERIAL.fetch_add(1, Ordering::Relaxed),
            robots,
            offsets,
            links,
            bodies: LinkBodies::new(bodies),
            nv,
            coordinates,
            blocks,
            world,
        })
    }

    /// A number that no other space of this process has.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    /// 2 for planar robots, 3 for spatial ones.
    pub fn dimension(&self) -> u32 {
        self.robots[0].dimension()
    }

    /// The number of entries of a configuration.
    pub fn nq(&self) -> usize {
        self.coordinates.len()
    }

    /// The number of entries of a velocity, a step or a gradient.
    pub fn nv(&self) -> usize {
        self.nv
    }

    /// The range of each coordinate.
    pub fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    /// Whether a whole turn of a coordinate leaves every link where it was.
    pub fn is_periodic(&self, coordinate: usize) -> bool {
        let before = |offset: &Offset| offset.coordinate <= coordinate;
        let robot = self.offsets.partition_point(before) - 1;
        self.robots[robot].is_periodic(coordinate - self.offsets[robot].coordinate)
    }

    /// The blocks of coordinates that move together.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// One entry per robot, in the order given.
    pub fn offsets(&self) -> &[Offset] {
        &self.offsets
    }

    /// The box that the links' origins must stay in.
    pub fn world(&self) -> &WorldBox {
        &self.world
    }

    /// The number of links of all robots.
    pub fn link_count(&self) -> usize {
        self.links
    }

    /// A link of the space; `None` if the number is out of range.
    pub fn link(&self, link: usize) -> Option<&Link> {
        (link < self.links).then(|| {
            let robot = self.robot_of(link);
            &self.robots[robot].links()[link - self.offsets[robot].link]
        })
    }

    /// The link with a name; refused where none has it, or links of several robots do.
    pub fn find_link(&self, name: &str) -> Result<usize> {
        let of_robots = self.robots.iter().zip(&self.offsets);
        let mut found = of_robots.filter_map(|(robot, at)| Some(at.link + robot.find_link(name)?));
        let first = found.next().ok_or_else(|| {
            let message = format!("no link of the space has the name \"{name}\"");
            Error::new(ErrorKind::NotFound, message)
        })?;
        match found.next() {
            None => Ok(first),
            Some(other) => Err(Error::invalid(format!(
                "links {first} and {other} of the space both have the name \"{name}\""
            ))),
        }
    }

    /// The body of a link, if it has one.
    #[inline]
    pub fn body(&self, link: usize) -> Option<&Body> {
        self.bodies.get(link)
    }

    /// The bodies of all links.
    pub(crate) fn bodies(&self) -> &LinkBodies {
        &self.bodies
    }

    /// Whether the SRDF file of a robot rules out this pair of its links for self-collision.
    pub fn is_pair_disabled(&self, pair: [usize; 2]) -> bool {
        let robot = self.robot_of(pair[0]);
        if robot != self.robot_of(pair[1]) {
            return false;
        }
        let own = pair.map(|link| (link - self.offsets[robot].link) as u32);
        self.robots[robot].semantics().pairs.is_disabled(own)
    }

    /// All pairs of links with bodies but those that an SRDF file rules out, in order of their numbers.
    pub fn enabled_pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        let links = self.bodies.carriers();
        let count = links.len();
        let pairs = (0..count).flat_map(move |i| (i + 1..count).map(move |k| [i, k]));
        let pairs = pairs.map(|pair| pair.map(|i| links[i]));
        pairs.filter(|&pair| !self.is_pair_disabled(pair))
    }

    /// The poses of all links at q, in the world. Fails only in a custom joint.
    pub fn link_poses(&self, q: &[f64]) -> Result<Vec<Pose>> {
        let mut poses = vec![Pose::IDENTITY; self.links];
        self.write_link_poses(q, &mut poses)?;
        Ok(poses)
    }

    /// The same, into one place for each link.
    pub fn write_link_poses(&self, q: &[f64], poses: &mut [Pose]) -> Result<()> {
        let mut rest = poses;
        for (number, robot) in self.robots.iter().enumerate() {
            let (own, others) = rest.split_at_mut(robot.links().len());
            robot.write_link_poses(&q[self.coordinates_of(number)], own)?;
            rest = others;
        }
        Ok(())
    }

    /// Refuses a number of link poses other than the number of links.
    pub fn check_link_poses(&self, count: usize) -> Result<()> {
        if count == self.links {
            return Ok(());
        }
        let links = self.links;
        Err(Error::new(
            ErrorKind::WrongSize,
            format!("{count} link poses given, the space has {links} links"),
        ))
    }

    /// Refuses a configuration that has the wrong number of entries, an entry that is not a usable number, or a quaternion
    /// that is not of unit length.
    pub fn check_configuration(&self, q: &[f64]) -> Result<()> {
        check_configuration(q, self.nq(), &self.blocks)
    }

    /// The configuration with all coordinates 0 and identity quaternions. It may be out of range.
    pub fn neutral(&self) -> Vec<f64> {
        let mut q = vec![0.0; self.nq()];
        for at in self.quaternions() {
            q[at + 3] = 1.0;
        }
        q
    }

    /// Adds the derivative of `direction . point` to `row`, for a point fixed to a link; eq. (39).
    pub fn add_gradient(
        &self,
        state: RobotState,
        link: usize,
        point: &Vec3,
        direction: &Vec3,
        row: &mut [f64],
    ) -> Result<()> {
        self.visit_columns(state, link, point, |column| {
            row[column.velocity] += direction.dot(&column.linear);
        })
    }

    /// The 6 x nv basic Jacobian (33) of a point fixed to a link, row-major: linear, then angular velocity, in the world.
    pub fn jacobian(&self, state: RobotState, link: usize, point: &Vec3) -> Result<Vec<f64>> {
        let mut matrix = vec![0.0; 6 * self.nv];
        self.visit_columns(state, link, point, |c| c.add_to(&mut matrix, self.nv))?;
        Ok(matrix)
    }

    /// Visits the non-zero columns of the Jacobian of a point fixed to a link; see [`Robot::visit_columns`].
    fn visit_columns(
        &self,
        state: RobotState,
        link: usize,
        point: &Vec3,
        mut visit: impl FnMut(Column),
    ) -> Result<()> {
        let robot = self.robot_of(link);
        let offset = self.offsets[robot];
        let own = RobotState {
            q: &state.q[self.coordinates_of(robot)],
            poses: &state.poses[offset.link..],
        };
        self.robots[robot].visit_columns(own, link - offset.link, point, |column| {
            visit(Column {
                velocity: offset.velocity + column.velocity,
                ..column
            });
        })
    }

    /// All links while the space goes from q with constant velocity v for a unit of time.
    pub fn link_motions(&self, q: &[f64], v: &[f64]) -> LinkMotions {
        let mut motions = LinkMotions::default();
        for (index, robot) in self.robots.iter().enumerate() {
            let first = self.offsets[index].velocity;
            let courses = CoordinateCourses::Line {
                q: &q[self.coordinates_of(index)],
                v: &v[first..first + robot.nv()],
            };
            robot.append_motions(&mut motions, &courses);
        }
        motions
    }

    /// All links in a box of configurations around q, with one half width per velocity: those of a free joint's position stand with
    /// its linear velocities, those of quaternions must be 0.
    pub fn link_motions_in_box(&self, q: &[f64], half: &[f64]) -> LinkMotions {
        let mut motions = LinkMotions::default();
        for (index, robot) in self.robots.iter().enumerate() {
            let first = self.offsets[index].velocity;
            let courses = CoordinateCourses::Box {
                q: &q[self.coordinates_of(index)],
                half: &half[first..first + robot.nv()],
                first,
            };
            robot.append_motions(&mut motions, &courses);
        }
        motions
    }

    /// All links on a Bezier curve, given by its control points: one configuration after another, of which no coordinates of
    /// quaternions differ.
    pub fn link_motions_on_curve(&self, controls: &[f64]) -> LinkMotions {
        let mut motions = LinkMotions::default();
        for (index, robot) in self.robots.iter().enumerate() {
            let courses = CoordinateCourses::Curve {
                controls,
                nq: self.nq(),
                first: self.coordinates_of(index).start,
            };
            robot.append_motions(&mut motions, &courses);
        }
        motions
    }

    /// All links on a motion from q that a function gives, with bounds of the first two derivatives of each coordinate; those of
    /// quaternions rest.
    pub fn link_motions_given(
        &self,
        q: &[f64],
        max_rates: &[f64],
        max_accelerations: &[f64],
    ) -> LinkMotions {
        let mut motions = LinkMotions::default();
        for (index, robot) in self.robots.iter().enumerate() {
            let courses = CoordinateCourses::Given {
                q,
                max_rates,
                max_accelerations,
                first: self.coordinates_of(index).start,
            };
            robot.append_motions(&mut motions, &courses);
        }
        motions
    }

    /// The parent of a link; `None` for the world.
    pub fn parent(&self, link: usize) -> Option<usize> {
        let first = self.offsets[self.robot_of(link)].link;
        Some(first + self.link(link)?.parent?)
    }

    /// The index of the robot that a link belongs to.
    pub fn robot_of(&self, link: usize) -> usize {
        self.offsets.partition_point(|offset| offset.link <= link) - 1
    }

    pub(super) fn coordinates_of(&self, robot: usize) -> std::ops::Range<usize> {
        let first = self.offsets[robot].coordinate;
        first..first + self.robots[robot].nq()
    }
}

/// Refuses a range that the coordinate cannot have.
fn check_range(range: Coordinate, default: Coordinate, is_periodic: bool) -> Result<()> {
    if let Coordinate::Interval { lower, upper } = range {
        if lower.is_nan() || upper.is_nan() {
            return Err(Error::new(ErrorKind::NotFinite, "it holds a NaN"));
        }
        if lower > upper || lower == f64::INFINITY || upper == f64::NEG_INFINITY {
            return Err(Error::invalid(format!("it is empty: {lower} to {upper}")));
        }
        for end in [lower, upper].into_iter().filter(|end| end.is_finite()) {
            require_coordinates(&[end], "end")?;
        }
    }
    if range == Coordinate::Circle && !is_periodic {
        return Err(Error::invalid(
            "a circle, but a whole turn of this coordinate does not bring every link back: it moves a prismatic joint, or \
             one that follows it by a part",
        ));
    }
    if (range == Coordinate::Quaternion) != (default == Coordinate::Quaternion) {
        return Err(Error::invalid(if default == Coordinate::Quaternion {
            "this coordinate belongs to a quaternion, which has no limits"
        } else {
            "this coordinate does not belong to a quaternion"
        }));
    }
    Ok(())
}
