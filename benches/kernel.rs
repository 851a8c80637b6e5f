//! Queries of two bodies against FCL, Coal and parry on the same poses in one process:
//! `scripts/bench.sh kernel [--csv FILE] [--quick]`.
//!
//! Every variant of every library runs each row once; the fastest of each library then run several times in turn with ours,
//! and medians count. All answers are compared.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::fmt::Write as _;
use std::time::Instant;

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::hierarchy::{HierarchyOptions, WrapperKind};
use cstk::pose::{Mat3, Pose, Vec3};
use cstk::query::QueryContext;
use cstk_scenes::{self as scenes, Scene};
use parry3d_f64::math::Pose as ParryPose;
use parry3d_f64::shape::TriMesh;

/// How often the fastest variants run.
const REPEATS: usize = 5;

#[derive(Clone, Copy, PartialEq)]
enum Mode {
    Distance,
    Within(f64),
    Collide,
}

impl Mode {
    fn name(self) -> String {
        match self {
            Mode::Distance => "D".into(),
            Mode::Within(threshold) => format!("I {threshold}"),
            Mode::Collide => "collide".into(),
        }
    }

    fn number(self) -> (c_int, f64) {
        match self {
            Mode::Distance => (0, 0.0),
            Mode::Within(threshold) => (1, threshold),
            Mode::Collide => (2, 0.0),
        }
    }
}

/// One way to answer all queries of a row: seconds of the pass, and the answers.
struct Runner<'a> {
    library: &'static str,
    variant: String,
    run: Box<dyn FnMut() -> Option<(f64, Vec<f64>)> + 'a>,
    seconds: Vec<f64>,
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |name: &str| {
        let place = arguments.iter().position(|a| a == name)?;
        arguments.get(place + 1).cloned()
    };
    let quick = arguments.iter().any(|a| a == "--quick");
    let peers: Vec<Peer> = [("FCL", "fcl"), ("Coal", "coal")]
        .into_iter()
        .filter_map(|(name, prefix)| Peer::open(name, prefix))
        .collect();
    let mut csv = String::from("scene,mode,library,variant,microseconds_per_query\n");
    println!(
        "| row | B | BC | H | HC = default | FCL | Coal | parry | best peer / default | boxes, primitives a query |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    let mut ratios = Vec::new();
    for (scene, modes) in rows(quick) {
        for mode in modes {
            if let Some(ratio) = row(&scene, mode, &peers, &mut csv) {
                ratios.push(ratio);
            }
        }
    }
    let mean = ratios.iter().map(|r: &f64| r.ln()).sum::<f64>() / ratios.len().max(1) as f64;
    let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    println!(
        "\ngeometric mean of best peer / default over {} rows: {:.1}, least {least:.1}",
        ratios.len(),
        mean.exp()
    );
    if let Some(file) = value("--csv") {
        std::fs::write(&file, csv).unwrap_or_else(|error| panic!("{file}: {error}"));
        println!("written: {file}");
    }
}

fn rows(quick: bool) -> Vec<(Scene, Vec<Mode>)> {
    use Mode::{Collide, Distance, Within};
    let lamp = vec![Distance, Within(0.1), Collide];
    let teapot = vec![Distance, Within(0.01), Collide];
    let gear = vec![Distance, Within(0.0001), Within(0.00128), Collide];
    let random = vec![Distance, Within(0.001), Collide];
    let mut rows = vec![
        (scenes::free_lamp(), lamp.clone()),
        (scenes::teapot_contacts(), teapot.clone()),
        (scenes::gear_plate_motor(), gear.clone()),
        (scenes::free_lamp().turned(1), lamp),
        (scenes::teapot_contacts().turned(2), teapot),
        (scenes::gear_plate_motor().turned(3), gear),
        (scenes::random_pair(20_000, 1), random.clone()),
    ];
    if !quick {
        rows.push((scenes::random_pair(20_000, 2), random.clone()));
        rows.push((scenes::random_pair(200_000, 3), random));
    }
    rows
}

