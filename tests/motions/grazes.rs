//! Motions that come within rounding of contact for long: where distances jitter about what rounding may take off, a proof must not creep
//! on by what single ones allow.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::HierarchyOptions;
use cstk::motion::{MotionOptions, MotionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::JointKind;

use helpers::robots::{against, environment, link, robot, space};

fn block(rows: [f64; 12], half: [f64; 3]) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    let pose = Pose::from_row_major(&rows).unwrap();
    builder.add_box(&pose, &half.into(), 0).unwrap();
    let built = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(built.unwrap())
}

/// A block shifted by 2e8 times its gap, along a face of another: the gap shrinks from 1.7e-16 to nothing, and what rounding may take off
/// it is 6.5e-18. Without an end to it the proof would look at 1e13 intervals.
#[test]
fn a_block_along_a_face_is_near_at_once() {
    #[rustfmt::skip]
    let moving = block([
        0.7463283470606982, 0.4343550444119141, 0.5043111081143961, 6.263203141178731e-5,
        0.49966939347499895, 0.13490109874057166, -0.8556472350115514, 1.2826283792498361e-06,
        -0.4396868153560812, 0.8905826120874529, -0.11635340755438461, -1.0285749802361743e-07,
    ], [1.533990156562089e-6, 1.09710361982037e-06, 2.695247549771473e-07]);
    #[rustfmt::skip]
    let resting = block([
        1.0, 0.0, 0.0, 4.192891372359205e-5,
        0.0, 1.0, 0.0, -3.6113953164819086e-07,
        0.0, 0.0, 1.0, -1.582760508131294e-5,
    ], [3.201344350540092e-8, 1.4300823854642233e-08, 2.6932160528202633e-08]);
    #[rustfmt::skip]
    let at = Pose::from_row_major(&[
        -0.08430823929134146, -0.7140582383807296, 0.6949913330309976, 7.774503841026051e-5,
        0.9666290250696378, -0.22793753367159608, -0.11693078566669896, -4.082309345913556e-5,
        0.24191000119985823, 0.6619405660210884, 0.7094464309411709, -4.589907462386289e-7,
    ]);
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let mut links: Vec<_> = (0..3)
        .map(|i: usize| link(i.checked_sub(1), JointKind::Prismatic, axes[i]))
        .collect();
    links[2].body = Some(moving);
    let space = space(vec![robot(3, links)]);
    let (environment, _) = environment(&[(&resting, at.unwrap())]);
    let set = against(&space, &environment);
    let end = [
        -2.7001864568017644e-09,
        2.877211351918096e-09,
        -3.286205546285142e-8,
    ];
    let context = &mut QueryContext::new();
    let start = context.distance(&set, Configuration::Coordinates(&[0.0; 3]), 1.0);
    let start = start.unwrap().distance;
    assert!((1.6e-16..1.8e-16).contains(&start), "{start:e}");
    context.set_limit(Some(2000));
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let options = MotionOptions {
            tolerance,
            ..MotionOptions::default()
        };
        let found = context.motion(&set, &[0.0; 3], &end, &options).unwrap();
        assert_eq!(found.outcome, MotionOutcome::Near);
        let [from, to] = found.times;
        assert!(to - from <= tolerance && from > 0.9, "{from} {to}");
    }
}
