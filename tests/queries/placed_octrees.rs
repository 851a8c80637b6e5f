//! Octrees that stand in an environment, while cells change: queries against them and brute force over the cells' boxes.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Instant;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::Class;
use cstk::environment::{Change, Environment};
use cstk::error::ErrorKind;
use cstk::hierarchy::HierarchyOptions;
use cstk::octree::Octree;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition};

use super::octrees::{Model, change, random_change};
use helpers::random::Random;
use helpers::robots::{against, environment, free_body, link, robot, space};

/// A ball that moves freely, and the distance of its centre from the nearest cell.
struct Ball {
    radius: f64,
    query: QueryContext,
}

impl Ball {
    fn new(radius: f64) -> (Self, Arc<Body>) {
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_sphere(&Vec3::zeros(), radius, 0).unwrap();
        let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
        let query = QueryContext::new();
        (Self { radius, query }, Arc::new(body.unwrap()))
    }
}

/// The distance of a point from the boxes of the cells.
fn from_cells(model: &Model, resolution: f64, point: &Vec3) -> f64 {
    let from_cell = |cell: &[i64; 3]| {
        let away = |axis: usize| {
            let low = cell[axis] as f64 * resolution;
            (low - point[axis])
                .max(point[axis] - low - resolution)
                .max(0.0)
        };
        Vec3::new(away(0), away(1), away(2)).norm()
    };
    model.iter().map(from_cell).fold(f64::INFINITY, f64::min)
}

#[test]
fn queries_see_each_change_as_brute_force_does() {
    let mut random = Random::new(77);
    let resolution = 0.07;
    for round in 0..6 {
        let (mut ball, body) = Ball::new(0.11);
        let space = space(vec![free_body(&body)]);
        let world = Arc::new(Environment::default());
        let set = against(&space, &world);
        let mut octree = Octree::new(resolution).unwrap();
        let mut model = Model::new();
        let mut pose = random.pose(2.0);
        if round % 2 == 0 {
            random_change(&mut random, &mut octree, &mut model, 10);
        }
        octree.place(&world, &pose, None).unwrap();
        for step in 0..40 {
            if step == 25 {
                pose = random.pose(2.0);
                octree.move_to(&pose).unwrap();
            }
            random_change(&mut random, &mut octree, &mut model, 10);
            for _ in 0..6 {
                let center = random.point(1.0);
                let at = pose.transform_point(&center);
                let q = [at.x, at.y, at.z, 0.3, 0.1, -0.4];
                let expected = from_cells(&model, resolution, &center) - ball.radius;
                let at = Configuration::Coordinates(&q);
                let found = ball.query.distance(&set, at, f64::INFINITY).unwrap();
                if model.is_empty() {
                    assert!(found.upper.is_infinite());
                    continue;
                }
                assert!(
                    (found.upper - expected.max(0.0)).abs() < 1e-12,
                    "{found:?} {expected}"
                );
                if expected.abs() > 1e-9 {
                    let class = ball.query.classify(&set, at).unwrap();
                    let expected = if expected > 0.0 {
                        Class::Outside
                    } else {
                        Class::Inside
                    };
                    assert_eq!(class, expected);
                }
                let list = ball.query.witnesses(&set, at, 0.2, 10_000).unwrap();
                for contact in &list.contacts {
                    let on_cells = pose.inverse().transform_point(&contact.points[1]);
                    assert!(from_cells(&model, resolution, &on_cells) < 1e-12);
                }
                assert_eq!(!list.witnesses.is_empty(), expected <= 0.2);
            }
        }
        octree.remove().unwrap();
        assert!(world.snapshot().is_empty());
    }
}

/// A tetrahedron against the octree that changed, and against the body of its cells built anew.
#[test]
fn answers_are_those_of_a_body_built_anew() {
    let mut random = Random::new(8);
    let mut builder = BodyBuilder::new(3).unwrap();
    let corners = random.points(4, 0.3);
    builder.add_polyhedron(&corners, 0).unwrap();
    let built = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    let space = space(vec![free_body(&Arc::new(built.unwrap()))]);
    let mut query = QueryContext::new();
    let pose = random.pose(3.0);
    let changing = Arc::new(Environment::default());
    let mut octree = Octree::new(0.05).unwrap();
    octree.place(&changing, &pose, None).unwrap();
    let mut model = Model::new();
    for _ in 0..30 {
        random_change(&mut random, &mut octree, &mut model, 16);
        if model.is_empty() {
            continue;
        }
        let body = octree.body(&HierarchyOptions::default(), &mut |_| Ok(()));
        let body = Arc::new(body.unwrap());
        assert_eq!(body.primitives().len(), octree.cubes().len());
        let (anew, _) = environment(&[(&body, pose)]);
        for _ in 0..20 {
            let at = pose.transform_point(&random.point(1.2));
            let angles = random.point(3.0);
            let q = [at.x, at.y, at.z, angles.x, angles.y, angles.z];
            let at = Configuration::Coordinates(&q);
            let [a, b] = [&changing, &anew].map(|world| {
                let set = against(&space, world);
                let distance = query.distance(&set, at, f64::INFINITY).unwrap();
                (distance.upper, query.classify(&set, at).unwrap())
            });
            assert!((a.0 - b.0).abs() < 1e-12 && a.1 == b.1, "{a:?} {b:?}");
        }
    }
}

