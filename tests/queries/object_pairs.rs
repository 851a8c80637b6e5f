//! Objects against objects, within an environment and between two: the same pairs, distances and witnesses as those of the pair
//! queries of every two bodies.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::Class;
use cstk::environment::{Attachment, Change, Environment};
use cstk::error::ErrorKind;
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Distance, DistanceKind, ObjectSets, QueryContext, SSide, Witness};
use cstk::robot::JointKind;

use helpers::random::Random;
use helpers::robots::{environment, link, robot, space};
use helpers::shapes::{cube_surface, cuboid, dented_ball, planar};

type Object = (u64, Arc<Body>, Pose);

fn sphere(radius: f64) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_sphere(&Vec3::zeros(), radius, 0).unwrap();
    let options = HierarchyOptions::default();
    Arc::new(builder.build(&options, &mut |_| Ok(())).unwrap())
}

/// Boxes, spheres, surfaces, and what is dented, of several sizes.
fn bodies(random: &mut Random) -> Vec<Arc<Body>> {
    vec![
        cuboid([0.3, 0.2, 0.1]).body,
        cuboid([0.05; 3]).body,
        cuboid([1.0, 0.02, 0.4]).body,
        cube_surface(0.3).body,
        dented_ball(|| random.within(0.1, 0.2)).body,
        sphere(0.1),
    ]
}

fn objects(environment: &Environment) -> Vec<Object> {
    let snapshot = environment.snapshot();
    let each = |object: &cstk::environment::SObject| (object.id, object.body.clone(), object.pose);
    snapshot.objects().map(each).collect()
}

/// Every pair that is asked about: the oracle's.
fn all_pairs(first: &Environment, second: Option<&Environment>) -> Vec<(Object, Object)> {
    let a = objects(first);
    let b = second.map_or_else(|| a.clone(), objects);
    let mut all = Vec::new();
    for r in &a {
        for s in &b {
            if second.is_some() || r.0 < s.0 {
                all.push((r.clone(), s.clone()));
            }
        }
    }
    all
}

fn ids((r, s): &(Object, Object)) -> [u64; 2] {
    [r.0, s.0]
}

fn measured(pair: &(Object, Object), max: f64) -> Distance {
    let ((_, a, at_a), (_, b, at_b)) = pair;
    let mut context = QueryContext::new();
    context.pair_distance((a, at_a), (b, at_b), max).unwrap()
}

fn are_within(pair: &(Object, Object), threshold: f64) -> bool {
    let ((_, a, at_a), (_, b, at_b)) = pair;
    let mut context = QueryContext::new();
    context
        .pair_within((a, at_a), (b, at_b), threshold)
        .unwrap()
}

type Found = (u64, SSide, [u32; 2], u64, usize);

fn found(witness: &Witness, [r, s]: [u64; 2]) -> Found {
    let at = witness.distance.to_bits();
    (
        r,
        SSide::Object(s),
        witness.primitives,
        at,
        witness.contact_count,
    )
}

