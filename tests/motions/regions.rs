//! Boxes of C-space: what is called free or inside is so at every sample, and what is mixed has both.

use cstk::cobject::{CObject, Class};
use cstk::motion::{RegionAnswer, RegionOptions, RegionOutcome};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::Coordinate;
use cstk::space::Space;

use helpers::random::Random;

use crate::compound::{arm, compound};
use crate::random_scenes::scene;

pub fn class(context: &mut QueryContext, cobject: &CObject, q: &[f64]) -> Class {
    let at = Configuration::Coordinates(q);
    context.classify(cobject, at).unwrap()
}

/// A configuration of a box: in each coordinate one of the ends, where bounds are tightest, or anything between.
pub fn sample(random: &mut Random, [low, high]: [&[f64]; 2]) -> Vec<f64> {
    let ends = low.iter().zip(high);
    ends.map(|(&low, &high)| match random.below(3) {
        0 => low,
        1 => high,
        _ => random.within(0.0, 1.0) * (high - low) + low,
    })
    .collect()
}

/// Checks what is said of a box by samples.
pub fn check(
    random: &mut Random,
    context: &mut QueryContext,
    cobject: &CObject,
    [low, high]: [&[f64]; 2],
    answer: &RegionAnswer,
    samples: usize,
) {
    let is_inside =
        |context: &mut QueryContext, q: &[f64]| class(context, cobject, q) == Class::Inside;
    for (q, inside) in [(&answer.inside, true), (&answer.outside, false)] {
        if let Some(q) = q {
            assert_eq!(is_inside(context, q), inside, "{answer:?}");
            let is_between = |c: usize| low[c] <= q[c] && q[c] <= high[c];
            assert!((0..q.len()).all(is_between), "{q:?}: {low:?} to {high:?}");
        }
    }
    assert_eq!(
        answer.outcome == RegionOutcome::Mixed,
        answer.inside.is_some() && answer.outside.is_some()
    );
    let claimed = match answer.outcome {
        RegionOutcome::Free => false,
        RegionOutcome::Inside => true,
        _ => return,
    };
    assert_eq!(answer.proved, 1.0);
    for _ in 0..samples {
        let q = sample(random, [low, high]);
        assert_eq!(
            is_inside(context, &q),
            claimed,
            "{q:?} of {low:?} to {high:?}: {answer:?}"
        );
    }
}

/// A box around a random configuration; quaternions rest, and some other coordinates.
pub fn random_box(random: &mut Random, space: &Space) -> [Vec<f64>; 2] {
    let v: Vec<f64> = (0..space.nv()).map(|_| random.within(-2.0, 2.0)).collect();
    let q = space.step(&space.neutral(), &v);
    let size = [0.01, 0.05, 0.2, 0.5, 2.0][random.below(5)];
    let half: Vec<f64> = (space.coordinates().iter())
        .map(|coordinate| match coordinate {
            Coordinate::Quaternion => 0.0,
            _ if random.below(5) == 0 => 0.0,
            _ => random.within(0.0, size),
        })
        .collect();
    [-1.0, 1.0].map(|sign| q.iter().zip(&half).map(|(q, h)| q + sign * h).collect())
}

/// The number of boxes and of samples in each: `CSTK_REGIONS=10000 cargo test --release --test motions regions -- --nocapture` runs a
/// campaign with 10,000 samples each.
pub fn amount(quick: usize) -> (usize, usize) {
    let campaign = std::env::var("CSTK_REGIONS").ok();
    campaign.map_or((quick, 100), |count| (count.parse().unwrap(), 10_000))
}

/// Robots with all kinds of joints and shapes among objects: self-collision, held objects, margins, floors.
#[test]
fn free_and_inside_boxes_are_so_at_every_sample() {
    let (count, samples) = amount(1000);
    let mut random = Random::new(301);
    let mut outcomes = [0usize; 4];
    let context = &mut QueryContext::new();
    let mut cobject = scene(&mut random);
    for round in 0..count {
        if round % 10 == 0 {
            cobject = scene(&mut random);
        }
        let [low, high] = &random_box(&mut random, cobject.space());
        let options = RegionOptions {
            max_boxes: [1, 100, 400][random.below(3)],
        };
        let answer = context
            .classify_region(&cobject, low, high, &options)
            .unwrap();
        outcomes[answer.outcome as usize] += 1;
        check(
            &mut random,
            context,
            &cobject,
            [low, high],
            &answer,
            samples,
        );
    }
    println!("free, inside, mixed, undecided: {outcomes:?}");
    assert!(outcomes[0] > count / 10, "{outcomes:?}");
    assert!(outcomes[2] > count / 20, "{outcomes:?}");
}

/// Intersections, differences and complements of induced and pure sets, with contact epsilons.
#[test]
fn boxes_of_compound_sets_are_what_samples_say() {
    let (count, samples) = amount(1000);
    let mut random = Random::new(303);
    let mut outcomes = [0usize; 4];
    let context = &mut QueryContext::new();
    let mut set = None;
    for round in 0..count {
        if round % 5 == 0 {
            let space = arm(&mut random);
            set = Some(compound(&mut random, &space, 3));
        }
        let set = set.as_ref().unwrap();
        let [low, high] = &random_box(&mut random, set.space());
        let options = RegionOptions { max_boxes: 200 };
        let answer = context.classify_region(set, low, high, &options).unwrap();
        outcomes[answer.outcome as usize] += 1;
        check(&mut random, context, set, [low, high], &answer, samples);
    }
    println!("free, inside, mixed, undecided: {outcomes:?}");
    assert!(outcomes[0] > count / 10, "{outcomes:?}");
    assert!(outcomes[1] > count / 50, "{outcomes:?}");
    assert!(outcomes[2] > count / 40, "{outcomes:?}");
}
