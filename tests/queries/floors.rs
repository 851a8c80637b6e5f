//! Half-spaces of the world that links must keep out of, against all vertices, closed forms and central differences.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, Class, PureOptions, PureShape};
use cstk::error::ErrorKind;
use cstk::hierarchy::HierarchyOptions;
use cstk::motion::SlideOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, DistanceKind, PurePlace, QueryContext, SSide};
use cstk::robot::{Coordinate, JointKind};
use cstk::space::{Space, WorldBox};

use helpers::random::Random;
use helpers::robots::{against, environment, free_body, free_planar_body, link, robot, space};
use helpers::shapes::{cuboid, dented_ball, planar};

fn floor(space: &Arc<Space>, links: &[usize], normal: Vec3, offset: f64) -> CObject {
    let shape = PureShape::floor(space, links, &normal, offset).unwrap();
    let options = PureOptions {
        contact_epsilon: 0.1,
        scale: None,
    };
    CObject::pure(space.clone(), shape, options).unwrap()
}

fn configuration(random: &mut Random, n: usize) -> Vec<f64> {
    (0..n).map(|_| random.within(-3.0, 3.0)).collect()
}

/// Distances, contacts and gradients of a body of many polygons over random planes.
#[test]
fn the_lowest_of_all_vertices_decides() {
    let mut random = Random::new(31);
    let ball = dented_ball(|| random.within(0.8, 1.2));
    let mut random = Random::new(32);
    let space = space(vec![free_body(&ball.body)]);
    let mut query = QueryContext::new();
    let (mut inside, mut outside) = (0, 0);
    for _ in 0..500 {
        let normal = random.unit() * random.within(0.1, 10.0);
        let offset = random.within(-2.0, 2.0) * normal.norm();
        let set = floor(&space, &[], normal, offset);
        let q = configuration(&mut random, 6);
        let pose = space.link_poses(&q).unwrap()[5];
        let unit = normal.normalize();
        let height = |p: &Vec3| unit.dot(&pose.transform_point(p)) - offset / normal.norm();
        let all = ball.parts.iter().flatten().map(height);
        let truth = all.fold(f64::INFINITY, f64::min);

        let at = Configuration::Coordinates(&q);
        let found = query.distance(&set, at, f64::INFINITY).unwrap();
        assert_eq!(found.kind, DistanceKind::Exact);
        assert!((found.distance - truth.max(0.0)).abs() < 1e-14 * 10.0);
        assert!(found.lower <= truth.max(0.0) && truth <= found.upper);
        let class = query.classify(&set, at).unwrap();
        let expected = match truth {
            t if t <= 0.0 => Class::Inside,
            t if t <= 0.1 => Class::Contact,
            _ => Class::Outside,
        };
        assert_eq!(class, expected, "{truth}");
        let poses = space.link_poses(&q).unwrap();
        let at_poses = Configuration::LinkPoses(&poses);
        assert_eq!(query.classify(&set, at_poses).unwrap(), class);

        let list = query.gradients(&set, &q, f64::INFINITY, 10).unwrap();
        assert_eq!((list.witnesses.len(), list.contacts.len()), (1, 1));
        let (witness, contact) = (&list.witnesses[0], &list.contacts[0]);
        assert_eq!(witness.s_side, SSide::PureSet(PurePlace::World));
        assert_eq!(witness.r_link, 5);
        assert!((contact.clearance - truth).abs() < 1e-13);
        assert!((contact.normal - unit).norm() < 1e-15);
        let own = &ball.parts[witness.primitives[0] as usize];
        let nearest = own
            .iter()
            .map(|v| (pose.transform_point(v) - contact.points[0]).norm());
        assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-13);
        let across = contact.points[1] - contact.points[0];
        assert!((unit.dot(&contact.points[1]) - offset / normal.norm()).abs() < 1e-13);
        assert!(across.cross(&unit).norm() < 1e-13);
        // By central differences of the truth, unless two vertices are as low.
        let mut heights: Vec<f64> = ball.parts.iter().flatten().map(height).collect();
        heights.sort_by(f64::total_cmp);
        heights.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
        if heights[1] - heights[0] < 1e-4 {
            continue;
        }
        for i in 0..6 {
            let moved = |by: f64| {
                let mut q = q.clone();
                q[i] += by;
                let pose = space.link_poses(&q).unwrap()[5];
                let height = |p: &Vec3| unit.dot(&pose.transform_point(p));
                let all = ball.parts.iter().flatten().map(height);
                all.fold(f64::INFINITY, f64::min)
            };
            let slope = (moved(1e-6) - moved(-1e-6)) / 2e-6;
            assert!((list.gradients[i] - slope).abs() < 1e-8);
        }
        *if truth < 0.0 {
            &mut inside
        } else {
            &mut outside
        } += 1;
    }
    assert!(inside > 50 && outside > 50, "{inside} {outside}");
}

