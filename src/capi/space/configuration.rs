//! Operations on configurations of a space: steps and differences, samples, limits, link poses.

use crate::capi::at_configuration::answers::CSTK_NONE;
use crate::capi::boundary::{Failure, guard};
use crate::capi::handle;
use crate::capi::input::{Output, OutputSlice, array, numbers, slice};
use crate::capi::space::space::{absent, cstk_space};
use crate::capi::status::status::cstk_status;
use crate::error::require_coordinates;
use crate::pose::{Pose, Vec3};
use crate::robot::RobotState;
use crate::space::{Sampler, Space};

/// Writes whether every coordinate of q is in its range and every link's origin in the world box.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_contains(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    out: *mut bool,
) -> cstk_status {
    guard(|| {
        let space = &*handle::share::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let q = unsafe { configuration(space, q, nq, "q")? };
        out.write(space.contains(q)?);
        Ok(())
    })
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
        let space = &*handle::share::<Space>(space, "space")?;
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

/// Writes whether the origin of every link is in the world box at q, and to `link`, which may be NULL, the first that is
/// not (CSTK_NONE if all are).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_within_world(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    out: *mut bool,
    link: *mut u32,
) -> cstk_status {
    guard(|| {
        let space = &*handle::share::<Space>(space, "space")?;
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
        let space = &*handle::share::<Space>(space, "space")?;
        let out = OutputSlice::checked(poses.cast::<[f64; 12]>(), space.link_count(), "poses")?;
        // SAFETY: checked for NULL; the caller states the length.
        let q = unsafe { configuration(space, q, nq, "q")? };
        let poses = space.link_poses(q)?;
        let rows: Vec<[f64; 12]> = poses.iter().map(Pose::to_row_major).collect();
        out.write(&rows);
        Ok(())
    })
}

/// Writes the basic Jacobian (eq. 33) at q of a point fixed to a link of the space; as cstk_robot_jacobian, with the
/// space's nv.
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
        let space = &*handle::share::<Space>(space, "space")?;
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
        out.write(&space.jacobian(RobotState { q, poses }, link, &world)?);
        Ok(())
    })
}

/// Writes the neutral configuration, nq doubles: all coordinates 0, and identity quaternions 0, 0, 0, 1. It may be out of
/// range.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_get_neutral(
    space: *const cstk_space,
    q: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = &*handle::share::<Space>(space, "space")?;
        let out = OutputSlice::checked(q, space.nq(), "q")?;
        out.write(&space.neutral());
        Ok(())
    })
}

/// Writes the configuration reached from `q` with velocity `v` (`nv` doubles) after a unit of time: straight for intervals
/// and circles (which are not wrapped), at constant angular velocity for quaternions, along a screw for free joints. `out`
/// has `nq` doubles and may be `q`.
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
        let space = handle::borrowed::<Space>(space, "space")?;
        let out = OutputSlice::checked(out, space.nq(), "out")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (q, v) = unsafe { (configuration(space, q, nq, "q")?, slice(v, nv, "v")?) };
        space.check_velocity(v, "velocity")?;
        out.write(&reached(space, space.step(q, v))?);
        Ok(())
    })
}

/// Writes the smallest velocity that leads from `q0` to `q1` in a unit of time, nv doubles: circles go the shorter way
/// round (opposite angles the way of q1 - q0), quaternions turn by at most half a turn. From q1 to q0 it is the same way back, on
/// circles to the last bit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_difference(
    space: *const cstk_space,
    q0: *const f64,
    q1: *const f64,
    nq: usize,
    v: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrowed::<Space>(space, "space")?;
        let out = OutputSlice::checked(v, space.nv(), "v")?;
        // SAFETY: checked for NULL; the caller states the length.
        let [q0, q1] = unsafe { two_configurations(space, q0, q1, nq)? };
        out.write(&space.difference(q0, q1));
        Ok(())
    })
}

