//! A proof that a way of constant velocity through C-space is free, by distances and motion bounds (Quinlan 1994, ch. 4).

use super::context::QueryContext;
use super::half_spaces::dot;
use super::scene::Configuration;
use super::world::World;
use crate::cobject::{BodyPairs, CObject, PureShape, Set};
use crate::environment::{Environment, SObject};
use crate::error::Result;

/// So many distances may be computed for one proof; a way that needs more counts as not free.
const MOST_DISTANCES: usize = 400;

/// The part of the distance that a step uses up: the rest covers the rounding of kinematics and motion bounds.
const STEP_FRACTION: f64 = 0.99;

impl QueryContext {
    /// Whether the robot keeps clear of the C-object on the way from q with velocity v for a unit of time, from parameter
    /// `start` on. `false` may also mean that it comes too near for a proof of reasonable length.
    pub(super) fn way_is_free(
        &mut self,
        world: &World,
        cobject: &CObject,
        q: &[f64],
        v: &[f64],
        start: f64,
    ) -> Result<bool> {
        let motion = motion_bound(world, cobject, q, v);
        if motion.is_infinite() {
            return Ok(false);
        }
        // What rests may be as near as it likes.
        let space = cobject.space();
        let moves = |link: usize| space.reach_motion_bound(link, 1.0, q, v) > 0.0;
        let Some(cobject) = &cobject.moving(moves) else {
            return Ok(true);
        };
        let mut t = start;
        for _ in 0..MOST_DISTANCES {
            let way: Vec<f64> = v.iter().map(|x| x * t).collect();
            let at = cobject.space().step(q, &way);
            let at = Configuration::Coordinates(&at);
            let here = self.distance_in(world, cobject, at, f64::INFINITY)?;
            if here.lower <= 0.0 {
                return Ok(false);
            }
            if t == 1.0 {
                return Ok(true);
            }
            // Up to the next parameter no distance can have fallen to 0.
            t = (t + STEP_FRACTION * here.lower / motion).min(1.0);
        }
        Ok(false)
    }
}

/// No distance of the C-object changes by more than this on the way. Infinite where a joint does not state its speeds, and
/// where a set is no union of induced sets and of pure ones.
pub(super) fn motion_bound(world: &World, cobject: &CObject, q: &[f64], v: &[f64]) -> f64 {
    let Set::Union { induced, others } = cobject.set() else {
        return pure_motion_bound(cobject, q, v);
    };
    let space = cobject.space();
    let of_pairs = induced.iter().map(|term| match &term.pairs {
        BodyPairs::Objects { links, objects, .. } => {
            let held = reaches_of_held(world, objects.environment());
            let of_link = |link: usize| {
                let held = held.iter().filter(|(holder, _)| *holder == link);
                let held = held.map(|(_, reach)| space.reach_motion_bound(link, *reach, q, v));
                held.fold(space.motion_bound(link, q, v), f64::max)
            };
            let of_links = links.iter().map(|&link| of_link(link));
            // What is attached is an s-object to the other links, and moves.
            let of_carriers = held.iter().map(|(holder, _)| of_link(*holder));
            of_links.fold(0.0, f64::max) + of_carriers.fold(0.0, f64::max)
        }
        BodyPairs::Links { pairs } => {
            let of_link = |link: usize| space.motion_bound(link, q, v);
            let of_pair = |pair: &[usize; 2]| of_link(pair[0]) + of_link(pair[1]);
            pairs.iter().map(of_pair).fold(0.0, f64::max)
        }
    });
    let of_others = others.iter().map(|other| pure_motion_bound(other, q, v));
    of_pairs.chain(of_others).fold(0.0, f64::max)
}

/// The links that hold s-objects of an environment, and how far these reach from the links' origins.
fn reaches_of_held(world: &World, environment: &Environment) -> Vec<(usize, f64)> {
    let attached = world.snapshot(environment).map(|now| now.attached());
    let reach = |object: &SObject| {
        let link = object.attachment.as_ref()?.link;
        Some((link, object.pose.translation.norm() + object.body.reach()))
    };
    attached.into_iter().flatten().filter_map(reach).collect()
}

/// A distance in C-space changes by no more than the way is long.
fn pure_motion_bound(cobject: &CObject, q: &[f64], v: &[f64]) -> f64 {
    let Set::Pure(pure) = cobject.set() else {
        return f64::INFINITY;
    };
    match pure.shape {
        PureShape::Predicate(_) => f64::INFINITY,
        PureShape::Floor { ref links, .. } => {
            let space = cobject.space();
            let links = links.iter().map(|&link| space.motion_bound(link, q, v));
            links.fold(0.0, f64::max)
        }
        PureShape::BeyondWorld { ref links } => {
            let space = cobject.space();
            links
                .iter()
                .map(|&link| space.reach_motion_bound(link, 0.0, q, v))
                .fold(0.0, f64::max)
        }
        _ => pure.options.scale.unwrap_or(1.0) * dot(v, v).sqrt(),
    }
}
