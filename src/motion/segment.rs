//! A proof that a way of constant velocity through C-space is free, by distances and motion bounds (Quinlan 1994, ch. 4):
//! each body pair, and each pure set, with a distance and a motion bound of its own; of what a plane separates also along the
//! plane's normal, so that a base may slide over a floor however near.

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

/// At most this many distances are computed for one pair; a way that needs more counts as not free.
const MAX_DISTANCES: usize = 400;

/// The part of a distance that a step of the proof uses up: the rest covers the rounding of kinematics and motion bounds.
const STEP_FRACTION: f64 = 0.99;

/// The way from q with velocity v for a unit of time, in one state of the world. Both ends are in the coordinates' ranges.
#[derive(Clone, Copy)]
pub(crate) struct LinearMotion<'a> {
    pub world: &'a World,
    pub cobject: &'a CObject,
    pub q: &'a [f64],
    pub v: &'a [f64],
}

/// How far a pair that touches at the start may move before a distance must prove it free: from a touch no proof can begin.
/// The contacts must say that the pair does not come nearer, to first order.
#[derive(Clone, Copy)]
pub(crate) struct TouchAllowance {
    pub distance: f64,
    /// A pair with more witnesses than this within the distance is not trusted.
    pub max_count: usize,
}

/// A motion towards a plane that is no more than this part of [`TouchAllowance::distance`] is the rounding of one along it.
const LEVEL: f64 = 1e-9;

impl TouchAllowance {
    /// How much nearer than a touch a contact may come.
    fn allowed(&self) -> f64 {
        1e-3 * self.distance
    }
}

/// What the robot must keep clear of on a way: a body pair, or a pure set.
trait Obstacle {
    /// A safe lower bound of the distance at a scene; a distance above `limit` may give the limit.
    fn lower(&self, context: &mut QueryContext, scene: &Scene, limit: f64) -> Result<f64>;

    /// The witnesses within a distance, with gradients.
    fn witnesses(
        &self,
        context: &mut QueryContext,
        scene: &Scene,
        listed: WitnessRequest,
    ) -> Result<WitnessList>;

    /// A plane fixed to the world between the robot and the obstacle, if one is known.
    fn separation(
        &self,
        context: &mut QueryContext,
        way: &LinearMotion,
        scene: &Scene,
    ) -> Option<Separation>;
}

/// A plane between a moving link and something at rest.
struct Separation {
    /// How far the two are apart along the plane's normal.
    gap: f64,
    /// How far the link moves along the normal, on the whole way, at most.
    rate: f64,
}