/// Writes the configuration at parameter `t` of the way from `q0` (t = 0) to `q1` (t = 1) at the constant velocity of
/// cstk_space_difference; `t` may lie outside [0, 1]. `out` has `nq` doubles and may be `q0` or `q1`. Free joints follow a
/// screw: their origin does not move straight, but where one of its coordinates does, that one stays between its ends. See
/// cstk_space_distance.
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
        let space = handle::borrowed::<Space>(space, "space")?;
        let out = OutputSlice::checked(out, space.nq(), "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let [q0, q1] = unsafe { two_configurations(space, q0, q1, nq)? };
        require_coordinates(&[t], "t")?;
        out.write(&reached(space, space.interpolate(q0, q1, t))?);
        Ok(())
    })
}

/// Writes the length of the difference of two configurations, each velocity multiplied by its weight: `weights` has nv
/// doubles, none negative, or is NULL for 1 each. It is a metric, except with free joints, or with unequal weights of a
/// spherical joint: there the triangle inequality fails. For planning trees use a chain of prismatic x, y, z and a
/// spherical joint instead, which translates straight and rotates separately.
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
        let space = handle::borrowed::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let [q0, q1] = unsafe { two_configurations(space, q0, q1, nq)? };
        // SAFETY: the header states the length.
        let weights = unsafe { checked_weights(space, weights)? };
        out.write(space.distance(q0, q1, weights));
        Ok(())
    })
}

/// cstk_space_distance from `q` to each of `count` configurations: `others` has count * nq doubles, one configuration after the
/// other, and `distances` receives `count` doubles. So a planner finds the nearest nodes of its tree in few calls. The message names
/// the first of `others` that is no configuration, and nothing is written then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_distances(
    space: *const cstk_space,
    q: *const f64,
    others: *const f64,
    count: usize,
    nq: usize,
    weights: *const f64,
    distances: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrowed::<Space>(space, "space")?;
        let distances = OutputSlice::checked(distances, count, "distances")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (q, others, weights) = unsafe {
            let q = configuration(space, q, nq, "q")?;
            let others = numbers(others, count, nq, "others")?;
            (q, others, checked_weights(space, weights)?)
        };
        let found = space.distances(q, others, count, weights);
        distances.write(&found.map_err(|(i, error)| error.within(format!("others[{i}]")))?);
        Ok(())
    })
}

/// The weights of velocities; `None` for NULL.
unsafe fn checked_weights<'a>(
    space: &Space,
    weights: *const f64,
) -> Result<Option<&'a [f64]>, Failure> {
    if weights.is_null() {
        return Ok(None);
    }
    // SAFETY: not NULL; as the caller states.
    let given = unsafe { slice(weights, space.nv(), "weights")? };
    space.check_weights(given)?;
    Ok(Some(given))
}

/// Writes a configuration drawn uniformly from the coordinates' ranges, and uniformly from the rotations for quaternions.
/// `state` is the state of the random number generator: any number to begin with; each call advances it. Equal states give
/// equal configurations, on every machine. CSTK_ERROR_UNSUPPORTED, naming the coordinate, where a range is unbounded.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_sample(
    space: *const cstk_space,
    state: *mut u64,
    q: *mut f64,
) -> cstk_status {
    guard(|| {
        let space = handle::borrowed::<Space>(space, "space")?;
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

/// Writes the nearest configuration with all coordinates in range; quaternions are normalized. `out` has `nq` doubles and
/// may be `q`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_clamp(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    out: *mut f64,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    guard(|| unsafe { change(space, q, nq, out, Space::clamp) })
}

/// Writes the same configuration with circles in [0, 2 pi), as in §4.4, and unit quaternions with w >= 0. `out` has `nq`
/// doubles and may be `q`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_wrap(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    out: *mut f64,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    guard(|| unsafe { change(space, q, nq, out, Space::wrap) })
}

unsafe fn change(
    space: *const cstk_space,
    q: *const f64,
    nq: usize,
    out: *mut f64,
    change: impl Fn(&Space, &[f64]) -> Vec<f64>,
) -> Result<(), Failure> {
    let space = &*handle::share::<Space>(space, "space")?;
    let out = OutputSlice::checked(out, space.nq(), "out")?;
    // SAFETY: as the caller states.
    let q = unsafe { configuration(space, q, nq, "q")? };
    out.write(&change(space, q));
    Ok(())
}

/// The configuration reached, refused if it is too far away.
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
