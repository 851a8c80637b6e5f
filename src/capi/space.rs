//! Spaces.

use std::sync::Arc;

use super::answers::CSTK_NONE;
use super::boundary::{Failure, guard};
use super::handle::{self, Noun};
use super::input::{Output, OutputSlice, array, slice};
use super::robot::cstk_robot;
use super::status::cstk_status;
use crate::error::{Error, ErrorKind, require_coordinates};
use crate::pose::{Pose, Vec3};
use crate::robot::{Posture, Robot};
use crate::space::{Coordinate, Sampler, Space, WorldBox};

/// The C-space of one or more robots. Immutable; threads may share it. It keeps its robots.
pub struct cstk_space {
    _opaque: [u8; 0],
}

impl Noun for Space {
    type Handle = cstk_space;
    const KIND: u32 = 5;
    const NAME: &'static str = "cstk_space";
}

/// The topology of a coordinate.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_range_kind {
    /// The circle: angles in radians, equal modulo 2 pi. The limits are ignored.
    CSTK_RANGE_CIRCLE = 0,
    /// The closed interval from lower to upper; either may be infinite.
    CSTK_RANGE_INTERVAL = 1,
    /// What the joint says: its limits; without any, a circle for angles and the whole line for lengths.
    CSTK_RANGE_DEFAULT = 2,
    /// One of the four entries of a unit quaternion: what joints with quaternions say, and nothing else may be said of them.
    CSTK_RANGE_QUATERNION = 3,
}

/// The range of a coordinate.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_range {
    /// A cstk_range_kind.
    pub kind: i32,
    pub reserved: u32,
    pub lower: f64,
    pub upper: f64,
}

impl cstk_range {
    /// `None` for a number that is no kind, `Some(None)` for the default.
    fn decode(&self) -> Option<Option<Coordinate>> {
        let interval = Coordinate::Interval {
            lower: self.lower,
            upper: self.upper,
        };
        [
            (cstk_range_kind::CSTK_RANGE_CIRCLE, Some(Coordinate::Circle)),
            (cstk_range_kind::CSTK_RANGE_INTERVAL, Some(interval)),
            (cstk_range_kind::CSTK_RANGE_DEFAULT, None),
            (
                cstk_range_kind::CSTK_RANGE_QUATERNION,
                Some(Coordinate::Quaternion),
            ),
        ]
        .into_iter()
        .find_map(|(code, range)| (code as i32 == self.kind).then_some(range))
    }

    fn of(coordinate: &Coordinate) -> Self {
        let (kind, lower, upper) = match *coordinate {
            Coordinate::Circle => (cstk_range_kind::CSTK_RANGE_CIRCLE, 0.0, 0.0),
            Coordinate::Interval { lower, upper } => {
                (cstk_range_kind::CSTK_RANGE_INTERVAL, lower, upper)
            }
            Coordinate::Quaternion => (cstk_range_kind::CSTK_RANGE_QUATERNION, 0.0, 0.0),
        };
        Self {
            kind: kind as i32,
            reserved: 0,
            lower,
            upper,
        }
    }
}

