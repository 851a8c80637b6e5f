//! Penetration depths: closed forms for boxes, the definition itself for random solids, and the cases of other libraries'
//! users.

#![allow(clippy::excessive_precision)] // numbers stand as they were published

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Mat3, Pose, Vec3};
use cstk::query::{PenetrationList, QueryContext};

use helpers::random::Random;
use helpers::shapes::{Shape, cube_surface, cuboid, hull, planar, widest_gap};

fn penetration(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> PenetrationList {
    QueryContext::new()
        .pair_penetration((&a.0.body, a.1), (&b.0.body, b.1), usize::MAX)
        .unwrap()
}

fn distance(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> f64 {
    QueryContext::new()
        .pair_distance((&a.0.body, a.1), (&b.0.body, b.1), f64::INFINITY)
        .unwrap()
        .distance
}

fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose::from_translation(Vec3::new(x, y, z))
}

fn turned(r: [f64; 9], t: [f64; 3]) -> Pose {
    Pose::from_row_major(&[
        r[0], r[1], r[2], t[0], r[3], r[4], r[5], t[1], r[6], r[7], r[8], t[2],
    ])
    .unwrap()
}

/// The depth of two single primitives, whose list is checked: the translation takes them apart and no further, the points
/// belong to them and meet.
fn depth(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> (f64, Vec3) {
    let list = penetration(a, b);
    assert!(list.of_whole_bodies && !list.truncated);
    assert_eq!(list.penetrations.len(), 1, "they do not meet");
    let found = list.penetrations[0].penetration;
    let corners = [a, b].map(|(shape, pose)| shape.placed(pose, &Vec3::zeros()).concat());
    let size = corners
        .iter()
        .flatten()
        .map(|v| (v - corners[0][0]).norm())
        .fold(0.0, f64::max);
    let slack = 1e-12 * size + 8.0 * f64::EPSILON * corners[0][0].amax();
    assert!((found.direction.norm() - 1.0).abs() < 1e-14);
    let gap = (found.points[1] - found.points[0] - found.direction * found.depth).norm();
    assert!(gap <= slack, "the points are {gap:e} off");
    let away = |depth: f64| Pose {
        translation: a.1.translation + found.direction * depth,
        ..*a.1
    };
    assert!(distance((a.0, &away(found.depth)), b) <= slack);
    let beyond = found.depth + 1e-6 * size;
    let clear = distance((a.0, &away(beyond)), b);
    assert!((clear - 1e-6 * size).abs() <= slack, "clear by {clear:e}");
    (found.depth, found.direction)
}

#[test]
fn random_boxes_are_as_deep_as_their_axes_say() {
    let mut random = Random::new(5);
    let (mut met, mut apart) = (0, 0);
    for _ in 0..20_000 {
        let mut sides = || [0, 1, 2].map(|_| random.within(0.2, 2.0));
        let sides = [sides(), sides()];
        let poses = [random.pose(0.7), random.pose(0.7)];
        let want = -widest_gap(sides, [&poses[0], &poses[1]]);
        let boxes = sides.map(cuboid);
        let list = penetration((&boxes[0], &poses[0]), (&boxes[1], &poses[1]));
        // No penetrating pair is missed (A11), and none is made up.
        assert_eq!(list.penetrations.is_empty(), want < 0.0, "{want}");
        if want < 0.0 {
            apart += 1;
        } else {
            met += 1;
            let found = list.penetrations[0].penetration.depth;
            assert!((found - want).abs() <= 1e-14, "{found} for {want}");
        }
    }
    assert!(met > 5000 && apart > 500, "{met} {apart}");
}

/// How far r must go along n.
fn needed(corners: &[Vec<Vec3>; 2], n: &Vec3) -> f64 {
    let low = corners[0]
        .iter()
        .map(|v| n.dot(v))
        .fold(f64::INFINITY, f64::min);
    let high = corners[1]
        .iter()
        .map(|v| n.dot(v))
        .fold(f64::NEG_INFINITY, f64::max);
    high - low
}

#[test]
fn random_solids_have_no_shorter_way_out() {
    let mut random = Random::new(7);
    let mut close = 0;
    for _ in 0..300 {
        let mut solid = || {
            let count = 4 + random.below(20);
            let stretch = Vec3::new(1.0, random.within(0.05, 1.0), random.within(0.05, 1.0));
            let points = random.points(count, 1.0);
            hull(
                &points
                    .iter()
                    .map(|p| p.component_mul(&stretch))
                    .collect::<Vec<_>>(),
            )
        };
        let (a, b) = (solid(), solid());
        let poses = [random.pose(0.3), random.pose(0.3)];
        let pair = [(&a, &poses[0]), (&b, &poses[1])];
        if penetration(pair[0], pair[1]).penetrations.is_empty() {
            continue;
        }
        let (found, direction) = depth(pair[0], pair[1]);
        let corners = pair.map(|(shape, pose)| shape.placed(pose, &Vec3::zeros()).concat());
        assert!((needed(&corners, &direction) - found).abs() <= 1e-14);
        // A search that knows nothing of features comes down to it, never below.
        let mut best = (f64::INFINITY, Vec3::x());
        for _ in 0..2000 {
            let n = random.unit();
            let length = needed(&corners, &n);
            assert!(length >= found - 1e-14);
            if length < best.0 {
                best = (length, n);
            }
        }
        let mut step = 0.1;
        for _ in 0..2000 {
            let n = (best.1 + random.unit() * step).normalize();
            let length = needed(&corners, &n);
            assert!(length >= found - 1e-14);
            if length < best.0 {
                best = (length, n);
            } else {
                step = (step * 0.99).max(1e-9);
            }
        }
        close += usize::from(best.0 - found <= 1e-3);
    }
    assert!(close > 150, "{close}");
}

/// Case A8 of docs/cases.md.
#[test]
fn boxes_that_made_another_library_abort() {
    let (a, b) = (cuboid([0.05, 0.55, 0.3]), cuboid([0.25, 0.2, 0.15]));
    let pose_a = turned(
        [
            0.00079632671073326442932,
            -0.99999968293183538748,
            0.,
            0.99999968293183538748,
            0.00079632671073326442932,
            0.,
            0.,
            0.,
            1.,
        ],
        [0.75000000000000055511, -2.4083553715553102684e-15, 0.15],
    );
    let e = 6.1232339957367660359e-17;
    let pose_b = turned([e, 0., 1., -1., e, e, -e, -1., 3.75e-33], [0.75, 0., 0.15]);
    let (found, _) = depth((&a, &pose_a), (&b, &pose_b));
    assert!((found - 0.150059684869782).abs() <= 1e-14, "{found}");
}

/// Case A10 of docs/cases.md.
#[test]
fn cubes_come_apart_upwards() {
    let cube = cuboid([2.0; 3]);
    let (found, direction) = depth((&cube, &Pose::identity()), (&cube, &at(0., 0., 1.9)));
    assert!((found - 0.1).abs() <= 1e-15);
    assert_eq!(direction, -Vec3::z());
}

/// Case A12 of docs/cases.md.
#[test]
fn large_coordinates_in_both_dimensions() {
    let outline = |x: [f64; 4], y: [f64; 4]| -> Vec<Vec3> {
        (0..4).map(|i| Vec3::new(x[i], y[i], 0.0)).collect()
    };
    let a = outline(
        [90945.08, 91077.46, 91454.92, 91322.54],
        [54122.54, 53745.082, 53877.46, 54254.918],
    );
    let b = outline(
        [90919.64, 91162.62, 91480.36, 91237.38],
        [54037.383, 53719.637, 53962.617, 54280.363],
    );
    let here = Pose::identity();
    let (found, _) = depth(
        (&planar(std::slice::from_ref(&a)), &here),
        (&planar(std::slice::from_ref(&b)), &here),
    );
    assert!((found - 452.18875).abs() <= 5e-6, "{found}");
    // 300 high, they come apart upwards.
    let raised = |flat: &[Vec3]| -> Vec<Vec3> {
        let up = flat.iter().map(|p| p + Vec3::z() * 300.0);
        up.chain(flat.iter().copied()).collect()
    };
    let solids = [hull(&raised(&a)), hull(&raised(&b))];
    let (found, direction) = depth((&solids[0], &here), (&solids[1], &here));
    assert!((found - 300.0).abs() <= 1e-9);
    assert!(direction.z.abs() > 1.0 - 1e-12);
}

/// Case A23 of docs/cases.md.
#[test]
fn a_small_cube_in_the_corner_of_a_large_one() {
    let large = cuboid([1.0; 3]);
    for side in [0.1, 0.3] {
        let small = cuboid([side; 3]);
        let (found, direction) = depth((&small, &at(0.4, 0.4, 0.4)), (&large, &Pose::identity()));
        assert!((found - (0.1 + side / 2.0)).abs() <= 1e-15, "{found}");
        assert_eq!(direction.amax(), 1.0);
    }
}

/// Case A24 of docs/cases.md.
#[test]
fn surfaces_that_share_a_face_are_not_deep() {
    let cube = cube_surface(2.0);
    let list = penetration((&cube, &at(-1., 0., 0.)), (&cube, &at(1., 0., 0.)));
    assert!(!list.of_whole_bodies);
    assert!(list.penetrations.len() >= 4);
    for found in &list.penetrations {
        assert!(found.penetration.depth <= 1e-15, "{found:?}");
    }
}

/// Case A26 of docs/cases.md.
#[test]
fn touching_cubes_point_along_x() {
    let cube = cuboid([1.0; 3]);
    let (found, direction) = depth((&cube, &at(0.5, 0.5, 0.5)), (&cube, &at(1.5, 0.5, 0.5)));
    assert!(found <= 1e-15);
    assert_eq!(direction, -Vec3::x());
    let list = penetration((&cube, &at(0.5, 0.5, 0.5)), (&cube, &at(1.5, 0.5, 0.5)));
    let points = list.penetrations[0].penetration.points;
    assert!((points[0].x - 1.0).abs() <= 1e-15 && points[0] == points[1]);
}

#[test]
fn unions_answer_pair_by_pair_and_say_so() {
    let body = |places: &[f64]| -> Body {
        let mut builder = BodyBuilder::new(3).unwrap();
        for (i, x) in places.iter().enumerate() {
            let corners: Vec<Vec3> = (0..8)
                .map(|k| {
                    Vec3::new(
                        x + f64::from(k & 1),
                        f64::from(k >> 1 & 1),
                        f64::from(k >> 2),
                    )
                })
                .collect();
            builder.add_polyhedron(&corners, 10 + i as u64).unwrap();
        }
        builder
            .build(&HierarchyOptions::default(), &mut |_| Ok(()))
            .unwrap()
    };
    let (a, b) = (body(&[0.0, 2.0, 8.0]), body(&[0.75, 2.5, 20.0]));
    let here = Pose::identity();
    let ask = |most: usize| {
        let mut query = QueryContext::new();
        query
            .pair_penetration((&a, &here), (&b, &here), most)
            .unwrap()
    };
    let list = ask(10);
    assert!(!list.of_whole_bodies && !list.truncated);
    let found: Vec<_> = list
        .penetrations
        .iter()
        .map(|p| (p.primitives, p.tags, p.penetration.depth))
        .collect();
    // [2, 3] in [2.5, 3.5] by a half; [0, 1] in [0.75, 1.75] by a quarter.
    assert_eq!(found, [([1, 1], [11, 11], 0.5), ([0, 0], [10, 10], 0.25)]);
    let cut = ask(1);
    assert!(cut.truncated && cut.penetrations.len() == 1);
    assert_eq!(cut.penetrations[0].penetration.depth, 0.5);
}

#[test]
fn flat_things_have_a_depth_too() {
    let here = Pose::identity();
    let square = |z: f64| {
        let corners = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)];
        hull(&corners.map(|(x, y)| Vec3::new(x, y, z)))
    };
    // In one plane they have no inside in common.
    let (found, direction) = depth((&square(0.0), &here), (&square(0.0), &at(0.5, 0.5, 0.0)));
    assert_eq!(found, 0.0);
    assert_eq!(direction.z.abs(), 1.0);
    // Upright through one another: by the shorter way over an edge.
    let upright = Pose {
        rotation: Mat3::new(1., 0., 0., 0., 0., -1., 0., 1., 0.),
        translation: Vec3::new(0.0, 0.25, -0.5),
    };
    let (found, _) = depth((&square(0.0), &here), (&square(0.0), &upright));
    assert!((found - 0.25).abs() <= 1e-15, "{found}");
    // A segment and a point in a cube.
    let cube = cuboid([1.0; 3]);
    let segment = hull(&[Vec3::new(0.0, 0.0, 0.3), Vec3::new(0.2, 0.0, 0.3)]);
    let (found, direction) = depth((&segment, &here), (&cube, &here));
    assert!((found - 0.2).abs() <= 1e-15);
    assert_eq!(direction, Vec3::z());
    let point = hull(&[Vec3::new(-0.4, 0.0, 0.3)]);
    let (found, direction) = depth((&point, &here), (&cube, &here));
    assert!((found - 0.1).abs() <= 1e-15);
    assert_eq!(direction, -Vec3::x());
    let (found, _) = depth((&point, &here), (&point, &here));
    assert_eq!(found, 0.0);
    let (found, _) = depth((&segment, &here), (&segment, &here));
    assert_eq!(found, 0.0);
}
