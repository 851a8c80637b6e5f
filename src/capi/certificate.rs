//! Certificates.
//!
//! A proof that a whole motion is free, kept for those who must trust the answer. A certificate lists what it claims: two bodies, or
//! groups of their primitives, keep apart along a direction over an interval of time. cstk_certificate_verify checks a certificate by
//! a short routine of its own, which uses forward kinematics and support points and nothing of what found the proof. Certificates are
//! saved and loaded (docs/certificate-file.md), and are about content, not handles: they hold for robots, bodies and environments
//! that were made anew alike.
//!
//! ```c
//! cstk_certificate *certificate;
//! cstk_motion_result found;
//! check(cstk_motion_certificate(query, cobject, q0, q1, nq, NULL, NULL, &found, &certificate));
//! if (certificate != NULL) {
//!     check(cstk_certificate_verify(certificate, cobject, q0, q1, nq, 0));
//!     check(cstk_certificate_save(certificate, "edge.certificate"));
//! }
//! check(cstk_certificate_release(certificate));
//! ```

use std::ffi::c_char;
use std::sync::Arc;

use super::boundary::{Failure, guard};
use super::handle;
use super::handle::Noun;
use super::input::{Output, OutputSlice, path, slice};
use super::query::cstk_query;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::motion::motion::{ask_motion, cstk_motion_options, cstk_motion_result};
use crate::capi::status::status::cstk_status;
use crate::certificate::{Certificate, Entry};
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind};

/// A proof that a motion keeps clear of a C-object. Immutable; threads may share it. It refers to no other object.
pub struct cstk_certificate {
    _opaque: [u8; 0],
}

impl Noun for Certificate {
    type Handle = cstk_certificate;
    const KIND: u32 = 10;
    const NAME: &'static str = "cstk_certificate";
}

/// What a certificate is of.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_certificate_summary {
    /// The number of coordinates of its motion.
    pub nq: usize,
    /// The number of its entries.
    pub entry_count: usize,
    /// Everything stays farther away than this; a length.
    pub threshold: f64,
    /// A SHA-256 digest of the robots, bodies, poses, margins and sets that it is about.
    pub fingerprint: [u8; 32],
    pub reserved: [u64; 8],
}

/// One claim of a certificate: over an interval of time two groups of primitives stay farther apart than the threshold and the margin,
/// since gap - displacement is larger. Along the direction their gap is at least `gap` at both ends of the interval, and in between
/// no point of them moves off the line between its two places by more than `displacement`, seen from the body that carries the
/// direction. Of a floor or a side of the world box, the second side is the plane; of a set given in C-space there are no bodies, and gap
/// and displacement are of its distance.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_certificate_entry {
    /// The number of what the C-object asks about, in an order by content (docs/certificate-file.md): body pairs, links over floors or
    /// in the world box, sets given in C-space. Several entries may be of one item.
    pub item: u32,
    /// The side in whose body's frame the direction rests: 0 or 1.
    pub carrier: u32,
    /// The links that carry the bodies of the two sides, r-side first; UINT32_MAX for what rests in the world.
    pub links: [u32; 2],
    /// The number of primitives of each side; cstk_certificate_get_primitives lists them.
    pub primitive_counts: [u32; 2],
    /// The interval, within 0 and 1.
    pub times: [f64; 2],
    /// Of length 1, from the second side to the first; 0 for a set given in C-space.
    pub direction: [f64; 3],
    /// With rounding counted; lengths.
    pub gap: f64,
    pub displacement: f64,
    pub reserved: [u64; 4],
}

