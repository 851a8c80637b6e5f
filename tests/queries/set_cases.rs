//! Cases about sets of pairs and thresholds: all pairs within a tolerance, margins in the broad phase too, and what is said
//! when nothing is near.

use std::collections::BTreeSet;

use cstk::cobject::{CObject, Class, InducedOptions, LeftOut, SObjects};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, DistanceKind, QueryContext};
use cstk::robot::JointKind;

use helpers::oracle::hull_distance;
use helpers::random::Random;
use helpers::robots::{environment, link, robot, space};
use helpers::shapes::{Shape, cube_surface, cuboid};

fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose::from_translation(Vec3::new(x, y, z))
}

/// The pairs of primitives that are within epsilon by brute force, and those that are so near it that rounding decides.
fn by_brute_force(a: (&Shape, &Pose), b: (&Shape, &Pose), epsilon: f64) -> [BTreeSet<[u32; 2]>; 2] {
    let [of_a, of_b] = [a, b].map(|(shape, pose)| shape.placed(pose, &Vec3::zeros()));
    let mut sets = [BTreeSet::new(), BTreeSet::new()];
    for (i, p) in of_a.iter().enumerate() {
        for (j, q) in of_b.iter().enumerate() {
            let bounds = hull_distance(p, q);
            let pair = [i as u32, j as u32];
            if bounds.upper <= epsilon + 1e-13 {
                sets[1].insert(pair);
                if bounds.upper <= epsilon - 1e-13 || epsilon == 0.0 {
                    sets[0].insert(pair);
                }
            }
        }
    }
    sets
}

fn witnesses(a: (&Shape, &Pose), b: (&Shape, &Pose), epsilon: f64) -> BTreeSet<[u32; 2]> {
    let mut query = QueryContext::new();
    let list = query
        .pair_witnesses((&a.0.body, a.1), (&b.0.body, b.1), epsilon, usize::MAX)
        .unwrap();
    assert!(!list.truncated);
    let set: BTreeSet<[u32; 2]> = list.witnesses.iter().map(|w| w.primitives).collect();
    assert_eq!(set.len(), list.witnesses.len(), "some pair comes twice");
    set
}

/// Case A22 of docs/cases.md.
#[test]
fn parallel_faces_show_all_that_tie_and_choose_the_lowest() {
    let (a, b) = (cube_surface(2.0), cube_surface(2.0));
    let (here, above) = (Pose::identity(), at(0.1, 0.2, 2.5));
    let ties = witnesses((&a, &here), (&b, &above), 0.5 + 1e-12);
    assert!(ties.len() >= 4, "{ties:?}");
    let mut query = QueryContext::new();
    let lowest = *ties.iter().next().unwrap();
    for start in [
        at(5.0, 0.0, 0.0),
        at(0.0, 0.0, -3.0),
        at(-2.0, 2.0, 2.0),
        above,
    ] {
        // Whatever was nearest before, the same pair and the same points come out.
        let ask = |query: &mut QueryContext, pose: &Pose| {
            let found = query.pair_distance((&a.body, &here), (&b.body, pose), f64::INFINITY);
            found.unwrap()
        };
        ask(&mut query, &start);
        let found = ask(&mut query, &above);
        assert_eq!(found.witness.unwrap().primitives, lowest);
        let cold = ask(&mut QueryContext::new(), &above);
        assert_eq!(found.distance.to_bits(), cold.distance.to_bits());
        assert_eq!(found.points, cold.points);
    }
}

/// Case A25 of docs/cases.md.
#[test]
fn the_pairs_that_touch_are_those_of_brute_force() {
    let (large, small) = (cube_surface(2.0), cube_surface(1.0));
    let here = Pose::identity();
    for offset in [
        at(0.0, 0.0, 1.0),
        at(0.0, 0.0, 1.5),
        at(0.5, 0.5, 1.0),
        at(0.25, -0.25, 1.25),
    ] {
        let [surely, maybe] = by_brute_force((&large, &here), (&small, &offset), 0.0);
        assert_eq!(surely, maybe);
        assert!(!surely.is_empty());
        assert_eq!(witnesses((&large, &here), (&small, &offset), 0.0), surely);
    }
    let mut random = Random::new(25);
    for _ in 0..60 {
        let pose = random.pose(1.2);
        let epsilon = random.within(0.0, 0.5);
        let [surely, maybe] = by_brute_force((&large, &here), (&small, &pose), epsilon);
        let found = witnesses((&large, &here), (&small, &pose), epsilon);
        assert!(surely.is_subset(&found) && found.is_subset(&maybe));
    }
}

