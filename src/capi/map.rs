//! Maps.
//!
//! What is free on a grid over one to six coordinates, the others held: the class or the distance at the middle of every cell, or what is
//! proved of every whole cell. Maps are built coarse to fine: blocks of cells that are proved alike are filled at once, others are halved.
//! For classes, blocks of up to 16 cells are not proved but asked cell by cell. Where the cells are small beside the bodies, the cost
//! follows the boundary of the set rather than the number of cells; CSTK_MAP_CELLS costs more, as every cell at the boundary is a proof of
//! up to max_boxes parts. Maps are saved as arrays of NumPy's.
//!
//! ```c
//! cstk_map_axis axes[2] = {{0, 0, -3.14, 3.14, 512, 0, 0}, {1, 0, -3.14, 3.14, 512, 0, 0}};
//! cstk_map *map;
//! cstk_map_view view;
//! check(cstk_map_build(cobject, q, nq, axes, 2, NULL, NULL, NULL, &map));
//! check(cstk_map_get_view(map, &view));
//! if (view.values[3 * 512 + 7] == CSTK_CLASS_OUTSIDE) {
//!     printf("free in row 3, column 7\n");
//! }
//! check(cstk_map_save(map, "map.npy"));
//! check(cstk_map_show(map, "map.png"));
//! check(cstk_map_release(map));
//! ```

use std::ffi::{c_char, c_void};
use std::path::Path;
use std::sync::Arc;

use super::boundary::{Failure, guard};
use super::handle;
use super::handle::Noun;
use super::input::{
    OptionsStruct, Output, collected, options_or_default, path, slice, start, write_defaults,
};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::status::callbacks::{cstk_progress_fn, reporter};
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::error::Error;
use crate::map::{Map, MapAxis, MapKind, MapOptions, MapValues};
use crate::show::show_map;

/// A map of C-space. Immutable; threads may share it. It refers to no other object.
pub struct cstk_map {
    _opaque: [u8; 0],
}

/// The map and its axes as C has them.
pub(super) struct CMap {
    map: Map,
    axes: Vec<cstk_map_axis>,
}

impl Noun for CMap {
    type Handle = cstk_map;
    const KIND: u32 = 12;
    const NAME: &'static str = "cstk_map";
}

/// What a map tells of its cells.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_map_kind {
    /// The cstk_class at the middle of each cell, as cstk_classify has it. Where a C-object has contact epsilons or pure sets, what is
    /// proved not to be inside may be in contact, and is asked cell by cell; so are all cells where nothing can be proved, since a
    /// predicate without distances or a custom joint states no speed.
    CSTK_MAP_CLASSES = 0,
    /// The distance at the middle of each cell, as cstk_distance has it; every cell is asked.
    CSTK_MAP_DISTANCES = 1,
    /// The cstk_region_outcome of each whole cell, as cstk_region_classify has it: free or inside is proved at every configuration of the
    /// cell.
    CSTK_MAP_CELLS = 2,
}

/// An interval of a coordinate, cut into equal cells. The middle of cell i is low + (high - low) * ((i + 0.5) / cells).
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_map_axis {
    /// The coordinate's number in the space; none of a quaternion's.
    pub coordinate: u32,
    pub reserved_word: u32,
    /// Where the first cell begins and the last ends; finite, `low` below `high`. On a circle they may pass the place where angles
    /// wrap.
    pub low: f64,
    pub high: f64,
    /// How many cells there are, at least 1.
    pub cells: usize,
    /// The map is of a part of the cells: of `count` from number `first` on, or of all from there on where `count` is 0. They have the
    /// values that they have on a map of all cells, so that several machines may build a map in parts.
    pub first: usize,
    pub count: usize,
}

/// Options of a map. Write it with cstk_map_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_map_options {
    pub size: u32,
    pub cookie: u32,
    /// A cstk_map_kind. Default CSTK_MAP_CLASSES.
    pub kind: i32,
    /// The number of threads, the caller's among them, at most 1024; 0, the default, for as many as the machine runs at once. The map
    /// does not depend on it.
    pub threads: u32,
    /// Distances above this are not computed: infinity stands for them. Default infinity.
    pub max_distance: f64,
    /// The most parts that the proof of a single cell halves it into, at least 1. Default 64.
    pub max_boxes: u64,
}