fn round_body(add: impl FnOnce(&mut BodyBuilder)) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    add(&mut builder);
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

/// Round and smooth bodies, whose support functions are known.
#[test]
fn round_bodies_touch_in_closed_form() {
    let semi_axes = Vec3::new(0.3, 0.7, 1.1);
    let home = Pose::identity();
    let ellipsoid = round_body(|b| b.add_ellipsoid(&home, &semi_axes, 0).unwrap());
    let ends = [Vec3::new(1.0, 2.0, -1.0), Vec3::new(-0.5, 0.3, 0.2)];
    let capsule = round_body(|b| b.add_capsule(&ends[0], &ends[1], 0.25, 0).unwrap());
    let mut random = Random::new(5);
    let mut query = QueryContext::new();
    for _ in 0..300 {
        let normal = random.unit();
        let q = configuration(&mut random, 6);
        for (body, is_capsule) in [(&ellipsoid, false), (&capsule, true)] {
            let space = space(vec![free_body(body)]);
            let pose = space.link_poses(&q).unwrap()[5];
            let down = pose.rotation.tr_mul(&-normal);
            let reach = if is_capsule {
                down.dot(&ends[0]).max(down.dot(&ends[1])) + 0.25
            } else {
                semi_axes.component_mul(&down).norm()
            };
            let truth = normal.dot(&pose.translation) - reach + 9.0;
            let set = floor(&space, &[], normal, -9.0);
            let at = Configuration::Coordinates(&q);
            let found = query.distance(&set, at, f64::INFINITY).unwrap();
            assert!((found.distance - truth.max(0.0)).abs() < 1e-13, "{truth}");
        }
    }
}

/// Some links, the plane, and what is refused.
#[test]
fn links_are_chosen() {
    let box_body = cuboid([2.0, 2.0, 2.0]).body;
    let mut links = vec![
        link(None, JointKind::Fixed, Vec3::z()),
        link(Some(0), JointKind::Prismatic, Vec3::z()),
    ];
    links[0].body = Some(box_body.clone());
    links[1].body = Some(box_body);
    let lift = space(vec![robot(3, links)]);
    let mut query = QueryContext::new();
    let mut distance = |set: &CObject, q: f64| {
        let q = [q];
        let at = Configuration::Coordinates(&q);
        query.distance(set, at, f64::INFINITY).unwrap().distance
    };
    let corner = cuboid([2.0, 2.0, 2.0]).body.statistics().low[2];
    assert_eq!(distance(&floor(&lift, &[], Vec3::z(), corner), 5.0), 0.0);
    let of_lift = floor(&lift, &[1], Vec3::z(), corner);
    assert_eq!(distance(&of_lift, 5.0), 5.0);
    // What rests does not stop a slide, and the floor does.
    let all = floor(&lift, &[], 2.0 * Vec3::z(), 2.0 * (corner - 1e-7));
    let options = SlideOptions::with_shell(0.2);
    let mut q = vec![1.0];
    for _ in 0..40 {
        q = query
            .slide(&all, &q, &[-0.06], &options)
            .unwrap()
            .configuration;
    }
    assert!(q[0] > 0.0 && q[0] < 0.05, "{q:?}");

    for (links, normal, kind) in [
        (&[7usize][..], Vec3::z(), ErrorKind::NotFound),
        (&[], Vec3::zeros(), ErrorKind::Degenerate),
        (&[], Vec3::new(f64::NAN, 0.0, 1.0), ErrorKind::NotFinite),
    ] {
        let refused = PureShape::floor(&lift, links, &normal, 0.0);
        assert_eq!(refused.unwrap_err().kind, kind);
    }
    let flat = vec![Vec3::x(), Vec3::y(), -Vec3::x()];
    let plane = space(vec![free_planar_body(&planar(&[flat]).body)]);
    assert!(PureShape::floor(&plane, &[], &Vec3::z(), 0.0).is_err());
    assert_eq!(distance_in_plane(&plane, [0.5, 4.0, 0.0]), 4.0);
    assert!((distance_in_plane(&plane, [0.5, 4.0, 2.0]) - (4.0 - 2f64.sin())).abs() < 1e-15);
}