/// All four questions against those of every pair.
fn check(
    query: &mut QueryContext,
    first: &Environment,
    second: Option<&Environment>,
    threshold: f64,
) -> usize {
    let all = all_pairs(first, second);
    let sets = || ObjectSets::new(first, second, None).unwrap();
    let near: Vec<_> = all
        .iter()
        .filter(|pair| are_within(pair, threshold))
        .collect();
    let list = query
        .environment_pairs(&mut sets(), threshold, 1 << 20, true)
        .unwrap();
    let expected: Vec<[u64; 2]> = near.iter().map(|pair| ids(pair)).collect();
    let listed: Vec<[u64; 2]> = list.pairs.iter().map(|pair| pair.ids).collect();
    assert_eq!(listed, expected);
    assert!(!list.truncated);
    for ((pair, found), distance) in near.iter().zip(&list.pairs).zip(&list.distances) {
        let expected = measured(pair, f64::INFINITY);
        assert_eq!(distance.distance.to_bits(), expected.distance.to_bits());
        assert_eq!(distance.points, expected.points);
        assert_eq!(distance.lower.to_bits(), expected.lower.to_bits());
        let meet = expected.distance == 0.0;
        assert_eq!(
            found.class,
            if meet { Class::Inside } else { Class::Contact }
        );
        let witness = distance.witness.unwrap();
        assert_eq!([witness.r_object, object(witness.s_side)], ids(pair));
    }
    let classes = query
        .environment_pairs(&mut sets(), threshold, 1 << 20, false)
        .unwrap();
    assert!(classes.distances.is_empty() && classes.pairs.len() == list.pairs.len());
    for (a, b) in classes.pairs.iter().zip(&list.pairs) {
        assert_eq!((a.ids, a.class), (b.ids, b.class));
    }
    for count in [0, 1, expected.len() / 2] {
        let some = query
            .environment_pairs(&mut sets(), threshold, count, false)
            .unwrap();
        let listed: Vec<[u64; 2]> = some.pairs.iter().map(|pair| pair.ids).collect();
        assert_eq!(listed, expected[..count.min(expected.len())]);
        assert_eq!(some.truncated, count < expected.len());
    }
    let any = query.environment_within(&mut sets(), threshold).unwrap();
    assert_eq!(any, !expected.is_empty());
    check_nearest(query, &mut sets(), &all, threshold);
    check_witnesses(query, &sets, &near, threshold);
    expected.len()
}

fn object(side: SSide) -> u64 {
    match side {
        SSide::Object(id) => id,
        side => panic!("{side:?}"),
    }
}

fn check_nearest(
    query: &mut QueryContext,
    sets: &mut ObjectSets,
    all: &[(Object, Object)],
    threshold: f64,
) {
    let mut nearest: Option<(f64, [u64; 2])> = None;
    for pair in all {
        let most = nearest.map_or(f64::INFINITY, |(least, _)| least);
        let next = measured(pair, most);
        if next.kind == DistanceKind::Exact && next.distance < most {
            nearest = Some((next.distance, ids(pair)));
        }
    }
    let found = query.environment_distance(sets, f64::INFINITY).unwrap();
    match nearest {
        None => assert_eq!(found.kind, DistanceKind::Empty),
        Some((distance, ids)) => {
            let witness = found.witness.unwrap();
            assert_eq!(found.distance.to_bits(), distance.to_bits());
            assert_eq!([witness.r_object, object(witness.s_side)], ids);
            let limited = query.environment_distance(sets, threshold).unwrap();
            let is_near = distance <= threshold;
            assert_eq!(limited.kind == DistanceKind::Exact, is_near);
            assert!(limited.lower <= distance);
        }
    }
}

fn check_witnesses<'f>(
    query: &mut QueryContext,
    sets: &impl Fn() -> ObjectSets<'f>,
    near: &[&(Object, Object)],
    epsilon: f64,
) {
    let mut expected: Vec<Found> = Vec::new();
    for pair in near {
        let ((_, a, at_a), (_, b, at_b)) = pair;
        let mut context = QueryContext::new();
        let list = context.pair_witnesses((a, at_a), (b, at_b), epsilon, 1 << 20);
        let all = list.unwrap().witnesses;
        expected.extend(all.iter().map(|witness| found(witness, ids(pair))));
    }
    let order = |f: &Found| (f.3, f.0, f.1, f.2);
    expected.sort_by_key(order);
    for count in [1 << 20, expected.len() / 3, 0] {
        let list = query
            .environment_witnesses(&mut sets(), epsilon, count)
            .unwrap();
        let listed: Vec<Found> = list
            .witnesses
            .iter()
            .map(|witness| found(witness, [witness.r_object, object(witness.s_side)]))
            .collect();
        assert_eq!(listed, expected[..count.min(expected.len())]);
        assert_eq!(list.truncated, count < expected.len());
    }
}

