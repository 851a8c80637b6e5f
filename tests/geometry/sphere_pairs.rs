//! Pairs of bodies of one sphere each, which have a path of their own: against their centres and radii, and against the list of
//! witnesses, which takes the path of all primitives.

use cstk::body::{Body, BodyBuilder};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use helpers::models::built;
use helpers::random::Random;

struct Ball {
    body: Body,
    center: Vec3,
    radius: f64,
}

impl Ball {
    /// Off the origin of its body, by much or not at all.
    fn drawn(random: &mut Random) -> Self {
        let far = [0.0, 1.0, 1e3][random.below(3)];
        let (center, radius) = (random.point(far), 10f64.powf(random.within(-2.0, 0.0)));
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_sphere(&center, radius, 7).unwrap();
        let body = built(&builder, &Default::default());
        Self {
            body,
            center,
            radius,
        }
    }
}

/// Poses that bring the centres of two balls as far apart as their radii and `gap`. Also the largest coordinate on the way.
fn poses(random: &mut Random, [a, b]: [&Ball; 2], gap: f64) -> ([Pose; 2], f64) {
    let turns = [random.pose(0.0), random.pose(0.0)];
    let far = [1.0, 1e4][random.below(2)];
    let at = random.point(far);
    let away = random.unit() * (a.radius + b.radius + gap).max(0.0);
    let placed = |turn: Pose, center: Vec3, to: Vec3| Pose {
        translation: to - turn.rotation * center,
        ..turn
    };
    let pair = [
        placed(turns[0], a.center, at),
        placed(turns[1], b.center, at + away),
    ];
    let largest = at.norm() + away.norm() + a.center.norm() + b.center.norm();
    (pair, largest)
}

/// Gaps of either sign, most of them small, that leave the centres apart.
fn gap(random: &mut Random, [a, b]: [&Ball; 2]) -> f64 {
    let size = 10f64.powf(random.within(-12.0, 0.0));
    match random.below(2) {
        0 => size,
        _ => -0.9 * size * (a.radius + b.radius),
    }
}

#[test]
fn spheres_are_as_far_apart_as_their_centres_less_their_radii() {
    let mut random = Random::new(91);
    let mut query = QueryContext::new();
    let mut met = 0;
    for _ in 0..4000 {
        let (a, b) = (Ball::drawn(&mut random), Ball::drawn(&mut random));
        let gap = gap(&mut random, [&a, &b]);
        let (at, largest) = poses(&mut random, [&a, &b], gap);
        let centers = [
            at[0].transform_point(&a.center),
            at[1].transform_point(&b.center),
        ];
        let between = centers[0] - centers[1];
        let signed = between.norm() - a.radius - b.radius;
        // The rounding of the centres here, in the world.
        let rounding = 4e-15 * largest + 1e-14;
        let sides = ((&a.body, &at[0]), (&b.body, &at[1]));
        let found = query
            .pair_distance(sides.0, sides.1, f64::INFINITY)
            .unwrap();
        assert!(
            (found.distance - signed.max(0.0)).abs() <= rounding,
            "{signed} {found:?}"
        );
        assert!(found.lower <= signed.max(0.0) + rounding && found.upper >= signed - rounding);
        assert!(found.lower <= found.distance && found.distance <= found.upper);
        assert_eq!(found.witness.unwrap().tags, [7, 7]);
        let [on_a, on_b] = found.points;
        assert!((on_a - centers[0]).norm() <= a.radius + rounding);
        assert!((on_b - centers[1]).norm() <= b.radius + rounding);
        assert!(((on_a - on_b).norm() - found.distance).abs() <= rounding);
        let contact = found.contact.unwrap();
        assert!(
            (contact.clearance - signed).abs() <= rounding,
            "{signed} {found:?}"
        );
        let turned = (contact.normal - between.normalize()).norm();
        assert!(turned * between.norm() <= 2.0 * rounding, "{turned}");
        assert!((contact.points[0] - centers[0] + contact.normal * a.radius).norm() <= rounding);
        assert!((contact.points[1] - centers[1] - contact.normal * b.radius).norm() <= rounding);
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
    assert!((1000..3000).contains(&met), "{met}");
}

#[test]
fn spheres_have_the_bits_of_their_witness_list() {
    let mut random = Random::new(92);
    let mut query = QueryContext::new();
    for _ in 0..4000 {
        let (a, b) = (Ball::drawn(&mut random), Ball::drawn(&mut random));
        // Some of the centres are hardly apart, or not at all.
        let gap = match random.below(3) {
            0 => 10f64.powf(random.within(-17.0, -1.0)) - a.radius - b.radius,
            _ => gap(&mut random, [&a, &b]),
        };
        let (at, _) = poses(&mut random, [&a, &b], gap);
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
            list.contacts.first().map(all)
        );
    }
}
