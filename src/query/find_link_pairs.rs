//! Finds the link pairs that self-collision should test: leaves out adjacent links, links that touch at rest, and links
//! that touch in (almost) all configurations.

use super::context::QueryContext;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::robot::JointKind;
use crate::room::room_for;
use crate::space::{Sampler, Space};

/// Options of the search for link pairs.
#[derive(Clone, Debug)]
pub struct LinkPairOptions {
    /// The number of configurations sampled.
    pub samples: usize,
    /// The seed of the sampling.
    pub seed: u64,
    /// The configuration at rest; `None` for all coordinates 0, clamped to the ranges.
    pub rest: Option<Vec<f64>>,
    /// Links within this distance count as touching.
    pub margin: f64,
    /// Pairs that touch in at least this fraction of the samples count as always touching.
    pub always: f64,
}

impl Default for LinkPairOptions {
    fn default() -> Self {
        Self {
            samples: 1000,
            seed: 0,
            rest: None,
            margin: 0.0,
            always: 0.95,
        }
    }
}

/// The verdict on a pair of links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairVerdict {
    /// The pair should be tested: it touched in some samples, or belongs to different robots.
    Test,
    /// The links are joined, with no body in between, or fixed to each other.
    Adjacent,
    /// The links touch at rest.
    AtRest,
    /// The links touch in all samples, or almost all.
    Always,
    /// The links touch in no sample. This does not prove that they cannot.
    Never,
    /// The robot's SRDF file rules the pair out.
    Disabled,
}

/// A pair of links with bodies, the lower number first.
#[derive(Clone, Copy, Debug)]
pub struct LinkPair {
    /// The links, by number in the space.
    pub links: [usize; 2],
    /// The robots that the links belong to.
    pub robots: [usize; 2],
    /// Whether to test the pair, or why not.
    pub verdict: PairVerdict,
    /// The fraction of the samples in which the links touch; 0 where the verdict needed no samples.
    pub share: f64,
}

impl LinkPairOptions {
    fn check(&self) -> Result<()> {
        require_finite(&[self.margin], "margin")?;
        if self.margin < 0.0 {
            return Err(Error::invalid(format!(
                "margin is negative: {}",
                self.margin
            )));
        }
        if !(self.always > 0.0 && self.always <= 1.0) {
            return Err(Error::invalid(format!(
                "always is {}, not a share above 0 and up to 1",
                self.always
            )));
        }
        if self.samples == 0 || self.samples > MAX_SAMPLES {
            return Err(Error::invalid(format!(
                "samples is {}, not from 1 to {MAX_SAMPLES}",
                self.samples
            )));
        }
        Ok(())
    }
}

/// The most samples accepted.
const MAX_SAMPLES: usize = 1 << 30;

/// So many pairs are looked at without asking whether to go on.
const PAIRS_BETWEEN_ASKING: usize = 4096;

