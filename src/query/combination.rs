//! Sets made of others: their parts, each asked once.

use super::answer::Distance;
use super::scene::Group;
use crate::cobject::{CObject, Class, Set};
use foldhash::fast::RandomState;
use std::collections::HashMap;
use std::sync::Arc;

/// What parts have answered: by their serials, and whether the complement was asked.
pub(super) type Known<T> = HashMap<(u64, bool), T, RandomState>;

/// Memory for what the parts of a set answer, used again by the next call.
#[derive(Default)]
pub(super) struct Answers {
    pub classes: Known<Class>,
    pub within: Known<bool>,
    pub distances: Known<Distance>,
}

/// Memory is used again for so many parts: more would be swept by each call.
const MAX_KEPT: usize = 1024;

pub(super) fn emptied<T>(mut known: Known<T>) -> Known<T> {
    if known.capacity() > MAX_KEPT {
        return Known::default();
    }
    known.clear();
    known
}

/// How a set is made of its parts, or of their complements.
pub(super) enum Composition<'a> {
    /// A union: of what is induced, and of parts.
    Any(Option<&'a Group>, &'a [Arc<CObject>]),
    /// An intersection.
    All(Option<&'a Group>, &'a [Arc<CObject>]),
}

/// A set, or its complement by De Morgan's laws: complements stand at leaves only.
pub(super) fn composition(set: &Set, complement: bool) -> Composition<'_> {
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

/// The parts with the cheap ones first.
pub(super) fn cheap_first(parts: &[Arc<CObject>]) -> impl Iterator<Item = &CObject> + Clone {
    let all = || parts.iter().map(|part| &**part);
    all()
        .filter(is_pure)
        .chain(all().filter(|part| !is_pure(part)))
}

pub(super) fn is_pure(part: &&CObject) -> bool {
    matches!(part.set(), Set::Pure(_))
}
