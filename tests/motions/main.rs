//! Motions: slides, their paths and their proofs.

mod slide;
mod slide_paths;
mod slide_proofs;
