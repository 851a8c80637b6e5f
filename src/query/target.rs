//! A body pair that a search looks at.

use super::answer::SSide;
use super::context::CacheKey;
use crate::body::Body;
use crate::cobject::InducedOptions;
use crate::pair::Pairing;
use crate::pose::Pose;

/// A body at a pose.
pub type Placement<'a> = (&'a Body, &'a Pose);

/// A body pair with what its C-object says of it.
#[derive(Clone, Copy)]
pub(super) struct Target<'a> {
    pub sides: [Placement<'a>; 2],
    pub key: CacheKey,
    pub options: InducedOptions,
    /// Among all of a search, in order of ids: hits name their pair by it.
    pub rank: u32,
    /// A safe lower bound of the distance less the margin.
    pub bound: f64,
}

impl<'a> Target<'a> {
    /// The link, and what is on the other side. Where there is no robot, both are 0.
    #[inline(always)]
    pub fn parties(&self) -> (usize, SSide) {
        match self.key {
            CacheKey::Candidate { r_link, s_side, .. } => (r_link, s_side),
            CacheKey::Bodies(..) => (0, SSide::Object(0)),
        }
    }

    /// The two in one frame: made when it is needed, as most targets turn out to be too far.
    pub fn pairing(&self) -> Pairing<'a> {
        let [a, b] = self.sides;
        Pairing::new(a.0, a.1, b.0, b.1)
    }

    /// The same, unless the balls around the bodies are more than `limit` apart, less the margin.
    pub fn pairing_within(&self, limit: f64) -> Option<Pairing<'a>> {
        if self.bound > limit {
            return None;
        }
        let pairing = self.pairing();
        (pairing.sphere_bound() - self.options.margin <= limit).then_some(pairing)
    }
}
