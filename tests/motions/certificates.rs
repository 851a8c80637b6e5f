//! Certificates of free motions: those that are found hold at all samples, and are of all body pairs.

use std::collections::HashSet;

use cstk::certificate::Certificate;
use cstk::cobject::{CObject, Class};
use cstk::error::ErrorKind;
use cstk::motion::{MotionOptions, MotionOutcome};
use cstk::query::{Configuration, QueryContext, SSide};

use helpers::random::Random;

use super::compound::{arm, compound};
use super::random_scenes::{at, class, scene};

/// A motion of a C-object.
pub struct Drawn {
    pub cobject: CObject,
    pub q0: Vec<f64>,
    pub q1: Vec<f64>,
}

impl Drawn {
    /// Among random robots and obstacles.
    pub fn new(random: &mut Random) -> Self {
        let cobject = scene(random);
        let space = cobject.space().clone();
        let drawn = |random: &mut Random, size: f64| -> Vec<f64> {
            (0..space.nv())
                .map(|_| random.within(-size, size))
                .collect()
        };
        let q0 = space.step(&space.neutral(), &drawn(random, 2.0));
        let size = [0.05, 0.3, 1.0, 3.0][random.below(4)];
        let q1 = space.step(&q0, &drawn(random, size));
        Self { cobject, q0, q1 }
    }

    pub fn certified(&self, threshold: f64) -> (MotionOutcome, Option<Certificate>) {
        let options = MotionOptions {
            threshold,
            ..MotionOptions::default()
        };
        let context = &mut QueryContext::new();
        let found = context.motion_certificate(&self.cobject, &self.q0, &self.q1, &options);
        let (answer, certificate) = found.unwrap();
        assert_eq!(certificate.is_some(), answer.outcome == MotionOutcome::Free);
        (answer.outcome, certificate)
    }

    pub fn accepts(&self, certificate: &Certificate) -> bool {
        let threshold = certificate.threshold();
        match certificate.verify(&self.cobject, &self.q0, &self.q1, threshold) {
            Ok(()) => true,
            Err(error) => {
                assert_eq!(error.kind, ErrorKind::NotProved, "{error}");
                false
            }
        }
    }

    /// The configuration at a time.
    pub fn at(&self, t: f64) -> Vec<f64> {
        self.cobject.space().interpolate(&self.q0, &self.q1, t)
    }
}

/// `CSTK_CERTIFICATES=20000 cargo test --release --test motions certificates_of -- --nocapture` runs a campaign with 10,000 samples
/// each.
#[test]
fn certificates_of_random_motions_are_accepted_and_no_sample_contradicts() {
    let campaign: Option<usize> = std::env::var("CSTK_CERTIFICATES")
        .ok()
        .map(|n| n.parse().unwrap());
    let (count, samples) = campaign.map_or((600, 100), |count| (count, 10_000));
    let mut random = Random::new(1901);
    let context = &mut QueryContext::new();
    let (mut free, mut certified, mut entries) = (0, 0, 0);
    for round in 0..count {
        let drawn = Drawn::new(&mut random);
        let threshold = [0.0, 0.01][random.below(2)];
        let options = MotionOptions {
            threshold,
            ..MotionOptions::default()
        };
        let plain = context.motion(&drawn.cobject, &drawn.q0, &drawn.q1, &options);
        let plain = plain.unwrap().outcome;
        let (outcome, certificate) = drawn.certified(threshold);
        free += usize::from(plain == MotionOutcome::Free);
        let Some(certificate) = certificate else {
            assert!(
                outcome == plain || outcome == MotionOutcome::Near,
                "round {round}"
            );
            continue;
        };
        assert_eq!(plain, MotionOutcome::Free);
        certified += 1;
        entries += certificate.entries().len();
        let verified = certificate.verify(&drawn.cobject, &drawn.q0, &drawn.q1, threshold);
        verified.unwrap_or_else(|error| panic!("round {round}: {error}"));
        let again = Certificate::from_bytes(&certificate.to_bytes()).unwrap();
        assert_eq!(again, certificate);
        for i in 0..samples {
            let t = match i {
                0 => 0.0,
                1 => 1.0,
                _ => random.within(0.0, 1.0),
            };
            let q = drawn.at(t);
            let found = class(context, &drawn.cobject, &q);
            assert_ne!(found, Class::Inside, "round {round}: at {t}");
            let near = context.within(&drawn.cobject, Configuration::Coordinates(&q), threshold);
            assert!(threshold == 0.0 || !near.unwrap(), "round {round}: at {t}");
        }
    }
    println!("{free} free, {certified} certified, {entries} entries");
    assert!(free > count / 10 && certified * 100 >= free * 99);
}

