//! Motions.
//!
//! A whole motion between two configurations, on a path through several, on a curve or as a function of yours
//! gives it, proved free or followed to its first contact; the same of two bodies without a robot; the least distance along a
//! motion or a path; and paths made shorter by proofs. Nothing is sampled: bounds over intervals of time cover the motion, however thin an obstacle is (§2.3.1; Figure 1 shows
//! what sampling misses).
//!
//! ```c
//! cstk_motion_result found;
//! double contact[6];
//! check(cstk_motion(query, cobject, q0, q1, nq, NULL, contact, &found));
//! if (found.outcome == CSTK_MOTION_HIT) {
//!     printf("contact at %g of the way\n", found.times[1]);
//! }
//! cstk_clearance_options options;
//! cstk_clearance_result clearance;
//! check(cstk_clearance_options_default(&options, sizeof options));
//! options.tolerance = 1e-3;
//! check(cstk_motion_clearance(query, cobject, q0, q1, nq, &options, NULL, &clearance));
//! printf("never nearer than %g\n", clearance.lower);
//! ```

#[allow(clippy::module_inception)]
pub mod motion;

pub mod path;

pub mod curve;

pub mod function;

pub mod pair_motion;

pub mod clearance;

pub mod path_clearance;

pub mod shortcut;
