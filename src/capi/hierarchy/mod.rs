//! Hierarchies.
//!
//! Every body has a binary tree of bounding volumes over its primitives (§3.2). It affects the speed of queries, never
//! their answers. Options choose how it is built; its nodes can be measured, listed and drawn.
//!
//! ```c
//! cstk_hierarchy_options options;
//! check(cstk_hierarchy_options_default(&options, sizeof options));
//! options.threads = 2;
//! check(cstk_body_build(body_builder, &options, NULL, NULL, &body));
//! ```

pub mod options;

pub mod nodes;
