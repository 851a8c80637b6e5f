//! How near bodies come to the centres of their balls: never nearer than they are said to come at most.

use cstk::hierarchy::gap_to_center;
use cstk::pose::{Pose, Vec3};
use cstk::primitive::{
    Convex, Primitives, block, capsule, cone, convex_polygon, convex_polyhedron, cylinder,
    ellipsoid, sphere,
};
use helpers::random::Random;

fn shapes(random: &mut Random, length: f64) -> Vec<Convex> {
    let sizes = Vec3::from_fn(|_, _| length * 10f64.powf(random.within(-3.0, 0.0)));
    let at = random.point(length);
    let pose = Pose {
        rotation: random.rotation(),
        translation: at,
    };
    let points: Vec<Vec3> = (0..12)
        .map(|_| at + random.point(1.0).component_mul(&sizes))
        .collect();
    let made = [
        sphere(&at, sizes.x, false),
        capsule(&[at, points[0]], sizes.y, false),
        block(&pose, &sizes),
        cylinder(&pose, sizes.x, sizes.y),
        cone(&pose, sizes.x, sizes.y),
        ellipsoid(&pose, &sizes),
        convex_polygon(&points[..3]),
        convex_polyhedron(&points),
    ];
    made.into_iter().flatten().collect()
}

/// A set within r of a point, or holding the ball of radius -r around it, has no direction in which its support is less than the
/// point's by more than r.
#[test]
fn no_support_is_farther_behind_than_the_reach() {
    let mut random = Random::new(71);
    let (mut held, mut count) = (0, 0);
    for length in [1e-3, 1.0, 1e4] {
        let all: Vec<Convex> = (0..300).flat_map(|_| shapes(&mut random, length)).collect();
        for shape in all {
            let first = shape.vertices[0];
            let size = (shape.extent().1 - shape.extent().0).norm();
            for center in [
                first,
                first + random.point(0.3 * size),
                random.point(length),
            ] {
                let mut primitives = Primitives::default();
                primitives.push(shape.clone(), 0);
                let gap = gap_to_center(&primitives, &center);
                let behind = (0..200).map(|_| {
                    let direction = random.unit();
                    direction.dot(&(center - shape.farthest(&direction)))
                });
                let rounding = 1e-14 * (size + center.norm() + first.norm());
                let most = behind.fold(f64::NEG_INFINITY, f64::max);
                assert!(most <= gap + rounding, "{most} {gap} {shape:?}");
                held += usize::from(gap < 0.0);
                count += 1;
            }
        }
    }
    assert!(held > count / 5, "{held} of {count}");
}