fn scattered(
    random: &mut Random,
    bodies: &[Arc<Body>],
    count: usize,
    half: f64,
) -> Arc<Environment> {
    let placed: Vec<(&Arc<Body>, Pose)> = (0..count)
        .map(|_| (&bodies[random.below(bodies.len())], random.pose(half)))
        .collect();
    environment(&placed).0
}

#[test]
fn pairs_are_those_of_all_pair_queries() {
    let mut random = Random::new(211);
    let bodies = bodies(&mut random);
    let mut query = QueryContext::new();
    let mut seen = 0;
    for case in 0..24 {
        let count = [0, 1, 2, 9, 30, 70][case % 6];
        let half = [0.3, 1.0, 2.0][case % 3];
        let threshold = [0.0, 0.01, 0.1][case % 3];
        let live = scattered(&mut random, &bodies, count, half);
        seen += check(&mut query, &live, None, threshold);
        let other = scattered(&mut random, &bodies, [40, 1, 0][case % 3], half);
        seen += check(&mut query, &live, Some(&other), threshold);
    }
    assert!(seen > 400, "{seen}");
}

/// Trees that have been refitted, reshaped and rebuilt, objects far outside of them, in two frames far from each other.
#[test]
fn changes_and_strays_hide_no_pair() {
    let mut random = Random::new(212);
    let bodies = bodies(&mut random);
    let mut query = QueryContext::new();
    let live = scattered(&mut random, &bodies, 60, 1.0);
    let other = scattered(&mut random, &bodies, 40, 1.0);
    for round in 0..30 {
        let all = objects(&live);
        let far = Vec3::new(1e5, 0.0, 0.0);
        let mut changes = Vec::new();
        for (i, (id, _, pose)) in all.iter().enumerate() {
            let mut pose = *pose;
            match (round + i) % 11 {
                0 => pose = random.pose(1.0),
                1 | 2 => pose.translation += random.point(0.05),
                // A few go far away together, and come back.
                3 if round % 4 == 1 => pose = Pose::from_translation(far + random.point(0.1)),
                4 if round % 6 == 5 => {
                    changes.push(Change::Delete { id: *id });
                    continue;
                }
                _ => continue,
            }
            changes.push(Change::Move { id: *id, pose });
        }
        for _ in 0..3 {
            let body = bodies[random.below(bodies.len())].clone();
            let pose = random.pose(1.0);
            changes.push(Change::add(body, pose));
        }
        live.apply(&changes).unwrap();
        check(&mut query, &live, None, 0.02);
        check(&mut query, &live, Some(&other), 0.02);
        check(&mut query, &other, Some(&live), 0.02);
    }
}

/// More pairs than are looked at together, all at distance 0: of the lowest ids, and bounded by the count asked for.
#[test]
fn objects_in_one_place_are_listed_by_ids() {
    let small = cuboid([0.1; 3]).body;
    let placed: Vec<_> = (0..260).map(|_| (&small, Pose::identity())).collect();
    let (live, ids) = environment(&placed);
    let mut query = QueryContext::new();
    let sets = || ObjectSets::new(&live, None, None).unwrap();
    let all = query
        .environment_pairs(&mut sets(), 0.0, usize::MAX, false)
        .unwrap();
    assert_eq!(all.pairs.len(), 260 * 259 / 2);
    assert!(all.pairs.windows(2).all(|two| two[0].ids < two[1].ids));
    let few = query.environment_pairs(&mut sets(), 0.0, 3, true).unwrap();
    assert!(few.truncated && few.pairs[2].ids == [ids[0], ids[3]]);
    let nearest = query
        .environment_distance(&mut sets(), f64::INFINITY)
        .unwrap();
    let witness = nearest.witness.unwrap();
    assert_eq!(
        (witness.r_object, witness.s_side),
        (ids[0], SSide::Object(ids[1]))
    );
    let list = query.environment_witnesses(&mut sets(), 0.0, 300).unwrap();
    assert!(list.truncated && list.witnesses.len() == 300);
    let second = &list.witnesses[259];
    assert_eq!(
        (second.r_object, second.s_side),
        (ids[1], SSide::Object(ids[2]))
    );
    query.set_limit(Some(1000));
    let limited = query.environment_pairs(&mut sets(), 0.0, usize::MAX, false);
    assert_eq!(limited.unwrap_err().kind, ErrorKind::Limit);
}

