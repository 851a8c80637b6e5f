//! Every face of every model is sound, and the closed models are closed.

mod support;

use std::collections::{BTreeMap, BTreeSet};

use cstk_scenes::*;
use support::{area_vector, cross, dot, minus, norm, polygons};

fn closed_models() -> Vec<(&'static str, Mesh)> {
    vec![
        ("robot base", robot_base()),
        ("lamp", lamp()),
        ("teapot", teapot()),
        ("gear", gear()),
        ("plate", plate()),
        ("motor", motor()),
        ("lamps", lamps(5, 1)),
        ("robot bases", robot_bases(44, 1)),
        ("stalagmite", stalagmite(1)),
        ("bumpy sphere of 100", bumpy_sphere(100, 1)),
        ("bumpy sphere of 276", bumpy_sphere(276, 2)),
        ("bumpy sphere of 50,000", bumpy_sphere(50_000, 3)),
        ("bumpy sphere of 1,000,000", bumpy_sphere(1_000_000, 4)),
        ("spaghetti", spaghetti(30_000, 1)),
    ]
}

fn open_models() -> Vec<(&'static str, Mesh)> {
    vec![
        ("floor and screws", floor_and_screws(20_000, 1)),
        ("nested shells", nested_shells(5000)),
        ("coincident", coincident(100)),
    ]
}

fn scenes() -> Vec<Scene> {
    let mut scenes = vec![free_lamp(), teapot_contacts(), gear_plate_motor()];
    for seed in 1..4 {
        scenes.extend([
            free_lamp_seeded(seed),
            teapot_contacts_seeded(seed),
            gear_plate_motor_seeded(seed),
        ]);
    }
    scenes.push(bumpy_pair(2000, 1).scene);
    scenes.push(bumpy_pair_coherent(2000, 0.01, 1));
    scenes.extend((1..4).map(|seed| scattered(500, seed)));
    scenes.extend(scenes.clone().iter().map(|s| s.turned(11)));
    scenes
}

/// Panics unless every face is a convex planar polygon with distinct corners and an area.
fn check_faces(name: &str, mesh: &Mesh) {
    for (index, corners) in polygons(mesh).iter().enumerate() {
        let what = || format!("{name}, face {index}: {corners:?}");
        let n = corners.len();
        assert!(n >= 3, "{}", what());
        let normal = area_vector(corners);
        let area = norm(normal);
        let unit = normal.map(|x| x / area);
        let centre: Point =
            std::array::from_fn(|k| corners.iter().map(|p| p[k]).sum::<f64>() / n as f64);
        let far = norm(centre);
        let mut diameter = 0.0f64;
        for (i, &p) in corners.iter().enumerate() {
            for &q in &corners[..i] {
                assert_ne!(p, q, "repeated corner, {}", what());
                diameter = diameter.max(norm(minus(p, q)));
            }
        }
        assert!(area > 1e-5 * diameter * diameter, "no area, {}", what());
        for i in 0..n {
            let (p, q, r) = (corners[i], corners[(i + 1) % n], corners[(i + 2) % n]);
            let height = dot(minus(p, centre), unit).abs();
            // What a face far from the origin has from the rounding of its coordinates is no bend.
            let limit = 1e-13 * diameter + 1e-15 * far;
            assert!(height < limit, "bent by {height:e}, {}", what());
            let (a, b) = (minus(q, p), minus(r, q));
            let turn = dot(cross(a, b), unit) / (norm(a) * norm(b));
            assert!(turn > 1e-4, "turns by {turn:e}, {}", what());
        }
    }
}

/// The index of the connected part of each vertex.
fn parts(mesh: &Mesh) -> Vec<usize> {
    let mut parent: Vec<usize> = (0..mesh.vertices.len()).collect();
    fn root(parent: &mut [usize], mut v: usize) -> usize {
        while parent[v] != v {
            parent[v] = parent[parent[v]];
            v = parent[v];
        }
        v
    }
    for face in &mesh.faces {
        let first = root(&mut parent, face[0] as usize);
        for &v in face {
            let other = root(&mut parent, v as usize);
            parent[other] = first;
        }
    }
    (0..parent.len()).map(|v| root(&mut parent, v)).collect()
}

