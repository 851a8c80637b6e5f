//! Primitives and pairs of bodies: distances, contacts, penetration, overlap.

mod askew_lines;
mod balls_and_solids;
mod box_pairs;
mod contacts;
mod convex_depths;
mod deep_overlaps;
mod depth_frames;
mod depths;
mod depths_in_cavities;
mod flattened;
mod given_pairs;
mod kernel;
mod laws;
mod minkowski_facets;
mod nearly_level;
mod oracle;
mod parallel_contacts;
mod penetration;
mod planar_contacts;
mod published_cases;
mod round_pairs;
mod shape_bodies;
mod shapes;
mod slivers;
mod smooth_shapes;
mod winding;