/// Margins and thresholds hold among many objects as between two.
/// Case A37 of docs/cases.md.
#[test]
fn margins_reach_into_the_broad_phase() {
    let link_body = cuboid([0.16, 0.27, 0.37]);
    let wall = cuboid([5.898, 0.06, 2.69]);
    let here = Pose::from_row_major(&[
        0., -1., 0., 1.490670, 0., 0., 1., 0.845416, -1., 0., 0., -0.194226,
    ])
    .unwrap();
    let wall_at = at(0., 1.075, 0.555);
    let mut query = QueryContext::new();
    let found = query.pair_distance((&link_body.body, &here), (&wall.body, &wall_at), 1.0);
    assert!((found.unwrap().distance - 0.014584).abs() <= 1e-15);
    let mut links = vec![link(None, JointKind::Prismatic, Vec3::x())];
    links[0].body = Some(link_body.body.clone());
    let space = space(vec![robot(3, links)]);
    let pebble = cuboid([0.01; 3]);
    let mut objects = vec![(&wall.body, wall_at)];
    for i in 0..40 {
        objects.push((
            &pebble.body,
            at(f64::from(i) - 20.0, -3.0, f64::from(i % 7)),
        ));
    }
    let (world, _) = environment(&objects);
    let q = [here];
    let q = Configuration::LinkPoses(&q);
    for (margin, epsilon, class) in [
        (0.0, 0.0, Class::Outside),
        (0.0, 0.0145, Class::Outside),
        (0.0, 0.015, Class::Contact),
        (0.0145, 0.0, Class::Outside),
        (0.0145, 0.0001, Class::Contact),
        (0.015, 0.0, Class::Inside),
        (0.05, 0.0, Class::Inside),
    ] {
        let options = InducedOptions {
            contact_epsilon: epsilon,
            margin,
        };
        let all = SObjects::All(world.clone());
        let cobject =
            CObject::induced(space.clone(), &[], all, LeftOut::default(), options).unwrap();
        assert_eq!(
            query.classify(&cobject, q).unwrap(),
            class,
            "{margin} {epsilon}"
        );
        let want = (0.014584f64 - margin).max(0.0);
        let found = query.distance(&cobject, q, f64::INFINITY).unwrap();
        assert!((found.distance - want).abs() <= 1e-15);
        for threshold in [0.0, 0.001, 0.0145, 0.0146, 0.1] {
            let within = query.within(&cobject, q, threshold).unwrap();
            assert_eq!(within, want <= threshold, "{margin} {threshold}");
        }
    }
}

/// Case A38 of docs/cases.md.
#[test]
fn a_threshold_decides_at_the_gap() {
    let (a, b) = (cube_surface(1.0), cube_surface(1.0));
    let here = Pose::identity();
    let mut query = QueryContext::new();
    for gap in [0.3, 0.7, 0.95, 1.05] {
        let there = at(1.0 + gap, 0.1, 0.0);
        let mut within = |threshold: f64| {
            query
                .pair_within((&a.body, &here), (&b.body, &there), threshold)
                .unwrap()
        };
        assert_eq!(within(1.0), gap < 1.0, "{gap}");
        assert!(within(gap + 1e-12) && !within(gap - 1e-12));
    }
}

/// Case A39 of docs/cases.md.
#[test]
fn what_is_farther_than_asked_says_so() {
    let cube = cuboid([1.0; 3]);
    let (here, there) = (Pose::identity(), at(3.0, 0.0, 0.0));
    let mut query = QueryContext::new();
    let mut ask = |most: f64| {
        query
            .pair_distance((&cube.body, &here), (&cube.body, &there), most)
            .unwrap()
    };
    for most in [0.0, 1.0, 2.0 - 1e-12] {
        let found = ask(most);
        assert_eq!(found.kind, DistanceKind::BeyondMax);
        assert_eq!(found.distance, f64::INFINITY);
        assert!(found.witness.is_none() && found.lower <= most && found.lower >= most - 1e-13);
    }
    assert_eq!(ask(2.0).kind, DistanceKind::Exact);
    assert_eq!(ask(f64::INFINITY).distance, 2.0);
}