/// Panics unless every edge is used once each way and every connected part has its outside outside.
fn check_closed(name: &str, mesh: &Mesh) {
    let mut edges = BTreeSet::new();
    for face in &mesh.faces {
        for (i, &v) in face.iter().enumerate() {
            let next = face[(i + 1) % face.len()];
            assert!(edges.insert((v, next)), "{name}: edge {v} {next} twice");
        }
    }
    for &(v, w) in &edges {
        assert!(edges.contains(&(w, v)), "{name}: edge {v} {w} is open");
    }
    let parts = parts(mesh);
    let mut volumes = BTreeMap::new();
    for face in &mesh.faces {
        let part = parts[face[0] as usize];
        let origin = mesh.vertices[part];
        let corner = |i: usize| minus(mesh.vertices[face[i] as usize], origin);
        for i in 1..face.len() - 1 {
            let six = dot(corner(0), cross(corner(i), corner(i + 1)));
            *volumes.entry(part).or_insert(0.0) += six / 6.0;
        }
    }
    for (part, volume) in volumes {
        assert!(
            volume > 0.0,
            "{name}: part of vertex {part} has volume {volume}"
        );
    }
}

/// Panics if two vertices have the same coordinates, so that adjacency by coordinates is adjacency by index.
fn check_distinct(name: &str, mesh: &Mesh) {
    // Adding 0 makes one of the two zeros.
    let bits = |p: &Point| p.map(|x| (x + 0.0).to_bits());
    let distinct: BTreeSet<[u64; 3]> = mesh.vertices.iter().map(bits).collect();
    assert_eq!(distinct.len(), mesh.vertices.len(), "{name}");
}

fn check_all_used(name: &str, mesh: &Mesh) {
    let used: BTreeSet<u32> = mesh.faces.iter().flatten().copied().collect();
    assert_eq!(used.len(), mesh.vertices.len(), "{name}");
}

#[test]
fn faces_are_convex_and_planar() {
    for (name, mesh) in closed_models().iter().chain(&open_models()) {
        check_faces(name, mesh);
        check_all_used(name, mesh);
    }
}

#[test]
fn closed_models_are_closed_and_face_outward() {
    for (name, mesh) in closed_models() {
        check_closed(name, &mesh);
        check_distinct(name, &mesh);
    }
}

#[test]
fn bodies_of_the_scenes_are_sound() {
    for scene in scenes() {
        for mesh in scene.obstacles.iter().chain([&scene.moving]) {
            check_faces(&scene.name, mesh);
            check_closed(&scene.name, mesh);
            check_distinct(&scene.name, mesh);
        }
    }
}

#[test]
fn bodies_of_the_workcell_are_sound() {
    for mesh in puma_random(1).obstacles {
        check_faces("workcell", &mesh);
        check_closed("workcell", &mesh);
        check_distinct("workcell", &mesh);
    }
}

#[test]
fn screws_are_closed() {
    let mut mesh = floor_and_screws(2001, 8);
    mesh.faces.remove(0);
    check_closed("screws", &mesh);
}

#[test]
fn connected_surfaces_are_one_part() {
    for mesh in [stalagmite(3), bumpy_sphere(1000, 3), gear()] {
        let parts = parts(&mesh);
        assert!(parts.iter().all(|&part| part == parts[0]));
    }
}

#[test]
fn the_same_seed_gives_the_same_mesh_and_another_another() {
    let makers: [fn(u64) -> Mesh; 6] = [
        |seed| lamps(5, seed),
        |seed| robot_bases(10, seed),
        stalagmite,
        |seed| bumpy_sphere(1000, seed),
        |seed| spaghetti(600, seed),
        |seed| floor_and_screws(1000, seed),
    ];
    for make in makers {
        assert!(make(5) == make(5) && make(5) != make(6));
    }
}

#[test]
fn bumpy_spheres_have_no_slivers() {
    for corners in polygons(&bumpy_sphere(20_000, 5)) {
        let longest = (0..3).map(|i| norm(minus(corners[i], corners[(i + 1) % 3])));
        let longest = longest.fold(0.0, f64::max);
        assert!(norm(area_vector(&corners)) > 0.3 * longest * longest);
    }
}
