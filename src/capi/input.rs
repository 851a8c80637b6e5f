//! Checks arguments: slices, strings, outputs, and options structures.

use std::ffi::{CStr, c_char};
use std::fmt::{self, Display};
use std::ops::Deref;

use super::boundary::Failure;
use crate::capi::status::status::cstk_status;
use crate::error::{Error, ErrorKind};
use crate::pose::{Pose, Vec3};
use crate::room::room_for;

/// The number of entries of `count` items of `width` each.
pub fn product(count: usize, width: usize, argument: &str) -> Result<usize, Failure> {
    let entries = count.checked_mul(width);
    entries.ok_or_else(|| too_many(count, width, argument))
}

#[cold]
pub fn too_many(count: usize, width: usize, argument: &str) -> Failure {
    Failure::new(
        cstk_status::CSTK_ERROR_WRONG_SIZE,
        format!("{argument} cannot have {count} times {width} entries"),
    )
}

/// The error for a pointer that must not be NULL.
#[cold]
pub fn null(argument: &str) -> Failure {
    Failure::new(
        cstk_status::CSTK_ERROR_NULL_ARGUMENT,
        format!("{argument} is NULL"),
    )
}

#[cold]
fn misaligned(argument: &str) -> Failure {
    Failure::new(
        cstk_status::CSTK_ERROR_INVALID_ARGUMENT,
        format!("{argument} is not aligned for its type"),
    )
}

/// `count` items; NULL is allowed if the count is 0.
pub unsafe fn slice<'a, T>(
    items: *const T,
    count: usize,
    argument: &str,
) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    if items.is_null() {
        return Err(null(argument));
    }
    if !items.is_aligned() {
        return Err(misaligned(argument));
    }
    require_addressable::<T>(count, argument)?;
    // SAFETY: not null, aligned, and the caller states that it holds `count` items.
    Ok(unsafe { std::slice::from_raw_parts(items, count) })
}

/// The same of a list that may be left out, by NULL and a count of 0.
///
/// # Safety
/// As for [`slice`].
pub unsafe fn optional_slice<'a, T>(
    items: *const T,
    count: usize,
    argument: &str,
) -> Result<Option<&'a [T]>, Failure> {
    if items.is_null() && count == 0 {
        return Ok(None);
    }
    // SAFETY: as the caller states.
    unsafe { slice(items, count, argument) }.map(Some)
}

/// Refuses more items than memory has addresses for. Room for an answer may be more: it is not all written to.
pub fn require_addressable<T>(count: usize, argument: &str) -> Result<(), Failure> {
    if count > isize::MAX as usize / size_of::<T>().max(1) {
        return Err(Failure::new(
            cstk_status::CSTK_ERROR_WRONG_SIZE,
            format!("{argument} cannot have {count} entries"),
        ));
    }
    Ok(())
}

/// Collects items whose count comes from the caller. If there is not enough memory, the call is refused.
pub fn collected<T>(
    items: impl ExactSizeIterator<Item = T>,
    argument: impl Display,
) -> Result<Vec<T>, Failure> {
    let mut collected = reserved(items.len(), argument)?;
    collected.extend(items);
    Ok(collected)
}

/// An empty array with room for `count` items. If there is not enough memory, the call is refused.
pub fn reserved<T>(count: usize, argument: impl Display) -> Result<Vec<T>, Failure> {
    Ok(room_for(count).map_err(|error| error.within(argument))?)
}

/// `count` points of three numbers each.
pub unsafe fn points<'a>(
    xyz: *const f64,
    count: usize,
    argument: &str,
) -> Result<&'a [Vec3], Failure> {
    // SAFETY: as the caller states; a Vec3 is three numbers, one after the other.
    unsafe { slice(xyz.cast(), count, argument) }
}

