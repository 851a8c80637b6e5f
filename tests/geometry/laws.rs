//! The laws that answers keep among one another: warm as cold, class and thresholds in agreement, no witness missing, unions as
//! minima, margins as shifts.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{CObject, Class, InducedOptions};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, Distance, DistanceKind, QueryContext, SSide};

use helpers::placed::{PlacedPrimitive, cold, dented, hull_at, shifted, size_of};
use helpers::random::Random;
use helpers::robots::{against_with, environment, free_body, link, robot, space};
use helpers::shapes::{hull, hulls, mesh};

/// One context through a long walk answers as a fresh one does, bit for bit.
#[test]
fn warm_answers_are_cold_answers() {
    let mut random = Random::new(10);
    let shapes = [
        dented(&mut random),
        dented(&mut random),
        hulls(&[
            random.points(6, 0.5),
            random.points(6, 0.5),
            random.points(9, 1.0),
        ]),
    ];
    let mut warm = QueryContext::new();
    let mut poses: Vec<Pose> = (0..3).map(|_| random.pose(1.5)).collect();
    for step in 0..400 {
        let (i, j) = (random.below(3), random.below(3));
        poses[i].translation += random.point(0.05);
        if step % 50 == 49 {
            poses[i] = random.pose(1.5);
        }
        let a = PlacedPrimitive::new(shapes[i].clone(), poses[i]);
        let b = PlacedPrimitive::new(shapes[j].clone(), poses[j]);
        let limit = [f64::INFINITY, 0.4][step % 2];
        // Other questions in between leave other memories.
        warm.pair_within(a.side(), b.side(), random.within(0.0, 1.0))
            .unwrap();
        warm.pair_witnesses(a.side(), b.side(), 0.1, 3).unwrap();
        let again = warm.pair_distance(a.side(), b.side(), limit).unwrap();
        let fresh = QueryContext::new()
            .pair_distance(a.side(), b.side(), limit)
            .unwrap();
        assert_eq!(said(&again), said(&fresh), "step {step}");
    }
    assert!(warm.statistics().cache_hits > 100);
}

/// All that a distance says, bit for bit.
fn said(found: &Distance) -> (DistanceKind, Vec<u64>, Option<[u32; 2]>, bool) {
    let mut numbers = vec![found.distance, found.lower, found.upper];
    numbers.extend(found.points.iter().flatten());
    if let Some(contact) = &found.contact {
        numbers.extend(contact.normal.iter());
        numbers.extend(contact.points.iter().flatten());
    }
    (
        found.kind,
        numbers.iter().map(|x| x.to_bits()).collect(),
        found.witness.map(|witness| witness.primitives),
        found.witness.is_some_and(|witness| witness.overlapping),
    )
}

/// A robot of one link, and the C-object it makes with some objects.
fn one_link(
    body: &Arc<Body>,
    objects: &[&PlacedPrimitive],
    options: InducedOptions,
) -> (CObject, Vec<u64>) {
    let mut links = vec![link(None, cstk::robot::JointKind::Prismatic, Vec3::x())];
    links[0].body = Some(body.clone());
    let placed: Vec<(&Arc<Body>, Pose)> = objects.iter().map(|o| (&o.shape.body, o.pose)).collect();
    let (environment, ids) = environment(&placed);
    (
        against_with(&space(vec![robot(3, links)]), &environment, options),
        ids,
    )
}

#[test]
fn class_threshold_and_distance_agree() {
    let mut random = Random::new(11);
    let mut seen = [0; 3];
    for i in 0..300 {
        let a = hull_at(&random.points(6, 1.0), random.pose(0.2));
        let mut b = hull_at(&random.points(6, 1.0), random.pose(2.5));
        let first = cold(&a, &b);
        if i % 3 == 0 && first.distance > 0.0 {
            // Brought to within a few roundings of contact.
            let away = first.contact.unwrap().normal * first.distance;
            b.pose.translation += away * (1.0 + random.within(-1e-15, 1e-15));
        }
        let found = cold(&a, &b);
        let epsilon = [0.0, 0.5, found.distance][random.below(3)];
        let options = InducedOptions {
            contact_epsilon: epsilon,
            margin: 0.0,
        };
        let (cobject, _) = one_link(&a.shape.body, &[&b], options);
        let mut context = QueryContext::new();
        let at = Configuration::LinkPoses(std::slice::from_ref(&a.pose));
        let same = context.distance(&cobject, at, f64::INFINITY).unwrap();
        assert_eq!(said(&same), said(&found));
        let class = context.classify(&cobject, at).unwrap();
        let want = if found.lower == 0.0 {
            Class::Inside
        } else if found.lower <= epsilon {
            // Doubt within rounding counts as contact, as it counts as within.
            Class::Contact
        } else {
            Class::Outside
        };
        assert_eq!(class, want, "{found:?} {epsilon}");
        seen[class as usize] += 1;
        assert_eq!(found.distance == 0.0, found.lower == 0.0, "{found:?}");
        let below = f64::from_bits(found.lower.to_bits().saturating_sub(1));
        for t in [
            0.0,
            found.lower,
            below,
            found.distance,
            found.upper,
            0.5 * found.distance,
            1.0,
        ] {
            let says = context.within(&cobject, at, t).unwrap();
            assert_eq!(says, found.lower <= t, "{t:e} {found:?}");
            assert_eq!(context.pair_within(a.side(), b.side(), t).unwrap(), says);
        }
    }
    assert!(seen.iter().all(|&n| n > 20), "{seen:?}");
}

