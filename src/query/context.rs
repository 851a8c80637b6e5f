//! A query context: one thread's caches and scratch memory.

use super::answer::{ContactsListed, SSide};
use super::candidates::CandidateScratch;
use super::combination::Answers;
use super::scene::{Configuration, Scene, SceneMemory};
use super::world::World;
use crate::cobject::CObject;
use crate::environment::Environment;
use crate::error::{Error, ErrorKind, Result};
use crate::pair::Scratch;
use crate::work_meter::Statistics;
use foldhash::fast::RandomState;
use std::collections::HashMap;

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

    /// Asks about the scene of a query, in memory that the context keeps.
    pub(super) fn ask<T>(
        &mut self,
        cobject: &CObject,
        world: &World,
        at: Configuration,
        question: impl FnOnce(&mut Self, &Scene) -> Result<T>,
    ) -> Result<T> {
        let memory = std::mem::take(&mut self.scene_memory);
        let scene = scene(cobject, world, at, memory)?;
        let answer = question(self, &scene);
        self.scene_memory = scene.into_memory();
        answer
    }

    /// Counts the bounds of two bodies; refuses to go on past the limit of the call.
    pub(super) fn count_body_pair(&mut self) -> Result<()> {
        let meter = self.scratch.meter_mut();
        meter.count_nodes(1);
        meter.check()
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

/// Refuses thresholds that are NaN or negative; infinity is welcome.
pub(crate) fn check_threshold(value: f64, name: &str) -> Result<()> {
    if value.is_nan() {
        return Err(Error::new(ErrorKind::NotFinite, format!("{name} is NaN")));
    }
    if value < 0.0 {
        return Err(Error::invalid(format!("{name} is negative: {value}")));
    }
    Ok(())
}

/// The scene of a query. Whether coordinates are needed does not depend on which parts come to be asked.
pub(super) fn scene<'a>(
    cobject: &'a CObject,
    world: &'a World,
    at: Configuration<'a>,
    memory: SceneMemory,
) -> Result<Scene<'a>> {
    if let Configuration::LinkPoses(_) = at {
        cobject.require_no_coordinates()?;
    }
    Scene::new(cobject.space(), world, at, memory)
}
