//! Makes free neighbourhoods from clearances: lower bounds of distances at one configuration, less what is asked for, over how far
//! each coordinate moves what they are between.

use std::collections::BTreeMap;

use super::answer::SSide;
use super::body_pairs::CheckedGroup;
use super::candidates::CandidateFilter;
use super::context::QueryContext;
use super::neighbourhood_table::{CellCoordinate, Neighbourhood};
use super::neighbourhoods::{FreePairs, GroupKey, GroupMemory, Subject, SubjectMemory};
use super::scene::Scene;
use super::target::{Placement, Target};
use crate::cobject::{BodyPairs, Induced};
use crate::error::Result;
use crate::pair::{Clearance, traverse};
use crate::robot::{CarriedBall, Coordinate};

/// The most pairs of nodes that one making may look at.
const MAX_WORK: u64 = 4096;

/// A clearance of more than this part of the robot's extent is as good as any: more would be measured among more objects.
const FARTHEST: f64 = 0.3;

/// A bound by the bodies' balls of more than this part of the farthest is taken for the clearance.
const ENOUGH: f64 = 0.3;

/// A coordinate crosses a cell of the largest size by moving a subject by this part of the farthest.
const CELL: f64 = 0.5;

/// What the neighbourhoods of one union may take, in bytes; what finds them takes at most 64 KB more for each subject.
const MAX_BYTES: usize = 1 << 24;

/// Of more subjects nothing is remembered.
const MAX_SUBJECTS: usize = 192;

/// What a draft takes beside its measurements, in pairs of nodes.
const DRAFT_WORK: f64 = 24.0;

/// A unit quaternion's entry may be off by this at both configurations together, since a norm may be off by
/// [`crate::tolerance::ROTATION`].
const QUATERNION_ERROR: f64 = 2.1 * crate::tolerance::ROTATION;

/// What is kept of a clearance for the rounding of kinematics and distances, times the size of the pair. It is far more than what
/// they take, so that a query that looks for itself answers the same.
const RESERVE: f64 = 1e-9;

/// How fast coordinates move something: of each in a list, a length per unit.
type Arms = Vec<f64>;

/// The neighbourhood of one subject in the making.
struct Draft {
    subject: Subject,
    /// What was taken to measure it, in pairs of nodes.
    work: u64,
    coordinates: Vec<usize>,
    /// Of what the link carries, in the world.
    arms: Arms,
    /// The least clearance from what rests in the world.
    world: f64,
    found: Neighbourhood,
    is_free: bool,
}

impl Draft {
    /// Whether a body pair belongs to the subject.
    fn is_of(&self, target: &Target) -> bool {
        match (self.subject, target.parties()) {
            (Subject::Pair { links, .. }, (r, 0, SSide::Link(s))) => links == [r, s],
            (Subject::Pair { .. }, _) | (_, (_, _, SSide::Link(_))) => false,
            (Subject::Link(link), (r, ..)) => last([Some(r), target.s_carrier]) == link,
        }
    }

    /// A body pair of the subject is this far apart, beyond what is asked.
    fn keep_clear(&mut self, scene: &Scene, target: &Target, clearance: f64) {
        let is_clear = clearance > 0.0;
        if !is_clear {
            self.is_free = false;
        } else if target.links().1.is_none() {
            self.world = self.world.min(clearance);
        } else {
            let arms = pair_arms(scene, target, &self.coordinates);
            self.limit(scene, &arms, clearance);
        }
    }

    /// No pair comes near as long as the sum of the arms times the changes is less than the clearance.
    fn limit(&mut self, scene: &Scene, arms: &Arms, clearance: f64) {
        let coordinates = scene.space().coordinates();
        let quaternions = self.coordinates.iter().zip(arms);
        let quaternions = quaternions.filter(|(c, _)| coordinates[**c] == Coordinate::Quaternion);
        let doubt: f64 = quaternions.map(|(_, arm)| QUATERNION_ERROR * arm).sum();
        let clearance = clearance - doubt;
        let is_clear = clearance > 0.0;
        if !is_clear {
            self.is_free = false;
            return;
        }
        for (inverse, arm) in self.found.inverse_radii.iter_mut().zip(arms) {
            *inverse = inverse.max(arm / clearance);
        }
    }
}

/// The ball around a body.
fn ball((body, pose): Placement) -> CarriedBall {
    CarriedBall {
        center: pose.transform_point(body.center()),
        radius: body.radius(),
    }
}

/// Two links, as the second sees the first: `None` is the world.
pub(super) type Carriers = [Option<usize>; 2];

