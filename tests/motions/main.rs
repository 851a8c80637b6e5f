//! Motions: slides, their paths and their proofs.

mod clearance;
mod compound;
mod curves;
mod motions;
mod pair_motion;
mod path;
mod random_scenes;
mod regions;
mod slide;
mod slide_paths;
mod slide_proofs;
