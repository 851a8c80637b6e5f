//! The contacts of parallel features: the points that span what they share (§4.4, Fig. 17).

use cstk::convex::ContactMode;
use cstk::pose::{Pose, Vec3};
use cstk::query::{ContactRecord, QueryContext, WitnessList};

use helpers::placed::shifted;
use helpers::random::Random;
use helpers::shapes::{box_corners, hull, pair_size, planar};

/// The points of r of the contacts, which are all at the pair's distance, one for each of `want` and no more.
fn expect_contacts(list: &WitnessList, want: &[Vec3], distance: f64, size: f64) {
    assert_eq!(list.witnesses.len(), 1);
    assert_eq!(list.contacts.len(), want.len(), "{:#?}", list.contacts);
    for contact in &list.contacts {
        assert!((contact.distance - distance).abs() <= 1e-12 * size);
        let between = contact.points[0] - contact.points[1];
        assert!((between - contact.normal * distance).norm() <= 1e-12 * size);
        assert!((contact.normal.norm() - 1.0).abs() <= 1e-14);
    }
    for point in want {
        let found = list
            .contacts
            .iter()
            .filter(|c| (c.points[0] - point).norm() <= 1e-10 * size);
        assert_eq!(found.count(), 1, "{point} in {:#?}", list.contacts);
    }
}

/// Solids r and s as they stand, moved together by random rigid motions: at r's contact points, at some heights.
fn expect_parallel(r: &[Vec3], s: &[Vec3], up: Vec3, want: &[Vec3]) {
    let mut random = Random::new(12);
    for gap in [0.0, 1e-9, 1e-4, 0.5] {
        for turn in 0..10 {
            let common = if turn == 0 {
                Pose::identity()
            } else {
                random.pose(2.0)
            };
            let lifted = common.compose(&Pose::from_translation(up * gap));
            let (a, b) = (hull(r), hull(s));
            let list = QueryContext::new()
                .pair_witnesses((&a.body, &lifted), (&b.body, &common), gap + 0.1, 10)
                .unwrap();
            let want: Vec<Vec3> = want.iter().map(|p| lifted.transform_point(p)).collect();
            let size = pair_size(&a, &lifted, &b, &common);
            expect_contacts(&list, &want, gap, size);
            assert!(
                list.contacts
                    .iter()
                    .all(|c| (c.normal - common.rotation * up).amax() <= 1e-9)
            );
        }
    }
}

#[test]
fn a_face_on_a_face_touches_at_the_corners_of_the_overlap() {
    let base = box_corners([2.0, 2.0, 1.0]);
    let top = |x: f64, y: f64| Vec3::new(x, y, 0.5);
    // Shifted along both sides: one corner of each, and two crossings of edges.
    let beside = shifted(&box_corners([2.0, 2.0, 1.0]), Vec3::new(0.5, 0.75, 1.0));
    let overlap = [
        top(-0.5, -0.25),
        top(1.0, -0.25),
        top(1.0, 1.0),
        top(-0.5, 1.0),
    ];
    expect_parallel(&beside, &base, Vec3::z(), &overlap);
    // Wholly on it: the four corners of the smaller one, whichever is above.
    let small = shifted(&box_corners([0.5, 0.75, 1.0]), Vec3::new(0.1, 0.2, 1.0));
    let corners: Vec<Vec3> = small.iter().filter(|p| p.z == 0.5).copied().collect();
    expect_parallel(&small, &base, Vec3::z(), &corners);
    let under: Vec<Vec3> = corners.iter().map(|p| Vec3::new(p.x, p.y, 0.5)).collect();
    expect_parallel(&base, &small, -Vec3::z(), &under);
    // Across: four crossings of edges.
    let across = shifted(&box_corners([4.0, 0.5, 1.0]), Vec3::new(0.0, 0.1, 1.0));
    let overlap = [
        top(-1.0, -0.15),
        top(1.0, -0.15),
        top(1.0, 0.35),
        top(-1.0, 0.35),
    ];
    expect_parallel(&across, &base, Vec3::z(), &overlap);
}

#[test]
fn an_edge_on_a_face_touches_at_its_two_ends() {
    let base = box_corners([4.0, 4.0, 1.0]);
    let roof = [
        (-1.0, 0.0, 0.0),
        (0.5, 0.3, 0.0),
        (0.0, 1.0, 1.0),
        (0.0, -1.0, 1.2),
    ];
    let roof: Vec<Vec3> = roof
        .iter()
        .map(|&(x, y, z)| Vec3::new(x, y, z + 0.5))
        .collect();
    expect_parallel(&roof, &base, Vec3::z(), &roof[..2]);
    let feet: Vec<Vec3> = roof[..2].to_vec();
    expect_parallel(&base, &roof, -Vec3::z(), &feet);
    // Half over the rim: one end, and the crossing with the rim.
    let over = shifted(&roof, Vec3::new(2.0, 0.0, 0.0));
    let rim = Vec3::new(2.0, 0.2, 0.5);
    expect_parallel(&over, &base, Vec3::z(), &[over[0], rim]);
}

/// Fig. 17: an edge on an edge is (a) a pair of edge/point, (b) one of each, (c) a pair of point/edge contacts.
#[test]
fn planar_edge_on_edge_is_two_contacts() {
    use ContactMode::{EdgePoint, PointEdge};
    let rectangle = |low: f64, high: f64, bottom: f64| -> Vec<Vec3> {
        [(low, 0.0), (high, 0.0), (high, 1.0), (low, 1.0)]
            .map(|(x, y)| Vec3::new(x, y + bottom, 0.0))
            .into()
    };
    let s = rectangle(0.0, 2.0, -1.0);
    let cases = [
        (
            rectangle(-1.0, 3.0, 0.0),
            [(0.0, EdgePoint), (2.0, EdgePoint)],
        ),
        (
            rectangle(-1.0, 1.0, 0.0),
            [(0.0, EdgePoint), (1.0, PointEdge)],
        ),
        (
            rectangle(0.5, 1.5, 0.0),
            [(0.5, PointEdge), (1.5, PointEdge)],
        ),
    ];
    let mut random = Random::new(13);
    for (r, want) in cases {
        for gap in [0.0, 1e-9, 1e-4, 0.5] {
            for turn in 0..10 {
                let common = if turn == 0 {
                    Pose::identity()
                } else {
                    random.planar_pose(2.0)
                };
                let lifted = common.compose(&Pose::from_translation(Vec3::y() * gap));
                let (a, b) = (
                    planar(std::slice::from_ref(&r)),
                    planar(std::slice::from_ref(&s)),
                );
                let list = QueryContext::new()
                    .pair_witnesses((&a.body, &lifted), (&b.body, &common), gap + 0.1, 10)
                    .unwrap();
                let size = pair_size(&a, &lifted, &b, &common);
                let points = want.map(|(x, _)| lifted.transform_point(&Vec3::new(x, 0.0, 0.0)));
                expect_contacts(&list, &points, gap, size);
                for (point, (_, mode)) in points.iter().zip(want) {
                    let near = |c: &&ContactRecord| (c.points[0] - point).norm() <= 1e-9;
                    let contact = list.contacts.iter().find(near).unwrap();
                    assert_eq!(contact.mode, mode, "gap {gap} turn {turn}");
                }
            }
        }
    }
}
