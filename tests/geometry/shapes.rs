//! Round and ready-made primitives against closed forms: distances, points, contacts, penetration, refusals.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::error::{Error, ErrorKind, Result};
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::primitive::{FeatureKind, SupportFunction};
use cstk::query::{Distance, QueryContext, WitnessList};

use helpers::oracle::hull_distance;
use helpers::random::Random;

fn body(add: impl FnOnce(&mut BodyBuilder) -> Result<()>) -> Arc<Body> {
    built(3, add)
}

fn built(dimension: u32, add: impl FnOnce(&mut BodyBuilder) -> Result<()>) -> Arc<Body> {
    let mut builder = BodyBuilder::new(dimension).unwrap();
    add(&mut builder).unwrap();
    Arc::new(helpers::models::built(&builder, &Default::default()))
}

fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose::from_translation(Vec3::new(x, y, z))
}

fn asked(a: (&Body, &Pose), b: (&Body, &Pose)) -> Distance {
    QueryContext::new()
        .pair_distance(a, b, f64::INFINITY)
        .unwrap()
}

fn distance(a: &Body, b: &Body, pose_b: &Pose) -> Distance {
    asked((a, &Pose::identity()), (b, pose_b))
}

fn witnesses(a: &Body, b: &Body, pose_b: &Pose, epsilon: f64) -> WitnessList {
    QueryContext::new()
        .pair_witnesses((a, &Pose::identity()), (b, pose_b), epsilon, 1000)
        .unwrap()
}

fn sphere(radius: f64) -> Arc<Body> {
    body(|b| b.add_sphere(&Vec3::zeros(), radius, 7))
}

fn block(x: f64, y: f64, z: f64) -> Arc<Body> {
    body(|b| b.add_box(&Pose::identity(), &(Vec3::new(x, y, z) * 0.5), 0))
}

fn near(found: &Vec3, want: [f64; 3]) {
    assert!((found - Vec3::from(want)).amax() < 1e-12, "{found}");
}

/// FCL issue 275, FCL issue 127, python-fcl issue 54, FCL issue 319.
#[test]
fn cases_that_peers_got_wrong() {
    let found = distance(&sphere(20.0), &sphere(10.0), &at(0.0, 40.0, 0.0));
    assert!((found.distance - 10.0).abs() < 1e-12);
    near(&found.points[0], [0.0, 20.0, 0.0]);
    near(&found.points[1], [0.0, 30.0, 0.0]);
    assert_eq!(found.witness.unwrap().tags, [7, 7]);

    let found = distance(&sphere(1.0), &block(10.0, 2.0, 10.0), &at(0.0, 5.0, 3.0));
    assert!((found.distance - 3.0).abs() < 1e-12);
    near(&found.points[0], [0.0, 1.0, 0.0]);
    near(&found.points[1], [0.0, 4.0, 0.0]);

    let corners = [
        [1.0, 1.0, 1.0],
        [2.0, 1.0, 1.0],
        [1.0, 2.0, 1.0],
        [1.0, 1.0, 2.0],
    ]
    .map(Vec3::from);
    let tetrahedron =
        helpers::shapes::mesh(&corners, &[[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]]);
    let found = distance(&tetrahedron.body, &sphere(1e-4), &at(1.5, 1.25, 1.0));
    assert_eq!(found.distance, 0.0);
    near(&found.points[0], [1.5, 1.25, 1.0]);

    let quaternion = |w: f64, z: f64, x: f64, y: f64, height: f64| {
        let angle = 2.0 * z.atan2(w);
        Pose {
            rotation: rotation_about(&Vec3::z(), angle),
            translation: Vec3::new(x, y, height),
        }
    };
    let can = body(|b| b.add_cylinder(&Pose::identity(), 0.18, 0.09, 0));
    let plate = quaternion(1.0, 1.0, 0.8, -0.385, 0.735);
    let found = asked(
        (&block(0.05, 0.39, 1.47), &plate),
        (&can, &quaternion(0.991445, -0.130526, 0.4, -0.4, 0.93)),
    );
    assert!((found.distance - 0.025).abs() < 1e-12, "{}", found.distance);
    assert!((found.points[0].y + 0.4).abs() < 1e-6 && (found.points[1].y + 0.4).abs() < 1e-6);
}