impl Separation {
    /// Whether it separates the two on the whole way.
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
    /// Whether the robot keeps clear of the C-object all the way. `false` may also mean that it comes too near for a proof of
    /// reasonable length.
    pub(crate) fn way_is_free(
        &mut self,
        way: &LinearMotion,
        trust: &TouchAllowance,
    ) -> Result<bool> {
        let scene = &way.scene(way.q)?;
        if let Set::Union { induced, .. } = way.cobject.set() {
            // Each for itself: pairs that several hold need not be named by all of them.
            for term in induced {
                if !self.pairs_stay_clear(way, scene, term, trust)? {
                    return Ok(false);
                }
            }
        }
        for set in pure_sets(way.cobject) {
            for part in set.parts_on_way(way.cobject.space()) {
                let rate = part.motion_bound(way.cobject.space(), way.q, way.v);
                if !self.stays_clear(way, scene, &part, rate, trust)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    fn pairs_stay_clear(
        &mut self,
        way: &LinearMotion,
        scene: &Scene,
        term: &Arc<Induced>,
        trust: &TouchAllowance,
    ) -> Result<bool> {
        let term = std::slice::from_ref(term);
        let Some(fastest) = way.fastest_pair(&term[0]) else {
            return Ok(true);
        };
        let checked = scene.checked(term)?;
        let wanted = CandidateFilter::within(fastest / STEP_FRACTION);
        let candidates = scene.candidates(
            checked,
            wanted,
            &mut self.candidates,
            self.scratch.meter_mut(),
        )?;
        for &target in &candidates {
            let rate = way.rate(scene, &target);
            if STEP_FRACTION * target.bound >= rate {
                continue;
            }
            // Alone in its searches, whose hits name it by its rank.
            let target = Target { rank: 0, ..target };
            let pair = PairOnMotion { term, target };
            if !self.stays_clear(way, scene, &pair, rate, trust)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether one obstacle's distance, which falls by no more than `rate` on the way from a scene, stays above 0.
    fn stays_clear(
        &mut self,
        way: &LinearMotion,
        start: &Scene,
        obstacle: &impl Obstacle,
        rate: f64,
        trust: &TouchAllowance,
    ) -> Result<bool> {
        // What rests may be as near as it likes.
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
        let plane = obstacle.separation(self, way, start);
        if plane.as_ref().is_some_and(Separation::lasts) {
            return Ok(true);
        }
        if lower > 0.0 {
            return self.advances(way, obstacle, rate, STEP_FRACTION * lower / rate);
        }
        // What stays behind a plane and does not move towards it cannot come nearer, however far it slides.
        let is_level = |plane: &Separation| {
            plane.gap >= -trust.allowed() && plane.rate <= LEVEL * trust.distance
        };
        let nearer = plane.filter(is_level).map_or(rate, |plane| plane.rate);
        let share = if nearer > trust.distance {
            trust.distance / nearer
        } else {
            1.0
        };
        if !self.keeps_off(way, obstacle, start, share, trust)? {
            return Ok(false);
        }
        Ok(share == 1.0 || self.advances(way, obstacle, rate, share)?)
    }

    /// Whether an obstacle's distance stays above 0 from parameter `start` on: conservative advancement.
    fn advances(
        &mut self,
        way: &LinearMotion,
        obstacle: &impl Obstacle,
        rate: f64,
        start: f64,
    ) -> Result<bool> {
        let mut t = start;
        for _ in 0..MAX_DISTANCES {
            let at = way.at(t);
            let scene = &way.scene(&at)?;
            let rest = rate * (1.0 - t) / STEP_FRACTION;
            // A limit of 0 would make any bound 0.
            let lower = obstacle.lower(self, scene, rest.max(f64::MIN_POSITIVE))?;
            if lower <= 0.0 || lower >= rest {
                return Ok(lower > 0.0);
            }
            // Up to the next parameter the distance cannot have fallen to 0.
            t = (t + STEP_FRACTION * lower / rate).min(1.0);
        }
        Ok(false)
    }

    /// Whether the contacts at a touching start say that no witness comes nearer up to parameter `share`.
    fn keeps_off(
        &mut self,
        way: &LinearMotion,
        obstacle: &impl Obstacle,
        scene: &Scene,
        share: f64,
        trust: &TouchAllowance,
    ) -> Result<bool> {
        let listed = WitnessRequest {
            // What is farther cannot come to touch.
            with_gradients: true,
            counts_doubt: true,
            ..WitnessRequest::within(trust.distance / STEP_FRACTION, trust.max_count)
        };
        let list = obstacle.witnesses(self, scene, listed)?;
        let keeps_off =
            |a: &Approach| a.clearance + share * dot(a.gradient, way.v) >= -trust.allowed();
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
        listed: WitnessRequest,
    ) -> Result<WitnessList> {
        let Some(target) = self.at(scene) else {
            // Nothing is known of a pair that is not there.
            return Ok(WitnessList {
                truncated: true,
                ..WitnessList::default()
            });
        };
        context.list(self.term, scene, &[target], listed)
    }

    fn separation(
        &self,
        context: &mut QueryContext,
        way: &LinearMotion,
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
            rate: way.directed_rate(scene, link, target.sides[0], &normal)?,
        })
    }
}

impl PairOnMotion<'_> {
    /// The pair where the robot is now.
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
        listed: WitnessRequest,
    ) -> Result<WitnessList> {
        pure_witnesses(&[(self, false)], scene, listed)
    }

    /// A floor is such a plane.
    fn separation(
        &self,
        _: &mut QueryContext,
        way: &LinearMotion,
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
            rate: way.directed_rate(scene, link, scene.link(link)?, normal)?,
        })
    }
}

impl<'a> LinearMotion<'a> {
    pub(super) fn at(&self, t: f64) -> Vec<f64> {
        let way: Vec<f64> = self.v.iter().map(|x| x * t).collect();
        self.cobject.space().step(self.q, &way)
    }

    pub(super) fn scene<'s>(&'s self, q: &'s [f64]) -> Result<Scene<'s>> {
        Scene::new(
            self.cobject.space(),
            self.world,
            Configuration::Coordinates(q),
            SceneMemory::default(),
        )
    }

    /// Whether every joint that the way moves, and that changes some distance, states its speeds.
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

    /// No distance of a pair of the set changes by more than this; `None` where none changes.
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
                // What is attached is an s-object to the other links, and moves.
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

    /// What a link carries moves no farther than this along a direction of the world on the way from a scene.
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

    /// The distance of a pair changes by no more than this: by the motion of its bodies relative to each other.
    fn rate(&self, scene: &Scene, target: &Target) -> f64 {
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

/// How far a link's body, or what the link holds, is from the link's origin, at most.
fn extent(scene: &Scene, link: usize, (body, pose): Placement) -> f64 {
    (pose.translation - scene.poses()[link].translation).norm() + body.radius_from_origin()
}

/// The pure sets of a union, or the set itself if it is one.
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

/// The links of a space that hold s-objects of an environment, and how far these radius from the links' origins.
fn extents_of_held(world: &World, environment: &Environment, space: &Space) -> Vec<(usize, f64)> {
    let attached = world.snapshot(environment).map(|now| now.attached());
    let extent = |object: &SObject| {
        let attachment = object.attachment.as_ref()?;
        let radius = object.pose.translation.norm() + object.body.radius_from_origin();
        (attachment.space == space.serial()).then_some((attachment.link, radius))
    };
    attached.into_iter().flatten().filter_map(extent).collect()
}
