//! Gradients against central differences of the distance.

use cstk::cobject::CObject;
use cstk::pose::Vec3;
use cstk::query::{Configuration, ContactRecord, QueryContext, WitnessList};

use super::random::Random;

pub fn distance(cobject: &CObject, q: &[f64]) -> f64 {
    QueryContext::new()
        .distance(cobject, Configuration::Coordinates(q), f64::INFINITY)
        .unwrap()
        .distance
}

pub fn points(cobject: &CObject, q: &[f64]) -> [Vec3; 2] {
    QueryContext::new()
        .distance(cobject, Configuration::Coordinates(q), f64::INFINITY)
        .unwrap()
        .points
}

pub fn moved(q: &[f64], i: usize, by: f64) -> Vec<f64> {
    let mut q = q.to_vec();
    q[i] += by;
    q
}

pub fn rows(list: &WitnessList) -> Vec<&[f64]> {
    assert_eq!(list.gradients.len(), list.contacts.len() * list.nv);
    list.gradients.chunks_exact(list.nv).collect()
}

/// The step of the central differences. The distance carries some 1e-15, so its difference some 1e-9.
pub const STEP: f64 = 1e-6;

/// Compares the nearest contact's gradient with central differences; `false` where there is a tie.
///
/// A tie is a second contact within 1e-4 of the distance whose points lie elsewhere (primitives that share the point do
/// not tie), or closest points that move by more than 100 steps when one coordinate moves by one: the distance then has
/// a kink, or a curvature that the difference quotient does not see through.
pub fn agrees(cobject: &CObject, q: &[f64]) -> bool {
    let here = distance(cobject, q);
    assert!(here > 0.0);
    let list = QueryContext::new()
        .gradients(cobject, q, here + 1e-4, 64)
        .unwrap();
    let first = &list.contacts[list.witnesses[0].first_contact];
    let apart =
        |other: &ContactRecord| (0..2).any(|k| (other.points[k] - first.points[k]).norm() > 1e-6);
    if list.contacts.iter().any(apart) {
        return false;
    }
    assert!((first.distance - here).abs() <= 1e-14);
    let row = rows(&list)[list.witnesses[0].first_contact];
    for (i, gradient) in row.iter().enumerate() {
        let (back, forth) = (moved(q, i, -STEP), moved(q, i, STEP));
        let (from, to) = (points(cobject, &back), points(cobject, &forth));
        if (0..2).any(|k| (to[k] - from[k]).norm() > 100.0 * 2.0 * STEP) {
            return false;
        }
        let quotient = (distance(cobject, &forth) - distance(cobject, &back)) / (2.0 * STEP);
        assert!(
            (gradient - quotient).abs() <= 1e-6 * gradient.abs().max(1.0),
            "coordinate {i} at {q:?}: gradient {gradient}, difference {quotient}, distance {here}"
        );
    }
    true
}

/// Random configurations of a C-object, of which most must be free of ties.
pub fn agrees_at_many(cobject: &CObject, ranges: &[f64], count: usize, seed: u64) {
    let mut random = Random::new(seed);
    let (mut tried, mut compared) = (0, 0);
    while tried < count {
        let q: Vec<f64> = ranges.iter().map(|r| random.within(-r, *r)).collect();
        // Nearer than this the closest points' curvature exceeds what a step of STEP resolves.
        if distance(cobject, &q) < 0.02 {
            continue;
        }
        tried += 1;
        compared += usize::from(agrees(cobject, &q));
    }
    assert!(
        10 * compared >= 6 * count,
        "only {compared} of {count} were compared"
    );
}
