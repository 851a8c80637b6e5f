//! Unions and intersections, stored as given and flattened on first use: growing a set one part at a time costs the same
//! for each part.

use std::collections::HashSet;
use std::sync::{Arc, OnceLock};

use foldhash::fast::RandomState;

use super::cobject::{CObject, Content};
use super::set::{Flat, Set};

/// The operation of a compound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CompoundKind {
    Union,
    Intersection,
}

/// A union or an intersection of parts.
#[derive(Debug)]
pub(super) struct Compound {
    kind: CompoundKind,
    parts: Vec<Part>,
    /// The depth of the deepest part that is not a compound of the same kind.
    depth: u32,
    flat: OnceLock<Flat>,
}

#[derive(Debug)]
enum Part {
    /// A compound of the same kind, which adds no level. Its C-object need not live on.
    Compound(Arc<Compound>),
    Other(Arc<CObject>),
}

impl Compound {
    pub fn new(kind: CompoundKind, parts: &[Arc<CObject>]) -> Self {
        let part = |part: &Arc<CObject>| match part.content() {
            Content::Compound(joined) if joined.kind == kind => Part::Compound(joined.clone()),
            _ => Part::Other(part.clone()),
        };
        let parts: Vec<Part> = parts.iter().map(part).collect();
        let depths = parts.iter().map(|part| match part {
            Part::Compound(joined) => joined.depth,
            // An induced set is a union of one.
            Part::Other(part) => part.depth() - u32::from(kind.is(part)),
        });
        Self {
            kind,
            depth: depths.max().unwrap_or(0),
            parts,
            flat: OnceLock::new(),
        }
    }

    pub fn depth(&self) -> u32 {
        self.depth
    }

    pub fn flat(&self) -> &Flat {
        self.flat.get_or_init(|| Flat::of(self.flatten()))
    }

    /// All parts in their order, without duplicates.
    fn flatten(&self) -> Set {
        let (mut induced, mut others) = (Vec::new(), Vec::new());
        let mut seen: HashSet<u64, RandomState> = HashSet::default();
        let mut visited: HashSet<*const Compound, RandomState> = HashSet::default();
        let mut stack: Vec<&Part> = self.parts.iter().rev().collect();
        while let Some(part) = stack.pop() {
            match part {
                Part::Compound(joined) => {
                    if visited.insert(Arc::as_ptr(joined)) {
                        stack.extend(joined.parts.iter().rev());
                    }
                }
                Part::Other(part) if self.kind.is(part) => {
                    if let Set::Union { induced: more, .. } = part.set() {
                        let is_new = more.iter().filter(|i| seen.insert(i.leaf.serial));
                        induced.extend(is_new.cloned());
                    }
                    let parts = part.set().parts().iter();
                    others.extend(parts.filter(|p| seen.insert(p.serial())).cloned());
                }
                Part::Other(part) => {
                    others.extend(seen.insert(part.serial()).then(|| part.clone()));
                }
            }
        }
        match self.kind {
            CompoundKind::Union => Set::Union { induced, others },
            CompoundKind::Intersection => Set::Intersection(others),
        }
    }
}

impl CompoundKind {
    /// Whether a C-object is of this kind, and stored flat.
    fn is(self, part: &CObject) -> bool {
        match part.content() {
            Content::Flat(flat) => match flat.set {
                Set::Union { .. } => self == Self::Union,
                Set::Intersection(_) => self == Self::Intersection,
                _ => false,
            },
            Content::Compound(_) => false,
        }
    }
}

impl Drop for Compound {
    /// Frees a chain of compounds in a loop: recursion over thousands of them would exhaust the stack.
    fn drop(&mut self) {
        let mut open = std::mem::take(&mut self.parts);
        while let Some(part) = open.pop() {
            if let Part::Compound(joined) = part
                && let Some(mut joined) = Arc::into_inner(joined)
            {
                open.append(&mut joined.parts);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cobject::{PureOptions, PureShape};
    use crate::robot::{JointKind, LinkDefinition, RobotBuilder};
    use crate::space::{Space, WorldBox};

    fn limits(space: &Arc<Space>) -> Arc<CObject> {
        let (shape, options) = (PureShape::BeyondLimits, PureOptions::default());
        Arc::new(CObject::pure(space.clone(), shape, options).unwrap())
    }

    fn space() -> Arc<Space> {
        let mut builder = RobotBuilder::new(3).unwrap();
        let link = LinkDefinition {
            kind: JointKind::Prismatic,
            ..LinkDefinition::default()
        };
        builder.add_link(link).unwrap();
        let robots = vec![Arc::new(builder.build().unwrap())];
        Arc::new(Space::new(robots, &[], WorldBox::unbounded()).unwrap())
    }

    /// Joining does not flatten, whatever the parts hold; and a long chain is freed without exhausting the stack.
    #[test]
    fn sets_grown_one_by_one_are_flattened_once() {
        let space = space();
        type Join = fn(&[Arc<CObject>]) -> crate::error::Result<CObject>;
        for join in [CObject::union as Join, CObject::intersection] {
            let mut all = limits(&space);
            let first = all.serial();
            for _ in 0..100_000 {
                all = Arc::new(join(&[all, limits(&space)]).unwrap());
                let Content::Compound(joined) = all.content() else {
                    panic!("it is not joined");
                };
                assert!(joined.parts.len() == 2 && joined.flat.get().is_none());
            }
            assert_eq!((all.depth(), all.set().parts().len()), (2, 100_001));
            let serials = all.set().parts().iter().map(|part| part.serial());
            assert!(serials.clone().is_sorted() && serials.min() == Some(first));
        }
    }

    /// A set that is joined with itself again and again still holds each part once.
    #[test]
    fn parts_that_are_shared_count_once() {
        let space = space();
        let mut all = CObject::union(&[limits(&space), limits(&space)]).unwrap();
        for _ in 0..60 {
            let half = Arc::new(all);
            all = CObject::union(&[half.clone(), half]).unwrap();
        }
        assert_eq!(all.set().parts().len(), 2);
    }
}
