//! Building hierarchies, and what they are worth: `scripts/bench.sh hierarchies [--csv FILE] [--quick] [--clouds]`; with
//! `--clouds` the point clouds alone.
//!
//! Builds run each in a process of its own, so that the memory shown is theirs alone; seconds are medians of several.
//! Tests per query are counts, the same on every machine.

mod clouds;

use std::fmt::Write as _;
use std::process::Command;
use std::time::Instant;

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::hierarchy::{BuildTimes, Grouping, HierarchyOptions, Pieces, WrapperKind};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk_scenes::{self as scenes, Scene};

/// A model by name, with how many times its builds are repeated.
struct Model {
    name: &'static str,
    make: fn() -> scenes::Mesh,
    repeats: usize,
    /// What the report says of it.
    report: &'static str,
}

const REPORT_MODELS: [Model; 5] = [
    Model {
        name: "robot base",
        make: scenes::robot_base,
        repeats: 9,
        report: "12-13 levels",
    },
    Model {
        name: "lamp",
        make: scenes::lamp,
        repeats: 9,
        report: "16-17 levels",
    },
    Model {
        name: "five lamps",
        make: || scenes::lamps(5, 1),
        repeats: 9,
        report: "21 levels; 35 s basic, 12 s with adjacency",
    },
    Model {
        name: "44 robot bases",
        make: || scenes::robot_bases(44, 1),
        repeats: 5,
        report: "210 s basic, 50 s hybrid",
    },
    Model {
        name: "stalagmite",
        make: || scenes::stalagmite(1),
        repeats: 3,
        report: "under 25 min hybrid",
    },
];

const HARD_MODELS: [Model; 15] = [
    sized("bumpy sphere 1e4", || scenes::bumpy_sphere(10_000, 1), 5),
    sized("bumpy sphere 1e5", || scenes::bumpy_sphere(100_000, 1), 3),
    sized("bumpy sphere 1e6", || scenes::bumpy_sphere(1_000_000, 1), 3),
    sized("spaghetti 1e4", || scenes::spaghetti(10_000, 1), 5),
    sized("spaghetti 1e5", || scenes::spaghetti(100_000, 1), 3),
    sized("spaghetti 1e6", || scenes::spaghetti(1_000_000, 1), 3),
    sized("coincident 1e4", || scenes::coincident(10_000), 5),
    sized("coincident 1e5", || scenes::coincident(100_000), 3),
    sized("coincident 1e6", || scenes::coincident(1_000_000), 3),
    sized(
        "floor, screws 1e4",
        || scenes::floor_and_screws(10_000, 1),
        5,
    ),
    sized(
        "floor, screws 1e5",
        || scenes::floor_and_screws(100_000, 1),
        3,
    ),
    sized(
        "floor, screws 1e6",
        || scenes::floor_and_screws(1_000_000, 1),
        3,
    ),
    sized("nested shells 1e4", || scenes::nested_shells(10_000), 5),
    sized("nested shells 1e5", || scenes::nested_shells(100_000), 3),
    sized("nested shells 1e6", || scenes::nested_shells(1_000_000), 3),
];

const fn sized(name: &'static str, make: fn() -> scenes::Mesh, repeats: usize) -> Model {
    Model {
        name,
        make,
        repeats,
        report: "",
    }
}

const GROUPINGS: [(&str, Grouping); 3] = [
    ("hybrid", Grouping::Hybrid),
    ("basic", Grouping::Basic),
    ("top-down", Grouping::TopDown),
];

