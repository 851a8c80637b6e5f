//! C-objects.
//!
//! A C-object is a set in a space (§2.1.3). Induced sets hold all q at which links meet obstacles or each other; pure sets
//! are given by coordinates or by callbacks; unions, intersections, complements and differences combine other sets.
//!
//! ```c
//! cstk_cobject *obstacles, *limits, *forbidden;
//! check(cstk_cobject_induced(space, NULL, 0, environment, NULL, 0, NULL, &obstacles));
//! cstk_pure_options in_lengths;
//! check(cstk_pure_options_default(&in_lengths, sizeof in_lengths));
//! in_lengths.scale = 1.0; // so that distances from the limits compare with those of links
//! check(cstk_cobject_beyond_limits(space, &in_lengths, &limits));
//! const cstk_cobject *parts[2] = {obstacles, limits};
//! check(cstk_cobject_union(parts, 2, &forbidden));
//! ```

#[allow(clippy::module_inception)]
pub mod cobject;

pub mod sets;

pub mod predicate;

pub mod pure;
