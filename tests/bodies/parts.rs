//! Bodies put together of others, against the same primitives added one by one after the motion.

use std::sync::Arc;

use cstk::body::{BodyBuilder, Mesh};
use cstk::error::ErrorKind;
use cstk::hierarchy::{Grouping, HierarchyOptions, Pieces, WrapperKind};
use cstk::pose::{Pose, Vec3};
use cstk_scenes as scenes;

use crate::given::{Given, answers_are_equal, body_of, boxes_bound_their_primitives};
use helpers::files::loaded;
use helpers::models::{GROUPINGS, KINDS, built, options};
use helpers::random::Random;
use helpers::surfaces::*;

#[test]
fn parts_answer_as_their_primitives_one_by_one() {
    let mut random = Random::new(1);
    for case in 0..60 {
        let how = match case % 3 {
            0 => HierarchyOptions::default(),
            1 => options(
                GROUPINGS[case % GROUPINGS.len()],
                KINDS[case % KINDS.len()],
                0.0,
            ),
            _ => options(
                Grouping::TopDown,
                WrapperKind::Hull,
                3.0 * (case % 2) as f64,
            ),
        };
        let how = HierarchyOptions {
            pieces: [Pieces::Off, Pieces::Coplanar, Pieces::Patches][case / 3 % 3],
            ..how
        };
        let mut whole = BodyBuilder::new(3).unwrap();
        let mut flat = BodyBuilder::new(3).unwrap();
        let mut expected = Vec::new();
        for item in 0..1 + random.below(6) {
            let pose = random.pose(2.0);
            let count = 1 + random.below(12);
            let kind = random.below(3);
            let given: Vec<Given> = (0..count)
                .map(|i| match kind {
                    // A body of points, of one sort of primitive, or of many.
                    0 => Given::random(&mut random, 7 + 8 * i),
                    1 => Given::random(&mut random, 0),
                    _ => Given::random(&mut random, i + case),
                })
                .collect();
            if case % 4 == 1 && item % 2 == 0 {
                for one in &given {
                    one.add(&mut whole, &pose, 7);
                    one.add(&mut flat, &pose, 7);
                }
                expected.resize(whole.len(), None);
                continue;
            }
            let part = body_of(&given, &how);
            whole.add_body(&part, &pose, 100 + item as u64).unwrap();
            for (tag, one) in (0..).zip(&given) {
                one.add(&mut flat, &pose, tag);
            }
            expected.resize(whole.len(), Some(100 + item as u64));
        }
        let whole = built(&whole, &how);
        let flat = built(&flat, &HierarchyOptions::default());
        assert_eq!(whole.primitives().len(), flat.primitives().len());
        for (i, expected) in (0..).zip(&expected) {
            assert_eq!(whole.tag(i), flat.tag(i));
            let part = whole
                .part_of(i)
                .map(|part| whole.parts()[part as usize].tag);
            assert_eq!(part, *expected, "primitive {i}");
        }
        for k in 0..3 {
            let [a, b] = [whole.statistics(), flat.statistics()].map(|s| [s.low[k], s.high[k]]);
            assert!((a[0] - b[0]).abs() < 1e-10 && (a[1] - b[1]).abs() < 1e-10);
        }
        boxes_bound_their_primitives(&whole);
        assert!(whole.tree().subsets().is_sound(whole.primitives().len()));
        assert_eq!(
            whole.statistics().depth,
            whole.tree().subsets().depth() as u64
        );
        answers_are_equal(&whole, &flat, &mut random, 12);
        let read = loaded(&whole);
        assert_eq!(read.packed(), whole.packed());
        assert_eq!(read.tree(), whole.tree());
        assert_eq!(read.primitives(), whole.primitives());
        assert_eq!(read.parts(), whole.parts());
    }
}

/// Parts within parts: the innermost tags stay, and the outermost part is named.
#[test]
fn parts_may_have_parts() {
    let mut random = Random::new(2);
    let given: Vec<Given> = (0..9)
        .map(|kind| Given::random(&mut random, kind))
        .collect();
    let mut body = body_of(&given, &HierarchyOptions::default());
    let mut poses = vec![Pose::identity()];
    for _ in 0..3 {
        let mut builder = BodyBuilder::new(3).unwrap();
        let steps = [random.pose(1.0), random.pose(3.0)];
        for (tag, step) in (0..).zip(&steps) {
            builder.add_body(&body, step, tag).unwrap();
        }
        let outer = steps
            .iter()
            .flat_map(|step| poses.iter().map(|pose| step.compose(pose)));
        poses = outer.collect();
        body = Arc::new(built(&builder, &HierarchyOptions::default()));
    }
    let mut flat = BodyBuilder::new(3).unwrap();
    for pose in &poses {
        for (tag, one) in (0..).zip(&given) {
            one.add(&mut flat, pose, tag);
        }
    }
    assert_eq!(body.parts().len(), 2);
    assert_eq!(body.parts()[1].first as usize, body.primitives().len() / 2);
    boxes_bound_their_primitives(&body);
    let flat = built(&flat, &HierarchyOptions::default());
    answers_are_equal(&body, &flat, &mut random, 40);
}

/// A chain of parts, each of the one before and a primitive, would get a level deeper each time.
#[test]
fn deep_chains_of_parts_stay_shallow() {
    let mut random = Random::new(3);
    let mut body = body_of(
        &[Given::random(&mut random, 1)],
        &HierarchyOptions::default(),
    );
    for step in 0..150 {
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_body(&body, &Pose::identity(), step).unwrap();
        Given::random(&mut random, 1).add(&mut builder, &random.pose(3.0), step);
        body = Arc::new(built(&builder, &HierarchyOptions::default()));
        assert!(body.statistics().depth <= 57);
    }
    boxes_bound_their_primitives(&body);
    assert_eq!(loaded(&body).packed(), body.packed());
}

