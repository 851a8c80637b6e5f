//! What is culled by boxes and balls, in the tree over an environment's objects and in those of bodies, is never what a
//! query asks for.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, DistanceKind, QueryContext};
use cstk::robot::JointKind;

use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::box_corners;

fn body(parts: &[Vec<Vec3>]) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    for points in parts {
        builder.add_polyhedron(points, 0).unwrap();
    }
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

/// Pairs of slabs face each other along an axis that no grid of numbers holds: boxes whose axes are a little too
/// long must not seem farther apart than the slabs are.
#[test]
fn thresholds_just_above_the_distance_are_met() {
    let mut random = Random::new(5);
    for case in 0..300 {
        let turn = random.rotation();
        let slab = |aside: f64| -> Vec<Vec3> {
            let aside = Vec3::new(0.0, aside, 0.0);
            let corners = box_corners([0.02, 0.3, 0.2]);
            corners.iter().map(|c| turn * (c + aside)).collect()
        };
        let body = body(&[slab(-0.2), slab(0.2)]);
        let apart = [0.2, 0.8, 3.0, 50.0][case % 4];
        let pose = Pose::from_translation(turn * Vec3::new(apart, 0.0, 0.0));
        let mut context = QueryContext::new();
        let (a, b) = ((&*body, &Pose::identity()), (&*body, &pose));
        let found = context.pair_distance(a, b, f64::INFINITY).unwrap();
        assert!((found.distance - (apart - 0.02)).abs() < 1e-12 * apart);
        let threshold = found.distance * (1.0 + 1e-9);
        let mut cold = QueryContext::new();
        assert!(cold.pair_within(a, b, threshold).unwrap(), "case {case}");
        let limited = cold.pair_distance(a, b, threshold).unwrap();
        assert_eq!(limited.kind, DistanceKind::Exact, "case {case}");

        // The same among objects, of which another one is hardly farther.
        let mut base = link(None, JointKind::Prismatic, Vec3::x());
        base.body = Some(body.clone());
        let space = space(vec![robot(3, vec![base])]);
        let further = Pose::from_translation(turn * Vec3::new(-apart * (1.0 + 1e-6), 0.0, 0.0));
        let (environment, ids) = environment(&[(&body, further), (&body, pose)]);
        let cobject = against(&space, &environment);
        let at = Configuration::Coordinates(&[0.0]);
        let nearest = QueryContext::new()
            .distance(&cobject, at, f64::INFINITY)
            .unwrap();
        assert_eq!(nearest.distance, found.distance, "case {case}");
        let side = nearest.witness.unwrap().s_side;
        assert_eq!(side, cstk::query::SSide::Object(ids[1]));
        let within = QueryContext::new().within(&cobject, at, threshold);
        assert!(within.unwrap(), "case {case}");
    }
}

/// Rods modelled 1e6 from their own origin and brought to the world's, end to end with others: what rounding does to the
/// places of their bounds must not hide how near they are.
#[test]
fn bodies_brought_back_from_far_away_are_not_lost() {
    let mut random = Random::new(6);
    for case in 0..400 {
        let (away, along) = (random.unit() * 1e6, random.unit());
        let far = body(&[vec![away - along, away + along]]);
        let rotation = random.rotation();
        let pose = Pose {
            rotation,
            translation: -(rotation * away),
        };
        let near = body(&[vec![Vec3::zeros(), 2.0 * (rotation * along)]]);
        let lap = random.within(-1e-9, 1e-9);
        let other = Pose::from_translation(rotation * along * (1.0 + lap));
        let pair = ((&*far, &pose), (&*near, &other));
        let mut context = QueryContext::new();
        let distance = context.pair_distance(pair.0, pair.1, 1.0).unwrap();
        assert!(distance.distance < 2e-9);

        let mut base = link(None, JointKind::Prismatic, Vec3::x());
        base.body = Some(far.clone());
        let space = space(vec![robot(3, vec![base])]);
        let (environment, _) = environment(&[(&near, other)]);
        let cobject = against(&space, &environment);
        let at = Configuration::LinkPoses(std::slice::from_ref(&pose));
        let within = QueryContext::new().within(&cobject, at, distance.distance);
        assert!(within.unwrap(), "case {case}: {:e}", distance.distance);
    }
}