/// The arms of a ball on the first of two links in a list of coordinates, added to others.
fn add_arms(
    scene: &Scene,
    carriers: Carriers,
    ball: &CarriedBall,
    list: &[usize],
    arms: &mut Arms,
) {
    let poses = scene.poses();
    scene
        .space()
        .visit_lever_arms(poses, carriers, ball, |coordinate, arm| {
            if let Ok(place) = list.binary_search(&coordinate) {
                arms[place] += arm;
            }
        });
}

/// The bodies that a link carries: its own, and the attached objects of an environment.
fn carried<'s>(
    scene: &'s Scene,
    link: usize,
    environment: Option<u64>,
) -> impl Iterator<Item = Placement<'s>> {
    let held = environment.into_iter().flat_map(|e| scene.held_of(e));
    let held = held.filter(move |(_, held)| held.attachment.link == link);
    let held = held.map(|(_, held)| (&*held.object.body, &held.pose));
    scene.link(link).into_iter().chain(held)
}

/// The largest arms of the bodies that a link carries.
fn largest_arms(
    scene: &Scene,
    carriers: Carriers,
    environment: Option<u64>,
    list: &[usize],
) -> Arms {
    let mut largest = vec![0.0f64; list.len()];
    let link = carriers[0].into_iter();
    for placement in link.flat_map(|link| carried(scene, link, environment)) {
        let mut arms = vec![0.0; list.len()];
        add_arms(scene, carriers, &ball(placement), list, &mut arms);
        for (most, arm) in largest.iter_mut().zip(arms) {
            *most = most.max(arm);
        }
    }
    largest
}

/// The environment of a term, by its serial.
fn environment_of(term: &Induced) -> Option<u64> {
    Some(term.pairs.environment()?.serial())
}

/// The pairs of moving links whose bodies, or what they hold, a term may ask about, with their subjects; `None` is the world.
fn carriers_of(scene: &Scene, group: CheckedGroup, term: &Induced) -> Vec<(Subject, Carriers)> {
    match &term.pairs {
        BodyPairs::Links { pairs } => {
            let first = first_pair(group, term);
            let of_pair = |(number, &links): (usize, &[usize; 2])| {
                (Subject::Pair { number, links }, links.map(Some))
            };
            (first..).zip(pairs).map(of_pair).collect()
        }
        BodyPairs::Objects { links, objects, .. } => {
            let environment = objects.environment().serial();
            let holders = || scene.held_of(environment).map(|(_, h)| h.attachment.link);
            let moving = |&link: &usize| {
                scene.link(link).is_some() || holders().any(|holder| holder == link)
            };
            let links = links.iter().copied().filter(moving);
            let of_link = |link: usize| {
                let others = holders().filter(move |&holder| holder != link).map(Some);
                let others = std::iter::once(None).chain(others);
                others.map(move |other| {
                    let carriers = [Some(link), other];
                    (Subject::Link(last(carriers)), carriers)
                })
            };
            links.flat_map(of_link).collect()
        }
    }
}

/// The number of a term's first pair of links in its group.
fn first_pair(group: CheckedGroup, term: &Induced) -> usize {
    let before = group
        .iter()
        .take_while(|other| !std::ptr::eq(&***other, term));
    let count = |term: &Induced| match &term.pairs {
        BodyPairs::Links { pairs } => pairs.len(),
        BodyPairs::Objects { .. } => 0,
    };
    before.map(|term| count(term)).sum()
}

/// The link that a pair is remembered with: the last one.
fn last(carriers: Carriers) -> usize {
    carriers.into_iter().flatten().max().unwrap_or(0)
}

