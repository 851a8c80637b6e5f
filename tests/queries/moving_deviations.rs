//! Motions of bodies that state how far they are from what they stand for: proofs hold for spheres, in closed form.

use std::sync::Arc;

use cstk::cobject::{CObject, Class};
use cstk::motion::{
    ClearanceOptions, ClearanceOutcome, MotionOptions, MotionOutcome, PairMotion, RegionOptions,
    RegionOutcome,
};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::space::Space;

use helpers::random::Random;
use helpers::robots::{against, environment, free_body, space};

use super::deviations::{Ball, Kind, truth};

/// A body that goes freely among balls, and the least distance of what all of it stands for.
struct Scene {
    moving: Ball,
    rest: Vec<(Ball, Pose)>,
    space: Arc<Space>,
    cobject: Arc<CObject>,
}

impl Scene {
    fn new(random: &mut Random) -> Self {
        let moving = Ball::new(Kind::Solid, 0.5, 4 + random.below(5), 0.5);
        let rest: Vec<(Ball, Pose)> = (0..6)
            .map(|i| {
                let ball = match i % 3 {
                    0 => Ball::exact(0.5),
                    1 => Ball::new(Kind::Solid, 0.6, 3 + random.below(6), 0.0),
                    _ => Ball::new(Kind::Hull, 0.4, 4, 1.0),
                };
                (ball, random.pose(3.0))
            })
            .collect();
        let objects: Vec<_> = rest.iter().map(|(ball, at)| (&ball.body, *at)).collect();
        let (world, _) = environment(&objects);
        let space = space(vec![free_body(&moving.body)]);
        let cobject = Arc::new(against(&space, &world));
        Self {
            moving,
            rest,
            space,
            cobject,
        }
    }

    fn truth(&self, q: &[f64]) -> f64 {
        let at = Vec3::new(q[0], q[1], q[2]);
        let each = self.rest.iter();
        each.map(|(ball, pose)| truth(&self.moving, ball, (at - pose.translation).norm()))
            .fold(f64::INFINITY, f64::min)
    }

    fn drawn(&self, random: &mut Random) -> Vec<f64> {
        (0..6).map(|_| random.within(-3.0, 3.0)).collect()
    }
}

#[test]
fn motions_boxes_and_certificates_hold_for_what_bodies_stand_for() {
    let mut random = Random::new(2103);
    let mut query = QueryContext::new();
    let (mut free, mut hit, mut boxes, mut narrow) = (0, 0, 0, 0);
    for _ in 0..60 {
        let scene = Scene::new(&mut random);
        let complement = CObject::complement(&scene.cobject).unwrap();
        for _ in 0..6 {
            let q0 = scene.drawn(&mut random);
            let q1: Vec<f64> = q0.iter().map(|x| x + random.within(-1.5, 1.5)).collect();
            let threshold = [0.0, 0.1][random.below(2)];
            let options = MotionOptions {
                threshold,
                ..MotionOptions::default()
            };
            let at = |q: &[f64]| scene.truth(q);
            let class = query
                .classify(&scene.cobject, Configuration::Coordinates(&q0))
                .unwrap();
            assert!(class == Class::Inside || at(&q0) > 0.0);
            let opposite = query
                .classify(&complement, Configuration::Coordinates(&q0))
                .unwrap();
            // What bodies stand for may differ, so that nothing is out of the complement.
            assert_eq!(opposite, Class::Inside);
            let way = |t: f64| scene.space.interpolate(&q0, &q1, t);
            let found = query.motion_certificate(&scene.cobject, &q0, &q1, &options);
            let (answer, certificate) = found.unwrap();
            if answer.outcome == MotionOutcome::Free {
                free += 1;
                for i in 0..=100 {
                    assert!(at(&way(f64::from(i) / 100.0)) > threshold);
                }
                certificate
                    .unwrap()
                    .verify(&scene.cobject, &q0, &q1, threshold)
                    .unwrap();
            } else {
                hit += 1;
                let before = way(answer.times[0] * 0.999);
                assert!(answer.times[0] == 0.0 || at(&before) > threshold);
            }
            let answer = query.motion(&complement, &q0, &q1, &MotionOptions::default());
            assert_ne!(answer.unwrap().outcome, MotionOutcome::Free);
            let tolerance = ClearanceOptions {
                tolerance: 1e-3,
                relative_tolerance: 0.0,
                max_distance: f64::INFINITY,
            };
            let clearance = query.motion_clearance(&scene.cobject, &q0, &q1, &tolerance);
            let clearance = clearance.unwrap();
            let least = (0..=200).map(|i| at(&way(f64::from(i) / 200.0)));
            let least = least.fold(f64::INFINITY, f64::min);
            assert!(clearance.lower <= least);
            assert!(at(&clearance.configuration) <= clearance.upper);
            narrow += usize::from(clearance.outcome == ClearanceOutcome::Known);
            let region: [Vec<f64>; 2] = [-0.1, 0.1].map(|by| q0.iter().map(|x| x + by).collect());
            let options = RegionOptions { max_boxes: 200 };
            let [low, high] = &region;
            let answer = query.classify_region(&scene.cobject, low, high, &options);
            match answer.unwrap().outcome {
                RegionOutcome::Free => {
                    boxes += 1;
                    for _ in 0..50 {
                        let q: Vec<f64> = (low.iter().zip(high))
                            .map(|(low, high)| random.within(*low, *high))
                            .collect();
                        assert!(at(&q) > 0.0);
                    }
                }
                RegionOutcome::Inside => {
                    // Only the exact balls, and the moving one is not.
                    panic!("that approximate bodies meet is never proved");
                }
                RegionOutcome::Mixed | RegionOutcome::Undecided => {}
            }
        }
    }
    assert!(
        free > 60 && hit > 60 && boxes > 60 && narrow > 60,
        "{free} {hit} {boxes} {narrow}"
    );
}

/// Two bodies without a robot: the time of contact is that of the grown meshes, before that of the balls.
#[test]
fn moving_pairs_stop_before_what_they_stand_for_meets() {
    let [a, b] = [0.0, 1.0].map(|growth| Ball::new(Kind::Hull, 0.5, 8, growth));
    let stated = a.deviation + b.deviation;
    let mut random = Random::new(2104);
    let mut query = QueryContext::new();
    for _ in 0..100 {
        let start = Pose {
            rotation: random.rotation(),
            translation: Vec3::x() * -3.0,
        };
        let end = Pose {
            translation: Vec3::x() * 3.0,
            ..start
        };
        let rest = Pose {
            rotation: random.rotation(),
            translation: Vec3::zeros(),
        };
        let moving = PairMotion {
            body: &a.body,
            poses: [&start, &end],
        };
        let still = PairMotion {
            body: &b.body,
            poses: [&rest, &rest],
        };
        let answer = query.pair_motion(&moving, &still, &MotionOptions::default());
        let answer = answer.unwrap();
        assert_eq!(answer.outcome, MotionOutcome::Hit);
        let at = |t: f64| -3.0 + 6.0 * t;
        assert!(at(answer.times[0]) <= -1.0 && at(answer.times[1]) >= -1.0 - 2.0 * stated - 1e-3);
    }
}