/// Makes the C-space of `robot_count` robots, whose links and coordinates are numbered through in the order given.
///
/// `ranges` holds one range per coordinate, or is NULL with `range_count` 0 where each has its default; see
/// cstk_range_kind. `world_box` holds low x, y, z, high x, y, z: where the links' origins may be; NULL for everywhere.
/// Ranges and box limit slides and cstk_space_contains; other queries answer anywhere. Robots of dimension 2 make a planar
/// world, of dimension 3 a spatial one (the report's make-c-space-planar-world and make-c-space-3d-world).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_create(
    robots: *const *const cstk_robot,
    robot_count: usize,
    ranges: *const cstk_range,
    range_count: usize,
    world_box: *const f64,
    out: *mut *mut cstk_space,
) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (robots, ranges) = unsafe {
            (
                slice(robots, robot_count, "robots")?,
                slice(ranges, range_count, "ranges")?,
            )
        };
        let robots = robots
            .iter()
            .enumerate()
            .map(|(i, &robot)| handle::share::<Robot>(robot, &format!("robots[{i}]")))
            .collect::<Result<Vec<_>, _>>()?;
        let ranges = ranges
            .iter()
            .enumerate()
            .map(|(i, range)| {
                range.decode().ok_or_else(|| {
                    let kind = range.kind;
                    Error::invalid(format!("ranges[{i}].kind {kind} is no cstk_range_kind"))
                })
            })
            .collect::<Result<Vec<_>, _>>()?;
        let world = if world_box.is_null() {
            WorldBox::unbounded()
        } else {
            // SAFETY: not NULL; the header states the length.
            let b = unsafe { array::<6>(world_box, "world_box")? };
            WorldBox {
                low: [b[0], b[1], b[2]],
                high: [b[3], b[4], b[5]],
            }
        };
        let space = Space::new(robots, &ranges, world)?;
        out.write(handle::create(Arc::new(space)));
        Ok(())
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_retain(space: *mut cstk_space) -> cstk_status {
    guard(|| handle::retain::<Space>(space, "space"))
}

/// Drops a reference. NULL is a no-op. C-objects keep their space.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_release(space: *mut cstk_space) -> cstk_status {
    guard(|| handle::release::<Space>(space, "space"))
}

/// Writes the number of entries of a configuration (nq), of a velocity or gradient (nv), and of links; each may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_size(
    space: *const cstk_space,
    nq: *mut usize,
    nv: *mut usize,
    link_count: *mut usize,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let nq = Output::optional(nq, "nq")?;
        let nv = Output::optional(nv, "nv")?;
        let link_count = Output::optional(link_count, "link_count")?;
        nq.write(space.nq());
        nv.write(space.nv());
        link_count.write(space.link_count());
        Ok(())
    })
}

/// Writes whether every coordinate of q is in its range and every link's origin in the world box.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_contains(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    out: *mut bool,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let q = unsafe { slice(q, nq, "q")? };
        space.check_configuration(q)?;
        out.write(space.contains(q)?);
        Ok(())
    })
}

/// Where a robot's numbers begin in a space.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_space_offset {
    pub link: u32,
    pub coordinate: u32,
    pub velocity: u32,
    pub reserved: u32,
}

/// Writes where the links, coordinates and velocities of the space's `robot`-th robot begin: add them to the robot's own.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_get_offset(
    space: *const cstk_space,
    robot: usize,
    out: *mut cstk_space_offset,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        let offset = space
            .offsets()
            .get(robot)
            .ok_or_else(|| absent("robot", robot, space.offsets().len()))?;
        out.write(cstk_space_offset {
            link: offset.link as u32,
            coordinate: offset.coordinate as u32,
            velocity: offset.velocity as u32,
            reserved: 0,
        });
        Ok(())
    })
}

/// Writes the range of a coordinate; its kind is never CSTK_RANGE_DEFAULT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_get_range(
    space: *const cstk_space,
    coordinate: usize,
    out: *mut cstk_range,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        let range = space
            .coordinates()
            .get(coordinate)
            .ok_or_else(|| absent("coordinate", coordinate, space.nq()))?;
        out.write(cstk_range::of(range));
        Ok(())
    })
}

fn absent(what: &str, number: usize, count: usize) -> Error {
    let message = format!("{what} {number} does not exist; the space has {count}");
    Error::new(ErrorKind::NotFound, message)
}

/// Writes whether every coordinate of q is in its range, and to `coordinate`, which may be NULL, the first that is not
/// (CSTK_NONE if all are).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_within_limits(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    out: *mut bool,
    coordinate: *mut u32,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        let coordinate = Output::optional(coordinate, "coordinate")?;
        // SAFETY: checked for NULL; the caller states the length.
        let q = unsafe { configuration(space, q, nq, "q")? };
        let beyond = space.beyond_limits(q);
        out.write(beyond.is_none());
        coordinate.write(beyond.map_or(CSTK_NONE, |c| c as u32));
        Ok(())
    })
}

