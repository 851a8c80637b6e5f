//! What a proof looks at: the leaves of a set, the body pairs that the motion may bring near, and the crowds that pairs make.

use std::cmp::Ordering;
use std::ptr;

use super::carried::Carried;
use super::crowd::{Crowd, CrowdMemory};
use super::interval_proof::MovingLeaf;
use super::linear_motion::{LinearMotion, STEP_FRACTION};
use super::moving_pair::MovingPair;
use super::moving_pure::MovingPure;
use super::pair_rates::PairRates;
use super::set_tree::{LeafContent, SetLeaf, SetTree};
use super::start_contacts::StartContacts;
use super::way::{Way, WayKind};
use crate::cobject::{BodyPairs, Induced, PureSet, PureShape};
use crate::error::{Error, ErrorKind, Result};
use crate::query::{CandidateFilter, Group, Placement, QueryContext, Scene, Target};
use crate::robot::LinkMotions;

/// What is to be proved of a set, whose complements are moved down to the leaves of its tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keeps {
    /// No configuration is inside the tree's set: a leaf must not be inside, a complement must be inside or in contact.
    Out,
    /// Every configuration is inside the set whose complement the tree stands for: a leaf must be outside and not in contact, a
    /// complement inside.
    In,
}

fn unstated_speeds(term: &Induced) -> Error {
    Error::new(
        ErrorKind::Unsupported,
        format!(
            "C-object {}: a custom joint that does not state its speeds moves on the way",
            term.leaf.serial
        ),
    )
}

/// Gathers the leaves of a set on a motion, and the pairs that the motion may bring near.
pub(super) struct Gathering<'a> {
    way: &'a Way<'a>,
    rates: PairRates<'a>,
    threshold: f64,
    keeps: Keeps,
    is_plain: bool,
    /// Whether the leaf that is added stands for the complement.
    complement: bool,
    pub leaves: Vec<MovingLeaf>,
    pub pairs: Vec<MovingPair<'a>>,
    /// The proof does not see whether the start is free: pairs that rest, and bodies inside others.
    pub needs_start: bool,
    /// Of links' bodies in the world, where they were asked for.
    speeds: Vec<Option<f64>>,
    /// Of a motion that is known not to begin inside: what touches at its start.
    pub start: Option<&'a StartContacts>,
}

impl<'a> Gathering<'a> {
    pub fn new(
        way: &'a Way<'a>,
        motions: &'a LinkMotions,
        threshold: f64,
        tree: &SetTree,
        keeps: Keeps,
    ) -> Self {
        Self {
            way,
            rates: PairRates::new(motions),
            threshold,
            keeps,
            is_plain: tree.is_plain_union(),
            complement: false,
            leaves: Vec::with_capacity(tree.leaves.len()),
            pairs: Vec::new(),
            needs_start: false,
            speeds: Vec::new(),
            start: None,
        }
    }

    /// Adds a leaf of the tree; in the order of the tree's leaves. The scene is that at the middle.
    pub fn add(
        &mut self,
        leaf: &SetLeaf<'a>,
        scene: &'a Scene,
        context: &mut QueryContext,
    ) -> Result<()> {
        let complement = leaf.complement;
        self.complement = complement;
        let moving = match leaf.content {
            LeafContent::Pure(set) => self.pure(set, complement)?,
            LeafContent::Known(sets) => MovingLeaf::Known {
                sets: sets.clone(),
                complement,
            },
            // The distance from the complement of an induced set is 0 or unknown.
            LeafContent::Induced(_) if complement && self.threshold > 0.0 => MovingLeaf::Everything,
            LeafContent::Induced(group) => {
                for term in 0..group.len() {
                    self.add_pairs(&group[term..=term], complement, scene, context)?;
                }
                MovingLeaf::Pairs { complement }
            }
        };
        self.leaves.push(moving);
        Ok(())
    }

    fn pure(&self, set: &PureSet, complement: bool) -> Result<MovingLeaf> {
        let is_predicate = matches!(set.shape, PureShape::Predicate(_));
        if let Some(start) = self.start {
            return Ok(MovingLeaf::Pure(MovingPure::after_start(
                self.way, set, start,
            )?));
        }
        Ok(match (self.keeps, complement) {
            (Keeps::Out, _) => {
                MovingLeaf::Pure(MovingPure::new(self.way, set, complement, self.threshold)?)
            }
            // Where a predicate is in contact it is not outside, however far away that is.
            (Keeps::In, false) if is_predicate => MovingLeaf::Everything,
            (Keeps::In, false) => {
                MovingLeaf::Pure(MovingPure::new(self.way, set, false, set.epsilon())?)
            }
            (Keeps::In, true) => {
                let mut without_contact = set.clone();
                without_contact.options.contact_epsilon = 0.0;
                MovingLeaf::Pure(MovingPure::new(self.way, &without_contact, true, 0.0)?)
            }
        })
    }