/// A pose of 12 numbers.
#[inline(always)]
pub unsafe fn pose(values: *const f64, argument: &str) -> Result<Pose, Failure> {
    // SAFETY: as the caller states.
    let values = unsafe { array::<12>(values, argument)? };
    Ok(Pose::from_row_major(values).map_err(|e| e.within(argument))?)
}

/// Exactly N numbers.
#[inline(always)]
pub unsafe fn array<'a, const N: usize>(
    values: *const f64,
    argument: &str,
) -> Result<&'a [f64; N], Failure> {
    if values.is_null() {
        return Err(null(argument));
    }
    if !values.is_aligned() {
        return Err(misaligned(argument));
    }
    // SAFETY: not null, aligned, and the caller states that it holds N numbers.
    Ok(unsafe { &*values.cast::<[f64; N]>() })
}

/// The numbers of `count` items of `width` each.
pub unsafe fn numbers<'a>(
    values: *const f64,
    count: usize,
    width: usize,
    argument: &str,
) -> Result<&'a [f64], Failure> {
    let entries = product(count, width, argument)?;
    // SAFETY: as the caller states.
    unsafe { slice(values, entries, argument) }
}

/// A C string as text; must be UTF-8.
pub unsafe fn text<'a>(string: *const c_char, argument: &str) -> Result<&'a str, Failure> {
    // SAFETY: as the caller states.
    let string = unsafe { c_string(string, argument)? };
    string.to_str().map_err(|_| {
        Failure::new(
            cstk_status::CSTK_ERROR_INVALID_ARGUMENT,
            format!("{argument} is not UTF-8"),
        )
    })
}

/// A file's path; any bytes.
pub unsafe fn path<'a>(
    string: *const c_char,
    argument: &str,
) -> Result<&'a std::path::Path, Failure> {
    // SAFETY: as the caller states.
    let string = unsafe { c_string(string, argument)? };
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        Ok(std::path::Path::new(std::ffi::OsStr::from_bytes(
            string.to_bytes(),
        )))
    }
    #[cfg(not(unix))]
    {
        let text = string.to_str().map_err(|_| {
            Failure::new(
                cstk_status::CSTK_ERROR_INVALID_ARGUMENT,
                format!("{argument} is not UTF-8"),
            )
        })?;
        Ok(std::path::Path::new(text))
    }
}

unsafe fn c_string<'a>(string: *const c_char, argument: &str) -> Result<&'a CStr, Failure> {
    if string.is_null() {
        return Err(null(argument));
    }
    // SAFETY: not null, and the caller states that it is a terminated string.
    Ok(unsafe { CStr::from_ptr(string) })
}

/// Refuses a number of entries that is not the space's.
pub fn require_width(given: usize, expected: usize, name: &str, what: &str) -> Result<(), Failure> {
    if given == expected {
        return Ok(());
    }
    let message = format!("{name} is {given}, but the space has {expected} {what}");
    Err(Error::new(ErrorKind::WrongSize, message).into())
}

/// The destination of a result, checked before the call's work and written last.
pub struct Output<T>(*mut T);

impl<T> Output<T> {
    #[inline(always)]
    pub fn checked(out: *mut T, argument: &str) -> Result<Self, Failure> {
        if out.is_null() {
            return Err(null(argument));
        }
        if !out.is_aligned() {
            return Err(misaligned(argument));
        }
        Ok(Self(out))
    }

    /// NULL is allowed: then nothing is written.
    pub fn optional(out: *mut T, argument: &str) -> Result<OptionalOutput<T>, Failure> {
        if out.is_null() {
            return Ok(OptionalOutput(None));
        }
        Ok(OptionalOutput(Some(Self::checked(out, argument)?)))
    }

    pub fn address(&self) -> usize {
        self.0.addr()
    }

    #[inline(always)]
    pub fn write(self, value: T) {
        // SAFETY: checked at construction; the caller states that it is writable.
        unsafe { self.0.write(value) }
    }
}

/// The destination of a result that the caller may leave out.
pub struct OptionalOutput<T>(Option<Output<T>>);

