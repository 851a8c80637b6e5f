//! Answers are those of single queries, bit for bit, on any number of threads.

use std::fmt::Debug;

use cstk::batch::{Batch, ItemAnswer, PosePairs, Segments};
use cstk::cobject::CObject;
use cstk::motion::MotionOptions;
use cstk::pose::Pose;
use cstk::query::{Configuration, ContactsListed, QueryContext, World};

use super::scene::{Arm, NQ, at, on_threads, quiet};
use helpers::random::Random;

const THREADS: [u32; 4] = [1, 2, 3, 8];

/// Numbers are written with as many digits as tell them apart.
fn text<T: Debug>(answer: T) -> String {
    format!("{answer:?}")
}

fn keep<T: Debug>(slots: &mut &mut [String], item: usize, answer: ItemAnswer<T>) {
    slots[item] = text(answer.unwrap());
}

/// Runs a batch on each number of threads, twice with what it remembers, and compares it with single answers.
fn compare(single: &[String], mut run: impl FnMut(&mut Batch, u32, &mut [String])) {
    for threads in THREADS {
        let batch = &mut Batch::new();
        for _ in 0..2 {
            let mut found = vec![String::new(); single.len()];
            run(batch, threads, &mut found);
            assert!(found == single, "on {threads} threads");
        }
    }
}

fn single(q: &[f64], mut ask: impl FnMut(&mut QueryContext, &[f64]) -> String) -> Vec<String> {
    q.chunks(NQ)
        .map(|q| ask(&mut QueryContext::new(), q))
        .collect()
}

/// CSTK_BATCH_ITEMS says how many are asked.
fn item_count() -> usize {
    let given = std::env::var("CSTK_BATCH_ITEMS").ok();
    given.and_then(|count| count.parse().ok()).unwrap_or(300)
}

#[test]
fn classes_and_distances_are_those_of_single_queries() {
    let arm = Arm::new(5);
    let count = item_count();
    let q = arm.configurations(count, 6);
    let nothing = &mut |_| Ok(());
    let cobject = &arm.contact;
    let classes = single(&q, |context, q| {
        text(
            context
                .classify(cobject, Configuration::Coordinates(q))
                .unwrap(),
        )
    });
    let hits = classes.iter().filter(|class| *class == "Inside").count();
    assert!(hits > 20 && hits < count - 20, "{hits}");
    compare(&classes, |batch, threads, found| {
        let options = on_threads(threads);
        let done = batch
            .classify(cobject, at(&q), quiet(&options, found, nothing), keep)
            .unwrap();
        assert_eq!(done.version, arm.environment.snapshot().version);
    });
    for threshold in [0.0, 0.1] {
        let within = single(&q, |context, q| {
            let at = Configuration::Coordinates(q);
            text(context.within(cobject, at, threshold).unwrap())
        });
        compare(&within, |batch, threads, found| {
            let options = on_threads(threads);
            let job = quiet(&options, found, nothing);
            batch.within(cobject, at(&q), threshold, job, keep).unwrap();
        });
    }
    for max_distance in [0.05, f64::INFINITY] {
        let distances = single(&q, |context, q| {
            let at = Configuration::Coordinates(q);
            text(context.distance(cobject, at, max_distance).unwrap())
        });
        compare(&distances, |batch, threads, found| {
            let options = on_threads(threads);
            let job = quiet(&options, found, nothing);
            batch
                .distance(cobject, at(&q), max_distance, job, keep)
                .unwrap();
        });
    }
}

/// The row that `gradients` has for the nearest pair, as its documentation says to ask for it.
fn nearest_row(cobject: &CObject, q: &[f64]) -> Option<Vec<f64>> {
    let context = &mut QueryContext::new();
    let distance = context
        .distance(cobject, Configuration::Coordinates(q), f64::INFINITY)
        .unwrap();
    distance.contact.as_ref()?;
    context.set_contacts(ContactsListed::Nearest);
    let list = context.gradients(cobject, q, distance.upper, 1).unwrap();
    Some(list.gradients)
}

#[test]
fn gradients_are_those_of_the_nearest_pair() {
    let arm = Arm::new(7);
    let q = arm.configurations(200, 8);
    let nothing = &mut |_| Ok(());
    let [objects, own, limits] = &arm.parts;
    for cobject in [&arm.contact, objects, own, limits] {
        let rows: Vec<Option<Vec<f64>>> = q.chunks(NQ).map(|q| nearest_row(cobject, q)).collect();
        assert!(rows.iter().flatten().count() > 20);
        for threads in THREADS {
            let mut found = vec![Vec::new(); rows.len()];
            let options = on_threads(threads);
            let job = quiet(&options, &mut found[..], nothing);
            let put =
                |slots: &mut &mut [Vec<f64>], item: usize, answer: ItemAnswer<(_, &[f64])>| {
                    slots[item] = answer.unwrap().1.to_vec();
                };
            let batch = &mut Batch::new();
            batch
                .distance_with_gradient(cobject, at(&q), f64::INFINITY, job, put)
                .unwrap();
            for (row, expected) in found.iter().zip(&rows) {
                assert_eq!(*row, expected.clone().unwrap_or_default());
            }
        }
    }
}