const WRAPPERS: [(&str, WrapperKind); 5] = [
    ("hull", WrapperKind::Hull),
    ("oriented box", WrapperKind::OrientedBox),
    ("aligned box", WrapperKind::AlignedBox),
    ("tight sphere", WrapperKind::TightSphere),
    ("merged sphere", WrapperKind::MergedSphere),
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |name: &str| {
        let place = arguments.iter().position(|a| a == name)?;
        arguments.get(place + 1).cloned()
    };
    if let Some(request) = value("--build") {
        build_and_tell(&request);
        return;
    }
    if let Some(request) = value("--build-cloud") {
        clouds::build_and_tell(&request);
        return;
    }
    let quick = arguments.iter().any(|a| a == "--quick");
    if arguments.iter().any(|a| a == "--clouds") {
        println!("processor: {}\n", processor());
        clouds::print(quick);
        return;
    }
    let mut csv = String::from("body,polygons,builder,wrapper,threads,depth,seconds,bytes\n");
    println!("processor: {}\n", processor());
    print_builds(&mut csv, quick);
    print_wrappers(&mut csv);
    print_hard(&mut csv, quick);
    clouds::print(quick);
    print_queries();
    if let Some(file) = value("--csv") {
        std::fs::write(&file, csv).unwrap_or_else(|error| panic!("{file}: {error}"));
        println!("written: {file}");
    }
}

/// What one process found of its build.
struct Row {
    polygons: usize,
    depth: u64,
    grouping: f64,
    construction: f64,
    total: f64,
    bytes: u64,
    peak_mebibytes: f64,
}

/// Builds a model in a process of its own.
fn build(model: &str, grouping: &str, wrapper: &str, threads: usize, csv: &mut String) -> Row {
    eprint!("\r{model}, {grouping}, {wrapper}, {threads} threads          ");
    let request = format!("{model}|{grouping}|{wrapper}|{threads}");
    let exe = std::env::current_exe().expect("the path of this program");
    let output = Command::new(exe)
        .args(["--build", &request])
        .output()
        .expect("this program runs");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let numbers: Vec<f64> = text
        .split_whitespace()
        .filter_map(|word| word.parse().ok())
        .collect();
    let [
        polygons,
        depth,
        grouping_seconds,
        construction,
        total,
        bytes,
        peak,
    ] = numbers[..]
    else {
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        panic!("the build of {request} failed: {text}{errors}");
    };
    eprint!("\r{:60}\r", "");
    writeln!(
        csv,
        "{},{polygons},{grouping},{wrapper},{threads},{depth},{total:.6},{bytes}",
        model.replace(',', "")
    )
    .expect("strings grow");
    Row {
        polygons: polygons as usize,
        depth: depth as u64,
        grouping: grouping_seconds,
        construction,
        total,
        bytes: bytes as u64,
        peak_mebibytes: peak / 1024.0,
    }
}

/// The inner side of `build`: prints what it measured.
fn build_and_tell(request: &str) {
    let words: Vec<&str> = request.split('|').collect();
    let [name, grouping, wrapper, threads] = words[..] else {
        panic!("--build MODEL|GROUPING|WRAPPER|THREADS");
    };
    let model = REPORT_MODELS
        .iter()
        .chain(&HARD_MODELS)
        .find(|m| m.name == name)
        .expect("a known model");
    let builder = builder_of(&(model.make)());
    let options = HierarchyOptions {
        grouping: GROUPINGS
            .iter()
            .find(|g| g.0 == grouping)
            .expect("a grouping")
            .1,
        wrapper: WRAPPERS
            .iter()
            .find(|w| w.0 == wrapper)
            .expect("a wrapper")
            .1,
        threads: threads.parse().expect("a number of threads"),
        ..HierarchyOptions::default()
    };
    let mut runs: Vec<(f64, BuildTimes)> = Vec::new();
    let mut last = None;
    for _ in 0..model.repeats {
        // One body at a time, so that the peak of memory is that of a build.
        drop(last.take());
        let start = Instant::now();
        let body = builder.build(&options, &mut |_| Ok(())).expect("a body");
        runs.push((start.elapsed().as_secs_f64(), body.statistics().times));
        last = Some(body);
    }
    runs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (total, times) = &runs[runs.len() / 2];
    let body = last.expect("at least one run");
    println!(
        "{} {} {} {} {} {} {}",
        body.primitives().len(),
        body.statistics().depth,
        times.grouping,
        times.construction,
        total,
        body.tree().bytes() + body.packed().bytes(),
        peak_kibibytes()
    );
}