/// Writes whether the origin of every link's frame is in the world box at q, and to `link`, which may be NULL, the first that
/// is not (CSTK_NONE if all are).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_within_world(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    out: *mut bool,
    link: *mut u32,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        let link = Output::optional(link, "link")?;
        // SAFETY: checked for NULL; the caller states the length.
        let q = unsafe { configuration(space, q, nq, "q")? };
        let beyond = space.beyond_world(q)?;
        out.write(beyond.is_none());
        link.write(beyond.map_or(CSTK_NONE, |l| l as u32));
        Ok(())
    })
}

/// Writes the poses of all links at q, in the world: 12 doubles for each link of the space.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_link_poses(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    poses: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = OutputSlice::checked(poses, 12 * space.link_count(), "poses")?;
        // SAFETY: checked for NULL; the caller states the length.
        let q = unsafe { configuration(space, q, nq, "q")? };
        let poses = space.link_poses(q)?;
        out.write(
            &poses
                .iter()
                .flat_map(Pose::to_row_major)
                .collect::<Vec<_>>(),
        );
        Ok(())
    })
}

/// The basic Jacobian (eq. 33) at q of a point fixed to a link of the space; as cstk_robot_jacobian, with the space's nv.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_jacobian(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    link: u32,
    point: *const f64,
    jacobian: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = OutputSlice::checked(jacobian, 6 * space.nv(), "jacobian")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (q, point) = unsafe {
            (
                configuration(space, q, nq, "q")?,
                array::<3>(point, "point")?,
            )
        };
        require_coordinates(point, "point entry")?;
        let link = link as usize;
        if link >= space.link_count() {
            return Err(absent("link", link, space.link_count()).into());
        }
        let poses = &space.link_poses(q)?;
        let world = poses[link].transform_point(&Vec3::from(*point));
        out.write(&space.jacobian(Posture { q, poses }, link, &world)?);
        Ok(())
    })
}

/// Writes the configuration of no shift and no turn: zeros, and quaternions 0, 0, 0, 1. It may be out of range.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_neutral(space: *const cstk_space, q: *mut f64) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = OutputSlice::checked(q, space.nq(), "q")?;
        out.write(&space.neutral());
        Ok(())
    })
}

/// The configuration that velocity `v` of `nv` doubles leads to from `q` in a unit of time: straight for intervals and
/// circles (which are not wrapped), at constant angular velocity for quaternions, along a screw for free joints. `out` has
/// `nq` doubles and may be `q`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_step(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    v: *const f64,
    nv: usize,
    out: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = OutputSlice::checked(out, space.nq(), "out")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (q, v) = unsafe { (configuration(space, q, nq, "q")?, slice(v, nv, "v")?) };
        space.check_velocity(v, "velocity")?;
        out.write(&reached(space, space.step(q, v))?);
        Ok(())
    })
}

/// The smallest velocity that leads from `q0` to `q1` in a unit of time, nv doubles: circles go the shorter way round (the
/// negative one of two that are equal), quaternions turn by at most half a turn.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_difference(
    space: *const cstk_space,
    q0: *const f64,
    q1: *const f64,
    nq: usize,
    v: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = OutputSlice::checked(v, space.nv(), "v")?;
        // SAFETY: checked for NULL; the caller states the length.
        let [q0, q1] = unsafe { two_configurations(space, q0, q1, nq)? };
        out.write(&space.difference(q0, q1));
        Ok(())
    })
}

