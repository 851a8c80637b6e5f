//! Which pairs of links a self-collision set should test: not those joined, those that touch at rest, or those that hardly
//! ever part.

use super::context::QueryContext;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::robot::JointKind;
use crate::space::{Sampler, Space};

/// How pairs of links are judged.
#[derive(Clone, Debug)]
pub struct LinkPairOptions {
    /// So many configurations are drawn from the space.
    pub samples: usize,
    /// Decides which.
    pub seed: u64,
    /// The configuration at rest; none stands for all at 0, clamped to the ranges.
    pub rest: Option<Vec<f64>>,
    /// Links at most this far apart touch.
    pub margin: f64,
    /// Pairs that touch in this share of the samples, or more, always touch.
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

/// What was found out about a pair of links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairVerdict {
    /// It is to be tested: it touched in some samples, or the links are of different robots.
    Test,
    /// Joined, with no link that has a body in between; or fixed to each other.
    Adjacent,
    /// The links touch at rest.
    AtRest,
    /// The links touch in all samples, or nearly.
    Always,
    /// The links touched in no sample. That is no proof that they cannot.
    Never,
}

/// A pair of links that have bodies, the lower number first.
#[derive(Clone, Copy, Debug)]
pub struct LinkPair {
    pub links: [usize; 2],
    /// The robots that the two are of.
    pub robots: [usize; 2],
    pub verdict: PairVerdict,
    /// The share of the samples in which the two touch; 0 where the verdict needed none.
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

const MAX_SAMPLES: usize = 1 << 30;

impl QueryContext {
    /// Judges all pairs of links that have bodies, in order of their numbers. Coordinates without bounds stay at rest.
    /// `progress` hears the fraction done and may end the work with an error.
    pub fn link_pairs(
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
        let mut pairs = structure(space)?;
        let is_own =
            |pair: &LinkPair| space.robot_of(pair.links[0]) == space.robot_of(pair.links[1]);
        self.touch(space, &rest, options.margin, &mut pairs, |pair| {
            if is_own(pair) {
                pair.verdict = PairVerdict::AtRest;
            }
        })?;
        let mut sampler = Sampler(options.seed);
        for sample in 0..options.samples {
            if sample % 64 == 0 {
                progress(sample as f64 / options.samples as f64)?;
            }
            let q = space.sample_beside(&mut sampler, &rest);
            self.touch(space, &q, options.margin, &mut pairs, |pair| {
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

    /// Tells of each pair that is to be tested and touches at q.
    fn touch(
        &mut self,
        space: &Space,
        q: &[f64],
        margin: f64,
        pairs: &mut [LinkPair],
        mut tell: impl FnMut(&mut LinkPair),
    ) -> Result<()> {
        let poses = space.link_poses(q)?;
        for pair in pairs.iter_mut().filter(|p| p.verdict == PairVerdict::Test) {
            let [a, b] = pair
                .links
                .map(|link| space.link(link).and_then(|l| l.body.as_deref()));
            let (Some(a), Some(b)) = (a, b) else {
                continue;
            };
            let [at_a, at_b] = pair.links.map(|link| &poses[link]);
            if self.bodies_within((a, at_a), (b, at_b), margin)? {
                tell(pair);
            }
        }
        Ok(())
    }
}

/// All pairs of links with bodies, those that are adjacent marked.
fn structure(space: &Space) -> Result<Vec<LinkPair>> {
    let has_body = |&link: &usize| space.link(link).is_some_and(|l| l.body.is_some());
    let links: Vec<usize> = (0..space.link_count()).filter(has_body).collect();
    if links.is_empty() {
        return Err(Error::new(
            ErrorKind::Empty,
            "no link of the space has a body",
        ));
    }
    // Links without a body hang together in parts, which the lowest of each names.
    let mut part: Vec<usize> = (0..space.link_count()).collect();
    for link in 0..space.link_count() {
        let parent = space.parent(link).filter(|parent| !has_body(parent));
        if let Some(parent) = parent.filter(|_| !has_body(&link)) {
            part[link] = part[parent];
        }
    }
    // What a link stands on: a link with a body, or a part without one, which stands on a link itself, or on nothing.
    let below = |link: usize| space.parent(link).map(|parent| part[parent]);
    let are_joined = |r: usize, s: usize| {
        let stands_on = |s: usize, r: usize| {
            let next = below(s);
            next == Some(r) || next.is_some_and(|next| !has_body(&next) && below(next) == Some(r))
        };
        let shared = below(r).filter(|next| !has_body(next) && below(s) == Some(*next));
        stands_on(r, s) || stands_on(s, r) || shared.is_some()
    };
    // Links that are fixed to each other move as one, which the lowest of them stands for.
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
            verdict: if are_joined(r, s) || lowest[r] == lowest[s] {
                PairVerdict::Adjacent
            } else {
                PairVerdict::Test
            },
            share: 0.0,
        })
    });
    Ok(pairs.collect())
}
