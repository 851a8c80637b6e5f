//! Depths do not depend on the frames in which bodies are given: bounds of the same bodies in other frames do not contradict each other.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::Pose;
use cstk::query::{DepthOptions, PairDepth, QueryContext};

use helpers::random::Random;
use helpers::shapes::hull;
use helpers::surfaces::{cube, hollow_cube, shifted, solid, torus};

fn built(add: impl FnOnce(&mut BodyBuilder)) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    add(&mut builder);
    let built = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(built.unwrap())
}

fn bodies(random: &mut Random) -> Vec<Arc<Body>> {
    let corners = random.points(4, 0.5);
    vec![
        solid(&hollow_cube()),
        solid(&[torus(1.0, 0.4, 12, 8)]),
        solid(&[cube(0.5), shifted(&cube(0.3), [0.7, 0.2, 0.1])]),
        hull(&random.points(9, 0.7)).body,
        built(|builder| builder.add_rounded_polyhedron(&corners, 0.2, 0).unwrap()),
        built(|builder| {
            builder
                .add_capsule(&corners[0], &corners[1], 0.2, 0)
                .unwrap();
            builder.add_sphere(&corners[2], 0.3, 0).unwrap();
        }),
    ]
}

/// The same body in a frame at `frame` of its own.
fn seen_from(body: &Arc<Body>, frame: &Pose) -> Arc<Body> {
    built(|builder| builder.add_body(body, &frame.inverse(), 0).unwrap())
}

fn depth(a: (&Body, &Pose), b: (&Body, &Pose)) -> PairDepth {
    let options = DepthOptions {
        tolerance: 0.02,
        max_steps: 150,
    };
    QueryContext::new().pair_depth(a, b, &options).unwrap()
}

#[test]
fn bounds_in_other_frames_do_not_contradict_each_other() {
    let mut random = Random::new(23);
    let mut deep = 0;
    for case in 0..3 {
        let bodies = bodies(&mut random);
        for a in &bodies {
            for b in &bodies {
                let poses = [random.pose(0.6), random.pose(0.6)];
                let plain = depth((a, &poses[0]), (b, &poses[1]));
                let frames = [random.pose(2.0), random.pose(2.0)];
                let others = [seen_from(a, &frames[0]), seen_from(b, &frames[1])];
                let moved = [0, 1].map(|i| poses[i].compose(&frames[i]));
                let other = depth((&others[0], &moved[0]), (&others[1], &moved[1]));
                let slack = 1e-9;
                assert!(
                    plain.lower <= other.upper + slack && other.lower <= plain.upper + slack,
                    "case {case}: {plain:?} {other:?}"
                );
                // And by the definition.
                let away = Pose {
                    translation: poses[0].translation + other.translation,
                    ..poses[0]
                };
                let meets = QueryContext::new().pair_within((a, &away), (b, &poses[1]), 0.0);
                assert!(
                    !meets.unwrap() || other.upper == 0.0,
                    "case {case}: {other:?}"
                );
                deep += usize::from(plain.lower > 0.05);
            }
        }
    }
    assert!(deep > 50, "{deep}");
}
