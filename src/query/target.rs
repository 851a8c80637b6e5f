//! A body pair as the target of a search.

use std::cmp::Ordering;

use super::answer::SSide;
use super::cache_key::{CacheKey, PairIds};
use crate::body::Body;
use crate::cobject::InducedOptions;
use crate::pair::Pairing;
use crate::pose::Pose;

/// A body at a pose.
pub type Placement<'a> = (&'a Body, &'a Pose);

/// A body pair with the properties that its C-object gives it.
#[derive(Clone, Copy)]
pub(crate) struct Target<'a> {
    pub sides: [Placement<'a>; 2],
    pub key: CacheKey,
    pub options: InducedOptions,
    /// The user data of the two sides, or 0.
    pub data: [usize; 2],
    /// The link that the s-object is attached to, if any.
    pub s_carrier: Option<usize>,
    /// The number of the induced set in its group.
    pub term: u32,
    /// The position in order of ids among all targets of a search: hits name their pair by it.
    pub rank: u32,
    /// A safe lower bound of the distance less the margin.
    pub bound: f64,
}

/// Who the two sides of a body pair are, as witnesses tell it.
#[derive(Clone, Copy)]
pub(crate) struct Parties<'a> {
    pub bodies: [&'a Body; 2],
    pub r_link: usize,
    /// The attached object that is the r-side, or 0.
    pub r_object: u64,
    /// The link that the s-object is attached to, if any.
    pub s_carrier: Option<usize>,
    pub s_side: SSide,
    /// The user data of the two sides, or 0.
    pub data: [usize; 2],
}

impl<'a> Parties<'a> {
    /// Two bodies without a robot.
    #[inline(always)]
    pub fn of_bodies(bodies: [&'a Body; 2]) -> Self {
        Self {
            bodies,
            r_link: 0,
            r_object: 0,
            s_carrier: None,
            s_side: SSide::Object(0),
            data: bodies.map(Body::data),
        }
    }

    /// The tags of two primitives, one of each body.
    #[inline(always)]
    pub fn tags(&self, [on_a, on_b]: [u32; 2]) -> [u64; 2] {
        let [a, b] = self.bodies;
        [a.tag(on_a), b.tag(on_b)]
    }

    /// The parts of the bodies that two primitives belong to, one of each body.
    #[inline(always)]
    pub fn parts(&self, [on_a, on_b]: [u32; 2]) -> [Option<u32>; 2] {
        let [a, b] = self.bodies;
        [a.part_of(on_a), b.part_of(on_b)]
    }
}

impl<'a> Target<'a> {
    #[inline(always)]
    pub fn ids(&self) -> PairIds {
        self.key.ids()
    }

    /// An order of pairs with the same ids, by their bodies and where these are.
    pub fn order_of_states(&self, other: &Self) -> Ordering {
        let sides = self.sides.iter().zip(&other.sides);
        let orders = sides.map(|((a, pose_a), (b, pose_b))| {
            let order = a.serial().cmp(&b.serial());
            order.then_with(|| pose_a.order(pose_b))
        });
        orders.fold(Ordering::Equal, Ordering::then)
    }

    /// The link that moves the r-side, and the one that moves the s-side, if one does.
    pub fn links(&self) -> (usize, Option<usize>) {
        let (r_link, _, s_side) = self.ids();
        (r_link, s_side.link().or(self.s_carrier))
    }

    /// Who its two sides are.
    #[inline(always)]
    pub fn parties(&self) -> Parties<'a> {
        let (r_link, r_object, s_side) = self.ids();
        Parties {
            bodies: self.sides.map(|(body, _)| body),
            r_link,
            r_object,
            s_carrier: self.s_carrier,
            s_side,
            data: self.data,
        }
    }

    /// How far both bodies together may be from what they stand for.
    #[inline(always)]
    pub fn stated_deviation(&self) -> f64 {
        let [(a, _), (b, _)] = self.sides;
        a.stated_deviation() + b.stated_deviation()
    }

    /// What is subtracted from the distance: the margin of the C-object, and the stated deviations. The bodies grown by these
    /// hold what they stand for, so that whatever is proved apart is so. Only upper bounds need more (see `Distance::of_pair`).
    #[inline(always)]
    pub fn margin(&self) -> f64 {
        self.options.margin + self.stated_deviation()
    }

    /// Whether the trees of both bodies are a node each, or a leaf: a walk is then no dearer than the primitives that it comes to.
    #[inline(always)]
    pub fn is_walked_at_once(&self) -> bool {
        let is_small = |(body, _): &Placement| body.packed().nodes().len() <= 2;
        self.sides.iter().all(is_small)
    }

    /// Both bodies in one frame. Made on demand: most targets turn out to be too far.
    #[inline(always)]
    pub fn pairing(&self) -> Pairing<'a> {
        let [a, b] = self.sides;
        Pairing::new(a.0, a.1, b.0, b.1)
    }

    /// The same, or `None` if the bounding spheres are more than `limit` apart, less what is subtracted from the distance.
    pub fn pairing_within(&self, limit: f64) -> Option<Pairing<'a>> {
        if self.bound > limit {
            return None;
        }
        let pairing = self.pairing();
        (pairing.sphere_bound() - self.margin() <= limit).then_some(pairing)
    }
}
