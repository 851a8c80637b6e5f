//! Cases in which other libraries hung, threw or answered nothing: many random ones of a kind, each with a truth.

use cstk::pose::{Mat3, Pose, Vec3, rotation_about};
use cstk::query::{DistanceKind, QueryContext};

use helpers::random::Random;
use helpers::shapes::{Shape, cuboid, hull, planar, widest_gap};

/// Boxes that almost touch or just overlap, face to face, edge to edge and corner to face, many of them turned alike.
/// Each has an answer, and it is the truth.
/// Case A6 of docs/cases.md.
#[test]
fn boxes_near_contact_always_end_in_an_answer() {
    let mut random = Random::new(6);
    let mut query = QueryContext::new();
    let (mut touching, mut apart) = (0, 0);
    for case in 0..40_000 {
        let mut sides = || [0, 1, 2].map(|_| random.within(0.1, 1.0));
        let sides = [sides(), sides()];
        let rotation = random.rotation();
        let other = match case % 4 {
            0 => rotation,
            1 => rotation * rotation_about(&Vec3::z(), random.within(-3.0, 3.0)),
            2 => rotation * rotation_about(&Vec3::x(), random.within(-1e-7, 1e-7)),
            _ => random.rotation(),
        };
        let axis = random.unit();
        let far = Pose {
            rotation: other,
            translation: axis * 4.0,
        };
        let here = Pose {
            rotation,
            translation: Vec3::zeros(),
        };
        // Along the axis until the widest gap is as wanted: it grows with the way, so bisection finds it.
        let wanted = [0.0, 1e-15, -1e-15, 1e-12, 1e-9, -1e-9, 1e-6][case % 7];
        let (mut low, mut high) = (0.0, 4.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let there = Pose {
                translation: axis * middle,
                ..far
            };
            if widest_gap(sides, [&here, &there]) < wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        let there = Pose {
            translation: axis * high,
            ..far
        };
        let gap = widest_gap(sides, [&here, &there]);
        let boxes = sides.map(cuboid);
        let pair = [(&*boxes[0].body, &here), (&*boxes[1].body, &there)];
        let found = query
            .pair_distance(pair[0], pair[1], f64::INFINITY)
            .unwrap();
        assert_eq!(found.kind, DistanceKind::Exact);
        assert!(found.lower <= found.distance && found.distance <= found.upper);
        // Apart by the gap at least; and where they overlap they meet.
        assert!(found.upper >= gap, "{gap:e}: {found:?}");
        if gap <= -1e-14 {
            assert_eq!(found.distance, 0.0, "{gap:e}");
        }
        // A gap of some width along an axis is not lost.
        if gap >= 1e-13 {
            assert!(found.distance >= gap - 1e-14, "{gap:e}: {found:?}");
        }
        let within = query.pair_within(pair[0], pair[1], 0.0).unwrap();
        assert_eq!(within, found.lower == 0.0);
        touching += usize::from(within);
        apart += usize::from(!within);
    }
    assert!(touching > 10_000 && apart > 10_000, "{touching} {apart}");
}

/// Case A7 of docs/cases.md.
#[test]
fn a_box_beside_a_round_drum() {
    let quarter = Mat3::new(0., -1., 0., 1., 0., 0., 0., 0., 1.);
    let board = cuboid([0.05, 0.39, 1.47]);
    let board_at = Pose {
        rotation: quarter,
        translation: Vec3::new(0.8, -0.385, 0.735),
    };
    let drum_at = Pose {
        rotation: rotation_about(&Vec3::z(), -2.0 * 0.130526f64.asin()),
        translation: Vec3::new(0.4, -0.4, 0.93),
    };
    // An inscribed prism is farther away than the drum, a circumscribed one nearer.
    let sides = 256;
    let prism = |radius: f64| {
        let corners = (0..sides).flat_map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(sides);
            let (s, c) = angle.sin_cos();
            [-0.09, 0.09].map(|z| Vec3::new(radius * c, radius * s, z))
        });
        hull(&corners.collect::<Vec<_>>())
    };
    let sagitta = 1.0 - (std::f64::consts::PI / f64::from(sides)).cos();
    let mut query = QueryContext::new();
    let mut distance = |drum: &Shape| {
        let found = query.pair_distance((&board.body, &board_at), (&drum.body, &drum_at), 1.0);
        found.unwrap().distance
    };
    let (inscribed, circumscribed) = (
        distance(&prism(0.18)),
        distance(&prism(0.18 / (1.0 - sagitta))),
    );
    assert!(circumscribed <= 0.025 + 1e-15 && 0.025 <= inscribed + 1e-15);
    assert!(inscribed - circumscribed <= 0.18 * 2.1 * sagitta);
}

