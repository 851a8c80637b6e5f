//! What the test programs share: seeded random numbers, shapes, robots, and an oracle that uses nothing of the
//! library but its vector types.

pub mod changing;
pub mod checked;
pub mod closed_sets;
pub mod containment;
pub mod differences;
pub mod expansion;
pub mod facing;
pub mod files;
pub mod models;
pub mod oracle;
pub mod placed;
pub mod pure;
pub mod random;
pub mod robots;
pub mod shapes;
pub mod surfaces;
pub mod touch;
pub mod trees;

/// Whether tests run all their cases, or a part that is soon done.
pub fn all_cases() -> bool {
    std::env::var_os("CSTK_ALL_CASES").is_some()
}
