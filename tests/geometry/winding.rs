//! How solids' boundaries wind around points, against sums of solid angles.

use cstk::body::{Body, Mesh};
use cstk::hierarchy::{Grouping, WrapperKind};
use cstk::pair::{RayScratch, winding};
use cstk::pose::{Pose, Vec3};
use cstk_scenes as scenes;

use helpers::models::{built, options};
use helpers::random::Random;
use helpers::surfaces::*;

fn generated(mesh: &scenes::Mesh) -> Mesh {
    let faces: Vec<Vec<u32>> = mesh.faces.clone();
    helpers::surfaces::mesh(
        mesh.vertices.iter().map(|p| Vec3::from(*p)).collect(),
        &faces,
    )
}

/// Compares at points of the body's own frame. Returns how many are inside, of how many that were compared.
fn compare(mesh: &Mesh, body: &Body, points: impl Iterator<Item = Vec3>) -> [usize; 2] {
    let mut scratch = RayScratch::default();
    let mut counts = [0; 2];
    // Seen from where the body has its origin, so that nothing is lost on the way there.
    let centred = shifted(mesh, (-body.center()).into());
    for p in points {
        let turns = turns_around(&centred, &p);
        if turns.is_nan() {
            continue;
        }
        assert!((turns - turns.round()).abs() < 1e-6, "{turns} at {p:?}");
        let found = winding(body, &p, &mut scratch).number;
        assert_eq!(f64::from(found), turns.round(), "at {p:?}: {turns}");
        counts[0] += usize::from(found != 0);
        counts[1] += 1;
    }
    counts
}

fn random_points(random: &mut Random, body: &Body, count: usize) -> Vec<Vec3> {
    let extent = body.solid().unwrap().extent();
    let size = extent.size();
    let mut one = || {
        let within = |k: usize, x: f64| extent.low[k] + x * size[k];
        let share = Vec3::from_fn(|_, _| random.within(-0.05, 1.05));
        Vec3::from_fn(|k, _| within(k, share[k]))
    };
    (0..count).map(|_| one()).collect()
}

/// Points from which rays along the axes go through vertices and along edges.
fn aligned_points(random: &mut Random, body: &Body, count: usize) -> Vec<Vec3> {
    let primitives = body.primitives();
    let size = body.radius();
    (0..count)
        .map(|i| {
            let ring = primitives.get(random.below(primitives.len())).vertices;
            let k = random.below(ring.len());
            let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
            let mut p = match i % 3 {
                0 => a,
                1 => (a + b) * 0.5,
                // Where three such rays meet, as likely as not.
                _ => Vec3::new(a.x, b.y, ring[random.below(ring.len())].z),
            };
            p[random.below(3)] += random.within(-size, size);
            p
        })
        .collect()
}

#[test]
fn bumpy_and_branched_surfaces() {
    let mut random = Random::new(71);
    let meshes = [
        ("bumpy", generated(&scenes::bumpy_sphere(1200, 3))),
        ("gear", generated(&scenes::gear())),
        ("teapot", generated(&scenes::teapot())),
        ("plate", generated(&scenes::plate())),
        ("torus", torus(1.0, 0.4, 24, 12)),
        ("robot base", generated(&scenes::robot_base())),
    ];
    for (name, mesh) in meshes {
        let body = solid_one(&mesh);
        let points = random_points(&mut random, &body, 1500);
        let [inside, all] = compare(&mesh, &body, points.into_iter());
        assert!(inside > 20 && all > 1400, "{name}: {inside} of {all}");
        let points = aligned_points(&mut random, &body, 1500);
        let [_, all] = compare(&mesh, &body, points.into_iter());
        assert!(all > 800, "{name}: {all}");
    }
}

/// Every point of a lattice on which the vertices lie too: rays hit vertices and edges, and run in faces.
#[test]
fn rays_through_vertices_and_in_faces() {
    let twin = |by: [f64; 3]| shifted(&cube(0.5), by);
    // Two that share an edge, one that shares a face with the first, one over their corner, and one apart.
    let mesh = joined(&[
        twin([0.0, 0.0, 0.0]),
        twin([1.0, 1.0, 0.0]),
        twin([0.0, 0.0, 1.0]),
        twin([1.0, 1.0, 1.0]),
        twin([3.0, 0.0, 0.0]),
    ]);
    let body = solid_one(&mesh);
    let mut points = Vec::new();
    for i in 0..20 {
        for j in 0..12 {
            for k in 0..12 {
                let p = Vec3::new(f64::from(i), f64::from(j), f64::from(k)) * 0.25;
                points.push(p - Vec3::new(0.75, 0.75, 0.75) - body.center());
            }
        }
    }
    let [inside, all] = compare(&mesh, &body, points.into_iter());
    assert_eq!(inside, 5 * 27);
    assert!(all > 1500, "{all}");
}

