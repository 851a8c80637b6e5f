//! Pure sets, and what is asked of them.

use std::sync::Arc;

use cstk::cobject::{CObject, Class, Predicate, PureOptions, PureShape};
use cstk::error::Result;
use cstk::pose::Vec3;
use cstk::query::{Configuration, DistanceKind, QueryContext};
use cstk::robot::JointKind;
use cstk::space::Space;

use super::robots::{link, robot, space};

pub const EPSILON: f64 = 0.1;

pub fn pure(space: &Arc<Space>, shape: PureShape, scale: Option<f64>) -> Arc<CObject> {
    let options = PureOptions {
        contact_epsilon: EPSILON,
        scale,
    };
    Arc::new(CObject::pure(space.clone(), shape, options).unwrap())
}

/// A set that tells classes and nothing else: no distance, hence no speed that a proof could use.
struct ClassesAlone<F>(F);

impl<F: Fn(&[f64]) -> Result<Class> + Send + Sync> Predicate for ClassesAlone<F> {
    fn classify(&self, q: &[f64]) -> Result<Class> {
        (self.0)(q)
    }

    fn distance(&self, _: &[f64]) -> Result<Option<f64>> {
        Ok(None)
    }

    fn measures(&self) -> bool {
        false
    }
}

/// The set whose classes a function tells, which may also fail, panic, or take its time.
pub fn classified(
    space: &Arc<Space>,
    classify: impl Fn(&[f64]) -> Result<Class> + Send + Sync + 'static,
) -> Arc<CObject> {
    let shape = PureShape::Predicate(Arc::new(ClassesAlone(classify)));
    Arc::new(CObject::pure(space.clone(), shape, PureOptions::default()).unwrap())
}

/// The middle of [`ball`].
pub const CENTER: [f64; 3] = [0.1, -0.2, 0.3];

/// The configurations of three sliding links within a distance of [`CENTER`].
pub fn ball(radius: f64, options: PureOptions) -> CObject {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let links = (0..3usize).map(|i| link(i.checked_sub(1), JointKind::Prismatic, axes[i]));
    let space = space(vec![robot(3, links.collect())]);
    let center = CENTER.to_vec();
    CObject::pure(space, PureShape::Ball { center, radius }, options).unwrap()
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