/// Measures one row and prints it. The ratio of the best peer's time to ours.
fn row(scene: &Scene, mode: Mode, peers: &[Peer], csv: &mut String) -> Option<f64> {
    let name = format!("{} {}", scene.name, mode.name());
    let merged = merge(&scene.obstacles);
    let poses: Vec<Pose> = scene.poses.iter().map(pose).collect();
    let flat: Vec<f64> = scene.poses.iter().flat_map(|p| p.0).collect();
    let boxed = [WrapperKind::AlignedBox, WrapperKind::Hull]
        .map(|wrapper| [&scene.moving, &merged].map(|mesh| body(mesh, wrapper)));
    let parry = [&scene.moving, &merged].map(parry_mesh);
    let parry_poses: Vec<ParryPose> = scene.poses.iter().map(parry_pose).collect();
    let mut runners = Vec::new();
    let mut tests = [0.0; 2];
    for (bodies, letter) in boxed.iter().zip(["B", "H"]) {
        for cached in [false, true] {
            let poses = &poses;
            let work = || ours(bodies, poses, mode, cached);
            if letter == "H" && cached {
                tests = work().2;
            }
            runners.push(Runner {
                library: "cstk",
                variant: format!("{letter}{}", if cached { "C" } else { "" }),
                run: Box::new(move || {
                    let (seconds, answers, _) = ours(bodies, poses, mode, cached);
                    Some((seconds, answers))
                }),
                seconds: Vec::new(),
            });
        }
    }
    let triangles = Triangles::of(&scene.moving);
    let obstacles: Vec<Triangles> = scene.obstacles.iter().map(Triangles::of).collect();
    for peer in peers {
        for variant in 0..peer.variants(mode) {
            if peer.serves(variant, mode) {
                let runner = peer.runner(variant, mode, &triangles, &obstacles, &flat);
                runners.extend(runner);
            }
        }
    }
    runners.push(Runner {
        library: "parry",
        variant: "trimesh".into(),
        run: Box::new(|| parry_run(&parry, &parry_poses, mode)),
        seconds: Vec::new(),
    });
    let mut expected: Vec<f64> = Vec::new();
    let mut notes = Vec::new();
    for runner in &mut runners {
        eprint!(
            "\r{name}: {} {}                         ",
            runner.library, runner.variant
        );
        let Some((seconds, answers)) = (runner.run)() else {
            continue;
        };
        runner.seconds.push(seconds);
        if expected.is_empty() {
            expected = answers;
            continue;
        }
        let differences = expected.iter().zip(&answers).map(|(a, b)| (a - b).abs());
        let wrong = differences.filter(|&d| d > if mode == Mode::Distance { 1e-7 } else { 0.5 });
        let (count, worst) = wrong.fold((0, 0.0f64), |(n, worst), d| (n + 1, worst.max(d)));
        if count > 0 {
            notes.push(format!(
                "{} {}: {count} answers differ, by up to {worst:.1e}",
                runner.library, runner.variant
            ));
        }
    }
    // The fastest of each library, in turn with ours.
    let mut kept: Vec<usize> = (0..4).collect();
    for library in ["FCL", "Coal", "parry"] {
        let mut of: Vec<usize> = (0..runners.len())
            .filter(|&i| runners[i].library == library && !runners[i].seconds.is_empty())
            .collect();
        of.sort_by(|&i, &j| runners[i].seconds[0].total_cmp(&runners[j].seconds[0]));
        kept.extend(of.into_iter().take(2));
    }
    for _ in 0..REPEATS {
        for &i in &kept {
            let slow = runners[i].seconds[0] > 2.0;
            if slow {
                continue;
            }
            if let Some((seconds, _)) = (runners[i].run)() {
                runners[i].seconds.push(seconds);
            }
        }
    }
    eprint!("\r{:70}\r", "");
    let micro = |runner: &Runner| {
        let mut seconds = runner.seconds.clone();
        seconds.sort_by(f64::total_cmp);
        seconds
            .get(seconds.len() / 2)
            .map_or(f64::INFINITY, |s| s / poses.len() as f64 * 1e6)
    };
    for &i in &kept {
        let runner = &runners[i];
        writeln!(
            csv,
            "{},{},{},{},{:.4}",
            scene.name,
            mode.name(),
            runner.library,
            runner.variant,
            micro(runner)
        )
        .expect("strings grow");
    }
    let best = |library: &str| {
        kept.iter()
            .map(|&i| &runners[i])
            .filter(|runner| runner.library == library)
            .map(|runner| (micro(runner), runner.variant.clone()))
            .min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let default = micro(&runners[3]);
    let shown = |library: &str| {
        best(library).map_or("-".into(), |(us, variant)| format!("{us:.3} ({variant})"))
    };
    let best_peer = ["FCL", "Coal", "parry"]
        .iter()
        .filter_map(|library| Some(best(library)?.0))
        .fold(f64::INFINITY, f64::min);
    println!(
        "| {name} | {:.3} | {:.3} | {:.3} | {default:.3} | {} | {} | {} | {:.1} | {:.0}, {:.1} |",
        micro(&runners[0]),
        micro(&runners[1]),
        micro(&runners[2]),
        shown("FCL"),
        shown("Coal"),
        shown("parry"),
        best_peer / default,
        tests[0],
        tests[1],
    );
    for note in notes {
        eprintln!("  {name}: {note}");
    }
    best_peer.is_finite().then_some(best_peer / default)
}

/// Our queries, with or without the witnesses of the last one; and boxes and primitives tested a query.
fn ours(bodies: &[Body; 2], poses: &[Pose], mode: Mode, cached: bool) -> (f64, Vec<f64>, [f64; 2]) {
    let mut context = QueryContext::new();
    let identity = Pose::identity();
    let mut answers = Vec::with_capacity(poses.len());
    let start = Instant::now();
    for pose in poses {
        if !cached {
            context.clear();
        }
        let (a, b) = ((&bodies[0], pose), (&bodies[1], &identity));
        answers.push(match mode {
            Mode::Distance => {
                context
                    .pair_distance(a, b, f64::INFINITY)
                    .expect("a distance")
                    .distance
            }
            Mode::Within(threshold) => f64::from(u8::from(
                context.pair_within(a, b, threshold).expect("an answer"),
            )),
            Mode::Collide => {
                f64::from(u8::from(context.pair_within(a, b, 0.0).expect("an answer")))
            }
        });
    }
    let seconds = start.elapsed().as_secs_f64();
    let done = context.statistics();
    let each = |count: u64| count as f64 / poses.len() as f64;
    (
        seconds,
        answers,
        [each(done.node_pairs), each(done.primitive_pairs)],
    )
}

fn body(mesh: &scenes::Mesh, wrapper: WrapperKind) -> Body {
    let mut builder = BodyBuilder::new(3).expect("a builder");
    let mesh = Mesh {
        vertices: mesh.vertices.iter().map(|&p| Vec3::from(p)).collect(),
        face_sizes: mesh.faces.iter().map(|face| face.len() as u32).collect(),
        indices: mesh.faces.concat(),
    };
    builder.add_mesh(&mesh).expect("a sound mesh");
    let options = HierarchyOptions {
        wrapper,
        ..HierarchyOptions::default()
    };
    builder.build(&options, &mut |_| Ok(())).expect("a body")
}

fn merge(meshes: &[scenes::Mesh]) -> scenes::Mesh {
    let mut merged = meshes[0].clone();
    for mesh in &meshes[1..] {
        merged.append(mesh);
    }
    merged
}

fn pose(pose: &scenes::Pose) -> Pose {
    let m = &pose.0;
    Pose {
        rotation: Mat3::new(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]),
        translation: Vec3::new(m[3], m[7], m[11]),
    }
}

