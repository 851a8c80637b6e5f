//! Distances against brute force that proves itself, symmetric and the same wherever the pair is moved.

use cstk::body::{BodyBuilder, Mesh};
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::{Distance, DistanceKind};

use helpers::oracle::{Bounds, gap_along, hull_distance, moved_exactly};
use helpers::placed::{PlacedPrimitive, cold, dented, hull_at, shifted, size_of};
use helpers::random::Random;
use helpers::shapes::{Shape, box_corners, mesh, planar};

/// Bounds of the distance of two unions, by brute force over their parts.
fn brute_force(a: &PlacedPrimitive, b: &PlacedPrimitive) -> Bounds {
    let origin = a.pose.transform_point(a.shape.body.center());
    let parts_a = a.shape.placed(&a.pose, &origin);
    let parts_b = b.shape.placed(&b.pose, &origin);
    let mut all = Bounds {
        gap: f64::INFINITY,
        upper: f64::INFINITY,
    };
    for part_a in &parts_a {
        for part_b in &parts_b {
            let bounds = hull_distance(part_a, part_b);
            all.gap = all.gap.min(bounds.gap);
            all.upper = all.upper.min(bounds.upper);
        }
    }
    all
}

/// The distance lies within the brute-force bounds, which leave no room; its points are as far apart and lie in the
/// bodies; the contact's normal proves it.
fn certified(a: &PlacedPrimitive, b: &PlacedPrimitive) -> Distance {
    let found = cold(a, b);
    let size = size_of(a, b);
    let accepted = 1e-12 * size;
    let truth = brute_force(a, b);
    assert!(
        truth.upper - truth.lower() <= accepted,
        "the oracle is not sure: {truth:?}, L = {size}"
    );
    let d = found.distance;
    assert_eq!(found.kind, DistanceKind::Exact);
    assert!(
        d >= truth.lower() - accepted && d <= truth.upper + accepted,
        "got {d:e}, brute force {truth:?}, L = {size}"
    );
    assert!(found.lower <= d && d <= found.upper);
    // The bounds hold the truth, but for the rounding of the oracle's own.
    let oracle = 16.0 * f64::EPSILON * size;
    assert!(
        found.lower <= truth.upper + oracle && found.upper >= truth.lower() - oracle,
        "{truth:?} is not within {:e} to {:e}",
        found.lower,
        found.upper
    );
    let witness = found.witness.expect("a distance has a witness");
    let [p, q] = found.points;
    // A point in the world is rounded to its own coordinates, which L does not count.
    let slack = accepted + 4.0 * f64::EPSILON * p.amax().max(q.amax());
    assert!(((p - q).norm() - d).abs() <= slack);
    let origin = a.pose.transform_point(a.shape.body.center());
    let part = |placed: &PlacedPrimitive, k: usize| {
        placed.shape.placed(&placed.pose, &origin)[witness.primitives[k] as usize].clone()
    };
    let parts = [part(a, 0), part(b, 1)];
    for (part, point) in parts.iter().zip([p, q]) {
        let off = hull_distance(part, &[point - origin]).upper;
        assert!(off <= slack, "a point is {off:e} off its body, L = {size}");
    }
    match &found.contact {
        Some(contact) => {
            assert!((contact.normal.norm() - 1.0).abs() <= 1e-14);
            let gap = gap_along(&parts[0], &parts[1], &contact.normal);
            // The normal is promised through the gradient, to 1e-6; the brute-force bounds prove the distance itself. A pair
            // may overlap by 1e-6 L and still have a contact, whose clearance says how deep.
            let least = if d == 0.0 {
                assert!((-1e-6 * size..=0.0).contains(&contact.clearance));
                contact.clearance - 1e-10 * size
            } else {
                d - 1e-9 * size
            };
            assert!(
                gap >= least,
                "the normal proves {gap:e} of {d:e}, L = {size}"
            );
            assert!(!witness.overlapping);
        }
        None => assert!(d == 0.0 && witness.overlapping, "no contact at {d:e}"),
    }
    found
}

