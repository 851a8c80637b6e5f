//! Cases on which other libraries were wrong, hung or aborted, each named after the demand it stands for. Where the truth
//! is a depth, the class is asserted here. Every distance measured in this file passes [`checked`].

#![allow(clippy::excessive_precision)] // numbers stand as they were published

use cstk::cobject::Class;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::JointKind;

use helpers::checked::{at, checked, vertices};
use helpers::oracle::hull_distance;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::{Shape, cuboid, hull, mesh, pair_size, planar, sphere_points};

fn turned(rotation: [f64; 9], translation: [f64; 3]) -> Pose {
    let (r, t) = (rotation, translation);
    Pose::from_row_major(&[
        r[0], r[1], r[2], t[0], r[3], r[4], r[5], t[1], r[6], r[7], r[8], t[2],
    ])
    .unwrap()
}

fn meets(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> bool {
    let found = checked(a, b);
    let within = QueryContext::new()
        .pair_within((&a.0.body, a.1), (&b.0.body, b.1), 0.0)
        .unwrap();
    assert_eq!(
        within,
        found.lower == 0.0,
        "within(0) contradicts the distance"
    );
    found.distance == 0.0 && within
}

fn class(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> Class {
    let mut links = vec![link(None, JointKind::Prismatic, Vec3::x())];
    links[0].body = Some(a.0.body.clone());
    let space = space(vec![robot(3, links)]);
    let (environment, _) = environment(&[(&b.0.body, *b.1)]);
    QueryContext::new()
        .classify(
            &against(&space, &environment),
            Configuration::LinkPoses(&[*a.1]),
        )
        .unwrap()
}

/// Case A1 of docs/cases.md.
#[test]
fn stacks_are_exact_in_every_direction() {
    let unit = cuboid([1.0; 3]);
    assert_eq!(
        checked((&unit, &at(0., 4., 0.)), (&unit, &Pose::identity())).distance,
        3.0
    );
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            for gap in [1e-6, 0.3, 0.9, 0.99, 1.0, 2.0, 7.7, 1e3] {
                let mut offset = Vec3::new(0.25, -0.125, 0.0625);
                offset[axis] = sign * (1.0 + gap);
                let pose = Pose::from_translation(offset);
                let found = checked((&unit, &pose), (&unit, &Pose::identity()));
                assert!((found.distance - gap).abs() <= 1e-12 * (1.0 + gap));
            }
        }
    }
}

/// The 48 permutations and reflections of the axes, done to both boxes.
/// Case A1 of docs/cases.md.
#[test]
fn axis_permutations_change_no_bit() {
    let sides = [[1.0; 3], [1.0, 1.7, 0.3]];
    let offsets = [[0.0, 4.0, 0.0], [0.3, 4.1, -0.7], [2.9, 4.1, -3.3]];
    for side in sides {
        for offset in offsets {
            let mut seen: Vec<f64> = Vec::new();
            for order in [
                [0, 1, 2],
                [0, 2, 1],
                [1, 0, 2],
                [1, 2, 0],
                [2, 0, 1],
                [2, 1, 0],
            ] {
                for signs in 0..8 {
                    let sign = |k: usize| if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
                    let to = |v: [f64; 3]| Vec3::from_fn(|k, _| sign(k) * v[order[k]]);
                    let (a, b) = (
                        cuboid(order.map(|k| side[k])),
                        cuboid(order.map(|k| side[k])),
                    );
                    let pose = Pose::from_translation(to(offset));
                    seen.push(checked((&a, &pose), (&b, &Pose::identity())).distance);
                }
            }
            // The sum of three squares depends on their order by a rounding; where only one counts, no bit may differ.
            let allowed = if offset[0] == 0.0 {
                0.0
            } else {
                f64::EPSILON * 8.0
            };
            assert!(
                seen.iter().all(|d| (d - seen[0]).abs() <= allowed),
                "{seen:?}"
            );
        }
    }
}

