//! Two bodies without a robot, each on a screw from one pose to another.

use super::carried::Carried;
use super::interval_proof::{Proof, ProofLimits, prove};
use super::kinematics::Kinematics;
use super::motion::MotionOptions;
use super::motion_answer::{Moments, MotionAnswer};
use super::moving_pair::MovingPair;
use super::moving_set::{MovingLeaf, MovingSet};
use super::pair_rates::PairRates;
use super::proof_memory::ProofMemory;
use super::set_tree::SetTree;
use crate::body::Body;
use crate::error::Result;
use crate::pose::Pose;
use crate::query::{Distance, QueryContext, check_dimensions};
use crate::robot::{LinkMotions, LinkStates};
use crate::space::screw_between;

/// A body that goes from one pose to another on a screw, with constant velocity in its own frame: it turns by the shortest
/// rotation. Between poses that differ in place alone that is a straight line.
#[derive(Clone, Copy)]
pub struct PairMotion<'a> {
    /// The body.
    pub body: &'a Body,
    /// Its poses at time 0 and 1, in the world.
    pub poses: [&'a Pose; 2],
}

/// Both bodies on their screws, as the two carriers of a proof.
struct OnScrews<'a> {
    bodies: [&'a Body; 2],
    ends: [&'a Pose; 2],
    motions: LinkMotions,
    threshold: f64,
}

impl<'a> OnScrews<'a> {
    fn new(pair: [&PairMotion<'a>; 2], threshold: f64) -> Self {
        let mut motions = LinkMotions::default();
        for moving in pair {
            let [start, end] = moving.poses;
            let [linear, angular] = screw_between(start, end);
            motions.push_screw(start, &linear, &angular);
        }
        Self {
            bodies: pair.map(|moving| moving.body),
            ends: pair.map(|moving| moving.poses[1]),
            motions,
            threshold,
        }
    }

    fn poses_at(&self, t: f64) -> [Pose; 2] {
        if t == 1.0 {
            return self.ends.map(|end| *end);
        }
        let mut states = LinkStates::default();
        states.start(&self.motions, t);
        [0, 1].map(|body| states.of(&self.motions, body).pose)
    }

    fn meet_at(&self, t: f64, context: &mut QueryContext) -> Result<bool> {
        let [a, b] = self.bodies;
        let [at_a, at_b] = &self.poses_at(t);
        context.bodies_within((a, at_a), (b, at_b), self.threshold)
    }

    /// The pair as a proof asks it; `None` where neither moves as the other sees it.
    fn moving_pair(&self, rates: &mut PairRates) -> Option<MovingPair<'a>> {
        let first = Carried {
            body: self.bodies[0],
            link: 0,
            pose: None,
            number: 0,
        };
        let second = Carried {
            body: self.bodies[1],
            link: Some(1),
            pose: None,
            number: 1,
        };
        let everywhere = || [f64::INFINITY; 2];
        MovingPair::new(first, second, self.threshold, 0, rates, everywhere)
            .filter(|pair| !pair.rests())
    }

    /// Proves the whole motion, or finds the first contact.
    fn prove(&self, options: &MotionOptions, context: &mut QueryContext) -> Result<Proof> {
        let rates = &mut PairRates::new(&self.motions);
        let pair = self.moving_pair(rates);
        // What rests is asked once. A body inside another does not meet its surface.
        let has_solid = pair.as_ref().is_none_or(MovingPair::has_solid);
        if has_solid && self.meet_at(0.0, context)? {
            return Ok(Proof::Contact([0.0, 0.0]));
        }
        let set = &MovingSet {
            way: None,
            tree: &SetTree::of_group(&[]),
            leaves: vec![MovingLeaf::Pairs { complement: false }],
            pairs: pair.into_iter().collect(),
            crowds: Vec::new(),
        };
        let limits = &mut ProofLimits {
            tolerance: options.tolerance,
            any_contact: options.any_contact,
            intervals: usize::MAX,
        };
        let mut memory: Box<ProofMemory> = context.proof_memory.take();
        let states = std::mem::take(&mut memory.kinematics);
        let mut kinematics = Kinematics::new(&self.motions, None, states);
        let confirm = &mut |context: &mut QueryContext, t: f64| self.meet_at(t, context);
        let search = &mut memory.search;
        let proof = prove(set, &mut kinematics, limits, context, confirm, search);
        memory.kinematics = kinematics.into_memory();
        context.proof_memory.keep(memory);
        proof
    }
}

impl QueryContext {
    /// Whether two bodies that move keep farther apart than the threshold, in the sense of [`QueryContext::pair_within`]: proved, or
    /// their first contact. A translation is exact: no interval of it is halved for what it bends.
    pub fn pair_motion(
        &mut self,
        a: &PairMotion,
        b: &PairMotion,
        options: &MotionOptions,
    ) -> Result<MotionAnswer<[Pose; 2]>> {
        options.check()?;
        for end in 0..2 {
            check_dimensions((a.body, a.poses[end]), (b.body, b.poses[end]))?;
        }
        self.scratch.meter_mut().start_call();
        let screws = &OnScrews::new([a, b], options.threshold);
        let found = screws.prove(options, self).and_then(|proof| {
            let mut asked = AskedScrews {
                context: self,
                screws,
                options,
            };
            MotionAnswer::of_proof(proof, options.tolerance, &mut asked)
        });
        MotionAnswer::or_undecided(found, || screws.poses_at(0.0))
    }
}

/// A motion that two bodies make, as it is asked.
struct AskedScrews<'a> {
    context: &'a mut QueryContext,
    screws: &'a OnScrews<'a>,
    options: &'a MotionOptions,
}

impl Moments for AskedScrews<'_> {
    type Configuration = [Pose; 2];

    fn at(&self, t: f64) -> Result<[Pose; 2]> {
        Ok(self.screws.poses_at(t))
    }

    fn meet(&mut self, t: f64) -> Result<bool> {
        self.screws.meet_at(t, self.context)
    }

    fn distance(&mut self, [at_a, at_b]: &[Pose; 2]) -> Result<Option<Distance>> {
        if self.options.any_contact {
            return Ok(None);
        }
        let [a, b] = self.screws.bodies;
        let found = (self.context).bodies_distance((a, at_a), (b, at_b), f64::INFINITY);
        found.map(Some)
    }
}