/// [`certified`], and the same in either order and after a common rigid motion.
fn lawful(a: &PlacedPrimitive, b: &PlacedPrimitive, random: &mut Random) -> Distance {
    let found = certified(a, b);
    let size = size_of(a, b);
    let accepted = 1e-12 * size;
    let back = cold(b, a);
    assert!(
        (back.distance - found.distance).abs() <= accepted,
        "{:e} one way, {:e} the other",
        found.distance,
        back.distance
    );
    // The motion's own rounding is that of coordinates no larger than L.
    let common = Pose {
        rotation: random.rotation(),
        translation: random.point(1.0) * size,
    };
    let reach = a.pose.translation.amax().max(b.pose.translation.amax());
    let apart = cold(&a.moved(&common), &b.moved(&common)).distance;
    assert!(
        (apart - found.distance).abs() <= accepted + 8.0 * f64::EPSILON * reach,
        "{:e} here, {apart:e} after a motion",
        found.distance
    );
    found
}

fn scaled(points: &[Vec3], by: f64) -> Vec<Vec3> {
    points.iter().map(|p| p * by).collect()
}

/// Random hulls of four to nine points: far, near, overlapping, and brought to touch along their own normal.
#[test]
fn hulls_far_near_overlapping_and_touching() {
    let mut random = Random::new(1);
    let (mut apart, mut overlapping) = (0, 0);
    for i in 0..300 {
        let (n, m) = (4 + random.below(6), 4 + random.below(6));
        let a = hull_at(&random.points(n, 1.0), random.pose(0.5));
        let reach = [10.0, 2.0, 1.0][i % 3];
        let mut b = hull_at(&random.points(m, 1.0), random.pose(reach));
        let found = lawful(&a, &b, &mut random);
        if found.distance == 0.0 {
            overlapping += 1;
            continue;
        }
        apart += 1;
        let away = found.contact.unwrap().normal * found.distance;
        for share in [
            1.0 - 1e-3,
            1.0 - 1e-8,
            1.0 - 1e-12,
            1.0,
            1.0 + 1e-12,
            1.0 + 1e-8,
        ] {
            let start = b.pose.translation;
            b.pose.translation += away * share;
            lawful(&a, &b, &mut random);
            b.pose.translation = start;
        }
    }
    assert!(apart > 100 && overlapping > 30, "{apart} {overlapping}");
}

/// Triangles as long as 1 and as wide as 1e-3 to 1e-9: slivers with a corner near the middle, needles with one near an
/// end.
fn thin_triangle(random: &mut Random) -> Vec<Vec3> {
    let width = 10f64.powf(random.within(-9.0, -3.0));
    let share = if random.below(2) == 0 {
        random.within(0.3, 0.7)
    } else {
        random.within(0.0, 1e-6)
    };
    let turn = random.rotation();
    [Vec3::zeros(), Vec3::x(), Vec3::new(share, width, 0.0)]
        .map(|p| turn * p)
        .into()
}

#[test]
fn needles_and_slivers() {
    let mut random = Random::new(2);
    for i in 0..400 {
        let one = thin_triangle(&mut random);
        let other = if i % 2 == 0 {
            thin_triangle(&mut random)
        } else {
            random.points(3, 1.0)
        };
        let reach = [2.0, 0.3, 1e-3][i % 3];
        let (pose_a, pose_b) = (random.pose(0.2), random.pose(reach));
        let a = PlacedPrimitive::new(mesh(&one, &[[0, 1, 2]]), pose_a);
        let b = PlacedPrimitive::new(mesh(&other, &[[0, 1, 2]]), pose_b);
        lawful(&a, &b, &mut random);
        let (a, b) = (
            hull_at(&one, pose_a),
            hull_at(&random.points(6, 0.5), pose_b),
        );
        lawful(&a, &b, &mut random);
    }
}

/// Thin solids: a needle or sliver and one or two points off its plane, so that their faces are thin, too.
#[test]
fn thin_solids() {
    let mut random = Random::new(16);
    for i in 0..200 {
        let mut corners = thin_triangle(&mut random);
        let off = 10f64.powf(random.within(-8.0, 0.0));
        for _ in 0..1 + random.below(2) {
            let foot = (corners[0] + corners[1]) * 0.5;
            corners.push(foot + random.point(off));
        }
        let a = hull_at(&corners, random.pose(0.2));
        let b = hull_at(&random.points(6, 0.5), random.pose([2.0, 0.3][i % 2]));
        lawful(&a, &b, &mut random);
    }
}

/// No thin face of a mesh is lost: what is not kept is counted.
#[test]
fn thin_faces_are_kept() {
    let mut random = Random::new(17);
    for _ in 0..400 {
        let corners = thin_triangle(&mut random);
        let mut builder = BodyBuilder::new(3).unwrap();
        builder
            .add_mesh(&Mesh {
                vertices: corners.clone(),
                face_sizes: vec![3],
                indices: vec![0, 1, 2],
            })
            .unwrap();
        assert_eq!(builder.len(), 1, "{corners:?} is gone");
        builder.add_polygon(&corners, 0).unwrap();
        builder.add_polyhedron(&corners, 0).unwrap();
    }
}

