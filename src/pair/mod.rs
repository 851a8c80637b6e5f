//! Pairs: two bodies at two poses, no robot (§2.3.3).

mod hit;
mod pairing;
mod traversal;
mod visitors;

pub use hit::{Hit, HitKey};
pub use pairing::{Pairing, WorldContact};
pub use traversal::{Scratch, Statistics, Visitor, traverse};
pub use visitors::{Collect, Nearest, Within};
