//! Proves that a motion with constant velocity through C-space is free, by distances and motion bounds (Quinlan 1994, ch.
//! 4). Each body pair, and each pure set, has its own distance and motion bound. Where a plane separates a pair, the motion
//! along the plane's normal is bounded too, so that a base may slide over a floor however near.

use std::sync::Arc;

use super::half_spaces::dot;
use super::slide_step::Approach;
use crate::cobject::{BodyPairs, CObject, Induced, PureSet, PureShape, Set};
use crate::environment::{Environment, SObject};
use crate::error::Result;
use crate::pair::PrimitiveScratch;
use crate::pose::Vec3;
use crate::query::{
    CandidateFilter, Configuration, Group, Placement, PureAt, QueryContext, Scene, SceneMemory,
    Target, WitnessList, WitnessRequest, World, pure_witnesses,
};
use crate::space::Space;

/// The most distances computed for one pair; a motion that needs more counts as not free.
const MAX_DISTANCES: usize = 400;

/// The fraction of a distance that a step of the proof uses; the rest covers rounding of kinematics and motion bounds.
pub(super) const STEP_FRACTION: f64 = 0.99;

/// The motion from q with velocity v for a unit of time, in one state of the world. Both ends are within the coordinates'
/// ranges.
#[derive(Clone, Copy)]
pub(crate) struct LinearMotion<'a> {
    pub world: &'a World,
    pub cobject: &'a CObject,
    pub q: &'a [f64],
    pub v: &'a [f64],
}

/// How far a pair that touches at the start may move before a distance must prove it free: conservative advancement cannot
/// start at distance 0. Up to there its contacts must not come nearer, to first order.
#[derive(Clone, Copy)]
pub(crate) struct TouchAllowance {
    pub distance: f64,
    /// A pair with more witnesses than this within the distance counts as not free.
    pub max_count: usize,
}

/// A motion towards a plane of at most this fraction of [`TouchAllowance::distance`] is taken for rounding of a motion
/// along it.
const LEVEL: f64 = 1e-9;

impl TouchAllowance {
    /// How far below 0 the clearance of a contact may fall.
    fn allowed(&self) -> f64 {
        1e-3 * self.distance
    }
}

/// What the robot must keep clear of: a body pair, or a pure set.
trait Obstacle {
    /// A safe lower bound of the distance in a scene; a distance above `limit` may be given as the limit.
    fn lower(&self, context: &mut QueryContext, scene: &Scene, limit: f64) -> Result<f64>;

    /// The witnesses within a distance, with gradients.
    fn witnesses(
        &self,
        context: &mut QueryContext,
        scene: &Scene,
        request: WitnessRequest,
    ) -> Result<WitnessList>;

    /// A plane fixed in the world that separates the robot from the obstacle, if one is known.
    fn separation(
        &self,
        context: &mut QueryContext,
        motion: &LinearMotion,
        scene: &Scene,
    ) -> Option<Separation>;
}

/// A plane between a moving link and something at rest.
struct Separation {
    /// The gap between the two along the plane's normal.
    gap: f64,
    /// Bounds the link's motion along the normal over the whole motion.
    rate: f64,
}

impl Separation {
    /// Whether the plane separates the two during the whole motion.
    fn lasts(&self) -> bool {
        self.gap > 0.0 && STEP_FRACTION * self.gap >= self.rate
    }
}

/// A body pair of an induced set.
struct PairOnMotion<'a> {
    term: &'a Group,
    target: Target<'a>,
}

