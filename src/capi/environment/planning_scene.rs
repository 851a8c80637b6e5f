//! MoveIt's planning scenes as objects of an environment.

use std::any::Any;
use std::ffi::{CString, c_char};
use std::path::Path;
use std::sync::Arc;

use crate::capi::boundary::{Failure, guard};
use crate::capi::environment::environment::cstk_environment;
use crate::capi::handle;
use crate::capi::hierarchy::options::cstk_hierarchy_options;
use crate::capi::input::{
    OptionsStruct, Output, OutputSlice, options_or_default, path, text, write_defaults,
};
use crate::capi::status::status::cstk_status;
use crate::capi::urdf::cstk_mesh_form;
use crate::environment::{Addition, Change, Environment};
use crate::error::{Error, ErrorKind};
use crate::planning_scene::{SceneObject, SceneOptions, read_scene_file, read_scene_text};
use crate::pose::Pose;
use crate::user_data::UserData;

/// Options for reading a planning scene. Write it with cstk_scene_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_scene_options {
    pub size: u32,
    pub cookie: u32,
    /// Where the scene's frame is in the world: a pose of 12 doubles.
    pub at: [f64; 12],
    /// How the objects' hierarchies are built; NULL for the defaults.
    pub hierarchy: *const cstk_hierarchy_options,
    /// A cstk_mesh_form, for all meshes; default CSTK_MESH_SURFACE.
    pub mesh_form: i32,
    pub reserved: u32,
}

// SAFETY: repr(C), two u32, twelve doubles, a pointer, two 32-bit numbers: no padding; the pointer is only read after checks.
unsafe impl OptionsStruct for cstk_scene_options {
    const COOKIE: u32 = 0x4353_0303;
    const NAME: &'static str = "cstk_scene_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            at: Pose::identity().to_row_major(),
            hierarchy: std::ptr::null(),
            mesh_form: 0,
            reserved: 0,
        }
    }
}

/// Writes the default options. `size` is sizeof(cstk_scene_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_scene_options_default(
    out: *mut cstk_scene_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Adds the objects of a MoveIt planning scene, a `.scene` file (the text that MoveIt exports, of either version), to an
/// environment: all of them in one change, or none. Each object becomes one s-object: boxes, spheres, cylinders, cones and
/// meshes at their poses, one body. The scene ends at the word `.`; text after it is not read. Its user data (`s_data` of a witness) is its name, a NUL-terminated string that lives as
/// long as the object. Colours and subframes are skipped. The ids are written in the order of the file: at most `max_count` to
/// `ids` (NULL if `max_count` is 0), and their full number to `count`, which may be NULL. `scene_options` may be NULL.
///
/// Error messages name the file, the line and the object. Refused are unknown shapes, planes (they have no end; see
/// cstk_cobject_below_floor), objects without shapes, two objects of one name. Limits, beyond which a file is
/// CSTK_ERROR_UNSUPPORTED: 1 GiB, 2^17 shapes, 2^23 triangles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_load_scene(
    environment: *mut cstk_environment,
    file: *const c_char,
    scene_options: *const cstk_scene_options,
    max_count: usize,
    ids: *mut u64,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        let environment = &*handle::share::<Environment>(environment, "environment")?;
        let ids = OutputSlice::checked(ids, max_count, "ids")?;
        let count = Output::optional(count, "count")?;
        // SAFETY: checked for NULL, size and cookie; the caller states that names are terminated.
        let (file, options): (&Path, _) = unsafe { (path(file, "file")?, decode(scene_options)?) };
        let objects = read_scene_file(file, &options)?;
        let added = add(environment, objects)?;
        ids.write(&added);
        count.write(added.len());
        Ok(())
    })
}

/// As cstk_environment_load_scene, from a NUL-terminated text in memory, UTF-8. Error messages begin with "scene text".
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_load_scene_text(
    environment: *mut cstk_environment,
    scene: *const c_char,
    scene_options: *const cstk_scene_options,
    max_count: usize,
    ids: *mut u64,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        let environment = &*handle::share::<Environment>(environment, "environment")?;
        let ids = OutputSlice::checked(ids, max_count, "ids")?;
        let count = Output::optional(count, "count")?;
        // SAFETY: checked for NULL, size and cookie; the caller states that texts are terminated.
        let (scene, options) = unsafe { (text(scene, "scene")?, decode(scene_options)?) };
        let objects = read_scene_text(scene, &options).map_err(|e| e.within("scene text"))?;
        let added = add(environment, objects)?;
        ids.write(&added);
        count.write(added.len());
        Ok(())
    })
}

fn add(environment: &Environment, objects: Vec<SceneObject>) -> Result<Vec<u64>, Failure> {
    let changes = objects.into_iter().map(|object| {
        let short = object.name.clone();
        let name = CString::new(object.name)
            .map_err(|_| Error::new(ErrorKind::Parse, "an object's name holds a NUL"))?;
        let address = name.as_ptr() as usize;
        let keeper: Arc<dyn Any + Send + Sync> = Arc::new(name);
        Ok(Change::Add(Addition {
            name: Some(short.into()),
            data: Some(UserData::new(address, Some(keeper))),
            ..Addition::new(object.body, object.pose)
        }))
    });
    let changes = changes.collect::<Result<Vec<Change>, Error>>()?;
    Ok(environment.apply(&changes)?.0)
}

unsafe fn decode(given: *const cstk_scene_options) -> Result<SceneOptions, Failure> {
    // SAFETY: checked for size and cookie.
    unsafe {
        let given = options_or_default(given, "scene_options")?;
        let hierarchy = options_or_default(given.hierarchy, "scene_options->hierarchy")?;
        Ok(SceneOptions {
            at: Pose::from_row_major(&given.at).map_err(|e| e.within("scene_options->at"))?,
            form: cstk_mesh_form::decode(given.mesh_form, "scene_options->mesh_form")?,
            hierarchy: hierarchy.decode()?,
        })
    }
}
