//! Bodies of a single point, which have no extent: where two are in one place, they meet.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::Class;
use cstk::cobject::InducedOptions;
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::Configuration::Coordinates;
use cstk::query::QueryContext;
use cstk::robot::JointKind;

use helpers::robots::{against_with, environment, link, robot, space};

/// Points at a place of the body's own frame, in all the ways that they can be made.
fn points(at: Vec3) -> Vec<Arc<Body>> {
    let build = |add: &dyn Fn(&mut BodyBuilder)| {
        let mut builder = BodyBuilder::new(3).unwrap();
        add(&mut builder);
        let options = HierarchyOptions::default();
        Arc::new(builder.build(&options, &mut |_| Ok(())).unwrap())
    };
    vec![
        build(&|builder| builder.add_sphere(&at, 0.0, 0).unwrap()),
        build(&|builder| builder.add_polyhedron(&[at], 0).unwrap()),
        build(&|builder| {
            for _ in 0..20 {
                builder.add_sphere(&at, 0.0, 0).unwrap();
            }
        }),
    ]
}

#[test]
fn points_in_one_place_meet() {
    for place in [
        Vec3::zeros(),
        Vec3::x() * 1e-200,
        Vec3::x() * 1e-160,
        Vec3::new(5.0, -2.0, 1.0),
    ] {
        for (moving, standing) in points(place).iter().zip(points(-place).iter().rev()) {
            let mut slider = link(None, JointKind::Prismatic, Vec3::x());
            slider.body = Some(moving.clone());
            let space = space(vec![robot(3, vec![slider])]);
            // Where the moving point is at 0, together with others or alone.
            let there = Pose::from_translation(2.0 * place);
            let far = Pose::from_translation(2.0 * place + Vec3::z() * 3.0);
            for others in [vec![], vec![(standing, far)], vec![(standing, far); 12]] {
                let mut objects = vec![(standing, there)];
                objects.extend(others);
                let (world, _) = environment(&objects);
                for (margin, at) in [(0.0, 0.0), (0.1, 0.0), (0.1, 0.0999), (0.1, -0.0999)] {
                    let options = InducedOptions {
                        margin,
                        ..InducedOptions::default()
                    };
                    let set = against_with(&space, &world, options);
                    let q = Coordinates(&[at]);
                    let mut context = QueryContext::new();
                    assert_eq!(context.classify(&set, q).unwrap(), Class::Inside);
                    assert!(context.within(&set, q, 0.0).unwrap());
                    let found = context.distance(&set, q, f64::INFINITY).unwrap();
                    assert!(found.distance <= 0.0, "{found:?}");
                    let outside = [f64::signum(at) * (margin + 0.001)];
                    let outside = Coordinates(&outside);
                    assert_eq!(context.classify(&set, outside).unwrap(), Class::Outside);
                    let found = context.distance(&set, outside, f64::INFINITY).unwrap();
                    assert!((found.distance - 0.001).abs() < 1e-12, "{found:?}");
                }
            }
        }
    }
}
