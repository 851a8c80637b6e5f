//! Motions: slides, their paths and their proofs.

mod certificate_forgeries;
mod certificate_sets;
mod certificates;
mod clearance;
mod compound;
mod curves;
mod forged;
mod map_boundaries;
mod maps;
mod motions;
mod pair_motion;
mod path;
mod random_scenes;
mod regions;
mod slide;
mod slide_near;
mod slide_paths;
mod slide_proofs;
mod stated_motion;
