//! Whole motions: a proof that a segment of C-space is free, or its first contact (§2.3.1 asks for it; Figure 1 shows what sampling
//! misses). Nothing is sampled: every answer "free" rests on bounds over intervals that cover the segment.

use super::crowd::Crowd;
use super::gathering::{Gathering, Keeps};
use super::interval_proof::{Confirm, Proof, ProofLimits, prove};
use super::kinematics::Kinematics;
use super::linear_motion::LinearMotion;
use super::links_on_way::LinksOnWay;
use super::motion_answer::{Moments, MotionAnswer, MotionOutcome};
use super::moving_pair::MovingPair;
use super::moving_set::MovingSet;
use super::pair_rates::PairRates;
use super::proof_memory::ProofMemory;
use super::set_tree::SetTree;
use super::start_contacts::StartContacts;
use super::way::Way;
use crate::cobject::{CObject, Class};
use crate::error::{Error, Result};
use crate::query::{Configuration, Distance, QueryContext, World, check_threshold};
use crate::reused::emptied;

/// Where any contact will do, these eighths of a motion at most are looked at before a proof begins, in this order: most motions that
/// planners ask for are not free, and one configuration inside says so sooner than a proof fails. Of the motions that an RRT-Connect
/// asks for, the middle is inside twice as often as the end, and where it is not, mostly what comes before it is: with the end
/// first a quarter more configurations are looked at. Sixteenths cost motions that are free more than they save others.
const SAMPLED_FIRST: [u32; 8] = [4, 2, 8, 6, 1, 3, 5, 7];

/// What is asked of a motion.
#[derive(Clone, Copy, Debug)]
pub struct MotionOptions {
    /// What comes at most this near counts as contact: a length, at least 0. 0 asks for the class: nothing inside.
    pub threshold: f64,
    /// How exactly the time of contact is to be known, of the motion's time from 0 to 1: from 1e-12 to 1.
    pub tolerance: f64,
    /// Any contact will do, and no distance is told there; else the first is looked for.
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

impl MotionOptions {
    /// Checks them, and that the C-object can be asked about this threshold.
    pub(crate) fn check_for(&self, cobject: &CObject) -> Result<()> {
        self.check()?;
        if self.threshold > 0.0 {
            cobject.require_one_metric()?;
        }
        Ok(())
    }

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

/// A motion that a robot makes, as it is asked.
struct AskedWay<'a> {
    context: &'a mut QueryContext,
    way: &'a Way<'a>,
    options: &'a MotionOptions,
}

impl Moments for AskedWay<'_> {
    type Configuration = Vec<f64>;

    fn at(&self, t: f64) -> Result<Vec<f64>> {
        self.way.at(t)
    }

    fn meet(&mut self, t: f64) -> Result<bool> {
        self.context.has_contact(self.way, t, self.options)
    }

    fn distance(&mut self, at: &Vec<f64>) -> Result<Option<Distance>> {
        let LinearMotion { world, cobject, .. } = self.way.line;
        if self.options.any_contact || cobject.require_one_metric().is_err() {
            return Ok(None);
        }
        let at = Configuration::Coordinates(at);
        let found = self.context.distance_in(world, cobject, at, f64::INFINITY);
        found.map(Some)
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
        let world = &self.begin_motion(cobject, options)?;
        let found = self.motion_between_in(world, cobject, [q0, q1], options);
        MotionAnswer::or_undecided(found, || q0.to_vec())
    }

    /// The same in a given world, with checked options.
    pub(crate) fn motion_between_in(
        &mut self,
        world: &World,
        cobject: &CObject,
        [q0, q1]: [&[f64]; 2],
        options: &MotionOptions,
    ) -> Result<MotionAnswer> {
        let ask = |way: &Way| self.sampled_or_proved(way, options);
        Way::between(world, cobject, [q0, q1], ask)
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
        MotionAnswer::or_undecided(self.sampled_or_proved(way, options), || q.to_vec())
    }

    /// The answer of a whole straight motion: by a sample where any contact will do and one has it, else by the proof.
    pub(super) fn sampled_or_proved(
        &mut self,
        way: &Way,
        options: &MotionOptions,
    ) -> Result<MotionAnswer> {
        if options.any_contact {
            let uses_known = options.threshold == 0.0 && way.line.cobject.has_known();
            if uses_known && way.is_free_by_word(&SetTree::new(way.line.cobject, true))? {
                return MotionAnswer::of_proof(Proof::Free, 0.0, &mut self.asked(way, options));
            }
            for time in times_sampled_first(way) {
                if let Some(hit) = self.contact_at(way, time, options)? {
                    return Ok(hit);
                }
            }
        }
        self.motion_on(way, options)
    }

    /// The answer where there is contact at a time, and any will do.
    pub(super) fn contact_at(
        &mut self,
        way: &Way,
        time: f64,
        options: &MotionOptions,
    ) -> Result<Option<MotionAnswer>> {
        if !self.has_contact(way, time, options)? {
            return Ok(None);
        }
        let asked = &mut self.asked(way, options);
        MotionAnswer::new(MotionOutcome::Hit, [0.0, time], asked).map(Some)
    }

