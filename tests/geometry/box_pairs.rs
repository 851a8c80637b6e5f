//! Pairs of boxes: whether they are within a distance of one another, against closed forms where their edges are parallel and
//! against their distances where they nearly are.

use cstk::body::{Body, BodyBuilder};
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::QueryContext;
use helpers::models::built;
use helpers::random::Random;

fn box_of(half: &Vec3) -> Body {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_box(&Pose::identity(), half, 0).unwrap();
    built(&builder, &Default::default())
}

fn half(random: &mut Random) -> Vec3 {
    Vec3::from([0; 3].map(|_| 10f64.powf(random.within(-2.0, 0.0))))
}

/// Two boxes turned alike, A at the origin of `frame` and B off by `offset` in it.
fn parallel(frame: &Pose, offset: &Vec3) -> (Pose, Pose) {
    let b = frame.compose(&Pose::from_translation(*offset));
    (*frame, b)
}

/// How far one box is off another, whose half sides add up to `sums`: a face, an edge or a corner nearest, by a gap between two
/// powers of ten, of either sign.
fn off_by_a_gap(random: &mut Random, case: usize, sums: &Vec3, powers: [f64; 2]) -> Vec3 {
    let sign = if case.is_multiple_of(2) { 1.0 } else { -1.0 };
    let gap = sign * 10f64.powf(random.within(powers[0], powers[1]));
    let mut offset = Vec3::from([0, 1, 2].map(|k| random.within(-0.95, 0.95) * sums[k]));
    for k in 0..=(case / 2 % 3) {
        offset[k] = (sums[k] + gap).max(0.0).copysign(offset[k]);
    }
    offset
}

#[test]
fn parallel_boxes_are_within_what_their_sides_say() {
    let mut random = Random::new(71);
    let mut query = QueryContext::new();
    let (mut near, mut far) = (0, 0);
    for case in 0..4000 {
        let (a, b) = (half(&mut random), half(&mut random));
        let frame = random.pose(2.0);
        let sums = a + b;
        let offset = off_by_a_gap(&mut random, case, &sums, [-13.0, 0.0]);
        let beyond = Vec3::from([0, 1, 2].map(|k| (offset[k].abs() - sums[k]).max(0.0)));
        let distance = beyond.norm();
        let (bodies, poses) = ([box_of(&a), box_of(&b)], parallel(&frame, &offset));
        let doubt = 1e-14 * (1.0 + frame.translation.norm() + offset.norm() + sums.norm());
        for threshold in [
            0.0,
            0.5 * distance,
            distance - 4.0 * doubt,
            distance + 4.0 * doubt,
            2.0,
        ] {
            if threshold < 0.0 || (threshold - distance).abs() < doubt {
                continue;
            }
            let is_within = query
                .pair_within((&bodies[0], &poses.0), (&bodies[1], &poses.1), threshold)
                .unwrap();
            assert_eq!(
                is_within,
                distance <= threshold,
                "case {case}: {distance} {threshold}"
            );
            near += usize::from(is_within);
            far += usize::from(!is_within);
        }
    }
    assert!(near > 5000 && far > 3000, "{near} {far}");
}

#[test]
fn boxes_turned_by_little_are_within_their_distance() {
    let mut random = Random::new(72);
    let mut query = QueryContext::new();
    let (mut met, mut apart) = (0, 0);
    for case in 0..6000 {
        let (a, b) = (half(&mut random), half(&mut random));
        let sums = a + b;
        let offset = off_by_a_gap(&mut random, case, &sums, [-12.0, -1.0]);
        let angle = 10f64.powf(random.within(-16.0, 0.0));
        let turn = Pose {
            rotation: rotation_about(&random.unit(), angle),
            translation: offset,
        };
        let frame = random.pose(1.0);
        let (bodies, poses) = ([box_of(&a), box_of(&b)], [frame, frame.compose(&turn)]);
        let sides = [0, 1].map(|i| (&bodies[i], &poses[i]));
        let found = query
            .pair_distance(sides[0], sides[1], f64::INFINITY)
            .unwrap();
        for threshold in [0.0, 0.99 * found.lower, found.lower, found.upper] {
            let is_within = query.pair_within(sides[0], sides[1], threshold).unwrap();
            assert_eq!(
                is_within,
                found.lower <= threshold,
                "case {case}: {threshold} {found:?}"
            );
        }
        met += usize::from(found.distance == 0.0);
        apart += usize::from(found.distance > 0.0);
    }
    assert!(met > 2000 && apart > 2000, "{met} {apart}");
}
