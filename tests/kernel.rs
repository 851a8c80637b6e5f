//! The parts of the kernel, each against something that knows nothing of it: boxes against the vertices they hold, bounds
//! against distances by brute force, the distance of polygons against the same and against all their features.

mod common;

use cstk::body::{Body, BodyBuilder};
use cstk::convex::{DistanceScratch, PlacedBuffer, closest_points};
use cstk::hierarchy::{Grouping, PackedBox, PackedTree, Unit};
use cstk::pair::{Pairing, PrimitiveScratch};
use cstk::pose::{Mat3, Pose, Vec3};
use cstk::tolerance::DISTANCE_ERROR;
use cstk_scenes as scenes;

use common::models::{KINDS, builder, built, mixed_primitives, options};
use common::oracle::hull_distance;
use common::random::Random;

/// How far a point is outside a box in either of its meanings, at most 0 inside; both in units of the tree.
fn outside(bounds: &PackedBox, point: &Vec3) -> f64 {
    let from_center = point - Vec3::from(bounds.center.map(f64::from));
    let axes = Mat3::from_columns(&bounds.axes.map(|axis| Vec3::from(axis.map(f64::from))));
    let uprightness = (axes.transpose() * axes - Mat3::identity()).norm();
    assert!(uprightness < 1.0 / 4096.0, "axes are {uprightness} askew");
    let along = axes.transpose() * from_center;
    let places = axes.try_inverse().expect("axes") * from_center;
    let half = Vec3::from(bounds.half.map(f64::from));
    (along.abs() - half).sup(&(places.abs() - half)).max()
}

/// Checks the boxes of a unit and of all below, and counts the primitives met.
fn check_boxes(
    body: &Body,
    tree: &PackedTree,
    unit: Unit,
    ancestors: &mut Vec<PackedBox>,
) -> usize {
    ancestors.push(tree.bounding_box(unit));
    let met = if unit.is_leaf() {
        let place = tree.place(unit);
        let primitive = tree.primitives().entry(place as usize).primitive;
        for vertex in &body.primitives()[primitive as usize].vertices {
            for bounds in ancestors.iter() {
                let excess = outside(bounds, &(vertex / tree.scale()));
                assert!(excess <= 1e-15, "primitive {primitive} is {excess} outside");
            }
        }
        1
    } else {
        let index = tree.index(unit);
        let node = tree.node(index);
        let count = node.count as usize;
        assert!((2..=8).contains(&count), "{count} children");
        let eight = node.boxes(0.5);
        let met = (0..count)
            .map(|lane| {
                let child = tree.child(index, lane);
                let bounds = tree.bounding_box(child);
                for i in 0..3 {
                    assert_eq!(eight.center[i].0[lane], 0.5 * bounds.center[i]);
                    assert_eq!(eight.half[i].0[lane], 0.5 * bounds.half[i]);
                    for k in 0..3 {
                        assert_eq!(eight.axes[i][k].0[lane], bounds.axes[i][k]);
                    }
                }
                assert!(tree.lowest(child) >= tree.lowest(unit));
                check_boxes(body, tree, child, ancestors)
            })
            .sum();
        let lowest = (0..count).map(|lane| tree.lowest(tree.child(index, lane)));
        assert_eq!(lowest.min(), Some(tree.lowest(unit)));
        met
    };
    ancestors.pop();
    met
}

#[test]
fn every_box_holds_what_is_below_and_every_primitive_is_met_once() {
    for (name, builder) in [
        ("lamp", builder(&scenes::lamp())),
        ("spaghetti", builder(&scenes::spaghetti(2000, 3))),
        ("mixed", mixed_primitives(300, 5)),
    ] {
        for wrapper in KINDS {
            let body = built(&builder, &options(Grouping::Hybrid, wrapper, 0.0));
            let tree = body.packed();
            let met = check_boxes(&body, tree, tree.root(), &mut Vec::new());
            assert_eq!(met, body.primitives().len(), "{name}, {wrapper:?}");
        }
    }
}

/// Convex polygons of three to nine corners: round, slender, tiny, or nearly flat triangles.
fn polygon(random: &mut Random) -> Vec<Vec3> {
    let corners = 3 + random.below(7);
    let size = [1.0, 1e-3, 3.0][random.below(3)];
    let width = size * [1.0, 1e-2, 1e-6][random.below(3)];
    let turn = random.within(0.0, 6.0);
    (0..corners)
        .map(|i| {
            let angle = turn
                + (i as f64 + random.within(0.0, 0.5)) / corners as f64 * std::f64::consts::TAU;
            Vec3::new(size * angle.cos(), width * angle.sin(), 0.0)
        })
        .collect()
}

