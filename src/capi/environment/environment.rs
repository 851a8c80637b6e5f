//! Environments.

use std::ffi::{c_char, c_void};
use std::sync::Arc;

use crate::body::Body;
use crate::capi::body::body::cstk_body;
use crate::capi::boundary::{Failure, guard};
use crate::capi::handle;
use crate::capi::handle::Noun;
use crate::capi::input::{
    OptionsStruct, Output, OutputSlice, options_in_place, reserved, slice, text, write_defaults,
};
use crate::capi::space::space::cstk_space;
use crate::capi::status::callbacks::cstk_destroy_fn;
use crate::capi::status::status::cstk_status;
use crate::capi::user_data::CallerData;
use crate::environment::{Addition, Attachment, Change, Environment};
use crate::error::Error;
use crate::pose::Pose;
use crate::space::Space;

/// A set of s-objects. It may be changed while other threads query it: each query sees one consistent state. It keeps
/// references to the bodies of its objects.
pub struct cstk_environment {
    _opaque: [u8; 0],
}

impl Noun for Environment {
    type Handle = cstk_environment;
    const KIND: u32 = 6;
    const NAME: &'static str = "cstk_environment";
}

/// The kinds of changes.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_change_kind {
    /// Adds `body` at `pose`; the new object's id is an output of cstk_environment_apply.
    CSTK_CHANGE_ADD = 0,
    /// Moves object `id` to `pose`; an attached object is detached.
    CSTK_CHANGE_MOVE = 1,
    /// Deletes object `id`.
    CSTK_CHANGE_DELETE = 2,
    /// Attaches object `id` to `link` of `space` at `pose`, in the link's frame: a grasp. Nothing is rebuilt. To grasp an
    /// object where it is, pass the inverse of the link's pose composed with the object's pose. To release it in place, use
    /// CSTK_CHANGE_MOVE with the link's pose composed with `pose`. Attaching an attached object changes its pose or its
    /// touch links.
    CSTK_CHANGE_ATTACH = 3,
}

/// A change of an environment. Write it with cstk_environment_change_default first: an addition at the world's origin.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_environment_change {
    pub size: u32,
    pub cookie: u32,
    /// A cstk_change_kind.
    pub kind: i32,
    pub reserved: u32,
    /// The object to move, delete or attach.
    pub id: u64,
    /// The body to add.
    pub body: *const cstk_body,
    /// The body's frame, 12 doubles: in the world, for CSTK_CHANGE_ATTACH in the link's frame.
    pub pose: [f64; 12],
    /// For CSTK_CHANGE_ATTACH: the space, and the number of the link that holds the object. The object moves with the link. Given
    /// with CSTK_CHANGE_ADD, the new object comes attached, `pose` then in the link's frame.
    /// Queries in other spaces on sets that include the object fail with CSTK_ERROR_UNSUPPORTED, since its pose is unknown
    /// there. In a set of links against s-objects, it is tested against the other s-objects as the link itself is
    /// (`r_object` of a witness names it); and as an s-object against the links, except the link that holds it and the
    /// `touch_count` links in `touch_links` (the fingers, say). Those may touch it only while it is attached: for approach
    /// and retreat create a second set with `allowed` of cstk_induced_options. It is tested against other objects that its
    /// touch links hold, not against those that its own link holds.
    pub space: *const cstk_space,
    pub touch_links: *const u32,
    pub link: u32,
    pub touch_count: u32,
    /// For CSTK_CHANGE_ADD: user data, returned with witnesses. `destroy` may be NULL; it is called once, by the thread
    /// that drops the last state that holds the object, and not if the change fails.
    pub data: *mut c_void,
    pub destroy: cstk_destroy_fn,
    /// For CSTK_CHANGE_ADD: the object's name, UTF-8, which is copied; NULL or empty for none. Several objects may have one name.
    pub name: *const c_char,
}

// SAFETY: repr(C), no padding (16 + 8 + 8 + 96 + 6 * 8 bytes on 64-bit machines), the pointers are only read after checks.
unsafe impl OptionsStruct for cstk_environment_change {
    const EARLIER_SIZES: &'static [usize] = &[128, 168];
    const COOKIE: u32 = 0x4353_0301;
    const NAME: &'static str = "cstk_environment_change";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            kind: 0,
            reserved: 0,
            id: 0,
            body: std::ptr::null(),
            pose: Pose::identity().to_row_major(),
            space: std::ptr::null(),
            touch_links: std::ptr::null(),
            link: 0,
            touch_count: 0,
            data: std::ptr::null_mut(),
            destroy: None,
            name: std::ptr::null(),
        }
    }
}

/// Creates an empty environment.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_create(out: *mut *mut cstk_environment) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        out.write(handle::create(Arc::<Environment>::default()));
        Ok(())
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_retain(
    environment: *mut cstk_environment,
) -> cstk_status {
    guard(|| handle::retain::<Environment>(environment, "environment"))
}

/// Drops a reference. NULL is a no-op. C-objects hold references to their environments.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_release(
    environment: *mut cstk_environment,
) -> cstk_status {
    guard(|| handle::release::<Environment>(environment, "environment"))
}

/// Writes the default change. `size` is sizeof(cstk_environment_change).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_change_default(
    out: *mut cstk_environment_change,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Applies `count` changes together: all of them or, on failure, none. `ids` receives the id of the object of each change
