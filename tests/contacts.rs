//! Contacts (§4.4): modes, normals and gradients at exact contact and a little above it, against closed forms and the
//! one-sided difference on the way out; overlaps, which have none.

mod common;

use cstk::cobject::{CObject, Class};
use cstk::convex::ContactMode;
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::primitive::FeatureKind;
use cstk::query::{Configuration, QueryContext};

use common::differences::{agrees, distance, moved, rows};
use common::oracle::gap_along;
use common::random::Random;
use common::robots::{against, environment, free_body, free_planar_body, space};
use common::shapes::{Shape, box_corners, cuboid, hull, planar};

/// One free body touching one object at `q`.
struct Touch {
    cobject: CObject,
    q: Vec<f64>,
    r: Vec<Vec3>,
    s: Vec<Vec3>,
    /// The point of contact and the normal from s to r, by construction.
    point: Vec3,
    normal: Vec3,
    mode: ContactMode,
}

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

/// At exact contact: the answers of the one contact, its gradient's closed form, and the difference on the way out. A
/// step of 1e-7 keeps both its curvature and the distance's rounding under 1e-6.
fn check_touch(touch: &Touch, closed: &[f64]) {
    let (cobject, q) = (&touch.cobject, &touch.q);
    let mut context = QueryContext::new();
    let at = Configuration::Coordinates(q);
    let found = context.distance(cobject, at, f64::INFINITY).unwrap();
    assert_eq!((found.distance, found.lower), (0.0, 0.0));
    assert_eq!(context.classify(cobject, at).unwrap(), Class::Inside);
    let list = context.gradients(cobject, q, 0.0, 10).unwrap();
    assert_eq!(list.witnesses.len(), 1);
    assert!(!list.witnesses[0].overlapping, "{:?} overlaps", touch.mode);
    assert_eq!(
        list.contacts.len(),
        1,
        "{:?}: {:?}",
        touch.mode,
        list.contacts
    );
    let contact = &list.contacts[0];
    assert_eq!(contact.mode, touch.mode, "{:?}", contact.features);
    assert!((contact.normal.norm() - 1.0).abs() <= 1e-14);
    assert!(
        (contact.normal - touch.normal).amax() <= 1e-9,
        "{} {}",
        contact.normal,
        touch.normal
    );
    for point in contact.points {
        assert!((point - touch.point).norm() <= 1e-13);
    }
    let step = 1e-7;
    for (i, (gradient, want)) in rows(&list)[0].iter().zip(closed).enumerate() {
        assert!(
            (gradient - want).abs() <= 1e-9,
            "{:?} {i}: {gradient} {want}",
            touch.mode
        );
        let (out, into) = (step * gradient.signum(), -step * gradient.signum());
        let quotient = distance(cobject, &moved(q, i, out)) / step;
        assert!(
            (quotient - gradient.abs()).abs() <= 1e-6,
            "{i}: {quotient} {gradient}"
        );
        // The other way the solids meet, but for the curvature of the motion.
        assert!(distance(cobject, &moved(q, i, into)) <= 1e-6 * step);
    }
    // The normal separates the two sets.
    assert!(gap_along(&touch.r, &touch.s, &contact.normal) >= -1e-13);
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

/// The lowest of some points along `n`, if the next one lies clearly higher.
fn lowest(points: &[Vec3], n: &Vec3) -> Option<usize> {
    let height = |i: &usize| n.dot(&points[*i]);
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|i, j| height(i).total_cmp(&height(j)));
    (height(&order[1]) - height(&order[0]) > 0.05).then_some(order[0])
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

/// A planar body of one polygon that touches another polygon, or keeps a distance from it.
struct Flat {
    r: Vec<Vec3>,
    s: Vec<Vec3>,
    q: [f64; 3],
    s_pose: Pose,
}

impl Flat {
    fn cobject(&self) -> CObject {
        let (r, s) = (
            planar(std::slice::from_ref(&self.r)),
            planar(std::slice::from_ref(&self.s)),
        );
        let (environment, _) = environment(&[(&s.body, self.s_pose)]);
        against(&space(vec![free_planar_body(&r.body)]), &environment)
    }

    fn placed_r(&self) -> Vec<Vec3> {
        let turn = rotation_about(&Vec3::z(), self.q[2]);
        let shift = Vec3::new(self.q[0], self.q[1], 0.0);
        self.r.iter().map(|p| turn * p + shift).collect()
    }

    fn placed_s(&self) -> Vec<Vec3> {
        self.s
            .iter()
            .map(|p| self.s_pose.transform_point(p))
            .collect()
    }

    fn touch(&self, point: Vec3, normal: Vec3, mode: ContactMode) -> Touch {
        Touch {
            cobject: self.cobject(),
            q: self.q.to_vec(),
            r: self.placed_r(),
            s: self.placed_s(),
            point,
            normal,
            mode,
        }
    }
}

fn outward(a: &Vec3, b: &Vec3) -> Vec3 {
    Vec3::new(b.y - a.y, a.x - b.x, 0.0).normalize()
}

/// The report's gradient of a point of r over an edge of s, step 5. The edge stands still, so `n` is a constant (erratum
/// 3), which the printed gradient is right for; `p0` is the point in the body's frame.
fn report_point_edge(n: &Vec3, p0: &Vec3, q: &[f64; 3]) -> [f64; 3] {
    let (sin, cos) = q[2].sin_cos();
    [
        n.x,
        n.y,
        -n.x * (p0.x * sin + p0.y * cos) + n.y * (p0.x * cos - p0.y * sin),
    ]
}

/// The report's gradient of an edge of r over a point of s, step 5, with errata 1 and 2: the second entry is negative,
/// and the last two terms share their brackets. `n0` is the edge's normal in the body's frame, outward of r.
fn report_edge_point(n0: &Vec3, p: &Vec3, q: &[f64; 3]) -> [f64; 3] {
    let (x, y) = (q[0], q[1]);
    let (sin, cos) = q[2].sin_cos();
    [
        n0.y * sin - n0.x * cos,
        -(n0.x * sin + n0.y * cos),
        -p.x * (n0.x * sin + n0.y * cos)
            + p.y * (n0.x * cos - n0.y * sin)
            + (n0.x * x + n0.y * y) * sin
            + (n0.y * x - n0.x * y) * cos,
    ]
}

#[test]
fn planar_point_on_edge_has_the_reports_gradient() {
    let mut random = Random::new(9);
    let mut done = 0;
    while done < 60 {
        let (r, s) = (random.polygon(5, 1.0), random.polygon(4, 1.2));
        let s_pose = random.planar_pose(1.0);
        let mut flat = Flat {
            r,
            s,
            q: [0.0, 0.0, random.within(-3.0, 3.0)],
            s_pose,
        };
        let (placed, share) = (flat.placed_s(), random.within(0.1, 0.9));
        let point = placed[1] * (1.0 - share) + placed[2] * share;
        let normal = outward(&placed[1], &placed[2]);
        let turned = flat.placed_r();
        let Some(vertex) = lowest(&turned, &normal) else {
            continue;
        };
        let gap = if done % 2 == 0 { 0.0 } else { 0.3 };
        let shift = point + normal * gap - turned[vertex];
        (flat.q[0], flat.q[1]) = (shift.x, shift.y);
        let closed = report_point_edge(&normal, &flat.r[vertex], &flat.q);
        compare_planar(&flat, point, normal, ContactMode::PointEdge, closed, gap);
        done += 1;
    }
}

#[test]
fn planar_edge_on_point_has_the_reports_gradient() {
    let mut random = Random::new(10);
    let mut done = 0;
    while done < 60 {
        let (r, s) = (random.polygon(5, 1.0), random.polygon(4, 1.2));
        let s_pose = random.planar_pose(1.0);
        let mut flat = Flat {
            r,
            s,
            q: [0.0, 0.0, random.within(-3.0, 3.0)],
            s_pose,
        };
        let (turned, share) = (flat.placed_r(), random.within(0.1, 0.9));
        let foot = turned[1] * (1.0 - share) + turned[2] * share;
        let out = outward(&turned[1], &turned[2]);
        let placed = flat.placed_s();
        let Some(vertex) = lowest(&placed, &out) else {
            continue;
        };
        let gap = if done % 2 == 0 { 0.0 } else { 0.3 };
        let shift = placed[vertex] - out * gap - foot;
        (flat.q[0], flat.q[1]) = (shift.x, shift.y);
        let n0 = outward(&flat.r[1], &flat.r[2]);
        let closed = report_edge_point(&n0, &placed[vertex], &flat.q);
        compare_planar(
            &flat,
            placed[vertex],
            -out,
            ContactMode::EdgePoint,
            closed,
            gap,
        );
        done += 1;
    }
}

/// At contact as any touch; at a distance the contact's gradient is the closed form, too, and the central difference's.
fn compare_planar(
    flat: &Flat,
    point: Vec3,
    normal: Vec3,
    mode: ContactMode,
    closed: [f64; 3],
    gap: f64,
) {
    let touch = flat.touch(point, normal, mode);
    if gap == 0.0 {
        check_touch(&touch, &closed);
        return;
    }
    let list = QueryContext::new()
        .gradients(&touch.cobject, &flat.q, 1.0, 10)
        .unwrap();
    assert_eq!((list.witnesses.len(), list.contacts.len()), (1, 1));
    assert_eq!(list.contacts[0].mode, mode);
    assert!((list.contacts[0].distance - gap).abs() <= 1e-14);
    assert!((list.contacts[0].normal - normal).amax() <= 1e-13);
    for (gradient, want) in list.gradients.iter().zip(closed) {
        assert!(
            (gradient - want).abs() <= 1e-12,
            "{mode:?}: {gradient} {want}"
        );
    }
    assert!(agrees(&touch.cobject, &flat.q));
}

/// A corner over a corner: at a distance the direction between them; at contact some direction that separates, so that
/// its gradient is a lower bound of the distance on every way out.
#[test]
fn planar_point_at_point() {
    let mut random = Random::new(11);
    let mut done = 0;
    while done < 60 {
        let (r, s) = (random.polygon(5, 1.0), random.polygon(4, 1.2));
        let s_pose = random.planar_pose(1.0);
        let mut flat = Flat {
            r,
            s,
            q: [0.0, 0.0, random.within(-3.0, 3.0)],
            s_pose,
        };
        let angle = random.within(-3.0, 3.0);
        let normal = Vec3::new(angle.cos(), angle.sin(), 0.0);
        let (turned, placed) = (flat.placed_r(), flat.placed_s());
        let (Some(i), Some(j)) = (lowest(&turned, &normal), lowest(&placed, &-normal)) else {
            continue;
        };
        let gap = if done % 2 == 0 { 0.0 } else { 0.3 };
        let shift = placed[j] + normal * gap - turned[i];
        (flat.q[0], flat.q[1]) = (shift.x, shift.y);
        let cobject = flat.cobject();
        let list = QueryContext::new()
            .gradients(&cobject, &flat.q, gap + 0.1, 10)
            .unwrap();
        assert_eq!((list.witnesses.len(), list.contacts.len()), (1, 1));
        let contact = &list.contacts[0];
        assert_eq!(contact.mode, ContactMode::PointPoint);
        assert!((contact.normal.norm() - 1.0).abs() <= 1e-14 && contact.normal.z == 0.0);
        let moment = Vec3::z().cross(&turned[i]);
        let n = if gap > 0.0 { normal } else { contact.normal };
        for (gradient, want) in list.gradients.iter().zip([n.x, n.y, n.dot(&moment)]) {
            assert!((gradient - want).abs() <= 1e-12);
        }
        if gap > 0.0 {
            assert!(agrees(&cobject, &flat.q));
        } else {
            assert_eq!(contact.distance, 0.0);
            assert!(gap_along(&flat.placed_r(), &placed, &contact.normal) >= -1e-13);
            let step = 1e-7;
            for (k, gradient) in list.gradients.iter().enumerate() {
                for by in [-step, step] {
                    let least = by * gradient - 1e-6 * step;
                    assert!(distance(&cobject, &moved(&flat.q, k, by)) >= least);
                }
            }
        }
        done += 1;
    }
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
            // Each point lies on the feature named: on the hull of its vertices.
            for (k, (shape, pose)) in [(&a, &pose_a), (&b, &pose_b)].into_iter().enumerate() {
                let primitive = &shape.body.primitives()[0];
                let corners: Vec<Vec3> = primitive
                    .feature_vertices(contact.features[k])
                    .unwrap()
                    .iter()
                    .map(|&i| {
                        pose.transform_point(
                            &(primitive.vertices[i as usize] + shape.body.center()),
                        )
                    })
                    .collect();
                let off = common::oracle::hull_distance(&corners, &[contact.points[k]]).upper;
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
