//! How fast the bodies of pairs move as the other one sees them.

use super::carried::Carried;
use crate::robot::{
    ChainRates, ChainRounding, LinkMotions, LinkSpeed, LinkSpeeds, MotionRates, RatesFrom,
    RatesMemory,
};

/// How fast bodies move as others see them, found for one pair after the other. It is quickest where pairs follow each other that have
/// the same A and Bs that rest, or Bs of the same link.
pub(super) struct PairRates<'a> {
    /// Of all links.
    pub speeds: LinkSpeeds<'a>,
    in_world: RatesFrom<'a>,
    /// As the link sees it that carried B last.
    on_link: RatesFrom<'a>,
    /// The body asked for last, by its number, as the world sees it.
    last_body: Option<(usize, MotionRates)>,
}

/// Memory of [`PairRates`].
#[derive(Default)]
pub(super) struct PairRatesMemory {
    speeds: Vec<LinkSpeed>,
    in_world: RatesMemory,
    on_link: RatesMemory,
}

impl<'a> PairRates<'a> {
    pub fn new(motions: &'a LinkMotions) -> Self {
        Self::in_memory(motions, PairRatesMemory::default())
    }

    /// The same, in memory that is used again.
    pub fn in_memory(motions: &'a LinkMotions, memory: PairRatesMemory) -> Self {
        Self {
            speeds: LinkSpeeds::in_memory(motions, memory.speeds),
            in_world: RatesFrom::in_memory(motions, None, memory.in_world),
            on_link: RatesFrom::in_memory(motions, None, memory.on_link),
            last_body: None,
        }
    }

    pub fn into_memory(self) -> PairRatesMemory {
        PairRatesMemory {
            speeds: self.speeds.into_memory(),
            in_world: self.in_world.into_memory(),
            on_link: self.on_link.into_memory(),
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
                    rates.rounding.take_in(&self.speeds.of(link).rounding);
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
        &self,
        a: &Carried<usize>,
        b: &Carried<Option<usize>>,
    ) -> ChainRounding {
        let mut rounding = ChainRounding::default();
        for link in std::iter::once(a.link).chain(b.link) {
            rounding.take_in(&self.speeds.of(link).rounding);
        }
        for pose in [a.pose, b.pose].into_iter().flatten() {
            rounding.size += pose.translation.norm();
        }
        rounding
    }

    /// The derivatives of a body's centre in the world; `None` where a custom joint moves it.
    pub fn of_body(&mut self, body: &Carried<usize>) -> Option<MotionRates> {
        if let Some((number, rates)) = self.last_body
            && number == body.number
        {
            return Some(rates);
        }
        let rates = at_center(self.in_world.of(body.link)?, body);
        self.last_body = Some((body.number, rates));
        Some(rates)
    }
}

/// Goes on from a link's frame to the centre of a body that it carries.
fn at_center(chain: &ChainRates, body: &Carried<usize>) -> MotionRates {
    let mut rates = chain.at(&body.center());
    // The centre's place is the sum of two vectors, which are together at most this much longer than it.
    rates.rounding.size += body.pose.map_or(0.0, |pose| 2.0 * pose.translation.norm());
    rates
}
