//! The C-Space Toolkit: at a robot configuration q, is q free, in contact or inside; how far from contact and between
//! which features; which way is out, in joint space; which step slides along the contact.
//!
//! Data flow one way, in the order of the modules below; each imports only from those above it.

pub mod tolerance;

pub mod error;
pub mod user_data;
pub mod work_meter;

mod cow_vec;
pub mod index_set;
pub mod lanes;
mod reused;
mod whole_file;
mod xml;

pub mod pose;

pub mod euler;

mod parry_adapter;

pub mod gjk;
pub mod primitive;

pub mod convex;

pub mod boxes;

pub mod hierarchy;

pub mod body;

pub mod pair;

pub mod robot;

pub mod urdf;

pub mod space;

pub mod environment;

pub mod cobject;

pub mod query;

pub mod motion;

pub mod show;

pub mod capi;
