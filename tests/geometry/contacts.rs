//! Contacts (§4.4): modes, normals and gradients at exact contact and a little above it, against closed forms and the
//! one-sided difference on the way out; overlaps, which have none.

use cstk::convex::ContactMode;
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::primitive::FeatureKind;
use cstk::query::{ContactsListed, QueryContext};

use helpers::differences::rows;
use helpers::random::Random;
use helpers::robots::{against, environment, free_body, space};
use helpers::shapes::{Shape, box_corners, cuboid, hull, off_feature, planar};
use helpers::touch::{Touch, check_touch, lowest};

/// The closed form for a body that moves freely in space: the normal itself, and its moment about each axis.
fn closed_form(touch: &Touch) -> Vec<f64> {
    let q = &touch.q;
    let origin = Vec3::new(q[0], q[1], q[2]);
    let first = rotation_about(&Vec3::z(), q[3]);
    let second = first * rotation_about(&Vec3::y(), q[4]);
    let axes = [Vec3::z(), first * Vec3::y(), second * Vec3::x()];
    let moments = axes.map(|axis| axis.cross(&(touch.point - origin)).dot(&touch.normal));
    touch.normal.iter().copied().chain(moments).collect()
}

/// A little above contact, down to where only rounding lies between: the normal, the mode and the closed form stay.
fn check_lifted(touch: &Touch) {
    for gap in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
        let by = touch.normal * gap;
        let mut q = touch.q.clone();
        (0..3).for_each(|i| q[i] += by[i]);
        let found = QueryContext::new()
            .gradients(&touch.cobject, &q, 2.0 * gap + 1e-13, 10)
            .unwrap();
        assert_eq!((found.witnesses.len(), found.contacts.len()), (1, 1));
        let contact = &found.contacts[0];
        assert_eq!(contact.mode, touch.mode, "gap {gap:e}");
        assert!((contact.distance - gap).abs() <= 1e-13, "gap {gap:e}");
        // The normal is that of a face or of two edges, so nearness costs it nothing.
        assert!(
            (contact.normal - touch.normal).amax() <= 1e-9,
            "gap {gap:e}: {}",
            contact.normal - touch.normal
        );
        for (gradient, want) in rows(&found)[0].iter().zip(closed_form(touch)) {
            assert!((gradient - want).abs() <= 1e-9 + 2.0 * gap, "gap {gap:e}");
        }
    }
}

/// Brings points of r and s together by a translation: r at the given angles.
fn touching(
    r: &[Vec3],
    angles: [f64; 3],
    s: (&[Vec3], Pose),
    contact: impl FnOnce(&[Vec3], &[Vec3]) -> Option<([Vec3; 2], Vec3, ContactMode)>,
) -> Option<Touch> {
    let turn = rotation_about(&Vec3::z(), angles[0])
        * rotation_about(&Vec3::y(), angles[1])
        * rotation_about(&Vec3::x(), angles[2]);
    let turned: Vec<Vec3> = r.iter().map(|p| turn * p).collect();
    let placed: Vec<Vec3> = s.0.iter().map(|p| s.1.transform_point(p)).collect();
    let ([on_r, on_s], normal, mode) = contact(&turned, &placed)?;
    let shift = on_s - on_r;
    let (body_r, body_s) = (hull(r), hull(s.0));
    Some(Touch {
        cobject: against(
            &space(vec![free_body(&body_r.body)]),
            &environment(&[(&body_s.body, s.1)]).0,
        ),
        q: shift.iter().copied().chain(angles).collect(),
        r: turned.iter().map(|p| p + shift).collect(),
        s: placed,
        point: on_s,
        normal,
        mode,
    })
}

fn angles(random: &mut Random) -> [f64; 3] {
    [3.0, 1.4, 3.0].map(|r| random.within(-r, r))
}

/// The face of a box on the positive side of one of its axes: a point of it, and the outward normal.
fn face_of(corners: &[Vec3], axis: usize, shares: [f64; 2]) -> (Vec3, Vec3) {
    let near = corners[1 << axis];
    let along = |k: usize| corners[(1 << axis) | (1 << ((axis + k) % 3))] - near;
    let (u, v) = (along(1), along(2));
    (
        near + u * shares[0] + v * shares[1],
        u.cross(&v).normalize(),
    )
}

#[test]
fn vertex_on_face_and_face_on_vertex() {
    let mut random = Random::new(7);
    for sides in [[1.0, 1.4, 0.8], [0.3, 2.0, 1.0]] {
        let mut done = 0;
        while done < 40 {
            let (corners, other) = (box_corners(sides), random.points(7, 1.0));
            let (axis, shares) = (
                random.below(3),
                [random.within(0.1, 0.9), random.within(0.1, 0.9)],
            );
            let pose = random.pose(0.5);
            let on_face = touching(&other, angles(&mut random), (&corners, pose), |r, s| {
                let (point, normal) = face_of(s, axis, shares);
                let vertex = r[lowest(r, &normal)?];
                Some(([vertex, point], normal, ContactMode::PointFace))
            });
            let under_face = touching(&corners, angles(&mut random), (&other, pose), |r, s| {
                let (point, outward) = face_of(r, axis, shares);
                let vertex = s[lowest(s, &outward)?];
                Some(([point, vertex], -outward, ContactMode::FacePoint))
            });
            for touch in [on_face, under_face].into_iter().flatten() {
                check_touch(&touch, &closed_form(&touch));
                check_lifted(&touch);
                done += 1;
            }
        }
    }
}