/// The search for certificates, without the proof of motions before it, agrees with that: it finds none of motions that hit, and of those
/// that are free it misses next to none.
#[test]
fn certificates_are_found_of_free_motions_and_of_no_others() {
    let mut random = Random::new(1951);
    let context = &mut QueryContext::new();
    let mut found = [[0; 2]; 4];
    for round in 0..600 {
        let drawn = Drawn::new(&mut random);
        let (cobject, q0, q1) = (&drawn.cobject, &drawn.q0, &drawn.q1);
        let options = MotionOptions::default();
        let outcome = context.motion(cobject, q0, q1, &options).unwrap().outcome;
        let certificate = context.search_certificate(cobject, q0, q1, &options);
        let certificate = certificate.unwrap();
        found[outcome as usize][usize::from(certificate.is_some())] += 1;
        if certificate.is_some() {
            assert_ne!(outcome, MotionOutcome::Hit, "round {round}");
        }
        for i in 0..if certificate.is_some() { 100 } else { 0 } {
            let q = drawn.at(f64::from(i) / 99.0);
            assert_ne!(class(context, cobject, &q), Class::Inside, "round {round}");
        }
    }
    println!("without and with a certificate: free, hit, near, undecided {found:?}");
    let [[without, with], [hits, _], ..] = found;
    assert!(with > 99 * without && hits > 60, "{found:?}");
}

/// Every body pair that queries may name is an item of the certificate.
#[test]
fn all_body_pairs_have_entries() {
    let mut random = Random::new(1903);
    let context = &mut QueryContext::new();
    let mut compared = 0;
    while compared < 40 {
        let drawn = Drawn::new(&mut random);
        let (_, Some(certificate)) = drawn.certified(0.0) else {
            continue;
        };
        compared += 1;
        let all = Configuration::Coordinates(&drawn.q0);
        let list = context.witnesses(&drawn.cobject, all, 1e9, 1_000_000);
        let list = list.unwrap();
        assert!(!list.truncated);
        let pairs = list.witnesses.iter().filter_map(|witness| {
            let is_body = !matches!(witness.s_side, SSide::PureSet(_));
            let pair = (
                witness.leaf.serial,
                witness.r_link,
                witness.r_object,
                witness.s_side,
            );
            is_body.then_some(pair)
        });
        let pairs: HashSet<_> = pairs.collect();
        let bodies = certificate
            .entries()
            .iter()
            .filter(|entry| entry.groups[1][1] > 0);
        let items: HashSet<u32> = bodies.map(|entry| entry.item).collect();
        assert_eq!(pairs.len(), items.len());
    }
}

/// Unions, intersections and differences: what is certified holds at all samples, and only complements are refused.
#[test]
fn compound_sets_are_certified_where_no_complement_is_needed() {
    let mut random = Random::new(1933);
    let context = &mut QueryContext::new();
    let (mut certified, mut unsupported) = (0, 0);
    for _ in 0..300 {
        let space = arm(&mut random);
        let set = compound(&mut random, &space, 3);
        for _ in 0..4 {
            let size = [0.1, 0.5, 2.0][random.below(3)];
            let mut near = |size: f64| [(); 3].map(|()| random.within(-size, size)).to_vec();
            let (q0, v) = (near(2.0), near(size));
            let q1 = at(&space, &q0, &v, 1.0);
            let options = MotionOptions::default();
            let found = context.motion_certificate(&set, &q0, &q1, &options);
            let certificate = match found {
                Ok((_, certificate)) => certificate,
                Err(error) => {
                    assert_eq!(error.kind, ErrorKind::Unsupported, "{error}");
                    unsupported += 1;
                    continue;
                }
            };
            let Some(certificate) = certificate else {
                continue;
            };
            certified += 1;
            certificate.verify(&set, &q0, &q1, 0.0).unwrap();
            for i in 0..=100 {
                let q = space.interpolate(&q0, &q1, f64::from(i) / 100.0);
                assert_ne!(class(context, &set, &q), Class::Inside);
            }
        }
    }
    println!("{certified} certified, {unsupported} unsupported");
    assert!(certified > 100 && unsupported > 100);
}
