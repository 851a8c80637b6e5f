//! A query context: one thread's caches and scratch memory.

use super::answer::ContactsListed;
use super::cache_key::CacheKey;
use super::candidates::CandidateScratch;
use super::combination::Answers;
use super::scene::{Configuration, Scene, SceneMemory};
use super::world::World;
use crate::cobject::CObject;
use crate::environment::{Environment, NearPairScratch};
use crate::error::{Error, ErrorKind, Result};
use crate::pair::Scratch;
use crate::reused::Kept;
use crate::work_meter::Statistics;
use foldhash::fast::RandomState;
use std::collections::HashMap;

/// One thread's scratch memory, and the witnesses of earlier queries for warm starts (§2.3.4). It changes how long an
/// answer takes, never the answer. One thread at a time may use it.
#[derive(Default)]
pub struct QueryContext {
    pub(crate) scratch: Scratch,
    pub(crate) candidates: CandidateScratch,
    pub(super) scene_memory: SceneMemory,
    /// Memory of proofs of motions.
    pub(crate) proof_memory: Kept,
    pub(super) answers: Answers,
    /// Which contacts witness lists hold.
    pub(super) contacts: ContactsListed,
    pub(super) near_pairs: NearPairScratch,
    /// How far apart the bounds of answers about curved surfaces may be, if the caller wants these refined.
    pub(super) refinement: Option<f64>,
    /// The same within a call that refines.
    pub(super) gap: Option<f64>,
    witnesses: HashMap<CacheKey, [u32; 2], RandomState>,
    /// The pair remembered last.
    pub(super) recent: Option<CacheKey>,
    /// Whether it was found twice in a row, and near enough when a threshold was last asked about: along a motion it then mostly is the
    /// next time. At poses that have nothing to do with each other it hardly ever is: of the configurations that an RRT-Connect asks
    /// for, 2 % of those that are inside are so by the pair found last.
    pub(super) recent_decides: bool,
    /// Whether the distance asked for last was 0: the next one mostly is too.
    pub(super) met_last: bool,
    /// The versions of environments that the last query saw, in order of their serial numbers.
    seen: Vec<(u64, u64)>,
}

impl QueryContext {
    /// When this many witnesses are remembered, the cache is cleared.
    const CAPACITY: usize = 1 << 16;

    /// A context that remembers nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Begins a call: takes the current snapshots of the C-object's environments, and records their versions for
    /// [`QueryContext::version_seen`].
    pub(crate) fn look(&mut self, cobject: &CObject) -> World {
        let world = World::of(cobject);
        self.start_looking(world.versions());
        world
    }

    /// Begins a call that sees these versions of environments, in order of their serial numbers.
    pub(super) fn start_looking(&mut self, versions: impl IntoIterator<Item = (u64, u64)>) {
        self.scratch.meter_mut().start_call();
        self.seen.clear();
        self.seen.extend(versions);
    }

    /// Begins an item of a batch, whose world is taken: its work is counted from 0. Under a limit nothing of earlier items is
    /// remembered, so that the work of an item, and whether it reaches the limit, is its own.
    pub(crate) fn start_item(&mut self, limit: Option<u64>) {
        if limit.is_some() {
            self.clear();
        }
        let meter = self.scratch.meter_mut();
        meter.limit = limit;
        meter.start_call();
    }

    /// Runs a query on its scene, which is built in memory that the context keeps.
    pub(crate) fn with_scene<T>(
        &mut self,
        cobject: &CObject,
        world: &World,
        at: Configuration,
        query: impl FnOnce(&mut Self, &Scene) -> Result<T>,
    ) -> Result<T> {
        let memory = std::mem::take(&mut self.scene_memory);
        let scene = scene(cobject, world, at, memory)?;
        let answer = query(self, &scene);
        self.scene_memory = scene.into_memory();
        answer
    }

    /// Counts one test of bounds; fails once the call has reached its work limit.
    pub(super) fn count_body_pair(&mut self) -> Result<()> {
        let meter = self.scratch.meter_mut();
        meter.count_nodes(1);
        meter.check()
    }

    /// The version of an environment that the last query with this context saw; `None` if its C-object does not refer to
    /// the environment.
    pub fn version_seen(&self, environment: &Environment) -> Option<u64> {
        let serial = environment.serial();
        let found = self.seen.binary_search_by_key(&serial, |(seen, _)| *seen);
        found.ok().map(|i| self.seen[i].1)
    }

    /// The work done since the context was created or last reset.
    pub fn statistics(&self) -> Statistics {
        self.scratch.meter().done
    }

    /// Sets the statistics to 0.
    pub fn reset_statistics(&mut self) {
        self.scratch.meter_mut().done = Statistics::default();
    }

    /// The most node pairs and primitive pairs that a call may test; `None` for no limit. A call that needs more fails with
    /// [`crate::error::ErrorKind::Limit`].
    pub fn limit(&self) -> Option<u64> {
        self.scratch.meter().limit
    }

    /// Sets the limit of later calls.
    pub fn set_limit(&mut self, limit: Option<u64>) {
        self.scratch.meter_mut().limit = limit;
    }

    /// Which contacts witness lists hold.
    pub fn contacts(&self) -> ContactsListed {
        self.contacts
    }

    /// Sets which contacts later witness lists hold.
    pub fn set_contacts(&mut self, contacts: ContactsListed) {
        self.contacts = contacts;
    }

    /// A new context with the same settings.
    pub fn renewed(&self) -> Self {
        let mut renewed = Self {
            contacts: self.contacts,
            refinement: self.refinement,
            ..Self::default()
        };
        renewed.set_limit(self.limit());
        renewed
    }

    /// Forgets the witnesses of earlier queries.
    pub fn clear(&mut self) {
        self.witnesses.clear();
        self.recent = None;
        self.met_last = false;
    }

    pub(super) fn remembered(&self, key: &CacheKey) -> Option<[u32; 2]> {
        self.witnesses.get(key).copied()
    }

    pub(super) fn remember(&mut self, key: CacheKey, primitives: [u32; 2]) {
        if self.witnesses.len() >= Self::CAPACITY {
            self.witnesses.clear();
        }
        let before = self.witnesses.insert(key, primitives);
        self.recent_decides = self.recent == Some(key) && before == Some(primitives);
        self.recent = Some(key);
    }
}

/// Refuses thresholds that are NaN or negative; infinity is allowed.
pub(crate) fn check_threshold(value: f64, name: &str) -> Result<()> {
    if value.is_nan() {
        return Err(Error::new(ErrorKind::NotFinite, format!("{name} is NaN")));
    }
    if value < 0.0 {
        return Err(Error::invalid(format!("{name} is negative: {value}")));
    }
    Ok(())
}

/// The scene of a query. Refused for link poses if any part of the C-object needs coordinates, even one that the query
/// would not reach.
fn scene<'a>(
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
