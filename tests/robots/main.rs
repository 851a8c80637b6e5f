//! Robots, spaces, URDF.

mod find_link_pairs;
mod kinematics;
mod link_motions;
mod motion_bound;
mod spaces;
mod urdf;
