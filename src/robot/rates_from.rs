//! Bounds of how fast links move as one of them sees it.

use smallvec::SmallVec;

use super::link_motions::{Element, LinkMotions};
use super::motion_rates::ChainRates;

/// The bounds of links' derivatives on a motion as one link sees them, or the world. Each is computed when it is first asked for, from
/// that of its neighbour on the way to the one that sees it: only the joints between the two count.
#[derive(Debug)]
pub struct RatesFrom<'a> {
    motions: &'a LinkMotions,
    /// The link that sees the others, if it is not the world.
    from: Option<usize>,
    /// The first of its carriers whose own carrier has not been looked at, if it is not the world.
    behind: Option<usize>,
    /// The world, once all carriers have been looked at.
    world: Seen,
    links: Vec<Seen>,
    /// Which of the links have been looked at.
    is_seen: Vec<bool>,
}

/// Memory of [`RatesFrom`].
#[derive(Debug, Default)]
pub struct RatesMemory {
    links: Vec<Seen>,
    is_seen: Vec<bool>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    chain: ChainRates,
    /// A custom joint moves on the way.
    is_unknown: bool,
}

impl<'a> RatesFrom<'a> {
    /// As a link sees them, or for `None` the world.
    pub fn new(motions: &'a LinkMotions, from: Option<usize>) -> Self {
        Self::in_memory(motions, from, RatesMemory::default())
    }

    /// The same, in memory that is used again.
    pub fn in_memory(motions: &'a LinkMotions, from: Option<usize>, memory: RatesMemory) -> Self {
        let RatesMemory {
            mut links,
            mut is_seen,
        } = memory;
        links.resize(motions.len(), Seen::default());
        is_seen.clear();
        is_seen.resize(motions.len(), false);
        let mut rates = Self {
            motions,
            from: None,
            behind: None,
            world: Seen::default(),
            links,
            is_seen,
        };
        if from.is_some() {
            rates.look_from(from);
        }
        rates
    }

    /// The memory, for others.
    pub fn into_memory(self) -> RatesMemory {
        RatesMemory {
            links: self.links,
            is_seen: self.is_seen,
        }
    }

    /// Changes what sees them.
    pub fn look_from(&mut self, from: Option<usize>) {
        self.from = from;
        self.is_seen.fill(false);
        self.behind = from;
        match from {
            Some(link) => self.note(link, Seen::default()),
            None => self.world = Seen::default(),
        }
    }

    /// Looks at what carries the link that sees the others, up to a link, or for `None` to the world. Of these each is seen through
    /// the joint of the one before it from behind. Links have larger numbers than what carries them.
    fn look_behind(&mut self, to: Option<usize>) {
        let motions = self.motions;
        while let Some(link) = self.behind.filter(|link| to.is_none_or(|to| to < *link)) {
            let mut seen = self.links[link];
            seen.is_unknown |= !motions.is_joint_known(link);
            for element in motions.elements_of(link).iter().rev() {
                match element {
                    Element::Fixed(pose) => seen.chain.push_fixed(&pose.inverse()),
                    other => motions.push_element(&mut seen.chain, other),
                }
            }
            self.behind = motions.parent(link);
            match self.behind {
                Some(carrier) => self.note(carrier, seen),
                None => self.world = seen,
            }
        }
    }

    /// The link that sees the others, if it is not the world.
    pub fn from(&self) -> Option<usize> {
        self.from
    }

    /// The bounds of a link's derivatives; `None` where a custom joint moves on the way.
    pub fn of(&mut self, link: usize) -> Option<&ChainRates> {
        let Seen { chain, is_unknown } = self.seen(link);
        (!*is_unknown).then_some(chain)
    }

    /// The same as if all joints rested whose motion is not known.
    pub fn of_known_joints(&mut self, link: usize) -> &ChainRates {
        &self.seen(link).chain
    }

    fn note(&mut self, link: usize, seen: Seen) {
        self.links[link] = seen;
        self.is_seen[link] = true;
    }

    fn seen(&mut self, link: usize) -> &Seen {
        if !self.is_seen[link] {
            self.look_at(link);
        }
        &self.links[link]
    }

    /// Goes to a link from the nearest carrier that is known.
    fn look_at(&mut self, link: usize) {
        let mut path: SmallVec<[usize; 16]> = SmallVec::new();
        let mut next = Some(link);
        let mut seen = loop {
            self.look_behind(next);
            let Some(index) = next else {
                break self.world;
            };
            if self.is_seen[index] {
                break self.links[index];
            }
            path.push(index);
            next = self.motions.parent(index);
        };
        for index in path.into_iter().rev() {
            seen.is_unknown |= !self.motions.is_joint_known(index);
            for element in self.motions.elements_of(index) {
                self.motions.push_element(&mut seen.chain, element);
            }
            self.note(index, seen);
        }
    }
}