/// The same as cstk_motion, with a certificate where the motion is free. `certificate` receives one, or NULL where the motion is not
/// free. Making it takes longer than the proof of cstk_motion, by far for meshes.
///
/// In rare cases the motion is free, and the certificate cannot show it: where it comes as near the threshold as rounding, the outcome
/// is CSTK_MOTION_NEAR; where the limit of cstk_query_set_limit ended the making, CSTK_MOTION_UNDECIDED with times of 1.
///
/// Certificates are of links against s-objects and one another, attached objects, margins and allowed pairs, solids, floors, the world box,
/// limits, boxes, half-spaces and balls of C-space, and of unions of these. Of an intersection they show, one interval after another,
/// that the motion keeps out of some part. CSTK_ERROR_UNSUPPORTED, naming the leaf, for complements, predicates, and bodies
/// with a support function of the caller's, but for parts of intersections that are free without them; and as for cstk_motion.
/// CSTK_ERROR_LIMIT for more than 4 million body pairs or steps of the proof.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_motion_certificate(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q0: *const f64,
    q1: *const f64,
    nq: usize,
    options: *const cstk_motion_options,
    reached: *mut f64,
    out: *mut cstk_motion_result,
    certificate: *mut *mut cstk_certificate,
) -> cstk_status {
    guard(|| {
        ask_motion(query, cobject, nq, options, reached, out, |asked| {
            let certificate = Output::checked(certificate, "certificate")?;
            // SAFETY: checked for NULL; the caller states the lengths.
            let (q0, q1) = unsafe { (slice(q0, nq, "q0")?, slice(q1, nq, "q1")?) };
            let context = asked.context;
            let (answer, found) =
                context.motion_certificate(asked.cobject, q0, q1, &asked.options)?;
            certificate.write(found.map_or(std::ptr::null_mut(), |found| {
                handle::create(Arc::new(found))
            }));
            let result = (&answer).into();
            Ok((answer.configuration, result))
        })
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_certificate_retain(
    certificate: *mut cstk_certificate,
) -> cstk_status {
    guard(|| handle::retain::<Certificate>(certificate, "certificate"))
}

/// Drops a reference. NULL is a no-op.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_certificate_release(
    certificate: *mut cstk_certificate,
) -> cstk_status {
    guard(|| handle::release::<Certificate>(certificate, "certificate"))
}

/// Checks that a certificate proves the motion from q0 to q1 free of a C-object in the state that its environments are in at the call,
/// and farther away than `threshold` everywhere. CSTK_OK if it does. CSTK_ERROR_NOT_PROVED if it does not, with the entry that
/// fails in the message: if the certificate was made for other bodies, poses, robots or sets, another motion or threshold, or if it
/// was altered. `q0` and `q1` have `nq` doubles.
///
/// What an entry claims is computed anew from the bodies' primitives at the link poses of both ends of its interval, with rounding
/// counted; that the entries cover all primitives of all body pairs that the C-object asks about, at all times, is checked too. Maps of
/// custom joints are called and must be what they were; the speeds that they state are taken for granted. All else as
/// for cstk_motion.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_certificate_verify(
    certificate: *const cstk_certificate,
    cobject: *const cstk_cobject,
    q0: *const f64,
    q1: *const f64,
    nq: usize,
    threshold: f64,
) -> cstk_status {
    guard(|| {
        let certificate = handle::share::<Certificate>(certificate, "certificate")?;
        let cobject = handle::share::<CObject>(cobject, "cobject")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (q0, q1) = unsafe { (slice(q0, nq, "q0")?, slice(q1, nq, "q1")?) };
        Ok(certificate.verify(&cobject, q0, q1, threshold)?)
    })
}

/// Writes what a certificate is of.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_certificate_get_summary(
    certificate: *const cstk_certificate,
    out: *mut cstk_certificate_summary,
) -> cstk_status {
    guard(|| {
        let certificate = &*handle::share::<Certificate>(certificate, "certificate")?;
        let out = Output::checked(out, "out")?;
        out.write(cstk_certificate_summary {
            nq: certificate.ends()[0].len(),
            entry_count: certificate.entries().len(),
            threshold: certificate.threshold(),
            fingerprint: *certificate.fingerprint(),
            reserved: [0; 8],
        });
        Ok(())
    })
}