/// python-fcl issue 38: a box comes along x towards a cone's rim. parry issue 79: a threshold at a cylinder's distance.
#[test]
fn cones_and_cylinders_at_known_distances() {
    let cone = body(|b| b.add_cone(&Pose::identity(), 1.0, 3.0, 0));
    for x in [-10.0, -2.0, -1.6] {
        let found = distance(&cone, &block(1.0, 2.0, 3.0), &at(x, 0.0, 0.0)).distance;
        assert!((found - (-x - 1.5)).abs() < 1e-12, "{x}: {found}");
    }
    assert_eq!(
        distance(&cone, &block(1.0, 2.0, 3.0), &at(-1.5, 0.0, 0.0)).distance,
        0.0
    );
    // Beside the slope: its normal is (h, r) / |(h, r)| in the half plane, and the slope passes through the apex.
    let n = Vec3::new(3.0, 0.0, 1.0).normalize();
    let foot = Vec3::new(0.5, 0.0, 0.0);
    let point = body(|b| b.add_sphere(&Vec3::zeros(), 0.0, 0));
    let found = distance(&cone, &point, &Pose::from_translation(foot + n * 0.7));
    assert!((found.distance - 0.7).abs() < 1e-12);
    assert!((found.points[0] - foot).norm() < 1e-7);

    let can = body(|b| {
        let upright = Pose {
            rotation: rotation_about(&Vec3::x(), std::f64::consts::FRAC_PI_2),
            translation: Vec3::zeros(),
        };
        b.add_cylinder(&upright, 1.0, 0.5, 0)
    });
    let triangle = [[1.0, -1.0, 0.0], [-1.0, -1.0, 0.0], [0.0, -1.0, 1.0]].map(Vec3::from);
    let triangle = body(|b| b.add_polygon(&triangle, 0));
    let found = distance(&can, &triangle, &Pose::identity());
    assert!((found.distance - 0.5).abs() < 1e-12);
    let mut query = QueryContext::new();
    for (threshold, want) in [(0.49, false), (0.5, true), (0.51, true)] {
        let here = Pose::identity();
        let within = query.pair_within((&can, &here), (&triangle, &here), threshold);
        assert_eq!(within.unwrap(), want, "{threshold}");
    }
}

/// Hulls with a radius are as far apart as the hulls are, less the radii; their points lie on the line between the cores.
#[test]
fn rounded_hulls_at_all_scales() {
    let mut random = Random::new(5);
    let mut met = 0;
    for round in 0..600 {
        let scale = [1e-6, 1.0, 1e6][round % 3];
        let counts = [1, 2, 3, 9];
        let cores = [0, 1].map(|_| {
            let n = counts[random.below(4)];
            random.points(n, scale)
        });
        let radii = [0, 1].map(|_| random.within(0.0, 0.5) * scale);
        let pose = Pose {
            rotation: random.rotation(),
            translation: random.point(1.3 * scale),
        };
        let [a, b] = [0, 1].map(|i| body(|b| b.add_rounded_polyhedron(&cores[i], radii[i], 0)));
        let moved: Vec<Vec3> = cores[1].iter().map(|p| pose.transform_point(p)).collect();
        let apart = hull_distance(&cores[0], &moved).upper;
        let want = (apart - radii[0] - radii[1]).max(0.0);
        let found = distance(&a, &b, &pose);
        let error = 1e-12 * 8.0 * scale;
        assert!(
            (found.distance - want).abs() <= error,
            "{round}: {found:?} {want}"
        );
        assert!(found.lower <= want && want <= found.upper);
        let swapped = asked((&b, &pose), (&a, &Pose::identity()));
        assert!((swapped.distance - want).abs() <= error);
        if want == 0.0 {
            met += 1;
        } else {
            let between = (found.points[0] - found.points[1]).norm();
            assert!((between - want).abs() <= error);
        }
        for (side, core) in [&cores[0], &moved].into_iter().enumerate() {
            let off = hull_distance(core, &[found.points[side]]).upper;
            assert!(off <= radii[side] + error, "{round}: {off} {}", radii[side]);
        }
    }
    assert!((100..500).contains(&met), "{met}");
}