/// The configuration at parameter `t` of the shortest way from `q0` (t = 0) to `q1` (t = 1); `t` may lie beyond. `out` has
/// `nq` doubles and may be one of the two.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_interpolate(
    space: *const cstk_space,
    q0: *const f64,
    q1: *const f64,
    nq: usize,
    t: f64,
    out: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = OutputSlice::checked(out, space.nq(), "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let [q0, q1] = unsafe { two_configurations(space, q0, q1, nq)? };
        require_coordinates(&[t], "t")?;
        out.write(&reached(space, space.interpolate(q0, q1, t))?);
        Ok(())
    })
}

/// The length of the difference of two configurations, each velocity times its weight: `weights` has nv doubles, none
/// negative, or is NULL for 1 each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_distance(
    space: *const cstk_space,
    q0: *const f64,
    q1: *const f64,
    nq: usize,
    weights: *const f64,
    out: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let [q0, q1] = unsafe { two_configurations(space, q0, q1, nq)? };
        let weights = if weights.is_null() {
            None
        } else {
            // SAFETY: not NULL; the header states the length.
            let given = unsafe { slice(weights, space.nv(), "weights")? };
            require_coordinates(given, "weight")?;
            if let Some(i) = given.iter().position(|weight| *weight < 0.0) {
                return Err(Error::invalid(format!("weight {i} is negative: {}", given[i])).into());
            }
            Some(given)
        };
        out.write(space.distance(q0, q1, weights));
        Ok(())
    })
}

/// Draws a configuration uniformly from the coordinates' ranges; quaternions uniformly from the rotations. `state` is that of
/// the stream of random numbers: any number to begin with; each call advances it. Equal states give equal configurations, on
/// every machine. CSTK_UNSUPPORTED, naming the coordinate, where a range is unbounded.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_sample(
    space: *const cstk_space,
    state: *mut u64,
    q: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let advanced = Output::checked(state, "state")?;
        let out = OutputSlice::checked(q, space.nq(), "q")?;
        // SAFETY: checked for NULL and alignment above.
        let mut sampler = Sampler(unsafe { state.read() });
        let drawn = space.sample(&mut sampler)?;
        out.write(&drawn);
        advanced.write(sampler.0);
        Ok(())
    })
}

/// The nearest configuration whose coordinates are all in range; quaternions are made unit. `out` has `nq` doubles and may be
/// `q`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_clamp(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    out: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = OutputSlice::checked(out, space.nq(), "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let q = unsafe { configuration(space, q, nq, "q")? };
        out.write(&space.clamp(q));
        Ok(())
    })
}

/// The same configuration with circles in [0, 2 pi), as §4.4 has them, and quaternions unit with w >= 0. `out` has `nq`
/// doubles and may be `q`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_wrap(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    out: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrow::<Space>(space, "space")?;
        let out = OutputSlice::checked(out, space.nq(), "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let q = unsafe { configuration(space, q, nq, "q")? };
        out.write(&space.wrap(q));
        Ok(())
    })
}

/// What a step led to, unless that is too far.
fn reached(space: &Space, q: Vec<f64>) -> Result<Vec<f64>, Failure> {
    space
        .check_configuration(&q)
        .map_err(|e| e.within("the configuration reached"))?;
    Ok(q)
}

/// A checked configuration of the space.
unsafe fn configuration<'a>(
    space: &Space,
    q: *const f64,
    nq: usize,
    argument: &str,
) -> Result<&'a [f64], Failure> {
    // SAFETY: as the caller states.
    let q = unsafe { slice(q, nq, argument)? };
    space.check_configuration(q).map_err(|e| {
        if argument == "q" {
            e
        } else {
            e.within(argument)
        }
    })?;
    Ok(q)
}

unsafe fn two_configurations<'a>(
    space: &Space,
    q0: *const f64,
    q1: *const f64,
    nq: usize,
) -> Result<[&'a [f64]; 2], Failure> {
    // SAFETY: as the caller states.
    unsafe {
        Ok([
            configuration(space, q0, nq, "q0")?,
            configuration(space, q1, nq, "q1")?,
        ])
    }
}