/// A pose in which two polygons may be apart, nearly touching, crossing, parallel or in one plane.
fn relative(random: &mut Random) -> Pose {
    let mut pose = Pose::identity();
    if random.below(3) > 0 {
        pose.rotation = random.rotation();
    } else if random.below(2) == 0 {
        pose.rotation = cstk::pose::rotation_about(&Vec3::z(), random.within(-3.0, 3.0));
    }
    let reach = [1e-9, 1e-3, 0.5, 3.0][random.below(4)];
    pose.translation = random.point(reach);
    if random.below(4) == 0 {
        pose.translation.z = 0.0;
    }
    pose
}

#[test]
fn distances_of_polygons_are_those_of_brute_force_and_of_all_features() {
    let mut random = Random::new(11);
    let (mut touching, mut worst) = (0, 0.0f64);
    for case in 0..20_000 {
        let body = |points: &[Vec3]| {
            let mut builder = BodyBuilder::new(3).unwrap();
            builder.add_polygon(points, 0).ok()?;
            builder.build(&Default::default(), &mut |_| Ok(())).ok()
        };
        let (Some(a), Some(b)) = (body(&polygon(&mut random)), body(&polygon(&mut random))) else {
            continue;
        };
        let pose = relative(&mut random);
        let pairing = Pairing::new(&a, &Pose::identity(), &b, &pose);
        let size = pairing.precision.size;
        let mut scratch = PrimitiveScratch::default();
        let found = pairing
            .distance([0, 0], f64::INFINITY, &mut scratch)
            .unwrap();
        // The same with a cutoff on either side of it.
        if found > 0.0 {
            assert_eq!(pairing.distance([0, 0], found, &mut scratch), Some(found));
            assert_eq!(
                pairing.distance([0, 0], found * 0.99 - 1e-12 * size, &mut scratch),
                None
            );
        }
        let moved: Vec<Vec3> = b.primitives()[0]
            .vertices
            .iter()
            .map(|v| pairing.relative.transform_point(v))
            .collect();
        let truth = hull_distance(&a.primitives()[0].vertices, &moved);
        let error = (found - truth.upper).max(truth.lower() - found) / size;
        worst = worst.max(error);
        assert!(
            error <= 1e-13,
            "case {case}: {found}, brute force {truth:?}"
        );
        let (mut buffer_a, mut buffer_b) = (PlacedBuffer::default(), PlacedBuffer::default());
        let features = closest_points(
            &buffer_a.place(&a.primitives()[0], &Pose::identity()),
            &buffer_b.place(&b.primitives()[0], &pairing.relative),
            &pairing.precision,
            &mut DistanceScratch::default(),
        );
        let apart = (features.distance - found).abs() / size;
        assert!(
            apart <= 2.0 * DISTANCE_ERROR,
            "case {case}: {found}, all features {features:?}"
        );
        // The closest points are as far apart as the distance says.
        let hit = pairing.met([0, 0], found).hit(0, found);
        let closest = pairing.closest(&hit);
        let between = (closest.points[0] - closest.points[1]).norm();
        assert!(
            (between - found).abs() <= 1e-13 * size,
            "case {case}: {closest:?}"
        );
        touching += usize::from(found == 0.0);
    }
    println!("worst error {worst:.1e} of the size; {touching} of 20,000 touch");
    assert!((1000..15_000).contains(&touching));
}

/// The walk compares single-precision bounds of boxes; what it finds must not depend on how large the world is.
#[test]
fn answers_scale_with_the_world() {
    let mesh = scenes::lamp();
    let mut answers = Vec::new();
    for scale in [
        1.0,
        2f64.powi(-90),
        2f64.powi(90),
        2f64.powi(-30),
        2f64.powi(30),
    ] {
        let mut scaled = mesh.clone();
        for vertex in &mut scaled.vertices {
            *vertex = vertex.map(|x| x * scale);
        }
        let body = built(&builder(&scaled), &Default::default());
        let mut context = cstk::query::QueryContext::new();
        let mut random = Random::new(2);
        for _ in 0..20 {
            let pose = Pose {
                rotation: random.rotation(),
                translation: random.point(1.5) * scale,
            };
            let found = context
                .pair_distance((&body, &pose), (&body, &Pose::identity()), f64::INFINITY)
                .unwrap();
            answers.push((found.distance / scale, found.witness.unwrap().primitives));
        }
    }
    for other in answers.chunks_exact(20).skip(1) {
        assert_eq!(other, &answers[..20]);
    }
}
