//! Robots, spaces, URDF.

mod kinematics;
mod link_pairs;
mod motion_bound;
mod motion_chain;
mod spaces;
mod urdf;
