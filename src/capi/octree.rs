//! Octrees.
//!
//! An octree holds which cells of a grid are occupied: what a depth camera maps. Its cells are changed one by one or many
//! together, also while it is placed in an environment: only the objects around them are replaced, in one change, so that a
//! query sees the cells before it or after it. It is read from OctoMap's files, and gives a body where it need not change.
//!
//! ```c
//! const double seen[6] = {1.52, 0.33, 0.71, 1.52, 0.38, 0.71}, vanished[3] = {0.97, 0.12, 0.05};
//! cstk_octree *map;
//! check(cstk_octree_load("room.bt", 0.5, &map));
//! check(cstk_octree_place(map, environment, pose_a, NULL, NULL));
//! check(cstk_octree_set(map, seen, 2, true, NULL));
//! check(cstk_octree_set(map, vanished, 1, false, NULL));
//! check(cstk_octree_release(map));
//! ```

use std::ffi::{c_char, c_void};
use std::sync::Arc;

use super::body::body::cstk_body;
use super::boundary::{Failure, guard};
use super::environment::environment::cstk_environment;
use super::handle;
use super::handle::Noun;
use super::hierarchy::options::cstk_hierarchy_options;
use super::input::{Output, OutputSlice, options_or_default, path, points, pose};
use super::status::callbacks::{cstk_destroy_fn, cstk_progress_fn, reporter};
use super::status::status::cstk_status;
use super::user_data::CallerData;
use crate::environment::Environment;
use crate::exclusive::Exclusive;
use crate::octree::Octree;

/// Which cells of a grid are occupied. Serves one call at a time; another call meanwhile is CSTK_ERROR_BUSY. Queries on the
/// environment that it is placed in may run at any time.
pub struct cstk_octree {
    _opaque: [u8; 0],
}

pub(crate) struct SharedOctree(Exclusive<Octree>);

impl Noun for SharedOctree {
    type Handle = cstk_octree;
    const KIND: u32 = 13;
    const NAME: &'static str = "cstk_octree";
}

fn with_octree(
    octree: *const cstk_octree,
    action: impl FnOnce(&mut Octree) -> Result<(), Failure>,
) -> Result<(), Failure> {
    // A callback may release the caller's last reference meanwhile.
    let octree = handle::share::<SharedOctree>(octree, "octree")?;
    // Cells and objects are changed wholly or not at all.
    octree.0.with("the octree", |_| {}, action)
}

/// Creates an octree without occupied cells. Cell (i, j, k) reaches from i to i + 1 times `resolution` along x, and so on, in
/// the octree's frame, for whole numbers from -2^15 to 2^15 - 1: the grid of an OcTree of OctoMap with 16 levels.
/// CSTK_ERROR_INVALID_ARGUMENT, CSTK_ERROR_NOT_FINITE for a resolution that is not positive or finite, or whose grid would
/// pass 1e50.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_create(
    resolution: f64,
    out: *mut *mut cstk_octree,
) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        let octree = SharedOctree(Exclusive::new(Octree::new(resolution)?));
        out.write(handle::create(Arc::new(octree)));
        Ok(())
    })
}

/// Reads an octree from a file of OctoMap's: .bt, whose leaves are occupied or free, or .ot (of kind OcTree, OcTreeStamped or
/// ColorOcTree), whose leaves are occupied if their probability is at least `min_occupancy` (between 0 and 1; OctoMap takes
/// .5). What is free or unknown is empty. Which of both a file is, its first line tells.
///
/// CSTK_ERROR_PARSE for a file that is no such file, truncated, longer than its nodes, deeper than 16 levels, or of another
/// number of nodes than it says; CSTK_ERROR_NOT_FINITE for an occupancy that is NaN; CSTK_ERROR_UNSUPPORTED for another kind
/// of tree, above 1 GiB, or above 2^24 inner nodes. The message names the line or the node.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_load(
    file: *const c_char,
    min_occupancy: f64,
    out: *mut *mut cstk_octree,
) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states that it is terminated.
        let file = unsafe { path(file, "file")? };
        let octree = SharedOctree(Exclusive::new(Octree::load(file, min_occupancy)?));
        out.write(handle::create(Arc::new(octree)));
        Ok(())
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_retain(octree: *mut cstk_octree) -> cstk_status {
    guard(|| handle::retain::<SharedOctree>(octree, "octree"))
}

