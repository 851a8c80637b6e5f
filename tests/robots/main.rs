//! Robots, spaces, URDF.

mod kinematics;
mod link_motions;
mod link_pairs;
mod motion_bound;
mod spaces;
mod urdf;
