//! Smooth sets against flat, hulled and smooth ones of any size ratio: what overlaps is never called free, and what is apart
//! is measured. `CSTK_OVERLAP_PAIRS=10000000 cargo test --release --test geometry deep_overlaps -- --nocapture` runs a campaign.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{Class, InducedOptions};
use cstk::pose::{Mat3, Pose, Vec3, rotation_about};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::JointKind;

use helpers::closed_sets::Set::{
    self, Ball, Capsule, Cone, Cuboid, Cylinder, Ellipsoid, Points, Sheet, Supported,
};
use helpers::closed_sets::turn;
use helpers::random::Random;
use helpers::robots::{against_with, environment, link, robot, space};

/// Two sets that face one another: A's point lies `gap` above B's along B's normal, which is upright to both.
struct Case<'a> {
    sets: &'a [Set; 2],
    /// Of A in B's frame.
    pose: Pose,
    gap: f64,
    /// The largest coordinate.
    size: f64,
    /// A point of one boundary is so deep in the other set.
    certified_depth: f64,
}

/// Lengths of a set with the given largest: log-uniform over up to `spread` decades.
fn lengths(random: &mut Random, largest: f64, spread: f64) -> Vec3 {
    let mut length = || largest * 10f64.powf(-random.within(0.0, spread));
    let (a, b, c) = (largest, length(), length());
    match random.below(3) {
        0 => Vec3::new(a, b, c),
        1 => Vec3::new(b, a, c),
        _ => Vec3::new(b, c, a),
    }
}

fn smooth_set(random: &mut Random, largest: f64, spread: f64) -> Set {
    let l = lengths(random, largest, spread);
    match random.below(5) {
        0 | 1 => Cylinder(l.x, l.y),
        2 => Cone(l.x, l.y),
        3 => Ellipsoid(l),
        _ => Supported(Box::new(match random.below(3) {
            0 => Cylinder(l.x, l.y),
            1 => Cone(l.x, l.y),
            _ => Ellipsoid(l),
        })),
    }
}

fn any_set(random: &mut Random, largest: f64, spread: f64) -> Set {
    let l = lengths(random, largest, spread);
    match random.below(8) {
        0 | 1 => Cuboid(l),
        2 => {
            let corners = 3 + random.below(6);
            Sheet(random.polygon(corners, largest))
        }
        3 => Points(
            random
                .points(12, 1.0)
                .iter()
                .map(|p| p.component_mul(&l))
                .collect(),
        ),
        4 => Capsule(l.x, l.y),
        5 => Ball(l.x),
        _ => smooth_set(random, largest, spread),
    }
}

fn pair_of_sets(random: &mut Random, decades: f64) -> [Set; 2] {
    let ratio = 10f64.powf(random.within(0.0, decades));
    let spread = [0.5, 1.5, decades][random.below(3)];
    let small = smooth_set(random, 1.0, 1.5);
    let large = any_set(random, ratio, spread);
    match random.below(4) {
        0 => [large, small],
        _ => [small, large],
    }
}

fn case<'a>(random: &mut Random, sets: &'a [Set; 2]) -> Case<'a> {
    let on_a = sets[0].facing(random);
    let mut on_b = sets[1].facing(random);
    if random.below(4) == 0 {
        let tilt = 10f64.powf(random.within(-12.0, -1.0));
        on_b.normal = (on_b.normal + random.unit() * tilt).normalize();
        on_b.point = sets[1].farthest(&on_b.normal);
    }
    let spin = match random.below(3) {
        0 => 0.0,
        _ => random.within(-3.0, 3.0),
    };
    let rotation = rotation_about(&on_b.normal, spin) * turn(&on_a.normal, &-on_b.normal);
    let small = sets[0].size().min(sets[1].size());
    let gap = match random.below(6) {
        0 => small * 10f64.powf(random.within(-12.0, 0.0)),
        1 => -small * random.within(0.0, 0.9),
        _ => -small * 10f64.powf(random.within(-12.0, 0.0)),
    };
    let translation = on_b.point + on_b.normal * gap - rotation * on_a.point;
    let pose = Pose {
        rotation,
        translation,
    };
    let back = pose.inverse();
    let deep_a = -sets[1].excess(&pose.transform_point(&on_a.point));
    let deep_b = -sets[0].excess(&back.transform_point(&on_b.point));
    Case {
        gap,
        size: sets[1].size().max(sets[0].size() + pose.translation.norm()),
        certified_depth: 0.5 * deep_a.max(deep_b),
        sets,
        pose,
    }
}

#[derive(Default, Debug)]
struct Count {
    overlaps: u64,
    free: u64,
    apart: u64,
    undecided: u64,
    off: u64,
}