/// Case A2 of docs/cases.md.
#[test]
fn a_face_over_an_edge_is_never_touching() {
    let a = cuboid([0.363, 0.277, 0.363]);
    let pose_a = turned(
        [
            0.9999195703,
            0.01021849413,
            0.007512347878,
            -0.01021878248,
            0.9999477869,
            -3.329855922e-17,
            -0.007511955635,
            -7.676704888e-05,
            0.9999717819,
        ],
        [1.503354966, -0.8531707835, 0.7700092418],
    );
    let b = cuboid([0.363, 0.363, 0.277]);
    let pose_b = turned(
        [
            0.9998670967,
            -0.01297708324,
            0.009868343982,
            0.01297771517,
            0.9999157859,
            5.255670031e-17,
            -0.009867512928,
            0.0001280685574,
            0.9999513067,
        ],
        [1.48838308, -1.102020834, 0.4497073799],
    );
    let found = checked((&a, &pose_a), (&b, &pose_b));
    // The truth is given to 1e-11; the matrices, to ten digits, are made orthonormal, which moves corners by 1e-10.
    assert!(
        (found.distance - 3.57545e-6).abs() <= 1e-10,
        "{}",
        found.distance
    );
    let truth = truth((&a, &pose_a), (&b, &pose_b));
    assert!((found.distance - truth).abs() <= 1e-12 * pair_size(&a, &pose_a, &b, &pose_b));
    assert!(found.lower > 0.0);
    // A coarse question may not turn apart into touching.
    let mut context = QueryContext::new();
    let far = context
        .pair_distance((&a.body, &pose_a), (&b.body, &pose_b), 1e-3)
        .unwrap();
    assert_eq!(far.distance, found.distance);
    assert!(
        !context
            .pair_within((&a.body, &pose_a), (&b.body, &pose_b), 3.5e-6)
            .unwrap()
    );
    assert_eq!(class((&a, &pose_a), (&b, &pose_b)), Class::Outside);
}