/// Four points, or eight, within a slab or a rod of a millionth of its length are a solid like any other.
#[test]
fn flat_and_long_solids_are_built() {
    let mut random = Random::new(18);
    for exponent in 1..=6 {
        let thin = 10f64.powi(-exponent);
        for i in 0..60 {
            let (width, pose) = ([1.0, thin][i % 2], random.pose(1.0));
            let n = [4, 5, 8][i % 3];
            let mut points = random.points(n, 1.0);
            if i % 4 == 0 {
                points = box_corners([1.0; 3]);
            }
            let squeezed = Vec3::new(1.0, width, thin);
            let placed = |p: &Vec3| pose.transform_point(&p.component_mul(&squeezed));
            let points: Vec<Vec3> = points.iter().map(placed).collect();
            let built = BodyBuilder::new(3).unwrap().add_polyhedron(&points, 0);
            assert!(
                built.is_ok(),
                "{thin:e}, {width:e}: {built:?} of {points:?}"
            );
        }
    }
}

const TILTS: [f64; 12] = [
    1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14,
];

/// Edges that cross at small angles: of wedges, of triangles, and as bare segments.
#[test]
fn nearly_parallel_edges() {
    let mut random = Random::new(3);
    let wedge = [
        (-1.0, 0.0, 0.0),
        (1.0, 0.0, 0.0),
        (0.3, -0.5, -1.0),
        (-0.2, 0.6, -1.0),
    ]
    .map(|(x, y, z)| Vec3::new(x, y, z));
    for tilt in TILTS {
        for gap in [0.3, 1e-3, 1e-6, 1e-9, 0.0] {
            for corners in [2, 3, 4] {
                let across = rotation_about(&Vec3::z(), tilt) * rotation_about(&Vec3::x(), 3.1);
                let common = random.pose(1.0);
                let above = Pose {
                    rotation: across,
                    translation: Vec3::new(random.within(-0.5, 0.5), 0.0, gap),
                };
                let a = hull_at(&wedge[..corners], common.compose(&above));
                let b = hull_at(&wedge[..corners], common);
                lawful(&a, &b, &mut random);
            }
        }
    }
}

#[test]
fn nearly_parallel_faces() {
    let mut random = Random::new(4);
    let (small, large) = (box_corners([1.0, 0.8, 0.6]), box_corners([1.7, 1.3, 0.9]));
    for tilt in TILTS {
        for gap in [0.3, 1e-3, 1e-6, 1e-9, 0.0] {
            let common = random.pose(1.0);
            let lean =
                Vec3::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0), 0.0).normalize();
            let spin = rotation_about(&Vec3::z(), random.within(-3.0, 3.0));
            let above = Pose {
                rotation: rotation_about(&lean, tilt) * spin,
                translation: Vec3::new(
                    random.within(-0.6, 0.6),
                    random.within(-0.6, 0.6),
                    0.75 + gap,
                ),
            };
            let a = hull_at(&small, common.compose(&above));
            let b = hull_at(&large, common);
            lawful(&a, &b, &mut random);
            lawful(&b, &a, &mut random);
        }
    }
}

#[test]
fn coplanar_triangles() {
    let mut random = Random::new(5);
    let mut overlapping = 0;
    for i in 0..300 {
        let flat = |random: &mut Random, reach: f64| -> Vec<Vec3> {
            let away = Vec3::new(
                random.within(-reach, reach),
                random.within(-reach, reach),
                0.0,
            );
            shifted(&random.polygon(3, 1.0), away)
        };
        let (one, other) = (
            flat(&mut random, 0.0),
            flat(&mut random, [0.8, 2.0, 4.0][i % 3]),
        );
        let common = if i % 2 == 0 {
            Pose::identity()
        } else {
            random.pose(1.0)
        };
        let a = PlacedPrimitive::new(mesh(&one, &[[0, 1, 2]]), common);
        let b = PlacedPrimitive::new(mesh(&other, &[[0, 1, 2]]), common);
        let found = lawful(&a, &b, &mut random);
        overlapping += usize::from(found.distance == 0.0);
        // The same triangles as solids of the plane.
        if i % 2 == 0 {
            let a = PlacedPrimitive::new(planar(&[one]), common);
            let b = PlacedPrimitive::new(planar(&[other]), common);
            assert_eq!(certified(&a, &b).distance == 0.0, found.distance == 0.0);
        }
    }
    assert!(overlapping > 50, "{overlapping}");
}