impl QueryContext {
    /// Whether the robot is proved to keep clear of the C-object. `false` may also mean that a proof would take too many
    /// distances.
    pub(crate) fn motion_is_free(
        &mut self,
        motion: &LinearMotion,
        allowance: &TouchAllowance,
    ) -> Result<bool> {
        let scene = &motion.scene(motion.q)?;
        if let Set::Union { induced, .. } = motion.cobject.set() {
            // Term by term: a candidate that several terms hold names only one of them.
            for term in induced {
                if !self.pairs_stay_clear(motion, scene, term, allowance)? {
                    return Ok(false);
                }
            }
        }
        for set in pure_sets(motion.cobject) {
            for part in set.parts_on_way(motion.cobject.space()) {
                let rate = part.motion_bound(motion.cobject.space(), motion.q, motion.v);
                if !self.stays_clear(motion, scene, &part, rate, allowance)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    fn pairs_stay_clear(
        &mut self,
        motion: &LinearMotion,
        scene: &Scene,
        term: &Arc<Induced>,
        allowance: &TouchAllowance,
    ) -> Result<bool> {
        let term = std::slice::from_ref(term);
        let Some(fastest) = motion.fastest_pair(&term[0]) else {
            return Ok(true);
        };
        let checked = scene.checked(term)?;
        let filter = CandidateFilter::within(fastest / STEP_FRACTION);
        let candidates = scene.candidates(
            checked,
            filter,
            &mut self.candidates,
            self.scratch.meter_mut(),
        )?;
        for &target in &candidates {
            let rate = motion.rate(scene, &target);
            if STEP_FRACTION * target.bound >= rate {
                continue;
            }
            // Searched alone, so its rank is 0: hits name their pair by rank.
            let target = Target { rank: 0, ..target };
            let pair = PairOnMotion { term, target };
            if !self.stays_clear(motion, scene, &pair, rate, allowance)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether an obstacle's distance stays above 0 during the motion; `rate` bounds how much it falls.
    fn stays_clear(
        &mut self,
        motion: &LinearMotion,
        start: &Scene,
        obstacle: &impl Obstacle,
        rate: f64,
        allowance: &TouchAllowance,
    ) -> Result<bool> {
        // What does not move relative to the robot may be arbitrarily near.
        if rate == 0.0 {
            return Ok(true);
        }
        if rate.is_infinite() {
            return Ok(false);
        }
        let lower = obstacle.lower(self, start, rate / STEP_FRACTION)?;
        if lower > 0.0 && STEP_FRACTION * lower >= rate {
            return Ok(true);
        }
        let plane = obstacle.separation(self, motion, start);
        if plane.as_ref().is_some_and(Separation::lasts) {
            return Ok(true);
        }
        if lower > 0.0 {
            return self.advances(motion, obstacle, rate, STEP_FRACTION * lower / rate);
        }
        // A link that does not move towards a separating plane cannot come nearer, however far it slides.
        let is_level = |plane: &Separation| {
            plane.gap >= -allowance.allowed() && plane.rate <= LEVEL * allowance.distance
        };
        let nearer = plane.filter(is_level).map_or(rate, |plane| plane.rate);
        let share = if nearer > allowance.distance {
            allowance.distance / nearer
        } else {
            1.0
        };
        if !self.keeps_off(motion, obstacle, start, share, allowance)? {
            return Ok(false);
        }
        Ok(share == 1.0 || self.advances(motion, obstacle, rate, share)?)
    }

    /// Whether an obstacle's distance stays above 0 from parameter `start` on, by conservative advancement.
    fn advances(
        &mut self,
        motion: &LinearMotion,
        obstacle: &impl Obstacle,
        rate: f64,
        start: f64,
    ) -> Result<bool> {
        let mut t = start;
        for _ in 0..MAX_DISTANCES {
            let at = motion.at(t);
            let scene = &motion.scene(&at)?;
            let rest = rate * (1.0 - t) / STEP_FRACTION;
            // A limit of 0 would make any bound 0.
            let lower = obstacle.lower(self, scene, rest.max(f64::MIN_POSITIVE))?;
            if lower <= 0.0 || lower >= rest {
                return Ok(lower > 0.0);
            }
            // The distance cannot fall to 0 before the next parameter.
            t = (t + STEP_FRACTION * lower / rate).min(1.0);
        }
        Ok(false)
    }

    /// Whether, to first order, no contact of a touching start comes nearer up to parameter `share`.
    fn keeps_off(
        &mut self,
        motion: &LinearMotion,
        obstacle: &impl Obstacle,
        scene: &Scene,
        share: f64,
        allowance: &TouchAllowance,
    ) -> Result<bool> {
        let request = WitnessRequest {
            // Witnesses farther away cannot come to touch.
            with_gradients: true,
            counts_doubt: true,
            ..WitnessRequest::within(allowance.distance / STEP_FRACTION, allowance.max_count)
        };
        let list = obstacle.witnesses(self, scene, request)?;
        let keeps_off =
            |a: &Approach| a.clearance + share * dot(a.gradient, motion.v) >= -allowance.allowed();
        let is_known = !list.truncated && list.witnesses.iter().all(|w| w.contact_count > 0);
        Ok(is_known && list.approaches().iter().all(keeps_off))
    }
}

impl Obstacle for PairOnMotion<'_> {
    fn lower(&self, context: &mut QueryContext, scene: &Scene, limit: f64) -> Result<f64> {
        let Some(target) = self.at(scene) else {
            return Ok(0.0);
        };
        Ok(context.nearest(&[target], limit)?.lower.min(limit))
    }

    fn witnesses(
        &self,
        context: &mut QueryContext,
        scene: &Scene,
        request: WitnessRequest,
    ) -> Result<WitnessList> {
        let Some(target) = self.at(scene) else {
            // The scene does not hold the pair: nothing is known.
            return Ok(WitnessList {
                truncated: true,
                ..WitnessList::default()
            });
        };
        context.list(self.term, scene, &[target], request)
    }

    fn separation(
        &self,
        context: &mut QueryContext,
        motion: &LinearMotion,
        scene: &Scene,
    ) -> Option<Separation> {
        let target = self.at(scene)?;
        let (link, None) = target.links() else {
            return None;
        };
        let targets = &[target];
        let (hit, _) = context.nearest(targets, f64::INFINITY).ok()?.hit?;
        if hit.contained.is_some() {
            return None;
        }
        let pairing = target.pairing();
        let scratch = &mut PrimitiveScratch::default();
        let closest = pairing.closest(&hit, scratch);
        let contacts = pairing.world_contacts(hit.key.primitives, &closest, scratch);
        let normal = contacts.first()?.normal;
        Some(Separation {
            gap: pairing.gap_along(&normal) - target.options.margin,
            rate: motion.directed_rate(scene, link, target.sides[0], &normal)?,
        })
    }
}

impl PairOnMotion<'_> {
    /// The pair at its poses in a scene; `None` if the scene does not hold it.
    fn at<'s>(&'s self, scene: &'s Scene) -> Option<Target<'s>> {
        let sides = scene.sides_of(&self.term[0], &self.target.key)?;
        Some(Target {
            sides,
            bound: f64::NEG_INFINITY,
            ..self.target
        })
    }
}

impl Obstacle for PureSet {
    fn lower(&self, _: &mut QueryContext, scene: &Scene, limit: f64) -> Result<f64> {
        let at = PureAt {
            set: self,
            complement: false,
            scene,
        };
        Ok(at.bounded_distance()?.lower.min(limit))
    }

    fn witnesses(
        &self,
        _: &mut QueryContext,
        scene: &Scene,
        request: WitnessRequest,
    ) -> Result<WitnessList> {
        pure_witnesses(&[(self, false)], scene, request)
    }

    /// A floor is itself the plane.
    fn separation(
        &self,
        _: &mut QueryContext,
        motion: &LinearMotion,
        scene: &Scene,
    ) -> Option<Separation> {
        let PureShape::Floor { links, normal, .. } = &self.shape else {
            return None;
        };
        let &[link] = &links[..] else {
            return None;
        };
        let measure = self.measure(&scene.space_state()).ok()??;
        Some(Separation {
            gap: measure.signed - measure.error,
            rate: motion.directed_rate(scene, link, scene.link(link)?, normal)?,
        })
    }
}

impl<'a> LinearMotion<'a> {
    pub(super) fn at(&self, t: f64) -> Vec<f64> {
        let displacement: Vec<f64> = self.v.iter().map(|x| x * t).collect();
        self.cobject.space().step(self.q, &displacement)
    }

    pub(super) fn scene<'s>(&'s self, q: &'s [f64]) -> Result<Scene<'s>> {
        Scene::new(
            self.cobject.space(),
            self.world,
            Configuration::Coordinates(q),
            SceneMemory::default(),
        )
    }

    /// Whether every joint that moves, and that changes some distance, states its speeds.
    pub fn states_speeds(&self) -> bool {
        let space = self.cobject.space();
        let of_pairs = match self.cobject.set() {
            Set::Union { induced, .. } => &induced[..],
            _ => &[],
        };
        let of_pairs = of_pairs.iter().filter_map(|term| self.fastest_pair(term));
        let of_sets = pure_sets(self.cobject).map(|set| set.motion_bound(space, self.q, self.v));
        of_pairs.chain(of_sets).all(f64::is_finite)
    }

    /// Bounds the change of distance of all pairs of the set; `None` if no distance changes.
    pub(super) fn fastest_pair(&self, term: &Induced) -> Option<f64> {
        let &Self { world, q, v, .. } = self;
        let space = self.cobject.space();
        let fastest = match &term.pairs {
            BodyPairs::Objects { links, objects, .. } => {
                let held = extents_of_held(world, objects.environment(), space);
                let of_link = |link: usize| {
                    let held = held.iter().filter(|(holder, _)| *holder == link);
                    let held =
                        held.map(|(_, extent)| space.motion_bound_of_radius(link, *extent, q, v));
                    held.fold(space.motion_bound(link, q, v), f64::max)
                };
                let of_links = links.iter().map(|&link| of_link(link));
                // An attached object moves, and is an s-object to the other links.
                let of_carriers = held.iter().map(|(holder, _)| of_link(*holder));
                of_links.fold(0.0, f64::max) + of_carriers.fold(0.0, f64::max)
            }
            BodyPairs::Links { pairs } => {
                let extent = |link: usize| {
                    let body = space.link(link).and_then(|link| link.body.as_deref());
                    body.map_or(0.0, |body| body.radius_from_origin())
                };
                let of_pair = |&[r, s]: &[usize; 2]| {
                    space.relative_motion_bound([(r, extent(r)), (s, extent(s))], q, v)
                };
                pairs.iter().map(of_pair).fold(0.0, f64::max)
            }
        };
        (fastest > 0.0).then_some(fastest)
    }

    /// Bounds how far a body carried by a link moves along a direction of the world, from a scene on.
    fn directed_rate(
        &self,
        scene: &Scene,
        link: usize,
        carried: Placement,
        direction: &Vec3,
    ) -> Option<f64> {
        let extent = extent(scene, link, carried);
        let space = self.cobject.space();
        Some(space.directed_motion_bound(link, extent, direction, scene.state()?, self.v))
    }

    /// Bounds the change of a pair's distance, by the relative motion of its bodies.
    pub(super) fn rate(&self, scene: &Scene, target: &Target) -> f64 {
        let &Self { q, v, .. } = self;
        let space = self.cobject.space();
        let (r_link, s_link) = target.links();
        let r = (r_link, extent(scene, r_link, target.sides[0]));
        match s_link {
            Some(s) => {
                let s = (s, extent(scene, s, target.sides[1]));
                space.relative_motion_bound([r, s], q, v)
            }
            None => space.motion_bound_of_radius(r.0, r.1, q, v),
        }
    }
}

/// Bounds the distance of a link's body, or of an object attached to the link, from the link's origin.
fn extent(scene: &Scene, link: usize, (body, pose): Placement) -> f64 {
    (pose.translation - scene.poses()[link].translation).norm() + body.radius_from_origin()
}

/// The pure sets of a union, or the set itself if it is pure.
fn pure_sets(cobject: &CObject) -> impl Iterator<Item = &PureSet> {
    let own = match cobject.set() {
        Set::Pure(set) => Some(set),
        _ => None,
    };
    let parts = cobject.set().parts().iter();
    own.into_iter()
        .chain(parts.filter_map(|part| match part.set() {
            Set::Pure(set) => Some(set),
            _ => None,
        }))
}

/// The links of a space that hold s-objects of an environment, with bounds of the objects' distances from the links'
/// origins.
fn extents_of_held(world: &World, environment: &Environment, space: &Space) -> Vec<(usize, f64)> {
    let attached = world.snapshot(environment).map(|now| now.attached());
    let extent = |object: &SObject| {
        let attachment = object.attachment.as_ref()?;
        let radius = object.pose.translation.norm() + object.body.radius_from_origin();
        (attachment.space == space.serial()).then_some((attachment.link, radius))
    };
    attached.into_iter().flatten().filter_map(extent).collect()
}
