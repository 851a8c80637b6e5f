//! Pure sets, and what is asked of them.

use std::sync::Arc;

use cstk::cobject::{CObject, Class, PureOptions, PureShape};
use cstk::query::{Configuration, DistanceKind, QueryContext};
use cstk::space::Space;

pub const EPSILON: f64 = 0.1;

pub fn pure(space: &Arc<Space>, shape: PureShape, scale: Option<f64>) -> Arc<CObject> {
    let options = PureOptions {
        contact_epsilon: EPSILON,
        scale,
    };
    Arc::new(CObject::pure(space.clone(), shape, options).unwrap())
}

pub fn class(cobject: &CObject, q: &[f64]) -> Class {
    let mut query = QueryContext::new();
    query
        .classify(cobject, Configuration::Coordinates(q))
        .unwrap()
}

pub fn distance(cobject: &CObject, q: &[f64]) -> f64 {
    let mut query = QueryContext::new();
    let found = query.distance(cobject, Configuration::Coordinates(q), f64::INFINITY);
    let found = found.unwrap();
    assert_eq!(found.kind, DistanceKind::Exact, "{found:?}");
    assert!(found.lower <= found.distance && found.distance <= found.upper);
    found.distance
}
