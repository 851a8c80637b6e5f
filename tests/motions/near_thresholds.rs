//! Margins just below the distance, of fine surfaces that lie in any direction from each other: the boxes of these part along the line
//! between them where no face of theirs does, so that few are looked at.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{CObject, InducedOptions};
use cstk::motion::{ClearanceOptions, MotionOptions, MotionOutcome, RegionOptions, RegionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::robot::JointKind;

use helpers::random::Random;
use helpers::robots::{against_with, environment, link, robot, space};
use helpers::shapes::mesh;

/// A wavy sheet of twice `count` squared triangles.
fn sheet(count: u32) -> Arc<Body> {
    let at = |i: u32| f64::from(i) / f64::from(count) * 0.3 - 0.15;
    let mut vertices = Vec::new();
    for (i, j) in (0..=count).flat_map(|i| (0..=count).map(move |j| (i, j))) {
        let (x, y) = (at(i), at(j));
        vertices.push(Vec3::new(x, y, 0.03 * (20.0 * x).sin() * (13.0 * y).cos()));
    }
    let mut triangles = Vec::new();
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
        let first = i * (count + 1) + j;
        let [a, b, c, d] = [first, first + 1, first + count + 1, first + count + 2];
        triangles.extend([[a, b, c], [b, d, c]]);
    }
    mesh(&vertices, &triangles).body
}

/// A strip of long thin triangles.
fn strip(count: u32) -> Arc<Body> {
    let width = 0.6 / f64::from(count);
    let mut vertices = Vec::new();
    for i in 0..count {
        let (y, z) = (width * f64::from(i) - 0.3, 0.03 * f64::from(i).sin());
        vertices.extend([
            Vec3::new(-0.3, y, 0.0),
            Vec3::new(0.3, y, z),
            Vec3::new(0.3, y + width, 0.03),
        ]);
    }
    let triangles: Vec<[u32; 3]> = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    mesh(&vertices, &triangles).body
}

/// A body turns about y, against another one.
fn turning([body, other]: [&Arc<Body>; 2], at: Pose, margin: f64) -> CObject {
    let mut turn = link(None, JointKind::Revolute, Vec3::y());
    turn.body = Some(body.clone());
    let space = space(vec![robot(3, vec![turn])]);
    let (environment, _) = environment(&[(other, at)]);
    let options = InducedOptions {
        margin,
        ..InducedOptions::default()
    };
    against_with(&space, &environment, options)
}

#[test]
fn margins_just_below_the_distance_are_proved_by_few_boxes() {
    /// Of some 10^7 pairs of triangles.
    const MAX_LOOKS: u64 = 20_000;
    /// Of regions that are proved to be inside.
    const MAX_LOOKS_INSIDE: u64 = 50_000;
    let mut random = Random::new(31);
    let (sheet, strip) = (sheet(40), strip(3000));
    let (q0, q1) = ([0.0], [0.28]);
    for case in 0..24 {
        let bodies = [
            [&sheet, &sheet],
            [&strip, &sheet],
            [&sheet, &strip],
            [&strip, &strip],
        ];
        let bodies = bodies[case % 4];
        let diagonal = Vec3::new(1.0, 1.0, 1.0).normalize();
        let direction = if case < 4 { diagonal } else { random.unit() };
        let other = Pose {
            translation: direction * random.within(0.9, 3.0),
            rotation: random.rotation(),
        };
        let mut context = QueryContext::new();
        let options = ClearanceOptions::with_tolerance(1e-3);
        let plain = turning(bodies, other, 0.0);
        let clearance = context.motion_clearance(&plain, &q0, &q1, &options);
        let clearance = clearance.unwrap();
        // Long triangles lie across most directions: the nearer to the distance, the more times are looked at too.
        let parts: &[f64] = match case % 4 {
            0 => &[0.8, 0.9, 0.97, 0.99],
            _ => &[0.8, 0.9, 0.95],
        };
        for &part in parts {
            let set = turning(bodies, other, part * clearance.lower);
            let mut looks = |ask: &mut dyn FnMut(&mut QueryContext)| {
                context.reset_statistics();
                ask(&mut context);
                let work = context.statistics();
                let looks = work.node_pairs + work.primitive_pairs;
                assert!(looks < MAX_LOOKS, "case {case} at {part}: {looks}");
            };
            looks(&mut |context| {
                let found = context.motion(&set, &q0, &q1, &MotionOptions::default());
                assert_eq!(found.unwrap().outcome, MotionOutcome::Free);
            });
            looks(&mut |context| {
                let found = context.classify_region(&set, &q0, &q1, &RegionOptions::default());
                assert_eq!(found.unwrap().outcome, RegionOutcome::Free);
            });
        }
        // What is nearer than the margin is never called free.
        for part in [1.0001, 1.01, 1.1, 1.5] {
            let set = turning(bodies, other, part * clearance.upper);
            let found = context.motion(&set, &q0, &q1, &MotionOptions::default());
            assert_ne!(found.unwrap().outcome, MotionOutcome::Free, "case {case}");
            context.reset_statistics();
            let found = context.classify_region(&set, &q0, &q1, &RegionOptions::default());
            let outcome = found.unwrap().outcome;
            assert_ne!(outcome, RegionOutcome::Free, "case {case} at {part}");
            let work = context.statistics();
            let looks = work.node_pairs + work.primitive_pairs;
            assert!(
                outcome == RegionOutcome::Mixed || looks < MAX_LOOKS_INSIDE,
                "case {case} at {part}: {looks}"
            );
        }
    }
}
