//! What a C-object is made of, and what follows from it.

use std::sync::Arc;

use super::{CObject, Induced, KnownClass, PureSet, PureShape};
use crate::environment::Environment;

/// What a C-object is made of.
#[derive(Clone, Debug)]
pub enum Set {
    /// A union. Its induced sets are searched together, wherever they came from; a single induced set is a union of one.
    Union {
        /// The induced sets, without duplicates.
        induced: Vec<Arc<Induced>>,
        /// All other parts.
        others: Vec<Arc<CObject>>,
    },
    /// The configurations in all parts.
    Intersection(Vec<Arc<CObject>>),
    /// The configurations not in the part.
    Complement(Arc<CObject>),
    /// A set given in C-space itself.
    Pure(PureSet),
    /// A C-object whose class is known in places.
    Known(KnownClass),
}

/// The unit in which a set measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Metric {
    /// The set does not measure.
    None,
    Length,
    /// Units of C-space, in the pure set of this number.
    CSpace(u64),
    /// Lengths and units of C-space: the pure set of this number has no scale.
    Mixed(u64),
}

/// A set, with properties derived from its parts.
#[derive(Clone, Debug)]
pub(super) struct Flat {
    pub set: Set,
    pub metric: Metric,
    /// A part that cannot be answered from link poses alone: its number and its name.
    pub needs_coordinates: Option<(u64, &'static str)>,
    /// Without duplicates, in order of serials.
    pub environments: Vec<Arc<Environment>>,
    /// Its class, or that of a part, is known in places.
    pub has_known: bool,
}

impl Flat {
    pub fn of(set: Set) -> Self {
        let mut environments: Vec<Arc<Environment>> = set.environments();
        environments.sort_by_key(|environment| environment.serial());
        environments.dedup_by_key(|environment| environment.serial());
        Self {
            has_known: matches!(set, Set::Known(_))
                || set.parts().iter().any(|part| part.flat().has_known),
            metric: set.metric(),
            needs_coordinates: set.needs_coordinates(),
            set,
            environments,
        }
    }
}

impl Set {
    /// The parts, except for the induced sets.
    pub fn parts(&self) -> &[Arc<CObject>] {
        match self {
            Self::Union { others, .. } => others,
            Self::Intersection(parts) => parts,
            Self::Complement(part) => std::slice::from_ref(part),
            Self::Known(known) => std::slice::from_ref(&known.of),
            Self::Pure(_) => &[],
        }
    }

    fn environments(&self) -> Vec<Arc<Environment>> {
        let own = match self {
            Self::Union { induced, .. } => &induced[..],
            _ => &[],
        };
        let own = own.iter().filter_map(|term| term.pairs.environment());
        let below = self.parts().iter().flat_map(|part| part.environments());
        own.chain(below).cloned().collect()
    }

    fn needs_coordinates(&self) -> Option<(u64, &'static str)> {
        match self {
            Self::Pure(pure) => {
                let names = (pure.leaf.serial, pure.shape.name());
                (!pure.shape.is_in_world()).then_some(names)
            }
            _ => {
                let mut parts = self.parts().iter();
                parts.find_map(|part| part.flat().needs_coordinates)
            }
        }
    }

    fn metric(&self) -> Metric {
        let own = match self {
            Self::Union { induced, .. } if !induced.is_empty() => Metric::Length,
            Self::Pure(pure) if pure.shape.is_in_world() || pure.options.scale.is_some() => {
                Metric::Length
            }
            Self::Pure(pure) => match &pure.shape {
                PureShape::Predicate(predicate) if !predicate.measures() => Metric::None,
                _ => Metric::CSpace(pure.leaf.serial),
            },
            _ => Metric::None,
        };
        let parts = self.parts().iter().map(|part| part.flat().metric);
        parts.fold(own, |metric, next| match (metric, next) {
            (Metric::None, other) | (other, Metric::None) => other,
            (Metric::Mixed(pure), _) | (_, Metric::Mixed(pure)) => Metric::Mixed(pure),
            (Metric::CSpace(pure), Metric::Length) | (Metric::Length, Metric::CSpace(pure)) => {
                Metric::Mixed(pure)
            }
            (same, _) => same,
        })
    }
}
