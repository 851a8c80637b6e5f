//! What a proof looks at: the leaves of a set, the body pairs that the motion may bring near, and the crowds that pairs make.

use std::cmp::Ordering;
use std::ptr;

use super::balls::Balls;
use super::carried::Carried;
use super::crowd::{Crowd, CrowdMemory};
use super::kinematics::Kinematics;
use super::linear_motion::{LinearMotion, STEP_FRACTION, extent};
use super::moving_pair::MovingPair;
use super::moving_pure::MovingPure;
use super::moving_set::MovingLeaf;
use super::pair_rates::PairRates;
use super::set_tree::{LeafContent, SetLeaf, SetTree};
use super::span::Span;
use super::start_contacts::StartContacts;
use super::way::{Way, WayKind};
use crate::cobject::{BodyPairs, ClearPairs, Induced, LinksAndObjects, PureSet, PureShape};
use crate::error::{Error, ErrorKind, Result};
use crate::query::{CandidateFilter, Group, ListOrder, Placement, QueryContext, Scene, Target};
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
    /// [`Way::rounding`] of it.
    rounding: Vec<f64>,
    rates: PairRates<'a>,
    middle: Option<&'k mut Kinematics<'a>>,
    threshold: f64,
    keeps: Keeps,
    is_plain: bool,
    /// Whether the leaf that is added stands for the complement.
    complement: bool,
    pub leaves: Vec<MovingLeaf>,
    pub pairs: Vec<MovingPair<'a>>,
    /// The proof does not see whether the start is free: pairs that rest, and bodies inside others.
    pub needs_start: bool,
    /// How far links' bodies go from where they are at the middle, where that was asked for.
    shifts: Vec<Option<f64>>,
    /// Of a motion that is known not to begin inside: what touches at its start.
    pub start: Option<&'a StartContacts>,
}

impl<'a, 'k> Gathering<'a, 'k> {
    /// On an interval of time; `middle` are the kinematics at its middle. Without them in a box of configurations.
    pub fn new(
        way: &'a Way<'a>,
        motions: &'a LinkMotions,
        threshold: f64,
        tree: &SetTree,
        keeps: Keeps,
        middle: Option<&'k mut Kinematics<'a>>,
    ) -> Self {
        Self {
            way,
            rounding: way.rounding(),
            rates: PairRates::new(motions),
            middle,
            threshold,
            keeps,
            is_plain: tree.is_plain_union(),
            complement: false,
            leaves: Vec::with_capacity(tree.leaves.len()),
            pairs: Vec::new(),
            needs_start: false,
            shifts: Vec::new(),
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
            LeafContent::Pure(set) => self.pure(set, scene)?,
            LeafContent::Known(sets) => MovingLeaf::Known {
                sets: sets.clone(),
                complement,
            },
            // The distance from the complement of an induced set is 0 or unknown.
            LeafContent::Induced(_) if complement && self.threshold > 0.0 => MovingLeaf::Everything,
            LeafContent::Induced(group) => {
                for term in 0..group.len() {
                    self.add_pairs(&group[term..=term], scene, context)?;
                }
                MovingLeaf::Pairs { complement }
            }
        };
        self.leaves.push(moving);
        Ok(())
    }

