//! Whole motions: a proof that a segment of C-space is free, or its first contact (§2.3.1 asks for it; Figure 1 shows what sampling
//! misses). Nothing is sampled: every answer "free" rests on bounds over intervals that cover the segment.

use std::cmp::Ordering;

use super::crowd::Crowd;
use super::interval_proof::{MovingLeaf, MovingSet, Proof, ProofLimits, prove};
use super::moving_pair::{Carried, Kinematics, MovingPair, RatesInWorld};
use super::moving_pure::MovingPure;
use super::segment::{LinearMotion, STEP_FRACTION};
use super::set_tree::{LeafContent, SetLeaf, SetTree};
use super::way::Way;
use crate::cobject::{CObject, Class, Induced};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Pose;
use crate::query::{
    CandidateFilter, Configuration, Distance, Group, QueryContext, Scene, Target, World,
    check_threshold,
};
use crate::space::Space;

/// What is asked of a motion.
#[derive(Clone, Copy, Debug)]
pub struct MotionOptions {
    /// What comes at most this near counts as contact: a length, at least 0. 0 asks for the class: nothing inside.
    pub threshold: f64,
    /// How exactly the time of contact is to be known, of the motion's time from 0 to 1: from 1e-12 to 1.
    pub tolerance: f64,
    /// Any contact will do; else the first is looked for.
    pub any_contact: bool,
}

impl Default for MotionOptions {
    fn default() -> Self {
        Self {
            threshold: 0.0,
            tolerance: 1e-6,
            any_contact: false,
        }
    }
}

/// How a motion ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionOutcome {
    /// Proved free for every time from 0 to 1.
    Free,
    /// There is contact at the second of the times; unless any contact was asked for, all before the first is proved free, and the
    /// two are no farther apart than the tolerance.
    Hit,
    /// All before the times is free; between them, no farther apart than the tolerance, it comes so near the threshold that neither
    /// a proof nor a contact was found.
    Near,
    /// The work of a call was limited (see [`QueryContext::set_limit`]); all before the first time is free.
    Undecided,
}

/// What was found of a motion.
#[derive(Clone, Debug)]
pub struct MotionAnswer {
    /// How it ends.
    pub outcome: MotionOutcome,
    /// See [`MotionOutcome`]; 1 and 1 for a motion that is free.
    pub times: [f64; 2],
    /// The configuration at the second time.
    pub configuration: Vec<f64>,
    /// The distance there, with its witness: of hits and of what is near, unless lengths and units of C-space mix in the set.
    pub distance: Option<Distance>,
}

impl MotionOptions {
    pub(super) fn check(&self) -> Result<()> {
        check_threshold(self.threshold, "threshold")?;
        if !self.threshold.is_finite() {
            return Err(Error::invalid("threshold is infinite: nothing is farther"));
        }
        if !(1e-12..=1.0).contains(&self.tolerance) {
            return Err(Error::invalid(format!(
                "tolerance {} is not between 1e-12 and 1",
                self.tolerance
            )));
        }
        Ok(())
    }
}

impl QueryContext {
    /// Whether the motion from q0 to q1, as [`crate::space::Space::interpolate`] makes it, keeps clear of a C-object: proved, or its
    /// first contact.
    pub fn motion(
        &mut self,
        cobject: &CObject,
        q0: &[f64],
        q1: &[f64],
        options: &MotionOptions,
    ) -> Result<MotionAnswer> {
        let v = checked_difference(cobject.space(), q0, q1)?;
        self.motion_along(cobject, q0, &v, options)
    }

    /// The same from q with velocity v for a unit of time.
    pub fn motion_along(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        v: &[f64],
        options: &MotionOptions,
    ) -> Result<MotionAnswer> {
        cobject.space().check_configuration(q)?;
        cobject.space().check_velocity(v, "velocity")?;
        let world = &self.begin_motion(cobject, options)?;
        let way = &Way::straight(LinearMotion {
            world,
            cobject,
            q,
            v,
        });
        self.motion_on(way, options)
    }

    /// Checks what all motions need; takes the world.
    pub(super) fn begin_motion(
        &mut self,
        cobject: &CObject,
        options: &MotionOptions,
    ) -> Result<World> {
        options.check()?;
        if options.threshold > 0.0 {
            cobject.require_one_metric()?;
        }
        Ok(self.look(cobject))
    }

