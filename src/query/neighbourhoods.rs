//! Free neighbourhoods: what distances at one configuration prove of those around it (§2.3.4 remembers witnesses; Quinlan 1994 has
//! the bubbles).
//!
//! A link's pose depends only on the joints before it. So what is remembered is remembered for each link: "as far as the joints
//! before this link are in this neighbourhood, no body pair of the link is inside or in contact", with the pairs among links at the
//! last of the two. Where that is known of all links, a query needs neither poses nor geometry; else only the other links are asked.

use smallvec::SmallVec;

use super::make_neighbourhoods::Carriers;
use super::neighbourhood_table::{CellCoordinate, NeighbourhoodTable};
use super::scene::Group;
use super::witness_cells::WitnessCells;
use super::world::World;

/// Pairs that need not be asked.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FreePairs {
    /// No pair of the group is left.
    pub all: bool,
    /// All subjects worth a look-up of their own were found, and others were not.
    pub tried_all: bool,
    /// Of the first 64 links, one bit each: no pair with an s-object is left whose last link this is, by itself or by what it holds.
    pub links: u64,
    /// Of the group's first 128 pairs of links, one bit each, in the order of the sets.
    pub pairs: u128,
}

impl FreePairs {
    /// Whether the pairs with s-objects are free whose last link this is.
    #[inline(always)]
    pub fn has_link(self, link: usize) -> bool {
        link < 64 && self.links >> link & 1 != 0
    }

    /// Whether a pair of links is free.
    #[inline(always)]
    pub fn has_pair(self, number: usize) -> bool {
        number < 128 && self.pairs >> number & 1 != 0
    }

    #[inline(always)]
    pub fn has(self, subject: Subject) -> bool {
        match subject {
            Subject::Link(link) => self.has_link(link),
            Subject::Pair { number, .. } => self.has_pair(number),
        }
    }

    #[inline(always)]
    pub fn add(&mut self, subject: Subject) {
        match subject {
            Subject::Link(link) => self.links |= 1u64.checked_shl(link as u32).unwrap_or(0),
            Subject::Pair { number, .. } => {
                self.pairs |= 1u128.checked_shl(number as u32).unwrap_or(0);
            }
        }
    }
}

/// What a neighbourhood is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Subject {
    /// All pairs with s-objects whose last link this is: the coordinates before it count.
    Link(usize),
    /// A pair of links: the coordinates between them count.
    Pair {
        /// In the order of the group's sets.
        number: usize,
        links: [usize; 2],
    },
}

/// What remembered neighbourhoods did for queries.
#[derive(Clone, Copy, Debug, Default)]
pub struct NeighbourhoodCounts {
    /// Queries that were answered without poses or geometry.
    pub answers: u64,
    /// Queries answered by what met before in the same region.
    pub witnesses: u64,
    /// Links and pairs of links that other queries did not ask.
    pub left_out: u64,
    /// Neighbourhoods that were made.
    pub made: u64,
    /// Neighbourhoods that were dropped because an environment changed, or for those of another C-object.
    pub dropped: u64,
}

/// What neighbourhoods are of.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct GroupKey {
    /// The distance less the margin that is exceeded, as bits; of 0, the contact epsilons too.
    threshold: u64,
    /// Each induced set, by its leaf, with the version of its environment.
    terms: SmallVec<[(u64, u64); 4]>,
}

fn terms_of<'a>(world: &'a World, group: &'a Group) -> impl Iterator<Item = (u64, u64)> + 'a {
    group.iter().map(move |term| {
        let snapshot = term.pairs.environment().and_then(|e| world.snapshot(e));
        (term.leaf.serial, snapshot.map_or(0, |now| now.version))
    })
}

impl GroupKey {
    pub fn new(world: &World, group: &Group, threshold: f64) -> Self {
        Self {
            threshold: threshold.to_bits(),
            terms: terms_of(world, group).collect(),
        }
    }

    #[inline]
    fn is_of(&self, world: &World, group: &Group, threshold: f64) -> bool {
        self.threshold == threshold.to_bits()
            && self.terms.len() == group.len()
            && terms_of(world, group).eq(self.terms.iter().copied())
    }

    /// Whether both are of the same sets, in whatever state of the environments.
    fn is_of_same_sets(&self, other: &Self) -> bool {
        let leaves = |key: &Self| key.terms.iter().map(|(leaf, _)| *leaf).collect::<Vec<_>>();
        self.threshold == other.threshold && leaves(self) == leaves(other)
    }
}

/// Look-ups after which they are judged.
const WINDOW: u32 = 128;

/// Fewer of a window's look-ups than this are not worth them: making neighbourhoods takes more than they spare.
const ENOUGH: u32 = WINDOW / 4;

/// The longest rest, in queries.
const MAX_REST: u32 = 1 << 14;

/// Whether look-ups pay: those that rarely find anything rest, longer each time.
pub(super) struct Trial {
    /// Since the window began.
    asked: u32,
    found: u32,
    rests: u32,
    next_rest: u32,
}