/// Points on and about the seam of two tiles in the middle of occupied cells, wherever the octree is put, moved there or placed.
#[test]
fn no_rounding_of_places_opens_a_gap_between_tiles() {
    let mut random = Random::new(6);
    let resolution = 0.05;
    for size in [0.0, 1.0, 100.0, 1e5] {
        let mut octree = Octree::new(resolution).unwrap();
        change(&mut octree, &mut Model::new(), [4, 0, 0], [8, 4, 4], true);
        let world = Arc::new(environment(&[]).0);
        octree.place(&world, &Pose::identity(), None).unwrap();
        for round in 0..40 {
            let pose = random.pose(size);
            if round == 20 {
                octree.remove().unwrap();
                octree.place(&world, &pose, None).unwrap();
            } else {
                octree.move_to(&pose).unwrap();
            }
            for step in -6..=6 {
                let x = 8.0 * resolution + f64::from(step) * size * 2e-17;
                let mut builder = BodyBuilder::new(3).unwrap();
                let at = Vec3::new(x, 0.1, 0.1);
                builder.add_sphere(&at, 0.0, 0).unwrap();
                let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
                let point = LinkDefinition {
                    at: pose,
                    body: Some(Arc::new(body.unwrap())),
                    ..link(None, JointKind::Prismatic, Vec3::z())
                };
                let cell = against(&space(vec![robot(3, vec![point])]), &world);
                let class = QueryContext::new().classify(&cell, Configuration::Coordinates(&[0.0]));
                assert_eq!(class.unwrap(), Class::Inside, "{x} at {pose:?}");
            }
        }
    }
}

/// Tiles reach over their neighbours by what their places round to where they are, not by what they did where they were.
#[test]
fn an_octree_that_comes_back_from_afar_is_as_it_was() {
    let world = Arc::new(Environment::default());
    let mut octree = Octree::new(1.0).unwrap();
    octree.set(&[Vec3::repeat(0.5)], true).unwrap();
    octree.place(&world, &Pose::identity(), None).unwrap();
    let mut ball = BodyBuilder::new(3).unwrap();
    ball.add_sphere(&Vec3::zeros(), 1.0, 0).unwrap();
    let ball = ball.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    let space = space(vec![free_body(&Arc::new(ball.unwrap()))]);
    let cobject = against(&space, &world);
    let mut q = vec![0.0; space.nq()];
    (q[0], q[1], q[2]) = (3.0, 0.5, 0.5);
    for far in [1e8, 1e10, 1e12, 1e14] {
        let pose = Pose::from_translation(Vec3::new(far, 0.0, 0.0));
        octree.move_to(&pose).unwrap();
        octree.move_to(&Pose::identity()).unwrap();
        let at = Configuration::Coordinates(&q);
        let found = QueryContext::new().distance(&cobject, at, f64::INFINITY);
        let found = found.unwrap().distance;
        assert!((found - 1.0).abs() <= 1e-14, "{far:e}: {found}");
    }
}

fn ids(world: &Environment) -> BTreeSet<u64> {
    world.snapshot().objects().map(|object| object.id).collect()
}

#[test]
fn a_change_replaces_only_the_objects_around_it() {
    let world = Arc::new(Environment::default());
    let mut octree = Octree::new(1.0).unwrap();
    let mut model = Model::new();
    change(&mut octree, &mut model, [-32, -32, 0], [64, 64, 1], true);
    octree.place(&world, &Pose::identity(), None).unwrap();
    assert_eq!(octree.object_count(), 256);
    let mut before = ids(&world);
    let version = world.snapshot().version;
    let mut random = Random::new(4);
    for _ in 0..50 {
        let low = [
            random.below(60) as i64 - 30,
            random.below(60) as i64 - 30,
            0,
        ];
        let occupied = !model.contains(&low);
        change(&mut octree, &mut model, low, [1; 3], occupied);
        let after = ids(&world);
        assert!(before.difference(&after).count() <= 1 && after.difference(&before).count() <= 1);
        before = after;
    }
    assert_eq!(world.snapshot().version, version + 50);
    // A cube that becomes full replaces its tiles by one object, and one cell less parts it again.
    change(&mut octree, &mut model, [0, 0, 8], [16, 16, 16], true);
    let one = octree.object_count();
    change(&mut octree, &mut model, [0, 0, 0], [16, 16, 8], true);
    assert!(octree.object_count() < one);
    octree.set(&[Vec3::repeat(3.5)], false).unwrap();
    assert_eq!(octree.cell_count(), (model.len() - 1) as u64);
}

