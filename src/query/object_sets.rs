//! The objects of one environment or of two that are asked about pair by pair.

use std::sync::Arc;

use super::answer::SSide;
use super::cache_key::CacheKey;
use super::target::Target;
use crate::cobject::InducedOptions;
use crate::environment::{Environment, SObject, Snapshot};
use crate::error::{Error, ErrorKind, Result};

/// Whether a pair of objects is asked about; may fail.
pub type ObjectFilter<'f> = dyn FnMut(&SObject, &SObject) -> Result<bool> + 'f;

/// The objects of one state of an environment, each with each, or with each of a second environment.
pub struct ObjectSets<'f> {
    pub(super) environments: [u64; 2],
    pub(super) first: Arc<Snapshot>,
    pub(super) second: Option<Arc<Snapshot>>,
    filter: Option<&'f mut ObjectFilter<'f>>,
}

/// A pair of objects that the traversal found, by places, with a lower bound of its distance.
#[derive(Clone, Copy)]
pub(super) struct NearPair {
    pub places: [usize; 2],
    pub bound: f64,
}

impl<'f> ObjectSets<'f> {
    /// The current states of one or two environments. The same one twice is one. Refused are planar objects against spatial
    /// ones, and attached objects, whose poses are unknown here.
    pub fn new(
        first: &Environment,
        second: Option<&Environment>,
        filter: Option<&'f mut ObjectFilter<'f>>,
    ) -> Result<Self> {
        let second = second.filter(|second| second.serial() != first.serial());
        let environments = [first.serial(), second.unwrap_or(first).serial()];
        let (first, second) = (first.snapshot(), second.map(Environment::snapshot));
        for snapshot in [Some(&first), second.as_ref()].into_iter().flatten() {
            if let Some(SObject { id, .. }) = snapshot.attached().next() {
                return Err(Error::new(
                    ErrorKind::Unsupported,
                    format!(
                        "s-object {id} is attached to a link: its place in the world is not known here"
                    ),
                ));
            }
        }
        if let (Some(a), Some(b)) = (first.first(), second.as_ref().and_then(|s| s.first()))
            && a.body.dimension() != b.body.dimension()
        {
            return Err(Error::invalid(format!(
                "s-objects {} and {} differ in dimension",
                a.id, b.id
            )));
        }
        Ok(Self {
            environments,
            first,
            second,
            filter,
        })
    }

    /// The states of the two sides.
    pub(super) fn sides(&self) -> [&Snapshot; 2] {
        [&self.first, self.second.as_ref().unwrap_or(&self.first)]
    }

    pub(super) fn version(&self) -> u64 {
        let [a, b] = self.sides();
        a.version.max(b.version)
    }

    /// Whether there is no pair.
    pub(super) fn is_empty(&self) -> bool {
        let [a, b] = self.sides().map(|side| side.len());
        a == 0 || b == 0 || (self.second.is_none() && a == 1)
    }

    pub(super) fn admits(&mut self, places: [usize; 2]) -> Result<bool> {
        let second = self.second.as_ref().unwrap_or(&self.first);
        match &mut self.filter {
            Some(filter) => filter(self.first.object(places[0]), second.object(places[1])),
            None => Ok(true),
        }
    }
}

/// Two objects as the target of a search.
pub(super) fn target<'a>([a, b]: [&'a Snapshot; 2], pair: &NearPair) -> Target<'a> {
    let [a, b] = [a.object(pair.places[0]), b.object(pair.places[1])];
    Target {
        sides: [(&*a.body, &a.pose), (&*b.body, &b.pose)],
        // No space has this number.
        key: CacheKey::Candidate {
            space: 0,
            r_link: 0,
            r_object: a.id,
            s_side: SSide::Object(b.id),
            body: b.body.serial(),
        },
        options: InducedOptions::default(),
        data: [a.data(), b.data()],
        s_carrier: None,
        term: 0,
        rank: 0,
        bound: pair.bound,
    }
}

/// The targets of a block, ranked by ids and sorted by bound.
pub(super) fn targets<'a>(sides: [&'a Snapshot; 2], block: &mut [NearPair]) -> Vec<Target<'a>> {
    block.sort_unstable_by_key(|pair| pair.places);
    let ranked = block.iter().zip(0..).map(|(pair, rank)| Target {
        rank,
        ..target(sides, pair)
    });
    let mut targets: Vec<Target> = ranked.collect();
    targets.sort_unstable_by(|a, b| a.bound.total_cmp(&b.bound).then(a.rank.cmp(&b.rank)));
    targets
}