#[test]
fn capsules_along_one_another_and_along_faces() {
    let rod = |y: f64, from: f64, to: f64| {
        body(|b| b.add_capsule(&Vec3::new(from, y, 0.0), &Vec3::new(to, y, 0.0), 0.25, 0))
    };
    let list = witnesses(
        &rod(0.0, 0.0, 2.0),
        &rod(1.0, 1.0, 4.0),
        &Pose::identity(),
        1.0,
    );
    let spans: Vec<f64> = list.contacts.iter().map(|c| c.points[0].x).collect();
    assert_eq!(list.contacts.len(), 2, "{spans:?}");
    for contact in &list.contacts {
        assert!((contact.distance - 0.5).abs() < 1e-12);
        assert!((contact.normal + Vec3::y()).amax() < 1e-12);
        assert!((contact.points[0].y - 0.25).abs() < 1e-12);
    }
    assert!((spans.iter().sum::<f64>() - 3.0).abs() < 1e-12);

    // Deeper than a touch, but the cores are apart.
    let slab = block(10.0, 10.0, 2.0);
    for (height, clearance) in [(1.35, 0.1), (1.25, 0.0), (1.15, -0.1)] {
        let list = witnesses(&rod(0.0, 0.0, 2.0), &slab, &at(0.0, 0.0, -height), 0.2);
        assert_eq!(list.contacts.len(), 2);
        assert!(!list.witnesses[0].overlapping);
        for contact in &list.contacts {
            assert!((contact.clearance - clearance).abs() < 1e-12);
            assert!((contact.normal - Vec3::z()).amax() < 1e-12);
            assert!((contact.points[0].z + 0.25).abs() < 1e-12);
            assert!((contact.points[1].z + height - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn penetration_of_what_is_round() {
    let mut query = QueryContext::new();
    let mut depth = |a: &Body, b: &Body, pose: &Pose| {
        let found = query.pair_penetration((a, &Pose::identity()), (b, pose), 10);
        found.map(|list| list.penetrations[0].penetration)
    };
    let found = depth(&sphere(1.0), &sphere(2.0), &at(0.0, 2.5, 0.0)).unwrap();
    assert!((found.depth - 0.5).abs() < 1e-12);
    assert!((found.direction + Vec3::y()).amax() < 1e-12);
    near(&found.points[0], [0.0, 1.0, 0.0]);
    near(&found.points[1], [0.0, 0.5, 0.0]);
    // The centre is 0.25 below the top: out by that and the radius.
    let found = depth(&sphere(1.0), &block(4.0, 4.0, 4.0), &at(0.0, 0.0, -1.75)).unwrap();
    assert!((found.depth - 1.25).abs() < 1e-12, "{found:?}");
    assert!((found.direction - Vec3::z()).amax() < 1e-12);
    near(&found.points[0], [0.0, 0.0, -1.0]);
    near(&found.points[1], [0.0, 0.0, 0.25]);
    let can = body(|b| b.add_cylinder(&Pose::identity(), 1.0, 1.0, 0));
    let error = depth(&can, &sphere(1.0), &Pose::identity()).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Unsupported);
    assert!(error.message.contains("primitives 0 and 0"), "{error}");
}

/// One contact, with the normal of the face, apart, touching and just inside.
#[test]
fn a_cylinder_on_a_face() {
    let slab = block(10.0, 10.0, 2.0);
    for lying in [false, true] {
        let (turn, reach) = if lying { (1.0, 0.5) } else { (0.0, 2.0) };
        let can = body(|b| {
            let pose = Pose {
                rotation: rotation_about(&Vec3::x(), turn * std::f64::consts::FRAC_PI_2),
                translation: Vec3::zeros(),
            };
            b.add_cylinder(&pose, 0.5, 2.0, 0)
        });
        for gap in [0.3, 1e-3, 1e-9, 0.0, -1e-9, -1e-7, -1e-6] {
            let list = witnesses(&can, &slab, &at(0.3, 0.2, -1.0 - reach - gap), 0.5);
            assert_eq!(list.contacts.len(), 1, "{lying} {gap}");
            let contact = &list.contacts[0];
            assert!(
                (contact.clearance - gap).abs() < 1e-10,
                "{lying} {gap}: {contact:?}"
            );
            assert!(
                (contact.normal - Vec3::z()).amax() < 1e-6,
                "{lying} {gap}: {contact:?}"
            );
            assert_eq!(contact.features[0].kind, FeatureKind::Surface);
            assert_eq!(contact.features[1].kind, FeatureKind::Face);
            assert!((contact.points[0].z + reach).abs() < 1e-9, "{contact:?}");
        }
        let list = witnesses(&can, &slab, &at(0.0, 0.0, -0.9 - reach), 0.5);
        assert!(list.contacts.is_empty() && list.witnesses[0].overlapping);
    }
}

#[test]
fn round_shapes_of_the_plane() {
    let mut random = Random::new(9);
    let disc = built(2, |b| b.add_sphere(&Vec3::zeros(), 0.5, 0));
    let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let square = square.map(|(x, y)| Vec3::new(x, y, 0.0));
    let rounded = built(2, |b| b.add_rounded_polygon(&square, 0.25, 0));
    let rod = built(2, |b| b.add_capsule(&-Vec3::x(), &Vec3::x(), 0.25, 0));
    for _ in 0..300 {
        let pose = random.planar_pose(4.0);
        let local = pose.rotation.transpose() * -pose.translation;
        let outside = |v: Vec3, half: Vec3| (v.abs() - half).sup(&Vec3::zeros()).norm();
        for (other, half) in [(&rounded, Vec3::new(1.0, 1.0, 0.0)), (&rod, Vec3::x())] {
            let want = (outside(local, half) - 0.75).max(0.0);
            let found = distance(&disc, other, &pose);
            assert!((found.distance - want).abs() < 1e-12, "{want} {found:?}");
            assert!(found.points.iter().all(|p| p.z == 0.0));
        }
    }
    let mut builder = BodyBuilder::new(2).unwrap();
    let here = Pose::identity();
    let raised = Vec3::new(0.0, 0.0, 1.0);
    let one = Vec3::repeat(1.0);
    for (refused, kind) in [
        (builder.add_sphere(&raised, 1.0, 0), ErrorKind::NotPlanar),
        (builder.add_points(&[raised], 0.0), ErrorKind::NotPlanar),
        (builder.add_box(&here, &one, 0), ErrorKind::Unsupported),
        (
            builder.add_cylinder(&here, 1.0, 1.0, 0),
            ErrorKind::Unsupported,
        ),
        (builder.add_cone(&here, 1.0, 1.0, 0), ErrorKind::Unsupported),
        (
            builder.add_ellipsoid(&here, &one, 0),
            ErrorKind::Unsupported,
        ),
        (
            builder.add_support(Arc::new(Ball), 0),
            ErrorKind::Unsupported,
        ),
    ] {
        assert_eq!(refused.unwrap_err().kind, kind);
    }
    assert!(builder.is_empty());
}

#[test]
fn degenerate_sizes_are_refused() {
    let mut builder = BodyBuilder::new(3).unwrap();
    let (here, zero) = (Pose::identity(), Vec3::zeros());
    for (bad, kind) in [
        (f64::NAN, ErrorKind::NotFinite),
        (f64::INFINITY, ErrorKind::NotFinite),
        (-1.0, ErrorKind::InvalidArgument),
        (1e60, ErrorKind::InvalidArgument),
        (1e-60, ErrorKind::Degenerate),
        (0.0, ErrorKind::Degenerate),
    ] {
        let sizes = Vec3::new(1.0, bad, 1.0);
        let mut refused = vec![
            (builder.add_box(&here, &sizes, 0), "half extent y"),
            (builder.add_cylinder(&here, bad, 1.0, 0), "radius"),
            (builder.add_cylinder(&here, 1.0, bad, 0), "half length"),
            (builder.add_cone(&here, bad, 1.0, 0), "radius"),
            (builder.add_cone(&here, 1.0, bad, 0), "height"),
            (builder.add_ellipsoid(&here, &sizes, 0), "semi-axis y"),
        ];
        if bad != 0.0 {
            refused.push((builder.add_sphere(&zero, bad, 0), "radius"));
            refused.push((builder.add_capsule(&zero, &Vec3::x(), bad, 0), "radius"));
            refused.push((builder.add_points(&[zero], bad), "point 0: the radius"));
        }
        for (refused, culprit) in refused {
            let error = refused.unwrap_err();
            assert_eq!(error.kind, kind, "{error}");
            assert!(
                error.message.contains(culprit),
                "{error} names no {culprit}"
            );
        }
    }
    assert!(builder.is_empty());
}

/// A ball of radius 2 about (1, 0, 0).
struct Ball;

impl SupportFunction for Ball {
    fn support(&self, direction: &Vec3) -> Result<Vec3> {
        Ok(Vec3::x() + direction * 2.0)
    }
}

/// Answers well when it is tried, and then no more.
struct Fading(std::sync::atomic::AtomicU32);

impl SupportFunction for Fading {
    fn support(&self, direction: &Vec3) -> Result<Vec3> {
        use std::sync::atomic::Ordering;
        if self.0.fetch_add(1, Ordering::Relaxed) < 306 {
            Ball.support(direction)
        } else {
            Err(Error::new(ErrorKind::Callback, "faded"))
        }
    }
}

struct By(fn(&Vec3) -> Result<Vec3>);

impl SupportFunction for By {
    fn support(&self, direction: &Vec3) -> Result<Vec3> {
        self.0(direction)
    }
}

#[test]
fn support_functions_of_the_caller() {
    let ball = body(|b| b.add_support(Arc::new(Ball), 3));
    let mut random = Random::new(31);
    for _ in 0..200 {
        let pose = random.pose(6.0);
        let want = ((pose.translation - Vec3::x()).norm() - 3.0).max(0.0);
        let found = distance(&ball, &sphere(1.0), &pose);
        assert!((found.distance - want).abs() < 1e-11, "{want} {found:?}");
        assert!(found.lower <= want && want <= found.upper);
    }
    assert_eq!(ball.statistics().low, [-1.0, -2.0, -2.0]);
    assert!(ball.save(std::path::Path::new("/tmp/never")).is_err());

    // Failing later it counts as its box.
    let fading = body(|b| b.add_support(Arc::new(Fading(Default::default())), 0));
    let found = distance(&fading, &sphere(1.0), &at(5.0, 5.0, 0.0)).distance;
    let want = Vec3::new(5.0 - 3.0, 5.0 - 2.0, 0.0).norm() - 1.0;
    assert!((found - want).abs() < 1e-11, "{found} {want}");

    let mut builder = BodyBuilder::new(3).unwrap();
    let mut refused = |function: fn(&Vec3) -> Result<Vec3>| {
        builder.add_support(Arc::new(By(function)), 0).unwrap_err()
    };
    let error = refused(|_| Err(Error::new(ErrorKind::Callback, "not today")));
    assert_eq!(error.kind, ErrorKind::Callback);
    assert!(error.message.contains("not today") && error.message.contains("direction (1, 0, 0)"));
    assert_eq!(refused(|d| Ok(d / 0.0)).kind, ErrorKind::NotFinite);
    assert_eq!(refused(|d| Ok(-d)).kind, ErrorKind::NotConvex);
    assert_eq!(refused(|d| Ok(d * d.x.abs())).kind, ErrorKind::NotConvex);
    assert_eq!(refused(|d| Ok(d * 1e70)).kind, ErrorKind::InvalidArgument);
    assert!(builder.is_empty());
}

/// A box over the end of a cylinder by next to nothing: the contact's point is on the feature of the box that it names.
#[test]
fn boxes_that_touch_a_cylinder_name_the_feature_there() {
    let cylinder = body(|builder| builder.add_cylinder(&Pose::identity(), 1.0, 0.5, 0));
    let half = Vec3::new(0.375, 0.125, 0.0625);
    let block = body(|builder| builder.add_box(&Pose::identity(), &half, 0));
    let mut random = Random::new(8);
    let mut asked = 0;
    for round in 0..400 {
        let gap = 10f64.powi(-12 + round % 7);
        let (x, y) = (random.within(-1.2, 1.2), random.within(-1.2, 1.2));
        let pose = Pose {
            rotation: rotation_about(&Vec3::z(), random.within(0.0, 6.0)),
            translation: Vec3::new(x, y, 0.5 + half.z + gap),
        };
        let found = distance(&cylinder, &block, &pose);
        let Some(contact) = found.contact.filter(|_| found.distance < 1e-5) else {
            continue;
        };
        let seen = pose.inverse().transform_point(&contact.points[1]);
        let bounds = (0..3)
            .filter(|&k| (seen[k].abs() - half[k]).abs() < 1e-6)
            .count();
        let expected = match contact.features[1].kind {
            FeatureKind::Face => 1,
            FeatureKind::Edge => 2,
            _ => 3,
        };
        assert_eq!(bounds, expected, "{seen:?} {contact:?}");
        asked += 1;
    }
    assert!(asked > 200, "{asked}");
}

/// A capsule over the end of a cylinder, level or nearly so: its end is named only where the contact is at that end.
#[test]
fn capsules_over_a_cylinder_name_the_feature_there() {
    let cylinder = body(|builder| builder.add_cylinder(&Pose::identity(), 1.0, 0.5, 0));
    let end = Vec3::new(0.375, 0.0, 0.0);
    let capsule = body(|builder| builder.add_capsule(&-end, &end, 0.125, 0));
    let mut random = Random::new(9);
    let mut ends = 0;
    for round in 0..2000 {
        let tilt = [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3][round % 6] * random.within(-1.0, 1.0);
        let (x, y) = (random.within(-1.4, 1.4), random.within(-1.4, 1.4));
        let pose = Pose {
            rotation: rotation_about(&Vec3::z(), random.within(0.0, 6.0))
                * rotation_about(&Vec3::y(), tilt),
            translation: Vec3::new(x, y, random.within(0.7, 1.5)),
        };
        let found = distance(&cylinder, &capsule, &pose);
        let Some(contact) = found.contact else {
            continue;
        };
        let seen = pose.inverse().transform_point(&contact.points[1]);
        if contact.features[1].kind == FeatureKind::Vertex {
            let named = if contact.features[1].index == 0 {
                -end
            } else {
                end
            };
            assert!((seen - named).norm() < 0.125 + 1e-6, "{seen:?} {contact:?}");
            ends += 1;
        }
    }
    assert!(ends > 200, "{ends}");
}