/// Slender faces have several leaves, and count once.
#[test]
fn slender_faces() {
    let mut random = Random::new(75);
    let mut mesh = cube(1.0);
    for vertex in &mut mesh.vertices {
        vertex.x *= 100.0;
    }
    let mut builder = builder(std::slice::from_ref(&mesh));
    builder.set_solid(true);
    let sliced = options(Grouping::Hybrid, WrapperKind::Hull, 2.0);
    let body = built(&builder, &sliced);
    assert!(body.packed().primitives().len() > 60);
    let points = random_points(&mut random, &body, 20_000);
    let [inside, all] = compare(&mesh, &body, points.into_iter());
    assert!(inside > 10_000 && all > 19_000, "{inside} of {all}");
}

fn joined(meshes: &[Mesh]) -> Mesh {
    let mut whole = Mesh::default();
    for mesh in meshes {
        let first = whole.vertices.len() as u32;
        whole.vertices.extend(&mesh.vertices);
        whole.face_sizes.extend(&mesh.face_sizes);
        whole.indices.extend(mesh.indices.iter().map(|i| i + first));
    }
    whole
}

/// The number itself: outward shells count up, inward ones down, whichever way the ray goes.
#[test]
fn shells_add_up() {
    let mut random = Random::new(72);
    let overlapping = [cube(1.0), shifted(&sphere(0.9, 8), [0.5, 0.3, 0.2])];
    let cases = [
        vec![cube(1.0)],
        vec![inside_out(&cube(1.0))],
        overlapping.to_vec(),
        vec![overlapping[0].clone(), inside_out(&overlapping[1])],
        hollow_cube(),
        vec![cube(1.0), cube(1.0)],
    ];
    for meshes in cases {
        let mesh = joined(&meshes);
        let body = solid(&meshes);
        let points = random_points(&mut random, &body, 2000);
        let [_, all] = compare(&mesh, &body, points.into_iter());
        assert!(all > 1900, "{all}");
    }
}

/// Far from the origin, tiny and huge: as near the unit scale.
#[test]
fn scales_and_offsets() {
    let mut random = Random::new(73);
    let given = generated(&scenes::bumpy_sphere(300, 5));
    for (scale, offset) in [
        (1.0, 1e6),
        (1e-6, 0.0),
        (1e-6, 1.0),
        (1e6, 1e6),
        (1e-40, 0.0),
        (1e45, 0.0),
    ] {
        let vertices = given.vertices.iter();
        let mesh = Mesh {
            vertices: vertices
                .map(|v| v * scale + Vec3::new(1.0, -0.7, 0.4) * offset)
                .collect(),
            ..given.clone()
        };
        let body = solid_one(&mesh);
        // The oracle multiplies three lengths: it is given lengths of about 1.
        let measured = Mesh {
            vertices: mesh
                .vertices
                .iter()
                .map(|v| (v - body.center()) / scale)
                .collect(),
            ..mesh.clone()
        };
        let mut scratch = RayScratch::default();
        let mut inside = 0;
        for p in random_points(&mut random, &body, 500) {
            let turns = turns_around(&measured, &(p / scale)).round();
            if turns.is_nan() {
                continue;
            }
            assert_eq!(f64::from(winding(&body, &p, &mut scratch).number), turns);
            inside += usize::from(turns != 0.0);
        }
        assert!(inside > 100, "{inside} at {scale:e}");
    }
}

/// A point 1e-9 of the size on either side of a face is on that side; the ray may run along the next face.
#[test]
fn points_near_faces() {
    let mut random = Random::new(74);
    let given = generated(&scenes::bumpy_sphere(600, 8));
    let turned = Pose {
        rotation: random.rotation(),
        translation: random.point(3.0),
    };
    for mesh in [given.clone(), moved(&given, &turned), cube(1.0)] {
        let body = solid_one(&mesh);
        let mut scratch = RayScratch::default();
        for primitive in body.primitives().iter() {
            let middle = primitive.vertices.iter().sum::<Vec3>() / primitive.vertices.len() as f64;
            for (height, inside) in [(1e-9, 0), (-1e-9, 1)] {
                let p = middle + primitive.shape.faces[0].normal * height;
                assert_eq!(winding(&body, &p, &mut scratch).number, inside);
            }
        }
    }
}