/// Bodies made of single primitives of two bodies answer one by one what the bodies' witnesses say at once.
#[test]
fn no_witness_is_missing_and_none_is_there_twice() {
    let mut random = Random::new(12);
    for i in 0..8 {
        let a = PlacedPrimitive::new(dented(&mut random), random.pose(0.3));
        let parts: Vec<Vec<Vec3>> = (0..8)
            .map(|_| shifted(&random.points(5, 0.4), random.point(1.0)))
            .collect();
        let b = PlacedPrimitive::new(hulls(&parts), random.pose([2.5, 1.2][i % 2]));
        let size = size_of(&a, &b);
        let single = |placed: &PlacedPrimitive| -> Vec<PlacedPrimitive> {
            let alone = |part: &Vec<Vec3>| match part.len() {
                3 => mesh(part, &[[0, 1, 2]]),
                _ => hull(part),
            };
            placed
                .shape
                .parts
                .iter()
                .map(|part| PlacedPrimitive::new(alone(part), placed.pose))
                .collect()
        };
        let (singles_a, singles_b) = (single(&a), single(&b));
        let mut each = Vec::new();
        for (k, one) in singles_a.iter().enumerate() {
            for (l, other) in singles_b.iter().enumerate() {
                each.push(([k as u32, l as u32], cold(one, other).distance));
            }
        }
        for epsilon in [0.0, 0.05, 0.5] {
            let list = QueryContext::new()
                .pair_witnesses(a.side(), b.side(), epsilon, usize::MAX)
                .unwrap();
            assert!(!list.truncated);
            let mut keys: Vec<[u32; 2]> = list.witnesses.iter().map(|w| w.primitives).collect();
            keys.sort_unstable();
            assert!(
                keys.windows(2).all(|two| two[0] != two[1]),
                "a witness is there twice"
            );
            assert!(list.witnesses.is_sorted_by(|p, q| p.distance <= q.distance));
            for (key, distance) in &each {
                // Alone, a primitive is centred elsewhere, and so rounded elsewhere.
                if (distance - epsilon).abs() > 1e-12 * size || epsilon == 0.0 && *distance == 0.0 {
                    let listed = keys.binary_search(key).is_ok();
                    assert_eq!(
                        listed,
                        *distance <= epsilon,
                        "{key:?} at {distance:e}, {epsilon}"
                    );
                }
            }
            for witness in &list.witnesses {
                let (_, distance) =
                    each[witness.primitives[0] as usize * 8 + witness.primitives[1] as usize];
                assert!((witness.distance - distance).abs() <= 1e-12 * size);
            }
            truncates(&a, &b, epsilon);
        }
    }
}

/// Of more witnesses than asked for, the nearest are kept, and it says so.
fn truncates(a: &PlacedPrimitive, b: &PlacedPrimitive, epsilon: f64) {
    let ask = |count: usize| {
        QueryContext::new()
            .pair_witnesses(a.side(), b.side(), epsilon, count)
            .unwrap()
    };
    let all = ask(usize::MAX);
    for count in [1, 2, 7, all.witnesses.len(), all.witnesses.len() + 1] {
        let some = ask(count);
        assert_eq!(some.truncated, count < all.witnesses.len());
        let key = |w: &cstk::query::Witness| (w.distance.to_bits(), w.primitives, w.contact_count);
        let want = all.witnesses.iter().take(count).map(key);
        assert!(
            some.witnesses.iter().map(key).eq(want),
            "{count} of {}",
            all.witnesses.len()
        );
        let contacts: usize = some.witnesses.iter().map(|w| w.contact_count).sum();
        assert_eq!(some.contacts.len(), contacts);
    }
}

