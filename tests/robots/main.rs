//! Robots, spaces, URDF, SRDF.

mod find_link_pairs;
mod frozen;
mod kinematics;
mod link_motions;
mod motion_bound;
mod spaces;
mod srdf;
mod urdf;
