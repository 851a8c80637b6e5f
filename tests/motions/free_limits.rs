//! Free joints along the limits of their positions: what is beyond is open, so that a motion at a limit is free where no configuration
//! on it is beyond.

use std::f64::consts::TAU;
use std::sync::Arc;

use cstk::cobject::{CObject, Class, PureShape};
use cstk::motion::{MotionOptions, MotionOutcome};
use cstk::pose::Vec3;
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{Coordinate, JointKind};
use cstk::space::{Space, WorldBox};
use helpers::pure::pure;
use helpers::random::Random;
use helpers::robots::{link, robot};

/// A free joint whose height has a range, and what is beyond it.
fn beyond([lower, upper]: [f64; 2]) -> (Arc<Space>, Arc<CObject>) {
    let links = vec![link(None, JointKind::Free, Vec3::z())];
    let mut ranges = vec![None; 7];
    ranges[2] = Some(Coordinate::Interval { lower, upper });
    let robots = vec![robot(3, links)];
    let space = Arc::new(Space::new(robots, &ranges, WorldBox::unbounded()).unwrap());
    let limits = pure(&space, PureShape::BeyondLimits, None);
    (space, limits)
}

fn turned(axis: &Vec3, angle: f64) -> [f64; 4] {
    let (sin, cos) = (0.5 * angle).sin_cos();
    let v = axis * sin;
    [v.x, v.y, v.z, cos]
}

/// The outcome, and the most that any of some samples is beyond. Contacts that are reported are inside.
fn outcome(
    space: &Space,
    limits: &CObject,
    [q0, q1]: [&[f64]; 2],
    [lower, upper]: [f64; 2],
) -> (MotionOutcome, f64) {
    let mut query = QueryContext::new();
    let answer = query
        .motion(limits, q0, q1, &MotionOptions::default())
        .unwrap();
    let mut class = |q: &[f64]| {
        query
            .classify(limits, Configuration::Coordinates(q))
            .unwrap()
    };
    if answer.outcome == MotionOutcome::Hit {
        assert_eq!(
            class(&answer.configuration),
            Class::Inside,
            "{q0:?} {q1:?} {:?}",
            answer.times
        );
    }
    let mut most = f64::NEG_INFINITY;
    for i in 0..=64 {
        let q = space.interpolate(q0, q1, f64::from(i) / 64.0);
        let past = (lower - q[2]).max(q[2] - upper);
        assert_eq!(class(&q) == Class::Inside, past > 0.0, "{q:?}");
        most = most.max(past);
    }
    (answer.outcome, most)
}

#[test]
fn motions_along_a_limit_are_free() {
    let mut random = Random::new(71);
    for case in 0..2000 {
        let size = [1e-3, 1.0, 1e4][random.below(3)];
        let height = random.within(-size, size);
        let low = [height, height - size][random.below(2)];
        let range = if random.below(2) == 0 {
            [low, height]
        } else {
            [height, 2.0 * height - low]
        };
        let (space, limits) = beyond(range);
        // It turns about the vertical, or not at all and stands in any way.
        let (from, by) = (random.within(0.0, TAU), random.within(-3.0, 3.0));
        let turns = match random.below(2) {
            0 => [turned(&Vec3::z(), from), turned(&Vec3::z(), from + by)],
            _ => [turned(&random.unit(), from); 2],
        };
        let place = |random: &mut Random, turn: [f64; 4]| {
            let (x, y) = (random.within(-size, size), random.within(-size, size));
            [&[x, y, height][..], &turn].concat()
        };
        let (q0, q1) = (place(&mut random, turns[0]), place(&mut random, turns[1]));
        let (found, most) = outcome(&space, &limits, [&q0, &q1], range);
        assert!(most <= 0.0, "{case}");
        assert_eq!(found, MotionOutcome::Free, "{case} {q0:?} {q1:?} {range:?}");
    }
}

/// Screws about any axis from a limit: they go beyond it or not, and where they leave it is within rounding.
#[test]
fn motions_that_bend_beyond_a_limit_are_not_free() {
    let mut random = Random::new(72);
    let mut beyond_count = 0;
    for case in 0..2000 {
        let height = random.within(-1.0, 1.0);
        let range = [height - 1.5, height];
        let (space, limits) = beyond(range);
        let end = height - [0.0, 1e-3, 0.3][random.below(3)];
        let place = |random: &mut Random, height: f64| {
            let turn = turned(&random.unit(), random.within(0.0, 3.0));
            let (x, y) = (random.within(-1.0, 1.0), random.within(-1.0, 1.0));
            [&[x, y, height][..], &turn].concat()
        };
        let (q0, q1) = (place(&mut random, height), place(&mut random, end));
        let (found, most) = outcome(&space, &limits, [&q0, &q1], range);
        assert!(
            most <= 0.0 || found != MotionOutcome::Free,
            "{case} {most:e}"
        );
        beyond_count += usize::from(most > 0.0);
    }
    assert!(beyond_count > 500, "{beyond_count}");
}