    /// Adds the pairs of one induced set. Its outside begins where distances exceed the contact epsilon.
    fn add_pairs(
        &mut self,
        term: &'a Group,
        complement: bool,
        scene: &'a Scene,
        context: &mut QueryContext,
    ) -> Result<()> {
        let is_outside_meant = complement != (self.keeps == Keeps::In);
        let threshold = if is_outside_meant {
            term[0].options.contact_epsilon
        } else {
            self.threshold
        };
        if let BodyPairs::Links { pairs, .. } = &term[0].pairs {
            let meter = context.scratch.meter_mut();
            meter.count_nodes(pairs.len() as u64);
            meter.check()?;
            return self.add_link_pairs(pairs, threshold, &term[0], scene);
        }
        let fastest = self.fastest(&term[0], scene);
        if fastest.is_infinite() {
            return Err(unstated_speeds(&term[0]));
        }
        if fastest == 0.0 && self.is_plain {
            self.needs_start = true;
            return Ok(());
        }
        let checked = scene.checked(term)?;
        // No distance at another time is less than that at the middle by more than what the motion changes up to there.
        let wanted = CandidateFilter {
            any_order: true,
            ..CandidateFilter::within(threshold + self.share() * fastest / STEP_FRACTION)
        };
        let meter = context.scratch.meter_mut();
        let found = scene.candidates(checked, wanted, &mut context.candidates, meter)?;
        // Those of one body together, what is near first.
        let mut order: Vec<(usize, u64, OrderedBound, usize)> = Vec::with_capacity(found.len());
        for (place, target) in found.iter().enumerate() {
            let speed = self.speed(scene, target);
            if self.may_meet(target.bound, threshold, speed) {
                let (link, object, _) = target.parties();
                order.push((link, object, OrderedBound(target.bound), place));
            }
        }
        order.sort_unstable();
        for (.., place) in order {
            self.add_pair(&found[place], threshold, &term[0], scene)?;
        }
        context.candidates.keep(found);
        Ok(())
    }

    /// The same of pairs of links: all of them, for how fast two links come near each other is found for each pair.
    fn add_link_pairs(
        &mut self,
        pairs: &[[usize; 2]],
        threshold: f64,
        term: &Induced,
        scene: &'a Scene,
    ) -> Result<()> {
        let bounds = scene.bounds();
        let mut near: Vec<([usize; 2], f64)> = Vec::new();
        for &[r, s] in pairs {
            let [lower, _] = bounds[r].distance(&bounds[s]);
            let bound = lower - term.options.margin;
            // The distance of two bodies changes no faster than both move in the world.
            let speed = self.speed_of_link(scene, r) + self.speed_of_link(scene, s);
            if self.may_meet(bound, threshold, speed) {
                near.push(([s, r], bound));
            }
        }
        // Those that the same link carries come together, for their rates.
        near.sort_unstable_by_key(|(links, _)| *links);
        for ([s, r], bound) in near {
            let [Some(a), Some(b)] = [r, s].map(|link| scene.link(link)) else {
                continue;
            };
            let target = Target {
                options: term.options,
                bound,
                ..scene.link_pair([r, s], [a, b])
            };
            self.add_pair(&target, threshold, term, scene)?;
        }
        Ok(())
    }

