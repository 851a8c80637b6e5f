//! Bodies inside solid bodies: containment counts as interference (FCL issues 492, 78, 628 and their like: "a mesh has no
//! inside").

use std::collections::BTreeSet;
use std::sync::Arc;

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Distance, DistanceKind, QueryContext, Witness};

use helpers::checked::at;
use helpers::random::Random;
use helpers::shapes::box_corners;
use helpers::surfaces::*;

fn distance(a: (&Arc<Body>, &Pose), b: (&Arc<Body>, &Pose)) -> Distance {
    QueryContext::new()
        .pair_distance((a.0, a.1), (b.0, b.1), f64::INFINITY)
        .unwrap()
}

fn within(a: (&Arc<Body>, &Pose), b: (&Arc<Body>, &Pose), threshold: f64) -> bool {
    QueryContext::new()
        .pair_within((a.0, a.1), (b.0, b.1), threshold)
        .unwrap()
}

/// Everything that is said of a body that is wholly inside another, in either order of the two.
fn check_contained(inner: (&Arc<Body>, &Pose), outer: (&Arc<Body>, &Pose), primitives: [u32; 2]) {
    for (a, b, primitives) in [
        (inner, outer, primitives),
        (outer, inner, [primitives[1], primitives[0]]),
    ] {
        let found = distance(a, b);
        assert_eq!(found.kind, DistanceKind::Exact);
        assert_eq!((found.distance, found.lower), (0.0, 0.0));
        assert!(found.upper < 1e-12 * (1.0 + a.1.translation.norm() + b.1.translation.norm()));
        let witness = found.witness.unwrap();
        assert!(witness.contained && witness.overlapping);
        assert_eq!((witness.contact_count, witness.distance), (0, 0.0));
        assert_eq!(witness.primitives, primitives);
        assert!(found.contact.is_none());
        let [p, q] = found.points;
        assert_eq!(p, q);
        let seen = inner.1.inverse().transform_point(&p);
        let vertices = inner.0.primitives().iter().flat_map(|p| p.vertices);
        let mut off = vertices.map(|v| (v + inner.0.center() - seen).norm());
        assert!(off.any(|off| off < 1e-12 * (1.0 + p.norm())));
        assert!(within(a, b, 0.0) && within(a, b, 1.0));
        let list = QueryContext::new().pair_penetration((a.0, a.1), (b.0, b.1), 9);
        assert!(list.unwrap().penetrations.is_empty());
    }
}

/// The surfaces of the two are this far apart, and neither is inside the other.
fn check_apart(a: (&Arc<Body>, &Pose), b: (&Arc<Body>, &Pose), expected: f64) {
    for (a, b) in [(a, b), (b, a)] {
        let found = distance(a, b);
        let size = 1.0 + a.1.translation.norm() + b.1.translation.norm();
        assert!(
            (found.distance - expected).abs() < 1e-14 * size,
            "{}, not {expected}",
            found.distance
        );
        assert!(found.lower > 0.0 && !found.witness.unwrap().contained);
        assert!(!within(a, b, 0.999 * expected) && within(a, b, 1.001 * expected));
    }
}

/// LIVE at the peers: FCL and Coal answer 0.8, and no collision.
/// Case A34 of docs/cases.md.
#[test]
fn a_cube_inside_a_cube() {
    let mut random = Random::new(81);
    let [small, large] = [0.2, 1.0].map(|half| [surface(&[cube(half)]), solid(&[cube(half)])]);
    let here = Pose::identity();
    for k in 0..20 {
        let common = match k {
            0 => here,
            _ => random.pose(2.0),
        };
        let own = match k {
            0 => here,
            _ => Pose {
                rotation: random.rotation(),
                translation: random.point(0.6),
            },
        };
        let inner_pose = common.compose(&own);
        for inner in &small {
            check_contained((inner, &inner_pose), (&large[1], &common), [0, 0]);
        }
    }
    // Surfaces have no inside, and the small one is not around the large one.
    for inner in &small {
        check_apart((inner, &here), (&large[0], &here), 0.8);
    }
    // The pairs of primitives are those of surfaces.
    let pairs = |outer: &Body| {
        let list = QueryContext::new()
            .pair_witnesses((&small[0], &here), (outer, &here), 1.0, 99)
            .unwrap();
        let pairs = list.witnesses.into_iter().filter(|w| !w.contained);
        pairs
            .map(|w| (w.primitives, w.distance))
            .collect::<Vec<_>>()
    };
    assert!(pairs(&large[0]).len() > 6);
    assert_eq!(pairs(&large[1]), pairs(&large[0]));
    // Turned inside out it is the same solid.
    let back = solid(&[inside_out(&cube(1.0))]);
    check_contained((&small[0], &here), (&back, &here), [0, 0]);
}

