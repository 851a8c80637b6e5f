//! Two bodies without a robot, each on a screw from one pose to another.

use super::carried::Carried;
use super::interval_proof::{MovingLeaf, MovingSet, Proof, ProofLimits, prove};
use super::kinematics::Kinematics;
use super::motion::{MotionOptions, MotionOutcome};
use super::moving_pair::MovingPair;
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

/// What was found of two bodies on a motion.
#[derive(Clone, Debug)]
pub struct PairMotionAnswer {
    /// How it ends.
    pub outcome: MotionOutcome,
    /// See [`MotionOutcome`]; 1 and 1 for a motion that is free.
    pub times: [f64; 2],
    /// The poses of both bodies at the second time.
    pub poses: [Pose; 2],
    /// The distance there, with its witness: of hits and of what is near, unless any contact was asked for.
    pub distance: Option<Distance>,
}

impl QueryContext {
    /// Whether two bodies that move keep farther apart than the threshold, in the sense of [`QueryContext::pair_within`]: proved, or
    /// their first contact. A translation is exact: no interval of it is halved for what it bends.
    pub fn pair_motion(
        &mut self,
        a: &PairMotion,
        b: &PairMotion,
        options: &MotionOptions,
    ) -> Result<PairMotionAnswer> {
        options.check()?;
        for end in 0..2 {
            check_dimensions((a.body, a.poses[end]), (b.body, b.poses[end]))?;
        }
        self.scratch.meter_mut().start_call();
        let mut motions = LinkMotions::default();
        for moving in [a, b] {
            let [start, end] = moving.poses;
            let [linear, angular] = screw_between(start, end);
            motions.push_screw(start, &linear, &angular);
        }
        let poses_at = |t: f64| {
            let mut states = LinkStates::default();
            states.start(&motions, t);
            [0, 1].map(|body| states.of(&motions, body).pose)
        };
        let meets = |context: &mut Self, t: f64| {
            let poses = poses_at(t);
            let [at_a, at_b] = [(a.body, &poses[0]), (b.body, &poses[1])];
            context.bodies_within(at_a, at_b, options.threshold)
        };
        let rates = &mut PairRates::new(&motions);
        let first = Carried {
            body: a.body,
            link: 0,
            pose: None,
            number: 0,
        };
        let second = Carried {
            body: b.body,
            link: Some(1),
            pose: None,
            number: 1,
        };
        let pair = MovingPair::new(first, second, options.threshold, 0, rates, || {
            [f64::INFINITY; 2]
        });
        let pair = pair.filter(|pair| !pair.rests());
        // A body inside another does not meet its surface.
        let has_solid = pair.as_ref().is_none_or(MovingPair::has_solid);
        let end = if has_solid && meets(self, 0.0)? {
            Proof::Contact([0.0, 0.0])
        } else {
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
            let mut memory: Box<ProofMemory> = self.proof_memory.take();
            let states = std::mem::take(&mut memory.kinematics);
            let mut kinematics = Kinematics::new(&motions, None, states);
            let confirm = &mut |context: &mut Self, t: f64| meets(context, t);
            let search = &mut memory.search;
            let proof = prove(set, &mut kinematics, limits, self, confirm, search);
            memory.kinematics = kinematics.into_memory();
            self.proof_memory.keep(memory);
            proof?
        };
        let (outcome, times) = MotionOutcome::of_proof(end, options.tolerance, |t| meets(self, t))?;
        let poses = if times[1] == 1.0 {
            [*a.poses[1], *b.poses[1]]
        } else {
            poses_at(times[1])
        };
        let distance = match outcome {
            MotionOutcome::Hit | MotionOutcome::Near if !options.any_contact => {
                let [at_a, at_b] = [(a.body, &poses[0]), (b.body, &poses[1])];
                Some(self.bodies_distance(at_a, at_b, f64::INFINITY)?)
            }
            _ => None,
        };
        Ok(PairMotionAnswer {
            outcome,
            times,
            poses,
            distance,
        })
    }
}
