//! Spaces.

use std::ffi::c_char;
use std::sync::Arc;

use crate::capi::boundary::guard;
use crate::capi::handle;
use crate::capi::handle::Noun;
use crate::capi::input::{Output, array, slice, text};
use crate::capi::robot::robot::{cstk_robot, write_text};
use crate::capi::status::status::cstk_status;
use crate::error::{Error, ErrorKind};
use crate::robot::Robot;
use crate::space::{Coordinate, Space, WorldBox};

/// The C-space of one or more robots. Immutable; threads may share it. It keeps references to its robots.
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
    /// The joint's default: its limits; without any, a circle for angles and the whole line for lengths.
    CSTK_RANGE_DEFAULT = 2,
    /// One of the four entries of a unit quaternion: the only range of the coordinates of such joints.
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
    /// `None` for an unknown kind, `Some(None)` for the default.
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

/// Creates the C-space of `robot_count` robots. Links and coordinates are numbered through all robots, in the order given.
///
/// `ranges` holds one range per coordinate, or is NULL with `range_count` 0 for all defaults; see cstk_range_kind. A range
/// of one value freezes its coordinate. `world_box` holds low x, y, z, high x, y, z: bounds for the links' origins; NULL
/// for none. Ranges and box limit slides and cstk_space_contains; other queries answer anywhere. Robots of dimension 2 make
/// a planar world, of dimension 3 a spatial one (the report's make-c-space-planar-world and make-c-space-3d-world).
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

/// Drops a reference. NULL is a no-op. C-objects hold a reference to their space.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_release(space: *mut cstk_space) -> cstk_status {
    guard(|| handle::release::<Space>(space, "space"))
}

/// Writes the number of entries of a configuration (nq), of a velocity or gradient (nv), and of links; each output may be
/// NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_get_size(
    space: *const cstk_space,
    nq: *mut usize,
    nv: *mut usize,
    link_count: *mut usize,
) -> cstk_status {
    guard(|| {
        let space = &*handle::share::<Space>(space, "space")?;
        let nq = Output::optional(nq, "nq")?;
        let nv = Output::optional(nv, "nv")?;
        let link_count = Output::optional(link_count, "link_count")?;
        nq.write(space.nq());
        nv.write(space.nv());
        link_count.write(space.link_count());
        Ok(())
    })
}

/// Writes the name of a link, by number in the space; see cstk_robot_get_link_name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_get_link_name(
    space: *const cstk_space,
    link: u32,
    buffer: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> cstk_status {
    guard(|| {
        let space = &*handle::share::<Space>(space, "space")?;
        let found = space
            .link(link as usize)
            .ok_or_else(|| absent("link", link as usize, space.link_count()))?;
        write_text(&found.name, buffer, capacity, length)
    })
}

/// Writes the number of the link with this name. CSTK_ERROR_NOT_FOUND if there is none; CSTK_ERROR_INVALID_ARGUMENT if several robots
/// of the space have one: see cstk_robot_find_link and cstk_space_get_offset then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_find_link(
    space: *const cstk_space,
    name: *const c_char,
    out: *mut u32,
) -> cstk_status {
    guard(|| {
        let space = &*handle::share::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states that it is terminated.
        let name = unsafe { text(name, "name")? };
        out.write(space.find_link(name)? as u32);
        Ok(())
    })
}

/// The first link, coordinate and velocity of a robot in a space.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_space_offset {
    pub link: u32,
    pub coordinate: u32,
    pub velocity: u32,
    pub reserved: u32,
}

/// Writes where the links, coordinates and velocities of the space's `robot`-th robot begin: add them to the robot's own
/// numbers. Robots are counted from 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_get_offset(
    space: *const cstk_space,
    robot: usize,
    out: *mut cstk_space_offset,
) -> cstk_status {
    guard(|| {
        let space = &*handle::share::<Space>(space, "space")?;
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
        let space = &*handle::share::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        let range = space
            .coordinates()
            .get(coordinate)
            .ok_or_else(|| absent("coordinate", coordinate, space.nq()))?;
        out.write(cstk_range::of(range));
        Ok(())
    })
}

pub(crate) fn absent(what: &str, number: usize, count: usize) -> Error {
    let message = format!("{what} {number} does not exist; the space has {count}");
    Error::new(ErrorKind::NotFound, message)
}