// SAFETY: repr(C), four 4-byte numbers, a double, a u64: no padding.
unsafe impl OptionsStruct for cstk_map_options {
    const COOKIE: u32 = 0x4353_0602;
    const NAME: &'static str = "cstk_map_options";
    fn defaults() -> Self {
        let defaults = MapOptions::default();
        Self {
            size: 0,
            cookie: 0,
            kind: cstk_map_kind::CSTK_MAP_CLASSES as i32,
            threads: defaults.threads,
            max_distance: defaults.max_distance,
            max_boxes: defaults.max_boxes as u64,
        }
    }
}

/// The arrays of a map; they are valid as long as the map.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_map_view {
    pub kind: cstk_map_kind,
    pub reserved_word: u32,
    /// The axes, in the order given; their `count` is not 0.
    pub axes: *const cstk_map_axis,
    pub axis_count: usize,
    /// One entry for each cell of the map, row-major: of the last axis neighbours follow one another. NULL for distances.
    pub values: *const u8,
    /// The same of distances; NULL for other kinds.
    pub distances: *const f64,
    pub cell_count: usize,
    /// How many boxes it took to prove, and how many configurations were asked one by one.
    pub proofs: u64,
    pub questions: u64,
    pub reserved: [u64; 4],
}

/// Writes the default options. `size` is sizeof(cstk_map_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_map_options_default(
    out: *mut cstk_map_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Builds a map of a C-object. `axes` are `axis_count` intervals of different coordinates, 1 to 6; the other coordinates are those of
/// `q`, `nq` doubles. `options` may be NULL for the defaults. `progress` may be NULL; it is called on this thread, and `user` is passed
/// to it, between blocks of cells and while other threads work. The first failure ends the work. All cells see the state that the
/// environments are in at the call. Callbacks of C-objects and bodies are called from the map's threads, several at once.
///
/// The map holds a byte a cell, or 8 of distances. CSTK_ERROR_WRONG_SIZE for too many axes or cells, CSTK_ERROR_OUT_OF_MEMORY where the
/// values do not fit into memory, CSTK_ERROR_CANCELLED where `progress` says so; CSTK_ERROR_UNSUPPORTED for coordinates of a
/// quaternion, for distances where lengths and units of C-space mix, and, of CSTK_MAP_CELLS, for custom joints and predicates that state
/// no speed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_map_build(
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    axes: *const cstk_map_axis,
    axis_count: usize,
    options: *const cstk_map_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    out: *mut *mut cstk_map,
) -> cstk_status {
    guard(|| {
        let cobject = handle::share::<CObject>(cobject, "cobject")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
        let (q, axes, given) = unsafe {
            (
                slice(q, nq, "q")?,
                slice(axes, axis_count, "axes")?,
                options_or_default(options, "options")?,
            )
        };
        let options = given.decode()?;
        let known = collected(axes.iter().map(MapAxis::from), "axes")?;
        let map = Map::build(&cobject, q, &known, &options, &mut reporter(progress, user))?;
        let given = axes.iter().zip(map.axes());
        let axes = given.map(|(axis, known)| cstk_map_axis {
            count: known.part_length(),
            ..*axis
        });
        let axes = axes.collect();
        out.write(handle::create(Arc::new(CMap { map, axes })));
        Ok(())
    })
}