/// A mesh as peers take it: faces in fans of triangles.
struct Triangles {
    vertices: Vec<f64>,
    triangles: Vec<u32>,
}

impl Triangles {
    fn of(mesh: &scenes::Mesh) -> Self {
        let fan = |face: &Vec<u32>| -> Vec<u32> {
            (1..face.len() - 1)
                .flat_map(|i| [face[0], face[i], face[i + 1]])
                .collect()
        };
        Self {
            vertices: mesh.vertices.concat(),
            triangles: mesh.faces.iter().flat_map(fan).collect(),
        }
    }

    fn as_peer(&self) -> PeerMesh {
        PeerMesh {
            vertices: self.vertices.as_ptr(),
            vertex_count: self.vertices.len() / 3,
            triangles: self.triangles.as_ptr(),
            triangle_count: self.triangles.len() / 3,
        }
    }
}

fn parry_mesh(mesh: &scenes::Mesh) -> TriMesh {
    let mesh = Triangles::of(mesh);
    let vertices = mesh
        .vertices
        .chunks_exact(3)
        .map(|p| parry3d_f64::math::Vector::new(p[0], p[1], p[2]));
    let (triangles, _) = mesh.triangles.as_chunks::<3>();
    TriMesh::new(vertices.collect(), triangles.to_vec()).expect("a mesh")
}

