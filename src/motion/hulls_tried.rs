//! What a proof has found out about the hulls of two bodies.

/// Links that are never far apart, as those with two joints between them, mostly have hulls that are apart all the while, and a single
/// direction says so where boxes would have to be opened by the dozen.
#[derive(Clone, Debug, Default)]
pub(super) struct HullsTried {
    /// The work done on the pair so far, in groups of boxes, up to what is done before hulls are tried.
    groups: u32,
    /// No direction parts them where they were compared last.
    meet: bool,
    /// The direction that parted them last, in B's frame, or zero.
    direction: [f32; 3],
}

/// After so many groups of boxes the hulls of a pair are tried: pairs that are far apart take fewer.
const GROUPS_BEFORE: u32 = 8;

impl HullsTried {
    /// Counts work on the pair, in groups of boxes. Whether it is worth trying the hulls.
    pub fn count(&mut self, groups: u32) -> bool {
        let is_worth_it = !self.meet && self.groups >= GROUPS_BEFORE;
        self.groups = self.groups.saturating_add(groups).min(GROUPS_BEFORE);
        is_worth_it
    }

    /// Tries them: `are_parted` is given the direction that parted them last, or zero, and leaves there the one that parts them where they
    /// are compared, or zero.
    pub fn are_parted(&mut self, are_parted: impl FnOnce(&mut [f32; 3]) -> bool) -> bool {
        let parted = are_parted(&mut self.direction);
        self.meet = self.direction == [0.0; 3];
        parted
    }
}