    fn add_pair(
        &mut self,
        target: &Target<'a>,
        threshold: f64,
        term: &Induced,
        scene: &'a Scene,
    ) -> Result<()> {
        // Where bodies may differ from what they stand for, that two meet is never proved.
        if self.complement && target.stated_deviation() > 0.0 {
            return Ok(());
        }
        let (r_link, s_link) = target.links();
        let [on_r, on_s] = target.sides;
        let a = carried(scene, r_link, on_r);
        let b = match s_link {
            None => Carried {
                body: on_s.0,
                link: None,
                pose: Some(on_s.1),
                number: 0,
            },
            Some(link) => {
                let held = carried(scene, link, on_s);
                Carried {
                    body: held.body,
                    link: Some(link),
                    pose: held.pose,
                    number: held.number,
                }
            }
        };
        let limit = threshold + target.options.margin;
        let leaf = self.leaves.len() as u32;
        let line = &self.way.line;
        let speed = || line.rate(scene, target);
        let pair = MovingPair::new(a, b, limit, leaf, &mut self.rates, speed);
        let mut pair = pair.ok_or_else(|| unstated_speeds(term))?;
        if let Some(start) = self.start {
            pair.followed_from = start.pair_followed_from(term, target);
        }
        if pair.followed_from >= 1.0 || !self.may_meet(target.bound, threshold, pair.speed()) {
            return Ok(());
        }
        if self.is_plain {
            // What rests has no contact on the way that it has not at the start.
            self.needs_start |= pair.rests() || pair.has_solid();
            if pair.rests() {
                return Ok(());
            }
        }
        self.pairs.push(pair);
        Ok(())
    }
}

/// A bound in order of size.
#[derive(Clone, Copy, PartialEq)]
struct OrderedBound(f64);

impl Eq for OrderedBound {}

impl PartialOrd for OrderedBound {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for OrderedBound {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl Gathering<'_> {
    /// The pairs of a body among objects that rest, which stand together.
    pub fn crowds(&self, scene: &Scene, memory: &mut CrowdMemory) -> Vec<Crowd> {
        let mut crowds = Vec::new();
        memory.at_rest.start();
        let mut first = 0;
        for run in self.pairs.chunk_by(MovingPair::is_in_crowd_of) {
            if run.len() > 1 {
                let origin = scene.poses()[run[0].link()].translation;
                crowds.push(Crowd::new(first, run, origin, memory));
            }
            first += run.len() as u32;
        }
        crowds
    }

    /// Whether a pair whose distance less margin at the middle has this lower bound may come within the threshold at any other time.
    fn may_meet(&self, bound: f64, threshold: f64, speed: f64) -> bool {
        STEP_FRACTION * (bound - threshold) <= self.share() * speed
    }

    /// The largest part of a motion that lies between the middle and any other time.
    fn share(&self) -> f64 {
        match self.way.kind {
            WayKind::Line => 0.5,
            WayKind::Curve { .. } | WayKind::Stated(_) | WayKind::Box { .. } => 1.0,
        }
    }

    /// Bounds the change of the distance of any pair of an induced set in the whole time.
    fn fastest(&mut self, term: &Induced, scene: &Scene) -> f64 {
        if let BodyPairs::Objects { links, objects, .. } = &term.pairs {
            let environment = objects.environment().serial();
            if scene.held_of(environment).next().is_none() {
                let speeds = links.iter().map(|&link| self.speed_of_link(scene, link));
                return speeds.fold(0.0, f64::max);
            }
        }
        self.way.line.fastest_pair(term).unwrap_or(0.0)
    }

    /// Bounds the speed of a link's own body in the world; 0 where it has none.
    fn speed_of_link(&mut self, scene: &Scene, link: usize) -> f64 {
        self.speeds.resize(scene.poses().len(), None);
        if let Some(speed) = self.speeds[link] {
            return speed;
        }
        let speed = scene.link(link).map_or(0.0, |(body, pose)| {
            let known = self
                .rates
                .speed_in_world(&carried(scene, link, (body, pose)));
            known.unwrap_or_else(|| {
                let LinearMotion { q, v, cobject, .. } = self.way.line;
                cobject.space().motion_bound(link, q, v)
            })
        });
        self.speeds[link] = Some(speed);
        speed
    }

    /// Bounds the change of a pair's distance in the whole time.
    fn speed(&mut self, scene: &Scene, target: &Target) -> f64 {
        let (r_link, s_link) = target.links();
        let (_, r_object, _) = target.parties();
        if s_link.is_some() || r_object != 0 {
            return self.way.line.rate(scene, target);
        }
        self.speed_of_link(scene, r_link)
    }
}

/// A body of the scene that a link carries: its own, or an object that is attached to it.
fn carried<'a>(scene: &'a Scene, link: usize, (body, pose): Placement<'a>) -> Carried<'a, usize> {
    let mut carried = Carried {
        body,
        link,
        pose: None,
        number: link,
    };
    if !ptr::eq(pose, &scene.poses()[link]) {
        let held = scene.held();
        let place = held.iter().position(|held| ptr::eq(&held.pose, pose));
        let place = place.expect("a pose of the scene");
        carried.pose = Some(&held[place].object.pose);
        carried.number = scene.poses().len() + place;
    }
    carried
}
