//! What a proof looks at: the leaves of a set, the body pairs that the motion may bring near, and the crowds that pairs make.

use std::cmp::Ordering;
use std::ptr;

use super::carried::Carried;
use super::crowd::{Crowd, CrowdMemory};
use super::linear_motion::{LinearMotion, STEP_FRACTION};
use super::links_on_way::LinksOnWay;
use super::moving_pair::MovingPair;
use super::moving_pure::MovingPure;
use super::moving_set::MovingLeaf;
use super::set_tree::{LeafContent, SetLeaf, SetTree};
use super::start_contacts::StartContacts;
use super::way::Way;
use crate::cobject::{BodyPairs, ClearPairs, Induced, LinksAndObjects, PureSet, PureShape};
use crate::error::{Error, ErrorKind, Result};
use crate::query::{CandidateFilter, Group, ListOrder, Placement, QueryContext, Scene, Target};

/// What is to be proved of a set, whose complements are moved down to the leaves of its tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keeps {
    /// No configuration is inside the tree's set: a leaf must not be inside, a complement must be inside or in contact.
    Out,
    /// Every configuration is inside the set whose complement the tree stands for: a leaf must be outside and not in contact, a
    /// complement inside.
    In,
}

fn unstated_speeds(way: &Way, term: &Induced) -> Error {
    way.line.without_speed(Error::new(
        ErrorKind::Unsupported,
        format!(
            "C-object {}: a custom joint that does not state its speeds moves on the way",
            term.leaf.serial
        ),
    ))
}

/// Gathers the leaves of a set on a motion, and the pairs that the motion may bring near.
pub(super) struct Gathering<'a, 'k> {
    way: &'a Way<'a>,
    /// At the middle.
    scene: &'a Scene<'a>,
    pub links: LinksOnWay<'a, 'k>,
    threshold: f64,
    keeps: Keeps,
    is_plain: bool,
    /// Whether the leaf that is added stands for the complement.
    complement: bool,
    pub leaves: Vec<MovingLeaf>,
    pub pairs: Vec<MovingPair<'a>>,
    /// The proof does not see whether the start is free: pairs that rest, and bodies inside others.
    pub needs_start: bool,
    /// Of a motion that is known not to begin inside: what touches at its start.
    pub start: Option<&'a StartContacts>,
}

impl<'a, 'k> Gathering<'a, 'k> {
    /// On the way that the links are looked at on, whose middle the scene is at.
    pub fn new(
        way: &'a Way<'a>,
        scene: &'a Scene<'a>,
        links: LinksOnWay<'a, 'k>,
        threshold: f64,
        tree: &SetTree,
        keeps: Keeps,
    ) -> Self {
        Self {
            way,
            scene,
            links,
            threshold,
            keeps,
            is_plain: tree.is_plain_union(),
            complement: false,
            leaves: Vec::with_capacity(tree.leaves.len()),
            pairs: Vec::new(),
            needs_start: false,
            start: None,
        }
    }

    /// Adds a leaf of the tree; in the order of the tree's leaves.
    pub fn add(&mut self, leaf: &SetLeaf<'a>, context: &mut QueryContext) -> Result<()> {
        let complement = leaf.complement;
        self.complement = complement;
        let moving = match leaf.content {
            LeafContent::Pure(set) => self.pure(set)?,
            LeafContent::Known(sets) => MovingLeaf::Known {
                sets: sets.clone(),
                complement,
            },
            // The distance from the complement of an induced set is 0 or unknown.
            LeafContent::Induced(_) if complement && self.threshold > 0.0 => MovingLeaf::Everything,
            LeafContent::Induced(group) => {
                for term in 0..group.len() {
                    self.add_pairs(&group[term..=term], context)?;
                }
                MovingLeaf::Pairs { complement }
            }
        };
        self.leaves.push(moving);
        Ok(())
    }

