//! Motions: slides, their paths and their proofs.

mod compound;
mod curves;
mod motions;
mod pair_motion;
mod slide;
mod slide_paths;
mod slide_proofs;
