//! URDF.
//!
//! Robots from URDF files and texts: links, joints, limits, and the meshes and shapes of their collision geometry.
//!
//! ```c
//! uint32_t root;
//! check(cstk_robot_builder_create(3, &robot_builder));
//! check(cstk_robot_builder_load_urdf(robot_builder, "arm.urdf", NULL, NULL, NULL, &root));
//! check(cstk_robot_build(robot_builder, &robot));
//! ```

use std::collections::HashMap;
use std::ffi::{c_char, c_void};
use std::path::{Path, PathBuf};

use super::boundary::{Failure, guard};
use super::input::{
    OptionsStruct, Output, index_or_none, options_or_default, path, slice, text, write_defaults,
};
use crate::body::MeshForm;
use crate::capi::hierarchy::options::cstk_hierarchy_options;
use crate::capi::robot::builder::{cstk_robot_builder, with_builder};
use crate::capi::robot::joint::cstk_joint_kind;
use crate::capi::status::callbacks::{cstk_progress_fn, reporter};
use crate::capi::status::status::cstk_status;
use crate::error::{Error, ErrorKind};
use crate::pose::Pose;
use crate::urdf::{
    BaseJoint, LinkForms, UrdfGeometry, UrdfOptions, UrdfReport, add_urdf_file, add_urdf_text,
};

/// Which shapes of a URDF file's links become their bodies.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_urdf_geometry {
    /// The `collision` elements.
    CSTK_URDF_COLLISION = 0,
    /// The `visual` elements.
    CSTK_URDF_VISUAL = 1,
    /// None: the links have frames only, and no mesh file is read.
    CSTK_URDF_NO_GEOMETRY = 2,
}

/// What the meshes of a link, or of a scene's object, stand for.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_mesh_form {
    /// Their faces: a body wholly inside a mesh does not meet it.
    CSTK_MESH_SURFACE = 0,
    /// The solid that their faces bound, where all meshes of the body together are closed (see cstk_body_builder_set_solid);
    /// else their faces.
    CSTK_MESH_SOLID = 1,
    /// The convex hull of each mesh, a solid: what Drake and many MoveIt set-ups use.
    CSTK_MESH_HULL = 2,
}

impl cstk_mesh_form {
    pub(crate) fn decode(value: i32, argument: &str) -> Result<MeshForm, Failure> {
        let forms = [
            (Self::CSTK_MESH_SURFACE, MeshForm::Surface),
            (Self::CSTK_MESH_SOLID, MeshForm::Solid),
            (Self::CSTK_MESH_HULL, MeshForm::Hull),
        ];
        let found = forms.into_iter().find(|(code, _)| *code as i32 == value);
        found.map(|(_, form)| form).ok_or_else(|| {
            Error::invalid(format!("{argument} {value} is no cstk_mesh_form")).into()
        })
    }
}

/// The form of one link's meshes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_link_mesh_form {
    /// The link's name in the file, without a prefix.
    pub link: *const c_char,
    /// A cstk_mesh_form.
    pub form: i32,
    pub reserved: u32,
}

/// Options for reading a URDF file. Write it with cstk_urdf_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_urdf_options {
    pub size: u32,
    pub cookie: u32,
    /// A cstk_urdf_geometry; default CSTK_URDF_COLLISION.
    pub geometry: i32,
    /// The joint of the root link: CSTK_JOINT_FIXED (the default), _PLANAR, _FREE or _FREE_EULER.
    pub base: i32,
    /// The link of the builder that carries the robot, or -1 for the world.
    pub parent: i32,
    /// 0, the default, keeps spheres, cylinders and capsules exact. 3 to 1024 replaces them by polyhedra that enclose them,
    /// their circles divided into this many sides; contacts then span a cylinder's faces.
    pub sides: u32,
    /// The frame of the root's joint in the parent's frame: a pose of 12 doubles.
    pub at: [f64; 12],
    /// Prepended to the names of links and joints, so that a file can be loaded twice; may be NULL.
    pub prefix: *const c_char,
    /// Folders to search for the packages of package:// names, before the URDF file's folder and those above it. Last come
    /// the folders of the environment variables AMENT_PREFIX_PATH (packages lie in the folder share of each) and
    /// ROS_PACKAGE_PATH (each and the folders up to 4 levels below it, known by their names).
    pub package_paths: *const *const c_char,
    pub package_path_count: usize,
    /// How the links' hierarchies are built; NULL for the defaults.
    pub hierarchy: *const cstk_hierarchy_options,
    /// A folder that caches the links' bodies, so that the next load builds none of them; created if it does not exist.
    /// NULL, the default, for none. The key of a body is a digest of its meshes' bytes, its shapes and these options. A
    /// file that is damaged, or from another version of the library, is rebuilt and replaced. Processes may share the
    /// folder. Nothing is ever deleted from it. Whoever can write to it can change the robot's shapes.
    pub cache_folder: *const c_char,
    /// Forms of links whose meshes stand for something else than mesh_form says, by name: `link_form_count` entries; NULL,
    /// the default, for none. CSTK_ERROR_NOT_FOUND for a name that no link has.
    pub link_forms: *const cstk_link_mesh_form,
    pub link_form_count: usize,
    /// A cstk_mesh_form, for all other links; default CSTK_MESH_SURFACE.
    pub mesh_form: i32,
    pub reserved: u32,
}