#[test]
fn hollow_bodies_have_a_void() {
    let small = [solid(&[cube(0.1)]), surface(&[cube(0.1)])];
    let here = Pose::identity();
    let hollow = solid(&hollow_cube());
    assert_eq!(hollow.pieces().list.len(), 2);
    let common = Random::new(82).pose(3.0);
    for inner in &small {
        let place = |x: f64, y: f64| common.compose(&at(x, y, 0.0));
        for y in [0.0, 0.35, -0.75] {
            check_contained((inner, &place(0.8, y)), (&hollow, &common), [0, 0]);
        }
        check_apart((inner, &place(0.0, 0.0)), (&hollow, &common), 0.5);
        check_apart((inner, &place(0.2, 0.0)), (&hollow, &common), 0.3);
        check_apart((inner, &place(2.0, 0.5)), (&hollow, &common), 0.9);
        for x in [0.6, 0.95] {
            let found = distance((inner, &place(x, 0.01)), (&hollow, &common));
            assert_eq!((found.distance, found.lower), (0.0, 0.0));
            assert!(!found.witness.unwrap().contained);
        }
    }
    // What fills the void without touching is outside; what is around everything has it all inside.
    check_apart((&solid(&[cube(0.5)]), &here), (&hollow, &here), 0.1);
    let around = solid(&[shifted(&cube(3.0), [0.5, 0.0, 0.0])]);
    check_contained((&hollow, &here), (&around, &here), [0, 0]);
    // Shells that face the same way fill the void.
    let filled = solid(&[cube(1.0), cube(0.6)]);
    check_contained((&small[0], &here), (&filled, &here), [0, 0]);
}

#[test]
fn the_hole_of_a_torus_is_outside() {
    let mut random = Random::new(83);
    let ring = torus(2.0, 0.8, 40, 20);
    let (wheel, flat_wheel) = (solid_one(&ring), surface_one(&ring));
    let ball = solid(&[sphere(0.3, 10)]);
    let here = Pose::identity();
    let in_hole = distance((&ball, &here), (&wheel, &here));
    assert!((in_hole.distance - 0.9).abs() < 0.02 && in_hole.lower > 0.8);
    check_contained((&ball, &at(1.4, 1.4, 0.1)), (&wheel, &here), [0, 0]);
    let mut counts = [0; 3];
    for _ in 0..400 {
        let mut pose = random.pose(2.6);
        pose.translation.z *= 0.4;
        let found = distance((&ball, &pose), (&wheel, &here));
        let apart = distance((&ball, &pose), (&flat_wheel, &here));
        let turns = turns_around(&ring, &pose.translation).round();
        let (case, expected) = match apart.distance > 0.0 {
            true if turns != 0.0 => (0, 0.0),
            true => (1, apart.distance),
            false => (2, 0.0),
        };
        assert_eq!(found.distance, expected);
        assert_eq!(found.witness.unwrap().contained, case == 0);
        counts[case] += 1;
    }
    assert!(counts.iter().all(|count| *count > 30), "{counts:?}");
}

/// A solid of convex shape is as far from others as its hull.
#[test]
fn convex_solids_are_as_far_as_their_hulls() {
    let mut random = Random::new(84);
    let as_hull = |mesh: &Mesh| {
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_polyhedron(&mesh.vertices, 0).unwrap();
        build(&builder).unwrap()
    };
    let mut contained = [0; 2];
    for (scale, offset) in [(1.0, 0.0), (1.0, 1e6), (1e-6, 0.0), (1e6, 0.0)] {
        for k in 0..200 {
            let [a, b] = [0, 1].map(|_| {
                let stretch = Vec3::from_fn(|_, _| random.within(0.1, 1.0));
                let mesh = if random.below(2) == 0 {
                    cube(1.0)
                } else {
                    sphere(1.0, 5)
                };
                let stretched = mesh
                    .vertices
                    .iter()
                    .map(|v| v.component_mul(&stretch) * scale);
                Mesh {
                    vertices: stretched.collect(),
                    ..mesh
                }
            });
            let [pose_a, pose_b] = [0, 1].map(|_| {
                let mut pose = random.pose([0.2, 1.0][k % 2] * scale);
                pose.translation += Vec3::new(1.0, 0.5, 0.2) * offset;
                pose
            });
            let solids = [solid_one(&a), solid_one(&b)];
            let hulls = [as_hull(&a), as_hull(&b)];
            let found = distance((&solids[0], &pose_a), (&solids[1], &pose_b));
            let truth = distance((&hulls[0], &pose_a), (&hulls[1], &pose_b));
            assert!((found.distance - truth.distance).abs() <= 1e-12 * scale);
            assert_eq!(found.distance == 0.0, truth.distance == 0.0);
            if found.witness.unwrap().contained {
                // Every vertex of one is inside the other.
                let holds = |outer: &Body, inner: &Mesh, place: Pose| {
                    inner.vertices.iter().all(|v| {
                        let p = place.transform_point(v) - outer.center();
                        let shape = outer.primitives().get(0).shape;
                        shape.faces.iter().all(|face| {
                            let corner = shape.vertices[face.vertices[0] as usize];
                            face.normal.dot(&(p - corner)) < 1e-12 * scale + 1e-15 * offset
                        })
                    })
                };
                let b_in_a = pose_a.inverse().compose(&pose_b);
                let first = holds(&hulls[0], &b, b_in_a);
                assert!(first || holds(&hulls[1], &a, b_in_a.inverse()));
                contained[usize::from(first)] += 1;
            }
        }
    }
    assert!(contained.iter().all(|count| *count > 10), "{contained:?}");
}

