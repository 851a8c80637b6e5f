//! What names a body pair from one query to the next.

use super::answer::SSide;

/// What body pairs are ordered by: the r-link, the attached object that is the r-side (or 0), and the s-side. All 0 for two bodies
/// without a robot.
pub(crate) type PairIds = (usize, u64, SSide);

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

impl CacheKey {
    /// The ids of the pair.
    #[inline(always)]
    pub fn ids(&self) -> PairIds {
        match *self {
            Self::Candidate {
                r_link,
                r_object,
                s_side,
                ..
            } => (r_link, r_object, s_side),
            Self::Bodies(..) => (0, 0, SSide::Object(0)),
        }
    }
}