impl QueryContext {
    /// Adds the pairs' work since `before` to what making neighbourhoods may take, and makes some around a configuration whose
    /// links are not known to be free, if it may.
    pub(super) fn learn(
        &mut self,
        scene: &Scene,
        group: CheckedGroup,
        threshold: f64,
        free: FreePairs,
        before: u64,
    ) -> Result<()> {
        if !self.neighbourhoods.is_on || scene.state().is_none() {
            return Ok(());
        }
        let work = self.work_done() - before;
        if !self.neighbourhoods.has_credit(work) {
            return Ok(());
        }
        let key = GroupKey::new(scene.world(), &group, threshold);
        let make = || new_memory(scene, group, key.clone());
        let memory = self.neighbourhoods.memory_of(&key, make);
        let farthest = memory.farthest;
        let q = scene.state().map_or(&[][..], |state| state.q);
        let free = FreePairs {
            tried_all: free.tried_all || memory.is_empty(),
            ..free
        };
        let wanted = memory.subjects.iter();
        let wanted = wanted.filter(|subject| subject.is_wanted(q, free));
        let mut drafts: Vec<Draft> = wanted.map(|subject| draft(q, subject)).collect();
        let is_wanted = |subject: Subject| drafts.iter().any(|draft| draft.subject == subject);
        let carriers = memory.carriers.iter();
        let carriers = carriers.filter(|(subject, ..)| is_wanted(*subject));
        let carriers: Vec<_> = carriers.copied().collect();
        if drafts.is_empty() || farthest <= 0.0 {
            return Ok(());
        }
        let before = self.work_done();
        let left = self.scratch.meter_mut().begin_apart(MAX_WORK);
        let limits = [threshold, farthest];
        let measured = self.measure_clearances(scene, group, limits, &carriers, &mut drafts);
        self.scratch.meter_mut().end_apart(left);
        let spent = (self.work_done() - before) as f64 + DRAFT_WORK * (4 + drafts.len()) as f64;
        self.neighbourhoods.spend(spent);
        // Without an answer within the work that making may take there is nothing to keep.
        if measured.is_err() {
            return Ok(());
        }
        let mut made = 0;
        let memory = self
            .neighbourhoods
            .memory_of(&key, || unreachable!("it was made above"));
        for draft in drafts {
            let Some(subject) = memory.find(draft.subject) else {
                continue;
            };
            let work = 0.5 * draft.work as f64;
            let is_first = subject.table.is_empty();
            subject.value += (work - subject.value) * if is_first { 1.0 } else { 0.125 };
            made += u64::from(draft.is_free && subject.table.insert(&draft.found));
        }
        self.neighbourhoods.counts.made += made;
        Ok(())
    }

    /// The work done so far, in pairs of nodes: a pair of primitives takes about as long as four.
    pub(super) fn work_done(&self) -> u64 {
        let done = &self.scratch.meter().done;
        done.node_pairs + 4 * done.primitive_pairs
    }

    fn measure_clearances(
        &mut self,
        scene: &Scene,
        group: CheckedGroup,
        [threshold, farthest]: [f64; 2],
        carriers: &[(Subject, Option<u64>, Carriers)],
        drafts: &mut [Draft],
    ) -> Result<()> {
        let mut wanted = FreePairs::default();
        drafts.iter().for_each(|draft| wanted.add(draft.subject));
        let filter = CandidateFilter {
            free: FreePairs {
                links: !wanted.links,
                pairs: !wanted.pairs,
                ..FreePairs::default()
            },
            ..CandidateFilter::within(farthest)
        };
        let targets = self.candidates(scene, group, filter)?;
        let measured = targets.iter().try_for_each(|target| {
            let own = drafts
                .iter_mut()
                .filter(|draft| draft.is_free && draft.is_of(target));
            for draft in own {
                let before = self.work_done();
                self.measure_clearance(scene, target, threshold, farthest, draft)?;
                draft.work += self.work_done() - before;
            }
            Ok(())
        });
        self.keep_memory(targets);
        measured?;
        let asked = |term: &Induced| match threshold {
            0.0 => term.options.contact_epsilon,
            _ => threshold,
        };
        let most = group.iter().map(|term| asked(term)).fold(0.0, f64::max);
        finish(scene, carriers, farthest - most, drafts);
        Ok(())
    }

    /// Bounds one pair's distance from below.
    fn measure_clearance(
        &mut self,
        scene: &Scene,
        target: &Target,
        threshold: f64,
        farthest: f64,
        draft: &mut Draft,
    ) -> Result<()> {
        let (_, s_link) = target.links();
        let asked = match threshold {
            0.0 => target.options.contact_epsilon,
            _ => threshold,
        };
        let most = match s_link {
            None => farthest.min(draft.world + asked),
            Some(_) => farthest,
        };
        if target.bound > most {
            return Ok(());
        }
        // The caller's functions are called for answers alone.
        if target.sides.iter().any(|(body, _)| body.has_functions()) {
            draft.is_free = false;
            return Ok(());
        }
        self.count_body_pair()?;
        let pairing = target.pairing();
        let bound = target
            .bound
            .max(pairing.sphere_bound() - target.options.margin);
        if bound > most {
            return Ok(());
        }
        let size = pairing.precision.size + pairing.frame.translation.norm();
        let reserve = asked + 4.0 * pairing.slack() + RESERVE * size;
        if bound > ENOUGH * farthest {
            draft.keep_clear(scene, target, bound - reserve);
            return Ok(());
        }
        if pairing.has_solid() && pairing.is_one_inside(&mut self.scratch) {
            draft.is_free = false;
            return Ok(());
        }
        let mut visitor = Clearance::up_to(most, target.options.margin);
        let first = self.remembered(&target.key);
        let _ = traverse(&pairing, first, &mut self.scratch, &mut visitor);
        self.scratch.meter().check()?;
        draft.keep_clear(scene, target, visitor.clearance() - reserve);
        Ok(())
    }
}