/// Drops a reference. NULL is a no-op. The objects of an octree that is placed stay in the environment as they are when the
/// last reference goes: cstk_octree_remove takes them out before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_release(octree: *mut cstk_octree) -> cstk_status {
    guard(|| handle::release::<SharedOctree>(octree, "octree"))
}

/// Makes the cells around `point_count` points (three doubles each, in the octree's frame) occupied, or empty. A point between
/// two cells belongs to the upper one. `changed` receives the number of cells that were not so before, or is NULL.
///
/// Where the octree is placed, the environment changes once, by the objects around the changed cells: each holds 4 x 4 x 4
/// cells, or a larger cube of occupied cells. The time is that of these objects' bodies, and does not depend on how
/// many other cells there are, but for the upkeep of the environment's tree (see cstk_environment_apply).
/// CSTK_ERROR_NOT_FINITE or CSTK_ERROR_INVALID_ARGUMENT for a point that is not finite or beyond the grid, with its number;
/// CSTK_ERROR_UNSUPPORTED above 2^24 inner nodes. Nothing has changed then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_set(
    octree: *mut cstk_octree,
    xyz: *const f64,
    point_count: usize,
    occupied: bool,
    changed: *mut usize,
) -> cstk_status {
    guard(|| {
        with_octree(octree, |octree| {
            let changed = Output::optional(changed, "changed")?;
            // SAFETY: checked for NULL; the caller states the length.
            let points = unsafe { points(xyz, point_count, "xyz")? };
            changed.write(octree.set(points, occupied)?);
            Ok(())
        })
    })
}

/// Writes to `occupied` (`point_count` entries) whether the cells around points are occupied. Errors as of cstk_octree_set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_get(
    octree: *const cstk_octree,
    xyz: *const f64,
    point_count: usize,
    occupied: *mut bool,
) -> cstk_status {
    guard(|| {
        with_octree(octree, |octree| {
            let occupied = OutputSlice::checked(occupied, point_count, "occupied")?;
            // SAFETY: checked for NULL; the caller states the length.
            let points = unsafe { points(xyz, point_count, "xyz")? };
            occupied.write(&octree.are_occupied(points)?);
            Ok(())
        })
    })
}

/// Makes the cells that are occupied in `other` occupied. CSTK_ERROR_INVALID_ARGUMENT if the resolutions differ. The
/// environment follows as after cstk_octree_set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_insert(
    octree: *mut cstk_octree,
    other: *const cstk_octree,
) -> cstk_status {
    guard(|| {
        let other = handle::share::<SharedOctree>(other, "other")?;
        let same = handle::share::<SharedOctree>(octree, "octree")?;
        if Arc::ptr_eq(&other, &same) {
            return Ok(());
        }
        with_octree(octree, |octree| {
            let insert = |other: &mut Octree| Ok(octree.insert(other)?);
            other.0.with("the other octree", |_| {}, insert)
        })
    })
}

/// Writes the edge of a cell, the number of occupied cells, and the number of objects that the octree is in its environment;
/// each may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_get_state(
    octree: *const cstk_octree,
    resolution: *mut f64,
    cell_count: *mut u64,
    object_count: *mut usize,
) -> cstk_status {
    guard(|| {
        with_octree(octree, |octree| {
            let resolution = Output::optional(resolution, "resolution")?;
            let cell_count = Output::optional(cell_count, "cell_count")?;
            let object_count = Output::optional(object_count, "object_count")?;
            resolution.write(octree.resolution());
            cell_count.write(octree.cell_count());
            object_count.write(octree.object_count());
            Ok(())
        })
    })
}