impl<T> OptionalOutput<T> {
    pub fn write(self, value: T) {
        if let Some(out) = self.0 {
            out.write(value);
        }
    }
}

/// The destination of `count` results.
pub struct OutputSlice<T> {
    items: *mut T,
    count: usize,
}

impl<T: Copy> OutputSlice<T> {
    pub fn checked(items: *mut T, count: usize, argument: &str) -> Result<Self, Failure> {
        if count > 0 {
            Output::checked(items, argument)?;
        }
        Ok(Self { items, count })
    }

    /// NULL is allowed: then nothing is written.
    pub fn optional(
        items: *mut T,
        count: usize,
        argument: &str,
    ) -> Result<OptionalOutputSlice<T>, Failure> {
        if items.is_null() {
            return Ok(OptionalOutputSlice(None));
        }
        Ok(OptionalOutputSlice(Some(Self::checked(
            items, count, argument,
        )?)))
    }

    /// Writes as many values as there is room for.
    pub fn write(self, values: &[T]) {
        let count = values.len().min(self.count);
        if count > 0 {
            // SAFETY: checked at construction; the caller states that `count` items are writable.
            unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), self.items, count) }
        }
    }

    /// Writes one value everywhere.
    pub fn fill(self, value: T) {
        for i in 0..self.count {
            // SAFETY: checked at construction; the caller states that `count` items are writable.
            unsafe { self.items.add(i).write(value) }
        }
    }
}

/// The destination of results that the caller may leave out.
pub struct OptionalOutputSlice<T>(Option<OutputSlice<T>>);

impl<T: Copy> OptionalOutputSlice<T> {
    pub fn write(self, values: &[T]) {
        if let Some(out) = self.0 {
            out.write(values);
        }
    }
}

/// An options structure that C fills in. It begins with `size` and `cookie`. Fields are only ever appended: those that
/// an older caller lacks get their defaults, and bytes that a newer caller has beyond those known here must be 0.
///
/// # Safety
/// `repr(C)`, beginning with two `u32`, without padding, valid for every bit pattern.
pub unsafe trait OptionsStruct: Copy {
    /// Unique among the options structures.
    const COOKIE: u32;
    /// The C name.
    const NAME: &'static str;
    /// The sizes of its earlier versions.
    const EARLIER_SIZES: &'static [usize] = &[];
    /// The defaults, except for size and cookie.
    fn defaults() -> Self;
}

/// Later versions of a structure are larger by at most this. Sizes above are taken for those of something else.
const MAX_GROWTH: usize = 128;

/// Whether a version of the structure has this size: an earlier, the current or a later one.
fn is_version<T: OptionsStruct>(size: usize) -> bool {
    let largest = size_of::<T>() + MAX_GROWTH;
    T::EARLIER_SIZES.contains(&size) || (size_of::<T>()..=largest).contains(&size)
}

/// Writes the defaults into the caller's structure, which is `size` bytes long.
pub unsafe fn write_defaults<T: OptionsStruct>(out: *mut T, size: usize) -> Result<(), Failure> {
    Output::checked(out, "out")?;
    if !is_version::<T>(size) {
        return Err(Failure::new(
            cstk_status::CSTK_ERROR_WRONG_SIZE,
            format!(
                "size is {size}; pass sizeof({}), which is {}",
                T::NAME,
                size_of::<T>()
            ),
        ));
    }
    let defaults = T::defaults();
    let known = size.min(size_of::<T>());
    // SAFETY: the caller states that `size` bytes are writable; the structure begins with two u32.
    unsafe {
        out.cast::<u8>().write_bytes(0, size);
        std::ptr::copy_nonoverlapping((&raw const defaults).cast::<u8>(), out.cast(), known);
        out.cast::<u32>().write(size as u32);
        out.cast::<u32>().add(1).write(T::COOKIE);
    }
    Ok(())
}

/// A structure of the caller: borrowed if it has this library's layout, else a copy in that layout.
pub enum CallerStruct<'a, T> {
    Theirs(&'a T),
    Ours(T),
}