/// The class, and whether a witness says it, of a link at a pose against an object that rests.
fn class_as_link(bodies: &[Arc<Body>; 2], pose: &Pose, margin: f64) -> (Class, bool) {
    let mut moving = link(None, JointKind::Fixed, Vec3::z());
    moving.body = Some(bodies[0].clone());
    let (environment, _) = environment(&[(&bodies[1], Pose::identity())]);
    let options = InducedOptions {
        margin,
        ..InducedOptions::default()
    };
    let set = against_with(&space(vec![robot(3, vec![moving])]), &environment, options);
    let at = Configuration::LinkPoses(std::slice::from_ref(pose));
    let mut query = QueryContext::new();
    let listed = query.witnesses(&set, at, 0.0, 4).unwrap();
    (
        query.classify(&set, at).unwrap(),
        !listed.witnesses.is_empty(),
    )
}

/// Asks for both orders of the pair, the second in a frame of its own.
fn check(case: &Case, bodies: &[Arc<Body>; 2], random: &mut Random, count: &mut Count) {
    let world = Pose {
        rotation: random.rotation(),
        translation: Vec3::zeros(),
    };
    let here = Pose::identity();
    let moved = world.compose(&case.pose);
    let [a, b] = [&*bodies[0], &*bodies[1]];
    let sides = [[(a, &case.pose), (b, &here)], [(b, &world), (a, &moved)]];
    let rounding = 4e-15 * case.size;
    let overlap = case.certified_depth > 2.0 * rounding;
    let mut query = QueryContext::new();
    if overlap && random.below(20) == 0 {
        let margin = [0.0, 0.1 * case.size][random.below(2)];
        let answer = class_as_link(bodies, &case.pose, margin);
        assert_eq!(
            answer,
            (Class::Inside, true),
            "{:?} {:?}",
            case.sets,
            case.pose
        );
    }
    for [a, b] in sides {
        let found = query.pair_distance(a, b, f64::INFINITY).unwrap();
        let within = query.pair_within(a, b, 0.0).unwrap();
        let says = || {
            format!(
                "{:?} {:?} gap {:e} depth {:e} size {:e}: {found:?} within 0: {within}",
                case.sets, case.pose, case.gap, case.certified_depth, case.size
            )
        };
        assert_eq!(within, found.lower <= 0.0, "{}", says());
        if overlap {
            count.overlaps += 1;
            if !within || found.distance > 0.0 {
                count.free += 1;
                if count.free <= 5 {
                    println!("free: {}", says());
                }
            }
        } else if case.gap > 2.0 * rounding {
            count.apart += 1;
            // The promise of smooth sets, on both sides.
            let error = 2e-11 * (bodies[0].radius() + bodies[1].radius()) + rounding;
            if found.lower > case.gap + rounding || found.upper < case.gap - rounding {
                count.off += 1;
                println!("off: {}", says());
            }
            if found.lower <= 0.0 && case.gap > error {
                count.undecided += 1;
                if count.undecided <= 5 {
                    println!("undecided: {}", says());
                }
            }
        }
    }
}

/// Each pair of sets is asked at so many poses.
const POSES: u64 = 10;

fn campaign(pairs: u64, seed: u64) -> Count {
    let mut count = Count::default();
    let mut random = Random::new(seed);
    for i in 0..pairs / POSES {
        let decades = [1.0, 2.0, 4.0, 6.0][i as usize % 4];
        let sets = pair_of_sets(&mut random, decades);
        let bodies = [&sets[0], &sets[1]].map(|set| Arc::new(set.body()));
        for _ in 0..POSES {
            let case = case(&mut random, &sets);
            check(&case, &bodies, &mut random, &mut count);
        }
        if ((i + 1) * POSES).is_multiple_of(500_000) {
            println!(
                "seed {seed}, {} of {pairs} pairs: {count:?}",
                (i + 1) * POSES
            );
        }
    }
    count
}

#[test]
fn what_overlaps_is_not_called_free() {
    let pairs = std::env::var("CSTK_OVERLAP_PAIRS").ok();
    let pairs: u64 = pairs.and_then(|text| text.parse().ok()).unwrap_or(100_000);
    let counts = std::thread::scope(|scope| {
        let halves = [41, 42].map(|seed| scope.spawn(move || campaign(pairs / 2, seed)));
        halves.map(|half| half.join().unwrap())
    });
    for count in counts {
        println!("{count:?}");
        assert_eq!((count.free, count.off), (0, 0), "{count:?}");
        assert!(
            2 * count.overlaps > pairs && count.undecided * 1000 <= count.apart,
            "{count:?}"
        );
    }
}

