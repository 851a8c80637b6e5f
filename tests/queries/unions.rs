//! Unions, margins and states: what they hold, each pair once, whatever the order of the parts.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, Class, InducedOptions, LeftOut, SObjects};
use cstk::environment::{Change, Environment};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, DistanceKind, QueryContext, SSide, World};
use cstk::robot::{JointKind, LinkDefinition, RobotBuilder};
use cstk::space::{Space, WorldBox};

use helpers::random::Random;

fn cuboid(sides: [f64; 3]) -> Arc<Body> {
    let points: Vec<Vec3> = (0..8)
        .map(|i| {
            let pick = |axis: usize| sides[axis] * if i >> axis & 1 == 0 { -0.5 } else { 0.5 };
            Vec3::new(pick(0), pick(1), pick(2))
        })
        .collect();
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_polyhedron(&points, 0).unwrap();
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

fn at(x: f64) -> Pose {
    Pose::from_translation(Vec3::new(x, 0.0, 0.0))
}

/// Unit cubes that shift along x, each a link of its own.
fn sliders(count: usize) -> Arc<Space> {
    let mut builder = RobotBuilder::new(3).unwrap();
    for _ in 0..count {
        let link = LinkDefinition {
            body: Some(cuboid([1.0; 3])),
            kind: JointKind::Prismatic,
            axis: Vec3::x(),
            ..Default::default()
        };
        builder.add_link(link).unwrap();
    }
    let robot = Arc::new(builder.build().unwrap());
    let everywhere = WorldBox::unbounded();
    Arc::new(Space::new(vec![robot], &[], everywhere).unwrap())
}

fn induced(
    space: &Arc<Space>,
    environment: &Arc<Environment>,
    margin: f64,
    epsilon: f64,
) -> Arc<CObject> {
    let options = InducedOptions {
        contact_epsilon: epsilon,
        margin,
    };
    let all = SObjects::All(environment.clone());
    Arc::new(CObject::induced(space.clone(), &[], all, LeftOut::default(), options).unwrap())
}

fn with_cubes(places: &[f64]) -> (Arc<Environment>, Vec<u64>) {
    let environment = Arc::new(Environment::default());
    let add = |x: &f64| Change::add(cuboid([1.0; 3]), at(*x));
    let changes: Vec<Change> = places.iter().map(add).collect();
    let (ids, _) = environment.apply(&changes).unwrap();
    (environment, ids)
}

#[test]
fn an_object_in_two_states_counts_in_both() {
    let space = sliders(1);
    let (live, ids) = with_cubes(&[1.2]);
    let before = Arc::new(live.freeze());
    let moved = Change::Move {
        id: ids[0],
        pose: at(5.0),
    };
    live.apply(&[moved]).unwrap();
    let parts = [
        induced(&space, &live, 0.0, 0.0),
        induced(&space, &before, 0.0, 0.0),
    ];
    for order in [[0, 1], [1, 0]] {
        let union = CObject::union(&order.map(|i| parts[i].clone())).unwrap();
        let mut query = QueryContext::new();
        let q = Configuration::Coordinates(&[0.0]);
        let d = query.distance(&union, q, f64::INFINITY).unwrap();
        assert!((d.distance - 0.2).abs() < 1e-15);
        assert_eq!(
            query
                .witnesses(&union, q, 10.0, 10)
                .unwrap()
                .witnesses
                .len(),
            2
        );
    }
}

#[test]
fn the_class_of_a_union_is_the_largest_of_its_parts() {
    let space = sliders(1);
    let (environment, _) = with_cubes(&[1.2]);
    let q = Configuration::Coordinates(&[0.0]);
    let cases = [
        (0.1, 0.0),
        (0.0, 0.15),
        (0.0, 0.25),
        (0.3, 0.0),
        (0.05, 0.2),
        (0.15, 0.04),
    ];
    for (m1, e1) in cases {
        for (m2, e2) in cases {
            let parts = [
                induced(&space, &environment, m1, e1),
                induced(&space, &environment, m2, e2),
            ];
            let class = |c: &CObject| QueryContext::new().classify(c, q).unwrap();
            let union = CObject::union(&parts).unwrap();
            assert_eq!(
                class(&union),
                class(&parts[0]).max(class(&parts[1])),
                "{m1} {e1} {m2} {e2}"
            );
        }
    }
    assert!(Class::Outside < Class::Contact && Class::Contact < Class::Inside);
}

#[test]
fn a_pair_given_both_ways_or_twice_counts_once() {
    let space = sliders(2);
    let options = InducedOptions::default();
    let links = CObject::induced_links(space, &[[0, 1], [1, 0], [0, 1]], options).unwrap();
    let links = Arc::new(links);
    let mut doubled = links.clone();
    for _ in 0..40 {
        doubled = Arc::new(CObject::union(&[doubled.clone(), doubled]).unwrap());
    }
    for cobject in [links, doubled] {
        let q = [0.0, 3.0];
        let list = QueryContext::new()
            .witnesses(&cobject, Configuration::Coordinates(&q), 5.0, 10)
            .unwrap();
        assert_eq!(list.witnesses.len(), 1);
    }
}

/// Each pair is known to an error of its own, so the least bound need not be that of the nearest pair.
#[test]
fn bounds_do_not_depend_on_what_was_asked_before() {
    let space = sliders(1);
    let environment = Arc::new(Environment::default());
    let huge = cuboid([1e9; 3]);
    let changes = [
        Change::add(cuboid([1.0; 3]), at(1.1)),
        Change::add(huge, at(-5e8 - 0.6 - 1e-10)),
    ];
    environment.apply(&changes).unwrap();
    let cobject = induced(&space, &environment, 0.0, 0.0);
    let mut warm = QueryContext::new();
    for i in 0..50 {
        let q = [1e-7 * f64::from(i % 7 - 3)];
        let q = Configuration::Coordinates(&q);
        let cold = QueryContext::new()
            .distance(&cobject, q, f64::INFINITY)
            .unwrap();
        let again = warm.distance(&cobject, q, f64::INFINITY).unwrap();
        assert_eq!(
            [cold.distance, cold.lower, cold.upper].map(f64::to_bits),
            [again.distance, again.lower, again.upper].map(f64::to_bits)
        );
        for t in [cold.lower, cold.lower * 0.999_999, cold.distance] {
            assert_eq!(warm.within(&cobject, q, t).unwrap(), cold.lower <= t);
        }
    }
}

/// A slide asks many questions of one state: a world is how it gets it.
#[test]
fn a_world_does_not_follow_its_environments() {
    let space = sliders(1);
    let (live, ids) = with_cubes(&[1.2]);
    let (other, _) = with_cubes(&[-3.0]);
    let parts = [
        induced(&space, &live, 0.0, 0.0),
        induced(&space, &other, 0.0, 0.0),
    ];
    let union = CObject::union(&parts).unwrap();
    let then = World::of(&union);
    live.apply(&[Change::Delete { id: ids[0] }]).unwrap();
    let q = Configuration::Coordinates(&[0.0]);
    let mut query = QueryContext::new();
    let mut distance = |world: &World| {
        let found = query.distance_in(world, &union, q, f64::INFINITY);
        found.unwrap().distance
    };
    assert!((distance(&then) - 0.2).abs() < 1e-15);
    assert!((distance(&World::of(&union)) - 2.0).abs() < 1e-15);
}

/// Among many objects only those near are asked; the answers are those of asking each by itself.
#[test]
fn a_union_of_many_objects_is_the_least_of_all_pairs() {
    let mut random = Random::new(3);
    let space = sliders(3);
    let bodies = [[0.5, 0.2, 0.1], [3.0, 0.1, 0.1], [0.1; 3]].map(cuboid);
    // Far from the origin too: bounds in the world carry the rounding of its coordinates.
    for (reach, away) in [(4.0, 0.0), (12.0, 0.0), (12.0, 1e5)] {
        let environment = Arc::new(Environment::default());
        let poses: Vec<Pose> = (0..120)
            .map(|_| {
                let mut pose = random.pose(reach);
                pose.translation.x += away;
                pose
            })
            .collect();
        let add = |(i, pose): (usize, &Pose)| Change::add(bodies[i % 3].clone(), *pose);
        let changes: Vec<Change> = poses.iter().enumerate().map(add).collect();
        let (ids, _) = environment.apply(&changes).unwrap();
        let (margin, epsilon) = (0.05, 0.3);
        let cobject = induced(&space, &environment, margin, epsilon);
        let link = cuboid([1.0; 3]);
        for _ in 0..60 {
            let q: Vec<f64> = (0..3)
                .map(|_| away + random.within(-reach, reach))
                .collect();
            let mut query = QueryContext::new();
            let mut least = (f64::INFINITY, 0, 0);
            let mut within = 0;
            for (k, x) in q.iter().enumerate() {
                for (i, pose) in poses.iter().enumerate() {
                    let (a, b) = ((&*link, &at(*x)), (&*bodies[i % 3], pose));
                    let apart = query.pair_distance(a, b, f64::INFINITY).unwrap().distance;
                    let clear = if apart > margin { apart - margin } else { 0.0 };
                    if clear < least.0 {
                        least = (clear, k, i);
                    }
                    within += usize::from(clear <= epsilon);
                }
            }
            let q = Configuration::Coordinates(&q);
            let found = query.distance(&cobject, q, f64::INFINITY).unwrap();
            assert!((found.distance - least.0).abs() <= 1e-15 * away.max(10.0));
            let witness = found.witness.unwrap();
            assert_eq!(witness.r_link, least.1);
            assert_eq!(witness.s_side, SSide::Object(ids[least.2]));
            let list = query.witnesses(&cobject, q, epsilon, 1000).unwrap();
            assert_eq!(list.witnesses.len(), within);
            let class = match least.0 {
                0.0 => Class::Inside,
                d if d <= epsilon => Class::Contact,
                _ => Class::Outside,
            };
            assert_eq!(query.classify(&cobject, q).unwrap(), class);
            for threshold in [0.1, 1.0] {
                assert_eq!(
                    query.within(&cobject, q, threshold).unwrap(),
                    least.0 <= threshold
                );
            }
            let beyond = query.distance(&cobject, q, 0.9 * least.0).unwrap();
            assert_eq!(beyond.kind == DistanceKind::BeyondMax, least.0 > 0.0);
        }
    }
}

/// What met last is asked first, as it is now: moved, deleted, or left out by another C-object, it decides nothing.
#[test]
fn what_met_last_counts_only_while_it_meets() {
    let space = sliders(1);
    let (environment, ids) = with_cubes(&[0.5, 20.0]);
    let all = induced(&space, &environment, 0.0, 0.1);
    let q = Configuration::Coordinates(&[0.0]);
    let mut query = QueryContext::new();
    let ask = |query: &mut QueryContext, cobject: &CObject| {
        let class = query.classify(cobject, q).unwrap();
        assert_eq!(
            class == Class::Inside,
            query.within(cobject, q, 0.0).unwrap()
        );
        class
    };
    assert_eq!(ask(&mut query, &all), Class::Inside);
    let far_one = SObjects::Some(environment.clone(), vec![ids[1]]);
    let options = InducedOptions::default();
    let other = CObject::induced(space.clone(), &[], far_one, LeftOut::default(), options).unwrap();
    assert_eq!(ask(&mut query, &other), Class::Outside);
    assert_eq!(ask(&mut query, &all), Class::Inside);
    let moved = |x: f64| Change::Move {
        id: ids[0],
        pose: at(x),
    };
    environment.apply(&[moved(1.05)]).unwrap();
    assert_eq!(ask(&mut query, &all), Class::Contact);
    environment.apply(&[moved(1.0)]).unwrap();
    assert_eq!(ask(&mut query, &all), Class::Inside);
    environment.apply(&[Change::Delete { id: ids[0] }]).unwrap();
    assert_eq!(ask(&mut query, &all), Class::Outside);
}