    fn pure(&mut self, set: &PureSet, scene: &Scene) -> Result<MovingLeaf> {
        let (way, complement) = (self.way, self.complement);
        let places = &mut |link| self.rates.rounding_of_link(link, scene.poses());
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
    fn add_pairs(
        &mut self,
        term: &'a Group,
        scene: &'a Scene,
        context: &mut QueryContext,
    ) -> Result<()> {
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
            return self.add_link_pairs(pairs, clear.as_deref(), threshold, &term[0], scene);
        }
        let farthest = self.farthest(&term[0], scene);
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
            let shift = self.shift(scene, target);
            if may_meet(target.bound, threshold, shift) {
                let (link, object, _) = target.ids();
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
        clear: Option<&ClearPairs>,
        threshold: f64,
        term: &Induced,
        scene: &'a Scene,
    ) -> Result<()> {
        let clear = clear.filter(|_| threshold <= term.options.contact_epsilon);
        let mut near: Vec<([usize; 2], f64)> = Vec::new();
        for &[r, s] in pairs {
            let limit = threshold + term.options.margin;
            if self.links_stay_apart([r, s], limit, scene) {
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
            let shift = self.shift_of_link(scene, r) + self.shift_of_link(scene, s);
            if may_meet(bound, threshold, shift) {
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

    /// Whether the balls around two links' bodies stay apart the whole time. How both move in the world says so of most pairs, before
    /// any pair has rates of its own.
    fn links_stay_apart(&mut self, links: [usize; 2], limit: f64, scene: &'a Scene) -> bool {
        let Some(middle) = &mut self.middle else {
            return false;
        };
        let [Some(a), Some(b)] = links.map(|link| Some(carried(scene, link, scene.link(link)?)))
        else {
            return false;
        };
        let [Some(of_a), Some(of_b)] = [&a, &b].map(|body| self.rates.of_body(body)) else {
            return false;
        };
        let bodies = [a.body, b.body];
        let stated_deviation = a.body.stated_deviation() + b.body.stated_deviation();
        let balls = Balls {
            bodies,
            threshold: limit + stated_deviation,
        };
        let error = [(&a, &of_a), (&b, &of_b)]
            .map(|(body, rates)| rates.rounding.of_places(body.body.radius(), 0.5));
        let bounds = [1, 2].map(|k| of_a.origin[k] + of_b.origin[k]);
        let center = middle.center_from_center(&a, &b);
        balls.stay_apart_over(&center, bounds, Span::Around(0.5), error[0] + error[1])
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
        let speed = || {
            let off_the_way = LinearMotion {
                v: &self.rounding,
                ..*line
            };
            [line.rate(scene, target), off_the_way.rate(scene, target)]
        };
        let pair = MovingPair::new(a, b, limit, leaf, &mut self.rates, speed);
        let mut pair = pair.ok_or_else(|| unstated_speeds(self.way, term))?;
        if let Some(start) = self.start {
            pair.followed_from = start.pair_followed_from(term, target);
        }
        let shift = self.share() * pair.speed() + pair.rounding_all_the_while();
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

    /// The largest part of a motion that lies between the middle and any other time.
    fn share(&self) -> f64 {
        match self.way.kind {
            WayKind::Line | WayKind::Curve { .. } | WayKind::Stated(_) => 0.5,
            WayKind::Box { .. } => 1.0,
        }
    }

    /// Bounds the change of the distance of any pair of an induced set, from the middle to any other time.
    fn farthest(&mut self, term: &Induced, scene: &'a Scene) -> f64 {
        if let BodyPairs::Objects(LinksAndObjects { links, objects, .. }) = &term.pairs {
            let environment = objects.environment().serial();
            if scene.held_of(environment).next().is_none() {
                let shifts = links.iter().map(|&link| self.shift_of_link(scene, link));
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
        let roundings = links.map(|link| self.rounding_of_link(scene, link, largest));
        let rounding = roundings.fold(0.0, f64::max);
        // Both bodies of a pair may be carried.
        self.share() * fastest + 2.0 * rounding
    }

    /// What rounding may move a body that a link carries, at the middle and at any other time together; no point of the body is farther
    /// than `radius` from the link's origin.
    fn rounding_of_link(&mut self, scene: &Scene, link: usize, radius: f64) -> f64 {
        let rounding = self.rates.rounding_of_link(link, scene.poses());
        let LinearMotion { q, cobject, .. } = self.way.line;
        let of_coordinates =
            cobject
                .space()
                .motion_bound_of_radius(link, radius, q, &self.rounding);
        rounding.of_places(radius, self.share()) + of_coordinates
    }

    /// Bounds how far a link's own body goes in the world from where it is at the middle; 0 where it has none.
    fn shift_of_link(&mut self, scene: &'a Scene, link: usize) -> f64 {
        self.shifts.resize(scene.poses().len(), None);
        if let Some(shift) = self.shifts[link] {
            return shift;
        }
        let shift = scene.link(link).map_or(0.0, |placement| {
            let body = carried(scene, link, placement);
            self.shift_of_body(&body).unwrap_or_else(|| {
                let LinearMotion { q, v, cobject, .. } = self.way.line;
                let moved = self.share() * cobject.space().motion_bound(link, q, v);
                moved + self.rounding_of_link(scene, link, body.body.radius_from_origin())
            })
        });
        self.shifts[link] = Some(shift);
        shift
    }

    /// The same; `None` where a custom joint moves the body, or bounds overflow.
    fn shift_of_body(&mut self, body: &Carried<'a, usize>) -> Option<f64> {
        let rates = self.rates.of_body(body)?;
        let radius = body.body.radius();
        let rounding = rates.rounding.of_places(radius, self.share());
        let by_speed = self.share() * (rates.turn[0] * radius + rates.origin[0]);
        let shift = match &mut self.middle {
            None => by_speed,
            Some(middle) => by_speed.min(middle.shift(body, &rates, Span::Around(0.5))),
        };
        Some(shift + rounding).filter(|shift| !shift.is_nan())
    }

    /// Bounds the change of a pair's distance from the middle to any other time.
    fn shift(&mut self, scene: &'a Scene, target: &Target) -> f64 {
        let (r_link, s_link) = target.links();
        let (_, r_object, _) = target.ids();
        if s_link.is_some() || r_object != 0 {
            let links = [Some(r_link), s_link];
            let roundings = links
                .into_iter()
                .zip(target.sides)
                .filter_map(|(link, placed)| {
                    let link = link?;
                    Some(self.rounding_of_link(scene, link, extent(scene, link, placed)))
                });
            return roundings.sum::<f64>() + self.share() * self.way.line.rate(scene, target);
        }
        self.shift_of_link(scene, r_link)
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
