//! The C API: converts, checks, calls. It holds no geometry.
//!
//! Every exported function that can fail runs inside [`boundary::guard`]; all pointers are checked before use. The
//! public modules are the sections of the header, in its order; what their docs say opens the sections there.
//!
//! The library's unit tests leave it out: exported functions are compiled with all that they call, which would take four times as
//! long.

#![allow(non_camel_case_types)]
#![allow(clippy::missing_safety_doc)] // The header states once, for all functions, what callers owe.
#![allow(clippy::too_many_arguments)]

mod boundary;
mod handle;
mod input;
mod user_data;

pub mod status;

pub mod pose;

pub mod body;

pub mod hierarchy;

pub mod robot;

pub mod urdf;

pub mod srdf;

pub mod space;

pub mod environment;

pub mod octree;

pub mod cobject;

pub mod query;

pub mod at_configuration;

pub mod pair;

pub mod object_pairs;

pub mod depth;

pub mod motion;

pub mod certificate;

pub mod region;

pub mod slide;

pub mod batch;

pub mod map;

pub mod show;