fn print_builds(csv: &mut String, quick: bool) {
    println!("### The report's bodies, hull wrappers\n");
    println!(
        "| body | polygons | 2 log2 N | builder | levels | grouping, s | wrappers, s | total, s | two threads, s | the report (1997) |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    for model in &REPORT_MODELS[..if quick { 4 } else { 5 }] {
        for (name, _) in GROUPINGS {
            let one = build(model.name, name, "hull", 1, csv);
            let two = build(model.name, name, "hull", 2, csv);
            println!(
                "| {} | {} | {:.1} | {name} | {} | {:.4} | {:.4} | {:.4} | {:.4} | {} |",
                model.name,
                one.polygons,
                2.0 * (one.polygons as f64).log2(),
                one.depth,
                one.grouping,
                one.construction,
                one.total,
                two.total,
                model.report
            );
        }
    }
    println!();
}

fn print_wrappers(csv: &mut String) {
    println!("### Kinds of wrappers: 44 robot bases, hybrid, one thread\n");
    println!("| wrapper | wrappers, s | hierarchy, MiB |");
    println!("| --- | --- | --- |");
    for (name, _) in WRAPPERS {
        let row = build("44 robot bases", "hybrid", name, 1, csv);
        println!(
            "| {name} | {:.4} | {:.1} |",
            row.construction,
            row.bytes as f64 / f64::from(1 << 20)
        );
    }
    println!();
}