/// More witnesses than the list is cut at on the way: the nearest must survive the cuts.
#[test]
fn truncation_keeps_the_nearest_of_many() {
    let mut random = Random::new(13);
    let a = PlacedPrimitive::new(dented(&mut random), random.pose(0.1));
    let b = PlacedPrimitive::new(dented(&mut random), random.pose(3.0));
    truncates(&a, &b, 10.0);
}

#[test]
fn a_union_is_the_minimum_of_its_parts() {
    let mut random = Random::new(14);
    for _ in 0..40 {
        let objects: Vec<PlacedPrimitive> = (0..6)
            .map(|_| hull_at(&random.points(6, 0.8), random.pose(4.0)))
            .collect();
        let refs: Vec<&PlacedPrimitive> = objects.iter().collect();
        let body = hull(&random.points(8, 0.6)).body;
        let robot_space = space(vec![free_body(&body)]);
        let placed: Vec<(&Arc<Body>, Pose)> =
            refs.iter().map(|o| (&o.shape.body, o.pose)).collect();
        let (environment, ids) = environment(&placed);
        let options = InducedOptions::default();
        let whole = against_with(&robot_space, &environment, options);
        let parts: Vec<Arc<CObject>> = ids
            .iter()
            .map(|&id| Arc::new(helpers::robots::against_one(&robot_space, &environment, id)))
            .collect();
        let union = CObject::union(&parts).unwrap();
        let q: Vec<f64> = (0..6).map(|_| random.within(-2.0, 2.0)).collect();
        let at = Configuration::Coordinates(&q);
        let mut context = QueryContext::new();
        let mut ask = |c: &CObject| context.distance(c, at, f64::INFINITY).unwrap();
        let each: Vec<Distance> = parts.iter().map(|part| ask(part)).collect();
        let least = each
            .iter()
            .map(|d| d.distance)
            .fold(f64::INFINITY, f64::min);
        for c in [&whole, &union] {
            let found = ask(c);
            assert_eq!(found.distance, least);
            let nearest = each.iter().position(|d| d.distance == least).unwrap();
            assert_eq!(found.witness.unwrap().s_side, SSide::Object(ids[nearest]));
            let class = QueryContext::new().classify(c, at).unwrap();
            let classes = parts
                .iter()
                .map(|part| QueryContext::new().classify(part, at).unwrap());
            assert_eq!(Some(class), classes.max());
        }
    }
}

/// A margin is taken off every distance, of witnesses and contacts too, but not below 0.
#[test]
fn a_margin_shifts_distances() {
    let mut random = Random::new(15);
    for _ in 0..60 {
        let objects: Vec<PlacedPrimitive> = (0..3)
            .map(|_| hull_at(&random.points(6, 0.8), random.pose(3.0)))
            .collect();
        let refs: Vec<&PlacedPrimitive> = objects.iter().collect();
        let body = hull(&random.points(8, 0.6)).body;
        let margin = random.within(0.0, 2.0);
        let with = |margin: f64| InducedOptions {
            contact_epsilon: 0.0,
            margin,
        };
        let (plain, _) = one_link(&body, &refs, with(0.0));
        let (grown, _) = one_link(&body, &refs, with(margin));
        let pose = random.pose(2.0);
        let at = Configuration::LinkPoses(std::slice::from_ref(&pose));
        let mut context = QueryContext::new();
        let bare = context.distance(&plain, at, f64::INFINITY).unwrap();
        let less = context.distance(&grown, at, f64::INFINITY).unwrap();
        assert_eq!(less.distance, (bare.distance - margin).max(0.0));
        assert!(less.lower <= less.distance && less.distance <= less.upper);
        let inside = context.classify(&grown, at).unwrap() == Class::Inside;
        assert_eq!(inside, less.lower == 0.0);
        let epsilon = 1.0;
        let listed = context.witnesses(&grown, at, epsilon, 100).unwrap();
        let wider = context
            .witnesses(&plain, at, epsilon + margin, 100)
            .unwrap();
        assert_eq!(listed.witnesses.len(), wider.witnesses.len());
        let mut shifted: Vec<f64> = wider
            .witnesses
            .iter()
            .map(|w| (w.distance - margin).max(0.0))
            .collect();
        shifted.sort_by(f64::total_cmp);
        let got: Vec<f64> = listed.witnesses.iter().map(|w| w.distance).collect();
        assert_eq!(got, shifted);
        for witness in &listed.witnesses {
            let contacts = &listed.contacts[witness.first_contact..][..witness.contact_count];
            assert!(
                contacts
                    .iter()
                    .all(|c| (c.distance - witness.distance).abs() <= 1e-12)
            );
        }
    }
}
