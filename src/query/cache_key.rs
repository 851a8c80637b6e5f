//! What names a body pair from one query to the next.

use super::answer::SSide;

/// Identifies a body pair across queries: two parties of a space, or two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum CacheKey {
    Bodies(u64, u64),
    Candidate {
        space: u64,
        r_link: usize,
        /// The s-object attached to the link that is the r-side, or 0.
        r_object: u64,
        s_side: SSide,
        /// The serial of the s-side's body: an id keeps its body for good, but a key must not outlive what it names.
        body: u64,
    },
}
