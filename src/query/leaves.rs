//! The leaves of a C-object's tree, for queries that list all of them.

use std::collections::HashSet;
use std::sync::Arc;

use super::scene::Group;
use crate::cobject::{CObject, Induced, PureSet, Set};

/// The leaves of a C-object, without duplicates: unions of induced sets, and pure sets, with `true` where the complement is
/// meant.
#[derive(Default)]
pub(super) struct Leaves<'a> {
    pub groups: Vec<Vec<Arc<Induced>>>,
    pub pure: Vec<(&'a PureSet, bool)>,
}

impl CObject {
    /// The induced sets of a union that has no other parts, as most C-objects are; none twice.
    pub(super) fn only_group(&self) -> Option<&Group> {
        match self.set() {
            Set::Union { induced, others } if others.is_empty() => Some(induced),
            _ => None,
        }
    }

    /// Whether no configuration is in contact with it: it has neither contact epsilons nor pure sets, which may be open.
    pub(crate) fn never_touches(&self) -> bool {
        let Leaves { groups, pure } = Leaves::of(self);
        let mut terms = groups.iter().flatten();
        pure.is_empty() && terms.all(|term| term.options.contact_epsilon == 0.0)
    }
}

impl<'a> Leaves<'a> {
    /// The leaves in order. Two complements around a leaf cancel out. Induced sets are listed without regard to complements:
    /// their witnesses are the same pairs.
    pub fn of(cobject: &'a CObject) -> Self {
        let mut found = Self::default();
        let mut seen = HashSet::new();
        let mut seen_leaves = HashSet::new();
        let mut stack = vec![(cobject, false)];
        while let Some((next, complement)) = stack.pop() {
            match next.set() {
                Set::Pure(set) => {
                    if seen_leaves.insert((set.leaf.serial, complement)) {
                        found.pure.push((set, complement));
                    }
                    continue;
                }
                Set::Union { induced, .. } => {
                    let is_new =
                        |term: &&Arc<Induced>| seen_leaves.insert((term.leaf.serial, false));
                    let group: Vec<Arc<Induced>> = induced.iter().filter(is_new).cloned().collect();
                    found.groups.extend((!group.is_empty()).then_some(group));
                }
                _ => {}
            }
            let complement = complement != matches!(next.set(), Set::Complement(_));
            for part in next.set().parts().iter().rev() {
                let is_leaf = matches!(part.set(), Set::Pure(_));
                if is_leaf || seen.insert((part.serial(), complement)) {
                    stack.push((part, complement));
                }
            }
        }
        found
    }
}