/// Found from outside: .14 deep in a slab 10,000 times as large.
#[test]
fn a_cylinder_sunk_in_a_large_slab_is_inside() {
    let bodies = [
        Cylinder(0.5, 0.5).body(),
        Cuboid(Vec3::new(1e4, 1e4, 1.0)).body(),
    ]
    .map(Arc::new);
    let rotation = Mat3::new(1.0, 0.0, 0.0, 0.0, 0.8, -0.6, 0.0, 0.6, 0.8);
    let mut random = Random::new(5);
    for i in 0..2_000 {
        let (x, y) = match i {
            0 => (0.01, 0.003),
            _ => (random.within(-9e3, 9e3), random.within(-9e3, 9e3)),
        };
        let depth = if i == 0 {
            0.14
        } else {
            10f64.powf(random.within(-9.0, -0.5))
        };
        // Its lowest point is .7 below its middle.
        let pose = Pose {
            rotation,
            translation: Vec3::new(x, y, 1.7 - depth),
        };
        let mut query = QueryContext::new();
        let sides = [(&*bodies[0], &pose), (&*bodies[1], &Pose::identity())];
        let found = query
            .pair_distance(sides[0], sides[1], f64::INFINITY)
            .unwrap();
        assert_eq!(
            (found.distance, found.lower),
            (0.0, 0.0),
            "{pose:?} {found:?}"
        );
        assert!(query.pair_within(sides[0], sides[1], 0.0).unwrap());
        assert_eq!(class_as_link(&bodies, &pose, 0.0), (Class::Inside, true));
    }
}

/// A disc at an edge of a box half a million times as large, 3.1e-6 off it at least: the direction across the edge, and the
/// supports of both sets along it, leave so much between them. What volumes lose to rounding must not pass for contact.
#[test]
fn a_disc_just_off_a_huge_box_is_free() {
    let half = Vec3::new(241457.6241420255, 185001.65538230314, 412853.764695156);
    let bodies = [
        Cylinder(0.6656062223582805, 0.12672297817459038).body(),
        Cuboid(half).body(),
    ]
    .map(Arc::new);
    let pose = Pose {
        rotation: Mat3::new(
            0.19085360403791196,
            -0.5650003182894047,
            0.8027138606991981,
            0.6969347621633527,
            -0.4978766292541804,
            -0.5161402903579669,
            0.6912718995547635,
            0.6579464281956143,
            0.2987468133898371,
        ),
        translation: Vec3::new(
            -241458.09624876088,
            -185002.14137383638,
            -412853.76000221225,
        ),
    };
    let here = Pose::identity();
    for order in [[0, 1], [1, 0]] {
        let poses = [&pose, &here];
        let [a, b] = order.map(|i| (&*bodies[i], poses[i]));
        let mut query = QueryContext::new();
        assert!(!query.pair_within(a, b, 0.0).unwrap());
        let found = query.pair_distance(a, b, f64::INFINITY).unwrap();
        assert!(
            found.lower > 3.1e-6 && found.distance < 4e-6,
            "{} to {}",
            found.lower,
            found.distance
        );
    }
}

/// Directions are products of lengths, and supports square them: whatever the unit of length, what overlaps meets.
#[test]
fn what_overlaps_meets_at_every_scale() {
    let mut random = Random::new(6);
    let mut query = QueryContext::new();
    for scale in [
        1e-45, 1e-40, 1e-35, 1e-20, 1.0, 1e20, 1e38, 1e39, 1e40, 1e41, 1e45,
    ] {
        for case in 0..1000 {
            let mut semi = || lengths(&mut random, scale, 0.3);
            let (a, b) = (semi(), semi());
            // With one point across from each, the middle is inside.
            let points = random.points(6, 1.0);
            let across = points.iter().flat_map(|p| [p * scale, p * -scale]);
            let hull: Vec<Vec3> = across.collect();
            // Ellipsoids square most.
            let kinds = if case % 2 == 0 { 5 } else { 9 };
            let mut set = |l: Vec3| match random.below(kinds) {
                0 => Cylinder(l.x, l.y),
                1 => Cone(l.x, 2.0 * l.y),
                2 => Points(hull.clone()),
                3 => Cuboid(l),
                _ => Ellipsoid(l),
            };
            // The middle of each is deep inside it.
            let bodies = [set(a), set(b)].map(|set| set.body());
            let pose = Pose {
                rotation: random.rotation(),
                translation: random.unit() * (0.05 * scale),
            };
            let sides = [(&bodies[0], &Pose::identity()), (&bodies[1], &pose)];
            let found = query
                .pair_distance(sides[0], sides[1], f64::INFINITY)
                .unwrap();
            let is_within = query.pair_within(sides[0], sides[1], 0.0).unwrap();
            assert!(
                is_within && found.lower == 0.0,
                "{scale:e} {a:?} {b:?} {found:?}"
            );
        }
    }
}