// SAFETY: repr(C), six 32-bit numbers, twelve doubles, seven words, two 32-bit numbers: no padding; pointers only read after
// checks.
unsafe impl OptionsStruct for cstk_urdf_options {
    const COOKIE: u32 = 0x4353_0204;
    const NAME: &'static str = "cstk_urdf_options";
    const EARLIER_SIZES: &'static [usize] = &[152, 160];
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
            cache_folder: std::ptr::null(),
            link_forms: std::ptr::null(),
            link_form_count: 0,
            mesh_form: 0,
            reserved: 0,
        }
    }
}

/// What was read from a URDF file, what was built, and what was skipped.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_urdf_report {
    /// The number of the root link in the builder.
    pub root: u32,
    /// The number of `link` and of `joint` elements.
    pub link_count: u32,
    pub joint_count: u32,
    /// Links that have a body. A robot without any never collides.
    pub links_with_body: u32,
    /// Links without a body that have shapes of the kind not requested: `visual` with CSTK_URDF_COLLISION, and the reverse.
    /// If it is not 0, request the other kind, or load both as two robots.
    pub links_with_other_shapes: u32,
    /// The number of different bodies: links with equal shapes share one.
    pub body_count: u32,
    /// Bodies read from the cache folder; the others were built.
    pub bodies_from_cache: u32,
    /// Built bodies that could not be written to the cache folder.
    pub cache_failures: u32,
    /// The number of shapes of all links; those of a shared body count once for each link.
    pub shape_count: u32,
    pub mesh_file_count: u32,
    /// Elements of the robot, its links, joints and shapes that were skipped: inertia, materials, transmissions, shapes of
    /// the other kind.
    pub skipped_elements: u32,
    /// Bodies whose meshes are closed and became solids, where CSTK_MESH_SOLID asks for it.
    pub solid_body_count: u32,
    /// The number of convex primitives; those of a shared body count once.
    pub primitive_count: u64,
    /// Mesh faces that were not convex or not planar and were split into triangles, and those without area, which were left
    /// out.
    pub faces_split: u64,
    pub faces_dropped: u64,
    pub reserved: [u64; 6],
}

