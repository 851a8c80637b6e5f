//! Motions: slides, their paths and their proofs.

mod certificate_forgeries;
mod certificate_sets;
mod certificates;
mod clearance;
mod compound;
mod curves;
mod discs;
mod forged;
mod map_boundaries;
mod map_ends;
mod maps;
mod motions;
mod pair_motion;
mod path;
mod path_clearance;
mod random_scenes;
mod regions;
mod shortcut;
mod show_path;
mod slide;
mod slide_near;
mod slide_paths;
mod slide_proofs;
mod slide_to;
mod stated_motion;
mod trees;