#[test]
fn edge_across_edge() {
    let mut random = Random::new(8);
    let mut done = 0;
    while done < 60 {
        let (corners_r, corners_s) = (box_corners([1.0, 0.6, 1.3]), box_corners([0.9, 1.5, 0.7]));
        let (i, j) = (random.below(3), random.below(3));
        let (t, u) = (random.within(0.1, 0.9), random.within(0.1, 0.9));
        let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
        // The edge along an axis that lies farthest along a direction upright on it, at some share of its length.
        let edge = |corners: &[Vec3], axis: usize, up: &Vec3, share: f64| -> Option<Vec3> {
            let without: Vec<usize> = (0..8).filter(|k| k >> axis & 1 == 0).collect();
            let starts: Vec<Vec3> = without.iter().map(|&k| corners[k]).collect();
            let k = without[lowest(&starts, &-up)?];
            Some(corners[k] + (corners[k | 1 << axis] - corners[k]) * share)
        };
        let pose = random.pose(0.5);
        let touch = touching(
            &corners_r,
            angles(&mut random),
            (&corners_s, pose),
            |r, s| {
                let (along_r, along_s) = (r[1 << i] - r[0], s[1 << j] - s[0]);
                let cross = along_r.normalize().cross(&along_s.normalize());
                if cross.norm() < 0.2 {
                    return None;
                }
                let normal = cross.normalize() * sign;
                let points = [edge(r, i, &-normal, t)?, edge(s, j, &normal, u)?];
                Some((points, normal, ContactMode::EdgeEdge))
            },
        );
        if let Some(touch) = touch {
            check_touch(&touch, &closed_form(&touch));
            check_lifted(&touch);
            done += 1;
        }
    }
}

/// A prism whose caps fall into triangles, as their corners are off one plane by rounding, on a block: each contact names the triangle
/// that holds it.
#[test]
fn contacts_of_faces_that_are_hardly_flat_are_on_the_faces_named() {
    let mut random = Random::new(19);
    let mut named = std::collections::HashSet::new();
    for _ in 0..200 {
        let ring: Vec<Vec3> = (0..24u32)
            .map(|i| {
                let (y, x) = (std::f64::consts::TAU * f64::from(i / 2) / 12.0).sin_cos();
                let height = [-0.5, 0.5][i as usize % 2];
                Vec3::new(0.5 * x, 0.5 * y, height + random.within(-1e-11, 1e-11))
            })
            .collect();
        let side = random.within(0.1, 0.4);
        let (prism, block) = (hull(&ring), hull(&box_corners([2.0 * side; 3])));
        let turn = rotation_about(&Vec3::z(), random.within(0.0, 3.0));
        let aside = Vec3::new(
            random.within(-0.2, 0.2),
            random.within(-0.2, 0.2),
            -0.5 - side,
        );
        let poses = [
            Pose::identity(),
            Pose {
                rotation: turn,
                translation: aside,
            },
        ];
        let sides = [(&prism, &poses[0]), (&block, &poses[1])];
        let [a, b] = sides.map(|(shape, pose)| (&*shape.body, pose));
        let list = QueryContext::new().pair_witnesses(a, b, 1e-10, 10).unwrap();
        assert!(list.contacts.len() >= 3, "{}", list.contacts.len());
        for contact in &list.contacts {
            assert!(contact.clearance.abs() <= 1e-10, "{}", contact.clearance);
            for (k, side) in sides.into_iter().enumerate() {
                let off = off_feature(side, contact.features[k], &contact.points[k]);
                assert!(off <= 1e-9, "{off:e} {:?}", contact.features[k]);
            }
            named.insert(contact.features[0].index);
        }
    }
    assert!(named.len() > 4, "{named:?}");
}

/// Features say the same as the mode.
#[test]
fn modes_are_those_of_the_features() {
    let kinds = |mode| match mode {
        ContactMode::PointPoint => [FeatureKind::Vertex, FeatureKind::Vertex],
        ContactMode::PointEdge => [FeatureKind::Vertex, FeatureKind::Edge],
        ContactMode::EdgePoint => [FeatureKind::Edge, FeatureKind::Vertex],
        ContactMode::PointFace => [FeatureKind::Vertex, FeatureKind::Face],
        ContactMode::FacePoint => [FeatureKind::Face, FeatureKind::Vertex],
        ContactMode::EdgeEdge => [FeatureKind::Edge, FeatureKind::Edge],
        ContactMode::PureSet => [FeatureKind::Interior; 2],
    };
    let mut random = Random::new(14);
    let mut seen = std::collections::HashSet::new();
    for _ in 0..400 {
        let (a, b) = (hull(&random.points(6, 1.0)), hull(&random.points(6, 1.0)));
        let (pose_a, pose_b) = (random.pose(1.0), random.pose(3.0));
        let (a_side, b_side) = ((&*a.body, &pose_a), (&*b.body, &pose_b));
        let list = QueryContext::new()
            .pair_witnesses(a_side, b_side, 10.0, 10)
            .unwrap();
        for contact in &list.contacts {
            assert_eq!(contact.features.map(|f| f.kind), kinds(contact.mode));
            seen.insert(format!("{:?}", contact.mode));
            for (k, side) in [(&a, &pose_a), (&b, &pose_b)].into_iter().enumerate() {
                let off = off_feature(side, contact.features[k], &contact.points[k]);
                assert!(off <= 1e-12 * 10.0, "{off:e} {:?}", contact.features[k]);
            }
        }
    }
    assert_eq!(seen.len(), 6, "{seen:?}");
}

