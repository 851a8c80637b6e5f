//! Bodies that state how far they are from what they stand for: spheres and the meshes in and around them, in closed form.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::cobject::{CObject, Class, PureOptions, PureShape};
use cstk::error::ErrorKind;
use cstk::hierarchy::HierarchyOptions;
use cstk::motion::{MotionOptions, MotionOutcome, RegionOptions, RegionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, DepthOptions, DistanceKind, ObjectSets, QueryContext};

use helpers::files::loaded;
use helpers::random::Random;
use helpers::robots::{against, environment, free_body, space};
use helpers::surfaces::{faces, sphere};

/// What a mesh stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A sphere.
    Surface,
    /// A ball, by the boundary of a solid.
    Solid,
    /// A ball, by one convex polyhedron.
    Hull,
}

/// A ball or its surface around the origin, with the body that stands for it.
#[derive(Debug)]
pub struct Ball {
    pub kind: Kind,
    pub radius: f64,
    pub deviation: f64,
    pub body: Arc<Body>,
}

/// The distance of the planes of the mesh's faces from the origin, at least.
fn inner_radius(mesh: &Mesh) -> f64 {
    let heights = faces(mesh).into_iter().map(|face| {
        let [a, b, c] = [0, 1, 2].map(|i| mesh.vertices[face[i] as usize]);
        (b - a).cross(&(c - a)).normalize().dot(&a).abs()
    });
    heights.fold(f64::INFINITY, f64::min)
}

fn built(builder: &BodyBuilder) -> Arc<Body> {
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

impl Ball {
    /// A mesh whose vertices lie on the sphere times `size`: 1 for an inscribed one; more, up to one that is circumscribed.
    pub fn new(kind: Kind, radius: f64, bands: usize, growth: f64) -> Self {
        let inscribed = sphere(radius, bands);
        let inner = inner_radius(&inscribed);
        // From 1 to what brings the nearest face to the sphere.
        let size = 1.0 + growth * (radius / inner - 1.0);
        let mesh = sphere(radius * size, bands);
        let deviation = (radius - inner * size).max(radius * size - radius) + 1e-12;
        let mut builder = BodyBuilder::new(3).unwrap();
        match kind {
            Kind::Hull => builder.add_polyhedron(&mesh.vertices, 0).unwrap(),
            Kind::Surface | Kind::Solid => builder.add_mesh(&mesh).unwrap(),
        }
        builder.set_solid(kind == Kind::Solid);
        builder.set_deviation(deviation).unwrap();
        Self {
            kind,
            radius,
            deviation,
            body: built(&builder),
        }
    }

    fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for kind in [Kind::Surface, Kind::Solid, Kind::Hull] {
            for (bands, growth) in [(3, 0.0), (5, 1.0), (8, 0.5), (12, 0.0), (20, 1.0)] {
                let bands = if kind == Kind::Hull {
                    bands.min(8)
                } else {
                    bands
                };
                all.push(Self::new(kind, 0.3 + 0.1 * bands as f64, bands, growth));
            }
        }
        all
    }

    /// An exact ball.
    pub fn exact(radius: f64) -> Self {
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_sphere(&Vec3::zeros(), radius, 0).unwrap();
        Self {
            kind: Kind::Hull,
            radius,
            deviation: 0.0,
            body: built(&builder),
        }
    }
}

/// The distance of what two bodies stand for, whose centres are `apart`.
pub fn truth(a: &Ball, b: &Ball, apart: f64) -> f64 {
    let holds = |outer: &Ball, inner: &Ball| match outer.kind {
        Kind::Surface => outer.radius - apart - inner.radius,
        Kind::Solid | Kind::Hull => 0.0,
    };
    (apart - a.radius - b.radius)
        .max(holds(a, b))
        .max(holds(b, a))
        .max(0.0)
}

/// Two bodies at random poses, most of them near contact from one side or the other.
fn poses(random: &mut Random, a: &Ball, b: &Ball) -> [Pose; 2] {
    let at = random.pose(1.0);
    let near = match random.below(4) {
        0 => random.within(0.0, 3.0) * (a.radius + b.radius),
        1 => (a.radius - b.radius).abs() + random.within(-3.0, 3.0) * (a.deviation + b.deviation),
        _ => a.radius + b.radius + random.within(-3.0, 3.0) * (a.deviation + b.deviation),
    };
    let beside = Pose {
        rotation: random.rotation(),
        translation: at.translation + random.unit() * near,
    };
    [at, beside]
}