/// How fast coordinates change a pair's distance.
fn pair_arms(scene: &Scene, target: &Target, list: &[usize]) -> Arms {
    let (r, s) = target.links();
    let mut arms = vec![0.0; list.len()];
    let [on_r, on_s] = target.sides.map(ball);
    add_arms(scene, [Some(r), s], &on_r, list, &mut arms);
    add_arms(scene, [s, Some(r)], &on_s, list, &mut arms);
    arms
}

fn draft(q: &[f64], memory: &SubjectMemory) -> Draft {
    let all = memory.table.coordinates.iter();
    let coordinates: Vec<usize> = all.map(|coordinate| coordinate.index).collect();
    Draft {
        subject: memory.subject,
        work: 0,
        arms: vec![0.0; coordinates.len()],
        world: f64::INFINITY,
        found: Neighbourhood {
            center: coordinates.iter().map(|&c| q[c]).collect(),
            inverse_radii: vec![0.0; coordinates.len()],
        },
        coordinates,
        is_free: true,
    }
}

/// Adds what was not listed, all of which is farther away than `farthest`, and what rests in the world.
fn finish(
    scene: &Scene,
    carriers: &[(Subject, Option<u64>, Carriers)],
    farthest: f64,
    drafts: &mut [Draft],
) {
    let extent = scene.poses().iter().map(|pose| pose.translation.norm());
    let beyond = farthest - RESERVE * extent.fold(farthest, f64::max);
    for &(subject, environment, [a, b]) in carriers {
        let mut own = drafts.iter_mut();
        let Some(draft) = own.find(|draft| draft.is_free && draft.subject == subject) else {
            continue;
        };
        let list = &draft.coordinates;
        let mut arms = largest_arms(scene, [a, b], environment, list);
        if b.is_none() {
            for (most, arm) in draft.arms.iter_mut().zip(&arms) {
                *most = most.max(*arm);
            }
        } else {
            let others = largest_arms(scene, [b, a], environment, list);
            for (arm, other) in arms.iter_mut().zip(others) {
                *arm += other;
            }
        }
        draft.limit(scene, &arms, beyond);
    }
    for draft in drafts
        .iter_mut()
        .filter(|draft| draft.world < f64::INFINITY)
    {
        let arms = std::mem::take(&mut draft.arms);
        draft.limit(scene, &arms, draft.world);
    }
}

/// A memory without neighbourhoods: what has pairs, and the coordinates that move these.
fn new_memory(scene: &Scene, group: CheckedGroup, key: GroupKey) -> GroupMemory {
    // Of each subject the arms of coordinates; `None` behind a custom joint.
    let mut subjects = BTreeMap::<Subject, Option<BTreeMap<usize, f64>>>::new();
    let (space, mut carriers) = (scene.space(), Vec::new());
    for term in group.iter() {
        let environment = environment_of(term);
        for (subject, [a, b]) in carriers_of(scene, group, term) {
            carriers.push((subject, environment, [a, b]));
            let arms = subjects.entry(subject).or_insert(Some(BTreeMap::new()));
            for [link, other] in [[a, b], [b, a]] {
                for placement in link
                    .into_iter()
                    .flat_map(|l| carried(scene, l, environment))
                {
                    let ball = ball(placement);
                    let visit = |coordinate, arm: f64| {
                        if let Some(arms) = arms {
                            let known = arms.entry(coordinate).or_insert(0.0f64);
                            *known = known.max(arm);
                        }
                    };
                    if !space.visit_lever_arms(scene.poses(), [link, other], &ball, visit) {
                        *arms = None;
                    }
                }
            }
        }
    }
    let extent = subjects.values().flatten().flat_map(|arms| arms.values());
    let farthest = FARTHEST * extent.copied().fold(0.0, f64::max);
    let max_bytes = MAX_BYTES / subjects.len().max(1);
    let of_subject =
        |(number, (subject, arms)): (usize, (Subject, Option<BTreeMap<usize, f64>>))| {
            let arms = arms.filter(|_| number < MAX_SUBJECTS);
            let coordinate = |(index, arm): (usize, f64)| CellCoordinate {
                index,
                cells_per_unit: arm / (CELL * farthest),
            };
            let cells = arms.map(|arms| arms.into_iter().map(coordinate).collect());
            SubjectMemory::new(subject, cells, max_bytes)
        };
    let subjects = subjects.into_iter().enumerate();
    let subjects = subjects.map(of_subject).collect();
    GroupMemory::new(key, subjects, carriers, farthest)
}