    /// Proves a motion free, or finds its contact.
    pub(super) fn motion_on(&mut self, way: &Way, options: &MotionOptions) -> Result<MotionAnswer> {
        let motions = &way.link_motions();
        let tree = &SetTree::new(way.line.cobject);
        let q_middle = &way.at(0.5);
        let scene = &way.scene(q_middle)?;
        let mut gathering = Gathering {
            way,
            rates: RatesInWorld::new(motions),
            threshold: options.threshold,
            is_plain: tree.is_plain_union(),
            leaves: Vec::with_capacity(tree.leaves.len()),
            pairs: Vec::new(),
            needs_start: false,
            speeds: Vec::new(),
        };
        for leaf in &tree.leaves {
            gathering.add(leaf, scene, self)?;
        }
        let needs_start = gathering.needs_start;
        if needs_start && self.has_contact(way, 0.0, options)? {
            return self.answer(way, MotionOutcome::Hit, [0.0, 0.0]);
        }
        let crowds = gathering.crowds(scene);
        let Gathering { leaves, pairs, .. } = gathering;
        let set = &MovingSet {
            way: Some(way),
            tree,
            leaves,
            pairs,
            crowds,
        };
        let limits = ProofLimits {
            tolerance: options.tolerance,
            any_contact: options.any_contact,
        };
        let needs_poses = set.pairs.iter().any(MovingPair::needs_poses);
        let kinematics = &mut Kinematics::new(motions, needs_poses.then_some(way));
        let confirm = &mut |context: &mut Self, t: f64| context.has_contact(way, t, options);
        match prove(set, kinematics, limits, self, confirm)? {
            Proof::Free => self.answer(way, MotionOutcome::Free, [1.0, 1.0]),
            Proof::Contact(times) => self.answer(way, MotionOutcome::Hit, times),
            Proof::Exceeded(time) => self.answer(way, MotionOutcome::Undecided, [time, time]),
            Proof::Undecided([start, end]) => {
                // Where rounding hides the moment of contact, it may be certain as soon as the tolerance allows.
                for end in [end, (start + options.tolerance).min(1.0)] {
                    if self.has_contact(way, end, options)? {
                        return self.answer(way, MotionOutcome::Hit, [start, end]);
                    }
                }
                self.answer(way, MotionOutcome::Near, [start, end])
            }
        }
    }

    /// Whether there is contact at a time of the motion.
    pub(super) fn has_contact(
        &mut self,
        way: &Way,
        t: f64,
        options: &MotionOptions,
    ) -> Result<bool> {
        let q = way.at(t);
        if options.threshold == 0.0 {
            return Ok(self.classify_in(way.line.world, way.line.cobject, &q)? == Class::Inside);
        }
        let scene = &way.scene(&q)?;
        self.set_within(way.line.cobject, scene, options.threshold)
    }

    pub(super) fn answer(
        &mut self,
        way: &Way,
        outcome: MotionOutcome,
        times: [f64; 2],
    ) -> Result<MotionAnswer> {
        let configuration = way.at(times[1]);
        let distance = match outcome {
            MotionOutcome::Hit | MotionOutcome::Near
                if way.line.cobject.require_one_metric().is_ok() =>
            {
                let at = Configuration::Coordinates(&configuration);
                Some(self.distance_in(way.line.world, way.line.cobject, at, f64::INFINITY)?)
            }
            _ => None,
        };
        Ok(MotionAnswer {
            outcome,
            times,
            configuration,
            distance,
        })
    }
}

/// The velocity that leads from q0 to q1 in a unit of time.
pub(super) fn checked_difference(space: &Space, q0: &[f64], q1: &[f64]) -> Result<Vec<f64>> {
    for (q, name) in [(q0, "q0"), (q1, "q1")] {
        space
            .check_configuration(q)
            .map_err(|error| error.within(name))?;
    }
    Ok(space.difference(q0, q1))
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
struct Gathering<'a> {
    way: &'a Way<'a>,
    rates: RatesInWorld<'a>,
    threshold: f64,
    is_plain: bool,
    leaves: Vec<MovingLeaf>,
    pairs: Vec<MovingPair<'a>>,
    /// The proof does not see whether the start is free: pairs that rest, and bodies inside others.
    needs_start: bool,
    /// Of links' bodies in the world, where they were asked for.
    speeds: Vec<Option<f64>>,
}

