//! Smooth primitives: every distance is proved anew, from above by two points whose sets hold them by their equations, from
//! below by a direction along which closed-form support values leave that gap.

mod common;

use cstk::body::{Body, BodyBuilder};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;

use common::all_cases;
use common::random::Random;

/// A set at a pose, as the test knows it.
#[derive(Clone, Debug)]
enum Set {
    Cylinder(f64, f64),
    Cone(f64, f64),
    Ellipsoid(Vec3),
    Ball(f64),
    Points(Vec<Vec3>),
}

use Set::{Ball, Cone, Cylinder, Ellipsoid, Points};

impl Set {
    fn body(&self) -> Body {
        let mut builder = BodyBuilder::new(3).unwrap();
        let here = Pose::identity();
        match self {
            Cylinder(radius, half) => builder.add_cylinder(&here, *radius, *half, 0),
            Cone(radius, height) => builder.add_cone(&here, *radius, *height, 0),
            Ellipsoid(axes) => builder.add_ellipsoid(&here, axes, 0),
            Ball(radius) => builder.add_sphere(&Vec3::zeros(), *radius, 0),
            Points(points) => builder.add_polyhedron(points, 0),
        }
        .unwrap();
        common::models::built(&builder, &Default::default())
    }

    /// The largest product of a direction with a point of the set.
    fn reach(&self, d: &Vec3) -> f64 {
        let across = d.x.hypot(d.y);
        match self {
            Cylinder(radius, half) => radius * across + half * d.z.abs(),
            Cone(radius, height) => (0.5 * height * d.z).max(radius * across - 0.5 * height * d.z),
            Ellipsoid(axes) => axes.component_mul(d).norm(),
            Ball(radius) => radius * d.norm(),
            Points(points) => points.iter().map(|p| p.dot(d)).fold(f64::MIN, f64::max),
        }
    }

    /// The point farthest along a direction.
    fn farthest(&self, d: &Vec3) -> Vec3 {
        let across = d.x.hypot(d.y);
        let rim = |radius: f64, z: f64| match across {
            0.0 => Vec3::new(0.0, 0.0, z),
            _ => Vec3::new(d.x * radius / across, d.y * radius / across, z),
        };
        match self {
            Cylinder(radius, half) if d.z == 0.0 => rim(*radius, 0.0 * half),
            Cylinder(radius, half) => rim(*radius, half.copysign(d.z)),
            Cone(radius, height) if d.z * height > radius * across => Vec3::z() * (0.5 * height),
            Cone(radius, height) => rim(*radius, -0.5 * height),
            Ellipsoid(axes) => {
                let scaled = axes.component_mul(d);
                axes.component_mul(&scaled) / scaled.norm()
            }
            Ball(radius) => d * (radius / d.norm()),
            Points(points) => {
                let along = |p: &&Vec3, q: &&Vec3| p.dot(d).total_cmp(&q.dot(d));
                *points.iter().max_by(along).unwrap()
            }
        }
    }

    /// How far a point is outside the set, about; at most 0 inside. Of hulls no more is known than by some directions.
    fn excess(&self, p: &Vec3) -> f64 {
        let across = p.x.hypot(p.y);
        match self {
            Cylinder(radius, half) => (across - radius).max(p.z.abs() - half),
            Cone(radius, height) => {
                let slope = height.hypot(*radius);
                let beyond = (height * across + radius * (p.z - 0.5 * height)) / slope;
                beyond.max(-0.5 * height - p.z)
            }
            Ellipsoid(axes) => (p.component_div(axes).norm() - 1.0) * axes.min(),
            Ball(radius) => p.norm() - radius,
            Points(points) => common::oracle::hull_distance(points, &[*p]).upper,
        }
    }

    fn size(&self) -> f64 {
        [Vec3::x(), Vec3::y(), Vec3::z()]
            .iter()
            .map(|axis| self.reach(axis).max(self.reach(&-axis)))
            .fold(0.0, f64::max)
    }
}

/// Asks both ways and proves the answer. `None` for sets that meet.
fn proved(sets: [&Set; 2], bodies: [&Body; 2], pose: &Pose, allowed: f64) -> Option<f64> {
    let here = Pose::identity();
    let [a, b] = bodies;
    let ask = |one, other| {
        let found = QueryContext::new().pair_distance(one, other, f64::INFINITY);
        found.unwrap()
    };
    let found = ask((a, &here), (b, pose));
    let swapped = ask((b, pose), (a, &here));
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
    let normal = found.contact.expect("a contact").normal;
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
        let rounding = 1e-14 * a.reach().max(pose.translation.norm() + b.reach());
        assert!(
            found.lower <= gap + rounding && gap - rounding <= found.upper && found.lower > 0.0,
            "{smooth:?} {flat:?} {pose:?} {gap:e} {found:?}"
        );
    }
}