#[test]
fn bounds_hold_for_the_spheres_that_meshes_stand_for() {
    let mut random = Random::new(2101);
    let balls = Ball::all();
    let count = 100_000;
    let mut query = QueryContext::new();
    let (mut met, mut apart, mut in_doubt) = (0, 0, 0);
    for _ in 0..count {
        let [a, b] = [0, 1].map(|_| &balls[random.below(balls.len())]);
        let [pose_a, pose_b] = poses(&mut random, a, b);
        let [on_a, on_b] = [(&*a.body, &pose_a), (&*b.body, &pose_b)];
        let distance = (pose_a.translation - pose_b.translation).norm();
        let truth = truth(a, b, distance);
        let stated = a.deviation + b.deviation;
        let found = query.pair_distance(on_a, on_b, f64::INFINITY).unwrap();
        assert_eq!(found.kind, DistanceKind::Exact);
        assert!(found.lower <= truth + 1e-14 && truth <= found.upper + 1e-14);
        assert!(found.upper - found.lower <= 2.0 * stated + 1e-9);
        assert_eq!(found.lower == 0.0, found.distance == 0.0);
        assert!(found.lower <= found.distance && found.distance <= found.upper);
        if found.lower > 0.0 {
            // The points are those of the meshes.
            let between = (found.points[0] - found.points[1]).norm();
            assert!((between - found.distance - stated).abs() < 1e-10);
        }
        for threshold in [0.0, truth, random.within(0.0, 2.0) * truth, found.lower] {
            let within = query.pair_within(on_a, on_b, threshold).unwrap();
            assert_eq!(within, found.lower <= threshold);
            assert!(within || truth > threshold - 1e-14);
        }
        let turned = query.pair_distance(on_b, on_a, f64::INFINITY).unwrap();
        assert!((turned.distance - found.distance).abs() < 1e-11);
        *match (truth == 0.0, found.lower > 0.0) {
            (true, _) => &mut met,
            (false, true) => &mut apart,
            (false, false) => &mut in_doubt,
        } += 1;
    }
    println!("{count} pairs: {met} meet, {apart} apart, {in_doubt} in doubt");
    assert!(met > count / 10 && apart > count / 10 && in_doubt > count / 100);
}

/// Pairs with exact bodies, within environments, and by way of a maximal distance.
#[test]
fn environments_see_what_bodies_state() {
    let mut random = Random::new(2102);
    let mut query = QueryContext::new();
    let mut balls = Ball::all();
    balls.push(Ball::exact(0.4));
    balls.push(Ball::exact(1.0));
    for round in 0..40 {
        let placed: Vec<(&Ball, Pose)> = (0..30)
            .map(|_| (&balls[random.below(balls.len())], random.pose(6.0)))
            .collect();
        let objects: Vec<_> = placed.iter().map(|(ball, at)| (&ball.body, *at)).collect();
        let (world, ids) = environment(&objects);
        let limit = [0.0, 0.2, 1.0][round % 3];
        let sets = &mut ObjectSets::new(&world, None, None).unwrap();
        let found = query.environment_pairs(sets, limit, 1000, true).unwrap();
        let mut expected = 0;
        let mut least = f64::INFINITY;
        for i in 0..placed.len() {
            for j in i + 1..placed.len() {
                let [(a, at_a), (b, at_b)] = [&placed[i], &placed[j]];
                let [on_a, on_b] = [(&*a.body, at_a), (&*b.body, at_b)];
                let within = query.pair_within(on_a, on_b, limit).unwrap();
                expected += usize::from(within);
                let listed = found.pairs.iter().any(|pair| pair.ids == [ids[i], ids[j]]);
                assert_eq!(listed, within);
                let distance = query.pair_distance(on_a, on_b, f64::INFINITY).unwrap();
                least = least.min(distance.distance);
                let apart = (at_a.translation - at_b.translation).norm();
                assert!(within || truth(a, b, apart) > limit);
                let beyond = query.pair_distance(on_a, on_b, 0.1).unwrap();
                assert_eq!(
                    beyond.kind == DistanceKind::BeyondMax,
                    distance.distance > 0.1
                );
            }
        }
        assert_eq!(found.pairs.len(), expected);
        let sets = &mut ObjectSets::new(&world, None, None).unwrap();
        let nearest = query.environment_distance(sets, f64::INFINITY).unwrap();
        assert_eq!(nearest.distance, least);
    }
}