    fn pure(&mut self, set: &PureSet) -> Result<MovingLeaf> {
        let (way, complement) = (self.way, self.complement);
        let speeds = &self.links.rates.speeds;
        let places = &mut |link| speeds.rounding(link, self.scene.poses());
        let is_predicate = matches!(set.shape, PureShape::Predicate(_));
        if let Some(start) = self.start {
            return Ok(MovingLeaf::Pure(MovingPure::after_start(
                way, places, set, start,
            )?));
        }
        Ok(match (self.keeps, complement) {
            (Keeps::Out, _) => MovingLeaf::Pure(MovingPure::new(
                way,
                places,
                set,
                complement,
                self.threshold,
            )?),
            // Where a predicate is in contact it is not outside, however far away that is.
            (Keeps::In, false) if is_predicate => MovingLeaf::Everything,
            (Keeps::In, false) => {
                MovingLeaf::Pure(MovingPure::new(way, places, set, false, set.epsilon())?)
            }
            (Keeps::In, true) => {
                let mut without_contact = set.clone();
                without_contact.options.contact_epsilon = 0.0;
                MovingLeaf::Pure(MovingPure::new(way, places, &without_contact, true, 0.0)?)
            }
        })
    }

    /// Adds the pairs of one induced set. Its outside begins where distances exceed the contact epsilon.
    fn add_pairs(&mut self, term: &'a Group, context: &mut QueryContext) -> Result<()> {
        let scene = self.scene;
        let is_outside_meant = self.complement != (self.keeps == Keeps::In);
        let threshold = if is_outside_meant {
            term[0].options.contact_epsilon
        } else {
            self.threshold
        };
        if let BodyPairs::Links { pairs, clear, .. } = &term[0].pairs {
            let meter = context.scratch.meter_mut();
            meter.count_nodes(pairs.len() as u64);
            meter.check()?;
            return self.add_link_pairs(pairs, clear.as_deref(), threshold, &term[0]);
        }
        let farthest = self.farthest(&term[0]);
        if farthest.is_infinite() {
            return Err(unstated_speeds(self.way, &term[0]));
        }
        if farthest == 0.0 && self.is_plain {
            self.needs_start = true;
            return Ok(());
        }
        let checked = scene.checked(term)?;
        // No distance at another time is less than that at the middle by more than what the motion changes up to there.
        let wanted = CandidateFilter {
            order: ListOrder::Any,
            ..CandidateFilter::within(threshold + farthest / STEP_FRACTION)
        };
        let meter = context.scratch.meter_mut();
        let found = scene.candidates(checked, wanted, &mut context.candidates, meter)?;
        // Those of one body together, what is near first.
        let mut order: Vec<(usize, u64, OrderedBound, usize)> = Vec::with_capacity(found.len());
        for (place, target) in found.iter().enumerate() {
            if self.may_come_near(target, threshold) {
                let (link, object, _) = target.ids();
                order.push((link, object, OrderedBound(target.bound), place));
            }
        }
        order.sort_unstable();
        for (.., place) in order {
            self.add_pair(&found[place], threshold, &term[0])?;
        }
        context.candidates.keep(found);
        Ok(())
    }

