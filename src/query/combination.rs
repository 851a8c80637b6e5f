//! Compound sets: how they combine their parts, and memoized answers of the parts.

use super::answer::Distance;
use super::scene::Group;
use crate::cobject::{CObject, Class, Set};
use foldhash::fast::RandomState;
use std::collections::HashMap;
use std::sync::Arc;

/// Answers of parts, by serial and whether the complement was meant.
pub(super) type Memo<T> = HashMap<(u64, bool), T, RandomState>;

/// Memos of a query, whose memory is reused by the next.
#[derive(Default)]
pub(super) struct Answers {
    pub classes: Memo<Class>,
    pub within: Memo<bool>,
    pub distances: Memo<Distance>,
}

/// Memos with more entries are freed rather than reused: clearing them would cost every call.
const MAX_KEPT: usize = 1024;

/// An empty memo, in the memory of an old one.
pub(super) fn emptied<T>(mut memo: Memo<T>) -> Memo<T> {
    if memo.capacity() > MAX_KEPT {
        return Memo::default();
    }
    memo.clear();
    memo
}

/// A set as a union or an intersection of its parts, or of their complements.
pub(crate) enum Composition<'a> {
    /// A union of the induced sets and the parts.
    Any(Option<&'a Group>, &'a [Arc<CObject>]),
    /// An intersection.
    All(Option<&'a Group>, &'a [Arc<CObject>]),
}

/// A set, or its complement by De Morgan's laws, which move complements down to the leaves.
pub(crate) fn composition(set: &Set, complement: bool) -> Composition<'_> {
    match set {
        Set::Union { induced, others } => {
            let group = (!induced.is_empty()).then_some(&induced[..]);
            if complement {
                Composition::All(group, others)
            } else {
                Composition::Any(group, others)
            }
        }
        _ if complement => Composition::Any(None, set.parts()),
        _ => Composition::All(None, set.parts()),
    }
}

/// The parts, cheap ones first.
pub(super) fn cheap_first(parts: &[Arc<CObject>]) -> impl Iterator<Item = &CObject> + Clone {
    let all = || parts.iter().map(|part| &**part);
    all()
        .filter(is_pure)
        .chain(all().filter(|part| !is_pure(part)))
}

pub(super) fn is_pure(part: &&CObject) -> bool {
    matches!(part.set(), Set::Pure(_))
}