fn parry_pose(pose: &scenes::Pose) -> ParryPose {
    let m = &pose.0;
    let columns = [0, 1, 2].map(|k| parry3d_f64::math::Vector::new(m[k], m[4 + k], m[8 + k]));
    let rotation = parry3d_f64::math::Matrix::from_cols(columns[0], columns[1], columns[2]);
    ParryPose::from_parts(
        parry3d_f64::math::Vector::new(m[3], m[7], m[11]),
        parry3d_f64::math::Rotation::from_mat3(&rotation),
    )
}

fn parry_run(meshes: &[TriMesh; 2], poses: &[ParryPose], mode: Mode) -> Option<(f64, Vec<f64>)> {
    let still = ParryPose::identity();
    let mut answers = Vec::with_capacity(poses.len());
    let start = Instant::now();
    for pose in poses {
        let [a, b] = meshes;
        answers.push(match mode {
            Mode::Distance => {
                parry3d_f64::query::distance(pose, a, &still, b)
                    .ok()?
                    .distance
            }
            Mode::Within(threshold) => {
                let near =
                    parry3d_f64::query::closest_points(pose, a, &still, b, threshold).ok()?;
                f64::from(u8::from(!matches!(
                    near,
                    parry3d_f64::query::ClosestPoints::Disjoint
                )))
            }
            Mode::Collide => {
                let met = parry3d_f64::query::intersection_test(pose, a, &still, b).ok()?;
                f64::from(u8::from(met.intersecting))
            }
        });
        if start.elapsed().as_secs() > 5 {
            return None;
        }
    }
    Some((start.elapsed().as_secs_f64(), answers))
}

#[repr(C)]
struct PeerMesh {
    vertices: *const f64,
    vertex_count: usize,
    triangles: *const u32,
    triangle_count: usize,
}

/// A library behind benches/peers/peers.h.
struct Peer {
    name: &'static str,
    variant_count: unsafe extern "C" fn(c_int) -> c_int,
    variant_serves: unsafe extern "C" fn(c_int, c_int) -> c_int,
    variant_name: unsafe extern "C" fn(c_int) -> *const c_char,
    scene:
        unsafe extern "C" fn(*const PeerMesh, usize, *const PeerMesh, usize, c_int) -> *mut c_void,
    scene_free: unsafe extern "C" fn(*mut c_void),
    run: unsafe extern "C" fn(*mut c_void, c_int, f64, *const f64, usize, *mut f64) -> f64,
}

unsafe extern "C" {
    fn dlopen(file: *const c_char, flags: c_int) -> *mut c_void;
    fn dlsym(library: *mut c_void, name: *const c_char) -> *mut c_void;
}