impl<'a> Gathering<'a> {
    fn add(
        &mut self,
        leaf: &SetLeaf<'a>,
        scene: &'a Scene,
        context: &mut QueryContext,
    ) -> Result<()> {
        let complement = leaf.complement;
        let moving = match leaf.content {
            LeafContent::Pure(set) => {
                let pure = MovingPure::new(self.way, set, complement, self.threshold)?;
                MovingLeaf::Pure(pure)
            }
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

    /// Adds the pairs of one induced set. A complement begins where distances exceed the contact epsilon.
    fn add_pairs(
        &mut self,
        term: &'a Group,
        complement: bool,
        scene: &'a Scene,
        context: &mut QueryContext,
    ) -> Result<()> {
        let line = &self.way.line;
        let fastest = line.fastest_pair(&term[0]).unwrap_or(0.0);
        if fastest.is_infinite() {
            return Err(unstated_speeds(&term[0]));
        }
        if fastest == 0.0 && self.is_plain {
            self.needs_start = true;
            return Ok(());
        }
        let threshold = if complement {
            term[0].options.contact_epsilon
        } else {
            self.threshold
        };
        let checked = scene.checked(term)?;
        // No distance at another time is less than that at the middle by more than what the whole motion changes.
        let wanted = CandidateFilter {
            any_order: true,
            ..CandidateFilter::within(threshold + fastest)
        };
        let meter = context.scratch.meter_mut();
        let found = scene.candidates(checked, wanted, &mut context.candidates, meter)?;
        // Of a straight motion at most half lies between the middle and any other time.
        let share = if self.way.controls.is_some() {
            1.0
        } else {
            0.5
        };
        // Those of one body together, what is near first.
        let mut order: Vec<(usize, u64, OrderedBound, usize)> = Vec::with_capacity(found.len());
        for (place, target) in found.iter().enumerate() {
            let needed = share * self.speed(scene, target);
            if STEP_FRACTION * (target.bound - threshold) <= needed {
                let (link, object, _) = target.parties();
                order.push((link, object, OrderedBound(target.bound), place));
            }
        }
        order.sort_unstable();
        self.pairs.reserve(order.len());
        for (.., place) in order {
            self.add_pair(&found[place], threshold, term, scene)?;
        }
        context.candidates.keep(found);
        Ok(())
    }

    fn add_pair(
        &mut self,
        target: &Target<'a>,
        threshold: f64,
        term: &Group,
        scene: &Scene,
    ) -> Result<()> {
        let (r_link, s_link) = target.links();
        let [(body, r_pose), (other, s_pose)] = target.sides;
        let a = Carried {
            body,
            link: r_link,
            pose: pose_on(scene, Some(r_link), r_pose),
        };
        let b = Carried {
            body: other,
            link: s_link,
            pose: pose_on(scene, s_link, s_pose),
        };
        let limit = threshold + target.options.margin;
        let leaf = self.leaves.len() as u32;
        let line = &self.way.line;
        let speed = || line.rate(scene, target);
        let pair = MovingPair::new(a, b, limit, leaf, &mut self.rates, speed);
        let pair = pair.ok_or_else(|| unstated_speeds(&term[0]))?;
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
    fn crowds(&self, scene: &Scene) -> Vec<Crowd> {
        let mut crowds = Vec::new();
        let mut first = 0;
        for run in self.pairs.chunk_by(MovingPair::is_in_crowd_of) {
            if run.len() > 1 {
                let origin = scene.poses()[run[0].link()].translation;
                crowds.push(Crowd::new(first, run, origin));
            }
            first += run.len() as u32;
        }
        crowds
    }

    /// Bounds the change of a pair's distance in the whole time.
    fn speed(&mut self, scene: &Scene, target: &Target) -> f64 {
        let line = &self.way.line;
        let (r_link, s_link) = target.links();
        let (_, r_object, _) = target.parties();
        if s_link.is_some() || r_object != 0 {
            return line.rate(scene, target);
        }
        self.speeds.resize(scene.poses().len(), None);
        *self.speeds[r_link].get_or_insert_with(|| line.rate(scene, target))
    }
}

/// A pose of the world in the frame of a link, if one carries it.
fn pose_on(scene: &Scene, link: Option<usize>, pose: &Pose) -> Pose {
    match link.map(|link| &scene.poses()[link]) {
        None => *pose,
        Some(link) if link == pose => Pose::identity(),
        Some(link) => link.inverse().compose(pose),
    }
}
