//! Spaces.
//!
//! A space is the C-space of one or more robots: their coordinates, the coordinates' ranges, and the world box. It offers
//! what planners need: samples, differences, steps, interpolation, limits, link poses.
//!
//! ```c
//! uint64_t random = 1;
//! const cstk_robot *robots[1] = {robot};
//! check(cstk_space_create(robots, 1, NULL, 0, NULL, &space));
//! check(cstk_space_sample(space, &random, q));
//! ```

#[allow(clippy::module_inception)]
pub mod space;

pub mod configuration;

pub mod enabled_pairs;