#[test]
fn planar_unions() {
    let mut random = Random::new(6);
    for i in 0..200 {
        let mut union = |corners: usize| -> Shape {
            let parts: Vec<Vec<Vec3>> = (0..3)
                .map(|_| {
                    let away = Vec3::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0), 0.0);
                    shifted(&random.polygon(corners, 0.6), away)
                })
                .collect();
            planar(&parts)
        };
        let (one, other) = (union(3), union(6));
        let a = PlacedPrimitive::new(one, random.planar_pose(0.5));
        let b = PlacedPrimitive::new(other, random.planar_pose([1.0, 3.0, 10.0][i % 3]));
        certified(&a, &b);
        let common = random.planar_pose(1.0);
        let apart = cold(&a.moved(&common), &b.moved(&common)).distance;
        let slack = 1e-12 * size_of(&a, &b);
        assert!((apart - cold(&a, &b).distance).abs() <= slack);
        assert!((cold(&b, &a).distance - cold(&a, &b).distance).abs() <= slack);
    }
}

#[test]
fn all_scales() {
    let mut random = Random::new(7);
    for exponent in -6..=6 {
        let scale = 10f64.powi(exponent);
        for i in 0..40 {
            let (n, m) = (3 + random.below(6), 3 + random.below(6));
            let (one, other) = (random.points(n, 1.0), random.points(m, 1.0));
            let (mut pose_a, mut pose_b) = (random.pose(1.0), random.pose([4.0, 2.0][i % 2]));
            pose_a.translation *= scale;
            pose_b.translation *= scale;
            // Every fourth pair is of very unlike sizes.
            let unlike = if i % 4 == 0 { 1e-4 } else { 1.0 };
            let a = hull_at(&scaled(&one, scale), pose_a);
            let b = hull_at(&scaled(&other, scale * unlike), pose_b);
            lawful(&a, &b, &mut random);
        }
    }
}

/// Modelled 1e6 away from their own origins and placed as far from the world's, bodies measure as anywhere: L is what
/// they are after re-centring.
#[test]
fn bodies_far_from_their_origins() {
    let mut random = Random::new(8);
    for i in 0..120 {
        let mut far = |reach: f64| {
            let away = random.unit() * 1e6;
            let n = 4 + random.below(5);
            let points = shifted(&random.points(n, 1.0), away);
            let rotation = random.rotation();
            let world = Vec3::new(1e6, -2e6, 5e5) + random.point(reach);
            let pose = Pose {
                rotation,
                translation: world - rotation * away,
            };
            hull_at(&points, pose)
        };
        let (a, b) = (far(0.1), far([4.0, 1.5][i % 2]));
        assert!(size_of(&a, &b) < 20.0);
        certified(&a, &b);
        let slack = 1e-12 * size_of(&a, &b);
        assert!((cold(&a, &b).distance - cold(&b, &a).distance).abs() <= slack);
    }
}

#[test]
fn dented_meshes() {
    let mut random = Random::new(9);
    for i in 0..12 {
        let (one, other) = (dented(&mut random), dented(&mut random));
        let a = PlacedPrimitive::new(one, random.pose(0.5));
        let b = PlacedPrimitive::new(other, random.pose([6.0, 2.5, 1.0][i % 3]));
        lawful(&a, &b, &mut random);
    }
}

/// The oracle itself, on distances known in closed form.
#[test]
fn the_oracle_knows_the_known() {
    let unit = box_corners([1.0; 3]);
    let apart = hull_distance(&unit, &shifted(&unit, Vec3::new(3.0, 4.0, 0.0)));
    let want = 2f64.hypot(3.0);
    assert!((apart.gap - want).abs() <= 1e-15 && (apart.upper - want).abs() <= 1e-15);
    let deep = hull_distance(&unit, &shifted(&unit, Vec3::new(0.75, 0.1, 0.2)));
    assert!((deep.gap + 0.25).abs() <= 1e-15 && deep.upper == 0.0);
    let far = Pose::from_translation(Vec3::new(1e6 + 0.25, 0.0, 0.0));
    assert_eq!(
        moved_exactly(&Vec3::x(), &far, &(Vec3::x() * 1e6)),
        Vec3::x() * 1.25
    );
}