/// Writes the first and last configuration of the motion, `nq` doubles each; CSTK_ERROR_WRONG_SIZE if it has another number of
/// coordinates.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_certificate_get_ends(
    certificate: *const cstk_certificate,
    nq: usize,
    q0: *mut f64,
    q1: *mut f64,
) -> cstk_status {
    guard(|| {
        let certificate = &*handle::share::<Certificate>(certificate, "certificate")?;
        let [start, end] = certificate.ends();
        if nq != start.len() {
            let message = format!("nq is {nq}, but the motion has {} coordinates", start.len());
            return Err(Error::new(ErrorKind::WrongSize, message).into());
        }
        let q0 = OutputSlice::checked(q0, nq, "q0")?;
        let q1 = OutputSlice::checked(q1, nq, "q1")?;
        q0.write(start);
        q1.write(end);
        Ok(())
    })
}

fn entry_of(certificate: &Certificate, index: usize) -> Result<&Entry, Failure> {
    let count = certificate.entries().len();
    certificate.entries().get(index).ok_or_else(|| {
        let message = format!("entry {index} does not exist; the certificate has {count}");
        Error::new(ErrorKind::NotFound, message).into()
    })
}

/// Writes an entry, counted from 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_certificate_get_entry(
    certificate: *const cstk_certificate,
    index: usize,
    out: *mut cstk_certificate_entry,
) -> cstk_status {
    guard(|| {
        let certificate = &*handle::share::<Certificate>(certificate, "certificate")?;
        let out = Output::checked(out, "out")?;
        let entry = entry_of(certificate, index)?;
        out.write(cstk_certificate_entry {
            item: entry.item,
            carrier: entry.carrier,
            links: entry.links,
            primitive_counts: [0, 1].map(|side| certificate.primitives(entry, side).len() as u32),
            times: entry.times,
            direction: entry.direction,
            gap: entry.gap,
            displacement: entry.displacement,
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// Lists the primitives of one side of an entry, 0 or 1, by their indices in the body. At most `max_count` are written to
/// `primitives` (NULL if `max_count` is 0), and their full number to `count`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_certificate_get_primitives(
    certificate: *const cstk_certificate,
    index: usize,
    side: u32,
    max_count: usize,
    primitives: *mut u32,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        let certificate = &*handle::share::<Certificate>(certificate, "certificate")?;
        let room = OutputSlice::checked(primitives, max_count, "primitives")?;
        let count = Output::checked(count, "count")?;
        let entry = entry_of(certificate, index)?;
        if side > 1 {
            return Err(Error::invalid(format!("side is {side}; it must be 0 or 1")).into());
        }
        let found = certificate.primitives(entry, side as usize);
        room.write(found);
        count.write(found.len());
        Ok(())
    })
}

/// Saves a certificate to a file. An existing file is replaced only once everything is written. CSTK_ERROR_IO if the file
/// cannot be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_certificate_save(
    certificate: *const cstk_certificate,
    file: *const c_char,
) -> cstk_status {
    guard(|| {
        let certificate = &*handle::share::<Certificate>(certificate, "certificate")?;
        // SAFETY: checked for NULL; the caller states that it is terminated.
        let file = unsafe { path(file, "file")? };
        Ok(certificate.save(file)?)
    })
}

/// Loads a certificate that cstk_certificate_save wrote. It proves nothing before cstk_certificate_verify accepts it, wherever the file
/// comes from. CSTK_ERROR_IO if the file cannot be read, CSTK_ERROR_PARSE if it is truncated, altered or no certificate file,
/// CSTK_ERROR_UNSUPPORTED for another version of the format. The memory used is bounded by the size of the file.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_certificate_load(
    file: *const c_char,
    out: *mut *mut cstk_certificate,
) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states that it is terminated.
        let file = unsafe { path(file, "file")? };
        out.write(handle::create(Arc::new(Certificate::load(file)?)));
        Ok(())
    })
}