impl Default for Trial {
    fn default() -> Self {
        Self {
            asked: 0,
            found: 0,
            rests: 0,
            next_rest: WINDOW,
        }
    }
}

impl Trial {
    /// Whether this query goes without.
    #[inline]
    fn rests(&mut self) -> bool {
        let rests = self.rests > 0;
        self.rests -= u32::from(rests);
        rests
    }

    /// Counts a look-up. One that is still `learning` is not judged.
    #[inline]
    fn count(&mut self, is_found: bool, learning: bool) {
        self.asked += 1;
        self.found += u32::from(is_found);
        if self.asked < WINDOW {
            return;
        }
        if self.found < ENOUGH && !learning {
            self.rests = self.next_rest;
            self.next_rest = (2 * self.next_rest).min(MAX_REST);
        } else {
            self.next_rest = WINDOW;
        }
        (self.asked, self.found) = (0, 0);
    }
}

/// The neighbourhoods of one link or of a pair of links.
pub(super) struct SubjectMemory {
    pub subject: Subject,
    /// A custom joint may do anything: nothing is remembered.
    pub is_supported: bool,
    pub table: NeighbourhoodTable,
    /// What met, by cell.
    pub witnesses: WitnessCells,
    /// What a hit spares, in pairs of nodes: half the mean work of measuring a clearance.
    pub value: f64,
    trial: Trial,
}

/// A subject is judged once it has this many neighbourhoods.
const LEARNT: usize = 512;

/// Subjects that spare less are looked up only where all others were found: a look-up takes about as long.
const DEAR: f64 = 6.0;

impl SubjectMemory {
    /// An empty memory, which will take about `max_bytes` at most.
    pub fn new(
        subject: Subject,
        coordinates: Option<Vec<CellCoordinate>>,
        max_bytes: usize,
    ) -> Self {
        Self {
            subject,
            is_supported: coordinates.is_some(),
            table: NeighbourhoodTable::new(coordinates.unwrap_or_default(), max_bytes),
            witnesses: WitnessCells::default(),
            value: 0.0,
            trial: Trial::default(),
        }
    }

    fn is_dear(&self) -> bool {
        self.value >= DEAR
    }

    /// Looks up what is worth it by itself.
    #[inline]
    fn look_up(&mut self, q: &[f64]) -> bool {
        if self.trial.rests() {
            return false;
        }
        let is_found = self.table.contains(q);
        self.trial.count(is_found, self.table.len() < LEARNT);
        is_found
    }

    /// Whether a neighbourhood around what was looked up is worth making: it was looked up in vain.
    pub fn is_wanted(&self, q: &[f64], free: FreePairs) -> bool {
        let is_looked_up = if self.is_dear() {
            self.trial.rests == 0
        } else {
            free.tried_all
        };
        self.is_supported && is_looked_up && !free.has(self.subject) && !self.table.contains(q)
    }
}

/// The neighbourhoods of the induced sets of a union, in one state of their environments.
pub(super) struct GroupMemory {
    pub key: GroupKey,
    pub subjects: Vec<SubjectMemory>,
    /// Of looking up all subjects.
    trial: Trial,
    has_unsupported: bool,
    /// What moves the subjects' bodies, with the environment of those that links hold.
    pub carriers: Vec<(Subject, Option<u64>, Carriers)>,
    /// Lengths beyond which clearances are not measured.
    pub farthest: f64,
}

/// All that a context remembers: of at most [`Self::MAX_GROUPS`] unions.
pub(crate) struct Neighbourhoods {
    pub(super) is_on: bool,
    pub(super) groups: Vec<GroupMemory>,
    /// The group that the next new one replaces.
    oldest: usize,
    pub(super) counts: NeighbourhoodCounts,
    /// The work that may be spent on making neighbourhoods; negative where more was spent.
    credit: f64,
    /// The mean work of a query that looks at geometry.
    mean_work: f64,
}

impl Default for Neighbourhoods {
    fn default() -> Self {
        Self {
            is_on: false,
            groups: Vec::new(),
            oldest: 0,
            counts: NeighbourhoodCounts::default(),
            credit: Self::FIRST_CREDIT,
            mean_work: 0.0,
        }
    }
}

impl Neighbourhoods {
    const MAX_GROUPS: usize = 4;

    /// What a hundred or two queries of an arm take.
    const FIRST_CREDIT: f64 = 3e4;

    /// The part of its work by which a query lets neighbourhoods be made, and of what neighbourhoods spare.
    const SHARES: [f64; 2] = [1.0 / 16.0, 0.5];

    /// The work of a query beside its pairs of nodes and primitives, in pairs of nodes.
    const FIXED_WORK: f64 = 40.0;

    /// Forgets all neighbourhoods, not whether they are wanted nor what they did.
    pub fn clear(&mut self) {
        self.groups.clear();
        (self.oldest, self.credit) = (0, Self::FIRST_CREDIT);
    }

