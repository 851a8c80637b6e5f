//! Solids and bodies of many pieces: clouds of points in and around a cube, at all scales.

use std::sync::Arc;

use cstk::body::BodyBuilder;
use cstk::cobject::Class;
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::Vec3;
use cstk::query::{Configuration, QueryContext};

use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::surfaces::{cube, moved, solid_one};

/// Which points are inside is known by their coordinates; each is a piece, and a witness.
#[test]
fn the_points_inside_are_found() {
    let mut random = Random::new(11);
    let mut query = QueryContext::new();
    let (mut met, mut free) = (0, 0);
    for round in 0..200 {
        let scale = [1.0, 1e-6, 1e6, 1.0][round % 4];
        // Clouds smaller and much larger than the solid.
        let spread = [0.3, 2.0, 40.0][round % 3] * scale;
        let points: Vec<Vec3> = (0..600).map(|_| random.point(spread)).collect();
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_points(&points, 0.0).unwrap();
        let cloud = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
        let cloud = Arc::new(cloud.unwrap());
        let solid = solid_one(&moved(&cube(scale), &random.pose(0.0)));
        let mut still = link(None, cstk::robot::JointKind::Prismatic, Vec3::x());
        still.body = Some(solid.clone());
        let space = space(vec![robot(3, vec![still])]);
        let pose = random.pose(3.0 * scale);
        let (world, _) = environment(&[(&cloud, pose)]);
        let set = against(&space, &world);
        let q = [random.within(-2.0, 2.0) * scale];
        // How far points are within the cube, by the planes of its faces.
        let faces = solid.primitives();
        let within = |p: &Vec3| {
            let here = pose.transform_point(p) - Vec3::x() * q[0] - solid.center();
            let depth = faces.iter().map(|face| {
                let normal = face.shape.faces[0].normal;
                let outward = normal * normal.dot(&face.vertices[0]).signum();
                outward.dot(&(face.vertices[0] - here))
            });
            depth.fold(f64::INFINITY, f64::min)
        };
        let depths: Vec<f64> = points.iter().map(within).collect();
        if depths.iter().any(|d| d.abs() < 1e-9 * spread) {
            continue;
        }
        let expected: Vec<u32> = (0..)
            .zip(&depths)
            .filter(|(_, depth)| **depth > 0.0)
            .map(|(i, _)| i)
            .collect();
        let at = Configuration::Coordinates(&q);
        let list = query.witnesses(&set, at, 0.0, 1000).unwrap();
        let mut found: Vec<u32> = list.witnesses.iter().map(|w| w.primitives[1]).collect();
        found.sort_unstable();
        assert!(list.witnesses.iter().all(|w| w.contained));
        assert_eq!(found, expected, "round {round}");
        let class = query.classify(&set, at).unwrap();
        assert_eq!(class == Class::Inside, !expected.is_empty());
        *if expected.is_empty() {
            &mut free
        } else {
            &mut met
        } += 1;
    }
    assert!(met > 50 && free > 20, "{met} {free}");
}