    /// The same of pairs of links: all of them, for how fast two links come near each other is found for each pair.
    fn add_link_pairs(
        &mut self,
        pairs: &[[usize; 2]],
        clear: Option<&ClearPairs>,
        threshold: f64,
        term: &Induced,
    ) -> Result<()> {
        let scene = self.scene;
        let clear = clear.filter(|_| threshold <= term.options.contact_epsilon);
        let mut near: Vec<([usize; 2], f64)> = Vec::new();
        for &[r, s] in pairs {
            let limit = threshold + term.options.margin;
            if self.links.stay_apart([r, s], limit) {
                continue;
            }
            let known = clear.and_then(|pairs| pairs.of([r, s]));
            if known.is_some_and(|cells| self.way.stays_in(cells)) {
                continue;
            }
            let bounds = [r, s].map(|link| scene.bounds_of_link(link));
            let [Some(a), Some(b)] = bounds else {
                continue;
            };
            let [lower, _] = a.distance(&b);
            let bound = lower - term.options.margin;
            // The distance of two bodies changes by no more than both move in the world.
            let mut shift = || self.links.shift(r) + self.links.shift(s);
            if may_meet(bound, threshold, 0.0) || may_meet(bound, threshold, shift()) {
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
            self.add_pair(&target, threshold, term)?;
        }
        Ok(())
    }

    /// Whether the motion may bring a body among s-objects within a distance of one of them.
    fn may_come_near(&mut self, target: &Target, threshold: f64) -> bool {
        let (link, s_link) = target.links();
        let (_, attached, _) = target.ids();
        let links = &mut self.links;
        if s_link.is_some() || attached != 0 {
            return may_meet(target.bound, threshold, links.shift_of_pair(target));
        }
        // Most are near at the middle, or far off by the speeds of joints.
        may_meet(target.bound, threshold, 0.0)
            || may_meet(target.bound, threshold, links.shift_by_speed(link))
                && may_meet(target.bound, threshold, links.shift(link))
    }

    fn add_pair(&mut self, target: &Target<'a>, threshold: f64, term: &Induced) -> Result<()> {
        let scene = self.scene;
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
        let LinksOnWay {
            rates, rounding, ..
        } = &mut self.links;
        let speed = || {
            let off_the_way = LinearMotion {
                v: rounding,
                ..*line
            };
            [line.rate(scene, target), off_the_way.rate(scene, target)]
        };
        let pair = MovingPair::new(a, b, limit, leaf, rates, speed);
        let mut pair = pair.ok_or_else(|| unstated_speeds(self.way, term))?;
        if let Some(start) = self.start {
            pair.followed_from = start.pair_followed_from(term, target);
        }
        let shift = self.links.share() * pair.speed() + pair.rounding_all_the_while();
        if pair.followed_from >= 1.0 || !may_meet(target.bound, threshold, shift) {
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

impl<'a> Gathering<'a, '_> {
    /// The pairs of a body among objects that rest, which stand together.
    pub fn crowds(&self, memory: &mut CrowdMemory) -> Vec<Crowd> {
        let mut crowds = Vec::new();
        memory.at_rest.start();
        let mut first = 0;
        for run in self.pairs.chunk_by(MovingPair::is_in_crowd_of) {
            if run.len() > 1 {
                let origin = self.scene.poses()[run[0].link()].translation;
                crowds.push(Crowd::new(first, run, origin, memory));
            }
            first += run.len() as u32;
        }
        crowds
    }

    /// Bounds the change of the distance of any pair of an induced set, from the middle to any other time.
    fn farthest(&mut self, term: &Induced) -> f64 {
        let scene = self.scene;
        if let BodyPairs::Objects(LinksAndObjects { links, objects, .. }) = &term.pairs {
            let environment = objects.environment().serial();
            if scene.held_of(environment).next().is_none() {
                let shifts = links.iter().map(|&link| self.links.shift_for_search(link));
                return shifts.fold(0.0, f64::max);
            }
        }
        let Some(fastest) = self.way.line.fastest_pair(term) else {
            return 0.0;
        };
        let held = scene.held().iter();
        let held = held.map(|held| {
            held.object.body.radius_from_origin() + held.object.pose.translation.norm()
        });
        let own = (0..scene.poses().len())
            .filter_map(|link| Some(scene.link(link)?.0.radius_from_origin()));
        let largest = own.chain(held).fold(0.0, f64::max);
        let links = 0..scene.poses().len();
        let roundings = links.map(|link| self.links.rounding_of_link(link, largest));
        let rounding = roundings.fold(0.0, f64::max);
        // Both bodies of a pair may be carried.
        self.links.share() * fastest + 2.0 * rounding
    }
}

/// Whether a pair whose distance less margin at the middle has this lower bound may come within the threshold, if the distance changes
/// by no more than `shift` from there. Of what is no number nothing is known.
fn may_meet(bound: f64, threshold: f64, shift: f64) -> bool {
    let is_beyond = STEP_FRACTION * (bound - threshold) > shift;
    !is_beyond
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