    /// The links of a group that need not be asked.
    #[inline]
    pub fn look_up(
        &mut self,
        world: &World,
        group: &Group,
        q: &[f64],
        threshold: f64,
    ) -> FreePairs {
        let Some(memory) = self.find(world, group, threshold) else {
            return FreePairs::default();
        };
        let (free, spared) = memory.look_up(q);
        if free.all {
            self.counts.answers += 1;
            self.earn(self.mean_work);
        } else {
            self.counts.left_out += u64::from(free.links.count_ones() + free.pairs.count_ones());
            self.earn(spared);
        }
        free
    }

    /// Half of what neighbourhoods spare may be spent on others.
    fn earn(&mut self, spared: f64) {
        self.credit = (self.credit + Self::SHARES[1] * spared).min(Self::FIRST_CREDIT);
    }

    /// Whether a straight segment keeps all links in one neighbourhood each, with a part of its radii to spare.
    pub fn hold_segment(
        &mut self,
        world: &World,
        group: &Group,
        ends: [&[f64]; 2],
        spare: f32,
    ) -> bool {
        let holds = |subject: &SubjectMemory| {
            subject.is_supported && subject.table.contains_segment(ends, spare)
        };
        let memory = self.find(world, group, 0.0);
        let is_held = memory.is_some_and(|memory| memory.subjects.iter().all(holds));
        self.counts.answers += u64::from(is_held);
        is_held
    }

    pub(super) fn find(
        &mut self,
        world: &World,
        group: &Group,
        threshold: f64,
    ) -> Option<&mut GroupMemory> {
        let is_own = |memory: &&mut GroupMemory| memory.key.is_of(world, group, threshold);
        self.groups.iter_mut().find(is_own)
    }

    /// Counts the work of a query, in pairs of nodes. True if neighbourhoods may be made now.
    pub fn has_credit(&mut self, work: u64) -> bool {
        let work = Self::FIXED_WORK + work as f64;
        self.mean_work += (work - self.mean_work) / 64.0;
        self.credit = (self.credit + Self::SHARES[0] * work).min(Self::FIRST_CREDIT);
        self.credit > 0.0
    }

    pub(super) fn spend(&mut self, work: f64) {
        self.credit -= work;
    }

    /// The memory of a key, which `make` makes if there is none.
    pub(super) fn memory_of(
        &mut self,
        key: &GroupKey,
        make: impl FnOnce() -> GroupMemory,
    ) -> &mut GroupMemory {
        if let Some(place) = self.groups.iter().position(|memory| memory.key == *key) {
            return &mut self.groups[place];
        }
        let of_same = |memory: &GroupMemory| memory.key.is_of_same_sets(key);
        let place = match self.groups.iter().position(of_same) {
            Some(place) => place,
            None if self.groups.len() < Self::MAX_GROUPS => {
                self.groups.push(make());
                return self.groups.last_mut().expect("it was pushed");
            }
            None => {
                self.oldest = (self.oldest + 1) % Self::MAX_GROUPS;
                self.oldest
            }
        };
        let kept = self.groups[place].subjects.iter();
        self.counts.dropped += kept.map(|subject| subject.table.len() as u64).sum::<u64>();
        self.groups[place] = make();
        &mut self.groups[place]
    }
}

impl GroupMemory {
    pub(super) fn new(
        key: GroupKey,
        subjects: Vec<SubjectMemory>,
        carriers: Vec<(Subject, Option<u64>, Carriers)>,
        farthest: f64,
    ) -> Self {
        Self {
            has_unsupported: subjects.iter().any(|subject| !subject.is_supported),
            key,
            subjects,
            trial: Trial::default(),
            carriers,
            farthest,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.subjects.iter().all(|subject| subject.table.is_empty())
    }

    pub(super) fn find(&mut self, subject: Subject) -> Option<&mut SubjectMemory> {
        let mut all = self.subjects.iter_mut();
        all.find(|memory| memory.subject == subject)
    }

    /// What is known to be free, and what that spares.
    #[inline]
    fn look_up(&mut self, q: &[f64]) -> (FreePairs, f64) {
        let (mut free, mut spared) = (FreePairs::default(), 0.0);
        let mut is_all = true;
        for subject in self.subjects.iter_mut().filter(|subject| subject.is_dear()) {
            if subject.look_up(q) {
                free.add(subject.subject);
                spared += subject.value;
            } else {
                is_all = false;
            }
        }
        if !is_all || self.has_unsupported || self.trial.rests() {
            return (free, spared);
        }
        let others = self.subjects.iter().enumerate();
        let mut others = others.filter(|(_, subject)| !subject.is_dear());
        match others.find(|(_, subject)| !subject.table.contains(q)) {
            None => free.all = true,
            Some((place, _)) => {
                free.tried_all = true;
                // It may well be the first that is not found next time.
                self.subjects.swap(0, place);
            }
        }
        let kept = self.subjects.iter().map(|subject| subject.table.len());
        self.trial.count(free.all, kept.sum::<usize>() < LEARNT);
        (free, spared)
    }
}
