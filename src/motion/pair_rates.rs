//! How fast the bodies of pairs move as the other one sees them.

use super::carried::Carried;
use crate::pose::Pose;
use crate::robot::{ChainRates, ChainRounding, LinkMotions, MotionRates, RatesFrom};

/// How fast bodies move as others see them, found for one pair after the other. It is quickest where pairs follow each other that have
/// the same A and Bs that rest, or Bs of the same link.
pub(super) struct PairRates<'a> {
    motions: &'a LinkMotions,
    in_world: RatesFrom<'a>,
    /// As the link sees it that carried B last.
    on_link: RatesFrom<'a>,
    /// As the world sees them, by the bodies' numbers.
    of_bodies: Vec<Option<MotionRates>>,
}

impl<'a> PairRates<'a> {
    pub fn new(motions: &'a LinkMotions) -> Self {
        Self {
            motions,
            in_world: RatesFrom::new(motions, None),
            on_link: RatesFrom::new(motions, None),
            of_bodies: vec![None; motions.len()],
        }
    }

    /// The derivatives of A's centre as B sees it; `None` where a custom joint moves between them.
    pub fn between(
        &mut self,
        a: &Carried<usize>,
        b: &Carried<Option<usize>>,
    ) -> Option<MotionRates> {
        let mut rates = match b.link {
            None => self.of_body(a)?,
            Some(from) => {
                if self.on_link.from() != Some(from) {
                    self.on_link.look_from(Some(from));
                }
                let mut rates = at_center(self.on_link.of(a.link)?, a);
                for link in [from, a.link] {
                    let in_world = self.in_world.of_known_joints(link).rates;
                    rates.rounding.take_in(&in_world.rounding);
                }
                rates
            }
        };
        // Poses are computed in the world, and rounded relative to where they are there.
        rates.rounding.size += b.pose.map_or(0.0, |pose| pose.translation.norm());
        Some(rates)
    }

    /// What the rounding of both bodies' places comes from, but for the custom joints that move.
    pub fn rounding_of_known_joints(
        &mut self,
        a: &Carried<usize>,
        b: &Carried<Option<usize>>,
    ) -> ChainRounding {
        let mut rounding = ChainRounding::default();
        for link in std::iter::once(a.link).chain(b.link) {
            rounding.take_in(&self.in_world.of_known_joints(link).rates.rounding);
        }
        for pose in [a.pose, b.pose].into_iter().flatten() {
            rounding.size += pose.translation.norm();
        }
        rounding
    }

    /// What the rounding of a link's place comes from, given the poses of all links.
    pub fn rounding_of_link(&mut self, link: usize, poses: &[Pose]) -> ChainRounding {
        let mut rounding = self.in_world.of_known_joints(link).rates.rounding;
        rounding.size += self
            .motions
            .lengths_of_unknown_joints(link, |link| &poses[link]);
        rounding
    }

    /// The derivatives of a body's centre in the world; `None` where a custom joint moves it.
    pub fn of_body(&mut self, body: &Carried<usize>) -> Option<MotionRates> {
        if self.of_bodies.len() <= body.number {
            self.of_bodies.resize(body.number + 1, None);
        }
        let known = &mut self.of_bodies[body.number];
        if known.is_none() {
            *known = Some(at_center(self.in_world.of(body.link)?, body));
        }
        *known
    }
}

/// Goes on from a link's frame to the centre of a body that it carries.
fn at_center(chain: &ChainRates, body: &Carried<usize>) -> MotionRates {
    let mut rates = chain.at(&body.center());
    // The centre's place is the sum of two vectors, which are together at most this much longer than it.
    rates.rounding.size += body.pose.map_or(0.0, |pose| 2.0 * pose.translation.norm());
    rates
}