    /// Checks what all motions need; takes the world.
    pub(crate) fn begin_motion(
        &mut self,
        cobject: &CObject,
        options: &MotionOptions,
    ) -> Result<World> {
        options.check_for(cobject)?;
        Ok(self.look(cobject))
    }

    /// Proves a motion free, or finds its contact.
    pub(super) fn motion_on(&mut self, way: &Way, options: &MotionOptions) -> Result<MotionAnswer> {
        let confirm = &mut |context: &mut Self, t: f64| context.has_contact(way, t, options);
        let limits = &mut ProofLimits {
            tolerance: options.tolerance,
            any_contact: options.any_contact,
            intervals: usize::MAX,
        };
        let proof = self.prove_way(way, options.threshold, limits, None, confirm)?;
        let asked = &mut self.asked(way, options);
        MotionAnswer::of_proof(proof, options.tolerance, asked)
    }

    fn asked<'a>(&'a mut self, way: &'a Way, options: &'a MotionOptions) -> AskedWay<'a> {
        AskedWay {
            context: self,
            way,
            options,
        }
    }

    /// The proof of a motion. `start` is given for motions that are known not to begin inside.
    pub(super) fn prove_way(
        &mut self,
        way: &Way,
        threshold: f64,
        limits: &mut ProofLimits,
        start: Option<&StartContacts>,
        confirm: &mut Confirm,
    ) -> Result<Proof> {
        let motions = &way.link_motions();
        let tree = &SetTree::new(way.line.cobject, threshold == 0.0);
        if way.is_free_by_word(tree)? {
            return Ok(Proof::Free);
        }
        let q_middle = way.at(0.5)?;
        let at = Configuration::Coordinates(&q_middle);
        let LinearMotion { world, cobject, .. } = way.line;
        self.with_scene(cobject, world, at, |context, scene| {
            let mut memory: Box<ProofMemory> = context.proof_memory.take();
            let states = std::mem::take(&mut memory.kinematics);
            let mut kinematics = Kinematics::new(motions, Some(way), states);
            kinematics.start(0.5)?;
            let rates = PairRates::in_memory(motions, std::mem::take(&mut memory.rates));
            let links = LinksOnWay::new(way, scene, rates, Some(&mut kinematics));
            let mut gathering = Gathering::new(way, scene, links, threshold, tree, Keeps::Out);
            gathering.pairs = emptied(std::mem::take(&mut memory.pairs));
            gathering.start = start;
            for leaf in &tree.leaves {
                gathering.add(leaf, context)?;
            }
            let starts_inside = gathering.needs_start && confirm(context, 0.0)?;
            let crowds = match starts_inside {
                true => Vec::new(),
                false => gathering.crowds(&mut memory.crowds),
            };
            let Gathering {
                leaves,
                pairs,
                links,
                ..
            } = gathering;
            memory.rates = links.rates.into_memory();
            let set = MovingSet {
                way: Some(way),
                tree,
                leaves,
                pairs,
                crowds,
            };
            let proof = if starts_inside {
                Ok(Proof::Contact([0.0, 0.0]))
            } else {
                if set.pairs.iter().any(MovingPair::needs_poses) {
                    kinematics.need_poses();
                }
                let search = &mut memory.search;
                prove(&set, &mut kinematics, limits, context, confirm, search)
            };
            memory.kinematics = kinematics.into_memory();
            memory.pairs = emptied(set.pairs);
            let boxes = set.crowds.into_iter().map(Crowd::into_boxes);
            memory.crowds.boxes.extend(boxes);
            context.proof_memory.keep(memory);
            proof
        })
    }

    /// Whether there is contact at a time of the motion.
    pub(super) fn has_contact(
        &mut self,
        way: &Way,
        t: f64,
        options: &MotionOptions,
    ) -> Result<bool> {
        let q = way.at(t)?;
        let LinearMotion { world, cobject, .. } = way.line;
        if options.threshold == 0.0 {
            return Ok(self.classify_in(world, cobject, &q)? == Class::Inside);
        }
        let at = Configuration::Coordinates(&q);
        self.with_scene(cobject, world, at, |context, scene| {
            context.set_within(cobject, scene, options.threshold)
        })
    }
}

/// The eighths of a motion to be looked at first, but those between which the last link with a body, which the most joints carry,
/// moves less far than its body reaches from the link's origin: what lies nearer together tells little that its neighbours do not.
/// The end is looked at however short the motion is: of short motions that are not free it is mostly inside.
fn times_sampled_first(way: &Way) -> impl Iterator<Item = f64> {
    let LinearMotion { cobject, q, v, .. } = way.line;
    let space = cobject.space();
    let last_body = (0..space.link_count())
        .rev()
        .find_map(|link| Some((link, space.body(link)?.radius_from_origin())));
    let (last, radius) = last_body.unwrap_or((0, 0.0));
    let length = space.motion_bound_of_radius(last, radius, q, v);
    let is_asked = move |&eighths: &u32| {
        // Halves, quarters or eighths.
        let parts = (8 >> eighths.trailing_zeros()).max(2);
        eighths == 8 || length > radius * f64::from(parts) / 2.0
    };
    let asked = SAMPLED_FIRST.into_iter().filter(is_asked);
    asked.map(|eighths| f64::from(eighths) / 8.0)
}