impl Peer {
    // The fields say what the symbols are.
    #[allow(clippy::missing_transmute_annotations)]
    fn open(name: &'static str, prefix: &str) -> Option<Self> {
        let file = format!(
            "{}/build/peers/lib{prefix}_peer.so",
            env!("CARGO_MANIFEST_DIR")
        );
        let path = CString::new(file.clone()).expect("a path without NUL");
        const NOW: c_int = 2;
        // SAFETY: the library is ours; its constructors are those of C++ libraries.
        let library = unsafe { dlopen(path.as_ptr(), NOW) };
        if library.is_null() {
            eprintln!("LEFT OUT: {name}, for there is no {file}");
            return None;
        }
        let symbol = |suffix: &str| {
            let name = CString::new(format!("{prefix}_{suffix}")).expect("a name without NUL");
            // SAFETY: the library stays open.
            let found = unsafe { dlsym(library, name.as_ptr()) };
            assert!(!found.is_null(), "{name:?} is missing");
            found
        };
        // SAFETY: the types are those of peers.h.
        unsafe {
            Some(Self {
                name,
                variant_count: std::mem::transmute::<*mut c_void, _>(symbol("variant_count")),
                variant_serves: std::mem::transmute::<*mut c_void, _>(symbol("variant_serves")),
                variant_name: std::mem::transmute::<*mut c_void, _>(symbol("variant_name")),
                scene: std::mem::transmute::<*mut c_void, _>(symbol("scene")),
                scene_free: std::mem::transmute::<*mut c_void, _>(symbol("scene_free")),
                run: std::mem::transmute::<*mut c_void, _>(symbol("run")),
            })
        }
    }

    fn variants(&self, mode: Mode) -> c_int {
        // SAFETY: a plain function.
        unsafe { (self.variant_count)(mode.number().0) }
    }

    fn serves(&self, variant: c_int, mode: Mode) -> bool {
        // SAFETY: a plain function.
        unsafe { (self.variant_serves)(variant, mode.number().0) != 0 }
    }

    fn runner<'a>(
        &'a self,
        variant: c_int,
        mode: Mode,
        moving: &Triangles,
        obstacles: &[Triangles],
        poses: &'a [f64],
    ) -> Option<Runner<'a>> {
        let obstacles: Vec<PeerMesh> = obstacles.iter().map(Triangles::as_peer).collect();
        // SAFETY: the meshes live during the call, which copies them.
        let scene = unsafe {
            (self.scene)(
                &moving.as_peer(),
                1,
                obstacles.as_ptr(),
                obstacles.len(),
                variant,
            )
        };
        if scene.is_null() {
            return None;
        }
        let scene = Built { peer: self, scene };
        // SAFETY: the name is a literal of the library.
        let name = unsafe { CStr::from_ptr((self.variant_name)(variant)) };
        Some(Runner {
            library: self.name,
            variant: name.to_string_lossy().into_owned(),
            run: Box::new(move || scene.run(mode, poses)),
            seconds: Vec::new(),
        })
    }
}

/// A scene of a peer.
struct Built<'a> {
    peer: &'a Peer,
    scene: *mut c_void,
}

impl Built<'_> {
    fn run(&self, mode: Mode, poses: &[f64]) -> Option<(f64, Vec<f64>)> {
        let mut answers = vec![0.0; poses.len() / 12];
        let (number, threshold) = mode.number();
        let (poses, results) = (poses.as_ptr(), answers.as_mut_ptr());
        // SAFETY: one pose and one answer for each query.
        let seconds = unsafe {
            (self.peer.run)(self.scene, number, threshold, poses, answers.len(), results)
        };
        (seconds >= 0.0).then_some((seconds, answers))
    }
}

impl Drop for Built<'_> {
    fn drop(&mut self) {
        // SAFETY: made by the same library, and not used after this.
        unsafe { (self.peer.scene_free)(self.scene) }
    }
}