/// Solids as parts: a point is inside where it is inside one of them, whichever way their faces run.
#[test]
fn the_union_of_solid_parts_is_solid() {
    let mut random = Random::new(4);
    let hollow = hollow_cube();
    let meshes = [
        vec![cube(0.5)],
        vec![inside_out(&cube(0.6))],
        vec![sphere(0.6, 5)],
        vec![inside_out(&sphere(0.5, 4))],
        hollow,
        vec![with_sliver(0.0)],
    ];
    for case in 0..40 {
        let mut builder = BodyBuilder::new(3).unwrap();
        let mut placed: Vec<Vec<Mesh>> = Vec::new();
        for _ in 0..2 + random.below(3) {
            let meshes = &meshes[random.below(meshes.len())];
            let pose = random.pose(0.6);
            placed.push(meshes.iter().map(|mesh| moved(mesh, &pose)).collect());
            if case % 3 == 0 && placed.len() == 2 {
                for mesh in placed.last().unwrap() {
                    builder.add_mesh(mesh).unwrap();
                }
                builder.set_solid(true);
            } else {
                builder.add_body(&solid(meshes), &pose, 0).unwrap();
            }
        }
        // A surface that bounds nothing.
        let patch = body_of(
            &[Given::random(&mut random, 0)],
            &HierarchyOptions::default(),
        );
        builder.add_body(&patch, &random.pose(0.5), 0).unwrap();
        // Nested once more, and out of a file.
        let inner = Arc::new(built(&builder, &HierarchyOptions::default()));
        let mut outer = BodyBuilder::new(3).unwrap();
        let pose = random.pose(1.0);
        outer.add_body(&inner, &pose, 0).unwrap();
        let outer = built(&outer, &HierarchyOptions::default());
        assert!(inner.statistics().is_solid && outer.statistics().is_solid);
        let read = loaded(&outer);
        assert_eq!(read.solid(), outer.solid());
        let mut inside = 0;
        for _ in 0..300 {
            let p = random.point(1.0);
            let turns: Vec<f64> = placed
                .iter()
                .map(|meshes| meshes.iter().map(|mesh| turns_around(mesh, &p)).sum())
                .collect();
            if turns.iter().any(|turns| turns.is_nan()) {
                continue;
            }
            let expected = turns.iter().any(|turns| turns.round() != 0.0);
            inside += usize::from(expected);
            assert_eq!(number_at(&inner, p) != 0, expected, "{turns:?}");
            let p = pose.transform_point(&p);
            assert_eq!(number_at(&outer, p) != 0, expected, "{turns:?}");
            assert_eq!(number_at(&read, p) != 0, expected, "{turns:?}");
        }
        assert!(inside > 5, "{inside}");
    }
}

#[test]
fn planar_parts_stay_in_their_plane() {
    let mut random = Random::new(5);
    let mut part = BodyBuilder::new(2).unwrap();
    let polygon = random.polygon(5, 0.5);
    part.add_polygon(&polygon, 3).unwrap();
    part.add_sphere(&Vec3::x(), 0.2, 4).unwrap();
    let part = Arc::new(built(&part, &HierarchyOptions::default()));
    let mut whole = BodyBuilder::new(2).unwrap();
    let pose = random.planar_pose(1.0);
    whole.add_body(&part, &pose, 0).unwrap();
    let refused = whole.add_body(&part, &random.pose(1.0), 0).unwrap_err();
    assert_eq!(refused.kind, ErrorKind::InvalidArgument);
    assert!(refused.message.contains("plane"), "{}", refused.message);
    let mut spatial = BodyBuilder::new(3).unwrap();
    let refused = spatial.add_body(&part, &pose, 0).unwrap_err();
    assert!(refused.message.contains("dimension"), "{}", refused.message);
    assert!(spatial.is_empty());
    let whole = built(&whole, &HierarchyOptions::default());
    assert!(
        whole
            .primitives()
            .iter()
            .all(|p| p.vertices.iter().all(|v| v.z == 0.0))
    );
}

/// The scene of figure 9 (§3.3): 44 robot bases of 276 polygons.
#[test]
fn robot_bases_as_parts() {
    let mut random = Random::new(6);
    let mesh = scenes::robot_base();
    let base = Arc::new(built(
        &helpers::models::builder(&mesh),
        &HierarchyOptions::default(),
    ));
    let mut whole = BodyBuilder::new(3).unwrap();
    let mut flat = BodyBuilder::new(3).unwrap();
    for i in 0..44 {
        let mut pose = random.pose(0.0);
        pose.translation = Vec3::new(f64::from(i % 7), f64::from(i / 7), 0.0) * 1.1;
        whole.add_body(&base, &pose, i as u64).unwrap();
        for (tag, face) in (0..).zip(&mesh.faces) {
            let corners = face.iter().map(|&i| Vec3::from(mesh.vertices[i as usize]));
            let corners: Vec<Vec3> = corners.map(|p| pose.transform_point(&p)).collect();
            flat.add_polygon(&corners, tag).unwrap();
        }
    }
    let start = std::time::Instant::now();
    let whole = built(&whole, &HierarchyOptions::default());
    let composed = start.elapsed();
    let start = std::time::Instant::now();
    let flat = built(&flat, &HierarchyOptions::default());
    let anew = start.elapsed();
    println!("composed {composed:?}, anew {anew:?}");
    assert_eq!(whole.primitives().len(), 44 * base.primitives().len());
    boxes_bound_their_primitives(&whole);
    answers_are_equal(&whole, &flat, &mut random, 60);
}
