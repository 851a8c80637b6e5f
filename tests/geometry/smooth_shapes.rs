//! Smooth primitives: every distance is proved anew, from above by two points whose sets hold them by their equations, from
//! below by a direction along which closed-form support values leave that gap.

use std::f64::consts::FRAC_PI_2;

use cstk::body::Body;
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::QueryContext;

use helpers::all_cases;
use helpers::closed_sets::Set::{self, Ball, Cone, Cylinder, Ellipsoid, Points};
use helpers::random::Random;

/// Asks both ways and proves the answer. `None` for sets that meet.
fn proved(sets: [&Set; 2], bodies: [&Body; 2], pose: &Pose, allowed: f64) -> Option<f64> {
    proved_under(&Pose::identity(), sets, bodies, pose, allowed)
}

/// The same with both in a frame at a pose.
fn proved_under(
    common: &Pose,
    sets: [&Set; 2],
    bodies: [&Body; 2],
    pose: &Pose,
    allowed: f64,
) -> Option<f64> {
    let [a, b] = bodies;
    let ask = |one, other| {
        let found = QueryContext::new().pair_distance(one, other, f64::INFINITY);
        found.unwrap()
    };
    let there = common.compose(pose);
    let mut found = ask((a, common), (b, &there));
    let swapped = ask((b, &there), (a, common));
    let to_frame = common.inverse();
    found.points = found.points.map(|point| to_frame.transform_point(&point));
    let size = sets[0].size().max(pose.translation.norm() + sets[1].size());
    let error = allowed * size;
    let text = format!("{sets:?} {pose:?} {found:?}");
    assert!(
        (found.distance - swapped.distance).abs() <= 2.0 * error,
        "{text} {swapped:?}"
    );
    let back = pose.inverse();
    let [on_a, on_b] = [found.points[0], back.transform_point(&found.points[1])];
    assert!(
        sets[0].excess(&on_a) <= 1e-13 * size,
        "{text} {}",
        sets[0].excess(&on_a)
    );
    assert!(
        sets[1].excess(&on_b) <= 1e-13 * size,
        "{text} {}",
        sets[1].excess(&on_b)
    );
    if found.distance == 0.0 {
        assert!(
            (found.points[0] - found.points[1]).norm() <= error,
            "{text}"
        );
        return None;
    }
    let between = found.points[0] - found.points[1];
    assert!(
        (between.norm() - found.distance).abs() <= 1e-13 * size,
        "{text}"
    );
    let gap = |n: &Vec3| {
        let turned = pose.rotation.transpose() * n;
        n.dot(&-pose.translation) - sets[0].reach(&-n) - sets[1].reach(&turned)
    };
    // The contact's normal, too, must prove the distance: so it is the normal.
    let normal = to_frame.rotation * found.contact.expect("a contact").normal;
    let proof = gap(&normal);
    assert!(proof >= found.distance - error, "{proof} {text}");
    assert!(
        found.lower <= found.distance && proof <= found.upper + 1e-13 * size,
        "{text}"
    );
    assert!(found.lower <= between.norm(), "{text}");
    Some(proof - found.distance)
}

fn random_set(random: &mut Random, kind: usize, spread: f64) -> Set {
    let mut size = || 10f64.powf(random.within(-spread, 0.0));
    let (a, b, c) = (size(), size(), size());
    match kind {
        0 => Cylinder(a, b),
        1 => Cone(a, b),
        2 => Ellipsoid(Vec3::new(a, b, c)),
        3 => Ball(a),
        4 => Points(vec![random.point(1.0)]),
        5 => Points(random.points(2, 1.0)),
        6 => Points(random.points(3, 1.0)),
        _ => Points(random.points(10, 1.0)),
    }
}

#[test]
fn random_pairs() {
    let mut random = Random::new(77);
    let (mut apart, mut met) = (0, 0);
    let mut worst = 0.0f64;
    for round in 0..6000 {
        let spread = [0.01, 1.0, 4.0][round % 3];
        let sets = [random.below(3), random.below(8)].map(|k| random_set(&mut random, k, spread));
        let bodies = [sets[0].body(), sets[1].body()];
        let reach = random.within(0.3, 2.5);
        let pose = random.pose(reach);
        match proved([&sets[0], &sets[1]], [&bodies[0], &bodies[1]], &pose, 2e-10) {
            None => met += 1,
            Some(short) => {
                apart += 1;
                worst = worst.max(-short);
            }
        }
    }
    println!("{apart} apart, {met} meet; proofs fall short by {worst:e} at most");
    assert!(apart > 2000 && met > 300, "{apart} {met}");
}

#[test]
fn all_scales_and_degenerate_sizes() {
    let mut random = Random::new(78);
    for scale in [1e-6, 1e-3, 1e3, 1e6] {
        for thin in [1.0, 1e-4] {
            let sets = [
                Cylinder(scale, thin * scale),
                Cylinder(thin * scale, scale),
                Cone(thin * scale, scale),
                Cone(scale, thin * scale),
                Ellipsoid(Vec3::new(1.0, thin, thin) * scale),
                Ellipsoid(Vec3::new(1.0, 0.5, thin) * scale),
                Ball(scale),
                Points(random.points(3, scale)),
            ];
            let bodies: Vec<Body> = sets.iter().map(Set::body).collect();
            for i in 0..6 {
                for j in 0..8 {
                    for _ in 0..6 {
                        let pose = random.pose(2.0 * scale);
                        proved([&sets[i], &sets[j]], [&bodies[i], &bodies[j]], &pose, 2e-10);
                    }
                }
            }
        }
    }
}

