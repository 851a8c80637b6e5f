//! Certificates: proofs that motions are free, in a form that can be kept, and checked by a short routine of its own.
//!
//! A certificate is a list of entries. Each says of two bodies, or of groups of their primitives, that they stay apart over an
//! interval of time: along a direction they have a gap at both ends of the interval, and between the ends no point leaves the straight
//! line between its two places by as much. What an entry says is checked by kinematics at the two ends, by support points, and by a
//! bound of accelerations that `carried_points` derives. Together the entries cover all primitives of all body pairs that a C-object
//! asks about, at every time: that is checked too.
//!
//! Data flow: `statement` lists what a C-object asks about; `measure` computes what one entry claims; `check` goes through all of a
//! certificate; `search` finds one; `file` keeps it.

mod carried_points;
#[allow(clippy::module_inception)]
mod certificate;
mod check;
mod directions;
mod file;
mod fingerprint;
mod measure;
mod order;
mod outside;
mod search;
mod statement;

pub use certificate::{Certificate, Entry};