/// Containment has no contact, no gradient, and says so.
#[test]
fn deep_overlap_has_no_contact() {
    let mut random = Random::new(15);
    for depth in [1.0, 0.1, 1e-3, 1e-4] {
        for _ in 0..10 {
            let common = random.pose(1.0);
            let (a, b) = (cuboid([1.0; 3]), cuboid([3.0; 3]));
            let away = common.compose(&Pose::from_translation(Vec3::new(0.2, 0.1, 2.0 - depth)));
            expect_overlap(&a, &away, &b, &common);
            let common = random.planar_pose(1.0);
            let (a, b) = (
                planar(&[random.polygon(6, 1.0)]),
                planar(&[random.polygon(5, 1.0)]),
            );
            expect_overlap(&a, &common, &b, &common);
        }
    }
    // One inside the other, far from its surface.
    let (a, b) = (cuboid([0.1; 3]), cuboid([3.0; 3]));
    expect_overlap(&a, &Pose::identity(), &b, &random.pose(0.2));
    expect_overlap(&b, &Pose::identity(), &a, &random.pose(0.2));
}

fn expect_overlap(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) {
    let mut context = QueryContext::new();
    let sides = ((&*a.body, pose_a), (&*b.body, pose_b));
    let found = context
        .pair_distance(sides.0, sides.1, f64::INFINITY)
        .unwrap();
    assert_eq!((found.distance, found.lower), (0.0, 0.0));
    assert!(found.contact.is_none());
    let witness = found.witness.unwrap();
    assert!(witness.overlapping && witness.contact_count == 0);
    let list = context.pair_witnesses(sides.0, sides.1, 0.0, 10).unwrap();
    assert_eq!((list.witnesses.len(), list.contacts.len()), (1, 0));
    assert!(list.witnesses[0].overlapping && list.witnesses[0].contact_count == 0);
}

/// What is listed of contacts changes neither the witnesses nor their distances; and the nearest is the first of all.
#[test]
fn fewer_contacts_are_the_first_of_all() {
    let mut random = Random::new(9);
    let at = |x: f64, z: f64| Pose::from_translation(Vec3::new(x, 0.0, z));
    let blocks = [cuboid([1.0; 3]), cuboid([0.5, 1.0, 1.5])];
    let mut compared = 0;
    for k in 0..200 {
        let (a, b) = (&blocks[k % 2], &blocks[1 - k % 2]);
        // Upright, so that faces are parallel; the bodies are apart, touch, or overlap.
        let pose = match k % 4 {
            0 => random.pose(1.5),
            _ => at(0.3, 1.0 + 0.5 * (k % 3) as f64),
        };
        let sides = ((&*a.body, &Pose::identity()), (&*b.body, &pose));
        let lists = [
            ContactsListed::All,
            ContactsListed::Nearest,
            ContactsListed::None,
        ]
        .map(|listed| {
            let mut context = QueryContext::new();
            context.set_contacts(listed);
            context.pair_witnesses(sides.0, sides.1, 2.0, 10).unwrap()
        });
        let [all, nearest, none] = &lists;
        for list in [nearest, none] {
            assert_eq!(list.witnesses.len(), all.witnesses.len());
            for (one, other) in list.witnesses.iter().zip(&all.witnesses) {
                assert_eq!(
                    (one.primitives, one.distance),
                    (other.primitives, other.distance)
                );
            }
        }
        assert!(none.contacts.is_empty());
        for (witness, of_all) in nearest.witnesses.iter().zip(&all.witnesses) {
            assert_eq!(witness.overlapping, of_all.overlapping);
            assert_eq!(witness.contact_count, of_all.contact_count.min(1));
            if witness.contact_count > 0 {
                let (one, first) = (
                    &nearest.contacts[witness.first_contact],
                    &all.contacts[of_all.first_contact],
                );
                assert_eq!((one.points, one.normal), (first.points, first.normal));
                assert_eq!((one.mode, one.distance), (first.mode, first.distance));
                compared += usize::from(of_all.contact_count > 1);
            }
        }
        for witness in &none.witnesses {
            assert_eq!(witness.contact_count, 0);
            assert_eq!(witness.overlapping, witness.distance == 0.0);
        }
    }
    assert!(compared > 30, "{compared} pairs had several contacts");
}
