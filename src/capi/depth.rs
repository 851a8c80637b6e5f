//! Depths and signed distances.
//!
//! The depth of two bodies that meet is the least length of a translation after which they do not meet. For two convex primitives
//! cstk_pair_penetration has it in closed form; for unions and solids it is bounded from both sides by a search, as closely as the
//! work allows. Planners that optimise take the signed distance: the distance of what is apart, minus the depth of what meets,
//! with its derivative on both sides.
//!
//! ```c
//! cstk_depth_result deep;
//! cstk_signed_distance_list near;
//! check(cstk_pair_depth(query, body, pose_a, body, pose_b, NULL, &deep));
//! check(cstk_signed_distances(query, cobject, q, nq, 0.1, 64, NULL, &near));
//! ```

use super::at_configuration::answers::cstk_witness;
use super::boundary::{Failure, guard};
use super::cobject::cobject::cstk_cobject;
use super::handle;
use super::input::{OptionsStruct, Output, options_or_default, pose, slice, start, write_defaults};
use super::query::{State, cstk_query, refill, with_query};
use crate::body::Body;
use crate::capi::body::body::cstk_body;
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::query::{DepthOptions, GradientKind, SignedDistance, SignedDistanceList};

/// Options of the search for depths. Write it with cstk_depth_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_depth_options {
    pub size: u32,
    pub cookie: u32,
    /// The search ends when its bounds are this close, a length; 0, the default, for 1e-6 of the size of the pair. Polytopes
    /// mostly end closer than any tolerance.
    pub tolerance: f64,
    /// The search ends after this many steps, with the bounds that it has; 0, the default, for 1000. A step takes some
    /// microseconds between few primitives, and a millisecond or some between solids, even of few faces.
    pub max_steps: u64,
    pub reserved: [u64; 2],
}

// SAFETY: repr(C), two u32, a double, three u64: no padding.
unsafe impl OptionsStruct for cstk_depth_options {
    const COOKIE: u32 = 0x4353_0406;
    const NAME: &'static str = "cstk_depth_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            tolerance: 0.0,
            max_steps: 0,
            reserved: [0; 2],
        }
    }
}

impl From<&cstk_depth_options> for DepthOptions {
    fn from(given: &cstk_depth_options) -> Self {
        Self {
            tolerance: given.tolerance,
            max_steps: match given.max_steps {
                0 => DepthOptions::default().max_steps,
                steps => steps,
            },
        }
    }
}

/// Bounds of a depth, with a translation that parts the bodies. All 0 for bodies that are apart.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_depth_result {
    /// Whether the bodies meet.
    pub meet: bool,
    /// The bounds are within the tolerance, or as close as rounding allows.
    pub tight: bool,
    pub reserved_bytes: [u8; 6],
    /// No shorter translation parts the bodies.
    pub lower: f64,
    /// The length of `translation`. Never below the true depth: infinite, with a translation of 0, only if no translation was proved
    /// to part them.
    pub upper: f64,
    /// After body a has moved by it, in the world, the bodies are proved apart: by a little more than rounding.
    pub translation: [f64; 3],
    /// The steps of the search.
    pub steps: u64,
    pub reserved: [u64; 4],
}

/// What the row of a signed distance is.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_gradient_kind {
    /// The derivative of the signed distance.
    CSTK_GRADIENT_DERIVATIVE = 0,
    /// Several features are equally near, or several translations equally short: the derivative of one of them. The signed
    /// distance has no derivative here.
    CSTK_GRADIENT_ONE_OF_SEVERAL = 1,
    /// The bodies meet, and their depth is not known to the tolerance, or its translation does not follow from what touches after
    /// it: the derivative of the length of the translation found, its direction held.
    CSTK_GRADIENT_APPROXIMATE = 2,
    /// The bodies meet, and neither has an inside everywhere: no depth is defined. The row and the normal are 0.
    CSTK_GRADIENT_UNDEFINED = 3,
}

/// The signed distance of two bodies, less the C-object's margin.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_signed_distance {
    /// Which bodies; of bodies that are apart, the nearest primitives. It has no contacts.
    pub witness: cstk_witness,
    /// The distance; of bodies that meet, minus the length of the shortest translation found that parts them. Minus the margin
    /// where no depth is defined.
    pub distance: f64,
    /// Never above the true signed distance; -INFINITY where no depth is defined.
    pub lower: f64,
    /// Never below the true signed distance.
    pub upper: f64,
    /// The unit vector, in the world, along which the r-side gets away from the s-side.
    pub normal: [f64; 3],
    /// The witness points, in the world; of bodies that meet, two that touch after the translation, where they are before it.
    pub r_point: [f64; 3],
    pub s_point: [f64; 3],
    pub gradient_kind: cstk_gradient_kind,
    pub reserved_word: u32,
    pub reserved: [u64; 4],
}

/// The signed distances of body pairs, least first. The arrays belong to the query context and stay valid until its next call or
/// its release.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_signed_distance_list {
    pub pairs: *const cstk_signed_distance,
    pub count: usize,
    /// One row of `nv` doubles per pair: the derivative of its distance with respect to each velocity. See `gradient_kind`.
    pub gradients: *const f64,
    pub nv: usize,
    /// There are more pairs than max_count; these have the least distances.
    pub truncated: bool,
    pub reserved_bytes: [u8; 7],
    pub environment_version: u64,
    pub reserved: [u64; 4],
}