/// Many pieces, of all kinds: each that is inside is a witness, none that is not, and their pairs are as before.
#[test]
fn each_piece_inside_is_a_witness() {
    let mut random = Random::new(85);
    let ring = torus(2.0, 0.8, 24, 12);
    let (wheel, flat_wheel) = (solid_one(&ring), surface_one(&ring));
    let mut total = 0;
    for round in 0..12 {
        let mut builder = BodyBuilder::new(3).unwrap();
        let mut pieces: Vec<(u32, Arc<Body>)> = Vec::new();
        for k in 0..40 {
            let place = random.pose(2.4);
            let mut alone = BodyBuilder::new(3).unwrap();
            let lowest = builder.len() as u32;
            for builder in [&mut builder, &mut alone] {
                let points = |corners: &[Vec3]| -> Vec<Vec3> {
                    corners.iter().map(|p| place.transform_point(p)).collect()
                };
                let corners = points(&box_corners([0.1, 0.2, 0.3]));
                match k % 4 {
                    0 => builder.add_mesh(&moved(&cube(0.15), &place)).unwrap(),
                    1 => builder.add_polyhedron(&corners, 0).unwrap(),
                    2 => builder.add_polyhedron(&corners[..2], 0).unwrap(),
                    _ => builder.add_polyhedron(&corners[..1], 0).unwrap(),
                }
            }
            pieces.push((lowest, build(&alone).unwrap()));
        }
        let body = build(&builder).unwrap();
        assert_eq!(body.pieces().list.len(), pieces.len());
        let [pose, other] = [random.pose(1.0), random.pose(1.0)];
        let here = other.inverse().compose(&pose);
        let mut expected = BTreeSet::new();
        for (lowest, alone) in &pieces {
            let apart = distance((alone, &here), (&flat_wheel, &Pose::identity()));
            let vertex = alone.primitives().get(0).vertices[0] + alone.center();
            let turns = turns_around(&ring, &here.transform_point(&vertex));
            if apart.distance > 0.0 && turns.round() != 0.0 {
                expected.insert(*lowest);
            }
        }
        total += expected.len();
        let list = |wheel: &Body, epsilon: f64, most: usize| {
            QueryContext::new()
                .pair_witnesses((&body, &pose), (wheel, &other), epsilon, most)
                .unwrap()
        };
        for epsilon in [0.0, 0.05] {
            let found = list(&wheel, epsilon, 100_000);
            let (inside, rest): (Vec<&Witness>, Vec<&Witness>) =
                found.witnesses.iter().partition(|w| w.contained);
            let lowest: Vec<u32> = inside.iter().map(|w| w.primitives[0]).collect();
            assert_eq!(lowest, Vec::from_iter(expected.iter().copied()), "{round}");
            assert!(inside.iter().all(|w| w.distance == 0.0 && w.overlapping));
            assert!(inside.iter().all(|w| w.primitives[1] == 0));
            let before = list(&flat_wheel, epsilon, 100_000);
            let keys = |list: &mut dyn Iterator<Item = &Witness>| -> Vec<([u32; 2], f64)> {
                list.map(|w| (w.primitives, w.distance)).collect()
            };
            assert_eq!(
                keys(&mut rest.into_iter()),
                keys(&mut before.witnesses.iter())
            );
            // Cut short, it is the first of the whole.
            let few = list(&wheel, epsilon, 5);
            assert_eq!(
                keys(&mut few.witnesses.iter()),
                keys(&mut found.witnesses.iter().take(5))
            );
        }
        // The distance names the first of those at 0.
        let nearest = distance((&body, &pose), (&wheel, &other));
        let first = &list(&wheel, 0.0, 1).witnesses[0];
        let witness = nearest.witness.unwrap();
        assert_eq!(witness.primitives, first.primitives);
        assert_eq!(witness.contained, first.contained);
    }
    assert!(total > 30, "{total}");
}
