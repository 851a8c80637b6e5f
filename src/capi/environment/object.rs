//! The objects of an environment.

use std::ffi::{c_char, c_void};

use crate::capi::at_configuration::answers::CSTK_NONE;
use crate::capi::boundary::{Failure, guard};
use crate::capi::environment::environment::cstk_environment;
use crate::capi::handle;
use crate::capi::input::{Output, OutputSlice, text};
use crate::capi::robot::robot::write_text;
use crate::capi::status::status::cstk_status;
use crate::capi::user_data::address;
use crate::environment::{Environment, SObject, Snapshot};
use crate::error::{Error, ErrorKind};

/// The state of an s-object.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_object_info {
    pub id: u64,
    /// In the world, or, for an attached object, in the link's frame.
    pub pose: [f64; 12],
    /// The link that it is attached to, by number in the space it was attached with; CSTK_NONE if it is not attached.
    pub link: u32,
    /// The number of other links that may touch it while it is attached.
    pub touch_count: u32,
    /// Its user data, or its body's if it has none, or NULL.
    pub data: *mut c_void,
    pub reserved: [u64; 8],
}

fn find(now: &Snapshot, id: u64) -> Result<&SObject, Failure> {
    now.find(id).ok_or_else(|| {
        let message = format!("there is no s-object with id {id}");
        Error::new(ErrorKind::NotFound, message).into()
    })
}

/// Writes the ids of the objects in the order in which they were added: at most `max_count` to `ids` (NULL if `max_count`
/// is 0), and their full number to `count`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_get_objects(
    environment: *const cstk_environment,
    max_count: usize,
    ids: *mut u64,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        let environment = handle::share::<Environment>(environment, "environment")?;
        let room = OutputSlice::checked(ids, max_count, "ids")?;
        let count = Output::checked(count, "count")?;
        let now = environment.snapshot();
        let all: Vec<u64> = now
            .objects()
            .map(|object| object.id)
            .take(max_count)
            .collect();
        room.write(&all);
        count.write(now.len());
        Ok(())
    })
}

/// Writes the pose, the attachment and the data of an s-object. CSTK_ERROR_NOT_FOUND for an unknown or deleted id.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_get_object_info(
    environment: *const cstk_environment,
    id: u64,
    out: *mut cstk_object_info,
) -> cstk_status {
    guard(|| {
        let environment = handle::share::<Environment>(environment, "environment")?;
        let out = Output::checked(out, "out")?;
        let now = environment.snapshot();
        let object = find(&now, id)?;
        let holder = object.attachment.as_ref();
        out.write(cstk_object_info {
            id,
            pose: object.pose.to_row_major(),
            link: holder.map_or(CSTK_NONE, |holder| holder.link as u32),
            touch_count: holder.map_or(0, |holder| holder.touch_links.len() as u32),
            data: address(object.data()),
            reserved: [0; 8],
        });
        Ok(())
    })
}

/// Writes the name of an s-object, empty if it has none: see cstk_robot_get_link_name for the buffer. CSTK_ERROR_NOT_FOUND for an
/// unknown or deleted id.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_get_object_name(
    environment: *const cstk_environment,
    id: u64,
    buffer: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> cstk_status {
    guard(|| {
        let environment = handle::share::<Environment>(environment, "environment")?;
        let now = environment.snapshot();
        let name = find(&now, id)?.name.as_deref().unwrap_or_default();
        write_text(name, buffer, capacity, length)
    })
}

/// Writes the id of the s-object with this name; of several the one that was added first. It looks at one object after the other.
/// CSTK_ERROR_NOT_FOUND if there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_find_object(
    environment: *const cstk_environment,
    name: *const c_char,
    out: *mut u64,
) -> cstk_status {
    guard(|| {
        let environment = handle::share::<Environment>(environment, "environment")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states that it is terminated.
        let name = unsafe { text(name, "name")? };
        let now = environment.snapshot();
        let mut named = now.objects().filter(|o| o.name.as_deref() == Some(name));
        let object = named.next().ok_or_else(|| {
            let message = format!("there is no s-object with the name \"{name}\"");
            Error::new(ErrorKind::NotFound, message)
        })?;
        out.write(object.id);
        Ok(())
    })
}

/// Writes the pose (12 doubles) of an s-object: in the world, or in the frame of the link that it is attached to (see
/// cstk_environment_get_object_info). CSTK_ERROR_NOT_FOUND for an unknown or deleted id.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_get_object_pose(
    environment: *const cstk_environment,
    id: u64,
    pose: *mut f64,
) -> cstk_status {
    guard(|| {
        let environment = handle::share::<Environment>(environment, "environment")?;
        let out = OutputSlice::checked(pose, 12, "pose")?;
        let now = environment.snapshot();
        out.write(&find(&now, id)?.pose.to_row_major());
        Ok(())
    })
}