/// A wall of stacked boxes that tremble, frame after frame.
/// Case A9 of docs/cases.md.
#[test]
fn a_trembling_wall_never_fails() {
    let mut random = Random::new(9);
    let brick = cuboid([0.3; 3]);
    let mut query = QueryContext::new();
    let (mut met, mut clear) = (0, 0);
    for _ in 0..2500 {
        let poses: Vec<Pose> = (0..8)
            .map(|i| {
                let axis = random.unit();
                let jitter = random.within(-1e-3, 1e-3);
                Pose {
                    rotation: rotation_about(&axis, jitter),
                    translation: Vec3::new(0.3 * f64::from(i % 2), 0.0, 0.3 * f64::from(i / 2))
                        + random.point(1e-4),
                }
            })
            .collect();
        for i in 0..8 {
            for j in 0..i {
                let gap = widest_gap([[0.3; 3]; 2], [&poses[i], &poses[j]]);
                let pair = [(&*brick.body, &poses[i]), (&*brick.body, &poses[j])];
                let found = query
                    .pair_distance(pair[0], pair[1], f64::INFINITY)
                    .unwrap();
                assert_eq!(found.distance == 0.0, gap <= 1e-15, "{gap:e}");
                assert!(found.upper >= gap);
                let deep = query.pair_penetration(pair[0], pair[1], 1).unwrap();
                let depth = deep.penetrations.first().map(|p| p.penetration.depth);
                assert_eq!(depth.is_some(), found.distance == 0.0);
                if let Some(depth) = depth {
                    assert!((depth + gap).abs() <= 1e-15, "{depth} {gap}");
                    met += 1;
                } else {
                    clear += 1;
                }
            }
        }
    }
    assert!(met > 1000 && clear > 1000, "{met} {clear}");
}

/// Polygons of the plane, in the plane and lying in space, are as far apart as each other.
/// Case A13 of docs/cases.md.
#[test]
fn flat_polygons_are_measured_in_both_dimensions() {
    let mut random = Random::new(13);
    let mut query = QueryContext::new();
    let mut apart = 0;
    for _ in 0..2000 {
        let mut corners = || {
            let count = 3 + random.below(5);
            let offset = random.point(1.5);
            let polygon = random.polygon(count, 1.0);
            polygon
                .iter()
                .map(|p| p + Vec3::new(offset.x, offset.y, 0.0))
                .collect::<Vec<_>>()
        };
        let (a, b) = (corners(), corners());
        let here = Pose::identity();
        let mut measure = |a: &Shape, b: &Shape| {
            let found = query.pair_distance((&a.body, &here), (&b.body, &here), f64::INFINITY);
            found.unwrap().distance
        };
        let flat = measure(
            &planar(std::slice::from_ref(&a)),
            &planar(std::slice::from_ref(&b)),
        );
        let lying = measure(&hull(&a), &hull(&b));
        assert!(
            flat.is_finite() && (flat - lying).abs() <= 1e-14,
            "{flat} {lying}"
        );
        apart += usize::from(flat > 0.0);
        let raised: Vec<Vec3> = b.iter().map(|p| p + Vec3::z() * 0.5).collect();
        let above = measure(&hull(&a), &hull(&raised));
        assert!((above - flat.hypot(0.5)).abs() <= 1e-14);
    }
    assert!(apart > 300, "{apart}");
}