/// A gradient is what central differences of the distance are.
#[test]
fn gradients_are_the_derivatives_of_distances() {
    let arm = Arm::new(9);
    let q = arm.configurations(60, 10);
    let world = &World::of(&arm.contact);
    let context = &mut QueryContext::new();
    let row = &mut Vec::new();
    let mut compared = 0;
    for q in q.chunks(NQ) {
        let infinity = f64::INFINITY;
        let here = context
            .distance_with_gradient_in(world, &arm.contact, q, infinity, row)
            .unwrap();
        if here.distance < 1e-3 {
            continue;
        }
        for k in 0..NQ {
            let mut at = |step: f64| {
                let mut q = q.to_vec();
                q[k] += step;
                let at = Configuration::Coordinates(&q);
                context.distance(&arm.contact, at, infinity).unwrap()
            };
            let step = 1e-6;
            let [before, after] = [at(-step), at(step)];
            let pair =
                |d: &cstk::query::Distance| d.witness.map(|w| (w.leaf, w.s_side, w.primitives));
            if pair(&before) == pair(&here) && pair(&after) == pair(&here) {
                let slope = (after.distance - before.distance) / (2.0 * step);
                assert!((slope - row[k]).abs() < 1e-4, "{slope} {}", row[k]);
                compared += 1;
            }
        }
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn motions_are_those_of_single_queries() {
    let arm = Arm::new(11);
    let points = arm.configurations(60, 12);
    let nothing = &mut |_| Ok(());
    for any_contact in [false, true] {
        let asked = MotionOptions {
            any_contact,
            ..Default::default()
        };
        // The segments of a path: the ends are the points but for the first.
        let (starts, ends) = (&points[..points.len() - NQ], &points[NQ..]);
        let pairs = starts.chunks(NQ).zip(ends.chunks(NQ));
        let single: Vec<String> = pairs
            .map(|(q0, q1)| {
                let context = &mut QueryContext::new();
                text(context.motion(&arm.contact, q0, q1, &asked).unwrap())
            })
            .collect();
        let free = single
            .iter()
            .filter(|answer| answer.contains("Free"))
            .count();
        assert!(free > 3 && free < single.len() - 3, "{free}");
        compare(&single, |batch, threads, found| {
            let options = on_threads(threads);
            let segments = Segments {
                starts: at(starts),
                ends: at(ends),
            };
            let job = quiet(&options, found, nothing);
            batch
                .motion(&arm.contact, segments, &asked, job, keep)
                .unwrap();
        });
    }
}

/// The answers of new contexts at each pair of poses.
fn single_pairs(
    [rows_a, rows_b]: [&[[f64; 12]]; 2],
    ask: impl Fn(&mut QueryContext, &Pose, &Pose) -> String,
) -> Vec<String> {
    let read = |row| Pose::from_row_major(row).unwrap();
    let pairs = rows_a.iter().zip(rows_b);
    let answers = pairs.map(|(a, b)| ask(&mut QueryContext::new(), &read(a), &read(b)));
    answers.collect()
}

#[test]
fn pairs_are_those_of_single_queries() {
    let arm = Arm::new(13);
    let mut random = Random::new(14);
    let nothing = &mut |_| Ok(());
    let mut rows =
        || -> Vec<[f64; 12]> { (0..300).map(|_| random.pose(0.4).to_row_major()).collect() };
    let (rows_a, rows_b) = (rows(), rows());
    let body = &*arm.body;
    let pairs = PosePairs {
        bodies: [body, body],
        poses: [&rows_a, &rows_b],
    };
    let within = single_pairs(pairs.poses, |context, a, b| {
        text(context.pair_within((body, a), (body, b), 0.0).unwrap())
    });
    compare(&within, |batch, threads, found| {
        let options = on_threads(threads);
        let job = quiet(&options, found, nothing);
        batch.pair_within(pairs, 0.0, job, keep).unwrap();
    });
    let infinity = f64::INFINITY;
    let distances = single_pairs(pairs.poses, |context, a, b| {
        text(
            context
                .pair_distance((body, a), (body, b), infinity)
                .unwrap(),
        )
    });
    compare(&distances, |batch, threads, found| {
        let options = on_threads(threads);
        let job = quiet(&options, found, nothing);
        batch.pair_distance(pairs, infinity, job, keep).unwrap();
    });
}
