//! Convex hulls of bodies: no point of a body is farther outside of its hull than the hull is said to leave it.

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::Vec3;
use helpers::random::Random;

fn body(random: &mut Random, middle: &Vec3, size: f64) -> Body {
    let mut builder = BodyBuilder::new(3).unwrap();
    for _ in 0..2 + random.below(6) {
        let at = middle + random.point(size);
        let mut near = || at + random.point(0.5 * size);
        match near().x.to_bits() % 4 {
            0 => builder.add_sphere(&at, 0.1 * size, 0).unwrap(),
            1 => builder.add_capsule(&at, &near(), 0.1 * size, 0).unwrap(),
            2 => builder
                .add_polyhedron(&[at, near(), near(), near(), near(), near()], 0)
                .unwrap(),
            _ => builder.add_polygon(&[at, near(), near()], 0).unwrap(),
        }
    }
    builder
        .build(&HierarchyOptions::default(), &mut |_| Ok(()))
        .unwrap()
}

#[test]
fn a_body_reaches_no_farther_than_its_hull() {
    let mut random = Random::new(83);
    let mut hulls = 0;
    for size in [1e-3, 1.0, 1e3] {
        for distance in [0.0, 1.0, 1e4] {
            for _ in 0..40 {
                let middle = random.point(distance * size + 1e-9);
                let body = body(&mut random, &middle, size);
                let Some((hull, outside)) = body.hull() else {
                    continue;
                };
                hulls += 1;
                assert!(outside < 1e-12 * (size + middle.norm()), "{outside}");
                for _ in 0..200 {
                    let direction = random.unit();
                    let [of_body, of_hull] = [&body, hull]
                        .map(|b| direction.dot(&(b.farthest(&direction).point + b.center())));
                    assert!(
                        of_body <= of_hull + outside + hull.deviation(),
                        "{of_body} {of_hull}"
                    );
                }
            }
        }
    }
    assert!(hulls > 300, "{hulls}");
}

#[test]
fn one_polyhedron_is_its_own_hull() {
    let mut builder = BodyBuilder::new(3).unwrap();
    let corners = [Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()];
    builder.add_polyhedron(&corners, 0).unwrap();
    let body = builder
        .build(&HierarchyOptions::default(), &mut |_| Ok(()))
        .unwrap();
    let (hull, outside) = body.hull().unwrap();
    assert_eq!((hull.serial(), outside), (body.serial(), 0.0));
}
