//! The body pairs that a set of links against s-objects leaves out.

use super::induced::require_link;
use crate::environment::SObject;
use crate::error::Result;
use crate::robot::{JointKind, Link};
use crate::space::Space;

/// A body pair that may meet, so that the set leaves it out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct AllowedPair {
    /// The link on the r-side; with an attached object, the link that holds it.
    pub link: usize,
    /// An object attached to the link, or 0 for the link's own body.
    pub attached: u64,
    /// The s-object.
    pub object: u64,
}

/// The pairs to leave out, as a caller gives them.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeftOut<'a> {
    /// Pairs that may meet, in any order.
    pub allowed: &'a [AllowedPair],
    /// Leaves out all pairs of bodies that no coordinate moves: a base and the table that it stands on.
    pub unmoved: bool,
}

/// The same, ready for queries.
#[derive(Clone, Debug)]
pub struct Exceptions {
    /// Sorted.
    allowed: Vec<AllowedPair>,
    /// Whether a coordinate moves each link; empty where pairs that none moves count too.
    moved: Vec<bool>,
}

impl Exceptions {
    pub(super) fn new(space: &Space, left_out: LeftOut) -> Result<Self> {
        for (i, pair) in left_out.allowed.iter().enumerate() {
            require_link(space, pair.link).map_err(|e| e.within(format_args!("allowed[{i}]")))?;
        }
        let mut allowed = left_out.allowed.to_vec();
        allowed.sort_unstable();
        allowed.dedup();
        let mut moved = Vec::new();
        if left_out.unmoved {
            // Parents come before their children.
            for number in 0..space.link_count() {
                let moves = |link: &Link| !matches!(link.joint.kind, JointKind::Fixed);
                let parent = space.parent(number);
                moved.push(
                    space.link(number).is_some_and(moves) || parent.is_some_and(|p| moved[p]),
                );
            }
        }
        Ok(Self { allowed, moved })
    }

    /// Whether they have a pair of a link, or of an object attached to it (0 for the link's own body), and an s-object.
    #[inline]
    pub fn have(&self, link: usize, attached: u64, object: &SObject) -> bool {
        let holder = object.attachment.as_ref().map(|attachment| attachment.link);
        self.allow(link, attached, object, holder) || self.rest(link, holder)
    }

    fn allow(&self, link: usize, attached: u64, object: &SObject, holder: Option<usize>) -> bool {
        if self.allowed.is_empty() {
            return false;
        }
        let has = |pair: AllowedPair| self.allowed.binary_search(&pair).is_ok();
        let given = AllowedPair {
            link,
            attached,
            object: object.id,
        };
        // A pair of two attached objects may be allowed in either order.
        let turned = holder.map(|link| AllowedPair {
            link,
            attached: object.id,
            object: attached,
        });
        has(given) || attached != 0 && turned.is_some_and(has)
    }

    /// Whether no coordinate moves the two, where such pairs are left out.
    fn rest(&self, link: usize, holder: Option<usize>) -> bool {
        let rests = |link: usize| self.moved.get(link).is_some_and(|is_moved| !is_moved);
        rests(link) && holder.is_none_or(rests)
    }
}
