//! Slides.
//!
//! Steps that slide along contacts, proved free on their whole way: one, or as many as lead to a goal; and the two halves of a step
//! for callers who combine them themselves (§2.2.4, Appendix A).
//!
//! ```c
//! cstk_slide_options options;
//! cstk_slide_result slid;
//! check(cstk_slide_options_default(&options, sizeof options));
//! options.max_shell = 0.05;
//! check(cstk_slide(query, cobject, q, nq, step, nv, &options, q, &slid));
//! cstk_slide_to_options way;
//! cstk_slide_to_result led;
//! check(cstk_slide_to_options_default(&way, sizeof way));
//! way.step = 0.02;
//! check(cstk_slide_to(query, cobject, q0, q1, q1, nq, NULL, 0, &options, &way, NULL, NULL, &led));
//! printf("%zu configurations\n", led.path.count);
//! ```

#[allow(clippy::module_inception)]
pub mod slide;

pub mod slide_to;