fn distance_in_plane(plane: &Arc<Space>, q: [f64; 3]) -> f64 {
    let wall = floor(plane, &[], Vec3::y(), 0.0);
    let at = Configuration::Coordinates(&q);
    let found = QueryContext::new().distance(&wall, at, f64::INFINITY);
    found.unwrap().distance
}

/// A floor measures in lengths: it goes with obstacles. Limits do not, without a scale; they name the coordinate.
#[test]
fn floors_go_with_obstacles() {
    let cube = cuboid([2.0, 2.0, 2.0]).body;
    let moving = free_body(&cube);
    let mut ranges = vec![None; 6];
    ranges[2] = Some(Coordinate::Interval {
        lower: -5.0,
        upper: 5.0,
    });
    let space = Arc::new(Space::new(vec![moving], &ranges, WorldBox::unbounded()).unwrap());
    let (world, _) = environment(&[(&cube, Pose::from_translation(Vec3::new(6.0, 0.0, 0.0)))]);
    let obstacles = Arc::new(against(&space, &world));
    let ground = Arc::new(floor(&space, &[], Vec3::z(), -4.0));
    let union = CObject::union(&[obstacles, ground.clone()]).unwrap();
    let mut query = QueryContext::new();
    let mut distance = |q: [f64; 6]| {
        let at = Configuration::Coordinates(&q);
        query.distance(&union, at, f64::INFINITY).unwrap().distance
    };
    let low = cube.statistics().low[0];
    let side = cube.statistics().high[0] - low;
    assert!((distance([0.0; 6]) - (4.0 + low)).abs() < 1e-14);
    assert!((distance([3.0, 0.0, 0.0, 0.0, 0.0, 0.0]) - (3.0 - side)).abs() < 1e-14);

    let shape = PureShape::BeyondLimits;
    let limits = CObject::pure(space, shape, PureOptions::default()).unwrap();
    let q = [0.0, 0.0, 4.5, 0.0, 0.0, 0.0];
    let at = Configuration::Coordinates(&q);
    let found = query.distance(&limits, at, f64::INFINITY).unwrap();
    let witness = found.witness.unwrap();
    assert_eq!(witness.s_side, SSide::PureSet(PurePlace::Coordinate(2)));
    // The complement of a floor: how deep the robot is in it is not known.
    let allowed = CObject::complement(&ground).unwrap();
    let deep = [0.0, 0.0, -9.0, 0.0, 0.0, 0.0];
    let at = Configuration::Coordinates(&deep);
    let found = query.distance(&allowed, at, f64::INFINITY).unwrap();
    assert_eq!((found.kind, found.lower), (DistanceKind::LowerBound, 0.0));
}
