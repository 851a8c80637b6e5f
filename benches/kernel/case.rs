//! What is asked: bodies, poses, and modes.

use cstk::body::Mesh;
use cstk::body::mesh_file::read_mesh_file;
use cstk::pose::{Mat3, Pose, Vec3};
use cstk_scenes as scenes;

#[derive(Clone, Copy, PartialEq)]
pub enum Mode {
    Distance,
    Within(f64),
    Collide,
}

impl Mode {
    pub fn name(self) -> String {
        match self {
            Mode::Distance => "D".into(),
            Mode::Within(threshold) => format!("I {threshold}"),
            Mode::Collide => "collide".into(),
        }
    }
}

/// How we are asked.
#[derive(Clone, Copy, PartialEq)]
pub enum Query {
    /// One body against one.
    Pair,
    /// A C-object: all links against all objects of an environment.
    CObject,
}

/// Moving bodies and obstacles, in a number of poses.
pub struct Case {
    pub name: String,
    pub query: Query,
    pub modes: Vec<Mode>,
    pub moving: Vec<Mesh>,
    pub obstacles: Vec<Mesh>,
    /// One pose of each moving body for each query.
    pub poses: Vec<Vec<Pose>>,
    /// Among the rows that the mean is of; else bodies are so far apart that all is culled at once.
    pub counts: fn(Mode) -> bool,
}

fn always(_: Mode) -> bool {
    true
}

/// The report's lamp stays so far off that only its distance takes work.
fn distance_only(mode: Mode) -> bool {
    mode == Mode::Distance
}

/// All the cases; with `quick`, the smaller ones. `seed` is added to those of the scenes.
pub fn cases(quick: bool, seed: u64) -> Vec<Case> {
    use Mode::{Collide, Distance, Within};
    let lamp = vec![Distance, Within(0.1), Collide];
    let teapot = vec![Distance, Within(0.01), Collide];
    let gear = vec![Distance, Within(0.0001), Within(0.00128), Collide];
    let random = vec![Distance, Within(0.001), Collide];
    let near = vec![Distance, Within(0.01), Collide];
    let pair = |modes: &[Mode], scene: scenes::Scene| Case::of(scene, Query::Pair, modes);
    let many = |modes: &[Mode], scene: scenes::Scene| Case::of(scene, Query::CObject, modes);
    let mut cases = vec![
        Case {
            counts: distance_only,
            ..pair(&lamp, scenes::free_lamp())
        },
        pair(&teapot, scenes::teapot_contacts()),
        pair(&gear, scenes::gear_plate_motor()),
        Case {
            counts: distance_only,
            ..pair(&lamp, scenes::free_lamp().turned(1 + seed))
        },
        pair(&teapot, scenes::teapot_contacts().turned(2 + seed)),
        pair(&gear, scenes::gear_plate_motor().turned(3 + seed)),
        pair(&random, scenes::bumpy_pair(20_000, 1 + seed).scene),
        many(&near, scenes::scattered(500, 1 + seed)),
    ];
    if !quick {
        cases.push(pair(&random, scenes::bumpy_pair(20_000, 2 + seed).scene));
        cases.push(pair(&random, scenes::bumpy_pair(200_000, 3 + seed).scene));
        cases.push(many(&near, scenes::scattered(500, 2 + seed)));
    }
    match puma_links() {
        Some(links) => {
            cases.push(Case::of_arm(scenes::puma_random(1 + seed), &links, &near));
            cases.push(Case::of_arm(scenes::puma_coherent(1 + seed), &links, &near));
        }
        None => eprintln!("LEFT OUT: the Puma 560, for its meshes are not in build/puma560"),
    }
    cases
}

impl Case {
    pub fn of(scene: scenes::Scene, query: Query, modes: &[Mode]) -> Self {
        Self {
            name: scene.name,
            query,
            modes: modes.to_vec(),
            moving: vec![mesh(&scene.moving)],
            obstacles: scene.obstacles.iter().map(mesh).collect(),
            poses: scene.poses.iter().map(|p| vec![pose(p)]).collect(),
            counts: always,
        }
    }

    fn of_arm(scene: scenes::ArmScene, links: &[Mesh], modes: &[Mode]) -> Self {
        Self {
            name: scene.name,
            query: Query::CObject,
            modes: modes.to_vec(),
            moving: links.to_vec(),
            obstacles: scene.obstacles.iter().map(mesh).collect(),
            poses: scene
                .link_poses
                .iter()
                .map(|poses| poses.iter().map(pose).collect())
                .collect(),
            counts: always,
        }
    }

    /// The same with every polygon as a fan of triangles, as peers are given it.
    pub fn in_triangles(&self) -> Self {
        let cut = |meshes: &[Mesh]| meshes.iter().map(fans).collect();
        Self {
            name: self.name.clone(),
            query: self.query,
            modes: self.modes.clone(),
            moving: cut(&self.moving),
            obstacles: cut(&self.obstacles),
            poses: self.poses.clone(),
            counts: self.counts,
        }
    }

    pub fn polygons(&self) -> [usize; 2] {
        [&self.moving, &self.obstacles]
            .map(|meshes| meshes.iter().map(|m| m.face_sizes.len()).sum())
    }
}

/// The seven links of the Puma 560, if scripts/fetch_puma560.sh has got them.
fn puma_links() -> Option<Vec<Mesh>> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/build/puma560");
    (0..7)
        .map(|link| read_mesh_file(format!("{folder}/link{link}.stl").as_ref()).ok())
        .collect()
}

fn mesh(mesh: &scenes::Mesh) -> Mesh {
    Mesh {
        vertices: mesh.vertices.iter().map(|&p| Vec3::from(p)).collect(),
        face_sizes: mesh.faces.iter().map(|face| face.len() as u32).collect(),
        indices: mesh.faces.concat(),
    }
}

fn pose(pose: &scenes::Pose) -> Pose {
    let m = &pose.0;
    Pose {
        rotation: Mat3::new(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]),
        translation: Vec3::new(m[3], m[7], m[11]),
    }
}

/// All in one.
pub fn merged(meshes: &[Mesh]) -> Mesh {
    let mut all = Mesh {
        vertices: Vec::new(),
        face_sizes: Vec::new(),
        indices: Vec::new(),
    };
    for mesh in meshes {
        let first = all.vertices.len() as u32;
        all.vertices.extend(&mesh.vertices);
        all.face_sizes.extend(&mesh.face_sizes);
        all.indices.extend(mesh.indices.iter().map(|i| i + first));
    }
    all
}

/// A mesh with its faces in fans of triangles.
fn fans(mesh: &Mesh) -> Mesh {
    let indices = Triangles::of(mesh).triangles;
    Mesh {
        vertices: mesh.vertices.clone(),
        face_sizes: vec![3; indices.len() / 3],
        indices,
    }
}

/// A mesh as peers take it: faces in fans of triangles.
pub struct Triangles {
    pub vertices: Vec<f64>,
    pub triangles: Vec<u32>,
}

impl Triangles {
    pub fn of(mesh: &Mesh) -> Self {
        let mut triangles = Vec::new();
        let mut rest = &mesh.indices[..];
        for &size in &mesh.face_sizes {
            let (face, after) = rest.split_at(size as usize);
            for i in 1..face.len() - 1 {
                triangles.extend([face[0], face[i], face[i + 1]]);
            }
            rest = after;
        }
        Self {
            vertices: mesh.vertices.iter().flat_map(|p| [p.x, p.y, p.z]).collect(),
            triangles,
        }
    }
}