/// What stands on one axis or in one plane of symmetry, upright, upside down or on its side, the whole turned a little or much: supports
/// are many there, and directions of no length.
#[test]
fn special_positions() {
    let mut random = Random::new(80);
    let mut apart = 0;
    for _ in 0..if all_cases() { 400_000 } else { 40_000 } {
        let shape = |random: &mut Random| {
            let kind = random.below(8);
            let size = |random: &mut Random| 10f64.powf(random.within(-3.0, 0.0));
            let (a, b, c) = (size(random), size(random), size(random));
            match kind {
                0 => Cylinder(a, b),
                1 => Cone(a, b),
                2 => Ellipsoid(Vec3::new(a, b, c)),
                3 => Points(vec![Vec3::z() * a, Vec3::z() * -a]),
                _ => {
                    let corners = [Vec3::x() * a, Vec3::y() * b, Vec3::z() * c];
                    Points(corners.iter().flat_map(|v| [*v, -v]).collect())
                }
            }
        };
        let sets = [shape(&mut random), shape(&mut random)];
        let bodies = [sets[0].body(), sets[1].body()];
        let axis = [Vec3::x(), Vec3::y(), Vec3::z()][random.below(3)];
        let over = [Vec3::x(), Vec3::y()][random.below(2)];
        let quarters = random.below(4) as f64;
        let aside = random.below(2) as f64 * 10f64.powf(random.within(-6.0, 0.0));
        let way = [Vec3::x(), Vec3::y(), Vec3::z()][random.below(3)];
        let pose = Pose {
            rotation: rotation_about(&over, quarters * FRAC_PI_2),
            translation: axis * random.within(0.0, 2.0) + way * (aside * sets[0].size()),
        };
        // About a coordinate axis, zeros of the relative rotation stay zeros.
        let about = [Vec3::x(), Vec3::y(), random.unit()][random.below(3)];
        let common = Pose {
            rotation: rotation_about(&about, 10f64.powf(random.within(-7.0, 0.5))),
            translation: random.point(1.0),
        };
        let (sets, bodies) = ([&sets[0], &sets[1]], [&bodies[0], &bodies[1]]);
        apart += usize::from(proved_under(&common, sets, bodies, &pose, 2e-10).is_some());
    }
    assert!(apart > 20_000, "{apart}");
}

/// Far from the origin of their body's frame, and near contact.
#[test]
fn near_contact_the_distance_keeps_its_digits() {
    let mut random = Random::new(79);
    for _ in 0..300 {
        let (p, q) = (random.unit(), random.unit());
        for gap in [1e-3, 1e-6, 1e-9] {
            // Two spheres as ellipsoids, and a cylinder's side against a ball.
            let sets = [Ellipsoid(Vec3::repeat(1.0)), Ball(0.5)];
            let pose = Pose::from_translation(p * (1.5 + gap));
            let bodies = [sets[0].body(), sets[1].body()];
            let found = QueryContext::new()
                .pair_distance(
                    (&bodies[0], &Pose::identity()),
                    (&bodies[1], &pose),
                    f64::INFINITY,
                )
                .unwrap();
            assert!((found.distance - gap).abs() < 1e-13, "{gap} {found:?}");
            let normal = found.contact.unwrap().normal;
            assert!((normal + p).amax() < 1e-6, "{gap} {normal} {p}");

            let flat = Vec3::new(q.x, q.y, 0.0).normalize();
            let pose = Pose::from_translation(flat * (1.5 + gap) + Vec3::z() * (0.9 * q.z));
            let can = Cylinder(1.0, 1.0).body();
            let found = QueryContext::new()
                .pair_distance(
                    (&can, &Pose::identity()),
                    (&bodies[1], &pose),
                    f64::INFINITY,
                )
                .unwrap();
            assert!((found.distance - gap).abs() < 1e-13, "{gap} {found:?}");
            let normal = found.contact.unwrap().normal;
            assert!((normal + flat).amax() < 1e-6, "{gap} {normal} {flat}");
        }
    }
}

/// Between two planes a little apart, each touched by one of the sets: the gap is the distance, however the bodies are turned.
/// Smooth sets next to flat ones make tetrahedra to which rounding alone gives an inside.
#[test]
fn a_gap_is_never_taken_for_contact() {
    let mut random = Random::new(23);
    let count = if all_cases() { 400_000 } else { 40_000 };
    for _ in 0..count {
        let spread = [0.01, 1.0][random.below(2)];
        let (smooth, flat) = (random.below(3), 4 + random.below(3));
        let smooth = random_set(&mut random, smooth, spread);
        let flat = random_set(&mut random, flat, spread);
        let turn = match random.below(4) {
            0 => Pose::identity().rotation,
            _ => random.rotation(),
        };
        let mut way = match random.below(4) {
            0 => [Vec3::x(), Vec3::y(), Vec3::z(), -Vec3::z()][random.below(4)],
            _ => random.unit(),
        };
        if random.below(5) == 0 {
            way = (way + Vec3::z() * 10f64.powf(random.within(0.0, 8.0))).normalize();
        }
        let gap = 10f64.powf(random.within(-10.0, -6.0));
        let pose = Pose {
            rotation: turn,
            translation: smooth.farthest(&way) + way * gap
                - turn * flat.farthest(&-turn.tr_mul(&way)),
        };
        let (a, b) = (smooth.body(), flat.body());
        let found =
            QueryContext::new().pair_distance((&a, &Pose::identity()), (&b, &pose), f64::INFINITY);
        let found = found.unwrap();
        let rounding = 1e-14
            * a.radius_from_origin()
                .max(pose.translation.norm() + b.radius_from_origin());
        assert!(
            found.lower <= gap + rounding && gap - rounding <= found.upper && found.lower > 0.0,
            "{smooth:?} {flat:?} {pose:?} {gap:e} {found:?}"
        );
    }
}