fn print_hard(csv: &mut String, quick: bool) {
    println!("### Hard bodies and large ones, hull wrappers, one thread\n");
    println!(
        "| body | polygons | builder | levels | total, s | µs a polygon | hierarchy, MiB | peak of the process, MiB |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for model in HARD_MODELS
        .iter()
        .filter(|m| !quick || !m.name.ends_with("1e6"))
    {
        for (name, _) in GROUPINGS {
            let row = build(model.name, name, "hull", 1, csv);
            println!(
                "| {} | {} | {name} | {} | {:.3} | {:.2} | {:.1} | {:.0} |",
                model.name,
                row.polygons,
                row.depth,
                row.total,
                row.total / row.polygons as f64 * 1e6,
                row.bytes as f64 / f64::from(1 << 20),
                row.peak_mebibytes
            );
        }
    }
    println!();
}

/// A way of building that queries are counted for.
fn variants() -> Vec<(String, HierarchyOptions)> {
    let base = HierarchyOptions::default();
    let mut variants: Vec<(String, HierarchyOptions)> = GROUPINGS
        .iter()
        .map(|&(name, grouping)| {
            (
                format!("{name}, hull"),
                HierarchyOptions { grouping, ..base },
            )
        })
        .collect();
    for (name, wrapper) in &WRAPPERS[1..] {
        let options = HierarchyOptions {
            wrapper: *wrapper,
            ..base
        };
        variants.push((format!("hybrid, {name}"), options));
    }
    let mut named = |name: &str, options| variants.push((name.into(), options));
    named(
        "hybrid, hull up to 64 vertices",
        HierarchyOptions {
            hull_vertex_limit: 64,
            ..base
        },
    );
    named(
        "hybrid, hull, aspect limit 4",
        HierarchyOptions {
            aspect_limit: 4.0,
            ..base
        },
    );
    named(
        "hybrid, hull, coplanar pieces",
        HierarchyOptions {
            pieces: Pieces::Coplanar,
            ..base
        },
    );
    named(
        "hybrid, hull, convex patches",
        HierarchyOptions {
            pieces: Pieces::Patches,
            ..base
        },
    );
    variants
}

fn print_queries() {
    let designed = [
        scenes::free_lamp(),
        scenes::teapot_contacts(),
        scenes::gear_plate_motor(),
    ];
    let turned = [1, 2, 3].map(|seed| designed[seed as usize - 1].turned(seed));
    let seeded = [
        scenes::free_lamp_seeded(7),
        scenes::teapot_contacts_seeded(7),
        scenes::gear_plate_motor_seeded(7),
    ];
    let all: Vec<Scene> = designed.into_iter().chain(turned).chain(seeded).collect();
    for (title, threshold) in [
        (
            "Tests per distance query: box pairs / primitive pairs",
            None,
        ),
        (
            "Tests per interference query (FL 0.1, FP 0.01, GPM 0.00128): box pairs / primitive pairs",
            Some([0.1, 0.01, 0.00128]),
        ),
    ] {
        println!("### {title}\n");
        print!("| builder, wrapper |");
        for scene in &all {
            print!(" {} |", scene.name);
        }
        println!("\n| --- |{}", " --- |".repeat(all.len()));
        for (name, options) in variants() {
            print!("| {name} |");
            for (i, scene) in all.iter().enumerate() {
                eprint!("\r{name}: {}          ", scene.name);
                let counts = count_tests(scene, &options, threshold.map(|t| t[i % 3]));
                eprint!("\r{:60}\r", "");
                print!(" {:.0} / {:.1} |", counts[0], counts[1]);
            }
            println!();
        }
        println!();
    }
}

/// Wrapper pairs and primitive pairs tested per query along the motion: the nearest of all obstacles, or whether one is
/// within the threshold.
fn count_tests(scene: &Scene, options: &HierarchyOptions, threshold: Option<f64>) -> [f64; 2] {
    let body = |mesh: &scenes::Mesh| {
        let built = builder_of(mesh).build(options, &mut |_| Ok(()));
        built.expect("a body")
    };
    let moving = body(&scene.moving);
    let obstacles: Vec<Body> = scene.obstacles.iter().map(body).collect();
    let still = Pose::identity();
    let mut query = QueryContext::new();
    for pose in &scene.poses {
        let pose = Pose::from_row_major(&pose.0).expect("a pose");
        let mut nearest = f64::INFINITY;
        for obstacle in &obstacles {
            let (a, b) = ((&moving, &pose), (obstacle, &still));
            match threshold {
                None => {
                    let found = query.pair_distance(a, b, nearest).expect("a distance");
                    nearest = nearest.min(found.distance);
                }
                Some(threshold) => {
                    if query.pair_within(a, b, threshold).expect("an answer") {
                        break;
                    }
                }
            }
        }
    }
    let done = query.statistics();
    [done.node_pairs, done.primitive_pairs].map(|n| n as f64 / scene.poses.len() as f64)
}

fn builder_of(mesh: &scenes::Mesh) -> BodyBuilder {
    let mut builder = BodyBuilder::new(3).expect("a builder");
    let mesh = Mesh {
        vertices: mesh.vertices.iter().map(|&p| Vec3::from(p)).collect(),
        face_sizes: mesh.faces.iter().map(|face| face.len() as u32).collect(),
        indices: mesh.faces.concat(),
    };
    builder.add_mesh(&mesh).expect("a sound mesh");
    builder
}

/// The machine's processor, where /proc tells it.
fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = text
        .lines()
        .find_map(|line| line.strip_prefix("model name"));
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    let name = model.map_or("unknown", |rest| rest.trim_start_matches([':', ' ', '\t']));
    format!("{name}, {threads} threads")
}

/// The most memory this process had, where /proc tells it.
fn peak_kibibytes() -> f64 {
    memory_kibibytes("VmHWM:")
}

/// A figure of this process's memory, where /proc tells it.
fn memory_kibibytes(name: &str) -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix(name));
    line.and_then(|rest| rest.split_whitespace().next()?.parse().ok())
        .unwrap_or(0.0)
}
