//! Pairs of bodies of one sphere or capsule each, which have a path of their own: against their axes and radii, and against the list
//! of witnesses, which takes the path of all primitives.

use cstk::body::{Body, BodyBuilder};
use cstk::pose::{Pose, Vec3};
use cstk::primitive::FeatureKind;
use cstk::query::QueryContext;
use helpers::models::built;
use helpers::random::Random;

/// All points within the radius of the segment between two ends, or of the first of them.
struct Round {
    body: Body,
    ends: [Vec3; 2],
    is_capsule: bool,
    radius: f64,
}

impl Round {
    /// Off the origin of its body, by much or not at all.
    fn drawn(random: &mut Random) -> Self {
        let far = [0.0, 1.0, 1e3][random.below(3)];
        let along = random.unit() * 10f64.powf(random.within(-2.0, 0.0));
        Self::along(random, far, along)
    }

    fn along(random: &mut Random, far: f64, along: Vec3) -> Self {
        let (start, radius) = (random.point(far), 10f64.powf(random.within(-2.0, 0.0)));
        let ends = [start, start + along];
        let is_capsule = random.below(3) > 0;
        let mut builder = BodyBuilder::new(3).unwrap();
        let added = match is_capsule {
            true => builder.add_capsule(&ends[0], &ends[1], radius, 7),
            false => builder.add_sphere(&start, radius, 7),
        };
        added.unwrap();
        Self {
            body: built(&builder, &Default::default()),
            ends,
            is_capsule,
            radius,
        }
    }

    /// The point of its axis at a share of the way from end to end.
    fn at(&self, share: f64) -> Vec3 {
        let [start, end] = self.ends;
        match self.is_capsule {
            true => start + (end - start) * share,
            false => start,
        }
    }
}

/// The ends of an axis in the world.
fn placed(round: &Round, pose: &Pose) -> [Vec3; 2] {
    [0.0, 1.0].map(|share| pose.transform_point(&round.at(share)))
}

/// Poses that bring some points of the axes of two rounds as far apart as their radii and `gap`. Also the largest coordinate on the way.
fn poses(random: &mut Random, [a, b]: [&Round; 2], gap: f64) -> ([Pose; 2], f64) {
    let turns = [random.pose(0.0), random.pose(0.0)];
    let far = [1.0, 1e4][random.below(2)];
    let at = random.point(far);
    let away = random.unit() * (a.radius + b.radius + gap).max(0.0);
    let mut share = || [0.0, 1.0, random.within(0.0, 1.0)][random.below(3)];
    let points = [a.at(share()), b.at(share())];
    let posed = |turn: Pose, point: Vec3, to: Vec3| Pose {
        translation: to - turn.rotation * point,
        ..turn
    };
    let pair = [
        posed(turns[0], points[0], at),
        posed(turns[1], points[1], at + away),
    ];
    let largest = at.norm() + away.norm() + a.at(0.0).norm() + b.at(0.0).norm() + 3.0;
    (pair, largest)
}

/// Gaps of either sign, most of them small, that leave the points apart.
fn gap(random: &mut Random, [a, b]: [&Round; 2]) -> f64 {
    let size = 10f64.powf(random.within(-12.0, 0.0));
    match random.below(2) {
        0 => size,
        _ => -0.9 * size * (a.radius + b.radius),
    }
}

/// The point of a segment nearest to another point.
fn foot([start, end]: [Vec3; 2], point: &Vec3) -> Vec3 {
    let along = end - start;
    match along.norm_squared() {
        0.0 => start,
        square => start + along * (along.dot(&(point - start)) / square).clamp(0.0, 1.0),
    }
}

