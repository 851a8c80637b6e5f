//! Environments.
//!
//! An environment holds s-objects, the obstacles: bodies at poses. Changes are applied together or not at all, while other
//! threads query: a query sees the state before or after, never between. Objects can be attached to links.
//!
//! ```c
//! cstk_environment_change table;
//! uint64_t id;
//! check(cstk_environment_change_default(&table, sizeof table));
//! table.kind = CSTK_CHANGE_ADD;
//! table.body = body;
//! check(cstk_environment_apply(environment, &table, 1, &id, NULL));
//! ```

#[allow(clippy::module_inception)]
pub mod environment;

pub mod object;

pub mod planning_scene;