#[test]
fn filters_leave_pairs_out_of_every_answer() {
    let mut random = Random::new(213);
    let bodies = bodies(&mut random);
    let live = scattered(&mut random, &bodies, 50, 0.4);
    let mut query = QueryContext::new();
    // Asked without a filter first: what is remembered is left out too.
    let mut unfiltered = ObjectSets::new(&live, None, None).unwrap();
    query
        .environment_distance(&mut unfiltered, f64::INFINITY)
        .unwrap();
    let odd = |r: u64, s: u64| (r + s) % 2 == 1;
    let mut filter =
        |r: &cstk::environment::SObject, s: &cstk::environment::SObject| Ok(odd(r.id, s.id));
    let mut sets = ObjectSets::new(&live, None, Some(&mut filter)).unwrap();
    let near = all_pairs(&live, None).into_iter().filter(|pair| {
        let [r, s] = ids(pair);
        odd(r, s) && are_within(pair, 0.05)
    });
    let expected: Vec<[u64; 2]> = near.map(|pair| ids(&pair)).collect();
    let list = query
        .environment_pairs(&mut sets, 0.05, 4096, false)
        .unwrap();
    let listed: Vec<[u64; 2]> = list.pairs.iter().map(|pair| pair.ids).collect();
    assert_eq!(listed, expected);
    assert!(expected.len() > 20);
    let nearest = query
        .environment_distance(&mut sets, f64::INFINITY)
        .unwrap();
    let witness = nearest.witness.unwrap();
    assert!(odd(witness.r_object, object(witness.s_side)));
    drop(sets);
    let mut none = |_: &cstk::environment::SObject, _: &cstk::environment::SObject| Ok(false);
    let mut sets = ObjectSets::new(&live, None, Some(&mut none)).unwrap();
    assert!(!query.environment_within(&mut sets, 1e9).unwrap());
    let empty = query
        .environment_distance(&mut sets, f64::INFINITY)
        .unwrap();
    assert_eq!(empty.kind, DistanceKind::Empty);
    assert!(
        query
            .environment_witnesses(&mut sets, 1.0, 9)
            .unwrap()
            .witnesses
            .is_empty()
    );
}

#[test]
fn attached_objects_and_other_dimensions_are_refused() {
    let body = cuboid([0.1; 3]).body;
    let (live, ids) = environment(&[(&body, Pose::identity())]);
    let space = space(vec![robot(
        3,
        vec![link(None, JointKind::Prismatic, Vec3::x())],
    )]);
    live.apply(&[Change::Attach {
        id: ids[0],
        pose: Pose::identity(),
        attachment: Attachment::new(&space, 0, &[]).unwrap(),
    }])
    .unwrap();
    let refused = ObjectSets::new(&live, None, None).err().unwrap();
    assert_eq!(refused.kind, ErrorKind::Unsupported);
    assert!(refused.message.contains(&ids[0].to_string()));
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let corners = square.map(|[x, y]| Vec3::new(x, y, 0.0));
    let flat = planar(&[corners.to_vec()]).body;
    let (flat, _) = environment(&[(&flat, Pose::identity())]);
    let (solid, _) = environment(&[(&body, Pose::identity())]);
    let refused = ObjectSets::new(&flat, Some(&solid), None).err().unwrap();
    assert_eq!(refused.kind, ErrorKind::InvalidArgument);
    let mut query = QueryContext::new();
    let mut alone = ObjectSets::new(&flat, Some(&flat), None).unwrap();
    assert!(!query.environment_within(&mut alone, 1e9).unwrap());
    assert!(query.environment_within(&mut alone, f64::NAN).is_err());
}
