//! Whole motions: a proof that a segment of C-space is free, or its first contact (§2.3.1 asks for it; Figure 1 shows what sampling
//! misses). Nothing is sampled: every answer "free" rests on bounds over intervals that cover the segment.

use std::sync::Arc;

use super::interval_proof::{Condition, Proof, ProofLimits, ProofScratch, Verdict, prove};
use super::moving_pair::MovingPair;
use super::segment::{LinearMotion, STEP_FRACTION};
use crate::cobject::{CObject, Class, Induced, PureSet, PureShape, Set};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Pose;
use crate::query::{
    CandidateFilter, Configuration, Distance, PureAt, QueryContext, Scene, Target, check_threshold,
};
use crate::robot::MotionChain;

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
    /// The distance there, with its witness: of hits and of what is near.
    pub distance: Option<Distance>,
}

/// A pure set on the motion.
struct MovingSet {
    set: PureSet,
    /// Its distance falls by no more than this in the whole time.
    rate: f64,
}

/// The pure sets of a union on a motion.
struct PureSets<'a> {
    way: LinearMotion<'a>,
    sets: Vec<MovingSet>,
    threshold: f64,
}

impl Condition for PureSets<'_> {
    fn over(&mut self, middle: f64, half: f64) -> Result<Verdict> {
        if self.sets.is_empty() {
            return Ok(Verdict::Free);
        }
        let q = self.way.at(middle);
        let scene = &self.way.scene(&q)?;
        let mut verdict = Verdict::Free;
        for MovingSet { set, rate } in &self.sets {
            let pure = PureAt {
                set,
                complement: false,
                scene,
            };
            // At the boundary of an open set, such as that beyond the joint limits, a configuration is outside.
            let lower = pure.bounded_distance()?.lower;
            let is_inside = pure.class()? == Class::Inside;
            if is_inside || (self.threshold > 0.0 && lower <= self.threshold) {
                return Ok(Verdict::Meets);
            }
            if lower - self.threshold <= rate * half * (1.0 + 1e-9) && *rate > 0.0 {
                verdict = Verdict::Undecided;
            }
        }
        Ok(verdict)
    }
}

/// What a union holds: its induced sets and its pure sets.
#[derive(Default)]
struct Parts<'a> {
    induced: Vec<&'a Arc<Induced>>,
    pure: Vec<&'a PureSet>,
}

impl<'a> Parts<'a> {
    fn of(cobject: &'a CObject) -> Result<Self> {
        let mut parts = Self::default();
        parts.take(cobject)?;
        Ok(parts)
    }

    fn take(&mut self, cobject: &'a CObject) -> Result<()> {
        match cobject.set() {
            Set::Pure(set) => self.pure.push(set),
            Set::Union { induced, others } => {
                self.induced.extend(induced);
                others.iter().try_for_each(|part| self.take(part))?;
            }
            Set::Intersection(_) | Set::Complement(_) => {
                return Err(Error::new(
                    ErrorKind::Unsupported,
                    format!(
                        "C-object {} is an intersection or a complement: motions are proved for unions",
                        cobject.serial()
                    ),
                ));
            }
        }
        Ok(())
    }
}

