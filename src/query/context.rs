//! A query context: one thread's caches and scratch memory.

use std::collections::HashMap;

use foldhash::fast::RandomState;

use super::answer::{ContactsListed, SSide};
use super::candidates::CandidateScratch;
use super::scene::SceneMemory;
use super::sets::Answers;
use super::world::World;
use crate::cobject::CObject;
use crate::environment::Environment;
use crate::pair::Scratch;
use crate::work_meter::Statistics;

/// Names a body pair across queries: a space and two of its parties, or two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum CacheKey {
    Bodies(u64, u64),
    Candidate {
        space: u64,
        r_link: usize,
        /// What is attached to the link and stands for it, or 0.
        r_object: u64,
        s_side: SSide,
        /// The s-object's body: an id keeps its body for good, but a key must not outlive what it names.
        body: u64,
    },
}

/// Scratch memory and the witnesses of earlier queries (§2.3.4). It changes how long an answer takes, never the answer.
#[derive(Default)]
pub struct QueryContext {
    pub(crate) scratch: Scratch,
    pub(crate) candidates: CandidateScratch,
    pub(super) scene_memory: SceneMemory,
    pub(super) answers: Answers,
    /// Which contacts lists of witnesses hold.
    pub(super) contacts: ContactsListed,
    witnesses: HashMap<CacheKey, [u32; 2], RandomState>,
    /// The pair remembered last.
    pub(super) recent: Option<CacheKey>,
    /// The versions of environments that the last query saw, in order of their serial numbers.
    seen: Vec<(u64, u64)>,
}

impl QueryContext {
    /// Beyond this many remembered witnesses the cache starts anew.
    const CAPACITY: usize = 1 << 16;

    pub fn new() -> Self {
        Self::default()
    }

    /// The world as a C-object sees it now, which [`QueryContext::version_seen`] tells from then on. A call begins with it.
    pub(crate) fn look(&mut self, cobject: &CObject) -> World {
        self.scratch.meter_mut().start_call();
        let world = World::of(cobject);
        self.seen.clear();
        self.seen.extend(world.versions());
        world
    }

    /// The version of an environment that the last query with this context saw, if it was one of a C-object that refers
    /// to it.
    pub fn version_seen(&self, environment: &Environment) -> Option<u64> {
        let serial = environment.serial();
        let found = self.seen.binary_search_by_key(&serial, |(known, _)| *known);
        found.ok().map(|i| self.seen[i].1)
    }

    /// Work done since the context was made or last reset.
    pub fn statistics(&self) -> Statistics {
        self.scratch.meter().done
    }

    pub fn reset_statistics(&mut self) {
        self.scratch.meter_mut().done = Statistics::default();
    }

    /// How many node pairs and primitive pairs a call may look at; `None` for no limit. A call that needs more fails with
    /// [`crate::error::ErrorKind::Limit`].
    pub fn limit(&self) -> Option<u64> {
        self.scratch.meter().limit
    }

    pub fn set_limit(&mut self, limit: Option<u64>) {
        self.scratch.meter_mut().limit = limit;
    }

    /// Which contacts come with the witnesses of lists.
    pub fn contacts(&self) -> ContactsListed {
        self.contacts
    }

    /// Which contacts come with the witnesses of lists from now on.
    pub fn set_contacts(&mut self, contacts: ContactsListed) {
        self.contacts = contacts;
    }

    /// Forgets the witnesses of earlier queries.
    pub fn clear(&mut self) {
        self.witnesses.clear();
        self.recent = None;
    }

    pub(super) fn remembered(&self, key: &CacheKey) -> Option<[u32; 2]> {
        self.witnesses.get(key).copied()
    }

    pub(super) fn remember(&mut self, key: CacheKey, primitives: [u32; 2]) {
        if self.witnesses.len() >= Self::CAPACITY {
            self.witnesses.clear();
        }
        self.witnesses.insert(key, primitives);
        self.recent = Some(key);
    }
}