/// Writes the default options. `size` is sizeof(cstk_depth_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_depth_options_default(
    out: *mut cstk_depth_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Writes bounds of the depth of body a at pose_a in body b at pose_b, and a translation of body a, in the world, that is proved to
/// part them. Unions and solids (cstk_body_builder_set_solid) count as a whole: the depth is exact to rounding for unions of
/// polytopes and for solids whose boundary is convex and has at most 4096 faces, and bounded to the tolerance for others, if the steps
/// suffice; `tight` tells. CSTK_ERROR_UNSUPPORTED if the bodies
/// meet and each has a primitive without an inside, such as a polygon that bounds no solid; the message names them. A surface in
/// a solid has a depth. `options` may be NULL for the defaults. Poses are 12 doubles, row-major [R | t], the body's frame in the
/// world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pair_depth(
    query: *mut cstk_query,
    body_a: *const cstk_body,
    pose_a: *const f64,
    body_b: *const cstk_body,
    pose_b: *const f64,
    options: *const cstk_depth_options,
    out: *mut cstk_depth_result,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            // Callbacks may release the bodies during the call.
            let a = handle::share::<Body>(body_a, "body_a")?;
            let b = handle::share::<Body>(body_b, "body_b")?;
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for NULL; the header states the lengths.
            let (pose_a, pose_b) = unsafe { (pose(pose_a, "pose_a")?, pose(pose_b, "pose_b")?) };
            // SAFETY: checked for size and cookie.
            let options = unsafe { options_or_default(options, "options")? };
            let sides = ((&*a, &pose_a), (&*b, &pose_b));
            let found = state
                .context
                .pair_depth(sides.0, sides.1, &(&options).into())?;
            out.write(cstk_depth_result {
                meet: found.meet,
                tight: found.is_tight,
                reserved_bytes: [0; 6],
                lower: found.lower,
                upper: found.upper,
                translation: found.translation.into(),
                steps: found.steps,
                reserved: [0; 4],
            });
            Ok(())
        })
    })
}

/// Writes the signed distances, less the margin, of all pairs of bodies of the C-object that are at most `max_distance` apart (not
/// negative; may be INFINITY) at configuration q: of links, attached objects and s-objects, each pair with the derivative of its
/// signed distance with respect to the velocities. The C-object is an induced set or a union of such, else
/// CSTK_ERROR_UNSUPPORTED. Apart, distances are as cstk_distance has them; of bodies that meet, they are minus the depth, bounded as
/// cstk_pair_depth does with these options, of which NULL stands for the defaults. `gradient_kind` tells where there is no
/// derivative, and where no depth. If there are more than `max_count` pairs, those with the least distances are listed and `truncated`
/// is set. The arrays stay valid until the next call with this query context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_signed_distances(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    max_distance: f64,
    max_count: usize,
    options: *const cstk_depth_options,
    out: *mut cstk_signed_distance_list,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            // Shared ownership: a callback may release the handle during the call.
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for NULL; the caller states the length.
            let q = unsafe { slice(q, nq, "q")? };
            // SAFETY: checked for size and cookie.
            let options = unsafe { options_or_default(options, "options")? };
            let options = DepthOptions::from(&options);
            let context = &mut state.context;
            let list = context.signed_distances(&cobject, q, max_distance, max_count, &options)?;
            out.write(state.keep_signed_distances(list));
            Ok::<(), Failure>(())
        })
    })
}

impl State {
    /// Stores a list, and returns a view of its arrays.
    fn keep_signed_distances(&mut self, list: SignedDistanceList) -> cstk_signed_distance_list {
        refill(&mut self.signed_distances, &list.pairs);
        self.gradients = list.gradients;
        cstk_signed_distance_list {
            pairs: start(&self.signed_distances),
            count: self.signed_distances.len(),
            gradients: start(&self.gradients),
            nv: list.nv,
            truncated: list.truncated,
            reserved_bytes: [0; 7],
            environment_version: list.version,
            reserved: [0; 4],
        }
    }
}

impl From<&SignedDistance> for cstk_signed_distance {
    fn from(pair: &SignedDistance) -> Self {
        Self {
            witness: (&pair.witness).into(),
            distance: pair.distance,
            lower: pair.lower,
            upper: pair.upper,
            normal: pair.normal.into(),
            r_point: pair.points[0].into(),
            s_point: pair.points[1].into(),
            gradient_kind: match pair.gradient {
                GradientKind::Derivative => cstk_gradient_kind::CSTK_GRADIENT_DERIVATIVE,
                GradientKind::OneOfSeveral => cstk_gradient_kind::CSTK_GRADIENT_ONE_OF_SEVERAL,
                GradientKind::Approximate => cstk_gradient_kind::CSTK_GRADIENT_APPROXIMATE,
                GradientKind::Undefined => cstk_gradient_kind::CSTK_GRADIENT_UNDEFINED,
            },
            reserved_word: 0,
            reserved: [0; 4],
        }
    }
}