impl MotionOptions {
    fn check(&self) -> Result<()> {
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
    /// Whether the motion from q0 to q1, as [`crate::space::Space::interpolate`] makes it, keeps clear of a C-object, a union of
    /// induced and pure sets: proved, or its first contact.
    pub fn motion(
        &mut self,
        cobject: &CObject,
        q0: &[f64],
        q1: &[f64],
        options: &MotionOptions,
    ) -> Result<MotionAnswer> {
        let space = cobject.space();
        for (q, name) in [(q0, "q0"), (q1, "q1")] {
            space
                .check_configuration(q)
                .map_err(|error| error.within(name))?;
        }
        let v = space.difference(q0, q1);
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
        options.check()?;
        cobject.space().check_configuration(q)?;
        cobject.space().check_velocity(v, "velocity")?;
        cobject.require_one_metric()?;
        let world = &self.look(cobject);
        let way = &LinearMotion {
            world,
            cobject,
            q,
            v,
        };
        let parts = Parts::of(cobject)?;
        if self.has_contact(way, 0.0, options)? {
            return self.answer(way, MotionOutcome::Hit, [0.0, 0.0]);
        }
        let mut condition = way.moving_sets(&parts, options.threshold)?;
        let q_middle = &way.at(0.5);
        let scene = &way.scene(q_middle)?;
        let mut targets: Vec<(Target, f64)> = Vec::new();
        for term in &parts.induced {
            let term = std::slice::from_ref(*term);
            let Some(fastest) = way.fastest_pair(&term[0]) else {
                continue;
            };
            if fastest.is_infinite() {
                return Err(unstated_speeds());
            }
            let checked = scene.checked(term)?;
            // No distance at another time is less than that at the middle by more than what the whole motion changes.
            let wanted = CandidateFilter::within(options.threshold + fastest);
            let meter = self.scratch.meter_mut();
            let found = scene.candidates(checked, wanted, &mut self.candidates, meter)?;
            // Of the motion at most half lies between the middle and any other time.
            let may_meet = |target: &&Target| {
                let needed = 0.5 * way.rate(scene, target);
                STEP_FRACTION * (target.bound - options.threshold) <= needed
            };
            let threshold = |target: &Target| options.threshold + target.options.margin;
            let near = found.iter().filter(may_meet);
            targets.extend(near.map(|target| (*target, threshold(target))));
        }
        let mut pairs = Vec::with_capacity(targets.len());
        for (target, threshold) in &targets {
            let chain = way
                .relative_motion(scene, target)
                .ok_or_else(unstated_speeds)?;
            if !chain.rests() {
                let [(a, _), (b, _)] = target.sides;
                pairs.push(MovingPair::new(a, b, chain, *threshold));
            }
        }
        let limits = ProofLimits {
            tolerance: options.tolerance,
            any_contact: options.any_contact,
        };
        let memory = &mut ProofScratch::default();
        let proof = prove(&pairs, &mut condition, limits, memory, &mut self.scratch)?;
        match proof {
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
    fn has_contact(&mut self, way: &LinearMotion, t: f64, options: &MotionOptions) -> Result<bool> {
        let q = way.at(t);
        if options.threshold == 0.0 {
            return Ok(self.classify_in(way.world, way.cobject, &q)? == Class::Inside);
        }
        let scene = &way.scene(&q)?;
        self.set_within(way.cobject, scene, options.threshold)
    }

    fn answer(
        &mut self,
        way: &LinearMotion,
        outcome: MotionOutcome,
        times: [f64; 2],
    ) -> Result<MotionAnswer> {
        let configuration = way.at(times[1]);
        let distance = match outcome {
            MotionOutcome::Hit | MotionOutcome::Near => {
                let at = Configuration::Coordinates(&configuration);
                Some(self.distance_in(way.world, way.cobject, at, f64::INFINITY)?)
            }
            MotionOutcome::Free | MotionOutcome::Undecided => None,
        };
        Ok(MotionAnswer {
            outcome,
            times,
            configuration,
            distance,
        })
    }
}

fn unstated_speeds() -> Error {
    Error::new(
        ErrorKind::Unsupported,
        "a custom joint moves on the way: of these no motion is proved",
    )
}

impl<'a> LinearMotion<'a> {
    /// The pure sets with how fast their distances may fall.
    fn moving_sets(&self, parts: &Parts, threshold: f64) -> Result<PureSets<'a>> {
        let space = self.cobject.space();
        let is_in_range = space.beyond_limits(&self.at(1.0)).is_none();
        let mut sets = Vec::new();
        for set in &parts.pure {
            let is_limits = matches!(set.shape, PureShape::BeyondLimits);
            // Between two configurations in range, coordinates that move alone are in range.
            if is_limits && (threshold > 0.0 || !is_in_range) {
                let speed = self.v.iter().map(|x| x * x).sum::<f64>().sqrt();
                sets.push(MovingSet {
                    set: (*set).clone(),
                    rate: set.scale() * speed,
                });
                continue;
            }
            for part in set.parts_on_way(space) {
                let rate = part.motion_bound(space, self.q, self.v);
                if rate.is_infinite() {
                    return Err(Error::new(
                        ErrorKind::Unsupported,
                        format!(
                            "of pure set {} no speed is known: a predicate, or a custom joint without speeds",
                            set.leaf.serial
                        ),
                    ));
                }
                sets.push(MovingSet { set: part, rate });
            }
        }
        Ok(PureSets {
            way: *self,
            sets,
            threshold,
        })
    }

    /// How the r-side of a pair moves as the s-side sees it, in the bodies' frames; `scene` is at any time of the motion. `None` where
    /// a custom joint in between moves.
    fn relative_motion(&self, scene: &Scene, target: &Target) -> Option<MotionChain> {
        let (r_link, s_link) = target.links();
        let [(_, pose_r), (_, pose_s)] = target.sides;
        let fixed_to = |link: usize, pose: &Pose| {
            let link = &scene.poses()[link];
            if link == pose {
                Pose::identity()
            } else {
                link.inverse().compose(pose)
            }
        };
        let mut chain = MotionChain::default();
        let base = match s_link {
            None => {
                chain.push_fixed(pose_s.inverse());
                None
            }
            Some(s) => {
                chain.push_fixed(fixed_to(s, pose_s).inverse());
                Some(s)
            }
        };
        let between = self
            .cobject
            .space()
            .relative_motion(r_link, base, self.q, self.v)?;
        chain = chain.followed_by(&between);
        chain.push_fixed(fixed_to(r_link, pose_r));
        Some(chain)
    }
}
