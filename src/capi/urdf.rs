//! Robots from URDF files.

use std::ffi::{c_char, c_void};
use std::path::{Path, PathBuf};

use super::body_builder::{cstk_progress_fn, reporter};
use super::boundary::{Failure, guard};
use super::hierarchy::cstk_hierarchy_options;
use super::input::{
    OptionsStruct, Output, index_or_none, options_or_default, path, slice, text, write_defaults,
};
use super::joint::cstk_joint_kind;
use super::robot_builder::{cstk_robot_builder, with_builder};
use super::status::cstk_status;
use crate::error::Error;
use crate::pose::Pose;
use crate::urdf::{BaseJoint, UrdfGeometry, UrdfOptions, add_urdf_file};

/// Which shapes of a URDF file's links become their bodies.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_urdf_geometry {
    /// The <collision> elements.
    CSTK_URDF_COLLISION = 0,
    /// The <visual> elements.
    CSTK_URDF_VISUAL = 1,
    /// None: the links have frames only, and no mesh file is looked for.
    CSTK_URDF_NO_GEOMETRY = 2,
}

/// How to read a URDF file. Write it with cstk_urdf_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_urdf_options {
    pub size: u32,
    pub cookie: u32,
    /// A cstk_urdf_geometry; default CSTK_URDF_COLLISION.
    pub geometry: i32,
    /// How the root link is joined to what carries the robot: CSTK_JOINT_FIXED (the default), _PLANAR, _FREE or
    /// _FREE_EULER.
    pub base: i32,
    /// The link of the builder that carries the robot, or -1 for the world.
    pub parent: i32,
    /// 0, the default, for spheres, cylinders and capsules as they are. Or into how many sides their circles are divided,
    /// 3 to 1024: polyhedra that hold the shapes, with contacts that span a cylinder's faces.
    pub sides: u32,
    /// Where the robot stands on its parent: a pose of 12 doubles.
    pub at: [f64; 12],
    /// Put before the names of links and joints, so that a file can be read twice; may be NULL.
    pub prefix: *const c_char,
    /// Folders in which the packages of package:// names are looked for; the folders that hold the URDF file are looked
    /// through after them.
    pub package_paths: *const *const c_char,
    pub package_path_count: usize,
    /// How the links' hierarchies are built; NULL for the defaults.
    pub hierarchy: *const cstk_hierarchy_options,
}

// SAFETY: repr(C), six 32-bit numbers, twelve doubles, four words: no padding; pointers only read after checks.
unsafe impl OptionsStruct for cstk_urdf_options {
    const COOKIE: u32 = 0x4353_0204;
    const NAME: &'static str = "cstk_urdf_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            geometry: 0,
            base: 0,
            parent: -1,
            sides: 0,
            at: Pose::identity().to_row_major(),
            prefix: std::ptr::null(),
            package_paths: std::ptr::null(),
            package_path_count: 0,
            hierarchy: std::ptr::null(),
        }
    }
}

/// Writes the default options. `size` is sizeof(cstk_urdf_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_urdf_options_default(
    out: *mut cstk_urdf_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Adds the robot of a URDF file to a builder of dimension 3: links and joints under their names, parents before
/// children, branch by branch, the branches of a link in the order of its joints in the file; the root link's number is
/// written to `root`, which may be NULL. `urdf_options` may be NULL for the defaults; `progress`, which may be NULL, is
/// told the part of the links that is done, `user` is passed to it.
///
/// Joints: fixed, revolute and prismatic (with their limits), continuous, floating, planar, spherical; mimic. Shapes:
/// box, sphere, cylinder, capsule, and meshes in OBJ, STL and DAE, scaled; several of one link become one body. Meshes
/// are surfaces: what is wholly inside one does not meet it. Whatever else the file says is passed over. Failures name
/// the file, the line and the element; the builder is then as it was.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_load_urdf(
    builder: *mut cstk_robot_builder,
    file: *const c_char,
    urdf_options: *const cstk_urdf_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    root: *mut u32,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let root = Output::optional(root, "root")?;
            // SAFETY: checked for NULL, size and cookie; the caller states that names are terminated.
            let (file, options) = unsafe {
                let given = options_or_default(urdf_options, "urdf_options")?;
                (path(file, "file")?, decode(&given)?)
            };
            let mut report = reporter(progress, user);
            let link = add_urdf_file(builder, file, &options, &mut report)?;
            root.write(link as u32);
            Ok(())
        })
    })
}

unsafe fn decode(given: &cstk_urdf_options) -> Result<UrdfOptions, Failure> {
    let geometry = match given.geometry {
        0 => UrdfGeometry::Collision,
        1 => UrdfGeometry::Visual,
        2 => UrdfGeometry::None,
        other => {
            let message = format!("urdf_options->geometry {other} is no cstk_urdf_geometry");
            return Err(Error::invalid(message).into());
        }
    };
    let bases = [
        (cstk_joint_kind::CSTK_JOINT_FIXED, BaseJoint::Fixed),
        (cstk_joint_kind::CSTK_JOINT_PLANAR, BaseJoint::Planar),
        (cstk_joint_kind::CSTK_JOINT_FREE, BaseJoint::Free),
        (cstk_joint_kind::CSTK_JOINT_FREE_EULER, BaseJoint::FreeEuler),
    ];
    let base = bases
        .into_iter()
        .find_map(|(code, base)| (code as i32 == given.base).then_some(base))
        .ok_or_else(|| {
            Error::invalid(format!(
                "urdf_options->base {} is no joint a base may have: fixed, planar, free or free by angles",
                given.base
            ))
        })?;
    // SAFETY: as the caller states.
    unsafe {
        let prefix = if given.prefix.is_null() {
            ""
        } else {
            text(given.prefix, "urdf_options->prefix")?
        };
        let paths = slice(
            given.package_paths,
            given.package_path_count,
            "urdf_options->package_paths",
        )?;
        let search = paths
            .iter()
            .enumerate()
            .map(|(i, &folder)| path(folder, &format!("urdf_options->package_paths[{i}]")))
            .map(|folder| folder.map(Path::to_path_buf))
            .collect::<Result<Vec<PathBuf>, Failure>>()?;
        Ok(UrdfOptions {
            geometry,
            base,
            parent: index_or_none(given.parent, "urdf_options->parent")?,
            at: Pose::from_row_major(&given.at).map_err(|e| e.within("urdf_options->at"))?,
            prefix: prefix.to_string(),
            search,
            sides: given.sides as usize,
            hierarchy: options_or_default(given.hierarchy, "urdf_options->hierarchy")?.decode()?,
        })
    }
}