/// (`count` entries, or NULL); `version` the environment's new version (or NULL). Ids are never reused, and are unique in
/// the process. All changes have the size of the first.
///
/// A change takes some microseconds, whatever the number of objects, and much less when many are applied in one call: the
/// bounding volumes above objects that stay near are refitted in one pass. After changes of at least a sixteenth of the
/// objects the tree over all objects may be rebuilt (some microseconds an object). Meanwhile other threads that apply
/// changes wait; queries never do. The environment keeps the memory of the state before the last change for the next
/// change; if a query or a snapshot still holds that state, the changed parts are copied.
///
/// CSTK_ERROR_NOT_FOUND for an unknown or deleted id, CSTK_ERROR_UNSUPPORTED for a snapshot.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_apply(
    environment: *mut cstk_environment,
    changes: *const cstk_environment_change,
    count: usize,
    ids: *mut u64,
    version: *mut u64,
) -> cstk_status {
    guard(|| {
        let environment = &*handle::share::<Environment>(environment, "environment")?;
        let ids = OutputSlice::checked(ids, if ids.is_null() { 0 } else { count }, "ids")?;
        let version = Output::optional(version, "version")?;
        if count > 0 {
            // SAFETY: as below. Before memory is asked for on the caller's word.
            let _ = unsafe { options_in_place(changes, "changes[0]")? };
        }
        let (mut read, mut kept) = (reserved(count, "changes")?, Vec::new());
        let (mut next, mut first_size) = (changes, None);
        for i in 0..count {
            // SAFETY: checked for size and cookie; the caller states that `count` of them follow one another.
            let change = unsafe { options_in_place(next, format_args!("changes[{i}]"))? };
            let size = *first_size.get_or_insert(change.size);
            if change.size != size {
                return Err(Failure::new(
                    cstk_status::CSTK_ERROR_WRONG_SIZE,
                    format!(
                        "changes[{i}].size is {}, that of changes[0] is {size}",
                        change.size
                    ),
                ));
            }
            // SAFETY: checked for NULL; the header states the length.
            read.push(unsafe { change_from(&change, i, &mut kept)? });
            next = next.wrapping_byte_add(change.size as usize);
        }
        let (applied, now) = environment.apply(&read)?;
        kept.iter().for_each(|data| data.take_ownership());
        ids.write(&applied);
        version.write(now);
        Ok(())
    })
}

unsafe fn change_from(
    change: &cstk_environment_change,
    i: usize,
    kept: &mut Vec<Arc<CallerData>>,
) -> Result<Change, Failure> {
    let pose = || {
        Pose::from_row_major(&change.pose).map_err(|e| e.within(format_args!("changes[{i}].pose")))
    };
    let is = |kind: cstk_change_kind| change.kind == kind as i32;
    if is(cstk_change_kind::CSTK_CHANGE_ADD) {
        let body = handle::share::<Body>(change.body, &format!("changes[{i}].body"))?;
        // SAFETY: as the caller states.
        let (attachment, name) = unsafe {
            let attachment = match change.space.is_null() {
                true => None,
                false => Some(attachment_from(change, i)?),
            };
            (attachment, name_from(change, i)?)
        };
        let data = CallerData::new(change.data, change.destroy);
        let added = Change::Add(Addition {
            body,
            pose: pose()?,
            attachment,
            name,
            data: data.as_user_data(),
        });
        kept.push(data);
        Ok(added)
    } else if is(cstk_change_kind::CSTK_CHANGE_MOVE) {
        Ok(Change::Move {
            id: change.id,
            pose: pose()?,
        })
    } else if is(cstk_change_kind::CSTK_CHANGE_ATTACH) {
        Ok(Change::Attach {
            id: change.id,
            pose: pose()?,
            // SAFETY: as the caller states.
            attachment: unsafe { attachment_from(change, i)? },
        })
    } else if is(cstk_change_kind::CSTK_CHANGE_DELETE) {
        Ok(Change::Delete { id: change.id })
    } else {
        let kind = change.kind;
        Err(Error::invalid(format!("changes[{i}].kind {kind} is no cstk_change_kind")).into())
    }
}

unsafe fn attachment_from(
    change: &cstk_environment_change,
    i: usize,
) -> Result<Attachment, Failure> {
    let space = &*handle::share::<Space>(change.space, &format!("changes[{i}].space"))?;
    let count = change.touch_count as usize;
    let name = format!("changes[{i}].touch_links");
    // SAFETY: checked for NULL; the header states the length.
    let touch_links = unsafe { slice(change.touch_links, count, &name)? };
    let touch_links: Vec<usize> = touch_links.iter().map(|&link| link as usize).collect();
    Attachment::new(space, change.link as usize, &touch_links)
        .map_err(|e| e.within(format_args!("changes[{i}]")).into())
}

unsafe fn name_from(
    change: &cstk_environment_change,
    i: usize,
) -> Result<Option<Arc<str>>, Failure> {
    if change.name.is_null() {
        return Ok(None);
    }
    // SAFETY: checked for NULL; the caller states that it is terminated.
    let name = unsafe { text(change.name, &format!("changes[{i}].name"))? };
    Ok((!name.is_empty()).then(|| name.into()))
}

/// Creates a snapshot: an environment that stays as this one is now. It can be used wherever an environment can, but not
/// changed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_snapshot(
    environment: *const cstk_environment,
    out: *mut *mut cstk_environment,
) -> cstk_status {
    guard(|| {
        let environment = &*handle::share::<Environment>(environment, "environment")?;
        let out = Output::checked(out, "out")?;
        out.write(handle::create(Arc::new(environment.freeze())));
        Ok(())
    })
}

/// Writes the number of objects and the version, which counts the successful calls of cstk_environment_apply; either may be
/// NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_get_state(
    environment: *const cstk_environment,
    object_count: *mut usize,
    version: *mut u64,
) -> cstk_status {
    guard(|| {
        let environment = &*handle::share::<Environment>(environment, "environment")?;
        let object_count = Output::optional(object_count, "object_count")?;
        let version = Output::optional(version, "version")?;
        let now = environment.snapshot();
        object_count.write(now.len());
        version.write(now.version);
        Ok(())
    })
}