/// The distance by brute force, which proves itself.
fn truth(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> f64 {
    let origin = a.1.translation;
    let bounds = hull_distance(&a.0.placed(a.1, &origin)[0], &b.0.placed(b.1, &origin)[0]);
    let size = pair_size(a.0, a.1, b.0, b.1);
    assert!(bounds.upper - bounds.lower() <= 1e-13 * size, "{bounds:?}");
    bounds.upper
}

/// Case A3 of docs/cases.md.
#[test]
fn nearly_touching_boxes_are_apart() {
    let a = cuboid([0.03, 0.12, 0.1]);
    let pose_a = turned(
        [
            -3.0627937852578681533e-08,
            -0.99999999999999888978,
            -2.8893865161583314238e-08,
            0.9999999999999980016,
            -3.0627939739957803544e-08,
            6.4729926918527511769e-08,
            -6.4729927722963847085e-08,
            -2.8893863029448751323e-08,
            0.99999999999999711342,
        ],
        [
            0.63499979627350811029,
            -0.48500002215636439651,
            1.0778146458339641356,
        ],
    );
    let b = cuboid([0.025, 0.35, 1.845]);
    let pose_b = turned(
        [0., -1., 0., 1., 0., 0., 0., 0., 1.],
        [0.8, -0.4575, 1.0225],
    );
    let found = checked((&a, &pose_a), (&b, &pose_b));
    assert!(
        (found.distance - 1.70821917e-08).abs() <= 1e-10,
        "{}",
        found.distance
    );
    assert!(found.lower > 0.0);
    assert_eq!(class((&a, &pose_a), (&b, &pose_b)), Class::Outside);
}

/// Case A4 of docs/cases.md.
#[test]
fn kissing_boxes_meet() {
    let r = [
        0.96193976625564348026,
        0.15401279915737359216,
        0.22572537250328919556,
        -0.19134171618254486313,
        0.96936494951283913579,
        0.15401279915737359216,
        -0.19509032201612822033,
        -0.19134171618254486313,
        0.96193976625564348026,
    ];
    let cube = cuboid([0.5; 3]);
    let one = turned(
        r,
        [
            2.0770063995786869349,
            0.48468247475641951239,
            1.1543291419087275962,
        ],
    );
    let two = turned(r, [2.0, 0.0, 1.25]);
    assert!(meets((&cube, &one), (&cube, &two)));
}

const TILT: [f64; 9] = [
    0.94096063217417758029,
    0.29296840037289501035,
    0.16959541586174811667,
    -0.23569836841299879326,
    0.92661523595848427348,
    -0.29296840037289506586,
    -0.2429801799032638987,
    0.23569836841299884878,
    0.94096063217417758029,
];

/// Case A5 of docs/cases.md.
#[test]
fn the_reported_tilted_cubes_meet() {
    let cube = cuboid([0.25; 3]);
    let one = turned(
        TILT,
        [
            0.073242100093223821977,
            0.2316538089896212349,
            1.3089245921032497399,
        ],
    );
    let two = turned(TILT, [0.0, 0.0, 1.25]);
    assert!(meets((&cube, &one), (&cube, &two)));
}

/// The generalisation: five sizes, seven separations far below what their coordinates resolve.
/// Case A5 of docs/cases.md.
#[test]
fn tilted_kissing_cubes_at_all_sizes() {
    for side in [0.01, 0.25, 0.5, 10.0, 1000.0f64] {
        let cube = cuboid([side; 3]);
        let two = turned(TILT, [0.0, 0.0, 1.25]);
        let mut last = Class::Inside;
        for step in [-1e-15, -2.5e-16, -1e-16, 0.0, 1e-16, 2.5e-16, 1e-15] {
            let scale = side.max(1.0);
            let separation = step * scale;
            let up = two.rotation.column(1).into_owned();
            let one = Pose {
                translation: two.translation + up * (side + separation),
                ..two
            };
            let found = checked((&cube, &one), (&cube, &two));
            let want = separation.max(0.0);
            assert!(
                (found.distance - want).abs() <= 1e-12 * scale,
                "{side} {step}"
            );
            let class = class((&cube, &one), (&cube, &two));
            assert!(class <= last, "{side} {step}: {class:?} after {last:?}");
            last = class;
        }
    }
}

/// Case A10 of docs/cases.md.
#[test]
fn overlapping_cubes_meet() {
    let cube = cuboid([2.0; 3]);
    let up = at(0.0, 0.0, 1.9);
    assert!(meets((&cube, &Pose::identity()), (&cube, &up)));
    let found = checked((&cube, &Pose::identity()), (&cube, &up));
    assert!(found.witness.unwrap().overlapping && found.contact.is_none());
    assert_eq!(
        class((&cube, &Pose::identity()), (&cube, &up)),
        Class::Inside
    );
}

/// Case A12 of docs/cases.md.
#[test]
fn large_overlapping_polyhedra_meet_in_both_dimensions() {
    let outline = |x: [f64; 4], y: [f64; 4]| -> Vec<Vec3> {
        (0..4).map(|i| Vec3::new(x[i], y[i], 0.0)).collect()
    };
    let raised = |flat: &[Vec3]| -> Vec<Vec3> {
        let up = flat.iter().map(|p| p + Vec3::z() * 300.0);
        up.chain(flat.iter().copied()).collect()
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
    assert!(meets(
        (&hull(&raised(&a)), &here),
        (&hull(&raised(&b)), &here)
    ));
    // The corners are given to a few units of 1e-3 and are planar polygons as they stand.
    assert!(meets((&planar(&[a]), &here), (&planar(&[b]), &here)));
}

/// Case A14 of docs/cases.md.
#[test]
fn a_point_over_a_facet() {
    let point = hull(&vertices(&[(44.2919, 39.7508, 18.8208)]));
    let solid = hull(&vertices(&[
        (46.0659, 38.6251, 16.3637),
        (44.2764, 42.3867, 18.239),
        (50.0397, 38.4649, 19.9843),
        (47.1963, 40.4563, 19.1057),
        (48.0266, 38.5593, 18.2475),
        (45.1735, 40.495, 17.3336),
        (48.0415, 40.4456, 18.1963),
    ]));
    let here = Pose::identity();
    let found = checked((&point, &here), (&solid, &here));
    assert!(
        (found.distance - 1.81345264534).abs() <= 1e-11,
        "{}",
        found.distance
    );
    let want = Vec3::new(45.328388252, 40.763961517, 17.730934715);
    assert!(
        (found.points[1] - want).amax() <= 1e-9,
        "{:?}",
        found.points
    );
}

/// Case A16 of docs/cases.md.
#[test]
fn two_triangles_in_both_orders() {
    let one = vertices(&[
        (-0.37579435, 0.014414025, 0.3265663),
        (-0.37263185, 0.0108978925, 0.36118037),
        (-0.35647663, 0.03625821, 0.34328437),
    ]);
    let two = vertices(&[
        (0.23884095, -1.6477574, 0.116889484),
        (0.26891768, -1.6353351, 0.10821109),
        (0.26338503, -1.6657706, 0.10510237),
    ]);
    let here = Pose::identity();
    let as_polygons = [mesh(&one, &[[0, 1, 2]]), mesh(&two, &[[0, 1, 2]])];
    let as_hulls = [hull(&one), hull(&two)];
    for [a, b] in [&as_polygons, &as_hulls] {
        for (a, b) in [(a, b), (b, a)] {
            let found = checked((a, &here), (b, &here));
            assert!(
                (found.distance - 1.78445334).abs() <= 5e-9,
                "{}",
                found.distance
            );
        }
    }
    let [a, b] = &as_polygons;
    let found = checked((a, &here), (b, &here));
    let back = checked((b, &here), (a, &here));
    let ulp = f64::EPSILON * pair_size(a, &here, b, &here);
    assert!((found.distance - back.distance).abs() <= ulp);
    assert!((found.distance - truth((a, &here), (b, &here))).abs() <= 1e-14);
}

/// Case A17 of docs/cases.md.
#[test]
fn a_ball_under_a_box() {
    let ball = hull(&sphere_points(1.0, 8));
    let found = checked(
        (&ball, &Pose::identity()),
        (&cuboid([10., 2., 10.]), &at(0., 5., 3.)),
    );
    assert_eq!(found.distance, 3.0);
    assert_eq!(found.points, [Vec3::y(), Vec3::y() * 4.0]);
}

/// Case A18 of docs/cases.md.
#[test]
fn two_balls() {
    let (large, small) = (hull(&sphere_points(20.0, 6)), hull(&sphere_points(10.0, 6)));
    let found = checked((&large, &Pose::identity()), (&small, &at(0., 40., 0.)));
    assert_eq!(found.distance, 10.0);
    assert_eq!(found.points, [Vec3::y() * 20.0, Vec3::y() * 30.0]);
}

/// Case A19 of docs/cases.md.
#[test]
fn long_boxes_turned_about_z() {
    let third = std::f64::consts::FRAC_PI_3;
    let first = Pose {
        rotation: cstk::pose::rotation_about(&Vec3::z(), third),
        translation: Vec3::new(-2.0, 0.0, 0.0),
    };
    let long = cuboid([20.0, 5.0, 1000.0]);
    let post = cuboid([5.0, 5.0, 1000.0]);
    for (pose, want) in [
        (at(-5., 10., 0.), 1.6830127018922194),
        (at(-15., 15., 0.), 12.843266739736606),
    ] {
        let found = checked((&long, &first), (&post, &pose));
        let size = pair_size(&long, &first, &post, &pose);
        assert!(
            (found.distance - want).abs() <= 1e-12 * size,
            "{} {want}",
            found.distance
        );
    }
}

/// Case A21 of docs/cases.md.
#[test]
fn a_small_ball_in_the_surface_of_a_mesh() {
    let corners = vertices(&[(1., 1., 1.), (2., 1., 1.), (1., 2., 1.), (1., 1., 2.)]);
    let tetrahedron = mesh(&corners, &[[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]]);
    let ball = hull(&sphere_points(1e-4, 3));
    let center = Vec3::new(1.5, 1.25, 1.0);
    let pose = Pose::from_translation(center);
    assert!(meets((&ball, &pose), (&tetrahedron, &Pose::identity())));
    let found = checked((&ball, &pose), (&tetrahedron, &Pose::identity()));
    let witness = found.witness.unwrap();
    assert!(witness.overlapping && found.contact.is_none());
    assert_eq!(witness.primitives, [0, 0]);
    // One point of the intersection.
    assert_eq!(found.points[0], found.points[1]);
    assert!((found.points[0] - center).norm() <= 1e-4 + 1e-15);
    assert!((found.points[0].z - 1.0).abs() <= 1e-15);
}