/// The distance of two segments. That of a point of the one from the other is convex along the one: cut to a third, over and over.
fn segment_distance(p: [Vec3; 2], q: [Vec3; 2]) -> f64 {
    let at = |share: f64| p[0] + (p[1] - p[0]) * share;
    let apart = |share: f64| (at(share) - foot(q, &at(share))).norm();
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..100 {
        let third = (high - low) / 3.0;
        if apart(low + third) <= apart(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    [0.0, 1.0, 0.5 * (low + high)]
        .map(apart)
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn rounds_are_as_far_apart_as_their_axes_less_their_radii() {
    let mut random = Random::new(91);
    let mut query = QueryContext::new();
    let (mut met, mut without, mut on_edges) = (0, 0, 0);
    for case in 0..8000 {
        let (a, b) = (Round::drawn(&mut random), Round::drawn(&mut random));
        let gap = gap(&mut random, [&a, &b]);
        let (at, largest) = poses(&mut random, [&a, &b], gap);
        let axes = [placed(&a, &at[0]), placed(&b, &at[1])];
        let apart = segment_distance(axes[0], axes[1]);
        let signed = apart - a.radius - b.radius;
        // The rounding of the axes here, in the world, and of the thirds.
        let rounding = 4e-15 * largest + 2e-14;
        let sides = ((&a.body, &at[0]), (&b.body, &at[1]));
        let found = query
            .pair_distance(sides.0, sides.1, f64::INFINITY)
            .unwrap();
        assert!(
            (found.distance - signed.max(0.0)).abs() <= rounding,
            "{case} {signed} {found:?}"
        );
        assert!(found.lower <= signed.max(0.0) + rounding && found.upper >= signed - rounding);
        assert!(found.lower <= found.distance && found.distance <= found.upper);
        assert_eq!(found.witness.unwrap().tags, [7, 7]);
        // The points are on the sets, as far apart as these.
        let [on_a, on_b] = found.points;
        let off = |point: &Vec3, axis: [Vec3; 2]| (point - foot(axis, point)).norm();
        assert!(off(&on_a, axes[0]) <= a.radius + rounding, "{case}");
        assert!(off(&on_b, axes[1]) <= b.radius + rounding, "{case}");
        assert!(((on_a - on_b).norm() - found.distance).abs() <= rounding);
        match found.contact {
            // Axes that meet have no normal.
            None => {
                assert!(apart < 1e-6 * largest, "{case} {apart} {found:?}");
                without += 1;
            }
            Some(contact) => {
                assert!(
                    (contact.clearance - signed).abs() <= rounding,
                    "{case} {signed} {found:?}"
                );
                assert!((contact.normal.norm() - 1.0).abs() < 1e-14);
                let [to_a, to_b] = contact.points;
                let across = to_a - to_b - contact.normal * contact.clearance;
                assert!(across.norm() <= 4.0 * rounding, "{case} {found:?}");
                for (side, (point, radius)) in [(to_a, a.radius), (to_b, -b.radius)]
                    .into_iter()
                    .enumerate()
                {
                    let on_axis = point + contact.normal * radius;
                    let axis = axes[side];
                    assert!(off(&on_axis, axis) <= 4.0 * rounding, "{case} {found:?}");
                    let feature = contact.features[side];
                    let near = |end: &Vec3| (end - on_axis).norm() <= 4.0 * rounding;
                    match feature.kind {
                        FeatureKind::Vertex => assert!(near(&axis[feature.index as usize])),
                        FeatureKind::Edge => {
                            let along = (axis[1] - axis[0]).normalize();
                            let turned = along.dot(&contact.normal).abs();
                            assert!(turned * apart <= 4.0 * rounding, "{case} {turned}");
                            on_edges += 1;
                        }
                        _ => panic!("{feature:?}"),
                    }
                }
            }
        }
        // No threshold contradicts the bounds of the distance.
        let mut within = |t: f64| query.pair_within(sides.0, sides.1, t).unwrap();
        assert_eq!(within(0.0), found.distance == 0.0);
        assert!(within(found.lower) && within(found.distance) && within(found.upper));
        if found.distance > 0.0 {
            assert!(!within(found.lower.next_down()), "{found:?}");
            let up_to = |most: f64| QueryContext::new().pair_distance(sides.0, sides.1, most);
            assert_eq!(up_to(found.distance).unwrap().distance, found.distance);
            let beyond = up_to(found.distance.next_down()).unwrap();
            assert!(beyond.distance == f64::INFINITY && beyond.lower <= found.lower);
        } else {
            met += 1;
        }
    }
    assert!((1000..7000).contains(&met), "{met}");
    assert!(without < 200 && on_edges > 2000, "{without} {on_edges}");
}

/// The same bits, contacts and features: also of axes that are parallel, hardly apart, or cross.
#[test]
fn rounds_have_the_bits_of_their_witness_list() {
    let mut random = Random::new(92);
    let mut query = QueryContext::new();
    for case in 0..8000 {
        let a = Round::drawn(&mut random);
        let b = match random.below(3) {
            0 => {
                // About parallel where poses do not turn one alone.
                let tilt = random.unit() * 10f64.powf(random.within(-17.0, -3.0));
                let along = (a.ends[1] - a.ends[0] + tilt) * random.within(-1.5, 1.5);
                Round::along(&mut random, 1.0, along)
            }
            _ => Round::drawn(&mut random),
        };
        // Some of the points are hardly apart, or not at all.
        let gap = match random.below(3) {
            0 => 10f64.powf(random.within(-17.0, -1.0)) - a.radius - b.radius,
            _ => gap(&mut random, [&a, &b]),
        };
        let (mut at, _) = poses(&mut random, [&a, &b], gap);
        if random.below(2) == 0 {
            at[1].rotation = at[0].rotation;
        }
        let sides = ((&a.body, &at[0]), (&b.body, &at[1]));
        let found = query
            .pair_distance(sides.0, sides.1, f64::INFINITY)
            .unwrap();
        let list = query
            .pair_witnesses(sides.0, sides.1, f64::INFINITY, 1)
            .unwrap();
        assert_eq!(found.distance, list.witnesses[0].distance);
        let all = |c: &cstk::query::ContactRecord| {
            let places = [c.points[0], c.points[1], c.normal];
            (places, [c.distance, c.clearance], c.mode, c.features)
        };
        assert_eq!(
            found.contact.as_ref().map(all),
            list.contacts.first().map(all),
            "{case}"
        );
    }
}

/// Where the axis of a capsule or the centre of a ball is in a box, one point of both is the answer: of the axis, and in the box.
#[test]
fn axes_in_boxes_have_a_point_in_common_with_them() {
    let mut random = Random::new(93);
    let mut query = QueryContext::new();
    let mut met = 0;
    for case in 0..20_000 {
        let half = Vec3::from([0; 3].map(|_| 10f64.powf(random.within(-2.0, 1.0))));
        let frame = random.pose(1.0);
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_box(&frame, &half, 7).unwrap();
        let solid = built(&builder, &Default::default());
        let round = Round::drawn(&mut random);
        let mut at = [random.pose(1.0), random.pose(1.0)];
        // A point of the axis is somewhere in the box.
        let wanted = half.map(|half| random.within(-0.999_9, 0.999_9) * half);
        let wanted = at[1].transform_point(&frame.transform_point(&wanted));
        let share = random.within(0.0, 1.0);
        at[0].translation += wanted - at[0].transform_point(&round.at(share));
        let size = at[0].translation.norm() + round.ends[0].norm() + 30.0;
        let found = query
            .pair_distance((&round.body, &at[0]), (&solid, &at[1]), f64::INFINITY)
            .unwrap();
        assert_eq!(found.distance, 0.0, "{case}");
        let [on_round, on_solid] = found.points;
        assert_eq!(on_round, on_solid);
        let in_box = frame
            .inverse()
            .transform_point(&at[1].inverse().transform_point(&on_solid));
        let outside = (in_box.abs() - half).max();
        let axis = placed(&round, &at[0]);
        let from_axis = (on_round - foot(axis, &on_round)).norm();
        assert!(outside <= 1e-13 * size, "{case}: {outside}");
        assert!(from_axis <= round.radius, "{case}: {from_axis}");
        if outside < -1e-3 {
            met += 1;
            assert!(from_axis <= 1e-13 * size, "{case}: {from_axis}");
        }
    }
    assert!(met > 5000, "{met}");
}