impl<T> Deref for CallerStruct<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        match self {
            CallerStruct::Theirs(given) => given,
            CallerStruct::Ours(copy) => copy,
        }
    }
}

/// The caller's structure in this library's layout.
pub unsafe fn options<T: OptionsStruct>(
    given: *const T,
    argument: impl fmt::Display,
) -> Result<T, Failure> {
    // SAFETY: as the caller states.
    Ok(match unsafe { options_in_place(given, argument)? } {
        CallerStruct::Theirs(given) => *given,
        CallerStruct::Ours(copy) => copy,
    })
}

/// The same, copied only if necessary: for arrays.
pub unsafe fn options_in_place<'a, T: OptionsStruct>(
    given: *const T,
    argument: impl fmt::Display,
) -> Result<CallerStruct<'a, T>, Failure> {
    // SAFETY: as the caller states.
    let size = unsafe { checked_size(given, &argument)? };
    if size == size_of::<T>() {
        // SAFETY: not NULL and aligned; the cookie and size were written together by the _default function, so `size` bytes are
        // readable, and valid whatever they are.
        return Ok(CallerStruct::Theirs(unsafe { &*given }));
    }
    let mut read = T::defaults();
    let known = size.min(size_of::<T>());
    // SAFETY: as above.
    unsafe {
        std::ptr::copy_nonoverlapping(given.cast::<u8>(), (&raw mut read).cast(), known);
        let beyond = std::slice::from_raw_parts(given.cast::<u8>().add(known), size - known);
        if beyond.iter().any(|&byte| byte != 0) {
            return Err(Failure::new(
                cstk_status::CSTK_ERROR_UNSUPPORTED,
                format!("{argument} sets a field this version of the library does not know"),
            ));
        }
    }
    Ok(CallerStruct::Ours(read))
}

/// The size of the caller's structure, which was written by its _default function.
unsafe fn checked_size<T: OptionsStruct>(
    given: *const T,
    argument: &impl fmt::Display,
) -> Result<usize, Failure> {
    if given.is_null() {
        return Err(null(&argument.to_string()));
    }
    if !given.is_aligned() {
        return Err(misaligned(&argument.to_string()));
    }
    let not_initialised = |what: String| {
        Failure::new(
            cstk_status::CSTK_ERROR_NOT_INITIALISED,
            format!("{argument} was not written by {}_default: {what}", T::NAME),
        )
    };
    // SAFETY: every options structure begins with two u32.
    let (size, cookie) = unsafe {
        (
            given.cast::<u32>().read(),
            given.cast::<u32>().add(1).read(),
        )
    };
    let size = size as usize;
    if cookie != T::COOKIE {
        return Err(not_initialised(format!("its cookie is {cookie:#x}")));
    }
    if !is_version::<T>(size) {
        return Err(not_initialised(format!("its size is {size}")));
    }
    Ok(size)
}

/// The same, where NULL stands for the defaults.
pub unsafe fn options_or_default<T: OptionsStruct>(
    given: *const T,
    argument: &str,
) -> Result<T, Failure> {
    if given.is_null() {
        return Ok(T::defaults());
    }
    // SAFETY: as the caller states.
    unsafe { options(given, argument) }
}

/// A count or index from a signed field where -1 means none.
pub fn index_or_none(value: i32, argument: &str) -> Result<Option<usize>, Failure> {
    match value {
        -1 => Ok(None),
        0.. => Ok(Some(value as usize)),
        _ => Err(Failure::new(
            cstk_status::CSTK_ERROR_INVALID_ARGUMENT,
            format!("{argument} is {value}; it must be -1 or an index"),
        )),
    }
}

/// The address of an array; NULL if it is empty.
pub fn start<T>(items: &[T]) -> *const T {
    if items.is_empty() {
        std::ptr::null()
    } else {
        items.as_ptr()
    }
}