impl From<&UrdfReport> for cstk_urdf_report {
    fn from(report: &UrdfReport) -> Self {
        Self {
            root: report.root as u32,
            link_count: report.links as u32,
            joint_count: report.joints as u32,
            links_with_body: report.links_with_body as u32,
            links_with_other_shapes: report.links_with_other_shapes as u32,
            body_count: report.bodies as u32,
            bodies_from_cache: report.bodies_from_cache as u32,
            cache_failures: report.cache_failures as u32,
            shape_count: report.shapes as u32,
            mesh_file_count: report.mesh_files as u32,
            skipped_elements: report.skipped_elements as u32,
            solid_body_count: report.solid_bodies as u32,
            primitive_count: report.primitives,
            faces_split: report.faces_split,
            faces_dropped: report.faces_dropped,
            reserved: [0; 6],
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

/// Adds the robot of a URDF file to a builder of dimension 3: links and joints under their names, depth first, parents
/// before children, siblings in file order. The root link's number is written to `root`, which may be NULL. `urdf_options`
/// may be NULL for the defaults; `progress` may be NULL and receives the fraction of the links done; `user` is passed to
/// it.
///
/// Joints: fixed, revolute and prismatic (with their limits), continuous, floating, planar, spherical; mimic. Shapes: box,
/// sphere, cylinder, capsule, and meshes in OBJ, STL, PLY and DAE, scaled (as by cstk_body_builder_add_mesh); the shapes of one link become
/// one body. Meshes are surfaces unless the options' mesh forms make them solids or convex hulls. A mesh file is read once, and links with equal shapes share one
/// body, and its cstk_body_set_data. Everything else in the file is skipped; cstk_robot_builder_get_urdf_report counts it.
/// Error messages name the file, the line and the element; the builder is then unchanged.
///
/// Limits, beyond which a file is CSTK_ERROR_UNSUPPORTED: 64 MiB for the URDF file, 1 GiB for a mesh file; 2^17 links; 2^23
/// faces and 2^25 indices of faces, in one mesh file and in all bodies of the robot together, of which 2^20 faces and 2^22
/// indices may come from repeated use of a mesh or a geometry; 2^14 corners of a face, and 2^35 for the squares of the corners
/// of all faces added up, 2^31 of those repeated. In XML, 2^23 tags, 2^12 attributes of an element, 2^8 namespaces; in DAE, 2^20 nodes, transforms
/// and instances, 64 levels. Only regular files are read.
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
            let loaded = add_urdf_file(&mut builder.robot, file, &options, &mut report)?;
            builder.urdf = Some(loaded);
            root.write(loaded.root as u32);
            Ok(())
        })
    })
}

/// As cstk_robot_builder_load_urdf, from a NUL-terminated text in memory, UTF-8 and at most 64 MiB: what the robot_description
/// of ROS holds. Names of meshes are relative to `folder`; where it is NULL they must be absolute, or in packages. Error
/// messages begin with "URDF text", then name line and element.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_load_urdf_text(
    builder: *mut cstk_robot_builder,
    urdf: *const c_char,
    folder: *const c_char,
    urdf_options: *const cstk_urdf_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    root: *mut u32,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let root = Output::optional(root, "root")?;
            // SAFETY: checked for NULL, size and cookie; the caller states that texts are terminated.
            let (urdf, options) = unsafe {
                let given = options_or_default(urdf_options, "urdf_options")?;
                (text(urdf, "urdf")?, decode(&given)?)
            };
            let folder = if folder.is_null() {
                None
            } else {
                // SAFETY: not NULL; the caller states that it is terminated.
                Some(unsafe { path(folder, "folder")? })
            };
            let mut report = reporter(progress, user);
            let loaded = add_urdf_text(&mut builder.robot, urdf, folder, &options, &mut report)?;
            builder.urdf = Some(loaded);
            root.write(loaded.root as u32);
            Ok(())
        })
    })
}

/// Writes the report on the URDF file or text that was last added to the builder. CSTK_ERROR_EMPTY if there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_get_urdf_report(
    builder: *mut cstk_robot_builder,
    out: *mut cstk_urdf_report,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let out = Output::checked(out, "out")?;
            let report = builder.urdf.as_ref().ok_or_else(|| {
                Error::new(ErrorKind::Empty, "no URDF file was added to the builder")
            })?;
            out.write(report.into());
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
            forms: link_forms(given)?,
            cache_folder: if given.cache_folder.is_null() {
                None
            } else {
                Some(path(given.cache_folder, "urdf_options->cache_folder")?.to_path_buf())
            },
        })
    }
}

unsafe fn link_forms(given: &cstk_urdf_options) -> Result<LinkForms, Failure> {
    let argument = "urdf_options->link_forms";
    // SAFETY: checked for NULL; the header states the length.
    let entries = unsafe { slice(given.link_forms, given.link_form_count, argument)? };
    let mut named = HashMap::new();
    for (i, entry) in entries.iter().enumerate() {
        // SAFETY: checked for NULL; the caller states that it is terminated.
        let link = unsafe { text(entry.link, &format!("{argument}[{i}].link"))? };
        let form = cstk_mesh_form::decode(entry.form, &format!("{argument}[{i}].form"))?;
        named.insert(link.to_string(), form);
    }
    Ok(LinkForms {
        others: cstk_mesh_form::decode(given.mesh_form, "urdf_options->mesh_form")?,
        named,
    })
}