impl QueryContext {
    /// Gives a verdict on all pairs of links with bodies, in order of their numbers. Coordinates without bounds stay at
    /// rest. `progress` receives the fraction done and may stop the work with an error.
    pub fn find_link_pairs(
        &mut self,
        space: &Space,
        options: &LinkPairOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<Vec<LinkPair>> {
        options.check()?;
        self.scratch.meter_mut().start_call();
        let rest = match &options.rest {
            Some(rest) => {
                space
                    .check_configuration(rest)
                    .map_err(|e| e.within("rest"))?;
                rest.clone()
            }
            None => space.clamp(&space.neutral()),
        };
        progress(0.0)?;
        let mut pairs = structure(space)?;
        let is_own =
            |pair: &LinkPair| space.robot_of(pair.links[0]) == space.robot_of(pair.links[1]);
        let ask = &mut || progress(0.0);
        self.touch(space, &rest, options.margin, &mut pairs, ask, |pair| {
            if is_own(pair) {
                pair.verdict = PairVerdict::AtRest;
            }
        })?;
        let mut sampler = Sampler(options.seed);
        for sample in 0..options.samples {
            let done = sample as f64 / options.samples as f64;
            if sample % 64 == 0 {
                progress(done)?;
            }
            let q = space.sample_beside(&mut sampler, &rest);
            let ask = &mut || progress(done);
            self.touch(space, &q, options.margin, &mut pairs, ask, |pair| {
                pair.share += 1.0
            })?;
        }
        for pair in &mut pairs {
            pair.share /= options.samples as f64;
            if pair.verdict == PairVerdict::Test && is_own(pair) {
                if pair.share >= options.always {
                    pair.verdict = PairVerdict::Always;
                } else if pair.share == 0.0 {
                    pair.verdict = PairVerdict::Never;
                }
            }
        }
        progress(1.0)?;
        Ok(pairs)
    }

    /// Calls `on_touch` for each pair with verdict `Test` that touches at q. `ask`, which may stop the work with an error, is asked
    /// after every so many pairs.
    fn touch(
        &mut self,
        space: &Space,
        q: &[f64],
        margin: f64,
        pairs: &mut [LinkPair],
        ask: &mut dyn FnMut() -> Result<()>,
        mut on_touch: impl FnMut(&mut LinkPair),
    ) -> Result<()> {
        let poses = space.link_poses(q)?;
        let tested = pairs.iter_mut().filter(|p| p.verdict == PairVerdict::Test);
        for (number, pair) in (1..).zip(tested) {
            if number % PAIRS_BETWEEN_ASKING == 0 {
                ask()?;
            }
            let [a, b] = pair.links.map(|link| space.body(link));
            let (Some(a), Some(b)) = (a, b) else {
                continue;
            };
            let [at_a, at_b] = pair.links.map(|link| &poses[link]);
            if self.bodies_within((a, at_a), (b, at_b), margin)? {
                on_touch(pair);
            }
        }
        Ok(())
    }
}

/// All pairs of links with bodies, with those marked that are ruled out or adjacent.
fn structure(space: &Space) -> Result<Vec<LinkPair>> {
    let links = space.bodies().carriers();
    let has_body = |&link: &usize| space.body(link).is_some();
    if links.is_empty() {
        return Err(Error::new(
            ErrorKind::Empty,
            "no link of the space has a body",
        ));
    }
    // Connected links without a body form one part, named by its lowest link.
    let mut part: Vec<usize> = (0..space.link_count()).collect();
    for link in 0..space.link_count() {
        let parent = space.parent(link).filter(|parent| !has_body(parent));
        if let Some(parent) = parent.filter(|_| !has_body(&link)) {
            part[link] = part[parent];
        }
    }
    // What a link is joined to: a link with a body, or a part without bodies, which is itself joined to a link or to the
    // world.
    let below = |link: usize| space.parent(link).map(|parent| part[parent]);
    let are_joined = |r: usize, s: usize| {
        let stands_on = |s: usize, r: usize| {
            let next = below(s);
            next == Some(r) || next.is_some_and(|next| !has_body(&next) && below(next) == Some(r))
        };
        let shared = below(r).filter(|next| !has_body(next) && below(s) == Some(*next));
        stands_on(r, s) || stands_on(s, r) || shared.is_some()
    };
    // Links fixed to each other move as one; the lowest of them stands for all.
    let mut lowest: Vec<usize> = (0..space.link_count()).collect();
    for link in 0..space.link_count() {
        let is_fixed = space
            .link(link)
            .is_some_and(|l| matches!(l.joint.kind, JointKind::Fixed));
        if let Some(parent) = space.parent(link).filter(|_| is_fixed) {
            lowest[link] = lowest[parent];
        }
    }
    let pairs = links.iter().enumerate().flat_map(|(i, &r)| {
        let lowest = &lowest;
        let are_joined = &are_joined;
        links[i + 1..].iter().map(move |&s| LinkPair {
            links: [r, s],
            robots: [r, s].map(|link| space.robot_of(link)),
            verdict: if space.is_pair_disabled([r, s]) {
                PairVerdict::Disabled
            } else if are_joined(r, s) || lowest[r] == lowest[s] {
                PairVerdict::Adjacent
            } else {
                PairVerdict::Test
            },
            share: 0.0,
        })
    });
    let mut all = room_for(links.len() * (links.len() - 1) / 2)?;
    all.extend(pairs);
    Ok(all)
}
