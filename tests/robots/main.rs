//! Robots, spaces, URDF, SRDF, planning scenes.

mod find_link_pairs;
mod frozen;
mod kinematics;
mod link_motions;
mod mesh_forms;
mod motion_bound;
mod planning_scene;
mod spaces;
mod srdf;
mod srdf_example;
mod srdf_faults;
mod srdf_mutations;
mod urdf;
mod urdf_folder;
mod urdf_meshes;