/// Balls over floors, and in the complement of one.
#[test]
fn floors_see_what_bodies_state() {
    let mut random = Random::new(2105);
    let mut query = QueryContext::new();
    for case in 0..200 {
        let ball = Ball::new(Kind::Surface, 1.0, 3 + case % 8, 0.5);
        let space = space(vec![free_body(&ball.body)]);
        let normal = random.unit();
        let shape = PureShape::floor(&space, &[], &normal, 0.0).unwrap();
        let options = PureOptions {
            contact_epsilon: 0.05,
            scale: None,
        };
        let floor = Arc::new(CObject::pure(space.clone(), shape, options).unwrap());
        let complement = CObject::complement(&floor).unwrap();
        let height = 1.0 + random.within(-3.0, 3.0) * ball.deviation;
        let at = normal * height;
        let turns = [0; 3].map(|_| random.within(-3.0, 3.0));
        let q = [at.x, at.y, at.z, turns[0], turns[1], turns[2]];
        let here = Configuration::Coordinates(&q);
        let truth = (height - 1.0).max(0.0);
        let found = query.distance(&floor, here, f64::INFINITY).unwrap();
        assert!(found.lower <= truth + 1e-14 && truth <= found.upper + 1e-14);
        assert!(found.upper - found.lower <= 2.0 * ball.deviation + 1e-9);
        let contact = found.contact.unwrap();
        assert!(contact.points[1].dot(&normal).abs() < 1e-12);
        let class = query.classify(&floor, here).unwrap();
        assert!(class == Class::Inside || truth > 0.0);
        assert!(class != Class::Outside || truth > 0.05);
        let opposite = query.classify(&complement, here).unwrap();
        assert!(opposite != Class::Outside || height < 1.0);
        let explained = query.explain(&complement, here, 9).unwrap();
        assert_eq!(explained.class, opposite);
        let mut q1 = q;
        let slide = normal.cross(&Vec3::new(0.3, 0.5, 0.7));
        (0..3).for_each(|k| q1[k] += slide[k]);
        let options = MotionOptions::default();
        let (answer, certificate) = query.motion_certificate(&floor, &q, &q1, &options).unwrap();
        if answer.outcome == MotionOutcome::Free {
            assert!(height > 1.0);
            certificate.unwrap().verify(&floor, &q, &q1, 0.0).unwrap();
        }
        let back = query.motion(&complement, &q, &q1, &options).unwrap();
        assert!(back.outcome != MotionOutcome::Free || height < 1.0);
    }
}

/// Signed distances of balls that meet or not: the bounds hold, and are finite for single primitives.
#[test]
fn signed_distances_are_between_their_bounds() {
    let mut random = Random::new(2106);
    let mut query = QueryContext::new();
    let options = DepthOptions::default();
    let mut meeting = 0;
    for _ in 0..60 {
        let kinds = [[Kind::Hull, Kind::Solid][random.below(2)], Kind::Hull];
        let [a, b] = kinds.map(|kind| Ball::new(kind, 0.5, 4 + random.below(4), 0.5));
        let rest = random.pose(0.1);
        let (world, _) = environment(&[(&b.body, rest)]);
        let space = space(vec![free_body(&a.body)]);
        let cobject = against(&space, &world);
        let apart = random.within(0.4, 1.4);
        let at = rest.translation + random.unit() * apart;
        let q = [at.x, at.y, at.z, 0.1, 0.2, 0.3];
        let list = query
            .signed_distances(&cobject, &q, 1.0, 9, &options)
            .unwrap();
        let [pair] = &list.pairs[..] else {
            panic!("one pair");
        };
        let truth = apart - 1.0;
        assert!(pair.lower <= truth && truth <= pair.upper);
        assert!(pair.lower <= pair.distance && pair.distance <= pair.upper);
        let are_convex = kinds[0] == Kind::Hull;
        assert!(pair.lower.is_finite() || (!are_convex && pair.distance < 0.0));
        let [on_a, on_b] = [(&*a.body, &Pose::from_translation(at)), (&*b.body, &rest)];
        match query.pair_depth(on_a, on_b, &options) {
            Ok(depth) => assert!(!depth.meet && truth > 0.0),
            Err(error) => {
                assert_eq!(error.kind, ErrorKind::Unsupported);
                assert!(error.message.contains("body_a"), "{error}");
                meeting += 1;
            }
        }
    }
    assert!(meeting > 10);
}

