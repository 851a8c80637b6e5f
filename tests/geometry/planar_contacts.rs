//! Contacts in the plane (§4.4): point/edge and edge/point against the report's closed forms, errata mended, and point/point.

use cstk::cobject::CObject;
use cstk::convex::ContactMode;
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::QueryContext;

use helpers::differences::{agrees, distance, moved};
use helpers::oracle::gap_along;
use helpers::random::Random;
use helpers::robots::{against, environment, free_planar_body, space};
use helpers::shapes::planar;
use helpers::touch::{Touch, check_touch, lowest};

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
