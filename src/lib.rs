//! The C-Space Toolkit: at a robot configuration q, is q free, in contact or inside; how far from contact and between
//! which features; which way is out, in joint space; which step slides along the contact.
//!
//! Data flow one way, in the order of the modules below; each imports only from those above it.

pub mod tolerance;

pub mod error;
#[doc(hidden)]
pub mod user_data;
#[doc(hidden)]
pub mod work_meter;

mod cow_vec;
#[doc(hidden)]
pub mod index_set;
#[doc(hidden)]
pub mod lanes;
mod reused;
mod whole_file;
mod xml;

pub mod pose;

pub mod euler;

mod parry_adapter;

#[doc(hidden)]
pub mod gjk;
pub mod primitive;

#[doc(hidden)]
pub mod convex;

#[doc(hidden)]
pub mod boxes;

pub mod hierarchy;

pub mod body;

#[doc(hidden)]
pub mod pair;

pub mod robot;

pub mod urdf;

pub mod space;

pub mod environment;

pub mod cobject;

pub mod query;

pub mod motion;

pub mod show;

#[doc(hidden)]
pub mod capi;
