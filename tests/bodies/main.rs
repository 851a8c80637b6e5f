//! Bodies, solids and their files.

mod bezier_patches;
mod closed_surfaces;
mod cloud_files;
mod flat_hulls;
mod given;
mod hull;
mod nurbs_surfaces;
mod obj_files;
mod parts;
mod placed_meshes;
mod refined_patches;
mod refits;
mod refused_nurbs_surfaces;
mod sampled_surfaces;
mod solid_bodies;
mod solid_clouds;
mod solid_files;
mod solid_queries;
mod whole_files;