/// Writes the occupied cells as cubes: eight cells, or cubes, that fill a cube of the octree are one. Four doubles each, the
/// lowest corner and the edge: at most `max_count` cubes to `cubes` (NULL if `max_count` is 0), and their full number to
/// `count`. Equal cells have equal cubes in equal order, however they became so.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_get_cubes(
    octree: *const cstk_octree,
    max_count: usize,
    cubes: *mut f64,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        with_octree(octree, |octree| {
            let room = OutputSlice::checked(cubes, max_count.saturating_mul(4), "cubes")?;
            let count = Output::checked(count, "count")?;
            let (mut numbers, mut total) = (Vec::new(), 0);
            octree.visit_cubes(&mut |low, edge| {
                if total < max_count {
                    numbers.extend([low.x, low.y, low.z, edge]);
                }
                total += 1;
            });
            room.write(&numbers);
            count.write(total);
            Ok(())
        })
    })
}

/// Builds a body of the occupied cells, in the octree's frame: each cube of cstk_octree_get_cubes is a solid box, tagged with
/// its number. It does not change any more, and may be a link or a part as any body. `options` may be NULL; `progress` may be
/// NULL; `user` is passed to it. CSTK_ERROR_EMPTY if no cell is occupied, CSTK_ERROR_UNSUPPORTED above 2^22 cubes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_build_body(
    octree: *const cstk_octree,
    options: *const cstk_hierarchy_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    out: *mut *mut cstk_body,
) -> cstk_status {
    guard(|| {
        with_octree(octree, |octree| {
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for size and cookie.
            let options = unsafe { options_or_default(options, "options")? };
            let options = options.decode()?;
            let mut report = reporter(progress, user);
            let body = octree.body(&options, &mut report)?;
            out.write(handle::create(Arc::new(body)));
            Ok(())
        })
    })
}

/// Places the octree in an environment, its frame at `pose` (12 doubles), in one change. From now on changes of cells change
/// the environment too. It can be in one environment at a time: CSTK_ERROR_INVALID_ARGUMENT if it is in one.
///
/// To queries the octree is several s-objects, which cover its occupied cells and are as exact as boxes; their ids change with
/// the cells. All have the user data `data`, so that the `s_data` of a witness names the octree. `destroy` may be NULL; it is
/// called once, by the thread that drops the last state that holds an object, and not if this call fails; it must not call
/// the octree. A C-object that is to be about the octree alone takes all objects of an environment that holds nothing else.
/// Do not move, attach or delete the objects one by one; those that are gone are not missed.
///
/// The objects stand at rounded places. So that there is no gap between them, each reaches over its neighbours by up to 2e-15 L, where L
/// is how far it is from the octree's origin and that from the world's together; distances may be too small by twice that.
///
/// CSTK_ERROR_UNSUPPORTED for a snapshot.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_place(
    octree: *mut cstk_octree,
    environment: *mut cstk_environment,
    pose: *const f64,
    data: *mut c_void,
    destroy: cstk_destroy_fn,
) -> cstk_status {
    guard(|| {
        with_octree(octree, |octree| {
            let environment = handle::share::<Environment>(environment, "environment")?;
            // SAFETY: checked for NULL; the header states the length.
            let pose = unsafe { self::pose(pose, "pose")? };
            let data = CallerData::new(data, destroy);
            octree.place(&environment, &pose, data.as_user_data())?;
            data.take_ownership();
            Ok(())
        })
    })
}

/// Moves an octree within its environment, in one change. Its objects keep their ids, but for those that get so much farther from
/// the world's origin, or nearer to it, that they must reach over their neighbours by more or by less. CSTK_ERROR_NOT_FOUND if
/// the octree is in none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_move(
    octree: *mut cstk_octree,
    pose: *const f64,
) -> cstk_status {
    guard(|| {
        with_octree(octree, |octree| {
            // SAFETY: checked for NULL; the header states the length.
            let pose = unsafe { self::pose(pose, "pose")? };
            Ok(octree.move_to(&pose)?)
        })
    })
}

/// Takes an octree out of its environment, in one change; its cells stay. A no-op if it is in none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_octree_remove(octree: *mut cstk_octree) -> cstk_status {
    guard(|| with_octree(octree, |octree| Ok(octree.remove()?)))
}