/// Writes the arrays of a map.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_map_get_view(
    map: *const cstk_map,
    out: *mut cstk_map_view,
) -> cstk_status {
    guard(|| {
        let CMap { map, axes } = handle::borrowed::<CMap>(map, "map")?;
        let out = Output::checked(out, "out")?;
        let (kind, values, distances) = match map.values() {
            MapValues::Classes(values) => (cstk_map_kind::CSTK_MAP_CLASSES, &values[..], &[][..]),
            MapValues::Cells(values) => (cstk_map_kind::CSTK_MAP_CELLS, &values[..], &[][..]),
            MapValues::Distances(all) => (cstk_map_kind::CSTK_MAP_DISTANCES, &[][..], &all[..]),
        };
        out.write(cstk_map_view {
            kind,
            reserved_word: 0,
            axes: start(axes),
            axis_count: axes.len(),
            values: start(values),
            distances: start(distances),
            cell_count: values.len().max(distances.len()),
            proofs: map.proofs(),
            questions: map.questions(),
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// The name of a file to be written.
unsafe fn named<'a>(file: *const c_char) -> Result<&'a Path, Failure> {
    // SAFETY: checked for NULL; the caller states the terminator.
    let file = unsafe { path(file, "file")? };
    if file.as_os_str().is_empty() {
        return Err(Error::invalid("file is empty: it names no file").into());
    }
    Ok(file)
}

/// Writes the values to a file that NumPy's load reads (.npy): an array with as many dimensions as the map has axes, of 8-bit unsigned
/// numbers, or of doubles for distances. The file is written whole or not at all; CSTK_ERROR_IO if that fails. This takes less than a
/// megabyte of memory besides the map, whatever its size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_map_save(map: *const cstk_map, file: *const c_char) -> cstk_status {
    guard(|| {
        let CMap { map, .. } = handle::borrowed::<CMap>(map, "map")?;
        // SAFETY: checked for NULL; the caller states the terminator.
        let file = unsafe { named(file)? };
        Ok(map.save(file)?)
    })
}

/// Writes a picture of a map. Of two axes (.png), a pixel a cell: the first axis goes to the right, the second up. Classes are white
/// (outside), orange (contact) and dark red (inside); cells white (free), dark red (inside), light gray (mixed) and gray (undecided). A
/// distance of 0 is black, the largest that is finite, and what is infinite, white. The picture is not compressed: a byte a cell.
///
/// Of three axes (.glb, a glTF file), the boundary of the cells that are inside, at distance 0, or not proved free, in the coordinates of
/// the axes as x, y and z. It is closed: beyond the map nothing is inside. The surface goes between the middles of unlike cells and
/// rounds edges and corners off, so that it may be nearer than the cells' own boundary, by half a cell at most: it is to be looked at.
///
/// The file is written whole or not at all; CSTK_ERROR_IO if that fails, CSTK_ERROR_UNSUPPORTED for maps with another number of axes, for
/// another ending than .glb of a map with three, and for a boundary of more than 29 million faces: each takes 144 bytes, and a .glb file
/// has less than 4 GB. This takes less than a megabyte of memory besides the map, whatever its size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_map_show(map: *const cstk_map, file: *const c_char) -> cstk_status {
    guard(|| {
        let CMap { map, .. } = handle::borrowed::<CMap>(map, "map")?;
        // SAFETY: checked for NULL; the caller states the terminator.
        let file = unsafe { named(file)? };
        Ok(show_map(map, file)?)
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_map_retain(map: *mut cstk_map) -> cstk_status {
    guard(|| handle::retain::<CMap>(map, "map"))
}

/// Drops a reference. NULL is a no-op.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_map_release(map: *mut cstk_map) -> cstk_status {
    guard(|| handle::release::<CMap>(map, "map"))
}

impl cstk_map_options {
    fn decode(&self) -> Result<MapOptions, Failure> {
        let kind = match self.kind {
            x if x == cstk_map_kind::CSTK_MAP_CLASSES as i32 => MapKind::Classes,
            x if x == cstk_map_kind::CSTK_MAP_DISTANCES as i32 => MapKind::Distances,
            x if x == cstk_map_kind::CSTK_MAP_CELLS as i32 => MapKind::Cells,
            other => {
                return Err(
                    Error::invalid(format!("kind is {other}, which is no cstk_map_kind")).into(),
                );
            }
        };
        Ok(MapOptions {
            kind,
            threads: self.threads,
            max_distance: self.max_distance,
            max_boxes: usize::try_from(self.max_boxes).unwrap_or(usize::MAX),
        })
    }
}

impl From<&cstk_map_axis> for MapAxis {
    fn from(axis: &cstk_map_axis) -> Self {
        Self {
            coordinate: axis.coordinate as usize,
            low: axis.low,
            high: axis.high,
            cells: axis.cells,
            part: match axis.count {
                0 => [axis.first, axis.cells],
                count => [axis.first, axis.first.saturating_add(count)],
            },
        }
    }
}
