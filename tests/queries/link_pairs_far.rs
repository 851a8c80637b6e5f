//! Pairs of links are culled by their boxes wherever they are and however large, of round primitives and in the plane; pairs stand just
//! within the threshold and just beyond it.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, InducedOptions};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::JointKind;

use helpers::random::Random;
use helpers::robots::{link, robot, space};
use helpers::shapes::planar;

fn built(add: impl FnOnce(&mut BodyBuilder)) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    add(&mut builder);
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

/// A body of the given size around a place of its frame.
fn body(random: &mut Random, size: f64, place: Vec3) -> Arc<Body> {
    let at = Pose {
        translation: place,
        ..random.pose(0.0)
    };
    match random.below(7) {
        0 => built(|b| b.add_sphere(&place, size, 0).unwrap()),
        1 => built(|b| {
            let [from, to] = [(); 2].map(|()| place + random.point(size));
            b.add_capsule(&from, &to, 0.3 * size, 0).unwrap();
        }),
        2 => built(|b| {
            b.add_box(&at, &Vec3::new(size, 0.1 * size, 1e-3 * size), 0)
                .unwrap()
        }),
        3 => built(|b| b.add_cylinder(&at, 0.2 * size, size, 0).unwrap()),
        4 => built(|b| {
            let axes = Vec3::new(size, 0.2 * size, 0.1 * size);
            b.add_ellipsoid(&at, &axes, 0).unwrap();
        }),
        5 => built(|b| {
            let corners: Vec<_> = random.points(4, size).iter().map(|p| p + place).collect();
            b.add_rounded_polyhedron(&corners, 0.2 * size, 0).unwrap();
        }),
        _ => built(|b| {
            let points: Vec<_> = random.points(20, size).iter().map(|p| p + place).collect();
            b.add_points(&points, 0.05 * size).unwrap();
        }),
    }
}

/// Every answer is that of the pairs one by one, at thresholds from 0 over all pairs' distances, a little less and more, to infinity.
fn check(
    random: &mut Random,
    dimension: u32,
    bodies: &[Option<Arc<Body>>],
    poses: &[Pose],
) -> [u32; 2] {
    let count = bodies.len();
    let links = bodies.iter().map(|body| {
        let mut one = link(None, JointKind::Fixed, Vec3::z());
        one.body = body.clone();
        one
    });
    let space = space(vec![robot(dimension, links.collect())]);
    let mut pairs = Vec::new();
    while pairs.len() < 2 * count {
        let pair = [random.below(count), random.below(count)];
        if pair[0] != pair[1] && pair.iter().all(|&link| bodies[link].is_some()) {
            pairs.push(pair);
        }
    }
    let margin = [0.0, 1e-9, 0.1, 1e3][random.below(4)];
    let options = InducedOptions {
        margin,
        contact_epsilon: [0.0, 0.01][random.below(2)],
    };
    let cobject = CObject::induced_links(space, &pairs, options).unwrap();
    let at = Configuration::LinkPoses(poses);
    let (mut context, mut oracle) = (QueryContext::new(), QueryContext::new());
    let mut distances: Vec<f64> = pairs
        .iter()
        .map(|&pair| {
            let [a, b] = pair.map(|link| (bodies[link].as_deref().unwrap(), &poses[link]));
            oracle.pair_distance(a, b, f64::INFINITY).unwrap().distance
        })
        .collect();
    distances.sort_by(f64::total_cmp);
    let mut thresholds = vec![0.0, 1e-300, f64::INFINITY];
    for near in distances.iter().take(3) {
        for factor in [1.0 - 1e-3, 1.0 - 1e-7, 1.0, 1.0 + 1e-7, 1.001, 2.0] {
            thresholds.push((near * factor - margin).max(0.0));
        }
    }
    let mut counts = [0; 2];
    for threshold in thresholds {
        let any = pairs.iter().any(|&pair| {
            let [a, b] = pair.map(|link| (bodies[link].as_deref().unwrap(), &poses[link]));
            oracle.pair_within(a, b, margin + threshold).unwrap()
        });
        let found = context.within(&cobject, at, threshold).unwrap();
        assert_eq!(found, any, "{threshold} {margin} {distances:?}");
        counts[usize::from(any)] += 1;
    }
    counts
}

#[test]
fn boxes_of_links_are_safe_at_any_size_and_place() {
    let mut random = Random::new(911);
    let mut counts = [0; 2];
    for _ in 0..1500 {
        let count = 2 + random.below(20);
        let unit = [1e-6, 1.0, 1e6][random.below(3)];
        let far = [0.0, 1.0, 1e3, 1e6, 1e9][random.below(5)] * unit;
        let center = random.unit() * far;
        let own_place = [0.0, 10.0, 1e4][random.below(3)] * unit;
        let bodies: Vec<_> = (0..count)
            .map(|i| {
                let size = unit * [1e-6, 1e-2, 1.0, 1.0, 1.0, 100.0][random.below(6)];
                let place = random.point(own_place);
                (i < 2 || random.below(6) > 0).then(|| body(&mut random, size, place))
            })
            .collect();
        let spread = [0.5, 3.0, 30.0][random.below(3)] * unit;
        let poses: Vec<_> = bodies
            .iter()
            .map(|body| {
                let mut pose = random.pose(spread);
                // One in some is very far: it makes the frame large.
                if random.below(20) == 0 {
                    pose.translation += random.unit() * 1e7 * unit;
                }
                pose.translation += center;
                if let Some(body) = body {
                    pose.translation -= pose.rotation * body.center();
                }
                pose
            })
            .collect();
        let found = check(&mut random, 3, &bodies, &poses);
        counts = [0, 1].map(|i| counts[i] + found[i]);
    }
    println!("apart or within: {counts:?}");
    assert!(counts.iter().all(|count| *count > 1000));
}

#[test]
fn boxes_of_planar_links_are_safe() {
    let mut random = Random::new(912);
    let mut counts = [0; 2];
    for _ in 0..600 {
        let count = 2 + random.below(20);
        let far = [0.0, 1e6][random.below(2)];
        let center = random.planar_pose(far).translation;
        let bodies: Vec<_> = (0..count)
            .map(|_| {
                let size = [1e-5, 0.3, 5.0][random.below(3)];
                let corners = 3 + random.below(3);
                Some(planar(&[random.polygon(corners, size)]).body)
            })
            .collect();
        let poses: Vec<_> = (0..count)
            .map(|_| {
                let mut pose = random.planar_pose(6.0);
                pose.translation += center;
                pose
            })
            .collect();
        let found = check(&mut random, 2, &bodies, &poses);
        counts = [0, 1].map(|i| counts[i] + found[i]);
    }
    println!("apart or within: {counts:?}");
    assert!(counts.iter().all(|count| *count > 400));
}