/// Cells in a row are one box, and tiles with equal cells share a body, whichever change made them.
#[test]
fn tiles_are_few_boxes_and_share_their_bodies() {
    let world = Arc::new(Environment::default());
    let mut octree = Octree::new(0.5).unwrap();
    let mut model = Model::new();
    octree.place(&world, &Pose::identity(), None).unwrap();
    // About as far from the origin, so that they are grown by as much.
    for x in [20, 24, 28] {
        change(&mut octree, &mut model, [x, 0, 1], [4, 4, 2], true);
    }
    change(&mut octree, &mut model, [0, 8, 8], [2, 1, 1], true);
    let state = world.snapshot();
    let bodies: Vec<&Arc<Body>> = state.objects().map(|object| &object.body).collect();
    assert_eq!(bodies.len(), 4);
    assert!(bodies.iter().all(|body| body.primitives().len() == 1));
    let shared = |i: usize| Arc::ptr_eq(bodies[0], bodies[i]);
    assert_eq!([1, 2, 3].map(shared), [true, true, false]);
}

/// What is there already stays as it is.
#[test]
fn cells_that_are_occupied_already_change_nothing() {
    let mut random = Random::new(9);
    let mut octree = Octree::new(0.1).unwrap();
    let mut model = Model::new();
    for _ in 0..40 {
        random_change(&mut random, &mut octree, &mut model, 12);
    }
    let mut same = Octree::new(0.1).unwrap();
    same.insert(&octree).unwrap();
    let world = Arc::new(environment(&[]).0);
    octree.place(&world, &Pose::identity(), None).unwrap();
    let before = (ids(&world), world.snapshot().version);
    octree.insert(&same).unwrap();
    assert_eq!((ids(&world), world.snapshot().version), before);
}

/// A snapshot keeps its cells; an environment that refuses a change leaves the octree as it was.
#[test]
fn snapshots_stay_and_refused_changes_change_nothing() {
    let world = Arc::new(Environment::default());
    let mut octree = Octree::new(1.0).unwrap();
    octree.set(&[Vec3::repeat(0.5)], true).unwrap();
    octree.place(&world, &Pose::identity(), None).unwrap();
    let kept = Arc::new(world.freeze());
    octree.set(&[Vec3::new(5.5, 0.5, 0.5)], true).unwrap();
    assert_eq!((kept.snapshot().len(), world.snapshot().len()), (1, 2));
    let error = octree.place(&world, &Pose::identity(), None).unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidArgument);
    let mut other = Octree::new(1.0).unwrap();
    let error = other.place(&kept, &Pose::identity(), None).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Unsupported);
    let error = other.move_to(&Pose::identity()).unwrap_err();
    assert_eq!(error.kind, ErrorKind::NotFound);
    // Planar bodies keep boxes out, so that the next change fails.
    let mut flat = BodyBuilder::new(2).unwrap();
    let corners = [Vec3::zeros(), Vec3::x(), Vec3::y()];
    flat.add_polygon(&corners, 0).unwrap();
    let flat = flat.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    let planar = Arc::new(Environment::default());
    other.place(&planar, &Pose::identity(), None).unwrap();
    let add = Change::add(Arc::new(flat.unwrap()), Pose::identity());
    planar.apply(&[add]).unwrap();
    assert!(other.set(&[Vec3::zeros(), Vec3::x()], true).is_err());
    assert!(other.insert(&octree).is_err());
    assert_eq!((other.cell_count(), other.object_count()), (0, 0));
    // Objects that somebody else deleted are not missed.
    let all = ids(&world).into_iter().map(|id| Change::Delete { id });
    world.apply(&all.collect::<Vec<_>>()).unwrap();
    octree.set(&[Vec3::repeat(0.5)], false).unwrap();
    assert_eq!((octree.cell_count(), world.snapshot().len()), (1, 0));
    octree.remove().unwrap();
    octree.remove().unwrap();
}

/// What changes cost beside the body built anew; to be run by hand.
#[test]
#[ignore = "a measurement"]
fn octree_costs() {
    for edge in [64, 256] {
        let world = Arc::new(Environment::default());
        let mut octree = Octree::new(0.05).unwrap();
        let mut model = Model::new();
        change(&mut octree, &mut model, [0, 0, 0], [edge, edge, 1], true);
        let start = Instant::now();
        let body = octree
            .body(&HierarchyOptions::default(), &mut |_| Ok(()))
            .unwrap();
        let anew = start.elapsed();
        let start = Instant::now();
        octree.place(&world, &Pose::identity(), None).unwrap();
        let placed = start.elapsed();
        let mut random = Random::new(1);
        let rounds = 200;
        let mut one = || {
            let cell = [
                random.below(edge as usize) as i64,
                random.below(edge as usize) as i64,
                0,
            ];
            let occupied = !model.contains(&cell);
            change(&mut octree, &mut model, cell, [1; 3], occupied);
        };
        one();
        let start = Instant::now();
        (0..rounds).for_each(|_| one());
        let each = start.elapsed() / rounds;
        println!(
            "{} cells, {} cubes: the body anew {anew:?}, placed as {} objects {placed:?}, a cell changed {each:?}",
            octree.cell_count(),
            body.primitives().len(),
            octree.object_count(),
        );
    }
}