#[test]
fn what_is_stated_stays_in_files_parts_and_refitted_bodies() {
    let ball = Ball::new(Kind::Solid, 1.0, 6, 0.0);
    let read = loaded(&ball.body);
    assert_eq!(read.stated_deviation(), ball.deviation);
    let vertices: Vec<Vec3> = ball.body.vertices().map(|vertex| vertex * 1.5).collect();
    let refitted = ball.body.refit(&vertices).unwrap();
    assert_eq!(refitted.stated_deviation(), ball.deviation);
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_body(&ball.body, &Pose::identity(), 0).unwrap();
    builder.add_sphere(&(Vec3::x() * 5.0), 1.0, 0).unwrap();
    assert_eq!(built(&builder).stated_deviation(), ball.deviation);
    builder.set_deviation(2.0 * ball.deviation).unwrap();
    assert_eq!(built(&builder).stated_deviation(), 2.0 * ball.deviation);
    builder.set_deviation(0.5 * ball.deviation).unwrap();
    assert_eq!(built(&builder).stated_deviation(), ball.deviation);
    // What a body is includes what it states.
    let exact = {
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_mesh(&sphere(1.0, 6)).unwrap();
        builder.set_solid(true);
        built(&builder)
    };
    assert_ne!(exact.digest().unwrap(), ball.body.digest().unwrap());
    for refused in [-1.0, f64::NAN, f64::INFINITY, 1e51] {
        assert!(BodyBuilder::new(3).unwrap().set_deviation(refused).is_err());
    }
}

/// The largest deviation there can be: nothing is proved apart, and nothing fails.
#[test]
fn what_may_be_anywhere_is_near_everything() {
    let mut random = Random::new(2107);
    let mut query = QueryContext::new();
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_mesh(&sphere(0.5, 4)).unwrap();
    builder.set_deviation(1e50).unwrap();
    let anywhere = built(&builder);
    let other = Ball::exact(0.1).body;
    let mut objects: Vec<_> = (0..40).map(|_| (&other, random.pose(50.0))).collect();
    objects.push((&anywhere, random.pose(50.0)));
    let (world, _) = environment(&objects);
    let sets = &mut ObjectSets::new(&world, None, None).unwrap();
    let found = query.environment_pairs(sets, 0.0, 1000, false).unwrap();
    assert!(found.pairs.len() >= 40);
    for body in [&anywhere, &other] {
        let space = space(vec![free_body(body)]);
        let cobject = against(&space, &world);
        let (q0, q1) = ([100.0; 6], [101.0; 6]);
        let class = query.classify(&cobject, Configuration::Coordinates(&q0));
        assert_eq!(class.unwrap(), Class::Inside);
        let motion = query.motion(&cobject, &q0, &q1, &MotionOptions::default());
        let motion = motion.unwrap();
        assert_eq!((motion.outcome, motion.times[0]), (MotionOutcome::Hit, 0.0));
        let region = query.classify_region(&cobject, &q0, &q1, &RegionOptions { max_boxes: 50 });
        assert_eq!(region.unwrap().outcome, RegionOutcome::Undecided);
        let distance = query.distance(&cobject, Configuration::Coordinates(&q0), f64::INFINITY);
        let distance = distance.unwrap();
        assert!(distance.distance == 0.0 && distance.lower == 0.0 && distance.upper > 100.0);
    }
}
