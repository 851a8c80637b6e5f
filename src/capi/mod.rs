//! The C API: converts, checks, calls. It holds no geometry.
//!
//! Every exported function that can fail runs inside [`boundary::guard`]; all pointers are checked before use. The
//! modules stand in the order in which the header presents them.

#![allow(non_camel_case_types)]
#![allow(clippy::missing_safety_doc)] // The header states once, for all functions, what callers owe.
#![allow(clippy::too_many_arguments)]

mod exclusive;
mod handle;
mod input;
mod user_data;

pub mod version;

pub mod status;

pub mod boundary;

pub mod pose;

pub mod hierarchy;

pub mod body_builder;

pub mod body;

pub mod primitive;

pub mod shapes;

pub mod nodes;

pub mod custom_joint;

pub mod joint;

pub mod robot;

pub mod robot_builder;

pub mod urdf;

pub mod space;

pub mod configuration;

pub mod environment;

pub mod s_object;

pub mod cobject;

pub mod sets;

pub mod predicate;

pub mod pure;

pub mod answers;

pub mod query;

pub mod point_queries;

pub mod explain;

pub mod link_pairs;

pub mod pair;

pub mod slide;

pub mod show;
